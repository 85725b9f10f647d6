"""Touchdowns that a controller has to notice on soft ground, in Python and compiled.

walked(plant, gait, touchdown, ...) is a loop in MuJoCo, whose controller is told of touchdowns by the detector
`touchdown` (None: at once), with its run.
"""

from __future__ import annotations

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.touchdowns import touchdowns
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.engine.on_plant import CompiledLoop
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.hardware.touchdown import ByForce, ByKinematics, FaultyTouchdown

from .loops import loop_on, run_of

T = 1e-3


@pytest.fixture(scope="module")
def plant(biped):
    return MuJoCoPlant(biped, integrator="leapfrog")


def low_order(constraint):
    return ba.ADRCController(constraint, observer=ba.GPIObserver.from_bandwidth(300.0, m=1))


def walked(plant, gait, touchdown, kind=CompiledLoop, t_end=0.43, controller=low_order):
    clock = ba.SampledTime(T, restart=False)
    more = {"timing": clock, "touchdown": touchdown}
    loop = loop_on(plant, controller(gait.constraint), kind, **more)
    return loop, run_of(loop, gait, t_end)


LEAVES = (
    FaultyTouchdown(late=3e-3),
    ByForce(debounce=2e-3, delay=1e-3),
    ByKinematics(height=3e-3),
)


@pytest.mark.parametrize("leaf", LEAVES, ids=lambda leaf: type(leaf).__name__)
def test_compiled_as_in_python(plant, gait, leaf):
    """leaf: how a touchdown is detected: late, by force or by kinematics. Final state and delays of the
    compiled loop are those of the loop in Python; the walk has one touchdown, shortly before its end.
    """
    (loop, compiled), (_, python) = (
        walked(plant, gait, leaf, kind) for kind in (CompiledLoop, SteppingLoop)
    )
    assert compiled.settings["engine"] == "compiled"
    assert len(python.events("foot_strike")) == 1
    scale = 1.0 + np.abs(python.final_state)
    np.testing.assert_allclose(
        compiled.final_state / scale, python.final_state / scale, rtol=0.0, atol=1e-9
    )
    np.testing.assert_array_equal(touchdowns(loop, compiled).late, touchdowns(loop, python).late)


def test_noticed_at_once_is_ideal_knowledge(plant, gait):
    """Touchdowns on soft ground are at ticks, so the same tick that follows one notices it."""
    (_, ideal), (_, told) = (
        walked(plant, gait, leaf, t_end=0.9) for leaf in (None, FaultyTouchdown())
    )
    assert len(ideal.events("foot_strike")) == 2
    np.testing.assert_allclose(told.final_state[:10], ideal.final_state[:10], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(told.final_state[-4:], ideal.final_state[-4:], rtol=0.0, atol=1e-6)


def test_in_the_window_the_recorded_torque_is_the_old_law_s(plant, gait):
    """For 4 ms after a touchdown that is noticed late the controller computes in the old labels of the legs."""
    loop, run = walked(plant, gait, FaultyTouchdown(late=4e-3), controller=ba.NPDController)
    (event,) = run.events("foot_strike")
    arc, biped = run.arcs[1], plant.biped
    for k in np.flatnonzero(arc.t[:-1] < event.t + 3.5e-3):  # before it is noticed
        # at sample instants: of two nodes of equal time the later one
        if (
            round(arc.t[k] / T) * T == pytest.approx(arc.t[k], abs=1e-12)
            and arc.t[k + 1] > arc.t[k]
        ):
            q, v = biped.relabel(arc.x[k, :5]), biped.R @ arc.x[k, 5:10]
            m = loop.measure(arc.t[k], q, v, ba.closed_loop.protocols.Mode())
            u = loop.saturate(loop.law.output(np.zeros(0), m))
            np.testing.assert_allclose(arc.read["u"][k], u[loop.plant.swap], rtol=1e-8, atol=1e-8)
