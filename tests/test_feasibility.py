"""What ground and motors could have carried: mean force against momentum, hand-made steps, walks cut short.

A single support is feasible if the ground pushes (mean F_N > 0), the friction |F_T| / F_N is at most 0.6, no
torque is above 150 N m, and the swing foot stays above the ground (no "scuffing"); forces are means over 5 ms.
These limits are `KNOWN`. `judged(walker, t, F_N, ...)` is the verdict on a single support of 0.4 s with these
forces, `infeasible()` its broken limits by name. A node is a stored instant; `handmade` makes nodes of forces,
`grid()` are their times, H = 0.1 ms apart. WEIGHT is a force of 300 N. `beginning(walker, torque=0.1)` are
nodes in which a violation of this kind begins at 0.1 s, `first_in(walker, nodes)` is the first violation.
"""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq

import biped_adrc as ba
from biped_adrc.analysis.certificate import certificates, first_violation, supports
from biped_adrc.analysis.feasibility import outcome_of
from biped_adrc.analysis.ground_force import Nodes, demands
from biped_adrc.core.errors import InputError
from biped_adrc.gait.constraint import continued
from biped_adrc.model.ground import KnownLimits, StepUp, ground_axes
from biped_adrc.studies.run import run_trials
from biped_adrc.view.placement import joint_values

KNOWN = KnownLimits(0.6, 150.0, 5e-3)  # friction, torque [N m], window [s]
WEIGHT = 300.0
H = 1e-4


def handmade(walker, t, F_N, F_T=None, height=None, u=None):
    """Nodes of one single support under these forces (x, z) [N], linear between them, with heights of the swing
    foot [m] and torques [N m]."""
    count, zero = len(t), np.zeros(len(t))
    F = np.column_stack((zero if F_T is None else F_T, F_N))
    newton = F - walker.plant.weight * np.array([0.0, 1.0])
    none = np.zeros((count, 4))
    momentum = cumulative_trapezoid(newton, t, axis=0, initial=0.0)
    height = zero + 0.05 if height is None else height
    parts = (t, zero + 1.0, zero, zero, none, none if u is None else u, none, zero, none, momentum)
    return Nodes(np.column_stack((*parts, zero, height)), 5, 4)


def judged(walker, t, F_N, finished=True, **more):
    """The `Support` of a handmade single support, with an impulse along the normal at its end if it is
    finished."""
    n = handmade(walker, t, F_N, **more)
    after = n.rows[-1, -4:-2] + ground_axes(walker.ground_slope)[1]
    (found,) = supports(walker, n, KNOWN, int(finished), after)
    return found


@pytest.fixture(scope="module")
def walker(biped, gait):
    return ba.Walker(biped, ba.NPDController(gait.constraint))


def grid(duration=0.4, h=H):
    return np.linspace(0.0, duration, round(duration / h) + 1)


def dip(length, depth=-100.0):
    """F_N with both sides of the edges of a dip of this length [s]."""
    t = grid()
    edges = 0.2, 0.2 + length
    t = np.sort(np.concatenate((t[~np.isin(t, edges)], np.repeat(edges, 2))))
    inside = (t > edges[0]) & (t < edges[1])
    first, last = np.flatnonzero(t == edges[0]), np.flatnonzero(t == edges[1])
    inside[first[1]] = inside[last[0]] = True
    return t, np.where(inside, depth, WEIGHT)


def test_a_force_that_dips_for_2_ms_is_carried_and_one_for_6_ms_is_not(walker):
    """F_N of 300 N that dips to -100 N: over a window of 5 ms the mean is 300 - 400 * 2 / 5 = 140 N with a
    dip of 2 ms, and -100 N with one of 6 ms."""
    for length, names in ((2e-3, []), (6e-3, ["normal_force"])):
        t, F_N = dip(length)
        s = judged(walker, t, F_N)
        assert list(s.infeasible()) == names
        least = WEIGHT - 400.0 * min(length, 5e-3) / 5e-3
        assert s.mean_normal_force == pytest.approx(least, abs=1e-9)


def test_a_foot_that_is_lifted_needs_no_friction_and_is_infeasible(walker):
    """Where the mean F_N is below zero there is no ratio |F_T| / F_N, only a lifted foot (friction infinite,
    not counted). Where F_N changes from -5 to 100 N it passes near zero, and friction is broken too."""
    t = grid()
    s = judged(walker, t, np.full(len(t), -5.0), F_T=np.full(len(t), 50.0))
    assert s.mean_friction == np.inf
    assert list(s.infeasible()) == ["normal_force"]
    partly = np.where(t < 0.2, -5.0, 100.0)
    s = judged(walker, t, partly, F_T=np.full(len(t), 50.0))
    assert s.mean_friction > 0.6  # as the mean of F_N passes through zero
    assert list(s.infeasible()) == ["normal_force", "friction"]


