"""A walker in plain values: dataclasses of the package by class and fields, and made again of them.

A class of the user's own is told by module:Class, the values that its constructor takes, and a hash of its
source; nothing of it is imported when a record is read.
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
from biped_adrc.scenario.registry import registered, source_hash, takes

_ROOMS = re.compile(
    r"biped_adrc\.((control|observers|disturbances|gait|hardware|model|robots)\.[a-z_]+|timing|ground|closed_loop\.walker)"
)
"""Modules whose classes are made when a record is read."""


@dataclass(frozen=True, eq=False)
class Missing:
    """A part that waits for a class of the user's own: its record, with what in it could be made."""

    home: str
    values: Mapping[str, Any]
    source: str | None
    """None for a part of the package that has something of the user's own inside."""

    @property
    def wanted(self) -> list[str]:
        """Classes of the user's own in it, module:Class."""
        inner = [home for part in _missing(self.values) for home in part.wanted]
        return ([] if self.source is None else [self.home]) + inner

    @property
    def why(self) -> str:
        """For a reader: what is missing, and what to do."""
        return (
            f"{' and '.join(map(repr, self.wanted))} not of this package; give it, as in load_walk(path, "
            "controller=Class) for the class of any one part, or ba.register it first"
        )


def _missing(x: Any) -> list[Missing]:
    """What is missing in values, in lists and mappings of them too."""
    if isinstance(x, Missing):
        return [x]
    inner = x.values() if isinstance(x, Mapping) else x if isinstance(x, list | tuple) else ()
    return [part for value in inner for part in _missing(value)]


def home_of(kind: type[Any]) -> str:
    """module:Class."""
    return f"{kind.__module__}:{kind.__qualname__}"


def is_ours(home: str) -> bool:
    """Whether a class is of the package."""
    return _ROOMS.fullmatch(home.partition(":")[0]) is not None


@dataclass
class Writer:
    """`records`: of all objects, each once; `own`: what is the user's own."""

    records: list[dict[str, Any]] = field(default_factory=list)
    own: list[str] = field(default_factory=list)
    _known: dict[int, tuple[int, Any]] = field(default_factory=dict)

    def plain(self, x: Any) -> Any:
        """Values that JSON has, with {kind: ..} for what it has not."""
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
        return {"part": self._part(x)}

    def _part(self, x: Any) -> int:
        if id(x) not in self._known:
            made = self._record(x)
            self._known[id(x)] = len(self.records), x
            self.records.append(made)
        return self._known[id(x)][0]

    def _record(self, x: Any) -> dict[str, Any]:
        if isinstance(x, Missing):
            return self._carried(x)
        kind = type(x)
        home = home_of(kind)
        values = {name: self.plain(getattr(x, name)) for name in _names(x) if hasattr(x, name)}
        if is_ours(home) and values.keys() >= set(_names(x)):
            return {"class": home, "values": values}
        home = home_of(x) if hasattr(x, "__qualname__") else home
        self.own.append(home)
        return {"class": home, "values": values, "source": source_hash(kind)}

    def _carried(self, x: Missing) -> dict[str, Any]:
        """The record that a missing part was read from."""
        record = {"class": x.home, "values": {k: self.plain(y) for k, y in x.values.items()}}
        if x.source is None:
            return record
        self.own.append(x.home)
        return {**record, "source": x.source}


def _names(x: Any) -> list[str]:
    """What the constructor takes."""
    if is_dataclass(x):
        return [f.name for f in fields(x) if f.init]
    if hasattr(x, "_fields"):
        return list(x._fields)
    return [] if hasattr(x, "__qualname__") else list(takes(type(x)))


@dataclass
class Reader:
    """Makes objects of `records`; given: classes or objects of the user's own by module:Class."""

    records: list[dict[str, Any]]
    given: Mapping[str, Any]
    changed: list[str] = field(default_factory=list)
    """Of the user's own, what has another source than when it was stored."""
    _made: dict[int, Any] = field(default_factory=dict)

    def made(self, x: Any) -> Any:
        """The inverse of `Writer.plain`; a `Missing` for what is not given. Raises InputError."""
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

    def whole(self, x: Any) -> Any:
        """As `made`. Raises InputError where something is missing."""
        made = self.made(x)
        for part in _missing(made):
            raise InputError(part.why)
        return made

    def _part(self, i: int) -> Any:
        if i not in self._made:
            self._made[i] = self._new(self.records[i])
        return self._made[i]

    def _new(self, record: Mapping[str, Any]) -> Any:
        home = record["class"]
        own = "source" in record or not is_ours(home)
        kind = self._own(home, record["source"]) if own else _class(home)
        if not (kind is None or isinstance(kind, type)):
            return kind
        values = {name: self.made(x) for name, x in record["values"].items()}
        if kind is None or _missing(values):
            return Missing(home, values, record.get("source"))
        try:
            return kind(**values)
        except BipedError:
            raise
        except (Exception, SystemExit) as error:  # whatever a class of the user's may raise
            raise InputError(
                f"'{home}' cannot be made of {sorted(values)}: {error}; give an object of it, as in "
                "load_walk(path, controller=object)"
            ) from error

    def _own(self, home: str, source: str) -> Any:
        """The user's own class or object; None where it is not there."""
        found = self.given.get(home) or registered(home)
        kind = found if isinstance(found, type) else type(found)
        if found is not None and source_hash(kind) != source:
            self.changed.append(home)
        return found


def _class(home: str) -> Any:
    """Of the package. Raises InputError."""
    module, _, name = home.partition(":")
    found = getattr(import_module(module), name, None) if is_ours(home) else None
    if not isinstance(found, type) or found.__module__ != module:
        raise InputError(f"there is no class '{home}' in this version of the package")
    return found
