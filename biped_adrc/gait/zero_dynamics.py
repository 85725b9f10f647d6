"""The zero dynamics of a virtual constraint on a robot with one unactuated coordinate, by quadrature.

On the constraint q_b = h(Theta), Theta = c q, the configuration is q(Theta): q_b are the p actuated joints, q_N
is the last coordinate, without a motor. Theta runs from Theta+ just after an impact to Theta- just before the
next one; sigma+ and sigma- likewise. With sigma = D_N(q) q' the angular momentum about the stance foot (D_N is
the row of q_N of the inertia matrix D, G_N = dV/dq_N gravity's torque, V the potential energy),

    sigma  = I(Theta) Theta',   I = D_N(q) dq/dTheta
    sigma' = -dV/dq_N = -G_N
    d(sigma^2 / 2)/dTheta = -G_N I

so an orbit is one quadrature, and Theta' = sigma / I. Impact maps sigma- to sigma+ = delta sigma- (about the
new foot): the cycle closes when sigma-^2 = 2 W / (1 - delta^2), W = int -G_N I dTheta, and its
multiplier is delta^2 (Westervelt, Grizzle, Koditschek, IEEE TAC 48(1), 2003). Gauss-Legendre nodes
make the quadrature exact to round-off for smooth constraints.

`ZeroDynamics` is one step of one orbit, with torques and ground reaction at the nodes, as the design of gaits
needs it. `zero_orbits` has all speeds at once: return map, fixed point, domain of attraction.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.polynomial import legendre

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import ControlledCurve
from biped_adrc.model.biped import Biped

JointCurve = Callable[[float], tuple[Array, Array, Array]]
"""A function of Theta [rad] that returns h [rad], dh/dTheta, d2h/dTheta2, each (p,)."""


@lru_cache(maxsize=8)
def gauss_nodes(count: int) -> tuple[Array, Array, Array]:
    """Gauss-Legendre nodes (K,) and weights (K,) on [0, 1], and the matrix C (K, K) of running integrals.

    K = count. C f is the integral from 0 to each node of the polynomial through the values f (K,) at the nodes:
    exact for polynomials of degree below K, by their Legendre coefficients.
    """
    x, w = legendre.leggauss(count)
    # to_coefficients @ f: its Legendre coefficients; integral: those of P_0 .. P_K-1 from -1 to each x
    to_coefficients = (legendre.legvander(x, count - 1) * w[:, np.newaxis]).T
    # coefficient j of f is (j + 1/2) int P_j f dx over [-1, 1]
    to_coefficients *= (np.arange(count) + 0.5)[:, np.newaxis]
    integrals = (legendre.legint(row, lbnd=-1) for row in np.eye(count))
    integral = np.array([legendre.legval(x, row) for row in integrals]).T
    # from [-1, 1] to [0, 1]
    return 0.5 * (x + 1.0), 0.5 * w, 0.5 * integral @ to_coefficients


@dataclass(frozen=True)
class ZeroDynamicsOrbit(Shown):
    """One step of the zero dynamics at K Gauss nodes (phases); n coordinates, p motors."""

    theta: Array
    """Phases (K,) [rad]."""
    q: Array
    """Angles (K, n) [rad]."""
    v: Array
    """Rates (K, n) [rad/s]."""
    a: Array
    """Accelerations (K, n) [rad/s^2]."""
    u: Array
    """Torques (K, p) [N m]."""
    ground_reaction: Array
    """Ground reaction (F_T, F_N) (K, 2) [N]."""
    time_weights: Array
    """Weights (K,) [s]: time_weights @ f, f (K,) at the nodes, is the integral of f over the step's time."""
    period: float
    """Duration of the step [s]."""


