"""A walker as plain values that JSON holds, and a walker made again of them.

`Writer` turns an object into a record: its class as `module:Class` and the values that its constructor takes,
with inner objects in records of their own, each once, referred to by number. `Reader` makes the objects again.

Only classes of this package are imported when a record is read (`is_ours`), so that a file cannot run code of
its own. A class of the user's is stored by name, values and a hash of its source, and becomes a `MissingPart`
unless the user hands it over. `stored` uses both to write walks that can be read without the files they were
made from.

How values are written:

    None, bool, int, float, str   as they are
    array                         {"array": [...], "shape": [...], "dtype": "float64"}
    list, tuple, mapping          {"list": [...]}, {"tuple": [...]}, {"map": {...}}
    complex, path, enum           {"complex": [re, im]}, {"path": "..."}, {"enum": [module:Class, name]}
    any other object              {"part": place}, a `PartRecord` in the list of records
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from enum import Enum
from importlib import import_module
from pathlib import Path
from typing import Any, NotRequired, TypedDict

import numpy as np

from biped_adrc.errors import BipedError, InputError
from biped_adrc.scenario.registry import registered, source_hash, takes

_ROOMS = re.compile(
    r"biped_adrc\.((control|observers|disturbances|gait|hardware|model|robots)\.[a-z_]+|timing|ground|closed_loop\.walker)"
)
"""Modules whose classes are made when a record is read."""

PartRecord = TypedDict(
    "PartRecord", {"class": str, "values": dict[str, object], "source": NotRequired[str]}
)
"""One object: its class as module:Class, what its constructor takes, and for the user's own a hash of its
source."""


@dataclass(frozen=True, eq=False)
class MissingPart:
    """In place of an object whose class, or that of an object inside of it, is the user's and not at hand."""

    home: str
    """Its class, module:Class."""
    values: Mapping[str, object]
    """What its constructor takes, made as far as possible."""
    source: str | None
    """Hash of its source; None for a class of the package that has something of the user's inside."""

    @property
    def wanted(self) -> list[str]:
        """The user's classes that are missing in it, module:Class."""
        inner = [home for part in _missing(self.values) for home in part.wanted]
        return ([] if self.source is None else [self.home]) + inner

    @property
    def why(self) -> str:
        """End of an error message: what is missing, and what to do."""
        return (
            f"{' and '.join(map(repr, self.wanted))} not of this package; give it, as in load_walk(path, "
            "controller=Class) for the class of any one part, or ba.register it first"
        )


def _missing(x: object) -> list[MissingPart]:
    """All missing parts in a value, also inside lists and mappings."""
    if isinstance(x, MissingPart):
        return [x]
    inner = x.values() if isinstance(x, Mapping) else x if isinstance(x, list | tuple) else ()
    return [part for value in inner for part in _missing(value)]


def home_of(kind: Any) -> str:
    """A class or function as `module:Class`."""
    return f"{kind.__module__}:{kind.__qualname__}"


def is_ours(home: str) -> bool:
    """True where module:Class is of this package, and may be imported when a record is read."""
    return _ROOMS.fullmatch(home.partition(":")[0]) is not None


@dataclass
class Writer:
    """Turns objects into records; the inverse of `Reader`.

    An object that is used twice, such as the robot in walker and gait, is written once and is one object again
    after reading. Objects are dataclasses, NamedTuples, or classes that keep the arguments of their constructor
    as attributes of the same names.
    """

    records: list[PartRecord] = field(default_factory=list)
    """Of all objects seen, each once; an object is referred to by its place here."""
    own: list[str] = field(default_factory=list)
    """Classes of the user's among them, module:Class."""
    _known: dict[int, tuple[int, object]] = field(default_factory=dict)
    """By id of an object its place, and the object itself, so that its id is not used again."""

    def plain(self, x: object) -> object:
        """The value as JSON has it; {kind: ...} for arrays, tuples, enums and paths, {"part": place} for
        objects.
        """
        if x is None or (isinstance(x, bool | int | float | str) and not isinstance(x, Enum)):
            return x
        if isinstance(x, np.generic):
            return self.plain(x.item())
        if isinstance(x, complex):
            return {"complex": [x.real, x.imag]}
        if isinstance(x, Enum):
            return {"enum": [home_of(type(x)), x.name]}
        if isinstance(x, Path):
            return {"path": str(x)}
        if isinstance(x, np.ndarray):
            return {"array": x.ravel().tolist(), "shape": list(x.shape), "dtype": str(x.dtype)}
        if isinstance(x, Mapping):
            return {"map": {str(key): self.plain(inner) for key, inner in x.items()}}
        if isinstance(x, list | tuple) and not hasattr(x, "_fields"):
            return {type(x).__name__: [self.plain(inner) for inner in x]}
        return {"part": self.part(x)}

    def part(self, x: object) -> int:
        """The place of an object among the records, written the first time it is seen."""
        if id(x) not in self._known:
            made = self._record(x)
            self._known[id(x)] = len(self.records), x
            self.records.append(made)
        return self._known[id(x)][0]

    def _record(self, x: object) -> PartRecord:
        """The record of one object; with a hash of its source where it is not wholly the package's."""
        if isinstance(x, MissingPart):
            return self._carried(x)
        kind = type(x)
        home = home_of(kind)
        values = {name: self.plain(getattr(x, name)) for name in _names(x) if hasattr(x, name)}
        if is_ours(home) and values.keys() >= set(_names(x)):
            return {"class": home, "values": values}
        home = home_of(x) if hasattr(x, "__qualname__") else home
        self.own.append(home)
        return {"class": home, "values": values, "source": source_hash(kind)}

    def _carried(self, x: MissingPart) -> PartRecord:
        """The record that a missing part was read from: a walk can be stored again without its class."""
        record: PartRecord = {
            "class": x.home,
            "values": {k: self.plain(y) for k, y in x.values.items()},
        }
        if x.source is not None:
            self.own.append(x.home)
            record["source"] = x.source
        return record


