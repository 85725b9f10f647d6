"""The field `touchdown` of a scenario: what is made of it, and what a finished walk says.

It is a detector of touchdowns; "faulty" knows the true ones and makes errors, such as to be `late` [s]. USUAL
is a walk of two impacts under NPD with a period of 1 ms; `made(name, ..)` is the detector of such a scenario.
"""

from __future__ import annotations

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.hardware.touchdown import ByForce, ByKinematics, FaultyTouchdown
from biped_adrc.scenario.build import build
from biped_adrc.studies.run import run_trials

USUAL = {"controller.name": "NPD", "hardware.period": 1e-3, "run.impacts": 2}


def made(name, **own):
    return build(ba.Scenario(hardware={"touchdown": {"name": name, **own}}, **USUAL)).touchdown


def test_a_touchdown_is_made_by_its_name_and_its_values():
    """The detector by its name, in any case of letters, with the values given; none where the scenario names
    none. A faulty one draws from the scenario's seed, which is not looked at.
    """
    assert made("faulty", late=5e-3) == FaultyTouchdown(5e-3, seed=made("faulty").seed)
    assert made("Force", delay=2e-3, on=40.0) == ByForce(on=40.0, delay=2e-3)
    assert made("kinematics", height=1e-3) == ByKinematics(height=1e-3)
    assert build(ba.Scenario(**USUAL)).touchdown is None


@pytest.mark.parametrize("plant", ["rigid", "mujoco"])
def test_a_walk_says_when_its_controller_noticed(plant, tmp_path):
    """The notice comes 4 ms late, and then at the next tick of 1 ms: after 4 to 5 ms. The last touchdown ends
    the walk before it is noticed: NaN, and it counts as waiting, not as missed.
    """
    walk = ba.walk_scenario(
        ba.Scenario(hardware={"touchdown": {"name": "faulty", "late": 4e-3}}, ground=plant, **USUAL)
    )
    found = walk.touchdowns
    assert len(found.t) == 2
    assert 4e-3 - 1e-9 < found.late[0] < 5e-3
    assert np.isnan(found.late[1])
    assert (found.waits, found.rates.missed_share) == (True, 0.0)
    again = ba.load_walk(walk.save(tmp_path / "walk.npz"))
    np.testing.assert_array_equal(again.touchdowns.late, found.late)
    assert again.walker.touchdown == walk.walker.touchdown


@pytest.mark.parametrize("plant", ["rigid", "mujoco"])
def test_a_row_of_a_study_says_how_touchdowns_were_noticed(plant):
    """Step 1 is noticed early, by a false alarm 0.4105 s after its start; step 2 late by 4 ms to the next tick;
    step 3 waits when the walk ends. So half of the two that were judged are early, and one delay is both mean
    and largest. Without a detector there is no number.
    """
    values = {
        **USUAL,
        "run.impacts": 3,
        "hardware.touchdown.name": "faulty",
        "hardware.touchdown.late": 4e-3,
        "hardware.touchdown.false_at": [1, 0.4105],
        "ground.plant": plant,
        "hardware.torque_limit": 150.0,  # reached, as an early notice makes the controller ask for more
    }
    row = run_trials([values])[0]
    assert row["status"] == "COMPLETED"
    assert (row["early_share"], row["missed_share"], row["false_notices"]) == (0.5, 0.0, 0)
    assert 4e-3 - 1e-9 < row["late_mean"] == row["late_max"] < 5e-3
    rates = ba.walk_scenario(ba.Scenario(**values)).touchdowns.rates
    assert {name: row[name] for name in rates._fields} == pytest.approx(rates._asdict(), abs=1e-9)
    at_once = {name: x for name, x in values.items() if "touchdown" not in name}
    assert run_trials([at_once])[0]["false_notices"] is None
