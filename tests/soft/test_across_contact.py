"""An observer on soft ground that knows of contact: what the paper's push leaves of the tracking error."""

import numpy as np

import biped_adrc as ba
from biped_adrc.control.around import Hold
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.extras.mujoco.soft_ground import SoftGround

from .loops import loop_on, run_of

PUSH = ba.TorquePulse([30.0, 30.0, 30.0, 30.0, 0.0], step=2, start=0.1, stop=0.3)


def test_held_after_touchdown_an_observer_of_low_order_leaves_a_quarter_of_npds_error(biped, gait):
    """From the push's onset to 50 ms after its end; not held it leaves more than half of it."""
    h, plant, found = gait.constraint, MuJoCoPlant(biped, SoftGround(friction=0.8)), []
    slow = ba.ADRCController(h, ba.GPIObserver.from_bandwidth(500.0))
    for controller in (ba.NPDController(h), Hold(slow, 0.015)):
        run = run_of(loop_on(plant, controller, disturbance=PUSH), gait, impacts=2)
        assert run.status is ba.Status.COMPLETED
        arc = run.arcs[1]
        late = arc.x[(arc.t > arc.mode.start + 0.1) & (arc.t < arc.mode.start + 0.35)]
        found.append(max(np.max(np.abs(x[:4] - h(0.0, x[:5], x[5:10]).q_d)) for x in late))
    npd, held = found
    assert 0.2 * npd < held < 0.26 * npd
