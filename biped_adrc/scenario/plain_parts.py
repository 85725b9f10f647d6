"""A walker and its parts as plain values, for a file, and made again of them.

`Writer` turns an object into a record: its class as `module:Class` and the values that its constructor takes,
with inner objects in records of their own, each once, referred to by number. `Reader` makes the objects again.
Only classes of this package are imported when a record is read (`is_ours`), so that a file cannot run code of
its own: of a class of the user's the name alone is stored, and a stand-in takes the place of such a controller.

A part here is any such object. A class counts as ours if it is in one of the modules of this package that the
pattern `_ROOMS` names, those of controllers, observers, disturbances, gaits, hardware, robots, timing and the
walker; all others count as the user's. How values are written:

    None, bool, int, float, str   as they are
    array                         {"array": [...], "shape": [...], "dtype": "float64"}
    list, tuple, mapping          {"list": [...]}, {"tuple": [...]}, {"map": {...}}
    complex, path, enum           {"complex": [re, im]}, {"path": "..."}, {"enum": [module:Class, name]}
    any other object              {"part": number of its record in the list "parts"}
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.registry import takes

_ROOMS = re.compile(
    r"biped_adrc\.((control|observers|disturbances|gait|hardware|model(\.robots)?)\.[a-z_]+|core\.timing|closed_loop\.walker)"
)
"""Pattern of the names of those modules whose classes are imported when a record is read."""

PartRecord = dict[str, Any]
"""One object: `class` as module:Class, `values` that its constructor takes; without them it is the user's."""


class MissingPart(InputError):
    """An object cannot be made again, since its class, or that of an object inside it, is the user's."""

    def __init__(self, home: str) -> None:
        super().__init__(f"'{home}' is not of this package")
        self.home = home


def home_of(kind: Any) -> str:
    """Name of a class or function as `module:Class`, by which it can be imported again."""
    return f"{kind.__module__}:{kind.__qualname__}"


def is_ours(home: str) -> bool:
    """True where module:Class lies in a module of `_ROOMS`, and may be imported when a record is read."""
    return _ROOMS.fullmatch(home.partition(":")[0]) is not None


@dataclass
class Writer:
    """Turns objects into records; the inverse of `Reader`.

    An object that is used twice, such as the robot in walker and gait, is written once and is one object again
    after reading. Objects are dataclasses, NamedTuples, or classes that keep the arguments of their constructor
    as attributes of the same names.
    """

    records: list[PartRecord] = field(default_factory=list)
    """Records of the objects that were written, each once; other records name an object by its place here."""
    _known: dict[int, tuple[int, object]] = field(default_factory=dict)
    """id of an object -> its place, and the object itself, kept alive so that no other one gets its id."""

    def plain(self, x: object) -> object:
        """The value as JSON has it, in the form of the table in the head of this file."""
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
        """The place from 0 of an object's record in `records`; the first call for an object writes it there."""
        if id(x) not in self._known:
            # first the record, which may append records of inner objects; then its own place is known
            result = self._record(x)
            self._known[id(x)] = len(self.records), x
            self.records.append(result)
        return self._known[id(x)][0]

    def _record(self, x: Any) -> PartRecord:
        """The record of one object. It has the class alone for an object of the user's, and for one that does
        not keep all arguments of its constructor as attributes.
        """
        if hasattr(x, "__qualname__"):  # a class or a function itself
            return {"class": home_of(x)}
        home, names = home_of(type(x)), takes(x.__class__)  # names of the constructor's parameters
        if not is_ours(home) or not all(hasattr(x, name) for name in names):
            return {"class": home}
        return {"class": home, "values": {name: self.plain(getattr(x, name)) for name in names}}


@dataclass
class Reader:
    """Makes objects of records; the inverse of `Writer`."""

    records: list[PartRecord]
    """The records that a `Writer` left."""
    _objects: dict[int, object] = field(default_factory=dict)
    """Place of a record -> the object made of it, so that an object that is used twice is one again."""

    def value(self, x: object) -> Any:
        """The value that `Writer.plain` wrote as x: an array, list, tuple, mapping and so on by its one key,
        an object from its record, anything else as it is.

        Raises MissingPart for an object of the user's and what contains one, InputError for a class that this
        version of the package does not have, and what a class raises of values that it does not take.
        """
        match x:
            case {"part": int(i)}:
                if i not in self._objects:
                    home, values = self.records[i]["class"], self.records[i].get("values")
                    if values is None:
                        raise MissingPart(home)
                    inner = {name: self.value(y) for name, y in values.items()}
                    self._objects[i] = _class(home)(**inner)
                return self._objects[i]
            case {"array": values, "shape": shape, "dtype": kind}:
                return np.array(values, dtype=np.dtype(kind)).reshape(shape)
            case {"map": values}:
                return {key: self.value(inner) for key, inner in values.items()}
            case {"list": values}:
                return [self.value(inner) for inner in values]
            case {"tuple": values}:
                return tuple(self.value(inner) for inner in values)
            case {"enum": (home, name)}:
                return _class(home)[name]
            case {"complex": (real, imaginary)}:
                return complex(real, imaginary)
            case {"path": path}:
                return Path(path)
        return x


def _class(home: str) -> Any:
    """A class of this package by module:Class. Raises InputError where this version does not have it."""
    module, _, name = home.partition(":")
    # nothing else is imported, since an import runs code; and below, a class that the module itself has only
    # imported from elsewhere is refused
    result = getattr(import_module(module), name, None) if is_ours(home) else None
    if not isinstance(result, type) or result.__module__ != module:
        raise InputError(f"there is no class '{home}' in this version of the package")
    return result
