"""Every law as machine code, from the lines that run in Python: the same numbers, and those of the methods."""

import ctypes
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.control.base import Controller, controller_laws
from biped_adrc.control.delayed import Delayed
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.passive import Passive
from biped_adrc.control.pd_gravity import PDGravityController
from biped_adrc.disturbances.base import Disturbance, disturbance_laws
from biped_adrc.disturbances.hip_force import HipForce
from biped_adrc.disturbances.link import OnLink
from biped_adrc.disturbances.noise import TorqueNoise
from biped_adrc.engine.compiled_walker import disturbance_code
from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.fingerprint import hash_of
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.machine import ModuleText, load_or_compile
from biped_adrc.engine.symbols import Tracer, Vector, column, floats, run
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import CorrectedConstraint
from biped_adrc.gait.reference import Reference, ReferenceLaws
from biped_adrc.observers.base import Estimate, Observer, ObserverLaws
from biped_adrc.observers.chain import chain_estimate, chain_reset, chain_state
from biped_adrc.observers.gpi import GPIObserver, SampledGPIObserver
from biped_adrc.observers.high_gain import HighGainObserver
from biped_adrc.observers.momentum import MomentumObserver, SampledMomentumObserver
from biped_adrc.scenario.registry import find, names
from biped_adrc.types import Array

SWAP = np.array([1, 0, 3, 2])
DOUBLES = ctypes.POINTER(ctypes.c_double)
FUNCTION = ctypes.CFUNCTYPE(None, DOUBLES, DOUBLES, DOUBLES)


def call(code, name, K, inp, size):
    """What a function of machine code writes."""
    out = np.full(size, np.nan)
    pointers = (np.ascontiguousarray(x).ctypes.data_as(DOUBLES) for x in (K, inp, out))
    FUNCTION(code.addresses[name])(*pointers)
    return out


def agree(law, *arguments):
    """The result in Python, equal to that of the machine code to 1e-12 of its largest number.

    The code solves linear systems by an elimination of its own, so round-off differs from LAPACK's.
    """
    expected = law(*arguments)
    numbers = np.array([x for argument in arguments for x in floats(argument)] + [0.0])
    K = Vector("K", len(numbers))
    made = run(Tracer(), law, *(K.like(argument) for argument in arguments))
    parts = made if isinstance(made, tuple) else (made,)
    function = SymbolicFunction(K.symbol, Vector("inp", 1).symbol, column(*parts))
    text = module_text({"law": function})
    code = load_or_compile(hash_of("tested", text), ["law"], lambda: ModuleText(text))
    one = (
        np.concatenate([np.ravel(x) for x in expected]) if isinstance(expected, tuple) else expected
    )
    other = call(code, "law", numbers, np.zeros(1), np.size(one))
    assert np.max(np.abs(np.ravel(one) - other), initial=0.0) <= 1e-12 * np.max(
        np.abs(one), initial=1.0
    )
    return expected


def measurements(biped, gait, count=5):
    walker = ba.Walker(biped, Passive())
    random = np.random.default_rng(3)
    q, v = gait.start(biped)
    for _ in range(count):
        x = q + 0.05 * random.normal(size=5), v + 0.5 * random.normal(size=5)
        m = walker.measure(0.1, *x, Mode())
        yield m._replace(body=biped.body_terms(*x)), random


