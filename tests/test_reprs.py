"""What a user prints fits a line."""

from __future__ import annotations

import dataclasses
import inspect

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.source import source_of
from biped_adrc.observers.base import Estimate
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.shown import LONGEST, Shown, one_line

LINE = 120


PERIOD = ba.SampledTime(1e-3)


@pytest.fixture(scope="module")
def things(biped, gait):
    """One of every public class that holds numbers, and what they hand out."""
    npd, adrc = ba.NPDController(gait.constraint), ba.ADRCController(gait.constraint)
    return [
        *of_a_robot(biped, gait),
        *of_controllers(biped, gait, npd, adrc),
        *disturbances(biped),
        *(ba.RK4(), ba.Adaptive(), ba.Exponential(), ba.Stiff(), ba.Mode(), ba.ContinuousTime()),
        *(PERIOD, ba.Motors(), ba.Sensors(counts=4096), ba.ModelErrors(), ba.Limits()),
        *(ba.Told(), ba.ByForce(), ba.ByKinematics(), ba.StepLimits(), ba.GaitLimits()),
        *of_walks(biped, gait, npd, adrc),
        *on_other_plants(biped, gait, npd),
    ]


def of_a_robot(biped, gait):
    """Robot, gait, virtual constraint, and the zero dynamics on it."""
    h, (q, v) = gait.constraint, gait.start(biped)
    zero, cycle = ba.ZeroDynamics.of(biped, h), ba.find_cycle("compass")
    marks = {"theta_plus": h.theta_plus, "theta_minus": h.theta_minus, "phase": h.phase}
    return [
        *(biped, biped.description, biped.tree, biped.impact(q, v)),
        *(gait, h, h.curve, h.laws, h(0.0, q, v), zero, ba.ZeroOrbits.of(zero)),
        *(cycle, cycle.P, ba.cycle_stability(cycle, samples=0)),
        ba.GaitRecord("paper", h.curve.coefficients, **marks),
    ]


def of_controllers(biped, gait, npd, adrc):
    """Controllers, observers, outputs and references."""
    h, gains, (q, v) = gait.constraint, ba.StrideGains(-1.0, -0.4), gait.start(biped)
    outputs = ba.LinearOutputs(np.eye(4, 5), h)
    return [
        *(npd, npd.laws, npd.gains, adrc, adrc.laws, adrc.observer, adrc.observer.laws),
        *(Estimate(q, v, q), ba.ReferenceReset(adrc), ba.Passive(), ba.TimeReference(np.sin)),
        *(outputs, outputs(0.0, q, v), ba.FunctionOutputs(np.sin)),
        *(ba.OutputNPDController(outputs), ba.FiniteTimeController(outputs, 0.9, 0.02)),
        *(gains, ba.StridePI(npd, 0.7, 0.3, (0.0,) * 4, gains)),
    ]


def disturbances(biped):
    """One of each kind, and a sum."""
    pulse, step = pushed(), ba.TorqueStep([1.0] * 5)
    return [
        *(pulse, pulse.laws[0], pulse + pulse, step, ba.HipForce(biped, (3.0, 1.0))),
        ba.TorqueNoise([1.0] * 5, bandwidth=10.0, seed=1),
        ba.TorqueSine([1.0] * 5, frequency=2.0),
        *(ba.OnLink(biped, "torso", ba.TorqueStep([1.0] * 3)), ba.StepDown(1, 0.01)),
        ba.StepUp(1, 0.01),
    ]


def pushed():
    """The paper's push, in the first single support."""
    return ba.TorquePulse([30, 30, 30, 30, 0], step=1, start=0.1, stop=0.3)


