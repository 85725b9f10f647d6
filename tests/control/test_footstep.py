"""The footstep controller and its family of gaits: the map from step to step, forces, rough ground, stones.

A family has a gait, its member, for each speed v and step length L within its range; "flat" is the stored one,
and `slow` the gait of 0.6 m/s. In each step, at the *decision* (35 % of its phase), the controller decides on
which member the step ends. sigma is the angular momentum about the stance foot; `decisions(biped, walk)` are
sigma^2 at the decisions of a simulated walk, and `family.steps` has polynomials for

    sigma^2 at the next decision = delta^2 (sigma^2 + 2 W + 2 r J) + 2 W' + 2 r J'

with r the torque of a force from outside. `TwoSteps` has delta^2, 2 W', J', .., 2 W, J by quadratures.
A stone is where a step has to end.
"""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis import family_design
from biped_adrc.analysis.family_design import OF_LIBRARY, TwoSteps, library
from biped_adrc.cli.options import scenario_from
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.files import data_file
from biped_adrc.gait.family import DECISION, PolynomialMap, load_family
from biped_adrc.model.ground import Stones
from biped_adrc.scenario.scenario import read_scenario, scenario_lines

CLOCK = ba.SampledTime(1e-3)


@pytest.fixture(scope="module")
def slow(biped):
    return ba.load_gait("v0.6", biped)


def walker(biped, gait, disturbance=None, inner=ba.NPDController, **options):
    law = ba.Footstep.on_gait(inner(gait.constraint), gait, biped, **options)
    return ba.Walker(biped, law, disturbance, timing=CLOCK, torque_limit=150.0)


def decisions(biped, walk):
    """sigma^2 where each step decides, from the full simulation."""
    law, found = walk.walker.law, []
    for arc in walk.trajectory.arcs:
        w = walk.walker.split_state(arc.x[-1])[2].own
        minus = law.family.curve(np.array((w.begin, w.L)))[2]
        s = (arc.x[:, : biped.n] @ law.family.phase - w.plus) / (minus - w.plus)
        x = arc.x[int(np.searchsorted(s, DECISION))]
        found.append(biped.angular_momentum(x[:5], x[5:10]) ** 2)
    return np.array(found)


def speeds_of(walk):
    """Length over time of each step [m/s]."""
    lengths = [c.step_length for c in walk.certificates]
    t = [e.t for e in walk.trajectory.events("foot_strike")]
    return np.array(lengths) / np.diff([0.0, *t])


# -- the family ------------------------------------------------------------------------------------


@pytest.mark.parametrize("preset", ["identified", "identified-bare", "tac2003"])
def test_a_member_ends_at_its_step_length(preset):
    """The posture of a member at the end of its phase has the swing foot on the ground and L ahead, to the 3 mm
    that the polynomials of the family leave, for each preset of RABBIT's parameters.
    """
    biped = ba.Biped.load("rabbit", preset)
    family = load_family("flat", biped)
    for v in np.linspace(family.low[0], family.high[0], 4):
        for L in np.linspace(family.low[1], family.high[1], 5):
            h = family.member(v, L)
            q_b = h.h(h.theta_minus)[0]
            q = np.append(q_b, h.theta_minus - h.phase[:-1] @ q_b)
            x, z = biped.swing_foot(q)
            assert abs(x - L) < 3e-3
            assert abs(z) < 3e-3


def test_a_family_comes_back_from_its_file(biped, tmp_path):
    """The family read back is equal, and so is its gait of 0.7 m/s and steps of 0.35 m, which lies between the
    members that are stored.
    """
    family = load_family("flat", biped)
    family.save(tmp_path / "mine.json")
    again = load_family(tmp_path / "mine.json", biped)
    # its arrays are read-only, also when read from a file
    assert (again, again.low.flags.writeable) == (family, False)
    mu = np.array((0.7, 0.35))
    assert np.array_equal(again.curve(mu)[0], family.curve(mu)[0])
    assert again.steps.cycle_square(0.7, 0.35) == family.steps.cycle_square(0.7, 0.35)


