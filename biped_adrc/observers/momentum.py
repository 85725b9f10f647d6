"""Momentum observer: from the momentum alone, an estimate r of the force zeta that the model does not contain.

zeta (n,) [N m] is generalised, in the coordinates q (n,) [rad]; ^ is an estimate. pi is the momentum, D the
inertia matrix, C q' and G the Coriolis and gravity terms, B u the motors' torques u in all coordinates, l_i
[1/s^i] the gains. beta is the force that the model knows.

    pi = D q' [kg m^2/s],   dpi/dt = beta + zeta,   beta = C^T q' - G + B u [N m]

    dpi^/dt = beta + r      + l_1 (pi - pi^)
    dr_0/dt =        r_1    + l_2 (pi - pi^),   r = r_0
     ...
    dr_(k-2)/dt =             l_k (pi - pi^)

r_1, r_2, ... are estimates of the derivatives of zeta. Only the momentum pi is measured: no acceleration and
no inverse of D is needed. With one pole there would be no r_0, and r = l_1 (pi - pi^) is the residual of De
Luca, Albu-Schaeffer, Haddadin, Hirzinger, IROS 2006. Here there are two poles or more. With two, r is a state
of its own as in the disturbance observer of Chen, Ballance, Gawthrop, O'Reilly, IEEE Trans. Industrial
Electronics 47(4), 2000: for constant zeta the errors zeta - r and pi - pi^ go to zero. With k poles they do so
for a zeta that is a polynomial in time of degree k - 2. With chi(s) = s^k + l_1 s^(k-1) + ... + l_k the
polynomial of the poles

    zeta - r = s^(k-1) (s + l_1) / chi(s) zeta

The states Z (k, n) have one column per coordinate; row i, counted from 0, is the module's state divided by
scale^i, with scale the geometric mean of the poles [rad/s] (1/T in the discrete form), as in the GPI observer.

The rows of zeta are all n coordinates, the unactuated q_N among them, so r has a
part that no motor can cancel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from biped_adrc.observers.base import equal_poles, stable_poles
from biped_adrc.observers.gpi import InjectedChain, mean_bandwidth


@dataclass(frozen=True)
class MomentumObserver(InjectedChain):
    """The momentum observer in continuous time. Make it with `from_poles` or `from_bandwidth`.

    One integrator (lead = 1) leads from the force to the momentum, and r and its derivatives are m = k - 1
    extended states. Its flow takes y = pi (n,), the momentum [kg m^2/s], and input = beta (n,), the known force
    [N m], of all n coordinates, as `control.momentum_dob` has them.
    """

    poles: tuple[complex, ...] = ()
    lead: int = field(default=1, kw_only=True)

    MAKERS = ("from_bandwidth", "from_poles")

    @classmethod
    def from_poles(cls, poles: Sequence[complex]) -> MomentumObserver:
        """The observer with these poles [rad/s]: two or more, with negative real parts, complex ones in pairs.

        Raises InputError for others.
        """
        poles = stable_poles(poles, "a momentum observer")
        # m, scale, poles
        return cls(len(poles) - 1, mean_bandwidth(poles), poles)

    @classmethod
    def from_bandwidth(cls, bandwidth: float, order: int = 2) -> MomentumObserver:
        """The observer with `order` poles, at least two, at -bandwidth [rad/s]. Raises InputError for fewer."""
        return cls.from_poles(equal_poles(bandwidth, order))
