"""Sensors on a computer whose touchdowns are noticed at sample instants, as `closed_loop.semantics` has it.

A touchdown that is noticed comes with the measurement of that instant. It is seen in the old labels
first, so that rates go on; these are relabelled, and the sample instant that follows at once reads
nothing again. The state is that of the sensors inside, and 1 between touchdown and sample instant.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array, Indices
from biped_adrc.hardware.sensing import Sensor


@dataclass(frozen=True)
class Noticed(Sensor):
    """`inner` on a robot with q+ = R q- + offset. Raises InputError where labels do not exchange in pairs."""

    inner: Sensor
    R: Indices
    offset: Array

    def __post_init__(self) -> None:
        R, offset = self.R, self.offset
        if np.any(np.eye(len(R)) != R @ R) or np.any(R @ offset + offset != 0.0):
            raise InputError(
                "the labels of this robot's joints do not exchange in pairs at a touchdown, so what was "
                "measured has no old labels; leave out touchdown"
            )

    def sampled(self, n: int, p: int, period: float) -> Noticed:
        return replace(self, inner=self.inner.sampled(n, p, period))

    @property
    def size(self) -> int:
        return self.inner.size + 1

    def start(self, q: Array, v: Array) -> Array:
        return np.concatenate((self.inner.start(q, v), np.zeros(1)))

    def sense(self, w: Array, q: Array, v: Array) -> Array:
        after = np.where(w[-1] > 0.5, w[:-1], self.inner.sense(w[:-1], q, v))
        return np.concatenate((after, np.zeros(1)))

    def impact(self, w: Array, q: Array, v: Array, v_model: Array) -> Array:
        R = self.R
        q_old, v_old = R @ q + self.offset, R @ v
        before = self.inner.sense(w[:-1], q_old, v_old)
        rates = self.inner.reading(before, q_old, v_old)[1]
        return np.concatenate((self.inner.impact(before, q, v, R @ rates), np.ones(1)))

    def reading(self, w: Array, q: Array, v: Array) -> tuple[Array, Array]:
        return self.inner.reading(w[:-1], q, v)
