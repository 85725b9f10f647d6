"""CasADi's integrators on the planar tree's closed forms: CVODES with exact Jacobians, and RK4."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import casadi as ca
import numpy as np
from chain import Chain, Simulate

from biped_adrc.gait.design.step import each, together
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import PlanarTree, inertia_and_bias
from biped_adrc.types import Array

H, RTOL, ATOL = 1e-3, 1e-6, 1e-9  # [s], relative, absolute


def solve_symmetric(D: Any, right: Any) -> Any:
    """D^-1 right by L D L'."""
    return ca.ldl_solve(right, *ca.ldl(D))


def terms(tree: PlanarTree, q: Any, v: Any) -> tuple[Any, Any]:
    """D (n, n) and Omega (n,) as CasADi's matrices."""
    D, Omega = inertia_and_bias(tree, tree.K, each(q), each(v))
    return together(D), together(Omega)


class CasADiChain(Chain):
    """Symbols of q'' = D^-1 (f - Omega)."""

    def __init__(self, biped: Biped) -> None:
        super().__init__(biped)
        n, tree = biped.n, PlanarTree.of(biped)
        self.q, self.v, f = (ca.SX.sym(name, n) for name in ("q", "v", "f"))
        D, Omega = terms(tree, self.q, self.v)
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
