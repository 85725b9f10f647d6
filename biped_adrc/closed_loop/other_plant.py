"""A walker's walk on a plant that moves by itself: its controller, sensors, motors and pushes, another ground.

    walker -> SteppingLoop -> Trajectory with states (q, q', s, held), as the rigid plant's
    footing(row, u, load) -> Feet     a method of the plant, for instance of `MuJoCoPlant`

A plant that moves by itself, with an integration and contacts of its own such as MuJoCo's, is a
`protocols.SteppingPlant`; the rigid plant is the walker's own, with a pinned stance foot and an impact map. q
(n,) [rad], q' [rad/s] are the coordinates and rates, s is the controller's state, `held` what sensors and
motors hold between sample instants. Steps of the ground are places where it falls or rises. The numbers that
the plant keeps for itself are taken out of the states, so that whatever reads a walk reads this one; forces of
the ground, places and velocities of both feet, which could not be computed without them, are recorded at the
nodes (instants whose state is stored) where the plant has feet.

row (2 n + k,) is the plant's whole state, (q, q', and k numbers of its own), u (p,) [N m] the torque asked of
the p motors, load what acts from outside: the disturbance zeta (n,) [N m] and its resultant force [N]. Forces
of the ground follow from these, so a run does not compute them: `with_readings` asks the plant at every node of
a finished run and adds the answers to the arcs (`Arc.read`). An arc is the motion of one single support.
"""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.closed_loop.protocols import LaggingPlant, Load, OnFeet, SteppingPlant, UnevenPlant
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.hybrid.simulator import Progress, RunOptions
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory
from biped_adrc.model.biped import Biped


def stepping_loop(
    walker: Walker,
    plant: SteppingPlant,
    first_step: int = 1,
    kind: type[SteppingLoop] = SteppingLoop,
) -> SteppingLoop:
    """Make a loop of another plant with the controller, sensors and clock of a walker.

    The lag of the walker's motors and the steps of its ground become the plant's; a rate limit of the motors
    stays in the loop. first_step: number of the first single support, from which the plant counts for its steps
    of the ground. kind: class of the loop. Raises InputError for a walker in continuous time or with an error
    of the impact map, which only the rigid plant has, and for a plant that has another slope, lag or steps of
    the ground than the walker, or cannot have those of the walker.
    """
    if len(walker.gain) > 0:
        raise InputError(
            f"the walker has an error of the impact map, and {type(plant).__name__} takes none; leave that "
            "out, or walk on the rigid plant"
        )
    motors = None if walker.motors is None else replace(walker.motors, lag=0.0)
    # a walker has all fields of a loop; the model of its controller does not change with the plant
    values = {f.name: getattr(walker, f.name) for f in fields(SteppingLoop)}
    values |= {"plant": _fitted(plant, walker, first_step), "model": walker.nominal}
    return kind(**values | {"motors": motors})


def lag_of(plant: SteppingPlant) -> float:
    """Time constant of the plant's motors [s]; 0 for a plant without such a property."""
    return plant.lag if isinstance(plant, LaggingPlant) else 0.0


def _fitted(plant: SteppingPlant, walker: Walker, first_step: int) -> SteppingPlant:
    """A copy of the plant with the lag of the walker's motors, and on the steps of the walker's ground. Raises
    InputError for a plant that has another slope, lag or steps of its own, or cannot have the walker's."""
    name, steps = type(plant).__name__, walker.ground_steps
    # a walker without a slope (None) walks on the plant's, and a plant that has none takes any
    if walker.slope not in (None, slope := getattr(plant, "slope", walker.slope)):
        raise InputError(f"{name} has a slope of {slope} rad, the walker {walker.slope}; give one")
    lag = 0.0 if walker.motors is None else walker.motors.lag
    own = {"lag": lag_of(plant), "steps": getattr(plant, "ground_steps", ())}
    for what, kind, other in (("lag", LaggingPlant, lag), ("steps", UnevenPlant, steps)):
        # where the two differ, the plant takes the walker's: if its own is 0 or (), and it is of the class that
        # has the method for that
        if own[what] != other and (own[what] or not isinstance(plant, kind)):
            raise InputError(
                f"{name} has {what} {own[what]} and the walker {other}; give motors with lag and steps of the "
                "ground to the walker alone, and to a plant that takes them"
            )
    if lag and isinstance(plant, LaggingPlant):
        plant = plant.lagging(lag)
    return plant.on_steps(steps, first_step) if steps and isinstance(plant, UnevenPlant) else plant


def walk_on(
    loop: SteppingLoop,
    walker: Walker,
    start: tuple[Array, Array],
    mode: Mode,
    impacts: int,
    progress: Progress | None = None,
) -> Trajectory:
    """Simulate a loop of `stepping_loop` from start = (q, v), each (n,) [rad, rad/s], until `impacts` impacts.

    walker: the one of the loop, for its longest single support. mode: the single support in which it starts.
    progress: called during the run. The states of the result have the walker's layout, (q, q', s, held). Raises
    InputError where (q, v) cannot be a start.
    """
    x0 = loop.initial_state(*start, mode)
    # a single support that takes too long is noticed at a tick, so up to one period late
    longest = walker.max_step_time + loop.clock.period
    # the run ends after the last of these impacts, and at `end` at the latest
    end, last = mode.start + impacts * longest, (FOOT_STRIKE, impacts)
    options = RunOptions(end, mode.start, stop_after=last, progress=progress)
    return as_walked(loop, loop.run(x0, options, mode))


