"""Gait (a): the virtual constraint whose periodic orbit passes through a given pre-impact state.

Bezier curves of degree M over Theta. End points and end slopes come from the state x- = (q, q') and from its
impact x+, so that the constraint is hybrid-invariant:

    h(Theta-) = q_b-,  h'(Theta-) = q_b'- / Theta'-,   h(Theta+) = q_b+,  h'(Theta+) = q_b'+ / Theta'+

The M - 3 coefficients left per joint minimise the torque int u'u dt, a sum of squares, with the periodicity
condition sigma-^2 - sigma+^2 = 2 W of the zero dynamics and the limits of friction, torque, clearance and
knees as weighted residuals (Gauss-Newton, SciPy's least_squares); then the periodicity condition is solved to
round-off.

This makes the paper's gait (`published`). For gaits of a given speed or step there is `gait.design`, which
takes limits as constraints and needs no state.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.errors import GaitError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Bezier
from biped_adrc.gait.zero_dynamics import ZeroDynamics, ZeroDynamicsOrbit
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes
from biped_adrc.types import Array

_SLOWEST = 0.05
"""Least sigma^2 during the step over that before impact, dimensionless: the step must not nearly stop."""
_TORQUE_SCALE = 1e3
"""Typical int u'u dt of a step [N^2 m^2 s], by which the torque residuals are scaled to about 1."""
_CLOSURE_WEIGHT = 300.0
"""Weight of the relative closure against the scaled torque."""
_LIMIT_WEIGHT = 10.0
"""Weight of a violated limit against the scaled torque."""
_LIMIT_TOLERANCE = 5e-3
"""Largest violation of a limit in the end, scaled as in `margins`: half a newton, half a millimetre."""


@dataclass(frozen=True)
class GaitLimits:
    """What the designed step must keep; the certificate of the simulated step is the test of it."""

    friction: float = 0.55
    """|F_T| / F_N, below the 0.6 of dry friction."""
    torque: float = 140.0
    """[N m], below RABBIT's 150."""
    normal_force: float = 50.0
    """[N], F_N above it."""
    clearance: float = 0.015
    """[m], height of the swing foot in the middle of the step."""
    knee: float = -0.02
    """[rad], both knees stay below it."""


def onto_section(biped: Biped, q: Array, slope: float = 0.0) -> Array:
    """The configuration (n,) [rad] nearest to q (n,) whose swing foot is on ground of `slope` [rad].

    Newton's method on the foot's height moves the driven joints q_b only, by the least change; the last
    coordinate q_N is kept. Raises GaitError when no configuration near q reaches the ground.
    """
    q = np.array(q, dtype=float)
    normal = ground_axes(slope)[1]
    for _ in range(30):
        height = float(normal @ biped.swing_foot(q))
        row = (normal @ biped.swing_foot_jacobian(q))[:-1]
        if abs(height) < 1e-15 or not row @ row > 1e-12:
            break
        q[:-1] -= row * height / (row @ row)
    if not abs(height) < 1e-12:
        raise GaitError(
            f"the swing foot stays {height:.3g} m off the ground: no configuration near this one reaches it"
        )
    return q


@dataclass(frozen=True)
class _Problem:
    """The least-squares problem for the free coefficients f (p * (M - 3),) [rad], inner points of the curve."""

    biped: Biped
    fixed: Array
    """Coefficients (p, M + 1) [rad] for f = 0, of which the two at each end are given by state and impact."""
    phase: Array
    """c (n,)."""
    theta_plus: float
    theta_minus: float
    """Theta+ and Theta- [rad]."""
    sigma_plus: float
    sigma_minus: float
    """Angular momentum about the stance foot after and before impact [kg m^2/s]."""
    limits: GaitLimits

    def constraint(self, f: Array) -> VirtualConstraint:
        """The curve for f: the fixed coefficients with f added to the inner ones."""
        alpha = self.fixed.copy()
        alpha[:, 2:-2] += f.reshape(alpha.shape[0], -1)
        return VirtualConstraint(Bezier(alpha), self.phase, self.theta_plus, self.theta_minus)

    def zero_dynamics(self, f: Array) -> ZeroDynamics:
        """The quadratures along the curve for f."""
        return ZeroDynamics.of(self.biped, self.constraint(f))

    def closure(self, f: Array) -> float:
        """Gap of the periodicity condition, ((sigma-^2 - sigma+^2) / 2 - W) / sigma-^2; zero on an orbit."""
        gap = 0.5 * (self.sigma_minus**2 - self.sigma_plus**2) - self.zero_dynamics(f).work
        return gap / self.sigma_minus**2

    def residuals(self, f: Array) -> Array:
        """Residuals of the least squares: sqrt(dt) u at the nodes, the closure, and violations of limits."""
        z = self.zero_dynamics(f)
        o = z.orbit(self.sigma_plus, _SLOWEST * self.sigma_minus**2)
        torque = o.u * np.sqrt(np.abs(o.time_weights) / _TORQUE_SCALE)[:, np.newaxis]
        missed = np.minimum(np.concatenate(list(self.margins(z, o).values())), 0.0)
        return np.concatenate(
            (torque.ravel(), [_CLOSURE_WEIGHT * self.closure(f)], _LIMIT_WEIGHT * missed)
        )

    def margins(self, z: ZeroDynamics, o: ZeroDynamicsOrbit) -> dict[str, Array]:
        """Distance to each limit at the nodes (K,), scaled to about 1; negative where it is violated."""
        limits = self.limits
        F_T, F_N = o.ground_reaction.T
        s = (o.theta - self.theta_plus) / (self.theta_minus - self.theta_plus)
        clearance = limits.clearance * np.sin(np.pi * s)
        return {
            "friction": (limits.friction * F_N - np.abs(F_T)) / 100.0,
            "normal force": (F_N - limits.normal_force) / 100.0,
            "torque": (limits.torque - np.max(np.abs(o.u), axis=1)) / 100.0,
            "foot clearance": (o.swing_height - clearance) * 10.0,
            "knee angle": limits.knee - np.max(o.q[:, 2:4], axis=1),
            "progress": z.sigma_squared(self.sigma_plus) / self.sigma_minus**2 - _SLOWEST,
        }


