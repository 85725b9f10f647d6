"""One-step methods behind one interface.

A method yields steps over a smooth segment [t, t_end]. A step can give its own state at any time inside it
(`at`), to the accuracy of the method; the loop locates events with that.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy.integrate import DOP853, RK45, OdeSolver, Radau

from biped_adrc.errors import InputError, NotFiniteError, SingularError
from biped_adrc.hybrid.system import HybridSystem, Mode, Split
from biped_adrc.types import Array

Flow = Callable[[float, Array], Array]
LANDING = 1e-9  # a last step longer than h by this fraction is still one step, dimensionless


class StepFailed(Exception):
    """The method cannot go on; the text is the solver's own."""


@dataclass(frozen=True)
class Step:
    """From (t0, x0) to (t1, x1) with slopes dx0, dx1 at the ends."""

    t0: float
    t1: float
    x0: Array
    x1: Array
    dx0: Array
    dx1: Array
    at: Callable[[float], Array]


class OneStepMethod(ABC):
    """Yields the steps of a smooth segment."""

    compiled_form: ClassVar[str] = ""
    """Name of the same method in the compiled loops; empty for one that runs in Python only."""

    def split(self, system: HybridSystem, mode: Mode) -> Split | None:
        """The coordinates of `system` that the method steps in; None for x itself."""
        return None

    @abstractmethod
    def steps(
        self, f: Flow, split: Split | None, t: float, x: Array, t_end: float
    ) -> Iterator[Step]:
        """Steps from (t, x) to t_end under x' = f(t, x)."""

    @property
    @abstractmethod
    def label(self) -> str:
        """The method and its step or tolerance, for records."""


def step_ends(t: float, t_end: float, h: float) -> Iterator[float]:
    """t + h, t + 2h, ..., t_end; counted, not accumulated."""
    count = max(1, math.ceil((t_end - t) / h - LANDING))
    for k in range(1, count):
        yield t + k * h
    yield t_end


def check_step(h: float, what: str) -> None:
    """Raise InputError unless h is positive and finite."""
    if not (math.isfinite(h) and h > 0):
        raise InputError(f"{what} is {h}, expected a positive number")


@dataclass(frozen=True)
class RK4(OneStepMethod):
    """The classical explicit Runge-Kutta method of order 4 with fixed step h [s]."""

    compiled_form: ClassVar[str] = "rk4"

    h: float = 1e-3

    def __post_init__(self) -> None:
        check_step(self.h, "step h [s]")

    @property
    def label(self) -> str:
        return f"RK4, h = {self.h:g} s"

    def steps(
        self, f: Flow, split: Split | None, t: float, x: Array, t_end: float
    ) -> Iterator[Step]:
        dx = f(t, x)
        for t1 in step_ends(t, t_end, self.h):
            x1 = rk4(f, t, x, dx, t1 - t)
            dx1 = f(t1, x1)

            def at(s: float, t: float = t, x: Array = x, dx: Array = dx) -> Array:
                return rk4(f, t, x, dx, s - t)

            yield Step(t, t1, x, x1, dx, dx1, at)
            t, x, dx = t1, x1, dx1


def rk4(f: Flow, t: float, x: Array, dx: Array, h: float) -> Array:
    """One step of length h from (t, x), dx = f(t, x)."""
    k2 = f(t + 0.5 * h, x + 0.5 * h * dx)
    k3 = f(t + 0.5 * h, x + 0.5 * h * k2)
    k4 = f(t + h, x + h * k3)
    return x + (h / 6.0) * (dx + 2.0 * (k2 + k3) + k4)


@dataclass(frozen=True)
class _SciPy(OneStepMethod):
    """A SciPy solver, used one step at a time; events are located on its own dense output."""

    rtol: float = 1e-9
    atol: float = 1e-9
    max_step: float = 0.02

    _solver = RK45

    def __post_init__(self) -> None:
        for name in ("rtol", "atol", "max_step"):
            check_step(getattr(self, name), name)

    @property
    def label(self) -> str:
        return f"{type(self).__name__}, rtol = {self.rtol:g}, atol = {self.atol:g}"

    def steps(
        self, f: Flow, split: Split | None, t: float, x: Array, t_end: float
    ) -> Iterator[Step]:
        last: NotFiniteError | SingularError | None = None

        def tried(t: float, x: Array) -> Array:
            nonlocal last
            try:
                dx, last = f(t, x), None
            except (NotFiniteError, SingularError) as error:  # a step too long, which is rejected
                dx, last = np.full_like(x, np.nan), last or error
            return dx

        solver: OdeSolver = self._solver(
            tried, t, x, t_end, rtol=self.rtol, atol=self.atol, max_step=self.max_step
        )
        t0, x0, dx0 = t, x, f(t, x)
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                if last is not None:
                    raise last
                raise StepFailed(f"{type(self).__name__} at t = {solver.t:.6g} s: {message}")
            x1 = solver.y.copy()
            dx1 = f(solver.t, x1)
            yield Step(t0, solver.t, x0, x1, dx0, dx1, solver.dense_output())
            t0, x0, dx0 = solver.t, x1, dx1


@dataclass(frozen=True)
class Adaptive(_SciPy):
    """The explicit pair of Dormand and Prince of order 8(5, 3), with step control."""

    compiled_form: ClassVar[str] = "dop853"
    _solver = DOP853


@dataclass(frozen=True)
class Stiff(_SciPy):
    """Radau IIA of order 5, implicit, with step control; for the observer of Table I as it stands."""

    _solver = Radau
