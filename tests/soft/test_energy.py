"""Energy of a soft walk: motors + push + ground - joint friction = change of kinetic and potential energy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.feet import readings
from biped_adrc.closed_loop.protocols import Load, Mode
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.robot import mujoco
from biped_adrc.hybrid.simulator import RunOptions

from .loops import loop_on, run_of

STILL = Load(np.zeros(5), np.zeros(2))
PUSH = ba.TorquePulse([30.0, 30.0, 0.0, 0.0, 0.0], step=2, start=0.02, stop=0.06)


def energy(plant, r, k):
    """Kinetic with rotors, and potential [J], by MuJoCo at reading k."""
    plant.footing(r.row[k], r.u[k], STILL)
    mujoco().mj_energyPos(plant.engine.model, plant.engine.data)
    mujoco().mj_energyVel(plant.engine.model, plant.engine.data)
    return plant.engine.data.energy.sum()


def balance(biped, gait, h):
    """What is missing [J] in each step of the engine, from 10 ms before the first touchdown to it and from
    there on for 0.1 s; the largest power of the ground [W]; and all the work that was exchanged [J].
    """
    plant = MuJoCoPlant(biped, h=h)
    loop = loop_on(plant, ba.NPDController(gait.constraint), disturbance=PUSH)
    first = run_of(loop, gait, impacts=1)
    end = first.events()[0]
    later = loop.run(end.x_plus, RunOptions(end.t + 0.1, end.t), mode=Mode(2, end.t)).arcs[0]
    arc = first.arcs[0]
    before = replace(
        arc, t=arc.t[-20:], x=arc.x[-20:], dx=arc.dx[-20:], read={"u": arc.read["u"][-20:]}
    )
    missing, most, done = [], 0.0, 0.0
    viscous, static = (float(biped.friction) * x for x in biped.friction_coefficients)
    for part in (before, later):
        r = readings(loop, part, h)
        v = r.row[:, 5:10]
        power = np.sum(r.u * v[:, :4], axis=1) + np.sum(r.zeta * v, axis=1)
        ground = np.sum(r.force * r.speed, axis=(1, 2))
        power += ground - v**2 @ viscous - np.abs(v) @ static
        level = np.array([energy(plant, r, k) for k in range(len(r.t))])
        work = 0.5 * np.diff(r.t) * (power[1:] + power[:-1])
        missing.append(np.diff(level) - work)
        most, done = max(most, np.max(np.abs(ground))), done + np.sum(np.abs(work))
    return missing, most, done


@pytest.mark.parametrize("friction", [False, True])
def test_energy_closes_but_for_the_step_in_which_a_foot_comes_down(gait, friction):
    """To 1 % of what is exchanged at the usual step, of second order in it where forces do not jump."""
    biped = ba.Biped.load("rabbit", friction=friction)
    gaps = []
    for h in (2e-4, 1e-4):
        (before, after), most, done = balance(biped, gait, h)
        jump = np.argmax(np.abs(before))
        rest = np.sum(np.delete(before, jump)) + np.sum(after)
        assert abs(rest) < 0.01 * done
        assert abs(before[jump]) < 0.55 * h * most
        assert np.sum(np.abs(np.delete(before, jump))) < 0.1 * abs(before[jump])
        gaps.append(abs(np.sum(after)))
    if not friction:  # static friction is a constraint of the engine's own, with jumps of its own
        assert gaps[0] / gaps[1] == pytest.approx(4.0, rel=0.25)