def _problem(biped: Biped, q: Array, v: Array, degree: int, limits: GaitLimits) -> _Problem:
    """The problem through (q, v), each (n,). Raises GaitError unless Theta runs one way, before and after."""
    impact = biped.impact(q, v)
    c, p = biped.phase, biped.p
    theta_plus, theta_minus = float(c @ impact.q), float(c @ q)
    rate_plus, rate_minus = float(c @ impact.v), float(c @ v)
    span = theta_minus - theta_plus
    if rate_plus * span <= 0 or rate_minus * span <= 0:
        raise GaitError(
            f"Theta runs from {theta_plus:.4g} to {theta_minus:.4g} rad, but its rate is "
            f"{rate_plus:.4g} rad/s after and {rate_minus:.4g} rad/s before impact; all three need one sign"
        )
    slopes = impact.v[:p] / rate_plus * span, v[:p] / rate_minus * span
    return _Problem(
        biped,
        Bezier.between(impact.q[:p], *slopes, q[:p], degree),
        c,
        theta_plus,
        theta_minus,
        biped.angular_momentum(impact.q, impact.v),
        biped.angular_momentum(q, v),
        limits,
    )


def constraint_through(
    biped: Biped,
    q: Array,
    v: Array,
    degree: int = 6,
    limits: GaitLimits | None = None,
    max_evaluations: int = 100,
) -> VirtualConstraint:
    """The constraint of least torque whose periodic orbit passes through x- = (q, v).

    q: (n,) [rad], with the swing foot on the ground (see `onto_section`). v: (n,) [rad/s]. degree: M >= 4 of
    the Bezier curves, of which M - 3 coefficients per joint are free. Raises GaitError when no curve of this
    degree keeps the limits, naming the worst one.
    """
    if degree < 4:
        raise GaitError(f"degree is {degree}; at least 4 is needed to have a free coefficient")
    height = float(biped.swing_foot(q)[1])
    if abs(height) > 1e-9:
        raise GaitError(
            f"the swing foot of the state is {height:.3g} m above the ground; move it with onto_section"
        )
    from scipy.optimize import least_squares  # takes long to load

    problem = _problem(biped, q, v, degree, limits or GaitLimits())
    # Gauss-Newton, closure and limits as weighted residuals
    start = np.zeros(biped.p * (degree - 3))
    options = {"x_scale": 0.1, "ftol": 1e-8, "max_nfev": max_evaluations}
    f = _close(problem, least_squares(problem.residuals, start, **options).x)
    _check_limits(problem, f)
    return problem.constraint(f)


def _check_limits(problem: _Problem, f: Array) -> None:
    """Raise GaitError where the curve for f violates a limit by more than the tolerance, naming the worst."""
    z = problem.zero_dynamics(f)
    margins = problem.margins(z, z.orbit(problem.sigma_plus, _SLOWEST * problem.sigma_minus**2))
    worst = min(margins, key=lambda name: float(np.min(margins[name])))
    if np.min(margins[worst]) < -_LIMIT_TOLERANCE:
        raise GaitError(
            f"no gait through this state keeps the limits: {worst} misses by "
            f"{-np.min(margins[worst]):.3g} (scaled). Loosen GaitLimits or raise the degree"
        )


def _close(problem: _Problem, f: Array) -> Array:
    """f (p * (M - 3),) moved along the gradient of the closure until the orbit is periodic to round-off.

    Least squares leaves a closure of about 1e-6, since it trades it against torque.
    """
    from scipy.optimize import brentq

    base, step = problem.closure(f), 1e-7
    direction = np.array([(problem.closure(f + step * e) - base) / step for e in np.eye(len(f))])
    direction /= direction @ direction
    reach = 4.0 * abs(base) + 1e-9
    r = brentq(lambda a: problem.closure(f + a * direction), -reach, reach, xtol=1e-16)
    closed: Array = f + r * direction
    return closed
