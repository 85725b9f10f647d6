"""A double integrator with noise under output feedback: its cost is exact, and its optimum is Riccati's.

    x+ = A x + B u + w,  y = C x + v,  u = -K x^,  x^+ = A x^ + B u + L (y - C x^)

The cost is the stationary mean of x'Q x + u'R u, from the Lyapunov equation of plant and observer together.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_discrete_are, solve_discrete_lyapunov

T = 0.05
A, B, C = np.array([[1.0, T], [0.0, 1.0]]), np.array([[T * T / 2], [T]]), np.array([[1.0, 0.0]])
W, V = B @ B.T + 1e-6 * np.eye(2), np.array([[1e-4]])
Q, R = np.diag([100.0, 1.0]), np.array([[0.1]])


def covariance(K, L):
    """Of (x, x^), stationary; None where the loop is unstable."""
    F = np.block([[A, -B @ K], [L @ C, A - B @ K - L @ C]])
    if np.max(np.abs(np.linalg.eigvals(F))) >= 1.0:
        return None
    zero = np.zeros((2, 2))
    return solve_discrete_lyapunov(F, np.block([[W, zero], [zero, L @ V @ L.T]]))


def costs(K, L, R=R):
    """(mean of x'Q x, mean of u'R u), or None."""
    X = covariance(K, L)
    if X is None:
        return None
    return float(np.trace(Q @ X[:2, :2])), float((R @ K @ X[2:, 2:] @ K.T)[0, 0])


def optimum(R=R):
    """(K, L) of the regulator and the Kalman filter."""
    P = solve_discrete_are(A, B, Q, R)
    S = solve_discrete_are(A.T, C.T, W, V)
    K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
    return K, A @ S @ C.T @ np.linalg.inv(C @ S @ C.T + V)


def rows(records):
    """A row of each record, as `bench.run.run_trials` gives one of each walk."""
    return [_row(record) for record in records]


def _row(record):
    own = record["own"]
    K = np.array([[own["k1"], own["k2"]]])
    L = np.array([[own["l1"]], [own["l2"]]])
    found = costs(K, L)
    if found is None:
        return {"status": "FALLEN", "survived": 0, "feasible": 0, "cost": None, "of_state": None}
    told = {"cost": sum(found), "of_state": found[0], "of_torque": found[1] / float(R[0, 0])}
    return {"status": "COMPLETED", "survived": 1, "feasible": 1, **told}


def tables(**study):
    """The tables of a tuning study of it."""
    spans = {"k1": (1.0, 100.0), "k2": (1.0, 100.0), "l1": (0.05, 2.0), "l2": (0.1, 10.0)}
    log = {k: {"from": a, "to": b, "scale": "log"} for k, (a, b) in spans.items()}
    return {
        "study": {"name": "linear plant", "budget": 200, "generation": 10, "seed": 1, **study},
        "fixed": {"own": {"k1": 5.0, "k2": 5.0, "l1": 0.5, "l2": 1.0}},
        "variables": {"own": log},
        "objectives": [{"column": "cost"}],
        "training": {"seeds": [0]},
        "selection": {"seeds": [1]},
        "test": {"seeds": [2]},
    }


COLUMNS = ("cost", "of_state", "of_torque", "feasible")
