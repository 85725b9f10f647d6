"""The page of findings: its numbers are those of its rows, its test was fixed before it was walked, each of its
studies walks, and its statistics keep laws that need no simulation.
"""

import csv
import importlib
import json
import math
import re
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.studies.search import Candidate
from biped_adrc.studies.study import read_study
from validation.findings import comparison, numbers, page, searches, statistics, steps
from validation.findings.__main__ import COMPARED, DECLARED, DIGITS, SOFT, STUDIES, counts
from validation.findings.statistics import Side

NAMES = (*COMPARED, SOFT, *DECLARED)


def sides(ratio, searches=5, walks=20, seed=0):
    """Two sides whose errors differ by a factor but for noise, with equal objectives of choice."""
    random = np.random.default_rng(seed)
    choice = random.uniform(1.0, 2.0, (2, searches))
    errors = np.exp(random.normal(0.0, 0.2, (2, searches, walks)))
    return Side(choice[0], ratio * errors[0]), Side(choice[1], errors[1])


def test_the_pages_are_those_of_their_rows():
    for path, text in page.texts().items():
        assert path.read_text() == text


def test_the_page_is_short_and_its_rows_are_small():
    assert len(page.PAGES[0].read_text().split()) <= 2000
    for path in numbers.ROWS.glob("*.csv"):
        assert path.stat().st_size <= 150_000, path.name


def test_the_rows_are_those_of_the_questions_that_stand_last_in_the_list_of_versions():
    """The text's hash is in every row of its walks, and their seeds begin at the number that it gives."""
    with (statistics.HERE / "versions.csv").open() as file:
        versions = list(csv.DictReader(file))
    assert versions[-1]["hash"] == statistics.text_hash()
    assert all(len(v["answers"].split(", ")) == 6 for v in versions[:-1])
    for name in (*COMPARED, SOFT):
        assert {r["question"] for r in numbers.rows(name)} == {statistics.text_hash()}
        assert read_study(STUDIES / f"{name}.toml").seeds[0] == statistics.first_seed()


def test_a_question_that_was_changed_after_its_walks_says_so(monkeypatch):
    monkeypatch.setattr(statistics, "text_hash", lambda: "another")
    assert "changed after its walks" in numbers.warning(("exact", "v0.6", "tracking", "NPD"))


def test_each_study_of_the_comparison_is_that_of_its_settings():
    rows = comparison.settings()
    for name, at in COMPARED.items():
        expected = comparison.toml(comparison.tables_of(*at, rows), comparison.comment(name))
        assert (STUDIES / f"{name}.toml").read_text() == expected
    for name, tables in ((SOFT, comparison.soft_tables), (DIGITS, comparison.digit_tables)):
        expected = comparison.toml(tables(rows), comparison.comment(name))
        assert (STUDIES / f"{name}.toml").read_text() == expected


@pytest.mark.parametrize("name", NAMES)
def test_each_study_walks(name, tmp_path):
    """In a form of seconds: the first and the last case under one condition, one seed, four impacts."""
    study = read_study(STUDIES / f"{name}.toml")
    cases = [*study.cases.items()]
    short = {
        "base": {**study.base, "run.impacts": 4},
        "cases": dict([cases[0], cases[-1]]),
        "conditions": dict([*study.conditions.items()][:1]),
        "grid": {k: x[:1] for k, x in study.grid.items()},
        "seeds": study.seeds[:1],
    }
    with ThreadPoolExecutor(1) as executor:
        found = ba.study(study.model_copy(update=short), tmp_path, executor)
    rows = list(counts(found))
    assert [r["walks"] for r in rows] == [1, 1]
    assert all(r["status"] not in ("REFUSED", "RAISED") for r in found.rows())


def test_equal_sides_do_not_differ():
    one, _ = sides(1.0)
    found = statistics.compare(one, one, "error", 2000)
    assert (found.value, found.p) == (1.0, pytest.approx(1.0, abs=0.2))
    assert found.low <= 1.0 <= found.high


def test_a_ratio_is_found_and_its_interval_holds_it_as_often_as_it_says():
    """Of 200 samples with a true ratio of 0.8 about 95 % of the intervals of 95 % hold it."""
    holds = 0
    for seed in range(200):
        one, other = sides(0.8, seed=seed)
        found = statistics.compare(one, other, "error", 400, seed)
        holds += found.low <= 0.8 <= found.high
    assert 0.9 <= holds / 200 <= 1.0


def test_two_infeasible_walks_tie_and_one_decides():
    infinite, one = np.full((1, 20), np.inf), np.ones((1, 20))
    choice = np.ones(1)
    tie = statistics.compare(Side(choice, infinite), Side(choice, infinite), "error", 500)
    assert (tie.value, tie.p) == (1.0, 1.0)
    lost = statistics.compare(Side(choice, infinite), Side(choice, one), "error", 500)
    assert lost.value == math.inf
    assert lost.p < 0.01
    share = statistics.compare(Side(choice, one), Side(choice, infinite), "share", 500)
    assert (share.value, share.low, share.high) == (1.0, 1.0, 1.0)


