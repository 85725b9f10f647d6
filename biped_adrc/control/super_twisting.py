"""Super-twisting sliding mode about the reference: a continuous torque that rejects a disturbance exactly.

    sigma = e' + lambda e,   e = q_b - q_d
    u = kappa^-1 (q_d'' - lambda e' - k_1 |sigma|^(1/2) sign(sigma) + z - xi),   z' = -k_2 sign(sigma)

(q_b: the p joints with motors, q_b'' = kappa u + xi by the model) leaves sigma' = -k_1 |sigma|^(1/2)
sign(sigma) + z + d for an error d [rad/s^2] of the model. With |d'| <= L and

    k_1 = 1.5 L^(1/2),   k_2 = 1.1 L

sigma and sigma' are zero after a finite time, and e falls like exp(-lambda t): Levant, Int. J. Control 58(6),
1993, and 76(9), 2003. After a jump of d, such as the edge of a push, this begins anew.

Here the root and the sign are smooth within a layer delta [rad/s], which gives up the last of the accuracy:

    |sigma|^(1/2) sign(sigma)  ->  sigma / (|sigma| + delta)^(1/2),   sign(sigma)  ->  sigma / (|sigma| + delta)

and d is rejected as by an integral of gain k_2 / delta. In sampled time, with the period T, sigma cannot stay
below k_2 T^2: with a smaller delta the torque chatters from one sample instant to the next by the order of
kappa^-1 k_1 (k_2 T^2)^(1/2). A delta of a few k_2 T^2 ends that.
"""

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.control.base import Measurement, WithPeriod
from biped_adrc.control.tracking import solved_acceleration
from biped_adrc.core.checks import PositiveFloat
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array, Indices, relabelled
from biped_adrc.gait.reference import Reference, ReferencePoint


@dataclass(frozen=True)
class SuperTwistingController(WithPeriod):
    """Super-twisting sliding mode control about the reference, smooth within a layer around
    sigma = e' + lambda e = 0.

    reference: q_d. slope: lambda [1/s] of the sliding surface. lipschitz: L [rad/s^3], the bound on |d'|, the
    rate of the model's error. layer: delta [rad/s]. period [s]: of the discrete form; `sampled` sets it, None
    is for continuous time. Raises InputError for numbers that are not positive.
    """

    reference: Reference
    slope: PositiveFloat = 50.0
    lipschitz: PositiveFloat = 1e4
    layer: PositiveFloat = 0.05
    period: float | None = None

    @derived
    def k_1(self) -> float:
        """Gain k_1 [rad^(1/2) / s^(3/2)]."""
        return 1.5 * math.sqrt(self.lipschitz)

    @derived
    def k_2(self) -> float:
        """Gain k_2 [rad/s^3]."""
        return 1.1 * self.lipschitz

    def sliding(self, r: ReferencePoint, m: Measurement) -> tuple[Array, Array]:
        """The sliding variable sigma = e' + lambda e and the rate error e' = q_b' - q_d', each (p,) [rad/s], at
        the point r of the reference.
        """
        de = m.v_b - r.dq_d
        return de + self.slope * (m.q_b - r.q_d), de

    def output(self, s: Array, m: Measurement) -> Array:
        """u (p,) [N m] for the state s = z (p,) [rad/s^2]."""
        r = self.reference(m.t, m.q, m.v)
        sigma, de = self.sliding(r, m)
        # q_d'' contains q'', and so the torque: `solved_acceleration` solves for q_b'' = q_d'' + f
        f = s - self.slope * de - self.k_1 * sigma / np.sqrt(np.abs(sigma) + self.layer)
        return m.terms.kappa_inverse @ (solved_acceleration(r, m.terms, f) - m.terms.xi)

    def initial_state(self, m: Measurement) -> Array:
        """z = 0 (p,) [rad/s^2] at the start: the model is taken for exact."""
        return np.zeros(len(m.q_b))

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        """z' (p,) [rad/s^3], whatever the torque u: z ignores the torque limit, and
        winds up while it is reached.
        """
        sigma, _ = self.sliding(self.reference(m.t, m.q, m.v), m)
        return -self.k_2 * sigma / (np.abs(sigma) + self.layer)

    def correct(self, s: Array, m: Measurement) -> Array:
        """z (p,) [rad/s^2] over the period before this tick, by its sigma: so z does not lose a sample."""
        assert self.period is not None
        return s + self.period * self.flow(s, m, np.zeros_like(s))

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        """z itself, which `correct` moves."""
        return s

    def jump(self, s: Array, after: Measurement, swap: Indices) -> Array:
        """z (p,) [rad/s^2] after impact, relabelled, as an error of the model belongs to a leg: the legs
        exchange their names, and joint i takes entry swap[i] of (z, -z).
        """
        return relabelled(s, swap)
