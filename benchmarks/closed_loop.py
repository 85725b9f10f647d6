"""The closed loop in every peer: RABBIT under ADRC with the observer of Table I in continuous time.

Run: python benchmarks/closed_loop.py [OUT] [--quick]

Smooth: one single support from the gait's start, restarted, with no impact and no push. Peers run at rtol
1e-6 and atol 1e-9 where the row has no other, on the package's machine code but where the row says Python; the
package's own engine watches its guards besides. Error: largest difference of an angle at 20 instants to DOP853
at 1e-11 [rad].

"CVODE in C" is CVODE's library on the machine code with no Python between them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from peers.casadi_models import closed_loop, cvodes
from peers.solvers import CVODEInC, Flow, cvode, program_of, right_hand_side, scipy_solver
from report import Table, arguments, rounds
from scipy.interpolate import CubicHermiteSpline

import biped_adrc as ba
from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array
from biped_adrc.engine.kernels.compiled_run import CompiledRun
from biped_adrc.engine.program import CompiledWalker
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4

DURATION, INSTANTS = 0.4, 20  # [s] of each restart
BUDGET = 4.0  # [s] for the restarts of one solver
SAME = 1e-9
"""Largest relative difference of a peer's x' to the package's, dimensionless."""
METHODS: dict[str, Exponential | RK4] = {
    "ETD-RK4 1 ms": Exponential(1e-3),
    "ETD-RK4 5 ms": Exponential(5e-3),
    "ETD-RK4 0.5 ms": Exponential(5e-4),
    "RK4 0.1 ms": RK4(1e-4),
}
PUSH = ba.TorquePulse([30.0, 30.0, 30.0, 30.0, 0.0], step=1, start=0.1, stop=0.3)

Solve = Callable[[], Array]


def states(walker: ba.Walker, gait: ba.Gait) -> Array:
    """States of a pushed step, whose observer is off its estimates."""
    pushed = replace(walker, disturbance=PUSH)
    return ba.walk(pushed, gait, 1, RK4(1e-4), engine="compiled").trajectory.arcs[0].x[::40]


def check(name: str, f: Flow, g: Flow, at: Array) -> None:
    """Raise ModelError where g and f differ by more than SAME at a state."""
    pairs = ((g(0.0, x), f(0.0, x)) for x in at)
    worst = max(float(np.linalg.norm(a - b) / np.linalg.norm(b)) for a, b in pairs)
    if not worst <= SAME:
        raise ModelError(f"{name}: x' differs by {worst:.1e} relative, expected {SAME:g}")


def own(
    walker: ba.Walker, x: Array, times: Array, method: Exponential | RK4
) -> tuple[Solve, Solve]:
    """The engine on one single support, as it is timed and with its states at the times, which steps divide."""
    compiled = CompiledWalker.of(walker, method, walker.layout_of(x))
    every = round(float(times[1] - times[0]) / method.h)

    def run() -> CompiledRun:
        run = compiled.plan.start(x, 0.0, 1, 0.0, float(times[-1]))
        run["every"] = every
        run.keep(float(times[-1]))
        run.strikes(1)
        run.stride()
        return run

    def interpolated() -> Array:
        walked = run()
        rows = walked.nodes[: int(walked["count"])]
        rows = rows[np.append(np.diff(rows[:, 0]) > 0.0, True)]
        return CubicHermiteSpline(rows[:, 0], *np.hsplit(rows[:, 1:], 2))(times)

    return run, interpolated


def peers(
    walker: ba.Walker, x: Array, times: Array, sides: dict[str, Flow], quick: bool
) -> dict[str, Solve | None]:
    """What is timed by name; None for what is not installed."""
    f = sides["compiled"]
    found: dict[str, Solve | None] = {
        f"SciPy {method}": partial(scipy_solver(method), f, x, times)
        for method in ("Radau", "BDF", "DOP853")
    }
    if not quick:
        found["SciPy BDF, Python"] = partial(scipy_solver("BDF"), sides["Python"], x, times)
    found["CasADi CVODES, exact Jacobian"] = partial(cvodes(sides["CasADi"], times), x)
    makers = {
        "CVODE (scikit-sundae)": lambda: partial(cvode(), f, x, times),
        "CVODE in C": lambda: partial(CVODEInC(program_of(walker)), x, times),
        "CVODE in C, rtol 1e-4": lambda: partial(CVODEInC(program_of(walker), 1e-4), x, times),
    }
    for name, make in makers.items():
        try:
            found[name] = make()
        except ModuleNotFoundError:
            found[name] = None
    return found


def main() -> None:
    """Check, time, print, and write when asked."""
    asked = arguments(__doc__).parse_args()
    biped = ba.Biped.load("rabbit")
    gait = ba.load_gait("published", biped)
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint))
    x, times = walker.initial_state(*gait.start(biped)), np.linspace(0.0, DURATION, INSTANTS + 1)
    in_casadi = closed_loop(biped, walker.controller)
    sides: dict[str, Flow] = {
        "Python": partial(walker.flow, mode=ba.Mode()),
        "compiled": right_hand_side(walker, program_of(walker)),
        "CasADi": lambda t, y: np.array(in_casadi(y)).ravel(),
    }
    for name, side in sides.items():
        check(name, sides["Python"], side, states(walker, gait))
    truth = scipy_solver("DOP853", 1e-11, 1e-12)(sides["compiled"], x, times)

    def error(X: Array) -> float:
        return float(np.max(np.abs(X - truth)[:, : biped.n]))

    ours = {f"biped_adrc, {name}": own(walker, x, times, m) for name, m in METHODS.items()}
    fine = error(own(walker, x, times, RK4(2e-5))[1]())
    theirs = peers(walker, x, times, {**sides, "CasADi": in_casadi}, asked.quick)
    errors = {name: error(at()) for name, (_, at) in ours.items()}
    errors |= {name: error(run()) for name, run in theirs.items() if run}
    runs = {name: run for name, (run, _) in ours.items()} | {k: r for k, r in theirs.items() if r}
    seconds = rounds(runs, 3 if asked.quick else 25, BUDGET)
    note = f"{biped.preset}; the reference and RK4 at 0.02 ms differ by {fine:.1e} rad"
    table = Table("Closed loop", "simulated s", note, ("scikit-sundae", "casadi", "scipy"))
    for name in (*ours, *theirs):
        if name in runs:
            table.add(name, seconds[name], DURATION, error=errors[name])
        else:
            table.missing(name)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
