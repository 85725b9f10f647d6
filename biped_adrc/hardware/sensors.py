"""Encoders, in sampled time: what the controller sees of (q, q').

    y_k = q(t_k) + noise,   q^_k = resolution * round(y_k / resolution)
    v^_k = v^_(k-1) + (1 - exp(-T / tau)) ((q^_k - q^_(k-1)) / T - v^_(k-1))

or, for coordinates whose rate has a sensor of its own, v^_k = q' + noise. At impact velocities jump, and a
difference across it says nothing: v^ goes through the nominal model's impact (7), and the first tick after it
keeps that value.

The state w is (q^, v^, fresh, r): fresh is 1 where no difference can be taken, r the state of the noise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.hardware.random import SIZE, normals, seeded
from biped_adrc.types import Array


class SensorParameters(NamedTuple):
    """resolution, noise (n,) [rad], rate_noise (n,) [rad/s], the share 1 - exp(-T / tau) and T [s].

    differences (n,) of ints: 1 where the rate comes from differences; rounds (n,) of ints: 1 where angles are
    counts; noisy: 1 with noise.
    """

    resolution: Array
    noise: Array
    rate_noise: Array
    share: float
    period: float
    differences: Any
    rounds: Any
    noisy: int


def sensor_state(k: SensorParameters, q: Array, v: Array, r: Array) -> Array:
    """w at the start of a run and after an impact: nothing to take a difference from."""
    fresh = np.ones(1)
    return np.concatenate((rounded(k, q), v, fresh, r))


def rounded(k: SensorParameters, y: Array) -> Array:
    """The nearest count; y itself where angles are exact."""
    return np.where(k.rounds > 0, k.resolution * np.floor(y / k.resolution + 0.5), y)


def sense(k: SensorParameters, w: Array, q: Array, v: Array) -> Array:
    """w at a tick at (q, v)."""
    n = len(q)
    before, rate, fresh, r = w[:n], w[n : 2 * n], w[2 * n], w[2 * n + 1 :]
    y, dy = q, v
    if k.noisy > 0:
        r, g = normals(r, 2 * n)
        y, dy = q + k.noise * g[:n], v + k.rate_noise * g[n:]
    seen = rounded(k, y)
    difference = rate + k.share * ((seen - before) / k.period - rate)
    difference = np.where(fresh > 0.5, rate, difference)
    seen_rate = np.where(k.differences > 0, difference, dy)
    return np.concatenate((seen, seen_rate, np.zeros(1), r))


def sensed_impact(k: SensorParameters, w: Array, q: Array, v: Array, v_model: Array) -> Array:
    """w after an impact to (q, v); v_model (n,) is v^ taken through the nominal model's impact."""
    n = len(q)
    return sensor_state(k, q, np.where(k.differences > 0, v_model, v), w[2 * n + 1 :])


@dataclass(frozen=True)
class Sensors:
    """counts: of the joints' encoders per revolution, None for exact angles.

    pitch_resolution [rad]: of the unactuated pitch; None: as the joints'.
    noise, pitch_noise [rad], rate_noise [rad/s]: standard deviations, drawn anew at every tick.
    velocity: "differences" of the angles, "measured", or "gyro": differences, but for the pitch's own rate.
    filter_time [s]: time constant of the differences' low-pass, 0 for none.
    seed: of the noise. Raises InputError for what is negative or not finite.
    """

    counts: float | None = None
    pitch_resolution: float | None = None
    noise: float = 0.0
    pitch_noise: float = 0.0
    rate_noise: float = 0.0
    velocity: str = "differences"
    filter_time: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        if self.counts is not None and not (math.isfinite(self.counts) and self.counts >= 1):
            raise InputError(
                f"the encoders have {self.counts} counts per revolution, expected at least 1, or None "
                "for exact angles"
            )
        units = {"pitch_resolution": "rad", "noise": "rad", "pitch_noise": "rad"}
        units |= {"rate_noise": "rad/s", "filter_time": "s"}
        for name, unit in units.items():
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value >= 0.0):
                raise InputError(
                    f"the sensors' {name} is {value} {unit}, expected zero or a positive number"
                )
        if self.velocity not in VELOCITIES:
            raise InputError(
                f"the sensors' velocity is '{self.velocity}', expected one of {list(VELOCITIES)}"
            )
        if isinstance(self.seed, bool) or not isinstance(self.seed, int) or self.seed < 0:
            raise InputError(f"the sensors' seed is {self.seed!r}, expected a whole number from 0")

    @property
    def noisy(self) -> bool:
        """Whether anything is random."""
        return self.noise > 0.0 or self.pitch_noise > 0.0 or self.rate_noise > 0.0

    @cached_property
    def start(self) -> Array:
        """r at the start of a run: (6,), or none without noise."""
        return seeded(self.seed) if self.noisy else np.zeros(0)

    def size(self, n: int) -> int:
        """Numbers in w."""
        return 2 * n + 1 + (SIZE if self.noisy else 0)

    def parameters(self, n: int, p: int, period: float) -> SensorParameters:
        """What the laws need, for p joints among n coordinates and ticks every `period` [s]."""
        joints = np.arange(n) < p
        step = 0.0 if self.counts is None else 2.0 * math.pi / self.counts
        pitch = step if self.pitch_resolution is None else self.pitch_resolution
        share = 1.0 if self.filter_time == 0.0 else -math.expm1(-period / self.filter_time)
        gyro = joints if self.velocity == "gyro" else np.full(n, self.velocity == "differences")
        resolution = np.where(joints, step, pitch)
        return SensorParameters(
            np.where(resolution > 0.0, resolution, 1.0),
            np.where(joints, self.noise, self.pitch_noise),
            np.full(n, float(self.rate_noise)),
            share,
            float(period),
            gyro.astype(int),
            (resolution > 0.0).astype(int),
            int(self.noisy),
        )


VELOCITIES = ("differences", "measured", "gyro")
