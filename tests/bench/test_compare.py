"""The comparison: bisection and statistics against closed forms, the table, what is stored and written."""

import json
import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from biped_adrc.analysis.statistics import (
    holm,
    mcnemar,
    median,
    paired_equal,
    paired_ratio,
    share,
    sign_test,
)
from biped_adrc.bench import compare_study
from biped_adrc.bench.cell import IMPULSE, MEASURES, NEEDS, REASONS, Cell
from biped_adrc.bench.compare_study import RESULTS, run_comparison
from biped_adrc.bench.comparison import compare, nominal_trial
from biped_adrc.bench.conditions import BANDWIDTH, OWN, conditions_on
from biped_adrc.bench.largest_push import (
    DIRECTIONS,
    LADDER,
    PHASES,
    RESOLUTION,
    Bracket,
    Search,
    gathered,
    largest_pushes,
    median_span,
    searches,
    whole_span,
)
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.run import COLUMNS, run_trial
from biped_adrc.bench.settings import AS_PUBLISHED, SETTINGS
from biped_adrc.campaign.workers import Threads
from biped_adrc.errors import BipedError, InputError
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.viz import comparison_text

published = partial(run_comparison, settings=AS_PUBLISHED)


def row(made, legal=None, status=None, **values):
    """A made-up row: legal where it made all steps, if not told otherwise."""
    known = dict.fromkeys(COLUMNS) | dict.fromkeys(MEASURES, 1.0) | dict.fromkeys(NEEDS, 1.0)
    known |= dict.fromkeys((*REASONS, IMPULSE), 0)
    return known | {
        "survived": int(made),
        "legal": int(made if legal is None else made and legal),
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


@pytest.mark.parametrize("threshold", [-1.0, 0.0, 3.0, 77.7, 160.0, 319.0, 1e9])
@pytest.mark.parametrize("legal_share", [1.0, 0.9, 0.2, -1.0])
def test_bisection_finds_both_thresholds(threshold, legal_share):
    """Walks that survive below a threshold, and are legal below a share of it."""
    asked = []
    lawful = min(legal_share * threshold, threshold)

    def carry(records):
        asked.extend(r["amplitude"] for r in records)
        return [row(r["amplitude"] <= threshold, r["amplitude"] <= lawful) for r in records]

    (found,) = largest_pushes([Search("NPD", "torso +", "late", 0)], carry)
    for bracket, limit in ((found.survived, threshold), (found.legal, lawful)):
        if limit < 0.0:
            assert (bracket.low, bracket.ends) == (None, (0.0, 0.0))
        elif limit >= LADDER[-1]:
            assert (bracket.low, bracket.ends[1]) == (LADDER[-1], math.inf)
        else:
            assert bracket.low <= limit < bracket.high
            assert bracket.high - bracket.low <= RESOLUTION
    halvings = math.ceil(math.log2(max(np.diff(LADDER)) / RESOLUTION))
    assert len(asked) <= len(LADDER) + 2 * halvings
    assert len(asked) == len(set(asked)), "no amplitude is walked twice"


def test_the_ladder_ends_with_the_first_failure():
    """What is illegal on one rung and legal above counts to the rung below; above a fall nothing is walked."""
    asked = []

    def carry(records):
        asked.extend(r["amplitude"] for r in records)
        return [row(r["amplitude"] < 150.0, r["amplitude"] < 35.0) for r in records]

    (found,) = largest_pushes([Search("NPD", "torso +", "late", 0)], carry)
    assert max(asked) == 160.0
    assert found.legal.low <= 35.0 < 150.0 <= found.survived.high


def test_all_searches_share_their_rounds():
    rounds = []

    def carry(records):
        rounds.append(len(records))
        limits = {"early": 30.0, "middle": 61.0, "late": 200.0}
        names = {onset: name for name, onset in PHASES.items()}
        limit = [limits[names[r["onset"]]] for r in records]
        return [
            row(r["amplitude"] <= x, r["amplitude"] <= x / 2)
            for r, x in zip(records, limit, strict=True)
        ]

    found = largest_pushes(searches(["NPD", "ADRC"], 2), carry)
    assert len(found) == 2 * len(DIRECTIONS) * len(PHASES) * 2
    assert len(rounds) <= len(LADDER) + 7
    for s in found:
        limit = {"early": 30.0, "middle": 61.0, "late": 200.0}[s.phase]
        assert s.survived.low <= limit < s.survived.high <= s.survived.low + RESOLUTION
        assert s.legal.low <= limit / 2 < s.legal.high <= s.legal.low + RESOLUTION
    groups = gathered(found)
    assert len(groups) == len(found) // 2
    assert all(len(g.legal) == len(g.survived) == 2 for g in groups)


def test_a_median_of_censored_values_is_an_interval():
    """Whatever the values inside their intervals, and never a number where the highest rung was passed."""
    random = np.random.default_rng(2)
    brackets = [Bracket(x, x + 2.0) for x in (10.0, 30.0, 12.0, 50.0)]
    low, high = median_span(brackets)
    for _ in range(50):
        values = [random.uniform(b.low, b.high) for b in brackets]
        assert low <= np.median(values) <= high
    assert whole_span(brackets) == (10.0, 52.0)
    passed, failed = Bracket(LADDER[-1], None), Bracket(None, 0.0)
    assert median_span([passed, passed, Bracket(4.0, 5.0)]) == (LADDER[-1], math.inf)
    assert median_span([passed, Bracket(4.0, 5.0), Bracket(6.0, 7.0)]) == (6.0, 7.0)
    assert median_span([failed, failed, passed]) == (0.0, 0.0)
    assert comparison_text.span(median_span([passed]).plain()) == "at least 320"
    assert comparison_text.span([0.0, 0.0]) == "0"
    assert comparison_text.span([77.5, 80.0]) == "77.5 to 80"


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


def test_exact_tests_against_closed_forms():
    """Sign test and McNemar: 2^(1-n) when all n go one way; Holm by hand; ties and nothing at all."""
    assert sign_test(8, 0) == pytest.approx(2.0**-7)
    assert sign_test(0, 0) == 1.0
    assert mcnemar([True] * 6 + [False] * 3, [False] * 6 + [False] * 3) == pytest.approx(2.0**-5)
    assert mcnemar([True, False], [False, True]) == 1.0
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert holm([]) == []
    assert holm([0.9, 0.8]) == [1.0, 1.0]
    assert paired_ratio([], [], 1.1) is None
    assert paired_equal([], [], 0.1) is None
    assert paired_ratio([2.0] * 9, [1.0] * 9, 1.1).p == pytest.approx(2.0**-8)
    assert paired_ratio([1.05] * 9, [1.0] * 9, 1.1).p == 1.0
    assert paired_equal([1.0] * 9, [1.05] * 9, 0.1).p == pytest.approx(2.0**-9)
    assert paired_equal([1.0] * 9, [1.2] * 9, 0.1).p == 1.0


def test_pairing_finds_what_the_spread_over_seeds_hides():
    """Each seed is 1.5 times the other's, over three decades of seeds."""
    b = np.geomspace(1e-4, 1e-1, 20)
    found = paired_ratio(list(1.5 * b), list(b), 1.1)
    assert found.value == pytest.approx((1.5, 1.5, 1.5))
    swapped = paired_ratio(list(b), list(1.5 * b), 1.1)
    assert swapped.value.value == pytest.approx(1 / 1.5)
    assert swapped.p == found.p < 1e-5


def test_a_share_of_errors_is_covered_as_often_as_it_says():
    """Under no effect at the margin the paired test rejects in 5 % of the studies at most."""
    random = np.random.default_rng(3)
    wrong = [
        paired_ratio(list(1.1 * np.exp(random.normal(0, 0.3, 20))), [1.0] * 20, 1.1).p < 0.05
        for _ in range(600)
    ]
    assert np.mean(wrong) < 0.07


def test_the_table_is_that_of_the_rows():
    def walk(r):
        if r["controller"] == "NPD":
            return row(True, peak_error=0.1)
        made, legal = r["seed"] % 4 != 3, r["seed"] % 4 != 2
        return row(
            made,
            legal,
            peak_error=0.01 * (1 + r["seed"]),
            bad_friction=int(not legal),
            bad_torque=int(r["seed"] == 2),
            bad_impulse=None if r["seed"] else 1,
            mean_friction=0.1 * r["seed"],
        )

    found = compare(
        lambda records: [walk(r) for r in records], ["NPD", "ADRC"], ["nothing", "delay"], 8, False
    )
    cell = found.cell("ADRC", "delay")
    assert (cell.controller, cell.condition) == ("ADRC", "delay")
    assert (cell.survived.value, cell.legal.value) == (0.75, 0.5)
    assert cell.legal == share(4, 8)
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
    assert texts["made, but not legal for [%]"] == "friction 33, torque 17"
    assert texts["legal [%]"].startswith("50 (")
    assert texts["made all steps [%]"].startswith("75 (")
    json.dumps(plain, allow_nan=False)


@pytest.mark.parametrize(
    ("rows", "made", "legal"),
    [
        ([row(False)] * 3, 0, 0),
        ([row(False) | {"legal": 1}] * 3, 0, 0),
        ([row(True, False, bad_friction=1)] * 3, 3, 0),
        ([row(False) | dict.fromkeys([*MEASURES, *NEEDS, "legal"])] * 3, 0, 0),
        ([row(True, **dict.fromkeys([*MEASURES, *NEEDS]))] * 3, 3, 3),
        ([row(True, peak_error=math.nan, mean_friction=math.inf)] * 3, 3, 3),
    ],
)
def test_cells_without_survivors_legal_walks_or_numbers(rows, made, legal):
    cell = Cell("NPD", "nothing", tuple(rows))
    assert (cell.survived.value, cell.legal.value) == (made / 3, legal / 3)
    plain = cell.row()
    json.dumps(plain, allow_nan=False)
    for texts in (comparison_text.share_texts(plain), comparison_text.median_texts(plain)):
        assert all(isinstance(x, str) and "nan" not in x for x in texts)


def test_the_trial_of_the_gait_itself_is_disturbed_by_nothing():
    for settings in SETTINGS.values():
        made = trial(nominal_trial(settings))
        assert made.gait == settings.values.get("gait", "published")
        assert replace(made, gait="published").record() == (
            Scenario(controller="NPD", hardware="ideal", torque_limit=150.0).record()
        )
    found = compare_study.nominal(
        row(True, False, bad_friction=1, bad_impulse=1, mean_friction=9.65, impulse_ratio=0.85)
    )
    text = comparison_text.nominal_text(found)
    assert "is not legal; beyond its limit already: friction, impulse at impact" in text
    assert "friction 9.65 of 0.6 (mean over 5 ms)" in text
    assert "friction 0.85 of 0.6 for the impulse at impact" in text
    legal = comparison_text.nominal_text(compare_study.nominal(row(True)))
    assert "is legal." in legal
    fell = row(False, **dict.fromkeys(NEEDS))
    assert "does not make all steps: fell" in comparison_text.nominal_text(
        compare_study.nominal(fell)
    )


def test_equal_bandwidth_is_that_of_table_i():
    """The ninth root of the product of the poles; m = 7 where the trial has to say it."""
    poles = [180.0 * 1.8**k for k in range(9)]
    assert pytest.approx(np.prod(poles) ** (1 / 9)) == BANDWIDTH
    for name in OWN:
        made = trial(AS_PUBLISHED.equal_record("delay", name, 2))
        assert (made.bandwidth, made.delay) == (BANDWIDTH, 2e-3)
        assert made.order == (7 if name.startswith("ADRC") else None)


@pytest.mark.parametrize("status", ["REFUSED", "RAISED", "CRASHED"])
def test_what_was_no_walk_is_no_fall(status):
    with pytest.raises(InputError, match=f"{status}: it says"):
        compare(
            lambda records: [row(False, status=status) for _ in records], ["NPD"], ["nothing"], 2
        )


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


def made_up(records):
    """In place of walks: ADRC tracks better and LESO too, and one seed in five is not legal."""
    error = {"NPD": 1.0, "LESO": 0.3, "ADRC": 0.1}
    found = []
    for r in records:
        seed, fell = r.get("seed", 0), r.get("amplitude", 0.0) > 70.0
        peak = error[r.get("controller", "ADRC")] * (1.0 + 0.01 * seed)
        legal = seed % 5 != 4
        found.append(row(not fell, legal, peak_error=peak, bad_friction=int(not legal)))
    return found


def test_a_comparison_is_written_and_gone_on_with(tmp_path, monkeypatch):
    asked = (("NPD", "LESO", "ADRC"), ("nothing", "sine on joints", "encoders"), 12, True)
    monkeypatch.setattr(compare_study, "run_trials", made_up)
    summary = published(tmp_path, "the command", *asked, Threads(2))
    page = (tmp_path / "comparison.html").read_text()
    for text in ("the command", "not tuned alike", "The gait itself", "At equal bandwidth", "1890"):
        assert text in page
    assert "nan" not in page.split("<main", 1)[1].split("data:image", 1)[0]
    assert "http://" not in page.replace("http://www.w3.org", "")
    assert "https://" not in page
    stored = json.loads((tmp_path / "summary.json").read_text())
    assert sum(1 for _ in tmp_path.glob("*.svg")) == 6
    told = []
    again = published(tmp_path, "the command", *asked, Threads(2), lambda p: told.append(p.fresh))
    assert max(told) == 0
    assert again == summary == stored
    assert [x["equal"]["controller"] for x in summary["equal_bandwidth"]] == ["LESO"] * 3 + [
        "ADRC"
    ] * 3
    assert {p["bandwidth"] for p in summary["pushes"]} == {None, BANDWIDTH}
    assert all(
        x["own"]["bandwidth"] == OWN[x["own"]["controller"]] for x in summary["equal_bandwidth"]
    )
    with pytest.raises(BipedError, match="other in conditions"):
        published(tmp_path, "the command", ("NPD",), ("nothing",), 2, False, Threads(1))
    assert (tmp_path / RESULTS).exists()


def test_walks_of_rabbit_are_judged_by_the_ground(tmp_path):
    """With encoders RABBIT makes all steps, and the ground would have to hold more than its friction."""
    asked = (("NPD",), ("nothing", "encoders"), 2, False, Threads(2))
    summary = published(tmp_path, "the command", *asked)
    assert summary["walks"] == 5
    assert summary["nominal"]["legal"]
    assert summary["nominal"]["limits"]["friction"] == 0.6
    assert 0.4 < summary["nominal"]["needs"]["mean_friction"] < 0.6
    nothing, encoders = summary["cells"]
    assert (nothing["survived"][0], nothing["legal"][0]) == (1.0, 1.0)
    assert (encoders["survived"][0], encoders["legal"][0]) == (1.0, 0.0)
    assert encoders["reasons"]["bad_friction"][0] == 1.0
    assert encoders["peak_error"] is None
    rows = [run_trial(AS_PUBLISHED.record("nothing", "NPD", seed)) for seed in range(2)]
    assert nothing["peak_error"][0] == np.median([r["peak_error"] for r in rows])
