"""Numerics guard themselves: a run that explodes ends in a status, and no NaN or infinity is stored.

RAN_AWAY is the end of a run whose joint is faster than `runaway_speed` (20) times 50 rad/s, or whose torque
is above `runaway_torque` times the robot's peak torque (150 N m for RABBIT). The engines are compiled code
and Python on Pinocchio, and both have to end alike.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.delayed import Delayed
from biped_adrc.engine.run import simulate_by
from biped_adrc.hybrid import integrators
from biped_adrc.hybrid.integrators import RK4, Adaptive
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.system import Guard, HybridSystem
from biped_adrc.scenario.integration import default_method, rate_of_law

from .plain import Undecorated

ENGINES = ("compiled", "pinocchio")


def all_finite(run):
    """Whether every number that a trajectory keeps is finite."""
    states = [x for e in run.events() for x in (e.x_minus, e.x_plus) if x is not None]
    nodes = [rows for arc in run.arcs for rows in (arc.t, arc.x, arc.dx)]
    return all(np.all(np.isfinite(x)) for x in (*nodes, *states, run.final_state))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("controller", "push"), [("ADRC", "q5=300@1:0.02-"), ("NPD", "q1,q2,q3,q4,q5=120@1:0.02-")]
)
def test_a_walk_that_explodes_has_run_away(tmp_path, engine, controller, push):
    """A push that throws the robot out of its gait: all numbers stay finite and below the bound of 20 * 50
    rad/s, and the stored walk knows its end."""
    s = ba.Scenario(controller, pushes=push, run={"impacts": 1, "engine": engine})
    made = ba.walk_scenario(s)
    run = made.trajectory
    assert run.status is ba.Status.RAN_AWAY
    assert not run.status.ok
    assert all_finite(run)
    assert max(np.max(np.abs(arc.x[:, 5:10])) for arc in run.arcs) <= 20.0 * 50.0
    outcome = made.outcome
    assert not outcome.walked
    assert math.isfinite(outcome.peak_error)
    assert math.isfinite(outcome.peak_torque)
    made.save(tmp_path / "run.npz")
    again = ba.load_walk(tmp_path / "run.npz")
    assert again.trajectory.status is ba.Status.RAN_AWAY
    assert again.walker.runaway_speed == 20.0


@pytest.mark.parametrize(
    ("timing", "plain"), [(ba.ContinuousTime(), False), (ba.SampledTime(1e-3), True)]
)
def test_the_bounds_are_the_walkers(biped, gait, timing, plain):
    """At 0.7 of a walk's peak torque or rate they end it, before the step's end at 0.4 s and alike in both
    engines; at 1.01 of the peaks, which the walk does not reach, it is completed. plain: by a law that
    cannot be compiled."""
    law = ba.NPDController(gait.constraint)
    walker = ba.Walker(biped, Undecorated(law) if plain else law, timing=timing)
    # in the units of the bounds, the motors' 150 N m and 50 rad/s
    peak = np.max(np.abs(ba.walk(walker, gait, impacts=1).signals.u)) / 150.0
    fast = np.max(np.abs(ba.walk(walker, gait, impacts=1).trajectory.arcs[0].x[:, 5:10])) / 50.0
    for bound in ({"runaway_torque": 0.7 * peak}, {"runaway_speed": 0.7 * fast}):
        ends = [
            ba.walk(replace(walker, **bound), gait, impacts=1, engine=e).trajectory for e in ENGINES
        ]
        assert [run.status for run in ends] == [ba.Status.RAN_AWAY] * 2
        assert all(all_finite(run) for run in ends)
        assert abs(ends[0].t_end - ends[1].t_end) < 1e-9
        assert ends[0].t_end < 0.4
    free = replace(walker, runaway_torque=1.01 * peak, runaway_speed=1.01 * fast)
    assert ba.walk(free, gait, impacts=1).trajectory.status is ba.Status.COMPLETED
    with pytest.raises(ba.BipedError, match="runaway_speed is nan"):
        replace(walker, runaway_speed=math.nan)


def test_what_a_joint_states_does_not_move_the_bound_at_which_a_walk_has_run_away(biped, slow_knee):
    """`slow_knee` states 2 rad/s for one knee: that makes a walk infeasible, and is no explosion."""
    for robot in (biped, slow_knee):
        assert np.array_equal(
            ba.Walker(robot, ba.Passive()).bounds.fastest, np.full(5, 20.0 * 50.0)
        )


@pytest.mark.parametrize("method", [ba.Exponential(1e-3), Adaptive()])
def test_a_torque_beyond_the_bound_ends_a_run_of_every_method(biped, gait, method):
    """The bound is 0.1 * 150 = 15 N m, less than the gait needs at once."""
    law = ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(300.0))
    walker = ba.Walker(biped, law, runaway_torque=0.1)
    for engine in ENGINES:
        run = ba.walk(walker, gait, impacts=1, method=method, engine=engine).trajectory
        assert run.status is ba.Status.RAN_AWAY
        assert all_finite(run)


def test_robots_without_motors_run_away_by_their_speed_alone():
    """No motor, so the bound on torque is infinite; 0.02 * 50 = 1 rad/s is less than the compass's legs
    swing."""
    assert ba.Walker(ba.Biped.load("compass"), ba.Passive()).bounds.strongest == math.inf
    for engine in ENGINES:
        s = ba.Scenario(
            "passive", robot="compass", run={"impacts": 1, "engine": engine, "runaway_speed": 0.02}
        )
        assert ba.walk_scenario(s).trajectory.status is ba.Status.RAN_AWAY


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("timing", [ba.ContinuousTime(), ba.SampledTime(1e-3)])
def test_a_joint_that_turns_all_the_way_round_ends_the_walk(biped, gait, engine, timing):
    """The swing leg starts 100 rad/s faster and whirls about the hip, over a hole of 3 m in which it meets no
    ground; motors of 1 N m do not hold it. The walk ends just before q2 = 2 pi, a whole turn."""
    hole = (ba.StepDown(1, 3.0),)
    law = ba.NPDController(gait.constraint)
    walker = ba.Walker(biped, law, timing=timing, torque_limit=1.0, ground_steps=hole)
    q, v = gait.start(biped)
    v = v + 100.0 * np.eye(5)[1]
    run = ba.walk(walker, gait, 1, ba.RK4(1e-4), start=(q, v), engine=engine).trajectory
    assert run.status is ba.Status.RAN_AWAY
    assert "q2 is 6.2" in run.detail
    assert "rad, beyond a whole turn" in run.detail
    farthest = np.max(np.abs(run.final_state[:5]))
    assert 2.0 * np.pi - 0.05 < farthest <= 2.0 * np.pi


class Falling(HybridSystem):
    """x' = -1, with a slope, a witness or a reset that is lost at some time or state."""

    def __init__(self, slope_until=math.inf, reset_to=0.5, seen_until=-math.inf):
        self.slope_until, self.reset_to, self.seen_until = slope_until, reset_to, seen_until

    def flow(self, t, x, mode):
        return np.array([-1.0 if t < self.slope_until else math.nan])

    def guards(self, mode):
        def height(t, x):
            return x[0] if x[0] > self.seen_until else math.nan

        return (Guard("ground", height, lambda t, x: (np.array([self.reset_to]), mode)),)


