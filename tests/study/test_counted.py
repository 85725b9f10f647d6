"""A row of a study, from the table of the compiled walk and from all nodes of the same walk.

run_trials(records) makes the rows of these scenarios, as a study does; walk_scenario gives the walk itself.
"""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.scenario.build import limits
from biped_adrc.studies.build import scenario_of
from biped_adrc.studies.page import _figures
from biped_adrc.studies.run import counted_in, run_trials

PULL = {"shape": "sine", "link": "torso", "force": 40.0, "step": 2, "duration": 0.3}
PULSE = {**PULL, "shape": "pulse"}
WRONG = {"impact_width": 0.02, "mass_width": 0.05}
BETWEEN = {**PULSE, "onset": 0.1004, "duration": 0.0503}
CASES = {
    "pulled by a sine": {"controller": "LESO", "hardware.period": 1e-3, "pushes": [PULL]},
    "pulse between instants": {"hardware.period": 1.5e-3, "pushes": [BETWEEN]},
    "encoders, delay, lag": {"hardware": {"profile": "rabbit", "delay": 0.7e-3, "lag": 1e-3}},
    "other impacts": {"hardware.period": 1e-3, "errors": WRONG, "ground.slope": 0.01},
    "falls": {"hardware.period": 1e-3, "pushes": [{**PULSE, "force": 900.0}]},
    "falls off the curve": {
        "hardware.period": 1e-3,
        "pushes": [{**PULSE, "force": 900.0, "direction": math.pi}],
    },
}


@pytest.mark.parametrize("name", CASES)
def test_a_row_has_the_numbers_of_the_signals_of_its_walk(name):
    """A row of a study is computed from the table that the compiled walk fills; `counted_in` computes the same
    columns from all signals of the same walk. They agree to round-off in each of CASES, falls included.
    """
    s = ba.Scenario(**{"controller": "NPD", "run.impacts": 3, **CASES[name]})
    row, walk = run_trials([s.record()])[0], ba.walk_scenario(s)
    assert row["status"] == walk.trajectory.status.name
    for column, x in counted_in(walk, limits(s)).items():
        if isinstance(x, float) and np.isfinite(x):
            assert row[column] == pytest.approx(x, rel=1e-9, abs=1e-12), column
        else:
            assert row[column] == x, column


@pytest.mark.parametrize("conditions", [[], ["5 N", "9 N"]])
def test_the_page_has_a_picture_of_feasible_walks_under_several_conditions_alone(
    tmp_path, conditions
):
    """Under one condition the feasible walks are a column of the page's table. In the picture each of 2 laws
    has a dot under each of 2 conditions; of one walk the share is 0 or 1. The axis of a ratio has no unit.
    """
    laws = {f"K_p {x}": {"controller.K_p": x} for x in (4000.0, 5000.0)}
    tables = {
        "name": "page",
        "base": {"controller.name": "NPD", "run.impacts": 1},
        "cases": laws,
        "conditions": {x: {"pushes": [{**PULSE, "step": 1, "force": x}]} for x in conditions},
    }
    pictures = dict(_figures(ba.study(tables, tmp_path, ThreadPoolExecutor(1))))
    assert ("Whose walks are feasible?" in pictures) == bool(conditions)
    (axes,) = pictures["Who is better on the same walk?"].axes
    assert axes.get_xlabel() == "ratio to K_p 4000.0 in rms_error"
    if conditions:
        (axes,) = pictures["Whose walks are feasible?"].axes
        dots = [x for line in axes.lines for x in line.get_xdata()]
        assert axes.get_xscale() == "linear"
        assert len(dots) == 4
        assert set(dots) <= {0.0, 1.0}


def test_a_study_that_asks_for_rounding_has_it(tmp_path):
    """The column `rounding` (how far two walks whose starts are 1e-12 apart differ) is that of the walk itself,
    without and with encoder counts; in a row that does not ask for it, it is None.
    """
    base = {"controller.name": "NPD", "run.impacts": 2}
    tables = {"name": "rounding", "column": "rounding", "base": base}
    tables["grid"] = {"hardware.encoders.counts": ["none", 8192.0]}
    exact, counted = ba.study(tables, tmp_path / "rounding", ThreadPoolExecutor(1)).rows()
    s = ba.Scenario(**{"hardware": "ideal", **base})
    assert exact["rounding"] == ba.walk_scenario(s).rounding() < 1e-10
    s = s.replace({"hardware.encoders.counts": 8192.0})
    assert counted["rounding"] == ba.walk_scenario(s).rounding()
    assert run_trials([base])[0]["rounding"] is None


def test_errors_of_a_fall_are_those_of_the_walk_and_end_where_it_leaves_the_gait():
    """A push of -150 N m throws the robot back, behind the start of the curve. The row's errors are the walk's,
    up to there: less than a tenth of the distance from the curve that was reached while it fell.
    """
    values = {"controller.name": "NPD", "gait.name": "v0.8", "run.impacts": 9}
    values |= {"hardware.torque_limit": 150.0, "hardware.period": 1e-3}
    values |= {"pushes": "q1,q2=-150@4:0.3-0.5"}
    (row,), walk = run_trials([values]), ba.walk_scenario(scenario_of(values))
    assert row["status"] == walk.trajectory.status.name == "FELL"
    assert row["peak_error"] == pytest.approx(walk.signals.peak_error, rel=1e-4)
    assert row["rms_error"] == pytest.approx(walk.outcome.rms_error, rel=1e-3)
    assert row["peak_error"] < 0.1 * np.nanmax(np.abs(walk.signals.q[:, :4] - walk.signals.q_d))
