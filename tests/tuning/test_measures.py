"""Measures, candidates and held-out numbers, by counting and closed forms."""

import math

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.statistics import over_seeds
from biped_adrc.tuning.candidate import Candidate, finalists, front, ranked
from biped_adrc.tuning.held_out import held_out
from biped_adrc.tuning.measure import Aim, Limit
from biped_adrc.tuning.study_file import read_tuning
from biped_adrc.tuning.without_walk import numbers_without_walk

INF = math.inf


def walks(*numbers, condition="", feasible=1, column="rms_error"):
    return [(condition, {"survived": 1, "feasible": feasible, column: x}) for x in numbers]


FELL = ("", {"survived": 0, "feasible": 0, "rms_error": 0.001})
REFUSED = ("", {"survived": None, "feasible": None, "rms_error": None})


def of(m, walked):
    return m.measured(walked, {})


def test_falls_and_infeasible_walks_rank_worst_and_are_not_dropped():
    median, best = Aim(column="rms_error"), Aim(column="rms_error", goal="maximise")
    assert of(median, walks(3.0, 1.0, 2.0)) == 2.0
    assert of(median, walks(1.0, 2.0)) == 1.5
    for bad in (FELL, REFUSED, *walks(0.001, feasible=0), *walks(None)):
        assert of(median, [*walks(3.0, 1.0), bad]) == 3.0
        assert of(best, [*walks(3.0, 1.0), bad]) == 1.0
        assert of(median, [*walks(3.0), bad]) == INF
        assert of(best, [*walks(3.0), bad]) == -INF
        assert of(Aim(column="rms_error", over="mean"), [*walks(3.0), bad]) == INF
    made = Aim(column="rms_error", counts="made")
    assert of(made, [*walks(3.0, 1.0), *walks(0.5, feasible=0)]) == 1.0
    assert of(made, [*walks(3.0, 1.0), FELL]) == 3.0


def test_quantiles_are_numbers_of_walks_in_the_order_of_the_goal():
    x = walks(*range(1, 11))
    assert [of(Aim(column="rms_error", over=p), x) for p in (0.5, 0.9, 0.91)] == [5, 9, 10]
    most = {"column": "rms_error", "goal": "maximise"}
    assert [of(Aim(over=p, **most), x) for p in (0.5, 0.9, 0.91)] == [6, 2, 1]
    assert of(Aim(column="rms_error", over="worst"), x) == 10
    assert of(Aim(over="worst", **most), x) == 1


def test_every_walk_counts_in_a_share():
    feasible = Limit(column="feasible", least=0.9)
    x = of(feasible, [*walks(1.0, 1.0), FELL, REFUSED])
    assert (x, feasible.excess(x)) == (0.5, pytest.approx(0.4 / 0.9))
    torque = Limit(column="peak_torque", most=150.0, over="worst")
    assert torque.excess(of(torque, walks(100.0, 165.0, column="peak_torque"))) == pytest.approx(
        0.1
    )
    assert torque.excess(150.0) == 0.0
    assert Limit(column="bad_friction", most=0.0).excess(0.5) == 0.5


STUDY = {
    "study": {"name": "s", "budget": 10, "generation": 4, "seed": 0, "finalists": 3},
    "fixed": {"controller": "LESO", "contact": "hold", "contact_window": 0.01},
    "variables": {
        "bandwidth": {"from": 50, "to": 500, "scale": "log"},
        "contact": {"choices": ["none", "hold"]},
        "contact_window": {"from": "5 ms", "to": "20 ms", "when": {"contact": "hold"}},
        "own.filter": {"from": 1, "to": 4, "whole": True},
    },
    "objectives": [{"column": "rms_error"}, {"column": "speed", "goal": "maximise"}],
    "limits": [{"column": "feasible", "least": 0.9}],
    "training": {"seeds": [0, 1]},
    "selection": {"seeds": {"from": 10, "count": 3}},
    "test": {"seeds": [20]},
}


