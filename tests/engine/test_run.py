"""Compiled runs against the Python engine's: the same arcs, nodes, events and statuses.

`runs(walker, gait, method)` walks two steps by the Python engine ("pinocchio") and by the compiled one, in
machine code. `same(python, compiled, tolerance)` compares all nodes (stored instants) and events, as shares of
each column's largest number, `same_events` the events alone. Tolerances: SHARP = 1e-11 is round-off of sums in
another order, TICKS = 1e-10 in sampled time, where gains amplify it, LANDED = 1e-6 where the last sub-step
before an event differs.

A controller that cannot be traced, as it branches on a number, is called in Python by the "compiled plant";
`in_part` asserts that, with the reason why, and the same walk. `npd` and `adrc` make controllers, `ticked` is a
walker in sampled time with such a controller in Python.
"""

import gc
import re
import signal
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from inspect import getsourcelines

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.control.base import Controller
from biped_adrc.core.errors import InputError, ModelError, NotFiniteError, SingularError
from biped_adrc.core.linear import solve
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.engine import numbers
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.published import passive_cycle
from biped_adrc.hybrid import simulator
from tests.plain import Undecorated

simulate = partial(simulate_by, "compiled")

SHARP = 1e-11
"""Largest difference of the engines: round-off of sums in another order, which nothing amplifies."""
TICKS = 1e-10
"""The same in sampled time, where the gains amplify round-off of an angle and a tick holds the torque."""
LANDED = 1e-6
"""The same of methods whose last sub-step before an event, or whose choice of steps, differs in both
engines."""
PULSE = (30.0, 0.0, -10.0, 5.0, 3.0)


def npd(gait, **more):
    return ba.NPDController(gait.constraint, **more)


def adrc(gait, bandwidth=300.0, **more):
    return ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(bandwidth), **more)


def runs(
    walker, gait, method, impacts=2, t_end=4.0, mode=None, t0=None, start=None, every=1, x0=None
):
    """The runs of a walker by the Python engine and by the compiled one."""
    mode = Mode() if mode is None else mode
    t0 = mode.start if t0 is None else t0
    if x0 is None:
        q, v = gait.start(walker.nominal) if start is None else start
        x0 = walker.initial_state(q, v, mode)
    stop = None if impacts is None else (FOOT_STRIKE, impacts)
    same = {"t_end": t_end, "t0": t0, "store_every": every}
    python = simulator.simulate(walker, x0, mode, method, stop_after=stop, **same)
    return python, simulate(walker, x0, mode, method, impacts=impacts, **same)


def near(found, expected, tolerance):
    """Each column within `tolerance` of its largest number, or of 1 where that is smaller."""
    gap = np.abs(found - expected)
    scale = np.maximum(1.0, np.max(np.abs(expected), axis=0, initial=0.0))
    assert np.all(gap <= tolerance * scale), np.max(gap / scale)


def same_events(python, compiled, tolerance, engine="compiled"):
    """The runs have equal ends, engines as expected, and single supports and events within `tolerance`."""
    assert compiled.status is python.status, (compiled.status, compiled.detail, python.detail)
    assert compiled.settings["engine"] == engine
    assert compiled.settings["method"] == python.settings["method"]
    assert len(compiled.arcs) == len(python.arcs)
    for found, expected in zip(compiled.arcs, python.arcs, strict=True):
        assert found.mode.step == expected.mode.step
        assert abs(found.mode.start - expected.mode.start) <= tolerance
        if expected.event is None:
            assert found.event is None
            continue
        assert found.event.guard == expected.event.guard
        assert abs(found.event.t - expected.event.t) <= tolerance
        near(found.event.x_minus, expected.event.x_minus, tolerance)
        assert (found.event.x_plus is None) == (expected.event.x_plus is None)
        if expected.event.x_plus is not None:
            near(found.event.x_plus, expected.event.x_plus, tolerance)


def same(python, compiled, tolerance, engine="compiled"):
    """The runs agree in events and in all nodes."""
    same_events(python, compiled, tolerance, engine)
    for found, expected in zip(compiled.arcs, python.arcs, strict=True):
        assert found.t.shape == expected.t.shape
        near(found.t, expected.t, tolerance)
        near(found.x, expected.x, tolerance)
        near(found.dx, expected.dx, tolerance)


# -- methods and time bases beyond what tests/control/conforms.py asks of every method ---------------


