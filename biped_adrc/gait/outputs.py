"""Outputs y(t, q) that a controller drives to zero where they are not the joint errors q_b - q_d.

    y   = y(t, q)
    y'  = J q' + dy/dt
    y'' = J q'' + drift

q (n,) are the coordinates, q_b the p = n - 1 actuated ones, and q_d their reference.

Linear outputs follow a curve over the phase, y = H0 q - h_d(Theta), Theta = c q (Westervelt, Grizzle,
Koditschek, IEEE TAC 48(1), 2003). Where [H0; c] is invertible they are a virtual constraint in other words:

    [H0; c] q = [h_d(Theta); Theta]   gives   q_b = h(Theta)

Any smooth y(q) is an output too: J = dy/dq and drift = J' q', with J' = dJ/dt. `FunctionOutputs` differentiates
a Python function numerically.

The controllers `control.output_npd` and `control.finite_time` call an `Outputs` object at each evaluation, and
solve y'' for the torque by its J and drift, the part of y'' without q''.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.core.checks import called_checked, returned
from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown, shown
from biped_adrc.core.types import Array, read_only
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Curve

_SLOPE = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12.0
"""Weights of the central difference of order 4 for f' over -2 h .. 2 h, times 1 / h; error h^4 f^(5) / 30."""
_BEND = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0
"""Weights of the central difference of order 4 for f'', times 1 / h^2; error h^4 f^(6) / 90."""


_H = 4e-3
"""Distance of neighbouring points of the differences [rad]; the outer ones are 2 _H away."""


@shown
class OutputPoint(NamedTuple):
    """Outputs at one instant; p outputs, each in its own unit (such as rad or m), n coordinates."""

    y: Array
    """y (p,)."""
    dy: Array
    """y' (p,), unit of y per s."""
    J: Array
    """dy/dq (p, n), unit of y per rad."""
    drift: Array
    """Part of y'' that does not depend on q'' (p,), unit of y per s^2: y'' = J q'' + drift."""


class Outputs(Shown, ABC):
    """Base of all outputs: y as a pure function of (t, q, q').

    What a subclass returns is checked at every call. Raises InputError for wrong shapes, or NotFiniteError,
    with the name of that class.
    """

    SUCH_AS = "LinearOutputs(H0, gait.constraint)"  # an example, for error messages

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        called_checked(cls, OutputPoint)  # wraps the `__call__` of the subclass

    @abstractmethod
    def __call__(self, t: float, q: Array, v: Array) -> OutputPoint:
        """The outputs at time t [s] and state q (n,) [rad], v (n,) [rad/s]."""


@dataclass(frozen=True)
class LinearOutputs(Outputs):
    """Linear outputs y = H0 q - h_d(Theta). With H0 = [I 0] they are the joint errors y = q_b - h(Theta).

    Raises GaitError when the shapes do not fit.
    """

    H0: Array
    """Output matrix (p, n) [1]."""
    desired: VirtualConstraint
    """h_d over its phase, one row of its curve per output [rad]."""

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
        # r: q_d is h_d(Theta) here, with q_d'' = H q'' + drift, so y'' = (H0 - H) q'' - drift
        r = self.desired(t, q, v)
        return OutputPoint(self.H0 @ q - r.q_d, self.H0 @ v - r.dq_d, self.H0 - r.H, -r.drift)


def all_coordinates(curve: Curve, H0: Array, phase: Array, ends: tuple[float, float]) -> Curve:
    """The curve q(s) [rad] of all n coordinates from that of n - 1 outputs y(s), by [H0; c] q = [y; Theta].

    H0: output matrix (n - 1, n). phase: c (n,). ends: Theta+ and Theta- [rad], at s = 0 and 1. Raises GaitError
    where outputs and phase together are not n independent rows.
    """
    n = len(phase)
    # a matrix of zeros where the shapes do not fit, so that the test of the rank refuses it
    H = np.vstack((H0, phase)) if H0.shape == (n - 1, n) else np.zeros((n, n))
    if np.linalg.matrix_rank(H) < n:
        raise GaitError(
            f"outputs of shape {H0.shape} and the phase row {np.round(phase, 6).tolist()} do not determine all "
            f"{n} coordinates, expected {n} independent rows; give a phase that moves with the coordinate that "
            "has no row, or one row per coordinate"
        )
    # Theta(s) is a straight line; a linear map of curves is that of their coefficients
    ramp = type(curve).ramp(curve.degree, *ends)
    q = np.linalg.solve(H, np.vstack((curve.coefficients, ramp)))
    return type(curve)(np.asarray(q, dtype=np.float64))


@dataclass(frozen=True)
class FunctionOutputs(Outputs):
    """Outputs y = function(q) by a Python function that is at least four times differentiable.

        height = FunctionOutputs(lambda q: np.array([biped.hip(q)[1] - 0.78, q[4]]))

    Its derivatives are central differences of order 4. Where the function and its derivatives are about 1 in
    size, J is within 1e-11 and the drift within 1e-10 |v|^2 of the truth. Raises InputError or NotFiniteError,
    at a call, for a result of the wrong shape or not finite. Outputs with derivatives of their own are a
    subclass of `Outputs`.
    """

    function: Callable[[Array], Array]
    """The function q (n,) [rad] -> y (p,)."""

    def __call__(self, t: float, q: Array, v: Array) -> OutputPoint:
        y = returned(self.function(q), None, self, "function")
        # dy/dq_i along each unit vector e: a central difference of order 4 over points _H = 4e-3 rad apart
        J = np.array([_along(self.function, q, _H * e, _SLOPE) / _H for e in np.eye(len(q))]).T
        # the drift J' v, with J' = dJ/dt, is the second derivative of y along v; its points q + k h v, with k
        # from -2 to 2, are _H apart whatever the speed |v| is; for v = 0 the drift is 0
        speed = math.sqrt(v.dot(v))
        h = _H / np.where(speed > 0.0, speed, 1.0)
        drift = np.where(speed > 0.0, _along(self.function, q, h * v, _BEND) / h**2, 0.0)
        return OutputPoint(y, J @ v, J, drift)


def _along(f: Callable[[Array], Array], q: Array, dq: Array, weights: Array) -> Array:
    """Finite difference of f along dq (n,): sum_k w_k f(q + k dq), k = -2 .. 2, with weights w (5,), of which
    those that are 0 cost no call of f.
    """
    points = zip(range(-2, 3), weights, strict=True)
    return np.asarray(sum(w * np.asarray(f(q + k * dq)) for k, w in points if w))
