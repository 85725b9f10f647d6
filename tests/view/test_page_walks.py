"""Walks of a page under a hand, saved as files, walked again: every controller, every effect of hardware."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from selenium.webdriver import Chrome

import biped_adrc as ba
from biped_adrc.core.registry import REGISTRY
from biped_adrc.extras.play.page import FIRST, page, revised
from biped_adrc.scenario.scenario import read_scenario

from .browser import chromium, console

SLOW = {"controller.name": "ADRC", "controller.observer": {"bandwidth": 160.0, "order": 1}}
ENCODERS = {"hardware.encoders": {"counts": 8192.0, "velocity": "differences"}}
WALKS: dict[str, dict[str, Any]] = {
    "PD": {"controller": {"name": "PD", "K_p": 900.0, "K_d": 60.0}, "hardware.lag": 2e-3},
    "NPD": {"controller": "NPD", "hardware.rate_limit": 3e4, "errors.mass_width": 0.05},
    "NPID": {"controller": "NPID", "hardware.friction": True}
    | {"hardware.touchdown": {"name": "faulty", "late": 2e-3}},
    "super twisting": {"controller": "super twisting", "hardware.encoders.noise": 1e-5},
    "ADRC": {**SLOW, **ENCODERS, "controller.prediction": 1e-3, "ground.slope": 0.01}
    | {"hardware.delay": 1e-3, "hardware.encoders.filter_time": 2e-3},
    "ADRC output": {"controller": "ADRC output", "controller.observer": SLOW["controller.observer"]}
    | {"hardware.delay": 4e-4, "hardware.delay_known": True},
    "ADRC b0": {"controller.name": "ADRC b0", "hardware": "rabbit", "gait": "v0.8"},
    "LESO": {"controller.name": "LESO", "controller.observer": {"bandwidth": 160.0}}
    | {"hardware.encoders": {"counts": 8192.0, "velocity": "gyro"}}
    | {"controller.contact": {"name": "hold", "window": 5e-3}},
    "ADRC assisted": {"controller": "ADRC assisted", "hardware.touchdown": "force"},
    "DOB": {"controller": "DOB", "hardware.touchdown": "kinematics"},
    "stride PI": {"controller": {"name": "stride PI", "inner": "NPD"}, "hardware.delay": 2e-3},
    "footstep": {"controller": {"name": "footstep", "inner": "NPD"}, "ground.stones": [0.4, 0.3]}
    | {"ground.step_height": 0.01},
    "foot barrier": {
        "controller": {"name": "foot barrier", "inner": "NPD"},
        "ground.stones": [0.4],
    },
    "reference reset": {"controller": {"name": "reference reset", "inner": "NPD"}}
    | {"hardware.sensor": {"name": "pitch sensor", "bias": 1e-3}},
    "RABBIT, feedforward": {**SLOW, "hardware": "rabbit", "controller.feedforward": 0.9}
    | {"controller.contact": "impact invariant"},
}
"""Each registered controller that is traced, with an effect of hardware."""
NOT_TRACED = {"CLF-QP", "output NPD", "finite time", "delayed", "passive"}
"""A QP, two that decide by numbers, a delay in continuous time, and a robot without motors."""
HAND = """
const [name, seconds] = arguments, states = [];
play.pause(); play.begin(name, "NPD");
for (let k = 0; play.walking[0].walks && play.leader.t < seconds; k += 1) {
  const [walk] = play.walking;
  const push = { torque: { q1: 5, q2: 5 }, force: [10, -5], link: "right_shin", at: [0, -0.1] };
  if (k === 150) play.push({ ...push, seconds: 0.1 });
  if (k === 700) play.pull({ link: "torso", at: [0, 0.3], anchor: [walk.foot[0] + 0.1, 1.2] });
  if (k === 730) play.let_go();
  play.sample();
  const [now] = play.walking;
  if (k % 25 === 0) states.push([now.t, now.step, ...now.q, ...now.v]);
}
return { text: scenarioText(play), states, ending: play.walking[0].ending };
"""
MOVED = """
const [name, value] = arguments, states = [], slider = "controller.speed", walks = [name];
const seen = ({ t, step, q, v }) => [t, step, ...q, ...v];
play.pause(); play.begin(name, null); showSliders(name);
while (play.leader.step < 3) play.sample();
play.tune({ slider, value, walks });
while (play.leader.walks && play.leader.step < 7) { play.sample(); states.push(seen(play.leader)); }
play.begin(name, null);
while (play.leader.step < 4) play.sample();
const text = scenarioText(play), saved = seen(play.leader);
play.tune({ slider, value: undefined, walks });
const [row] = [...document.querySelectorAll("#sliders input")].filter((x) => x.ariaLabel === "speed [m/s]");
const one = numbers.walks[name].sliders.find((x) => x.name === slider);
return { states, text, saved, one, shown: row !== undefined };
"""


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chrome]:
    path = tmp_path_factory.mktemp("page") / "all.html"
    with pytest.MonkeyPatch.context() as patch:
        # the tour would be five walks more, which test_play.py walks
        patch.setattr("biped_adrc.extras.play.page.guided", lambda *_: [])
        path.write_text(page(FIRST, WALKS, samples=0), encoding="utf-8")
    with chromium() as started:
        started.get(path.as_uri())
        started.set_window_size(500, 400)  # what is drawn is not looked at
        started.implicitly_wait(60)
        started.find_element("css selector", "#sliders input")
        yield started


def same(walk: ba.Walk, t: float, step: float, *x: float) -> None:
    """The state x of the page at t [s] is that of the finished walk."""
    arc = walk.trajectory.arcs[int(step) - 1]
    # t may be behind the arc's end by round-off
    there = arc(min(t, float(arc.t[-1])), "left")[: len(x)]
    np.testing.assert_allclose(x, there, rtol=0.0, atol=1e-8, err_msg=f"at {t} s")


def test_every_controller_that_is_traced_is_here() -> None:
    """WALKS and NOT_TRACED, those that have no machine code for a page, are all registered controllers: a new
    one has to be put into one of them.
    """
    walked = {revised(FIRST, x).controller.name for x in WALKS.values()}
    assert walked | NOT_TRACED == {*REGISTRY["controller"]}


@pytest.mark.parametrize("name", WALKS)
def test_what_a_hand_did_is_walked_again(browser: Chrome, tmp_path: Path, name: str) -> None:
    """Script HAND walks 1.3 s in the page with a push and a pull, and returns states and the scenario that the
    page saves. The package's simulator, given that scenario, has the same states at the same times, and the
    same end.
    """
    found = browser.execute_script(HAND, name, 1.3)
    path = tmp_path / "by_hand.toml"
    path.write_text(found["text"], encoding="utf-8")
    walk = ba.walk_scenario(read_scenario(path))
    assert len(found["states"]) > 15  # it did not end at once
    for state in found["states"]:
        same(walk, *state)
    if found["ending"]:
        assert found["ending"].startswith(walk.trajectory.status.name.lower().replace("_", " "))
    assert console(browser) == []


def test_the_speed_moves_while_it_walks(browser: Chrome, tmp_path: Path) -> None:
    """A slider that goes from the speed of the walk to 0.7 m/s in step 3 does what a schedule does that has the
    first speed up to step 3; one that is moved before the walk does what the scenario says that the page saves.
    Its range is that of the family.
    """
    found = browser.execute_script(MOVED, "footstep", 0.7)
    schedule = {"controller.speeds": [found["one"]["value"]] * 3, "controller.speed": 0.7}
    s = revised(FIRST, WALKS["footstep"]).replace({**schedule, "run.impacts": 6})
    walk = ba.walk_scenario(s)
    family = walk.walker.law.family  # type: ignore[attr-defined]
    assert [found["one"][end] for end in ("low", "high")] == [family.low[0], family.high[0]]
    assert found["shown"]
    assert found["states"][-1][1] == 7
    for state in found["states"][::25]:
        same(walk, *state)
    path = tmp_path / "saved.toml"
    path.write_text(found["text"], encoding="utf-8")
    same(ba.walk_scenario(read_scenario(path)), *found["saved"])
