"""Loops around MuJoCo's plant, and their runs."""

import biped_adrc as ba
from biped_adrc.analysis.soft_steps import recorded_steps
from biped_adrc.closed_loop.other_plant import with_readings
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.model.ground import ground_axes

TICK = ba.SampledTime(1e-3)
SOFT = {"ground.plant": "mujoco", "hardware.period": 1e-3, "hardware.torque_limit": 150.0}
"""The same of a scenario."""


def loop_on(plant, law, kind=SteppingLoop, **more):
    """A loop at 1 kHz, its torques limited."""
    return kind(plant, law, **{"timing": TICK, "model": plant.biped, "torque_limit": 150.0} | more)


def run_of(loop, gait, t_end=4.0, impacts=None):
    """A run from the start of a gait on, until a time [s] or after so many touchdowns."""
    stop = None if impacts is None else ("foot_strike", impacts)
    x0 = loop.initial_state(*gait.start(loop.model))
    return loop.run(x0, RunOptions(t_end, stop_after=stop))


def steps_of(loop, run):
    """What the feet did in each single support of a run of this loop."""
    axes = ground_axes(loop.plant.slope)
    return recorded_steps(with_readings(loop, run), loop.plant.ground.friction, axes)
