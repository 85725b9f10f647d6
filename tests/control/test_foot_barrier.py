"""The barrier on the swing foot: its derivatives, its bounds, and stones under a load that no model knows.

The barrier is a filter of the torque of the controller inside. It keeps the swing foot within `tolerance` of a
path x_c (the corridor), which follows the reference's foot x_r, whose steps are `step` [m] long, and ends on
the next *stone*, the place where the foot has to come down. e = x - x_c is the foot's error; e'' = G q_b'' + g.
STONES are eight lengths of steps from 0.25 to 0.55 m, and `on_stones` a walk over them; `gait` makes 0.6 m/s.
Gains are K_p = 400 where they are WEAK.
"""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from numpy.polynomial import Polynomial

import biped_adrc as ba
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.control.around import AddedTorque
from biped_adrc.control.foot_barrier import BarrierState, FootBarrier, infeasible_instants
from biped_adrc.core.errors import InputError
from biped_adrc.studies.run import run_trials

WEAK = ba.Gains(400.0, 40.0)
STONES = (0.45, 0.3, 0.5, 0.25, 0.4, 0.55, 0.35, 0.4)
CLOCK = ba.SampledTime(1e-3)


@pytest.fixture(scope="module")
def gait(biped):
    return ba.load_gait("v0.6", biped)


def near_orbit(biped, gait, random, law):
    q, v = gait.start(biped)
    x = q + 0.1 * random.normal(size=5), v + 0.5 * random.normal(size=5)
    return ba.Walker(biped, law).measure(0.0, *x, ba.Mode())


def on_stones(biped, gait, inner, force=None, **values):
    """A walk over STONES; a barrier has them already."""
    law = ba.Footstep.on_gait(inner, gait, biped, speed=0.55, stones=STONES)
    walker = ba.Walker(biped, law, force, timing=CLOCK, torque_limit=150.0, **values)
    return ba.walk(walker, gait, impacts=8)


def misses(walk):
    """By how much each step misses its stone [m]."""
    x = walk.trajectory.before(FOOT_STRIKE)
    return np.array([walk.walker.plant.swing_foot(row[:5])[0] for row in x]) - STONES[: len(x)]