SLOW = GPIObserver.from_bandwidth(20.0)
"""Its gains do not turn the last bit of an angle into 1e-9 of a rate, as those of Table I do."""
CONTROLLERS = {
    "passive": lambda c: Passive(),
    "PD with gravity": lambda c: PDGravityController(c),
    "NPD": lambda c: ba.NPDController(c),
    "ADRC": lambda c: ba.ADRCController(c),
    "ADRC, discrete": lambda c: ba.ADRCController(c).sampled(1e-3),
    "ADRC output": lambda c: OutputADRCController(c, SLOW),
    "DOB, discrete": lambda c: MomentumDOBController(c).sampled(1e-3),
    "delayed": lambda c: Delayed(OutputADRCController(c, SLOW), 2e-3),
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
        if laws.estimate:
            agree(laws.estimate, k, s, m)
    assert (laws.flow is not None) == (name in ("ADRC", "ADRC output", "delayed"))
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


def zeta_of(disturbance, at):
    """The sum of the machine code of a disturbance's laws."""
    t, step, t_start, q, v = at
    inp, total = np.array([t, step, t_start, *q, *v]), np.zeros(len(q))
    for law in disturbance_laws(disturbance):
        K = np.array([*floats(law.parameters), 0.0])
        total += call(disturbance_code(law, len(q)), "torque", K, inp, len(q))
    return total


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
            expected = total.torque(*at)
            assert np.max(np.abs(zeta_of(total, at) - expected)) <= 1e-13
            seen += any(expected)
    assert 0 < seen <= 15


def test_a_force_on_the_hip(biped):
    force = HipForce(biped, (-3.0, 1.0), steps=(2, 3))
    q = np.random.default_rng(5).uniform(-1.0, 1.0, 5)
    J = biped.pinned.jacobian(q, biped.pinned.hip)
    for step in (1, 2, 3, 4):
        F = np.array([-3.0, 1.0]) if step in (2, 3) else np.zeros(2)
        assert np.array_equal(F, force.resultant(0.0, step, 0.0))
        assert np.max(np.abs(J.T @ F - force.torque(0.0, step, 0.0, q, q))) < 1e-13
        assert np.max(np.abs(J.T @ F - zeta_of(force, (0.0, step, 0.0, q, q)))) < 1e-13


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
    code, K = disturbance_code(law, 5), np.array([*floats(law.parameters), 0.0])
    for step, t in ((1, 1.13), (2, 1.13), (3, 1.13)):
        at = (t, step, 1.0, q, q)
        assert np.max(np.abs(zeta_of(push, at) - push.torque(*at))) <= 1e-14
        found = call(code, "resultant", K, np.array([t, step, 1.0, *q, *q]), 2)
        assert np.max(np.abs(found - push.resultant(t, step, 1.0))) <= 1e-15
    assert law.switches == wave.switches


def test_every_class_with_laws_is_tested_here():
    for name in names("controller"):
        find("controller", name).load()  # every controller of the package

    def below(cls):
        for child in cls.__subclasses__():
            yield child
            yield from below(child)

    found = {
        cls.__name__
        for base in (Controller, Observer, Reference, Disturbance)
        for cls in below(base)
        if cls.__module__.startswith("biped_adrc.") and "laws" in vars(cls)
    }
    assert found == {
        *("NPDController", "Passive", "PDGravityController", "ObservingController", "Delayed"),
        *("ChainObserver", "GPIObserver", "SampledGPIObserver", "VirtualConstraint", "Windowed"),
        *("HighGainObserver", "MomentumObserver", "SampledMomentumObserver"),
        *("OnLink", "HipForce", "Sum"),
    }


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
    "NPD": lambda h, o: ba.NPDController(h),
    "PD": lambda h, o: PDGravityController(h),
    "ADRC": lambda h, o: ba.ADRCController(h, o),
    "ADRC output": lambda h, o: OutputADRCController(h, o),
    "delayed": lambda h, o: Delayed(ba.ADRCController(h, o), 2e-3),
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


@pytest.mark.parametrize("name", ["ADRC", "ADRC output", "delayed"])
def test_methods_do_what_laws_do(biped, gait, name):
    one, other = (
        TRACKING[name](gait.constraint, observer)
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

    class Brake(Disturbance):
        """A torque of which nothing is known."""

        def torque(self, t, step, t_start, q, v):
            return -v

    last = disturbance_laws(ba.TorquePulse([1.0] * 5) + Brake())[-1]
    assert last.obstacle == "disturbance Brake has no laws of arrays"


def test_what_neither_has_laws_nor_methods_says_what_to_write(biped, gait):
    class Empty(Controller):
        """Nothing."""

    class Nothing(Observer):
        """Nothing."""

    class Still(Reference):
        """Nothing."""

    class Calm(Disturbance):
        """Nothing."""

    z, walker = np.zeros(8), ba.Walker(biped, Empty())
    with pytest.raises(InputError, match=r"Empty has neither a method output\(s, m\) nor laws"):
        walker.initial_state(*gait.start(biped))
    with pytest.raises(InputError, match="Nothing has no laws, and does not write all"):
        Nothing().estimate(z)
    with pytest.raises(InputError, match="Still has neither laws nor a method __call__"):
        Still()(0.0, z, z)
    with pytest.raises(InputError, match="Calm has neither laws nor a method torque"):
        Calm().torque(0.0, 1, 0.0, z, z)