@pytest.mark.parametrize("restart", [True, False])
def test_both_engines_have_the_same_sample_instants(biped, gait, restart):
    """Steps of 0.8 ms do not divide the period of 2 ms; a clock without restart counts from the late
    start at 0.41237 s, one with restart from each impact.
    """
    time = ba.SampledTime(2e-3, restart)
    walker = ba.Walker(biped, adrc(gait), timing=time, torque_limit=120.0)
    python, compiled = runs(walker, gait, ba.RK4(8e-4), 2, mode=Mode(3, 0.41237))
    same(python, compiled, TICKS)
    origin = compiled.arcs[1].mode.start if restart else 0.41237
    ticks = (compiled.arcs[1].t - origin) / 2e-3
    assert np.any(np.abs(ticks - np.round(ticks)) < 1e-9)


def test_ticks_with_table_one_and_steps_longer_than_the_period(biped, gait):
    """The gains of Table I amplify round-off to 1e-7. Steps of 5 ms are cut at the ticks of 1 ms."""
    time = ba.SampledTime(1e-3)
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint), timing=time)
    same(*runs(walker, gait, ba.RK4(5e-3)), 1e-7)


def test_a_run_that_begins_within_a_single_support(biped, gait):
    """Step 2 began at 0.2 s, the run begins at 0.3 s and ends at a time, not at an impact; the longest time of
    a step counts from 0.2 s. Then the same in sampled time.
    """
    walker = ba.Walker(biped, npd(gait), max_step_time=0.5)
    late = {"mode": Mode(2, 0.2), "t0": 0.3, "t_end": 0.9, "impacts": None}
    same(*runs(walker, gait, ba.RK4(2e-3), **late), SHARP)
    ticks = replace(walker, timing=ba.SampledTime(1e-3, restart=False))
    same(*runs(ticks, gait, ba.RK4(1e-3), **late), TICKS)


# -- disturbances, plants, ground ------------------------------------------------------------------


SEVERAL = (
    ba.TorqueSine((5.0, 0.0, -3.0, 2.0, 1.0), 1, 0.05, 0.3, frequency=7.0)
    + ba.TorqueStep((1.0, 0.0, 0.0, 1.0, 0.5), 2, 0.1)
    + ba.TorquePulse(PULSE, 1, 0.1003, 0.1007)
    + ba.TorquePulse((0.0, 1.0, 0.0, 0.0, 0.0), None, 0.1005, 0.45)
)
"""Pushes within one integration step, over an impact, and from the second single support on."""


@pytest.mark.parametrize("sampled", [False, True], ids=["continuous", "sampled"])
def test_both_engines_make_the_same_walk_under_pushes(biped, gait, sampled):
    """SEVERAL has four pushes: a sine, one from the second single support on, one within an integration step,
    one over an impact; so integration steps end at their jumps.
    """
    time = ba.SampledTime(1e-3) if sampled else ba.ContinuousTime()
    walker = ba.Walker(biped, npd(gait), SEVERAL, time)
    python, compiled = runs(walker, gait, ba.RK4(4e-3))
    same(python, compiled, TICKS if sampled else SHARP)


def test_a_plant_that_is_not_the_model_on_a_slope_and_under_a_limit(biped, gait):
    """The plant has a heavier torso and thigh than the model; then it walks also under a push and a lower
    torque limit by the exponential method, which ends at events by other sub-steps (LANDED).
    """
    plant = ba.ModelErrors(mass={"torso": 0.05}, inertia={"thigh": 0.2}).apply(biped)
    walker = ba.Walker(plant, adrc(gait), model=biped, slope=0.02, torque_limit=90.0)
    same(*runs(walker, gait, ba.RK4(3e-3)), SHARP)
    pushed = replace(
        walker, disturbance=ba.TorquePulse(PULSE, 1, 0.1003, 0.1607), torque_limit=60.0
    )
    same(*runs(pushed, gait, ba.Exponential(2e-3), impacts=1), LANDED)


def test_ground_steps_add_up(biped, gait):
    """Two steps down of 2 mm and 1 mm in step 2: the swing foot lands 3 mm lower."""
    down = (ba.StepDown(2, 0.002), ba.StepDown(2, 0.001))
    walker = ba.Walker(biped, adrc(gait), ground_steps=down)
    python, compiled = runs(walker, gait, ba.RK4(4e-3))
    same(python, compiled, SHARP)
    x, z = walker.plant.swing_foot(compiled.arcs[1].event.x_minus[:5])
    assert x > 0.0
    assert z == pytest.approx(-0.003, abs=1e-12)


