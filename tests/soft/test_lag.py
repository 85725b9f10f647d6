"""Motors with lag in MuJoCo: tau u_m' = u - u_m, by closed forms and against motors without lag.

u is the torque asked for, u_m the one on the joints; TAU = 5 ms is the lag. TICK is a clock of 1 kHz, SOFT the
values of a scenario in MuJoCo, U four torques.
"""

from __future__ import annotations

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.protocols import Load
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.core.errors import InputError
from biped_adrc.engine.on_plant import CompiledLoop, fastest_loop
from biped_adrc.extras.mujoco.mjcf import mjcf
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import mujoco
from biped_adrc.hardware.motors import Motors
from biped_adrc.model.ground import SoftGround

from .loops import SOFT, TICK, run_of

TAU = 5e-3


class Holds(ba.Controller):
    """Asks for the same torques from the start on."""

    def output(self, s, m):
        return np.array([20.0, -10.0, 5.0, 2.0])


@pytest.mark.parametrize("made", [SteppingLoop, CompiledLoop])
@pytest.mark.parametrize("tau", [1e-5, 50e-3])
@pytest.mark.parametrize("method", ["rk4", "leapfrog"])
def test_the_recorded_torque_is_the_closed_form(made, biped, gait, tau, method):
    """For a constant torque u asked for from the start on, u_m = u (1 - exp(-t / tau)): for lags much shorter
    and longer than the period of 1 ms, in both loops (`made`) and both methods.
    """
    # Holds asks for u; None: no push
    loop = made(MuJoCoPlant(biped, lag=tau, integrator=method), Holds(), None, TICK, biped)
    arc = run_of(loop, gait, 0.02).arcs[0]
    expected = Holds().output(None, None) * (1.0 - np.exp(-arc.t / tau))[:, np.newaxis]
    np.testing.assert_allclose(arc.read["u"], expected, rtol=1e-12, atol=1e-12)


U = np.array([40.0, -30.0, 20.0, -10.0])


def test_the_angles_are_of_second_order_in_the_engines_step(biped, gait):
    """In free flight, 9 m up, where no contact jumps, half the step leaves a quarter of the error; 1/64 ms is
    the exact one. All fly for 10 ms under constant torques U, without a load (None).
    """
    soft = SoftGround(time_constant=5e-3)
    plants = [MuJoCoPlant(biped, soft, h=1e-3 / k, lag=1e-3) for k in (2, 4, 64)]
    rows = []
    for plant in plants:
        row = plant.start(0.0, *gait.start(biped))
        row[12] += 9.0  # z of the base
        for k in range(10):
            row = plant.engine.moved(k * 1e-3, row, U, None, (k + 1) * 1e-3)
        rows.append(row[:5])
    coarse, fine = (np.max(np.abs(row - rows[2])) for row in rows[:2])
    assert coarse / fine == pytest.approx(4.0, rel=0.05)


def test_a_walk_of_a_scenario_has_the_u_m_of_the_closed_form():
    """The recorded torque goes to the torque that is held in x (its last four numbers) by exp(-dt / TAU),
    stretch by stretch; in machine code and in Python alike.
    """
    walks = [
        ba.walk_scenario(
            ba.Scenario("NPD", run={"engine": e, "impacts": 1}, **SOFT, **{"hardware.lag": TAU})
        )
        for e in ("compiled", "pinocchio")
    ]
    for walk in walks:
        assert walk.trajectory.settings["plant"]["lag"] == TAU
        assert walk.walker.held.motors.speed == 1.0 / TAU  # the rate [1/s] of the lag
        arc, u = walk.trajectory.arcs[0], walk.signals.u[walk.signals.step == 1]
        ways, asked = np.diff(arc.t)[:, np.newaxis], arc.x[:-1, -4:]
        expected = asked + np.exp(-ways / TAU) * (u[:-1] - asked)
        np.testing.assert_allclose(u[1:], expected, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(walks[0].signals.u, walks[1].signals.u, rtol=1e-5, atol=1e-4)


def test_a_rate_limit_stays_and_what_does_not_fit_is_said(biped, gait):
    """The lag goes from the motors to the plant, which integrates it, and the rate limit of 1e4 N m/s stays
    with the loop. A lag in both, a negative one, and one in a loop whose plant has none are refused.
    """
    law = ba.NPDController(gait.constraint)
    walker = ba.Walker(biped, law, timing=TICK, motors=Motors(1e4, TAU))
    loop = fastest_loop(walker, MuJoCoPlant(biped))
    assert loop.motors == Motors(1e4)
    assert loop.plant.lag == TAU
    for wrong in (
        lambda: fastest_loop(walker, MuJoCoPlant(biped, lag=1e-3)),
        lambda: MuJoCoPlant(biped, lag=-1.0),
        lambda: SteppingLoop(MuJoCoPlant(biped), law, None, TICK, biped, motors=Motors(lag=TAU)),
    ):
        with pytest.raises(InputError, match="lag"):
            wrong()


def test_the_ground_carries_what_motors_with_lag_press(biped, gait):
    """Forces of the ground under lagging motors are those of ideal motors with the torque u_m, not u: 2 ms
    after the start u_m is a third of u.
    """
    plant, ideal = MuJoCoPlant(biped, lag=TAU), MuJoCoPlant(biped)
    u = 5.0 * U
    # None: no force from outside
    row = plant.advance(0.0, plant.start(0.0, *gait.start(biped)), u, None, 2e-3).row
    found = plant.forces()
    u_m, still = u * (1.0 - np.exp(-2e-3 / TAU)), Load(np.zeros(5), np.zeros(2))
    # [:15]: without u_m, which ideal motors do not have
    expected = ideal.footing(row[:15], u_m, still).force
    np.testing.assert_allclose(found, expected, rtol=1e-6)
    # the row has its own u_m, so that u does not count
    np.testing.assert_allclose(plant.footing(row, u, still).force, expected, rtol=1e-6)
    assert np.max(np.abs(expected)) > 100.0


def test_its_file_has_the_lag(biped):
    """MuJoCo's own integration of u_m, by RK4, is compared with the closed form."""
    mj = mujoco()
    model = mj.MjModel.from_xml_string(mjcf(MuJoCoPlant(biped, lag=TAU)))
    data = mj.MjData(model)
    data.ctrl[:] = U
    mj.mj_step(model, data, 50)
    np.testing.assert_allclose(data.act, U * (1.0 - np.exp(-data.time / TAU)), rtol=1e-8)
