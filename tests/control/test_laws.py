"""Every law in machine code, from the lines that run in Python: the same numbers, and those of the methods."""

import types
from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.base import Controller
from biped_adrc.control.delayed import Delayed
from biped_adrc.control.finite_time import psi
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.passive import Passive
from biped_adrc.control.pd_gravity import PDGravityController
from biped_adrc.control.reference_reset import ReferenceReset, reset_polynomial, reset_start
from biped_adrc.control.stride import (
    TORSO_LEAN,
    StrideGains,
    StridePI,
    stride_correction,
    stride_jump,
)
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.disturbances.hip_force import HipForce, hip_force, hip_torque
from biped_adrc.disturbances.link import OnLink
from biped_adrc.disturbances.noise import TorqueNoise
from biped_adrc.gait.corrected import CorrectedConstraint
from biped_adrc.linear import solve, solve_positive
from biped_adrc.observers.base import Estimate, Observer
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.observers.gpi_sampled import SampledGPIObserver
from biped_adrc.observers.high_gain import HighGainObserver
from biped_adrc.observers.momentum import MomentumObserver, SampledMomentumObserver
from biped_adrc.scenario.registry import find, names
from biped_adrc.walker import Mode

numba = pytest.importorskip("numba")
pytestmark = pytest.mark.filterwarnings(
    "ignore::numba.NumbaPerformanceWarning"
)  # @ of a column of H

SWAP = np.array([1, 0, 3, 2])
COMPILED = {}


@numba.njit
def _solve(A, B, what):
    return np.linalg.solve(A, B)


COMPILED[solve] = COMPILED[solve_positive] = _solve


def compiled(law):
    """The law in machine code, and with it every function of the package that it calls."""
    if law not in COMPILED:
        scope = dict(law.__globals__)
        for name in law.__code__.co_names:
            called = scope.get(name)
            if isinstance(called, types.FunctionType) and called.__module__.startswith(
                "biped_adrc"
            ):
                scope[name] = compiled(called)
        COMPILED[law] = numba.njit(types.FunctionType(law.__code__, scope, law.__name__))
    return COMPILED[law]


def agree(law, *arguments):
    """The result in Python, equal to the compiled one to 1e-14 of its largest number."""
    expected, found = law(*arguments), compiled(law)(*arguments)
    several = isinstance(expected, tuple)
    for one, other in zip(
        *((expected, found) if several else ((expected,), (found,))), strict=True
    ):
        assert np.max(np.abs(one - other)) <= 1e-14 * max(1.0, np.max(np.abs(one)))
    return expected


def measurements(biped, gait, count=5):
    walker = ba.Walker(biped, Passive())
    random = np.random.default_rng(3)
    q, v = gait.start(biped)
    for _ in range(count):
        x = q + 0.05 * random.normal(size=5), v + 0.5 * random.normal(size=5)
        m = walker.measure(0.1, *x, Mode())
        yield m._replace(body=biped.body_terms(*x)), random


CONTROLLERS = {
    "passive": lambda c: Passive(),
    "PD with gravity": lambda c: PDGravityController(c),
}


@pytest.mark.parametrize("name", list(CONTROLLERS))
def test_controllers(biped, gait, name):
    controller = CONTROLLERS[name](gait.constraint)
    laws = controller.laws
    k = laws.parameters
    for m, random in measurements(biped, gait):
        s = controller.initial_state(m)
        if laws.initial_state:
            assert np.array_equal(agree(laws.initial_state, k, m), s)
        s = s * (1.0 + 0.01 * random.normal(size=len(s)))
        u = 20.0 * random.normal(size=4)
        assert np.array_equal(agree(laws.output, k, s, m), controller.output(s, m))
        for law, rest in (("flow", (m, u)), ("correct", (m,)), ("predict", (m, u))):
            if getattr(laws, law):
                expected = agree(getattr(laws, law), k, s, *rest)
                assert np.array_equal(expected, getattr(controller, law)(s, *rest))
    assert (laws.flow is None) == (type(controller).flow is Controller.flow or "discrete" in name)
    assert (laws.correct is None) == (laws.predict is None) == ("discrete" not in name)


