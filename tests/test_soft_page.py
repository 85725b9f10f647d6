"""The page of soft ground, from rows made by hand: who meets the goal, and what is said where nobody does."""

from __future__ import annotations

import importlib
import itertools
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
ERRORS = ("peak_error", "rms_error", "settled_error", "settled_rms")


@pytest.fixture
def script(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    return importlib.import_module


def study(case, push=0.2, touch=1.0, falls=(), slips=()):
    """Rows of NPD and of a case on 4 grounds with no push and two pushes.

    push, touch: the case's errors as multiples of NPD's. falls, slips: places (friction, T) where it does.
    """
    rows = []
    for name, (mu, T), condition in itertools.product(
        ("NPD", case),
        itertools.product((0.4, 1.0), (2e-3, 2e-2)),
        ("none", "paper", "random"),
    ):
        mine = name == case
        falling, alone = mine and (mu, T) in falls, condition == "none"
        given = {"case": name, "gait": "v0.5", "ground_friction": mu, "time_constant": T}
        given |= {"condition": condition, "status": "FELL" if falling else "COMPLETED"}
        given |= {"survived": int(not falling), "impacts": 6, **dict.fromkeys(ERRORS, 1e-2)}
        given["pushed_error"] = (1e-2 * push if mine else 1e-2) * (
            100.0 * T / 4.0 if alone else 1.0
        )
        given["touchdown_error"] = 5e-3 * touch if mine else 5e-3
        given["slip"] = 2e-2 if mine and (mu, T) in slips else 1e-3
        rows.append(given)
    return rows


def test_a_case_meets_the_goal_where_all_of_it_is_met(script):
    cells = script("soft_cells")
    for values, met in (
        ({}, True),
        ({"push": 0.26}, False),
        ({"touch": 1.11}, False),
        ({"falls": [(0.4, 2e-3)]}, False),
        ({"push": 0.25, "touch": 1.1}, True),
    ):
        found = cells.pairs(study("hold", **values), "hold")
        assert len(found) == 12
        assert len(cells.pushed(found)) == 8
        assert cells.meets(found) == met, values


def test_cells_in_which_npd_falls_do_not_count(script):
    cells = script("soft_cells")
    rows = study("hold")
    rows[0]["survived"] = 0
    assert len(cells.pairs(rows, "hold")) == 11
    assert cells.pairs(rows, "hold")[0].ratio("pushed_error") == pytest.approx(0.2)


def test_what_is_nearest_walks_wherever_npd_walks(script):
    cells = script("soft_cells")
    fast = [row for row in study("fast", push=0.1, falls=[(0.4, 2e-2)]) if row["case"] == "fast"]
    assert cells.nearest(study("slow", push=0.3) + fast) == "slow"
    assert cells.nearest(study("fast", push=0.1, falls=[(0.4, 2e-2)])) == "fast"


def test_floors_are_of_the_walk_without_a_push(script):
    cells = script("soft_cells")
    rows = study("hold")
    found = cells.floors(rows, cells.pairs(rows, "hold"))
    assert len(found) == 4
    for pair, floor in found:
        assert floor == pytest.approx(25.0 * pair.case["time_constant"])


def test_the_page_says_by_how_much_it_fails(script):
    page, rows = script("soft_page"), study("hold", 0.3, 1.2, [(0.4, 2e-3)], [(0.4, 2e-2)])
    verdict = page.verdicts(rows, "hold")[0]
    assert "No case meets the goal" in verdict
    assert "in 0 of 8 cells (0 %, where 95 % were asked)" in verdict
    assert "in 0 of 12 (largest 1.20)" in verdict
    missed, dry, floor = page.obstacles(rows, "hold")
    assert "in 8 of 8 cells. In 4 of these a foot slips" in missed
    assert "Of the 4 cells in which neither slips" in dry
    assert "below 20 ms in 0 of 2" in dry
    assert "Of the 4 cells missed under the paper's push, NPD has in 2" in floor
    assert "**The goal is met by hold.**" in page.verdicts(study("hold"), "hold")[0]
    assert page.goal_texts(rows, "hold")[1:3] == ["9 of 12", "0 of 8"]


def test_the_whole_page_is_written_from_a_summary(script):
    page, rows = script("soft_page"), study("hold", falls=[(0.4, 2e-3)])
    half = {"survived": 1, "pushed_error": 1.02e-2, "touchdown_error": 4.9e-3}
    halved = [{**row, "half": half} for row in rows if row["case"] == "NPD"][1:3]
    summary = {"command": "sweep", "columns": list(rows[0]), "halved": halved, "caused": []}
    fresh = {name: summary[name] for name in ("command", "columns")}
    walked = [{"rows": [list(row.values()) for row in those]} for those in (rows, study("hold"))]
    text = page.page(summary | walked[0], fresh | walked[1])
    assert "walks 24 others: friction 0.4, 1, no push, the paper's and 1 fresh draws" in " ".join(
        text.split()
    )
    assert "24 walks of RABBIT" in text
    assert (
        "NPD makes all steps in 12 of 12 cells, in 12 without slip. In 0 cells nobody walks."
        in text
    )
    assert "FELL 3" in text
    assert "push by 2 % in the median and 2 % at most" in text
    assert "no claim is made here against controllers that are tuned" in text


def test_what_the_step_of_the_engine_decides_is_said(script):
    page, rows = script("soft_page"), []
    for case, change in (("NPD", 1.0), ("hold", 1.1)):
        row = next(row for row in study("hold") if row["case"] == case)
        half = {name: row[name] for name in ("survived", "pushed_error", "touchdown_error")}
        half["touchdown_error"] *= change
        rows.append({**row, "half": half})
    npd, hold, undecided = page.at_half(rows)
    assert "push by 0 % in the median" in npd
    assert (
        "touchdown by 10 % in the median and 10 % at most; as a multiple of NPD's by 10 %" in hold
    )
    assert "between 0.99 and 1.21 times NPD's" in undecided


def test_what_the_push_alone_causes_is_counted(script):
    page = script("soft_page")
    (said,) = page.by_difference([{"case": 1.0, "npd": 8.0}, {"case": 3.0, "npd": 8.0}])
    assert "within a quarter of NPD's in 1 of 2 cells (50 %)" in said
    assert "the median is 0.25, the largest 0.375." in said
    assert page.by_difference([]) == []


def test_shares_on_cells_that_chose_nothing_are_beside_those_of_the_study(script):
    section = script("soft_held_out")
    rows, fresh = study("hold"), study("hold", 0.3, 1.2, [(0.4, 2e-3)])
    _, told, table = section.held_out(rows, fresh, "sweep")
    assert "The goal is met there by no case." in told
    assert "without slip in 12 of 12 cells (12 of 12 cells in the study)" in " ".join(told.split())
    assert "is one of 2 pushes" in told
    assert "The goal is met there by hold." in section.held_out(fresh, rows, "sweep")[1]
    assert section.beside("hold", rows, fresh) == [
        *("hold", "8 of 8 (100 %)", "0 of 8 (0 %)", "4 of 4 (100 %)", "0 of 4 (0 %)"),
        *("12 of 12 (100 %; largest 1)", "0 of 12 (0 %; largest 1.2)"),
        *("12 of 12", "9 of 12"),
    ]
    assert table.splitlines()[0].count("held out") == 4
    assert "| NPD |" not in table
