"""The registry: which controllers, observers, disturbances, curves, robots and gaits a scenario may name.

Each packaged part is one line of `registry.toml`: its class or function as `module:name`, words for a reader,
and values where a scenario has none. Besides these a name may be one that `register` added in this process, or
`package.module:Class` of the user's own, in Python, on the command line and in study files alike.

Classes are imported when a walker (the closed loop of robot and controller) is built, never when a file is
read. Those of the user are also looked for in the working directory and in the folder of the study file that
names them. `construct` calls a class with those values that its constructor takes by name, which is how a new
controller gets gains, reference or observer without code here.

What becomes of a name:

    "adrc"             known_name -> "ADRC" -> find -> Entry -> load -> ADRCController -> construct
    "my_law:Mine"      no entry; find -> Entry("my_law:Mine") -> load imports my_law
    register(.., f)    Entry with the object itself; records name it by its module:Class (`portable`)
"""

import os
import re
import sys
from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.machinery import PathFinder
from inspect import Parameter, signature
from pkgutil import resolve_name
from threading import RLock
from types import MappingProxyType

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import BipedError, InputError, unknown
from biped_adrc.core.files import data_folder, packaged
from biped_adrc.core.types import T

_OWN = re.compile(r"[^\W\d]\w*(\.[^\W\d]\w*)*:[^\W\d]\w*(\.[^\W\d]\w*)*")
"""package.module:Class, or Class.Inner of a class inside a class."""

FOLDERS: dict[str, str] = {}
"""Name of a user's module -> folder of the study file that names a class of it; workers are handed a copy."""
_IMPORTING = RLock()
"""Held while folders are on the path: threads share it, and a module may name others while it is imported."""
Maker = Callable[..., object]
"""A class or function that makes a part."""


@dataclass(frozen=True)
class _Entry:
    """One entry of the registry: a class or function, and what a scenario has to know of it."""

    home: str
    """Its class or function as `module:name`."""
    words: str = ""
    """A description, which a list of the names shows."""
    defaults: Mapping[str, float] = field(default_factory=dict)
    """Values that it gets where a scenario states none, by their names in a scenario."""
    units: Mapping[str, str] = field(default_factory=dict)
    """Units of the values that only this part takes, and of K_p and K_d if they differ from NPD's."""
    over_steps: bool = False
    """For a disturbance: whether it goes on over impacts, with its window in the time of the walk; else its
    window is in the time of one single support."""
    thing: Maker | None = None
    """The object itself, where `register` was given it; None: it is imported from `home`."""

    def load(self) -> Maker:
        """The class or function itself. Raises InputError where the user's own cannot be imported."""
        return _imported(self.home) if self.thing is None else self.thing


REGISTRY: dict[str, dict[str, _Entry]] = {
    kind: {name: _Entry(**values) for name, values in entries.items()}
    for kind, entries in packaged("biped_adrc.core", "registry.toml").items()
} | {"robot": {}, "gait": {}}
"""Entries by kind and name, from registry.toml and `register`; `names` also has the files of robots and
gaits."""


def names(kind: str) -> tuple[str, ...]:
    """All names of one kind, packaged ones first."""
    return tuple(dict.fromkeys((*stored(kind), *REGISTRY[kind])))


@lru_cache
def stored(kind: str) -> tuple[str, ...]:
    """Names of robots or gaits that the package has as files (folders with a robot.toml, gaits as .json); none
    of another kind. They are read once in a process: reading was half the time of a new scenario.
    """
    if kind == "robot":
        return tuple(sorted(p.parent.name for p in data_folder("urdf").glob("*/robot.toml")))
    found = data_folder("gaits").glob("*/*.json") if kind == "gait" else ()
    return tuple(sorted({path.stem for path in found}))


def register(kind: str, name: str, thing: Maker, words: str = "") -> None:
    """Make a class or function of one's own known by a name, in this process.

    name: that by which scenarios refer to it. thing: the class or function. kind: "controller", "contact",
    "observer", "sensor", "touchdown", "disturbance", "plant", "curve", "robot" or "gait". words: for a list of
    names. Records of scenarios write it as `module:Class`, so that other processes find it. Raises InputError
    for an unknown kind, and for a name that is taken or reads as `module:Class`. A thing that does not fit its
    kind raises it only where a walker is built.

    >>> def soft_npd(reference):
    ...     return ba.NPDController(reference, ba.Gains(2500.0, 35.0))
    >>> ba.register("controller", "soft NPD", soft_npd)
    >>> ba.walk_scenario(ba.Scenario("soft NPD", run={"impacts": 2})).impacts
    2
    """
    if kind not in REGISTRY:
        raise InputError(f"there is no kind '{kind}' of things; choose one of {list(REGISTRY)}")
    check_part(name, f"the name of a {kind}", str)
    if not callable(thing):
        raise InputError(f"'{name}' is registered as {thing!r}, expected a class or a function")
    # _plain: a name as it is compared, in small letters and without hyphens
    if _plain(name) in map(_plain, names(kind)) or is_own(name) or not name.strip():
        raise InputError(f"{kind} '{name}' is taken or reads as module:Class; choose another name")
    home = f"{thing.__module__}:{getattr(thing, '__qualname__', name)}"
    REGISTRY[kind][name] = _Entry(home, words, thing=thing)


def portable(kind: str, name: str) -> str:
    """The name by which another process finds a part: its `module:Class` where `register` added it in this
    process alone, else the name itself.
    """
    entry = REGISTRY[kind].get(name)
    return entry.home if entry is not None and entry.thing is not None else name