@pytest.mark.parametrize("robot", ["rimless_wheel", "simplest"])
def test_robots_without_motors_walk_alike_in_both_engines(robot):
    """The rimless wheel has all its mass in one point: inertia matrices of double support are singular."""
    biped = ba.Biped.load(robot)
    known = passive_cycle(biped)
    walker = ba.Walker(biped, ba.Passive(), slope=known.slope, max_step_time=known.max_step_time)
    start = known.q_plus, known.v_plus
    t_end = 9.0 * known.max_step_time
    python, compiled = runs(walker, None, ba.RK4(4e-3), t_end=t_end, start=start)
    # its feet have 1e-7 of the hip's mass, so the matrices are ill-conditioned
    tolerance = 1e-7 if robot == "simplest" else SHARP
    same_events(python, compiled, tolerance)
    assert len(python.events(FOOT_STRIKE)) == 2


# -- how runs end ----------------------------------------------------------------------------------
FALLS = (ba.Status.FELL, ba.Status.RAN_AWAY)


@pytest.mark.parametrize("sampled", [False, True], ids=["continuous", "sampled"])
def test_both_engines_end_falls_stalls_and_time_outs_alike(biped, gait, sampled):
    """A push of 60 N m on the torso makes a fall, without a torque limit a runaway; a step may last 0.3 s,
    which is too short; 0.7 s are too short for two impacts, and end a run without a number of impacts well.

    Falls amplify round-off to 1e-9.
    """
    time = ba.SampledTime(2e-3) if sampled else ba.ContinuousTime()
    walker = ba.Walker(biped, npd(gait), timing=time)
    push = ba.TorqueStep((0.0, 0.0, 0.0, 0.0, 60.0), 1, 0.1)
    ends = {
        ba.Status.FELL: (replace(walker, disturbance=push, torque_limit=150.0), {}),
        ba.Status.RAN_AWAY: (replace(walker, disturbance=push), {}),
        ba.Status.STALLED: (replace(walker, max_step_time=0.3), {}),
        ba.Status.TIME_OUT: (walker, {"t_end": 0.7}),
        ba.Status.COMPLETED: (walker, {"t_end": 0.7, "impacts": None}),
    }
    for status, (made, more) in ends.items():
        python, compiled = runs(made, gait, ba.RK4(4e-3), **more)
        assert python.status is status
        same(python, compiled, 1e-9 if status in FALLS else TICKS)


@dataclass(frozen=True)
class Stateless(Controller):
    """The torque of another controller, without its state."""

    inner: Controller

    def output(self, s, m):
        return self.inner.output(s, m)


class Rooted(Stateless):
    """NaN after 0.1 s."""

    def output(self, s, m):
        return super().output(s, m) * np.sqrt(0.1 - m.t)


class Closing(Stateless):
    """Singular from 0.05 s on, and larger than any limit just before."""

    def output(self, s, m):
        A = np.eye(1) * np.maximum(0.05 - m.t, 0.0)
        return super().output(s, m) + 1e-3 * solve(A, np.ones(1), "the matrix")[0]


@pytest.mark.parametrize("sampled", [False, True], ids=["continuous", "sampled"])
def test_a_torque_limit_hides_neither_nan_nor_a_singular_matrix(biped, gait, sampled):
    """min and max with the limit may turn NaN into a number, and the walk would go on. `Rooted` gives NaN after
    0.1 s, `Closing` solves with a matrix that is singular from 0.05 s on.
    """
    time = ba.SampledTime(1e-3) if sampled else ba.ContinuousTime()
    for cls, status in ((Rooted, ba.Status.NOT_FINITE), (Closing, ba.Status.SINGULAR)):
        walker = ba.Walker(biped, cls(npd(gait)), timing=time, torque_limit=100.0)
        python, compiled = runs(walker, gait, ba.RK4(2e-3))
        assert python.status is status
        assert compiled.status is status
        assert compiled.t_end == python.t_end
        near(compiled.final_state, python.final_state, TICKS)


# -- laws that look at numbers ---------------------------------------------------------------------


def scaled(factor):
    return lambda u: factor * u


@dataclass(frozen=True)
class Shaped(Stateless):
    """A torque that a function changes."""

    shape: Callable[[Array], Array]

    def output(self, s, m):
        return self.shape(super().output(s, m))


def test_what_a_law_has_around_it_is_part_of_it(biped, gait):
    """A law that is compiled with the value of a closure, here a factor 1 or 0.9 of the torque, is not found
    again for another value.
    """
    ends = []
    for factor in (1.0, 0.9):
        walker = ba.Walker(biped, Shaped(npd(gait), scaled(factor)))
        python, compiled = runs(walker, gait, ba.RK4(2e-3), impacts=1)
        same(python, compiled, SHARP)
        ends.append(compiled.final_state)
    assert np.max(np.abs(ends[0] - ends[1])) > 1e-3


