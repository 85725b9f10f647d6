"""What may be seen of a live walk at the end of a sample: error, estimate, torques, forces of the ground.

    xi = q_b'' - kappa u,   e = q_b - q_d

These are the signals of the finished walk (`analysis.signals`) at the same node, without the walk having to
be made first. q'' is the slope of the sample's last node: of the rigid plant its acceleration, of a plant that
moves by itself the difference of rates over the sample.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.feet import OnFeet
from biped_adrc.closed_loop.noticing import estimated
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.closed_loop.stepping_plant import Load, PlantState
from biped_adrc.ground import ground_axes
from biped_adrc.hybrid.simulator import FlownArc
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.live.hand import Hand
from biped_adrc.live.live_walk import LiveWalk
from biped_adrc.live.moving import Moving, Now
from biped_adrc.soft.meters import slipping
from biped_adrc.types import Array


class Carried(NamedTuple):
    """What motors and ground carry at the end of a sample."""

    load: Load
    """What acts from outside, the hand among it."""
    u: Array
    """Torque of the motors (p,) [N m]."""
    ground: Array
    """Force (F_x, F_z) (2,) [N] of the ground on the stance foot."""
    other: Array
    """Force (2,) [N] on the other foot; zero on the rigid plant, NaN where the plant does not say."""
    slips: bool | None
    """Whether a foot slips on soft ground, as `soft.meters` counts it; None where no foot can."""


class Reading(NamedTuple):
    """A live walk at the end of a sample, before the sample instant there."""

    t: float
    """[s]"""
    step: int
    """Number of the single support."""
    q: Array
    """Angles (n,) [rad]."""
    v: Array
    """Rates (n,) [rad/s]."""
    error: Array
    """q_b - q_d of the gait (p,) [rad]."""
    u: Array
    """Torque of the motors (p,) [N m]."""
    zeta: Array
    """Torques from outside, the hand among them (n,) [N m]."""
    xi: Array
    """Total disturbance of the nominal model (p,) [rad/s^2]."""
    xi_estimate: Array
    """What the observer says of it (p,) [rad/s^2]; NaN without one."""
    ground: Array
    """Force (F_x, F_z) (2,) [N] of the ground on the stance foot."""
    other: Array
    """Force (2,) [N] on the other foot; zero on the rigid plant, NaN where the plant does not say."""


def reading(live: LiveWalk, flown: FlownArc, hand: Hand | None) -> Reading:
    """Of a sample that a live walk made under a hand; `live` is the walk before or after it."""
    moving, arc = live.moving, flown.arc
    loop, mode, t, x = moving.loop, arc.mode, float(arc.t[-1]), arc.x[-1]
    q, v, s, tail = parts(loop, x)
    n, p = len(q), moving.walker.plant.p
    load, u, ground, other, _ = carried(live, flown, hand)
    m = loop.measure(t, q, v, mode)
    found = estimated(loop, s, tail, m, mode)
    return Reading(
        t,
        mode.step,
        q,
        v,
        q[:p] - live.scene.walked.constraint(t, q, v).q_d,
        u,
        load.zeta,
        arc.dx[-1][n : n + p] - m.terms.kappa @ u,
        np.full(p, np.nan) if found is None else found,
        ground,
        other,
    )


def carried(live: LiveWalk, flown: FlownArc, hand: Hand | None) -> Carried:
    """Loads, torques and forces of the ground at the end of a sample: a third of the work of `reading`."""
    arc, n = flown.arc, len(live.q)
    mode, t, x = arc.mode, float(arc.t[-1]), arc.x[-1]
    load = acting(live, hand, float(arc.seen[-1]), x[:n], x[n : 2 * n], mode)
    u = live.moving.torque(Now(t, x, mode, mode.start))
    return Carried(load, u, *ground_forces(live, arc, hand, arc.dx[-1][n : 2 * n], load))


def acting(live: LiveWalk, hand: Hand | None, t: float, q: Array, v: Array, mode: Mode) -> Load:
    """What acts from outside at t [s], q (n,) [rad], v (n,) [rad/s]: the scenario's pushes, and the hand."""
    walker = live.moving.walker
    own = Load(walker.external(t, q, v, mode), walker.resultant(t, mode))
    if hand is None:
        return own
    mine = live.moving.points.load(hand, q)
    return Load(own.zeta + mine.zeta, own.force + mine.force)


def ground_forces(
    live: LiveWalk, arc: Arc, hand: Hand | None, a: Array, load: Load
) -> tuple[Array, Array, bool | None]:
    """Forces (2,) [N] of the ground on stance foot and other foot at the end of a sample, and `Carried.slips`.

    a (n,) [rad/s^2], load: q'' and what acts there. A plant that moves by itself is asked, with the load that
    it had over the sample, taken where that began.
    """
    moving, n = live.moving, len(a)
    plant, x = moving.loop.plant, arc.x[-1]
    if isinstance(plant, OnFeet):
        k = max(len(arc.t) - 2, 0)  # a sample that failed at once has one node
        before, t, end = arc.x[k], float(arc.t[k]), float(arc.t[-1])
        held = acting(live, hand, 0.5 * (t + end), before[:n], before[n : 2 * n], arc.mode)
        now = Now(end, x, arc.mode, arc.mode.start)
        state = PlantState(end, x[:n], x[n : 2 * n], moving.own(now))
        force, _, speed = plant.footing(state, asked(moving, x), held)
        axes = ground_axes(moving.walker.slope)
        slips = slipping(force, speed, live.scenario.ground_friction, axes)
        return force[0], force[1], bool(np.any(slips))
    if plant is not moving.walker.plant:
        return np.full(2, np.nan), np.full(2, np.nan), None
    return plant.ground_reaction(x[:n], x[n : 2 * n], a) - load.force, np.zeros(2), None


def asked(moving: Moving, x: Array) -> Array:
    """The torque that is asked of the motors in x (nx,), (p,) [N m]."""
    return x[len(x) - moving.walker.plant.p :]
