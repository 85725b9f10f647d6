"""One suite over every controller, observer, disturbance and method; a new leaf that is not listed fails it."""

import importlib
import inspect
import pkgutil

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.base import Controller
from biped_adrc.control.clf_qp import CLFQPController
from biped_adrc.control.delayed import Delayed
from biped_adrc.control.finite_time import FiniteTimeController
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.output_npd import OutputNPDController
from biped_adrc.control.pd_gravity import PDGravityController
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.control.stride import TORSO_LEAN, StrideGains, StridePI
from biped_adrc.disturbances.base import Disturbance, Sum, Windowed
from biped_adrc.disturbances.hip_force import HipForce
from biped_adrc.disturbances.link import OnLink
from biped_adrc.disturbances.noise import TorqueNoise
from biped_adrc.gait.outputs import LinearOutputs
from biped_adrc.observers.base import Observer
from biped_adrc.observers.gpi import GPIObserver, SampledGPIObserver
from biped_adrc.observers.high_gain import HighGainObserver
from biped_adrc.observers.momentum import (
    MomentumChain,
    MomentumObserver,
    SampledMomentumObserver,
)

PULSE = ba.TorquePulse([1.0, 2.0, 3.0, 4.0, 5.0], step=2, start=0.1, stop=0.2)
DISTURBANCES = [
    PULSE,
    ba.TorqueStep([1.0] * 5, step=2, start=0.1),
    ba.TorqueSine([1.0] * 5, start=0.1, stop=0.5, frequency=3.0),
    PULSE + ba.TorqueSine([1.0] * 5, frequency=2.0),
    HipForce(ba.Biped.load("rabbit"), (-3.0, 1.0), steps=(2, 3)),
    TorqueNoise([1.0] * 5, start=0.1, stop=0.5, bandwidth=10.0, seed=1),
    OnLink(ba.Biped.load("rabbit"), "right_shin", ba.TorquePulse([1.0, 2.0, 3.0], step=2)),
]
OBSERVERS = [
    GPIObserver.from_poles(),
    GPIObserver.from_bandwidth(300.0, 0),
    GPIObserver.from_poles().sampled(1e-3),
    HighGainObserver.from_epsilon(0.002),
    HighGainObserver.from_epsilon(0.002, m=2).sampled(1e-3),
    MomentumObserver.from_bandwidth(200.0),
    MomentumObserver.from_bandwidth(200.0, 4).sampled(1e-3),
]
CONTROLLERS = {
    ba.NPDController: lambda c: ba.NPDController(c),
    ba.ADRCController: lambda c: ba.ADRCController(c),
    ba.Passive: lambda c: ba.Passive(),
    ReferenceReset: lambda c: ReferenceReset(ba.ADRCController(c)),
    StridePI: lambda c: StridePI(
        ba.NPDController(c), 0.7, 0.3, TORSO_LEAN, StrideGains(-1.0, -0.4)
    ),
    OutputNPDController: lambda c: OutputNPDController(LinearOutputs(np.eye(4, 5), c)),
    FiniteTimeController: lambda c: FiniteTimeController(LinearOutputs(np.eye(4, 5), c), 0.9, 0.02),
    PDGravityController: lambda c: PDGravityController(c),
    OutputADRCController: lambda c: OutputADRCController(c),
    MomentumDOBController: lambda c: MomentumDOBController(c),
    CLFQPController: lambda c: CLFQPController(c),
    Delayed: lambda c: Delayed(ba.ADRCController(c), 1e-3),
}
CONTINUOUS = {Delayed}
"""In sampled time a delay belongs to `SampledTime`."""


def leaves(base, package):
    """Concrete subclasses of `base` defined in a package of biped_adrc."""
    module = importlib.import_module(f"biped_adrc.{package}")
    for found in pkgutil.iter_modules(module.__path__):
        importlib.import_module(f"biped_adrc.{package}.{found.name}")

    def below(cls):
        for child in cls.__subclasses__():
            yield child
            yield from below(child)

    return {
        cls
        for cls in below(base)
        if cls.__module__.startswith(f"biped_adrc.{package}.") and not inspect.isabstract(cls)
    }


def test_every_leaf_is_listed():
    assert leaves(Disturbance, "disturbances") - {Windowed} == {type(d) for d in DISTURBANCES}
    assert leaves(Controller, "control") == set(CONTROLLERS)
    found = {cls for cls in leaves(Observer, "observers") if "Chain" not in cls.__name__}
    assert found == {type(o) for o in OBSERVERS}
    assert found == {
        *(GPIObserver, SampledGPIObserver, HighGainObserver),
        *(MomentumObserver, SampledMomentumObserver),
    }


