"""A disturbance: the generalised force zeta of (1) of the paper, and the times at which it is not smooth.

    D(q) q'' + Omega(q, q') = B u + zeta(t, step, t_start, q, q')

D is the inertia matrix, Omega (n,) [N m] the Coriolis and gravity terms, B u the motors' torques. step is the
number of the single support, from 1, and t_start [s] the time at which it began. zeta (n,) [N m] acts on all
coordinates q1..qN, the unactuated pitch among them. The controller does not know it. Where it comes from a
force in the world, the ground has to carry that force too: `resultant` (2,) [N].

A disturbance is a pure function, so a run or an integration step may be repeated. It is written as the method
`torque`, which both engines run: Python on numbers, the compiler on symbols. `acts` says when it acts; `zeta`
and `net_force` are zero at other times. Integrators end their steps at `switching_times`, since a method of
high order loses its accuracy across a jump. A sum has several terms, and each is compiled by itself.

A `derived` value is computed once from the fields, and is a number in machine code; `setup` marks a field that
machine code does not read.

`closed_loop.walker` evaluates it, `scenario.build` makes it by name.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from biped_adrc.core.checks import PositiveInt, check_part, numbers, returned
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import Part, derived, setup
from biped_adrc.core.types import Array, read_only


class Disturbance(Part):
    """A pure function of time, single support and state: write `torque`. `a + b` is the sum of two.

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

    SUCH_AS = "TorquePulse([30, 30, 30, 30, 0], step=3, start=0.1, stop=0.3); a sum is a + b"

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
        """A number above 0 where torque and resultant act; elsewhere they are zero and not computed.

        It is a number and no bool, so that it can be computed on symbols for machine code.
        """
        return 1.0

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """Times (step, s) at which it is not smooth: s [s] after single support `step` began; for step 0 after
        the start of the run.
        """
        return ()

    def check_size(self, n: int) -> None:
        """Raise InputError where the torque has not n coordinates, in a subclass that knows their number
        without computing the torque; others are found out in the walk."""

    @property
    def terms(self) -> tuple[Disturbance, ...]:
        """The disturbances of which it is the sum, sums within it resolved; itself where it is none."""
        return (self,)

    def zeta(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta (n,) [N m]: the sum of `torque` over the terms that act, zero where none does.

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
        """Times [s] of the run at which the torque is not smooth in single support `step`.

        t_start [s]: when it began. All switches that count from the start of the run are among them, also those
        that lie in other single supports.
        """
        return tuple(s if at == 0 else t_start + s for at, s in self.switches if at in (0, step))

    @property
    def pulls(self) -> bool:
        """Whether a force from outside may act on the robot as a whole: one of the terms writes `resultant`."""
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


NO_PUSH = Sum()
"""A disturbance without terms, for a loop that has none."""


def summands(disturbance: Disturbance) -> tuple[Disturbance, ...]:
    """The parts of a sum, or the disturbance itself as the only one."""
    return disturbance.parts if isinstance(disturbance, Sum) else (disturbance,)


@dataclass(frozen=True)
class Windowed(Disturbance):
    """A torque that acts between `start` and `stop` [s], its window.

    amplitude (n,) [N m] acts on q1..qN, actuated or not. With `step`, from 1, the window counts from the start
    of that single support and closes at its end at the latest; without, from the start of the run. The base of
    pulse, step, sine and noise, which write `torque` in the window.

    Raises InputError for an amplitude that is not one row of finite numbers, a window that is empty or
    begins before 0, and a step below 1.
    """

    SUCH_AS = "a TorquePulse; add up several OnLink for a sum"

    amplitude: Array
    step: PositiveInt | None = setup(None)
    start: float = 0.0
    stop: float = math.inf

    def __post_init__(self) -> None:
        amplitude = read_only(numbers(self.amplitude, "torque amplitude"))
        finite = amplitude.ndim == 1 and np.all(np.isfinite([*amplitude, self.start]))
        if not (finite and 0.0 <= self.start < self.stop):
            raise InputError(
                f"torque amplitude is {amplitude} over [{self.start}, {self.stop}] s, expected one finite "
                "number [N m] per coordinate, and 0 <= start < stop"
            )
        object.__setattr__(self, "amplitude", amplitude)

    def check_size(self, n: int) -> None:
        if (size := len(self.amplitude)) != n:
            raise InputError(f"{type(self).__name__} has {size} amplitudes, expected {n}")

    @derived
    def support(self) -> float:
        """Number of the single support in which the window opens; 0 where it counts from the start of the run.

        It is a float, since in machine code floats are data: another step needs no new code.
        """
        return float(self.step or 0)

    @derived
    def end(self) -> float:
        """Time from which the torque is zero [s], counted as `start`: here `stop`; a subclass whose
        torque falls along a ramp after `stop` returns the end of the ramp.
        """
        return float(self.stop)

    def onset(self, t_start: float) -> float:
        """Time of the run at which the window opens [s], for a single support that began at t_start [s].

        t_start counts only where the window has a `step`.
        """
        # support: `step` as a float, 0 for None
        return 1.0 * (self.support > 0) * t_start + self.start

    def acts(self, t: float, step: int, t_start: float) -> float:
        """A number above 0 in the window, start <= t < end (counted from t_start if it has a `step`), else 0.

        A product of comparisons in place of `if`, so that it runs on symbols too.
        """
        # 1 where times count from the start of its single support, 0 where from the start of the run;
        # here: 1 in its single support, and in all of them without a `step`
        counted = 1.0 * (self.support > 0)
        here = 1.0 - counted + counted * (step == self.support)
        return here * (t >= self.onset(t_start)) * (t < counted * t_start + self.end)

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """Both ends of the window, where the torque jumps, as (step, or 0 for the run; time [s] since it
        began).
        """
        ends = (self.start, self.stop)
        return tuple((self.step or 0, float(s)) for s in ends if math.isfinite(s))


@dataclass(frozen=True)
class WindowedTorque(Windowed):
    """A torque amplitude * profile(time since onset) in its window: the shortest way to write one's own.

    amplitude (n,) [N m]: on q1..qN. step: number of the single support, from 1; None: the window counts from
    the start of the run. start [s], stop [s]: ends of the window.

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
        # float(): the user's profile gets a plain number; on symbols the engine's float() changes nothing
        return self.amplitude * self.profile(float(t - self.onset(t_start)))
