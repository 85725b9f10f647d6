"""biped_adrc: rigid-body dynamics and control research on underactuated walking.

The public names are those of `__init__.pyi`. They are imported when they are first used, so that
`import biped_adrc` is quick.
"""

from __future__ import annotations

import re
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from typing import Any

__version__ = "0.2.0"

_STUB = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_HOMES = {
    name: module
    for module, name in re.findall(r"^from biped_adrc\.(\S+) import (\w+)", _STUB, re.M)
}
"""Public names and their modules."""
__all__ = tuple(_HOMES)


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        near = get_close_matches(name, _HOMES, 1)
        meant = f"; did you mean '{near[0]}'?" if near else ""
        raise AttributeError(f"module 'biped_adrc' has no attribute '{name}'{meant}")
    return getattr(import_module(f"biped_adrc.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
