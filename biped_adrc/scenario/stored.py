"""Walks on disk, complete in themselves: scenario, states, signals, walker and gait in one .npz file.

Robot and gait are in the file as they were, so that neither the working directory nor later changes of their
files matter.

Entries of the file, beside the trajectory that `hybrid.storage` writes:

    walker      JSON: {"parts": records of all objects, "walker": number of the walker's record in this list,
                from 0, "gait": the gait as `plain_parts` writes a value}
    signal.*    the arrays of `analysis.signals.Signals` (torques, errors ..), one row for each stored time
    settings    versions, the scenario's record, remarks (sentences on what was not as asked for), names of the
                states, and what the caller adds

A class of the user's is not imported again. A stand-in takes the place of such a controller or disturbance: the
walk can be looked at, but it cannot go on. A part is an object such as a controller; its record is its class
and the values of its constructor. An arc of a trajectory is the motion of one single support.
"""

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import reading
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.hybrid import storage
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.plain_parts import MissingPart, PartRecord, Reader
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
    """Message where a walk would need the user's class `home` (module:Class), for which a stand-in stands."""
    return f"a stored walk cannot go on without '{home}'; walk it again with walk_scenario(walk.scenario)"


_OF_TWO = ("ground_reaction", "outside", "momentum", "swing_foot", "hip")
OF_COORDINATES, OF_JOINTS = ("q", "v", "a", "zeta"), ("q_d", "dq_d", "error", "u", "zeta_estimate")
"""Signals with two columns (x and z), with one for each of n coordinates, and with one for each of p joints, as
all that begin with xi; each other signal has one number in a row."""
STAND_INS = {"controller": AbsentController, "disturbance": AbsentDisturbance}
"""Fields of a walker in which a stand-in replaces a part of the user's; in other fields such a part is left
out."""


def load_walk(path: Path | str) -> Walk:
    """The walk in a run file (.npz) written by `Walk.save`, or by the commands `simulate` and `reproduce`.

    path: of the file. No class of the user's is imported: signals, figures and pictures are those of the file,
    and the walk of a controller of the user's is walked again with `walk_scenario(walk.scenario)`. Raises
    InputError.

    >>> walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, impacts=2)
    >>> ba.load_walk(walk.save(folder / "walk.npz")).impacts
    2
    """
    # a file has modes as numbers: the single support's number as a float, and its start [s]
    trajectory = storage.load(path, lambda step, start: Mode(int(step), start))
    beside = storage.load_beside(path)  # the entries that are not the trajectory's own
    # an error inside becomes an InputError that names the file
    with reading("run", path, InputError):
        if "walker" not in beside:
            raise InputError("it names no walker, as runs of Walk.save, simulate and reproduce do")
        record = json.loads(str(beside["walker"]))
        reader = Reader(record["parts"])
        walker = _walker(reader, record["parts"][record["walker"]])
        names = [k for k in beside if k.startswith("signal.")]
        arrays = {k.removeprefix("signal."): beside[k] for k in names}
        remarks = tuple(map(str, trajectory.settings.get("remarks", ())))
        gait, scenario = reader.value(record["gait"]), None
        # no scenario, or one that names files or classes which are not at hand: the walk has none then
        with suppress(KeyError, TypeError, InputError):
            scenario = _scenario(trajectory.settings)
        signals = _signals(arrays, walker, trajectory)
        return Walk(walker, gait, trajectory, scenario, signals, remarks)


def _scenario(settings: Mapping[str, Any]) -> Scenario:
    """The scenario of a file. Files without names of the states are older than relative errors of bodies: the
    factor 1.2 in them is the error 0.2 now.
    """
    record = dict(settings["scenario"])
    if "states" not in settings and "errors" in record:
        by_body = {k: x for k, x in record["errors"].items() if isinstance(x, dict)}
        errors = {k: {name: x - 1.0 for name, x in by.items()} for k, by in by_body.items()}
        record["errors"] = record["errors"] | errors
    return Scenario(**record)


def _signals(arrays: Mapping[str, Array], walker: Walker, trajectory: Trajectory) -> Signals:
    """The signals of a file, from its arrays by name, one row for each stored time of the trajectory. Raises
    ValueError for an array that does not fit the walk.
    """
    rows, plant = sum(len(arc.t) for arc in trajectory.arcs), walker.plant
    # wide: name of a signal -> number of its columns; a signal that is not in it has one number per row
    # signals with columns x and z, with one per coordinate, with one per joint
    wide = dict.fromkeys(_OF_TWO, 2) | dict.fromkeys(OF_COORDINATES, plant.n)
    estimates = [name for name in arrays if name.startswith("xi")]
    wide |= dict.fromkeys((*OF_JOINTS, *estimates), plant.p)
    for name, x in arrays.items():
        shape = (rows, wide[name]) if name in wide else (rows,)
        if x.dtype.kind not in "fi" or x.shape != shape:  # floats or integers
            raise ValueError(f"signal {name} is {x.dtype}{x.shape}, expected numbers {shape}")
    return Signals(**arrays)


def _walker(reader: Reader, record: PartRecord) -> Walker:
    """The walker of a record, with a stand-in for a controller or a disturbance of the user's; other parts of
    the user's are left out, so that the walker has its default for them.
    """
    values = dict[str, Any]()
    for name, x in record["values"].items():
        try:
            values[name] = reader.value(x)
        except MissingPart as missing:  # its class is the user's
            if name in STAND_INS:
                values[name] = STAND_INS[name](missing.home)
    return Walker(**values)


def rebuilt_walk(s: Scenario, trajectory: Trajectory) -> Walk:
    """The walk of a trajectory that another process simulated: its walker is built again from the scenario."""
    scene = RobotAndGait.of(s)
    return Walk(build(s, scene), scene.gait, trajectory, s)


def load_walks(paths: Sequence[Path]) -> dict[str, Walk]:
    """The walks in run files, by the name of the controller; if names repeat, by controller and file."""
    walks = [load_walk(path) for path in paths]
    names = [walk.controller_name for walk in walks]
    if len(set(names)) < len(names):
        names = [f"{name} ({path})" for name, path in zip(names, paths, strict=True)]
    return dict(zip(names, walks, strict=True))
