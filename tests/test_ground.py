"""A force on the hip and a step down: power, energy, and the way back to the cycle.

`bare` is RABBIT without rotor inertias and `published` its gait. `down` is a walk of 10 impacts over a step
down of 15 mm at the end of its second single support.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

import biped_adrc as ba
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.disturbances.force import HipForce
from biped_adrc.gait.constraint import continued
from biped_adrc.model.ground import StepDown

METHOD = ba.RK4(2e-3)
HEIGHT = 0.015  # [m]


@pytest.fixture(scope="module")
def down(bare, published):
    """A step down at the end of the second single support."""
    law = ReferenceReset(ba.NPDController(continued(published.constraint)))
    walker = ba.Walker(bare, law, ground_steps=(StepDown(2, HEIGHT),))
    return ba.walk(walker, published, 10, METHOD)


def energy(biped, x):
    return biped.kinetic_energy(x[:5], x[5:10]) + biped.potential_energy(x[:5])


# -- force on the hip ------------------------------------------------------------------------------


def test_the_force_acts_in_its_steps_only(bare):
    """5 N backwards in single supports 2 and 3: it makes torques in these and none before or after."""
    force, q = HipForce(bare, (-5.0, 0.0), steps=(2, 3)), np.full(5, 0.3)
    acts = [bool(np.any(force.zeta(0.0, step, 0.0, q, q))) for step in (1, 2, 3, 4)]
    assert acts == [False, True, True, False]


# -- slope -----------------------------------------------------------------------------------------


@pytest.mark.filterwarnings("ignore:the start has the swing foot 6.25 mm below the ground")
def test_a_walker_without_a_slope_walks_on_that_of_the_gait(bare, published, tmp_path):
    """A slope of 0.02 rad, so that feet come down at z = -tan(0.02) x; no remark says that slopes differ, and
    the stored walk knows its own. The pose is that of level ground: its rear foot is 0.02 * 0.3124 m in
    the ground."""
    gait, law = replace(published, slope=0.02), ba.NPDController(published.constraint)
    walk = ba.walk(ba.Walker(bare, law), gait, 2, METHOD)
    feet = [bare.swing_foot(e.x_minus[:5]) for e in walk.trajectory.events("foot_strike")]
    for x, z in feet:
        assert z == pytest.approx(-np.tan(0.02) * x, abs=1e-9)
    assert not any("slope" in remark for remark in walk.remarks)
    assert ba.load_walk(walk.save(tmp_path / "walk.npz")).walker.slope == 0.02


def test_another_slope_than_that_of_the_gait_is_remarked(bare, published):
    """A walker that is asked for level ground walks on it (z = 0), and the gait's own 0.02 rad are named in a
    warning."""
    gait, law = replace(published, slope=0.02), ba.NPDController(published.constraint)
    with pytest.warns(ba.WalkWarning, match="a slope of 0.02 rad, and the ground has 0 rad"):
        walk = ba.walk(ba.Walker(bare, law, slope=0.0), gait, 1, METHOD)
    x, z = bare.swing_foot(walk.trajectory.events("foot_strike")[0].x_minus[:5])
    assert z == pytest.approx(0.0, abs=1e-9)
    assert x > 0.1


# -- step down -------------------------------------------------------------------------------------


def test_the_height_lost_appears_as_work_the_joints_need_not_do(bare, down):
    """Joint work = energy gained + energy lost at impacts, potential energy in the world's own height."""
    arcs, done = down.trajectory.arcs, down.certificates
    start, end = arcs[0].x[0], arcs[-1].x[-1]
    gained = energy(bare, end) - bare.weight * HEIGHT - energy(bare, start)
    # `end` is just before the last impact, whose loss therefore does not count
    lost = sum(c.energy_lost for c in done[:-1])
    assert sum(c.joint_work for c in done) == pytest.approx(gained + lost, abs=2e-3)
    # 2000 times the tolerance: a height that is left out shows
    assert bare.weight * HEIGHT > 4.0, "[J]"


