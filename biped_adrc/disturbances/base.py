"""What a disturbance is: the generalised force zeta of (1), and the times at which it is not smooth.

    D(q) q'' + Omega(q, q') = B u + zeta(t, step, t_start, q, q')

zeta (n,) [N m] acts on all coordinates q1..qN, the unactuated pitch among them. The controller does not know
it. Where it comes from a force in the world, the ground has to carry that force too: `resultant` (2,) [N].

A disturbance is a pure function, so a run may be repeated and a step of integration taken again. Most leaves
give `laws`, functions of numbers and arrays, which the engine turns into machine code; one that writes the
method `torque` alone runs in Python. Integrators end their steps at `switching_times`, since a method of high
order loses its accuracy across a jump.

It stands below `closed_loop.walker`, which evaluates it, and `scenario.disturbances`, which makes it by name.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import ClassVar, NamedTuple, Protocol

import numpy as np

from biped_adrc.composed import Composed
from biped_adrc.errors import InputError, check_count
from biped_adrc.parts import check_part, numbers, returned
from biped_adrc.shown import one_line
from biped_adrc.types import Array

GAUSS = 0.5773502691896257
"""1 / sqrt(3): nodes of Gauss's rule on [-1, 1], both of weight 1."""


class DisturbanceLaw(NamedTuple):
    """The pure function behind a disturbance: zeta = torque(parameters, t, step, t_start, q, v).

    The numbers are kept apart from the functions, so that disturbances which differ in numbers alone share one
    machine code.
    """

    parameters: object
    """k, a NamedTuple of numbers and float64 arrays."""
    torque: Callable[..., Array]
    """zeta (n,) [N m]."""
    switches: tuple[tuple[int, float], ...] = ()
    """(step, s): not smooth s [s] after that single support began, or for step 0 at the time s of the run."""
    resultant: Callable[..., Array] | None = None
    """`Disturbance.resultant` (2,) [N] as resultant(parameters, t, step, t_start, q, v), of time alone; None is
    zero."""
    active: Callable[..., float] | None = None
    """active(parameters, t, step, t_start): above 0 where torque and resultant act, elsewhere they are zero and
    not asked for. None: they always act."""
    obstacle: str = ""
    """Why it runs in Python only; empty where it compiles."""

    def acts(self, t: float, step: int, t_start: float) -> bool:
        """Whether torque and resultant act."""
        return self.active is None or self.active(self.parameters, t, step, t_start) > 0

    def __repr__(self) -> str:
        return one_line(self)


