"""What the tests of studies run in place of walks, with the columns of walks: cheap, and bad on request.

The search is judged on a double integrator under output feedback, whose optimum is Riccati's:

    x+ = A x + B u + w,  y = C x + v,  u = -K x^,  x^+ = A x^ + B u + L (y - C x^)

Its cost is the stationary mean of x'Q x + u'R u. A script as well: `plants.py KIND FOLDER PAUSE` runs a study.
"""

import math
import os
import signal
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from scipy.linalg import solve_discrete_are, solve_discrete_lyapunov

import biped_adrc as ba

T = 0.05
A, B, C = np.array([[1.0, T], [0.0, 1.0]]), np.array([[T * T / 2], [T]]), np.array([[1.0, 0.0]])
W, V = B @ B.T + 1e-6 * np.eye(2), np.array([[1e-4]])
Q, R = np.diag([100.0, 1.0]), np.array([[0.1]])
ROWS = {
    "name": "stand-in",
    "base": {"controller.pause": 0.0},
    "grid": {"run.impacts": list(range(1, 31))},
    "cases": {"a": {"controller.of": 0}, "b": {"controller.of": 1}},
}
"""A study of 60 rows."""


def carried(tables, folder, function, workers=None, **more):
    """The results of a study, walked in a thread of this process where no workers are said."""
    with ThreadPoolExecutor(1) as pool:
        return ba.study(tables, folder, workers or pool, function=function, **more)


def rows(records):
    """A row of each record; `raise` raises, `kill` ends the process, `once` does so at first."""
    return [_row(record) for record in records]


def _row(record):
    time.sleep(record["controller.pause"])
    x = record["run.impacts"] + 100 * record["controller.of"]
    if x == record.get("controller.raise"):
        raise ValueError(f"no row for {x}")
    if x == record.get("controller.kill") or (
        x == 7 and _first_time(record.get("controller.once"))
    ):
        os.kill(os.getpid(), signal.SIGKILL)
    walk = {"status": "COMPLETED", "survived": 1, "feasible": 1, "detail": f"µ{x}"}
    return walk | {"rms_error": (2.0 + math.sin(x)) / 3.0, "impacts": x}


def _first_time(path):
    if path is None or Path(path).exists():
        return False
    Path(path).touch()
    return True


def cost(K, L):
    """The stationary cost; None where the loop is unstable."""
    F = np.block([[A, -B @ K], [L @ C, A - B @ K - L @ C]])
    if np.max(np.abs(np.linalg.eigvals(F))) >= 1.0:
        return None
    zero = np.zeros((2, 2))
    X = solve_discrete_lyapunov(F, np.block([[W, zero], [zero, L @ V @ L.T]]))
    return float(np.trace(Q @ X[:2, :2]) + (R @ K @ X[2:, 2:] @ K.T)[0, 0])


def optimum():
    """The cost of the regulator with the Kalman filter."""
    P = solve_discrete_are(A, B, Q, R)
    S = solve_discrete_are(A.T, C.T, W, V)
    K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
    return cost(K, A @ S @ C.T @ np.linalg.inv(C @ S @ C.T + V))


def costs(records):
    """A row of each record, with the cost in the column rms_error."""
    return [_cost(record) for record in records]


def _cost(record):
    time.sleep(record.get("controller.pause", 0.0))
    k1, k2, l1, l2 = (record[f"controller.{name}"] for name in ("k1", "k2", "l1", "l2"))
    found = cost(np.array([[k1, k2]]), np.array([[l1], [l2]]))
    if found is None:
        return {"status": "FALLEN", "survived": 0, "feasible": 0, "rms_error": None}
    told = {"rms_error": found, "peak_error": k1 - record.get("controller.bonus", 0.0)}
    return {"status": "COMPLETED", "survived": 1, "feasible": 1, **told}


def tables(seeds=([0], [1], [2]), base_of=(), **search):
    """The tables of a search on the linear plant."""
    spans = {"k1": (1.0, 100.0), "k2": (1.0, 100.0), "l1": (0.05, 2.0), "l2": (0.1, 10.0)}
    log = {f"controller.{k}": {"from": a, "to": b, "scale": "log"} for k, (a, b) in spans.items()}
    walks = {k: {"seeds": x} for k, x in zip(("search", "choice", "test"), seeds, strict=True)}
    given = {"budget": 50, "generation": 10, "seed": 1, "objective": {"column": "rms_error"}}
    base = {"controller.k1": 5.0, "controller.k2": 5.0, "controller.l1": 0.5, "controller.l2": 1.0}
    search = {"variables": log, "walks": walks, **given, **search}
    return {"name": "linear plant", "base": {**base, **dict(base_of)}, "search": search}


def slowly(kind, pause):
    """The study of a kind with a pause in each row, and the function of its rows."""
    base = {"controller.pause": pause}
    if kind == "costs":
        return tables(base_of=base, budget=10, generation=8), costs
    return {**ROWS, "base": base}, rows


def main(kind, folder, pause):
    study, function = slowly(kind, float(pause))

    def progress(p):
        print(p.done, flush=True)

    ba.study(study, folder, ThreadPoolExecutor(2), function=function, progress=progress)


if __name__ == "__main__":
    main(*sys.argv[1:])