@pytest.mark.parametrize("d", DISTURBANCES, ids=lambda d: type(d).__name__)
def test_disturbances(d):
    q, v = np.zeros(5), np.ones(5)
    for step in (1, 2, 3):
        switches = d.switching_times(step, 1.0)
        for t in (1.0, 1.15, 1.3, *switches):
            one, two = d.torque(t, step, 1.0, q, v), d.torque(t, step, 1.0, q, v)
            assert one.shape == (5,)
            assert np.array_equal(one, two)
            assert np.all(np.isfinite(one))
            one += 1.0  # what is handed out is the caller's
            assert np.array_equal(two, d.torque(t, step, 1.0, q, v))
    assert not np.any(q)


def test_windows_close_where_they_say():
    q = np.zeros(5)
    assert not np.any(PULSE.torque(1.05, 2, 1.0, q, q))
    start, stop = PULSE.switching_times(2, 1.0)
    assert np.array_equal(PULSE.torque(start, 2, 1.0, q, q), PULSE.amplitude)
    assert not np.any(PULSE.torque(stop, 2, 1.0, q, q))
    assert np.any(PULSE.torque(np.nextafter(stop, 0.0), 2, 1.0, q, q))
    assert not np.any(PULSE.torque(1.15, 1, 1.0, q, q))
    stays = DISTURBANCES[1]
    assert np.any(stays.torque(9.0, 7, 8.9, q, q))
    total = DISTURBANCES[3]
    assert isinstance(total, Sum)
    expected = PULSE.torque(1.15, 2, 1.0, q, q) + total.parts[1].torque(1.15, 2, 1.0, q, q)
    assert np.array_equal(total.torque(1.15, 2, 1.0, q, q), expected)


@pytest.mark.parametrize("kind", [ba.TorquePulse, ba.TorqueSine])
def test_bad_windows(kind):
    for arguments, message in (
        ({"amplitude": [np.nan] * 5}, "nan"),
        ({"amplitude": [1.0] * 5, "start": 0.3, "stop": 0.1}, "start < stop"),
        ({"amplitude": [1.0] * 5, "step": 0}, "counted from 1"),
    ):
        with pytest.raises(ba.BipedError, match=message):
            kind(**arguments)
    with pytest.raises(ba.BipedError, match="frequency is -1"):
        ba.TorqueSine([1.0] * 5, frequency=-1.0)
    with pytest.raises(ba.BipedError, match="use TorquePulse"):
        ba.TorqueStep([1.0] * 5, stop=1.0)


@pytest.mark.parametrize("observer", OBSERVERS, ids=lambda o: f"{type(o).__name__} {o.order}")
def test_observers(observer):
    y, dy, xi = np.linspace(0, 1, 4), np.linspace(1, 2, 4), np.linspace(-3, 3, 4)
    z = observer.initial_state(y, dy, xi)
    found = observer.estimate(z)
    assert found.position == pytest.approx(y)
    momentum = isinstance(observer, MomentumChain)
    assert found.velocity == pytest.approx(np.zeros(4) if momentum else dy)
    has_xi = momentum or observer.order > 2
    assert found.disturbance == pytest.approx(xi if has_xi else np.zeros(4))
    kept = z.copy()
    if isinstance(observer, SampledGPIObserver | SampledMomentumObserver):
        results = [observer.correct(z, y), observer.predict(z, xi)]
        with pytest.raises(ba.BipedError, match="sampled time only"):
            observer.flow(z, y, xi)
    else:
        results = [observer.flow(z, y, xi)]
        with pytest.raises(ba.BipedError, match=r"call sampled\(period\)"):
            observer.predict(z, xi)
    for policy in ba.ResetPolicy:
        results.append(observer.reset(z, policy, np.array([1, 0, 3, 2]), y, dy, xi))
    for result in results:
        assert result.shape == z.shape
        assert np.all(np.isfinite(result))
    assert np.array_equal(z, kept)


@pytest.mark.parametrize("kind", list(CONTROLLERS), ids=lambda k: k.__name__)
@pytest.mark.parametrize("timing", [ba.ContinuousTime(), ba.SampledTime(1e-3)])
def test_controllers(biped, gait, kind, timing):
    walker = ba.Walker(biped, CONTROLLERS[kind](gait.constraint), timing=timing)
    if walker.sampled and kind in CONTINUOUS:
        with pytest.raises(ba.BipedError, match="SampledTime"):
            _ = walker.law
        return
    q, v = gait.start(biped)
    m = walker.measure(0.0, q, v, ba.Mode())
    law = walker.law
    s = law.initial_state(m)
    kept = (s.copy(), q.copy(), v.copy())
    u = law.output(s, m)
    assert np.array_equal(u, law.output(s, m))
    assert u.shape == (biped.p,)
    assert np.all(np.isfinite(u))
    swap = biped.relabelling[: biped.p]
    after = [law.jump(s, m, swap)]
    after += [law.correct(s, m), law.predict(s, m, u)] if walker.sampled else [law.flow(s, m, u)]
    for state in after:
        assert state.shape == s.shape
        assert np.all(np.isfinite(state))
    for a, b in zip(kept, (s, q, v), strict=True):
        assert np.array_equal(a, b)
