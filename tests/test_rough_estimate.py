"""The estimated height of a ground that is walked: against the exact map, and against walks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.rough_estimate import GRID_END, RoughEstimate, rough_estimate
from biped_adrc.analysis.rough_ground import WAYS, rough_ground
from biped_adrc.core.errors import InputError
from biped_adrc.gait.constraint import continued
from biped_adrc.scenario.build import build
from biped_adrc.studies.build import scene_of

CLOCK = ba.SampledTime(1e-3)


def gait_of(name, biped):
    gait = ba.load_gait(name, biped)
    return replace(gait, constraint=continued(gait.constraint))


def reset_on(gait, biped, timing):
    npd = ba.NPDController(gait.constraint)
    return ba.Walker(biped, ba.ReferenceReset(npd, share=0.5), timing=timing)


@pytest.fixture(scope="module")
def npd(biped):
    """Under NPD with low gains, which no exact map describes."""
    gait = gait_of("v0.6", biped)
    law = ba.NPDController(gait.constraint, gains=ba.Gains(600.0, 30.0))
    return rough_estimate(ba.Walker(biped, law, timing=CLOCK), gait, grid=(17, 21))


@pytest.mark.parametrize("name", ["v0.6", "v0.8"])
def test_with_the_reset_it_is_the_exact_map(biped, name):
    """2 %: of the clock of 1 kHz, and of lines between the values of the grid. The interval of y: 3 %, as its
    ends are steep in H."""
    gait = gait_of(name, biped)
    exact = rough_ground(reset_on(gait, biped, ba.ContinuousTime()), gait, forces=())
    found = rough_estimate(reset_on(gait, biped, CLOCK), gait, grid=(25, 21))
    for way in WAYS:
        assert found.reach(way).cause == exact.reach(way).cause
        assert found.reach(way).height == pytest.approx(exact.reach(way).height, rel=0.02)
    H, m = 0.8 * exact.reach().height, exact.map
    assert found.interval(H) == pytest.approx(exact.interval(H), rel=0.03)
    y = m.delta2[m.level] * (found.y - m.V_2[m.level]) - m.V_1[m.level]
    level, made = found.following[:, 10], np.isfinite(found.following[:, 10])
    assert level[made] == pytest.approx(y[made], rel=1e-3)


def test_walks_below_H_are_feasible_and_not_all_above(npd):
    assert npd.reach().cause == "friction"
    assert 1e3 * npd.reach().height == pytest.approx(9.1, abs=0.2)
    assert npd.overturn(walks=20, share=0.95, steps=20) == (0, 0)
    random, worst = npd.overturn(walks=20, share=1.3, steps=20)
    assert random > 5
    assert worst >= 4


def test_H_grows_with_friction(npd):
    H = [npd.at_friction(mu).reach().height for mu in (0.4, 0.5, 0.6, 0.65, 0.8)]
    assert sorted(H) == H
    assert H[0] == 0.0 < H[2] < H[-1]
    both, up, down = (npd.reach(way).height for way in ("both", "up", "down"))
    assert both <= min(up, down)


def test_other_limits_are_those_of_a_new_estimate(biped, npd):
    again = rough_estimate(npd.walker, npd.gait, ba.Limits(friction=0.7), grid=(17, 21))
    assert again.reaches() == npd.at_friction(0.7).reaches()


def test_in_continuous_time_it_is_that_of_a_fast_clock(biped, npd):
    """A walk without a table is judged by its signals. 2 %: of the clock of 1 kHz."""
    of = [replace(npd.walker, timing=timing) for timing in (CLOCK, ba.ContinuousTime())]
    clock, exact = (rough_estimate(x, npd.gait, highest=0.012, grid=(9, 9)) for x in of)
    assert exact.reach().height == pytest.approx(clock.reach().height, rel=0.02)


def test_the_grid_stops_H(npd):
    cut = replace(
        npd, **{name: getattr(npd, name)[..., 8:13] for name in ("heights", "following", "numbers")}
    )
    assert isinstance(cut, RoughEstimate)
    assert cut.reach() == (pytest.approx(4e-3), GRID_END)


def test_what_it_cannot_estimate_is_refused(biped, npd):
    gait, walker = npd.gait, npd.walker
    weak = replace(walker, torque_limit=1.0)
    for text, call in {
        "on level ground": lambda: rough_estimate(weak, gait),
        "the grid is": lambda: rough_estimate(walker, gait, grid=(25, 40)),
        "what is to walk": lambda: rough_estimate(walker.controller, gait),
        "sideways": lambda: npd.reach("sideways"),
    }.items():
        with pytest.raises(InputError, match=text):
            call()


def test_the_text_has_the_numbers(npd):
    text = npd.text()
    assert "mm, friction" in text
    assert "0.4: 0.0" in text


def test_y_rises_for_a_late_controller(biped):
    """Behind encoders and a filter of 90 ms a step that comes to no middle stands at a larger y than the next
    faster one: it is left out, and there is a height.
    """
    encoders = {"counts": 8192, "velocity": "differences", "filter_time": 0.0886}
    hardware = {"period": 1e-3, "delay": 1e-3, "encoders": encoders}
    law = {"name": "NPD", "K_p": 224.0, "K_d": 84.7, "feedforward": 0.758, "prediction": 2.8e-3}
    s = ba.Scenario(law, gait={"name": "v0.6", "continued": True}, hardware=hardware)
    scene = scene_of(s)
    found = rough_estimate(build(s, scene), scene.walked, highest=0.05, grid=(25, 11))
    assert np.all(np.diff(found.y) > 0.0)
    assert 0.005 < found.reach().height < 0.03
