"""Laws of one's own: observers and references that compile under every controller, and others."""

from dataclasses import dataclass

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.delayed import Delayed
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.core.part import derived
from biped_adrc.gait.reference import Reference
from biped_adrc.observers.base import Estimate


@dataclass(frozen=True)
class Luenberger(ba.Observer):
    """Position, velocity and a constant disturbance of each joint, from three equal poles."""

    bandwidth: float

    @derived
    def gains(self):
        return np.poly([-self.bandwidth] * 3)[1:]

    def initial_state(self, y, dy, xi):
        return np.array((y, dy, xi))

    def estimate(self, z):
        return Estimate(*z)

    def reset(self, z, policy, swap, y, dy, xi):
        return self.initial_state(y, dy, xi)

    def flow(self, z, y, input):
        l1, l2, l3 = self.gains
        position, velocity, xi = self.estimate(z)
        e = y - position
        return np.array((velocity + l1 * e, xi + input + l2 * e, l3 * e))


@dataclass(frozen=True)
class LeaningReference(Reference):
    """A reference of one's own: another one with a shift of every joint [rad]."""

    h: Reference
    shift: float = 1e-3

    def __call__(self, t, q, v):
        r = self.h(t, q, v)
        return r._replace(q_d=r.q_d + self.shift)


def walked(biped, gait, controller, engine):
    # the approximant of a delay of 1 ms asks for short steps
    h = 5e-4 if isinstance(controller, Delayed) else 2e-3
    run = ba.walk(ba.Walker(biped, controller), gait, 1, ba.RK4(h), engine=engine)
    return run.trajectory


TRACKING = {
    "ADRC": lambda h, o: ba.ADRCController(h, o),
    "delayed, output": lambda h, o: Delayed(OutputADRCController(h, o), 1e-3),
    "DOB": lambda h, o: MomentumDOBController(h),
}


@pytest.mark.parametrize("name", list(TRACKING))
def test_observers_and_references_of_ones_own_compile(biped, gait, name):
    """A user's reference (`LeaningReference`) and observer (`Luenberger`) inside the controller `name` run as
    machine code, not in Python, and walk as in Python. DOB takes the reference alone.
    """
    controller = TRACKING[name](LeaningReference(gait.constraint), Luenberger(300.0))
    fast, slow = (walked(biped, gait, controller, engine) for engine in ("compiled", "pinocchio"))
    assert fast.settings["engine"] == "compiled"
    assert "why" not in fast.settings
    assert fast.status is slow.status
    x = slow.final_state
    assert np.max(np.abs(fast.final_state - x)) <= 1e-8 * np.max(np.abs(x))
