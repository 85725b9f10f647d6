"""The registry: which controllers, observers, disturbances, curves, robots and gaits a scenario may name.

Each packaged thing is one line of `registry.toml`: its class or function as `module:name`, words for a reader,
and values where a scenario has none. Besides these a name may be one that `register` added in this process, or
`package.module:Class` of the user's own, in Python, on the command line and in study files alike.

Classes are imported when a walker is built, never when a file is read. Those of the user are also looked for in
the working directory, so that worker processes find them. `construct` calls a class with those values that its
constructor takes by name, which is how a new controller gets gains, reference or observer without code here.

What becomes of a name:

    "adrc"             spelled -> "ADRC" -> find -> Entry -> load -> ADRCController -> construct
    "my_law:Mine"      no entry; find -> Entry("my_law:Mine") -> load imports my_law
    register(.., f)    Entry with the object itself; records name it by its module:Class (`portable`)
"""

from __future__ import annotations

import hashlib
import inspect
import os
import re
import sys
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import lru_cache
from importlib import import_module
from inspect import Parameter, signature
from types import MappingProxyType
from typing import TypeVar

from biped_adrc.errors import BipedError, InputError
from biped_adrc.parts import check_part
from biped_adrc.resources import data_folder, packaged

_OWN = re.compile(r"[^\W\d]\w*(\.[^\W\d]\w*)*:[^\W\d]\w*(\.[^\W\d]\w*)*")
"""package.module:Class, or Class.Inner of a class inside a class."""

_OF_A_FILE = ContextVar("_OF_A_FILE", default=False)
"""Whether names come from a stored run."""
_T = TypeVar("_T")
_VARIADIC = (Parameter.VAR_POSITIONAL, Parameter.VAR_KEYWORD)


@dataclass(frozen=True)
class Entry:
    """One thing of the registry."""

    home: str
    """Its class or function as `module:name`."""
    words: str = ""
    """A description for a reader."""
    defaults: Mapping[str, float] = field(default_factory=dict)
    """Values of a scenario that it takes where the scenario has none."""
    over_steps: bool = False
    """Of a disturbance: whether it goes on over impacts, with its window in time of the walk."""
    given: Callable[..., object] | None = None
    """The object itself, where `register` was given it; None: it is imported from `home`."""

    def load(self) -> Callable[..., object]:
        """The class or function itself. Raises InputError where the user's own cannot be imported."""
        return _imported(self.home) if self.given is None else self.given


BASES = {
    "controller": "biped_adrc.control.base:Controller",
    "contact": "biped_adrc.control.across_contact:AcrossContact",
    "around": "biped_adrc.control.base:Controller",
    "observer": "biped_adrc.observers.base:Observer",
    "curve": "biped_adrc.gait.curves:Curve",
    "sensor": "biped_adrc.hardware.sensing:Sensor",
    "touchdown": "biped_adrc.hardware.touchdown:Touchdown",
    "disturbance": "biped_adrc.disturbances.base:Disturbance",
    "plant": "biped_adrc.closed_loop.stepping_plant:SteppingPlant",
    "robot": "biped_adrc.model.biped:Biped",
    "gait": "biped_adrc.gait.gait:Gait",
}
"""What a thing of each kind has to be."""

REGISTRY: dict[str, dict[str, Entry]] = {
    kind: {name: Entry(**values) for name, values in entries.items()}
    for kind, entries in packaged("biped_adrc.scenario", "registry.toml").items()
} | {"robot": {}, "gait": {}}
"""By kind and name, from registry.toml and `register`; `names` has curves and files of robots and gaits too."""


def names(kind: str) -> tuple[str, ...]:
    """All names of one kind, packaged ones first."""
    return tuple(dict.fromkeys((*_stored(kind), *REGISTRY[kind])))


def _stored(kind: str) -> Iterable[str]:
    """Names that are no lines of registry.toml: folders of robots, files of gaits."""
    if kind == "robot":
        return sorted(path.parent.name for path in data_folder("urdf").glob("*/robot.toml"))
    return sorted({p.stem for p in data_folder("gaits").glob("*/*.json")}) if kind == "gait" else ()


