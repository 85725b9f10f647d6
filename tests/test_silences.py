"""Numbers that are none of what they stand for are refused with a sentence, before anything is computed."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.errors import InputError
from biped_adrc.scenario.run import execute, passive_walk
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.timing import LONGEST_PERIOD

ENGINES = ("pinocchio", "compiled")
NO_COUNTS = (0, -1, 2.5, True, "3", math.nan)


@pytest.fixture(scope="module")
def walker(biped, gait):
    return ba.Walker(biped, ba.NPDController(gait.constraint))


@pytest.mark.parametrize(
    ("timing", "meant"),
    [
        (1e-2, "SampledTime(0.01)"),
        (1, "SampledTime(1)"),
        (True, "SampledTime(period)"),
        (None, "SampledTime(period)"),
        ("1 kHz", "SampledTime(period)"),
        (ba.SampledTime, "SampledTime(period)"),
    ],
)
def test_a_number_is_no_timing(timing, meant, walker):
    with pytest.raises(InputError, match=re.escape(f"{timing!r}, expected {meant}")):
        replace(walker, timing=timing)


def test_a_clock_slower_than_a_fall_is_none():
    assert ba.SampledTime(LONGEST_PERIOD).period == LONGEST_PERIOD
    for period in (1000, 0.5, True, math.inf):
        with pytest.raises(InputError, match=rf"at most {LONGEST_PERIOD} s"):
            ba.SampledTime(period)


@pytest.mark.parametrize("count", NO_COUNTS)
@pytest.mark.parametrize("engine", ENGINES)
def test_counts_are_whole_numbers_from_one(count, engine, walker, gait):
    for name, said in (
        ("impacts", f"the walk asks for {count} impacts"),
        ("first_step", f"begins in single support {count}"),
    ):
        with pytest.raises(InputError, match=re.escape(f"{said}, expected a whole number")):
            ba.walk(walker, gait, engine=engine, **{"impacts": 1, name: count})
    with pytest.raises(InputError, match=re.escape(f"impacts: found {count!r}, should be")):
        execute(Scenario("NPD", impacts=count, engine=engine))


@pytest.mark.parametrize("count", NO_COUNTS)
def test_counts_elsewhere(count, walker, gait, biped):
    start = walker.initial_state(*gait.start(biped))
    for more in ({"store_every": count}, {"stop_after": ("foot_strike", count)}):
        with pytest.raises(InputError, match="expected a whole number"):
            ba.simulate(walker, start, ba.Mode(), ba.RK4(), t_end=0.01, **more)
    with pytest.raises(InputError, match="expected a whole number"):
        passive_walk("compass", count)
    for made in (
        lambda: ba.TorquePulse([30.0] * 5, step=count, start=0.1, stop=0.2),
        lambda: ba.TorqueStep([30.0] * 5, step=count, start=0.1),
        lambda: ba.StepDown(count, 0.01),
        lambda: ba.StepUp(count, 0.01),
    ):
        with pytest.raises(InputError, match="expected a whole number"):
            made()


@pytest.mark.parametrize("count", [0, -1, 2.5, True])
def test_a_case_of_a_batch_asks_for_whole_impacts(count, walker, gait, biped):
    case = ba.Case(walker, *gait.start(biped), ba.RK4(), impacts=count)
    with pytest.raises(InputError, match=r"whole number|impacts"):
        list(ba.simulate_many([case]))


def test_counts_of_numpy_are_counts(walker, gait):
    made = ba.walk(walker, gait, np.int64(1), engine="compiled", first_step=np.int32(2))
    assert made.trajectory.status.ok


@pytest.mark.parametrize(
    "bound",
    [
        {"max_step_time": -1.0},
        {"max_step_time": math.nan},
        {"fall_height": math.nan},
        {"fall_height": 2.0},
    ],
)
def test_bounds_of_a_walk(bound, walker):
    with pytest.raises(InputError, match="expected a positive time and a share"):
        replace(walker, **bound)
