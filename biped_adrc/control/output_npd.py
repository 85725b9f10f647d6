"""Input-output linearisation for outputs of any kind, with proportional-derivative action.

    y'' = J q'' + drift = w,   w = -K_p y - K_d y'  (another law w: `finite_time`, which uses this torque too)
    u   = (J D^-1 B)^-1 (w - drift + J D^-1 Omega)

y (p,) are the outputs, as many as motors, J = dy/dq (p, n). D q'' + Omega = B u is the nominal model, with
inertia matrix D, Coriolis and gravity terms Omega, torques u (p,). q_b are the joints with motors, q_N the
others; J = (J_b, J_N). Isidori, Nonlinear Control Systems, 1995, 5.1, for outputs of relative
degree two. With (12), (13) of the paper, q_b'' = a = kappa u + xi and q_N'' = A_N a + a_N, the same u is

    (J_b + J_N A_N) a = w - drift - J_N a_N,   u = kappa^-1 (a - xi)

since J D^-1 B = (J_b + J_N A_N) kappa. For y = q_b - h(Theta), the error from the curve of a gait, this is NPD,
equation (28) of the paper: there u depends on Theta'' and Theta'' on u, and these linear equations are solved
together.

Outputs are any object of `gait.outputs`: linear ones, those of a virtual constraint, positions of a foot. They
may be a user's own Python, so these controllers run in Python.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dgecon, dgetrf, dgetrs

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.core.errors import InputError, SingularError
from biped_adrc.core.types import Array
from biped_adrc.gait.outputs import OutputPoint, Outputs
from biped_adrc.model.reduction import Reduction

_SINGULAR = 1e-9
"""Least reciprocal condition number [1] of the decoupling matrix: a Jacobian by differences has relative errors
of 1e-11, which a condition number of 1e9 makes 1e-2 in the torque."""


@dataclass(frozen=True)
class OutputNPDController(Controller):
    """Input-output linearisation with y'' = -K_p y - K_d y' for the nominal model; as many outputs as motors.

    outputs: y. gains: K_p [1/s^2], K_d [1/s]. Raises InputError for another number of outputs, SingularError
    where J D^-1 B is singular.
    """

    in_python = "it asks LAPACK whether J D^-1 B is singular"

    outputs: Outputs
    gains: Gains = TABLE_II

    def output(self, s: Array, m: Measurement) -> Array:
        o = self.outputs(m.t, m.q, m.v)
        return linearising_torque(o, m.terms, -self.gains.K_p * o.y - self.gains.K_d * o.dy)


def linearising_torque(o: OutputPoint, terms: Reduction, w: Array) -> Array:
    """Torque u (p,) [N m] that gives the outputs the acceleration y'' = J q'' + drift = w (p,).

    o: the outputs now. terms: of the nominal model now. w: in the units of y, per s^2. Raises InputError when J
    is not (p, n), SingularError where J D^-1 B is singular.
    """
    p, n = terms.kappa.shape[0], terms.D.shape[0]
    if o.J.shape != (p, n):
        raise InputError(
            f"the outputs have a Jacobian of shape {o.J.shape}, expected {(p, n)}: one output per motor, "
            "one column per coordinate"
        )
    J_b, J_N = o.J[:, :p], o.J[:, p:]
    a = _solve(J_b + J_N @ terms.A_N, w - o.drift - J_N @ terms.a_N)
    return terms.kappa_inverse @ (a - terms.xi)


def _solve(M: Array, b: Array) -> Array:
    """Solve M x = b for M (p, p), b (p,). Raises SingularError for a condition number above 1 / _SINGULAR."""
    if len(M) == 0:
        return np.zeros_like(b)
    factors, pivots, _ = dgetrf(M)
    # reciprocal condition number, in the norm of the largest column sum
    condition, _ = dgecon(factors, float(np.max(np.sum(np.abs(M), axis=0))))
    if not condition > _SINGULAR:  # also for NaN
        raise SingularError(
            "the decoupling matrix J D^-1 B of the outputs is singular at this state: its reciprocal "
            f"condition number is {condition:.1e}, expected above {_SINGULAR:g}; choose outputs that the "
            "motors can move independently here"
        )
    return dgetrs(factors, pivots, b)[0]  # x; LAPACK's flag follows
