"""Gait (b), the recipe of section IV."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.errors import GaitError
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.recipe import (
    HUMAN_STEP,
    fit_to_x_star,
    impact_smoothness,
    inverse_kinematics,
    joint_trajectories,
    recipe_constraint,
    regress,
)
from biped_adrc.gait.through_state import onto_section


def test_inverse_kinematics_inverts_the_leg():
    for thigh, knee in ((3.2, -0.6), (3.6, -0.1), (2.9, -1.2)):
        leg = sum(0.4 * np.array([-np.sin(a), np.cos(a)]) for a in (thigh, thigh + knee))
        assert inverse_kinematics(leg, 0.4) == pytest.approx((thigh, knee), abs=1e-12)
    with pytest.raises(GaitError, match="reaches"):
        inverse_kinematics(np.array([0.0, -0.9]), 0.4)


def test_the_feet_and_the_hip_go_where_the_recipe_says(biped):
    p = fit_to_x_star(biped)
    s = np.linspace(0.0, 1.0, 21)
    q = joint_trajectories(biped, p, s)
    L = p.step_fraction * HUMAN_STEP
    pose = onto_section(biped, X_STAR[:5])
    hip = np.array([biped.hip(row) for row in q])
    foot = np.array([biped.swing_foot(row) for row in q])
    assert hip[:, 0] == pytest.approx(biped.hip(pose)[0] - L * (1 - s), abs=1e-12)
    lift = np.sin(np.pi * s)
    assert hip[:, 1] == pytest.approx(biped.hip(pose)[1] + p.hip_amplitude * lift, abs=1e-12)
    assert foot[:, 1] == pytest.approx(p.clearance * lift, abs=1e-12)
    assert foot[[0, -1], 0] == pytest.approx([-L, L], abs=1e-12)
    assert q[-1] == pytest.approx(pose, abs=1e-12)
    assert q[0] == pytest.approx(pose[biped.relabelling], abs=1e-12)


def test_regression_keeps_the_ends_and_is_close_between():
    theta = np.linspace(3.3, 2.9, 101)
    joints = np.column_stack((np.sin(5 * theta), np.cos(3 * theta)))
    curve, residual = regress(theta, joints, 8)
    assert residual < 1e-6
    assert curve(0.0)[0] == pytest.approx(joints[0], abs=1e-14)
    assert curve(1.0)[0] == pytest.approx(joints[-1], abs=1e-12)


def test_positions_close_and_rates_do_not(any_biped):
    """The impact is smooth for the gait through x*, and is not for the recipe, as section VII admits."""
    c, residual = recipe_constraint(any_biped, fit_to_x_star(any_biped))
    R = any_biped.relabelling[:4]
    assert c.h(c.theta_plus)[0] == pytest.approx(c.h(c.theta_minus)[0][R], abs=1e-12)
    assert residual < 1e-3
    smooth = impact_smoothness(ba.load_gait("published", any_biped), any_biped)
    rough = impact_smoothness(ba.load_gait("recipe", any_biped), any_biped)
    assert np.max(np.abs(smooth)) < 1e-9
    assert np.max(np.abs(rough)) > 0.5


def test_stored_recipe_is_a_cycle_of_the_closed_loop(biped):
    gait = ba.load_gait("recipe", biped)
    made = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 2, ba.RK4(1e-3))
    x = np.append(gait.q_minus, gait.v_minus)
    assert np.max(np.abs(made.trajectory.before("foot_strike")[-1] - x)) < 1e-6
    fresh, _ = recipe_constraint(biped, fit_to_x_star(biped))
    stored = gait.constraint.curve.coefficients
    assert fresh.curve.coefficients == pytest.approx(stored, abs=1e-8)