def candidate(number, rms_error, speed, excess=0.0, walked=True, **chosen):
    return Candidate(number, 0, chosen, (rms_error, speed), (0.9,), (excess,), walked)


def test_candidates_are_ranked_by_limits_then_objective_and_the_front_is_not_dominated():
    study = read_tuning(STUDY)
    found = [
        candidate(0, 3.0, 1.0),
        candidate(1, 1.0, 0.5, bandwidth=60.0),
        candidate(2, 0.1, 9.0, excess=0.2, bandwidth=70.0),
        candidate(3, 2.0, 2.0, bandwidth=80.0),
        candidate(4, 2.0, 1.5, bandwidth=90.0),
        candidate(5, INF, -INF, walked=False, bandwidth=95.0),
        candidate(6, 1.0, 0.5, bandwidth=60.0),
    ]
    assert [c.number for c in ranked(study, found)] == [1, 6, 3, 4, 0, 2]
    assert [c.number for c in front(study, found)] == [1, 3]
    assert [c.number for c in finalists(study, found)] == [1, 3, 4, 0]
    quick = candidate(7, 9.0, 5.0, bandwidth=99.0)  # of the front, and the last by the first goal
    assert [c.number for c in finalists(study, [*found, quick])] == [1, 3, 7, 0]


def test_the_interval_over_seeds_draws_seeds_with_all_conditions():
    random = np.random.default_rng(1)
    of_seed = random.normal(size=400)
    x = np.array([of_seed, of_seed + 1.0])
    found = over_seeds(x, lambda sets: sets.mean(axis=1))
    half = 1.96 * of_seed.std() / math.sqrt(400)
    assert found.value == pytest.approx(x.mean())
    assert (found.high - found.low) / 2.0 == pytest.approx(half, rel=0.1)
    x[0, 0] = INF
    assert over_seeds(x, lambda sets: sets.mean(axis=1)).high == INF
    assert over_seeds(x, lambda sets: np.median(sets, axis=1)).high < 1.0


def test_held_out_numbers_are_paired_by_seed():
    mean = [{"column": "rms_error", "over": "mean"}]
    study = read_tuning(STUDY | {"objectives": mean, "test": {"seeds": list(range(20, 60))}})
    y = np.random.default_rng(2).uniform(1.0, 9.0, 40)
    chosen, published = walks(*(0.5 * y)), walks(*y)
    error, feasible = held_out(study, (chosen, {}), (published, {}))
    assert error.ratio == pytest.approx((0.5, 0.5, 0.5))
    assert error.chosen.low < error.chosen.value < error.chosen.high
    assert feasible.chosen == pytest.approx((1.0, 0.9124, 1.0), abs=1e-4)
    fell = held_out(study, (chosen, {}), ([*published[1:], FELL], {}))[0]
    assert (fell.published.value, fell.ratio) == (INF, None)
    linear = held_out(study, (chosen, {"rms_error": 2.0}), (published, {"rms_error": 4.0}))[0]
    assert linear.ratio == (0.5, 0.5, 0.5)


def test_columns_without_a_walk_are_those_of_the_specification():
    """Numbers of the loop, margins 0 where it is unstable; on soft ground those of the rigid plant."""
    names = ("stable", "delay_margin", "disk_margin", "ripple")
    values = {"controller": "NPD", "period": 1e-3, "delay": 1e-3, "impacts": 2}
    told = ba.specified(ba.Scenario(**values))
    assert numbers_without_walk(names, values) == {name: told[name] for name in names}
    late = numbers_without_walk(names, values | {"delay": 0.012})
    assert late == {"stable": 0.0, "delay_margin": 0.0, "disk_margin": 0.0, "ripple": None}
    soft = values | {"plant": "mujoco", "ground_friction": 0.8, "time_constant": 5e-3}
    assert numbers_without_walk(names, soft) == {name: told[name] for name in names}
    assert numbers_without_walk(names, values | {"period": None}) == dict.fromkeys(names)
