"""Feedback linearisation with a filtered PID of the measured angles, without rates.

    e = q_b - q_d,   e_f'' = w^2 (e - e_f) - 2 zeta w e_f',   s' = e_f + (v - v_u) / (K_i T_t)
    u = kappa^-1 (a - xi),   a = q_d'' + v,   v = -K_d e_f' - K_p e_f - K_i s

q_b (p,) are the joints with motors, q_b'' = kappa u + xi by the nominal model. v is the acceleration of e that
the law asks for, v_u the one that the torque gives which acts. They differ where the motors saturate; there s
follows with the tracking time constant T_t, and does not wind up (Astrom, Hagglund, Advanced PID Control, ISA,
2006, 3.5). In C(s) and in polynomials s is Laplace's variable, else the integral of e_f. So
v = -C(s) e with

    C(s) = (K_d s^2 + K_p s + K_i) / (s (s^2 / w^2 + 2 zeta s / w + 1)).

In sampled time the filter takes the measurement of its own instant: e is that of the tick over the period
before it.

A linear ADRC of the output e'' = v + d, with observer gains l_1, l_2, l_3 (m = 1) and gains k_p, k_d, is the
same C(s) with

    w^2 = l_2 + k_p + k_d l_1,   2 zeta w = l_1 + k_d,
    w^2 (K_d, K_p, K_i) = (k_p l_1 + k_d l_2 + l_3, k_p l_2 + k_d l_3, k_p l_3),

as eliminating its observer's states shows. `like_adrc` makes this PID, and with the observer's start, resets
and input it is one loop with `output_adrc`: the states of both, (e_f, e_f', s) and the estimates (e^, e'^, d^),
are two coordinates of one filter, (e_f, e_f', s) = T (e^, e'^, d^). In sampled time it has the C(z) of that
ADRC. In general m extended states make a C(s) of order m + 2 with m poles at zero.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np
from scipy.linalg import expm

from biped_adrc.control.base import Measurement, WithPeriod
from biped_adrc.control.tracking import TABLE_II, Gains, output_matrix
from biped_adrc.core.checks import PositiveFloat, check_part
from biped_adrc.core.errors import InputError, check_positive
from biped_adrc.core.linear import solve
from biped_adrc.core.part import derived, setup
from biped_adrc.core.types import Array, Indices
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.observers.base import ChainObserver, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver


class FilterState(NamedTuple):
    """State of an `NPIDController`; what `flow` returns is its rate, in the same fields. Each (p,)."""

    e: Array
    """Filtered error e_f [rad]."""
    de: Array
    """Its rate e_f' [rad/s]."""
    total: Array
    """Integral s of e_f [rad s]."""


class FilterMatrices(NamedTuple):
    """The filter with rows Z (3, p) = (e_f, e_f', s): Z' = A Z + b e + w (v_u - v) in continuous time; in
    sampled time Z <- A Z + b e at a tick, and Z <- F Z + w (v_u - v) after it.
    """

    A: Array
    """(3, 3)."""
    b: Array
    """(3,)."""
    w: Array
    """(3,)."""
    F: Array
    """(3, 3); not used in continuous time."""


_COORDINATES = ChainObserver(1, 1.0)
"""Start and resets of states (e, e', d), without a scale."""


