"""Encoders and an inertial sensor, in sampled time: the measured (q, q').

    y_k = q(t_k) + noise,   c_k = resolution * round(y_k / resolution)
    q^_k = q^_(k-1) + (1 - exp(-T / tau_q)) (c_k - q^_(k-1))
    v^_k = v^_(k-1) + (1 - exp(-T / tau)) ((q^_k - q^_(k-1)) / T - v^_(k-1))

at the tick (sample instant) t_k, with the sampling period T and the time constants tau_q of a low-pass on the
angles of joints with motors and tau of one on rates, 0 for none; or, for
coordinates whose rate has a sensor of its own, v^_k = q' + noise. At impact velocities jump, and a difference
across it is no rate: v^ is mapped by the nominal model's impact, (7) of the paper, and the first tick after it
keeps that value. The low-pass of the angles begins anew there.

The noise is a pure function of its state: MRG32k3a, in doubles that hold whole numbers exactly.

    x_n = (1403580 x_(n-2) - 810728 x_(n-3)) mod m_1,   m_1 = 2^32 - 209
    y_n = (527612 y_(n-1) - 1370589 y_(n-3)) mod m_2,   m_2 = 2^32 - 22853
    u_n = ((x_n - y_n) mod m_1) / (m_1 + 1), m_1 in place of 0

L'Ecuyer, Operations Research 47(1), 1999. Normal numbers are made by Box and Muller. The state of the generator
is r = (x_(n-3), x_(n-2), x_(n-1), y_(n-3), y_(n-2), y_(n-1)). Functions take and return it, so that the same
seed gives the same run, and an integrator may repeat a tick.

An inertial sensor on the torso measures the unactuated pitch and its rate, with a bias and a drift:

    q_N^ = q_N + b + k d T + white noise,      v_N^ = v_N + d        at the k-th tick

d [rad/s] is the bias of the gyroscope, by which the integrated angle drifts, b [rad] the mounting error of the
sensor. It is put behind encoders, `Sensors(...) + PitchSensor(...)`, whose joints it leaves alone.

After an impact the rate is read anew, and the angle is that of the last tick: at an impact the pitch rate jumps
and the pitch does not.

No encoder of a joint measures the pitch, and Theta, by which the gait is timed, contains it. So a bias shifts
the whole walking step in phase, and a drift of the angle does so more and more from step to step.

The methods that have no text of their own here do what `hardware.sensing.Sensor` says. `derived` values are
computed once from the fields; `setup` marks a field that machine code does not read.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, NamedTuple

import numpy as np

from biped_adrc.core.checks import FiniteFloat, NonNegativeFloat, NonNegativeInt, Range, one_of
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import derived, setup
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, Indices
from biped_adrc.hardware.sensing import Sensor

CountsFloat = Annotated[float, Range("at least 1 count", lambda x: 1.0 <= x < math.inf)]


@dataclass(frozen=True)
class Sensors(Shown, Sensor):
    """Encoders of the joints with motors, and the sensor of the pitch; joints without motors have its values.

    counts [1]: of the joints' encoders per revolution, None for exact angles. pitch_resolution [rad]: of the
    unactuated pitch; None: as the joints'. noise [rad], pitch_noise [rad], rate_noise [rad/s]: standard
    deviations of joint angles, the pitch and measured rates, drawn anew at every tick. velocity: "differences"
    of the angles, "measured", or "gyro": differences, but for the pitch's own rate. filter_time [s]: time
    constant of the differences' low-pass, angle_filter [s]: of the low-pass on the angles of joints with
    motors, 0 for none. seed: of the noise, a whole number from 0. Raises InputError for numbers that are
    negative or not finite.

    >>> sensors = ba.Sensors(counts=10000, noise=1e-5, seed=1)
    >>> timing = ba.SampledTime(1e-3)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, sensors=sensors)
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    comes_first: ClassVar[bool] = True
    counts: CountsFloat | None = None
    pitch_resolution: NonNegativeFloat | None = None
    noise: NonNegativeFloat = 0.0
    pitch_noise: NonNegativeFloat = 0.0
    rate_noise: NonNegativeFloat = 0.0
    velocity: Annotated[str, one_of(("differences", "measured", "gyro"))] = "differences"
    filter_time: NonNegativeFloat = 0.0
    seed: NonNegativeInt = 0
    angle_filter: NonNegativeFloat = 0.0

    @property
    def noisy(self) -> bool:
        """Whether any noise is above 0."""
        return self.noise > 0.0 or self.pitch_noise > 0.0 or self.rate_noise > 0.0

    def smooth(self) -> Sensors:
        """These sensors without noise and rounding; differences and their low-pass remain."""
        exact = replace(self, noise=0.0, pitch_noise=0.0, rate_noise=0.0)
        return replace(exact, counts=None, pitch_resolution=None)

    def on_computer(self, before: Sensor | None) -> Sensor | None:
        """The sensor that stands for the software on the controller's computer: differences of angles and their
        low-pass, without noise and counts; where rates are measured, nothing of these sensors runs there.

        before: the software of the sensors before these, None without any. Raises InputError for a low-pass on
        the angles beside measured rates.
        """
        if self.angle_filter and self.velocity == "measured":
            raise InputError("a low-pass on angles needs rates by differences or gyro here")
        return before if self.velocity == "measured" else self.smooth()

    def errors(self, n: int, p: int, before: Array) -> Array:
        """Standard deviations (2 n,) [rad, rad/s] of the errors of angles and rates at one tick.

        n: number of coordinates, p: of motors. A uniform error over one count has the standard deviation count
        / sqrt(12). A rate from differences has no error of its own, since it follows from the angles. Encoders
        read the true q, so the errors `before` (2 n,) of sensors before these do not enter; nor does the
        period, for which `sampled` gets 1 s.
        """
        k = self.sampled(n, p, 1.0)
        counts = np.where(k.rounds > 0, k.resolution, 0.0)
        rates = np.where(k.differences > 0, 0.0, k.rate_noise)
        return np.concatenate((np.hypot(k.noise, counts / math.sqrt(12.0)), rates))

    def sampled(self, n: int, p: int, period: float) -> SampledSensors:
        """The sensors with one number for each of the n coordinates, for ticks every `period` [s].

        The first p have the encoders of joints; the others, the pitch among them, the values of the pitch.
        """
        # joints (n,): which coordinates have encoders; count: angle of one count [rad], 0 for exact angles
        joints = np.arange(n) < p
        count = 0.0 if self.counts is None else 2.0 * math.pi / self.counts
        pitch = count if self.pitch_resolution is None else self.pitch_resolution
        share, of_angle = (
            1.0 if time == 0.0 else -math.expm1(-period / time)
            for time in (self.filter_time, self.angle_filter)
        )
        differs = joints if self.velocity == "gyro" else np.full(n, self.velocity == "differences")
        resolution = np.where(joints, count, pitch)
        # in the order of the fields of SampledSensors
        return SampledSensors(
            # 1 in place of 0: `rounded` divides by it everywhere
            np.where(resolution > 0.0, resolution, 1.0),
            np.where(joints, self.noise, self.pitch_noise),
            float(self.rate_noise),
            share,
            np.where(joints, of_angle, 1.0) if self.angle_filter else np.zeros(0),
            float(period),
            differs.astype(int),
            (resolution > 0.0).astype(int),
            seeded(self.seed) if self.noisy else np.zeros(0),
        )


