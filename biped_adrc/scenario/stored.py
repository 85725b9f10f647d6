"""Runs on disk that are complete in themselves: trajectory, walker, gait, scenario and torques in one .npz.

Robot and gait are in the file as they were, so that neither the working directory nor what has become of their
files matters. Reading a run imports nothing: of a controller of the user's own the signals are in the file.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.analysis.signals import Signals, signals
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.published import passive_cycle
from biped_adrc.hybrid import storage
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.build import Scene, build
from biped_adrc.scenario.controllers import OF_OBSERVER
from biped_adrc.scenario.plain import Missing, Reader, Writer, home_of
from biped_adrc.scenario.recording import Walk, watched
from biped_adrc.scenario.scenario import FREE, Scenario
from biped_adrc.types import Array
from biped_adrc.versions import versions


class AbsentController(Missing, Controller):
    """In place of the controller of a stored walk of which a class was not given."""

    def output(self, s: Array, m: Measurement) -> Array:
        raise InputError(f"the walk cannot go on without its controller: {self.why}")


class AbsentDisturbance(Missing, Disturbance):
    """In place of a disturbance of which a class was not given."""

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        raise InputError(f"the walk cannot go on without its disturbance: {self.why}")


STAND_INS = {"controller": AbsentController, "disturbance": AbsentDisturbance}


def save_walk(walk: Walk, path: Path | str, settings: Mapping[str, Any] | None = None) -> Path:
    """Write a walk (.npz) that `load_walk` reads anywhere; returns its path. Raises InputError, OutputError."""
    writer = Writer()
    walker, gait = writer.plain(walk.walker), writer.plain(walk.gait)
    record = {"parts": writer.records, "walker": walker["part"], "gait": gait}
    seen = vars(walk.signals) if writer.own else {"u": walk.signals.u}
    about: dict[str, Any] = {"versions": versions()}
    if walk.scenario is not None:
        about["scenario"] = walk.scenario.record()
    if writer.own:
        about["own"] = sorted(set(writer.own))
    beside = {"walker": json.dumps(record), **{f"signal.{name}": x for name, x in seen.items()}}
    return storage.save(walk.trajectory, path, {**about, **(settings or {})}, beside)


def load_walk(path: Path | str, controller: Any = None) -> Walk:
    """The walk in a run file (.npz) written by `Walk.save`, `simulate` or `reproduce`.

    controller: class or object of one's own, of the controller or of another part such as its observer, with
    which the walk can go on; without, its signals, figures and pictures are those of the file. Raises
    InputError.
    """
    trajectory = storage.load(path, lambda step, start: Mode(int(step), start))
    beside = storage.load_beside(path)
    with storage.reading_run(path):
        found = (
            _stored(trajectory, beside, controller) if "walker" in beside else _of_0_1(trajectory)
        )
        _check(found)
    return found


def _stored(trajectory: Trajectory, beside: Mapping[str, Any], controller: Any) -> Walk:
    """The walk of a trajectory, from what is beside it."""
    record = json.loads(str(beside["walker"]))
    reader = Reader(record["parts"], _given(record["parts"], controller))
    walker = _walker(reader, record["parts"][record["walker"]])
    gait = reader.whole(record["gait"])
    seen = {k.removeprefix("signal."): x for k, x in beside.items() if k.startswith("signal.")}
    changed = tuple(
        f"the source of {home} has changed since this walk"
        for home in dict.fromkeys(reader.changed)
    )
    made = watched(walker, gait, trajectory, _scenario(trajectory.settings))
    return replace(made, recorded=Signals(**seen) if len(seen) > 1 else None, said=changed)


def _check(walk: Walk) -> None:
    """Raise ValueError where gait, states or signals do not fit the walker, which is asked for one node."""
    walker, arcs, n = walk.walker, walk.trajectory.arcs, walk.walker.plant.n
    expected = Gait if walker.plant.p else type(None)
    if not isinstance(walk.gait, expected):
        raise ValueError(f"its gait is a {type(walk.gait).__name__}")
    if walk.recorded is not None:
        t = np.concatenate([arc.t for arc in arcs])
        rows = {len(signal) for signal in vars(walk.recorded).values()}
        if rows != {len(t)} or not np.array_equal(walk.recorded.t, t):
            raise ValueError(f"its signals are not of its {len(t)} nodes")
        return
    first = arcs[0]
    size = len(walker.initial_state(first.x[0, :n], first.x[0, n : 2 * n], first.mode))
    if any(arc.x.shape[1] != size for arc in arcs):
        raise ValueError(f"its states have {first.x.shape[1]} numbers, its walker's {size}")
    node = replace(first, t=first.t[:1], x=first.x[:1], dx=first.dx[:1], event=None)
    signals(walker, Trajectory((node,), walk.trajectory.status), walk.reference)


def _given(parts: Sequence[Mapping[str, Any]], thing: Any) -> dict[str, Any]:
    """What stands for parts of the user's own, by their name in the file; the module may be another one."""
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


