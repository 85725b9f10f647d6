"""ADRC whose observer contains the nominal model's xi, and estimates the remaining disturbance d.

    x1' = x2,   x2' = xi + kappa u + d                              d: model error and external torques
    u = kappa^-1 (q_d'' - K_d (x2^ - q_d') - K_p (x1^ - q_d) - xi - d^)

With m = 0 there is no d^, and the law is NPD (28) on the angles and rates of an observer in place of measured
ones. With m >= 1 the observer has less to follow than in (20), where all of xi is a disturbance:
`control.adrc` needs kappa alone of the model, this one all of it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.base import Measurement, measured
from biped_adrc.core.types import Array
from biped_adrc.observers.base import ErrorSystem, Estimate, Observer
from biped_adrc.observers.gpi import GPIObserver


@dataclass(frozen=True)
class AssistedADRCController(ADRCController):
    """ADRC with the nominal model's xi in the observer's input, by the module's equations.

    The observer is the whole state; m = 1 and Table II by default.
    """

    observer: Observer = field(default_factory=lambda: GPIObserver.from_bandwidth(500.0, 1))

    def measured_output(self, m: Measurement) -> Estimate:
        """q_b [rad], q_b' [rad/s], each (p,), and d = 0: without error the model explains the whole motion."""
        x = measured(m)
        return x._replace(disturbance=np.zeros(len(x.disturbance)))

    def observer_input(self, m: Measurement, u: Array) -> Array:
        """Input of the observer: kappa u + xi (p,) [rad/s^2], the acceleration by the model."""
        return super().observer_input(m, u) + m.terms.xi

    def joint_estimate(self, x: Estimate, m: Measurement) -> Estimate:
        """The estimates x of the joints with xi^ = xi + d^ [rad/s^2], each (p,)."""
        return x._replace(disturbance=m.terms.xi + x.disturbance)

    def error_system(self) -> ErrorSystem | None:
        """None, as the observer's input is not kappa u alone."""
        return None
