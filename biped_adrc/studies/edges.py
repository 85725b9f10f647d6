"""What became of the edges of a disturbance: a window that an impact cuts off acts for less time than asked.

When the impacts come is known once the walk is made, and depends on the push. A walk is therefore not refused;
it says what was not as it was asked for.
"""

from __future__ import annotations

from collections.abc import Iterator

from biped_adrc.disturbances.base import Disturbance, terms
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.walker import FOOT_STRIKE, Walker

NEAR = 1e-3
"""[s], the usual step: an edge this close to an impact is before or after it by the error of the method."""


def edge_remarks(walker: Walker, trajectory: Trajectory) -> tuple[str, ...]:
    """A sentence for each window that an impact cuts off, that never opens, or with an edge at an impact."""
    if walker.disturbance is None:
        return ()
    parts = (_edges(part) for part in terms(walker.disturbance))
    found = [remark for edges in parts for remark in _remarks(edges, trajectory)]
    return tuple(dict.fromkeys(found))


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


def _beside(name: str, times: list[float], origin: float, bound: bool, arc: Arc) -> Iterator[str]:
    """Edges beside the impact that ends an arc; bound: to its single support, which cuts off what is left."""
    assert arc.event is not None
    end = arc.event.t - origin
    near = [s for s in times if s > 0.0 and abs(s - end) <= NEAR]
    late = [s for s in times if s > end + NEAR]
    impact = f"the impact at {end:.4f} s"
    for s in near:
        yield f"{name} has the edge at {s:g} s within {1e3 * NEAR:g} ms of {impact}; move it away from there"
    if bound and late and not near:
        begun = len(late) < len(times)
        yield f"{name} was cut by {impact}" if begun else f"{name} did not begin before {impact}"


def _name(step: int, times: list[float]) -> str:
    window = f"from {times[0]:g}" + (f" to {times[-1]:g} s" if len(times) > 1 else " s on")
    return f"the push {window}" + (f" in single support {step}" if step > 0 else "")
