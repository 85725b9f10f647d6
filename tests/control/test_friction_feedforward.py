"""Friction feedforward: with the right friction a plant walks as one without, and nothing counts twice.

u = u_i + F: u_i is the torque of the controller inside, F `share` of the friction at the rates of the
reference. The plant `biped` has no friction, `rubbing` has; `inside(h)` are NPD and two controllers with an
observer, on the gait's constraint h.
"""

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.friction_feedforward import FrictionFeedforward, friction_feedforward
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.core.errors import InputError

T = 1e-3
FAST = ba.GPIObserver.from_bandwidth(500.0)


@pytest.fixture(scope="module")
def rubbing(biped):
    return replace(biped, friction=True)


def inside(h):
    return [ba.NPDController(h), ba.ADRCController(h, FAST), MomentumDOBController(h)]


def walked(plant, model, law, timing, start, until=0.1):
    walker = ba.Walker(plant, law, timing=timing, model=None if plant is model else model)
    run = ba.simulate(walker, walker.initial_state(*start), ba.Mode(), ba.RK4(1e-3), t_end=until)
    assert run.status is ba.Status.COMPLETED
    return walker, run.arcs[0]


def fed(biped, gait, m):
    """F by the record and by differences of the gait along the motion of Theta."""
    h, d = gait.constraint, 1e-6
    ends = [h(m.t, m.q + e * m.v, m.v).q_d for e in (-d, d)]
    rates = np.append((ends[1] - ends[0]) / (2.0 * d), 0.0)
    return -replace(biped, friction=True).friction_torque(rates)[:4]


@pytest.mark.parametrize("timing", [ba.ContinuousTime(), ba.SampledTime(T)], ids=["all", "ticks"])
def test_the_controller_inside_is_told_the_torque_beyond_the_feedforward(biped, gait, timing):
    """Whatever u acts, such as a torque at its limit of 150 N m, the observer inside gets u - F. F is 0.8 of
    the record's friction at rates by differences (`fed`).
    """
    q, v = gait.start(biped)
    for inner in inside(gait.constraint):
        law = friction_feedforward(inner, gait.constraint, biped, 0.8)
        walker = ba.Walker(biped, law, timing=timing)
        inner = ba.Walker(biped, inner, timing=timing).law
        m = walker.measure(0.0, q + 0.02, 1.1 * v, ba.Mode())
        F, s = 0.8 * fed(biped, gait, m), 1.1 * inner.initial_state(m)
        np.testing.assert_allclose(walker.law.output(s, m), inner.output(s, m) + F, rtol=1e-7)
        acts = np.array([150.0, -3.0, 0.0, -150.0])
        step = "predict" if walker.sampled else "flow"
        found, told = (
            getattr(x, step)(s, m, u) for x, u in ((walker.law, acts), (inner, acts - F))
        )
        np.testing.assert_allclose(found, told, rtol=1e-7, atol=1e-9)


def test_with_the_right_friction_a_walk_is_that_without_to_the_order_of_the_error(
    biped, rubbing, gait
):
    """The rates of the joints differ from the reference's by the error, and so does friction.

    From a start on the orbit (e = 0) the gap of the walks is below 1e-3 of that without feedforward; beyond, it
    doubles with the error e of the rates.
    """
    q, v = gait.start(biped)
    h, gaps = gait.constraint, []
    compensated = friction_feedforward(ba.NPDController(h), h, biped, 1.0)
    for e in (0.0, 0.005, 0.01):
        start = q, v + e * np.array([1.0, -1.0, 0.5, -0.5, 0.0])
        runs = [
            walked(plant, biped, controller, ba.ContinuousTime(), start)[1].x[-1]
            for plant, controller in (
                (rubbing, compensated),
                (biped, ba.NPDController(h)),
                (rubbing, ba.NPDController(h)),
            )
        ]
        gaps.append(np.max(np.abs(runs[0] - runs[1])))
        without = np.max(np.abs(runs[2] - runs[1]))
    assert gaps[0] < 1e-3 * without
    assert (gaps[2] - gaps[0]) / (gaps[1] - gaps[0]) == pytest.approx(2.0, abs=0.3)


@pytest.mark.parametrize("share", [0.0, 0.6, 1.0])
def test_the_estimate_of_xi_is_the_same_with_and_without_the_feedforward(
    biped, rubbing, gait, share
):
    """xi = q_b'' - kappa u of the rubbing plant contains its friction, whoever compensates it; so xi^ has to be
    near xi for any share, within 10 % of what the model misses.
    """
    h = gait.constraint
    law = friction_feedforward(ba.ADRCController(h, FAST), h, biped, share)
    walker, run = walked(rubbing, biped, law, ba.SampledTime(T), gait.start(biped), 0.15)
    x = walker.tick(run.t[-1], run.x[-1], ba.Mode())
    i = walker.instant(run.t[-1], x, ba.Mode())
    xi = i.a[:4] - i.measurement.terms.kappa @ i.u
    found = walker.law.estimate(i.s, i.measurement).disturbance
    model = i.measurement.terms.xi
    assert np.max(np.abs(found - xi)) < 0.1 * np.max(np.abs(model - xi))


def test_wrong_friction_values_are_refused(biped, gait):
    """A negative share, a coefficient of NaN, and a robot whose record has no friction."""
    for wrong in ({"share": -0.1}, {"static": (1.0, np.nan, 0.0, 0.0)}):
        values = {"viscous": (1.0,) * 4, "static": (1.0,) * 4, **wrong}
        with pytest.raises(InputError):
            FrictionFeedforward(ba.NPDController(gait.constraint), gait.constraint, **values)
    smooth = ba.Biped.load("three_link")
    with pytest.raises(InputError, match="whose record has none"):
        friction_feedforward(ba.NPDController(gait.constraint), gait.constraint, smooth, 1.0)