def register(kind: str, name: str, thing: Callable[..., object], words: str = "") -> None:
    """Make a class or function of one's own known by a name, in this process.

        ba.register("controller", "my law", MyController, "PD with my feedforward")
        ba.walk_scenario(ba.Scenario({"name": "my law", "stiffness": 300.0}))

    kind: "controller", "contact", "observer", "sensor", "touchdown", "disturbance", "plant", "curve", "robot"
    or "gait". words: for a reader. Records of scenarios write it as `module:Class`, so that other processes
    find it. Raises InputError for an unknown kind, a thing of another kind, and for a name that is taken or
    reads as `module:Class`.
    """
    if kind not in REGISTRY:
        raise InputError(f"there is no kind '{kind}' of things; choose one of {list(REGISTRY)}")
    check_part(name, f"the name of a {kind}", str)
    if not callable(thing):
        raise InputError(f"'{name}' is registered as {thing!r}, expected a class or a function")
    base = _imported(BASES[kind])
    assert isinstance(base, type)
    if isinstance(thing, type) and kind != "plant" and not issubclass(thing, base):
        raise InputError(
            f"the {kind} '{name}' is registered as the class {thing.__name__}, expected a class below "
            f"{base.__name__}, or a function that makes one"
        )
    taken = {_plain(known) for known in names(kind)}
    if _plain(name) in taken or is_own(name) or not name.strip():
        raise InputError(
            f"the {kind} '{name}' cannot be registered: that name is taken or reads as module:Class; there are "
            f"{list(names(kind))}, choose another name"
        )
    home = f"{thing.__module__}:{getattr(thing, '__qualname__', name)}"
    REGISTRY[kind][name] = Entry(home, words, given=thing)
    if kind == "curve":
        from biped_adrc.gait.curves import CURVES

        CURVES[name] = thing


def registered(home: str) -> Callable[..., object] | None:
    """The object that `register` was given whose class is `home`, module:Class; None without one."""
    entries = (entry for of_kind in REGISTRY.values() for entry in of_kind.values())
    return next((entry.given for entry in entries if entry.given and entry.home == home), None)


def portable(kind: str, name: str) -> str:
    """The name by which another process finds it: `module:Class` for what was registered in this one."""
    entry = REGISTRY[kind].get(name)
    return entry.home if entry is not None and entry.given is not None else name


def own(kind: str, name: str) -> Callable[..., object] | None:
    """The user's class or function of this name for a robot or a gait; None where the name is that of a file.

    Raises InputError where it cannot be imported.
    """
    return find(kind, name).load() if is_own(name) or name in REGISTRY[kind] else None


@contextmanager
def read_from_a_file() -> Iterator[None]:
    """While a stored run is read, or walked again: names in it cause no import, and no call of what is neither
    registered nor the class of a part, which would run what somebody has written there.
    """
    token = _OF_A_FILE.set(True)
    try:
        yield
    finally:
        _OF_A_FILE.reset(token)


def is_own(name: str) -> bool:
    """True where a name has the form `package.module:Class`."""
    return _OWN.fullmatch(name) is not None


def spelled(kind: str, name: str) -> str:
    """The name as the registry spells it, whatever its capitals, hyphens and underscores; others unchanged."""
    return next((known for known in names(kind) if _plain(known) == _plain(name)), name)


def find(kind: str, name: str) -> Entry:
    """The entry of a name. Raises InputError with the names there are, the nearest first."""
    known = spelled(kind, name)
    if known in REGISTRY[kind]:
        return REGISTRY[kind][known]
    if is_own(name):
        return Entry(name)
    near = get_close_matches(name, names(kind), 1)
    hint = f"did you mean '{near[0]}'? There are" if near else "choose one of"
    raise InputError(
        f"{kind} '{name}' is unknown; {hint} {list(names(kind))}, or give one of your own as "
        "package.module:Class"
    )


def words(kind: str, name: str) -> str:
    """The description of a thing for a reader; for the user's own the first line of its docstring."""
    found = find(kind, name)
    return found.words or (found.load().__doc__ or name).strip().splitlines()[0]


def source_hash(thing: Callable[..., object]) -> str:
    """Hash (12 hexadecimal digits) of the source text of a class or function; "none" where there is no text.

    Stored walks carry it, so that a class changed since then is noticed.
    """
    try:
        return hashlib.sha256(inspect.getsource(thing).encode()).hexdigest()[:12]
    except (OSError, TypeError):
        return "none"


def _plain(name: str) -> str:
    """A name as it is compared: small letters, spaces for hyphens and underscores."""
    return name.casefold().replace("-", " ").replace("_", " ").strip()