@dataclass(frozen=True)
class ZeroDynamics(Shown):
    """The model along one constraint at K Gauss nodes (phases), with orbits by quadrature. Make it by `of`.

    >>> zero = ba.ZeroDynamics.of(biped, gait.constraint)
    >>> zero.delta**2 < 1.0  # the cycle is stable
    True
    """

    biped: Biped
    """The robot."""
    constraint: VirtualConstraint
    """The virtual constraint q_b = h(Theta)."""
    theta: Array
    """Phases of the nodes (K,) [rad]."""
    weights: Array
    """weights @ f is the integral of f over Theta from Theta+ to Theta- (K,) [rad]."""
    cumulative: Array
    """cumulative @ f is the integral of f over Theta from Theta+ to each node (K, K) [rad]."""
    q: Array
    """Configurations on the constraint (K, n) [rad]."""
    dq: Array
    """dq/dTheta (K, n) [rad/rad]."""
    ddq: Array
    """d2q/dTheta2 (K, n) [1/rad]."""
    inertia: Array
    """I(Theta) (K,) [kg m^2]."""
    gravity: Array
    """G_N (K,) [N m]."""

    @classmethod
    def of(
        cls,
        biped: Biped,
        constraint: VirtualConstraint,
        nodes: int = 40,
        h: JointCurve | None = None,
    ) -> ZeroDynamics:
        """Evaluate the model along the constraint at `nodes` Gauss nodes; 40 are enough for curves of degree 6
        to be integrated to round-off. h: another curve that a step follows between Theta+ and Theta- of the
        constraint; None for its own.

        Raises InputError where biped is no `Biped` or constraint no `VirtualConstraint`.
        """
        check_part(biped, "biped", Biped)
        check_part(constraint, "constraint", VirtualConstraint)
        # phases in [0, 1], weights of an integral over it, and matrix of the integrals from 0 to each node
        s, w, C = gauss_nodes(nodes)
        span = constraint.theta_minus - constraint.theta_plus
        theta = constraint.theta_plus + span * s
        rows = (configuration(constraint.phase, h or constraint.h, th) for th in theta)
        q, dq, ddq = map(np.array, zip(*rows, strict=True))
        # [-1]: the row of the coordinate without a motor
        inertia = np.array([biped.inertia(q[k])[-1] @ dq[k] for k in range(nodes)])
        gravity = np.array([biped.gravity(q[k])[-1] for k in range(nodes)])
        return cls(biped, constraint, theta, span * w, span * C, q, dq, ddq, inertia, gravity)

    @property
    def work(self) -> float:
        """W = int -G_N I dTheta over the step [kg^2 m^4/s^2], by which gravity changes sigma^2 / 2 from the
        start to the end of the step; positive where it speeds the step up.
        """
        return float(self.weights @ (-self.gravity * self.inertia))

    @cached_property
    def _end(self) -> tuple[Array, Array]:
        """State (q-, q'-), each (n,) [rad, rad/s], at the end of the step on the constraint, at |Theta'-| = 1
        rad/s in the direction of the walk; other speeds only scale q'-.
        """
        h = self.constraint
        q, dq, _ = configuration(h.phase, h.h, h.theta_minus)
        return q, np.sign(h.theta_minus - h.theta_plus) * dq

    @property
    def delta(self) -> float:
        """Ratio sigma+ / sigma- [1] of the angular momenta after the impact (about the new foot) and before it
        (about the old one); the impact is linear in the rates, so it is the same at every speed.
        """
        impact = self.biped.impact(*self._end)
        after = self.biped.angular_momentum(impact.q, impact.v)
        return after / self.biped.angular_momentum(*self._end)

    @property
    def sigma_minus(self) -> float:
        """sigma- of the periodic orbit [kg m^2/s]: sigma-^2 = 2 W / (1 - delta^2), with the sign of the walk.

        Raises GaitError when there is none.
        """
        # _end: the state at the end of the step at |Theta'| = 1 rad/s, here for the sign
        delta2 = self.delta**2
        square = 2.0 * self.work / (1.0 - delta2)
        if not square > 0:
            raise GaitError(
                f"the zero dynamics have no periodic orbit: W = {self.work:.6g}, "
                f"delta^2 = {delta2:.6g} give sigma-^2 = {square:.6g} < 0; change the constraint"
            )
        return math.copysign(math.sqrt(square), self.biped.angular_momentum(*self._end))

    def end_state(self, sigma_minus: float) -> tuple[Array, Array]:
        """State (q-, q'-), each (n,) [rad, rad/s], at the end of the step on the constraint, with the angular
        momentum sigma_minus [kg m^2/s].
        """
        # at |Theta'| = 1 rad/s; the angular momentum is proportional to the rates
        q, v = self._end
        return q, v * (sigma_minus / self.biped.angular_momentum(q, v))

    def sigma_squared(self, sigma_plus: float) -> Array:
        """sigma^2 at the nodes (K,) [kg^2 m^4/s^2] of a step that starts with sigma_plus [kg m^2/s]; a
        negative value means that the step has stopped before that node.
        """
        return sigma_plus**2 + 2.0 * self.cumulative @ (-self.gravity * self.inertia)

    def orbit(self, sigma_plus: float) -> ZeroDynamicsOrbit:
        """The walking step that starts with sigma_plus [kg m^2/s]: states, torques and ground reaction at the
        nodes.

        Raises GaitError when the step does not reach its end, or I changes its sign, so that Theta is no phase.
        """
        low, high = np.min(self.inertia), np.max(self.inertia)
        square = self.sigma_squared(sigma_plus)
        if not (low * high > 0.0 and np.min(square) > 0.0):
            raise GaitError(
                f"the step does not reach its end: sigma^2 falls to {np.min(square):.4g} kg^2 m^4/s^2, "
                f"expected above 0, and I(Theta) runs from {low:.4g} to {high:.4g} kg m^2, expected one sign; "
                "begin faster, or choose another phase or curve"
            )
        sigma = np.sign(sigma_plus) * np.sqrt(square)
        rate = sigma / self.inertia  # Theta'
        v = self.dq * rate[:, np.newaxis]
        rows = zip(*(self.dynamics(k, rate[k]) for k in range(len(rate))), strict=True)
        time = self.weights / rate  # dt = dTheta / Theta'
        a, u, reaction = map(np.array, rows)
        return ZeroDynamicsOrbit(self.theta, self.q, v, a, u, reaction, time, float(np.sum(time)))

    @cached_property
    def cycle(self) -> ZeroDynamicsOrbit:
        """The walking step of the periodic orbit. Raises GaitError when there is none."""
        return self.orbit(self.sigma_minus * self.delta)

    def dynamics(self, k: int, rate: float) -> tuple[Array, Array, Array]:
        """q'' (n,) [rad/s^2], u (p,) [N m] and ground reaction (F_T, F_N) (2,) [N] at node k, for Theta' = rate
        [rad/s].

        Theta'' (rate2) follows from the unactuated row of D q'' + Omega = (u, 0), u from the others.
        """
        q, dq, ddq, b = self.q[k], self.dq[k], self.ddq[k], self.biped
        v = dq * rate
        D, Omega = b.inertia(q), b.bias(q, v)  # inertia matrix; Coriolis and gravity terms
        rate2 = -(Omega[-1] + D[-1] @ ddq * rate**2) / (D[-1] @ dq)
        a = dq * rate2 + ddq * rate**2
        u = (D @ a + Omega)[: b.p]
        return a, u, b.ground_reaction(q, v, a)