class Sensed(NamedTuple):
    """State of `Sensors`."""

    angle: Array
    """Measured angles of the last tick (n,) [rad]."""
    rate: Array
    """Measured rates (n,) [rad/s]."""
    fresh: float
    """1 at a start and after an impact, where no difference of angles can be taken yet; else 0."""
    r: Array
    """State of the random numbers (6,), or (0,) without noise."""


class Pitch(NamedTuple):
    """State of a `PitchSensor`."""

    angle: float
    """Measured pitch [rad]."""
    rate: float
    """Measured pitch rate [rad/s]."""
    off: float
    """Bias with the drift so far, b + k d T [rad]; the next measurement contains it."""
    r: Array
    """State of the random numbers (6,), or (0,) without noise."""


@dataclass(frozen=True)
class SampledSensors(Sensor):
    """`Sensors` on n coordinates, for ticks every `period` [s]: counts, noise, differences and their
    low-pass.
    """

    resolution: Array
    """Resolution of the angles (n,) [rad]; 1 where `rounds` is 0, without meaning."""
    noise: Array
    """Standard deviation of the angles' noise (n,) [rad]."""
    rate_noise: float
    """Standard deviation of the noise of measured rates [rad/s]."""
    share: float
    """1 - exp(-T / tau) [1], the part of a new difference in v^; 1 without low-pass."""
    angle_share: Array
    """1 - exp(-T / tau_q) (n,) [1], the part of a new angle in q^; (0,) without low-pass."""
    period: float
    """T [s]."""
    differences: Indices
    """(n,), 1 where the rate comes from differences, else 0."""
    rounds: Indices
    """(n,), 1 where angles are counts, else 0."""
    random: Array
    """State r of the noise at the start of a run: (6,), or (0,) without noise."""

    @property
    def noisy(self) -> bool:
        return len(self.random) > 0

    def start(self, q: Array, v: Array) -> Sensed:
        """State at the start: angles without noise, and the true rates, as no difference exists yet (`fresh`
        is 1).
        """
        return Sensed(self.rounded(q), v, 1.0, self.random)

    def sense(self, w: Sensed, q: Array, v: Array) -> Sensed:
        """State after a tick at the true q (n,) [rad], v (n,) [rad/s], by the equations of the module."""
        n = len(q)
        # before: angles of the last tick; y, dy: angles and rates with noise, g (2 n,) of unit variance
        before, rate, fresh, r = w
        y, dy = q, v
        if self.noisy:
            r, g = normals(r, 2 * n)
            y, dy = q + self.noise * g[:n], v + self.rate_noise * g[n:]
        angle = self.rounded(y)
        if len(self.angle_share) > 0:
            angle = before + self.angle_share * (angle - before)
        difference = rate + self.share * ((angle - before) / self.period - rate)
        # after an impact the difference would reach across it, so the rate is kept for one tick
        difference = np.where(fresh > 0.5, rate, difference)
        rate = np.where(self.differences > 0, difference, dy)
        return Sensed(angle, rate, 0.0, r)

    def impact(self, w: Sensed, q: Array, v: Array, v_model: Array) -> Sensed:
        """State after an impact to q, v: rates from differences become v_model, others v, all without noise."""
        rate = np.where(self.differences > 0, v_model, v)
        # 1.0 (`fresh`): no difference is taken at the next tick, so that the rate stays
        return Sensed(self.rounded(q), rate, 1.0, w.r)

    def reading(self, w: Sensed, q: Array, v: Array) -> tuple[Array, Array]:
        # w holds the readings of the last tick; the readings q, v of sensors before these are not needed
        return w.angle, w.rate

    def rounded(self, y: Array) -> Array:
        """The angles y (n,) [rad], rounded to the nearest count (n,) [rad]; y itself where angles are exact."""
        return np.where(self.rounds > 0, self.resolution * np.floor(y / self.resolution + 0.5), y)


