"""Gait (b), the recipe of section IV: kinematics, regression, closing, unsmooth impact, stored files."""

from __future__ import annotations

import numpy as np

from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.npd import NPDController
from biped_adrc.gait.gait import load_gait, onto_section
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.zero_dynamics import configuration, impact_jump
from biped_adrc.hybrid.integrators import RK4
from validation.recipe import (
    HUMAN_STEP,
    design_recipe_gait,
    fit_to_x_star,
    inverse_kinematics,
    joint_trajectories,
    recipe_constraint,
)

LENGTH = 0.4  # [m], thigh and shin of RABBIT
EDGE = 1e-6  # share of a step over which end slopes are taken


def test_inverse_kinematics_inverts_the_forward_kinematics(biped):
    """From hip and feet of 200 random poses (LENGTH is that of thigh and shin) the inverse finds the angles q
    again. Hips count from the torso q5, which the feet do not determine; a leg's angle and its knee do not
    depend on it.
    """
    rng = np.random.default_rng(0)
    for q in rng.uniform([2.7, 2.7, -1.5, -1.5, -0.3], [3.7, 3.7, -0.02, -0.02, 0.3], (200, 5)):
        hip, foot = biped.hip(q), biped.swing_foot(q)
        stance, stance_knee = inverse_kinematics(-hip, LENGTH)
        swing, swing_knee = inverse_kinematics(foot - hip, LENGTH)
        found = [stance - q[4], swing - q[4], stance_knee, swing_knee, q[4]]
        np.testing.assert_allclose(found, q, rtol=0.0, atol=1e-9)


def test_the_feet_and_the_hip_follow_the_recipe(biped):
    """Over the share s of a step the hip goes forward evenly and up and down by a half sine, to its place in x*
    at the end; the foot's height is a half sine. Places are by the robot's own kinematics.
    """
    p = fit_to_x_star(biped)
    s = np.linspace(0.0, 1.0, 21)
    q = joint_trajectories(biped, p, s)
    L = p.step_fraction * HUMAN_STEP
    end = biped.hip(onto_section(biped, X_STAR[:5]))
    lift = np.sin(np.pi * s)
    hip = np.column_stack((end[0] - L * (1.0 - s), end[1] + p.hip_amplitude * lift))
    np.testing.assert_allclose([biped.hip(row) for row in q], hip, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(
        [biped.swing_foot(row)[1] for row in q], p.clearance * lift, rtol=0.0, atol=1e-12
    )
    assert np.all(q[:, 2:4] < 0), "a knee bends forwards"


def test_the_step_ends_in_the_pose_of_x_star_and_starts_in_it_relabelled(any_biped):
    """The pose at the end is that of x*, at the start that one relabelled, so that the gait closes in its
    angles. The published x* has three decimals, hence 5e-4.
    """
    pose = onto_section(any_biped, X_STAR[:5])
    constraint, _ = recipe_constraint(any_biped, fit_to_x_star(any_biped))
    end, _, _ = configuration(constraint.phase, constraint.h, constraint.theta_minus)
    begin, _, _ = configuration(constraint.phase, constraint.h, constraint.theta_plus)
    np.testing.assert_allclose(end, pose, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(begin, any_biped.relabel(pose), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(pose, X_STAR[:5], atol=5e-4)


def test_the_path_leaves_in_the_direction_of_the_rates_of_x_star(biped):
    """dq/dTheta at s = 1 is q'/Theta' of x*: all that x* says of its rates but the speed."""
    q = joint_trajectories(biped, fit_to_x_star(biped), np.array([1.0 - EDGE, 1.0]))
    slope = (q[1] - q[0]) / (biped.phase @ (q[1] - q[0]))
    np.testing.assert_allclose(slope, X_STAR[5:] / (biped.phase @ X_STAR[5:]), rtol=0.0, atol=1e-4)


def test_the_impact_is_smooth_on_the_published_gait_and_not_on_the_recipe(any_biped):
    """The jump of the actuated rates off the constraint by the impact [rad/s] is zero for a hybrid-invariant
    gait. The recipe sets no slopes at its ends, as the paper says of it.
    """
    published, recipe = (
        impact_jump(any_biped, gait.constraint, gait.q_minus, gait.v_minus)[1]
        for gait in (load_gait(name, any_biped) for name in ("published", "recipe"))
    )
    assert np.max(np.abs(published)) < 1e-6
    assert np.max(np.abs(recipe)) > 0.5, "[rad/s]"


def test_the_design_reproduces_the_stored_file(biped):
    """Curves, ends of the phase and provenance of gait (b) designed anew are those in the package's file."""
    stored, designed = load_gait("recipe", biped), design_recipe_gait(biped)
    a, b = stored.constraint, designed.constraint
    np.testing.assert_allclose(a.curve.coefficients, b.curve.coefficients, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(
        [a.theta_plus, a.theta_minus], [b.theta_plus, b.theta_minus], rtol=0.0, atol=1e-12
    )
    # "cycle" was added when the orbit of the closed loop took the place of the design's
    written = {k: v for k, v in stored.provenance.items() if k != "cycle"}
    assert written == dict(designed.provenance)


def test_the_stored_state_is_a_fixed_point_of_the_walk_under_npd(any_biped):
    """The walk is that of the closed loop, whose controller brings the robot back to the curve after each
    impact: P(s) = s for the return map P of the simulated walk.
    """
    gait = load_gait("recipe", any_biped)
    walker = Walker(any_biped, NPDController(gait.constraint))
    P = ReturnMap(walker, RK4(1e-3))
    s = P.project(np.concatenate((gait.q_minus, gait.v_minus)))
    np.testing.assert_allclose(P(s), s, rtol=0.0, atol=1e-7)
