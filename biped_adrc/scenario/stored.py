"""Walks on disk, complete in themselves: scenario, states, signals, walker and gait in one .npz file.

Robot and gait are in the file as they were, so that neither the working directory nor later changes of their
files matter. Reading a file imports no code of the user: a stand-in takes the place of a controller that is not
at hand. A stored walk is checked before it is handed over (`_check`), so that damage is noticed on reading.

Entries of the file, beside the trajectory that `hybrid.storage` writes:

    walker      JSON: {"parts": records of all objects, "walker": place of the walker, "gait": the gait}
    signal.*    arrays over the nodes
    settings    versions, the scenario's record, names of the user's classes, and what the caller adds
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.feet import NAMES
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid import storage
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.recording import Walk, watched
from biped_adrc.scenario.registry import read_from_a_file
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walker_record import MissingPart, PartRecord, Reader, Writer, home_of
from biped_adrc.types import Array
from biped_adrc.versions import versions


class AbsentController(MissingPart, Controller):
    """Stand-in for the controller of a stored walk whose class is not at hand.

    Raises InputError when called.
    """

    def output(self, s: Array, m: Measurement) -> Array:
        raise InputError(f"the walk cannot go on without its controller: {self.why}")


class AbsentDisturbance(MissingPart, Disturbance):
    """Stand-in for a disturbance whose class is not at hand. Raises InputError when called."""

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        raise InputError(f"the walk cannot go on without its disturbance: {self.why}")


STAND_INS = {"controller": AbsentController, "disturbance": AbsentDisturbance}
"""Fields of a walker in which a missing part is accepted, and the class that takes its place."""


def save_walk(walk: Walk, path: Path | str, settings: Mapping[str, object] | None = None) -> Path:
    """Write a walk (.npz) that `load_walk` reads anywhere; returns its path.

    settings: more plain values to be stored beside it.

    Raises InputError and OutputError.
    """
    writer = Writer()
    walker, gait = writer.part(walk.walker), writer.plain(walk.gait)
    record = {"parts": writer.records, "walker": walker, "gait": gait}
    about: dict[str, object] = {"versions": versions()}
    if walk.scenario is not None:
        about["scenario"] = walk.scenario.record()
    if writer.own:
        about["own"] = sorted(set(writer.own))
    arrays: dict[str, ArrayLike] = {"walker": json.dumps(record)}
    arrays |= {f"signal.{k}": x for k, x in vars(walk.signals).items()}
    return storage.save(walk.trajectory, path, {**about, **(settings or {})}, arrays)


def load_walk(path: Path | str, controller: object = None) -> Walk:
    """The walk in a run file (.npz) written by `Walk.save`, `simulate` or `reproduce`.

        walk = ba.load_walk("walk.npz")
        walk = ba.load_walk("walk.npz", controller=MyController)

    controller: class or object of one's own, of the controller or of another part such as its observer, with
    which the walk can go on; without, its signals, figures and pictures are those of the file. Raises
    InputError.
    """
    trajectory = storage.load(path, _mode)
    beside = storage.load_beside(path)
    with storage.reading_run(path), read_from_a_file():
        if "walker" not in beside:
            raise InputError(
                "it does not say which robot, gait and controller it is of; runs written by Walk.save, "
                "'biped-adrc simulate' and 'reproduce' do"
            )
        found = _stored(trajectory, beside, controller)
        _check(found)
    return found


def _mode(step: float, start: float) -> Mode:
    """A mode from its numbers in a file."""
    return Mode(int(step), start)


def _stored(trajectory: Trajectory, beside: Mapping[str, Array], controller: object) -> Walk:
    """The walk of a trajectory, from the record of its walker and the signals beside it in the file."""
    record = json.loads(str(beside["walker"]))
    reader = Reader(record["parts"], _given(record["parts"], controller))
    walker = _walker(reader, record["parts"][record["walker"]])
    gait = reader.whole(record["gait"])
    seen = {k.removeprefix("signal."): x for k, x in beside.items() if k.startswith("signal.")}
    changed = tuple(
        f"the source of {home} has changed since this walk"
        for home in dict.fromkeys(reader.changed)
    )
    made = watched(walker, gait, trajectory, _scenario(trajectory))
    return replace(made, recorded=Signals(**seen), said=changed)


def _check_readings(walk: Walk) -> None:
    """Raise ValueError where a walk with readings of its feet lacks some, or they are none of its nodes."""
    arcs, plant = walk.trajectory.arcs, walk.walker.plant
    if not any(set(NAMES) & set(arc.read) for arc in arcs):
        return
    width = {**dict.fromkeys(NAMES, 4), "u": plant.p, "zeta": plant.n}
    for i, arc in enumerate(arcs):
        for name, count in width.items():
            rows = arc.read.get(name)
            if rows is None or rows.shape != (len(arc.t), count) or not np.all(np.isfinite(rows)):
                found = "none" if rows is None else f"an array {rows.shape}"
                raise ValueError(
                    f"{name} of arc {i} is {found}, expected finite numbers ({len(arc.t)}, {count})"
                )


def _check(walk: Walk) -> None:
    """Raise ValueError where gait, states or signals of a file do not fit the walker."""
    walker, arcs, n = walk.walker, walk.trajectory.arcs, walk.walker.plant.n
    _check_readings(walk)
    expected = Gait if walker.plant.p else type(None)
    if not isinstance(walk.gait, expected):
        raise ValueError(f"its gait is a {type(walk.gait).__name__}")
    t = np.concatenate([arc.t for arc in arcs])
    rows = {len(signal) for signal in vars(walk.signals).values()}
    if rows != {len(t)} or not np.array_equal(walk.signals.t, t):
        raise ValueError(f"its signals are not of its {len(t)} nodes")
    if any(arc.x.shape[1] < 2 * n for arc in arcs):
        raise ValueError(f"its states have {arcs[0].x.shape[1]} numbers, expected {2 * n} or more")


def _given(parts: Sequence[PartRecord], thing: Any) -> dict[str, object]:
    """A class or object of the user's, by the module:Class under which the file has it.

    The name of the class has to agree; its module may be another one, as in a notebook. Raises InputError for
    what the file does not have.
    """
    if thing is None:
        return {}
    kind = thing if hasattr(thing, "__qualname__") else type(thing)
    own = sorted({part["class"] for part in parts if "source" in part})
    found = [home for home in own if home == home_of(kind)]
    found = found or [home for home in own if home.partition(":")[2] == kind.__qualname__]
    if not found:
        needed = " and ".join(map(repr, own)) or "nothing, so leave it out"
        raise InputError(
            f"{thing!r} is given, expected a Controller or its class, or those of another part, of a name that "
            f"the file has from outside the package: {needed}"
        )
    return dict.fromkeys(found, thing)


def _walker(reader: Reader, record: PartRecord) -> Walker:
    """The walker of a record, with a stand-in for a controller or a disturbance that is not at hand."""
    values = dict[str, Any]()
    for name, x in record["values"].items():
        values[name] = reader.made(x) if name in STAND_INS else reader.whole(x)
        if isinstance(part := values[name], MissingPart):
            values[name] = STAND_INS[name](part.home, part.values, part.source)
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
    return watched(build(s, scene), scene.gait, trajectory, s)


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