def configuration(c: Array, curve: JointCurve, theta: float) -> tuple[Array, Array, Array]:
    """q [rad], dq/dTheta and d2q/dTheta2 at theta [rad], each (n,), where q_b = h(Theta) and Theta = c q.

    c (n,): row of the phase, [c_b c_N]. curve: h as a function of theta. The last coordinate follows from
    Theta = c q: q_N = (Theta - c_b h) / c_N.
    """
    h, dh, ddh = curve(theta)
    c_b, c_N = c[:-1], c[-1]
    return (
        np.append(h, (theta - c_b @ h) / c_N),
        np.append(dh, (1.0 - c_b @ dh) / c_N),
        np.append(ddh, -(c_b @ ddh) / c_N),
    )


def impact_jump(
    biped: Biped, constraint: VirtualConstraint, q: Array, v: Array
) -> tuple[Array, Array]:
    """Distance from a constraint just after an impact from the state (q-, q'-), each (n,) [rad, rad/s].

    Returns q_b+ - h(Theta+) [rad] and q_b'+ - h'(Theta+) Theta'+ [rad/s], each (p,), with Theta+ = c q+. Both
    are zero for a state on a hybrid-invariant constraint; otherwise each impact disturbs the tracking
    controller by this much.
    """
    after, c, p = biped.impact(q, v), constraint.phase, biped.p
    h, slope, _ = constraint.h(float(c @ after.q))
    return after.q[:p] - h, after.v[:p] - slope * float(c @ after.v)


def invariant_constraint(
    kind: type[ControlledCurve], biped: Biped, q: Array, dq: Array, degree: int
) -> VirtualConstraint:
    """The hybrid-invariant constraint of a step that ends in the pre-impact pose q (n,) [rad] with the slope
    dq = dq/dTheta (n,), and so begins in the relabelled pose.

    kind, degree: of its curve. The slope at the start is that after the impact: the impact is linear in the
    rates, so dq stands for q' at Theta' = 1 rad/s. The inner coefficients, which invariance leaves free, lie on
    a straight line.
    """
    p, c, impact = biped.p, biped.phase, biped.impact(q, dq)
    plus, minus = float(c @ impact.q), float(c @ q)
    # dh/ds = dh/dTheta (Theta- - Theta+), at the start and at the end
    slopes = impact.v[:p] / float(c @ impact.v) * (minus - plus), dq[:p] * (minus - plus)
    alpha = kind.between(impact.q[:p], *slopes, q[:p], degree)
    return VirtualConstraint(kind(alpha), c, plus, minus)