def test_friction_is_judged_in_the_mean_and_on_both_sides(walker):
    """70 N along 100 N need 0.7, forwards and backwards; 90 N that change their sign at 1 kHz cancel in 5
    ms."""
    t = grid()
    for sign in (-1.0, 1.0):
        s = judged(walker, t, np.full(len(t), 100.0), F_T=np.full(len(t), 70.0 * sign))
        assert list(s.infeasible()) == ["friction"]
        assert s.mean_friction == pytest.approx(0.7)
        assert not replace(s, limits=KNOWN._replace(friction=0.8)).infeasible()
    # 0.25 H: no node is at a zero of the sine
    chatter = 90.0 * np.sign(np.sin(2.0 * np.pi * 1e3 * (t + 0.25 * H)))
    s = judged(walker, t, np.full(len(t), 100.0), F_T=chatter)
    assert s.mean_friction < 0.1
    assert not s.infeasible()
    # 65 N that do not change their sign need 0.65
    s = judged(walker, t, np.full(len(t), 100.0), F_T=65.0 + 0.3 * chatter)
    assert list(s.infeasible()) == ["friction"]


@pytest.mark.parametrize("slope", [-0.2, 0.2])
def test_friction_is_along_the_ground(walker, slope):
    """100 N across and 30 N along ground that slopes by 0.2 rad need a friction of 0.3; along x and z the
    ratio would be another."""
    t = grid()
    tilted = replace(walker, slope=slope)
    F_N, F_T = 100.0, 30.0  # across and along
    x, z = F_T * np.cos(slope) + F_N * np.sin(slope), F_N * np.cos(slope) - F_T * np.sin(slope)
    ones = np.ones(len(t))
    s = judged(tilted, t, z * ones, F_T=x * ones)
    assert (s.mean_friction, s.mean_normal_force) == pytest.approx((0.3, 100.0))


def test_scuffing_counts_away_from_the_ends_below_the_lower_foothold(walker):
    """The ends are 3 % of 0.4 s, 12 ms; the end counts where no touchdown follows (finished=False)."""
    t = grid()
    F_N = np.full(len(t), WEIGHT)
    ends = np.where((t < 0.011) | (t > 0.389), -1e-3, 0.02)
    assert judged(walker, t, F_N, height=ends).scuffing == 0.0
    middle = np.where(np.abs(t - 0.2) < 0.01, -2e-3, 0.02)
    s = judged(walker, t, F_N, height=middle)
    assert s.scuffing == pytest.approx(2e-3)
    assert list(s.infeasible()) == ["scuffing"]
    # 2 mm deep is above a ground 5 mm lower; a step up does not lower what counts
    down = replace(walker, ground_steps=(ba.StepDown(1, 0.005),))
    assert judged(down, t, F_N, height=middle).scuffing == 0.0
    up = replace(walker, ground_steps=(StepUp(1, 0.005),))
    assert judged(up, t, F_N, height=middle).scuffing == pytest.approx(2e-3)
    late = np.where(t > 0.39, -1e-3, 0.02)
    assert judged(walker, t, F_N, height=late, finished=False).scuffing > 0.0


@pytest.mark.parametrize(
    ("number", "reason"),
    [
        ("mean_friction", "friction"),
        ("mean_normal_force", "normal_force"),
        ("peak_torque", "torque"),
        ("scuffing", "scuffing"),
        ("slip", "slip"),
        ("impulse_ratio", "impulse"),
    ],
)
def test_nan_in_a_number_is_infeasible_and_the_reason_names_the_number(walker, number, reason):
    """A NaN is in no limit: written into one number of a feasible support it must not pass as kept."""
    t = grid()
    good = judged(walker, t, np.full(len(t), WEIGHT))
    assert good.infeasible() == {}
    assert list(replace(good, **{number: np.nan}).infeasible()) == [reason]


def test_torque_at_its_limit_is_feasible_and_above_is_not(walker):
    """The limit is 150 N m for |u|, here at one node of one joint, with a negative sign."""
    t = grid()
    F_N, u = np.full(len(t), WEIGHT), np.zeros((len(t), 4))
    u[50, 2] = -150.0
    assert not judged(walker, t, F_N, u=u).infeasible()
    u[50, 2] = -151.0
    assert list(judged(walker, t, F_N, u=u).infeasible()) == ["torque"]


def test_a_force_that_is_no_number_is_not_feasible(walker):
    """One NaN in 4001 values of F_N, or most of F_T: a comparison with NaN is False and must not count as
    within the limit."""
    t = grid()
    F_N = np.full(len(t), WEIGHT)
    F_N[7] = np.nan
    assert "normal_force" in judged(walker, t, F_N).infeasible()
    F_T = np.where(t < 0.1, 0.0, np.nan)
    assert "friction" in judged(walker, t, np.full(len(t), WEIGHT), F_T=F_T).infeasible()


