"""A walker as plain values that JSON holds, and a walker made again of them.

`Writer` turns an object into a record: its class as `module:Class` and the values that its constructor takes,
with inner objects in records of their own, each once, referred to by number. `Reader` makes the objects again.

Only classes of this package are imported when a record is read (`is_ours`), so that a file cannot run code of
its own. A class of the user's is stored by name, and becomes a `MissingPart`. `stored` uses both to write walks
that can be read without the files they were made from.

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
from typing import Any

import numpy as np

from biped_adrc.errors import BipedError, InputError
from biped_adrc.scenario.registry import takes

_ROOMS = re.compile(
    r"biped_adrc\.((control|observers|disturbances|gait|hardware|model(\.robots)?)\.[a-z_]+|timing|closed_loop\.walker)"
)
"""Modules whose classes are made when a record is read."""

PartRecord = dict[str, Any]
"""One object: `class` as module:Class, `values` that its constructor takes; without them it is the user's."""


@dataclass(frozen=True, eq=False)
class MissingPart:
    """In place of an object whose class, or that of an object inside of it, is the user's."""

    home: str
    """The user's class, module:Class."""


def _missing(x: object) -> MissingPart | None:
    """A missing part in a value, also inside lists and mappings."""
    if isinstance(x, MissingPart):
        return x
    inner = x.values() if isinstance(x, Mapping) else x if isinstance(x, list | tuple) else ()
    return next((found for value in inner if (found := _missing(value))), None)


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
        """The record of one object; of one that is the user's its class alone."""
        home = x.home if isinstance(x, MissingPart) else home_of(type(x))
        values = {name: self.plain(getattr(x, name)) for name in _names(x) if hasattr(x, name)}
        if is_ours(home) and values.keys() >= set(_names(x)):
            return {"class": home, "values": values}
        return {"class": home_of(x) if hasattr(x, "__qualname__") else home}


def _names(x: Any) -> list[str]:
    """Names of what the constructor of an object takes; none for a class or a function itself."""
    if is_dataclass(x):
        return [f.name for f in fields(x) if f.init]
    return [] if hasattr(x, "__qualname__") else list(takes(type(x)))


@dataclass
class Reader:
    """Makes objects of records; the inverse of `Writer`. What contains a part of the user's is missing too."""

    records: list[PartRecord]
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
        if missing := _missing(made):
            raise InputError(f"'{missing.home}' is not of this package")
        return made

    def _part(self, i: int) -> object:
        """The object of a record, made the first time it is asked for."""
        if i not in self._made:
            self._made[i] = self._new(self.records[i])
        return self._made[i]

    def _new(self, record: PartRecord) -> object:
        """The object of a record. Raises InputError for values that its class does not take."""
        home = record["class"]
        if "values" not in record:
            return MissingPart(home)
        kind = _class(home)
        values = {name: self.made(x) for name, x in record["values"].items()}
        if missing := _missing(values):
            return missing
        try:
            return kind(**values)
        except BipedError:
            raise
        except Exception as error:
            raise InputError(f"'{home}' cannot be made of {sorted(values)}: {error}") from error


def _class(home: str) -> Any:
    """A class of this package by module:Class. Raises InputError where this version does not have it."""
    module, _, name = home.partition(":")
    found = getattr(import_module(module), name, None) if is_ours(home) else None
    if not isinstance(found, type) or found.__module__ != module:
        raise InputError(f"there is no class '{home}' in this version of the package")
    return found