# -- what is refused, and what is used instead -----------------------------------------------------
def test_a_method_that_does_not_fit_is_refused(biped, gait):
    """Refused are the exponential method for a controller without an observer, and in sampled time; then a run
    of no duration, a start of NaN, an engine that does not exist.
    """
    for walker in (
        ba.Walker(biped, npd(gait)),
        ba.Walker(biped, adrc(gait), timing=ba.SampledTime(1e-3)),
    ):
        x0 = walker.initial_state(*gait.start(biped))
        for engine in ("compiled", "pinocchio"):
            with pytest.raises(InputError, match="needs a controller in continuous time whose obs"):
                simulate_by(engine, walker, x0, Mode(), ba.Exponential(), t_end=1.0)
    with pytest.raises(InputError, match="positive duration"):
        simulate(walker, x0, Mode(), ba.RK4(), t_end=0.0)
    with pytest.raises(InputError, match="finite numbers"):
        simulate(walker, x0 * np.nan, Mode(), ba.RK4(), t_end=1.0)
    with pytest.raises(InputError, match="engine 'c' is unknown"):
        simulate_by("c", walker, x0, Mode(), ba.RK4(), t_end=1.0)


def test_a_robot_that_is_no_planar_tree_is_simulated_with_pinocchio(gait, monkeypatch):
    """Machine code needs the closed form of a planar tree (`robot_of`), which is refused here; the run says
    what was used instead and why.
    """

    def refuse(biped):
        raise ModelError("no planar tree")

    monkeypatch.setattr(numbers, "robot_of", refuse)
    biped = ba.Biped.load("rabbit")  # another object: nothing of it is remembered
    walker = ba.Walker(biped, npd(gait))
    x0 = walker.initial_state(*gait.start(biped))
    run = simulate_by("compiled", walker, x0, Mode(), ba.RK4(2e-3), t_end=0.05)
    assert run.settings["engine"] == "pinocchio"
    assert run.settings["why"] == "no planar tree; Pinocchio was used instead"


# -- parts in plain Python on the compiled plant ---------------------------------------------------
PLANT = "compiled plant"


@dataclass(frozen=True)
class InPython(Controller):
    """NPD, and from `after` [s] on, by a branch, `factor` times its torque; with a state that counts ticks."""

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
class Falling(Disturbance):
    """A torque that cannot be traced."""

    def torque(self, t, step, t_start, q, v):
        return np.array((3.0, 0.0, -2.0, 0.0, 1.0)) * np.exp(-np.interp(t, (0.0, 9.0), (0.0, 9.0)))


def in_part(python, partly, tolerance, why):
    """The run on the compiled plant says `why`, and is the run in Python."""
    assert why in partly.settings["why"]
    same(python, partly, tolerance, PLANT)


@pytest.fixture
def python(gait):
    return InPython(ba.NPDController(gait.constraint))


@pytest.fixture
def ticked(biped, python):
    return ba.Walker(biped, python, timing=ba.SampledTime(1e-3), torque_limit=120.0)


def test_a_controller_in_python_is_called_at_the_same_ticks_on_a_compiled_plant(gait, ticked):
    """The integration steps do not divide the period, and the start is late; the controller counts its ticks.

    Two single supports have more than 800 ticks of 1 ms; its jumps add 1/2 each, which two of them make whole.
    """
    walker = replace(ticked, timing=ba.SampledTime(1e-3, restart=False))
    late = {"mode": Mode(3, 0.41237), "every": 2}
    runs_ = runs(walker, gait, ba.RK4(4e-4), **late)
    in_part(*runs_, TICKS, "InPython.output")
    s = runs_[1].final_state[10]  # the controller's state, behind q and v
    assert s > 800.0
    assert s % 1.0 == 0.0


@dataclass(frozen=True)
class Drifting(ba.Reference):
    """A curve that moves on with time."""

    h: ba.VirtualConstraint

    def __call__(self, t, q, v):
        r = self.h(t, q, v)
        return r._replace(q_d=r.q_d + 0.01 * t, dq_d=r.dq_d + 0.01)


@dataclass(frozen=True)
class Keeping(Controller):
    """Keeps what it gets, and the reference there, at this time and at a later one."""

    reference: ba.Reference
    kept: list = field(default_factory=list)

    def output(self, s, m):
        now, later = (self.reference(t, m.q, m.v) for t in (m.t, m.t + 0.1))
        self.kept.append((m, now, later))
        return 2500.0 * (now.q_d - m.q_b) + 120.0 * (now.dq_d - m.v_b)