def test_the_mean_over_a_window_is_that_of_the_force_in_it(walker):
    """The force is constant between nodes, so that the momentum is linear and windows may begin anywhere.

    The 0.2 s before 0.25 s have 0.05 s of 100 N and 0.15 s of 400 N, which is 65 N s; the whole has 0.
    """
    t = np.array([0.0, 0.1, 0.1, 0.25, 0.25, 0.6])
    n = handmade(walker, t, np.array([1.0, 1.0, 4.0, 4.0, -2.0, -2.0]) * 100.0)
    # row 0: mean F_N over a window of 0.2 s that ends at the node; 1: number of single supports with an impact
    found = demands(walker, n, 0.2, 1)[0][0]
    # infinite as long as no whole window has passed
    assert found == pytest.approx([*[np.inf] * 3, 65.0 / 0.2, 65.0 / 0.2, -200.0])
    whole = demands(walker, n, 5.0, 1)[0][0]
    assert whole == pytest.approx([*[np.inf] * 5, (10.0 + 60.0 - 70.0) / 0.6])


PUSH = ba.TorquePulse([30.0, 30.0, 30.0, 30.0, 0.0], step=1, start=0.1, stop=0.2503)


def test_the_mean_force_is_the_change_of_momentum(biped, gait):
    """int F dt of the ground's force over 50 nodes against the change of m v_com, which Pinocchio gives at the
    stored states, less weight and the pull on the torso. A force left out or doubled breaks it."""
    pull = ba.TorquePulse([-60.0, 20.0, 0.0], step=1, start=0.13, stop=0.21)
    push = PUSH + ba.OnLink(biped, biped.description.trunk, pull)
    heavier = ba.ModelErrors(mass={"torso": 0.1}).apply(biped)
    walker = ba.Walker(heavier, ba.NPDController(gait.constraint), push, model=biped)
    s = ba.walk(walker, gait, impacts=1, method=ba.RK4(H)).signals
    p = np.array([heavier.momentum(q, v) for q, v in zip(s.q, s.v, strict=True)])
    # once more, by the Jacobian of the COM
    J = np.array([heavier.pinned.mass_jacobian(q) @ v for q, v in zip(s.q, s.v, strict=True)])
    assert np.max(np.abs(p - J)) < 1e-9
    assert np.max(np.abs(p - s.momentum)) < 1e-9
    rows = np.flatnonzero(np.diff(s.t, prepend=-1.0) > 0.0)
    compared = 0
    for i in rows[:: len(rows) // 40]:
        j = rows[rows > i][:50]
        if len(j) < 50:
            break
        j, t = j[-1], s.t
        pulled = max(0.0, min(t[j], 0.21) - max(t[i], 0.13)) * np.array([-60.0, 20.0])
        change = p[j] - p[i] + heavier.weight * (t[j] - t[i]) * np.array([0.0, 1.0]) - pulled
        F = s.ground_reaction[i : j + 1]
        found = np.trapezoid(F, t[i : j + 1], axis=0)
        # a repeated time at the last node is its left side first: nothing between the two
        assert np.max(np.abs(found - change)) < 1e-4 * np.max(np.abs(change)), (t[i], t[j])
        compared += 1
    assert compared > 30


def test_a_walk_is_judged_by_all_its_steps_and_cut_at_the_first_violation(biped, gait):
    """300 N m on the torso in single support 2 break limits there: `until_infeasible` keeps the same states
    up to the node before the first violation, and a walk asked to stay `within` limits ends at the same
    one."""
    push = ba.TorquePulse([0.0, 0.0, 0.0, 0.0, 300.0], step=2, start=0.1, stop=0.2)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), push)
    walk = ba.walk(walker, gait, impacts=3)
    found = walk.feasibility
    assert found.outcome == outcome_of(walk.trajectory.status, found.reasons) != "infeasible"
    assert found.feasible_impacts == 1
    assert found.reasons
    cut = walk.until_infeasible()
    assert cut.trajectory.status is ba.Status.INFEASIBLE
    assert "single support 2" in cut.trajectory.detail
    assert "push less" in cut.trajectory.status.value
    assert outcome_of(ba.Status.INFEASIBLE, ()) == "ended"
    one, other = walk.trajectory.arcs[1], cut.trajectory.arcs[1]
    assert other.event is None
    assert np.array_equal(one.x[: len(other.x)], other.x)
    assert cut.trajectory.t_end > 0.1 + one.mode.start  # not before the push
    assert cut.trajectory.t_end < walk.trajectory.t_end
    first = first_violation(walker, Nodes.of(walk.signals), KNOWN, 3)
    assert other.t[-1] <= first.t < one.t[len(other.t)]
    asked = ba.walk(walker, gait, impacts=3, within=ba.Limits())
    assert asked.trajectory.detail == cut.trajectory.detail