def _walker(reader: Reader, record: Mapping[str, Any]) -> Walker:
    """With a stand-in for a controller or a disturbance that is not there."""
    values = dict[str, Any]()
    for name, x in record["values"].items():
        values[name] = reader.made(x) if name in STAND_INS else reader.whole(x)
        if isinstance(part := values[name], Missing):
            values[name] = STAND_INS[name](part.home, part.values, part.source)
    return Walker(**values)


def _scenario(settings: Mapping[str, Any]) -> Scenario | None:
    """What asked for the walk; None where it names what this process has not."""
    try:
        return Scenario(**settings["scenario"])
    except (KeyError, TypeError, InputError):
        return None


def replay(s: Scenario, trajectory: Trajectory) -> Walk:
    """The walk of a trajectory that was sent: its walker is built again from the scenario."""
    scene = Scene.of(s)
    return watched(build(s, scene), scene.gait, trajectory, s)


def _of_0_1(trajectory: Trajectory) -> Walk:
    """A run of version 0.1, which names its robot and gait: they are looked up as they are now."""
    settings = trajectory.settings
    try:
        if "passive" in settings:
            record = settings["passive"]
            known = passive_cycle(Biped.load(record["robot"], record["preset"]))
            beside = {"robot": record["robot"], "preset": record["preset"]}
            slope = float(record["slope"]) - known.slope
            return replay(Scenario("passive", slope=slope, **beside), trajectory)
        if "run" in settings:
            return replay(Scenario(**values_of_0_1(settings["run"])), trajectory)
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            f"it is of version 0.1 and cannot be read: {error}; walk it again with "
            "'biped-adrc simulate'"
        ) from error
    raise InputError(
        "it does not say which robot, gait and controller it is of; runs written by Walk.save, "
        "'biped-adrc simulate' and 'reproduce' do"
    )


def values_of_0_1(record: Mapping[str, Any]) -> dict[str, Any]:
    """Without what had no effect then, and is refused now."""
    idle = {"store_every", "poles" if record.get("bandwidth") else "order"}
    idle |= {*OF_OBSERVER, "reset"} if record.get("controller") == "NPD" else set()
    idle |= set() if record.get("method") in FREE else {"tolerance"}
    return {name: x for name, x in record.items() if name not in idle}


def load_walks(paths: Sequence[Path]) -> dict[str, Walk]:
    """The walks in run files, named by controller and, where that is not enough, by file."""
    found = [(path, load_walk(path)) for path in paths]
    names = [walk.controller_name for _, walk in found]
    if len(set(names)) < len(names):
        names = [f"{walk.controller_name} ({path.stem})" for path, walk in found]
    if len(set(names)) < len(names):
        names = [f"{name} {k}" for k, name in enumerate(names, start=1)]
    return dict(zip(names, (walk for _, walk in found), strict=True))
