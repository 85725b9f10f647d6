"""One-step methods behind one interface: RK4, Dormand-Prince 8(5, 3), Radau IIA, and ETD-RK4.

A method yields steps over a smooth segment [t, t_end]. A step can give its own state at any time
inside it (`at`), to the accuracy of the method; the simulator locates events with that. The
compiled loops have RK4, Adaptive and Exponential too (`compiled_form`).

The exponential Runge-Kutta method ETD-RK4 is for a flow whose stiff part is linear. In the
coordinates of `Split`, E' = A E + N_E(t, p, E) and p' = N_p(t, p, E). A is integrated exactly
through the phi-functions; p sees the classical RK4 (Cox, Matthews, J. Comput. Phys. 176, 2002, eqs
(26)-(29)):

    a = e^(hA/2) E + h/2 phi1(hA/2) N(E)
    b = e^(hA/2) E + h/2 phi1(hA/2) N(a)
    c = e^(hA/2) a + h/2 phi1(hA/2) (2 N(b) - N(E))
    E1 = e^(hA) E + h [(phi1 - 3 phi2 + 4 phi3) N(E) + 2 (phi2 - 2 phi3) (N(a) + N(b))
                       + (4 phi3 - phi2) N(c)]
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import ClassVar, NamedTuple

import numpy as np
from scipy.integrate import DOP853, RK45, OdeSolver, Radau
from scipy.linalg import expm

from biped_adrc.errors import (
    InputError,
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

    compiled_form: ClassVar[str] = ""
    """Name of the same method in the compiled loops; empty for one that runs in Python only."""

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

    compiled_form: ClassVar[str] = "rk4"

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

    compiled_form: ClassVar[str] = "dop853"
    _solver = DOP853


@dataclass(frozen=True)
class Stiff(_SciPy):
    """Radau IIA of order 5, implicit, with step control; for the observer of Table I as it stands."""

    _solver = Radau


Start = tuple[float, Array, Array, tuple[Array, Array]]
"""t [s], p, E and the remainder at the start of a step of ETD-RK4."""
_SAME_STEP = 1e-9
"""Relative difference [1] below which two steps share their phi-functions."""


Phi = tuple[Array, Array, Array, Array]
"""phi_0 to phi_3, each (k, k)."""


class PhiTable(NamedTuple):
    """The matrices of one step of length h of ETD-RK4, each (k, k); h is inside the weights."""

    half: Array
    """e^(hA/2)"""
    half_phi1: Array
    """h/2 phi1(hA/2) [s]"""
    full: Array
    """e^(hA)"""
    first: Array
    """h (phi1 - 3 phi2 + 4 phi3) [s], for N(E)."""
    middle: Array
    """h (2 phi2 - 4 phi3) [s], for N(a) and N(b)."""
    last: Array
    """h (4 phi3 - phi2) [s], for N(c)."""

    @classmethod
    def of(cls, half: Phi, phi: Phi, h: float) -> PhiTable:
        """For a step h [s], from the functions of hA / 2 and of hA."""
        p0, p1, p2, p3 = phi
        first, middle = h * (p1 - 3.0 * p2 + 4.0 * p3), h * (2.0 * p2 - 4.0 * p3)
        return cls(half[0], 0.5 * h * half[1], p0, first, middle, h * (4.0 * p3 - p2))


def phi_functions(A: Array, h: float) -> Phi:
    """e^(hA), phi1(hA), phi2(hA), phi3(hA), each (k, k), from one exponential of a (4k, 4k) matrix.

        phi_0 = e^z,   phi_(j+1)(z) = (phi_j(z) - 1/j!) / z

    The block matrix has the phi-functions in its first row, so no division by a small z is needed.
    """
    k = A.shape[0]
    block = np.zeros((4 * k, 4 * k))
    block[:k, :k] = h * A
    for j in range(3):
        block[j * k : (j + 1) * k, (j + 1) * k : (j + 2) * k] = np.eye(k)
    top = expm(block)[:k]
    return top[:, :k], top[:, k : 2 * k], top[:, 2 * k : 3 * k], top[:, 3 * k :]


def phi_table(A: Array, h: float) -> PhiTable:
    """The matrices of ETD-RK4 for A (k, k) [1/s] and a step h [s], from two matrix exponentials."""
    return PhiTable.of(phi_functions(A, 0.5 * h), phi_functions(A, h), h)


@lru_cache(maxsize=16)
def _remembered(A: bytes, k: int, h: float) -> PhiTable:
    """`phi_table` for the regular step of a method, kept for the last 16 (A, h); A as bytes."""
    return phi_table(np.frombuffer(A).reshape(k, k), h)


def no_coordinates() -> InputError:
    """The error of the method for a system without a split."""
    return InputError(
        "the exponential method needs a controller in continuous time whose observer is linear "
        "in its error and measures the true q_b; use RK4, Adaptive or Stiff instead"
    )


@dataclass(frozen=True)
class Exponential(OneStepMethod):
    """ETD-RK4 with fixed step h [s]; feedback: the system's `feedback_split` instead of its `split`.

    With feedback a step costs more and its error is smaller, most where the model is right. Where the torque is
    at its limit the linear part is wrong, the remainder has to undo it, and the other coordinates are better.
    Raises InputError for a system without these coordinates.
    """

    compiled_form: ClassVar[str] = "etd"

    h: float = 5e-4
    feedback: bool = False

    def __post_init__(self) -> None:
        check_positive(self.h, f"step h [s] is {self.h}")

    @property
    def label(self) -> str:
        return f"ETD-RK4{' with feedback' if self.feedback else ''}, h = {self.h:g} s"

    def split(self, system: HybridSystem, mode: Mode) -> Split | None:
        return system.feedback_split(mode) if self.feedback else system.split(mode)

    def steps(
        self, f: Flow, split: Form | None, t: float, x: Array, t_end: float
    ) -> Iterator[Step]:
        """Steps from (t, x), x (nx,), to t_end [s] in the coordinates of `split`.

        A step of another length than h, before a break, makes matrices of its own, and so does
        every look inside a step. Raises InputError without such coordinates.
        """
        if not isinstance(split, Split):
            raise no_coordinates()
        A = np.ascontiguousarray(split.A)
        table = _remembered(A.tobytes(), A.shape[0], self.h)
        p, E = split.to(x)
        node = split.node or partial(_linear_node, split)
        N, _, dx = node(t, p, E)
        for t1 in step_ends(t, t_end, self.h):
            h = t1 - t
            if abs(h - self.h) > _SAME_STEP * self.h:
                table = phi_table(A, h)
            p1, E1 = etd_rk4(split, table, t, p, E, N, h)
            N1, x1, dx1 = node(t1, p1, E1)

            def at(s: float, start: Start = (t, p, E, N)) -> Array:
                h = s - start[0]
                return split.back(*etd_rk4(split, phi_table(A, h), *start, h))

            yield Step(t, t1, x, x1, dx, dx1, at)
            t, x, dx, p, E, N = t1, x1, dx1, p1, E1, N1


def _linear_node(
    split: Split, t: float, p: Array, E: Array
) -> tuple[tuple[Array, Array], Array, Array]:
    """The remainder, x and x' (nx,) at (t, p, E) for a linear `back`, which maps slopes as it maps states."""
    N = split.remainder(t, p, E)
    return N, split.back(p, E), split.back(N[0], split.A @ E + N[1])


def etd_rk4(
    split: Split,
    table: PhiTable,
    t: float,
    p: Array,
    E: Array,
    N: tuple[Array, Array],
    h: float,
) -> tuple[Array, Array]:
    """p and E (k, c) after one step of length h [s] from (p, E), with N = remainder(t, p, E) known already.

    table: the matrices of that h. Three more evaluations of the remainder, as RK4 has.
    """
    Np, NE = N
    half, phi, full, first, middle, last = table
    half_E = half @ E
    Ea = half_E + phi @ NE
    Na, NEa = split.remainder(t + 0.5 * h, p + 0.5 * h * Np, Ea)
    Eb = half_E + phi @ NEa
    Nb, NEb = split.remainder(t + 0.5 * h, p + 0.5 * h * Na, Eb)
    Ec = half @ Ea + phi @ (2.0 * NEb - NE)
    Nc, NEc = split.remainder(t + h, p + h * Nb, Ec)
    p1 = p + (h / 6.0) * (Np + 2.0 * (Na + Nb) + Nc)
    E1 = full @ E + first @ NE + middle @ (NEa + NEb) + last @ NEc
    return p1, E1
