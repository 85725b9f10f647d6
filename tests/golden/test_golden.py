"""A walk for each line of the registry, each robot and each preset, in both engines, as it is stored.

A change of a number on purpose writes the walks that it changes anew, and says why:
`python -m tests.golden.test_golden NAME ..`.
"""

from __future__ import annotations

import json
import sys
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.registry import names
from biped_adrc.model.robots.robot_toml import load_description, robot_names

HERE = Path(__file__).parent
FILE = HERE / "walks.json"
CASES = tomllib.loads((HERE / "walks.toml").read_text(encoding="utf-8"))
ENGINES = ("compiled", "pinocchio")
WITHIN = 1e-6
"""Largest difference, relative to max(1, |x|): another processor rounds otherwise."""


def scenario(name: str, engine: str) -> ba.Scenario:
    """One of the cases. Its files are named from the root of the checkout."""
    s = ba.Scenario(**CASES["usual"] | CASES["walk"][name] | {"run.engine": engine})
    files = {k: str(HERE / Path(x).name) for k, x in s.dotted().items() if "golden/" in str(x)}
    return s.replace(files)


def walked(name: str, engine: str) -> dict[str, Any]:
    """Status, end, verdict and largest values of a walk."""
    walk = ba.walk_scenario(scenario(name, engine))
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


def written() -> dict[str, Any]:
    """The stored walks."""
    found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return found


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("name", CASES["walk"])
def test_walk_is_as_stored(name: str, engine: str) -> None:
    """Status, end, verdict and largest values of a scenario's walk are those in walks.json, which was written
    by this code before: numbers to 1e-6, words exactly. A change by accident shows here.
    """
    before, after = written()[name][engine], walked(name, engine)
    for key, x in before.items():
        if isinstance(x, str):
            assert after[key] == x, key
        else:
            np.testing.assert_allclose(after[key], x, rtol=WITHIN, atol=WITHIN, err_msg=key)


KINDS = ("controller", "contact", "observer", "sensor", "touchdown", "disturbance", "plant")


@pytest.mark.parametrize("kind", [*KINDS, "around", "curve", "robot", "preset"])
def test_each_line_of_the_registry_walks(kind: str) -> None:
    """Every name that a scenario may use is a word of one of the stored scenarios, or their default: so no part
    of the package is left out of the stored walks. kind: of part, such as controller or sensor.
    """
    scenarios = [scenario(name, "compiled").dotted() for name in CASES["walk"]]
    words = {str(x) for s in scenarios for x in s.values()}
    words |= {part for s in scenarios for name in s for part in name.split(".")}
    words |= {walk["compiled"]["curve"].lower() for walk in written().values()}
    presets = [p for name in robot_names() for p in load_description(name).presets]
    robots = [load_description(s.get("robot.name", "rabbit")) for s in scenarios]
    # defaults, which no scenario names
    words |= {"rabbit", "ADRC", "rigid", "pulse", *(robot.default_preset for robot in robots)}
    assert set(presets if kind == "preset" else names(kind)) - words == set()


if __name__ == "__main__":
    walks = written() | {name: {e: walked(name, e) for e in ENGINES} for name in sys.argv[1:]}
    walks = {name: walks[name] for name in CASES["walk"]}
    FILE.write_text(json.dumps(walks, indent=1) + "\n", encoding="utf-8")
