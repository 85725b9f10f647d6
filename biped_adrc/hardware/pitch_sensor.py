"""An inertial sensor on the torso: the unactuated pitch and its rate, with a bias
and a drift, in sampled time.

    q_N^ = q_N + b + k d T + white noise,      v_N^ = v_N + d        at the k-th tick

d [rad/s] is the bias of the gyroscope, by which the integrated angle drifts, b [rad] the mounting error of the
sensor. It is put behind encoders, `Sensors(...) + PitchSensor(...)`, whose joints it leaves alone.

The state w is (q_N^, v_N^, b + k d T, r), r of the noise. After an impact the rate is read anew, the angle is
that of the last tick: at an impact the rate jumps and the angle does not.

No encoder of a joint measures the pitch, and Theta, by which the gait is timed, contains it. So a bias shifts
the whole step in phase, and a drift of the angle does so more and more from step to step.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.core.checks import FiniteFloat, NonNegativeFloat, NonNegativeInt
from biped_adrc.core.part import setup
from biped_adrc.core.types import Array
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.sensors import Sensors, normals, seeded


@dataclass(frozen=True)
class PitchSensor(Sensor):
    """An inertial sensor of the pitch: bias b [rad], drift d [rad/s], noise: standard
    deviation of the angle [rad].

    The noise is drawn at each tick, by `seed`, a whole number from 0. Raises InputError for numbers that are
    not finite or a noise that is negative.
    """

    bias: FiniteFloat = 0.0
    drift: FiniteFloat = 0.0
    noise: NonNegativeFloat = 0.0
    seed: NonNegativeInt = setup(0)

    @property
    def noisy(self) -> bool:
        return self.noise > 0.0

    def smooth(self) -> PitchSensor:
        return replace(self, noise=0.0)

    def on_computer(self, before: Sensor | None) -> Sensor | None:
        if isinstance(before, Sensors) and before.velocity == "differences":
            return replace(before, velocity="gyro")
        return before

    def errors(self, n: int, p: int, before: Array) -> Array:
        own = before.copy()
        own[n - 1], own[-1] = self.noise, 0.0
        return own

    def sampled(self, n: int, p: int, period: float) -> SampledPitchSensor:
        r = seeded(self.seed) if self.noisy else np.zeros(0)
        return SampledPitchSensor(self, float(self.drift * period), r)


@dataclass(frozen=True)
class SampledPitchSensor(Sensor):
    """`PitchSensor` for ticks every T, by the module's equations."""

    of: PitchSensor
    turn: float
    """Drift d T of the angle in a period [rad]."""
    random: Array
    """State r of the noise at the start of a run: (6,), or (0,) without noise."""

    @property
    def size(self) -> int:
        return 3 + len(self.random)

    def start(self, q: Array, v: Array) -> Array:
        at = np.array([q[-1] + self.of.bias, v[-1] + self.of.drift, self.of.bias])
        return np.concatenate((at, self.random))

    def sense(self, w: Array, q: Array, v: Array) -> Array:
        r, g = normals(w[3:], 1) if len(self.random) > 0 else (w[3:], np.zeros(1))
        off = np.array([w[2] + self.turn])
        return np.concatenate((q[-1:] + w[2] + self.of.noise * g, v[-1:] + self.of.drift, off, r))

    def impact(self, w: Array, q: Array, v: Array, v_model: Array) -> Array:
        return np.concatenate((w[:1], v[-1:] + self.of.drift, w[2:]))

    def reading(self, w: Array, q: Array, v: Array) -> tuple[Array, Array]:
        return np.concatenate((q[:-1], w[:1])), np.concatenate((v[:-1], w[1:2]))
