"""Remarks on a finished walk: pushes that an impact cut off, steps of integration too long beside their edges,
and the last stone.

A window of a push is given in the time of one single support. When the impacts come is known only once the walk
is simulated, and depends on the push. A walk is therefore not refused: `Walk.remarks` states what was not as it
was asked for, since a push that acts for less time than intended spoils a comparison without any other sign.

An edge is an instant at which a disturbance switches (`Disturbance.switches`), by the number of its single
support and the time [s] from its start; the number 0 is for times from the start of the walk.

    the push from 0.1 to 0.3 s in single support 3 was cut by the impact at 0.2531 s
    the push from 0.6 s on in single support 2 did not begin before the impact at 0.5402 s
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.disturbances.base import Disturbance, summands
from biped_adrc.hybrid.trajectory import Trajectory

NEAR = 1e-3
"""[s], the usual integration step: whether an edge this close to an impact acts before or after it is decided
by the error of the method."""
LONGER = 1.1
"""Largest step over the observer's shortest time constant; a little above 1 for round-off in its poles."""


def remarks(walker: Walker, trajectory: Trajectory) -> Iterator[str]:
    """Sentences on the pushes of a walk, on its steps beside their edges, and on what is behind its last stone.

    A push is named that did not act, that an impact cuts off, or with an edge at an impact. An edge within
    `NEAR` of an impact is named on both sides of it. One at s = 0 of a single support is not: it is how "from
    the impact on" is written.
    """
    for part in () if walker.disturbance is None else summands(walker.disturbance):
        edges = {
            step: sorted(s for k, s in part.switches if k == step) for step, _ in part.switches
        }
        found = [x for step, times in edges.items() for x in _of_edges(step, times, trajectory)]
        yield from found
        if not found and not _acted(part, trajectory, walker.plant.n):
            names = [_name(step, times) for step, times in edges.items()]
            name = names[0] if names else f"the push {type(part).__name__}"
            yield f"{name} did not act: it was zero at every instant of the walk"
    yield from _of_steps(walker, trajectory)
    count = 0 if walker.stones is None else len(walker.stones.lengths)
    if 0 < count < trajectory.arcs[-1].mode.step:
        yield (
            f"behind stone {count}, the last one, from single support {count + 1} on, the ground is whole"
        )


def _acted(part: Disturbance, trajectory: Trajectory, n: int) -> bool:
    """Whether a disturbance was other than zero at some node of the walk, of n coordinates."""
    return any(
        np.any(part.zeta(t, arc.mode.step, arc.mode.start, x[:n], x[n : 2 * n]))
        for arc in trajectory.arcs
        for t, x in zip(arc.t, arc.x, strict=True)
    )


def _of_edges(step: int, times: list[float], trajectory: Trajectory) -> Iterator[str]:
    """Sentences on the edges of one push, times [s] from the start of the single support, of the walk at 0."""
    name, arcs = _name(step, times), trajectory.arcs
    starts = [0.0] if step == 0 else [arc.mode.start for arc in arcs if arc.mode.step == step]
    if not starts:
        yield f"{name} did not act: the walk has no single support {step}"
        return
    if step == 0 and times[0] > trajectory.t_end:
        yield f"{name} did not act: the walk ended at {trajectory.t_end:.4g} s"
    impacts = [
        (arc.mode.step, e.t - starts[0])
        for arc in arcs
        if (e := arc.event) and e.guard == FOOT_STRIKE
    ]
    near = {(s, end) for s in times if s > 0.0 for _, end in impacts if abs(s - end) <= NEAR}
    for s, end in sorted(near):
        yield (
            f"{name} has the edge at {s:g} s within {1e3 * NEAR:g} ms of the impact at {end:.4f} s; move it "
            "away from there"
        )
    own = [end for number, end in impacts if number == step]
    late = [s for end in own for s in times if s > end + NEAR]
    if late and not near:
        begun = "was cut by" if len(late) < len(times) else "did not begin before"
        yield f"{name} {begun} the impact at {own[0]:.4f} s"


def _of_steps(walker: Walker, trajectory: Trajectory) -> Iterator[str]:
    """A sentence where steps of a fixed length are too long for the observer's transient after an edge.

    In the coordinates of `Walker.split` the observer's error decays with its poles. Where the step is longer
    than 1 / |p| of the fastest pole, the error seen after an edge is mostly that of the integration method.
    Single supports with an edge are looked at, and those after them. Empty for methods that control their
    error.
    """
    if walker.disturbance is None or "rtol" in trajectory.settings.get("method", ""):
        return
    split = walker.split(Mode())
    if split is None:
        return
    edges = {step for part in summands(walker.disturbance) for step, _ in part.switches}
    constant = 1.0 / float(np.max(np.abs(np.linalg.eigvals(split.A))))
    # an edge of step 0 is in time of the walk: it may be in any single support
    beside = [a for a in trajectory.arcs if edges & {0, a.mode.step, a.mode.step - 1}]
    longest = max((float(np.max(np.diff(a.t), initial=0.0)) for a in beside), default=0.0)
    if longest > LONGER * constant:
        yield (
            f"the step of {1e3 * longest:.3g} ms beside the edges of the push is longer than the shortest time "
            f"constant of the observer ({1e3 * constant:.2g} ms): the largest errors may be mostly errors of "
            "integration; give a step as short as that, or the compiled engine and no step"
        )


def _name(step: int, times: list[float]) -> str:
    """The push as a message names it, by its window and its single support."""
    window = f"from {times[0]:g}" + (f" to {times[-1]:g} s" if len(times) > 1 else " s on")
    return f"the push {window}" + (f" in single support {step}" if step > 0 else "")
