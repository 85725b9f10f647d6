"""biped_adrc: rigid-body dynamics and control research on underactuated walking.

`import biped_adrc as ba` gives the public names, such as `ba.Biped`, `ba.Walker`, `ba.simulate`.
They are listed once, in `__init__.pyi`: a type checker reads that file as it is, and at run time
this module reads in it which module defines each name.

A module is imported when one of its names is first used. Pinocchio, CasADi and matplotlib
take seconds to load, and most programs need only some of them.
"""

import re
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path

__version__ = "0.4.0"

_STUB = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_HOMES = {
    name: module
    for module, name in re.findall(r"^from biped_adrc\.(\S+) import (\w+)", _STUB, re.M)
}
"""Public name -> the module below `biped_adrc` that defines it, read from `__init__.pyi`."""
__all__ = tuple(_HOMES)


def __getattr__(name: str) -> object:
    """Import a public name and return it; Python calls this for names that are not loaded yet (PEP 562).

    Raises AttributeError for other names, and proposes the public name that is most alike.
    """
    if name not in _HOMES:
        near = get_close_matches(name, _HOMES, 1)
        meant = f"; did you mean '{near[0]}'?" if near else ""
        raise AttributeError(f"module 'biped_adrc' has no attribute '{name}'{meant}")
    return getattr(import_module(f"biped_adrc.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    """What `dir(biped_adrc)` lists: names that are loaded and those that would be on first use."""
    return sorted([*globals(), *_HOMES])
