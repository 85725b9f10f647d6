"""Walks on soft ground in MuJoCo at 1 kHz: simulated seconds per second, and the share of MuJoCo's own steps.

Run: python benchmarks/engine/soft.py [OUT] [--quick]

RABBIT on the published gait, MuJoCo at 0.2 ms, every node kept, from the call of `run` to its trajectory.
Table I's ADRC and NPD, with the paper's push and without; integrators "rk4" and "leapfrog"; sample instants in
machine code (`CompiledLoop`) and in Python (`SteppingLoop`). The goal is 20 simulated seconds per wall second.
The share is the time in `mj_step`, by a clock around each call of a walk of its own.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from itertools import product

from cases import TICK, load
from report import Table, arguments, rounds

import biped_adrc as ba

IMPACTS = 6
PUSH = ba.TorquePulse([30.0, 30.0, 30.0, 30.0, 0.0], step=3, start=0.1, stop=0.3)
LOOPS = {"compiled": ba.CompiledLoop, "Python": ba.SteppingLoop}
CONTROLLERS = {"NPD": ba.NPDController, "Table I": ba.ADRCController}


def walker(
    gait: ba.Gait, biped: ba.Biped, kind: type, controller: str, integrator: str, push: bool
) -> Callable[[], ba.Trajectory]:
    """What walks so many impacts from the gait's start, as often as it is called."""
    plant = ba.MuJoCoPlant(biped, integrator=integrator)
    law = CONTROLLERS[controller](gait.constraint)
    loop = kind(plant, law, biped, ba.SampledTime(TICK), PUSH if push else None, 150.0)
    options = ba.RunOptions(0.8 * IMPACTS, stop_after=("foot_strike", IMPACTS))
    return partial(loop.run, loop.initial_state(*gait.start(biped)), options)


def share(run: Callable[[], ba.Trajectory]) -> float:
    """Part of a walk's wall time that passes in MuJoCo's steps [1]."""
    engine, spent = run.func.__self__.plant.engine, 0.0  # type: ignore[attr-defined]
    step = engine.step

    def timed(*given: object) -> None:
        nonlocal spent
        begin = time.perf_counter()
        step(*given)
        spent += time.perf_counter() - begin

    engine.step, begin = timed, time.perf_counter()
    run()
    engine.step, whole = step, time.perf_counter() - begin
    return spent / whole


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    biped = ba.Biped.load("rabbit")
    gait = ba.load_gait("published", biped)
    cases = list(product(LOOPS, CONTROLLERS, ("rk4", "leapfrog"), (False, True)))
    runs = {case: walker(gait, biped, LOOPS[case[0]], *case[1:]) for case in cases}
    walks = {case: run() for case, run in runs.items()}
    quick = {case: run for case, run in runs.items() if case[0] == "compiled"}
    times = rounds(quick, 3 if asked.quick else 15)
    times |= rounds({case: run for case, run in runs.items() if case not in quick}, 1)
    table = Table("Soft ground", "simulated s", f"{IMPACTS} impacts; {load()}", ("mujoco-core",))
    for case in cases:
        tick, controller, integrator, push = case
        table.add(
            f"{controller}{', push' if push else ''}, {integrator}, tick {tick}",
            per_wall_s=walks[case].t_end / times[case].wall,
            per_CPU_s=walks[case].t_end / times[case].cpu,
            share_of_mj_step=share(runs[case]),
            note=f"{walks[case].status.name}, {walks[case].t_end:.2f} s",
        )
    table.finish(asked.out)


if __name__ == "__main__":
    main()
