"""Sensors on a computer whose touchdowns are noticed at sample instants, as `closed_loop.noticing` has it.

A touchdown that is noticed comes with the measurement of that instant. It is seen in the old labels
first, so that rates go on; these are relabelled, and the sample instant that follows at once reads
nothing again. The state is that of the sensors inside, and 1 between touchdown and sample instant.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from biped_adrc.engine.mechanics import RobotStructure
from biped_adrc.errors import InputError
from biped_adrc.hardware.sensing import Sensor, SensorLaws
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.types import Array, Indices


@dataclass(frozen=True)
class Noticed(Sensor):
    """`inner` on a robot with this structure. Raises InputError where labels do not exchange in pairs."""

    inner: Sensors
    robot: RobotStructure

    def __post_init__(self) -> None:
        R, offset = self.robot.R, self.robot.offset
        if np.any(np.eye(len(R)) != R @ R) or np.any(R @ offset + offset != 0.0):
            raise InputError(
                "the labels of this robot's joints do not exchange in pairs at a touchdown, so what was "
                "measured has no old labels; leave out touchdown"
            )

    def start(self, k: Any, q: Array, v: Array) -> Array:
        return np.concatenate((self.inner.start(k, q, v), np.zeros(1)))

    def laws(self, n: int, p: int, period: float) -> SensorLaws:
        inner = self.inner.laws(n, p, period)
        sense, impact, seen = _around(inner, self.robot.R, self.robot.offset)
        return SensorLaws(inner.parameters, inner.size + 1, sense, impact, seen)


def _around(inner: SensorLaws, R: Indices, offset: Array) -> tuple[Callable[..., Any], ...]:
    """sense, impact and seen of the module, around those of the sensors inside."""
    sensed, struck, sight = inner.sense, inner.impact, inner.seen

    def sense(k: Any, w: Array, q: Array, v: Array) -> Array:
        after = np.where(w[-1] > 0.5, w[:-1], sensed(k, w[:-1], q, v))
        return np.concatenate((after, np.zeros(1)))

    def impact(k: Any, w: Array, q: Array, v: Array, v_model: Array) -> Array:
        q_old, v_old = R @ q + offset, R @ v
        before = sensed(k, w[:-1], q_old, v_old)
        rates = sight(k, before, q_old, v_old)[1]
        return np.concatenate((struck(k, before, q, v, R @ rates), np.ones(1)))

    def seen(k: Any, w: Array, q: Array, v: Array) -> tuple[Array, Array]:
        found: tuple[Array, Array] = sight(k, w[:-1], q, v)
        return found

    return sense, impact, seen