@pytest.mark.parametrize("step", [None, 0.4])
def test_the_error_of_the_foot_moves_as_differences_of_pinocchio_s_foot_say(biped, gait, step):
    """e, e' and e'' = G q_b'' + g against differences along a motion with random q_b'', with e by its
    definition and Pinocchio's foot, for a stone at 0.5 m.

    step: length of the reference's step; None: the reference steps on the stone, and x_c is x_r. q_r is the
    posture of the reference at the same phase, z the share of the step.
    """
    law = FootBarrier(ba.NPDController(gait.constraint), biped, (0.5,), step)
    h, random = gait.constraint, np.random.default_rng(1)

    def error(q):
        theta = h.phase @ q
        q_b = h.h(theta)[0]
        q_r = np.append(q_b, (theta - h.phase[:4] @ q_b) / h.phase[4])
        x_r = biped.swing_foot(q_r)[0]
        z = min(max(x_r / (step or 0.5), 0.0), 1.0)
        x_c = x_r + (0.5 - (step or 0.5)) * z**3 * (10.0 - 15.0 * z + 6.0 * z**2)
        return biped.swing_foot(q)[0] - x_c

    for _ in range(10):
        m, d = near_orbit(biped, gait, random, law), 1e-4
        a = 50.0 * random.normal(size=4)
        ddq = np.append(a, m.terms.A_N @ a + m.terms.a_N)
        behind, here, ahead = (error(m.q + t * m.v + 0.5 * t * t * ddq) for t in (-d, 0.0, d))
        f = law.error(m)
        np.testing.assert_allclose(f.e, here, rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(f.de, (ahead - behind) / (2.0 * d), rtol=0.0, atol=1e-4)
        np.testing.assert_allclose(
            f.G @ a + f.g, (ahead - 2.0 * here + behind) / d**2, rtol=0.0, atol=1e-2
        )


def test_the_corridor_bends_as_its_polynomial_does(biped, gait):
    """x_c(x_r) = x_r + (0.5 - 0.4) beta(x_r / 0.4) and two derivatives, with beta = 10 z^3 - 15 z^4 + 6 z^5,
    for a stone at 0.5 m and reference steps of 0.4 m.
    """
    law, x = (
        FootBarrier(ba.NPDController(gait.constraint), biped, (0.5,), 0.4),
        Polynomial([0.0, 1.0]),
    )
    z = x / 0.4
    x_c = x + 0.1 * (10.0 * z**3 - 15.0 * z**4 + 6.0 * z**5)
    for at in np.linspace(0.0, 0.4, 9):
        expected = [x_c.deriv(k)(at) for k in range(3)]
        np.testing.assert_allclose(law.corridor(at, 0.5), expected, rtol=0.0, atol=1e-12)


def test_the_torque_is_that_of_the_solver_of_the_quadratic_program(biped, gait):
    """min |kappa (u' - u)|^2 under |e'' + 2 lambda e' + lambda^2 e| <= lambda^2 tol with lambda = 100 1/s and
    tol = 3 mm, the defaults: so 200, 1e4 and 30 below.

    u is the torque inside, u' the filter's; both bounds are met among the states (`sides`).
    """
    qpsolvers = pytest.importorskip("qpsolvers")
    inner, random = ba.NPDController(gait.constraint), np.random.default_rng(2)
    law, s, sides = FootBarrier(inner, biped, (0.4,)), BarrierState(np.zeros(0), 0.0), set()
    for _ in range(20):
        m = near_orbit(biped, gait, random, law)
        f, k, u = law.error(m), m.terms.kappa, inner.output(s.inner, m)
        rest = f.g + f.G @ m.terms.xi + 200.0 * f.de + 1e4 * f.e
        G, h = np.array([f.G @ k, -f.G @ k]), np.array([30.0 - rest, 30.0 + rest])
        best = qpsolvers.solve_qp(k.T @ k, -k.T @ k @ u, G, h, solver="daqp", primal_tol=1e-10)
        np.testing.assert_allclose(law.output(s, m), best, rtol=1e-5, atol=1e-4)
        sides.add(np.sign(law.missing(s.inner, m, u)[0]))
    assert sides >= {-1.0, 1.0}


@pytest.mark.parametrize("tolerance", [0.003, 0.01])
def test_the_foot_stays_in_the_corridor_whatever_the_torque_inside(biped, gait, tolerance):
    """The walk is in continuous time, of the model that is known. 60 N m on the swing hip throw the foot out of
    it by more than twice the tolerance. The barrier uses its width and keeps it.
    """
    inner = AddedTorque(ba.NPDController(gait.constraint, WEAK), np.array([0.0, 60.0, 0.0, 0.0]))
    law, largest = FootBarrier(inner, biped, (0.4,), tolerance=tolerance), []
    for acting in (inner, law):
        walker = ba.Walker(biped, acting)
        x = walker.initial_state(*gait.start(biped))
        arc = ba.simulate(walker, x, ba.Mode(), ba.RK4(1e-3), t_end=0.25).arcs[0]
        seen = (
            walker.measure(t, y[:5], y[5:10], ba.Mode()) for t, y in zip(arc.t, arc.x, strict=True)
        )
        largest.append(max(abs(law.error(m).e) for m in seen))
    assert largest[0] > 2.0 * tolerance
    assert 0.8 * tolerance < largest[1] < 1.001 * tolerance


def test_a_walk_in_which_the_filter_never_acts_is_that_of_the_controller_inside_bit_for_bit(
    biped, gait
):
    """The corridor of 1 m is wider than any error of the foot. NPD walks over stones, ADRC, whose state the
    filter hands on, on level ground.
    """

    def on_level(inner):
        return ba.walk(ba.Walker(biped, inner, timing=CLOCK), gait, impacts=2)

    over_stones = partial(on_stones, biped, gait)
    for law, walked in ((ba.NPDController, over_stones), (ba.ADRCController, on_level)):
        inner = law(gait.constraint)
        wide = FootBarrier(inner, biped, STONES, tolerance=1.0)
        alone, filtered = (walked(x) for x in (inner, wide))
        assert np.array_equal(alone.signals.u, filtered.signals.u)
        assert np.array_equal(alone.signals.q, filtered.signals.q)


def test_a_torque_that_no_model_knows_throws_the_foot_off_its_stone_and_not_with_the_barrier(
    biped, gait
):
    """The torque is -25 N m on the swing hip. A stone reaches 25 mm to each side; with the barrier the foot
    misses its middle by less than half of that.
    """
    push, inner = (
        ba.TorqueStep([0.0, -25.0, 0.0, 0.0, 0.0], step=1),
        ba.NPDController(gait.constraint, WEAK),
    )
    alone = on_stones(biped, gait, inner, push)
    kept = on_stones(biped, gait, FootBarrier(inner, biped, STONES), push)
    assert np.max(np.abs(misses(alone))) > 0.025
    assert kept.feasibility.status is ba.Status.COMPLETED
    assert np.max(np.abs(misses(kept))) < 0.0125


def test_with_the_observer_s_estimate_the_barrier_knows_how_the_foot_moves(biped, gait):
    """Under a load of 40 N m on the swing hip that the model does not know, e'' predicted with the observer's
    xi^ is that of the plant; with the model's xi it is off by more than 5 m/s^2.
    """
    push = ba.TorqueStep([0.0, 40.0, 0.0, 0.0, 0.0], step=1)
    inner = ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(500.0))
    law = FootBarrier(inner, biped, (0.4,))
    walker = ba.Walker(biped, law, push)
    x = walker.initial_state(*gait.start(biped))
    arc = ba.simulate(walker, x, ba.Mode(), ba.RK4(5e-4), t_end=0.2).arcs[0]
    t, x, ddq = arc.t[-1], arc.x[-1], arc.dx[-1][5:10]
    m, s = walker.measure(t, x[:5], x[5:10], ba.Mode()), walker.split_state(x)[2]
    u = law.output(s, m)
    G = law.error(m).G
    by_model, by_observer = (
        G @ (m.terms.kappa @ u + xi - ddq[:4])
        for xi in (m.terms.xi, law.estimate(s, m).disturbance)
    )
    assert abs(by_model) > 5.0
    assert abs(by_observer) < 0.01 * abs(by_model)


