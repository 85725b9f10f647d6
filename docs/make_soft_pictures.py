"""Make the pictures of docs/soft_walk.md: xi^ through a touchdown, and Table I under a push in MuJoCo.

Run: python docs/make_soft_pictures.py

Beside each picture a JSON file holds the numbers that it shows; docs/check_pictures.py compares them with
walks.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from make_pictures import AFTER, BEFORE, animated

from biped_adrc.files import write_bytes, write_text
from biped_adrc.paper.figures import push_window
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.viz.figure_numbers import Numbers, as_text, numbers_of
from biped_adrc.viz.from_the_side.moving_parts import Motion
from biped_adrc.viz.from_the_side.moving_picture import write_moving_picture
from biped_adrc.viz.plots.touchdown import STEP, Walks, touchdown_figure
from biped_adrc.viz.style import render

FOLDER = Path(__file__).resolve().parent / "soft_walk"
SAMPLED = {"period": 1e-3, "torque_limit": 150.0, "impacts": STEP}
POLICIES: dict[str, dict[str, Any]] = {
    "no policy": {},
    "hold 15 ms": {"contact": "hold", "contact_window": 0.015},
    "fade 30 ms": {"contact": "fade", "contact_window": 0.03},
    "freeze 15 ms": {"contact": "freeze", "contact_window": 0.015},
    "impact invariant": {"contact": "impact invariant"},
}
PLANTS: dict[str, dict[str, Any]] = {
    "rigid": {},
    "soft, 2 ms": {"plant": "mujoco", "time_constant": 2e-3},
    "soft, 10 ms": {"plant": "mujoco", "time_constant": 1e-2},
}
"""What the figure shows, with m = 1."""
PUSHED = {
    **SAMPLED,
    "plant": "mujoco",
    "impacts": STEP + 1,
    "pushes": f"q1,q2,q3,q4=30@{STEP}:0.1-0.3",
}
ANIMATED = {"Table I": "no policy", "Table I, held 15 ms": "hold 15 ms"}
"""Names and policies of the walks in the animation."""
MOTION = Motion(apart=True, magnify=15.0, slower=4.0, fps=15, width=800)


@cache
def touchdown_walks() -> Walks:
    """The walks of the figure, without a push."""
    return {
        plant: {
            policy: walked({**SAMPLED, "controller": "LESO", **values, **around}).signals
            for policy, around in POLICIES.items()
        }
        for plant, values in PLANTS.items()
    }


@cache
def pushed_walks() -> Mapping[str, Walk]:
    """The walks of the animation."""
    return {name: walked({**PUSHED, **POLICIES[policy]}) for name, policy in ANIMATED.items()}


def walked(values: Mapping[str, Any]) -> Walk:
    """The walk of a scenario."""
    return walk_scenario(Scenario(**values))


def part(walks: Mapping[str, Walk]) -> tuple[float, float]:
    """What of the walks is shown: the touchdown before the push, and what is around it [s]."""
    first = next(iter(walks.values())).signals
    window = push_window(first)
    assert window is not None
    return window[0] - BEFORE, window[1] + AFTER


def numbers() -> dict[str, Numbers]:
    """What the pictures show, by name."""
    walks = pushed_walks()
    return {
        "touchdown": numbers_of(touchdown_figure(touchdown_walks())),
        "walk": animated(walks, part(walks), MOTION),
    }


def main() -> None:
    """Walk, draw."""
    drawn, walks = touchdown_figure(touchdown_walks()), pushed_walks()
    start, stop = part(walks)
    write_bytes(FOLDER / "touchdown.svg", render(drawn, "svg"))
    write_moving_picture(FOLDER / "walk.gif", walks, start=start, stop=stop, motion=MOTION)
    for name, found in numbers().items():
        write_text(FOLDER / f"{name}.json", as_text(found))


if __name__ == "__main__":
    main()