def _imported(home: str) -> Callable[..., object]:
    """The class `module:Class`, from Python's path or the working directory.

    The working directory is put at the end of the path, so that it cannot hide an installed module. Whatever
    the user's module raises when it is imported becomes an InputError with the cause, as do a module and a
    class that there are not.
    """
    module, _, name = home.partition(":")
    ours = home.startswith("biped_adrc.")
    of_a_file = _OF_A_FILE.get()
    if of_a_file and (given := registered(home)) is not None:
        return given
    if of_a_file and not ours and module not in sys.modules:
        raise InputError(
            f"the file names '{home}', and reading a file imports nothing; import '{module}' before, if you "
            "trust it"
        )
    here = os.getcwd()
    if not ours and here not in sys.path and "" not in sys.path:
        sys.path.append(here)
    try:
        found = import_module(module)
    except ModuleNotFoundError as error:
        raise InputError(
            f"'{home}': there is no module '{error.name}' in '{here}' or on the path of Python; "
            "expected package.module:Class, in the working directory or installed, here and where workers run"
        ) from error
    except (Exception, SystemExit) as error:  # whatever a module of the user's may raise
        raise InputError(
            f"'{home}': importing '{module}' failed with {type(error).__name__}: {error}; run "
            f"python -c 'import {module}' to see where"
        ) from error
    thing: object = found
    for part in name.split("."):
        thing = getattr(thing, part, None)
    if not callable(thing):
        there = [key for key, x in vars(found).items() if isinstance(x, type)]
        near = get_close_matches(name, there, 1) or there
        raise InputError(f"'{home}': module '{module}' has no class '{name}'; it has {near}")
    if of_a_file and not (_is_packaged(home) or _is_part(thing)):
        raise InputError(
            f"the file names '{home}', which is no class of a part, and reading a file calls nothing else; "
            "register it before with ba.register, if you trust it"
        )
    return thing


def _is_packaged(home: str) -> bool:
    """Whether a line of registry.toml says module:name."""
    return any(entry.home == home for of_kind in REGISTRY.values() for entry in of_kind.values())


def _is_part(thing: object) -> bool:
    """Whether it is a class below one of BASES."""
    if not isinstance(thing, type):
        return False
    bases = (home.split(":") for home in BASES.values())
    return any(
        (base.__module__, base.__qualname__) == (module, name)
        for module, name in bases
        for base in thing.__mro__
    )


def takes(make: Callable[..., object]) -> Mapping[str, Parameter]:
    """The parameters of a class or function that may be given by name.

    Raises InputError for what has no signature, such as functions written in C.
    """
    try:
        return _takes(make)
    except TypeError:  # what has no hash
        return _takes.__wrapped__(make)
    except ValueError as error:
        raise InputError(f"{error}; expected a class or a function written in Python") from error


@lru_cache(maxsize=1024)
def _takes(make: Callable[..., object]) -> Mapping[str, Parameter]:
    """As `takes`; kept, since each walk of a study asks for the same."""
    found = signature(make).parameters
    return MappingProxyType({name: p for name, p in found.items() if p.kind not in _VARIADIC})


def lacking(make: Callable[..., object], values: Container[str]) -> list[str]:
    """Names of parameters without a default that are not among the values."""
    wanted = (p for p in takes(make).values() if p.default is Parameter.empty)
    return [p.name for p in wanted if p.name not in values]


def construct(
    what: str,
    make: Callable[..., object],
    values: Mapping[str, object],
    kind: type[_T],
    place: str = "",
) -> _T:
    """make(**values) with those of the values that it takes; the result has to be a `kind`.

    what: what is made, for messages, such as "controller 'NPD'"; place: the dotted name of its record.
    Raises InputError for values that are missing, an error inside of make, and a result of another class.
    """
    names, missing = takes(make), lacking(make, values)
    if missing and isinstance(make, type) and not issubclass(make, kind):
        raise InputError(f"{what} is no {kind.__name__}; expected a class below it")
    if missing:
        role = "" if isinstance(make, type) else f", a function that has to make a {kind.__name__},"
        raise InputError(
            f"{what}{role} needs {', '.join(missing)}; give {place}{'.' * bool(place)}{missing[0]}; it "
            f"gets by themselves {sorted(values)}"
        )
    try:
        made = make(**{name: x for name, x in values.items() if name in names})
    except BipedError:
        raise
    except (Exception, SystemExit) as error:  # whatever a class of the user's may raise
        raise InputError(f"{what} could not be made: {type(error).__name__}: {error}") from error
    if not isinstance(made, kind):
        raise InputError(
            f"{what} made a {type(made).__name__}, expected one of class {kind.__name__}"
        )
    return made
