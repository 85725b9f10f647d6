"""Where the links of the drawn robot are, against Pinocchio."""

from __future__ import annotations

import numpy as np
import pytest

from biped_adrc.model.biped import Biped
from biped_adrc.scenario.recording import Walk
from biped_adrc.viz.from_the_side.robot_figure import direction
from biped_adrc.viz.placement import WalkScene, joint_values, link_placements

from .pinocchio_view import floating


@pytest.mark.parametrize("step", [1, 2, 7])
def test_links_are_where_pinocchio_puts_them(biped: Biped, step: int) -> None:
    rng = np.random.default_rng(step)
    for _ in range(20):
        q, foothold = rng.uniform(-3.0, 3.0, biped.n), float(rng.uniform(-5.0, 5.0))
        values = joint_values(biped, q, step, foothold)
        ours, theirs = link_placements(biped.tree, values), floating(biped, values)
        for link, placement in theirs.items():
            np.testing.assert_allclose(ours[link], placement, atol=1e-12, err_msg=link)
        stance, swing = ("left", "right") if step % 2 else ("right", "left")
        origin = np.array([foothold, 0.0])
        p_2, hip = biped.swing_foot(q), biped.hip(q)
        np.testing.assert_allclose(ours[f"{stance}_foot"][[0, 2], 3], origin, atol=1e-12)
        np.testing.assert_allclose(ours[f"{swing}_foot"][[0, 2], 3], origin + p_2, atol=1e-12)
        np.testing.assert_allclose(ours["torso"][[0, 2], 3], origin + hip, atol=1e-12)
        thigh = ours[f"{stance}_thigh"][[0, 2], 2]
        np.testing.assert_allclose(thigh, direction(q[4] + q[0]), atol=1e-12)


def test_no_drawn_joint_jumps_at_impact(biped: Biped, walks: dict[str, Walk]) -> None:
    walk = WalkScene.of(walks["NPD"])
    assert len(walk.footholds) == 3
    assert np.all(np.diff(walk.footholds) > 0.2)
    for event in walks["NPD"].trajectory.events("foot_strike")[:-1]:
        before, after = walk.joints(event.t - 1e-9), walk.joints(event.t + 1e-9)
        assert max(abs(before[name] - after[name]) for name in before) < 1e-6


def test_a_pose_is_held_outside_the_run(biped: Biped, walks: dict[str, Walk]) -> None:
    walk = WalkScene.of(walks["ADRC"])
    assert walk.joints(99.0) == walk.joints(walks["ADRC"].trajectory.t_end)
    assert walk.joints(-1.0) == walk.joints(0.0)