@pytest.mark.parametrize("policy", ba.ResetPolicy)
@pytest.mark.parametrize("kind", [ba.ADRCController, MomentumDOBController])
def test_what_the_impact_does_to_an_observer(biped, gait, kind, policy):
    controller = kind(gait.constraint, reset=policy)
    laws = controller.laws
    for m, random in measurements(biped, gait, 3):
        s = random.normal(size=len(controller.initial_state(m)))
        expected = agree(laws.jump, laws.parameters, s, m, SWAP)
        assert np.array_equal(expected, controller.jump(s, m, SWAP))


@pytest.mark.parametrize(
    "observer",
    [
        GPIObserver.from_poles(),
        GPIObserver.from_poles().sampled(1e-3),
        HighGainObserver.from_epsilon(0.002),
        MomentumObserver.from_bandwidth(9.0, 3),
        MomentumObserver.from_bandwidth(9.0).sampled(1e-3),
    ],
    ids=["continuous", "discrete", "high gain", "momentum", "momentum, discrete"],
)
def test_observers(observer):
    laws, random = observer.laws, np.random.default_rng(4)
    k = laws.parameters
    x = Estimate(*random.normal(size=(3, 4)))
    assert np.array_equal(agree(laws.state, k, x).ravel(), observer.initial_state(*x))
    Z = random.normal(size=(observer.order, 4))
    z, y, input = Z.ravel(), x.position, x.disturbance
    for one, other in zip(agree(laws.estimate, k, Z), observer.estimate(z), strict=True):
        assert np.array_equal(one, other)
    for policy in ba.ResetPolicy:
        expected = agree(laws.reset, k, policy.code, Z, SWAP, x)
        assert np.array_equal(expected.ravel(), observer.reset(z, policy, SWAP, *x))
    for law, rest in (("flow", (y, input)), ("correct", (y,)), ("predict", (input,))):
        if getattr(laws, law):
            expected = agree(getattr(laws, law), k, Z, *rest)
            assert np.array_equal(expected.ravel(), getattr(observer, law)(z, *rest))
    sampled = isinstance(observer, SampledGPIObserver | SampledMomentumObserver)
    assert (laws.flow is None, laws.correct is None, laws.predict is None) == (
        sampled,
        not sampled,
        not sampled,
    )


def test_disturbances():
    amplitude, q = np.array([30.0, -20.0, 5.0, 0.0, 1.0]), np.zeros(5)
    pulse = ba.TorquePulse(amplitude, step=2, start=0.1, stop=0.2)
    total = pulse + ba.TorqueStep(amplitude, step=2, start=0.1)
    total += ba.TorqueSine(amplitude, start=0.3, frequency=5.0)
    total += TorqueNoise(amplitude, step=2, start=0.1, stop=0.3, bandwidth=10.0, seed=1, sines=4)
    assert len(total.laws) == 4
    seen = 0
    for step in (1, 2, 3):
        for t in (1.0, 1.1, np.nextafter(1.2, 0.0), 1.2, 1.34):
            at = (float(t), step, 1.0, q, q)
            expected = sum(agree(law.torque, law.parameters, *at) for law in total.laws)
            assert np.array_equal(expected, total.torque(*at))
            seen += any(expected)
    assert 0 < seen <= 15


def test_a_force_on_the_hip(biped):
    force = HipForce(biped, (-3.0, 1.0), steps=(2, 3))
    q = np.random.default_rng(5).uniform(-1.0, 1.0, 5)
    J = biped.pinned.jacobian(q, biped.pinned.hip)
    for step in (1, 2, 3, 4):
        expected = agree(hip_torque, force.parameters, step, J)
        assert np.array_equal(expected, force.torque(0.0, step, 0.0, q, q))
        expected = agree(hip_force, force.parameters, step)
        assert np.array_equal(expected, force.resultant(0.0, step, 0.0))
        (law,) = force.laws
        expected = agree(law.torque, law.parameters, 0.0, step, 0.0, q, q)
        assert np.max(np.abs(expected - force.torque(0.0, step, 0.0, q, q))) < 1e-13


