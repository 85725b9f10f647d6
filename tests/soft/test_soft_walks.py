"""A scenario's walk on soft ground: the same controller, another plant, by one argument everywhere.

The fixture made is a walk of two steps of a scenario under NPD in MuJoCo; SOFT are the values of this scenario,
plant, clock of 1 kHz and torque limit. loop_on makes a loop around a plant by hand, run_of simulates it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.signals import accelerations
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.control.around import Hold
from biped_adrc.core.errors import InputError
from biped_adrc.engine.on_plant import fastest_loop
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.model.ground import SoftGround
from biped_adrc.scenario.build import build
from biped_adrc.scenario.walk import halved

from .loops import SOFT, TICK, loop_on, run_of


@pytest.fixture(scope="module")
def made():
    return ba.walk_scenario(ba.Scenario("NPD", run={"impacts": 2}, **SOFT))


def test_a_scenario_on_soft_ground_is_the_walk_of_a_loop_around_the_plant(made, biped, gait):
    """A loop made by hand, in Python, has the same touchdowns and states: to the last bit as the scenario in
    Python, to 1e-9 as the compiled one; `apart` is that difference, 1000 times as large for torques.
    """
    loop = loop_on(MuJoCoPlant(biped), ba.NPDController(gait.constraint))
    run = run_of(loop, gait, impacts=2)
    plain = ba.walk_scenario(ba.Scenario("NPD", run={"engine": "pinocchio", "impacts": 2}, **SOFT))
    assert plain.trajectory.settings["engine"] == "pinocchio"
    assert made.trajectory.settings["engine"] == "compiled"
    for walk, apart in ((plain, 0.0), (made, 1e-9)):
        ends = [e.t for e in walk.trajectory.events(FOOT_STRIKE)]
        assert ends == [e.t for e in run.events(FOOT_STRIKE)]
        for ours, theirs in zip(walk.trajectory.arcs, run.arcs, strict=True):
            assert np.allclose(ours.x[:, :10], theirs.x[:, :10], rtol=apart, atol=apart)
            assert np.allclose(ours.x[:, -4:], theirs.x[:, -4:], rtol=1e3 * apart, atol=1e3 * apart)


def test_ba_walk_takes_the_plant_by_name_or_itself(made, biped, gait):
    """With plant="mujoco" the walk ends as the scenario's, to the last bit; a plant keeps its own friction."""
    walker = Walker(biped, ba.NPDController(gait.constraint), timing=TICK, torque_limit=150.0)
    walk = ba.walk(walker, gait, impacts=2, plant="mujoco")
    assert np.array_equal(walk.trajectory.final_state, made.trajectory.final_state)
    stiffer = MuJoCoPlant(biped, SoftGround(friction=1.0))
    walk = ba.walk(walker, gait, impacts=1, plant=stiffer)
    assert walk.trajectory.settings["plant"]["ground"]["friction"] == 1.0


def test_the_slope_of_a_plant_is_that_of_the_walk(biped, gait):
    """A walker without a slope takes the plant's, with a warning as the gait was made for another; two slopes
    that contradict one another are refused.
    """
    walker = Walker(biped, ba.NPDController(gait.constraint), timing=TICK, torque_limit=150.0)
    plant = MuJoCoPlant(biped, slope=-0.01)
    with pytest.warns(ba.WalkWarning, match="made for a slope of 0 rad, and the ground has -0.01"):
        walk = ba.walk(walker, gait, impacts=1, plant=plant)
    assert walk.walker.slope == -0.01
    with pytest.raises(InputError, match=r"a slope of -0\.01 rad, the walker 0\.02"):
        ba.walk(replace(walker, slope=0.02), gait, plant=plant)


def test_its_signals_are_of_the_plant_that_walked(made):
    """xi = q_b'' - kappa u with the q'' of MuJoCo; forces of the ground are in its cone of friction 0.6."""
    x, walker = made.signals, made.walker
    assert np.allclose(x.xi, x.xi_external + x.xi_nominal, rtol=1e-9, atol=1e-7)
    # some rows with a later one behind them: at a jump a time stands twice
    rows = np.flatnonzero(np.diff(x.t) > 0.0)[5:400:40]
    for k in rows:
        kappa = walker.plant.reduction(x.q[k], x.v[k]).kappa
        dv = (x.v[k + 1, :4] - x.v[k, :4]) / (x.t[k + 1] - x.t[k])
        assert np.allclose(x.xi[k], dv - kappa @ x.u[k], rtol=0.0, atol=1e-6)
    # of the second single support, without the transient after its touchdown and the instant of the next one
    late = (x.step == 2) & (x.t > x.t[x.step == 2][0] + 0.05) & (x.t < x.t[-1] - 2e-3)
    F = x.ground_reaction[late]
    assert np.min(F[:, 1]) > 0.0
    assert np.max(np.abs(F[:, 0]) / F[:, 1]) <= 0.6 * (1.0 + 1e-6)
    # the stance foot only creeps, less than 2 mm, and the second foothold is one step length ahead
    assert np.ptp(x.foothold[late]) < 2e-3
    first = x.foothold[x.step == 1][-1]
    assert x.foothold[late][0] - first == pytest.approx(0.31, abs=0.03)


