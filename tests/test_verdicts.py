"""Checks of the reproduction on made-up outcomes; what breaks one reaches the summary and the exit code."""

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

from biped_adrc.analysis.certificate import Certificate
from biped_adrc.analysis.feasibility import Feasibility
from biped_adrc.analysis.return_map import PeriodicOrbit
from biped_adrc.campaign.pool import Timed
from biped_adrc.checks import at_most
from biped_adrc.cli.app import EXIT_CHECK_FAILED, app
from biped_adrc.gait.published import X_STAR
from biped_adrc.hybrid.status import Status
from biped_adrc.paper import reproduction, verdicts
from biped_adrc.paper.claims.tally import AtTwoSteps, ClaimCase, Tally
from biped_adrc.paper.claims.words import judged
from biped_adrc.paper.plan import Plan, RecipeResult
from biped_adrc.paper.results import Results
from biped_adrc.robots.limits import KnownLimits
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.cycle_stability import PoincareResult

CERTIFICATE = Certificate(
    step=1,
    duration=0.4,
    least_normal_force=200.0,
    friction=0.4,
    share_outside=0.0,
    mean_normal_force=200.0,
    mean_friction=0.4,
    scuffing=0.0,
    slip=0.0,
    peak_torque=100.0,
    impulse_ratio=0.5,
    friction_limit=0.6,
    torque_limit=150.0,
    window=5e-3,
    step_length=0.3,
    old_foot_velocity=0.1,
    clearance=0.01,
    joint_work=10.0,
    energy_lost=10.0,
    cost_of_transport=0.3,
)
FEASIBILITY = Feasibility(Status.COMPLETED, (CERTIFICATE,), KnownLimits(0.6, 150.0, 5e-3), 1)


def outcome(controller, peak=1e-2, impacts=9, asked=9, **more):
    status = "COMPLETED" if impacts == asked else "FELL"
    made = Outcome(
        Scenario(controller, run={"impacts": asked}),
        status,
        "",
        impacts,
        np.tile(X_STAR, (impacts, 1)),
        np.full(impacts, 0.4),
        peak,
        peak,
        100.0,
        (CERTIFICATE,),
        FEASIBILITY,
        "rk4",
        "compiled",
    )
    return replace(made, **more)


def results(**odd):
    """Outcomes with which every check holds, but for those given by name, with _ for a space."""
    found = {}
    for c, peak in (("NPD", 1e-2), ("ADRC", 1e-5)):
        found[f"headline {c}"] = head(c, peak), []
        for name in ("sine", "torso", "1 kHz"):
            found[f"{name} {c}"] = outcome(c, peak)
        found[f"engines {c}"] = outcome(c, peak, half=outcome(c, peak))
        for kind in ("masses", "masses and inertias"):
            found[f"heavier, {kind} {c}"] = outcome(c, peak)
        found[f"nominal identified {c}"] = outcome(c)
        record = {"multipliers": [0.7], "stable": True}
        found[f"recipe identified {c}"] = RecipeResult("identified", c, True, "", record)
    orbit = SimpleNamespace(multipliers=np.array([0.694, 1e-5]))
    found["multipliers NPD"] = SimpleNamespace(orbit=orbit, delta_squared=0.694)
    found["multipliers ADRC"] = SimpleNamespace(orbit=orbit)
    for name, value in odd.items():
        found[name.replace("_", " ")] = value
    return Results.of(found)


PLAN = Plan(quick=True)


def orbit_with(multiplier):
    return PeriodicOrbit(np.zeros(10), np.array([multiplier]), 0.0, 1)


def broken(**odd):
    """Names of the checks that do not hold."""
    r = results(**odd)
    checks = (
        verdicts.consistency_checks(PLAN, r)
        + verdicts.push_checks(r)
        + verdicts.engine_checks(r)
        + verdicts.multiplier_checks(r)
        + verdicts.recipe_checks(PLAN, r)
        + verdicts.certificate_checks(PLAN, r)
    )
    return [check.name for check in checks if not check.holds]


