"""Walks as environments of Gymnasium: the interface, and that they are the walks of their scenarios.

`made(**values)` is an environment of a scenario with these values, in which a sample lasts 1 ms and the motors
give 150 N m; an action has a number from -1 to 1 for each motor: its torque, or with action="added" a torque
beside the controller's. `walked(env, seed, samples)` steps with one action, zero by default, and returns
observations, rewards, falls, time limits and infos. An observation has q, v, errors, their rates, u and the
phase: 5, 5, 4, 4, 4 and 1 numbers. SLOW is an observer of 160 rad/s.
"""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.extras.logs.robot_log import logged

ID = "biped_adrc.extras.gym:biped_adrc/Walk-v0"
SLOW = {"controller.observer.bandwidth": 160.0, "controller.observer.order": 1}


def made(**values):
    return gymnasium.make(ID, **values)


def walked(env, seed, samples, action=(0.0, 0.0, 0.0, 0.0)):
    """Columns of what `step` returns at each sample of a walk with one action, until it ends."""
    env.reset(seed=seed)
    rows = [env.step(np.array(action))]
    while len(rows) < samples and not (rows[-1][2] or rows[-1][3]):
        rows.append(env.step(np.array(action)))
    return list(zip(*rows, strict=True))


def state(env):
    """x of the one walk."""
    return env.unwrapped.stage.stepper.sample.x[0]


@pytest.mark.parametrize(
    "values",
    [{}, {"action": "added", "condition": "push on joints", **SLOW}, {"ground.plant": "mujoco"}],
    ids=["torques", "added", "mujoco"],
)
def test_gymnasium_finds_no_fault(values):
    """Warnings are errors here; all render modes are made and drawn, without a screen."""
    check_env(made(**values).unwrapped)


def test_bounds_are_two_turns_the_speed_of_a_runaway_and_the_lower_torque_limit():
    """These are the bounds of q and v; errors and phase have twice as much, and torques the lower of the
    motors' 150 N m and the scenario's limit.
    """
    high = np.repeat([4 * np.pi, 1000.0, 8 * np.pi, 2000.0, 150.0, 8 * np.pi], [5, 5, 4, 4, 4, 1])
    for limit, torque in ((None, 150.0), (200.0, 150.0), (100.0, 100.0)):
        # effort, a weight of the reward, has no effect here
        space = made(effort=1.0, **{"hardware.torque_limit": limit}).observation_space
        high[18:22] = torque
        np.testing.assert_array_equal([space.high, space.low], [high, -high])


CASES = {
    "RABBIT": {"condition": "RABBIT pushed", **SLOW},
    "MuJoCo": {"ground.plant": "mujoco", "hardware.period": 7e-4, **SLOW},  # sums of 0.7 ms round
}


@pytest.mark.parametrize("name", CASES)
def test_nothing_added_is_the_scenarios_own_walk_bit_for_bit(name):
    """With zeros added the environment is at a node of the scenario's walk: after its first impact (step 2) on
    the rigid plant, within the first single support in MuJoCo.
    """
    slow = name == "MuJoCo"
    env = made(action="added", **CASES[name])
    *_, infos = walked(env, 3, 80 if slow else 480)
    t, step = infos[-1]["t"], infos[-1]["step"]
    assert step == (1 if slow else 2)
    s = env.unwrapped.stage.task.scenario.replace(run={"seed": 3, "impacts": 3})
    arc = ba.walk_scenario(s).trajectory.arcs[step - 1]
    row = int(np.searchsorted(arc.t, t))
    assert arc.t[row] == t
    assert np.array_equal(arc.x[row, :10], state(env)[:10])


def test_a_torque_is_the_share_of_the_limit_and_acts_over_the_sample():
    """150 N m times the action, over 1 ms: the state after it is that of another integration, within 1e-6."""
    env = made(start={"speed_spread": 0.0})
    q, v = env.unwrapped.stage.scene.on_orbit
    action = np.array([0.2, -0.1, 0.3, 0.05])
    env.reset(seed=0)
    observation = env.step(action)[0]
    assert np.allclose(observation[18:22], 150.0 * action, rtol=1e-15)
    plant, u = env.unwrapped.stage.plant, 150.0 * action

    def slope(x):
        force = np.append(u, 0.0)
        return np.concatenate((x[5:], plant.acceleration(x[:5], x[5:], force)))

    x, h = np.concatenate((q, v)), 1e-4
    for _ in range(10):  # the midpoint rule, at a tenth of the environment's step
        middle = x + 0.5 * h * slope(x)
        x = x + h * slope(middle)
    assert np.max(np.abs(observation[:10] - x)) < 1e-6


