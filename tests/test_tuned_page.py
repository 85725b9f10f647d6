"""The page of controllers tuned alike, from searches made by hand: what is carried, open and lost."""

from __future__ import annotations

import importlib
import itertools
import json
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from scipy import stats

from biped_adrc.analysis.statistics import share, sign_test
from biped_adrc.campaign.store import Result
from biped_adrc.errors import InputError
from biped_adrc.viz.figure_numbers import numbers_of

ROOT = Path(__file__).resolve().parents[1]
PLACE, GAIT, SEEDS = "RABBIT, 1 ms", "v0.5", 15
RNG = np.random.default_rng(5)
BASE = 1e-3 * (2.0 + RNG.uniform(-0.3, 0.3, (2, SEEDS)))
"""Errors of NPD [rad], two conditions."""


@pytest.fixture
def script(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    return importlib.import_module


def walks(factor=1.0, illegal=()):
    """The kept columns: errors `factor` times those of NPD; illegal: seeds of which no walk is legal."""
    legal = np.ones((2, SEEDS), dtype=int)
    legal[:, list(illegal)] = 0
    return [(factor * BASE).tolist(), (40.0 + 0.0 * BASE).tolist(), BASE.tolist(), legal.tolist()]


def search(contestant, factor=1.0, illegal=(), seed=1, place=PLACE, gait=GAIT, selected=None):
    """A search that found something, whose errors are `factor` (a number or (2, SEEDS)) times NPD's."""
    return {
        "place": place,
        "gait": gait,
        "contestant": contestant,
        "seed": seed,
        "why": "",
        "chosen": {"K_p": 500.0, "own.K_i": 2.5},
        "selected": float(np.mean(factor)) if selected is None else selected,
        "margins": [0.0025, "-inf"],
        "tuned": walks(factor, illegal),
        "published": walks(2.0, range(SEEDS)),
    }


def nothing(contestant, seed=1):
    """A search in which no candidate keeps the limits."""
    told = {"place": PLACE, "gait": GAIT, "contestant": contestant, "seed": seed}
    return {**told, "why": "study 'x: a, b': none of 75 candidates keeps. The nearest is number 3"}


def summary(*searches):
    """A summary of these searches, of a contest that asked for one more."""
    names = ["NPD", "NPID", "observer's rates", "assisted, m = 1", "m = 1", "m = 2", "m = 3", "DOB"]
    place = {
        "margin": 0.002,
        "seeds": {GAIT: [1, 2], "published": [1]},
        "leaves": ["filter", "policy"],
    }
    asked = [[x[k] for k in ("place", "gait", "contestant", "seed")] for x in searches]
    two = {"seeds": {"count": 10}, "amplitudes": [60.0, 80.0]}
    windows = {"from": 0.003, "to": 0.03, "when": {"contact": ["hold"]}}
    policies = {"contact": {"choices": ["none", "hold"]}, "contact_window": windows}
    leaves = {
        "filter": {"words": "the filter", "variables": {"filter_time": {"from": 0.1, "to": 1.0}}},
        "policy": {"words": "the policy", "variables": policies},
    }
    contest = {
        "search": {"per_variable": 25},
        "limits": {"legal": 0.9, "friction": 0.57},
        "walk": {"impacts": 7},
        "training": {"seeds": {"count": 6}, "amplitudes": [60.0]},
        "selection": two,
        "test": {"seeds": {"count": SEEDS}, "amplitudes": [60.0, 80.0]},
        "places": {
            PLACE: place,
            "ideal": {**place, "walk": {"impacts": 4}, "leaves": [], "contestants": names[:7]},
        },
        "leaves": leaves,
        "gains": {"K_p": {"from": 200.0, "to": 20000.0, "scale": "log"}},
        "contestants": {n: {"own": {"own.K_i": {"from": 2.4, "to": 9.0}}} for n in names},
    }
    missing = [PLACE, "published", "DOB", 1]
    told = {"contest": contest, "asked": [*asked, missing], "searches": list(searches)}
    return {**told, "beside": {}}


def answers(script, *searches):
    """What the contest answers about these searches, by contestant."""
    page, given = script("tuned_page"), script("tuned_entries").entries(summary(*searches))
    return {x.a.contestant: x for x in page.families(page.first_groups(given))["the reference"]}


def test_a_difference_is_carried_where_all_seeds_agree(script):
    mixed = np.ones((2, SEEDS)) * np.where(np.arange(SEEDS) % 2, 1.1, 0.9)
    found = answers(
        script,
        search("NPD"),
        search("NPID", 1.2),
        search("m = 1", 0.5),
        search("m = 2", 3.0),
        search("DOB", mixed, selected=0.95),
    )
    assert {n: x.verdict for n, x in found.items()} == {
        "NPID": "larger",
        "m = 1": "smaller",
        "m = 2": "larger",
        "DOB": "open",
    }
    assert found["m = 1"].ratio == pytest.approx([0.5, 0.5, 0.5])
    assert found["m = 1"].p == pytest.approx(4 * 2.0 * 0.5**SEEDS)  # of four questions
    assert found["DOB"].within == pytest.approx(1.0 / 0.9)


def test_the_reference_is_the_better_one_on_the_selection_set(script):
    found = answers(
        script, search("NPD", selected=2.0), search("NPID", 1.2, selected=1.0), search("DOB")
    )
    assert {x.b.contestant for x in found.values()} == {"NPID"}
    found = answers(script, nothing("NPD"), search("NPID", 1.2), search("DOB"))
    assert {x.b.contestant for x in found.values()} == {"NPID"}
    assert not answers(script, search("NPD"), search("DOB"))


def test_one_of_which_some_searches_found_a_setting_goes_before_one_of_which_none_did(script):
    seeds = (1, 2, 3)
    given = [nothing("NPD", seed=s) for s in seeds]
    given += [nothing("NPID", seed=1), *(search("NPID", 1.2, seed=s) for s in (2, 3))]
    given += [search("DOB", 0.5, seed=s) for s in seeds]
    page, found = script("tuned_page"), script("tuned_entries").entries(summary(*given))
    (g,) = script("tuned_entries").groups_of(found)
    assert script("tuned_entries").reference(g).contestant == "NPID"
    assert {n: e.failed for n, e in g.items()} == {"NPD": 3, "NPID": 1, "DOB": 0}
    assert "Neither NPD nor NPID" not in page.page(summary(*given))


def test_illegal_walks_rank_worst_and_are_not_dropped(script):
    found = answers(
        script,
        search("NPD"),
        search("NPID", 2.0),
        search("m = 1", 0.5, illegal=range(8)),
        search("m = 2", 0.5, illegal=range(2)),
        nothing("m = 3"),
    )
    worst = script("tuned_questions").WORST
    assert found["m = 1"].ratio.value == pytest.approx(worst)
    assert (found["m = 1"].won, found["m = 1"].lost) == (7, 8)
    assert found["m = 1"].verdict == "open"
    assert found["m = 2"].ratio.value == pytest.approx(0.5)
    assert (found["m = 2"].won, found["m = 2"].lost) == (13, 2)
    assert found["m = 3"].verdict == "larger"
    assert found["m = 3"].legal_p < 0.05 < found["m = 2"].legal_p
    assert found["m = 2"].legal_bound == pytest.approx(share(2, SEEDS).high)


def test_a_seed_is_legal_where_all_its_walks_are(script):
    half = search("m = 1", 0.5)
    half["tuned"][-1][1] = [0] * SEEDS
    found = answers(script, search("NPD"), search("NPID", 1.2), half)["m = 1"]
    assert found.legal_p < 0.05
    assert found.ratio.value > 100.0
    assert (found.won, found.lost) == (0, SEEDS)


def test_what_the_corrected_test_does_not_carry_is_open_though_the_interval_would(script):
    most = np.ones((2, SEEDS)) * np.where(np.arange(SEEDS) < 12, 0.8, 1.25)
    names = ("m = 1", "m = 2")
    given = [search(n, most) for n in names]
    found = answers(script, search("NPD", selected=0.1), search("NPID", 1.2), *given)
    for x in (found[n] for n in names):
        assert x.ratio.high < 1.0
        assert x.p == pytest.approx(2 * sign_test(12, 3))
        assert x.verdict == "open"


def test_two_walks_that_are_both_not_legal_are_a_tie(script):
    logs = script("tuned_questions").log_ratios
    a, b = np.array([[1.0, math.inf, math.inf, 1.0]]), np.array([[2.0, math.inf, 1.0, math.inf]])
    top = math.log(script("tuned_questions").WORST)
    assert logs(a, b) == pytest.approx(np.array([[-math.log(2.0), 0.0, top, -top]]))


def test_a_placebo_is_not_found_different(script):
    found = answers(script, search("NPD"), search("NPID", selected=1.1))
    assert found["NPID"].verdict == "open"
    assert (found["NPID"].within, found["NPID"].p, found["NPID"].legal_p) == (1.0, 1.0, 1.0)


def test_the_page_says_who_wins_by_how_much_and_how_near_the_goal_is(script):
    given = summary(
        search("NPD"),
        search("NPID", 1.2),
        search("m = 1", 0.45),
        search("m = 2", 0.9, illegal=[3]),
        nothing("m = 3"),
    )
    text = " ".join(script("tuned_page").page(given).split())
    assert "5 of 6 searches are there" in text
    assert "gait published, seed 1 of the optimiser: DOB" in text
    assert "the best on the selection set is *m = 1*" in text
    assert "its ratio to the next, *m = 2*, is 0.5 (0.5 to 0.5) (carried)" in text
    assert "Best on the selection set, over 1 place and gait: *m = 1* 1." in text
    assert "Against *NPD*, the reference, carried are a smaller error of *m = 1* 0.45" in text
    assert "*m = 3* (no setting that keeps the limits)" in text
    low = f"{100 * share(SEEDS, SEEDS).low:.1f}"
    assert "of optimiser seed 1 has 0.45 (0.45 to 0.45), over all its searches 0.45" in text
    assert f"first is met. Of its walks 30 of 30 are legal, which is at least {low} %" in text
    assert "the second is not shown by so few walks" in text
    assert "An order above 1 pays in 0 of 2 questions. It costs in 2, and 0 are open." in text
    assert "m = 3*, seed 1 of the optimiser: none of 75 candidates keeps." in text
    assert "| m = 2 | K\\_p = 500, K\\_i = 2.5 | 2.5 |" in text
    assert "| 28 of 30 |" in text
    assert "| not stable | 0 of 30 |" in text
    assert "At ideal, where a walk takes long, are **left out** DOB." in text
    assert "is at RABBIT, 1 ms: K_i of *NPD* (v0.5, seed 1); K_i of *NPID*" in text


def test_a_search_in_which_no_candidate_was_walked_says_nothing_beyond_its_ranges(script):
    told = {
        **nothing("m = 3"),
        "why": "study 'x: y': none of 9 keeps all limits that need no walk; a",
    }
    gaps, (entry,) = script("tuned_gaps"), script("tuned_entries").entries(summary(told))
    assert gaps.reason(entry).startswith(
        "none of 9 keeps all limits that need no walk; a. So none was"
    )
    assert "outside them" in gaps.reason(entry)
    (entry,) = script("tuned_entries").entries(summary(nothing("m = 3")))
    assert gaps.reason(entry) == "none of 75 candidates keeps"


def test_a_goal_that_is_missed_is_missed_by_so_much(script):
    given = (search("NPD"), search("NPID", 1.2), search("m = 1", 0.8, illegal=[0]))
    first, longer = answers(script, *given), search("m = 1", 0.9, illegal=[0])
    every = answers(script, *given[:2], longer)
    (said,) = script("tuned_sentences").goal(list(first.values()), list(every.values()))
    assert (
        "of optimiser seed 1 has 0.8 (0.8 to 0.8), over all its searches 0.9 (0.9 to 0.9)" in said
    )
    assert f"which is at least {100 * share(SEEDS - 1, SEEDS).low:.1f} %" in said
    assert "the first is missed by 0.3" in said
    assert "28 of 30 are legal" in said
    assert "the second is missed by 4.0 %" in said


def test_what_each_rung_is_worth_is_held_against_the_one_below(script):
    page = script("tuned_page")
    given = summary(
        search("NPD"),
        search("observer's rates", 0.8),
        search("assisted, m = 1", 0.4),
        nothing("m = 1"),
    )
    groups = page.first_groups(script("tuned_entries").entries(given))
    said = script("tuned_sentences").rung_worths(page.families(groups)["the rung below"])
    assert said == [
        "*NPD* to *observer's rates* (the rates of an observer, with the nominal xi): ratio 0.8; smaller at "
        "RABBIT, 1 ms, gait v0.5.",
        "*observer's rates* to *assisted, m = 1* (what is left of xi, estimated with m = 1): ratio 0.5; "
        "smaller at RABBIT, 1 ms, gait v0.5.",
        "*assisted, m = 1* to *m = 1* (all of xi estimated, none from the model): ratio ∞; larger at "
        "RABBIT, 1 ms, gait v0.5.",
    ]


def test_conclusions_that_a_seed_of_the_optimiser_decides_are_open_and_named(script):
    module, entries = script("tuned_steady"), script("tuned_entries").entries

    def told(*factors):
        same = {"NPD": (1.0, 1.0, 1.0), "NPID": (1.2, 1.2, 1.2), "DOB": factors}
        given = [search(n, f, seed=s) for n, some in same.items() for s, f in enumerate(some, 1)]
        found = entries(summary(*given))
        asked = module.families(script("tuned_entries").groups_of(found), found)
        verdicts = {x.a.contestant: x.verdict for x in asked["the reference"]}
        return verdicts["DOB"], module.other_seeds(found, asked)

    verdict, (errors, steady, *_) = told(0.5, 0.5, 0.5)
    assert verdict == "smaller"
    assert "; DOB 1, 1, 1." in errors
    assert "of 2 conclusions 2 are carried, each of them without any one seed too. By the" in steady
    assert steady.endswith("the opposite: none.")
    verdict, (_, turned, *_) = told(0.5, 1.9, 1.9)
    where = "at RABBIT, 1 ms, gait v0.5"
    assert verdict == "open"
    assert (
        f"1 more would be by all seeds together, and one seed decides: DOB {where} (larger"
        in turned
    )
    verdict, (_, turned, *_) = told(1.2, 1.3, 0.9)
    assert verdict == "larger"
    assert turned.endswith(f"the opposite: DOB {where} (seed 3: 0.9 (0.9 to 0.9)).")


def test_a_difference_within_the_spread_of_searches_is_open(script):
    """Welch's test of two contestants with three searches each is SciPy's; Holm over two questions."""
    seeds, entries = script("tuned_seeds"), script("tuned_entries").entries
    questions = script("tuned_questions")
    factors = {"NPD": (1.0, 1.2, 1.44), "m = 1": (0.8, 0.896, 1.00352), "m = 2": (0.2, 0.25, 0.3)}
    given = [search(n, f, seed=i) for n, some in factors.items() for i, f in enumerate(some, 1)]
    found = entries(summary(*given))
    own = seeds.spreads_of(seeds.repeated(found))
    assert own["NPD", found[0].kind].factor == pytest.approx(
        math.exp(4.302653 * math.log(1.2) * math.sqrt(2.0))
    )
    (g,) = script("tuned_entries").groups_of(found)
    scatter = seeds.scatter_of(seeds.repeated(found))
    pairs = [(g[n], g["NPD"]) for n in ("m = 1", "m = 2")]
    near, far = questions.answered(pairs, scatter)
    p = [
        stats.ttest_ind(*(np.log(factors[n]) for n in (m, "NPD")), equal_var=False).pvalue
        for m in ("m = 1", "m = 2")
    ]
    assert near.searched.p(np.log(0.896 / 1.2)) == pytest.approx(p[0])
    assert (near.verdict, far.verdict) == ("open", "smaller")
    assert near.p > 0.05 > far.p > 0.0
    assert near.within == pytest.approx(near.searched.factor / near.ratio.low)
    assert questions.answered(pairs)[0].verdict == "smaller"


def test_in_which_order_searches_are_numbered_changes_no_answer(script):
    """Errors of searches that are not in the middle of each other: Welch's test is that of their means."""
    seeds, module = script("tuned_seeds"), script("tuned_entries")
    npd, other = (1.0, 1.1, 1.9), (0.9, 0.5, 0.6)

    def answer(*factors):
        given = [search("m = 1", f, seed=i) for i, f in enumerate(factors, 1)]
        given += [search("NPD", f, seed=i) for i, f in enumerate(npd, 1)]
        found = module.entries(summary(*given))
        (g,) = module.groups_of(found)
        scatter = seeds.scatter_of(seeds.repeated(found))
        return script("tuned_questions").answered([(g["m = 1"], g["NPD"])], scatter)[0]

    x = answer(*other)
    welch = stats.ttest_ind(np.log(other), np.log(npd), equal_var=False).pvalue
    assert x.p == pytest.approx(welch)
    assert x.ratio.value == pytest.approx(np.median(np.divide.outer(other, npd)))
    turned = answer(*other[::-1])
    assert turned.ratio == pytest.approx(x.ratio)
    assert (turned.p, turned.won, turned.lost) == (pytest.approx(x.p), x.won, x.lost)


def test_legality_is_not_asked_where_a_search_of_several_found_nothing(script):
    given = [search(n, seed=s) for n in ("NPD", "NPID", "m = 1") for s in (1, 2)]
    given += [search("DOB"), nothing("DOB", seed=2), nothing("m = 2"), nothing("m = 2", seed=2)]
    module = script("tuned_entries")
    groups = module.groups_of(module.entries(summary(*given)))
    asked = script("tuned_page").families(groups)["the reference"]
    assert {x.a.contestant: x.legal_p for x in asked}["DOB"] == 1.0
    same, left_out = script("tuned_sentences").who_is_legal(asked)
    assert "of 2 settings that keep the limits, 2 have no carried difference" in same
    assert left_out.startswith("Not asked")
    assert left_out.endswith("beside *NPD* *DOB* (1 of 2).")


def test_that_one_search_finds_nothing_carries_no_difference_and_that_all_do_does(script):
    seeds, module = script("tuned_seeds"), script("tuned_entries")
    questions = script("tuned_questions")
    base = [search("NPD", f, seed=i) for i, f in ((1, 1.0), (2, 1.01), (3, 0.99))]

    def verdict(*given):
        found = module.entries(summary(*base, *given))
        (g,) = module.groups_of(found)
        return questions.answered(
            [(g["m = 2"], g["NPD"])], seeds.scatter_of(seeds.repeated(found))
        )[0]

    every = [nothing("m = 2", seed=i) for i in (1, 2, 3)]
    assert verdict(*every).verdict == "larger"
    some = verdict(*every[:2], search("m = 2", 0.8, seed=3))
    assert (some.verdict, some.within) == ("open", math.inf)
    assert verdict(*every[:2], search("m = 2", 4.0, seed=3)).verdict == "larger"
    found = module.entries(summary(*base, every[0]))
    single = [e for e in found if e.seed == 1]
    pair = (single[1], single[0]) if single[0].contestant == "NPD" else tuple(single)
    assert questions.answered([pair], seeds.scatter_of(seeds.repeated(found)))[0].verdict == "open"


def test_searches_with_several_seeds_of_the_optimiser_count_with_all_their_walks(script):
    """Two searches of two contestants: the middle of both ratios."""
    module, questions = script("tuned_entries"), script("tuned_questions")
    given = summary(
        *(search("NPD", seed=s) for s in (1, 2)),
        *(search("m = 1", f, seed=s) for s, f in ((1, 0.4), (2, 0.9))),
        search("m = 3", 0.5),
        nothing("m = 3", seed=2),
    )
    (g,) = module.groups_of(module.entries(given))
    assert {n: e.searches for n, e in g.items()} == {"NPD": 2, "m = 1": 2, "m = 3": 2}
    assert g["m = 1"].tuned.rms_error.shape == (4, SEEDS)
    assert g["m = 1"].selected == pytest.approx(0.6)
    assert (g["m = 3"].selected, g["m = 3"].found) == (math.inf, True)
    assert g["m = 3"].tuned.legal.mean() == 0.5
    (x,) = questions.answered([(g["m = 1"], g["NPD"])])
    assert x.ratio.value == pytest.approx(0.6)
    assert x.won == SEEDS
    given["searches"].append(search("m = 1", 0.1, seed=3))
    (g,) = module.groups_of(module.entries(given))
    assert g["m = 1"].searches == 2, "a seed counts where all contestants have it"


def test_a_placebo_is_judged_by_searches_of_the_same_contestant_elsewhere(script):
    seeds, entries = script("tuned_seeds"), script("tuned_entries").entries

    def at_two(contestant, here, there):
        return [
            search(contestant, f, seed=s, gait=gait)
            for gait, some in (("v0.5", here), ("published", there))
            for s, f in enumerate(some, 1)
        ]

    steady = at_two("NPD", (1.0, 1.2, 1.4), (1.0, 1.2, 1.4))
    sudden = at_two("DOB", (1.0, 1.3, 1.7), (1.0, 1.01, 1.02))
    alone, both, single = seeds.placebos(entries(summary(*steady, *sudden)))
    assert len(alone) == sum(x.verdict != "open" for x in alone) == 12
    assert {(x.a.contestant, x.a.gait) for x in both if x.verdict != "open"} == {("DOB", "v0.5")}
    lost = [search("m = 2", 0.5), nothing("m = 2", seed=2)]
    said = seeds.placebo_sentences(entries(summary(*steady, *sudden, *lost)))
    assert "*m = 2* at 1" in said[0]
    assert "13 pairs" in said[1]
    assert "*DOB* at RABBIT, 1 ms, gait v0.5, seeds 1 and 3" in said[1]
    chance = sum(x.verdict != "open" for x in single)
    assert chance == sum(x.p < 0.05 for x in single) >= 3
    assert f"without it {chance} of the 12 pairs" in said[1]
    assert "where 5 % of them would be by chance; the other 1 cannot be." in said[1]


def with_beside(told, **beside):
    """A summary with what beside.py walked, each told by contestant."""
    key = {"place": PLACE, "gait": GAIT, "seed": 1}
    return told | {"beside": {kind: [key | x for x in some] for kind, some in beside.items()}}


def test_a_leaf_is_worth_what_is_lost_without_it(script):
    beside, module = script("tuned_leaves"), script("tuned_entries")
    given = with_beside(
        summary(search("NPD", 0.5), search("m = 1", 0.4)),
        without=[
            {"contestant": "NPD", "leaf": "filter", "walks": walks(1.0)},
            {"contestant": "m = 1", "leaf": "filter", "walks": walks(0.2)},
            {"contestant": "NPD", "leaf": "policy", "walks": walks(0.5)},
            {"contestant": "m = 1", "leaf": "policy", "walks": walks(0.4, range(SEEDS))},
        ],
    )
    found = module.entries(given)
    told = {(x.leaf, x.answer.a.contestant): x.answer for x in beside.worths(given, found)}
    assert {k: x.verdict for k, x in told.items()} == {
        ("filter", "NPD"): "smaller",
        ("filter", "m = 1"): "larger",
        ("policy", "NPD"): "open",
        ("policy", "m = 1"): "smaller",
    }
    assert told["filter", "NPD"].ratio.value == pytest.approx(0.5)
    of_filter, of_policy = beside.worth_sentences(given, found)
    assert of_filter == (
        "**the filter**: RABBIT, 1 ms, smaller with it in 1 of 2, the middle ratio is 0.5, larger in 1 "
        "(*m = 1* at gait v0.5)."
    )
    assert "in 1 of 2, the middle ratio is 0, open in 1 (within a factor 1)." in of_policy
    head, rows = beside.worth_rows(given, found)
    assert head == ["place, gait", "contestant", "the filter", "the policy"]
    assert rows[0][2:] == ["0.5 (0.5 to 0.5)", "1 (1 to 1) (open)"]


def test_what_moves_with_half_the_step_is_said_by_place(script):
    half = [[x[0]] for x in walks(0.5)]
    fewer = [[x[0]] for x in walks(0.44, (3,))]
    given = with_beside(
        summary(search("NPD", 0.5), search("m = 1", 0.4)),
        halved=[{"contestant": "NPD", "walks": half}, {"contestant": "m = 1", "walks": fewer}],
    )
    module = script("tuned_steps")
    found = script("tuned_entries").entries(given)
    changes = {x.entry.contestant: x.change for x in module.moved(given, found)}
    assert changes["NPD"] == 0.0
    assert changes["m = 1"] == pytest.approx(0.1, rel=0.3)
    (said,) = module.step_sentences(given, found)
    assert "of 2 settings the median error moves most for *m = 1* at gait v0.5" in said
    assert f"by at most -1 of {SEEDS}, those of all settings by -1 of {2 * SEEDS}." in said


def brackets(low, width=2.5, count=SEEDS):
    return [[low, low + width]] * count


def test_pushes_that_are_known_to_intervals_count_where_these_do_not_overlap(script):
    beside, page = script("tuned_pushes"), script("tuned_page")
    ends = {
        "NPD": brackets(40.0),
        "NPID": brackets(41.0),
        "m = 1": [*brackets(60.0, count=SEEDS - 1), [320.0, "inf"]],
        "m = 2": [*brackets(20.0, count=SEEDS - 1), [0.0, 0.0]],
        "DOB": brackets(42.5),
    }
    told = [{"contestant": name, "ends": x} for name, x in ends.items()]
    given = with_beside(summary(*(search(n) for n in ends)), pushes=told)
    groups = page.first_groups(script("tuned_entries").entries(given))
    found = {x.a.contestant: x for x in beside.pushes(given, groups)}
    assert {n: (x.won, x.lost, x.verdict) for n, x in found.items()} == {
        "NPID": (0, 0, "open"),
        "m = 1": (SEEDS, 0, "larger"),
        "m = 2": (0, SEEDS, "smaller"),
        "DOB": (SEEDS, 0, "open"),  # each is larger for certain, by a factor that may be 1
    }
    assert found["m = 1"].low.value == pytest.approx(60.0 / 42.5)
    assert found["m = 1"].high.value == pytest.approx(62.5 / 40.0)
    assert found["NPID"].within == pytest.approx(43.5 / 40.0)
    said = beside.push_sentences(list(found.values()))
    assert "*m = 1* bears larger pushes than *NPD*, by a median factor of at least 1.41" in said[1]
    assert "within a factor 1.09 of each other; median 41 to 43.5 N m" in said[0]


def test_a_setting_that_no_search_made_stands_beside_the_best_and_its_limit(script):
    given = with_beside(
        summary(search("NPD"), search("m = 1", 0.5)),
        unsearched=[{"name": "Table I", "margin": 2e-5, "walks": walks(0.1)}],
    )
    page = script("tuned_page")
    groups = page.first_groups(script("tuned_entries").entries(given))
    (said,) = script("tuned_leaves").unsearched_sentences(given, groups)
    assert "the best of those tuned. Its delay margin of 0.02 ms misses the limit of 2 ms." in said


def test_the_interquartile_mean_is_infinite_where_more_than_a_quarter_is(script):
    mean = script("tuned_text").interquartile
    x = np.arange(1.0, 9.0)[None, :]
    assert mean(x).value == pytest.approx(4.5)
    x[0, 6:] = np.inf
    assert mean(x).value == pytest.approx(4.5)
    x[0, 5:] = np.inf
    assert mean(x).value == math.inf


def test_orders_searched_at_equal_margin_and_ripple_are_held_against_the_first(script):
    beside, page = script("tuned_equal"), script("tuned_page")
    place = {"place": "margin 3 ms"}
    orders = summary(
        *(
            {**search(f"m = {m}", f, place="margin 3 ms"), "ripple": 5.0}
            for m, f in ((1, 1.0), (2, 2.0))
        ),
        nothing("m = 3") | place,
    )
    orders["contest"] = {
        **orders["contest"],
        "places": {"margin 3 ms": orders["contest"]["places"][PLACE]},
    }
    given = summary(search("NPD")) | {"orders": orders}
    (*_, told, _, shown) = beside.equal_loops(given, [])
    assert "**margin 3 ms**: *m = 1* has " in told
    assert "costs: *m = 2* 2 (2 to 2), *m = 3* (no setting that keeps the limits)" in told
    assert "2.5 | 2.5 | 5 | 4.01 (" in shown
    assert told in page.page(given)
    assert beside.equal_loops(summary(search("NPD")), []) == []


class Asked(NamedTuple):
    """A search as alike.py gives it."""

    place: str
    gait: str
    contestant: str
    seed: int

    @property
    def folder(self):
        return self.contestant


def test_a_folder_of_searches_becomes_a_summary(script, monkeypatch, tmp_path):
    module = script("tuned_entries")
    asked = [Asked(PLACE, GAIT, name, 1) for name in ("NPD", "NPID", "m = 1", "DOB")]
    notes = {
        "NPD": {
            "found": True,
            "chosen": {"K_p": 1234.567, "contact": None, "contact_window": 0.01},
        },
        "NPID": {"found": False, "why": "none keeps all limits"},
        "m = 1": {"found": False, "why": "of other versions"},
    }
    for e in asked[:3]:
        (tmp_path / e.folder).mkdir()
        write(tmp_path / e.folder / "entry.json", e._asdict() | notes[e.contestant])
    told = {
        "selected": [{"number": 4, "objectives": [0.0012345]}],
        "held_out": [
            {"words": "median rms_error", "chosen": {"value": 9.0}, "published": {"value": 9.0}},
            {
                "words": "mean delay_margin",
                "chosen": {"value": 2e-3},
                "published": {"value": "-inf"},
            },
        ],
    }
    write(tmp_path / "NPD" / "summary.json", told)
    conditions = [{"name": "60 N m"}, {"name": "80 N m"}]
    write(tmp_path / "NPD" / "test_set.json", {"conditions": conditions, "seeds": [8, 9]})
    monkeypatch.setattr(module, "read_store", lambda _: Store())
    found = module.collected(tmp_path, summary()["contest"], asked)
    assert (len(found["asked"]), len(found["searches"])) == (4, 2)
    npd, npid = found["searches"]
    assert npd["tuned"][0] == [[4068.0, 4069.0], [4088.0, 4089.0]]  # candidate, condition, seed
    assert npd["published"][0] == [[68.0, 69.0], [88.0, 89.0]]
    assert npd["chosen"] == {"K_p": 1235.0, "contact": None}  # no window without a policy
    assert (npd["selected"], found["beside"]) == (0.001234, {})
    assert npd["margins"] == [0.002, "-inf"]
    assert npid == {**asked[1]._asdict(), "why": "none keeps all limits"}


def write(path, told):
    path.write_text(json.dumps(told), encoding="utf-8")


class Store:
    """A file of results: walks of two candidates, backwards, and one of the training set."""

    def results(self):
        for number, condition, seed in itertools.product((4, 0), (80, 60), (9, 8)):
            at = {"set": "test", "candidate": number, "condition": f"{condition} N m", "seed": seed}
            x = float(1000 * number + condition + seed)
            yield Result(
                0,
                "",
                at,
                dict.fromkeys(("rms_error", "rms_torque", "cost_of_transport"), x) | {"legal": 1},
            )
        yield Result(0, "", at | {"set": "training"}, {})

    def close(self):
        """Nothing is open."""


def test_an_empty_folder_is_refused(script, tmp_path):
    with pytest.raises(InputError, match="no finished search; run"):
        script("write_tuned").summarised(tmp_path)
    with pytest.raises(InputError, match="run 'make tuned' first"):
        script("write_tuned").read(tmp_path / "summary.json")


def test_the_figures_have_no_mark_for_what_is_infinite(script):
    given = summary(
        search("NPD"),
        search("NPID", 1.2),
        search("m = 1", 0.5),
        nothing("m = 3"),
        search("NPD", seed=2),
    )
    drawn = script("tuned_figures").drawn(script("tuned_entries").entries(given))
    shown = {name: numbers_of(figure)["panels"] for name, figure in drawn.items()}
    (ratios,), (errors,) = ([p for p in shown[n] if p.get("title")] for n in ("ratios", "errors"))
    assert ratios["marks"] == {
        "optimiser seed 1": {"x": [1.2, 0.5], "y": [0, 1], "from": [1.2, 0.5], "to": [1.2, 0.5]}
    }
    assert set(errors["marks"]) == {"tuned"}  # as published no walk is legal
    assert errors["marks"]["tuned"]["x"] == pytest.approx(
        [1e3 * f * np.median(BASE) for f in (1.0, 1.2, 0.5)], rel=1e-3
    )
