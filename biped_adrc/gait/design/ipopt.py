"""IPOPT on a nonlinear programme: options, Ctrl-C, and the reason when no solution exists.

`solve` runs IPOPT once. Where it finds no feasible point, `relaxed` solves the same programme with a slack
variable s >= 0 in each limit and sum s minimised (an elastic, or l1, relaxation): a slack that stays above zero
names a limit that cannot be kept, and an end without slack is a feasible point to start from again. Called by
`optimise`; knows nothing of gaits but the rows of `nlp`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from biped_adrc.core.errors import GaitError
from biped_adrc.core.types import Array
from biped_adrc.gait.design.nlp import Bounded, NonlinearProgram

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
INTERRUPTED = ("NonIpopt_Exception_Thrown", "User_Requested_Stop")
"""Statuses with which CasADi ends IPOPT after Ctrl-C, in an evaluation or between two of them."""


class IpoptResult(NamedTuple):
    """How one run of IPOPT ended."""

    x: Array
    """Decision vector (nx,) of the last iteration, a solution or not."""
    status: str
    """IPOPT's return status, such as "Solve_Succeeded" or "Infeasible_Problem_Detected"."""
    solved: bool
    """Whether IPOPT met its tolerances, or its acceptable ones."""
    iterations: int


def solve(
    programme: NonlinearProgram, x0: Array, bounds: Bounds, strategy: str = "adaptive"
) -> IpoptResult:
    """Run IPOPT from x0 (nx,) within bounds of the decision vector.

    strategy: how IPOPT lowers its barrier parameter, "adaptive" (fast) or "monotone" (more robust). Raises
    KeyboardInterrupt on Ctrl-C, which CasADi notices at its next evaluation.
    """
    rows = programme.rows
    g = ca.vertcat(*(row.value for row in rows))
    low = np.concatenate([np.full(row.value.numel(), row.low) for row in rows])
    high = np.concatenate([np.full(row.value.numel(), row.high) for row in rows])
    problem = {"x": programme.x, "f": programme.objective, "g": g}
    options: dict[str, Any] = {
        "print_time": False,
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
    result = solver(x0=x0, lbx=bounds[0], ubx=bounds[1], lbg=low, ubg=high)
    stats = solver.stats()
    status, count = stats["return_status"], stats["iter_count"]
    if status in INTERRUPTED:
        raise KeyboardInterrupt
    return IpoptResult(np.array(result["x"]).ravel(), status, stats["success"], count)


def relaxed(
    programme: NonlinearProgram, request: str, x0: Array, bounds: Bounds, status: str
) -> Array:
    """A decision vector (nx,) that keeps all limits, found by the relaxation with slacks from x0 (nx,).

        minimise  w . s + 1e-6 f(x)   subject to  low - s <= g(x) <= high + s,  s >= 0

    Each name of a limit has one slack s, so that all rows of that name give way together; the small share of
    the objective keeps the solution unique. The problem is always feasible for slacks that are large enough.

    request, status: what was asked for and how IPOPT failed, for the message. One slack per name of a limit;
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
    result = solve(softened, np.concatenate((x0, np.ones(count))), ends, "monotone")
    missed = {k: s for k, s in zip(names, result.x[-count:], strict=True) if s > MISSED}
    if missed or not result.solved:
        reason = f"; these would have to give: {'; '.join(programme.in_words(missed))}"
        unknown = f" ({status}), and no limits that would have to; ask for a slower or shorter step, or less"
        raise GaitError(
            f"no gait with {request} keeps the limits{reason if result.solved else unknown}"
        )
    return result.x[:-count]