def as_walked(loop: SteppingLoop, run: Trajectory) -> Trajectory:
    """Convert a run of `loop` to the layout of a walker's states, (q, q', s, held).

    The plant's own numbers are removed, but for the torque of lagging motors, which moves to where a walker has
    it. Where the plant has feet, forces [N], places [m] and velocities [m/s] of both feet are added to the arcs
    (one for each single support), and a description of the plant to the settings of the run.
    """
    if isinstance(loop.plant, OnFeet):
        run = with_readings(loop, run)
    arcs = tuple(_as_rigid(loop, arc) for arc in run.arcs)
    return replace(run, arcs=arcs, settings={**run.settings, "plant": _values(loop.plant)})


def _as_rigid(loop: SteppingLoop, arc: Arc) -> Arc:
    """An arc of a run of `loop`, its states, slopes and event in the layout of a walker on the rigid plant."""
    layout, p = loop.layout_of(arc.x[0]), loop.plant.p
    # own: slice of the plant's own numbers; at: end of the queue, the torques that wait whole sampling periods
    own, at = layout.place("tail", "own"), layout.place("tail", "line", "queue").stop

    def without(x: Array) -> Array:
        """States (.., nx) without the plant's own numbers; where its motors lag, their torque u_m (.., p) is
        inserted behind the queue, where a walker keeps it. Also of slopes, where all but q' and q'' is 0."""
        # empty, [.., :0], without lag
        u_m = loop.motor_torque(x)[..., : p if lag_of(loop.plant) > 0.0 else 0]
        # only x[.., :at] has these numbers in it, at the places `own`
        return np.concatenate((np.delete(x[..., :at], own, axis=-1), u_m, x[..., at:]), axis=-1)

    event = arc.event
    if event is not None:
        after = None if event.x_plus is None else without(event.x_plus)
        event = Event(event.guard, event.t, without(event.x_minus), after)
    return replace(arc, x=without(arc.x), dx=without(arc.dx), event=event)


def _values(thing: Any) -> Any:
    """A plant as plain values for the settings of a run: a record of its class and its fields, which are
    numbers, texts, tuples or such records; of a robot, and of anything else, the name of its class."""
    if isinstance(thing, tuple):
        return tuple(map(_values, thing))
    if not is_dataclass(thing) or isinstance(thing, Biped):
        return thing if isinstance(thing, int | float | str) else type(thing).__name__
    values = {f.name: _values(getattr(thing, f.name)) for f in fields(thing) if f.init}
    return {"class": type(thing).__name__, **values}


FEET = ("foot_force", "foot_place", "foot_speed", "foot_level")
"""Names of what `with_readings` records, in the order of `Feet`: forces [N], places [m] and velocities [m/s],
(K, 4) each, x and z of the stance foot before those of the other; heights of the ground [m], (K, 2)."""


def with_readings(loop: SteppingLoop, run: Trajectory) -> Trajectory:
    """A copy of a run of this loop whose arcs have, in `Arc.read`, the readings FEET at their K nodes; also "u"
    (K, p), the motors' torque, and "zeta" (K, n) [N m], where an arc does not have them yet. `_passed` gives
    state and load of each node. Raises InputError for a plant without feet."""
    plant, arcs = loop.plant, []
    if not isinstance(plant, OnFeet):
        raise InputError(
            f"{type(plant).__name__} does not say what its feet do, expected a plant with footing(row, u, "
            "load), such as MuJoCoPlant"
        )
    for arc in run.arcs:
        rows = []
        for x, load in _passed(loop, arc):
            # the last p numbers of x are the torque that is asked of the motors
            feet = plant.footing(loop.row(x), x[-plant.p :], load)
            # ravel: (2, 2) of both feet becomes a row of 4
            rows.append((loop.motor_torque(x), load.zeta, *map(np.ravel, feet)))
        columns = map(np.array, zip(*rows, strict=True))
        read = dict(zip(("u", "zeta", *FEET), columns, strict=True))
        # read | arc.read: what the arc recorded itself counts; one that failed at once has no u and zeta
        arcs.append(replace(arc, read=read | arc.read))
    return replace(run, arcs=tuple(arcs))


def _passed(loop: SteppingLoop, arc: Arc) -> Iterator[tuple[Array, Load]]:
    """Yield the state x (nx,) at each node of an arc, and the load under which the plant moved there.

    The time between two sample instants or switching times is a stretch: it has two nodes, at its start and its
    end, and the load is constant over it, with its value in the middle. A last node alone is where the plant
    could not go on.
    """
    # a stretch begins at each node after which time goes on; where one ends the next begins, at the same time
    times, pieces = arc.t.tolist(), np.flatnonzero(np.diff(arc.t) > 0.0)
    for k in pieces:
        load = loop.load(0.5 * (times[k] + times[k + 1]), loop.row(arc.x[k]), arc.mode)
        yield arc.x[k], load
        yield arc.x[k + 1], load
    if len(times) > 2 * len(pieces):
        yield arc.x[-1], loop.load(times[-1], loop.row(arc.x[-1]), arc.mode)
