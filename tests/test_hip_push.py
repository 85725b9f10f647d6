"""A constant force on the hip: what stops the simulated walk against quadratures that know no controller.

The force is horizontal and backwards; no tracking controller can reject it. The quadratures (`forced_walk`,
one speed, beta and zeta per walking step) assume exact tracking: zeta is half the square of the angular
momentum about the stance foot before an impact. `HipCase(stride=True)` has a PI around the tracking, which
moves the gait's curve by beta [rad] from step to step to keep the speed. The gait walks 0.5 m/s.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.stride import StrideGains
from validation.forced_steps import forced_walk, stopping_force
from validation.hip_push import STANCE_KNEE, HipCase, PushedWalk

STEPS = 3
"""Number of walking steps in these tests."""
RESOLUTION = 0.1
"""Distance of the two forces of walks around the predicted one [N]."""


class Alone(NamedTuple):
    """A case without the PI, and its walks on both sides of the predicted force."""

    case: HipCase
    predicted: float
    below: PushedWalk
    stops: PushedWalk


@pytest.fixture(scope="module")
def gait(bare):
    return ba.load_gait("v0.5", bare)


@pytest.fixture(scope="module", params=["NPD", "ADRC"])
def alone(request):
    case = HipCase(request.param, stride=False, steps=STEPS)
    predicted = case.predicted()
    stops = math.ceil(predicted / RESOLUTION) * RESOLUTION
    below, above = (PushedWalk.of(case, force) for force in (stops - RESOLUTION, stops))
    return Alone(case, predicted, below, above)


def stride():
    return HipCase("NPD", stride=True).parts().law


# -- simulated against the quadratures --------------------------------------------------------------
def test_the_force_that_stops_tracking_is_the_one_of_the_quadratures(alone):
    """`alone` has simulated walks without the PI under two forces 0.1 N apart, with the predicted one between
    them: all three steps are made under the smaller one and not under the larger one."""
    assert alone.below.walks
    assert not alone.stops.walks
    assert alone.below.force < alone.predicted <= alone.stops.force
    assert len(alone.below.speeds) == STEPS
    assert np.all(np.diff(alone.below.speeds) < -0.05), "slower with every step"


def test_with_the_stride_controlled_the_same_force_is_walked_through(alone, bare, gait):
    """With the PI the force that stopped tracking is survived, with the speeds that the quadratures give. The
    PI learns from the first step, so the second one is the first that is quicker."""
    case = HipCase(alone.case.tracking, stride=True, steps=STEPS)
    walked = PushedWalk.of(case, alone.stops.force)
    assert walked.walks
    law = case.parts().law
    expected = forced_walk(gait, bare, -alone.stops.force, STEPS, law)
    np.testing.assert_allclose(walked.speeds, [step.speed for step in expected], atol=1e-3)
    assert walked.speeds[1] > alone.stops.speeds[1] + 5e-3, "quicker from the second step on"


def test_once_settled_the_walk_keeps_the_speed_of_the_gait(alone, bare, gait):
    """A simulated step from where the quadratures settle after 60 steps, with the PI's states from there, under
    the force that stops the tracking without a PI (`alone`): its speed is 0.5 m/s, and it ends where it
    began."""
    case = HipCase(alone.case.tracking, stride=True)
    biped, _, law = case.parts()
    force = alone.stops.force
    settled = forced_walk(gait, bare, -force, 60, law)[-1]
    zero = ba.ZeroDynamics.of(biped, gait.constraint)
    before = zero.end_state(math.copysign(math.sqrt(2.0 * settled.zeta), zero.sigma_minus))
    walker = ba.Walker(biped, law, ba.HipForce(biped, (-force, 0.0)))
    impact = biped.impact(*before)
    x = walker.initial_state(impact.q, impact.v)
    # the PI's states: sum I of the errors, whose part K_I I makes beta when the speed is kept, and beta
    x[-2:] = settled.beta / law.gains.K_I, settled.beta
    method = ba.RK4(4e-3) if case.tracking == "NPD" else ba.Exponential(2e-3)
    run = ba.simulate(walker, x, ba.Mode(), method, t_end=5.0, stop_after=("foot_strike", 1))
    assert law.step_length / (run.t_end - run.t_start) == pytest.approx(0.5, abs=1e-3)
    impact = biped.impact(*np.split(run.before("foot_strike")[0][:10], 2))
    assert np.max(np.abs(np.append(impact.q, impact.v) - x[:10])) < 2e-2, "a cycle"


# -- the quadratures ------------------------------------------------------------------------------
def test_without_a_force_the_walk_is_the_gait(bare, gait):
    """The quadratures alone give a speed of 0.5 m/s and no correction by the PI."""
    steps = forced_walk(gait, bare, 0.0, 3, stride())
    np.testing.assert_allclose([step.speed for step in steps], [0.5] * 3, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose([step.beta for step in steps], [0.0] * 3, rtol=0.0, atol=1e-8)


def test_what_the_force_takes_from_zeta_is_linear_in_it(bare, gait):
    """The force enters sigma' linearly and sigma^2 / 2 as its integral along the curve, so 3 N take three
    times what 1 N takes in the first step."""
    free, *pushed = (forced_walk(gait, bare, -F, 1)[0].zeta for F in (0.0, 1.0, 3.0))
    assert free - pushed[1] == pytest.approx(3.0 * (free - pushed[0]), rel=1e-9)
    assert pushed[0] < free


def test_the_first_step_agrees_with_the_work_of_the_force(bare, gait):
    """The energy gained in a step is the work of the joints and of the force along the path of the hip."""
    force = -2.0
    case = HipCase("NPD", stride=False)
    biped, gait, law = case.parts()
    walker = ba.Walker(biped, law, ba.HipForce(biped, (force, 0.0)))
    made = ba.walk(walker, gait, 1, ba.RK4(1e-3))
    s, step = made.signals.of_step(1), made.certificates[0]
    energy = s.kinetic + s.potential
    work = force * (s.hip[-1, 0] - s.hip[0, 0])
    assert energy[-1] - energy[0] == pytest.approx(step.joint_work + work, rel=1e-4)
    expected = forced_walk(gait, bare, force, 1)[0]
    sigma = biped.angular_momentum(s.q[-1], s.v[-1])
    assert 0.5 * sigma**2 == pytest.approx(expected.zeta, rel=1e-3)


def test_settled_under_a_small_force_is_the_fixed_point_of_the_affine_map(bare, gait):
    """zeta -> delta^2 zeta + const from step to step: the slope of the first two steps, and the fixed point
    in closed form after 60 steps."""
    zero = ba.ZeroDynamics.of(bare, gait.constraint)
    delta2, start = zero.delta**2, 0.5 * zero.sigma_minus**2
    zeta = np.array([step.zeta for step in forced_walk(gait, bare, -1.0, 60)])
    assert zeta[1] - zeta[0] == pytest.approx(delta2 * (zeta[0] - start), rel=1e-9)
    assert zeta[-1] == pytest.approx((zeta[1] - delta2 * zeta[0]) / (1.0 - delta2), rel=1e-8)


def test_about_3_newton_stop_the_gait_and_the_loop_more_than_doubles_that(bare, gait):
    """The literature's gait of the same speed stopped at 3 N (Westervelt et al., CDC 2003). Twice the force
    ends this one within 4 of 25 steps, and with the PI around it all 25 are made."""
    force = stopping_force(gait, bare, 25)
    assert force == pytest.approx(3.0, abs=0.15)
    assert len(forced_walk(gait, bare, -2.0 * force, 25)) < 4
    assert len(forced_walk(gait, bare, -2.0 * force, 25, stride())) == 25


# -- directions -----------------------------------------------------------------------------------
def test_the_static_gain_is_what_a_held_correction_does(bare, gait):
    """The gain of speed over beta [m/s per rad] of the linear response, against the speed of a walk in which
    beta stays at a bound of 1e-3 rad for 60 steps."""
    response = ba.stride_response(gait, bare, STANCE_KNEE)
    beta = 1e-3
    law = stride()
    gains = StrideGains(0.0, -1.0, limit=beta)  # one step with e > 0 takes beta to its bound
    # a wanted speed of 5 m/s: e > 0 in every step
    held = ba.StridePI(law.inner, 5.0, law.step_length, STANCE_KNEE, gains)
    step = forced_walk(gait, bare, 0.0, 60, held)[-1]
    assert step.beta == -beta
    assert (step.speed - 0.5) / -beta == pytest.approx(response.static_gain, rel=5e-3)
