"""What was not as it was asked for is said: a push that an impact cuts off, the curve of another gait.

The sentences are the `remarks` of a walk. A push is timed from the start of its single support, which ends with
an impact after 0.4164 s. `walked(*pushes)` is a walk of two impacts under NPD, `pulse(step, start, stop)` a
push of 20 N m on the four actuated joints in that single support.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.disturbances.force import OnLink

pytestmark = pytest.mark.filterwarnings("ignore::biped_adrc.WalkWarning")
TORQUE = [20.0, 20.0, 20.0, 20.0, 0.0]
STEP = 0.4164
"""Duration of a walking step of the undisturbed gait [s]."""


@pytest.fixture(scope="module")
def walked(biped, gait):
    def made(*pushes, impacts=2):
        total = sum(pushes[1:], pushes[0]) if pushes else None
        walker = ba.Walker(biped, ba.NPDController(gait.constraint), total)
        return ba.walk(walker, gait, impacts, engine="compiled")

    return made


def pulse(step, start, stop, amplitude=TORQUE):
    return ba.TorquePulse(amplitude, step=step, start=start, stop=stop)


@pytest.mark.parametrize(
    "push", [pulse(1, 0.1, 0.3), pulse(1, 0.1, math.inf), ba.TorqueSine(TORQUE, frequency=5.0)]
)
def test_a_push_that_acts_as_asked_for_is_passed_over(push, walked):
    """A pulse that ends in its single support, one without an end, and a sine without times: no remark."""
    assert walked(push).remarks == ()


def test_a_push_that_is_cut_off_acts_as_one_without_an_end(walked, biped):
    """A push whose stop lies behind the impact acts until the impact, as one without a stop; only the remark
    tells them apart.
    """
    cut, endless = walked(pulse(1, 0.1, 0.7)), walked(pulse(1, 0.1, math.inf))
    assert np.array_equal(cut.trajectory.final_state, endless.trajectory.final_state)
    end = cut.trajectory.events("foot_strike")[0].t
    assert cut.remarks == (
        f"the push from 0.1 to 0.7 s in single support 1 was cut by the impact at {end:.4f} s",
    )
    # a force of 10 N along x, without one along z and without a moment
    on_link = OnLink(biped, "torso", pulse(2, 0.3, 0.9, [10.0, 0.0, 0.0]))
    assert "from 0.3 to 0.9 s in single support 2 was cut by" in walked(on_link).remarks[0]


def test_a_push_that_begins_after_the_impact_never_acts(walked):
    """The walk ends bit by bit as that without a push, and the remark gives the impact's time; neither has the
    walk a 19th single support."""
    late, none = walked(pulse(1, 0.5, 0.7)), walked()
    assert np.array_equal(late.trajectory.final_state, none.trajectory.final_state)
    assert late.remarks == (
        f"the push from 0.5 to 0.7 s in single support 1 did not begin before the impact at {STEP} s",
    )
    absent = walked(pulse(1, 0.1, 0.2), pulse(19, 0.1, 0.3))
    assert absent.remarks == (
        "the push from 0.1 to 0.3 s in single support 19 did not act: the walk has no single support 19",
    )


@pytest.mark.parametrize("off", [-0.9e-3, 0.0, 0.9e-3])
@pytest.mark.parametrize("step", [None, 1])
def test_an_edge_at_an_impact_is_named(off, step, walked):
    """An edge less than 1 ms before or after the impact, where rounding decides whether it acts; 5 ms before
    it is no case for a remark. step None: in every single support."""
    end = walked().trajectory.events("foot_strike")[0].t
    small = 1e-6 * np.array(TORQUE)  # moves no impact
    (remark,) = walked(pulse(step, 0.1, end + off, small)).remarks
    assert f"edge at {end + off:g} s within 1 ms of the impact at {end:.4f} s" in remark
    assert walked(pulse(step, 0.1, end - 5e-3, small)).remarks == ()


@pytest.fixture(scope="module")
def observed(biped, gait):
    """The largest error and the remarks of a pushed ADRC walk with a step h [s]."""

    def made(bandwidth, h, push=(2, 0.1, 0.3), method=ba.Exponential):
        observer = ba.GPIObserver.from_bandwidth(bandwidth, 4)
        law = ba.ADRCController(gait.constraint, observer)
        walker = ba.Walker(biped, law, pulse(*push))
        walk = ba.walk(walker, gait, 2, None if h is None else method(h), engine="compiled")
        return walk.signals.peak_error, walk.remarks

    return made


def test_a_step_too_long_for_the_observer_is_named_where_it_spoils_the_errors(observed):
    """An integration step longer than 1 / bandwidth makes the peak error wrong by `share`; a shorter one has no
    remark."""
    for bandwidth, h, share in ((5000.0, 5e-4, 3.0), (2000.0, 1e-3, 0.1)):
        exact, silent = observed(bandwidth, 5e-5)
        assert silent == ()
        wrong, remarks = observed(bandwidth, h)
        assert abs(wrong / exact - 1.0) > share
        (remark,) = remarks
        assert f"the step of {1e3 * h:g} ms beside the edges" in remark
        assert f"({1e3 / bandwidth:.2g} ms)" in remark
    right, silent = observed(500.0, 1e-3)
    assert silent == ()
    assert right == pytest.approx(observed(500.0, 5e-5)[0], rel=1e-2)


def test_a_fall_cuts_nothing_off_and_what_comes_after_it_did_not_act(walked):
    """300 N m on the torso end the walk in its first single support: a push that is going on then needs no
    remark, one of step 7 does."""
    fallen = walked(pulse(1, 0.05, 0.9, [0.0, 0.0, 0.0, 0.0, 300.0]), pulse(7, 0.1, 0.3))
    assert not fallen.trajectory.status.ok
    assert not fallen.trajectory.events("foot_strike")
    (remark,) = fallen.remarks
    assert "from 0.1 to 0.3 s in single support 7 did not act" in remark


def test_a_push_without_torque_did_not_act():
    """A push whose torque was left out is 0 N m."""
    walk = ba.walk_scenario(ba.Scenario("NPD", pushes=[{"step": 1}], run={"impacts": 1}))
    assert any("did not act: it was zero" in remark for remark in walk.remarks)


# -- controller and gait --------------------------------------------------------------------------


@dataclass(frozen=True)
class Keeping(ba.Controller):
    """Keeps the integral of the error, and leaves it as it is at an impact."""

    reference: ba.Reference

    def initial_state(self, m):
        return np.zeros(4)

    def flow(self, s, m, u):
        return self.reference(m.t, m.q, m.v).q_d - m.q_b

    def output(self, s, m):
        r = self.reference(m.t, m.q, m.v)
        return 2500.0 * (r.q_d - m.q_b) + 120.0 * (r.dq_d - m.v_b) + 10.0 * s


class Exchanging(Keeping):
    def jump(self, s, after, swap):
        return s[swap]


def test_a_state_without_a_jump_is_named(biped, gait):
    """`Keeping` has one state per joint and does not exchange the legs in it at an impact; `Exchanging`
    differs by that method alone."""
    walks = [ba.walk(ba.Walker(biped, c(gait.constraint)), gait, 1) for c in (Keeping, Exchanging)]
    assert walks[0].remarks == (
        "Keeping has a state and no jump(s, after, swap) to exchange the legs in it at an impact",
    )
    assert walks[1].remarks == ()


def test_the_curve_of_another_gait_is_named(biped, gait):
    """The robot starts on one gait and tracks the curve of another: the remark has the largest distance of
    the two, here on 500 points."""
    other = ba.load_gait("v0.6", biped)
    (remark,) = ba.walk(ba.Walker(biped, ba.NPDController(other.constraint)), gait, 1).remarks
    at = np.linspace(gait.constraint.theta_plus, gait.constraint.theta_minus, 500)
    off = max(np.max(np.abs(other.constraint.h(x)[0] - gait.constraint.h(x)[0])) for x in at)
    assert remark.endswith(f"from that of gait '{gait.name}'")
    assert float(remark.split(" rad")[0].split()[-1]) == pytest.approx(off, rel=0.05)


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_a_start_with_the_swing_foot_in_the_ground_is_named(engine, biped, gait):
    """The pitch turns the robot about its stance foot: the swing foot behind sinks by sin(0.1) of the step."""
    q, v = gait.start(biped)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), slope=gait.slope)
    foot, lean = biped.swing_foot(q), 0.1 * np.eye(5)[4]
    c, s = math.cos(0.1), math.sin(0.1)
    # of a turn in either sense; the foot sinks in one of them and rises in the other
    depth = max(s * foot[0] - c * foot[1], -s * foot[0] - c * foot[1])
    with pytest.warns(ba.WalkWarning, match=f"swing foot {1e3 * depth:.3g} mm below the ground"):
        ba.walk(walker, gait, 1, start=(q + lean, v), engine=engine)
    # turned the other way by 1e-4 rad the foot is above the ground
    lifted = ba.walk(walker, gait, 1, start=(q - 0.001 * lean, v), engine=engine)
    assert lifted.remarks == ()


def test_a_gait_of_another_preset_and_a_push_after_the_walk_are_named(biped, gait):
    """A preset is a set of the robot's masses. A push without `step` is timed in the whole walk, which ends
    before 5 s; one that ends at 9 s acts from 0.1 s on and is no remark."""
    other = ba.Biped.load("rabbit", "tac2003")
    walk = ba.walk(ba.Walker(other, ba.NPDController(gait.constraint)), gait, 1)
    assert walk.remarks == ("gait 'published' was made for rabbit identified",)
    push = ba.TorquePulse([1.0] * 5, start=0.1, stop=9.0) + ba.TorquePulse([1.0] * 5, start=5.0)
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint), push), gait, 1)
    end = f"the walk ended at {walk.trajectory.t_end:.4g} s"
    assert walk.remarks == (f"the push from 5 s on did not act: {end}",)


def test_a_walk_warns_with_each_remark_and_shows_the_first(biped, gait):
    """Each remark is a warning at the line of the caller; the walk's repr has the first one and their number,
    or none."""
    # in single supports 5 and 7, which a walk of one impact never reaches
    late = pulse(5, 0.1, 0.3) + pulse(7, 0.1, 0.3)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), late)
    with pytest.warns(ba.WalkWarning) as caught:
        walk = ba.walk(walker, gait, 1)
    assert tuple(str(x.message) for x in caught) == walk.remarks
    assert [x.filename for x in caught] == [__file__, __file__]
    first, _ = walk.remarks
    assert repr(walk).endswith(f"COMPLETED; {first} (and 1 more in remarks))")
    quiet = ba.walk(ba.Walker(biped, walker.controller), gait, 1)
    assert repr(quiet).endswith("COMPLETED)")
