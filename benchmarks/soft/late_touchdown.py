"""How late, or early, may a touchdown be noticed before the walk is lost: controllers on both plants.

    python benchmarks/soft/late_touchdown.py [impacts [pushes [step]]]

For each controller the delay of `Told` grows by 1 ms, and the height of `ByKinematics` by 1 mm, until the first
walk that does not make its impacts. Printed is the last one before it, so nothing is said of larger ones that
walk again. Beside them is the largest error [mrad] at the nodes of walks told so late. With a step of the
engine [s] in place of the usual 0.2 ms, AGAIN in MuJoCo alone.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

import biped_adrc as ba
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.engine.simulate import run_compiled
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.scenario.build import RobotAndGait, build, soft_loop, start
from biped_adrc.scenario.walk import default_method

CONTROLLERS: dict[str, dict[str, Any]] = {
    "NPD": {"controller": "NPD"},
    "NPD, impact invariant": {"controller": "NPD", "contact": "impact invariant"},
    "m = 1, 500 rad/s": {"controller": "LESO", "bandwidth": 500.0},
    "m = 1, hold": {"controller": "LESO", "bandwidth": 500.0, "contact": "hold"},
    "Table I": {"controller": "ADRC"},
    "Table I, hold": {"controller": "ADRC", "contact": "hold"},
}
SOFT = {"plant": "mujoco", "ground_friction": 0.8, "own": {"integrator": "leapfrog"}}
PLANTS: dict[str, dict[str, Any]] = {"rigid": {}, "MuJoCo, 2 ms": SOFT}
AGAIN = ("NPD", "Table I, hold")
"""Controllers that are walked at another step of the engine."""
MOST = 60
"""Largest delay [ms] and height [mm] looked at."""
USUAL = {"period": 1e-3, "torque_limit": 150.0, "max_step_time": 1.0}
AT = (0, 2, 5, 10, 15)
"""[ms]: how late walks are whose error is printed."""
EVERY = 3
"""Of so many nodes one is looked at for the error."""
SCENE = RobotAndGait.of(ba.Scenario())


def run_of(s: ba.Scenario) -> Trajectory:
    """The states of a walk alone, without what is read of them."""
    walker, mode = build(s, SCENE), Mode()
    options = RunOptions(s.impacts * s.max_step_time, stop_after=(FOOT_STRIKE, s.impacts))
    loop, (q, v) = soft_loop(s, walker), start(s, SCENE)
    if loop is not None:
        return loop.run(loop.initial_state(q, v, mode), options, mode)
    x0 = walker.initial_state(q, v, mode)
    return run_compiled(walker, x0, mode, default_method(walker), options)


def walked(given: Mapping[str, Any], own: Mapping[str, float], impacts: int) -> float | None:
    """Largest error [mrad] of a walk; None where it was lost."""
    values = {**USUAL, **given, "own": {**given.get("own", {}), **own}, "impacts": impacts}
    run, h = run_of(ba.Scenario(**values)), SCENE.walked.constraint
    if len(run.events(FOOT_STRIKE)) < impacts:
        return None
    nodes = np.vstack([arc.x[::EVERY, :10] for arc in run.arcs])
    errors = [np.max(np.abs(x[:4] - h(0.0, x[:5], x[5:]).q_d)) for x in nodes]
    return 1e3 * float(np.max(errors))


def largest(given: Mapping[str, Any], touchdown: str, name: str, impacts: int) -> str:
    """The last value of the own value `name`, in thousandths, with which a row of walks is made."""
    for k in range(MOST + 1):
        if walked({**given, "touchdown": touchdown}, {name: 1e-3 * k}, impacts) is None:
            return str(k - 1) if k else "none"
    return f"{MOST} or more"


def rows(impacts: int, pushes: str, step: str) -> Iterator[str]:
    """The table, a line each; step: of the engine [s], for AGAIN in MuJoCo alone, or empty."""
    plants = {"MuJoCo, 2 ms": SOFT | {"plant_step": float(step)}} if step else PLANTS
    controllers = {name: CONTROLLERS[name] for name in (AGAIN if step else CONTROLLERS)}
    yield f"| plant | controller | {' | '.join(f'{k} ms' for k in AT)} | late [ms] | early [mm] |"
    yield "|---" * (4 + len(AT)) + "|"
    for where, plant in plants.items():
        for name, controller in controllers.items():
            given = {**controller, **plant, "pushes": pushes}
            late = largest(given, "told", "late", impacts)
            early = largest(given, "kinematics", "height", impacts)
            found = [
                walked({**given, "touchdown": "told"}, {"late": 1e-3 * k}, impacts) for k in AT
            ]
            errors = ["lost" if x is None else f"{x:.2g}" for x in found]
            yield f"| {where} | {name} | {' | '.join(errors)} | {late} | {early} |"


if __name__ == "__main__":
    impacts, pushes, step = [*sys.argv[1:], *("15", "", "")[len(sys.argv) - 1 :]]
    for row in rows(int(impacts), pushes, step):
        print(row, flush=True)
