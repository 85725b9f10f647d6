"""One suite over every leaf of the package, `conforms`, a row for each.

A leaf is a class that fills one place of a walker. `conforms(thing)` (in conforms.py) asserts all that the base
class of a thing promises, in Python and as machine code. A row says how a thing of the registry, the list of
names that a scenario may use, is made: `made(kind, name)` makes the things of a row. A thing without a row, or
a class that no row makes, fails.
"""

import importlib
import inspect
import pkgutil
import sys
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import lru_cache

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.around import AddedTorque
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.pd_gravity import JointGains
from biped_adrc.control.stride import TORSO_LEAN, StrideGains
from biped_adrc.core.errors import InputError
from biped_adrc.core.registry import find, names
from biped_adrc.disturbances.force import AddedForce
from biped_adrc.gait.constraint import CorrectedConstraint, continued
from biped_adrc.gait.curves import BSpline, Curve
from biped_adrc.gait.outputs import FunctionOutputs, LinearOutputs, Outputs
from biped_adrc.gait.reference import TimeReference, ZeroReference
from biped_adrc.hardware.motors import IDEAL, Motors
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.touchdown import Touchdown
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.model.planar import link_point
from biped_adrc.observers.momentum import MomentumObserver

from .conforms import PERIOD, SLOW, conforms, gait, heavy, loop_compiles, outputs, robot, written

A = [30.0, -20.0, 5.0, 0.0, 1.0]
HELD, PULLED = [A, np.zeros(5)], [[9.0, 1.0], [0.0, 0.0]]
THREE = (-90.0, -60 + 20j, -60 - 20j)