def test_the_walk_returns_to_its_cycle_at_the_rate_of_the_zero_dynamics(bare, published, down):
    """The step over the edge is longer; what is left of the difference in duration falls from step to step by
    delta^2, the multiplier that a quadrature of the zero dynamics gives."""
    T = np.array([arc.t[-1] - arc.t[0] for arc in down.trajectory.arcs])
    assert T[1] > 1.05 * published.period
    left = T[3:] - published.period
    delta2 = ba.ZeroDynamics.of(bare, published.constraint).delta ** 2
    np.testing.assert_allclose(left[1:] / left[:-1], delta2, atol=0.03)


def test_past_its_end_a_constraint_goes_on_smoothly(published):
    """1e-9 rad on either side of an end the points agree; 0.1 rad past it the polynomial itself is off by 1
    rad."""
    h, d = published.constraint, 1e-9
    c = continued(h)
    q = published.q_minus
    for end, outwards in ((h.theta_minus, -1.0), (h.theta_plus, 1.0)):
        points = []
        for side in (-d, d):
            at = q.copy()
            # the pitch q[4] has the factor 1 in Theta
            at[4] += end + outwards * side - h.phase @ q
            points.append(c(0.0, at, np.array([0.1, 0.2, -0.1, 0.3, -1.0])))
        for inside, outside in zip(*points, strict=True):
            np.testing.assert_allclose(outside, inside, rtol=0.0, atol=1e-3)
    far = q.copy()
    far[4] -= 0.1
    assert np.max(np.abs(c(0.0, far, far).q_d - q[:4])) < 0.3
    assert np.max(np.abs(h(0.0, far, far).q_d - q[:4])) > 1.0


# -- what ends a step --------------------------------------------------------------------------------
@pytest.mark.parametrize("engine", ["pinocchio", "compiled"])
def test_a_walk_is_a_fall_at_the_height_that_was_asked_for(bare, published, engine):
    """fall_height is a share of the hip's height over a straight leg. The gait's hip sinks below 0.93 of it
    in every step: the walk ends just there, to the accuracy of event location."""
    leg = float(np.linalg.norm(bare.hip(np.zeros(5))))
    walker = ba.Walker(bare, ba.NPDController(published.constraint), fall_height=0.93)
    assert walker.lowest_hip == pytest.approx(0.93 * leg, rel=1e-12)
    start = bare.hip(published.start(bare)[0])[1]
    assert start > 0.93 * leg
    made = ba.walk(walker, published, 1, METHOD, engine=engine)
    found = made.trajectory
    assert found.status is ba.Status.FELL
    assert bare.hip(found.final_state[:5])[1] / leg == pytest.approx(0.93, abs=1e-9)


@pytest.mark.parametrize(("ahead", "hits"), [(-2e-3, False), (0.9e-3, False), (1.1e-3, True)])
def test_a_foot_strikes_when_it_is_a_millimetre_ahead(bare, published, ahead, hits):
    """Nearer to the stance foot its coming down is no step: RABBIT's legs pass each other."""
    walker = ba.Walker(bare, ba.NPDController(published.constraint))
    q = published.q_minus.copy()
    around = q[1] - 1.0, q[1] + 1.0  # the swing leg is turned about the hip
    q[1] = brentq(lambda x: bare.swing_foot(np.array([q[0], x, *q[2:]]))[0] - ahead, *around)
    assert bare.swing_foot(q)[0] == pytest.approx(ahead, abs=1e-12)
    x = np.concatenate((q, published.v_minus))
    assert (walker.strike(0.0, x, Mode()) is not None) is hits


def test_the_potential_energy_has_the_height_of_the_foothold(bare, down):
    """Poses are relative to the stance foot, so m g times its height is added; then potential energy is
    continuous over each impact, also down the step of 15 mm."""
    s = down.signals
    assert s.foothold_height[-1] == pytest.approx(-HEIGHT, abs=1e-9)
    for k in (0, len(s.t) // 2, len(s.t) - 1):
        expected = bare.potential_energy(s.q[k]) + bare.weight * s.foothold_height[k]
        assert s.potential[k] == pytest.approx(expected, abs=1e-9)
    after = np.flatnonzero(np.diff(s.step))
    np.testing.assert_allclose(s.potential[after], s.potential[after + 1], rtol=0.0, atol=1e-8)
