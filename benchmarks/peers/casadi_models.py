"""The pinned chain and the closed loop of ADRC in CasADi's symbols, for its integrators with exact Jacobians.

x = (q, q', z) of the closed loop as the Walker has it, with (20) for u and (17) for z. Because kappa is the
inverse of kappa_inverse, kappa u = a - xi^ and the observer needs no inverse of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import casadi as ca
import numpy as np
from peers.chains import Chain, H, Simulate

from biped_adrc.control.adrc import ADRCController
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.model.biped import Biped
from biped_adrc.model.derivatives import entries, together
from biped_adrc.model.planar_robot import PlanarRobot, robot_of
from biped_adrc.observers.gpi import GPIObserver

RTOL, ATOL = 1e-6, 1e-9  # relative, absolute


def solve_symmetric(D: Any, right: Any) -> Any:
    """D^-1 right by L D L'."""
    return ca.ldl_solve(right, *ca.ldl(D))


def terms(robot: PlanarRobot, q: Any, v: Any) -> tuple[Any, Any]:
    """D (n, n) and Omega (n,) as CasADi's matrices."""
    D, Omega = robot.inertia_and_bias(entries(q), entries(v))
    return together(D), together(Omega)


class CasADiChain(Chain):
    """Symbols of q'' = D^-1 (f - Omega)."""

    def __init__(self, biped: Biped) -> None:
        super().__init__(biped)
        n, robot = biped.n, robot_of(biped)
        self.q, self.v, f = (ca.SX.sym(name, n) for name in ("q", "v", "f"))
        D, Omega = terms(robot, self.q, self.v)
        a = solve_symmetric(D, f - Omega)
        self.free = ca.substitute(a, f, np.zeros(n))
        self.function = ca.Function("acceleration", [self.q, self.v, f], [a])

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        return np.array(self.function(q, v, force)).ravel()

    def methods(self) -> Mapping[str, Simulate]:
        tolerances = {"reltol": RTOL, "abstol": ATOL}
        return {
            "CVODES BDF 1e-6": self._simulate("cvodes", tolerances),
            "CVODES Adams 1e-6": self._simulate(
                "cvodes", tolerances | {"linear_multistep_method": "adams"}
            ),
            "RK4 1 ms": self._simulate("rk", {}),
        }

    def _simulate(self, method: str, options: dict[str, Any]) -> Simulate:
        """The integrator is made for one duration and kept."""
        x = ca.vertcat(self.q, self.v)
        system = {"x": x, "ode": ca.vertcat(self.v, self.free)}
        kept: dict[float, Any] = {}

        def simulate(q: Array, v: Array, duration: float) -> Array:
            if duration not in kept:
                steps = {"number_of_finite_elements": round(duration / H)} if method == "rk" else {}
                kept[duration] = ca.integrator("f", method, system, 0.0, duration, options | steps)
            end = kept[duration](x0=np.concatenate((q, v)))["xf"]
            return np.array(end).ravel()[: len(q)]

        return simulate


def closed_loop(biped: Biped, controller: ADRCController) -> Any:
    """CasADi function x -> x'."""
    n, p, chain = biped.n, biped.p, controller.observer
    assert isinstance(chain, GPIObserver)
    x = ca.SX.sym("x", 2 * n + chain.order * p)
    q, v = x[:n], x[n : 2 * n]
    Z = ca.reshape(x[2 * n :], p, chain.order).T
    D, Omega = terms(robot_of(biped), q, v)
    A_N, a_N = -D[p, :p] / D[p, p], -Omega[p] / D[p, p]
    kappa_u = acceleration(controller, q, v, Z, A_N, a_N) - Z[2, :].T * chain.scale**2
    u = (D[:p, :p] + D[:p, p] @ A_N) @ kappa_u
    a = solve_symmetric(D, ca.vertcat(u, 0.0) - Omega)
    return ca.Function(
        "flow", [x], [ca.vertcat(v, a, ca.vec(observer(chain, q[:p], Z, kappa_u).T))]
    )


def cvodes(flow: Any, times: Array) -> Callable[[Array], Array]:
    """x -> X (len(times), nx) by CVODES with an exact Jacobian, of a CasADi function x -> x'."""
    x = ca.SX.sym("x", flow.size1_in(0))
    options = {"reltol": RTOL, "abstol": ATOL, "max_num_steps": 100_000}
    # the start is no output of its own: the grid begins after it
    run = ca.integrator(
        "run", "cvodes", {"x": x, "ode": flow(x)}, times[0], times[1:].tolist(), options
    )

    def solve(x0: Array) -> Array:
        return np.vstack((x0, np.array(run(x0=x0)["xf"]).T))

    return solve


def acceleration(k: ADRCController, q: Any, v: Any, Z: Any, A_N: Any, a_N: Any) -> Any:
    """a (p,), the acceleration asked for, solved through Theta''."""
    p, reference = A_N.numel(), k.reference
    assert isinstance(reference, VirtualConstraint)
    assert isinstance(k.observer, GPIObserver)
    h, dh, ddh, dtheta = constraint(reference, q, v)
    x1, x2 = Z[0, :].T, Z[1, :].T * k.observer.scale
    f = -k.gains.K_d * (x2 - dh * dtheta) - k.gains.K_p * (x1 - h)
    drift = ddh * dtheta**2 + f
    H = dh @ reference.phase[np.newaxis]
    return ca.solve(ca.SX.eye(p) - H[:, :p] - H[:, p] @ A_N, drift + H[:, p] * a_N)


def constraint(h: VirtualConstraint, q: Any, v: Any) -> tuple[Any, Any, Any, Any]:
    """h, dh/dTheta, d2h/dTheta2, each (p,), and Theta'."""
    p = h.curve.stacked.shape[1] // 3
    s = h.rate * (ca.dot(h.phase, q) - h.theta_plus)
    powers = ca.vertcat(*(s ** int(j) for j in h.curve.powers))
    rows = h.curve.stacked[0] @ powers
    return rows[:p], h.rate * rows[p : 2 * p], h.rate**2 * rows[2 * p :], ca.dot(h.phase, v)


def observer(k: GPIObserver, y: Any, Z: Any, kappa_u: Any) -> Any:
    """Z' (m + 2, p) of (17)."""
    p = y.numel()
    shifted = ca.vertcat(Z[1:, :], ca.SX.zeros(1, p))
    dZ = k.scale * (k.scaled_gains[:, np.newaxis] @ (y.T - Z[0, :]) + shifted)
    dZ[1, :] += kappa_u.T / k.scale
    return dZ
