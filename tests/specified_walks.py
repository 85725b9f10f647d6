"""Walks beside the specification of a walker: its largest multiplier, and the ripple of its torque.

The walks have no torque limit and, for multipliers, no counts: neither has a linear loop.
"""

from dataclasses import replace

import numpy as np

import biped_adrc as ba
from biped_adrc.analysis.loops.frozen_gait import FrozenGait
from biped_adrc.analysis.loops.specification import specification
from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.core.errors import BipedError
from biped_adrc.scenario.build import RobotAndGait, build

SETTLING = 4
"""Steps before Newton's method looks for the cycle, after the first one."""


def candidate(values):
    """The walker of a scenario's values, with its gait."""
    s = ba.Scenario(**values)
    scene = RobotAndGait.of(s)
    return build(s, scene), scene.walked


def specified(walker, gait):
    """Of this robot alone, since the walks are of one robot."""
    frozen = FrozenGait.of(walker.plant, gait, walker.nominal, spread=0.0)
    return specification(walker, frozen)


def multiplier(walker, gait):
    """The largest |multiplier| of the walk, infinite for a walker that does not come back to the section."""
    step = 2.5e-4 if walker.motors is not None and walker.motors.lag else 5e-4
    P = ReturnMap(walker, ba.RK4(step))
    try:
        x = walker.initial_state(*gait.start(walker.plant))
        run = ba.simulate(walker, x, ba.Mode(), P.method, t_end=2.0, stop_after=("foot_strike", 1))
        if not run.status.ok:
            return np.inf
        s = P.project(run.events("foot_strike")[-1].x_minus)
        for _ in range(SETTLING):
            s = P(s)
        return float(abs(P.fixed_point(P.lift(s), tolerance=1e-7).multipliers[0]))
    except BipedError:
        return np.inf


def torques(walker, gait, end):
    """The torque held after each sample instant from 50 ms to `end` [s] of the first step (K, p) [N m]."""
    x, T = walker.initial_state(*gait.start(walker.plant)), walker.timing.period
    arc = ba.simulate(walker, x, ba.Mode(), ba.RK4(0.5 * T), t_end=end).arcs[0]
    middle = np.arange(round(0.05 / T), int(end / T) - 1) * T + 0.5 * T
    return np.asarray(arc.x[np.searchsorted(arc.t, middle - 1e-9), -walker.plant.p :])


def rippled(values):
    """Ripple [N m] of the motor with most on RABBIT's hardware, by the specification and in a walk."""
    walker, gait = candidate(
        {
            "hardware.profile": "rabbit",
            "hardware.friction": False,
            "hardware.torque_limit": 1e6,
            "run.impacts": 2,
            **values,
        }
    )
    spec = specified(walker, gait)
    exact = replace(walker, sensors=walker.sensors.smooth())
    end = 0.9 * gait.period
    difference = torques(walker, gait, end) - torques(exact, gait, end)
    return spec.ripple, float(np.max(np.std(difference, axis=0)))