def _names(x: Any) -> list[str]:
    """Names of what the constructor of an object takes; none for a class or a function itself."""
    if is_dataclass(x):
        return [f.name for f in fields(x) if f.init]
    return [] if hasattr(x, "__qualname__") else list(takes(type(x)))


@dataclass
class Reader:
    """Makes objects of records; the inverse of `Writer`.

    A part whose class is missing does not stop the others: what contains it becomes a
    `MissingPart` too, and the rest is made. `whole` is for parts that must not be missing.
    """

    records: list[PartRecord]
    given: Mapping[str, object]
    """Classes or objects that the user hands over, by module:Class."""
    changed: list[str] = field(default_factory=list)
    """The user's classes whose source has changed since they were stored."""
    _made: dict[int, object] = field(default_factory=dict)

    def made(self, x: object) -> object:
        """The value that `Writer.plain` was given; a `MissingPart` for what is not at hand.

        Raises InputError for a class that this version of the package does not have, and for values that a
        class does not take.
        """
        if not isinstance(x, dict):
            return x
        kind = next(iter(x))
        if kind == "part":
            return self._part(int(x["part"]))
        if kind == "array":
            return np.array(x["array"], dtype=np.dtype(x["dtype"])).reshape(x["shape"])
        if kind == "map":
            return {key: self.made(inner) for key, inner in x["map"].items()}
        if kind in ("list", "tuple"):
            made = [self.made(inner) for inner in x[kind]]
            return made if kind == "list" else tuple(made)
        if kind == "enum":
            return _class(x["enum"][0])[x["enum"][1]]
        return complex(*x["complex"]) if kind == "complex" else Path(x["path"])

    def whole(self, x: object) -> Any:
        """As `made`, of whatever class was stored. Raises InputError where something is missing."""
        made = self.made(x)
        for part in _missing(made):
            raise InputError(part.why)
        return made

    def _part(self, i: int) -> object:
        """The object of a record, made the first time it is asked for."""
        if i not in self._made:
            self._made[i] = self._new(self.records[i])
        return self._made[i]

    def _new(self, record: PartRecord) -> object:
        """The object of a record; an object that the user handed over takes its place as it is."""
        home = record["class"]
        own = "source" in record or not is_ours(home)
        kind: object = self._own(home, record["source"]) if own else _class(home)
        if not (kind is None or isinstance(kind, type)):
            return kind
        values = {name: self.made(x) for name, x in record["values"].items()}
        if kind is None or _missing(values):
            return MissingPart(home, values, record.get("source"))
        try:
            return kind(**values)
        except BipedError:
            raise
        except (Exception, SystemExit) as error:  # whatever a class of the user's may raise
            raise InputError(
                f"'{home}' cannot be made of {sorted(values)}: {error}; give an object of it, as in "
                "load_walk(path, controller=object)"
            ) from error

    def _own(self, home: str, source: str) -> object:
        """The user's class or object, handed over or registered; None where it is not at hand.

        source: hash of the source it was stored with.
        """
        found = self.given.get(home) or registered(home)
        kind = found if isinstance(found, type) else type(found)
        if found is not None and source_hash(kind) != source:
            self.changed.append(home)
        return found


def _class(home: str) -> Any:
    """A class of this package by module:Class. Raises InputError where this version does not have it."""
    module, _, name = home.partition(":")
    found = getattr(import_module(module), name, None) if is_ours(home) else None
    if not isinstance(found, type) or found.__module__ != module:
        raise InputError(f"there is no class '{home}' in this version of the package")
    return found