def test_what_a_controller_in_python_keeps_stays_what_it_was(biped, gait):
    """The inputs of a controller in Python lie in blocks of 256 sample instants, which must not be used again;
    all are read-only. `Keeping` keeps them in a list, with the reference now and 0.1 s later, and all are as at
    their node in the end.
    """
    reference = Drifting(gait.constraint)
    walker = ba.Walker(biped, Keeping(reference), timing=ba.SampledTime(1e-3))
    x0, kept = walker.initial_state(*gait.start(biped)), walker.controller.kept
    kept.clear()  # of the calls that tried the controller at the start
    run = simulate(walker, x0, Mode(), ba.RK4(1e-3), t_end=0.3)
    assert "Keeping.output" in run.settings["why"]
    at = dict(zip(run.arcs[0].t.tolist(), run.arcs[0].x, strict=True))
    assert len(kept) > 256
    for m, *points in kept:
        assert np.array_equal(np.concatenate((m.q, m.v)), at[m.t][:10])
        near(m.terms.D, biped.reduction(m.q, m.v).D, SHARP)
        for t, point in zip((m.t, m.t + 0.1), points, strict=True):
            near(point.q_d, reference(t, m.q, m.v).q_d, SHARP)
        assert not any(x.flags.writeable for x in (m.q, m.v, m.terms.D, points[0].q_d))


def test_an_interrupt_is_not_lost(gait, ticked):
    """Most interrupts come while machine code runs, and are raised as the next method is called, before its
    first line. Alarms after 20 ms and more stand for Ctrl-C; each has to end the walks. The garbage collector
    is off, since Python drops an interrupt in a callback of its own.
    """
    x0 = ticked.initial_state(*gait.start(ticked.plant))
    walk = partial(simulate, ticked, x0, Mode(), ba.RK4(1e-3), t_end=0.2)
    whole, before = walk(), signal.signal(signal.SIGALRM, signal.default_int_handler)

    def walks(seconds):
        signal.setitimer(signal.ITIMER_REAL, seconds)
        for _ in range(500):
            assert np.array_equal(walk().final_state, whole.final_state)

    gc.disable()
    try:
        for k in range(8):
            with pytest.raises(KeyboardInterrupt):
                walks(0.02 + 0.003 * k)
    finally:
        gc.enable()
        signal.signal(signal.SIGALRM, before)


def test_tick_by_tick_with_hardware_other_methods_pushes_and_ground(biped, gait, ticked):
    """A controller in Python walks on the compiled plant as on Pinocchio's, whatever is around it: a push, a
    step down, a slope, a heavy plant, a delay and encoders; also by Adaptive, which runs in Python.
    """
    push = ba.TorquePulse((30.0, 0.0, -10.0, 5.0, 3.0), 1, 0.1003, 0.1007)
    walker = replace(ticked, disturbance=push, ground_steps=(ba.StepDown(1, 0.002),))
    heavy = ba.ModelErrors(mass={"torso": 0.05}).apply(biped)
    walker = replace(walker, plant=heavy, model=biped, slope=0.02)
    late = ba.SampledTime(1e-3, delay=0.4e-3)
    walker = replace(walker, timing=late, sensors=ba.Sensors(filter_time=2e-3))
    in_part(*runs(walker, gait, ba.RK4(1e-3)), TICKS, "InPython")
    why = "method Adaptive has no compiled form"
    in_part(*runs(walker, gait, ba.Adaptive(1e-9, 1e-9), t_end=0.11, impacts=None), TICKS, why)


@pytest.mark.parametrize("method", [ba.RK4(2e-3), ba.Adaptive(1e-6, 1e-6)], ids=["RK4", "adaptive"])
def test_a_controller_in_python_walks_on_a_compiled_plant_in_continuous_time(
    biped, gait, python, method
):
    """By RK4 the walk is that of Python to round-off. Adaptive runs in Python, here with NPD itself; it chooses
    other steps on the compiled plant: states before impact are compared to 1e-6.
    """
    walker = ba.Walker(biped, Stateless(python), torque_limit=90.0)
    if isinstance(method, ba.RK4):
        in_part(*runs(walker, gait, method), SHARP, "InPython.output")
        return
    python, partly = runs(replace(walker, controller=python.npd), gait, method)
    assert "method Adaptive has no compiled form" in partly.settings["why"]
    near(partly.before(FOOT_STRIKE), python.before(FOOT_STRIKE), 1e-6)