def part_of_user(kind: str, name: str, values: Mapping[str, object], base: type[T]) -> T | None:
    """The robot or gait that the user's class or function of this name makes; None where a file has the name.

    values: arguments of that class or function, by name. base: class that the result has to be of. Raises
    InputError where it cannot be imported, lacks an argument, raises, or returns another class.
    """
    if is_own(name) or name in REGISTRY[kind]:
        return construct(f"{kind} '{name}'", find(kind, name).load(), values, base)
    return None


def is_own(name: str) -> bool:
    """True where a name has the form `package.module:Class`."""
    return _OWN.fullmatch(name) is not None


def find(kind: str, name: str) -> _Entry:
    """The entry of a name, whatever its capitals; a new one for `module:Class`.

    Raises InputError for an unknown name, with the known ones that are most alike.
    """
    # without an entry the name is `module:Class` itself, hence the new entry's home
    return REGISTRY[kind].get(known_name(kind, name)) or _Entry(name)


def known_name(kind: str, name: str) -> str:
    """The name as the registry spells it, whatever its capitals, hyphens and underscores.

    A package.module:Class, and the file of a robot or a gait, are unchanged. Raises InputError for an unknown
    name, with the known ones that are most alike.
    """
    if name in REGISTRY[kind]:
        return name
    known = next((x for x in names(kind) if _plain(x) == _plain(name)), name)
    if known in REGISTRY[kind] or is_own(known) or kind in ("robot", "gait"):
        return known
    raise InputError(f"{kind} '{name}': {unknown(name, names(kind))}; your own is module:Class")


def unit_in(kind: str, name: object, value: str, usual: str) -> str:
    """The unit of the value named `value` of the part `name`, as its entry says; `usual` if that says none."""
    entries = REGISTRY.get(kind, {}).items()
    stated = (entry.units for known, entry in entries if _plain(known) == _plain(str(name)))
    return next(stated, {}).get(value, usual)


@lru_cache(maxsize=1000)
def _plain(name: str) -> str:
    """A name as it is compared: small letters, spaces for hyphens and underscores."""
    return name.casefold().replace("-", " ").replace("_", " ").strip()


def top_of(home: str) -> str:
    """The part of `package.module:Class` before its first dot or colon, which lies in a folder of the path."""
    return home.partition(":")[0].partition(".")[0]


def _imported(home: str) -> Maker:
    """The class `module:Class`, from Python's path, the folder of its study file or the working directory.

    A folder that has the module is at the end of the path while it is imported, so that it cannot hide an
    installed module, and nothing else is ever imported from there. Whatever the user's module raises when it
    is imported becomes an InputError with the cause, as does a missing class.
    """
    (module, _, _), here = home.partition(":"), os.getcwd()
    with _IMPORTING:
        # keys of a dict, to have each folder once and in order; an imported module needs none
        places = {} if module in sys.modules else {FOLDERS.get(top_of(home), here): 0, here: 0}
        added = [x for x in places if x not in sys.path and PathFinder.find_spec(top_of(home), [x])]
        sys.path += added
        try:
            return resolve_name(home)
        except (Exception, SystemExit) as error:  # whatever a module of the user's may raise
            raise InputError(
                f"'{home}' cannot be imported, {type(error).__name__}: {error}; is it in '{here}' or installed?"
            ) from error
        finally:
            for x in added:
                sys.path.remove(x)


@lru_cache(maxsize=1024)
def takes(make: Maker) -> Mapping[str, Parameter]:
    """Name -> parameter of a class or function, but for *args and **kwargs.

    The latest results are kept, since each walk of a study asks for the same. Raises InputError for what has no
    signature, such as functions written in C.
    """
    try:
        result = signature(make).parameters
    except (TypeError, ValueError) as error:
        raise InputError(f"{error}; expected a class or a function written in Python") from error
    # *args and **kwargs, which name nothing
    variadic = Parameter.VAR_POSITIONAL, Parameter.VAR_KEYWORD
    return MappingProxyType({name: p for name, p in result.items() if p.kind not in variadic})


def lacking(make: Maker, values: Container[str]) -> list[str]:
    """Names of parameters of `make` that have no default and are not among the names `values`."""
    parameters = (p for p in takes(make).values() if p.default is Parameter.empty)
    return [p.name for p in parameters if p.name not in values]


def construct(
    what: str, make: Maker, values: Mapping[str, object], kind: type[T], place: str = ""
) -> T:
    """Call make with those values whose names are parameters of it, and return the result, which has to be an
    object of class `kind`.

    what: what is made, for messages, such as "controller 'NPD'"; place: the dotted name of its record in a
    scenario, for the message; "" for none. Raises InputError for values that are missing, an error inside of
    make, and a result of another class.
    """
    names, missing = takes(make), lacking(make, values)
    if missing:
        give = ", ".join(f"{place}.{name}".lstrip(".") for name in missing)
        raise InputError(f"{what} needs {', '.join(missing)}; give {give}")
    try:
        result = make(**{name: x for name, x in values.items() if name in names})
    except BipedError:
        raise
    except (Exception, SystemExit) as error:  # whatever a class of the user's may raise
        raise InputError(f"{what} could not be made: {type(error).__name__}: {error}") from error
    if not isinstance(result, kind):
        raise InputError(f"{what} made a {type(result).__name__}, expected a {kind.__name__}")
    return result
