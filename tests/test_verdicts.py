"""The checks of the reproduction hold up to their limits, on made-up results; a check that does not hold
reaches summary and exit code; and a plan has the runs that it says.

`results(**odd)` are made-up results with which every check holds, but for the entries `odd`; `broken(**odd)`
are the names of the checks that then do not hold. `outcome(controller, peak)` is a walk of nine impacts with
this largest error [rad]: 1e-2 under NPD, of which ADRC may have 1 %; `head` is one of the headline. `away(off)`
are states before nine impacts, `off` [rad] beside x*; `cycle(...)` has these multipliers, 0.694 being right.
"""

import json
import math
from collections import Counter
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

from biped_adrc.analysis.half_step import AtTwoSteps
from biped_adrc.cli.app import ExitCode, app
from biped_adrc.cli.study import lines
from biped_adrc.core.processes import Timed
from biped_adrc.core.verdict import at_least, at_most, below, between
from biped_adrc.gait.published import X_STAR
from biped_adrc.paper import reproduction
from biped_adrc.paper.reproduction import _recipe
from biped_adrc.paper.runs import Runs, tasks
from biped_adrc.paper.scenarios import CONTROLLERS, Plan, base_runs
from biped_adrc.paper.table import checks

from .made_up_results import CERTIFICATE, cycle, head, outcome, results


def away(off):
    """States before nine impacts of a walk, all off x* by `off` [rad] in one angle."""
    return np.tile(X_STAR + np.eye(10)[3] * off, (9, 1))


def broken(**odd):
    """Names of the checks that do not hold, claims aside."""
    return [check.name for check in checks(results(**odd), []) if not check.holds]


def test_all_hold_on_good_results_and_every_kind_is_there():
    """The reference for the tests below: nothing is broken by itself, no two checks have one name, and the
    three kinds occur."""
    found = checks(results(), [])
    assert [check.name for check in found if not check.holds] == []
    kinds = Counter(check.kind for check in found)
    assert set(kinds) == {"law", "consistency", "reproduced"}
    assert len({check.name for check in found}) == len(found)


@pytest.mark.parametrize(("ratio", "count"), [(0.0099, 0), (0.011, 1), (math.nan, 1)])
def test_a_ratio_just_over_the_limit(ratio, count):
    """ADRC's largest error over NPD's may be 0.01, in the headline walk and under the sine: 0.0099 breaks
    nothing, 0.011 or NaN one check of each."""
    odd = head("ADRC", 1e-2 * ratio)
    found = [x for x in broken(headline={"ADRC": odd}) if x.startswith("push: peak error")]
    assert len(found) == count
    ratios = broken(runs={"sine ADRC": outcome("ADRC", 1e-2 * ratio)})
    assert len([name for name in ratios if name.startswith("sine: peak")]) == count


@pytest.mark.parametrize("controller", ["NPD", "ADRC"])
def test_a_fall_breaks_checks_and_the_nominal_walks_distance_too(controller):
    """The walk ends after 8 of 9 impacts: an early end breaks the share of impacts made; of the nominal walk
    besides its distance to x*, which an unfinished walk does not have, though its last state here is x* itself.
    """
    fallen = outcome(controller, impacts=8, x_minus=np.tile(X_STAR, (8, 1)))
    assert broken(runs={f"1 kHz {controller}": fallen})
    found = broken(runs={f"nominal identified {controller}": fallen})
    assert [name for name in found if "distance to x*" in name]


@pytest.mark.parametrize(
    "odd",
    [
        {"friction": 0.61},
        {"friction": math.nan},
        {"peak_torque": 151.0},
        {"least_normal_force": -1.0},
        {"least_normal_force": math.nan},
        {"joint_work": 10.01},
    ],
)
def test_a_step_that_is_no_step_of_the_gait(odd):
    """One number of the second step is beyond friction 0.6, 150 N m, F_N >= 0, or the work that the impact
    loses (10 J, 1e-4): one check breaks. Without a finished step all four do."""
    bad = outcome("ADRC", certificates=(CERTIFICATE, replace(CERTIFICATE, **odd)))
    assert len(broken(runs={"nominal identified ADRC": bad})) == 1
    assert len(broken(runs={"nominal identified ADRC": outcome("ADRC", certificates=())})) == 4


