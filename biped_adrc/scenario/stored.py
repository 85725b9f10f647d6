"""Walks on disk, complete in themselves: scenario, states, signals, walker and gait in one .npz file.

Robot and gait are in the file as they were, so that neither the working directory nor later changes of their
files matter.

Entries of the file, beside the trajectory that `hybrid.storage` writes:

    walker      JSON: {"parts": records of all objects, "walker": number of the walker's record in this list,
                from 0, "gait": the gait as a value, see below}
    signal.*    the arrays of `analysis.signals.Signals`, one row for each stored time
    settings    versions, the scenario's record, remarks, and what the caller adds

`Writer` turns an object into a record: its class as `module:Class` and the values that its constructor takes,
with inner objects in records of their own, each once, referred to by number. `Reader` makes the objects again.
Only classes of this package are imported when a record is read (`is_ours`), so that a file cannot run code of
its own: of a class of the user's the name alone is stored, and a stand-in takes the place of such a controller.

How values are written:

    None, bool, int, float, str   as they are
    array                         {"array": [...], "shape": [...], "dtype": "float64"}
    list, tuple, mapping          {"list": [...]}, {"tuple": [...]}, {"map": {...}}
    complex, path, enum           {"complex": [re, im]}, {"path": "..."}, {"enum": [module:Class, name]}
    any other object              {"part": number of its record in the list "parts"}
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from enum import Enum
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.errors import InputError
from biped_adrc.core.registry import takes
from biped_adrc.core.types import Array
from biped_adrc.core.versions import versions
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.hybrid import storage
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.scenario import Scenario


@dataclass(frozen=True)
class AbsentController(Controller):
    """Stand-in for the controller of a stored walk that is the user's. Raises InputError when called."""

    home: str
    """Its class, module:Class."""

    def output(self, s: Array, m: Measurement) -> Array:
        raise InputError(_again(self.home))


@dataclass(frozen=True)
class AbsentDisturbance(Disturbance):
    """Stand-in for a disturbance that is the user's. Raises InputError when called."""

    home: str
    """Its class, module:Class."""

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        raise InputError(_again(self.home))


def _again(home: str) -> str:
    return f"a stored walk cannot go on without '{home}'; walk it again with walk_scenario(walk.scenario)"


OF_TWO = ("ground_reaction", "outside", "momentum", "swing_foot", "hip")
OF_COORDINATES, OF_JOINTS = ("q", "v", "a", "zeta"), ("q_d", "dq_d", "error", "u", "zeta_estimate")
"""Signals with a column for each direction, coordinate and joint, as xi has; others are one number in a row."""
STAND_INS = {"controller": AbsentController, "disturbance": AbsentDisturbance}
"""Fields of a walker in which a part of the user's is replaced; other ones are left out."""


def save_walk(walk: Walk, path: Path | str, settings: Mapping[str, object] | None = None) -> Path:
    """Write a walk (.npz) that `load_walk` reads anywhere; returns its path.

    settings: more plain values to be stored beside it. Raises InputError and OutputError.
    """
    writer = Writer()
    walker, gait = writer.part(walk.walker), writer.plain(walk.gait)
    record = {"parts": writer.records, "walker": walker, "gait": gait}
    about: dict[str, object] = {"versions": versions(), "remarks": list(walk.remarks)}
    if walk.scenario is not None:
        about["scenario"] = walk.scenario.record()
    arrays: dict[str, ArrayLike] = {"walker": json.dumps(record)}
    arrays |= {f"signal.{k}": x for k, x in vars(walk.signals).items()}
    return storage.save(walk.trajectory, path, {**about, **(settings or {})}, arrays)


def load_walk(path: Path | str) -> Walk:
    """The walk in a run file (.npz) written by `Walk.save`, `simulate` or `reproduce`.

    Nothing of the user's is imported: signals, figures and pictures are those of the file, and a walk of an own
    controller is walked again with `walk_scenario(walk.scenario)`. Raises InputError.

    >>> walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, impacts=2)
    >>> ba.load_walk(walk.save(folder / "walk.npz")).impacts
    2
    """
    trajectory = storage.load(path, lambda step, start: Mode(int(step), start))
    beside = storage.load_beside(path)
    with storage.reading_run(path):
        if "walker" not in beside:
            raise InputError(
                "it does not say which robot, gait and controller it is of; runs written by Walk.save, "
                "'biped-adrc simulate' and 'reproduce' do"
            )
        record = json.loads(str(beside["walker"]))
        reader = Reader(record["parts"])
        walker = _walker(reader, record["parts"][record["walker"]])
        names = [k for k in beside if k.startswith("signal.")]
        arrays = {k.removeprefix("signal."): beside[k] for k in names}
        remarks = tuple(map(str, trajectory.settings.get("remarks", ())))
        gait, scenario = reader.made(record["gait"]), None
        with suppress(KeyError, TypeError, InputError):  # none, or it names what is not at hand
            scenario = Scenario(**trajectory.settings["scenario"])
        signals = _signals(arrays, walker, trajectory)
        return Walk(walker, gait, trajectory, scenario, signals, remarks)


