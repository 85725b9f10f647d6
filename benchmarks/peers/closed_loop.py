"""The closed loop in every peer: RABBIT under ADRC with the observer of Table I in continuous time.

Run: python benchmarks/peers/closed_loop.py [OUT] [--quick]

Smooth: one single support from the gait's start, restarted, with no impact and no push. All at rtol 1e-6 and
atol 1e-9 on the same right-hand sides, in Python and compiled; the package's own engine watches its guards
besides. Error: largest difference of an angle at 20 instants to the package's exponential method at 0.05 ms,
which CVODE at 1e-10 and Radau at 1e-8 confirm to 5e-10 rad.

"CVODE in C" is CVODE's library on the compiled right-hand side with no Python between them. "Estimate" is
scikit-sundae's wall time on it with the Python of its calls taken off.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from cvode_rows import IN_C, IN_PYTHON, estimate, in_c
from engine_arcs import arcs, program_of, right_hand_side
from report import Table, arguments, microseconds, rounds
from solvers import (
    Flow,
    SolverFailed,
    cvode,
    cvodes,
    patient,
    scipy_solvers,
)

import biped_adrc as ba
from biped_adrc.errors import ModelError
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.types import Array

DURATION, INSTANTS, RESTARTS = 0.4, 20, 25  # [s] of each restart, and how many of them
BUDGET = 4.0  # [s] for the restarts of one solver
FINE = 5e-5  # [s], step of the reference
SAME = 1e-9
"""Largest relative difference of a peer's x' to the package's, dimensionless."""


class Run(NamedTuple):
    """One restart."""

    watched: Callable[[], Array]
    """Given up when it takes too long; for the first time."""
    bare: Callable[[], object]
    """As it is timed, with nothing between solver and right-hand side."""


def right_hand_sides(walker: ba.Walker) -> dict[str, Flow]:
    """f(t, x) -> x' by name, one for each engine; every solver runs on each of them."""
    mode = ba.Mode()
    return {
        "Python": lambda t, x: walker.flow(t, x, mode),
        "compiled": right_hand_side(walker, program_of(walker)),
    }


def check(name: str, f: Flow, g: Flow, x: Array, samples: int = 100) -> float:
    """Largest relative difference of g to f at random states near x. Raises ModelError above SAME."""
    random, worst = np.random.default_rng(6), 0.0
    for _ in range(samples):
        y = x + 0.05 * random.normal(size=len(x))
        ours = f(0.0, y)
        worst = max(worst, float(np.linalg.norm(g(0.0, y) - ours) / np.linalg.norm(ours)))
    if not worst <= SAME:
        raise ModelError(f"{name}: x' differs by {worst:.1e} relative, expected {SAME:g}")
    return worst


def runs(walker: ba.Walker, x: Array, times: Array, table: Table) -> dict[str, Run]:
    """What is timed; solvers that are not installed are rows already. Raises ModelError."""
    found: dict[str, Run] = {}
    solvers = dict(scipy_solvers())
    sides = right_hand_sides(walker)
    try:
        solvers[IN_PYTHON] = cvode()
    except ModuleNotFoundError:
        table.missing(IN_PYTHON)
    for side, f in sides.items():
        check(side, sides["Python"], f, x)
        for solver, solve in solvers.items():
            todo = (partial(solve, g, x, times) for g in (patient(f), f))
            found[f"{solver}, {side}"] = Run(*todo)
    try:
        found[IN_C] = Run(*2 * [in_c(walker, x, times)])
    except ModuleNotFoundError:
        table.missing(IN_C)
    own = {
        f"biped_adrc, {name}": Run(one.states, one.run)
        for name, one in arcs(walker, x, times).items()
    }
    return own | found | casadi_runs(walker, x, times, sides["Python"])


def reference(walker: ba.Walker, x: Array, times: Array) -> Array:
    """X (len(times), n), by a method that is none of the peers'."""
    mode, states = ba.Mode(), [x]
    split, method = walker.split(mode), Exponential(FINE)
    for t0, t1 in pairwise(times.tolist()):
        steps = method.steps(partial(walker.flow, mode=mode), split, t0, states[-1], t1)
        states.append([step.x1 for step in steps][-1])
    return np.array(states)


def casadi_runs(walker: ba.Walker, x: Array, times: Array, f: Flow) -> dict[str, Run]:
    """CasADi's own loop, once it is known to be the same."""
    from casadi_loop import closed_loop

    assert isinstance(walker.controller, ba.ADRCController)
    flow = closed_loop(walker.plant, walker.controller)
    check("CasADi", f, lambda t, y: np.array(flow(y)).ravel(), x)
    run = partial(cvodes(flow, times), x)
    return {"CasADi CVODES, exact Jacobian": Run(run, run)}


def main() -> None:
    """Check, time, print, and write when asked."""
    asked = arguments(__doc__).parse_args()
    biped = ba.Biped.load("rabbit")
    gait = ba.load_gait("published", biped)
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint))
    x = walker.initial_state(*gait.start(biped))
    times = np.linspace(0.0, DURATION, INSTANTS + 1)
    calls = {name: microseconds(partial(f, 0.0, x)) for name, f in right_hand_sides(walker).items()}
    costs = ", ".join(f"{name} {cost:.3g} us" for name, cost in calls.items())
    note = f"{biped.preset}; right-hand side: {costs}; medians over restarts"
    table = Table("Closed loop", "simulated s", note, ("scikit-sundae", "casadi", "pin"))
    todo = runs(walker, x, times, table)
    truth = reference(walker, x, times)[:, : biped.n]
    errors: dict[str, float] = {}
    for name, run in todo.items():
        try:
            errors[name] = float(np.max(np.abs(run.watched()[:, : biped.n] - truth)))
        except SolverFailed as failed:
            table.add(name, note=str(failed))
    seconds = rounds(
        {name: todo[name].bare for name in errors}, 3 if asked.quick else RESTARTS, BUDGET
    )
    for name, error in errors.items():
        wall, cpu, restarts = seconds[name]
        rates = {"per_wall_s": DURATION / wall, "per_CPU_s": DURATION / cpu}
        table.add(name, **rates, error_of_q=error, restarts=restarts)
        if name == f"{IN_PYTHON}, compiled":
            rate = DURATION / estimate(walker, x, times, wall)
            table.add(f"{name}, estimate without Python", per_wall_s=rate, error_of_q=error)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