def test_a_family_that_does_not_fit_is_refused_with_what_there_is(biped, tmp_path):
    """An unknown name, a missing file, another preset of the robot, a speed out of range, too few gaits for the
    fit, another format of file: each message says what is wrong or what there is instead.
    """
    path = tmp_path / "mine.json"
    load_family("flat", biped).save(path)
    with pytest.raises(GaitError, match=r"no family 'steep'.*choose one of \['flat', 'rough'\]"):
        load_family("steep", biped)
    stored = data_file("gaits", "rabbit", "families", "steep.json")
    with pytest.raises(GaitError, match=r"families/steep.json' not found"):
        load_family(stored, biped)
    with pytest.raises(GaitError, match="preset 'identified', and this is 'rabbit', 'tac2003'"):
        load_family(path, ba.Biped.load("rabbit", "tac2003"))
    with pytest.raises(GaitError, match=r"no member of 2 m/s.*the nearest has 1.1 m/s"):
        load_family("flat", biped).member(2.0, 0.4)
    with pytest.raises(GaitError, match="2 speeds and 1 lengths, expected at least 5"):
        library(biped, [0.5, 0.6], [0.3])
    path.write_text('{"format": "another"}')
    with pytest.raises(GaitError, match="it is no family, whose format is 'biped_adrc family 4'"):
        load_family(path, biped)


def test_a_family_goes_through_the_gaits_of_its_library(biped, monkeypatch):
    """Of gaits that lie on polynomials the fit is these polynomials, and its steps are the quadratures.

    In place of an optimisation, each gait of the library is here a member of the stored family; one of 25 does
    not exist. 90 samples for the map are enough for 1 % and take less time. r = -3 N m, so 2 r J = -6 J.
    """
    flat, spoken = load_family("flat", biped), []
    speeds, lengths = (np.linspace(*ends, 5) for ends in zip(flat.low, flat.high, strict=True))

    def optimise(biped, request):
        # "x" below stands for what a gait says of its origin
        if (request.speed, request.step) == (speeds[1], lengths[2]):
            raise GaitError("none here")
        # at 8 phases of the step: few, to take less time
        zero = ba.ZeroDynamics.of(biped, flat.member(request.speed, request.step), 8)
        return SimpleNamespace(gait=ba.Gait.of_cycle("a", zero, dict.fromkeys(OF_LIBRARY, "x")))

    monkeypatch.setattr(family_design, "optimise", optimise)
    monkeypatch.setattr(family_design, "_SAMPLES", 90)
    gaits = library(biped, speeds, lengths, done=spoken.append)
    # pair 7, from 0, is the second speed with the third length; spoken: a line about each pair
    assert (len(gaits), spoken[7]) == (24, f"{speeds[1]:g} m/s, {lengths[2]:g} m: none, none here")
    assert spoken[0] == f"{speeds[0]:g} m/s, {lengths[0]:g} m: {gaits[0][2].period:.3f} s"
    found = family_design.design_family("mine", biped, gaits, {"command": "c"}, seed=1)
    assert found.provenance == {**dict.fromkeys(OF_LIBRARY, "x"), "command": "c"}
    assert (found.low.tolist(), found.high.tolist()) == (flat.low.tolist(), flat.high.tolist())
    mu = np.array((0.77, 0.37))
    np.testing.assert_allclose(found.curve(mu)[0], flat.curve(mu)[0], rtol=0.0, atol=1e-9)
    assert found.curve(mu)[1:] == pytest.approx(flat.curve(mu)[1:], abs=1e-9)
    # speed at the end of the first step, lengths of the step before and of it, speed and length of the second
    W, J = TwoSteps.of(biped, flat, (0.7, 0.34, 0.34, 0.8, 0.4)).numbers()[-2:]
    delta2, W_next, J_next = TwoSteps.of(biped, flat, (0.8, 0.34, 0.4, 0.8, 0.36)).numbers()[:3]
    exact = delta2 * (400.0 + W - 6.0 * J) + W_next - 6.0 * J_next
    for steps in (found.steps, flat.steps):
        # from sigma^2 = 400 at v 0.7, 0.34 m before, to the end at 0.8 m/s and 0.4 m; then 0.36 m
        y = steps.next_square(400.0, np.array((0.7, 0.34)), np.array((0.8, 0.4)), 0.36, -3.0)
        assert y == pytest.approx(exact, rel=0.01)
    for member in (found.members[0], found.members[-1]):
        h = flat.member(*member[:2])
        orbit = ba.ZeroDynamics.of(biped, h).cycle
        F_T, F_N = orbit.ground_reaction.T
        worst = np.max(np.abs(F_T / F_N)), np.max(np.abs(orbit.u)), np.min(F_N)
        # friction, peak torque and least normal force, stored with three decimals
        assert member[2:] == pytest.approx(worst, abs=6e-4)
    lengths[2] = 9.0  # no member has these speeds or this length, so no gait is found
    with pytest.raises(GaitError, match=r"^0 of 5 x 5 pairs .* a family needs at least 15$"):
        library(biped, speeds + 9.0, lengths)