def test_a_feasible_walk_is_left_as_it_is_and_limits_decide(biped, gait):
    """The gait needs a friction of 0.45 and 108 N m, so limits of 0.3 and 60 N m break; with a window of 1 us
    the mean friction is that of the instants."""
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, impacts=2)
    assert walk.feasibility.outcome == "feasible"
    assert walk.feasibility.feasible_impacts == 2
    assert walk.until_infeasible() is walk
    assert walk.feasibility.impulse_ratio == max(c.impulse_ratio for c in walk.certificates)
    strict = walk.feasible_within(ba.Limits(friction=0.3))
    assert (strict.outcome, strict.feasible_impacts) == ("infeasible", 0)
    assert list(strict.reasons) == ["friction", "impulse"]
    assert list(walk.feasible_within(ba.Limits(torque=60.0)).reasons) == ["torque"]
    assert walk.until_infeasible(ba.Limits(friction=0.3)).trajectory.status is ba.Status.INFEASIBLE
    walk = ba.walk(walk.walker, gait, impacts=1, method=ba.RK4(H))
    instant = walk.feasible_within(ba.Limits(window=1e-6))
    assert instant.mean_friction == pytest.approx(
        max(c.friction for c in walk.certificates), rel=1e-3
    )


def test_what_the_model_does_not_know_is_matched_and_unmatched(biped, gait):
    """What the model does not know, `unknown`, comes from the plant's own equation D q'' + Omega = B u + zeta +
    friction: its part in the joints' rows is matched (a motor could cancel it), that in the torso's is not."""
    rubbing = ba.Biped.load("rabbit", friction=True)
    heavier = ba.ModelErrors(mass={"torso": 0.2, "thigh": 0.15}).apply(rubbing)
    for plant, model in ((rubbing, None), (heavier, biped)):
        walker = ba.Walker(plant, ba.NPDController(gait.constraint), PUSH, model=model)
        s = ba.walk(walker, gait, 1, ba.RK4(1e-3)).signals
        assert np.allclose(s.xi_matched + s.xi_unmatched, s.xi - s.xi_nominal, rtol=0.0, atol=1e-9)
        for i in range(0, len(s.t), 37):
            q, v, a = s.q[i], s.v[i], s.a[i]
            terms = biped.reduction(q, v)
            unknown = s.zeta[i] + plant.friction_torque(v)
            unknown += (terms.D - plant.inertia(q)) @ a + terms.Omega - plant.bias(q, v)
            assert np.allclose(s.xi_matched[i], terms.kappa @ unknown[:4], rtol=0.0, atol=1e-8)
            rest = terms.kappa @ (terms.A_N.T @ unknown[4:])
            assert np.allclose(s.xi_unmatched[i], rest, rtol=0.0, atol=1e-8)
    assert np.max(np.abs(s.xi_unmatched)) > 0.5


def test_where_only_the_impulse_asks_for_more_it_is_feasible_but_for_the_impact(bare, published):
    """The limit of friction is 0.1 % below and above the ratio of the impulse, which (7) of the paper gives at
    x-."""
    walk = ba.walk(ba.Walker(bare, ba.NPDController(published.constraint)), published, impacts=2)
    asks = abs(np.divide(*bare.impact(published.q_minus, published.v_minus).impulse))
    assert asks > 0.6  # the friction of RABBIT's record
    assert walk.feasibility.impulse_ratio == pytest.approx(asks, rel=1e-6)
    for share, outcome, impacts in ((0.999, "but_impact", 0), (1.001, "feasible", 2)):
        found = walk.feasible_within(ba.Limits(friction=share * asks))
        assert (found.outcome, found.feasible_impacts) == (outcome, impacts)
    found = walk.feasibility
    assert list(found.reasons) == ["impulse"]
    assert found.text().startswith(
        "it made all steps, feasible but for the impact: step 1: the impulse"
    )
    cut = walk.until_infeasible().trajectory
    assert cut.status is ba.Status.INFEASIBLE
    assert cut.arcs[0].event is None
    assert np.array_equal(cut.final_state, walk.trajectory.arcs[0].event.x_minus)


def test_the_plant_is_judged_and_not_the_model(biped, gait):
    """A plant with half the torso's mass presses less on the ground, by more than half of the weight that it
    lacks, though the controller believes in the whole mass.
    """
    light = ba.ModelErrors(mass={"torso": -0.5}).apply(biped)
    law = ba.NPDController(gait.constraint)
    needed = [
        ba.walk(ba.Walker(plant, law, model=biped), gait, 1).certificates[0].mean_normal_force
        for plant in (biped, light)
    ]
    assert needed[0] - needed[1] > 0.5 * (biped.weight - light.weight)