ADDED = [
    {"action": "added", "controller": "NPD", "ground": "mujoco"},
    {"action": "added", "controller": "CLF-QP"},
]


@pytest.mark.parametrize("values", ADDED, ids=lambda values: " ".join(map(str, values.values())))
def test_an_action_of_kind_added_is_added_to_the_torque_of_the_controller(values):
    """The addition changes in the second sample: it is not fixed when the walk begins."""
    env, action, torques = made(**values), np.array([0.1, -0.05, 0.02, 0.03]), []
    for given in (np.zeros(4), action):
        env.reset(seed=0)
        env.step(-action)
        torques.append(env.step(given)[0][18:22])  # u of the observation
    assert np.allclose(torques[1] - torques[0], 150.0 * action, rtol=0.0, atol=1e-9)


def test_observation_and_reward_are_those_of_the_walks_signals():
    """They are compared at two samples, one after the first touchdown, with the signals of the scenario's own
    walk; reward = 1 + tracking / (1 + |e|^2 / 0.1^2) - effort |u|^2 / (4 150^2).
    """
    env = made(action="added", condition="push on joints", tracking=3.0, effort=0.2, **SLOW)
    rows = walked(env, 5, 460)
    s = env.unwrapped.stage.task.scenario.replace(run={"seed": 5, "impacts": 3})
    signals = ba.walk_scenario(s).signals
    for k in (200, 450):
        observation, reward, info = rows[0][k], rows[1][k], rows[4][k]
        i = int(np.searchsorted(signals.t, info["t"]))  # before the sample instant there
        # None: the rates of the errors, which are no column; they are computed below
        expected = (signals.q, signals.v, signals.error, None, signals.u, signals.theta[:, None])
        parts = np.split(observation, [5, 10, 14, 18, 22])
        for part, found in zip(parts, expected, strict=True):
            if found is not None:
                assert np.allclose(part, found[i], rtol=1e-9, atol=1e-11)
        rate = signals.v[i, :4] - signals.dq_d[i]
        assert np.allclose(parts[3], rate, rtol=1e-9, atol=1e-9)
        e, u = signals.error[i], signals.u[i]
        expected = 1.0 + 3.0 / (1.0 + 100.0 * e @ e) - 0.2 * (u @ u) / (4 * 150.0**2)
        assert reward == pytest.approx(expected, rel=1e-9)


def test_a_fall_terminates_and_time_truncates():
    """Without torques the robot falls: terminated, and the last sample pays nothing. A limit of seconds, or of
    impacts, after which step 2 begins, truncates a walk under its controller.
    """
    *_, infos = rows = walked(made(), 1, 2000)
    assert (rows[2][-1], rows[3][-1]) == (True, False)
    assert infos[-1]["status"] == "fell"
    assert rows[1][-1] == 0.0  # the last sample is not paid for being alive
    assert min(rows[1]) >= 0.0
    for limit, value in (("seconds", 0.1), ("run.impacts", 1)):
        rows = walked(made(action="added", **{limit: value}, **SLOW), 1, 2000)
        assert (rows[2][-1], rows[3][-1]) == (False, True)
    assert rows[4][-1]["step"] == 2
    assert walked(made(action="added", seconds=0.1, **SLOW), 1, 999)[4][-1]["t"] == 0.1


@pytest.mark.parametrize("push", [0.0, 60.0])
def test_feasibility_is_that_of_the_walk(push):
    """Feasibility and its extremes in the info are those of the scenario's walk, from the same nodes. push [N
    m]: on the torso; 60 make the walk infeasible.
    """
    pushed = {
        "pushes.0.shape": "pulse",
        "pushes.0.joints": "-q5",
        "pushes.0.torque": push,
        "pushes.0.step": 1,
        "pushes.0.onset": 0.1,
    }
    given = {"controller.name": "NPD", "run.impacts": 2, "start.speed_spread": 0.0}
    env = made(action="added", **given, **pushed)
    info = walked(env, 0, 2000)[4][-1]
    found = ba.walk_scenario(env.unwrapped.stage.task.scenario).outcome.feasibility
    assert info["feasible"] is (not found.reasons) is (push == 0.0)
    assert info["friction"] == pytest.approx(found.mean_friction, rel=1e-9)
    assert info["normal_force"] == pytest.approx(found.mean_normal_force, rel=1e-9)
    peak = max(support.peak_torque for support in found.supports)
    assert info["peak_torque"] == pytest.approx(peak, rel=1e-9)


