"""Any controller in continuous time, with its torque on the way to the motors for `delay` seconds.

    u(t) = u_asked(t - d),   exp(-s d) ~ N(s d) / D(s d)

by the Pade approximant with a numerator one degree lower than the denominator of degree k = `order`:

    N(x) = sum_(j<k)  (2k-1-j)! (k-1)! / ((2k-1)! j! (k-1-j)!) (-x)^j
    D(x) = sum_(j<=k) (2k-1-j)! k!     / ((2k-1)! j! (k-j)!)     x^j

Its error is of order (w d)^(2k), as good as the next one of equal degrees, whose gain at high frequency is +-1:
what is asked would act at once, in part and with the wrong sign, and a torque that depends on itself would have
to be solved for. This one passes nothing at once. States per joint R (k,), x' = d x / dt:

    d R_i' = R_(i+1),   d R_k' = (u_asked - sum_j D_j R_(j+1)) / D_k,   u = sum_j N_j R_(j+1)

hidden: the inner observer is fed with what was asked for, as if it acted at once; known: with what acts. The
legs swap in the line as in the controller. A torque limit of the Walker acts behind the line; one of the
drives' own, `torque_limit`, before it, and a hidden observer is fed with the limited torque.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import factorial
from typing import NamedTuple

import numpy as np

from biped_adrc.control.base import Controller, ControllerLaws, Measurement, controller_laws
from biped_adrc.errors import InputError, check_positive
from biped_adrc.observers.base import Estimate
from biped_adrc.types import Array

HIGHEST = 10
"""Largest order: beyond it coefficients cover more than ten decades and the line gets no better."""


class LineParameters(NamedTuple):
    """The line, as numbers for its laws.

    numerator: N (k,), denominator: D (k + 1,), lowest power first; rate: 1/d [1/s]; limit [N m], infinite for
    none; order: k; known: 1 where the observer is fed with what acts, else 0.
    """

    numerator: Array
    denominator: Array
    rate: float
    limit: float
    order: int
    known: int


class DelayedParameters(NamedTuple):
    """Of the controller inside, and of the line."""

    inner: object
    line: LineParameters


def line_state(k: LineParameters, u: Array) -> Array:
    """R (k, p) after u (p,) [N m] has been asked for long enough."""
    R = np.zeros((k.order, len(u)))
    R[0] = u / k.denominator[0]
    return R


def line_output(k: LineParameters, R: Array) -> Array:
    """u (p,) [N m] that comes out."""
    return k.numerator @ R


def line_flow(k: LineParameters, R: Array, asked: Array) -> Array:
    """R' (k, p) while `asked` (p,) [N m] goes in."""
    dR = np.zeros(R.shape)
    dR[:-1] = k.rate * R[1:]
    dR[-1] = k.rate * (asked - k.denominator[:-1] @ R) / k.denominator[-1]
    return dR


def held_back(k: LineParameters, u: Array) -> Array:
    """u (p,) [N m] within the drives' own limit."""
    return np.minimum(np.maximum(u, -k.limit), k.limit)


def parts(k: LineParameters, s: Array, p: int) -> tuple[Array, Array]:
    """The inner state and R (k, p) of s, whose last k p numbers are the line's."""
    size = len(s) - k.order * p
    return s[:size], s[size:].reshape(k.order, p)


@lru_cache(maxsize=64)
def delayed_laws(inner: ControllerLaws) -> ControllerLaws:
    """The laws of the line behind the laws of any controller, without parameters.

    Cached by the inner laws, so that controllers which differ in numbers alone share their machine code.
    """

    def output(k: DelayedParameters, s: Array, m: Measurement) -> Array:
        return line_output(k.line, parts(k.line, s, m.terms.kappa.shape[0])[1])

    def initial_state(k: DelayedParameters, m: Measurement) -> Array:
        s = m.q[:0] if inner.initial_state is None else inner.initial_state(k.inner, m)
        u = held_back(k.line, inner.output(k.inner, s, m))
        return np.concatenate((s, line_state(k.line, u).ravel()))

    def flow(k: DelayedParameters, s: Array, m: Measurement, u: Array) -> Array:
        z, R = parts(k.line, s, len(u))
        asked = held_back(k.line, inner.output(k.inner, z, m))
        fed = u if k.line.known > 0 else asked
        dz = z if inner.flow is None else inner.flow(k.inner, z, m, fed)
        return np.concatenate((dz, line_flow(k.line, R, asked).ravel()))

    def jump(k: DelayedParameters, s: Array, after: Measurement, swap: Array) -> Array:
        z, R = parts(k.line, s, len(swap))
        z = z if inner.jump is None else inner.jump(k.inner, z, after, swap)
        return np.concatenate((z, R[:, swap].ravel()))

    def estimate(k: DelayedParameters, s: Array, m: Measurement) -> Estimate | None:
        assert inner.estimate is not None
        return inner.estimate(k.inner, parts(k.line, s, m.terms.kappa.shape[0])[0], m)

    told = None if inner.estimate is None else estimate
    return ControllerLaws(None, output, initial_state, flow, jump, estimate=told)


@dataclass(frozen=True)
class Delayed(Controller):
    """The module's line behind `inner`. delay [s] > 0; order k of the approximant, 1 to 10.

    known: the observer inside is fed with the torque that acts. torque_limit [N m]: of what is asked for.
    It compiles around whatever compiles in continuous time. Raises InputError.
    """

    inner: Controller
    delay: float
    order: int = 4
    known: bool = False
    torque_limit: float | None = None

    def __post_init__(self) -> None:
        check_positive(
            self.delay,
            f"the delay is {self.delay} s",
            f"; use {type(self.inner).__name__} itself without one",
        )
        is_whole = isinstance(self.order, (int, np.integer)) and not isinstance(self.order, bool)
        if not (is_whole and 1 <= self.order <= HIGHEST):
            raise InputError(
                f"the line's order is {self.order!r}, expected a whole number 1 to {HIGHEST}"
            )
        if (limit := self.torque_limit) is not None:
            check_positive(limit, f"the torque limit is {limit} N m", " or None")

    @property
    def needs_body(self) -> bool:  # type: ignore[override]
        """As the controller inside."""
        return self.inner.needs_body

    @cached_property
    def line(self) -> LineParameters:
        """What the laws `line_...` need."""
        limit = math.inf if self.torque_limit is None else float(self.torque_limit)
        N, D = pade(self.order)
        return LineParameters(N, D, 1.0 / self.delay, limit, self.order, int(self.known))

    def sampled(self, period: float) -> Controller:
        raise InputError(
            "Delayed works in continuous time; in sampled time the delay is the clock's: "
            "SampledTime(period, delay=...) around the controller inside"
        )

    @property
    def laws(self) -> ControllerLaws:
        inner = controller_laws(self.inner)
        k = DelayedParameters(inner.parameters, self.line)
        return delayed_laws(inner.functions)._replace(parameters=k, obstacle=inner.obstacle)


def pade(k: int) -> tuple[Array, Array]:
    """N (k,) and D (k + 1,) of the module's approximant in x = s d, lowest power first; D_0 = N_0 = 1."""
    whole = factorial(2 * k - 1)
    N = [
        (-1.0) ** j * factorial(2 * k - 1 - j) * factorial(k - 1)
        / (whole * factorial(j) * factorial(k - 1 - j))
        for j in range(k)
    ]  # fmt: skip
    D = [
        factorial(2 * k - 1 - j) * factorial(k) / (whole * factorial(j) * factorial(k - j))
        for j in range(k + 1)
    ]
    return np.array(N), np.array(D)