def test_steps_shorter_than_the_window_are_judged_as_a_whole(walker, biped, gait):
    """The window is two steps long. The mean force F of a step is then its change of momentum: T F = p- - p+
    + T m g e_z, with p = m v_com after one impact (+) and before the next (-)."""
    q, v = gait.start(biped)
    change = biped.momentum(gait.q_minus, gait.v_minus) - biped.momentum(q, v)
    F = change / gait.period + biped.weight * np.array([0.0, 1.0])
    walk = ba.walk(walker, gait, impacts=2)
    for c in walk.certified(ba.Limits(window=2.0 * gait.period)):
        assert c.mean_normal_force == pytest.approx(F[1], rel=1e-5)
        assert c.mean_friction == pytest.approx(abs(F[0]) / F[1], rel=1e-4)


def test_a_foot_that_comes_from_lower_ground_does_not_scuff(biped, gait):
    """After a step up the old foothold lies below both of the next single support."""
    law = ba.NPDController(continued(gait.constraint))
    up = ba.Walker(biped, law, ground_steps=(StepUp(1, 0.01),))
    walk = ba.walk(up, gait, 2)
    assert [c.scuffing for c in walk.certificates] == [0.0, 0.0]
    s = walk.signals.of_step(2)
    deep = s.swing_foot[:, 1].copy()
    assert np.min(deep[s.t - s.t[0] > 0.013]) < 0.0  # it is below, and rises
    middle = np.abs(s.t - s.t[0] - 0.2) < 0.01
    deep[middle] = -0.002  # below both footholds, that counts
    dipped = replace(s, swing_foot=np.column_stack((s.swing_foot[:, 0], deep)))
    # row 2 of `demands`: the depth of scuffing at each node
    assert np.max(demands(up, Nodes.of(dipped), 5e-3, 1)[0][2]) == pytest.approx(0.002)


@pytest.mark.parametrize(("gap", "depth"), [(1e-3, 0.0), (-1e-3, 1e-3)])
def test_the_ground_joins_the_footholds_by_straight_lines(walker, gap, depth):
    """From a foothold 20 mm above to one 30 mm below the stance foot, the swing foot moves along both lines, a
    gap above or below them. With risers it is in the ground from the first foothold on: up to 20 mm before the
    stance foot, and 30 mm at 97 % of the way to the next one, less the gap. On a slope lines are the same.
    """
    t = grid()
    x = np.linspace(-0.4, 0.4, len(t))
    height = np.interp(x, [-0.4, 0.0, 0.4], [0.02, 0.0, -0.03]) + gap
    height[[0, -1]] -= gap
    for tilted in (walker, replace(walker, slope=0.05)):
        n = handmade_on(tilted, t, x, height)
        after = n.rows[-1, -4:-2] + ground_axes(tilted.ground_slope)[1]
        (found,) = supports(tilted, n, KNOWN, 1, after)
        assert found.scuffing == pytest.approx(depth, abs=1e-12)
        assert list(found.infeasible()) == (["scuffing"] if depth else [])
    # x at 97 % of the time is 0.94 of the way; nodes are 0.2 mm apart
    (found,) = supports(walker, handmade_on(walker, t, x, height), KNOWN, 1, after)
    assert found.riser == pytest.approx(0.94 * 0.03 - gap, abs=5e-5)


def handmade_on(walker, t, x, height):
    """Nodes of a swing foot that moves along x [m] at these heights [m]."""
    n = handmade(walker, t, np.full(len(t), WEIGHT), height=height)
    n.rows[:, -2] = x
    return n


# -- the first violation ---------------------------------------------------------------------------
LATER = {"torque": 0.0, "scuffs": 0.0, "F_N": 3.75e-3, "friction": 3.6e-3}
"""Delay [s] from the beginning of a violation until it is found: forces are means over 5 ms, which leave the
friction cone later; torque and depth count at once."""


def beginning(walker, **begins):
    """Nodes of a feasible single support, the ground pushing with 300 N, except that from its time [s] on each
    violation named in `begins` is there: beginning(walker, torque=0.1) asks for 151 N m from 0.1 s on."""
    t = grid()

    def since(name, before, after):
        return np.where(t >= begins.get(name, np.inf), after, before)

    u = np.outer(since("torque", 149.0, -151.0), [0.0, 0.0, 1.0, 0.0])
    forces = since("F_N", 300.0, -100.0), since("friction", 0.0, -250.0)
    return handmade(walker, t, *forces, since("scuffs", 0.05, -0.002), u)


