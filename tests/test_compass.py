"""A compass with a motor at its hip: angle and torque change their sign at an impact, as the legs swap.

Its one actuated coordinate goes from the stance leg to the swing leg, so an impact exchanges no joints but
turns signs. `designed` is a gait that was optimised for it, at 0.5 m/s; `walker(compass, controller)` has a
plant whose hip is 10 % heavier than the model, under a push of 5 N m. `STEP` is the integration method, `LATE`
a clock with a known delay of 2.4 periods, `adrc(constraint)` ADRC at 100 rad/s.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.gait_design import design_gait
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.npid import NPIDController
from biped_adrc.control.super_twisting import SuperTwistingController
from biped_adrc.core.files import data_folder
from biped_adrc.core.tree import flatten
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.loaded import OK, ExportedController
from biped_adrc.extras.export.source import source_of
from biped_adrc.extras.logs.log_file import relabel_legs
from biped_adrc.model.robot_import.import_robot import Hints, derive
from biped_adrc.observers.base import Estimate

RELABEL = ba.ResetPolicy.RELABEL
STEP = ba.RK4(2e-3)
LATE = ba.SampledTime(1.5e-3, delay=3.6e-3, delay_known=True)
PUSH = ba.TorquePulse([5.0, 0.0], step=1, start=0.1, stop=0.2)


@pytest.fixture(scope="module")
def compass():
    """The robot of the registry, with a motor between its legs."""
    path = data_folder("urdf") / "compass" / "floating.urdf"
    found = derive(path, Hints(actuated=("hip_joint",), torque=100.0))
    assert found.broken == ()
    return found.biped


@pytest.fixture(scope="module")
def designed(compass):
    return design_gait(compass, 0.5, limits=ba.StepLimits(clearance=None))


def adrc(constraint):
    return ba.ADRCController(constraint, ba.GPIObserver.from_bandwidth(100.0), reset=RELABEL)


def walker(compass, controller, **more):
    """The walker is on a plant that is heavier than the model knows, under a push."""
    heavy = ba.ModelErrors(mass={"hip": 0.1}).apply(compass)
    return ba.Walker(heavy, controller, PUSH, model=compass, **more)


def test_one_multiplier_of_the_walk_is_that_of_the_zero_dynamics(compass, designed):
    """The largest multiplier of the simulated return map against delta^2 of the design, a quadrature of the
    zero dynamics that knows no controller."""
    gait = designed.gait
    law = ba.Walker(compass, ba.NPDController(gait.constraint))
    x = law.initial_state(gait.q_minus, gait.v_minus)
    # pitch: where the search for the last angle begins, which is near pi for this robot
    found = ba.ReturnMap(law, ba.RK4(5e-4), pitch=math.pi).fixed_point(x)
    assert found.multipliers[0] == pytest.approx(designed.multiplier, rel=1e-6)


HARDWARE = {
    "continuous": {},
    "late": {"timing": LATE, "motors": ba.Motors(lag=2e-3)},
    "touchdown noticed": {
        "timing": ba.SampledTime(2e-3, restart=False),
        "sensors": ba.Sensors(1e5, filter_time=1e-3),
        "touchdown": ba.ByKinematics(after=0.1),
    },
}


@pytest.mark.parametrize(
    ("controller", "hardware"),
    [
        (adrc, "late"),
        (adrc, "touchdown noticed"),
        (NPIDController, "late"),
        (SuperTwistingController, "continuous"),
        (MomentumDOBController, "late"),
    ],
)
def test_both_engines_walk_alike(compass, designed, controller, hardware):
    """Compiled code against Python after each of two impacts. "late": a delay and lagging motors;
    "touchdown noticed": a clock that runs on over touchdowns that the controller has to notice."""
    around = walker(compass, controller(designed.gait.constraint), **HARDWARE[hardware])
    python, code = (
        ba.walk(around, designed.gait, 2, STEP, engine=engine).trajectory
        for engine in ("pinocchio", "compiled")
    )
    assert python.status is code.status is ba.Status.COMPLETED
    assert code.settings["engine"] == "compiled"
    for one, other in zip(python.arcs, code.arcs, strict=True):
        assert other.event.x_plus == pytest.approx(one.event.x_plus, rel=1e-9, abs=1e-9)


@dataclass(frozen=True)
class OfTheLeftLeg(ba.ADRCController):
    """Its observer sees the angle from the left leg to the right one, which no impact changes."""

    def side(self, m):
        return 1.0 if m.step % 2 == 1 else -1.0

    def measured_output(self, m):
        return Estimate(*(self.side(m) * x for x in super().measured_output(m)))

    def observer_input(self, m, u):
        return self.side(m) * super().observer_input(m, u)

    def torque(self, r, x, m):
        return super().torque(r, Estimate(*(self.side(m) * y for y in x)), m)

    def jump(self, s, after, swap):
        return s


def test_an_observer_that_is_relabelled_sees_what_one_of_the_left_leg_sees(compass, designed):
    """`law` turns the signs of its states at impacts; `OfTheLeftLeg` takes the angle from the left leg to the
    right one, which no impact changes, and never turns a sign. Both have to walk the same."""
    law = adrc(designed.gait.constraint)
    ends = [
        ba.walk(walker(compass, x), designed.gait, 2, STEP, engine="pinocchio").trajectory
        for x in (law, OfTheLeftLeg(**vars(law)))
    ]
    one, other = (end.final_state for end in ends)
    np.testing.assert_allclose(other[:4], one[:4], rtol=1e-12)
    # after two impacts the left leg stands again
    np.testing.assert_allclose(other[4:], one[4:], rtol=1e-12)


def test_a_motor_with_lag_keeps_its_torque_on_the_legs_over_an_impact(compass, designed):
    """The motor's torque cannot jump; the coordinate turns its sign, so all numbers of the line (delay and
    lag) do. Above 0.1 N m a missing sign would show."""
    around = walker(compass, adrc(designed.gait.constraint), **HARDWARE["late"])
    run = ba.walk(around, designed.gait, 2, STEP).trajectory
    for event in run.events("foot_strike"):
        before, after = (parts(around, x).tail.line for x in (event.x_minus, event.x_plus))
        assert np.abs(before.u_m) > 0.1
        np.testing.assert_array_equal(flatten(after), -flatten(before))


def test_the_exported_controller_walks_over_impacts(compass, designed):
    """The C code walks as Python does. A touchdown exchanges the legs, so the one torque changes its sign;
    where nothing is measured (NaN) it is held. x_plus[-4:] are the numbers of delay and motors."""
    late = {"timing": LATE, "motors": ba.Motors(rate_limit=2e4)}
    around = walker(compass, adrc(designed.gait.constraint), **late)
    by_c = ExportedController(source_of(Computer(around)))
    ends = [
        ba.walk(x, designed.gait, 2, STEP, engine="pinocchio").trajectory
        for x in (around, replace(around, controller=by_c))
    ]
    for one, other in zip(*(end.events("foot_strike") for end in ends), strict=True):
        assert other.t == pytest.approx(one.t, rel=1e-9)
        np.testing.assert_allclose(other.x_plus[:4], one.x_plus[:4], rtol=1e-9)
        np.testing.assert_allclose(other.x_plus[-4:], one.x_plus[-4:], rtol=1e-8, atol=1e-8)
    c, (q, v) = by_c.loaded, designed.gait.start(compass)
    _, x = c.init(c.measured(0.0, q, v))
    _, u = c.step(x, c.measured(0.0, q, v))
    assert c.touchdown(x, c.measured(1e-3, q, v)) == OK
    _, held = c.step(x, c.measured(np.nan, q, v))
    assert np.abs(u) > 1.0
    np.testing.assert_array_equal(held, -u)


def test_a_log_in_the_labels_of_its_own_legs_comes_back(compass):
    """Relabelling is its own inverse; on the second leg, `legs` = 2, the torque changes its sign."""
    q, v, u = (np.random.default_rng(3).normal(size=(6, k)) for k in (2, 2, 1))
    legs = np.array([1.0, 2.0, 2.0, 1.0, 2.0, 1.0])
    there = relabel_legs(legs, q, v, u, compass)
    np.testing.assert_array_equal(there[2][legs == 2.0], -u[legs == 2.0])
    for found, given in zip(relabel_legs(legs, *there, compass), (q, v, u), strict=True):
        np.testing.assert_allclose(found, given, atol=1e-15)


@dataclass(frozen=True)
class ForgetsTheSign(ba.NPDController):
    def initial_state(self, m):
        return np.zeros(1)

    def flow(self, s, m, u):
        return m.q_b

    def jump(self, s, after, swap):
        return s[swap]


@pytest.mark.parametrize("engine", ["pinocchio", "compiled"])
def test_a_controller_of_ones_own_that_forgets_the_sign_is_told(compass, designed, engine):
    """The controller's `jump` exchanges the entries of an angle that it keeps, by s[swap], but does not turn
    the sign: the walk has to end and name the method.
    """
    law = ForgetsTheSign(designed.gait.constraint)
    run = ba.walk(ba.Walker(compass, law), designed.gait, 1, STEP, engine=engine).trajectory
    assert not run.status.ok
    assert "ForgetsTheSign.jump" in str(run.detail)