# -- from step to step -----------------------------------------------------------------------------
def test_the_map_says_what_the_simulated_robot_does_under_a_force(biped, slow):
    """sigma^2 at the next decision, by the stored map and by the whole dynamics, under 6 N backwards on the
    hip. w: the controller's state at the end of each step; r: its estimate of the force's torque.
    """
    stones = (0.38, 0.3, 0.45, 0.4, 0.38)
    push = ba.HipForce(biped, (-6.0, 0.0))
    walk = ba.walk(walker(biped, slow, push, speed=0.7, step=0.38, stones=stones), slow, 4)
    law, y = walk.walker.law, decisions(biped, walk)
    w = [walk.walker.split_state(arc.x[-1])[2].own for arc in walk.trajectory.arcs[:4]]
    # the steps 2 and 3, each of which has a whole step before it and one after it
    for k in (1, 2):
        begin, end = np.array((w[k].begin, w[k].before)), np.array((w[k].end, w[k].L))
        predicted = law.family.steps.next_square(y[k], begin, end, w[k + 1].L, w[k].r)
        assert predicted == pytest.approx(y[k + 1], rel=0.02)


@pytest.mark.parametrize("pole", [0.35, 0.5])
def test_the_error_from_step_to_step_has_the_pole_that_was_asked_for(biped, slow, pole):
    """Two walks that start 1 % slower and faster than the settled one: from one decision to the next their
    difference of sigma^2 becomes `pole` times as large.
    """
    law = walker(biped, slow, speed=0.65, step=0.38, pole=pole, family="flat")
    settled = ba.walk(law, slow, impacts=12).trajectory.arcs[-1].x[0]
    y = []
    for scale in (0.99, 1.01):
        start = settled[:5], scale * settled[5:10]
        y.append(decisions(biped, ba.walk(law, slow, impacts=4, start=start)))
    apart = y[1] - y[0]
    assert apart[1] / apart[0] == pytest.approx(pole, rel=0.05)


# -- what it is for --------------------------------------------------------------------------------
@pytest.mark.parametrize("family", ["flat", "rough"])
@pytest.mark.parametrize(
    ("speed", "step"), [(0.5, 0.3), (0.6, 0.5), (0.7, 0.4), (0.8, 0.3), (1.0, 0.4), (1.0, 0.5)]
)
def test_the_speed_is_held(biped, slow, speed, step, family):
    """After 14 steps length over time is the speed to 2 %, and without a torque from outside r is zero: a bias
    of 0.1 N m would be 1 % of the speed.
    """
    law = walker(biped, slow, speed=speed, step=step, family=family)
    walk = ba.walk(law, slow, impacts=20)
    assert speeds_of(walk)[-6:] == pytest.approx([speed] * 6, rel=0.02)
    assert abs(walk.walker.split_state(walk.trajectory.arcs[-1].x[-1])[2].own.r) < 0.01