@dataclass(frozen=True)
class NPIDController(WithPeriod):
    """Feedback linearisation with a PID of the filtered error.

    reference: q_d. gains: K_p [1/s^2], K_d [1/s]. K_i [1/s^3]: on the integral. filter_bandwidth, damping: w
    [rad/s] and zeta [1] of the filter. tracking_time: T_t [s]. reset: what happens to the filter at impact, by
    the policies of an observer: e_f and e_f' stand for its estimates of e and e', K_i s for that of the
    disturbance. cancels: whether the law knows the nominal model's xi and q_d''; without, the integral has to
    find them. like: k_p [1/s^2], k_d [1/s] and bandwidth [rad/s] of the ADRC that has the same C, set by
    `like_adrc`. period [s]: of the discrete form; `sampled` sets it, None is for continuous time. Raises
    InputError for numbers that are not positive, and for an unstable loop.

    >>> controller = ba.NPIDController(gait.constraint, K_i=9e4, reset=ba.ResetPolicy.MEASURED)
    >>> ba.walk(ba.Walker(biped, controller), gait, impacts=1).impacts
    1
    """

    reference: Reference
    gains: Gains = TABLE_II
    K_i: PositiveFloat = 50000.0
    filter_bandwidth: PositiveFloat = 1000.0
    damping: PositiveFloat = 1.0
    tracking_time: PositiveFloat = 0.03
    reset: ResetPolicy = ResetPolicy.MODEL
    cancels: bool = True
    like: tuple[float, ...] = setup(())
    period: PositiveFloat | None = None

    def __post_init__(self) -> None:
        """Raise InputError unless the loop of e'' = v with the filter is stable, also with v held for a period.

        s^3 (s^2 + 2 zeta w s + w^2) + w^2 (K_d s^2 + K_p s + K_i) = 0 has roots with negative real parts, and
        what leads from one tick to the next eigenvalues below 1.
        """
        if len(self.like) not in (0, 3):
            raise InputError(f"like is {self.like!r}, expected (); call NPIDController.like_adrc")
        w, zeta = self.filter_bandwidth, self.damping
        # for each joint, where the gains are one per joint
        for K_p, K_d in np.broadcast(self.gains.K_p, self.gains.K_d):
            loop = [1.0, 2.0 * zeta * w, w * w, w * w * K_d, w * w * K_p, w * w * self.K_i]
            if not np.max(np.roots(loop).real) < 0.0:
                raise InputError(
                    f"the loop of NPID is unstable even on the exact model with K_p = {K_p:g}, K_d = {K_d:g}, "
                    f"K_i = {self.K_i:g} and a filter of {w:g} rad/s; expected K_i well below K_p K_d = "
                    f"{K_p * K_d:g} 1/s^3, and a filter faster than the loop"
                )
            if self.period is not None and not self._radius(K_p, K_d, self.period) < 1.0:
                raise InputError(
                    f"the loop of NPID is unstable at a period of {self.period:g} s with K_p = {K_p:g}, "
                    f"K_d = {K_d:g} and a filter of {w:g} rad/s; try a filter below {3.0 / self.period:g} rad/s"
                )

    def _radius(self, K_p: float, K_d: float, T: float) -> float:
        """Largest magnitude of the eigenvalues of the sampled loop of e'' = v, at ticks every T [s]."""
        A, b, _, F = self.filter
        loop, k = np.zeros((5, 5)), np.array([K_p, K_d, self.K_i])
        loop[:2, :2] = [[1.0, T], [0.0, 1.0]]
        Z = np.column_stack((b, 0.0 * b, A))  # after the tick, of (e, e', Z before it)
        loop[:2] -= np.outer([0.5 * T * T, T], k @ Z)
        loop[2:] = F @ Z
        return float(np.max(np.abs(np.linalg.eigvals(loop))))

    @classmethod
    def like_adrc(
        cls,
        reference: Reference,
        gains: Gains = TABLE_II,
        bandwidth: float = 500.0,
        reset: ResetPolicy = ResetPolicy.MODEL,
    ) -> Self:
        """The controller that is one loop with the output ADRC whose three observer poles are at -bandwidth
        [rad/s].

        gains: k_p [1/s^2] and k_d [1/s] of that ADRC, one number for all joints; the equations are the
        module's. reset: that of its observer.
        """
        check_positive(bandwidth, f"observer bandwidth is {bandwidth} rad/s")
        check_part(gains.K_p, "K_p of the ADRC", float)
        check_part(gains.K_d, "K_d of the ADRC", float)
        k_p, k_d = float(gains.K_p), float(gains.K_d)
        l_1, l_2, l_3 = 3.0 * bandwidth, 3.0 * bandwidth**2, bandwidth**3
        w2 = l_2 + k_p + k_d * l_1
        K_d, K_p, K_i = k_p * l_1 + k_d * l_2 + l_3, k_p * l_2 + k_d * l_3, k_p * l_3
        w, like = math.sqrt(w2), (k_p, k_d, float(bandwidth))
        own = Gains(K_p / w2, K_d / w2), K_i / w2, w, 0.5 * (l_1 + k_d) / w
        return cls(reference, *own, reset=reset, cancels=False, like=like)

    @property
    def _flow(self) -> tuple[Array, Array]:
        """A (3, 3) and b (3,) of the filter in continuous time."""
        w, zeta = self.filter_bandwidth, self.damping
        A = np.array([[0.0, 1.0, 0.0], [-w * w, -2.0 * zeta * w, 0.0], [1.0, 0.0, 0.0]])
        return A, np.array([0.0, w * w, 0.0])

    @derived
    def T(self) -> Array:
        """T (3, 3) of the module; of a PID of its own e_f and e_f' are the estimates, and K_i s that of d."""
        if not self.like:
            return np.diag([1.0, 1.0, 1.0 / self.K_i])
        # both filters have the same v and its derivatives k Z, k A Z, k A^2 Z
        k_p, k_d, bandwidth = self.like
        l_1, l_2, l_3 = GPIObserver.from_bandwidth(bandwidth, 1).gains
        theirs = np.array([[-l_1, 1.0, 0.0], [-l_2 - k_p, -k_d, 0.0], [-l_3, 0.0, 0.0]])
        ours, own = self._flow[0], np.array([self.gains.K_p, self.gains.K_d, self.K_i])
        seen = [
            np.array([k @ np.linalg.matrix_power(A, i) for i in range(3)])
            for A, k in ((ours, own), (theirs, np.array([k_p, k_d, 1.0])))
        ]
        return np.linalg.solve(*seen)

    @derived
    def T_inverse(self) -> Array:
        """(3, 3)."""
        return np.linalg.inv(self.T)

    @derived
    def filter(self) -> FilterMatrices:
        """The filter of this time base."""
        (A, b), h, T = self._flow, self.period, self.T
        follows = np.array([0.0, 0.0, -1.0 / self.K_i])
        if h is None:
            w = T[:, 1].copy() if self.like else follows / self.tracking_time
            return FilterMatrices(A, b, w, np.eye(3))
        if self.like:  # the ADRC's own discrete observer, its states without their scale
            k_p, k_d, bandwidth = self.like
            o = GPIObserver.from_bandwidth(bandwidth, 1).sampled(h)
            S = T * o.scale ** np.arange(3)
            correct = np.eye(3)
            correct[:, 0] -= o.L
            back = np.linalg.inv(S)
            k = np.array([k_p, k_d, 1.0]) @ self.T_inverse
            F = S @ o.Phi @ back - np.outer(S @ o.Gamma, k)
            return FilterMatrices(S @ correct @ back, S @ o.L, S @ o.Gamma, F)
        # the exact solution over a period in which e, here a fourth state, is constant
        held = expm(np.block([[A, b[:, np.newaxis]], [np.zeros((1, 4))]]) * h)
        w = -np.expm1(-h / self.tracking_time) * follows
        return FilterMatrices(held[:3, :3].copy(), held[:3, 3].copy(), w, np.eye(3))

    @derived
    def before(self) -> tuple[Array, Array]:
        """M (3, 3) and c (3,): from M (Z - c e) a tick with the error e leads to the state Z of the filter."""
        # an observer stays where it starts, as it has no innovation
        if self.period is None or self.like:
            return np.eye(3), np.zeros(3)
        return np.linalg.inv(self.filter.A), self.filter.b

    def command(self, s: FilterState) -> Array:
        """The acceleration v (p,) [rad/s^2] of e that the law asks for."""
        return -self.gains.K_d * s.de - self.gains.K_p * s.e - self.K_i * s.total

    def model(self, r: ReferencePoint, m: Measurement) -> tuple[Array, Array, Array]:
        """M (p, p), and of e'' = M (kappa u + xi) - c the parts xi and c (p,) [rad/s^2] that the law knows."""
        c = r.drift + r.H[:, len(r.q_d) :] @ m.terms.a_N
        none = np.zeros(len(r.q_d))
        return output_matrix(r, m.terms), *((m.terms.xi, c) if self.cancels else (none, none))

    def output(self, s: FilterState, m: Measurement) -> Array:
        # q_d'' contains q'', and so the torque: M a = v + c is solved for a = q_b''
        M, xi, c = self.model(self.reference(m.t, m.q, m.v), m)
        a = solve(M, self.command(s) + c, "I - H_b - H_N A_N, by which the reference is tracked,")
        return m.terms.kappa_inverse @ (a - xi)

    def errors(self, m: Measurement) -> tuple[Array, Array, Array]:
        """e [rad], e' [rad/s] and d [rad/s^2], each (p,): of e'' by the nominal model what the law ignores."""
        r = self.reference(m.t, m.q, m.v)
        d = np.zeros(len(r.q_d))
        if not self.cancels:
            d = output_matrix(r, m.terms) @ m.terms.xi - r.drift - r.H[:, len(d) :] @ m.terms.a_N
        return m.q_b - r.q_d, m.v_b - r.dq_d, d

    def filter_at(self, x: Array, e: Array) -> FilterState:
        """The filter before a tick with the error e = x_1 (p,), after which its estimates are x (3, p)."""
        M, c = self.before
        return FilterState(*(M @ (self.T @ x - np.outer(c, e))))

    def initial_state(self, m: Measurement) -> FilterState:
        """The filter at the measured error and its rate, with the model's value of d."""
        e, de, d = self.errors(m)
        return self.filter_at(_COORDINATES.initial_state(e, de, d), e)

    def flow(self, s: FilterState, m: Measurement, u: Array) -> FilterState:
        """Z' under the torque u (p,) that acts."""
        (A, b, _, _), e = self.filter, m.q_b - self.reference(m.t, m.q, m.v).q_d
        return FilterState(*(A @ np.array(s) + np.outer(b, e) + self.shortfall(s, m, u)))

    def correct(self, s: FilterState, m: Measurement) -> FilterState:
        """Z with the error of this tick."""
        e = m.q_b - self.reference(m.t, m.q, m.v).q_d
        return FilterState(*(self.filter.A @ np.array(s) + np.outer(self.filter.b, e)))

    def predict(self, s: FilterState, m: Measurement, u: Array) -> FilterState:
        """Z before the next tick, after the torque u (p,) that acts until then."""
        return FilterState(*(self.filter.F @ np.array(s) + self.shortfall(s, m, u)))

    def shortfall(self, s: FilterState, m: Measurement, u: Array) -> Array:
        """w (v_u - v) (3, p), by how much the torque u (p,) that acts is not the one that the law asks for."""
        M, xi, c = self.model(self.reference(m.t, m.q, m.v), m)
        return np.outer(self.filter.w, M @ (m.terms.kappa @ u + xi) - c - self.command(s))

    def jump(self, s: FilterState, after: Measurement, swap: Indices) -> FilterState:
        """The filter after impact, by the policy `reset`; swap (p,): as the legs exchange their names, joint i
        takes entry swap[i] of (x, -x) of its estimates x.
        """
        if self.reset is ResetPolicy.NONE:
            return s
        e, de, d = self.errors(after)
        x = _COORDINATES.reset(self.T_inverse @ np.array(s), self.reset, swap, e, de, d)
        if self.reset is ResetPolicy.RELABEL:  # of the measurement nothing is taken
            return FilterState(*(self.T @ x))
        return self.filter_at(x, e)
