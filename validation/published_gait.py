"""The gait (a) of the paper: the Bezier constraint of least torque whose periodic orbit passes through x*.

End points and end slopes come from the state x- = (q, q') and from its impact x+, so that the constraint is
hybrid-invariant:

    h(Theta-) = q_b-,  h'(Theta-) = q_b'- / Theta'-,   h(Theta+) = q_b+,  h'(Theta+) = q_b'+ / Theta'+

The M - 3 coefficients left per joint minimise int u'u dt, a sum of squares, with the periodicity condition
sigma-^2 - sigma+^2 = 2 W of the zero dynamics and the limits as weighted residuals (Gauss-Newton); then the
periodicity condition is solved to round-off. It made the files `published` of `gaits/`; other gaits through a
state are those of `ba.design_gait(through=...)`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares

from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Bezier
from biped_adrc.gait.gait import Gait, onto_section
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped

DEGREE = 6
SLOWEST = 0.05
"""Least sigma^2 during the step over that before impact: the step must not nearly stop."""
TORQUE_SCALE = 1e3
"""Typical int u'u dt of a step [N^2 m^2 s]."""
CLOSURE_WEIGHT, LIMIT_WEIGHT = 300.0, 10.0
"""Of the relative closure and of a violated limit against the scaled torque."""
FRICTION, TORQUE, NORMAL_FORCE, CLEARANCE, KNEE = 0.55, 140.0, 50.0, 0.015, -0.02
"""Limits: |F_T| / F_N, [N m], [N], [m] of the swing foot in the middle of the step, [rad]."""


@dataclass(frozen=True)
class Through:
    """The least-squares problem for the free coefficients f (p (M - 3),) [rad], inner points of the curve."""

    biped: Biped
    fixed: Array
    """Coefficients (p, M + 1) [rad] for f = 0."""
    theta: tuple[float, float]
    """Theta+ and Theta- [rad]."""
    sigma: tuple[float, float]
    """Angular momentum about the stance foot after and before impact [kg m^2/s]."""

    @classmethod
    def of(cls, biped: Biped, q: Array, v: Array) -> Through:
        """The problem through (q, v), each (n,) [rad, rad/s], the swing foot on the ground."""
        impact = biped.impact(q, v)
        c, p = biped.phase, biped.p
        theta = float(c @ impact.q), float(c @ q)
        span = theta[1] - theta[0]
        slopes = impact.v[:p] / float(c @ impact.v) * span, v[:p] / float(c @ v) * span
        sigma = biped.angular_momentum(impact.q, impact.v), biped.angular_momentum(q, v)
        return cls(biped, Bezier.between(impact.q[:p], *slopes, q[:p], DEGREE), theta, sigma)

    def constraint(self, f: Array) -> VirtualConstraint:
        """The curve for f: the fixed coefficients with f added to the inner ones."""
        alpha = self.fixed.copy()
        alpha[:, 2:-2] += f.reshape(alpha.shape[0], -1)
        return VirtualConstraint(Bezier(alpha), self.biped.phase, *self.theta)

    def closure(self, f: Array) -> float:
        """Gap of the periodicity condition, ((sigma-^2 - sigma+^2) / 2 - W) / sigma-^2."""
        before, after = self.sigma[1], self.sigma[0]
        work = ZeroDynamics.of(self.biped, self.constraint(f)).work
        return (0.5 * (before**2 - after**2) - work) / before**2

    def residuals(self, f: Array) -> Array:
        """sqrt(dt) u at the nodes, the closure, and violations of limits, scaled to about 1."""
        z = ZeroDynamics.of(self.biped, self.constraint(f))
        o = z.orbit(self.sigma[0])
        F_T, F_N = o.ground_reaction.T
        s = (o.theta - self.theta[0]) / (self.theta[1] - self.theta[0])
        height = np.array([self.biped.swing_foot(q)[1] for q in o.q])
        margins = (
            (FRICTION * F_N - np.abs(F_T)) / 100.0,
            (F_N - NORMAL_FORCE) / 100.0,
            (TORQUE - np.max(np.abs(o.u), axis=1)) / 100.0,
            (height - CLEARANCE * np.sin(np.pi * s)) * 10.0,
            KNEE - np.max(o.q[:, 2:4], axis=1),
            z.sigma_squared(self.sigma[0]) / self.sigma[1] ** 2 - SLOWEST,
        )
        torque = o.u * np.sqrt(np.abs(o.time_weights) / TORQUE_SCALE)[:, np.newaxis]
        missed = LIMIT_WEIGHT * np.minimum(np.concatenate(margins), 0.0)
        return np.concatenate((torque.ravel(), [CLOSURE_WEIGHT * self.closure(f)], missed))

    def closed(self, f: Array) -> Array:
        """f moved along the gradient of the closure until the orbit is periodic to round-off."""
        base, step = self.closure(f), 1e-7
        direction = np.array([(self.closure(f + step * e) - base) / step for e in np.eye(len(f))])
        direction /= direction @ direction
        reach = 4.0 * abs(base) + 1e-9
        r = brentq(lambda a: self.closure(f + a * direction), -reach, reach, xtol=1e-16)
        moved: Array = f + r * direction
        return moved


def design_published_gait(biped: Biped) -> Gait:
    """Gait (a) of a preset of RABBIT."""
    q, v = onto_section(biped, X_STAR[: biped.n]), np.array(X_STAR[biped.n :])
    problem = Through.of(biped, q, v)
    start = np.zeros(biped.p * (DEGREE - 3))
    found = least_squares(problem.residuals, start, x_scale=0.1, ftol=1e-8, max_nfev=100)
    constraint = problem.constraint(problem.closed(found.x))
    zero = ZeroDynamics.of(biped, constraint)
    orbit = zero.orbit(biped.angular_momentum(q, v) * zero.delta)
    moved = np.max(np.abs(q - X_STAR[: biped.n]))
    provenance = {
        "method": "Bezier virtual constraint whose periodic orbit passes through the published x*",
        "source": f"x* of the paper, section VI; q1..q4 moved onto the ground by at most {moved:.2g} rad",
        "command": "python -m validation.gaits",
    }
    robot, preset = biped.description.name, biped.preset
    return Gait("published", robot, preset, constraint, q, v, orbit.period, provenance)