def test_the_slowest_member_is_walked(biped, slow):
    """At the least speed of the family, 0.4 m/s, the speed is held too."""
    walk = ba.walk(walker(biped, slow, speed=0.4, step=0.4, family="flat"), slow, impacts=20)
    assert speeds_of(walk)[-6:] == pytest.approx([0.4] * 6, rel=0.02)
    assert walk.remarks == ()


def test_a_schedule_of_one_speed_is_that_speed(biped, slow):
    """The states of the two walks are the same numbers."""
    one, other = (
        ba.walk(walker(biped, slow, step=0.38, **given), slow, impacts=4).trajectory.arcs
        for given in ({"speed": 0.65}, {"speeds": (0.65,) * 3})
    )
    for arc, same in zip(one, other, strict=True):
        np.testing.assert_array_equal(arc.x, same.x)


def test_each_speed_of_a_schedule_is_reached(biped, slow):
    """0.5 m/s in ten steps, and 0.8 m/s from step 11 on, to which step 10 leads already."""
    walk = ba.walk(walker(biped, slow, step=0.3, speeds=(0.5,) * 10 + (0.8,)), slow, impacts=22)
    assert walk.feasibility.outcome == "feasible"
    v = speeds_of(walk)
    assert v[7:9] == pytest.approx([0.5] * 2, rel=0.02)
    assert v[10] > 0.7
    assert v[-4:] == pytest.approx([0.8] * 4, rel=0.02)


def test_the_robot_slows_down_over_several_steps(biped, slow):
    """From 1.0 m/s, at the end of the list, to 0.5 m/s: as fast as the family lets it, in some step just so.
    With a family that lets each step end on all members it loses its grip or falls.
    """
    schedule = {"speeds": (0.7, 0.8, 0.9) + (1.0,) * 5, "speed": 0.5, "step": 0.4}
    walk = ba.walk(walker(biped, slow, **schedule), slow, impacts=16)
    assert walk.feasibility.outcome == "feasible"
    family = walk.walker.controller.family
    own = [walk.walker.split_state(arc.x[-1])[2].own for arc in walk.trajectory.arcs]
    room = [w.end - family.steps.ends(np.array((w.begin, w.L)))[0] for w in own]
    assert min(room) == pytest.approx(0.0, abs=1e-9)
    assert at_once(biped, slow, walk).feasibility.outcome != "feasible"


def at_once(biped, gait, walk):
    """The walk with a family that lets each step end on all members."""
    law, starts = walk.walker.controller, len(walk.trajectory.arcs)
    ends = np.array([[law.family.low[0], law.family.high[0]]])
    every = PolynomialMap(((0, 0),), ends, law.family.low, law.family.high)
    law = replace(law, family=replace(law.family, steps=replace(law.family.steps, ends=every)))
    walker = ba.Walker(biped, law, timing=CLOCK, torque_limit=150.0)
    return ba.walk(walker, gait, impacts=starts - 1)


def test_the_robot_speeds_up_over_several_steps(biped, slow):
    """From 0.5 m/s to 1.0 m/s: with a family that lets each step end on all members the foot slips."""
    walk = ba.walk(walker(biped, slow, speeds=(0.5,) * 4, speed=1.0, step=0.4), slow, impacts=12)
    assert walk.feasibility.outcome == "feasible"
    own = [walk.walker.split_state(arc.x[-1])[2].own for arc in walk.trajectory.arcs]
    steps = walk.walker.controller.family.steps
    room = [steps.ends(np.array((w.begin, w.L)))[1] - w.end for w in own]
    assert min(room) == pytest.approx(0.0, abs=1e-9)
    assert at_once(biped, slow, walk).feasibility.outcome != "feasible"


