"""Outputs: what a controller drives to zero when that is not simply q_b - q_d.

    y   = y(t, q)
    y'  = J q' + dy/dt
    y'' = J q'' + drift

Linear outputs follow a curve over the phase, y = H0 q - h_d(Theta), Theta = c q (Westervelt, Grizzle,
Koditschek, IEEE TAC 48(1), 2003). Where [H0; c] is invertible they are a virtual constraint in other words:

    [H0; c] q = [h_d(Theta); Theta]   gives   q_b = h(Theta)

Any smooth y(q) is an output too: J = dy/dq and drift = J' q'.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import GaitError, InputError, NotFiniteError, check_positive
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Bezier, Polynomial, ramp
from biped_adrc.shown import Shown, one_line
from biped_adrc.types import Array, read_only

_SLOPE = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12.0  # times 1 / h, error h^4 f^(5) / 30
_BEND = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0  # times 1 / h^2, error h^4 f^(6) / 90


class OutputPoint(NamedTuple):
    """Outputs at one instant; p outputs in units of their own, n coordinates."""

    y: Array
    """(p,)."""
    dy: Array
    """y' (p,) [1/s]."""
    J: Array
    """(p, n) [1/rad]."""
    drift: Array
    """(p,) [1/s^2], y'' = J q'' + drift."""

    def __repr__(self) -> str:
        return one_line(self)


class Outputs(Shown, ABC):
    """A pure function of (t, q, q')."""

    @abstractmethod
    def __call__(self, t: float, q: Array, v: Array) -> OutputPoint:
        """The outputs at time t [s] and state (q, v), each (n,)."""


@dataclass(frozen=True)
class LinearOutputs(Outputs):
    """y = H0 q - h_d(Theta), H0 (p, n); `desired` is h_d over its phase, one row of its curve per output.

    With H0 = [I 0] it is y = q_b - h(Theta). Raises GaitError when the shapes do not fit.
    """

    H0: Array
    desired: VirtualConstraint

    def __post_init__(self) -> None:
        H0 = read_only(self.H0)
        expected = (self.desired.curve.coefficients.shape[0], len(self.desired.phase))
        if H0.shape != expected or not np.all(np.isfinite(H0)):
            raise GaitError(
                f"H0 has shape {H0.shape}, expected {expected} finite numbers: a row for each row of the "
                "curve h_d, a column for each coordinate of its phase"
            )
        object.__setattr__(self, "H0", H0)

    def __call__(self, t: float, q: Array, v: Array) -> OutputPoint:
        r = self.desired(t, q, v)
        return OutputPoint(self.H0 @ q - r.q_d, self.H0 @ v - r.dq_d, self.H0 - r.H, -r.drift)

    def as_virtual_constraint(self) -> VirtualConstraint:
        """q_b = h(Theta) with y = 0 on the same configurations, a Bezier curve where h_d is one.

        Raises GaitError when there is not one output fewer than coordinates, or [H0; c] is singular.
        """
        d = self.desired
        p, n = self.H0.shape
        M = np.vstack((self.H0, d.phase))
        if M.shape != (n, n) or np.linalg.matrix_rank(M) < n:
            raise GaitError(
                f"[H0; c] has shape {M.shape} and rank {np.linalg.matrix_rank(M)}; y = 0 fixes q_b over the "
                f"phase only when it is square and of rank {n}. Choose outputs independent of the phase"
            )
        curve = d.curve
        if not isinstance(curve, Bezier):
            curve = Polynomial(curve.power_coefficients)
        kind = type(curve)
        phase = ramp(kind, curve.degree, d.theta_plus, d.theta_minus)
        a: Array = np.asarray(np.linalg.solve(M, np.vstack((curve.coefficients, phase))))
        return VirtualConstraint(kind(a[:p]), d.phase, d.theta_plus, d.theta_minus)


@dataclass(frozen=True)
class FunctionOutputs(Outputs):
    """y = function(q) (p,), four times differentiable or smoother.

    jacobian: q -> dy/dq (p, n). drift: (q, v) -> J' v (p,). What is not given comes from central differences
    of order 4 with half width `difference` [rad]. For a function and derivatives of order one and the
    width of 4e-3, J is within 1e-11 and the drift within 1e-10 |v|^2 of the truth, 1e-11 |v|^2 where J is
    given. Raises InputError or NotFiniteError, at a call, for a result of the wrong shape or not finite.
    """

    function: Callable[[Array], Array]
    jacobian: Callable[[Array], Array] | None = None
    drift: Callable[[Array, Array], Array] | None = None
    difference: float = 4e-3

    def __post_init__(self) -> None:
        check_positive(self.difference, f"difference is {self.difference} rad", " such as 4e-3")

    def __call__(self, t: float, q: Array, v: Array) -> OutputPoint:
        y = np.asarray(self.function(q), dtype=float)
        if y.ndim != 1:
            raise InputError(
                f"the function of the outputs returned an array of shape {y.shape}, expected (p,): "
                "one number per output"
            )
        _check("function", y, y.shape)
        J = np.asarray(self.jacobian(q) if self.jacobian else self._slopes(q), dtype=float)
        _check("jacobian", J, (len(y), len(q)))
        drift = np.asarray(self.drift(q, v) if self.drift else self._bend(q, v), dtype=float)
        _check("drift", drift, y.shape)
        return OutputPoint(y, J @ v, J, drift)

    def _slopes(self, q: Array) -> Array:
        """dy/dq (p, n)."""
        h = self.difference
        columns = [_along(self.function, q, h * e, _SLOPE) / h for e in np.eye(len(q))]
        return np.array(columns).T

    def _bend(self, q: Array, v: Array) -> Array:
        """J' v (p,): the second derivative of y along v, or the first one of J v."""
        speed = math.sqrt(v.dot(v))
        if speed == 0.0:
            return np.zeros_like(self.function(q))
        h = self.difference / speed
        if self.jacobian is None:
            return _along(self.function, q, h * v, _BEND) / h**2
        return _along(self.jacobian, q, h * v, _SLOPE) @ v / h


def _along(f: Callable[[Array], Array], q: Array, dq: Array, weights: Array) -> Array:
    """sum_k w_k f(q + k dq), k = -2 .. 2."""
    total: Array = np.asarray(
        sum(w * np.asarray(f(q + k * dq)) for k, w in zip(range(-2, 3), weights, strict=True) if w)
    )
    return total


def _check(name: str, found: Array, shape: tuple[int, ...]) -> None:
    if found.shape != shape:
        raise InputError(
            f"the {name} of the outputs returned an array of shape {found.shape}, expected {shape}"
        )
    if not np.all(np.isfinite(found)):
        raise NotFiniteError(
            f"the {name} of the outputs returned {found}; expected finite numbers at every state"
        )
