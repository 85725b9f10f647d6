"""Walks on disk, complete in themselves: scenario, states, signals, walker and gait in one .npz file.

Robot and gait are in the file as they were, so that neither the working directory nor later changes of their
files matter. Reading a file imports no code of the user: a stand-in takes the place of a controller that is not
at hand. A stored walk is checked before it is handed over (`_check`), so that damage is noticed on reading.

Entries of the file, beside the trajectory that `hybrid.storage` writes:

    walker      JSON: {"parts": records of all objects, "walker": place of the walker, "gait": the gait}
    signal.*    arrays over the nodes
    settings    versions, the scenario's record, remarks, and what the caller adds
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import NoneType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.feet import NAMES
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.core.versions import versions
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid import storage
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.recording import Walk, recorded_walk
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walker_record import MissingPart, PartRecord, Reader, Writer


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
        result = _stored(trajectory, beside)
        _check(result)
    return result


def _stored(trajectory: Trajectory, beside: Mapping[str, Array]) -> Walk:
    """The walk of a trajectory, from the record of its walker and the signals beside it in the file."""
    record = json.loads(str(beside["walker"]))
    reader = Reader(record["parts"])
    walker = _walker(reader, record["parts"][record["walker"]])
    columns = {k.removeprefix("signal."): x for k, x in beside.items() if k.startswith("signal.")}
    made = recorded_walk(walker, reader.made(record["gait"]), trajectory, _scenario(trajectory))
    remarks = tuple(map(str, trajectory.settings.get("remarks", ())))
    return replace(made, recorded=Signals(**columns), stored_remarks=remarks)


def _check(walk: Walk) -> None:
    """Raise ValueError where gait, states, signals or readings of a file do not fit the walker."""
    arcs, plant, signals = walk.trajectory.arcs, walk.walker.plant, vars(walk.signals)
    t = np.concatenate([arc.t for arc in arcs])
    of_feet = {**dict.fromkeys(NAMES, 4), "u": plant.p, "zeta": plant.n}
    soft = any(set(NAMES) & set(arc.read) for arc in arcs)
    readings = [
        (arc.read.get(x), len(arc.t), n) for arc in arcs if soft for x, n in of_feet.items()
    ]
    fits = {
        "gait": isinstance(walk.gait, Gait if plant.p else NoneType),
        "signals": {len(x) for x in signals.values()} == {len(t)}
        and np.array_equal(signals["t"], t),
        "states": all(arc.x.shape[1] >= 2 * plant.n for arc in arcs),
        "readings": all(
            x is not None and x.shape == (k, n) and np.isfinite(x).all() for x, k, n in readings
        ),
    }
    if wrong := [name for name, fit in fits.items() if not fit]:
        raise ValueError(f"its {' and '.join(wrong)} do not fit its walker")


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


def _scenario(trajectory: Trajectory) -> Scenario | None:
    """The scenario stored with a trajectory; None without one, or where it names what is not at hand."""
    try:
        return Scenario(**trajectory.settings["scenario"])
    except (KeyError, TypeError, InputError):
        return None


def replay(s: Scenario, trajectory: Trajectory) -> Walk:
    """The walk of a trajectory that another process simulated: its walker is built again from the scenario."""
    scene = RobotAndGait.of(s)
    return recorded_walk(build(s, scene), scene.gait, trajectory, s)


def load_walks(paths: Sequence[Path]) -> dict[str, Walk]:
    """The walks in run files, by a name for each.

    The name is that of the controller, with the file or a number where names repeat.
    """
    walks = [load_walk(path) for path in paths]
    names = [walk.controller_name for walk in walks]
    if len(set(names)) < len(names):
        names = [f"{name} ({path.stem})" for name, path in zip(names, paths, strict=True)]
    if len(set(names)) < len(names):
        names = [f"{name} {k}" for k, name in enumerate(names, start=1)]
    return dict(zip(names, walks, strict=True))