def test_instants_are_counted_at_which_the_limit_of_the_torque_breaks_the_bounds(biped, gait):
    """20 N m are too few for the corridor at many of the ticks, 10 kN m at none. 0.65 s have 651 ticks, both
    ends counted. A controller without a barrier has no count.
    """
    inner = FootBarrier(ba.NPDController(gait.constraint), biped, (0.5,), step=0.4)
    counts = []
    for limit in (20.0, 1e4):
        walker = ba.Walker(biped, inner, timing=CLOCK, torque_limit=limit)
        run = ba.simulate(
            walker, walker.initial_state(*gait.start(biped)), ba.Mode(), ba.RK4(1e-3), t_end=0.65
        )
        counts.append(infeasible_instants(parts(walker, run.final_state).s))
    assert 50 < counts[0] <= 651
    assert counts[1] == 0
    assert infeasible_instants(np.zeros(0)) is None


def test_a_row_of_a_study_counts_the_infeasible_instants_of_a_barrier(gait):
    """None where no controller has one."""
    values = {"controller.name": "footstep", "controller.inner.name": "foot barrier"}
    values |= {
        "hardware.period": 1e-3,
        "run.impacts": 2,
        "gait.name": "v0.6",
        "ground.stones": (0.4,) * 8,
    }
    without = {**values, "controller.inner.name": "NPD"}
    row, other = run_trials([values, without])
    assert (row["feasible"], row["infeasible_qp"]) == (1, 0)
    assert other["infeasible_qp"] is None


def test_a_controller_without_a_constraint_and_a_zero_tolerance_are_refused(biped):
    """`Passive` tracks nothing, so the barrier has no path for the foot; a corridor of no width has no room."""
    with pytest.raises(InputError, match="virtual constraint"):
        FootBarrier(ba.Passive(), biped)
    with pytest.raises(InputError, match="tolerance"):
        replace(
            FootBarrier(ba.NPDController(ba.load_gait("v0.6", biped).constraint), biped),
            tolerance=0.0,
        )
