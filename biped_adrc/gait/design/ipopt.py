"""IPOPT on a nonlinear programme: options, progress, Ctrl-C, and the reason when no solution exists.

`solve` runs IPOPT once. Where it finds no feasible point, `relaxed` solves the same programme with a slack
variable s >= 0 in each limit and sum s minimised (an elastic, or l1, relaxation): a slack that stays above zero
names a limit that cannot be kept, and an end without slack is a feasible point to start from again. Called by
`optimise`; knows nothing of gaits but the rows of `nlp`.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from biped_adrc.core.errors import GaitError
from biped_adrc.core.types import Array
from biped_adrc.gait.design.nlp import Bounded, NonlinearProgram

IpoptProgress = Callable[[int, float, float], None]
"""Called after each iteration with its number, the objective, and the largest violation of a constraint."""
Bounds = tuple[Array, Array]
"""Lower and upper bounds of the decision vector, both (nx,)."""

MAX_ITERATIONS = 250
"""Of one run of IPOPT."""
MAX_SECONDS = 60.0
"""Wall time of one run of IPOPT [s]."""
ASKED = ("the speed", "the step length")
"""Names of the equality rows that state what was asked for rather than the physics of the step."""
ASKED_WEIGHT = 100.0
"""Weight of the slacks of ASKED in the relaxation, so that a limit gives way before what was asked does."""
MISSED = 1e-5
"""Largest slack of a limit that counts as kept."""
_SOLVED = ("Solve_Succeeded", "Solved_To_Acceptable_Level")


@dataclass(frozen=True)
class IpoptResult:
    """How one run of IPOPT ended."""

    x: Array
    """Decision vector (nx,) of the last iteration, a solution or not."""
    status: str
    """IPOPT's return status, such as "Solve_Succeeded" or "Infeasible_Problem_Detected"."""
    iterations: int

    @property
    def solved(self) -> bool:
        """Whether IPOPT met its tolerances, or its acceptable ones."""
        return self.status in _SOLVED


def solve(
    programme: NonlinearProgram,
    x0: Array,
    bounds: Bounds,
    progress: IpoptProgress | None,
    strategy: str = "adaptive",
) -> IpoptResult:
    """Run IPOPT from x0 (nx,) within bounds of the decision vector.

    strategy: how IPOPT lowers its barrier parameter, "adaptive" (fast) or "monotone" (more robust). Raises
    KeyboardInterrupt on Ctrl-C, after the iteration under way.
    """
    rows = programme.rows
    g = ca.vertcat(*(row.value for row in rows))
    low = np.concatenate([np.full(row.value.numel(), row.low) for row in rows])
    high = np.concatenate([np.full(row.value.numel(), row.high) for row in rows])
    watch = _Watch(programme.x.numel(), low, high, progress)
    problem = {"x": programme.x, "f": programme.objective, "g": g}
    options: dict[str, Any] = {
        "print_time": False,
        "iteration_callback": watch,
        "show_eval_warnings": False,
        "ipopt.print_level": 0,
        "ipopt.sb": "yes",
        "ipopt.max_iter": MAX_ITERATIONS,
        "ipopt.max_wall_time": MAX_SECONDS,
        "ipopt.mu_strategy": strategy,
        "ipopt.acceptable_tol": 1e-6,
        "ipopt.acceptable_constr_viol_tol": 1e-9,
        "ipopt.acceptable_iter": 5,
    }
    solver = ca.nlpsol("gait", "ipopt", problem, options)
    # CasADi swallows an exception in a callback, so Ctrl-C sets a flag; it reaches the main thread alone
    here = threading.current_thread() is threading.main_thread()
    before = signal.signal(signal.SIGINT, watch.interrupt) if here else None
    try:
        result = solver(x0=x0, lbx=bounds[0], ubx=bounds[1], lbg=low, ubg=high)
    finally:
        if here:
            signal.signal(signal.SIGINT, before)
    if watch.interrupted:
        raise KeyboardInterrupt
    stats = solver.stats()
    return IpoptResult(
        np.array(result["x"]).ravel(), str(stats["return_status"]), int(stats["iter_count"])
    )