@pytest.mark.parametrize(
    ("odd", "count"),
    [
        ({"runs": {"heavier, masses ADRC": outcome("ADRC", 1.01e-2)}}, 1),
        ({"runs": {"heavier, masses and inertias ADRC": outcome("ADRC", 1e-2)}}, 1),
        ({"runs": {"heavier, masses ADRC": outcome("ADRC", 0.99e-2)}}, 0),
        ({"runs": {"nominal identified NPD": outcome("NPD", x_minus=away(6e-4))}}, 1),
        ({"runs": {"nominal identified NPD": outcome("NPD", x_minus=away(4e-4))}}, 0),
        ({"engines": {"NPD": 2e-6}}, 1),
        ({"engines": {"NPD": math.inf}}, 1),
        ({"model": {"identified": dict.fromkeys(results().model["identified"], 2e-12)}}, 2),
        ({"cycles": {"gait (b), identified, NPD": "no cycle"}}, 3),
        ({"cycles": {"gait (b), identified, NPD": cycle(1.01)}}, 1),
        ({"cycles": {"gait (b), identified, NPD": cycle(0.7, change=1.1e-4)}}, 1),
        ({"cycles": {"gait (b), identified, NPD": cycle(0.7, change=0.9e-4)}}, 0),
        ({"multipliers": {"NPD": cycle(0.694 + 1.1e-5, 1e-5)}}, 1),
        ({"multipliers": {"NPD": cycle(0.694, 1.1e-3)}}, 1),
        ({"multipliers": {"ADRC": cycle(1.0)}}, 1),
        ({"runs": {"torso ADRC": outcome("ADRC", 1e-5, durations=np.full(9, 0.4) * 1.0101)}}, 1),
        ({"runs": {"torso ADRC": outcome("ADRC", 1e-5, durations=np.full(9, 0.4) * 1.0099)}}, 0),
    ],
)
def test_what_is_off_breaks_its_check(odd, count):
    """Each row has a number a little beyond the limit of `count` checks, or none at all; where count is 0 it is
    within the limit."""
    assert len(broken(**odd)) == count


# -- the summary and the exit code -------------------------------------------------------------------
@pytest.fixture
def stubbed(monkeypatch):
    """`reproduce` without its runs and pictures: results are what a test says."""

    def stub(r):
        replaced = {
            "tasks": lambda plan: {"made/up": None},
            "run_tasks": lambda *_: [Timed(None, 0.0)],
            "tables": lambda *_: {},
            "rebuilt_walk": lambda *_: SimpleNamespace(save=lambda _: None),
            "draw_all": lambda *_: {},
            "headline_animation": lambda *_: "",
        }
        for name, value in replaced.items():
            monkeypatch.setattr(reproduction, name, value)
        monkeypatch.setattr(Runs, "of", lambda *_: r)

    return stub


@pytest.mark.parametrize(
    ("ratio", "word", "holds"),
    [
        (0.0099, "replicated", True),
        (0.0101, "contradicted", False),
        (math.nan, "not testable", False),
    ],
)
def test_one_broken_claim_reaches_summary_and_exit_code(stubbed, tmp_path, ratio, word, holds):
    """ADRC's deviation under the push on gait (b) is `ratio` times NPD's, where 0.01 is allowed: the word
    stands in the JSON and the HTML, and the command fails unless the claim holds. Its summary stays short."""
    found = results()
    (only,) = found.pushed_recipe["identified"]
    npd = only.walked["NPD"]
    scaled = npd._replace(deviation=AtTwoSteps(*(ratio * x for x in npd.deviation)))
    odd = only._replace(walked={"NPD": npd, "ADRC": scaled})
    stubbed(replace(found, pushed_recipe={"identified": [odd]}))
    done = CliRunner().invoke(app, ["reproduce", "--quick", "--out", str(tmp_path)])
    assert done.exit_code == (0 if holds else ExitCode.CHECK_FAILED), done.output
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["holds"] is holds
    said = next(row for row in summary["claims"] if "independently" in row["claim"])
    assert said["word"] == word
    report = (tmp_path / "report.html").read_text()
    assert summary["tally"] in report
    # the preface of the claims comes before them
    assert report.index("no reproduction of their numbers") < report.index("independently")
    assert ("does not hold" in done.output) is not holds
    assert summary["tally"] in done.output
    assert len(lines(summary, tmp_path)) <= (10 if holds else 15)


