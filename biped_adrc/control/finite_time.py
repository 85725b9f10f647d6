"""Finite-time control: outputs y (p,) reach exactly zero, by a continuous feedback for double integrators.

    u = (J D^-1 B)^-1 (w - drift + J D^-1 Omega)       so that y'' = J q'' + drift = w, see `output_npd`
    w_i = psi(y_i, eps y_i') / eps^2
    psi(x1, x2) = -sign(x2) |x2|^alpha - sign(phi) |phi|^(alpha / (2 - alpha))
    phi(x1, x2) = x1 + sign(x2) |x2|^(2 - alpha) / (2 - alpha),   0 < alpha < 1

J = dy/dq (p, n) and drift are those of the outputs, D q'' + Omega = B u is the nominal model with inertia
matrix D, Coriolis and gravity terms Omega and torques u, and eps [s] a time scale: psi stabilises x1' = x2, x2'
= psi in the time t / eps. Bhat, Bernstein, IEEE TAC 43(5), 1998; for walking Grizzle, Abba, Plestan, IEEE TAC
46(1), 2001, with alpha = 0.9, eps = 0.1. On phi = 0 an output comes to rest after eps |eps y'|^(1 - alpha) / (1
- alpha) s. For alpha = 1 the law would be linear, with a double pole at -1 / eps. It is continuous but not
smooth at rest: integration methods with step control take small steps there, and smaller ones for smaller
alpha.

Finite time matters since the error is then zero before the impact, and the zero dynamics alone decide on
stability. The torque comes from `output_npd.linearising_torque`, as that of any law w for y''.
"""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.control.output_npd import OutputNPDController, linearising_torque
from biped_adrc.core.checks import PositiveFloat, Range
from biped_adrc.core.types import Array
from biped_adrc.gait.outputs import Outputs

LINEAR = "between 0 and 1; for a linear law use OutputNPDController"
ExponentFloat = Annotated[float, Range(LINEAR, lambda x: 0.0 < x < 1.0)]


def psi(x1: Array, x2: Array, alpha: float) -> Array:
    """Input psi (p,) of the double integrators x1' = x2, x2' = psi that brings both to zero in finite time.

    Each output by itself. x1 = y, x2 = eps y' (p,) and psi have the unit of y, as ' is here by t / eps.
    alpha [1]: the exponent, between 0 and 1.
    """
    phi = x1 + _power(x2, 2.0 - alpha) / (2.0 - alpha)
    return -_power(x2, alpha) - _power(phi, alpha / (2.0 - alpha))


def _power(x: Array, exponent: float) -> Array:
    """sign(x) |x|^exponent."""
    return np.sign(x) * np.abs(x) ** exponent


@dataclass(frozen=True)
class FiniteTimeController(Controller):
    """A controller that brings the outputs y to exactly zero in finite time, by a continuous torque.

    outputs: y (p,), which are brought to zero. eps [s]: the time scale in which they come to rest, above 0.
    alpha [1]: the exponent, between 0 and 1; the smaller, the more abruptly. Raises InputError outside these
    ranges; its torque raises SingularError where J D^-1 B (p, p) is singular, J = dy/dq.

    >>> from biped_adrc.gait.outputs import LinearOutputs
    >>> y = LinearOutputs(np.eye(4, 5), gait.constraint)  # q_b - h(Theta)
    >>> controller = ba.FiniteTimeController(y, alpha=0.9, eps=0.1)
    >>> ba.walk(ba.Walker(biped, controller), gait, impacts=1).impacts
    1
    """

    in_python = OutputNPDController.in_python

    outputs: Outputs
    alpha: ExponentFloat
    eps: PositiveFloat

    def output(self, s: Array, m: Measurement) -> Array:
        o = self.outputs(m.t, m.q, m.v)
        w = psi(o.y, self.eps * o.dy, self.alpha) / self.eps**2
        return linearising_torque(o, m.terms, w)