M_1, M_2 = 4294967087.0, 4294944443.0
"""Moduli m_1 and m_2 of the random numbers, as floats."""


def seeded(seed: int) -> Array:
    """State r (6,) of the random numbers from a seed; neighbouring seeds give independent states."""
    words = np.random.SeedSequence(seed).generate_state(6, np.uint32).astype(float)
    # entries from 1 to m_1 - 1, and to m_2 - 1: the generator never leaves three zeros
    return 1.0 + words % np.repeat([M_1 - 1.0, M_2 - 1.0], 3)


def modulo(a: float, m: float) -> float:
    """a mod m, from 0 to m - 1, for whole numbers |a| < 2^53 held as floats.

    It is exact: where the rounded quotient a / m is off by one, the two last lines correct the result.
    """
    b = a - np.floor(a / m) * m
    b = np.where(b < 0.0, b + m, b)
    return np.where(b >= m, b - m, b)


def uniforms(r: Array, count: int) -> tuple[Array, Array]:
    """Draw `count` uniform numbers in (0, 1) from the state r (6,); returns the next state and the numbers."""
    x0, x1, x2, y0, y1, y2 = r[0], r[1], r[2], r[3], r[4], r[5]
    u = np.zeros(count)
    for i in range(count):
        x = modulo(1403580.0 * x1 - 810728.0 * x0, M_1)
        y = modulo(527612.0 * y2 - 1370589.0 * y0, M_2)
        x0, x1, x2, y0, y1, y2 = x1, x2, x, y1, y2, y
        z = modulo(x - y, M_1)
        u[i] = np.where(z > 0.0, z, M_1) / (M_1 + 1.0)
    return np.array([x0, x1, x2, y0, y1, y2]), u