def test_a_finished_soft_walk_has_a_verdict_and_slips_and_comes_back_from_its_file(made, tmp_path):
    """Both of its steps are feasible, by the same numbers after saving and loading.

    A certificate needs the impact map of the rigid plant, so a soft walk has none.
    """
    assert made.certificates == ()
    assert made.feasibility.feasible_impacts == 2
    assert made.feasibility.text() == "it made all steps, feasible"
    assert made.outcome.impacts == 2
    slips = [max(step.slip) for step in made.soft_steps]
    assert [s.slip for s in made.feasibility.supports] == slips
    again = ba.load_walk(made.save(tmp_path / "soft.npz"))
    assert again.soft
    assert np.array_equal(again.signals.ground_reaction, made.signals.ground_reaction)
    assert again.feasibility == made.feasibility


@pytest.mark.parametrize(
    "values",
    [
        {"ground.friction": 0.0},
        {**SOFT, "errors.impact_width": 0.01},
        {"ground.plant": "mujocco"},
        {"ground.plant": "mujoco", "run.impacts": 1},
        {**SOFT, "ground.impratio": -1.0},
    ],
)
def test_wrong_values_of_soft_ground_are_refused(values):
    """No friction, an error of the impact map, which soft ground has not, a misspelt plant, no clock, and an
    engine's number below 0.
    """
    with pytest.raises(InputError):
        ba.walk_scenario(ba.Scenario("NPD", **values))


def test_what_only_the_rigid_plant_has_is_named(biped, gait):
    """MuJoCo has impacts and integration of its own: errors of the impact map (impact_gain) are refused when
    the loop is made, an integration method already before that."""
    law, plant = ba.NPDController(gait.constraint), MuJoCoPlant(biped)
    walker = Walker(biped, law, timing=TICK, impact_gain=(0.01,) * 5)
    with pytest.raises(InputError, match="impact"):
        fastest_loop(walker, plant)
    with pytest.raises(InputError, match="method"):
        ba.walk(walker, gait, method=ba.RK4(), plant=plant)


@pytest.mark.parametrize(
    ("ground", "h"),
    [
        ({"time_constant": 1e-3}, 1e-4),  # a tenth of it
        ({"time_constant": 2e-2}, 2e-4),  # at most
        ({"time_constant": 5e-3, "plant_step": 5e-4, "touchdown_force": 20.0}, 5e-4),
    ],
)
def test_values_of_ground_and_engine_come_from_the_scenario(ground, h):
    """h: the engine's step, a tenth of the time constant, at most 0.2 ms, or the one that is given. All values
    of `ground` arrive in the plant, and the halved scenario has half the step.
    """
    own = {"friction": 0.9, "impratio": 40.0}
    s = ba.Scenario("NPD", ground=own | ground, run={"impacts": 1}, **SOFT)
    plant = ba.walk_scenario(s).trajectory.settings["plant"]
    found = plant | plant["ground"]
    # numbers alone, as other values cannot be in a set; the plant has plant_step as h
    assert (own | ground).items() - {("plant_step", h)} <= {
        (name, x) for name, x in found.items() if isinstance(x, float)
    }
    assert plant["h"] == pytest.approx(h)
    assert halved(s, build(s)).ground.plant_step == pytest.approx(0.5 * h)


def test_a_step_that_takes_too_long_is_told():
    """A step takes about 0.42 s, and max_step_time is 0.1 s: the walk ends as stalled."""
    common = {"hardware.period": 1e-3, "run.impacts": 2, "run.max_step_time": 0.1}
    walk = ba.walk_scenario(ba.Scenario("NPD", ground="mujoco", **common))
    assert walk.trajectory.status is ba.Status.STALLED


def test_a_stretch_no_longer_than_round_off_gives_no_acceleration():
    """Where a push ends one bit beside a tick, 2e-16 rad/s in 1e-16 s would be an acceleration of 2 rad/s^2.
    Here that stretch has 4e3: replaced by 7 of the stretch before it or, at the start of an arc, by 9 after it.
    """
    t = np.array([0.0, 1e-3, 1e-3, np.nextafter(1e-3, 1.0), np.nextafter(1e-3, 1.0), 2e-3])
    a = np.array([7.0, 7.0, 4e3, 4e3, 9.0, 9.0])
    dx = np.column_stack((np.zeros(6), a))
    arcs = [Arc(None, t[k:], np.zeros((6 - k, 2)), dx[k:]) for k in (0, 2)]
    found = [accelerations(arc, 1) for arc in arcs]
    assert [x[:, 0].tolist() for x in found] == [[7.0, 7.0, 7.0, 7.0, 9.0, 9.0], [9.0] * 4]


# -- an observer that knows of contact --------------------------------------------------------------
PUSH = ba.TorquePulse([30.0, 30.0, 30.0, 30.0, 0.0], step=2, start=0.1, stop=0.3)


def test_held_after_touchdown_an_observer_of_low_order_leaves_a_quarter_of_npds_error(biped, gait):
    """ADRC with a slow observer that restarts at each tick for 15 ms after a touchdown (Hold) is under the same
    push as NPD: compared is the largest error from the push's onset to 50 ms after its end. The observer is
    held since it would take contact for a disturbance.
    """
    h, plant, found = gait.constraint, MuJoCoPlant(biped, SoftGround(friction=0.8)), []
    slow = ba.ADRCController(h, ba.GPIObserver.from_bandwidth(500.0))
    for controller in (ba.NPDController(h), Hold(slow, 0.015)):
        run = run_of(loop_on(plant, controller, disturbance=PUSH), gait, impacts=2)
        assert run.status is ba.Status.COMPLETED
        arc = run.arcs[1]
        late = arc.x[(arc.t > arc.mode.start + 0.1) & (arc.t < arc.mode.start + 0.35)]
        found.append(max(np.max(np.abs(x[:4] - h(0.0, x[:5], x[5:10]).q_d)) for x in late))
    npd, held = found
    assert 0.2 * npd < held < 0.26 * npd
