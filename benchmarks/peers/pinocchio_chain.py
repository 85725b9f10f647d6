"""Pinocchio's ABA in a Python loop: RK4 with a fixed step."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pinocchio as pin
from chain import Chain, Simulate

from biped_adrc.types import Array

H = 1e-3  # [s]


class PinocchioChain(Chain):
    """The package's own model, called as a user of Pinocchio would, without its checks."""

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        return self.biped.acceleration(q, v, force)

    def methods(self) -> Mapping[str, Simulate]:
        return {"aba in a Python loop, RK4 1 ms": self.rk4}

    def rk4(self, q: Array, v: Array, duration: float) -> Array:
        """q after `duration` [s]."""
        pinned = self.biped.pinned
        model, data, zero = pinned.model, pinned.data, np.zeros(pinned.model.nv)
        x, w = pinned.T @ q, pinned.T @ v
        for _ in range(round(duration / H)):
            a1 = pin.aba(model, data, x, w, zero)
            w2 = w + 0.5 * H * a1
            a2 = pin.aba(model, data, x + 0.5 * H * w, w2, zero)
            w3 = w + 0.5 * H * a2
            a3 = pin.aba(model, data, x + 0.5 * H * w2, w3, zero)
            w4 = w + H * a3
            a4 = pin.aba(model, data, x + H * w3, w4, zero)
            x = x + (H / 6.0) * (w + 2.0 * (w2 + w3) + w4)
            w = w + (H / 6.0) * (a1 + 2.0 * (a2 + a3) + a4)
        end: Array = np.linalg.solve(pinned.T, x)
        return end
