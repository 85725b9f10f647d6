"""What a user prints fits a line.

Parts (robots, controllers, walkers) and results show by repr what they are: one line of at most 120
characters, with values of their fields unless they are the defaults.
"""

from __future__ import annotations

import dataclasses

import numpy as np

import biped_adrc as ba
from biped_adrc.analysis.stability import known_cycle
from biped_adrc.core.shown import LONGEST, SHORT, as_line, short
from biped_adrc.gait.exchange.samples import Samples
from biped_adrc.gait.outputs import OutputPoint
from biped_adrc.gait.reference import ReferencePoint

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
    """Arrays up to 6 numbers are shown, longer ones by their shape."""
    text = "Impact(q=[0 0 0 0 0], v=[0 0 0 0 0], impulse=[0 0], v_e=array(7,))"
    assert repr(biped.impact(np.zeros(5), np.zeros(5))) == text
    assert repr(biped.reduction(np.zeros(5), np.zeros(5))).startswith(
        "Reduction(D=array(5, 5), Omega"
    )


def test_a_class_of_ones_own_fits_too(gait):
    """A dataclass of the user's gets the same repr by its base class: defaults are left out, and a table of
    1000 numbers does not make it longer than LONGEST."""

    @dataclasses.dataclass(frozen=True)
    class Own(ba.Controller):
        reference: ba.Reference
        gain: float = 2.0
        table: tuple[float, ...] = ()

    assert repr(Own(gait.constraint)).startswith("Own(reference=VirtualConstraint(")
    assert repr(Own(gait.constraint, 3.0)).endswith("gain=3.0)")
    assert len(repr(Own(gait.constraint, 3.0, (1.0,) * 1000))) <= LONGEST


def test_a_status_is_shown_by_its_name(biped, gait):
    """The value of a status is a sentence, which would fill the line."""
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1)
    assert repr(walk.feasibility).startswith("Feasibility(status=COMPLETED, ")
    assert repr([walk.trajectory.status]) == "[Status.COMPLETED]"


def test_a_stepper_and_its_samples_are_one_line(biped, gait):
    """The stepper has two walks at once; arrays of a sample have a row for each."""
    stepper = ba.Stepper(ba.Walker(biped, ba.NPDController(gait.constraint), timing=TICKS), 2)
    assert repr(stepper) == "Stepper(2 walks of Walker(...))"
    sample = stepper.reset(start=gait.start(biped))
    assert repr(sample).startswith("Sample(t=[0 0], x=array(2, ")


def test_values_are_shown_as_they_are(biped, gait):
    """Gains by default are not shown; numbers and arrays are, as they were entered."""
    assert repr(ba.Gains()) == "Gains()"
    assert repr(ba.Gains(1.0, np.array([1.0, 2.0]))) == "Gains(K_p=1.0, K_d=[1 2])"
    assert repr(gait) == "Gait('published', robot 'rabbit', preset 'identified', period 0.4164 s)"


def test_a_long_text_is_shortened_and_a_short_one_is_whole():
    """Texts by their start, tuples by their count, arrays of more than 6 numbers by their shape. A field with
    its default is left out, also where the default is an array."""
    assert short("v0.8") == "'v0.8'"
    assert short((1.0, 2.0)) == "(1.0, 2.0)"
    assert short("x" * 200) == repr("x" * (SHORT - 5) + "...")  # 5: two quotes and three dots
    assert short(tuple(range(200))) == "(200 items)"
    assert as_line(Own(np.zeros(3))) == "Own(x=[0 0 0])"  # of another length than its default
    assert as_line(Own()) == "Own()"
    assert repr(Samples(np.zeros(7), np.zeros((7, 2)))) == "Samples(t=array(7,), q=array(7, 2))"
    y = np.array([0.5])
    assert repr(OutputPoint(y, y, np.ones((1, 2)), y)) == (
        "OutputPoint(y=[0.5], dy=[0.5], J=array(1, 2), drift=[0.5])"
    )
    assert (
        repr(ReferencePoint(y, y, y, y))
        == "ReferencePoint(q_d=[0.5], dq_d=[0.5], drift=[0.5], H=[0.5])"
    )


@dataclasses.dataclass(frozen=True)
class Own:
    x: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros(2))
