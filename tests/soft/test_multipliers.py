"""Multipliers from pairs of walks with noise: maps whose multipliers are known, and starts of soft walks."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.stepping_plant import Load, PlantState
from biped_adrc.errors import InputError
from biped_adrc.scenario.walk import default_method

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from soft import multipliers as study
from soft.noisy_map import Pairs, fitted, magnitudes, multipliers, only_largest

KNOWN = np.array([0.7, 0.25, 0.0, 0.0])
"""Multipliers of the linear map."""
NOISE = 2e-2
"""Of a pair whose distances are at most 1."""


def linear(random):
    """A map (4, 4) that couples its directions, with the multipliers KNOWN."""
    T = np.diag(KNOWN) + np.triu(random.uniform(-1.0, 1.0, (4, 4)), 1)
    Z = np.linalg.qr(random.normal(size=(4, 4)))[0]
    return Z @ T @ Z.T


def noisy(P, count, random, size=1.0, noise=NOISE):
    """Pairs of x -> P x at distances up to `size`, both passages with uniform noise."""
    d = size * random.uniform(-1.0, 1.0, (count, len(P)))
    e = noise * random.uniform(-1.0, 1.0, (2, count, len(P)))
    return Pairs(d + e[0], d @ P.T + e[1])


def test_intervals_and_floor_of_a_known_map_hold_as_often_as_they_say():
    """In 40 draws: the largest within its interval, the second above the floor, zeros below it."""
    inside, above, below = [], [], []
    for seed in range(40):
        random = np.random.default_rng(seed)
        P = linear(random)
        found = multipliers(noisy(P, 40, random), noisy(P, 20, random, size=0.0), seed)
        inside.append(found.low <= 0.7 <= found.high)
        above.append(found.magnitudes[1] > found.floor)
        below.append(found.magnitudes[2] <= found.floor)
    assert sum(inside) >= 34  # at 95 %, fewer than 34 of 40 come three times in a thousand
    assert sum(above) >= 34
    assert sum(below) >= 36


def test_what_the_placebo_does_not_know_is_said():
    """A cubic term of the map is no noise: what P leaves is then many times the placebo."""
    random = np.random.default_rng(0)
    P = linear(random)
    pairs, placebo = noisy(P, 40, random), noisy(P, 20, random, size=0.0)
    assert 0.7 < multipliers(pairs, placebo, 0).left < 2.0
    bent = pairs._replace(second=pairs.second + pairs.first**3)
    assert multipliers(bent, placebo, 0).left > 10.0


def test_zeros_are_put_in_place_of_all_but_the_largest():
    P = linear(np.random.default_rng(1))
    alone, kept = only_largest(P)
    np.testing.assert_allclose(magnitudes(alone), [0.7, 0.0, 0.0, 0.0], atol=1e-4)
    assert kept == 1
    assert np.linalg.norm(alone) > 0.9  # what couples the directions has stayed
    turning = np.zeros((3, 3))
    turning[:2, :2] = 0.5 * np.array([[0.6, -0.8], [0.8, 0.6]])
    turning[2, 2] = 0.1
    alone, kept = only_largest(turning)
    np.testing.assert_allclose(magnitudes(alone), [0.5, 0.5, 0.0], atol=1e-12)
    assert kept == 2


def test_too_few_pairs_are_refused():
    random = np.random.default_rng(2)
    P = linear(random)
    with pytest.raises(InputError, match="7 pairs and 20 without a distance are too few for 4"):
        multipliers(noisy(P, 7, random), noisy(P, 20, random, size=0.0), 0)


def test_pairs_of_the_rigid_walk_have_the_multipliers_of_its_return_map(biped, gait):
    """In continuous time, with a jitter added. Sampled the map bends at every sampling period: nearby its
    derivative is that between two bends, further away that of continuous time.
    """
    found = {}
    for timing in (ba.ContinuousTime(), ba.SampledTime(1e-3)):
        walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing)
        P = ba.ReturnMap(walker, default_method(walker), controller_states=False)
        run = ba.walk(walker, gait, 8).trajectory
        orbit = P.fixed_point(run.before("foot_strike")[-1])
        found[walker.sampled] = P, P.project(orbit.x_minus), abs(orbit.multipliers[0])
    P, s, largest = found[False]
    far, jitter = study.images(P, s, 1.0), np.random.default_rng(4).uniform(-1e-3, 1e-3, (60, 9))
    moved = far._replace(second=far.second + jitter[:40])
    told = multipliers(moved, Pairs(np.zeros((20, 9)), jitter[40:]), 5)
    assert told.magnitudes[0] == pytest.approx(largest, abs=1e-3)
    assert 0.0 < told.high - told.low < 4e-3
    assert told.magnitudes[1] <= told.floor < 0.02
    P, s, nearby = found[True]
    assert abs(nearby - largest) > 2e-3
    assert magnitudes(fitted(study.images(P, s, 1e-5)))[0] == pytest.approx(nearby, abs=1e-4)
    assert magnitudes(fitted(study.images(P, s, 1.0)))[0] == pytest.approx(largest, abs=1e-3)


def walked(biped, gait):
    """Two steps of NPD in MuJoCo, the second arc to start beside."""
    plant = ba.MuJoCoPlant(biped)
    npd, period = ba.NPDController(gait.constraint), ba.SampledTime(1e-3)
    loop = ba.CompiledLoop(plant, npd, biped, period, torque_limit=150.0)
    x0 = loop.initial_state(*gait.start(biped))
    run = loop.run(x0, ba.RunOptions(2.0, stop_after=("foot_strike", 2)))
    return loop, run.arcs[-1]


def test_a_walk_starts_beside_the_cycle_on_the_same_foot_and_passes_twice(biped, gait):
    loop, arc = walked(biped, gait)
    t, still = arc.t[0] + 0.1504, Load(np.zeros(5), np.zeros(2))

    def stance(x):
        state = PlantState(t, x[:5], x[5:10], x[10:15])
        foot = loop.plant.footing(state, np.zeros(4), still)
        return foot.place[0], foot.speed[0]

    d = study.SCALE * np.array([1, -1, 0.5, 1, -1, 1, 1, -1, 0.5, 1])
    on, off = (study.beside(loop, arc, t, k * d) for k in (0.0, 1.0))
    np.testing.assert_allclose(on[:15], arc(t)[:15], atol=1e-12)
    np.testing.assert_allclose(off[:10] - on[:10], d, atol=1e-15)
    (place, speed), (place_off, speed_off) = stance(on), stance(off)
    shin = (d @ [0, 0, 0, 0, 0, 1, 0, 1, 0, 1]) * loop.plant.ground.foot_radius
    np.testing.assert_allclose(place_off, place, atol=1e-12)
    np.testing.assert_allclose(speed_off - speed, [shin, 0.0], atol=1e-12)  # the foot rolls
    passed = study.passages((loop, arc), d, 0.3)
    level = study.phase_at(arc, study.SECTION)
    np.testing.assert_allclose([study.phase(x) for x in passed], level, atol=1e-12)
    assert np.max(np.abs(passed[0] - passed[1])) < 1.0
