"""The compiled loops against the Python ones, on a rimless wheel with a stiff observer written both ways.

    theta' = v,  v' = g sin(theta + 0.08) - 0.1 v + 0.3 E_1 + zeta + blow v^3
    E' = A E + (0, theta^2 + zeta),  A = (0, 1; -a_0, -a_1),  z_1 = E_1 + 0.1 sin theta,  z_2 = E_2

The spokes strike at theta = alpha, and theta+ = -alpha lies on the guard's surface. In sampled time z_1 counts
the ticks and z_2 is the held torque.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numba
import numpy as np
import pytest
from numba import types

from biped_adrc.engine.kernels import layout, methods
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.run_plan import (
    STATUS,
    ClockTable,
    DisturbanceTable,
    GroundTable,
    LawAddresses,
    StateSizes,
    plan,
)
from biped_adrc.errors import InputError, NotFiniteError, SingularError
from biped_adrc.hybrid import integrators, simulator
from biped_adrc.hybrid import system as hybrid
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.status import Status

GRAVITY, ALPHA, A0, A1, ZERO_PIVOT_AT, NAN_AT, BLOW, GAIN, LOWEST_HIP, LONGEST, HOLE = range(11)
NUMBERS = np.array([9.81, 0.3, 400.0, 50.0, math.inf, math.inf, 0.0, 0.5, 0.5, 3.0, math.inf])
STIFF = NUMBERS.copy()
STIFF[A0], STIFF[A1] = 2e4 * 300.0, 2e4 + 300.0
START = np.array([-0.3, 1.1, 0.02, 0.1])
FAR = 10.0
"""[s], later than anything here."""


class Walked(NamedTuple):
    """How a walk ended."""

    code: int
    """Of `run_plan.STATUS`."""
    impacts: int
    t: float
    """[s]"""
    x: np.ndarray
    """x+ after the last impact asked for, the last good state otherwise (nx,)."""
    step: int
    t_start: float
    """[s]"""


def walk_plan(made, K, x, t, step, t_start, t_end, impacts, x_minus, x_plus, times):
    """A walk of a plan; strike i goes into row i of x_minus, x_plus and times."""
    m, nx = len(times), made.nx
    s, strikes = made.start(x, t, step, t_start, t_end), np.zeros((m, 1 + 2 * nx))
    status, count = kernels().stride(made.P, made.F, K, made.work(), s, impacts, strikes)
    times[:count] = strikes[:count, 0]
    x_minus[:count], x_plus[:count] = strikes[:count, 1 : 1 + nx], strikes[:count, 1 + nx :]
    head = s[[layout.TIME, layout.STEP, layout.START]].tolist()
    return Walked(status, count, head[0], s[layout.HEAD :].copy(), int(head[1]), head[2])


# -- the system, as C functions and as Python -----------------------------------------------------
def flow(K, inp, out):
    q, v, z1, z2, zeta = inp[3], inp[4], inp[5], inp[6], inp[7]
    e = z1 - 0.1 * math.sin(q)
    out[0] = v
    out[1] = K[0] * math.sin(q + 0.08) - 0.1 * v + 0.3 * e + zeta + K[6] * v**3
    out[2] = z2 + 0.1 * math.cos(q) * v
    out[3] = -K[2] * e - K[3] * z2 + q**2 + zeta
    out[4] = math.inf
    if q > K[4] or q > K[5]:
        out[1] = math.nan
        out[4] = 0.0 if q > K[4] else math.inf


def held(K, inp, out):
    q, v, u, zeta = inp[3], inp[4], inp[6], inp[7]
    out[0] = v
    out[1] = K[0] * math.sin(q + 0.08) - 0.1 * v + u + zeta
    out[2] = out[3] = 0.0
    out[4] = math.inf


def tick(K, inp, out):
    out[0], out[1] = inp[3], inp[4]
    out[2] = inp[5] + 1.0
    out[3] = -K[7] * inp[4] + inp[0] + 0.01 * inp[1]
    out[4] = math.inf
    out[5] = K[0] * math.sin(inp[3] + 0.08) - 0.1 * inp[4] + out[3] + inp[7]


def strike(K, inp, out):
    step, q, v = inp[1], inp[2], inp[3]
    out[0] = -q
    out[1] = v * math.cos(2.0 * q) + 1e-3 * step
    out[2], out[3] = inp[4], inp[5]
    out[4] = math.inf


def watch(K, inp, out):
    t, start, drop, q = inp[0], inp[1], inp[2], inp[3]
    out[0] = K[1] ** 2 - q**2 + drop
    out[1] = math.cos(q) - K[8]
    out[2] = start + K[9] - t
    out[3] = q


def to(K, x, y):
    y[0], y[1] = x[0], x[1]
    y[2] = x[2] - 0.1 * math.sin(x[0])
    y[3] = x[3]


def back(K, y, x):
    x[0], x[1] = y[0], y[1]
    x[2] = y[2] + 0.1 * math.sin(y[0])
    x[3] = y[3]


def remainder(K, inp, out):
    q, v, e, zeta = inp[3], inp[4], inp[5], inp[7]
    out[0] = v
    out[1] = K[0] * math.sin(q + 0.08) - 0.1 * v + 0.3 * e + zeta + K[6] * v**3
    out[2] = math.nan if abs(q - K[10]) < 1e-10 else q**2 + zeta
    out[3] = math.inf


def turn(M, E, out):
    for i in range(2):
        out[i] = M[2 * i] * E[0] + M[2 * i + 1] * E[1]


def pulse(K, inp, out):
    """K = (step, start, stop, amplitude) since the start of that step, or of the run for step 0."""
    origin = inp[2] if K[0] > 0.0 else 0.0
    acts = (K[0] == 0.0 or inp[1] == K[0]) and origin + K[1] <= inp[0] < origin + K[2]
    out[0] = K[3] * (1.0 + 0.2 * inp[4]) if acts else 0.0


SIGNATURE = types.void(*(types.CPointer(types.float64),) * 3)
LAWS = (flow, held, tick, strike, watch, to, back, remainder, turn, pulse)


@pytest.fixture(scope="module")
def address():
    """Of every law; the functions live as long as the module."""
    compiled = {f.__name__: numba.cfunc(SIGNATURE, error_model="numpy")(f) for f in LAWS}
    yield {name: made.address for name, made in compiled.items()}
    compiled.clear()


PULSES = ((2, 0.05, 0.0913, -0.4), (0, 0.0317, 0.1088, 0.3))


@dataclass(frozen=True)
class Wheel(hybrid.HybridSystem):
    """The same laws for `hybrid.simulate`; mode = (step, start)."""

    K: np.ndarray
    scene: GroundTable
    pulses: tuple = ()
    sampled: hybrid.Clock | None = None

    def call(self, law, size, *numbers):
        out = np.zeros(size + 2)
        law(self.K, np.concatenate([np.atleast_1d(x) for x in numbers]), out)
        if not np.all(np.isfinite(out[:size])):
            kind = SingularError if out[size] == 0.0 else NotFiniteError
            raise kind("not a number")
        return out[:size]

    def zeta(self, t, x, mode):
        total, part = np.zeros(1), np.zeros(1)
        for numbers in self.pulses:
            pulse(numbers, np.array([t, *mode, *x]), part)
            total += part
        return total

    def flow(self, t, x, mode):
        law = flow if self.sampled is None else held
        return self.call(law, 4, t, mode, x, self.zeta(t, x, mode))

    def tick(self, t, x, mode):
        return self.call(tick, 4, t, mode, x, self.zeta(t, x, mode))

    def clocks(self):
        clock = self.sampled
        return () if clock is None else (replace(clock, update=self.tick),)

    def switching_times(self, mode):
        now = [p for p in self.pulses if p[0] in (0, mode[0])]
        return tuple((mode[1] if p[0] else 0.0) + s for p in now for s in p[1:3])

    def seen(self, t, x, start, drop):
        out = np.zeros(4)
        watch(self.K, np.array([t, start, drop, x[0]]), out)
        return out

    def guards(self, mode):
        drop = sum(height for step, height in self.scene.drops if step == mode[0])

        def witness(k):
            return lambda t, x: self.seen(t, x, mode[1], drop)[k]

        def struck(t, x):
            if x[0] <= self.scene.least_step:
                return None
            return self.call(strike, 4, t, mode[0] + 1, x), (mode[0] + 1, t)

        return (
            hybrid.Guard("strike", witness(0), struck),
            hybrid.Guard("low", witness(1), terminal=Status.FELL),
            hybrid.Guard("long", witness(2), terminal=Status.STALLED),
        )

    def split(self, mode):
        def parts(law, numbers):
            return self.call(law, 4, numbers)

        def Ns(t, w, E):
            x = parts(back, np.concatenate((w, E.ravel())))
            out = self.call(remainder, 3, t, mode, w, E.ravel(), self.zeta(t, x, mode))
            return out[:2], np.array([[0.0], [out[2]]])

        def node(t, w, E):
            x = parts(back, np.concatenate((w, E.ravel())))
            return Ns(t, w, E), x, self.flow(t, x, mode)

        return hybrid.Split(
            lambda x: (x[:2].copy(), parts(to, x)[2:].reshape(2, 1)),
            lambda w, E: parts(back, np.concatenate((w, E.ravel()))),
            linear(self.K),
            Ns,
            node,
        )


def linear(K):
    return np.array([[0.0, 1.0], [-K[A0], -K[A1]]])


class Case(NamedTuple):
    """One run, for both engines."""

    K: np.ndarray = NUMBERS
    drops: tuple = ((2, 0.004),)
    pulses: tuple = PULSES
    clock: ClockTable = ClockTable()

    @property
    def scene(self):
        drops = np.array(self.drops, dtype=float).reshape(-1, 2)
        return GroundTable(1e-3, drops)

    def plan(self, address, method):
        names = ("flow" if self.clock.period == 0.0 else "held", *LawAddresses._fields[1:])
        code = LawAddresses(*(address[name] for name in names))
        pulses = self.pulses
        push = (
            DisturbanceTable()
            if not pulses
            else DisturbanceTable(
                np.array([address["pulse"]] * len(pulses)),
                np.ravel(pulses).astype(float),
                4 * np.arange(len(pulses) + 1),
                np.array([(p[0], s) for p in pulses for s in p[1:3]], dtype=float),
            )
        )
        return plan(code, StateSizes(1, 4, 1, 2, 2), self.scene, push, self.clock, method)

    def python(self, method, t_end=FAR, impacts=None, every=1, x=START, t0=0.0):
        clock = self.clock
        sampled = (
            hybrid.Clock("c", clock.period, None, bool(clock.restart)) if clock.period else None
        )
        wheel = Wheel(self.K, self.scene, self.pulses, sampled)
        stop = None if impacts is None else ("strike", impacts)
        return simulator.simulate(
            wheel, x, (1, t0), method, t_end=t_end, t0=t0, stop_after=stop, store_every=every
        )

    def walk(self, address, method, t_end=FAR, impacts=0, room=20, x=START, t0=0.0):
        """How it ended, and the strikes (times, x-, x+)."""
        strikes = np.zeros(room), np.zeros((room, 4)), np.zeros((room, 4))
        times, before, after = strikes
        made = self.plan(address, method)
        end = walk_plan(made, self.K, x, t0, 1, t0, t_end, impacts, before, after, times)
        return end, tuple(a[: end.impacts] for a in strikes)


def same_strikes(trajectory, strikes, tolerance):
    events = [a.event for a in trajectory.arcs if a.event is not None and a.event.guard == "strike"]
    times, before, after = strikes
    assert len(times) == len(events) > 0
    theirs = (
        np.array([e.t for e in events]),
        *(np.array([getattr(e, name) for e in events]) for name in ("x_minus", "x_plus")),
    )
    for ours, other in zip((times, before, after), theirs, strict=True):
        np.testing.assert_allclose(ours, other, rtol=0, atol=tolerance)


SAMPLED = Case(clock=ClockTable(7e-3, 1, 0.0))
FREE = Case(clock=ClockTable(7e-3, 0, 0.0))
PAIRS = {
    "rk4": (Case(), methods.rk4(1e-3), integrators.RK4(1e-3), 2e-13),
    "dop853": (
        Case(),
        methods.dop853(1e-10, 1e-10, 0.02),
        integrators.Adaptive(1e-10, 1e-10, 0.02),
        1e-8,
    ),
    "etd": (Case(), methods.etd(1e-3, linear(NUMBERS), [1]), Exponential(1e-3), 1e-12),
    "etd, stiff": (Case(STIFF), methods.etd(2e-3, linear(STIFF), [1]), Exponential(2e-3), 1e-10),
    "sampled": (SAMPLED, methods.rk4(2e-3), integrators.RK4(2e-3), 2e-13),
    "sampled, a free clock": (FREE, methods.rk4(2e-3), integrators.RK4(2e-3), 2e-13),
}
"""Case, method, the same in Python, and by how much they may differ."""


@pytest.mark.parametrize("name", PAIRS)
def test_a_walk_is_the_python_engine_s(address, name):
    """Six strikes with a step down and two pulses: every time, x- and x+; the same states are in the nodes."""
    case, ours, theirs, tolerance = PAIRS[name]
    trajectory = case.python(theirs, impacts=6)
    end, strikes = case.walk(address, ours, impacts=6)
    assert trajectory.status is STATUS[end.code] is Status.COMPLETED
    same_strikes(trajectory, strikes, tolerance)
    assert (end.step, end.t_start, end.t) == (7, strikes[0][-1], strikes[0][-1])
    np.testing.assert_array_equal(end.x, strikes[2][-1])


def test_a_swing_foot_behind_is_no_strike(address):
    """The wheel rolls back over -alpha without an event and goes on to fall."""
    case = Case(pulses=(), drops=())
    slow = np.array([-0.25, -0.6, 0.0, 0.0])
    trajectory = case.python(integrators.RK4(1e-3), x=slow)
    end, (times, _, _) = case.walk(address, methods.rk4(1e-3), x=slow)
    assert STATUS[end.code] is trajectory.status is Status.FELL
    assert len(times) == 0
    assert end.x[0] < -0.9
    np.testing.assert_allclose(end.x, trajectory.final_state, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("ours", "theirs", "tolerance"),
    [
        (methods.rk4(1e-2), integrators.RK4(1e-2), 1e-12),
        (methods.dop853(1e-6, 1e-6, 0.02), integrators.Adaptive(1e-6, 1e-6, 0.02), 1e-6),
        (methods.etd(1e-2, linear(NUMBERS), [1]), Exponential(1e-2), 5e-6),
    ],
    ids=["rk4", "dop853", "etd"],
)
def test_there_and_back_inside_one_step(address, ours, theirs, tolerance):
    """A hard push turns the wheel round just behind the surface: positive at both ends of the step."""
    case, x = Case(pulses=((0, 0.0, 1.0, -200.0),), drops=()), np.array([0.2985, 1.0, 0.0, 0.0])
    trajectory = case.python(theirs, impacts=1, x=x)
    end, strikes = case.walk(address, ours, impacts=1, x=x)
    assert STATUS[end.code] is Status.COMPLETED
    assert 0.0 < end.t < 4e-3
    same_strikes(trajectory, strikes, tolerance)


# -- order ---------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("K", "make", "steps"),
    [
        (NUMBERS, lambda h: methods.rk4(h), (8e-3, 4e-3, 2e-3)),
        (NUMBERS, lambda h: methods.etd(h, linear(NUMBERS), [1]), (16e-3, 8e-3, 4e-3)),
    ],
    ids=["rk4", "etd"],
)
def test_order_four_through_pulses_and_strikes(address, K, make, steps):
    """At a time that no step divides; switching times and strikes at odd times cost no order."""
    case = Case(K)
    exact, _ = case.walk(address, methods.dop853(1e-13, 1e-14, 0.005), t_end=1.3137)
    errors = []
    for h in steps:
        end, _ = case.walk(address, make(h), t_end=1.3137)
        assert end.impacts == exact.impacts > 1
        errors.append(np.max(np.abs(end.x - exact.x)))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(orders > 3.6), (errors, orders)


def test_a_landing_of_a_stiff_system(address):
    """Poles at 300 and 2e4 rad/s, steps of 2 ms: any end is reached, against a tight reference."""
    case, method = Case(STIFF, pulses=()), methods.etd(2e-3, linear(STIFF), [1])
    start = START.copy()
    for t_end in (2e-3, 2e-3 + 1e-7, 0.1, 0.1003, 0.1237911):
        exact, _ = case.walk(address, methods.dop853(1e-11, 1e-11, 0.02), t_end=t_end, x=start)
        end, _ = case.walk(address, method, t_end=t_end, x=start)
        assert end.t == t_end
        np.testing.assert_allclose(end.x[:3], exact.x[:3], rtol=0, atol=1e-7)
        np.testing.assert_allclose(end.x[3], exact.x[3], rtol=0, atol=2e-5)


# -- how runs end --------------------------------------------------------------------------------
def with_number(index, value, numbers=NUMBERS):
    K = numbers.copy()
    K[index] = value
    return K


ENDS = {
    Status.FELL: (Case(with_number(LOWEST_HIP, 0.98)), 0),
    Status.STALLED: (Case(with_number(LONGEST, 0.12345)), 0),
    Status.NOT_FINITE: (Case(with_number(NAN_AT, 0.1)), 0),
    Status.SINGULAR: (Case(with_number(ZERO_PIVOT_AT, 0.1)), 0),
    Status.TIME_OUT: (Case(), 50),
    Status.COMPLETED: (Case(), 0),
}
METHODS = {
    "rk4": (methods.rk4(1e-3), integrators.RK4(1e-3)),
    "dop853": (methods.dop853(1e-9, 1e-9, 0.02), integrators.Adaptive(1e-9, 1e-9, 0.02)),
}


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("status", ENDS, ids=lambda s: s.name)
def test_how_a_run_ends(address, status, name):
    """With the last good state, which the Python engine also keeps."""
    (case, impacts), (ours, theirs) = ENDS[status], METHODS[name]
    end, _ = case.walk(address, ours, t_end=1.0, impacts=impacts)
    trajectory = case.python(theirs, t_end=1.0, impacts=impacts or None)
    assert STATUS[end.code] is trajectory.status is status
    assert np.all(np.isfinite(end.x))
    if status in (Status.NOT_FINITE, Status.SINGULAR):
        assert end.x[0] <= 0.1
    if name == "rk4" or status not in (Status.NOT_FINITE, Status.SINGULAR):
        np.testing.assert_allclose(end.t, trajectory.arcs[-1].t[-1], rtol=0, atol=1e-8)
        np.testing.assert_allclose(end.x, trajectory.final_state, rtol=0, atol=1e-7)


def test_a_step_to_a_state_whose_remainder_is_no_number_is_not_taken(address):
    """N_E alone, at the state after two steps and at none of their stages: the run ends after the first."""
    free, ours, theirs = Case(pulses=()), methods.etd(0.01, linear(NUMBERS), [1]), Exponential(0.01)
    one, two = (free.walk(address, ours, t_end=t)[0].x for t in (0.01, 0.02))
    case = free._replace(K=with_number(HOLE, two[0]))
    end, _ = case.walk(address, ours, t_end=0.03)
    trajectory = case.python(theirs, t_end=0.03)
    assert STATUS[end.code] is trajectory.status is Status.NOT_FINITE
    np.testing.assert_array_equal(end.x, one)
    np.testing.assert_allclose(trajectory.final_state, one, rtol=0, atol=1e-12)


# -- tables --------------------------------------------------------------------------------------


def fitted(tick, period, method):
    return plan(
        LawAddresses(1, tick, 1, 1),
        StateSizes(1, 4, 1),
        Case().scene,
        DisturbanceTable(),
        ClockTable(period, 1, 0.0),
        method,
    )


@pytest.mark.parametrize(
    "make",
    [
        lambda: methods.rk4(0.0),
        lambda: methods.dop853(1e-15, 1e-9, 0.02),
        lambda: methods.etd(2e-3, linear(STIFF), [2]),
        lambda: fitted(0, 1e-3, methods.rk4(1e-3)),
        lambda: fitted(1, 1e-12, methods.rk4(1e-3)),
        lambda: fitted(1, 0.0, methods.etd(1e-3, linear(NUMBERS), [1])),
    ],
)
def test_what_does_not_fit_is_refused(make):
    with pytest.raises(InputError):
        make()
