"""A bound on what an observer may call a disturbance.

    xi^ <- min(max(xi^, -b), b)          for each joint, b [rad/s^2]

The state and its dynamics stay those of the observer inside, so poles and convergence do too: where |xi^| <= b
the estimate is the same number. After a jump, such as an impact of another height than the reset assumes, the
estimate of a fast observer peaks; the bound keeps the peak out of the torque. b has to be above the largest
disturbance, else the rest is not rejected. The bound on an estimate against peaking: Esfandiari, Khalil, Int.
J. Control 56(5), 1992; Freidovich, Khalil, IEEE TAC 53(10), 2008.
"""

from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from biped_adrc.core.checks import PositiveFloat
from biped_adrc.core.part import rewrites
from biped_adrc.core.types import Array, Indices
from biped_adrc.observers.base import ErrorSystem, Estimate, Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver


@dataclass(frozen=True)
class BoundedObserver(Observer):
    """An observer whose estimate of the disturbance is bounded; its state is that of the observer `inner`.

    inner: any observer. bound: b [rad/s^2], the same for every joint; [N m] of a momentum observer. Raises
    InputError for a bound that is not positive.
    """

    inner: Observer
    bound: PositiveFloat

    MAKERS = ("from_bandwidth",)

    @classmethod
    def from_bandwidth(cls, bound: float, bandwidth: float, m: int = 1) -> Self:
        """The bound around `GPIObserver.from_bandwidth`, with all m + 2 poles at -bandwidth [rad/s]."""
        return cls(GPIObserver.from_bandwidth(bandwidth, m), bound)

    @property
    def lead(self) -> int:
        """Number of integrators between disturbance and measurement, that of `inner`."""
        return int(getattr(self.inner, "lead", 2))

    def initial_state(self, y: Array, dy: Array, xi: Array) -> Any:
        return self.inner.initial_state(y, dy, xi)

    def estimate(self, z: Any) -> Estimate:
        x = self.inner.estimate(z)
        return x._replace(disturbance=np.clip(x.disturbance, -self.bound, self.bound))

    def reset(
        self, z: Any, policy: ResetPolicy, swap: Indices, y: Array, dy: Array, xi: Array
    ) -> Any:
        return self.inner.reset(z, policy, swap, y, dy, xi)

    def flow(self, z: Any, y: Array, input: Array) -> Any:
        return self.inner.flow(z, y, input)

    def correct(self, z: Any, y: Array) -> Any:
        return self.inner.correct(z, y)

    def predict(self, z: Any, input: Array) -> Any:
        return self.inner.predict(z, input)

    def sampled(self, period: float) -> Self:
        return replace(self, inner=self.inner.at_ticks(period))

    def error_system(self) -> ErrorSystem | None:
        return None if rewrites(self.inner, "error_system", "flow") else self.inner.error_system()
