"""Signals of a walk on another plant, where motion and forces of the ground are recorded and not computed.

    q'' by differences from tick to tick,   F of the ground as recorded,   xi = q_b'' - kappa u

What the controller is given and does follows from the states as on the rigid plant. xi~ = D q'' + Omega - B_s u
then holds all that the pinned model does not know: the touchdown's force, a foot that gives way.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.closed_loop.feet import NAMES
from biped_adrc.closed_loop.instant_signals import InstantSignals
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.reduction import disturbance_parts, unknown_force

FORCE, PLACE, SPEED = NAMES
"""What an arc has `read` of the feet, (K, 4) each."""


def recorded(trajectory: Trajectory, name: str) -> Array | None:
    """What was recorded of the feet at all K nodes of a walk (K, 4); None for a walk on the rigid plant."""
    if any(name not in arc.read for arc in trajectory.arcs):
        return None
    return np.vstack([arc.read[name] for arc in trajectory.arcs])


def footholds(walker: Walker, trajectory: Trajectory) -> Array:
    """x and z [m] of the stance foot at the start of each arc (arcs, 2): the first stands at x = z = 0, each
    impact moves it by p_2(q-), the swing foot; on soft ground as recorded.
    """
    foot, feet, plant = np.zeros(2), [], walker.plant
    for arc in trajectory.arcs:
        feet.append(arc.read[PLACE][0, :2] if PLACE in arc.read else foot)
        if arc.event is not None and arc.event.x_plus is not None:
            foot = foot + plant.swing_foot(arc.event.x_minus[: plant.n])
    return np.array(feet)


def as_recorded(walker: Walker, trajectory: Trajectory, found: InstantSignals) -> InstantSignals:
    """The readings at all nodes with q'', ground force, momentum and xi of the plant that walked, in place of
    the rigid one's.

    Forces from outside are added to that of the ground, as `InstantSignals` has it.
    """
    force, speed = recorded(trajectory, FORCE), recorded(trajectory, SPEED)
    if force is None or speed is None:
        return found
    n, p, arcs = walker.plant.n, walker.plant.p, trajectory.arcs
    x, a = np.vstack([arc.x for arc in arcs]), np.vstack([accelerations(arc, n) for arc in arcs])
    outside = [walker.resultant(float(t), arc.mode) for arc in arcs for t in arc.seen]
    rows = []
    for x_k, a_k, u in zip(x, a, found.u, strict=True):
        terms = walker.nominal.reduction(x_k[:n], x_k[n : 2 * n])
        matched, unmatched = disturbance_parts(terms, unknown_force(terms, a_k, u))
        rows.append((a_k[:p] - terms.kappa @ u, matched + unmatched, matched, terms.xi))
    xi, external, matched, nominal = map(np.array, zip(*rows, strict=True))
    return found._replace(
        a=a,
        xi=xi,
        xi_external=external,
        xi_matched=matched,
        xi_nominal=nominal,
        ground_reaction=force[:, :2] + np.array(outside),
        momentum=found.momentum + walker.plant.mass * speed[:, :2],
    )


def accelerations(arc: Arc, n: int) -> Array:
    """q'' (K, n) [rad/s^2] at the nodes of an arc, by differences of rates.

    In a stretch of less than SAME_INSTANT, as where a push ends at a tick but for round-off, a difference is
    round-off too: there it is that of the stretch before, or after it at the start.
    """
    ways = np.diff(arc.t)
    short = (ways > 0.0) & (ways < SAME_INSTANT)
    bad = np.append(short, False) | np.append(False, short)
    good = np.flatnonzero(~bad)
    if len(good) == 0:
        return arc.dx[:, n : 2 * n]
    before = np.searchsorted(good, np.arange(len(arc.t)), side="right") - 1
    return arc.dx[good[np.maximum(before, 0)], n : 2 * n]