def test_the_interval_draws_searches():
    """Walks that agree to the last digit leave no width; searches that differ do."""
    walks = np.ones((5, 20))
    spread = walks * np.array([[1.0], [1.2], [1.4], [1.6], [2.0]])
    choice = np.array([1.0, 1.2, 1.4, 1.6, 2.0])
    found = statistics.compare(Side(choice, spread), Side(np.ones(5), walks), "error", 4000)
    assert found.value == found.low == 1.0
    assert found.high > 1.1


def test_holm():
    """p 0.01, 0.02, 0.03 of four with 0.5: times 4, 3, 2, and never less than the one before."""
    assert statistics.holm([0.03, 0.5, 0.01, 0.02]) == pytest.approx([0.06, 0.5, 0.04, 0.06])


def test_the_numbers_of_the_readme_are_those_of_the_page():
    """Its first question with the upper end of the interval, and how many walks are feasible."""
    words = " ".join((comparison.ROOT / "README.md").read_text().split())
    answer = numbers.answers()[0][1]
    assert f"leaves **{answer.value:.2g} (95 %: at most {answer.high:.2g})** of NPD's" in words
    walked = {
        condition: [
            numbers.fine(("rabbit", "v0.6", "tracking", c), condition) for c in ("m = 1", "NPD")
        ]
        for condition in (numbers.PUSH, numbers.HIP, numbers.LIGHT)
    }
    (a, b), (c, d), (e, f) = walked.values()
    assert (
        f"Of 20 walks ADRC makes {a} feasibly, NPD {b}. With 2 N held on the hip they make {c} and {d}."
        in words
    )
    assert f"On a robot 30 % lighter ADRC makes {e} of 20 walks, NPD {f}." in words


def test_the_grounds_of_the_headline_are_walked_as_the_readme_says(monkeypatch):
    """Of 20 grounds of 30 mm v0.6 falls on some and walks none feasibly; the other gait falls on none."""
    monkeypatch.syspath_prepend(str(comparison.ROOT / "docs"))
    pictures = importlib.import_module("make_pictures")
    left, right = (pictures.outcomes(gait) for gait in ("v0.6", "rough"))
    words = " ".join((comparison.ROOT / "README.md").read_text().split())
    fallen, walked = ([x[k] for x in (left, right)] for k in ("fell", "feasible"))
    assert (
        f"On {left.total()} such grounds: - the left gait falls on {fallen[0]}, and walks {walked[0]} "
        f"feasibly; - the right gait, designed for rough ground, falls on {fallen[1]}, and walks "
        f"{walked[1]} feasibly."
    ) in words


def test_each_number_of_a_question_stands_on_the_page():
    text = page.PAGES[0].read_text()
    for _, answer, _ in numbers.answers():
        assert re.sub(r"\s+", " ", numbers.in_words(answer)) in re.sub(r"\s+", " ", text)


class Formula(steps.Searches):
    """Settings that are judged by a formula in place of walks: the error is 1 / K_p, and more than 20 of K_p
    for each unit of K_d misses the limit.
    """

    def judge(self, number, asked):
        result = {}
        for name, x in asked.items():
            k_p, k_d = x["controller.K_p"], x["controller.K_d"]
            missed = (max(0.0, k_p / k_d - 20.0), 0.0)
            result[name] = Candidate(number, x, x, 1.0 / k_p, missed, True)
        return result


def test_a_setting_is_moved_until_it_keeps_the_limits_and_no_step_gains():
    tables = searches.study_of("exact", "v0.6", "tracking")
    place = Formula(read_study(tables), None, None)
    gains = {"1": (2100.0, 100.0), "2": (1000.0, 201.0), "3": (900.0, 120.0), "4": (1e5, 50.0)}
    stops = {"2": "not tuned: better with K_p up by 3%", "3": "stopped by the objective: K_p up"}
    rows = [
        {
            "controller": "PD",
            "search": i,
            "on choice": "",
            "values": json.dumps({"controller.K_p": k_p, "controller.K_d": k_d}),
            "stop": stops.get(i, ""),
            "why": "",
        }
        for i, (k_p, k_d) in gains.items()
    ]
    steps.move_all(place, rows)
    one, two, three, far = rows
    ends = [json.loads(r["values"]) for r in (one, two, three)]
    assert all(x["controller.K_p"] <= 20.0 * x["controller.K_d"] for x in ends)
    # a ratio of 21: one of 200 steps down from 1e6 to 1e3, then one up from 30 to 5000, which costs no error
    assert one["why"] == steps.WHY_LIMIT
    assert ends[0]["controller.K_p"] == pytest.approx(2100.0 * 1000.0**-0.005)
    assert ends[0]["controller.K_d"] == pytest.approx(100.0 * (5000.0 / 30.0) ** 0.005)
    # K_p of the second doubles twice, a step being a tenth of three decades; a third time misses the limit
    assert (two["why"], ends[1]["controller.K_p"]) == (steps.WHY_GAIN, pytest.approx(3981.0718))
    assert "the limit under 1 ms more: K_p up" in two["stop"]
    # the third could double, but was stopped by its search, and stays
    assert (three["why"], three["stop"], ends[2]["controller.K_p"]) == ("", stops["3"], 900.0)
    # ten small steps do not bring the last one back
    assert (far["values"], far["stop"]) == ("", steps.OUTSIDE)
