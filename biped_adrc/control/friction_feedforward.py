"""Friction feedforward around any controller: the nominal joint friction at the rates of the reference.

    u = u_i + F,   F = share (viscous q_d' + static tanh(q_d' / w))

u_i (p,) is the torque of the controller inside, viscous [N m s/rad] and static [N m] are the coefficients of
the friction in each joint with a motor, share [1] how much of it is cancelled, q_d' the rates of a reference at
the measured phase Theta = c q and its rate Theta', and w [rad/s] the width of the plant's own smoothed sign,
`model.biped.STICTION_SPEED`. Measured rates have the noise of encoder counts, and static friction would change
its sign with it; the rates of the reference are smooth, and equal to the true ones up to the tracking error.

The controller inside gets u - F as the applied torque, where u is the torque that acts. So for it the friction
is reduced by F, after a saturation too, and its observer estimates the remaining disturbance,

    q_b'' = xi + kappa u = (xi + kappa F) + kappa (u - F)

If it got u instead, its xi^ would contain all of the friction, which would then be compensated twice.
Here kappa (p, p) is the input gain and xi the disturbance of the joints' accelerations. `estimate` gives xi,
without kappa F. With share = 1 F is the friction of the robot's record; with share = 0 the walk is that of the
controller inside, bit for bit.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from biped_adrc.control.around import Around
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.checks import NonNegativeFloat, NonNegativeFloats
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference
from biped_adrc.model.biped import STICTION_SPEED, Biped
from biped_adrc.observers.base import Estimate


@dataclass(frozen=True)
class FrictionFeedforward(Around):
    """A wrapper that adds to the torque of `inner` the friction F = share (viscous q_d'
    + static tanh(q_d' / w)).

    path: the reference whose rates q_d' are used; corrections of an outer loop are not in them.
    viscous [N m s/rad], static [N m]: one number for each motor. Raises InputError for numbers
    that are negative or not finite.
    """

    path: Reference
    viscous: NonNegativeFloats
    static: NonNegativeFloats
    share: NonNegativeFloat = 1.0

    @derived
    def coefficients(self) -> tuple[Array, Array]:
        """Viscous [N m s/rad] and static [N m] coefficients, each (p,), times the share."""
        return self.share * np.array(self.viscous), self.share * np.array(self.static)

    def friction(self, m: Measurement) -> Array:
        """Torque F (p,) [N m] that cancels the share of the joint friction at the rates of the reference."""
        dq_d, (viscous, static) = self.path(m.t, m.q, m.v).dq_d, self.coefficients
        return viscous * dq_d + static * np.tanh(dq_d / STICTION_SPEED)

    def output(self, s: Any, m: Measurement) -> Array:
        return self.inner.output(s, m) + self.friction(m)

    def flow(self, s: Any, m: Measurement, u: Array) -> Any:
        # u is the torque that acts; of it the friction F is not the inner controller's
        return self.inner.flow(s, m, u - self.friction(m))

    def predict(self, s: Any, m: Measurement, u: Array) -> Any:
        return self.inner.predict(s, m, u - self.friction(m))

    def estimate(self, s: Any, m: Measurement) -> Estimate | None:
        x = self.inner.estimate(s, m)
        if x is None:
            return None
        # of xi + kappa F, which the observer inside estimates, xi is left
        return x._replace(disturbance=x.disturbance - m.terms.kappa @ self.friction(m))


def friction_feedforward(
    inner: Controller, reference: Reference, biped: Biped, feedforward: float
) -> Controller:
    """Wrap a controller in the feedforward of the joint friction in the robot's record (robot.toml).

    reference: that whose rates q_d' are used. feedforward: the share [1].
    The robot may be loaded with friction or without. Raises InputError for a record without friction.
    """
    # of all n coordinates; the first p are the joints with motors
    viscous, static = (tuple(x[: biped.p].tolist()) for x in biped.friction_coefficients)
    if not any(viscous + static):
        raise InputError(
            f"feedforward = {feedforward} of the joint friction of robot '{biped.description.name}', whose "
            "record has none; expected a table [friction] in its robot.toml, or feedforward = 0"
        )
    return FrictionFeedforward(inner, reference, viscous, static, feedforward)
