"""One-step methods behind one interface: RK4, Dormand-Prince 8(5, 3), Radau IIA.

A method yields steps over a smooth segment [t, t_end]. A step can give its own state at any time
inside it (`at`), to the accuracy of the method; the simulator locates events with that. The
compiled loops have RK4 and Exponential too; the latter is in `exponential`.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.integrate import DOP853, RK45, OdeSolver, Radau

from biped_adrc.errors import (
    NotFiniteError,
    RanAwayError,
    SingularError,
    check_positive,
)
from biped_adrc.hybrid.relaxation import relaxation
from biped_adrc.hybrid.system import HybridSystem, Mode, Relaxing, Split
from biped_adrc.types import Array

Form = Split | Relaxing
"""What a method may know of a system beside its flow: its stiff part."""
Flow = Callable[[float, Array], Array]
"""f(t, x) -> x'."""
LANDING = 1e-9
"""A last step longer than h by this fraction [1] is still one step: round-off in the count of steps."""


LOST = (NotFiniteError, RanAwayError, SingularError)
"""What a flow may raise at a state that means nothing."""


class StepFailed(Exception):
    """The method cannot go on; the text is the solver's own."""


@dataclass(frozen=True)
class Step:
    """One step of a method, from (t0, x0) to (t1, x1); times [s], states (nx,)."""

    t0: float
    t1: float
    x0: Array
    x1: Array
    dx0: Array
    """Slope x' at the start (nx,)."""
    dx1: Array
    """Slope x' at the end (nx,)."""
    at: Callable[[float], Array]
    """at(t) -> x(t) (nx,) for t0 <= t <= t1, to the order of the method."""


class OneStepMethod(ABC):
    """Base of the methods: yields the steps of a smooth segment. A user's own needs `steps` and `label`."""

    def split(self, system: HybridSystem, mode: Mode) -> Form | None:
        """The form of `system` that the method steps in; None for x' = f(t, x) itself. Raises
        InputError for none.
        """
        return None

    @abstractmethod
    def steps(
        self, f: Flow, split: Form | None, t: float, x: Array, t_end: float
    ) -> Iterator[Step]:
        """Steps from (t, x) to t_end [s] under x' = f(t, x), x (nx,); in `split` where it is not None."""

    @property
    @abstractmethod
    def label(self) -> str:
        """The method and its step or tolerance, for records."""


def step_ends(t: float, t_end: float, h: float) -> Iterator[float]:
    """t + h, t + 2h, ..., t_end [s]; counted, not accumulated, so that round-off does not grow."""
    count = max(1, math.ceil((t_end - t) / h - LANDING))
    for k in range(1, count):
        yield t + k * h
    yield t_end


@dataclass(frozen=True)
class RK4(OneStepMethod):
    """The classical explicit Runge-Kutta method of order 4 with fixed step h [s]."""

    h: float = 1e-3

    def __post_init__(self) -> None:
        check_positive(self.h, f"step h [s] is {self.h}")

    @property
    def label(self) -> str:
        return f"RK4, h = {self.h:g} s"

    def split(self, system: HybridSystem, mode: Mode) -> Relaxing | None:
        return system.relaxing()

    def steps(
        self, f: Flow, split: Form | None, t: float, x: Array, t_end: float
    ) -> Iterator[Step]:
        """Steps from (t, x), x (nx,), to t_end [s]; inside a step `at` takes a shorter one from its start."""
        if isinstance(split, Relaxing):
            yield from _relaxing_steps(f, split, t, x, step_ends(t, t_end, self.h))
            return
        dx = f(t, x)
        for t1 in step_ends(t, t_end, self.h):
            x1 = rk4(f, t, x, dx, t1 - t)
            dx1 = f(t1, x1)

            def at(s: float, t: float = t, x: Array = x, dx: Array = dx) -> Array:
                return rk4(f, t, x, dx, s - t)

            yield Step(t, t1, x, x1, dx, dx1, at)
            t, x, dx = t1, x1, dx1


def rk4(f: Flow, t: float, x: Array, dx: Array, h: float) -> Array:
    """x (nx,) after one RK4 step of length h [s] from (t, x), dx = f(t, x)."""
    k2 = f(t + 0.5 * h, x + 0.5 * h * dx)
    k3 = f(t + 0.5 * h, x + 0.5 * h * k2)
    k4 = f(t + h, x + h * k3)
    return x + (h / 6.0) * (dx + 2.0 * (k2 + k3) + k4)


def _relaxing_steps(
    f: Flow, r: Relaxing, t: float, x: Array, ends: Iterator[float]
) -> Iterator[Step]:
    """As `RK4.steps` to these `ends` [s], with what relaxes exact."""
    for t1 in ends:
        dx, x1 = relaxing_rk4(f, r, t, x, t1 - t)

        def at(s: float, t: float = t, x: Array = x) -> Array:
            return relaxing_rk4(f, r, t, x, s - t)[1]

        yield Step(t, t1, x, x1, dx, f(t1, x1), at)
        t, x = t1, x1


