"""ADRC on RABBIT's hardware beside its tuned rivals: rules of choice, numbers, and the page of them."""

from __future__ import annotations

import importlib
import tomllib
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]
TUNED = ROOT / "benchmarks" / "tuned"


@pytest.fixture
def module(monkeypatch):
    for folder in (ROOT / "docs", TUNED):
        monkeypatch.syspath_prepend(str(folder))
    return importlib.import_module


def tables(name):
    return tomllib.loads((TUNED / name).read_text(encoding="utf-8"))


def walk(error, legal=1, friction=0.5, cost=0.6):
    """The row of a walk that made all steps."""
    return {
        "survived": 1,
        "legal": legal,
        "rms_error": error,
        "rms_torque": 40.0,
        "mean_friction": friction,
        "cost_of_transport": cost,
    }


def test_the_page_is_that_of_its_summary(module):
    w = module("write_robot_goal")
    s = w.read(w.FOLDER / "summary.json")
    assert w.PAGE.read_text(encoding="utf-8") == w.page(s, w.goal())


def test_no_walk_of_the_test_was_seen_by_a_search_or_a_choice():
    sets = {}
    for name in ("contest.toml", "reserve.toml", "goal.toml"):
        found = tables(name)
        for kind in {"training", "selection", "test", "outside", "push"} & found.keys():
            given = found[kind]["seeds"]
            sets[name, kind] = set(range(given["from"], given["from"] + given["count"]))
    for (a, x), (b, y) in combinations(sets.items(), 2):
        assert not x & y, (a, b)


def test_the_searches_with_a_reserve_have_walks_gains_place_and_some_leaves_of_the_contest(module):
    contest, reserve = tables("contest.toml"), tables("reserve.toml")
    assert reserve["walk"] == contest["walk"]
    assert reserve["gains"] == contest["gains"]
    for name in ("values", "margin"):
        assert reserve["places"]["RABBIT, 1 ms"][name] == contest["places"]["RABBIT, 1 ms"][name]
    for name, leaf in reserve["leaves"].items():
        assert leaf["variables"] == contest["leaves"][name]["variables"]
    assert [name for name, _ in module("reserve").contests()] == [
        f"friction_{x:g}" for x in reserve["limits"]["friction"]
    ]


def test_roles_are_taken_by_their_rules(module):
    def row(contestant, error, legal, friction):
        return {
            "contestant": contestant,
            "error": error,
            "legal": (legal, 0, 1),
            "friction": friction,
        }

    rows = [
        row("NPD", 2.0, 0.95, 0.58),
        row("NPD", 1.0, 0.5, 0.7),  # not legal
        row("NPID", 3.0, 1.0, 0.5),
        row("m = 1", 0.5, 0.95, 0.6),
        row("m = 1", 0.8, 1.0, 0.45),
        row("m = 2", 0.85, 0.975, 0.4),  # not all legal
        row("m = 2", 1.9, 1.0, 0.3),  # not close
        row("m = 1", 0.7, 1.0, 0.5),
    ]
    found = module("goal").roles(tables("goal.toml"), rows)
    places = {role: next(i for i, r in enumerate(rows) if r is one) for role, one in found.items()}
    assert places == {"NPD": 0, "NPID": 2, "rival": 0, "closest": 3, "goal": 4}


def test_a_walk_that_is_not_legal_counts_against_the_adrc_alone(module):
    numbers = module("goal_numbers")
    rival = [walk(2.0, legal=0)] * 5
    assert numbers.beside([walk(1.0)] * 5, rival, [rival])["ratio"] == (0.5, 0.5, 0.5)
    mine = [walk(1.0)] * 2 + [walk(1.0, legal=0)] * 3
    assert numbers.beside(mine, rival, [rival])["ratio"].value == np.inf
    other = [walk(1.0)] * 5
    beside = numbers.beside([walk(0.5, friction=0.4)] * 5, rival, [rival, other])
    assert beside["ratio_each"].value == 0.5
    assert beside["friction_ratio"].value == pytest.approx(0.8)


def test_the_friction_needed_is_that_of_292_walks_of_300(module):
    numbers = module("goal_numbers")
    rows = [walk(1.0, friction=0.001 * i) for i in range(1, 301)]
    assert numbers.of_walks(rows)["friction"] == pytest.approx(0.292)
    fell = {**walk(1.0), "survived": 0}
    assert numbers.of_walks([*rows[:291], *[fell] * 9])["friction"] == np.inf


def test_a_ratio_of_pushes_is_that_which_is_certain(module):
    of = module("goal_numbers").pushes_beside
    assert of([(100.0, 102.0)] * 3, [(78.0, 80.0)] * 3)["ratio"].value == 1.25
    assert of([(100.0, np.inf)] * 3, [(320.0, np.inf)] * 3)["ratio"].value == 1.0


@pytest.mark.parametrize("demand", [0, 1, 3, 4, 7])
def test_one_demand_that_is_missed_misses_the_goal(module, demand):
    v = module("robot_goal_verdicts")
    met = [v.Verdict("", "", "", True)] * 8
    for i in (2, 5, 6):  # the aim, and one of friction and push
        assert v.reached([*met[:i], met[i]._replace(met=False), *met[i + 1 :]])
    assert not v.reached([*met[:5], *[met[0]._replace(met=False)] * 2, met[7]])
    assert not v.reached([*met[:demand], met[0]._replace(met=False), *met[demand + 1 :]])
