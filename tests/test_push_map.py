"""The map of pushes: what a walk under a push is called, on made-up walks and on one that is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.errors import InputError
from biped_adrc.paper.push_map import (
    PATTERNS,
    Fate,
    PushCell,
    Tried,
    apart,
    certain,
    counts,
    push_map,
    pushes,
)
from biped_adrc.scenario.run import execute
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.viz.plots.push_map import FATES, push_map_figure

LEGAL = Fate("legal", "COMPLETED", 200.0, 0.4, 0.5)
MADE = Fate("made", "COMPLETED", 50.0, 0.8, 0.5)
PULLED = Fate("made", "COMPLETED", -20.0, 0.5, 0.5)
FELL = Fate("fell", "FELL", 10.0, 0.9, None)
ENDED = Fate("ended", "SINGULAR", 10.0, 0.9, None)


def cell(npd: Fate, adrc: Fate, **place: object) -> PushCell:
    where = {"preset": "p", "onset": 0.1, "amplitude": 30.0, "pattern": "all +"}
    return PushCell(**{**where, "torque_limit": None, **place}, npd=npd, adrc=adrc)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("fate", "word"),
    [(LEGAL, "legal"), (MADE, "made"), (PULLED, "pulled"), (FELL, "fell"), (ENDED, "ended")],
)
def test_the_word_of_a_walk(fate, word):
    assert fate.word == word
    assert replace(fate, marginal=True).word == "marginal"
    assert word in FATES


def test_marginal_cells_carry_no_claim():
    sure = [cell(MADE, LEGAL), cell(LEGAL, LEGAL), cell(LEGAL, FELL)]
    cells = [*sure, cell(replace(MADE, marginal=True), LEGAL)]
    assert certain(cells) == sure
    assert apart(cells) == {"p, unlimited": (1, 1)}
    assert counts(cells)["p, unlimited"]["NPD"]["marginal"] == 1
    assert counts(cells)["p, unlimited"]["ADRC"] == {
        "legal": 3,
        "made": 0,
        "pulled": 0,
        "fell": 1,
        "ended": 0,
        "marginal": 0,
    }


def test_settings_are_kept_apart():
    cells = [cell(LEGAL, LEGAL), cell(FELL, LEGAL, torque_limit=150.0)]
    assert list(counts(cells)) == ["p, unlimited", "p, 150 N m"]


def test_a_fall_of_the_polynomial_is_none_of_the_robot():
    """A late push that throws NPD past the phase range, where the gait's polynomial explodes."""
    tried = Tried(0.3, 150.0, "swing knee -", None)
    run = replace(tried.run(Scenario(preset="identified-bare"), "NPD"), continued=False)
    assert not execute(run).walked
    (found,) = push_map(Scenario(preset="identified-bare"), [tried])
    assert found.npd.status == "COMPLETED"
    assert found.npd.word != "legal"


def test_the_map_of_soft_ground_halves_the_step_of_its_engine(monkeypatch):
    pytest.importorskip("mujoco")
    monkeypatch.setattr("biped_adrc.paper.push_map.IMPACTS", 1)
    base = Scenario(plant="mujoco", period=1e-3, contact="hold", own={"integrator": "leapfrog"})
    tried = Tried(0.1, 30.0, "all +", 150.0)
    run = tried.run(base, "LESO")
    assert (run.h, run.plant, run.first_step) == (None, "mujoco", 19)
    (found,) = push_map(base, [tried], controllers=("NPD", "LESO"))
    assert (found.npd.word, found.adrc.word) == ("legal", "legal")
    expected = execute(run).legality.mean_normal_force
    assert found.adrc.mean_normal_force == expected
    assert found.npd.mean_normal_force != expected


@pytest.mark.parametrize(
    ("slip", "word", "why"),
    [(None, "legal", ()), (4.9e-3, "legal", ()), (5.1e-3, "made", ("slip",))],
)
def test_a_walk_whose_foot_slips_is_not_legal(slip, word, why):
    made = execute(Scenario("NPD", period=1e-3, h=1e-3, impacts=1))
    assert made.slip is None
    made = replace(made, slip=slip)
    fate = Fate.of(replace(made, half=made))
    assert (fate.word, fate.reasons) == (word, why)
    marginal = Fate.of(replace(made, half=replace(made, slip=1.0))).marginal
    assert marginal == (word == "legal")


def test_the_map_is_drawn_of_every_word():
    fates = [LEGAL, MADE, PULLED, FELL, ENDED, replace(LEGAL, marginal=True)]
    rows = [cell(f, LEGAL, onset=0.05 * k).row() for k, f in enumerate(fates)]
    figure = push_map_figure(rows)
    texts = {text.get_text() for text in figure.legends[0].get_texts()}
    assert texts == {text for text, _, _ in FATES.values()}
    (axes,) = figure.axes
    assert [patch.get_hatch() for patch in axes.patches[::2]] == [h for _, _, h in FATES.values()]
    assert {patch.get_hatch() for patch in axes.patches[1::2]} == {""}
    assert "NPD 1, ADRC 6 of 6" in axes.get_title(loc="left")
    assert (axes.get_xlabel()[-4:], axes.get_ylabel()[-5:]) == ("[ms]", "[N m]")
    assert "unlimited" in axes.get_title(loc="left")
    with pytest.raises(InputError, match="at least one"):
        push_map_figure([])


@pytest.mark.parametrize(
    ("name", "joints"),
    [("all", "1234"), ("hips", "12"), ("stance knee", "3"), ("swing knee", "4")],
)
def test_the_joints_of_a_pattern_are_those_of_its_name(name, joints):
    for sign in "+-":
        assert PATTERNS[f"{name} {sign}"] == {f"q{k}": float(f"{sign}1") for k in joints}


def test_hips_pushed_apart_and_together_are_opposite():
    apart, together = PATTERNS["hips apart"], PATTERNS["hips together"]
    assert apart == {"q1": 1.0, "q2": -1.0}
    assert together == {joint: -factor for joint, factor in apart.items()}


def test_pushes_are_all_combinations():
    found = pushes((0.0, 0.1), (30.0,), ("all +", "hips +"), (None, 150.0))
    assert len(found) == len(set(found)) == 8
    run = found[0].run(Scenario(), "NPD")
    assert run.pushes[0].stop - run.pushes[0].start == pytest.approx(0.2)
    assert run.continued


def test_a_continued_constraint_is_the_same_inside(biped, gait):
    inside = ba.continued(gait.constraint)
    for theta in np.linspace(gait.constraint.theta_minus, gait.constraint.theta_plus, 7):
        for one, other in zip(inside.h(theta), gait.constraint.h(theta), strict=True):
            np.testing.assert_allclose(one, other, rtol=0, atol=1e-12)
