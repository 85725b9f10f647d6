"""Whether a gait keeps its limits everywhere along the step, by Pinocchio, between the nodes too."""

from __future__ import annotations

import numpy as np

from biped_adrc.gait.design.request import Limits
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped

NODES = 120


def missed_limits(biped: Biped, gait: Gait, limits: Limits, nodes: int = NODES) -> tuple[str, ...]:
    """What the periodic step of the gait misses, without the reserve; empty when it keeps all limits."""
    zero = ZeroDynamics.of(biped, gait.constraint, nodes)
    o = zero.orbit(zero.sigma_minus * zero.delta)
    sin, cos = np.sin(gait.slope), np.cos(gait.slope)
    F_T, F_N = o.ground_reaction @ (cos, -sin), o.ground_reaction @ (sin, cos)
    impact = biped.impact(gait.q_minus, gait.v_minus)
    P_T, P_N = (float(np.dot(row, impact.impulse)) for row in ((cos, -sin), (sin, cos)))
    height = np.array([biped.swing_foot(q) @ (sin, cos) for q in o.q])
    lifted = float(impact.old_foot_velocity @ (sin, cos))
    found = [
        ("F_N", np.min(F_N), 0.0, "N"),
        ("friction left", np.min(limits.friction * F_N - np.abs(F_T)), 0.0, "N"),
        ("torque left", limits.torque - np.max(np.abs(o.u)), 0.0, "N m"),
        ("speed of the old foot", lifted, 0.0, "m/s"),
    ]
    if limits.clearance is not None:
        found.append(("swing foot height", np.min(height), 0.0, "m"))
    if np.isfinite(limits.impulse_friction):
        found.append(
            ("impulse friction left", limits.impulse_friction * P_N - abs(P_T), 0.0, "N s")
        )
    for joint, (low, high) in limits.ranges.items():
        angle = o.q[:, biped.description.joint_index(joint)]
        found.append((f"{joint} above its least", np.min(angle) - low, 0.0, "rad"))
        found.append((f"{joint} below its largest", high - np.max(angle), 0.0, "rad"))
    return tuple(
        f"{name} is {value:.3g} {unit}" for name, value, least, unit in found if not value >= least
    )