def relaxing_rk4(f: Flow, r: Relaxing, t: float, x: Array, h: float) -> tuple[Array, Array]:
    """x' at the start and x (nx,) after one RK4 step of length h [s], by the weights of `relaxation`.

    The slope is that of the stage, for dense output: no steeper than a cubic without overshoot may be.
    """
    theta = r.speed * h
    first, middle, last, end = relaxation(theta)
    aim, gap = x[r.to], x[r.at] - x[r.to]

    def slope(c: float, y: Array, weight: float) -> Array:
        y[r.at] = aim + weight * gap
        return f(t + c * h, y)

    k1 = slope(0.0, x.copy(), first)
    k2 = slope(0.5, x + 0.5 * h * k1, middle)
    k3 = slope(0.5, x + 0.5 * h * k2, middle)
    k4 = slope(1.0, x + h * k3, last)
    x1 = x + (h / 6.0) * (k1 + 2.0 * (k2 + k3) + k4)
    x1[r.at] = aim + end * gap
    k1[r.at] = -min(theta, 3.0) / h * gap if h > 0.0 else 0.0
    return k1, x1


CROWDED, CROWDED_STEP = 1000, 1e-6
"""So many steps in a row of a method with step control may not be shorter on average than this [s]; on a torque
that chatters they would go on for days.
"""


@dataclass(frozen=True)
class _SciPy(OneStepMethod):
    """A SciPy solver, used one step at a time; events are located on its own dense output.

    - rtol [1], atol: relative and absolute tolerance of a step.
    - max_step [s]: longest step, so that the event functions are looked at often enough.
    """

    rtol: float = 1e-9
    atol: float = 1e-9
    max_step: float = 0.02

    _solver = RK45

    def __post_init__(self) -> None:
        for name in ("rtol", "atol", "max_step"):
            check_positive(getattr(self, name), f"{name} is {getattr(self, name)}")

    @property
    def label(self) -> str:
        return f"{type(self).__name__}, rtol = {self.rtol:g}, atol = {self.atol:g}"

    def steps(
        self, f: Flow, split: Form | None, t: float, x: Array, t_end: float
    ) -> Iterator[Step]:
        """Steps from (t, x), x (nx,), to t_end [s].

        A flow that raises one of LOST at a trial state, or is not finite there, gives NaN, and the
        solver rejects the step; the error is raised only where the solver gives up. Raises
        StepFailed with the solver's message otherwise.
        """
        last: Exception | None = None  # of the last trial; lost: of any in this step
        lost: Exception | None = None

        def tried(t: float, x: Array) -> Array:
            nonlocal last, lost
            try:
                dx, last = f(t, x), None
                if not np.all(np.isfinite(dx)):
                    lost = NotFiniteError(f"the slope is not finite at t = {t:.6g} s")
            except LOST as error:  # a step too long, which is rejected
                dx, last = np.full_like(x, np.nan), last or error
                lost = error
            return dx

        t0, x0, dx0 = t, x, f(t, x)
        if not np.all(np.isfinite(dx0)):  # of which SciPy's first step would never end
            raise NotFiniteError(f"the slope is not finite at t = {t:.6g} s")
        solver: OdeSolver = self._solver(
            tried, t, x, t_end, rtol=self.rtol, atol=self.atol, max_step=self.max_step
        )
        mark, count = t, 0
        while solver.status == "running":
            lost, count = None, count + 1
            try:
                message = solver.step()
            except ValueError:  # of SciPy's linear algebra, which takes no NaN
                if lost is None:
                    raise
                raise lost from None
            if solver.status == "failed":
                if last is not None:
                    raise last
                raise StepFailed(f"{type(self).__name__} at t = {solver.t:.6g} s: {message}")
            if count % CROWDED == 0:
                if solver.t - mark < CROWDED * CROWDED_STEP:
                    raise StepFailed(
                        f"{type(self).__name__} at t = {solver.t:.6g} s: the last {CROWDED} steps took "
                        f"{solver.t - mark:.1g} s together, since the torque jumps or chatters; take a method "
                        "of fixed step, such as RK4(1e-3), or a greater tolerance"
                    )
                mark = solver.t
            x1 = solver.y.copy()
            dx1 = f(solver.t, x1)
            yield Step(t0, solver.t, x0, x1, dx0, dx1, solver.dense_output())
            t0, x0, dx0 = solver.t, x1, dx1


@dataclass(frozen=True)
class Adaptive(_SciPy):
    """The explicit pair of Dormand and Prince of order 8(5, 3), with step control, as SciPy's DOP853."""

    _solver = DOP853


@dataclass(frozen=True)
class Stiff(_SciPy):
    """Radau IIA of order 5, implicit, with step control; for the observer of Table I as it stands."""

    _solver = Radau