@pytest.mark.parametrize(
    "wave",
    [
        ba.TorquePulse([3.0, -2.0, 1.0], step=2, start=0.1, stop=0.2),
        ba.TorquePulse([3.0, -2.0, 1.0], step=2, start=0.1, stop=0.2, rise=0.04),
        ba.TorqueStep([3.0, -2.0, 1.0], step=2, start=0.1),
        ba.TorqueSine([3.0, -2.0, 1.0], frequency=5.0),
        TorqueNoise([3.0, -2.0, 1.0], bandwidth=10.0, seed=1, sines=4),
    ],
    ids=lambda wave: type(wave).__name__,
)
def test_a_force_on_a_link(biped, wave):
    push, q = OnLink(biped, "right_shin", wave, (0.1, 0.2)), np.linspace(-1.0, 1.0, 5)
    (law,) = push.laws
    for step, t in ((1, 1.13), (2, 1.13), (3, 1.13)):
        at = (t, step, 1.0, q, q)
        assert np.array_equal(agree(law.torque, law.parameters, *at), push.torque(*at))
    assert law.switches == wave.switches


@pytest.mark.parametrize("w", [(0.4, 0.1, 0.02), (0.4, 9.0, 0.02), (0.0, 0.1, 0.02)])
def test_a_stride_controller(biped, gait, w):
    gains = StrideGains(-1.0, -0.4)
    loop = StridePI(ba.NPDController(gait.constraint), 0.7, 0.3, TORSO_LEAN, gains)
    k, w = loop.parameters, np.array(w)
    (m, _), *_ = measurements(biped, gait)
    assert np.array_equal(agree(stride_jump, k, w), loop.own_jump(w, gait.constraint, m))
    for theta in np.linspace(k.theta_plus - 0.1, k.theta_plus + 0.5, 5):
        agree(stride_correction, k, w, float(theta))


def test_a_reference_reset(biped, gait):
    loop = ReferenceReset(ba.NPDController(gait.constraint))
    k = loop.parameters
    for m, _ in measurements(biped, gait):
        h = gait.constraint
        w = agree(reset_start, k, h(m.t, m.q, m.v), m)
        assert np.array_equal(w, loop.own_start(h, m))
        for theta in np.linspace(k.range.end - 0.1, k.range.end + 0.3, 5):
            agree(reset_polynomial, k.range, w.reshape(2, -1), float(theta))
        late = m._replace(q=gait.q_minus)
        assert not np.any(agree(reset_start, k, h(late.t, late.q, late.v), late))


def test_outputs_brought_to_rest():
    random = np.random.default_rng(6)
    for _ in range(5):
        agree(psi, *random.normal(size=(2, 4)), 0.9)


def test_every_class_with_laws_is_tested_here():
    for name in names("controller"):
        find("controller", name).load()  # every controller of the package

    def below(cls):
        for child in cls.__subclasses__():
            yield child
            yield from below(child)

    found = {
        cls.__name__
        for base in (Controller, Observer, Disturbance)
        for cls in below(base)
        if cls.__module__.startswith("biped_adrc.") and "laws" in vars(cls)
    }
    assert found == {
        *("NPDController", "ADRCController", "Passive", "GPIObserver", "SampledGPIObserver"),
        *("PDGravityController", "OutputADRCController", "MomentumDOBController"),
        Delayed.__name__,
        *("HighGainObserver", "MomentumObserver", "SampledMomentumObserver"),
        *("TorquePulse", "TorqueStep", "TorqueSine", "TorqueNoise", "OnLink", "HipForce", "Sum"),
    }


def test_what_has_no_law_says_so(gait):
    bent = CorrectedConstraint(gait.constraint, lambda theta: (np.zeros(4),) * 3)
    for controller in (ba.NPDController(bent), ba.ADRCController(bent)):
        assert controller.laws is None
        with pytest.raises(ba.BipedError, match="CorrectedConstraint, which has no law"):
            _ = controller.parameters

    class Own(GPIObserver):
        """A variant of which nothing is known."""

    own = Own.from_poles()
    assert replace(ba.ADRCController(gait.constraint), observer=own).laws is None

    class Brake(Disturbance):
        """A torque of which nothing is known."""

        def torque(self, t, step, t_start, q, v):
            return -v

    assert (ba.TorquePulse([1.0] * 5) + Brake()).laws is None
    assert (
        Controller.laws.fget(None)
        is Observer.laws.fget(None)
        is Disturbance.laws.fget(None)
        is None
    )