def head(controller, *arguments, **more):
    return SimpleNamespace(outcome=outcome(controller, *arguments, **more))


def test_all_hold_on_good_outcomes():
    assert broken() == []


@pytest.mark.parametrize(("ratio", "count"), [(0.0099, 0), (0.011, 1), (math.nan, 1)])
def test_a_ratio_just_over_the_limit(ratio, count):
    found = broken(headline_ADRC=(head("ADRC", 1e-2 * ratio), []))
    assert len(found) == count
    assert all("the push" in name for name in found)
    found = broken(sine_ADRC=outcome("ADRC", 1e-2 * ratio))
    assert len(found) == count
    assert all("sine" in name for name in found)


@pytest.mark.parametrize("controller", ["NPD", "ADRC"])
def test_a_fall(controller):
    assert broken(**{f"headline_{controller}": (head(controller, 1e-5, 8), [])})
    assert broken(**{f"1_kHz_{controller}": outcome(controller, 1e-5, 8)})
    fallen = outcome(controller, impacts=8, x_minus=np.tile(X_STAR, (8, 1)))
    found = broken(**{f"nominal_identified_{controller}": fallen})
    assert [name for name in found if "distance to x*" in name]


def test_a_walk_away_from_x_star():
    off = X_STAR + np.eye(10)[3] * 6e-4
    found = broken(nominal_identified_NPD=outcome("NPD", x_minus=np.tile(off, (9, 1))))
    assert len(found) == 1
    near = X_STAR + np.eye(10)[3] * 4e-4
    assert broken(nominal_identified_NPD=outcome("NPD", x_minus=np.tile(near, (9, 1)))) == []


@pytest.mark.parametrize(
    "odd",
    [
        {"friction": 0.61},
        {"friction": math.nan},
        {"peak_torque": 151.0},
        {"least_normal_force": -1.0},
        {"least_normal_force": math.nan},
    ],
)
def test_a_certificate_that_is_broken(odd):
    bad = outcome("ADRC", certificates=(CERTIFICATE, replace(CERTIFICATE, **odd)))
    assert len(broken(nominal_identified_ADRC=bad)) == 1


def test_engines_that_disagree():
    gap = outcome("NPD", x_minus=np.tile(X_STAR + 2e-6, (9, 1)))
    assert len(broken(engines_NPD=outcome("NPD", half=gap))) == 1
    fewer = outcome("NPD", impacts=8, x_minus=np.tile(X_STAR, (8, 1)))
    assert len(broken(engines_NPD=outcome("NPD", half=fewer))) == 1
    none = outcome("NPD", impacts=0, x_minus=np.zeros((0, 10)))
    assert len(broken(engines_NPD=replace(none, half=none))) == 1


@pytest.mark.parametrize(("gap", "holds"), [(0.9e-4, True), (1.1e-4, False), (math.nan, False)])
def test_a_multiplier_that_the_step_decides(gap, holds):
    half = PoincareResult("NPD", "identified", "model", True, orbit_with(0.694 + gap), 0.694)
    found = replace(half, orbit=orbit_with(0.694), half=half)
    record = {"multipliers": [0.7], "multipliers_change": gap}
    recipe = RecipeResult("identified", "NPD", True, "", record)
    head = outcome("ADRC", 1e-5, half=outcome("ADRC", 1.001e-5, half=outcome("ADRC", 1.0015e-5)))
    r = {
        "headline NPD": (SimpleNamespace(outcome=outcome("NPD")), []),
        "headline ADRC": (SimpleNamespace(outcome=head), []),
        "multipliers NPD": found,
        "recipe identified NPD": recipe,
    }
    checks = [c for c in verdicts.convergence_checks(Results.of(r)) if "multiplier" in c.name]
    assert [c.holds for c in checks] == [holds, holds]
    assert "not told from zero" in checks[0].name