@pytest.mark.parametrize("name", ["rough", "flat"])
def test_a_step_may_end_where_ground_and_motors_bear_it(biped, name):
    """A step is borne on the slowest member that is stored, and not on one that is 0.25 m/s slower; on the
    fastest one, and not on one that is 0.1 m/s faster.
    """
    family, limits = load_family(name, biped), ba.Limits().of(biped.description)
    for v, L, end, beyond in ((0.95, 0.34, 0, -0.25), (1.0, 0.4, 0, -0.25), (0.8, 0.24, 1, 0.1)):
        last = family.steps.ends(np.array((v, L)))[end]
        assert family.low[0] < min(last, last + beyond) < max(last, last + beyond) < family.high[0]
        y = family.steps.cycle_square(v, L)
        ends = (v, last, last + beyond)
        borne = [TwoSteps.of(biped, family, (v, L, L, x, L)).keeps(y, limits) for x in ends]
        assert borne == [True, True, False]


def test_a_schedule_ends_at_the_speed_to_keep(biped, slow):
    """Behind the list comes `speed`, and where that is not given the last one of the list."""
    law = walker(biped, slow, speeds=(0.5, 0.7)).controller
    assert [law.kept(k) for k in (1, 2, 3, 9)] == [0.5, 0.7, 0.7, 0.7]
    law = walker(biped, slow, speeds=(0.5, 0.7), speed=0.6).controller
    assert [law.kept(k) for k in (1, 2, 3, 9)] == [0.5, 0.7, 0.6, 0.6]


def test_a_schedule_is_written_as_text(tmp_path):
    """With units, on the command line and in a scenario's file, which gives the same scenario back."""
    own = {"name": "footstep", "inner": "NPD", "speeds": ["0.5 m/s", "60 cm/s", 0.7]}
    s = ba.Scenario(own, gait="v0.6", hardware={"period": "1 ms"})
    path = tmp_path / "ramp.toml"
    path.write_text("\n".join(scenario_lines(s)))
    sets = ["controller.name=footstep", "controller.inner=NPD", "controller.speeds=0.5,0.6,0.7"]
    said = scenario_from({"gait.name": "v0.6", "hardware.period": "1 ms"}, sets)
    assert s == read_scenario(path) == said
    assert ba.walk_scenario(s.replace({"run.impacts": 1})).walker.law.speeds == (0.5, 0.6, 0.7)


def test_the_speed_of_a_cycle_is_found(biped, slow):
    """From y of the cycle of a member `zero` finds its speed, to 2 mm/s in the whole range."""
    law = walker(biped, slow).controller
    y = law.family.steps.cycle_square
    for v in np.linspace(law.family.low[0], law.family.high[0], 15):
        assert law.zero(lambda x, v=v: y(x, 0.4) - y(v, 0.4)) == pytest.approx(v, abs=2e-3)


def test_a_force_of_14_newtons_on_the_hip_is_walked_against(biped):
    """r, what the controller takes for the force's moment about the stance foot, is force times hip height.

    The hip's height, which varies over a step, is read at the walk's end: hence 10 %.
    """
    gait = ba.load_gait("v0.5", biped)
    push = ba.HipForce(biped, (-14.4, 0.0), steps=(5, 99))
    walk = ba.walk(walker(biped, gait, push, step=0.25), gait, impacts=20)
    assert walk.feasibility.outcome == "feasible"
    # [2]: the controller's state
    r = walk.walker.split_state(walk.trajectory.arcs[-1].x[-1])[2].own.r
    hip = walk.walker.plant.hip(walk.trajectory.arcs[-1].x[-1][:5])[1]
    assert r == pytest.approx(14.4 * hip, rel=0.1)


def test_steps_on_ground_of_random_height(biped, slow):
    """Each of 25 steps, the usual number of a walk, ends up to 20 mm higher or lower."""
    s = ba.Scenario({"name": "footstep", "speed": 0.65, "step": 0.38, "inner": "NPD"}, gait="v0.6")
    s = s.replace({"hardware.period": "1 ms", "ground.step_height": "20 mm", "run.seed": 5})
    walk = ba.walk_scenario(s)
    drops = [walk.walker.drop(k) for k in range(1, 26)]
    assert max(map(abs, drops)) > 0.018
    assert walk.feasibility.outcome == "feasible"