def of_walks(biped, gait, npd, adrc):
    """Walkers, walks, scenarios and logs."""
    q, v = gait.start(biped)
    walker = ba.Walker(biped, adrc, pushed(), timing=PERIOD, sensors=ba.Sensors())
    walk = ba.walk(ba.Walker(biped, npd, pushed()), gait, 1)
    m = ba.Walker(biped, npd).measure(0.0, q, v, ba.Mode())
    asked = ba.walk_scenario(ba.Scenario("NPD", impacts=1, pushes="q1,q2,q3,q4=30@1:0.1-0.3"))
    return [
        *(walker, m, m.terms, ba.Case(walker, q, v, ba.RK4()), ba.RunOptions(1.0)),
        *(walk, walk.trajectory, walk.trajectory.arcs[0], walk.signals, walk.certificates[0]),
        *(walk.legality, asked, asked.outcome, asked.scenario, asked.scenario.pushes[0]),
        ba.Samples(walk.signals.t, walk.signals.q, walk.signals.v),
        ba.RobotLog(np.arange(3) * 1e-3, np.ones(3), np.zeros((3, 5)), np.zeros((3, 4))),
    ]


def on_other_plants(biped, gait, npd):
    """MuJoCo's plant and the loops around it, a frozen gait, and an exported controller."""
    soft, walker = ba.MuJoCoPlant(biped, ba.SoftGround()), ba.Walker(biped, npd, timing=PERIOD)
    loops = [kind(soft, npd, biped, PERIOD) for kind in (ba.SteppingLoop, ba.CompiledLoop)]
    frozen, exported = ba.FrozenGait.of(biped, gait), ba.Loaded(source_of(Computer(walker)))
    return [
        *(soft, soft.ground, *loops, frozen, ba.specification(walker, frozen)),
        *(exported, exported.source, ba.ExportedController(exported)),
    ]


ELSEWHERE = {
    "Arm",
    "ArmSystem",
    "DesignedGait",
    "GaitLibrary",
    "Push",
    "BipedError",
    "Status",
    "ResetPolicy",
}
"""Made in other tests, or no records."""


def test_everything_fits_a_line(things):
    for thing in things:
        text = repr(thing)
        assert "\n" not in text, type(thing)
        assert len(text) <= LINE, (len(text), text)


def test_no_public_class_is_left_out(things):
    seen = {type(thing).__name__ for thing in things}
    classes = {name for name in ba.__all__ if inspect.isclass(getattr(ba, name))}
    bases = {"Controller", "Disturbance", "Observer", "Outputs", "Reference"}
    bases |= {"ObservingController", "WindowedTorque", "Touchdown"}
    assert classes - bases - ELSEWHERE <= seen
    assert all(
        issubclass(getattr(ba, name), Shown) for name in ("Arm", "ArmSystem", "DesignedGait")
    )


def test_a_class_of_ones_own_fits_too(gait):
    @dataclasses.dataclass(frozen=True)
    class Own(ba.Controller):
        reference: ba.Reference
        gain: float = 2.0
        table: tuple[float, ...] = ()

    assert repr(Own(gait.constraint)).startswith("Own(reference=VirtualConstraint(")
    assert "gain" not in repr(Own(gait.constraint))
    assert repr(Own(gait.constraint, 3.0)).endswith("gain=3.0)")
    assert len(repr(Own(gait.constraint, 3.0, (1.0,) * 1000))) <= LONGEST


def test_a_sentence_of_ones_own_is_kept():
    @dataclasses.dataclass(frozen=True)
    class Told(Shown):
        x: int

        def __repr__(self):
            return "told"

    @dataclasses.dataclass(frozen=True)
    class Below(Told):
        y: int = 0

    assert repr(Told(1)) == repr(Below(1, 2)) == "told"


def test_values_are_shown_as_they_are(biped, gait):
    assert repr(ba.Gains()) == "Gains()"
    assert repr(ba.Gains(1.0, np.array([1.0, 2.0]))) == "Gains(K_p=1.0, K_d=[1 2])"
    assert repr(biped) == f"Biped('rabbit', preset 'identified': n = 5, p = 4, {biped.mass:.4g} kg)"
    assert repr(gait) == "Gait('published', robot 'rabbit', preset 'identified', period 0.4164 s)"
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1)
    assert repr(walk).endswith(
        "NPD on gait 'published', rabbit identified: 1 impact in 0.4164 s, COMPLETED)"
    )
    assert one_line(Scenario("NPD")) == "Scenario(controller='NPD')"
    assert "array(5, 5)" in repr(biped.reduction(*gait.start(biped)))