def test_the_table_of_gait_b_has_a_row_for_each_walk_on_it():
    """Walks on gait (a) are not in it; where no periodic walk was found, the reason stands for its numbers."""
    table = _recipe(results(cycles={"gait (b), identified, NPD": "no cycle"}))
    none, one = (dict(zip(table["columns"], row, strict=True)) for row in table["rows"])
    assert [x["gait"] for x in (none, one)] == [f"gait (b), identified, {c}" for c in CONTROLLERS]
    for row, stable, size, remark in ((none, None, None, "no cycle"), (one, True, [0.7], "")):
        assert (row["stable"], row["largest multipliers"], row["remark"]) == (stable, size, remark)


# -- checks at their limits -------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("check", "inside", "outside"),
    [
        (lambda x: at_most("x", "law", x, 2.0), (1.9, 2.0, -math.inf), (2.1, math.inf, math.nan)),
        (lambda x: at_least("x", "law", x, 2.0), (2.1, 2.0, math.inf), (1.9, -math.inf, math.nan)),
        (lambda x: below("x", "law", x, 2.0), (1.9, -math.inf), (2.0, 2.1, math.inf, math.nan)),
        (lambda x: between("x", "law", x, 1.0, 2.0), (1.0, 1.5, 2.0), (0.9, 2.1, math.nan)),
    ],
)
def test_a_check_holds_up_to_its_limit(check, inside, outside):
    """inside and outside: values just within and beyond, infinities included. NaN is in no limit."""
    assert [check(x).holds for x in inside] == [True] * len(inside)
    assert [check(x).holds for x in outside] == [False] * len(outside)


# -- what is planned --------------------------------------------------------------------------------
def test_a_quick_plan_leaves_out_what_it_says() -> None:
    """Walks of the observer's resets, of (20) as printed and of two presets; the headline stays. `left_out`
    names the five parts. A full plan has the map of 2400 pushes."""
    whole, quick = tasks(Plan()), tasks(Plan(quick=True))
    assert set(quick) < set(whole)
    missing = set(whole) - set(quick)
    assert {"multipliers/ADRC", "multipliers/ADRC measured"} <= missing
    assert not [name for name in quick if name.startswith(("runs/reset", "runs/as printed"))]
    assert not [name for name in quick if "tac2003" in name or "bare" in name]
    assert {"headline/NPD", "headline/ADRC", "multipliers/NPD"} <= set(quick)
    assert len(Plan(quick=True).left_out) == 5
    assert len(Plan().left_out) == 1  # most of the map of pushes
    full = [task for name, task in tasks(Plan(full=True)).items() if name.startswith("map/")]
    assert sum(len(task.arguments[0]) for task in full) == 2400


def test_both_controllers_are_run_alike() -> None:
    """Each walk under NPD has one under ADRC with the same push, errors of the model and number of impacts:
    else their comparison says nothing."""
    runs = base_runs(Plan())
    for name, run in runs.items():
        if name.endswith(" NPD"):
            other = runs[f"{name.removesuffix('NPD')}ADRC"]
            assert (other.pushes, other.errors) == (run.pushes, run.errors)
            assert other.run.impacts == run.run.impacts
