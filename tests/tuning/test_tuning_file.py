"""What may be wrong in the file of a tuning study, all of it in one error; scenario files; what is written."""

import math
import re
from copy import deepcopy

import linear_plant as plant
import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.bench.parameters import nested
from biped_adrc.bench.study_file import read_study
from biped_adrc.bench.sweep import sweep
from biped_adrc.campaign.workers import Threads
from biped_adrc.cli import app
from biped_adrc.errors import InputError
from biped_adrc.scenario.file import read_scenario, write_scenario
from biped_adrc.tuning.study_file import load_tuning, read_tuning
from biped_adrc.tuning.tune import tune

from .test_measures import STUDY


def changed(**changes):
    """The tables with some entries replaced: {"study.budget": 3}, or left out where the value is ..."""
    tables = deepcopy(STUDY)
    for place, x in changes.items():
        *path, last = re.split(r"__", place)
        inner = tables
        for key in path:
            inner = inner[int(key)] if isinstance(inner, list) else inner[key]
        if x is ...:
            del inner[last]
        else:
            inner[last] = x
    return tables


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"selection__seeds": [1, 2]}, r"selection.seeds: share \[1\] with training.seeds"),
        ({"test": ...}, r"test: found None, expected a table \[test\]"),
        ({"variables__bandwith": {"from": 1, "to": 2}}, "variables.bandwith: .*'bandwidth'"),
        (
            {"variables__bandwidth": {"from": 2, "to": 1}},
            "variables.bandwidth: .*expected from < to",
        ),
        ({"objectives__0__column": "rms_eror"}, r"objectives\[1\].column: .*'rms_error'"),
        ({"limits__0__most": 1.0}, r"limits\[1\]: has \['least', 'most'\], expected one of"),
        ({"study__generation": 2}, "study.generation: found 2, expected at least 4"),
        ({"fixed__seed": 1}, "fixed.seed: seeds are given by the sets"),
    ],
)
def test_mistakes_of_a_tuning_file_are_named_by_their_place(changes, message):
    with pytest.raises(InputError, match=message):
        read_tuning(changed(**changes))


def test_a_study_takes_the_values_of_a_scenario_file(tmp_path):
    path = tmp_path / "s.toml"
    write_scenario(
        path, ba.Scenario({"name": "LESO", "observer": {"bandwidth": 77.0}}, run={"impacts": 3})
    )
    study = read_tuning(changed(study__scenario=str(path), fixed={"impacts": 5}))
    assert {"controller": "LESO", "bandwidth": 77.0, "impacts": 5}.items() <= study.fixed.items()
    tables = {"study": {"name": "s", "scenario": str(path)}, "grid": {"bandwidth": [1.0, 2.0]}}
    swept = read_study(tables | {"fixed": {"impacts": 5}})
    assert swept.fixed == {"controller": "LESO", "robot": "rabbit", "impacts": 5}


@pytest.fixture(scope="module")
def tuned(tmp_path_factory):
    tables = plant.tables(budget=24, generation=8, name="a <b> $x$")
    tables["objectives"] = [{"column": "of_state"}, {"column": "of_torque"}]
    tables["limits"] = [{"column": "feasible", "least": 0.5}]
    out = tmp_path_factory.mktemp("tuned")
    return tune(read_tuning(tables, columns=plant.COLUMNS), out, Threads(1), function=plant.rows)


def test_the_best_file_is_the_scenario_of_the_choice(tuned):
    found = ba.Scenario(**nested(read_scenario(tuned.out / "best.toml")))
    assert found == tuned.scenario
    assert {f"own.{k}": x for k, x in found.own.items()} == tuned.chosen.chosen


WALKS = """
[study]
name = "walks"
budget = 3
generation = 3
finalists = 1
seed = 1
[fixed]
controller = "NPD"
impacts = 1
[variables]
K_p = { from = 2000.0, to = 9000.0, scale = "log" }
[[objectives]]
column = "rms_error"
[training]
seeds = [0]
[selection]
seeds = [1]
[test]
seeds = [2]
"""


def test_the_command_tunes_and_simulate_takes_what_it_wrote(tmp_path):
    path, out = tmp_path / "walks.toml", tmp_path / "out"
    path.write_text(WALKS)
    dry = CliRunner().invoke(app, ["tune", str(path), "--out", str(out), "--dry-run"])
    assert dry.stdout.strip() == "walks: 3 candidates, 3 walks on the training set"
    assert not out.exists()
    line = ["tune", str(path), "--out", str(out), "--threads", "--workers", "1"]
    done = CliRunner().invoke(app, line)
    assert done.exit_code == 0, done.output
    again = CliRunner().invoke(app, line)
    assert again.stdout.splitlines()[-1] == done.stdout.splitlines()[-1]
    best = ["simulate", "--scenario", str(out / "best.toml"), "--impacts", "2"]
    walked = CliRunner().invoke(app, best)
    assert walked.exit_code == 0, walked.output
    assert "2 impacts" in walked.stdout


def test_rows_are_those_of_a_sweep(tmp_path):
    (tmp_path / "walks.toml").write_text(WALKS)
    study = load_tuning(tmp_path / "walks.toml")
    tuned = tune(study, tmp_path / "tuned", Threads(1))
    K_p = [c.chosen["K_p"] for c in tuned.candidates[1:]]
    tables = {"study": {"name": "x", "seeds": [0]}, "fixed": study.fixed, "grid": {"K_p": K_p}}
    swept = sweep(read_study(tables), tmp_path / "swept", Threads(1)).table("rms_error", "feasible")
    pairs = zip(swept["rms_error"], swept["feasible"], strict=True)
    expected = [x if feasible else math.inf for x, feasible in pairs]
    assert [c.objectives[0] for c in tuned.candidates[1:]] == expected
