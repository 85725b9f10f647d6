"""Laws of one's own: observers and references that compile under every controller, and others."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.control.base import controller_laws
from biped_adrc.control.delayed import Delayed
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.passive import Passive
from biped_adrc.gait.constraint import CorrectedConstraint
from biped_adrc.gait.reference import Reference, ReferenceLaws
from biped_adrc.observers.base import Observer, ObserverLaws
from biped_adrc.observers.chain import chain_estimate, chain_reset, chain_state
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.types import Array


def measurements(biped, gait, count=5):
    walker = ba.Walker(biped, Passive())
    random = np.random.default_rng(3)
    q, v = gait.start(biped)
    for _ in range(count):
        x = q + 0.05 * random.normal(size=5), v + 0.5 * random.normal(size=5)
        m = walker.measure(0.1, *x, Mode())
        yield m._replace(body=biped.body_terms(*x)), random


class Squared(NamedTuple):
    """Gains [1/s], [1/s^2], [1/s^3], and what sets in past an error of one."""

    gains: Array
    bend: float
    scale: float = 1.0
    order: int = 3


def squared_flow(k, Z, y, input):
    """A chain whose injection grows with the error."""
    e = (y - Z[0]) * (1.0 + k.bend * (y - Z[0]) ** 2)
    dZ = np.outer(k.gains, e)
    dZ[:-1] += Z[1:]
    dZ[1] += input
    return dZ


@dataclass(frozen=True)
class SquaredObserver(Observer):
    """An observer of one's own, as laws."""

    @property
    def laws(self):
        k = Squared(np.array([600.0, 1.2e5, 8e6]), 0.1)
        return ObserverLaws(k, chain_state, chain_estimate, chain_reset, flow=squared_flow)


@dataclass(frozen=True)
class SquaredInPython(Observer):
    """The same as methods."""

    order = 3

    def initial_state(self, y, dy, xi):
        return SquaredObserver().initial_state(y, dy, xi)

    def estimate(self, z):
        return SquaredObserver().estimate(z)

    def reset(self, z, policy, swap, y, dy, xi):
        return SquaredObserver().reset(z, policy, swap, y, dy, xi)

    def flow(self, z, y, input):
        return SquaredObserver().flow(z, y, input)


class Lean(NamedTuple):
    """h, and a shift of every joint [rad]."""

    h: tuple
    shift: Array


def lean_point(k, t, q, v):
    """The constraint of another reference, shifted."""
    r = WITHIN.point(k.h, t, q, v)
    return r._replace(q_d=r.q_d + k.shift)


@dataclass(frozen=True)
class LeaningReference(Reference):
    """A reference of one's own, as a law."""

    h: Reference

    @property
    def laws(self):
        global WITHIN
        WITHIN = self.h.laws
        return ReferenceLaws(Lean(self.h.laws.parameters, np.full(4, 1e-3)), lean_point)


def walked(biped, gait, controller, engine):
    run = ba.walk(ba.Walker(biped, controller), gait, 1, ba.RK4(5e-4), engine=engine)
    return run.trajectory


TRACKING = {
    "ADRC": lambda h, o: ba.ADRCController(h, o),
    "ADRC output": lambda h, o: OutputADRCController(h, o),
    "delayed, output": lambda h, o: Delayed(OutputADRCController(h, o), 1e-3),
    "DOB": lambda h, o: MomentumDOBController(h),
}


@pytest.mark.parametrize("name", list(TRACKING))
def test_observers_and_references_of_ones_own_compile(biped, gait, name):
    controller = TRACKING[name](LeaningReference(gait.constraint), SquaredObserver())
    fast, slow = (walked(biped, gait, controller, engine) for engine in ("compiled", "pinocchio"))
    assert fast.settings["engine"] == "compiled"
    assert "why" not in fast.settings
    assert fast.status is slow.status
    x = slow.final_state
    assert np.max(np.abs(fast.final_state - x)) <= 1e-8 * np.max(np.abs(x))


def test_methods_do_what_laws_do(biped, gait):
    one, other = (
        ba.ADRCController(gait.constraint, observer)
        for observer in (SquaredObserver(), SquaredInPython())
    )
    assert "observer SquaredInPython has no laws" in controller_laws(other).obstacle
    runs = [walked(biped, gait, controller, "pinocchio") for controller in (one, other)]
    assert np.array_equal(runs[0].final_state, runs[1].final_state)


def test_what_has_no_law_says_so(biped, gait):
    bent = CorrectedConstraint(gait.constraint, lambda theta: (np.zeros(4),) * 3)
    for controller in (
        ba.NPDController(bent),
        ba.ADRCController(bent),
        MomentumDOBController(bent),
    ):
        assert controller.laws.obstacle == "reference CorrectedConstraint has no laws of arrays"

    class Plain(GPIObserver):
        """Under another name."""

    class Own(GPIObserver):
        """One that writes a method over the laws."""

        def flow(self, z, y, input):
            return 0.0 * z

    adrc = ba.ADRCController(gait.constraint)
    assert replace(adrc, observer=Plain.from_poles()).laws.obstacle == ""
    own = replace(adrc, observer=Own.from_poles()).laws
    assert own.obstacle == "observer Own writes flow over the laws that it inherits"
    (m, _), *_ = measurements(biped, gait)
    s = adrc.initial_state(m)
    assert not np.any(own.flow(own.parameters, s, m, np.zeros(4)))
