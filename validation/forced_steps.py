"""A walk under a constant horizontal force on the hip, step by step, by quadrature.

How large a constant force stops a gait, if tracking were perfect? F_x [N] at the hip of height
z_hip enters the unactuated row, sigma' = -G_N - z_hip F_x. With exact tracking

    sigma^2 / 2 + V_F = const in a step,   V_F(Theta) = int_{Theta+}^{Theta} (G_N + z_hip F_x) I dTheta

so that, with zeta = sigma-^2 / 2 before an impact and delta = sigma+ / sigma- across it, the step
after it is

    zeta  ->  delta^2 zeta - V_F(Theta-),   T = int |I| / sqrt(2 (delta^2 zeta - V_F)) dTheta,

and is finished if delta^2 zeta > max V_F. The force changes no impact: delta is that of the gait.
With F_x = 0 these are the zero dynamics of Westervelt, Grizzle, Koditschek, IEEE TAC 48(1), 2003.
Around them the PI of `control.stride` sets beta from step to step. No tracking law appears: what
stops this walk stops it under any controller that tracks the same constraint.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.stride_gain import bumped
from biped_adrc.control.stride import StridePI, StrideState
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics, gauss_nodes
from biped_adrc.gait.zero_orbits import series
from biped_adrc.model.biped import Biped

NODES = 400
"""Number of Gauss nodes of T; a step that nearly comes to rest needs more of them than V_F does."""
LONGEST = 2.0
"""Step that stops a walk [s]."""
LARGEST = 1e3
"""Force at which the search for one that stops a walk gives up [N]."""
RESOLUTION = 1e-3
"""Accuracy of that search [N]."""


class ForcedStep(NamedTuple):
    """One finished step: its mean speed, the correction and the energy-like state at its end."""

    speed: float
    """Mean speed L / T [m/s]."""
    beta: float
    """Correction of the PI during the step [rad]."""
    zeta: float
    """sigma-^2 / 2 at its end [kg^2 m^4/s^2]."""


class ForcedCurve(NamedTuple):
    """The integrand of one step under a force, at Gauss nodes along Theta."""

    inertia: Array
    """|I(Theta)| (NODES,) [kg m^2], with dTheta/dt = sigma / I."""
    potential: Array
    """V_F(Theta) (NODES,) [kg^2 m^4/s^2]."""
    end: float
    """V_F(Theta-) [kg^2 m^4/s^2]."""
    weights: Array
    """Weights of the quadrature in |Theta| (NODES,) [rad]."""

    @classmethod
    def of(cls, biped: Biped, h: VirtualConstraint, force: float) -> ForcedCurve:
        """V_F of one virtual constraint under F_x = force [N]."""
        zero = ZeroDynamics.of(biped, h)
        height = np.array([biped.hip(q)[1] for q in zero.q])
        slope = series(zero, (zero.gravity + force * height) * zero.inertia)
        V, span = slope.integ(lbnd=h.theta_plus), h.theta_minus - h.theta_plus
        s, w, _ = gauss_nodes(NODES)
        theta = h.theta_plus + span * s
        inertia = np.abs(series(zero, zero.inertia)(theta))
        return cls(inertia, V(theta), float(V(h.theta_minus)), abs(span) * w)

    def duration(self, begin: float) -> float:
        """T [s] of the step with sigma+^2 / 2 = begin [kg^2 m^4/s^2]; infinite where it is not finished."""
        square = 2.0 * (begin - self.potential)
        if not min(float(np.min(square)), begin - self.end) > 0.0:
            return math.inf
        return float(self.weights @ (self.inertia / np.sqrt(square)))


def forced_walk(
    gait: Gait,
    biped: Biped,
    force: float,
    steps: int,
    stride: StridePI | None = None,
) -> tuple[ForcedStep, ...]:
    """The finished steps, at most `steps`, from the gait's orbit on, under F_x = force [N] from the start.

    stride: the PI from step to step; the controller inside it plays no part. A step longer than
    LONGEST stops the walk. Raises InputError for a gait on a slope, GaitError for one
    without a periodic orbit.
    """
    _check_level(gait)
    zero = ZeroDynamics.of(biped, gait.constraint)
    delta2, zeta = zero.delta**2, 0.5 * zero.sigma_minus**2
    length = float(np.hypot(*biped.swing_foot(gait.q_minus)))
    curve = ForcedCurve.of(biped, gait.constraint, force)
    w, done = StrideState(0.0, 0.0, 0.0), list[ForcedStep]()
    for _ in range(steps):
        if stride is not None:
            h = bumped(gait.constraint, w.beta * np.array(stride.direction))
            curve = ForcedCurve.of(biped, h, force)
        T = curve.duration(delta2 * zeta)
        if not LONGEST >= T:
            break
        zeta = delta2 * zeta - curve.end
        done.append(ForcedStep(length / T, float(w.beta), zeta))
        if stride is not None:
            w = stride.stepped(w._replace(tau=T))
    return tuple(done)


def stopping_force(gait: Gait, biped: Biped, steps: int, stride: StridePI | None = None) -> float:
    """The smallest rearward force -F_x [N] that stops the walk within `steps` steps, to RESOLUTION.

    Raises as `forced_walk`, and GaitError where the gait fails without a force, or survives the
    largest.
    """

    def walks(force: float) -> bool:
        return len(forced_walk(gait, biped, -force, steps, stride)) == steps

    low, high = 0.0, 1.0
    if not walks(low):
        raise GaitError(
            f"gait '{gait.name}' does not make {steps} steps without a force; expected a walk that lasts"
        )
    while walks(high):
        low, high = high, 2.0 * high
        if high > LARGEST:
            raise GaitError(
                f"gait '{gait.name}' makes {steps} steps under {low:g} N; expected a force that stops it, ask "
                "for more steps"
            )
    while high - low > RESOLUTION:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if walks(middle) else (low, middle)
    return high


def _check_level(gait: Gait) -> None:
    """Raise InputError for a gait on a slope."""
    if gait.slope:
        raise InputError(
            f"gait '{gait.name}' walks on a slope of {gait.slope} rad, expected level ground"
        )
