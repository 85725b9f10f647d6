"""Controllers in plain Python on the compiled plant, against the Python engine."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.control.base import Controller, ControllerLaws
from biped_adrc.control.npd import npd_torque
from biped_adrc.disturbances.base import Disturbance, DisturbanceLaw, window_acts
from biped_adrc.disturbances.pulse import pulse_torque
from biped_adrc.engine.run import simulate_by
from biped_adrc.errors import NotFiniteError, SingularError
from biped_adrc.gait.constraint import virtual_constraint

simulate = partial(simulate_by, "compiled")

SHARP, TICKS = 1e-11, 1e-10
PLANT = "compiled plant"


def npd_output(k, s, m):
    """NPD on a virtual constraint; k is `NPDController(...).laws.parameters`."""
    return npd_torque(k.own, virtual_constraint(k.h, m.q, m.v), s, m)


@dataclass(frozen=True)
class InPython(Controller):
    """NPD, and from `after` [s] on `factor` times its torque; with a state that counts ticks."""

    npd: ba.NPDController
    after: float = np.inf
    factor: float = 1.0

    def initial_state(self, m):
        return np.zeros(1)

    def output(self, s, m):
        u = self.npd.output(s, m)
        return u if m.t < self.after else self.factor * u

    def predict(self, s, m, u):
        return s + 1.0

    def jump(self, s, after, swap):
        return s + 0.5


@dataclass(frozen=True)
class WithoutState(Controller):
    npd: ba.NPDController

    def output(self, s, m):
        return self.npd.output(s, m)


@dataclass(frozen=True)
class Falling(Disturbance):
    """A torque that is written as a method alone."""

    def torque(self, t, step, t_start, q, v):
        return np.array((3.0, 0.0, -2.0, 0.0, 1.0)) * np.exp(-t)


def runs(walker, gait, method, impacts=2, t_end=4.0, mode=None, every=1, t0=None):
    mode = Mode() if mode is None else mode
    x0 = walker.initial_state(*gait.start(walker.nominal), mode)
    stop = None if impacts is None else (FOOT_STRIKE, impacts)
    t0 = mode.start if t0 is None else t0
    same = {"t_end": t_end, "t0": t0, "store_every": every}
    python = ba.simulate(walker, x0, mode, method, stop_after=stop, **same)
    return python, simulate(walker, x0, mode, method, impacts=impacts, **same)


def near(found, expected, tolerance):
    gap = np.abs(found - expected)
    scale = np.maximum(1.0, np.max(np.abs(expected), axis=0, initial=0.0))
    assert np.all(gap <= tolerance * scale), np.max(gap / scale)


def same(python, partly, tolerance, why):
    assert partly.status is python.status, (partly.detail, python.detail)
    assert partly.settings["engine"] == PLANT
    assert why in partly.settings["why"]
    assert "on the compiled plant" in partly.settings["why"]
    assert len(partly.arcs) == len(python.arcs)
    for found, expected in zip(partly.arcs, python.arcs, strict=True):
        assert found.mode.step == expected.mode.step
        assert found.t.shape == expected.t.shape
        for name in ("t", "x", "dx"):
            near(getattr(found, name), getattr(expected, name), tolerance)
        assert (found.event is None) == (expected.event is None)
        if expected.event is not None:
            assert found.event.guard == expected.event.guard
            near(found.event.x_minus, expected.event.x_minus, tolerance)
            assert (found.event.x_plus is None) == (expected.event.x_plus is None)
            if expected.event.x_plus is not None:
                near(found.event.x_plus, expected.event.x_plus, tolerance)


@pytest.fixture
def python(gait):
    return InPython(ba.NPDController(gait.constraint))


@pytest.fixture
def ticked(biped, python):
    return ba.Walker(biped, python, timing=ba.SampledTime(1e-3), torque_limit=120.0)


@pytest.mark.parametrize("restart", [True, False])
def test_tick_by_tick(gait, ticked, restart):
    """With a state of its own, sub-steps that do not divide the period, and a late start."""
    walker = replace(ticked, timing=ba.SampledTime(1e-3, restart))
    late = {"mode": Mode(3, 0.41237), "every": 2}
    runs_ = runs(walker, gait, ba.RK4(4e-4), **late)
    same(*runs_, TICKS, "controller InPython has no laws")
    s = runs_[1].final_state[10]
    assert s > 800.0
    assert s % 1.0 == 0.0


def test_tick_by_tick_with_other_methods_pushes_and_ground(biped, gait, ticked):
    push = ba.TorquePulse((30.0, 0.0, -10.0, 5.0, 3.0), 1, 0.1003, 0.1007)
    walker = replace(ticked, disturbance=push, ground_steps=(ba.StepDown(1, 0.002),))
    heavy = biped.with_errors(mass={"torso": 1.05})
    walker = replace(walker, plant=heavy, model=biped, slope=0.02)
    same(*runs(walker, gait, ba.RK4(1e-3)), TICKS, "InPython")
    same(*runs(walker, gait, ba.Adaptive(1e-9, 1e-9), impacts=1), TICKS, "InPython")


@pytest.mark.parametrize("method", [ba.RK4(2e-3), ba.Stiff(1e-6, 1e-6)], ids=["RK4", "stiff"])
def test_in_continuous_time(biped, gait, method):
    npd = ba.NPDController(gait.constraint)
    walker = ba.Walker(biped, WithoutState(npd), torque_limit=90.0)
    if isinstance(method, ba.RK4):
        same(*runs(walker, gait, method), SHARP, "controller WithoutState has no laws")
        return
    python, partly = runs(replace(walker, controller=npd), gait, method)
    assert "method Stiff has no compiled form" in partly.settings["why"]
    near(partly.before(FOOT_STRIKE), python.before(FOOT_STRIKE), 1e-6)


@pytest.mark.parametrize("sampled", [False, True], ids=["continuous", "sampled"])
def test_disturbances_without_laws(biped, gait, sampled):
    time = ba.SampledTime(1e-3) if sampled else ba.ContinuousTime()
    tolerance = TICKS if sampled else SHARP
    npd = ba.NPDController(gait.constraint)
    hip = ba.HipForce(biped, (-2.0, 0.0))
    walker = ba.Walker(biped, npd, Falling() + hip, time)
    same(*runs(walker, gait, ba.RK4(2e-3), impacts=1), tolerance, "disturbance Falling has no laws")


# -- what goes wrong in Python ---------------------------------------------------------------------
@pytest.mark.parametrize("factor", [np.nan, 1e300])
@pytest.mark.parametrize("sampled", [False, True], ids=["continuous", "sampled"])
def test_torques_without_numbers(biped, gait, python, sampled, factor):
    broken = replace(python, after=0.1, factor=factor)
    walker = ba.Walker(biped, broken if sampled else Stateless(broken))
    if sampled:
        walker = replace(walker, timing=ba.SampledTime(1e-3))
    python, partly = runs(walker, gait, ba.RK4(2e-3))
    assert python.status is ba.Status.NOT_FINITE
    assert partly.status is ba.Status.NOT_FINITE
    if factor != 1e300:  # where the state overflows later, what is named differs in its last digits
        assert partly.detail == python.detail
    assert partly.t_end == python.t_end
    near(partly.final_state, python.final_state, TICKS)


@dataclass(frozen=True)
class Stateless(Controller):
    inner: InPython

    def output(self, s, m):
        return self.inner.output(s, m)


@dataclass(frozen=True)
class Jumping(InPython):
    """Raises at its first impact."""

    raises: type = NotFiniteError

    def jump(self, s, after, swap):
        raise self.raises("the jump")


@pytest.mark.parametrize(
    ("raises", "status"),
    [(NotFiniteError, ba.Status.NOT_FINITE), (SingularError, ba.Status.SINGULAR)],
)
def test_a_jump_that_raises_ends_the_run_with_its_status(gait, ticked, raises, status):
    npd = ba.NPDController(gait.constraint)
    walker = replace(ticked, controller=Jumping(npd, raises=raises))
    python, partly = runs(walker, gait, ba.RK4(1e-3))
    assert python.status is status
    assert partly.status is status
    assert partly.detail == python.detail == "the jump"
    assert partly.events() == python.events() == ()
    assert np.all(np.isfinite(partly.final_state))
    assert abs(partly.t_end - python.t_end) <= 1e-3


def test_an_exception_of_the_controller_s_own_comes_out(gait, ticked):
    npd = ba.NPDController(gait.constraint)
    walker = replace(ticked, controller=Jumping(npd, raises=KeyError))
    with pytest.raises(KeyError, match="the jump"):
        runs(walker, gait, ba.RK4(1e-3))
    x0 = walker.initial_state(*gait.start(walker.plant))
    with pytest.raises(KeyError, match="the jump"):
        simulate(walker, x0, Mode(), ba.RK4(1e-3), t_end=4.0, impacts=1)


# -- laws that cannot be compiled ------------------------------------------------------------------
branching = lambda k, s, m: npd_output(k, s, m) * (1.0 if m.t < 0.1 else 0.9)  # noqa: E731


def pulsing(k, t, step, t_start, q, v):
    """A pulse that is weaker later on."""
    return pulse_torque(k, t, step, t_start, q, v) * (1.0 if t < 0.15 else 0.9)


@dataclass(frozen=True)
class Branching(WithoutState):
    """Its law branches, so that it is no expression."""

    def output(self, s, m):
        return branching(self.npd.laws.parameters, s, m)

    @property
    def laws(self):
        return ControllerLaws(self.npd.laws.parameters, branching)


@dataclass(frozen=True)
class BranchingPulse(ba.TorquePulse):
    @property
    def laws(self):
        return (DisturbanceLaw(self.parameters, pulsing, self.switches, active=window_acts),)


@pytest.mark.parametrize("sampled", [False, True], ids=["continuous", "sampled"])
def test_laws_that_cannot_be_compiled_run_in_python(biped, gait, sampled):
    time = ba.SampledTime(1e-3) if sampled else ba.ContinuousTime()
    npd = ba.NPDController(gait.constraint)
    pulse = BranchingPulse((3.0, 0.0, 0.0, 1.0, 0.0), 1, 0.1003, 0.2)
    for walker in (
        ba.Walker(biped, Branching(npd), timing=time),
        ba.Walker(biped, npd, pulse, timing=time),
    ):
        why = "cannot be compiled: the law branches on the value of a number"
        same(*runs(walker, gait, ba.RK4(2e-3), impacts=1), TICKS, why)


def test_progress_and_the_engine_asked_for(gait, ticked):
    x0 = ticked.initial_state(*gait.start(ticked.plant))
    told = []
    more = {"t_end": 4.0, "impacts": 2, "progress": lambda t, n: told.append((t, n))}
    run = simulate_by("compiled", ticked, x0, Mode(), ba.RK4(1e-3), **more)
    assert run.settings["engine"] == PLANT
    assert [n for _, n in told] == [1, 2]
    assert [t for t, _ in told] == [event.t for event in run.events(FOOT_STRIKE)]
    run = simulate_by("pinocchio", ticked, x0, Mode(), ba.RK4(1e-3), t_end=0.01)
    assert run.settings["engine"] == "pinocchio"
