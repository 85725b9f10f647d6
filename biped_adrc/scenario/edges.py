"""What became of the edges of a disturbance: a window that an impact cuts off acts for less time than asked.

When the impacts come is known once the walk is made, and depends on the push. A walk is therefore not refused;
it says what was not as it was asked for, and where its steps were too long for the edges.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.disturbances.base import Disturbance, terms
from biped_adrc.hybrid.trajectory import Arc, Trajectory

NEAR = 1e-3
"""[s], the usual step: an edge this close to an impact is before or after it by the error of the method."""
LONGER = 1.1
"""A step may be so many times the observer's shortest time constant: beyond 1 for round-off in its poles."""


def edge_remarks(walker: Walker, trajectory: Trajectory) -> tuple[str, ...]:
    """A sentence for each window that an impact cuts off, that never opens, or with an edge at an impact.

    An edge within `NEAR` of an impact is named on both sides of it. One at s = 0 of a single support is not: it
    is how "from the impact on" is written.
    """
    if walker.disturbance is None:
        return ()
    parts = (_edges(part) for part in terms(walker.disturbance))
    found = [remark for edges in parts for remark in _remarks(edges, trajectory)]
    return tuple(dict.fromkeys(found))


def step_remarks(walker: Walker, trajectory: Trajectory) -> tuple[str, ...]:
    """A sentence where steps of a fixed length are too long for the observer's error after an edge.

    In the coordinates of `Walker.split` that error decays with the observer's poles. Where the step is longer
    than 1 / |p| of the fastest one, what is left after an edge is mostly the method's. Single supports with an
    edge are looked at, and those after them.
    """
    if walker.disturbance is None or "rtol" in trajectory.settings.get("method", ""):
        return ()
    split = walker.split(Mode())
    if split is None:
        return ()
    edges = [step for part in terms(walker.disturbance) for step in _edges(part)]
    constant = 1.0 / float(np.max(np.abs(np.linalg.eigvals(split.A))))
    longest = max((_longest(a) for a in trajectory.arcs if _beside_edge(a, edges)), default=0.0)
    if longest <= LONGER * constant:
        return ()
    return (
        f"the step of {1e3 * longest:.3g} ms beside the edges of the push is longer than the shortest time "
        f"constant of the observer ({1e3 * constant:.2g} ms): the largest errors may be mostly errors of "
        "integration; give a step as short as that, or the compiled engine and no step",
    )


def _beside_edge(arc: Arc, edges: list[int]) -> bool:
    return bool({0, arc.mode.step, arc.mode.step - 1}.intersection(edges))


def _longest(arc: Arc) -> float:
    return float(np.max(np.diff(arc.t), initial=0.0))


def _edges(disturbance: Disturbance) -> dict[int, list[float]]:
    """Edges s [s] by single support, from its start; by 0 from the start of the run."""
    edges: dict[int, list[float]] = {}
    for step, s in disturbance.switches:
        edges.setdefault(step, []).append(s)
    return {step: sorted(times) for step, times in edges.items()}


def _remarks(edges: dict[int, list[float]], trajectory: Trajectory) -> Iterator[str]:
    arcs = [a for a in trajectory.arcs if a.event is not None and a.event.guard == FOOT_STRIKE]
    walked = {arc.mode.step for arc in trajectory.arcs}
    for step, times in edges.items():
        name = _name(step, times)
        if step > 0 and step not in walked and trajectory.status.ok:
            yield f"{name} did not act: the walk has no single support {step}"
        for arc in arcs:
            if step in (0, arc.mode.step):
                yield from _beside(name, times, 0.0 if step == 0 else arc.mode.start, step > 0, arc)
            elif arc.mode.step == step - 1:
                yield from _just_after(name, times, arc)


def _beside(name: str, times: list[float], origin: float, bound: bool, arc: Arc) -> Iterator[str]:
    """Edges beside the impact that ends an arc; bound: to its single support, which cuts off what is left."""
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
    """Edges beside the impact that begins their single support and ends this arc."""
    assert arc.event is not None
    for s in (s for s in times if 0.0 < s <= NEAR):
        yield _at_impact(name, s, f"the impact before it, at {arc.event.t:.4f} s")


def _at_impact(name: str, s: float, impact: str) -> str:
    return f"{name} has the edge at {s:g} s within {1e3 * NEAR:g} ms of {impact}; move it away from there"


def _name(step: int, times: list[float]) -> str:
    window = f"from {times[0]:g}" + (f" to {times[-1]:g} s" if len(times) > 1 else " s on")
    return f"the push {window}" + (f" in single support {step}" if step > 0 else "")
