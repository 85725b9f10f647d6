"""The closed loop of ADRC in CasADi's symbols, for CVODES with an exact Jacobian.

x = (q, q', z) as the Walker has it, with (20) for u and (17) for z. Because kappa is the inverse of
kappa_inverse, kappa u = a - xi^ and the observer needs no inverse of its own.
"""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
from casadi_chain import solve_symmetric, terms

from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.observing import ObservingParameters
from biped_adrc.gait.constraint import ConstraintParameters
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import PlanarTree
from biped_adrc.observers.gpi import GPIParameters


def closed_loop(biped: Biped, controller: ADRCController) -> Any:
    """CasADi function x -> x'."""
    n, p, k = biped.n, biped.p, controller.laws.parameters
    assert isinstance(k.observer, GPIParameters)
    x = ca.SX.sym("x", 2 * n + k.observer.order * p)
    q, v = x[:n], x[n : 2 * n]
    Z = ca.reshape(x[2 * n :], p, k.observer.order).T
    D, Omega = terms(PlanarTree.of(biped), q, v)
    A_N, a_N = -D[p, :p] / D[p, p], -Omega[p] / D[p, p]
    kappa_u = acceleration(k, q, v, Z, A_N, a_N) - Z[2, :].T * k.observer.scale**2
    u = (D[:p, :p] + D[:p, p] @ A_N) @ kappa_u
    a = solve_symmetric(D, ca.vertcat(u, 0.0) - Omega)
    return ca.Function(
        "flow", [x], [ca.vertcat(v, a, ca.vec(observer(k.observer, q[:p], Z, kappa_u).T))]
    )


def acceleration(k: ObservingParameters, q: Any, v: Any, Z: Any, A_N: Any, a_N: Any) -> Any:
    """a (p,), the acceleration asked for, solved through Theta''."""
    p = A_N.numel()
    h, dh, ddh, dtheta = constraint(k.h, q, v)
    x1, x2 = Z[0, :].T, Z[1, :].T * k.observer.scale
    f = -k.own.K_d * (x2 - dh * dtheta) - k.own.K_p * (x1 - h)
    drift = ddh * dtheta**2 + f
    if k.own.loop == 0.0:
        return drift
    H = dh @ k.h.c[np.newaxis]
    return ca.solve(ca.SX.eye(p) - H[:, :p] - H[:, p] @ A_N, drift + H[:, p] * a_N)


def constraint(k: ConstraintParameters, q: Any, v: Any) -> tuple[Any, Any, Any, Any]:
    """h, dh/dTheta, d2h/dTheta2, each (p,), and Theta'."""
    p = k.curve.stacked.shape[0] // 3
    s = k.rate * (ca.dot(k.c, q) - k.theta_plus)
    powers = ca.vertcat(*(s ** int(j) for j in k.curve.powers))
    rows = k.curve.stacked @ powers
    return rows[:p], k.rate * rows[p : 2 * p], k.rate**2 * rows[2 * p :], ca.dot(k.c, v)


def observer(k: GPIParameters, y: Any, Z: Any, kappa_u: Any) -> Any:
    """Z' (m + 2, p) of (17)."""
    p = y.numel()
    shifted = ca.vertcat(Z[1:, :], ca.SX.zeros(1, p))
    dZ = k.scale * (k.gains[:, np.newaxis] @ (y.T - Z[0, :]) + shifted)
    dZ[1, :] += kappa_u.T / k.scale
    return dZ