class _Watch(ca.Callback):
    """IPOPT's iteration callback: reports progress, and stops IPOPT by returning 1 after Ctrl-C.

    CasADi asks it for the sizes of its inputs (the solver's outputs x, f, g and multipliers) by the methods
    below, whose names are CasADi's.
    """

    def __init__(self, nx: int, low: Array, high: Array, progress: IpoptProgress | None) -> None:
        ca.Callback.__init__(self)
        ng = len(low)
        self._sizes = {"x": nx, "f": 1, "g": ng, "lam_x": nx, "lam_g": ng, "lam_p": 0}
        self._low, self._high = low, high
        self._progress, self._iteration = progress, -1
        self.interrupted = False
        self.construct("watch", {})

    def interrupt(self, *_: object) -> None:
        """Stop at the next iteration; a handler of a signal."""
        self.interrupted = True

    def get_n_in(self) -> int:
        return int(ca.nlpsol_n_out())

    def get_sparsity_in(self, i: int) -> ca.Sparsity:
        """Shape of the solver's output i: a dense column, or empty for the multipliers of no parameters."""
        size = self._sizes[ca.nlpsol_out(i)]
        return ca.Sparsity.dense(size, 1) if size else ca.Sparsity(0, 0)

    def eval(self, arg: Sequence[ca.DM]) -> list[int]:
        """One iteration: report it, and return [1] to stop, [0] to go on."""
        values = dict(zip((ca.nlpsol_out(i) for i in range(len(arg))), arg, strict=True))
        g = np.array(values["g"]).ravel()
        self._iteration += 1
        missed = float(np.max(np.maximum(self._low - g, g - self._high), initial=0.0))
        try:
            if self._progress is not None:
                self._progress(self._iteration, float(values["f"]), missed)
        except KeyboardInterrupt:
            self.interrupted = True
        return [int(self.interrupted)]


def relaxed(
    programme: NonlinearProgram, request: str, x0: Array, bounds: Bounds, status: str
) -> Array:
    """A decision vector (nx,) that keeps all limits, found by the relaxation with slacks from x0 (nx,).

        minimise  w . s + 1e-6 f(x)   subject to  low - s <= g(x) <= high + s,  s >= 0

    Each name of a limit has one slack s, so that all rows of that name give way together; the small share of
    the objective keeps the solution unique. The problem is always feasible for slacks that are large enough.

    asked, status: what was asked for and how IPOPT failed, for the message. One slack per name of a limit;
    speed and step length asked for have slacks of weight ASKED_WEIGHT, the equations of the model none.
    Raises GaitError naming the limits whose slack stays above MISSED.
    """
    soft = [row for row in programme.rows if row.low != row.high or row.name in ASKED]
    hard = [row for row in programme.rows if row.low == row.high and row.name not in ASKED]
    names = list(dict.fromkeys(row.name for row in soft))
    slack = ca.MX.sym("slack", len(names))
    rows = list(hard)
    for row in soft:
        give = ca.repmat(slack[names.index(row.name)], row.value.numel(), 1)
        if np.isfinite(row.low):
            rows.append(Bounded(row.name, row.value + give, row.low, np.inf))
        if np.isfinite(row.high):
            rows.append(Bounded(row.name, row.value - give, -np.inf, row.high))
    weight = np.array([ASKED_WEIGHT if name in ASKED else 1.0 for name in names])
    count = len(names)
    softened = NonlinearProgram(
        ca.vertcat(programme.x, slack),
        ca.dot(weight, slack) + 1e-6 * programme.objective,
        tuple(rows),
    )
    low, high = bounds
    ends = np.append(low, np.zeros(count)), np.append(high, np.full(count, np.inf))
    result = solve(softened, np.concatenate((x0, np.ones(count))), ends, None, "monotone")
    missed = {k: s for k, s in zip(names, result.x[-count:], strict=True) if s > MISSED}
    if missed or not result.solved:
        reason = f"; these would have to give: {'; '.join(programme.in_words(missed))}"
        unknown = f" ({status}), and no limits that would have to; ask for a slower or shorter step, or less"
        raise GaitError(
            f"no gait with {request} keeps the limits{reason if result.solved else unknown}"
        )
    return result.x[:-count]