def normals(r: Array, count: int) -> tuple[Array, Array]:
    """Draw `count` independent standard normal numbers by Box and Muller from the state r (6,); returns the
    next state (6,) and the numbers (count,). They come in pairs, so for an odd count the last one is dropped.
    """
    pairs = (count + 1) // 2
    r, u = uniforms(r, 2 * pairs)
    g = np.zeros(2 * pairs)
    for i in range(pairs):
        radius, angle = np.sqrt(-2.0 * np.log(u[2 * i])), 2.0 * math.pi * u[2 * i + 1]
        g[2 * i], g[2 * i + 1] = radius * np.cos(angle), radius * np.sin(angle)
    return r, g[:count]


@dataclass(frozen=True)
class PitchSensor(Sensor):
    """An inertial sensor of the pitch: bias b [rad], drift d [rad/s], noise: standard
    deviation of the angle [rad].

    The noise is drawn at each tick, by `seed`, a whole number from 0. period [s]: of the ticks, in which the
    angle drifts by d T; set by `sampled`. Raises InputError for numbers that are
    not finite or a noise that is negative.
    """

    bias: FiniteFloat = 0.0
    drift: FiniteFloat = 0.0
    noise: NonNegativeFloat = 0.0
    seed: NonNegativeInt = setup(0)
    period: float = setup(0.0)

    @property
    def noisy(self) -> bool:
        return self.noise > 0.0

    def smooth(self) -> PitchSensor:
        return replace(self, noise=0.0)

    def on_computer(self, before: Sensor | None) -> Sensor | None:
        """The software on the controller's computer: only that of the sensors before it, `before`, or None.

        Where this takes differences of all angles, that of the pitch is left out ("gyro"), as the pitch's rate
        is measured here.
        """
        if isinstance(before, Sensors) and before.velocity == "differences":
            return replace(before, velocity="gyro")
        return before

    def errors(self, n: int, p: int, before: Array) -> Array:
        """Standard deviations (2 n,) [rad, rad/s] of the random errors in (q^, v^) behind this sensor.

        before (2 n,): those of the encoders before it. The pitch, the last of the n coordinates, has this
        sensor's noise [rad], its rate 0; bias and drift are not random.
        """
        own = before.copy()
        own[n - 1], own[-1] = self.noise, 0.0
        return own

    def sampled(self, n: int, p: int, period: float) -> PitchSensor:
        return replace(self, period=float(period))

    @derived
    def turn(self) -> float:
        """Drift d T of the angle in a period [rad]."""
        return float(self.drift * self.period)

    @derived
    def random(self) -> Array:
        """State r of the noise at the start of a run: (6,), or (0,) without noise."""
        return seeded(self.seed) if self.noisy else np.zeros(0)

    def start(self, q: Array, v: Array) -> Pitch:
        """State at the start of a run: pitch q[-1] with the bias, its rate with the drift, no noise."""
        return Pitch(q[-1] + self.bias, v[-1] + self.drift, self.bias, self.random)

    def sense(self, w: Pitch, q: Array, v: Array) -> Pitch:
        """State after a tick: pitch q[-1] with bias, drift so far and noise, its rate with the drift."""
        r, g = normals(w.r, 1) if len(self.random) > 0 else (w.r, np.zeros(1))
        angle = q[-1] + w.off + self.noise * g[0]
        return Pitch(angle, v[-1] + self.drift, w.off + self.turn, r)

    def impact(self, w: Pitch, q: Array, v: Array, v_model: Array) -> Pitch:
        """State after an impact, which led to q, v (n,): a gyroscope feels the jump of the rate, v[-1]; the
        pitch itself does not jump. v_model, the rates by the model's impact, is for encoders and not used
        here."""
        return w._replace(rate=v[-1] + self.drift)

    def reading(self, w: Pitch, q: Array, v: Array) -> tuple[Array, Array]:
        """q, v (n,) as the encoders before it read them, with the last entries, the pitch, of this sensor."""
        angle, rate = np.array([w.angle]), np.array([w.rate])
        return np.concatenate((q[:-1], angle)), np.concatenate((v[:-1], rate))