def test_a_joint_that_turns_faster_than_it_states_is_in_the_verdict_and_not_in_the_spaces(
    slow_knee,
):
    """`slow_knee` is RABBIT whose URDF bounds the rate of one knee below what the gait needs: the walk is
    infeasible, and the bounds of observations are the usual ones.
    """
    record = slow_knee.description.urdf.with_name("robot.toml")
    given = {"controller.name": "NPD", "gait.name": "v0.6", "run.impacts": 1}
    slow, usual = (made(action="added", **given, **x) for x in ({"robot.name": str(record)}, {}))
    assert slow.observation_space == usual.observation_space
    assert [walked(env, 0, 1000)[4][-1]["feasible"] for env in (slow, usual)] == [False, True]


def test_a_seed_repeats_a_start():
    """The random start of a walk follows from the seed of `reset` alone; without one, each reset has another
    seed, and the same row of them after the same first seed.
    """
    env = made(action="added", **CASES["RABBIT"])
    first = [env.reset(seed=k)[0] for k in (1, 2, 1)]
    assert np.array_equal(first[0], first[2])
    assert not np.array_equal(first[0], first[1])
    assert env.reset(seed=7)[1]["seed"] == 7
    drawn = [env.reset()[1]["seed"] for _ in range(3)]
    assert len(set(drawn)) == 3
    env.reset(seed=7)
    assert [env.reset()[1]["seed"] for _ in range(3)] == drawn


WRONG = (
    {"condition": "windy"},
    {"condition": "wrong impact", "ground": "mujoco"},
    {"gate": 3},
    {"action": "wishes"},
    {"hardware.period": None},
    {"controller": "NPD"},
    {"seconds": 0.0},
    {"alive": -1.0},
    {"effort": 2.0},
    {"scenario": ba.Scenario(), "condition": "delay"},
)


@pytest.mark.parametrize("values", WRONG)
def test_what_is_no_task_is_refused(values):
    """WRONG has an unknown condition, one that MuJoCo cannot have, unknown fields and kinds of action,
    continuous time, a controller beside an action that is all of the torque, no time, a negative weight, an
    effort above the reward for being alive, a scenario beside a condition.
    """
    with pytest.raises(InputError):
        made(**values)


def test_a_learner_sees_what_the_robots_computer_logs():
    """Observations are the measured q and v of the scenario's log, also between a touchdown and its notice, in
    the labels of the leg that the computer believes in; 554 is the number of ticks in two steps.
    """
    hardware = {"profile": "rabbit", "touchdown": {"name": "kinematics"}}
    s = ba.Scenario("NPD", hardware=hardware, run={"impacts": 2})
    # alive, a part of the reward, has no effect here
    rows, *_, infos = walked(made(scenario=s, action="added", alive=2.0), 0, 999)
    log = logged(ba.walk_scenario(s))
    assert len(log.t) == len(rows) == 554  # the first one is of the reset there
    seen = np.array(rows[:-1])
    np.testing.assert_array_equal(seen[:, :5], log.q[1:])
    np.testing.assert_array_equal(seen[:, 5:10], log.v[1:])
    assert [x["t"] for x in infos[:-1]] == log.t[1:].tolist()
    assert [x["step"] for x in infos[:-1]] == log.step[1:].tolist()


def test_what_is_no_action_is_refused():
    """A step before the first reset, three numbers, NaN, a word; and options of a reset. The walk is where it
    was.
    """
    env = made().unwrapped
    with pytest.raises(InputError, match=r"call reset\(\) first"):
        env.step(np.zeros(4))
    env.reset(seed=0)
    for action in (np.zeros(3), np.array([0.0, np.nan, 0.0, 0.0]), ["much", 0, 0, 0]):
        with pytest.raises(InputError):
            env.step(action)
    with pytest.raises(InputError, match="expected none"):
        env.reset(options={"pushes.0.torque": 3.0})
    assert env.step(np.zeros(4))[4]["t"] == 0.001  # and the walk goes on
