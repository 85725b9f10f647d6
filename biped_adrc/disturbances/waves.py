"""Torques over a window of time: a pulse, a step, a sine, band-limited noise.

zeta (n,) [N m] is the torque on all n coordinates, amplitude (n,) [N m] its size, t [s] the time, and start,
stop [s] the ends of the window, the onset being its beginning. step is the number of the single support,
t_start [s] the time at which it began.

`TorquePulse` is constant over a window; it rises and falls at once (vertical edges) or with a finite slope:

    zeta = amplitude (r(t - start) - r(t - stop)),   r(s) = s / rise between 0 and 1

Its integral is amplitude (stop - start) whatever the rise; without a rise r is the unit step. The pushes of
the paper have vertical edges. An observer of a disturbance that changes slowly is judged more fairly by edges
that take some milliseconds, as a push of a hand does.

`TorqueStep` sets in and stays through all later steps: zeta = amplitude from onset on. It stands for a load
that is picked up, or a friction that nobody modelled. An observer with one extended state (m = 1) estimates it
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

import math
from dataclasses import dataclass, field

import numpy as np

from biped_adrc.core.checks import NonNegativeFloat, NonNegativeInt, PositiveFloat, PositiveInt
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import SETUP, derived
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Windowed, WindowedTorque


@dataclass(frozen=True)
class TorquePulse(Windowed):
    """A torque pulse, the push of the paper: constant from start to stop in one single support.

    amplitude (n,) [N m]: on q1..qN. step: number of the single support, from 1; None: the window counts from
    the start of the run. start [s], stop [s]: ends of the window. rise [s]: the torque grows linearly from
    `start` to start + rise and falls from `stop` to stop + rise; 0 for vertical edges. Raises InputError for a
    rise that is negative or not finite.

    >>> push = ba.TorquePulse([-60.0, -60.0, 0.0, 0.0, 0.0], step=10, start=0.1, stop=0.3)
    >>> push.switching_times(10, 4.0)
    (4.1, 4.3)
    """

    rise: NonNegativeFloat = field(default=0.0, kw_only=True)

    @derived
    def width(self) -> float:
        """Time from the beginning of the rise to the beginning of the fall [s], stop - start."""
        return float(self.stop) - float(self.start)

    @derived
    def end(self) -> float:
        """Time at which the falling edge has come to zero [s], counted as `start`."""
        return float(self.stop) + float(self.rise)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta = amplitude (r(t - start) - r(t - stop)) (n,) [N m], r the unit step or a ramp of length `rise`.

        The forms with vertical edges and with a rise are both computed and one is selected: machine code has no
        branch here. It is called only within the window (`acts`), so the form with vertical edges is constant.
        """
        s = t - self.onset(t_start)
        sloping = self.rise > 0.0
        # 1 in place of 0: no division by zero in the form that is not selected
        rise = np.where(sloping, self.rise, 1.0)
        up, down = np.minimum(s / rise, 1.0), np.clip((s - self.width) / rise, 0.0, 1.0)
        return np.where(sloping, up - down, 1.0) * self.amplitude

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """The four corners, two where the edges are vertical: (step, or 0 for the run; time [s] since it
        began).

        With a rise the torque has corners and no jumps; integrators stop there too, since rises are short.
        """
        step = self.step or 0
        rises = (0.0, float(self.rise)) if self.rise > 0 else (0.0,)
        corners = (end + rise for end in (float(self.start), float(self.stop)) for rise in rises)
        return tuple((step, s) for s in corners if math.isfinite(s))


@dataclass(frozen=True)
class TorqueStep(Windowed):
    """A torque step, which stays to the end of the run.

    amplitude (n,) [N m]: on q1..qN. step: number of the single support, from 1; None: the time counts from the
    start of the run. start [s]: when it begins. stop [s]: infinite, for the torque has no end. Raises
    InputError for a stop that is not infinite.

    >>> load = ba.TorqueStep([-10.0, -10.0, 0.0, 0.0, 0.0], step=5)
    >>> load.zeta(3.0, 5, 2.9, np.zeros(5), np.zeros(5))
    array([-10., -10.,   0.,   0.,   0.])
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.stop != float("inf"):
            raise InputError("a torque step has no stop; use TorquePulse for a window")

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta = amplitude (n,) [N m]; `acts` keeps it from acting before its onset."""
        return 1.0 * self.amplitude

    def acts(self, t: float, step: int, t_start: float) -> float:
        """A number above 0 from onset on, in all later steps too."""
        # with a `step` (support > 0) the window closes with its single support, so later ones are added
        later = 1.0 * (self.support > 0) * (step > self.support)
        return later + super().acts(t, step, t_start)


@dataclass(frozen=True)
class TorqueSine(WindowedTorque):
    """A sinusoidal torque in its window, zero at onset.

    amplitude (n,) [N m]: on q1..qN. step: number of the single support, from 1; None: the window counts from
    the start of the run. start [s], stop [s]: ends of the window. frequency [Hz]: f. Raises InputError for a
    frequency that is not positive.

    >>> sine = ba.TorqueSine([5.0, 5.0, 0.0, 0.0, 0.0], frequency=2.0)
    >>> sine.zeta(0.125, 1, 0.0, np.zeros(5), np.zeros(5))
    array([5., 5., 0., 0., 0.])
    """

    frequency: PositiveFloat = 1.0

    def profile(self, s: float) -> float:
        """sin(2 pi f s), s [s] after the window has opened."""
        return np.sin(2.0 * math.pi * self.frequency * s)


@dataclass(frozen=True)
class TorqueNoise(Windowed):
    """Band-limited noise, different on every coordinate.

    amplitude (n,) [N m]: its root mean square on q1..qN. step: number of the single support, from 1; None: the
    window counts from the start of the run. start [s], stop [s]: ends of the window. bandwidth [Hz]: the
    spectrum is flat up to it and zero above. seed: of frequencies and phases, a whole number from 0; the same
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
        """Frequencies f [Hz] and phases phi [rad] of the sines, each (n, K), drawn from the seed.

        The frequency of sine k lies in the k-th of K equal parts of (0, bandwidth).
        """
        random, shape = np.random.default_rng(self.seed), (len(self.amplitude), self.sines)
        part = np.arange(self.sines) + random.uniform(size=shape)
        return self.bandwidth * part / self.sines, random.uniform(0.0, 2.0 * math.pi, shape)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta (n,) [N m], the module's sum of K sines at s = t - onset after the window has opened."""
        s, (frequencies, phases) = t - self.onset(t_start), self.drawn
        total = np.sin(2.0 * math.pi * frequencies * s + phases).sum(axis=1)
        return self.amplitude * math.sqrt(2.0 / self.sines) * total
