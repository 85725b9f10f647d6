"""What a user prints fits a line."""

from __future__ import annotations

import dataclasses

import numpy as np

import biped_adrc as ba
from biped_adrc.analysis.stability import known_cycle
from biped_adrc.core.shown import LONGEST, SHORT, short

LINE = 120
TICKS = ba.SampledTime(1e-3)


def test_parts_and_walks_fit_a_line(biped, gait):
    """The repr of each has no line break and at most 120 characters."""
    npd, adrc = ba.NPDController(gait.constraint), ba.ADRCController(gait.constraint)
    pulse = ba.TorquePulse([30, 30, 30, 30, 0], step=1, start=0.1, stop=0.3)
    walker = ba.Walker(biped, adrc, pulse, timing=ba.SampledTime(1e-3), sensors=ba.Sensors())
    walk = ba.walk(ba.Walker(biped, npd, pulse), gait, 1)
    m = walker.measure(0.0, *gait.start(biped), ba.Mode())
    parts = [
        biped,
        biped.tree,
        gait,
        gait.constraint,
        adrc,
        adrc.observer,
        pulse,
        walker,
        m,
        m.terms,
    ]
    results = [walk, walk.trajectory, walk.signals, walk.certificates[0], walk.feasibility]
    studied = [ba.Scenario("NPD"), known_cycle(ba.Biped.load("compass")), ba.Limits()]
    for thing in (*parts, *results, *studied):
        assert "\n" not in repr(thing), type(thing)
        assert len(repr(thing)) <= LINE, repr(thing)


def test_what_a_robot_computes_is_one_line(biped):
    text = "Impact(q=[0 0 0 0 0], v=[0 0 0 0 0], impulse=[0 0], v_e=array(7,))"
    assert repr(biped.impact(np.zeros(5), np.zeros(5))) == text
    assert repr(biped.reduction(np.zeros(5), np.zeros(5))).startswith(
        "Reduction(D=array(5, 5), Omega"
    )


def test_a_class_of_ones_own_fits_too(gait):
    @dataclasses.dataclass(frozen=True)
    class Own(ba.Controller):
        reference: ba.Reference
        gain: float = 2.0
        table: tuple[float, ...] = ()

    assert repr(Own(gait.constraint)).startswith("Own(reference=VirtualConstraint(")
    assert repr(Own(gait.constraint, 3.0)).endswith("gain=3.0)")
    assert len(repr(Own(gait.constraint, 3.0, (1.0,) * 1000))) <= LONGEST


def test_a_status_is_shown_by_its_name(biped, gait):
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1)
    assert repr(walk.feasibility).startswith("Feasibility(status=COMPLETED, ")
    assert repr([walk.trajectory.status]) == "[Status.COMPLETED]"


def test_a_stepper_and_its_samples_are_one_line(biped, gait):
    stepper = ba.Stepper(ba.Walker(biped, ba.NPDController(gait.constraint), timing=TICKS), 2)
    assert repr(stepper) == "Stepper(2 walks of Walker(...))"
    sample = stepper.reset(start=gait.start(biped))
    assert repr(sample).startswith("Sample(t=[0 0], x=array(2, ")


def test_values_are_shown_as_they_are(biped, gait):
    assert repr(ba.Gains()) == "Gains()"
    assert repr(ba.Gains(1.0, np.array([1.0, 2.0]))) == "Gains(K_p=1.0, K_d=[1 2])"
    assert repr(gait) == "Gait('published', robot 'rabbit', preset 'identified', period 0.4164 s)"


def test_a_long_text_is_shortened_and_a_short_one_is_whole():
    assert short("v0.8") == "'v0.8'"
    assert short((1.0, 2.0)) == "(1.0, 2.0)"
    assert short("x" * 200) == repr("x" * (SHORT - 5) + "...")
    assert short(tuple(range(200))) == "(200 items)"
