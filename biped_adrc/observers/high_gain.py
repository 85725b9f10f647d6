"""The extended high-gain observer: gains alpha_i / eps^i, with one small number eps [s] to choose.

    x1^' = x2^      + alpha_1 / eps   (y - x1^)
    x2^' = x3^ + kappa u + alpha_2 / eps^2 (y - x1^)
     ...
    x_(m+2)^' =       alpha_(m+2) / eps^(m+2) (y - x1^)

x1^, x2^, x3^ estimate a joint's angle, velocity and disturbance, y is the measured angle, and kappa u the
acceleration that the torques give by the nominal model. s^(m+2) + alpha_1 s^(m+1) + ... + alpha_(m+2) is
Hurwitz; its roots divided by eps are the poles. As eps falls, the closed loop comes to behave as if state and
disturbance were known, but the peak of x_k^ after a jump grows as eps^-(k-1). So the torque has to be limited,
and the observer to be reset at impact. Freidovich, Khalil, IEEE TAC 53(10), 2008; Khalil, High-Gain Observers
in Nonlinear Feedback Control, SIAM, 2017. It is the GPI observer (17) in another parametrisation, with states
scaled by 1 / eps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import comb

import numpy as np

from biped_adrc.core.checks import numbers
from biped_adrc.core.errors import InputError, check_positive, check_whole
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array
from biped_adrc.observers.gpi import InjectedChain


@dataclass(frozen=True)
class HighGainObserver(InjectedChain):
    """The extended high-gain observer, the same for every joint; `scale` is 1 / eps [1/s]. Make it with
    `from_epsilon`.

    alpha (m + 2,): alpha_1 .. alpha_(m+2), dimensionless.
    """

    alpha: tuple[float, ...] = ()

    MAKERS = ("from_epsilon",)

    @classmethod
    def from_epsilon(
        cls, epsilon: float, alpha: Sequence[float] | None = None, m: int = 1
    ) -> HighGainObserver:
        """The observer with eps = epsilon [s] and alpha_1 .. alpha_(m+2), dimensionless; if alpha is None, the
        coefficients of (s + 1)^(m+2): all poles at -1 / eps.

        Raises InputError for an epsilon that is not positive, m below 1, and alphas that are not those of a
        stable polynomial of degree m + 2.
        """
        check_positive(epsilon, f"epsilon is {epsilon} s", " as 0.002")
        check_whole(m, f"the order m of a high-gain observer is {m!r}", 1)
        equal = [comb(m + 2, i) for i in range(1, m + 3)]
        a = numbers(equal if alpha is None else alpha, "alpha")
        if a.shape != (m + 2,) or not np.isfinite(a).all() or np.roots([1.0, *a]).real.max() >= 0.0:
            raise InputError(
                f"alpha is {a}, expected {m + 2} numbers for m = {m}: the roots of s^{m + 2} + alpha_1 "
                f"s^{m + 1} + ... must have negative real parts; try those of (s + 1)^{m + 2}"
            )
        return cls(int(m), 1.0 / float(epsilon), tuple(a.tolist()))

    @cached_property
    def poles(self) -> tuple[complex, ...]:
        """Poles of the error dynamics (m + 2,) [rad/s]; round-off scatters equal ones a little."""
        return tuple(complex(root) * self.scale for root in np.roots([1.0, *self.alpha]))

    @derived
    def scaled_gains(self) -> Array:
        """The coefficients alpha (m + 2,): as states are scaled by 1 / eps, they are the scaled gains."""
        return np.array(self.alpha)
