"""Motors with lag in MuJoCo: tau u_m' = u - u_m, by its closed form, by energy and against the rigid plant."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import Load, PlantState
from biped_adrc.engine.compiled_loop import CompiledLoop
from biped_adrc.engine.on_plant import stepping_loop
from biped_adrc.errors import InputError
from biped_adrc.extras.mujoco.mjcf import mjcf
from biped_adrc.extras.mujoco.robot import mujoco
from biped_adrc.hardware.motors import Motors
from biped_adrc.hybrid.simulator import simulate

TICK = ba.SampledTime(1e-3)
TAU = 5e-3
SOFT = {
    "ground.plant": "mujoco",
    "hardware.period": 1e-3,
    "hardware.torque_limit": 150.0,
    "run.impacts": 1,
    "hardware.lag": TAU,
}


class Holds(ba.Controller):
    """Asks for the same torques from the start on."""

    def output(self, s, m):
        return np.array([20.0, -10.0, 5.0, 2.0])


@pytest.mark.parametrize("made", [SteppingLoop, CompiledLoop])
@pytest.mark.parametrize("tau", [1e-5, 50e-3])
def test_the_recorded_torque_is_the_closed_form(made, biped, gait, tau):
    loop = made(ba.MuJoCoPlant(biped, lag=tau), Holds(), None, TICK, biped)
    run = loop.run(loop.initial_state(*gait.start(biped)), ba.RunOptions(0.02))
    arc = run.arcs[0]
    expected = Holds().output(None, None) * (1.0 - np.exp(-arc.t / tau))[:, np.newaxis]
    np.testing.assert_allclose(arc.read["u"], expected, rtol=1e-12, atol=1e-12)


def flown(biped, gait, integrator, h, tau, u):
    """A row after 20 ms in the air under u (4,) [N m] from rest of the motors, and the work of the motors."""
    plant = ba.MuJoCoPlant(biped, h=h, integrator=integrator, lag=tau)
    q, _ = gait.start(biped)
    state = plant.start(0.0, q, np.zeros(5))
    row, work, energy = np.concatenate(state[1:]), 0.0, []
    row[12] += 9.0
    power = [plant.motor_torque(row, u) @ row[5:9]]
    for k in range(200):
        energy.append(energy_of(plant, row))
        row = plant.engine.moved(k * 1e-4, row, u, None, (k + 1) * 1e-4)
        power.append(plant.motor_torque(row, u) @ row[5:9])
    work = 1e-4 * (np.sum(power) - 0.5 * (power[0] + power[-1]))
    return row, work, energy_of(plant, row) - energy[0]


def energy_of(plant, row):
    mj = mujoco()
    plant.engine.place(row)
    mj.mj_forward(plant.model, plant.data)
    mj.mj_energyPos(plant.model, plant.data)
    mj.mj_energyVel(plant.model, plant.data)
    return float(np.sum(plant.data.energy))


U = np.array([40.0, -30.0, 20.0, -10.0])


def test_in_the_air_the_motors_give_the_energy_that_u_m_says(biped, gait):
    """From rest, by differences of the energy; with u in the place of u_m it would be several times as much."""
    bare = replace(biped, friction=False)
    _, work, gained = flown(bare, gait, "rk4", 1e-4, 20e-3, U)
    _, by_u, _ = flown(bare, gait, "rk4", 1e-4, 0.0, U)
    assert gained == pytest.approx(work, rel=1e-3)
    assert by_u > 3.0 * work > 0.01


def test_no_lag_is_the_limit(biped, gait):
    """Linear in tau, also where tau is far below the engine's step."""
    ideal, *_ = flown(biped, gait, "leapfrog", 1e-4, 0.0, U)
    gaps = [
        np.max(np.abs((flown(biped, gait, "leapfrog", 1e-4, tau, U)[0][:15] - ideal)[5:10]))
        for tau in (1e-5, 1e-6)
    ]
    assert gaps[0] / gaps[1] == pytest.approx(10.0, rel=0.05)


def test_the_angles_are_of_second_order_in_the_engines_step(biped, gait):
    soft = ba.SoftGround(time_constant=5e-3)
    plants = [ba.MuJoCoPlant(biped, soft, h=1e-3 / k, lag=1e-3) for k in (2, 4, 64)]
    rows = []
    for plant in plants:
        row = np.concatenate(plant.start(0.0, *gait.start(biped))[1:])
        row[12] += 9.0
        for k in range(10):
            row = plant.engine.moved(k * 1e-3, row, U, None, (k + 1) * 1e-3)
        rows.append(row[:5])
    coarse, fine = (np.max(np.abs(row - rows[2])) for row in rows[:2])
    assert coarse / fine == pytest.approx(4.0, rel=0.05)