# -- rows: how a thing of the registry is made --------------------------------------------------
ROWS = {
    "controller": {
        "PD": lambda make, h: [make(h), make(h, JointGains([1e3, 2e3, 3e3, 4e3], 50.0))],
        "NPD": lambda make, h: [make(h), make(h, solve_theta=False)],
        "NPID": lambda make, h: [make(h), make.like_adrc(h)],
        "super twisting": lambda make, h: [make(h)],
        "ADRC": lambda make, h: [
            make(h),
            make(h, ba.GPIObserver.from_bandwidth(300.0, 0), ba.Gains([4e3, 5e3, 6e3, 7e3], 50.0)),
        ],
        "ADRC output": lambda make, h: [make(h, SLOW, reset=ba.ResetPolicy.MEASURED)],
        "ADRC b0": lambda make, h: [make(h), make.from_bandwidth(h, 20.0, 150.0, 2, b_0=0.7)],
        "LESO": lambda make, h: [make(h, ba.GPIObserver.from_bandwidth(500.0))],
        "ADRC assisted": lambda make, h: [make(h)],
        "DOB": lambda make, h: [
            make(h),
            make(h, MomentumObserver.from_poles(THREE), solve_theta=False),
        ],
        "CLF-QP": lambda make, h: [make(h)],
        "output NPD": lambda make, h: [make(outputs(h))],
        "finite time": lambda make, h: [make(outputs(h), 0.9, 0.02)],
        "stride PI": lambda make, h: [
            ba.StridePI(ba.NPDController(h), 0.7, 0.3, TORSO_LEAN, StrideGains(-1.0, -0.4))
        ],
        "footstep": lambda make, h: [
            make(ba.NPDController(h), gait(), robot(), "flat", stones=(0.3, 0.5)),
            make(ba.NPDController(h), gait(), robot(), speeds=(0.5, 0.7, 0.6)),
        ],
        "reference reset": lambda make, h: [make(ba.ADRCController(h))],
        "foot barrier": lambda make, h: [
            make(ba.NPDController(h), robot()),
            make(ba.ADRCController(h, SLOW), robot(), (0.3, 0.5), 0.4),
        ],
        "delayed": lambda make, h: [make(ba.ADRCController(h, SLOW), 2e-3)],
        "passive": lambda make, h: [make()],
    },
    "contact": {
        "hold": lambda make, h: [make(ba.ADRCController(h, SLOW), 0.2), make(ba.NPDController(h))],
        "impact invariant": lambda make, h: [
            make(ba.NPDController(h), 0.07),
            make(MomentumDOBController(h), 0.2, innovation=True),
        ],
    },
    "around": {
        "prediction": lambda make, h: [make(ba.ADRCController(h, SLOW), 2.3e-3)],
        "feedforward": lambda make, h: [make(ba.ADRCController(h, SLOW), h, robot(), 0.8)],
    },
    "observer": {
        "GPI": lambda make: [make.from_poles(), make.from_bandwidth(300.0, 0)],
        "high gain": lambda make: [make.from_epsilon(0.002), make.from_epsilon(0.01, m=2)],
        "Kalman": lambda make: [make.from_noise(100.0, 1e-5), make.from_noise(1e3, 1e-4, m=2)],
        "half gain": lambda make: [make.from_bandwidth(150.0), make.from_bandwidth(300.0, 0)],
        "cascade": lambda make: [
            make.from_bandwidth(60.0),
            make.from_bandwidth(40.0, 2, levels=3, ratio=2.0),
        ],
        "internal model": lambda make: [
            make.from_bandwidth(150.0, 8.0),
            make.from_bandwidth(90.0, 20.0, 0),
        ],
        "bounded": lambda make: [
            make.from_bandwidth(200.0, 150.0),
            make(ba.GPIObserver.from_bandwidth(90.0, 2), 9.0),
        ],
        "momentum": lambda make: [make.from_bandwidth(9.0, 3), make.from_poles(THREE)],
        "behind filter": lambda make: [
            make.from_bandwidth(200.0, 3e-3),
            make.from_bandwidth(90.0, 5e-3, 0),
        ],
    },
    "sensor": {
        "pitch sensor": lambda make: [
            make(0.01, -0.02),
            ba.Sensors(512) + make(noise=1e-3, seed=2),
        ],
        "encoders": lambda make: [
            make(8192.0, noise=5e-5, rate_noise=0.01, filter_time=2e-3, seed=3),
            make(64.0, velocity="gyro", pitch_noise=1e-3, seed=4),
        ],
    },
    "touchdown": {
        "faulty": lambda make: [make(4e-3), make(missed=0.5, seed=2), make(false_at=(1, 0.2))],
        "force": lambda make: [make(), make(debounce=2e-3, delay=1e-3, on=30.0)],
        "kinematics": lambda make: [make(), make(height=5e-3, ahead=0.0, slope=0.01)],
    },
    "disturbance": {
        "pulse": lambda make: [
            make(A, step=2, start=0.1, stop=0.2),
            make(A, step=2, start=0.1, stop=0.2, rise=0.04),
            ba.OnLink(robot(), "right_shin", make(A[:3], step=2, start=0.1, stop=0.2), (0.1, 0.2)),
        ],
        "step": lambda make: [make(A, step=2, start=0.1), make(A) + make(A, step=3)],
        "sine": lambda make: [make(A, start=0.3, frequency=5.0)],
        "noise": lambda make: [
            make(A, step=2, start=0.1, stop=0.3, bandwidth=10.0, seed=1, sines=4)
        ],
        "recorded": lambda make: [make(written("t,q1,q5\n0,1,2\n.1,3,-4\n.7,0,0"), robot(), 2)],
        "hand": lambda make: [make(robot(), 2, [0.1, 0.2], HELD, "torso", (0.0, 0.3), PULLED)],
        "hip force": lambda make: [make(robot(), (-3.0, 1.0), steps=(2, 3))],
    },
    "curve": {
        "bezier": lambda make: [make(np.random.default_rng(1).normal(size=(4, 6)))],
        "bspline": lambda make: [
            make(np.random.default_rng(k).normal(size=(4, k))) for k in (4, 9)
        ],
        "polynomial": lambda make: [make(np.random.default_rng(1).normal(size=(4, 6)))],
    },
}
UNNAMED = {
    "virtual constraint": lambda h: [continued(with_curve(h, BSpline(h.curve.coefficients)))],
    "corrected constraint": lambda h: [
        CorrectedConstraint(h, leaning),
        CorrectedConstraint(CorrectedConstraint(continued(h), leaning), leaning),
    ],
    "time": lambda h: [TimeReference(swung)],
    "zero": lambda h: [ZeroReference(4)],
    "linear outputs": lambda h: [outputs(h), LinearOutputs(ABSOLUTE, h)],
    "outputs of a function": lambda h: [FunctionOutputs(bent)],
    "added torque": lambda h: [AddedTorque(ba.ADRCController(h), np.full(4, 2.0))],
    "added force": lambda h: [
        AddedForce(np.array([20.0, -5.0]), link_point(robot(), robot().description.trunk))
    ],
    "RK4": lambda h: [ba.RK4(2e-3)],
    "adaptive": lambda h: [ba.Adaptive(1e-9, 1e-9)],
    "exponential": lambda h: [ba.Exponential(1e-3)],
    "motors": lambda h: [Motors(), Motors(2e4, 1e-3)],
}
"""Rows of what no scenario names."""
ABSOLUTE = np.array([[1, 0, 0, 0, 1], [0, 1, 0, 0, 1], [1, 0, 1, 0, 1], [0, 1, 0, 1, 1.0]])
IN_PYTHON = {"CLF-QP", "output NPD", "finite time"}
"""Controllers that call a solver of their own; all other things of the registry compile."""
EACH = [(kind, name) for kind, rows in ROWS.items() for name in rows]
PARTS_OF_CONTROL = {"OuterLoop", "ObservingController", "AbsentController", "WithPeriod"}
PARTS_OF_CONTROL |= {"Around", "AcrossContact", "ContactWindow", "DoubleSupport"}
BASES = {
    ba.Controller: ("control", PARTS_OF_CONTROL),
    ba.Observer: ("observers", {"ChainObserver", "InjectedChain", "BehindChain"}),
    ba.Disturbance: (
        "disturbances",
        {"Windowed", "WindowedTorque", "Lines", "HeldRows", "AbsentDisturbance"},
    ),
    ba.Reference: ("gait", {"Shifted"}),
    Outputs: ("gait", set()),
    OneStepMethod: ("hybrid", {"Solver"}),
    Sensor: ("hardware", set()),
    Touchdown: ("hardware", {"Gated"}),
    Curve: ("gait", {"ControlledCurve"}),
}
"""Where leaves are, and what is only a part of them or stands for one that is not there."""


