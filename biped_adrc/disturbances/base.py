"""A disturbance: the generalised force zeta of (1), and the times at which it is not smooth.

    D(q) q'' + Omega(q, q') = B u + zeta(t, step, t_start, q, q')

zeta (n,) [N m] acts on all coordinates q1..qN, the unactuated pitch among them. The controller does not know
it. Where it comes from a force in the world, the ground has to carry that force too: `resultant` (2,) [N].

A disturbance is a pure function, so a run may be repeated and an integration step repeated. It is written as
the method `torque`, which both engines run. `acts` says when it acts; `zeta` and `net_force` are zero at other
times. Integrators end their steps at `switching_times`, since a method of high order loses its accuracy across
a jump.

`closed_loop.walker` evaluates it, `scenario.build` makes it by name.

*Torques over a window*: a pulse, a step, a sine, band-limited noise.

`TorquePulse` is constant over a window, with vertical edges or edges of finite slope:

    zeta = amplitude (r(t - start) - r(t - stop)),   r(s) = s / rise between 0 and 1

Its integral is amplitude (stop - start) whatever the rise; without a rise r is the unit step. The pushes of
the paper have vertical edges. An observer of a disturbance that changes slowly is judged more fairly by edges
that take some milliseconds, as a push of a hand does.

`TorqueStep` sets in and stays through all later steps: zeta = amplitude from onset on. It stands for a load
that is picked up, or a friction that nobody modelled. An observer with one extended state (m = 1) finds it
without a steady error, a PD controller leaves an error that falls with its gains. Joints swap names at impact,
so a torque on one leg's joints stays with the leg that stands, not with the metal.

`TorqueSine` is sinusoidal over a window: zeta = amplitude sin(2 pi f (t - start)). It shows how fast a
disturbance an observer follows: the estimate of one with a bandwidth w_o lags behind by a phase that grows
with 2 pi f / w_o. It begins at zero without a jump and ends with one, unless the window holds a whole number
of half periods.

`TorqueNoise` is band-limited noise over a window, without a state: a sum of K sines with random phases.

    zeta_i = amplitude_i sqrt(2/K) sum_k sin(2 pi f_ik s + phi_ik),   s = t - start

f_ik is drawn evenly from the k-th of K equal parts of (0, bandwidth), so the spectrum is flat, the mean square
over a long window is amplitude_i^2, and the sum is close to normally distributed (Shinozuka, Deodatis, Applied
Mechanics Reviews 44(4), 1991). It is smooth and a pure function of time: it asks for no ticks and repeats by
its seed. White noise drawn at each sample instant would be neither: its effect would depend on the step of the
integrator.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass, field

import numpy as np

from biped_adrc.core.checks import (
    NonNegativeFloat,
    NonNegativeInt,
    PositiveFloat,
    PositiveInt,
    check_part,
    numbers,
    returned,
)
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import SETUP, Part, derived, setup
from biped_adrc.core.types import Array


class Disturbance(Part):
    """A pure function of time, step and state: write `torque`. `a + b` adds two of them up.

    A class may also write `acts`, the times where it jumps in `switches`, and `resultant` for a force from
    outside.

    >>> @dataclass(frozen=True)
    ... class Damping(ba.Disturbance):
    ...     d: float  # [N m s/rad]
    ...
    ...     def torque(self, t, step, t_start, q, v):
    ...         return -self.d * v
    >>> Damping(0.5).torque(0.0, 1, 0.0, gait.q_minus, np.ones(5))
    array([-0.5, -0.5, -0.5, -0.5, -0.5])
    """

    @abstractmethod
    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta (n,) [N m] at time t [s] in single support `step` (from 1), which began at t_start [s].

        q (n,) [rad], v (n,) [rad/s]: the state of the plant. It is called only where the disturbance acts.
        """

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        """External force (F_x, F_z) (2,) [N] on the robot as a whole, zero for torques between links.

        The ground carries m (p_com'' - g) less this force. It is called only where the disturbance acts.
        """
        return np.zeros(2)

    def acts(self, t: float, step: int, t_start: float) -> float:
        """A number above 0 where torque and resultant act; elsewhere they are zero and not computed."""
        return 1.0

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """Times (step, s) at which it is not smooth: s [s] after that single support began,
        or after the run for step 0.
        """
        return ()

    def check_size(self, n: int) -> None:
        """Raise InputError where the disturbance is known to have another number of coordinates than n."""

    @property
    def terms(self) -> tuple[Disturbance, ...]:
        """The disturbances of which it is the sum; each term is compiled by itself."""
        return (self,)

    def zeta(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """The sum of `torque` (n,) [N m] over the terms that act.

        Raises InputError for a torque of another shape, NotFiniteError for NaN.
        """
        total = np.zeros(len(q))
        for term in self.terms:
            if term.acts(t, step, t_start) > 0:
                total += returned(term.torque(t, step, t_start, q, v), total.shape, term, "torque")
        return total

    def net_force(self, t: float, step: int, t_start: float) -> Array:
        """The sum of `resultant` (2,) [N] over the terms that act."""
        total = np.zeros(2)
        for term in self.terms:
            if term.acts(t, step, t_start) > 0:
                total += term.resultant(t, step, t_start)
        return total

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        """Times [s] of the run at which the torque is not smooth in this step, which began at t_start [s]."""
        return tuple(s if at == 0 else t_start + s for at, s in self.switches if at in (0, step))

    @property
    def pulls(self) -> bool:
        """Whether a force acts on the robot as a whole, so that `resultant` may differ from zero."""
        return any(type(term).resultant is not Disturbance.resultant for term in self.terms)

    def __add__(self, other: Disturbance) -> Disturbance:
        check_part(other, f"what is added to a {type(self).__name__}", Disturbance)
        return Sum((*summands(self), *summands(other)))


@dataclass(frozen=True)
class Sum(Disturbance):
    """The sum of several disturbances; zero if there are none."""

    parts: tuple[Disturbance, ...] = ()

    @property
    def terms(self) -> tuple[Disturbance, ...]:
        return tuple(term for part in self.parts for term in part.terms)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return self.zeta(t, step, t_start, q, v)

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        return self.net_force(t, step, t_start)

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        return tuple(edge for part in self.parts for edge in part.switches)

    def check_size(self, n: int) -> None:
        for part in self.parts:
            part.check_size(n)


def summands(disturbance: Disturbance) -> tuple[Disturbance, ...]:
    """The parts of a sum, or the disturbance itself."""
    return disturbance.parts if isinstance(disturbance, Sum) else (disturbance,)


@dataclass(frozen=True)
class Windowed(Disturbance):
    """A torque that acts between `start` and `stop` [s].

    amplitude (n,) [N m] acts on q1..qN, actuated or not. With `step`, from 1, the window counts from the start
    of that single support and closes at its end at the latest; without, from the start of the run. The base of
    pulse, step, sine and noise, which write `torque` in the window.

    Raises InputError for an amplitude that is not one row of finite numbers, a window that is empty or
    begins before 0, and a step below 1.
    """

    amplitude: Array
    step: PositiveInt | None = setup(None)
    start: float = 0.0
    stop: float = math.inf

    def __post_init__(self) -> None:
        amplitude = numbers(self.amplitude, "torque amplitude")
        finite = amplitude.ndim == 1 and np.all(np.isfinite([*amplitude, self.start]))
        if not (finite and 0.0 <= self.start < self.stop):
            raise InputError(
                f"torque amplitude is {amplitude} over [{self.start}, {self.stop}] s, expected one finite "
                "number [N m] per coordinate, and 0 <= start < stop"
            )
        amplitude.setflags(write=False)
        object.__setattr__(self, "amplitude", amplitude)

    def check_size(self, n: int) -> None:
        if len(self.amplitude) != n:
            raise InputError(
                f"{type(self).__name__} has an amplitude of {len(self.amplitude)} numbers, expected {n}, one "
                "for each coordinate (0 where nothing acts)"
            )

    @derived
    def support(self) -> float:
        """Number of the single support in which the window opens, as a float; 0 where it counts
        from the start of the run.
        """
        return float(self.step or 0)

    @derived
    def end(self) -> float:
        """Time from which the torque is zero [s], counted as `start`."""
        return float(self.stop)

    def onset(self, t_start: float) -> float:
        """Time of the run at which the window opens [s], for a single support that began at t_start [s]."""
        return 1.0 * (self.support > 0) * t_start + self.start

    def acts(self, t: float, step: int, t_start: float) -> float:
        """A number above 0 in the window, start <= t < end, and 0 outside.

        A product of comparisons in place of `if`, so that it runs on symbols too.
        """
        counted = 1.0 * (self.support > 0)  # from the start of its step; else from that of the run
        here = 1.0 - counted + counted * (step == self.support)
        return here * (t >= self.onset(t_start)) * (t < counted * t_start + self.end)

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """Both ends of the window, where the torque jumps; (step, time in it [s])."""
        ends = (self.start, self.stop)
        return tuple((self.step or 0, float(s)) for s in ends if math.isfinite(s))


@dataclass(frozen=True)
class WindowedTorque(Windowed):
    """A torque amplitude * profile(time since onset) in its window: the shortest way to write one's own.

    >>> @dataclass(frozen=True)
    ... class Decaying(ba.WindowedTorque):
    ...     def profile(self, s):
    ...         return np.exp(-s / 0.1)
    >>> push = Decaying([-60.0, -60.0, 0.0, 0.0, 0.0], step=3, start=0.1)
    >>> push.switching_times(3, 1.0)
    (1.1,)
    """

    @abstractmethod
    def profile(self, s: float) -> float:
        """Factor on the amplitude [1], s [s] after onset."""

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return self.amplitude * self.profile(float(t - self.onset(t_start)))


@dataclass(frozen=True)
class TorquePulse(Windowed):
    """A torque pulse, the push of the paper: amplitude (n,) [N m] over [start, stop) [s] of one step.

    rise [s]: the torque grows linearly from `start` to start + rise and falls from `stop` to stop + rise; 0
    for vertical edges. Raises InputError for a rise that is negative or not finite.

    >>> push = ba.TorquePulse([-60.0, -60.0, 0.0, 0.0, 0.0], step=10, start=0.1, stop=0.3)
    >>> push.switching_times(10, 4.0)
    (4.1, 4.3)
    """

    rise: NonNegativeFloat = field(default=0.0, kw_only=True)

    @derived
    def width(self) -> float:
        """Time from edge to edge [s]."""
        return float(self.stop) - float(self.start)

    @derived
    def end(self) -> float:
        """Time at which the falling edge has come to zero [s], counted as `start`."""
        return float(self.stop) + float(self.rise)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """Torque zeta = amplitude (r(t - start) - r(t - stop)) (n,) [N m], r the unit step
        or a ramp of length `rise`.

        The forms with vertical edges and with a rise are both computed and one is selected:
        machine code has no branch here.
        """
        s = t - self.onset(t_start)
        sloping = self.rise > 0.0
        rise = np.where(sloping, self.rise, 1.0)
        up, down = np.minimum(s / rise, 1.0), np.clip((s - self.width) / rise, 0.0, 1.0)
        return np.where(sloping, up - down, 1.0) * self.amplitude

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """The four corners, two where the edges are vertical; (step, time in it [s]).

        With a rise the torque has corners and no jumps; integrators stop there too, since rises are short.
        """
        step = self.step or 0
        rises = (0.0, float(self.rise)) if self.rise > 0 else (0.0,)
        corners = (end + rise for end in (float(self.start), float(self.stop)) for rise in rises)
        return tuple((step, s) for s in corners if math.isfinite(s))


@dataclass(frozen=True)
class TorqueStep(Windowed):
    """A torque step: amplitude (n,) [N m] from `start` [s] of single support `step` (or of the
    run) to the end of the run.

    Raises InputError for a stop that is not infinite.

    >>> load = ba.TorqueStep([-10.0, -10.0, 0.0, 0.0, 0.0], step=5)
    >>> load.zeta(3.0, 5, 2.9, np.zeros(5), np.zeros(5))
    array([-10., -10.,   0.,   0.,   0.])
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.stop != float("inf"):
            raise InputError("a torque step has no stop; use TorquePulse for a window")

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return 1.0 * self.amplitude

    def acts(self, t: float, step: int, t_start: float) -> float:
        """A number above 0 from onset on, in all later steps too."""
        later = 1.0 * (self.support > 0) * (step > self.support)
        return later + super().acts(t, step, t_start)


@dataclass(frozen=True)
class TorqueSine(Windowed):
    """A sinusoidal torque: amplitude (n,) [N m], frequency f [Hz], the window as in `Windowed`.

    Raises InputError for a frequency that is not positive.

    >>> sine = ba.TorqueSine([5.0, 5.0, 0.0, 0.0, 0.0], frequency=2.0)
    >>> sine.zeta(0.125, 1, 0.0, np.zeros(5), np.zeros(5))
    array([5., 5., 0., 0., 0.])
    """

    frequency: PositiveFloat = 1.0

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        s = t - self.onset(t_start)
        return self.amplitude * np.sin(2.0 * math.pi * self.frequency * s)


@dataclass(frozen=True)
class TorqueNoise(Windowed):
    """Band-limited noise of root mean square `amplitude` (n,) [N m], different on every coordinate.

    The spectrum is flat up to `bandwidth` [Hz] and zero above it. The same seed, of frequencies and phases,
    gives the same noise. sines: K, their number per coordinate; the more, the closer to a normal distribution,
    and the slower to evaluate. Raises InputError for a bandwidth or a number that is not positive, or a seed
    that is no whole number >= 0.

    >>> noise = ba.TorqueNoise([2.0, 2.0, 2.0, 2.0, 0.0], bandwidth=20.0, seed=1)
    >>> noise.zeta(0.3, 1, 0.0, np.zeros(5), np.zeros(5)).shape
    (5,)
    """

    bandwidth: PositiveFloat = field(kw_only=True)
    seed: NonNegativeInt = field(kw_only=True, metadata=SETUP)
    sines: PositiveInt = field(default=32, kw_only=True)

    @derived
    def drawn(self) -> tuple[Array, Array]:
        """Frequencies f [Hz] and phases phi [rad] of the sines, each (n, K)."""
        random, shape = np.random.default_rng(self.seed), (len(self.amplitude), self.sines)
        part = np.arange(self.sines) + random.uniform(size=shape)
        return self.bandwidth * part / self.sines, random.uniform(0.0, 2.0 * math.pi, shape)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        s, (frequencies, phases) = t - self.onset(t_start), self.drawn
        total = np.sin(2.0 * math.pi * frequencies * s + phases).sum(axis=1)
        return self.amplitude * math.sqrt(2.0 / self.sines) * total
