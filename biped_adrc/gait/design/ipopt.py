"""IPOPT on a programme: its options, its progress, and what to say when nothing keeps the limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from biped_adrc.errors import GaitError
from biped_adrc.gait.design.programme import Programme, Row
from biped_adrc.types import Array

Progress = Callable[[int, float, float], None]
"""Told the iteration, the objective, and by how much the worst row is missed."""

MAX_ITERATIONS = 250
ASKED = ("the speed", "the step length")
ASKED_WEIGHT = 100.0  # so that a limit is named before what was asked
MISSED = 1e-5  # a limit that has to give by more than this is named
_SOLVED = ("Solve_Succeeded", "Solved_To_Acceptable_Level")


@dataclass(frozen=True)
class Found:
    """What IPOPT ends with."""

    x: Array
    objective: float
    """In the units of Objective."""
    status: str
    iterations: int

    @property
    def solved(self) -> bool:
        """Whether it is a solution."""
        return self.status in _SOLVED


def solve(
    programme: Programme,
    x0: Array,
    bounds: tuple[Array, Array],
    progress: Progress | None,
    strategy: str = "adaptive",
) -> Found:
    """IPOPT from x0 with bounds of the unknowns; `strategy` is that of its barrier parameter."""
    x = programme.unknowns.vector()
    g = ca.vertcat(*(row.value for row in programme.rows))
    g_low, g_high = sides(programme.rows)
    options = _options(strategy)
    watch = None
    if progress is not None:
        watch = _Watch(x.numel(), g.numel(), programme.rows, progress)
        options["iteration_callback"] = watch
    solver = ca.nlpsol("gait", "ipopt", {"x": x, "f": programme.objective, "g": g}, options)
    found = solver(x0=x0, lbx=bounds[0], ubx=bounds[1], lbg=g_low, ubg=g_high)
    stats = solver.stats()
    if watch is not None and watch.interrupted:
        raise KeyboardInterrupt
    value = ca.Function("value", [x], [programme.value])
    return Found(
        np.array(found["x"]).ravel(),
        float(value(found["x"])),
        str(stats["return_status"]),
        int(stats["iter_count"]),
    )


def _options(strategy: str) -> dict[str, Any]:
    return {
        "print_time": False,
        "ipopt.print_level": 0,
        "ipopt.sb": "yes",
        "ipopt.max_iter": MAX_ITERATIONS,
        "ipopt.mu_strategy": strategy,
        "ipopt.acceptable_tol": 1e-6,
        "ipopt.acceptable_constr_viol_tol": 1e-9,
        "ipopt.acceptable_iter": 5,
    }


class _Watch(ca.Callback):
    """Hands IPOPT's iterations on."""

    def __init__(self, nx: int, ng: int, rows: tuple[Row, ...], progress: Progress) -> None:
        ca.Callback.__init__(self)
        self._sizes = {"x": nx, "f": 1, "g": ng, "lam_x": nx, "lam_g": ng, "lam_p": 0}
        self._sides = sides(rows)
        self._progress, self._iteration = progress, -1
        self.interrupted = False
        self.construct("watch", {})

    def get_n_in(self) -> int:
        return int(ca.nlpsol_n_out())

    def get_n_out(self) -> int:
        return 1

    def get_sparsity_in(self, i: int) -> Any:
        size = self._sizes[ca.nlpsol_out(i)]
        return ca.Sparsity.dense(size, 1) if size else ca.Sparsity(0, 0)

    def eval(self, arg: Any) -> list[int]:
        values = dict(zip((ca.nlpsol_out(i) for i in range(len(arg))), arg, strict=True))
        low, high = self._sides
        g = np.array(values["g"]).ravel()
        self._iteration += 1
        missed = float(np.max(np.maximum(low - g, g - high), initial=0.0))
        try:
            self._progress(self._iteration, float(values["f"]), missed)
        except KeyboardInterrupt:
            self.interrupted = True
        return [int(self.interrupted)]


def sides(rows: tuple[Row, ...]) -> tuple[Array, Array]:
    """low and high of all rows."""
    low = np.concatenate([np.full(row.value.numel(), row.low) for row in rows])
    return low, np.concatenate([np.full(row.value.numel(), row.high) for row in rows])


def relaxed(
    programme: Programme, asked: str, x0: Array, bounds: tuple[Array, Array], status: str
) -> Array:
    """A point that keeps all limits, found by relaxing each by a slack of its own and making the sum least.

    Raises GaitError naming the limits whose slack stays.
    """
    soft = [row for row in programme.rows if row.low != row.high or row.name in ASKED]
    hard = [row for row in programme.rows if row.low == row.high and row.name not in ASKED]
    names = list(dict.fromkeys(row.name for row in soft))
    slack = ca.MX.sym("slack", len(names))
    rows = list(hard)
    for row in soft:
        give = ca.repmat(slack[names.index(row.name)], row.value.numel(), 1)
        if np.isfinite(row.low):
            rows.append(Row(row.name, row.value + give, row.low, np.inf))
        if np.isfinite(row.high):
            rows.append(Row(row.name, row.value - give, -np.inf, row.high))
    x = ca.vertcat(programme.unknowns.vector(), slack)
    g = ca.vertcat(*(row.value for row in rows))
    weight = np.array([ASKED_WEIGHT if name in ASKED else 1.0 for name in names])
    nlp = {"x": x, "f": ca.dot(weight, slack) + 1e-6 * programme.objective, "g": g}
    solver, (g_low, g_high) = (
        ca.nlpsol("gives", "ipopt", nlp, _options("monotone")),
        sides(tuple(rows)),
    )
    found = solver(
        x0=np.concatenate((x0, np.ones(len(names)))),
        lbx=np.concatenate((bounds[0], np.zeros(len(names)))),
        ubx=np.concatenate((bounds[1], np.full(len(names), np.inf))),
        lbg=g_low,
        ubg=g_high,
    )
    if solver.stats()["return_status"] not in _SOLVED:
        raise GaitError(
            f"no gait with {asked} was found ({status}), and what stands in the way could not be told; ask "
            "for a slower or shorter step, give one of speed and step only, or loosen the limits"
        )
    gives = np.array(found["x"]).ravel()[-len(names) :]
    units = {row.name: row.unit for row in programme.rows}
    missed = [
        f"{name} by {amount:.3g} {units[name]}".rstrip()
        for name, amount in sorted(zip(names, gives, strict=True), key=lambda pair: -pair[1])
        if amount > MISSED
    ]
    if missed:
        raise GaitError(
            f"no gait with {asked} keeps the limits; these would have to give: {'; '.join(missed)}"
        )
    point: Array = np.array(found["x"]).ravel()[: -len(names)]
    return point