def with_curve(h, curve):
    return ba.VirtualConstraint(curve, h.phase, h.theta_plus, h.theta_minus)


def leaning(theta):
    """A correction and its two derivatives."""
    d = np.array([0.1, 0.1, 0.0, -0.05])
    return d * np.sin(3.0 * theta), 3.0 * d * np.cos(3.0 * theta), -9.0 * d * np.sin(3.0 * theta)


def swung(t):
    """Angles about those of the gait, as a function of time."""
    d, q = np.array([0.3, -0.2, 0.1, 0.05]), gait().start(robot())[0][:4]
    return q + d * np.sin(5.0 * t), 5.0 * d * np.cos(5.0 * t), -25.0 * d * np.sin(5.0 * t)


def bent(q):
    """Outputs that are not linear."""
    return np.sin(q[:4])


def made(kind, name):
    """The things of a row."""
    given = (gait().constraint,) if kind in ("controller", "contact", "around") else ()
    return ROWS[kind][name](find(kind, name).load(), *given)


@pytest.mark.parametrize(("kind", "name"), EACH)
def test_every_part_of_the_registry_conforms(kind, name):
    """`conforms` asserts the promises; of a controller it returns whether it compiled, of other things None.
    Only the controllers of IN_PYTHON, which call a solver of their own, do not compile.
    """
    for thing in made(kind, name):
        compiled = conforms(thing)
        assert compiled in (None, name not in IN_PYTHON)


def test_a_leaf_equals_another_of_the_same_values():
    """A thing is made twice: the second is found in a dict by the first, so both are equal and have one hash.
    Things that hold a Python function are left out: it has no values.
    """
    for each in EACH:
        for thing, other in zip(made(*each), made(*each), strict=True):
            if not callable(getattr(thing, "function", None)):
                assert {thing: 1}[other] == 1


def test_parts_compare_by_class_and_values():
    """Arrays count by value (NaN equals NaN, -0.0 equals 0.0), by type and shape; so equal walkers, made twice,
    share what is cached for one (`lru_cache`).
    """

    @dataclass(frozen=True)
    class Own(ba.Reference):
        w: np.ndarray
        inside: ba.Disturbance | None = None

        def __call__(self, t, q, v):
            raise NotImplementedError

    @dataclass(frozen=True)
    class Other(Own):
        pass

    push = ba.TorquePulse([30, 30, 30, 30, 0], step=2, start=0.1, stop=0.3)
    w = np.array([1.0, np.nan, 0.0])
    # the third has -0.0 in place of 0.0
    same = [Own(w, push), Own(w.copy(), replace(push)), Own(-(-w + 0.0) * 1.0, push)]
    unlike = [
        Own(w.astype(np.float32), push),
        Own(w[np.newaxis], push),
        Own(np.array([1.0, 2.0, 0.0]), push),
        Own(w, replace(push, amplitude=push.amplitude + 1.0)),
        Own(w),
        Other(w, push),
    ]
    assert len(set(same)) == 1
    assert len({*same, *unlike}) == 1 + len(unlike)
    assert Own(w) != w  # a part does not equal the array in it

    def walker():
        biped = ba.Biped.load("rabbit")
        law = ba.ADRCController(ba.load_gait("published", biped).constraint)
        return ba.Walker(biped, law, replace(push), timing=ba.SampledTime(1e-3))

    calls = lru_cache(lambda walker: object())
    assert calls(walker()) is calls(walker())
    assert calls(walker()) is not calls(replace(walker(), slope=0.01))


