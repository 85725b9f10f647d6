"""RABBIT: a published example of its hybrid zero dynamics, beside the gait found here at the same speed.

    zeta = sigma-^2 / 2,   zeta+ = delta^2 zeta - V_zero(Theta-),   zeta* = -V_zero(Theta-) / (1 - delta^2)

Westervelt, Grizzle, Koditschek, IEEE TAC 48(1), 2003, walking at 1.05 m/s.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.control.npd import NPDController
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.gait.zero_orbits import ZeroOrbits
from biped_adrc.hybrid.integrators import Adaptive
from biped_adrc.model.biped import Biped
from biped_adrc.studies.gait_design import DesignedGait, design_gait
from biped_adrc.studies.verification.row import Row, at_most
from biped_adrc.walker import Walker

TAC = "Westervelt, Grizzle, Koditschek 2003, example at 1.05 m/s"
ZETA, DELTA2, V_END, K = 979.0, 0.638, -354.4, 260.4
UNIT = "[kg^2 m^4/s^2]"


def printed_rows() -> tuple[Row, ...]:
    """The printed digits among themselves: the formulae of the zero dynamics are theirs."""
    existence = DELTA2 / (1.0 - DELTA2) * V_END + K
    name = "RABBIT tac2003, 1.05 m/s, as printed"
    return (
        Row(name, f"zeta* = -V / (1 - delta^2) {UNIT}", ZETA, -V_END / (1.0 - DELTA2), 1e-3, TAC),
        at_most(name, f"delta^2 / (1 - delta^2) V + K, orbit exists {UNIT}", 0.0, existence, TAC),
    )


def designed_rows(step: float | None = None) -> tuple[Row, ...]:
    """The gait found at 1.05 m/s beside the example; step [m], None leaves it free."""
    found = design_gait("rabbit", 1.05, step, preset="tac2003")
    biped = Biped.load("rabbit", "tac2003")
    orbits = ZeroOrbits.of(ZeroDynamics.of(biped, found.gait.constraint))
    asked = "" if step is None else f", step {step:g} m"
    name = f"RABBIT tac2003, 1.05 m/s{asked}, designed here"
    beside = (
        ("delta^2", DELTA2, orbits.delta**2),
        (f"V_zero(Theta-) {UNIT}", V_END, orbits.v_end),
        (f"K = max V_zero {UNIT}", K, orbits.v_max),
        (f"zeta* {UNIT}", ZETA, orbits.zeta_star),
    )
    shown = tuple(Row(name, label, printed, value, None, TAC) for label, printed, value in beside)
    return (*shown, *_own_rows(name, found, orbits))


def _own_rows(name: str, found: DesignedGait, orbits: ZeroOrbits) -> tuple[Row, ...]:
    """Of the designed gait alone: its speed, and zeta* against the walk; the torques in the note."""
    gait, biped = found.gait, orbits.zero.biped
    P = ReturnMap(Walker(biped, NPDController(gait.constraint)), Adaptive(1e-10, 1e-10))
    s = P.project(np.concatenate((gait.q_minus, gait.v_minus)))
    sigma = biped.angular_momentum(*np.split(P.lift(P(s)), 2))
    c = found.certificate
    torques = (
        f"peak torque {c.peak_torque:.1f} N m, int u'u dt / step {found.objective:.0f} N^2 m s, step "
        f"{c.step_length:.3f} m, friction {c.friction:.2f}, of the impulse {c.impulse_ratio:.2f}"
    )
    walked, law = f"zeta after a simulated step {UNIT}", "zeta* of its zero dynamics"
    return (
        Row(name, "speed [m/s]", 1.05, found.speed, 1e-6, "as asked", note=torques),
        Row(name, walked, orbits.zeta_star, 0.5 * sigma**2, 1e-6, law),
    )
