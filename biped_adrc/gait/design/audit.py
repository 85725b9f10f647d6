"""Whether a gait keeps its limits everywhere along the step, by Pinocchio, between the nodes too."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.gait.design.request import GaitRequest, Objective, RobotLimits
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics, ZeroDynamicsOrbit
from biped_adrc.ground import ground_axes
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import PlanarTree
from biped_adrc.types import Array

NODES = 120
SPEED = 1e-4  # largest relative difference to the speed and step asked for


class Audited(NamedTuple):
    """The periodic step at many nodes."""

    orbit: ZeroDynamicsOrbit
    delta2: float
    length: float
    """Between the feet [m]."""
    F_T: Array
    """Along the ground (K,) [N]."""
    F_N: Array
    """Out of it [N]."""
    height: Array
    """Of the swing foot over the ground (K,) [m]."""


def audited(biped: Biped, gait: Gait, nodes: int = NODES) -> Audited:
    """The step of a gait. Raises GaitError when its zero dynamics have none."""
    zero = ZeroDynamics.of(biped, gait.constraint, nodes)
    o = zero.cycle
    along, out = ground_axes(gait.slope)
    height = np.array([biped.swing_foot(q) @ out for q in o.q])
    length = float(np.hypot(*biped.swing_foot(gait.q_minus)))
    reaction = o.ground_reaction
    return Audited(o, zero.delta**2, length, reaction @ along, reaction @ out, height)


def objective_of(biped: Biped, objective: Objective, a: Audited) -> float:
    """The objective along the step, in its units."""
    o = a.orbit
    match objective:
        case Objective.TORQUE:
            return float(np.sum(o.u**2, axis=1) @ o.time_weights) / a.length
        case Objective.TRANSPORT:
            power = np.sum(np.abs(o.u * o.v[:, : biped.p]), axis=1)
            return float(power @ o.time_weights) / (biped.weight * a.length)
        case Objective.PEAK:
            return float(np.max(np.abs(o.u)))


def missed_limits(
    biped: Biped, gait: Gait, limits: RobotLimits, a: Audited | None = None
) -> tuple[str, ...]:
    """What the periodic step of the gait misses; empty when it keeps all limits.

    Friction, torque and ranges are held against the limits themselves, of which the design keeps a reserve;
    F_N, clearance and lift-off, which have none, against what the reserve leaves of them.
    """
    a = audited(biped, gait) if a is None else a
    o, c, left = a.orbit, gait.constraint, 1.0 - limits.reserve
    along, out = ground_axes(gait.slope)
    impact = biped.impact(gait.q_minus, gait.v_minus)
    P_T, P_N = float(along @ impact.impulse), float(out @ impact.impulse)
    s = (o.theta - c.theta_plus) / (c.theta_minus - c.theta_plus)
    hump = (limits.clearance or 0.0) * PlanarTree.of(biped).leg * 16.0 * (s * (1.0 - s)) ** 2
    came_down = -float(out @ biped.swing_foot_velocity(gait.q_minus, gait.v_minus))
    rates = np.abs(o.v @ c.phase)
    slowest = float(np.min(rates) / abs(c.phase @ gait.v_minus))
    lifted = float(impact.old_foot_velocity @ out)
    found = [
        ("F_N", np.min(a.F_N), left * limits.normal_force * biped.weight, "N"),
        ("friction left", np.min(limits.friction * a.F_N - np.abs(a.F_T)), 0.0, "N"),
        ("torque left", limits.torque - np.max(np.abs(o.u)), 0.0, "N m"),
        ("downward speed of the swing foot", came_down, left * limits.lift_off, "m/s"),
        ("upward speed of the old foot", lifted, left * limits.lift_off, "m/s"),
        ("slowest rate over that before impact", slowest, left * limits.slowest, ""),
        ("stability left, limit - delta^2", limits.multiplier - a.delta2, -1e-6, ""),
        ("normal impulse", P_N, 0.0, "N s"),
    ]
    if limits.clearance is not None:
        found.append(("swing foot over its hump", np.min(a.height - left * hump), 0.0, "m"))
    if np.isfinite(limits.impulse_friction):
        found.append(
            ("impulse friction left", limits.impulse_friction * P_N - abs(P_T), 0.0, "N s")
        )
    for joint, (low, high) in limits.ranges.items():
        angle = o.q[:, biped.description.joint_index(joint)]
        found.append((f"{joint} above its least", np.min(angle) - low, 0.0, "rad"))
        found.append((f"{joint} below its largest", high - np.max(angle), 0.0, "rad"))
    return tuple(
        f"{name} is {value:.3g} {unit}".rstrip() + f", expected at least {least:.3g}"
        for name, value, least, unit in found
        if not value >= least
    )


def missed_wishes(request: GaitRequest, a: Audited) -> tuple[str, ...]:
    """Where speed and step are not those asked for."""
    reached = {
        "speed": (request.speed, a.length / a.orbit.period),
        "step": (request.step, a.length),
    }
    return tuple(
        f"the {name} is {found:.6g}, asked {asked:.6g}"
        for name, (asked, found) in reached.items()
        if asked is not None and not abs(found - asked) <= SPEED * asked
    )
