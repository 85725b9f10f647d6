"""The robot as a file for MuJoCo's viewer: read back it is the model that walks, and refusals are sentences."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.errors import InputError, OutputError
from biped_adrc.extras.mujoco.engine import Own
from biped_adrc.extras.mujoco.mjcf import mjcf, write_mjcf
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import mujoco

GROUND = ba.SoftGround(0.55 + 1e-9, 3e-3 / 7, 0.9 + 1e-9, (0.9 + 1e-9, 0.95), 7.0, 1e-3 / 3)
"""Numbers of more than six digits."""


def read_back(text):
    """The model of MuJoCo in a text."""
    return mujoco().MjModel.from_xml_string(text)


@pytest.fixture(params=[("rabbit", "tac2003"), ("three_link", None)])
def plant(request):
    """With masses, a slope and a ground that six digits do not hold."""
    biped = ba.Biped.load(*request.param, friction=True)
    links = {
        name: replace(link, inertial=link.inertial.scaled("mass", 1.0 + 1e-9 / 3))
        if link.inertial is not None
        else link
        for name, link in biped.tree.links.items()
    }
    biped = replace(biped, tree=replace(biped.tree, links=links))
    return MuJoCoPlant(biped, GROUND, 0.1 / 3, h=4e-5)


def evaluated(model, qpos, qvel, ctrl):
    """Accelerations, and the forces of each contact in its own axes."""
    mj, data, wrench = mujoco(), mujoco().MjData(model), np.zeros(6)
    data.qpos[:], data.qvel[:], data.ctrl[:] = qpos, qvel, ctrl
    mj.mj_forward(model, data)
    forces = []
    for k in range(data.ncon):
        mj.mj_contactForce(model, data, k, wrench)
        forces.append(wrench[:3].copy())
    return data.qacc.copy(), np.array(forces).reshape(-1, 3), data.qpos.copy()


def test_read_back_it_moves_and_is_carried_as_the_model_that_walks(plant):
    model, random = read_back(mjcf(plant)), np.random.default_rng(2)
    n, touched = plant.n, 0
    for _ in range(20):
        q, v = random.uniform(-1.0, 1.0, n), random.normal(size=n)
        own = Own.of(plant.start(0.0, 0.0 * q, v).own)
        base = plant.biped.floating.configuration(q)[plant.biped.floating.base]
        deep = own._replace(base=base - 2e-4 * np.array(plant.out), speed=random.normal(size=2))
        plant.engine.place(np.concatenate((q, v, deep.numbers())))
        state = (
            plant.data.qpos.copy(),
            plant.data.qvel.copy(),
            random.normal(size=plant.p, scale=30),
        )
        (a, forces, _), (b, others, _) = evaluated(plant.model, *state), evaluated(model, *state)
        np.testing.assert_allclose(b, a, rtol=1e-12, atol=1e-12 * np.max(np.abs(a)))
        np.testing.assert_allclose(others, forces, rtol=1e-12, atol=1e-12 * np.max(np.abs(a)))
        touched += len(forces) > 0
    assert touched == 20
    assert (model.nu, model.opt.timestep) == (plant.p, 4e-5)
    assert model.opt.integrator == plant.model.opt.integrator


def test_shapes_are_seen_and_touch_nothing(biped):
    """Rabbit's own; all but the two feet and the ground are without contact, and nothing has their mass."""
    plant = MuJoCoPlant(biped)
    model = read_back(mjcf(plant))
    assert model.ngeom == 3 + sum(len(link.visuals) for link in biped.tree.links.values())
    assert not np.any(model.geom_contype)
    assert not np.any(model.geom_conaffinity)
    np.testing.assert_array_equal(model.body_mass, plant.model.body_mass)
    first = biped.tree.links["left_shin"].visuals[0]
    seen = [k for k in range(model.ngeom) if model.geom_bodyid[k] == model.body("left_shin").id]
    assert model.geom_size[seen[0], :2] == pytest.approx([first.size[0], first.size[1] / 2])


def test_the_start_of_a_gait_is_a_keyframe_on_the_ground(biped, gait):
    plant = MuJoCoPlant(biped)
    model = read_back(mjcf(plant, gait))
    data = mujoco().MjData(model)
    mujoco().mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco().mj_forward(model, data)
    q, v = gait.start(biped)
    assert data.body("left_foot").xpos == pytest.approx([0.0, 0.0, 0.0], abs=2e-6)
    apart = data.body("right_foot").xpos - data.body("left_foot").xpos
    np.testing.assert_allclose(apart[[0, 2]], biped.swing_foot(q), atol=1e-12)
    np.testing.assert_array_equal(data.qvel[plant.engine.angles], v)


def test_the_command_writes_it(tmp_path):
    path = tmp_path / "rabbit.xml"
    line = ["robot", "export", "rabbit", "--mjcf", str(path), "--gait", "published"]
    line += ["--set", "ground.slope=0"]
    done = CliRunner().invoke(app, line, catch_exceptions=False)
    assert done.exit_code == 0
    assert f"written to {path}" in done.output.replace("\n", "")
    assert mujoco().MjModel.from_xml_path(str(path)).nkey == 1


def test_what_cannot_be_written_is_refused(biped, gait, tmp_path):
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