def _signals(arrays: Mapping[str, Array], walker: Walker, trajectory: Trajectory) -> Signals:
    """The signals of a file. Raises ValueError for an array that is none of this walk."""
    rows, plant = sum(len(arc.t) for arc in trajectory.arcs), walker.plant
    wide = dict.fromkeys(OF_TWO, 2) | dict.fromkeys(OF_COORDINATES, plant.n)
    estimates = [name for name in arrays if name.startswith("xi")]
    wide |= dict.fromkeys((*OF_JOINTS, *estimates), plant.p)
    for name, x in arrays.items():
        shape = (rows, wide[name]) if name in wide else (rows,)
        if x.dtype.kind not in "fi" or x.shape != shape:
            raise ValueError(f"signal {name} is {x.dtype}{x.shape}, expected numbers {shape}")
    return Signals(**arrays)


def _walker(reader: Reader, record: PartRecord) -> Walker:
    """The walker of a record, with a stand-in for a controller or a disturbance of the user's."""
    values = dict[str, Any]()
    for name, x in record["values"].items():
        try:
            values[name] = reader.made(x)
        except MissingPart as missing:
            if name in STAND_INS:
                values[name] = STAND_INS[name](missing.home)
    return Walker(**values)


def replay(s: Scenario, trajectory: Trajectory) -> Walk:
    """The walk of a trajectory that another process simulated: its walker is built again from the scenario."""
    scene = RobotAndGait.of(s)
    return Walk(build(s, scene), scene.gait, trajectory, s)


def load_walks(paths: Sequence[Path]) -> dict[str, Walk]:
    """The walks in run files, by the name of the controller, with that of the file where names repeat."""
    walks = [load_walk(path) for path in paths]
    names = [walk.controller_name for walk in walks]
    if len(set(names)) < len(names):
        names = [f"{name} ({path})" for name, path in zip(names, paths, strict=True)]
    return dict(zip(names, walks, strict=True))


# -- objects as plain values ----------------------------------------------------------------------
_ROOMS = re.compile(
    r"biped_adrc\.((control|observers|disturbances|gait|hardware|model(\.robots)?)\.[a-z_]+|core\.timing|closed_loop\.walker)"
)
"""Modules whose classes are made when a record is read."""

PartRecord = dict[str, Any]
"""One object: `class` as module:Class, `values` that its constructor takes; without them it is the user's."""


class MissingPart(InputError):
    """An object whose class, or that of an object inside of it, is the user's."""

    def __init__(self, home: str) -> None:
        super().__init__(f"'{home}' is not of this package")
        self.home = home


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

    def _record(self, x: Any) -> PartRecord:
        """The record of one object; of one that is the user's its class alone."""
        if hasattr(x, "__qualname__"):  # a class or a function itself
            return {"class": home_of(x)}
        home, names = home_of(type(x)), takes(x.__class__)
        if not is_ours(home) or not all(hasattr(x, name) for name in names):
            return {"class": home}
        return {"class": home, "values": {name: self.plain(getattr(x, name)) for name in names}}


@dataclass
class Reader:
    """Makes objects of records; the inverse of `Writer`."""

    records: list[PartRecord]
    _made: dict[int, object] = field(default_factory=dict)

    def made(self, x: object) -> Any:
        """The value that `Writer.plain` was given.

        Raises MissingPart for an object of the user's and what contains one, InputError for a class that this
        version of the package does not have, and what a class raises of values that it does not take.
        """
        match x:
            case {"part": int(i)}:
                if i not in self._made:
                    home, values = self.records[i]["class"], self.records[i].get("values")
                    if values is None:
                        raise MissingPart(home)
                    inner = {name: self.made(y) for name, y in values.items()}
                    self._made[i] = _class(home)(**inner)
                return self._made[i]
            case {"array": values, "shape": shape, "dtype": kind}:
                return np.array(values, dtype=np.dtype(kind)).reshape(shape)
            case {"map": values}:
                return {key: self.made(inner) for key, inner in values.items()}
            case {"list": values}:
                return [self.made(inner) for inner in values]
            case {"tuple": values}:
                return tuple(self.made(inner) for inner in values)
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
    result = getattr(import_module(module), name, None) if is_ours(home) else None
    if not isinstance(result, type) or result.__module__ != module:
        raise InputError(f"there is no class '{home}' in this version of the package")
    return result
