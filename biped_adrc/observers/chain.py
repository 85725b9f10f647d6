"""A chain of integrators per joint in scaled states: what continuous and discrete GPI observers share.

x_k = z_k scale^(k-1), k = 1..m+2, with x1 position, x2 velocity, x3 disturbance and its derivatives. In x
itself the observer matrix of Table I has condition number 3e29; scaled it has 5e6.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.observers.base import Estimate, Observer, ResetPolicy
from biped_adrc.types import Array


@dataclass(frozen=True)
class ChainObserver(Observer):
    """m extended states; z is (m + 2, p) flattened."""

    m: int
    scale: float

    @property
    def order(self) -> int:
        return self.m + 2

    def initial_state(self, y: Array, dy: Array, xi: Array) -> Array:
        Z = np.zeros((self.order, len(y)))
        Z[0], Z[1] = y, dy / self.scale
        if self.m > 0:
            Z[2] = xi / self.scale**2
        return Z.ravel()

    def estimate(self, z: Array) -> Estimate:
        Z = z.reshape(self.order, -1)
        xi = Z[2] * self.scale**2 if self.m > 0 else np.zeros(Z.shape[1])
        return Estimate(Z[0], Z[1] * self.scale, xi)

    def reset(
        self, z: Array, policy: ResetPolicy, swap: Array, y: Array, dy: Array, xi: Array
    ) -> Array:
        if policy is ResetPolicy.NONE:
            return z
        if policy is ResetPolicy.MODEL:
            return self.initial_state(y, dy, xi)
        Z = z.reshape(self.order, -1)[:, swap]
        if policy is ResetPolicy.MEASURED:
            Z[0], Z[1] = y, dy / self.scale
        return Z.ravel()
