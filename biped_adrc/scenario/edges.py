"""Remarks on a finished walk: sentences on what was not as it was asked for.

They are on pushes that an impact cut off; integration steps that are too long around the switching times of a
push; a walk that went on behind the last of its stepping stones; a gait that was made for another robot, slope
or controller; and a controller that lacks a method, or whose observer does not fit the sensors.

The window of a push, the time in which it acts, counts from the start of one single support. When the impacts
come is known only once the walk is simulated, and depends on the push. So a walk with a window that an impact
cuts cannot be refused before: `Walk.remarks` states it afterwards, since a push that acts for less time than
intended spoils a comparison without any other sign.

An edge is a switching time of a push: an instant at which a disturbance switches on or off. A disturbance has
its edges in `switches`, as pairs (step, s): number of the single support and time [s] from its start; the
number 0 stands for times from the start of the walk.

    the push from 0.1 to 0.3 s in single support 3 was cut by the impact at 0.2531 s
    the push from 0.6 s on in single support 2 did not begin before the impact at 0.5402 s

A remark is such a sentence. An arc of a trajectory is one single support; its nodes are the instants at which
the states were stored.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.control.base import nested
from biped_adrc.control.outer_loop import own_reference
from biped_adrc.core.timing import SampledTime
from biped_adrc.disturbances.base import Disturbance, summands
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.trajectory import Trajectory

_NEAR = 1e-3
"""The usual integration step [s]. Whether an edge this close to an impact acts before or after the impact is
decided by the error of integration."""
BURIED = 5e-3
"""Depth of the swing foot below the ground [m] from which on a start has a remark; a scuffing leg is less
deep."""
LONGER = 1.1
"""Largest integration step over the observer's shortest time constant [1]; multiple poles have round-off."""
SAME_CURVE = 1e-6
"""Curves that differ by no more than this [rad] count as the same, stored or fitted twice."""


def remarks(walker: Walker, gait: Gait | None, trajectory: Trajectory) -> Iterator[str]:
    """Yield the remarks on a walk: on pushes, integration steps around their edges, the start, single supports
    behind the last stepping stone, controller and gait.

    gait: the one that was to be walked; None for a robot without motors, and for a walk from a state alone. A
    push has a remark if it did not act, if an impact cuts it off, or if one of its edges is within `_NEAR`,
    1 ms, of an impact, before or after it. An edge at the very start of a single support has none: it is how
    "from the impact on" is written.
    """
    # summands: each push of a sum by itself
    for part in () if walker.disturbance is None else summands(walker.disturbance):
        # number of the single support, 0 for the whole walk -> times of the edges in it [s]
        edges = {k: sorted(s for j, s in part.switches if j == k) for k, _ in part.switches}
        found = [x for step, times in edges.items() for x in _of_edges(step, times, trajectory)]
        yield from found
        if not found and not _acted(part, {*edges}, trajectory, walker.plant.n):
            names = [_name(step, times) for step, times in edges.items()]
            name = names[0] if names else f"the push {type(part).__name__}"
            yield f"{name} did not act: it was zero at every instant of the walk"
    yield from _of_steps(walker, trajectory)
    # q (n,) of the first node of the first arc; the depth is below the plane through the stance foot
    depth = -walker.clearance(trajectory.arcs[0].x[0, : walker.plant.n])
    if depth > BURIED:
        yield f"the start has the swing foot {1e3 * depth:.3g} mm below the ground"
    # stone k is where single support k is to end; behind the last one a foot may land anywhere
    count = 0 if walker.stones is None else len(walker.stones.lengths)
    if 0 < count < trajectory.arcs[-1].mode.step:
        behind = f"behind stone {count}, the last one, from single support {count + 1} on"
        yield f"{behind}, the ground is whole"
    yield from _of_controller(walker, trajectory)
    yield from () if gait is None else _of_gait(walker, gait)