@pytest.mark.parametrize("method", [RK4(0.1), Adaptive()])
@pytest.mark.parametrize(
    "system",
    [
        Falling(slope_until=0.25),
        Falling(reset_to=math.nan),
    ],
)
def test_what_is_not_finite_ends_a_run_and_is_not_kept(system, method):
    """x' = -1 from 0.32: its slope is NaN from 0.25 s on, or the reset at x = 0 gives NaN. Neither is stored,
    as node or as event, and the run says why it ended."""
    run = simulate(system, np.array([0.32]), 0, method, t_end=2.0)
    assert run.status in (ba.Status.NOT_FINITE, ba.Status.STEP_FAILED)
    assert all_finite(run)
    assert run.events() == ()
    assert run.detail


def test_a_controller_faster_than_the_usual_step_gets_a_shorter_one(biped, gait):
    """The step is 1 over the fastest pole of the delay's approximant; 1 ms, the usual one, is unstable
    there."""
    observer = ba.GPIObserver.from_bandwidth(300.0)
    walker = ba.Walker(biped, Delayed(ba.ADRCController(gait.constraint, observer), 2e-4))
    # the fastest pole [1/s] of the Pade approximant of a delay of 0.2 ms
    line = np.abs(np.roots(walker.controller.pade[1][::-1])).max() / 2e-4
    assert rate_of_law(walker) == pytest.approx(line, rel=1e-3)
    assert default_method(walker).h == pytest.approx(1.0 / line, rel=1e-3)
    assert not ba.walk(walker, gait, impacts=1, method=RK4(1e-3)).trajectory.status.ok
    assert ba.walk(walker, gait, impacts=1).trajectory.status.ok
    assert default_method(ba.Walker(biped, ba.NPDController(gait.constraint))) == RK4(1e-3)
    # a delay of 4 ms has poles slow enough for 1 ms
    slow = Delayed(ba.ADRCController(gait.constraint, observer), 4e-3)
    assert default_method(replace(walker, controller=slow)) == RK4(1e-3)


@pytest.mark.filterwarnings("ignore:the start has the swing foot 20 mm below the ground")
@pytest.mark.parametrize("observer", [None, ba.GPIObserver.from_bandwidth(300.0)])
def test_static_friction_on_little_inertia_gets_a_shorter_step(bare, published, observer):
    """The smoothed sign of dry friction turns within 0.05 rad/s, which is stiff without rotor inertias: with
    the default step the end of a walking step is within 5e-7 of that with 20 us, with the usual one it is
    not."""
    constraint = published.constraint
    controller = (
        ba.ADRCController(constraint, observer) if observer else ba.NPDController(constraint)
    )
    rubbing = ba.Biped.load("rabbit", "identified-bare", friction=True)
    walker, (q, v) = ba.Walker(rubbing, controller), published.start(bare)
    method = default_method(walker)

    def ends(h):
        # 1.02 q is off the gait's curve: rates of joints change their sign more often
        made = ba.walk(walker, published, 1, replace(method, h=h), start=(1.02 * q, v))
        return made.trajectory.final_state[:10]

    # type(method)(): the same method with its usual step
    assert method.h < type(method)().h == default_method(replace(walker, plant=bare)).h
    assert (
        np.max(np.abs(ends(method.h) - ends(2e-5)))
        < 5e-7
        < np.max(np.abs(ends(type(method)().h) - ends(2e-5)))
    )


