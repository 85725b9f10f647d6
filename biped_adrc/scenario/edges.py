"""Remarks on a finished walk: pushes that an impact cut off, and integration steps too long beside their edges.

A window of a push is given in the time of one single support. When the impacts come is known only once the walk
is simulated, and depends on the push. A walk is therefore not refused: `Walk.remarks` states what was not as it
was asked for, since a push that acts for less time than intended spoils a comparison without any other sign.

An edge is an instant at which a disturbance switches (`Disturbance.switches`).

    the push from 0.1 to 0.3 s in single support 3 was cut by the impact at 0.2531 s
    the push from 0.6 s on in single support 2 did not begin before the impact at 0.5402 s
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.disturbances.base import Disturbance, summands
from biped_adrc.hybrid.trajectory import Arc, Trajectory

NEAR = 1e-3
"""[s], the usual integration step: whether an edge this close to an impact acts before or after it is decided
by the error of the method."""
LONGER = 1.1
"""Largest step over the observer's shortest time constant; a little above 1 for round-off in its poles."""


def edge_remarks(walker: Walker, trajectory: Trajectory) -> tuple[str, ...]:
    """A sentence for each push that did not act, that an impact cuts off, or with an edge at an impact.

    An edge within `NEAR` of an impact is named on both sides of it. One at s = 0 of a single support is not: it
    is how "from the impact on" is written.
    """
    if walker.disturbance is None:
        return ()
    found = list[str]()
    for part in summands(walker.disturbance):
        said = list(_remarks(_edges(part), trajectory))
        n = walker.plant.n
        found += said if said or _acted(part, trajectory, n) else [_idle(part)]
    return tuple(dict.fromkeys(found))


def _acted(part: Disturbance, trajectory: Trajectory, n: int) -> bool:
    """Whether a disturbance was other than zero at some node of the walk, of n coordinates."""
    return any(
        np.any(part.zeta(t, arc.mode.step, arc.mode.start, x[:n], x[n : 2 * n]))
        for arc in trajectory.arcs
        for t, x in zip(arc.t, arc.x, strict=True)
    )


def _idle(part: Disturbance) -> str:
    """The sentence for one that did not act."""
    edges = _edges(part)
    name = _name(*next(iter(edges.items()))) if edges else f"the push {type(part).__name__}"
    return f"{name} did not act: it was zero at every instant of the walk"


def step_remarks(walker: Walker, trajectory: Trajectory) -> tuple[str, ...]:
    """A sentence where steps of a fixed length are too long for the observer's transient after an edge.

    In the coordinates of `Walker.split` the observer's error decays with its poles. Where the step is longer
    than 1 / |p| of the fastest pole, the error seen after an edge is mostly that of the integration method.
    Single supports with an edge are looked at, and those after them. Empty for methods that control their
    error.
    """
    if walker.disturbance is None or "rtol" in trajectory.settings.get("method", ""):
        return ()
    split = walker.split(Mode())
    if split is None:
        return ()
    edges = {step for part in summands(walker.disturbance) for step in _edges(part)}
    constant = 1.0 / float(np.max(np.abs(np.linalg.eigvals(split.A))))
    # an edge of step 0 is in time of the walk: it may be in any single support
    beside = [a for a in trajectory.arcs if edges & {0, a.mode.step, a.mode.step - 1}]
    longest = max((float(np.max(np.diff(a.t), initial=0.0)) for a in beside), default=0.0)
    if longest <= LONGER * constant:
        return ()
    return (
        f"the step of {1e3 * longest:.3g} ms beside the edges of the push is longer than the shortest time "
        f"constant of the observer ({1e3 * constant:.2g} ms): the largest errors may be mostly errors of "
        "integration; give a step as short as that, or the compiled engine and no step",
    )


def _edges(disturbance: Disturbance) -> dict[int, list[float]]:
    """Times [s] of the edges by number of the single support, from its start; under 0 from the start of the
    walk.
    """
    edges: dict[int, list[float]] = {}
    for step, s in disturbance.switches:
        edges.setdefault(step, []).append(s)
    return {step: sorted(times) for step, times in edges.items()}


def _remarks(edges: dict[int, list[float]], trajectory: Trajectory) -> Iterator[str]:
    """Sentences on the edges of one disturbance."""
    arcs = [a for a in trajectory.arcs if a.event is not None and a.event.guard == FOOT_STRIKE]
    walked = {arc.mode.step for arc in trajectory.arcs}
    for step, times in edges.items():
        name = _name(step, times)
        if step > 0 and step not in walked:
            yield f"{name} did not act: the walk has no single support {step}"
        elif step == 0 and times[0] > trajectory.t_end:
            yield f"{name} did not act: the walk ended at {trajectory.t_end:.4g} s"
        for arc in arcs:
            if step in (0, arc.mode.step):
                yield from _beside(name, times, 0.0 if step == 0 else arc.mode.start, step > 0, arc)
            elif arc.mode.step == step - 1:
                yield from _just_after(name, times, arc)


def _beside(name: str, times: list[float], origin: float, bound: bool, arc: Arc) -> Iterator[str]:
    """Sentences on edges beside the impact that ends an arc, and on those that it cut off.

    times, origin: edges [s] counted from the time origin [s]. bound: they belong to this single support, so
    that what comes after the impact does not act.
    """
    assert arc.event is not None
    end = arc.event.t - origin
    near = [s for s in times if s > 0.0 and abs(s - end) <= NEAR]
    late = [s for s in times if s > end + NEAR]
    impact = f"the impact at {end:.4f} s"
    for s in near:
        yield _at_impact(name, s, impact)
    if bound and late and not near:
        begun = len(late) < len(times)
        yield f"{name} was cut by {impact}" if begun else f"{name} did not begin before {impact}"


def _just_after(name: str, times: list[float], arc: Arc) -> Iterator[str]:
    """Sentences on edges within `NEAR` after the impact that begins their single support and ends this arc."""
    assert arc.event is not None
    for s in (s for s in times if 0.0 < s <= NEAR):
        yield _at_impact(name, s, f"the impact before it, at {arc.event.t:.4f} s")


def _at_impact(name: str, s: float, impact: str) -> str:
    return f"{name} has the edge at {s:g} s within {1e3 * NEAR:g} ms of {impact}; move it away from there"


def _name(step: int, times: list[float]) -> str:
    """The push as a message names it, by its window and its single support."""
    window = f"from {times[0]:g}" + (f" to {times[-1]:g} s" if len(times) > 1 else " s on")
    return f"the push {window}" + (f" in single support {step}" if step > 0 else "")
