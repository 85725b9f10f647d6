"""The robot as a file for MuJoCo's viewer: read back it is the model that walks, and refusals are sentences."""

from __future__ import annotations

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError, OutputError
from biped_adrc.extras.mujoco.mjcf import mjcf, write_mjcf
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import mujoco
from biped_adrc.model.ground import SoftGround

GROUND = SoftGround(0.55 + 1e-9, 3e-3 / 7, 0.9 + 1e-9, (0.9 + 1e-9, 0.95), 7.0, 1e-3 / 3)
"""Numbers of more than six digits."""


def read_back(text):
    """The model of MuJoCo in a text."""
    return mujoco().MjModel.from_xml_string(text)


@pytest.mark.parametrize("robot", [("rabbit", "tac2003"), ("three_link", None)])
def test_the_file_read_back_is_the_model_that_walks(robot):
    """All numbers of MuJoCo's model but shapes and lengths are the same bit for bit. Masses, slope and ground
    have more than the six digits that MuJoCo would write itself.
    """
    errors = ba.ModelErrors(mass={"torso": 1e-9 / 3})
    biped = errors.apply(ba.Biped.load(*robot, friction=True))
    plant = MuJoCoPlant(biped, GROUND, 0.1 / 3, h=4e-5)
    model = read_back(mjcf(plant))
    arrays = [
        x for x in dir(model) if x.startswith(("body_", "jnt_", "dof_", "actuator_", "pair_"))
    ]
    for name in (*arrays, "qpos0"):
        # lengths: MuJoCo estimates scales of joints (dof_length) and of motors from the shapes
        if not any(skipped in name for skipped in ("geom", "bvh", "length")):
            expected = getattr(plant.model, name)
            np.testing.assert_array_equal(getattr(model, name), expected, err_msg=name)
    for name in ("timestep", "integrator", "gravity", "impratio", "cone", "disableflags"):
        np.testing.assert_array_equal(getattr(model.opt, name), getattr(plant.model.opt, name))


def test_shapes_are_seen_and_touch_nothing(biped):
    """The shapes are Rabbit's own, and three more: two feet and the ground. No shape touches another by
    itself (feet and ground do by MuJoCo's <pair>), and masses are those without shapes.
    """
    plant = MuJoCoPlant(biped)
    model = read_back(mjcf(plant))
    assert model.ngeom == 3 + sum(len(link.visuals) for link in biped.tree.links.values())
    assert not np.any(model.geom_contype)
    assert not np.any(model.geom_conaffinity)
    np.testing.assert_array_equal(model.body_mass, plant.model.body_mass)
    first = biped.tree.links["left_shin"].visuals[0]
    seen = [k for k in range(model.ngeom) if model.geom_bodyid[k] == model.body("left_shin").id]
    # MuJoCo's cylinders have half the length
    assert model.geom_size[seen[0], :2] == pytest.approx([first.size[0], first.size[1] / 2])


def test_the_start_of_a_gait_is_a_keyframe_on_the_ground(biped, gait):
    """In the file's keyframe the stance foot is at the origin, up to the 1e-6 m that it is pressed into the
    ground, the swing foot where the robot's kinematics has it, and rates are the gait's.
    """
    plant = MuJoCoPlant(biped)
    model = read_back(mjcf(plant, gait))
    data = mujoco().MjData(model)
    mujoco().mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco().mj_forward(model, data)
    q, v = gait.start(biped)
    assert data.body("left_foot").xpos == pytest.approx([0.0, 0.0, 0.0], abs=2e-6)
    apart = data.body("right_foot").xpos - data.body("left_foot").xpos
    np.testing.assert_allclose(apart[[0, 2]], biped.swing_foot(q), rtol=0.0, atol=1e-12)
    np.testing.assert_array_equal(data.qvel[plant.engine.angles], v)


def test_what_cannot_be_written_is_refused(biped, gait, tmp_path):
    """A suffix other than .xml, steps of the ground, which no such file can have, no plant, and a folder;
    nothing is left behind.
    """
    steps = MuJoCoPlant(biped, ground_steps=(ba.StepDown(2, 5e-3),))
    for plant, path in (
        (MuJoCoPlant(biped), tmp_path / "a.png"),
        (steps, tmp_path / "a.xml"),
        ("rabbit", tmp_path / "a.xml"),
        (MuJoCoPlant(biped), tmp_path),
    ):
        with pytest.raises((InputError, OutputError)):
            write_mjcf(plant, path)
    assert not list(tmp_path.iterdir())
