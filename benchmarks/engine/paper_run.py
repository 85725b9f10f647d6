"""The paper's run: 25 impacts in continuous time with its push, by every method of the compiled engine.

Run: python benchmarks/engine/paper_run.py [OUT] [--quick]

Errors are largest differences of a joint's angle to RK4 with steps of 0.01 ms: in the states before impacts,
and 0.05, 0.1 ... 0.3 s after the start of every single support. The exponential method with feedback at 0.05 ms
is another derivation; how far it is from that reference is in the note. "Nodes kept" is `biped_adrc.walk`,
with x and x' of every step; the other is a walk of a batch, which keeps its strikes.

Peers have no impacts and no push: one smooth single support of 0.4 s of the same closed loop, restarted, at
rtol 1e-6. See benchmarks/peers/closed_loop.py for more of them and for their accuracy at equal work.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import cases  # noqa: F401  # finds the peers
import closed_loop
import numpy as np
from cases import IMPACTS, Setting, load, paper, ready
from report import Table, arguments, rounds

import biped_adrc as ba
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod
from biped_adrc.types import Array

STEPS = (2e-4, 5e-4, 1e-3)  # [s]
METHODS: dict[str, tuple[OneStepMethod, ...]] = {
    "ADRC": (
        RK4(1e-4),
        *(Exponential(h) for h in STEPS),
        *(Exponential(h, feedback=True) for h in STEPS),
        Adaptive(),
        Adaptive(1e-6, 1e-6),
    ),
    "NPD": (RK4(1e-4), RK4(1e-3), Adaptive(), Adaptive(1e-6, 1e-6)),
}
REFERENCE, OTHER = RK4(1e-5), Exponential(5e-5, feedback=True)
RESTARTS = 25  # of a peer, but for those whose right-hand side is in Python
APART = 1e-3  # [s], between nodes of the references
IN_STEP = 0.05 * np.arange(1, 7)  # [s] from the start of each single support


def angles(run: ba.Trajectory, p: int) -> tuple[Array, Array]:
    """q_b before impacts (25, p), and at IN_STEP of every single support (25, 6, p)."""
    within = [[arc(arc.t[0] + s)[:p] for s in IN_STEP] for arc in run.arcs]
    return run.before(FOOT_STRIKE)[:, :p], np.array(within)


def difference(one: tuple[Array, Array], other: tuple[Array, Array]) -> tuple[float, float]:
    """Largest, before impacts and within steps [rad]; infinite where one fell."""
    if one[0].shape != other[0].shape:
        return np.inf, np.inf
    a, b = (float(np.max(np.abs(x - y))) for x, y in zip(one, other, strict=True))
    return a, b


def reference(setting: Setting, method: OneStepMethod) -> tuple[Array, Array]:
    """Angles, with nodes kept as they are needed."""
    every = round(APART / method.h)  # type: ignore[attr-defined]
    return angles(setting.thinned(method, every), setting.walker.plant.p)


def peers(table: Table) -> dict[str, tuple[Callable[[], object], int, float]]:
    """By name: what runs some restarts of the closed loop of benchmarks/peers, how many, and its error."""
    setting = paper(push=False)
    x = setting.walker.initial_state(*setting.gait.start(setting.walker.plant))
    times = np.linspace(0.0, closed_loop.DURATION, closed_loop.INSTANTS + 1)
    truth = closed_loop.reference(setting.walker, x, times)[:, : setting.walker.plant.n]
    found: dict[str, tuple[Callable[[], object], int, float]] = {}
    for name, run in closed_loop.runs(setting.walker, x, times, table).items():
        if name.startswith(("CVODE", "CasADi", "SciPy Radau", "SciPy BDF")):
            error = float(np.max(np.abs(run.watched()[:, : truth.shape[1]] - truth)))
            many = 1 if name.endswith("Python") else RESTARTS
            found[f"peer: {name}"] = (partial(repeated, run.bare, many), many, error)
    return found


def repeated(run: Callable[[], object], count: int) -> None:
    """Again and again."""
    for _ in range(count):
        run()


def fill(table: Table, count: int) -> None:
    """Every run once in each round, so that all meet the same machine; then their rows."""
    settings = {name: paper(name) for name in METHODS}
    chosen = {f"{n}, {m.label}": (settings[n], m) for n in METHODS for m in METHODS[n]}
    others = peers(table)
    runs: dict[str, Callable[[], object]] = {k: ready(s.case(m)) for k, (s, m) in chosen.items()}
    runs |= {f"{k}, kept": partial(s.walk, m, "compiled") for k, (s, m) in chosen.items()}
    seconds = rounds(runs | {key: run for key, (run, _, _) in others.items()}, count)
    truths = {name: reference(s, REFERENCE) for name, s in settings.items()}
    gaps = difference(reference(settings["ADRC"], OTHER), truths["ADRC"])
    table.note += f"; references differ by {gaps[0]:.1e} and {gaps[1]:.1e} rad"
    for key, (setting, method) in chosen.items():
        run = setting.walk(method, "compiled")
        gaps = difference(angles(run, setting.walker.plant.p), truths[key.split(",")[0]])
        table.add(
            key,
            per_wall_s=run.t_end / seconds[key].wall,
            per_CPU_s=run.t_end / seconds[key].cpu,
            nodes_kept=run.t_end / seconds[f"{key}, kept"].cpu,
            error_at_impacts=gaps[0],
            error_within_steps=gaps[1],
            note="" if len(run.arcs) == IMPACTS else run.status.name,
        )
    for key, (_, many, error) in others.items():
        time, note = many * closed_loop.DURATION, "no impacts, no push"
        rates = {"per_wall_s": time / seconds[key].wall, "per_CPU_s": time / seconds[key].cpu}
        table.add(key, **rates, error_within_steps=error, note=note)


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    note = f"25 impacts, push of 30 N m on four joints in single support 19; {load()}"
    table = Table("Paper run", "simulated s", note, ("scikit-sundae", "casadi", "pin"))
    fill(table, 3 if asked.quick else 9)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