@pytest.mark.parametrize("inner", [ba.NPDController, ba.ADRCController])
def test_steps_onto_stones_at_random_distances(inner):
    """The robot makes 20 steps of 0.2 to 0.6 m; the verdict includes the stones."""
    own = {"name": "footstep", "speed": "0.55 m/s", "step": "0.4 m"}
    own["inner"] = "NPD" if inner is ba.NPDController else "LESO"
    ground = {"stone_range": (0.2, 0.6)}
    s = ba.Scenario(own, gait="v0.6", hardware={"period": "1 ms"}, ground=ground)
    walk = ba.walk_scenario(s.replace({"run.impacts": 20, "run.seed": 3}))
    assert walk.feasibility.outcome == "feasible"
    lengths = [c.step_length for c in walk.certificates]
    assert lengths == pytest.approx(walk.walker.stones.lengths[:20], abs=5e-3)
    assert np.ptp(lengths) > 0.3


@pytest.mark.filterwarnings("ignore::biped_adrc.WalkWarning")
def test_a_foot_off_its_stone_is_not_feasible(biped, slow):
    """NPD steps 438.8 mm whatever the stones are: the first, at 500 mm, reaches 25 mm to each side, so the foot
    is 61.2 - 25 = 36.2 mm off its edge. The second, at 440 mm, is hit.
    """
    course = Stones((0.5, 0.44))
    npd = ba.Walker(biped, ba.NPDController(slow.constraint), stones=course)
    walk = ba.walk(npd, slow, impacts=3)
    assert walk.feasibility.reasons["stones"].startswith("step 1: the foot lands 36.2 mm beyond")
    assert set(walk.feasibility.reasons) == {"stones"}
    assert walk.remarks == (
        "behind stone 2, the last one, from single support 3 on, the ground is whole",
    )


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"controller.speed": "3 m/s"}, "no member of 3 m/s"),
        ({"controller.speeds": (0.5, 3.0)}, "speed 2 .* no member of 3 m/s .* nearest has 1.1 m/s"),
        ({"controller.speeds": (0.5, -1.0)}, "-1.0, expected a positive number"),
        ({"ground.stones": (0.3, 0.9)}, "stone 2 is out of reach.*the nearest has .* 0.6 m"),
        ({"ground.stones": (0.3,), "ground.stone_range": (0.2, 0.3)}, "stone_range"),
        ({"ground.stone_range": (0.3, 0.2)}, "stone_range"),
        ({"hardware.period": None}, "sampled time only"),
    ],
)
def test_wrong_values_of_footsteps_are_refused(values, text):
    """A speed and a stone beyond the family, stones beside a range of random ones, a range that falls, and no
    sampled time; else a footstep controller at 1 ms is accepted.
    """
    usual = {"controller": "footstep", "gait": "v0.6", "hardware.period": "1 ms"}
    with pytest.raises(InputError, match=text):
        ba.walk_scenario(ba.Scenario(**usual | values))


def test_the_stored_map_is_that_of_the_integrals_over_a_step(biped):
    """The polynomials fit the quadratures to 2 % of 2 W and J, and 5 % of the rest, for a step within the range
    of the family.

    x: (v, length before, L, v at the end, length ahead), first with equal and then with changing members.
    """
    family = load_family("flat", biped)
    low, high = np.array(family.low), np.array(family.high)
    (v, L), (end, ahead) = 0.5 * (low + high), 0.45 * low + 0.55 * high
    for x in ((v, L, L, v, L), (v, L, ahead, end, L)):
        found = TwoSteps.of(biped, family, x).numbers()
        at = dict(zip(("v", "before", "L", "end", "ahead"), x, strict=True))
        stored = family.steps.to_impact(np.array([at[k] for k in ("v", "end", "L", "ahead")]))
        decision = family.steps.to_decision(
            np.array([at[k] for k in ("v", "before", "L", "ahead")])
        )
        assert found[-2:] == pytest.approx(stored, rel=2e-2)
        assert found[:-2] == pytest.approx(decision, rel=5e-2, abs=0.05 * np.max(np.abs(decision)))