def first_in(walker, n, finished=True):
    """The first violation of a single support, with an impulse along the normal at its end."""
    return first_violation(
        walker, n, KNOWN, int(finished), n.rows[-1, -4:-2] + np.array([0.0, 1.0])
    )


@pytest.mark.parametrize("first", LATER)
@pytest.mark.parametrize("second", [None, *LATER])
def test_of_two_violations_the_earlier_one_is_reported(walker, first, second):
    """`first` begins at 0.1 s and `second`, if any, at 0.2 s: the report has the kind and time of `first`.
    Means of forces over 5 ms are beyond their limits some time later, `LATER`.
    """
    # if both are one kind, 0.1 s counts, which is written last
    begins = {first: 0.1} if second is None else {second: 0.2, first: 0.1}
    found = first_in(walker, beginning(walker, **begins))
    assert found.t == pytest.approx(0.1 + LATER[first], abs=2e-4)
    assert first in found.what


def test_a_feasible_support_has_no_violation_and_nan_in_a_torque_is_one(walker):
    """The made-up support keeps all limits (149 of 150 N m); a NaN at node 7 is the first violation, at its
    time."""
    feasible = beginning(walker)
    assert first_in(walker, feasible) is None
    feasible.rows[7, 9] = np.nan  # u of the second joint at node 7
    assert first_in(walker, feasible).t == feasible.at.t[7]


def test_the_end_of_a_step_counts_unless_the_foot_comes_down_there(walker):
    """The foot is 2 mm deep from 0.395 s of 0.4 s on: in the last 3 % of a step that is the touchdown, but
    not of a step that has none. first_in(walker, nodes) is the first violation of these nodes."""
    late = beginning(walker, scuffs=0.395)
    assert first_in(walker, late) is None
    assert first_in(walker, late, finished=False).t == pytest.approx(0.395)


# -- what the URDF states of the joints ------------------------------------------------------------
BODY = (
    '<link name="{}"><inertial><origin xyz="0 0 {}"/><mass value="5"/>'
    '<inertia ixx="0.1" iyy="0.1" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>'
)
JOINT = (
    '<joint name="{}" type="revolute"><parent link="{}"/><child link="{}"/><origin xyz="0 0 {}"/>'
    '<axis xyz="0 {} 0"/><limit effort="80" velocity="{}" lower="{}" upper="{}"/></joint>'
)
FOOT = (
    '<link name="{0}_foot"/><joint name="{0}_end" type="fixed"><parent link="{0}"/>'
    '<child link="{0}_foot"/><origin xyz="0 0 -0.5"/></joint>'
)


def two_legs():
    """A trunk and two legs; angles of the right one count the other way, and each joint bears another rate."""
    limits = {"left": (1, 3.0, -0.4, 1.5), "right": (-1, 5.0, -1.2, 0.3)}
    legs = [
        BODY.format(leg, -0.2) + FOOT.format(leg) + JOINT.format(f"{leg}_hip", "trunk", leg, 0, *x)
        for leg, x in limits.items()
    ]
    return f'<robot name="own">{BODY.format("trunk", 0.3)}{"".join(legs)}</robot>'


def compass_with_a_motor():
    """One motor between two legs: its coordinate changes its sign at an impact."""
    legs = [BODY.format(leg, -0.2) + FOOT.format(leg) for leg in ("one", "other")]
    hip = JOINT.format("hip", "one", "other", 0, 1, 4.0, -0.3, 1.0)
    return f'<robot name="own">{"".join(legs)}{hip}</robot>'


