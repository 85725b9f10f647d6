"""Leapfrog, against closed forms and against RK4: MuJoCo's Euler method between two shifts of the
positions, half a step forwards before it and half a step back after it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import biped_adrc as ba
from biped_adrc.engine.on_plant import CompiledLoop
from biped_adrc.extras.mujoco.engine import leapfrog
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import mujoco

from .loops import loop_on, run_of

LENGTH, GRAVITY = 0.7, 9.81


def pendulum(h):
    """A point mass on a rod without mass, horizontal at the angle 0."""
    mj = mujoco()
    spec = mj.MjSpec()
    spec.option.timestep, spec.option.gravity = h, [0.0, 0.0, -GRAVITY]
    spec.option.integrator = mj.mjtIntegrator.mjINT_EULER
    body = spec.worldbody.add_body(
        mass=1.3, ipos=[LENGTH, 0.0, 0.0], inertia=[1e-12] * 3, explicitinertial=True
    )
    body.add_joint(type=mj.mjtJoint.mjJNT_HINGE, axis=[0.0, -1.0, 0.0])
    return spec.compile()


def swung(move, h, duration):
    model = pendulum(h)
    data = mujoco().MjData(model)
    data.qpos[:], data.qvel[:] = 0.3, -1.0
    move(model, data, round(duration / h))
    return np.array([data.qpos[0], data.qvel[0]])


def test_a_pendulum_is_of_second_order_and_of_first_without_the_shifts():
    """Half the step leaves a quarter of the error by leapfrog, and half of it by MuJoCo's Euler method
    alone."""
    exact = solve_ivp(
        lambda t, x: (x[1], -GRAVITY / LENGTH * np.cos(x[0])),
        (0.0, 0.8), (0.3, -1.0), method="DOP853", rtol=1e-12, atol=1e-12,
    ).y[:, -1]  # fmt: skip
    for move, order in ((leapfrog, 2), (mujoco().mj_step, 1)):
        # swung: angle and rate after 0.8 s in MuJoCo, by steps of h
        coarse, fine = (np.abs(swung(move, h, 0.8) - exact) for h in (2e-3, 1e-3))
        np.testing.assert_allclose(coarse / fine, 2.0**order, rtol=0.02)


def test_free_fall_is_exact(biped, gait):
    """The height is z = z_0 - g t^2 / 2; without the shifts it would be off by g h t / 2."""
    plant, q = MuJoCoPlant(biped, h=1e-4, integrator="leapfrog"), gait.start(biped)[0]
    row = plant.start(0.0, q, np.zeros(5))
    row[12] += 9.0  # z of the base [m]
    fallen = plant.engine.moved(0.0, row, np.zeros(4), None, 0.05)
    g = biped.description.gravity
    assert fallen[12] == pytest.approx(row[12] - g * 0.05**2 / 2.0, abs=1e-12)
    np.testing.assert_allclose(fallen[:5], q, rtol=0.0, atol=1e-12)


def walked(gait, controller, plant, impacts):
    loop = loop_on(plant, controller(gait.constraint), CompiledLoop)
    return run_of(loop, gait, impacts=impacts)


def test_table_1_walks_on_it_and_not_on_eulers_method(biped, gait):
    """ADRC with the poles of Table I walks five steps on leapfrog, with periods near 0.42 s. With MuJoCo's
    Euler steps in the same plant (engine.step) it does not: the order of the method decides.
    """
    plant = MuJoCoPlant(biped, integrator="leapfrog")
    run = walked(gait, ba.ADRCController, plant, 5)
    assert run.status is ba.Status.COMPLETED
    periods = np.diff([event.t for event in run.events("foot_strike")])
    np.testing.assert_allclose(periods, 0.422, atol=0.004)
    plant.engine.step = mujoco().mj_step
    assert walked(gait, ba.ADRCController, plant, 5).status is ba.Status.INFEASIBLE


def test_leapfrog_goes_through_a_touchdown_as_with_a_sixteenth_of_the_step(biped, gait):
    """From the same state 8 ms before a touchdown to 12 ms after it, steps of 0.2 ms and a 16th of that give
    places of the foot within 0.3 mm and its depth within 10 %, where RK4 has 0.06 mm and 3 %.
    """
    first = walked(gait, ba.NPDController, MuJoCoPlant(biped), 1).arcs[0]
    # nodes are 1 ms apart: the first one later than 8.5 ms before the end is 8 ms before it
    x = first.x[np.searchsorted(first.t, first.t[-1] - 8.5e-3)]

    def feet(h, integrator):
        engine, row, found = MuJoCoPlant(biped, h=h, integrator=integrator).engine, x[:15], []
        for k in range(20):
            # under the last torques of that state, x[-4:], and no load; [1]: the swing foot
            row = engine.moved(k * 1e-3, row, x[-4:], None, (k + 1) * 1e-3)
            found.append(engine.points()[1])
        return 1e3 * np.array(found)  # [mm]

    exact = feet(1.25e-5, "rk4")
    for integrator, place, depth in (("rk4", 0.06, 0.03), ("leapfrog", 0.3, 0.1)):
        swing = feet(2e-4, integrator)
        assert np.max(np.abs(swing - exact)) < place
        assert np.min(swing[:, 2]) == pytest.approx(np.min(exact[:, 2]), rel=depth)
