"""The compiled loops on a rimless wheel with a stiff observer; with whole walkers they are in test_simulate.py.

    theta' = v,  v' = g sin(theta + 0.08) - 0.1 v + 0.3 E_1 + zeta
    E' = A E + (0, theta^2 + zeta),  A = (0, 1; -a_0, -a_1),  z_1 = E_1 + 0.1 sin theta,  z_2 = E_2

The spokes strike at theta = alpha, and theta+ = -alpha lies on the guard's surface.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numba
import numpy as np
import pytest
from numba import types

from biped_adrc.core.errors import InputError
from biped_adrc.engine.kernels.run_plan import STATUS, Functions, Push, plan
from biped_adrc.hybrid.constants import ETD, RK4
from biped_adrc.hybrid.exponential import phi_levels
from biped_adrc.hybrid.status import Status

GRAVITY, ALPHA, A0, A1, ZERO_PIVOT_AT, NAN_AT, LOWEST_HIP, LONGEST = range(8)
NUMBERS = np.array([9.81, 0.3, 400.0, 50.0, math.inf, math.inf, 0.5, 3.0])
STIFF = NUMBERS.copy()
STIFF[A0], STIFF[A1] = 2e4 * 300.0, 2e4 + 300.0
START = np.array([-0.3, 1.1, 0.02, 0.1])
FAR = 10.0
"""[s], later than anything here."""


# -- the system, as C functions ------------------------------------------------------------------
def flow(K, inp, out):
    q, v, z1, z2, zeta = inp[3], inp[4], inp[5], inp[6], inp[7]
    e = z1 - 0.1 * math.sin(q)
    out[0] = v
    out[1] = K[0] * math.sin(q + 0.08) - 0.1 * v + 0.3 * e + zeta
    out[2] = z2 + 0.1 * math.cos(q) * v
    out[3] = -K[2] * e - K[3] * z2 + q**2 + zeta
    out[4] = math.inf
    if q > K[4] or q > K[5]:
        out[1] = math.nan
        out[4] = 0.0 if q > K[4] else math.inf


def impact(K, inp, out):
    step, q, v = inp[1], inp[2], inp[3]
    out[0] = -q
    out[1] = v * math.cos(2.0 * q) + 1e-3 * step
    out[2], out[3] = inp[4], inp[5]
    out[4] = math.inf


def events(K, inp, out):
    t, start, drop, q = inp[0], inp[1], inp[2], inp[3]
    out[0] = K[1] ** 2 - q**2 + drop
    out[1] = math.cos(q) - K[6]
    out[2] = start + K[7] - t
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
    out[1] = K[0] * math.sin(q + 0.08) - 0.1 * v + 0.3 * e + zeta
    out[2] = q**2 + zeta
    out[3] = math.inf


def matvec(M, E, out):
    for i in range(2):
        out[i] = M[2 * i] * E[0] + M[2 * i + 1] * E[1]


def pulse(K, inp, out):
    """K = (step, start, stop, amplitude) since the start of that step, or of the run for step 0."""
    origin = inp[2] if K[0] > 0.0 else 0.0
    acts = (K[0] == 0.0 or inp[1] == K[0]) and origin + K[1] <= inp[0] < origin + K[2]
    out[0] = K[3] * (1.0 + 0.2 * inp[4]) if acts else 0.0


SIGNATURE = types.void(*(types.CPointer(types.float64),) * 3)
FUNCTIONS = (flow, impact, events, to, back, remainder, matvec, pulse)


@pytest.fixture(scope="module")
def address():
    """Of every function; the functions live as long as the module."""
    compiled = {f.__name__: numba.cfunc(SIGNATURE, error_model="numpy")(f) for f in FUNCTIONS}
    yield {name: made.address for name, made in compiled.items()}
    compiled.clear()


def rk4(h):
    return {"kind": RK4, "h": h}, {}


def etd(h, A):
    return {"kind": ETD, "h": h}, {"phi": phi_levels(h, A)}


def linear(K):
    return np.array([[0.0, 1.0], [-K[A0], -K[A1]]])


class Case(NamedTuple):
    """A wheel, its steps down and its pulses."""

    K: np.ndarray = NUMBERS
    drops: tuple = ((2, 0.004),)
    pulses: tuple = ((2, 0.05, 0.0913, -0.4), (0, 0.0317, 0.1088, 0.3))

    def plan(self, address, method):
        code = Functions(**{name: address.get(name, 0) for name in Functions._fields})
        fields, tables = method
        drops = np.array(self.drops, dtype=float).reshape(-1, 2)
        pulses, push = self.pulses, Push()
        if pulses:
            push = Push(
                np.array([(address["pulse"], 4 * i, 0) for i in range(len(pulses))]),
                np.ravel(pulses).astype(float),
                np.array([(p[0], s) for p in pulses for s in p[1:3]], dtype=float),
            )
        sizes = {"n": 1, "nx": 4, "p": 1, "n_slow": 2, "k": 2, "restart": 1}
        bounds = {"least_step": 1e-3, "farthest": math.inf}
        return plan(code, push, {"K": self.K, "drops": drops, **tables}, sizes | bounds | fields)

    def walk(self, address, method, t_end=FAR, impacts=0, x=START):
        """How it ended: status, time, x, and the strikes (k, 9) with t, x- and x+."""
        made, strikes = self.plan(address, method), np.zeros((20, 9))
        run = made.start(x, 0.0, 1, 0.0, t_end)
        code, count = run.stride(impacts, strikes)
        return STATUS[code], run["t"], run.x.copy(), strikes[:count]


def test_a_swing_foot_behind_is_no_strike(address):
    """The wheel rolls back over -alpha without an event and goes on to fall."""
    slow = np.array([-0.25, -0.6, 0.0, 0.0])
    status, _, x, strikes = Case(pulses=(), drops=()).walk(address, rk4(1e-3), x=slow)
    assert status is Status.FELL
    assert len(strikes) == 0
    assert x[0] < -0.9


METHODS = {
    "rk4": rk4(1e-2),
    "etd": etd(1e-2, linear(NUMBERS)),
}


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_there_and_back_inside_one_step(address, method):
    """A hard push turns the wheel round just behind the surface: positive at both ends of the step."""
    case, x = Case(pulses=((0, 0.0, 1.0, -200.0),), drops=()), np.array([0.2985, 1.0, 0.0, 0.0])
    status, t, _, strikes = case.walk(address, method, impacts=1, x=x)
    assert status is Status.COMPLETED
    assert 0.0 < t < 4e-3
    assert strikes[0, 1] == pytest.approx(NUMBERS[ALPHA], abs=1e-12)


# -- order ---------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("K", "make", "steps"),
    [
        (NUMBERS, rk4, (8e-3, 4e-3, 2e-3)),
        (NUMBERS, lambda h: etd(h, linear(NUMBERS)), (16e-3, 8e-3, 4e-3)),
    ],
    ids=["rk4", "etd"],
)
def test_order_four_through_pulses_and_strikes(address, K, make, steps):
    """At a time that no step divides; switching times and strikes at odd times cost no order."""
    case = Case(K)
    _, _, exact, struck = case.walk(address, rk4(1e-4), t_end=1.3137)
    errors = []
    for h in steps:
        _, _, x, strikes = case.walk(address, make(h), t_end=1.3137)
        assert len(strikes) == len(struck) > 1
        errors.append(np.max(np.abs(x - exact)))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(orders > 3.6), (errors, orders)


def test_a_landing_of_a_stiff_system(address):
    """Poles at 300 and 2e4 rad/s, steps of 2 ms: any end is reached, against short steps of RK4."""
    case, method = Case(STIFF, pulses=()), etd(2e-3, linear(STIFF))
    start = START.copy()
    for t_end in (2e-3, 2e-3 + 1e-7, 0.1, 0.1003, 0.1237911):
        _, _, exact, _ = case.walk(address, rk4(4e-6), t_end=t_end, x=start)
        _, t, x, _ = case.walk(address, method, t_end=t_end, x=start)
        assert t == t_end
        np.testing.assert_allclose(x[:3], exact[:3], rtol=0, atol=1e-7)
        np.testing.assert_allclose(x[3], exact[3], rtol=0, atol=2e-5)


# -- how runs end --------------------------------------------------------------------------------
def with_number(index, value, numbers=NUMBERS):
    K = numbers.copy()
    K[index] = value
    return K


ENDS = {
    Status.FELL: (with_number(LOWEST_HIP, 0.98), lambda t, x: math.cos(x[0]) - 0.98),
    Status.STALLED: (with_number(LONGEST, 0.12345), lambda t, x: t - 0.12345),
    Status.NOT_FINITE: (with_number(NAN_AT, 0.1), lambda t, x: max(x[0] - 0.1, 0.0)),
    Status.SINGULAR: (with_number(ZERO_PIVOT_AT, 0.1), lambda t, x: max(x[0] - 0.1, 0.0)),
    Status.COMPLETED: (NUMBERS, lambda t, x: t - 1.0),
}


@pytest.mark.parametrize("status", ENDS, ids=lambda s: s.name)
def test_how_a_run_ends(address, status):
    """There, or with the last good state."""
    K, gap = ENDS[status]
    found, t, x, _ = Case(K).walk(address, METHODS["rk4"], t_end=1.0)
    assert found is status
    assert np.all(np.isfinite(x))
    assert gap(t, x) == pytest.approx(0.0, abs=1e-9)


# -- tables --------------------------------------------------------------------------------------
def test_a_period_too_short_is_refused():
    with pytest.raises(InputError, match="period"):
        plan(Functions(1, 1, 1, 1), Push(), {}, {"n": 1, "nx": 4, "p": 1, "period": 1e-12})
