"""Feedback linearisation with a filtered PID of the measured angles, without rates.

    e = q_b - q_d,   e_f'' = w^2 (e - e_f) - 2 zeta w e_f',   s' = e_f
    u = kappa^-1 (a - xi),   a = q_d'' - K_d e_f' - K_p e_f - K_i s

q_b (p,) are the joints with motors, q_b'' = kappa u + xi by the nominal model. In C(s) and in polynomials s is
Laplace's variable, else the integral of e_f. So a - q_d'' = -C(s) e with

    C(s) = (K_d s^2 + K_p s + K_i) / (s (s^2 / w^2 + 2 zeta s / w + 1)).

A linear ADRC of the output e'' = v + d, with observer gains l_1, l_2, l_3 (m = 1) and gains k_p, k_d, is the
same C(s) with

    w^2 = l_2 + k_p + k_d l_1,   2 zeta w = l_1 + k_d,
    w^2 (K_d, K_p, K_i) = (k_p l_1 + k_d l_2 + l_3, k_p l_2 + k_d l_3, k_p l_3),

as eliminating its observer's states shows. In general m extended states make a C(s) of order m + 2 with m
poles at zero. ADRC and this PID differ in what the transfer function does not show: ADRC does without xi of the
model, its observer is fed with the torque applied, so that it does not wind up, and is reset at impact.
Astrom, Hagglund, Advanced PID Control, ISA, 2006.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.linalg import expm

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.control.tracking import TABLE_II, Gains, solved_acceleration
from biped_adrc.core.checks import PositiveFloat, check_part
from biped_adrc.core.errors import InputError, check_positive
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array, Indices, relabelled
from biped_adrc.gait.reference import Reference


class FilterState(NamedTuple):
    """State of an `NPIDController`; what `flow` returns is its rate, in the same fields. Each (p,)."""

    e: Array
    """Filtered error e_f [rad]."""
    de: Array
    """Its rate e_f' [rad/s]."""
    total: Array
    """Integral s of e_f [rad s]."""


@dataclass(frozen=True)
class NPIDController(Controller):
    """Feedback linearisation with a PID of the filtered error.

    reference: q_d. gains: K_p [1/s^2], K_d [1/s]. K_i [1/s^3]: on the integral. filter_bandwidth, damping: w
    [rad/s] and zeta [1] of the filter. period [s]: of the discrete form, in which the error is held from one
    sample instant to the next; `sampled` sets it, None is for continuous time. Raises InputError for numbers
    that are not positive, and for an unstable loop.
    """

    reference: Reference
    gains: Gains = TABLE_II
    K_i: PositiveFloat = 50000.0
    filter_bandwidth: PositiveFloat = 1000.0
    damping: PositiveFloat = 1.0
    period: float | None = None

    def __post_init__(self) -> None:
        """Raise InputError unless all roots of the loop, of e'' = a - q_d'' with the filter, have negative real
        parts.

        s^3 (s^2 + 2 zeta w s + w^2) + w^2 (K_d s^2 + K_p s + K_i) = 0
        """
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

    @classmethod
    def like_adrc(
        cls, reference: Reference, gains: Gains = TABLE_II, bandwidth: float = 500.0
    ) -> NPIDController:
        """The controller with C(s) of the linear ADRC whose three observer poles are at -bandwidth [rad/s].

        gains: k_p [1/s^2] and k_d [1/s] of that ADRC, one number for all joints; the equations are the
        module's.
        """
        check_positive(bandwidth, f"observer bandwidth is {bandwidth} rad/s")
        check_part(gains.K_p, "K_p of the ADRC", float)
        check_part(gains.K_d, "K_d of the ADRC", float)
        k_p, k_d = float(gains.K_p), float(gains.K_d)
        l_1, l_2, l_3 = 3.0 * bandwidth, 3.0 * bandwidth**2, bandwidth**3
        w2 = l_2 + k_p + k_d * l_1
        K_d, K_p, K_i = k_p * l_1 + k_d * l_2 + l_3, k_p * l_2 + k_d * l_3, k_p * l_3
        w = math.sqrt(w2)
        return cls(reference, Gains(K_p / w2, K_d / w2), K_i / w2, w, 0.5 * (l_1 + k_d) / w)

    @derived
    def filter(self) -> tuple[Array, Array]:
        """M (3, 3) and b (3,) of the filter with Z (3, p), whose rows are e_f, e_f', s: M Z + b e is Z' in
        continuous time (no period), and Z one period later in sampled time.
        """
        w, zeta = self.filter_bandwidth, self.damping
        A = np.array([[0.0, 1.0, 0.0], [-w * w, -2.0 * zeta * w, 0.0], [1.0, 0.0, 0.0]])
        b = np.array([0.0, w * w, 0.0])
        if self.period is None:
            return A, b
        # the exact solution over a period in which e, here a fourth state, is constant
        held = expm(np.block([[A, b[:, np.newaxis]], [np.zeros((1, 4))]]) * self.period)
        return held[:3, :3].copy(), held[:3, 3].copy()

    def output(self, s: FilterState, m: Measurement) -> Array:
        # q_d'' contains q'', and so the torque: `solved_acceleration` solves for a = q_d'' + f
        r = self.reference(m.t, m.q, m.v)
        f = -self.gains.K_p * s.e - self.gains.K_d * s.de - self.K_i * s.total
        return m.terms.kappa_inverse @ (solved_acceleration(r, m.terms, f) - m.terms.xi)

    def initial_state(self, m: Measurement) -> FilterState:
        """The filter at the measured error and its rate, each (p,), with the integral 0."""
        r = self.reference(m.t, m.q, m.v)
        e, de = m.q_b - r.q_d, m.v_b - r.dq_d
        return FilterState(e, de, np.zeros(len(e)))

    def flow(self, s: FilterState, m: Measurement, u: Array) -> FilterState:
        """M Z + b e, with Z (3, p) the rows e_f, e_f', s of the filter's state and e the error of this
        measurement: Z' in continuous time, Z one period later in sampled time.
        """
        (M, b), e = self.filter, m.q_b - self.reference(m.t, m.q, m.v).q_d
        return FilterState(*(M @ np.array(s) + np.outer(b, e)))

    predict = flow

    def jump(self, s: FilterState, after: Measurement, swap: Indices) -> FilterState:
        """The filter after impact: it starts anew at the measured error and rate, but keeps the integral,
        relabelled: joint i takes entry swap[i] of (s, -s), as the legs exchange their names.
        """
        return self.initial_state(after)._replace(total=relabelled(s.total, swap))

    def sampled(self, period: float) -> NPIDController:
        return replace(self, period=period)

    def continuous(self) -> NPIDController:
        if self.period is not None:
            self._only_sampled()
        return self
