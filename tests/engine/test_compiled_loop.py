"""A stepping loop with compiled sample instants: the same walk as in Python, with the same ends.

The plant is MuJoCo's; the loop around it acts once per sample instant, in Python (`SteppingLoop`) or in machine
code (`CompiledLoop`). `both` walks with each, and `same` compares status, nodes and all that was recorded, as a
share of each quantity's largest value.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.engine.on_plant import CompiledLoop
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.hybrid.simulator import RunOptions

PUSH = ba.TorquePulse([30.0, 0.0, 10.0, 0.0, 5.0], start=0.0303, stop=0.0507)
PERIOD = ba.SampledTime(1e-3)


@pytest.fixture(scope="module")
def plant(biped):
    return MuJoCoPlant(biped, integrator="leapfrog")


def loop(kind, plant, controller, **more):
    more = {"timing": PERIOD, "torque_limit": 150.0} | more
    return kind(plant, controller, model=plant.biped, **more)


def both(plant, gait, controller, t_end=0.1, change=None, **more):
    """The walk in Python and the same one compiled, from the gait's start or a change of it."""
    runs = []
    for kind in (SteppingLoop, CompiledLoop):
        system = loop(kind, plant, controller, **more)
        x0 = system.initial_state(*gait.start(plant.biped))
        x0 = x0 if change is None else change(x0)
        runs.append(system.run(x0, RunOptions(t_end)))
    return runs


def same(python, compiled, rtol):
    """Nodes at equal times, and all that was recorded there."""
    assert (compiled.status, compiled.detail) == (python.status, python.detail)
    assert len(compiled.arcs) == len(python.arcs)
    for one, other in zip(python.arcs, compiled.arcs, strict=True):
        np.testing.assert_array_equal(other.t, one.t)
        pairs = [(one.x, other.x), (one.dx, other.dx)]
        pairs += [(one.read[name], other.read[name]) for name in one.read]
        for a, b in pairs:
            scale = np.max(np.abs(np.nan_to_num(a)), axis=0) + 1e-9
            np.testing.assert_allclose(b / scale, a / scale, rtol=0.0, atol=rtol)


HARDWARE = {
    "pushed": {},
    "sensors": {"sensors": ba.Sensors(counts=8192), "torque_limit": 40.0},
    "delay": {"timing": ba.SampledTime(1e-3, delay=2.4e-3, delay_known=True)},
    "motors": {"motors": ba.Motors(rate_limit=2e4), "timing": replace(PERIOD, restart=False)},
}


@pytest.mark.parametrize("name", HARDWARE)
def test_both_engines_make_the_same_walk_with_hardware_between_controller_and_plant(
    plant, gait, name
):
    """name: of a row of HARDWARE: pushes, encoders with a torque limit, a known delay of 2.4 periods, or a rate
    limit. 1e-6 is round-off times the gains of Table I.
    """
    more = dict(HARDWARE[name])
    if name == "pushed":
        more["disturbance"] = PUSH + ba.HipForce(plant.biped, (20.0, -10.0))
    python, compiled = both(plant, gait, ba.ADRCController(gait.constraint), **more)
    assert compiled.settings["engine"] == "compiled"
    assert python.status is ba.Status.COMPLETED
    same(python, compiled, 1e-6)


def test_both_engines_make_the_same_walk_over_a_touchdown(plant, gait):
    """The walks last until 0.45 s, beyond the touchdown at about 0.42 s."""
    python, compiled = both(plant, gait, ba.NPDController(gait.constraint), 0.45)
    assert [event.guard for event in compiled.events()] == ["foot_strike"]
    same(python, compiled, 1e-6)


@dataclass(frozen=True)
class Written(ba.Controller):
    """u = -K_d q_b', and NaN from `lost` [s] on; the branch on time has no machine code."""

    lost: float = np.inf

    def output(self, s, m):
        return np.full(4, np.nan) if m.t >= self.lost else -5.0 * m.v_b


def test_a_controller_that_branches_on_time_runs_in_python_on_a_compiled_model(plant, gait):
    """Such a controller has no machine code, so it is called in Python, with the terms of its model from
    machine code; the settings of the walk say so and why.
    """
    python, compiled = both(plant, gait, Written(), 0.05, disturbance=PUSH)
    assert compiled.settings["engine"] == "compiled model"
    assert "Written" in compiled.settings["why"]
    same(python, compiled, 1e-9)


@dataclass(frozen=True)
class Breaks(ba.Disturbance):
    """A push of a user's own that raises at the end of a stretch, and not in the middle of one."""

    def torque(self, t, step, t_start, q, v):
        if t >= 0.05:
            raise ValueError("broken")
        return np.zeros(5)


def rushing(x0):
    x0[5:10] *= 1e9
    return x0


ENDS = {
    "not a number": (Written(lost=0.0105), {}, 0.1, None, ba.Status.NOT_FINITE),
    "lost by the engine": (None, {}, 0.1, rushing, ba.Status.STEP_FAILED),
    "a push that raises": (None, {"disturbance": Breaks()}, 0.1, None, ba.Status.RAISED),
    "a fall": (ba.Passive(), {}, 2.0, None, ba.Status.FELL),
}


@pytest.mark.parametrize("name", ENDS)
def test_both_engines_end_a_walk_with_the_same_status(plant, gait, name):
    """name: of a row of ENDS: a torque of NaN, rates 1e9 times too large (`rushing`), which the simulator
    cannot step, a push that raises, and a fall without torques.
    """
    controller, more, t_end, change, status = ENDS[name]
    controller = controller or ba.NPDController(gait.constraint)
    python, compiled = both(plant, gait, controller, t_end, change, **more)
    assert python.status is status
    same(python, compiled, 1e-6)