def test_it_moves_as_the_rigid_plant_with_this_lag(biped, gait):
    """Over 60 ms of a single support the lag does the same, within 2 % (1 % was measured)."""
    law, start = ba.NPDController(gait.constraint), gait.start(biped)
    walkers = [
        ba.Walker(biped, law, timing=TICK, motors=motors) for motors in (None, Motors(lag=TAU))
    ]
    ground = ba.SoftGround(friction=2.0, time_constant=2e-3)
    moved = []
    for walker in walkers:
        x0 = walker.initial_state(*start)
        rigid = simulate(walker, x0, Mode(), ba.RK4(1e-4), t_end=0.06)
        loop = stepping_loop(walker, ba.MuJoCoPlant(biped, ground))
        soft = loop.run(loop.initial_state(*start), ba.RunOptions(0.06))
        moved.append((rigid.final_state[:5], soft.final_state[:5]))
    (rigid, soft), (rigid_lag, soft_lag) = moved
    by_lag = rigid_lag - rigid
    np.testing.assert_allclose(
        soft_lag - soft, by_lag, rtol=0.0, atol=0.02 * np.max(np.abs(by_lag))
    )


def test_a_walk_of_a_scenario_has_u_m_as_on_the_rigid_plant(biped, gait):
    walks = [
        ba.walk_scenario(ba.Scenario("NPD", run={"engine": e}, **SOFT))
        for e in ("compiled", "pinocchio")
    ]
    for walk in walks:
        assert walk.trajectory.settings["plant"]["lag"] == TAU
        x, k = walk.signals, walk.walker.held.sizes
        assert k.lag == 1
        # u_m of the signals goes to what is held of the asked torque, stretch by stretch
        asked = walk.trajectory.arcs[0].x[:, -4:]
        mine = x.step == 1
        u, t = x.u[mine], x.t[mine]
        stretch = np.flatnonzero(np.diff(t) > 0.0)
        left = np.exp(-np.diff(t)[stretch] / TAU)[:, np.newaxis]
        expected = asked[stretch] + left * (u[stretch] - asked[stretch])
        np.testing.assert_allclose(u[stretch + 1], expected, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(walks[0].signals.u, walks[1].signals.u, rtol=1e-5, atol=1e-4)


def test_a_rate_limit_stays_and_what_does_not_fit_is_said(biped, gait):
    law = ba.NPDController(gait.constraint)
    walker = ba.Walker(biped, law, timing=TICK, motors=Motors(1e4, TAU))
    loop = stepping_loop(walker, ba.MuJoCoPlant(biped))
    assert loop.motors == Motors(1e4)
    assert loop.plant.lag == TAU
    for wrong in (
        lambda: stepping_loop(walker, ba.MuJoCoPlant(biped, lag=1e-3)),
        lambda: ba.MuJoCoPlant(biped, lag=-1.0),
        lambda: SteppingLoop(ba.MuJoCoPlant(biped), law, None, TICK, biped, motors=Motors(lag=TAU)),
    ):
        with pytest.raises(InputError, match="lag"):
            wrong()


def test_the_ground_carries_what_motors_with_lag_press(biped, gait):
    """Forces at a touchdown and in the readings are those under u_m, not under u."""
    plant, ideal = ba.MuJoCoPlant(biped, lag=TAU), ba.MuJoCoPlant(biped)
    state, u = plant.start(0.0, *gait.start(biped)), 5.0 * U
    row, _ = plant.stride(0.0, np.concatenate(state[1:]), u, None, 2e-3)
    found = plant.forces()
    u_m, still = u * (1.0 - np.exp(-2e-3 / TAU)), Load(np.zeros(5), np.zeros(2))
    expected = ideal.footing(PlantState(2e-3, row[:5], row[5:10], row[10:15]), u_m, still).force
    np.testing.assert_allclose(found, expected, rtol=1e-6)
    own = PlantState(2e-3, row[:5], row[5:10], row[10:])
    np.testing.assert_allclose(plant.footing(own, u, still).force, expected, rtol=1e-6)
    assert np.max(np.abs(expected)) > 100.0


def test_its_file_has_the_lag(biped):
    """MuJoCo's own integration of u_m, by RK4, against the closed form."""
    mj = mujoco()
    model = mj.MjModel.from_xml_string(mjcf(ba.MuJoCoPlant(biped, lag=TAU)))
    data = mj.MjData(model)
    data.ctrl[:] = U
    mj.mj_step(model, data, 50)
    np.testing.assert_allclose(data.act, U * (1.0 - np.exp(-data.time / TAU)), rtol=1e-8)
