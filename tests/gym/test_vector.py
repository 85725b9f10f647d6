"""Many walks in one call: each of them the walk of one environment, bit for bit."""

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, VectorEnv
from PIL import ImageColor

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.view.colours import STANCE, SWING, TRUNK
from biped_adrc.view.placement import WalkScene

ID = "biped_adrc.extras.gym:biped_adrc/Walk-v0"


def made(count, **values):
    return gymnasium.make_vec(ID, num_envs=count, vectorization_mode="vector_entry_point", **values)


@pytest.mark.parametrize(
    "values",
    [
        {"condition": "RABBIT pushed", "seconds": 0.5},
        {"ground": "mujoco", "seconds": 0.04},
    ],
    ids=["rigid", "mujoco"],
)
def test_each_walk_is_that_of_one_environment_bit_for_bit(values):
    """The comparison goes on beyond falls and time limits. By NEXT_STEP, what ends begins anew at the step
    after.
    """
    count, samples = 3, 60 if "ground" in values else 450
    envs, single = made(count, **values), [gymnasium.make(ID, **values) for _ in range(count)]
    assert isinstance(envs, VectorEnv)
    assert envs.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    rng = np.random.default_rng(0)
    found, _ = envs.reset(seed=10)
    for i, env in enumerate(single):
        assert np.array_equal(found[i], env.reset(seed=10 + i)[0])
    over, again = np.zeros(count, dtype=bool), 0
    for _ in range(samples):
        actions = rng.uniform(-0.5, 0.5, (count, 4))
        found, rewards, fallen, late, infos = envs.step(actions)
        for i, env in enumerate(single):
            if over[i]:
                expected = (env.reset()[0], 0.0, False, False)
                again += 1
            else:
                expected = env.step(actions[i])
            assert np.array_equal(found[i], expected[0])
            assert (rewards[i], fallen[i], late[i]) == tuple(expected[1:4])
            if len(expected) == 5:
                assert {name: infos[name][i] for name in expected[4]} == expected[4]
                # Gymnasium's mask: which walks have this entry
                assert all(infos[f"_{name}"].all() for name in expected[4])
        over = fallen | late
    assert again >= count


def test_the_robot_is_drawn_where_its_walk_stands():
    """After 450 ms, in the second step, the stance foot is at the foothold of the scenario's walk; the pictures
    have the ground in row 320, which is not white, and the colours of legs and trunk.
    """
    s = ba.Scenario("NPD", hardware={"period": 1e-3}, run={"seed": 3})
    envs = made(2, scenario=s, action="added", render_mode="rgb_array").unwrapped
    envs.reset(seed=3)
    for _ in range(450):
        envs.step(np.zeros((2, 4)))
    scene = WalkScene.of(ba.walk_scenario(s.replace(run={"impacts": 2})))
    where = [[scene.footholds[1], scene.heights[1]]] * 2
    np.testing.assert_allclose(envs.stage.feet, where, rtol=0.0, atol=1e-12)
    one, other = envs.render()
    assert one.shape == (360, 480, 3)
    np.testing.assert_array_equal(one, other)
    assert np.all(np.any(one[320] < 255, axis=1))  # the ground, from one edge to the other
    colours = {tuple(x) for x in one.reshape(-1, 3).tolist()}
    assert {ImageColor.getrgb(x) for x in (STANCE, SWING, TRUNK)} <= colours
    assert made(1, scenario=s, action="added").unwrapped.render() is None


def test_what_is_no_vector_is_refused():
    """Two walks need two rows of actions and two seeds."""
    envs = made(2)
    envs.reset(seed=0)
    with pytest.raises(InputError, match=r"shape \(4,\), expected \(2, 4\)"):
        envs.step(np.zeros(4))
    with pytest.raises(InputError, match="3 seeds, expected 2"):
        envs.reset(seed=[1, 2, 3])
