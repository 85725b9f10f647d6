"""Where the links of the drawn robot are, against Pinocchio."""

from __future__ import annotations

import numpy as np
import pytest

from biped_adrc.model.biped import Biped
from biped_adrc.view.from_the_side.robot_figure import direction
from biped_adrc.view.placement import joint_values, link_placements

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
