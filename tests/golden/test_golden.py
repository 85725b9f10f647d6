"""A walk for each line of the registry, each robot and each preset, as it is stored, and its first step in
both engines.

A change of a number on purpose writes the walks that it changes anew, and says why:
`python -m tests.golden.test_golden NAME ..`.
"""

from __future__ import annotations

import json
import sys
import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.registry import names
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.robots.robot_toml import load_description, robot_names

HERE = Path(__file__).parent
FILE = HERE / "walks.json"
CASES = tomllib.loads((HERE / "walks.toml").read_text(encoding="utf-8"))
WITHIN = 1e-6
"""Largest difference, relative to max(1, |x|): another processor rounds otherwise."""
IN_PYTHON = ("CLF-QP", "output NPD", "finite time")
"""Walks with a solver of its own in their law."""
COARSE = 4e-3
"""Integration step, period and delay [s] of the step that both engines walk: a short one would show no more."""


def scenario(name: str) -> ba.Scenario:
    """One of the cases. Its files are named from the root of the checkout."""
    s = ba.Scenario(**CASES["usual"] | CASES["walk"][name])
    files = {k: str(HERE / Path(x).name) for k, x in s.dotted().items() if "golden/" in str(x)}
    return s.replace(files)


@cache
def passive_walk(name: str) -> ba.Walk:
    """The walk of one of the cases without motors, whose start is searched for."""
    return ba.walk_scenario(scenario(name))


def walked(name: str) -> dict[str, Any]:
    """Status, end, verdict and largest values of a walk."""
    s = scenario(name)
    walk = passive_walk(name) if s.controller.name == "passive" else ba.walk_scenario(s)
    signals, run = walk.signals, walk.trajectory
    curve = walk.gait and getattr(walk.gait.constraint, "curve", None)
    return {
        "status": run.status.name,
        "arcs": len(run.arcs),
        "outcome": walk.feasibility.outcome,
        "friction": walk.feasibility.mean_friction,
        "curve": type(curve).__name__ if curve else "",
        "end": [run.t_end, *run.arcs[-1].x[-1][: 2 * walk.walker.plant.n]],
        "error": float(np.max(np.abs(signals.error), initial=0.0)),
        "torque": float(np.max(np.abs(signals.u), initial=0.0)),
    }


def first_step(name: str, engine: str) -> Trajectory:
    """The first single support of a case and the impact at its end, with coarse steps of integration."""
    s = scenario(name)
    if s.controller.name == "passive":
        walk = passive_walk(name)
        n = walk.walker.plant.n
        start = walk.trajectory.arcs[0].x[0][: 2 * n]
        way = {"start": (start[:n], start[n:]), "engine": engine}
        return ba.walk(walk.walker, None, 1, ba.RK4(COARSE), **way).trajectory
    dear = {"hardware.period", "controller.delay"} & CASES["walk"][name].keys()
    # a delay is resolved by steps as short as it asks for
    coarse = dear or {"run.h"}
    changed = dict.fromkeys(coarse, COARSE) | {"run.impacts": 1, "run.engine": engine}
    return ba.walk_scenario(s.replace(changed)).trajectory


def written() -> dict[str, Any]:
    """The stored walks."""
    found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return found


@pytest.mark.parametrize("name", CASES["walk"])
def test_walk_is_as_stored(name: str) -> None:
    """Status, end, verdict and largest values of a scenario's walk are those in walks.json, which was written
    by this code before: numbers to 1e-6, words exactly. A change by accident shows here.
    """
    before, after = written()[name], walked(name)
    for key, x in before.items():
        if isinstance(x, str):
            assert after[key] == x, key
        else:
            np.testing.assert_allclose(after[key], x, rtol=WITHIN, atol=WITHIN, err_msg=key)


@pytest.mark.parametrize("name", CASES["walk"])
def test_the_first_step_is_that_of_pinocchio(name: str) -> None:
    """Instants, states and rates of all nodes of a scenario's first single support, and the state after its
    impact, from the compiled engine and from Pinocchio in Python: to 1e-6 of each quantity's largest value, or
    of 1. Laws that call a solver of their own walk in Python in both, on a compiled plant in one.
    """
    code, python = (first_step(name, engine) for engine in ("compiled", "pinocchio"))
    assert code.settings["engine"] == ("compiled plant" if name in IN_PYTHON else "compiled")
    assert python.settings["engine"] == "pinocchio"
    assert code.status is python.status is ba.Status.COMPLETED
    (one,), (other,) = code.arcs, python.arcs
    assert one.event.guard == other.event.guard
    pairs = [(getattr(one, x), getattr(other, x)) for x in ("t", "x", "dx")]
    for found, expected in [*pairs, (one.event.x_plus, other.event.x_plus)]:
        assert found.shape == expected.shape
        size = np.maximum(1.0, np.max(np.abs(expected), axis=0, initial=0.0))
        assert np.all(np.abs(found - expected) <= WITHIN * size)


KINDS = ("controller", "contact", "observer", "sensor", "touchdown", "disturbance", "plant")


@pytest.mark.parametrize("kind", [*KINDS, "around", "curve", "robot", "preset"])
def test_each_line_of_the_registry_walks(kind: str) -> None:
    """Every name that a scenario may use is a word of one of the stored scenarios, or their default: so no part
    of the package is left out of the stored walks. kind: of part, such as controller or sensor.
    """
    scenarios = [scenario(name).dotted() for name in CASES["walk"]]
    words = {str(x) for s in scenarios for x in s.values()}
    words |= {part for s in scenarios for name in s for part in name.split(".")}
    words |= {walk["curve"].lower() for walk in written().values()}
    presets = [p for name in robot_names() for p in load_description(name).presets]
    robots = [load_description(s.get("robot.name", "rabbit")) for s in scenarios]
    # defaults, which no scenario names
    words |= {"rabbit", "ADRC", "rigid", "pulse", *(robot.default_preset for robot in robots)}
    assert set(presets if kind == "preset" else names(kind)) - words == set()


if __name__ == "__main__":
    walks = written() | {name: walked(name) for name in sys.argv[1:]}
    walks = {name: walks[name] for name in CASES["walk"]}
    FILE.write_text(json.dumps(walks, indent=1) + "\n", encoding="utf-8")
