"""One-step methods of integration: RK4, and SciPy's DOP853.

`RK4` has a fixed step [s]. `Adaptive` is SciPy's DOP853, with step control; it is a `Solver`, which runs in
Python and not in the compiled engine. A `Solver` yields its steps between two times at which the flow is not
smooth, such as sample instants and impacts; `Step.at(t)` gives the state inside a step, so that events can be
located. `hybrid.march` itself computes the steps of `RK4` and of `exponential.Exponential`.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.core.checks import Checked, PositiveFloat
from biped_adrc.core.errors import NotFiniteError, RanAwayError, SingularError
from biped_adrc.core.types import Array

Flow = Callable[[float, Array], Array]
"""f(t, x) -> x' (nx,), for t [s] and x (nx,)."""


class StepFailed(Exception):
    """The method cannot go on; the text is the solver's own."""


class Step(NamedTuple):
    """One integration step of a solver: its end, and the way there."""

    t: float
    """Time at its end [s]."""
    x: Array
    """State (nx,)."""
    dx: Array
    """Slope x' (nx,)."""
    at: Callable[[float], Array]
    """x (nx,) at a time [s] within the step, to the order of the method."""


class OneStepMethod(ABC):
    """Base of the integration methods."""

    SUCH_AS = "RK4(1e-3)"
    """Example of a method, for error messages."""

    @property
    @abstractmethod
    def label(self) -> str:
        """Text with the method and its step or tolerance, which is stored with a run."""


@dataclass(frozen=True)
class RK4(Checked, OneStepMethod):
    """The classical explicit Runge-Kutta method of order 4 with a fixed step.

    h [s]: length of the step.

    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    >>> ba.walk(walker, gait, impacts=1, method=ba.RK4(5e-4)).impacts
    1
    """

    h: PositiveFloat = 1e-3

    @property
    def label(self) -> str:
        return f"RK4, h = {self.h:g} s"


class Solver(OneStepMethod):
    """Base of the methods that step in Python; one of a user's own needs `steps` and `label`."""

    @abstractmethod
    def steps(self, f: Flow, t: float, x: Array, t_end: float) -> Iterator[Step]:
        """Iterate over integration steps from (t, x), x (nx,), of which the last ends at t_end [s].

        The flow x' = f(t, x) is smooth in between.
        """


CROWDED, CROWDED_STEP = 1000, 1e-6
"""CROWDED steps in a row of a method with step control may not be shorter on average than CROWDED_STEP [s]; on
a torque that chatters such a run would take days."""


@dataclass(frozen=True)
class Adaptive(Checked, Solver):
    """The explicit pair of Dormand and Prince of order 8(5, 3), with step control, as SciPy's DOP853.

    rtol [1], atol: bounds on the error of a step, relative to the state and in its units [rad, rad/s].
    max_step [s]: length of the longest step, so that the event functions are looked at often enough. Events are
    located on its own dense output.

    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    >>> method = ba.Adaptive(rtol=1e-8, atol=1e-8)
    >>> ba.walk(walker, gait, impacts=1, method=method, engine="pinocchio").impacts
    1
    """

    rtol: PositiveFloat = 1e-9
    atol: PositiveFloat = 1e-9
    max_step: PositiveFloat = 0.02

    @property
    def label(self) -> str:
        return f"Adaptive, rtol = {self.rtol:g}, atol = {self.atol:g}"

    def steps(self, f: Flow, t: float, x: Array, t_end: float) -> Iterator[Step]:
        """Iterate over the steps of DOP853 from (t, x), x (nx,), to t_end [s] under x' = f(t, x).

        Where f raises NotFiniteError, RanAwayError or SingularError, as at a trial state that no motion can
        have, the solver gets NaN and tries a shorter step. If it gives up, that error is raised, or StepFailed
        where f raised none. Raises StepFailed also for steps that are too short (CROWDED), and NotFiniteError
        where f is not finite at (t, x).
        """
        from scipy.integrate import DOP853  # it takes long to load

        last: Exception | None = None  # the first error since f had a value

        def tried(t: float, x: Array) -> Array:
            nonlocal last
            try:
                dx, last = f(t, x), None
            # a step too long, which is rejected
            except (NotFiniteError, RanAwayError, SingularError) as error:
                dx, last = np.full_like(x, np.nan), last or error
            return dx

        if not np.all(np.isfinite(f(t, x))):  # SciPy would look for its first step without end
            raise NotFiniteError(f"the slope is not finite at t = {t:.6g} s")
        solver = DOP853(tried, t, x, t_end, rtol=self.rtol, atol=self.atol, max_step=self.max_step)
        mark, count = t, 0  # time of the last check for crowded steps, and number of steps
        while solver.status == "running":
            count += 1
            message = solver.step()
            if solver.status == "failed":
                if last is not None:
                    raise last
                raise StepFailed(f"Adaptive at t = {solver.t:.6g} s: {message}")
            # a torque that chatters makes the steps ever shorter; every CROWDED steps their mean is checked
            if count % CROWDED == 0:
                # so many steps on the average below CROWDED_STEP [s] are given up
                if solver.t - mark < CROWDED * CROWDED_STEP:
                    raise StepFailed(
                        f"Adaptive at t = {solver.t:.6g} s: the last {CROWDED} steps took "
                        f"{solver.t - mark:.1g} s together, since the torque jumps or chatters; take a method "
                        "of fixed step, such as RK4(1e-3), or a greater tolerance"
                    )
                mark = solver.t
            x1 = solver.y.copy()
            yield Step(solver.t, x1, f(solver.t, x1), solver.dense_output())
