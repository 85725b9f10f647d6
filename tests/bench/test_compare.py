"""The comparison: bisection and statistics against closed forms, the table, what is stored and written."""

import json
import math

import numpy as np
import pytest

from biped_adrc.errors import BipedError, InputError
from biped_adrc.studies.bench.catalogue import CONTROLLERS
from biped_adrc.studies.bench.compare_study import RESULTS, run_comparison
from biped_adrc.studies.bench.comparison import MEASURES, compare
from biped_adrc.studies.bench.conditions import CONDITIONS, record
from biped_adrc.studies.bench.findings import findings
from biped_adrc.studies.bench.largest_push import (
    DIRECTIONS,
    LADDER,
    PHASES,
    RESOLUTION,
    Search,
    largest_pushes,
    searches,
)
from biped_adrc.studies.bench.run import COLUMNS, run_trial
from biped_adrc.studies.bench.statistics import median, share
from biped_adrc.studies.bench.trial import Trial
from biped_adrc.studies.bench.workers import Threads


def row(survived, status="COMPLETED", **values):
    known = dict.fromkeys(COLUMNS) | dict.fromkeys(MEASURES, 1.0)
    return known | {"survived": int(survived), "status": status, "detail": "it says"} | values


def test_every_condition_is_a_trial_that_any_controller_can_walk():
    for name in CONDITIONS:
        for controller in CONTROLLERS:
            given = record(name, controller, 3)
            trial = Trial(**given)
            assert trial.controller == controller
            assert Trial(**trial.record()) == trial
            assert Trial(**json.loads(json.dumps(trial.record()))) == trial


@pytest.mark.parametrize("threshold", [-1.0, 0.0, 3.0, 77.7, 160.0, 319.0, 1e9])
def test_bisection_finds_the_threshold(threshold):
    """Walks that survive below a threshold and fall above."""
    asked = []

    def carry(records):
        asked.extend(r["amplitude"] for r in records)
        return [
            row(r["amplitude"] <= threshold, "COMPLETED" if r["amplitude"] <= threshold else "FELL")
            for r in records
        ]

    (found,) = largest_pushes([Search("NPD", "torso +", "late", 0)], carry)
    if threshold < 0.0:
        assert found.low is None
        assert found.largest == 0.0
    elif threshold >= LADDER[-1]:
        assert (found.low, found.high) == (LADDER[-1], None)
    else:
        assert found.low <= threshold < found.high
        assert found.high - found.low <= RESOLUTION
        assert found.largest == found.low
    rungs = math.ceil(math.log2(max(np.diff(LADDER)) / RESOLUTION))
    assert len(asked) <= len(LADDER) + rungs


def test_all_searches_share_their_rounds():
    rounds = []

    def carry(records):
        rounds.append(len(records))
        limits = {"early": 30.0, "middle": 61.0, "late": 200.0}
        names = {onset: name for name, onset in PHASES.items()}
        return [row(r["amplitude"] <= limits[names[r["onset"]]], "FELL") for r in records]

    found = largest_pushes(searches(["NPD", "ADRC"], 2), carry)
    assert len(found) == 2 * len(DIRECTIONS) * len(PHASES) * 2
    assert len(rounds) <= 8
    for s in found:
        limit = {"early": 30.0, "middle": 61.0, "late": 200.0}[s.phase]
        assert s.low <= limit < s.high <= s.low + RESOLUTION


def test_shares_and_medians_against_what_is_known():
    """Wilson's interval in closed form; a bootstrap that covers the true median as often as it says."""
    z, n, k = 1.959964, 20, 17
    p = k / n
    centre = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z / (1 + z**2 / n) * math.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    assert share(k, n) == pytest.approx((p, centre - half, centre + half), abs=1e-6)
    random = np.random.default_rng(5)
    covered = 0
    for _ in range(400):
        found = median(list(random.normal(3.0, 1.0, 20)))
        covered += found.low <= 3.0 <= found.high
    assert 0.90 < covered / 400 < 0.99
    assert median([None, None]) is None
    assert median([2.0, None, 4.0]).value == 3.0


def test_the_table_is_that_of_the_rows():
    def carry(records):
        return [
            row(
                r["seed"] % 4 != 3 or r["controller"] == "NPD",
                "COMPLETED" if r["seed"] % 4 != 3 or r["controller"] == "NPD" else "FELL",
                peak_error=0.1 if r["controller"] == "NPD" else 0.01 * (1 + r["seed"]),
            )
            for r in records
        ]

    found = compare(carry, ["NPD", "ADRC"], ["nothing", "delay"], seeds=8, pushes=False)
    cell = found.cell("ADRC", "delay")
    assert (cell.controller, cell.condition) == ("ADRC", "delay")
    assert cell.survived.value == 0.75
    assert cell.falls == {"FELL": 2}
    assert cell.medians["peak_error"].value == pytest.approx(np.median([1, 2, 3, 5, 6, 7]) * 0.01)
    assert found.cell("NPD", "nothing").survived.value == 1.0
    assert any("delay: least error with ADRC" in line for line in findings(found))


@pytest.mark.parametrize("status", ["REFUSED", "RAISED", "CRASHED"])
def test_what_was_no_walk_is_no_fall(status):
    with pytest.raises(InputError, match=f"{status}: it says"):
        compare(lambda records: [row(False, status) for _ in records], ["NPD"], ["nothing"], 2)


def test_names_that_there_are_not():
    for arguments, message in (
        ((["NPD", "nobody"], ["nothing"], 1), "nobody"),
        ((["NPD"], ["rain"], 1), "rain"),
        ((["NPD", "NPD"], ["nothing"], 1), "different ones"),
        (([], ["nothing"], 1), "different ones"),
        ((["NPD"], ["nothing"], 0), "0 seeds"),
    ):
        with pytest.raises(BipedError, match=message):
            compare(lambda records: [], *arguments)


def test_a_comparison_is_written_and_gone_on_with(tmp_path):
    asked = (("NPD", "LESO"), ("nothing", "encoders"), 2, False, Threads(2))
    summary = run_comparison(tmp_path, "the command", *asked)
    assert summary["walks"] == 8
    page = (tmp_path / "comparison.html").read_text()
    assert "the command" in page
    assert "http://" not in page.replace("http://www.w3.org", "")
    assert "https://" not in page
    stored = json.loads((tmp_path / "summary.json").read_text())
    told = []
    again = run_comparison(tmp_path, "the command", *asked, lambda p: told.append(p.fresh))
    assert max(told) == 0
    assert again == summary == stored
    one = next(
        c for c in summary["cells"] if c["controller"] == "LESO" and c["condition"] == "nothing"
    )
    rows = [run_trial(Trial(**record("nothing", "LESO", seed)).record()) for seed in range(2)]
    assert one["peak_error"][0] == np.median([r["peak_error"] for r in rows])
    with pytest.raises(BipedError, match="other in conditions"):
        run_comparison(tmp_path, "the command", ("NPD",), ("nothing",), 2, False, Threads(1))
    assert (tmp_path / RESULTS).exists()