def test_a_disturbance_without_machine_code_acts_alike_in_both_engines(biped, gait):
    """`Falling` uses np.interp, which cannot be traced; the compiled plant calls it in Python, beside a force
    on the hip, and names its line.
    """
    hip = ba.HipForce(biped, (-2.0, 0.0))
    walker = ba.Walker(biped, npd(gait), Falling() + hip, ba.SampledTime(1e-3))
    in_part(*runs(walker, gait, ba.RK4(2e-3), impacts=1), TICKS, "Falling.torque (test_run")


# -- what goes wrong in Python ---------------------------------------------------------------------
@pytest.mark.parametrize("factor", [np.nan, 1e300])
@pytest.mark.parametrize("sampled", [False, True], ids=["continuous", "sampled"])
def test_a_torque_that_is_nan_or_huge_ends_both_engines_alike(biped, gait, python, sampled, factor):
    """factor: of NPD's torque from 0.1 s on. NaN is no number, 1e300 a runaway."""
    broken = replace(python, after=0.1, factor=factor)
    law, timing = (
        (broken, ba.SampledTime(1e-3)) if sampled else (Stateless(broken), ba.ContinuousTime())
    )
    walker = ba.Walker(biped, law, timing=timing)
    python, partly = runs(walker, gait, ba.RK4(2e-3))
    expected = ba.Status.RAN_AWAY if factor == 1e300 else ba.Status.NOT_FINITE
    assert (python.status, partly.status) == (expected, expected)
    if factor != 1e300:  # where the state overflows later, what is named differs in its last digits
        assert partly.detail == python.detail
    assert partly.t_end == python.t_end
    near(partly.final_state, python.final_state, TICKS)


@dataclass(frozen=True)
class Jumping(InPython):
    """Raises at its first impact."""

    raises: type = NotFiniteError

    def jump(self, s, after, swap):
        raise self.raises("the jump")


@pytest.mark.parametrize(
    ("raises", "status"),
    [
        (NotFiniteError, ba.Status.NOT_FINITE),
        (SingularError, ba.Status.SINGULAR),
        (KeyError, ba.Status.RAISED),
    ],
)
def test_a_jump_that_raises_ends_the_run_with_its_status(gait, ticked, raises, status):
    """The run ends at its first impact, which then is no event; an error that is not the package's is named
    with its place. The end is the last node before, up to an integration step of 1 ms.
    """
    npd = ba.NPDController(gait.constraint)
    walker = replace(ticked, controller=Jumping(npd, raises=raises))
    python, partly = runs(walker, gait, ba.RK4(1e-3))
    assert python.status is status
    assert partly.status is status
    place = r"Jumping\.jump \(test_run\.py:\d+.*\) raised KeyError: "
    said = rf"{place}'the jump'" if raises is KeyError else "the jump"
    assert re.fullmatch(said, python.detail)
    assert partly.detail == python.detail
    assert partly.events() == python.events() == ()
    assert np.all(np.isfinite(partly.final_state))
    assert abs(partly.t_end - python.t_end) <= 1e-3


