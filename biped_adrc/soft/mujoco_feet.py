"""Where the feet are in MuJoCo, and how fast the points move that touch the ground."""

from __future__ import annotations

import numpy as np

from biped_adrc.closed_loop.feet import Feet
from biped_adrc.soft.mujoco_robot import mujoco
from biped_adrc.types import Array, MuJoCoData, MuJoCoModel


def feet_of(
    model: MuJoCoModel, data: MuJoCoData, names: tuple[str, str], force: Array, up: Array
) -> Feet:
    """Of the bodies `names` after mj_forward, with their forces (2, 2) [N].

    up (2,) [m]: from the point that touches to the foot's centre; it moves at v + omega x (-up).
    """
    mj, place, speed = mujoco(), np.zeros((2, 2)), np.zeros((2, 2))
    for i, name in enumerate(names):
        moves, body = np.zeros(6), data.body(name)
        mj.mj_objectVelocity(model, data, mj.mjtObj.mjOBJ_XBODY, body.id, moves, 0)
        spin, centre = moves[1], moves[[3, 5]]
        place[i] = body.xpos[[0, 2]]
        speed[i] = centre - spin * np.array([up[1], -up[0]])
    return Feet(force, place, speed)