def _of_controller(walker: Walker, trajectory: Trajectory) -> Iterator[str]:
    """Yield a sentence for each controller that has a state but no method `jump`, which exchanges the legs in
    the state at an impact.
    """
    for law in nested(walker.controller):  # the controller, and those inside it
        # _writes: whether its class overrides this method of the base class
        name, kept = type(law).__name__, law._writes("initial_state") and not law._writes("jump")
        if kept and trajectory.events(FOOT_STRIKE):
            yield f"{name} has a state and no jump(s, after, swap) to exchange the legs in it at an impact"
        yield from _of_observer(walker, name, getattr(law, "observer", None))


def _of_observer(walker: Walker, law: str, observer: Any) -> Iterator[str]:
    """Yield a sentence for an observer, None for none, that does not know the low-pass on the angle in the
    encoders, and for one whose slowest pole is beyond the sampling; law: name of its controller.
    """
    # time constants [ms] of the low-pass that the observer knows, and of the one that there is
    knows = 1e3 * getattr(observer, "filter_time", 0.0)
    has = 1e3 * getattr(walker.sensors, "angle_filter", 0.0)
    if observer is not None and knows != has:
        what = f"the observer of {law} knows a low-pass of {knows:g} ms on the angles"
        yield f"{what}, and the encoders have one of {has:g} ms"
    slowest = min(np.abs(getattr(observer, "poles", ())), default=0.0)
    if isinstance(walker.timing, SampledTime) and slowest * walker.timing.period > np.pi:
        yield (
            f"the observer of {law} has its slowest pole at {slowest:.4g} rad/s, beyond the sampling's pi / T ="
            f" {np.pi / walker.timing.period:.4g} rad/s: it follows each sample, noise included"
        )


def _of_gait(walker: Walker, gait: Gait) -> Iterator[str]:
    """Yield a sentence for each of these three that is not the gait's own: the robot with its preset, the slope
    of the ground, and the curve q_b = h(Theta) that the controller tracks, angles of the joints with motors
    over the phase Theta = c q [rad], where c is a row of numbers (`phase`).
    """
    name, slope, plant = f"gait '{gait.name}'", walker.ground_slope, walker.plant
    if (gait.robot, gait.preset) != (plant.description.name, plant.preset):
        yield f"{name} was made for {gait.robot} {gait.preset}"
    if gait.slope != slope:
        yield f"{name} was made for a slope of {gait.slope:g} rad, and the ground has {slope:g} rad"
    # curves: the one that the controller tracks (None without), and the one of the gait
    h, c = own_reference(walker.controller), gait.constraint
    # curves over another phase variable Theta cannot be compared point by point
    if h != c and isinstance(h, VirtualConstraint) and np.array_equal(h.phase, c.phase):
        # h(Theta) gives value, slope and curvature: [0] are the angles
        inside = np.linspace(c.theta_plus, c.theta_minus)
        off = max(float(np.max(np.abs(h.h(x)[0] - c.h(x)[0]))) for x in inside)
        if off > SAME_CURVE:
            yield f"the controller's curve is up to {off:.2g} rad from that of {name}"


def _acted(part: Disturbance, steps: set[int], trajectory: Trajectory, n: int) -> bool:
    """Whether the torque zeta of a disturbance was other than zero at some node of the walk.

    steps: numbers of the single supports in which it switches; these are tried first, since there the answer is
    found soonest. n: number of coordinates, so that a stored state begins with q (n,), q' (n,).
    """
    return any(
        np.any(part.zeta(t, arc.mode.step, arc.mode.start, x[:n], x[n : 2 * n]))
        # False is sorted before True: arcs of these single supports come first
        for arc in sorted(trajectory.arcs, key=lambda arc: arc.mode.step not in steps)
        for t, x in zip(arc.t, arc.x, strict=True)
    )