def test_a_recipe_that_does_not_close():
    bad = RecipeResult("identified", "NPD", False, "no cycle", {})
    assert len(broken(recipe_identified_NPD=bad)) == 1
    unstable = RecipeResult("identified", "NPD", True, "", {"multipliers": [1.01]})
    assert len(broken(recipe_identified_NPD=unstable)) == 1


# -- the summary and the exit code -------------------------------------------------------------------
def claim(ratio):
    """One member, whose ratio is given."""
    holds = bool(ratio <= 0.01)
    case = ClaimCase("member", AtTwoSteps(ratio, ratio), holds)
    return judged("ADRC rejects", "VI", Tally((case,)), f"{ratio}", "made up", asserted=True)


@pytest.fixture
def stubbed(monkeypatch):
    """`reproduce` without its runs and pictures: checks and claims are what a test says."""

    def stub(checks, claims):
        values = {"numerics": ([], {})}
        for c in ("NPD", "ADRC"):
            values[f"headline {c}"] = (head(c), [])
            values[f"nominal identified {c}"] = outcome(c)
            values[f"multipliers {c}"] = SimpleNamespace(record=dict)
        values["model identified"] = []
        replaced = {
            "planned_tasks": lambda plan: dict.fromkeys(values),
            "run_tasks": lambda *_: [Timed(value, 0.0) for value in values.values()],
            "_checks": lambda *_: checks,
            "claims": lambda *_: claims,
            "gathered": lambda *_: {},
            "findings": lambda *_: [],
            "tables": lambda *_: {},
            "_save": lambda *_: None,
            "draw_all": lambda *_: {},
            "_animate": lambda *_: "",
            "_stored": lambda *_: None,
            "_three_steps": lambda _: {},
        }
        for name, value in replaced.items():
            monkeypatch.setattr(reproduction, name, value)
        monkeypatch.setattr(Results, "regressions", {})
        monkeypatch.setattr(verdicts, "recipe_notes", lambda *_: [])

    return stub


@pytest.mark.parametrize(
    ("value", "ratio", "word", "holds"),
    [
        (0.5, 0.0099, "replicated", True),
        (0.5, 0.0101, "contradicted", False),
        (0.5, math.nan, "contradicted", False),
        (1.5, 0.0099, "replicated", False),
        (math.nan, 0.0099, "replicated", False),
    ],
)
def test_one_broken_check_reaches_summary_and_exit_code(
    stubbed, tmp_path, value, ratio, word, holds
):
    stubbed([at_most("c", "law", value, 1.0)], [claim(ratio)])
    done = CliRunner().invoke(app, ["reproduce", "--quick", "--out", str(tmp_path)])
    assert done.exit_code == (0 if holds else EXIT_CHECK_FAILED), done.output
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["holds"] is holds
    assert [row["word"] for row in summary["claims"]] == [word]
    report = (tmp_path / "report.html").read_text()
    assert report.index("no reproduction of their numbers") < report.index("ADRC rejects")
    if not holds:
        assert "does not hold" in done.output


@pytest.mark.parametrize("kind", ["masses", "masses and inertias"])
@pytest.mark.parametrize(("ratio", "count"), [(0.99, 0), (1.0, 1), (1.01, 1), (math.nan, 1)])
def test_a_heavier_plant_has_to_be_tracked_better(kind, ratio, count):
    r = results(**{f"heavier, {kind} ADRC": outcome("ADRC", 1e-2 * ratio)})
    checks = [c for c in verdicts.push_checks(r) if not c.holds]
    assert [f"heavier plant ({kind})" in c.name for c in checks] == [True] * count


@pytest.mark.parametrize(("gap", "count"), [(0.0099, 0), (0.0101, 1)])
def test_step_times_after_a_push_of_the_torso_differ_by_one_per_cent_at_most(gap, count):
    late = outcome("ADRC", durations=np.append(np.full(8, 0.4), 0.4 * (1.0 + gap)))
    assert len(broken(torso_ADRC=late)) == count