class Disturbance(Composed):
    """A pure function of time, step and state: give `laws`, or write `torque`. `a + b` adds two of them up.

    A class that writes `torque` may name the times where it jumps in `switches`, and write `resultant` when it
    is a force from outside.
    """

    _kind: ClassVar[str] = "disturbance"
    _methods: ClassVar[frozenset[str]] = frozenset(("torque", "resultant"))

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...] | None:
        """The torque is their sum; None for a disturbance written as a method alone."""
        return None

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta (n,) [N m] at time t [s] in single support `step` (from 1), which began at t_start [s].

        q (n,) [rad], v (n,) [rad/s]: the state of the plant. Raises InputError where there is neither a law nor
        a method, and for a law that gives another shape.
        """
        if self._laws is None:
            raise InputError(
                f"{type(self).__name__} has neither laws nor a method torque(t, step, t_start, q, v); write "
                "one of them: zeta (n,) [N m]"
            )
        total = np.zeros(len(q))
        for law in self._laws:
            if law.acts(t, step, t_start):
                zeta = law.torque(law.parameters, t, step, t_start, q, v)
                total += returned(zeta, total.shape, self, "torque", finite=False)
        return total

    def check_size(self, n: int) -> None:
        """Raise InputError where this is known beforehand to be of other coordinates than n."""

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        """Force (F_x, F_z) (2,) [N] from outside on the robot as a whole, zero for torques between links.

        The ground carries m (p_com'' - g) less this force.
        """
        total, still = np.zeros(2), np.zeros(0)
        for law in self._laws or ():
            if law.resultant is not None and law.acts(t, step, t_start):
                total += law.resultant(law.parameters, t, step, t_start, still, still)
        return total

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        """Times [s] of the run at which the torque is not smooth in this step, which began at t_start [s]."""
        return tuple(s if at == 0 else t_start + s for at, s in self.switches if at in (0, step))

    def impulse(self, t0: float, t1: float, step: int, t_start: float) -> Array:
        """The integral of `resultant` from t0 to t1 (2,) [N s], by two points of Gauss in each smooth piece.

        Exact for a resultant that is a polynomial of degree 3 in each piece, as all packaged ones but the sine
        and noise are.
        """
        inside = sorted(s for s in self.switching_times(step, t_start) if t0 < s < t1)
        total = np.zeros(2)
        for a, b in pairwise([t0, *inside, t1]):
            middle, half = 0.5 * (a + b), 0.5 * (b - a)
            for node in (middle - GAUSS * half, middle + GAUSS * half):
                total += half * self.resultant(node, step, t_start)
        return total

    @property
    def pulls(self) -> bool:
        """Whether it has a resultant at all; without one, `impulse` need not be asked for."""
        written = type(self).resultant is not Disturbance.resultant
        return written or any(law.resultant is not None for law in self._laws or ())

    @property
    def _obstacle(self) -> str:
        """As `Composed._obstacle`; a resultant written as a method keeps it in Python as well."""
        written = type(self).resultant is not Disturbance.resultant
        if written and all(law.resultant is None for law in self._laws or ()):
            return (
                f"disturbance {type(self).__name__} has a resultant and no law of it; give "
                "DisturbanceLaw(..., resultant=...)"
            )
        return super()._obstacle

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """(step, s) as `DisturbanceLaw.switches`; of a disturbance without laws, none that are known."""
        return tuple(edge for law in self._laws or () for edge in law.switches)

    def __add__(self, other: Disturbance) -> Disturbance:
        check_part(other, f"what is added to a {type(self).__name__}", Disturbance)
        return Sum((*terms(self), *terms(other)))


def disturbance_laws(disturbance: Disturbance) -> tuple[DisturbanceLaw, ...]:
    """The laws of a disturbance, or its methods as a law, which runs in Python only and says so.

    The closed loop thus has one way to evaluate a disturbance, whether it was written as laws or as methods.
    """
    if not disturbance._obstacle:
        return disturbance._laws or ()
    made = DisturbanceLaw(disturbance, type(disturbance).torque, disturbance.switches, resultant)
    return (made if disturbance.pulls else made._replace(resultant=None),)


def resultant(k: Disturbance, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
    """The method `resultant`, which is a function of time alone, as a law."""
    return k.resultant(t, step, t_start)


@dataclass(frozen=True)
class Sum(Disturbance):
    """The sum of several disturbances; of none, zero. Its laws are those of all parts, one after the other."""

    parts: tuple[Disturbance, ...] = ()

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...]:
        """Those of all parts; a part without laws stands for itself, and keeps the others compiled."""
        return tuple(law for part in self.parts for law in disturbance_laws(part))

    def check_size(self, n: int) -> None:
        for part in self.parts:
            part.check_size(n)

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        return tuple(s for part in self.parts for s in part.switching_times(step, t_start))


def terms(disturbance: Disturbance) -> tuple[Disturbance, ...]:
    """The parts of a sum, or the disturbance itself."""
    return disturbance.parts if isinstance(disturbance, Sum) else (disturbance,)


class WindowParameters(NamedTuple):
    """A window in time, as numbers for a law.

    amplitude (n,) [N m]; step, 0 when the window counts from the start of the run; start, stop [s].
    """

    amplitude: Array
    step: float
    start: float
    stop: float
    """Infinite for a window that stays open."""


def onset(k: WindowParameters, t_start: float) -> float:
    """Time of the run at which the window opens [s], for a single support that began at t_start [s]."""
    return 1.0 * (k.step > 0) * t_start + k.start


def within(k: WindowParameters, t: float, step: int, t_start: float) -> float:
    """Above 0 in the window, start <= t < stop, and 0 outside.

    A product of comparisons in place of `if`, so that the same function runs on numbers and as machine code.
    """
    counted = 1.0 * (k.step > 0)  # from the start of its step; else from that of the run
    here = 1.0 - counted + counted * (step == k.step)
    return here * (t >= onset(k, t_start)) * (t < counted * t_start + k.stop)


class WithWindow(Protocol):
    """Parameters of a law that acts in a window alone."""

    @property
    def window(self) -> WindowParameters:
        """When it acts."""


def window_acts(k: WithWindow, t: float, step: int, t_start: float) -> float:
    """Above 0 in the window of parameters that have one; what such a law gives as `active`."""
    return within(k.window, t, step, t_start)


@dataclass(frozen=True)
class Windowed(Disturbance):
    """A torque between `start` and `stop` [s].

    amplitude (n,) [N m] acts on q1..qN, actuated or not. With `step` the window counts from the start of
    that single support and closes at its end at the latest; without, from the start of the run. The base of
    pulse, step, sine and noise: a leaf gives `windowed`, the law of its shape in time.

    Raises InputError for an amplitude that is not one row of finite numbers, a window that is empty or begins
    before 0, and a step below 1.
    """

    amplitude: Array
    step: int | None = None
    """Single support, counted from 1."""
    start: float = 0.0
    """[s] from the start of that step, or of the run."""
    stop: float = math.inf
    """[s], counted as `start`; the torque is zero from then on."""

    def __post_init__(self) -> None:
        amplitude = numbers(self.amplitude, "torque amplitude")
        if amplitude.ndim != 1 or not np.all(np.isfinite(amplitude)):
            raise InputError(
                f"torque amplitude is {amplitude}, expected one finite number [N m] per coordinate"
            )
        if not (math.isfinite(self.start) and self.start >= 0 and self.stop > self.start):
            raise InputError(
                f"torque window is [{self.start}, {self.stop}] s, expected 0 <= start < stop"
            )
        if self.step is not None:
            check_count(
                self.step, f"torque step is {self.step}; single supports are counted from 1"
            )
        amplitude.setflags(write=False)
        object.__setattr__(self, "amplitude", amplitude)

    def check_size(self, n: int) -> None:
        if len(self.amplitude) != n:
            raise InputError(
                f"{type(self).__name__} has an amplitude of {len(self.amplitude)} numbers, expected {n}, one "
                "for each coordinate (0 where nothing acts)"
            )

    @cached_property
    def window(self) -> WindowParameters:
        """The window as the numbers that `onset` and `within` take."""
        return WindowParameters(
            self.amplitude, float(self.step or 0), float(self.start), float(self.stop)
        )

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """As `DisturbanceLaw.switches`: both ends of the window, where the torque jumps."""
        ends = (self.start, self.stop)
        return tuple((self.step or 0, float(s)) for s in ends if math.isfinite(s))

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...] | None:
        """The one law `windowed`, with the times at which this window switches."""
        law = self.windowed
        return None if law is None else (law._replace(switches=self.switches),)

    @property
    def windowed(self) -> DisturbanceLaw | None:
        """The law of the torque in the window; None for one written as a method.

        `laws` puts `switches` into it.
        """
        return None


@dataclass(frozen=True)
class WindowedTorque(Windowed):
    """amplitude * profile(time since onset) in its window: the shortest way to write a torque of one's own.

    It is written as a method, so a walk with it runs in Python; give `windowed` where it has to be fast.
    """

    @abstractmethod
    def profile(self, s: float) -> float:
        """Factor on the amplitude, s [s] after onset."""

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        if not within(self.window, t, step, t_start) > 0:
            return np.zeros(len(self.amplitude))
        return self.amplitude * self.profile(float(t - onset(self.window, t_start)))