class Switching(ba.NPDController):
    """Of every joint's torque 20 N m change their sign with the rate: a sliding mode without a layer."""

    def output(self, s, m):
        return super().output(s, m) - 20.0 * np.sign(m.v_b)


@pytest.mark.parametrize("engine", ENGINES)
def test_steps_that_a_switching_torque_makes_tiny_end_a_run(biped, gait, engine, monkeypatch):
    """Dry friction without a layer chatters: without a limit a method with step control makes several millions
    of steps. CROWDED (1000, here 200) of them that are shorter than 1 us on average end the run."""
    monkeypatch.setattr(integrators, "CROWDED", 200)
    q, v = gait.start(biped)
    walker = ba.Walker(biped, Switching(gait.constraint))
    # from rest, where a rate may change its sign at once
    run = ba.walk(
        walker, gait, 1, Adaptive(1e-10, 1e-12), start=(q, 0.0 * v), engine=engine
    ).trajectory
    assert run.status is ba.Status.STEP_FAILED
    assert len(run.arcs[-1].t) < 5 * integrators.CROWDED
    assert all_finite(run)


@dataclass(frozen=True)
class TimesZero(ba.Controller):
    """Zero where the gain is a number."""

    K_p: float

    def output(self, s, m):
        return 0.0 * self.K_p * m.q[:4] + m.terms.Omega[:4]


def test_a_gain_that_is_nan_is_nan_in_both_engines(biped, gait):
    """0 * NaN is NaN; symbolic code could simplify 0 * K_p to 0 and walk on with a gain that is no number."""
    walker = ba.Walker(biped, TimesZero(math.nan))
    x = np.concatenate(gait.start(biped))
    for engine in ENGINES:
        run = simulate_by(engine, walker, x, ba.Mode(), RK4(), t_end=0.1)
        assert run.status is ba.Status.NOT_FINITE
        assert all_finite(run)


# -- rounding -------------------------------------------------------------------------------------
COUNTED = {
    "controller.name": "reference reset",
    "run.impacts": 3,
    "run.seed": 368,
    "hardware.period": 0.0011633571256965862,
    "hardware.encoders.counts": 50000,
    "hardware.encoders.velocity": "differences",
    "hardware.touchdown.name": "force",
    "errors.mass_width": 0.17140917491665197,
}
"""A walk in which a count of an encoder flips with the last digit, and the end of the walk by 44 ms."""


def test_a_walk_that_rounding_decides_says_so():
    """`rounding` is the distance at the end of two walks that start 1e-12 apart. In `COUNTED`, found by a
    search, an encoder count flips with the last digit, and they end more than 1e-3 apart."""
    assert ba.walk_scenario(ba.Scenario(**COUNTED)).rounding() > 1e-3


@pytest.mark.parametrize("controller", ["NPD", "ADRC"])
def test_neighbours_of_a_smooth_walk_stay_together_at_any_step(controller, biped, gait):
    """Walks that start 1e-12 apart end less than 1e-10 apart, also with an integration step of 20 ms, which
    is so long that half of it makes another walk: `rounding` is not the error of the method."""
    walk, half = (
        ba.walk_scenario(ba.Scenario(controller, run={"impacts": 3, "h": h})) for h in (0.02, 0.01)
    )
    assert abs(walk.trajectory.t_end - half.trajectory.t_end) > 1e-6
    assert walk.rounding() < 1e-10


def test_the_distance_of_neighbours_is_that_of_the_linear_map(bare, published):
    """`rounding` starts a walk 1e-12 off, in the direction cos(k) of coordinate k. 1e-6 off in the same
    direction a million times as much has to be left after three impacts, in times and angles."""
    walker = ba.Walker(bare, ba.NPDController(published.constraint))
    walk = ba.walk(walker, published, 3)
    q, v = published.start(bare)
    d = 1e-6 * np.cos(np.arange(10.0))
    other = ba.walk(walker, published, 3, start=(q + d[:5], v + d[5:]))
    rows = [[(a.t[-1], *a.x[-1, :5]) for a in w.trajectory.arcs] for w in (walk, other)]
    assert walk.rounding() == pytest.approx(1e-6 * np.max(np.abs(np.subtract(*rows))), rel=0.1)


def test_what_cannot_be_repeated_is_refused(bare, published, tmp_path):
    """A walk from a file does not know the integration steps with which it was made, so its neighbour cannot
    be walked."""
    walk = ba.walk(ba.Walker(bare, ba.NPDController(published.constraint)), published, 1)
    stored = ba.load_walk(walk.save(tmp_path / "walk.npz"))
    with pytest.raises(ba.BipedError, match="has no steps; ask a new one"):
        stored.rounding()