@pytest.mark.parametrize("text", [two_legs(), compass_with_a_motor()], ids=["two", "between"])
def test_rate_and_range_are_those_of_the_joint_behind_a_coordinate(tmp_path, text):
    """They are compared with Pinocchio's reading of the URDF: rates and angles of its joints come from the pose
    as drawn, in single supports 1 and 2, at random states. A leg taken for the other has the wrong limit.
    """
    # text: two legs, on whose right joint angles count the other way, or a motor between two legs
    path = tmp_path / "own.urdf"
    path.write_text(text)
    biped = ba.biped_from_urdf(path)
    stated, p = pin.buildModelFromUrdf(str(path)), biped.p
    places = [stated.joints[stated.getJointId(j)].idx_q for j in biped.description.actuated]
    low, high = stated.lowerPositionLimit[places], stated.upperPositionLimit[places]
    walker = ba.Walker(biped, ba.Passive())
    random, broken = np.random.default_rng(3), set()
    for step in (1, 2) * 20:
        q, v = random.normal(0.0, 0.6, biped.n), random.normal(0.0, 3.0, biped.n)
        drawn, dt = joint_values(biped, q, step), 1e-4
        later = joint_values(biped, q + dt * v, step)
        angle = np.array([drawn[name] for name in biped.description.actuated])
        rate = (np.array([later[name] for name in biped.description.actuated]) - angle) / dt
        shares, beyond = (
            np.abs(rate) / stated.velocityLimit[places],
            np.maximum(low - angle, angle - high),
        )
        # momentum, height of the ground, and of the swing foot, which is high enough
        none, mass = np.zeros(p), np.array([0.0, 0.0, 0.0, 0.1])
        row = np.concatenate(([0.0, step, 0.0, 0.0], none, none, q, v[:p], mass))
        (found,) = supports(walker, Nodes(row[np.newaxis], biped.n, p), KNOWN, 0)
        assert found.rate_share == pytest.approx(np.max(shares), rel=1e-6)
        assert found.beyond_range == pytest.approx(max(np.max(beyond), 0.0), abs=1e-12)
        texts = found.infeasible()
        assert ("rate" in texts, "range" in texts) == (np.max(shares) > 1.0, np.max(beyond) > 0.0)
        if "range" in texts:
            k = np.argmax(beyond)
            name = biped.description.actuated[k]
            assert f"{name} is " in texts["range"]
            assert f"from {low[k]:g} to {high[k]:g} rad" in texts["range"]
            broken.add((step, name))
        if "rate" in texts:
            k = np.argmax(shares)
            assert (
                f"{biped.description.actuated[k]} turns at {abs(rate[k]):.4g} rad/s"
                in texts["rate"]
            )
    assert len(broken) == 2 * p  # each joint was out of its range in both supports


def test_a_walk_beyond_a_rate_or_a_range_is_not_feasible_and_names_the_joint(slow_knee):
    """`slow_knee`: a right knee for 2 rad/s and angles below -0.1 rad. It is the swing knee (coordinate 3) in
    step 1 and the stance knee (2) in step 2; the walk is cut where the rate first is above 2 rad/s."""
    gait = ba.load_gait("v0.6", slow_knee)
    walker = ba.Walker(slow_knee, ba.NPDController(gait.constraint), timing=ba.SampledTime(1e-3))
    walk = ba.walk(walker, gait, impacts=2)
    s, found = walk.signals, walk.feasibility
    rate, angle = np.abs(s.v[s.step == 1.0, 3]), s.q[s.step == 2.0, 2]
    assert found.outcome == "infeasible"
    assert found.reasons == {
        "rate": f"step 1: right_knee turns at {np.max(rate):.4g} rad/s > 2",
        "range": f"step 2: right_knee is {np.max(angle) + 0.1:.3g} rad beyond its range from -2.5 to -0.1 rad",
    }
    assert [x.rate_share for x in found.supports] == pytest.approx(
        [np.max(rate) / 2.0, np.max(np.abs(s.v[s.step == 2.0, 2])) / 2.0]
    )
    assert [x.beyond_range for x in found.supports] == pytest.approx([0.0, np.max(angle) + 0.1])
    assert [c.infeasible() for c in walk.certificates] == [x.infeasible() for x in found.supports]
    cut = walk.until_infeasible().trajectory
    assert cut.status is ba.Status.INFEASIBLE
    assert "right_knee turns at" in cut.detail
    assert cut.t_end == s.t[np.argmax(rate > 2.0)]
    row = run_trials([_scenario(slow_knee).record()])[0]
    assert (row["outcome"], row["bad_rate"], row["bad_range"]) == ("infeasible", 1, 1)
    assert row["bad_torque"] == 0


def _scenario(biped):
    record = biped.description.urdf.with_name("robot.toml")
    return ba.Scenario("NPD", robot=str(record), gait="v0.6", run={"impacts": 2}, hardware="ideal")


def test_single_supports_of_a_stepper_are_judged_by_the_same_limits(slow_knee):
    """A stepper walks tick by tick; its verdicts on two single supports are those of the whole walk, on a
    right knee for 2 rad/s."""
    within = ba.Limits()
    stepper = ba.Stepper(_scenario(slow_knee), within=within)
    stepper.reset()
    over = []
    while len(over) < 2:
        stepper.step()
        over += [support.infeasible() for _, support in stepper.over]
    assert over == ba.walk_scenario(_scenario(slow_knee)).feasibility.broken
    assert [list(texts) for texts in over] == [["rate"], ["range"]]


def test_rabbit_states_neither_rate_nor_range_and_is_judged_by_torque_alone(walker, gait):
    """Without limits in the URDF rate and range are never broken; with a limit of 20 N m the reason names the
    joint of the largest torque."""
    for joint in walker.plant.motor_joints[1]:
        assert (joint.speed, joint.range) == (np.inf, (-np.inf, np.inf))
    found = ba.walk(walker, gait, impacts=1).feasible_within(ba.Limits(torque=20.0))
    (support,) = found.supports
    u = np.abs(ba.walk(walker, gait, impacts=1).signals.u)
    name = walker.plant.description.actuated[np.argmax(np.max(u, axis=0))]
    assert found.reasons["torque"] == f"step 1: {name} has the torque {np.max(u):.4g} N m > 20"
    assert (support.rate_share, support.beyond_range) == (0.0, 0.0)