def _of_edges(step: int, times: list[float], trajectory: Trajectory) -> Iterator[str]:
    """Yield sentences on those edges of one push that lie in single support `step`: that the walk did not get
    there, that an edge is close to an impact, or that the impact which ended the single support came first.

    times: of the edges, increasing [s], from the start of that single support; for step 0 from the start of the
    walk, and then no impact cuts the push.
    """
    name, arcs = _name(step, times), trajectory.arcs
    starts = [0.0] if step == 0 else [arc.mode.start for arc in arcs if arc.mode.step == step]
    if not starts:
        yield f"{name} did not act: the walk has no single support {step}"
        return
    if step == 0 and times[0] > trajectory.t_end:
        yield f"{name} did not act: the walk ended at {trajectory.t_end:.4g} s"
    # the impacts, as (number of the single support that it ends, time [s] counted as `times` are)
    ends = [(arc.mode.step, arc.event) for arc in arcs if arc.event]
    impacts = [(k, e.t - starts[0]) for k, e in ends if e.guard == FOOT_STRIKE]
    # s > 0: an edge at 0 is meant to be at the impact
    # _NEAR: so near the error of integration decides on which side an edge is
    near = {(s, end) for s in times if s > 0.0 for _, end in impacts if abs(s - end) <= _NEAR}
    for s, end in sorted(near):
        edge = f"the edge at {s:g} s within {1e3 * _NEAR:g} ms of the impact at {end:.4f} s"
        yield f"{name} has {edge}; move it away from there"
    # the impact that ended this single support (none for step 0 or after a fall), and the edges after it: where
    # all are after it the push did not begin, where some are it was cut
    own = [end for number, end in impacts if number == step]
    late = [s for end in own for s in times if s > end + _NEAR]
    if late and not near:
        begun = "was cut by" if len(late) < len(times) else "did not begin before"
        yield f"{name} {begun} the impact at {own[0]:.4f} s"


def _of_steps(walker: Walker, trajectory: Trajectory) -> Iterator[str]:
    """Yield a sentence if the fixed integration step is too long for the observer's transient after an edge of
    a push.

    `Walker.split` gives the linear dynamics E' = A E of the observer's error, whose eigenvalues are the poles;
    None without a linear observer in continuous time. If the integration step is longer than 1 / |p| of the
    fastest pole p, the tracking error after an edge is mostly an error of integration. Single supports with an
    edge are looked at, and those after them.
    """
    # a method that controls its own error has its tolerance "rtol" in its text, and needs no remark
    if walker.disturbance is None or "rtol" in trajectory.settings.get("method", ""):
        return
    split = walker.split(Mode())
    if split is None:
        return
    edges = {step for part in summands(walker.disturbance) for step, _ in part.switches}
    constant = 1.0 / float(np.max(np.abs(np.linalg.eigvals(split.A))))
    # the number 0 is for an edge in the time of the walk, which may lie in every single support
    beside = [a for a in trajectory.arcs if edges & {0, a.mode.step, a.mode.step - 1}]
    # each integration step has a node, so differences of the nodes' times are the steps
    longest = max((float(np.max(np.diff(a.t), initial=0.0)) for a in beside), default=0.0)
    # LONGER times the observer's shortest time constant
    if longest > LONGER * constant:
        yield (
            f"the step of {1e3 * longest:.3g} ms beside the edges of the push is longer than the shortest time "
            f"constant of the observer ({1e3 * constant:.2g} ms): the largest errors may be mostly errors of "
            "integration; give a step as short as that, or the compiled engine and no step"
        )


def _name(step: int, times: list[float]) -> str:
    """The push as a message names it: by its first and last edge in `times` [s], or by "on" where it has only
    one, and by its single support `step`, which 0 leaves out.
    """
    window = f"from {times[0]:g}" + (f" to {times[-1]:g} s" if len(times) > 1 else " s on")
    return f"the push {window}" + (f" in single support {step}" if step > 0 else "")
