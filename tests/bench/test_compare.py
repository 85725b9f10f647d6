"""The comparison: statistics against closed forms, the table, what is stored and written."""

import json
import math
from functools import partial

import numpy as np
import pytest

from biped_adrc.analysis.statistics import median, share
from biped_adrc.bench import compare_study
from biped_adrc.bench.cell import IMPULSE, MEASURES, NEEDS, REASONS
from biped_adrc.bench.compare_study import RESULTS, run_comparison
from biped_adrc.bench.comparison import compare
from biped_adrc.bench.conditions import conditions_on
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.run import COLUMNS, run_trial
from biped_adrc.bench.settings import AS_PUBLISHED, SETTINGS
from biped_adrc.campaign.workers import Threads
from biped_adrc.errors import BipedError, InputError
from biped_adrc.viz import comparison_text

published = partial(run_comparison, settings=AS_PUBLISHED)


def row(made, feasible=None, status=None, **values):
    """A made-up row: feasible where it made all steps, if not told otherwise."""
    known = dict.fromkeys(COLUMNS) | dict.fromkeys(MEASURES, 1.0) | dict.fromkeys(NEEDS, 1.0)
    known |= dict.fromkeys((*REASONS, IMPULSE), 0)
    return known | {
        "survived": int(made),
        "feasible": int(made if feasible is None else made and feasible),
        "but_impact": 0,
        "outcome": "infeasible" if feasible is False else "feasible",
        "status": status or ("COMPLETED" if made else "FELL"),
        "detail": "it says",
        **values,
    }


def test_every_condition_is_a_trial_that_any_controller_can_walk():
    for settings in SETTINGS.values():
        for name in conditions_on("rigid", settings.alike):
            for contestant in settings.contestants:
                made = trial(settings.record(name, contestant, 3))
                assert made.controller == settings.controller(contestant)
                assert trial(made.record()) == made
                assert trial(json.loads(json.dumps(made.record()))) == made


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
    def walk(r):
        if r["controller"] == "NPD":
            return row(True, peak_error=0.1)
        made, feasible = r["seed"] % 4 != 3, r["seed"] % 4 != 2
        return row(
            made,
            feasible,
            peak_error=0.01 * (1 + r["seed"]),
            bad_friction=int(not feasible),
            bad_torque=int(r["seed"] == 2),
            bad_impulse=None if r["seed"] else 1,
            mean_friction=0.1 * r["seed"],
        )

    found = compare(
        lambda records: [walk(r) for r in records], ["NPD", "ADRC"], ["nothing", "delay"], 8
    )
    cell = found.cell("ADRC", "delay")
    assert (cell.controller, cell.condition) == ("ADRC", "delay")
    assert (cell.survived.value, cell.feasible.value) == (0.75, 0.5)
    assert cell.feasible == share(4, 8)
    assert cell.falls == {"FELL": 2}
    assert cell.reasons["bad_friction"] == share(2, 6)
    assert cell.reasons["bad_torque"] == share(1, 6)
    assert cell.impulse == share(1, 1)
    plain = cell.row()
    assert plain["peak_error"][0] == pytest.approx(np.median([1, 2, 5, 6]) * 0.01)
    assert plain["made"]["peak_error"][0] == pytest.approx(np.median([1, 2, 3, 5, 6, 7]) * 0.01)
    assert plain["needs"]["mean_friction"][0] == pytest.approx(np.median([0, 1, 2, 4, 5, 6]) * 0.1)
    assert found.cell("NPD", "nothing").survived.value == 1.0
    texts = dict(zip(comparison_text.SHARES, comparison_text.share_texts(plain), strict=True))
    assert texts["the others ended"] == "2 fell"
    assert texts["made, but not feasible for [%]"] == "friction 33, torque 17"
    assert texts["feasible [%]"].startswith("50 (")
    assert texts["made all steps [%]"].startswith("75 (")
    json.dumps(plain, allow_nan=False)


@pytest.mark.parametrize("status", ["REFUSED", "RAISED", "CRASHED"])
def test_what_was_no_walk_is_no_fall(status):
    with pytest.raises(InputError, match=f"{status}: it says"):
        compare(
            lambda records: [row(False, status=status) for _ in records], ["NPD"], ["nothing"], 2
        )


def made_up(records):
    """In place of walks: ADRC tracks better and LESO too, and one seed in five is not feasible."""
    error = {"NPD": 1.0, "LESO": 0.3, "ADRC": 0.1}
    found = []
    for r in records:
        seed = r.get("seed", 0)
        peak = error[r.get("controller", "ADRC")] * (1.0 + 0.01 * seed)
        feasible = seed % 5 != 4
        found.append(row(True, feasible, peak_error=peak, bad_friction=int(not feasible)))
    return found


def test_a_comparison_is_written_and_gone_on_with(tmp_path, monkeypatch):
    asked = (("NPD", "LESO", "ADRC"), ("nothing", "sine on joints", "encoders"), 4)
    monkeypatch.setattr(compare_study, "run_trials", made_up)
    summary = published(tmp_path, "the command", *asked, Threads(2))
    assert "the command" in (tmp_path / "comparison.html").read_text()
    stored = json.loads((tmp_path / "summary.json").read_text())
    told = []
    again = published(tmp_path, "the command", *asked, Threads(2), lambda p: told.append(p.fresh))
    assert max(told) == 0
    assert again == summary == stored
    with pytest.raises(BipedError, match="other in conditions"):
        published(tmp_path, "the command", ("NPD",), ("nothing",), 2, Threads(1))
    assert (tmp_path / RESULTS).exists()


def test_walks_of_rabbit_are_judged_by_the_ground(tmp_path):
    """With encoders RABBIT makes all steps, and the ground would have to hold more than its friction."""
    asked = (("NPD",), ("nothing", "encoders"), 2, Threads(2))
    summary = published(tmp_path, "the command", *asked)
    assert summary["walks"] == 5
    assert summary["nominal"]["outcome"] == "feasible"
    assert summary["nominal"]["limits"]["friction"] == 0.6
    assert 0.4 < summary["nominal"]["needs"]["mean_friction"] < 0.6
    nothing, encoders = summary["cells"]
    assert (nothing["survived"][0], nothing["feasible"][0]) == (1.0, 1.0)
    assert (encoders["survived"][0], encoders["feasible"][0]) == (1.0, 0.0)
    assert encoders["reasons"]["bad_friction"][0] == 1.0
    assert encoders["peak_error"] is None
    rows = [run_trial(AS_PUBLISHED.record("nothing", "NPD", seed)) for seed in range(2)]
    assert nothing["peak_error"][0] == np.median([r["peak_error"] for r in rows])