# -- times and windows -----------------------------------------------------------------------------
def test_the_first_window_after_a_touchdown_counts_at_every_touchdown(biped, gait):
    """The mean over the first 5 ms is that of the change of momentum at the tick 5 ms after the touchdown,
    which the clock reaches up to round-off only; before, no window is whole and the mean is infinite."""
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=ba.SampledTime(1e-3))
    s = ba.walk(walker, gait, impacts=6).signals
    found = demands(walker, Nodes.of(s), 5e-3, 6)[0][0]
    for step in range(1, 7):
        (rows,) = np.nonzero(s.step == step)
        after = s.t[rows] - s.t[rows[0]]
        end = rows[np.flatnonzero(np.abs(after - 5e-3) < 1e-9)[0]]
        change = biped.momentum(s.q[end], s.v[end]) - biped.momentum(s.q[rows[0]], s.v[rows[0]])
        assert found[end] == pytest.approx(change[1] / 5e-3 + biped.weight, rel=1e-6)
        assert np.all(np.isinf(found[rows[after < 5e-3 - 1e-9]]))


def test_clearance_is_that_of_the_middle_of_the_step(biped, gait):
    """A foot that is lowest in the first or the last 3 % of the step has the clearance of the rest, 0.05 m."""
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, impacts=1)
    s = walk.signals
    share = (s.t - s.t[0]) / (s.t[-1] - s.t[0])
    for lowest, begins, ends in ((0.02, 0.0, 0.03), (0.02, 0.97, 1.0), (0.01, 0.03, 0.97)):
        inside = np.flatnonzero((share > begins) & (share < ends))
        for at in (inside[1], inside[-2]):
            height = np.full(len(s.t), 0.05)
            height[[0, -1]] = 0.0  # the footholds
            height[at] = lowest
            heights = np.column_stack((s.swing_foot[:, 0], height))
            (found,) = certificates(walk.walker, walk.trajectory, replace(s, swing_foot=heights))
            # the middle is the part longer than half of the step
            assert found.clearance == (lowest if ends - begins > 0.5 else 0.05)


# -- starts ------------------------------------------------------------------------------------------
@pytest.mark.parametrize("first_step", [1, 2])
def test_a_start_behind_its_touchdown_is_refused_and_one_at_it_walks(
    walker, biped, gait, first_step
):
    """A start after 97 % of a step, the pose turned until the front foot is 1 um to 1 cm in the ground, is
    refused; 1 mm above, at the touchdown, and just after it (the rear foot in the ground) a walk begins. A
    nanometre is round-off: half as much more is refused, half as much is not."""
    s = ba.walk(walker, gait, impacts=1).signals
    k = int(0.97 * len(s.t))
    q, v, foot = s.q[k], s.v[k], ("right_foot", "left_foot")[first_step - 1]

    def turned(depth):
        """The pose turned about the stance foot until the swing foot is so deep in the ground."""
        pose = lambda a: q + a * np.eye(5)[4]  # noqa: E731
        return pose(brentq(lambda a: biped.swing_foot(pose(a))[1] + depth, -0.2, 0.2)), v

    mode = ba.Mode(first_step)
    for depth in (1e-6, 1e-3, 1e-2):
        said = f"swing foot '{foot}' {1e3 * depth:.3g} mm below the ground"
        with pytest.raises(InputError, match=said):
            ba.walk(walker, gait, 1, start=turned(depth), first_step=first_step)
        with pytest.raises(InputError, match=said):
            list(ba.simulate_many([ba.Case(walker, *turned(depth), ba.RK4(1e-3), 1, mode)]))
    above = ba.walk(walker, gait, 1, start=turned(-1e-3), first_step=first_step)
    assert above.trajectory.status is ba.Status.COMPLETED
    with pytest.raises(InputError, match="below the ground"):
        walker.check_foot(*turned(1.5e-9), mode)
    for x in (gait.start(biped), (gait.q_minus, gait.v_minus), turned(0.5e-9)):
        walker.check_foot(*x, mode)
    behind, rates = gait.start(biped)
    low = behind + 1e-3 * np.eye(5)[3]
    assert biped.swing_foot(low)[1] < -1e-5  # behind, it comes out of the ground
    again = ba.walk(walker, gait, 1, start=(low, rates), first_step=first_step)
    assert again.trajectory.status is ba.Status.COMPLETED