def test_an_interrupt_within_a_sample_instant_is_raised(gait, ticked):
    """Ctrl-C while a controller in Python runs ends the program, not only the run as errors do."""
    npd = ba.NPDController(gait.constraint)
    walker = replace(ticked, controller=Jumping(npd, raises=KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        ba.walk(walker, gait, 2)


# -- methods that cannot be compiled ---------------------------------------------------------------
class Branching(Stateless):
    def output(self, s, m):
        return super().output(s, m) * (1.0 if m.t < 0.1 else 0.9)


class LooksUp(Stateless):
    def output(self, s, m):
        return super().output(s, m) * {1: 0.9}.get(m.step, 1.0)


class Rounds(Stateless):
    def output(self, s, m):
        return super().output(s, m) * (1.0 + 0.1 * int(10.0 * m.t))


class Interpolates(Stateless):
    def output(self, s, m):
        return super().output(s, m) * np.interp(m.t, (0.0, 1.0), (1.0, 0.9))


class Checks(Stateless):
    def output(self, s, m):
        return super().output(s, m) * (1.0 if np.isfinite(m.q).all() else 0.9)


class Turns(Stateless):
    def output(self, s, m):
        return super().output(s, m) + 0.0 * np.arctan2(m.t, 1.0)


class Fills(Stateless):
    def output(self, s, m):
        return super().output(s, m) + 0.0 * np.nan_to_num(m.q_b)


@dataclass(frozen=True)
class Logs(Stateless):
    kept: list = field(default_factory=list)

    def output(self, s, m):
        self.kept.append(m.t)
        return super().output(s, m)


@dataclass(frozen=True)
class Noisy(Stateless):
    noise: np.random.Generator = field(default_factory=np.random.default_rng)

    def output(self, s, m):
        return super().output(s, m) + 0.0 * self.noise.normal()


class Catches(Stateless):
    def output(self, s, m):
        try:
            return super().output(s, m) * (1.0 if m.t < 0.02 else 0.9)
        except Exception:
            return np.zeros(4)


IN_PYTHON = {
    Branching: "branches on the value of a number",
    LooksUp: "looks a number up",
    Rounds: "int()",
    Interpolates: "turns a number into a float",
    Checks: ": a function or operator there has no compiled form;",
    Turns: ": a function or operator there has no compiled form;",
    Fills: "uses nan_to_num, which has no form on symbols",
    Logs: "changes a list",
    Noisy: "uses a Generator",
}


@pytest.mark.parametrize("cls", IN_PYTHON)
def test_what_cannot_be_compiled_runs_in_python_and_names_class_line_and_code(biped, gait, cls):
    """Each class of IN_PYTHON has one line that cannot be traced: the walk is that of Python, and the reason
    has the class, the number of that line, its code and what is wrong with it.
    """
    walker = ba.Walker(biped, cls(npd(gait)), timing=ba.SampledTime(1e-3))
    python, partly = runs(walker, gait, ba.RK4(1e-3), t_end=0.05, impacts=None)
    in_part(python, partly, TICKS, IN_PYTHON[cls])
    lines, first = getsourcelines(cls.output)
    place = rf"{cls.__name__}.output \(test_run.py:{first + 1}, `{re.escape(lines[1].strip())}`\)"
    assert re.match(place + " cannot be compiled: ", partly.settings["why"])


@pytest.mark.parametrize(
    ("cls", "why"),
    [
        (Undecorated, "Undecorated cannot be compiled: it is no dataclass"),
        (Catches, "cannot be compiled: it catches exceptions"),
    ],
)
def test_other_classes_run_in_python(biped, gait, cls, why):
    """A class that is no dataclass has no fields to compare; one that catches exceptions may swallow those by
    which tracing stops.
    """
    walker = ba.Walker(biped, cls(npd(gait)), timing=ba.SampledTime(1e-3))
    in_part(*runs(walker, gait, ba.RK4(1e-3), impacts=1), TICKS, why)


class Plain(Stateless):
    """What users write without a thought of symbols."""

    def output(self, s, m):
        gains = {"left": 0.9, "right": 0.9}
        u = np.asarray(super().output(s, m), dtype=float)
        rows = [gains["left"] * float(x) for x in u]
        size = np.linalg.norm(np.array(rows, float).astype(float))
        share = max(size, 1.0) if isinstance(m.t, float) else 0.0
        return u / (1.0 + 1e-6 * share)


def test_a_controller_of_the_user_s_is_compiled(biped, gait):
    """`Plain` is written for NumPy and floats, without a thought of symbols: dict, float(), np.linalg.norm,
    max, isinstance.
    """
    walker = ba.Walker(biped, Plain(npd(gait)), timing=ba.SampledTime(1e-3))
    same(*runs(walker, gait, ba.RK4(1e-3), t_end=0.05, impacts=None), TICKS)


@pytest.mark.parametrize(
    "ask",
    [
        lambda step: step == 2,
        lambda step: step != 1,
        lambda step: step in (2, 4),
        lambda step: np.array_equal(np.array([step]), np.array([2])),
    ],
)
def test_a_law_that_asks_whether_numbers_are_equal_runs_in_python(biped, gait, ask):
    """With Python's own == a symbol would never equal a number, and the law would be compiled with that answer.
    ask: about the number of the step, which is 1 in one walk and 2 in another.
    """

    class Asking(Stateless):
        def output(self, s, m):
            return (0.9 if ask(m.step) else 1.0) * super().output(s, m)

    walker = ba.Walker(biped, Asking(npd(gait)), timing=ba.SampledTime(1e-3))
    for step in (1, 2):
        both = runs(walker, gait, ba.RK4(2e-3), mode=Mode(step), t_end=0.05, impacts=None)
        in_part(*both, TICKS, "branches on the value of a number")


def test_progress_is_called_at_each_impact_and_the_settings_name_the_engine(gait, ticked):
    """The call has the time and the number of the impact. What ran is in the settings: the compiled plant for a
    controller in Python, and Pinocchio where it is asked for.
    """
    x0 = ticked.initial_state(*gait.start(ticked.plant))
    told = []
    more = {"t_end": 4.0, "impacts": 2, "progress": lambda t, n: told.append((t, n))}
    run = simulate_by("compiled", ticked, x0, Mode(), ba.RK4(1e-3), **more)
    assert run.settings["engine"] == PLANT
    assert [n for _, n in told] == [1, 2]
    assert [t for t, _ in told] == [event.t for event in run.events(FOOT_STRIKE)]
    run = simulate_by("pinocchio", ticked, x0, Mode(), ba.RK4(1e-3), t_end=0.01)
    assert run.settings["engine"] == "pinocchio"


@pytest.mark.parametrize("h", [7e-4, 2.5e-3, 9e-3])
def test_all_nodes_of_the_longest_single_support_are_kept(biped, gait, h):
    """Memory for nodes is taken beforehand: it is enough where sample instants, a waiting torque, switching
    times of a push and short last steps leave as many nodes as possible. h [s]: steps shorter and longer than
    the period; 0.0995 s is no whole number of them.
    """
    push = ba.TorquePulse(PULSE, step=1, start=0.01, stop=0.0123)
    timing = ba.SampledTime(1e-3, delay=4e-4)
    walker = ba.Walker(biped, npd(gait), push, timing, max_step_time=0.0995)
    python, compiled = runs(walker, gait, ba.RK4(h), impacts=1)
    assert compiled.status is ba.Status.STALLED
    assert compiled.arcs[0].t == pytest.approx(python.arcs[0].t, abs=1e-12)


@dataclass(frozen=True)
class Free(Controller):
    """u = 0, in Python, since it branches."""

    def output(self, s, m):
        return np.zeros(len(m.terms.kappa)) * (1.0 if m.v[0] < 1e9 else 2.0)


@pytest.mark.parametrize("robot", ["compass", "rimless_wheel", "simplest"])
def test_a_robot_without_motors_under_a_controller_in_python(robot):
    """Arrays of no torque at all pass between machine code and Python."""
    biped = ba.Biped.load(robot)
    cycle = passive_cycle(biped)
    walker = ba.Walker(biped, Free(), slope=cycle.slope, timing=ba.SampledTime(1e-3))
    x0 = walker.initial_state(cycle.q_plus, cycle.v_plus)
    python, compiled = (
        simulate_by(engine, walker, x0, Mode(), ba.RK4(1e-3), t_end=0.5)
        for engine in ("pinocchio", "compiled")
    )
    assert compiled.settings["engine"] == "compiled plant"
    near(compiled.final_state, python.final_state, SHARP)


@dataclass(frozen=True)
class Raised(ba.Reference):
    """A curve, raised by k [rad]."""

    h: ba.VirtualConstraint
    k: float = 0.0

    def __call__(self, t, q, v):
        r = self.h(t, q, v)
        return r._replace(q_d=r.q_d + self.k)


@dataclass(frozen=True)
class Raising(Controller):
    """Tracks a copy of its reference that it raises with time."""

    reference: Raised

    def output(self, s, m):
        r = replace(self.reference, k=0.02 * m.t)(m.t, m.q, m.v)
        u = 2500.0 * (r.q_d - m.q_b) + 120.0 * (r.dq_d - m.v_b)
        return u if m.v[0] < 1e9 else np.zeros(4)


def test_a_controller_in_python_that_changes_its_reference(biped, gait):
    """`Raising` tracks a curve that it raises by 0.02 t [rad]. A copy of the compiled reference with another
    number runs in Python, and not by the old number."""
    walker = ba.Walker(biped, Raising(Raised(gait.constraint)), timing=ba.SampledTime(1e-3))
    x0 = walker.initial_state(*gait.start(biped))
    python, compiled = (
        simulate_by(engine, walker, x0, Mode(), ba.RK4(1e-3), t_end=0.2)
        for engine in ("pinocchio", "compiled")
    )
    near(compiled.final_state, python.final_state, 1e-9)


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_a_walk_that_starts_with_the_hip_too_low_and_sinking_falls_at_once(biped, gait, engine):
    """The state is from late in a step, where the hip sinks; the limit is 1 mm above it, as a share of the
    height of the straight leg. So the fall is at 0 s, and the state is unchanged.
    """
    arc = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1).trajectory.arcs[0]
    q, v = np.split(arc.x[int(0.8 * len(arc.t)), :10], 2)
    limit = (biped.hip(q)[1] + 1e-3) / np.linalg.norm(biped.hip(np.zeros(5)))
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), fall_height=float(limit))
    run = ba.walk(walker, gait, 1, start=(q, v), engine=engine).trajectory
    assert (run.status.name, run.t_end, len(run.events())) == ("FELL", 0.0, 1)
    assert np.array_equal(run.final_state[:10], [*q, *v])