@pytest.mark.parametrize("name", ROWS["controller"])
def test_a_controller_refuses_what_is_no_reference(name):
    """A `__post_init__` of its own has to call that of the base, which looks at all fields."""
    for thing in made("controller", name):
        if is_dataclass(thing) and "reference" in {x.name for x in fields(thing)}:
            # a gait, which only contains a reference; a class in place of an object; gains
            for wrong in (gait(), ba.VirtualConstraint, ba.TABLE_II):
                with pytest.raises(InputError, match="expected a Reference"):
                    replace(thing, reference=wrong)


@pytest.mark.parametrize("thing", [ba.TorqueStep([1.0] * 5), ba.Sensors(counts=1000)])
def test_only_things_of_one_kind_are_added_up(thing):
    """A disturbance plus a disturbance and a sensor plus a sensor are sums; a number, a class and a gait are
    refused.
    """
    for wrong in (1, type(thing), gait()):
        with pytest.raises(InputError, match="what is added to"):
            thing + wrong


@pytest.mark.parametrize("name", UNNAMED)
def test_every_part_outside_the_registry_conforms(name):
    """Classes that no scenario names, such as outputs and methods of integration."""
    for thing in UNNAMED[name](gait().constraint):
        conforms(thing)


def test_output_adrc_with_the_gains_of_table_one_compiles_in_the_loop():
    """`loop_compiles` compares flow, ticks and impacts of the closed loop in machine code with Python's, at
    random states, on a plant heavier than the model. The gains of Table I turn the last bit of an angle into
    1e-9 of a rate, so the loop is compared and not each method.
    """
    law = OutputADRCController(gait().constraint)
    for timing in (ba.ContinuousTime(), ba.SampledTime(PERIOD)):
        walker = ba.Walker(heavy(), law, timing=timing, model=robot(), torque_limit=150.0)
        loop_compiles(walker)


def acting(motors):
    """Names of the fields that are not those of ideal motors."""
    return [x.name for x in fields(Motors) if getattr(motors, x.name) != getattr(IDEAL, x.name)]


def below(cls):
    for child in cls.__subclasses__():
        yield child
        yield from below(child)


def test_every_leaf_has_a_row_and_a_name():
    """The rows have all names of the registry, and make every concrete subclass of the classes in BASES that
    the package's folders define; so no leaf is left untested.
    """
    # robots and gaits are files, which `names` finds without a line in the list of names
    assert "compass" in names("robot")
    assert "published-identified" in names("gait")
    for kind, rows in ROWS.items():
        assert set(rows) == set(names(kind))
        assert all(find(kind, name).words for name in rows)  # each name has a description
    things = [thing for each in EACH for thing in made(*each)]
    things += [thing for row in UNNAMED.values() for thing in row(gait().constraint)]
    # each field of Motors differs from its default in some row
    acted = [name for x in things if isinstance(x, Motors) for name in acting(x)]
    assert set(acted) == {x.name for x in fields(Motors)}
    listed = {type(thing) for thing in things}
    # the discrete forms of observers and sensors are classes of their own
    listed |= {type(x.sampled(PERIOD)) for x in things if isinstance(x, ba.Observer)}
    listed |= {type(x.sampled(5, 4, PERIOD)) for x in things if isinstance(x, Sensor)}
    for base, (room, parts) in BASES.items():
        package = importlib.import_module(f"biped_adrc.{room}")
        for module in pkgutil.iter_modules(package.__path__):
            importlib.import_module(f"biped_adrc.{room}.{module.name}")
        own = [cls for cls in below(base) if cls.__module__.startswith("biped_adrc.")]
        # classes of an export stand for other leaves
        own = [cls for cls in own if ".export." not in cls.__module__]
        # only classes that are in their module by name, not those that a function makes
        own = [cls for cls in own if getattr(sys.modules[cls.__module__], cls.__name__, 0) is cls]
        leaves = {cls for cls in own if cls.__name__ not in parts}
        assert not [cls for cls in leaves if inspect.isabstract(cls)]
        assert leaves <= listed, leaves - listed
