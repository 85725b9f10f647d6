"""Solvers of x' = f(t, x) behind one call, and how far each is from a tight reference.

A solver is `solve(f, x, times) -> X (len(times), n)` with times[0] the start. CVODE takes any callable f(t, x).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from biped_adrc.types import Array

RTOL, ATOL = 1e-6, 1e-9
PATIENCE = 60.0  # [s] for one restart

Flow = Callable[[float, Array], Array]
Solve = Callable[[Flow, Array, Array], Array]


class SolverFailed(Exception):
    """A solver gave up, or was given up; the text says which."""


def scipy_solver(method: str, rtol: float = RTOL, atol: float = ATOL) -> Solve:
    """`solve_ivp` with one of its methods."""

    def solve(f: Flow, x: Array, times: Array) -> Array:
        span = (times[0], times[-1])
        found = solve_ivp(f, span, x, method=method, t_eval=times, rtol=rtol, atol=atol)
        if not found.success:
            raise SolverFailed(found.message)
        states: Array = found.y.T
        return states

    return solve


def cvode(rtol: float = RTOL, atol: float = ATOL) -> Solve:
    """CVODE's BDF with its own difference Jacobian. Raises ModuleNotFoundError without scikit-sundae."""
    from sksundae.cvode import CVODE

    def solve(f: Flow, x: Array, times: Array) -> Array:
        def into(t: float, y: Array, dy: Array) -> None:
            dy[:] = f(t, y)

        solver = CVODE(into, method="BDF", rtol=rtol, atol=atol, max_num_steps=100_000)
        found = solver.solve(times, x)
        if not found.success:
            raise SolverFailed(str(found.message))
        states: Array = found.y
        return states

    return solve


def cvodes(flow: Any, times: Array) -> Callable[[Array], Array]:
    """x -> X by CasADi's CVODES with exact Jacobian, of a CasADi function x -> x'."""
    import casadi as ca

    x = ca.SX.sym("x", flow.size1_in(0))
    options = {"reltol": RTOL, "abstol": ATOL, "max_num_steps": 100_000}
    # the start is no output of its own: the grid begins after it
    run = ca.integrator(
        "run", "cvodes", {"x": x, "ode": flow(x)}, times[0], times[1:].tolist(), options
    )

    def solve(x0: Array) -> Array:
        return np.vstack((x0, np.array(run(x0=x0)["xf"]).T))

    return solve


def scipy_solvers() -> Mapping[str, Solve]:
    """SciPy's."""
    methods = ("Radau", "BDF", "LSODA", "RK45", "DOP853")
    return {f"SciPy {method}": scipy_solver(method) for method in methods}


def patient(f: Flow, limit: float = PATIENCE) -> Flow:
    """f that raises SolverFailed `limit` [s] after its first call: LSODA can hang."""
    begun: list[float] = []  # at the first call, which is long after this one

    def watched(t: float, x: Array) -> Array:
        if not begun:
            begun.append(time.perf_counter())
        if time.perf_counter() > begun[0] + limit:
            raise SolverFailed(f"not done in {limit:g} s")
        return f(t, x)

    return watched
