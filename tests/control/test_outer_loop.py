"""Outer loops: the reference bent to the state after impact, the speed controlled from step to step.

`ReferenceReset` adds to the constraint h after each impact a correction c that brings h to the state and fades
out. `StridePI` bends h by beta, from a PI on the speed of the step before. The reference in force is h with
what is added. The gait `recipe` has a constraint that the impact leaves; that of `published` is hybrid
invariant. `bare` is the robot. `gap` is (q_b - q_d, q_b' - q_d') of the reference in force, `largest_error` the
largest of the first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.stride_gain import StrideResponse, stride_response
from biped_adrc.control.around import Around
from biped_adrc.control.outer_loop import OuterLoop, reference_in_force
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.control.stride import TORSO_LEAN, StrideGains, StridePI
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.disturbances.force import HipForce
from biped_adrc.gait.curves import BSpline
from biped_adrc.gait.reference import TimeReference

RK4 = ba.RK4(2e-3)


@pytest.fixture(scope="module")
def recipe(bare):
    return ba.load_gait("recipe", bare)


def gap(walker, x, t=0.0):
    """q_b - q_d and q_b' - q_d' of the reference in force, (2, p)."""
    q, v, s = walker.split_state(x)
    r = reference_in_force(walker.law, s)(t, q, v)
    return np.array((q[:4] - r.q_d, v[:4] - r.dq_d))


def largest_error(walk):
    nodes = [(t, x) for arc in walk.trajectory.arcs for t, x in zip(arc.t, arc.x, strict=True)]
    return max(np.max(np.abs(gap(walk.walker, x, t)[0])) for t, x in nodes)


def stride(law, gait, biped, **options):
    gains = stride_response(gait, biped).gains()
    return StridePI.on_gait(law(gait.constraint), gait, biped, gains, **options)


# -- reference reset -------------------------------------------------------------------------------


def test_a_constraint_that_the_impact_leaves_is_tracked_all_the_same(bare, recipe):
    """Without the reset the impact leaves an error of 4e-2 rad; with it, that of the method. The peak of the
    torque is below 0.6 of that without.
    """
    inner, method = ba.NPDController(recipe.constraint), ba.RK4(1e-3)
    plain = ba.walk(ba.Walker(bare, inner), recipe, 1, method)
    reset = ba.walk(ba.Walker(bare, ReferenceReset(inner)), recipe, 1, method)
    assert plain.trajectory.status.ok
    assert reset.trajectory.status.ok
    assert largest_error(plain) > 3e-2
    assert largest_error(reset) < 1e-5
    assert np.max(np.abs(reset.signals.u)) < 0.6 * np.max(np.abs(plain.signals.u))
    for event in reset.trajectory.events("foot_strike"):
        assert np.max(np.abs(gap(reset.walker, event.x_plus))) < 1e-12
        h = recipe.constraint(event.t, event.x_plus[:5], event.x_plus[5:10])
        assert np.max(np.abs(event.x_plus[:4] - h.q_d)) < 1e-3, "the pose closes"
        assert np.max(np.abs(event.x_plus[5:9] - h.dq_d)) > 0.5, "the rates do not [rad/s]"


def test_on_a_hybrid_invariant_constraint_there_is_nothing_to_correct(bare, published):
    """The impact brings the state back onto h, so the correction c of every step is zero, from the start of the
    phase to where it has faded out, up to the method's error.
    """
    law = ReferenceReset(ba.NPDController(published.constraint))
    walk = ba.walk(ba.Walker(bare, law), published, 2, ba.RK4(5e-4))
    for arc in walk.trajectory.arcs:
        c = law.correction(walk.walker.split_state(arc.x[0])[2].own)
        phases = np.linspace(published.constraint.theta_plus, law.range[0], 9)
        assert max(np.max(np.abs(c(theta)[0])) for theta in phases) < 1e-8


def test_the_correction_does_not_depend_on_the_speed(bare, recipe):
    """The impact is linear in the rates, so h + c is one constraint, invariant at every speed. share: of the
    speed of the cycle at impact; found: the coefficients of c, which are not zero.
    """
    zero = ba.ZeroDynamics.of(bare, recipe.constraint)
    walker = ba.Walker(bare, ReferenceReset(ba.NPDController(recipe.constraint)))
    found = []
    for share in (1.0, 0.6):
        x = np.concatenate((*zero.end_state(share * zero.sigma_minus), np.zeros(8)))
        # strike gives (x+, mode); behind (q, q') x+ has the 8 coefficients of c, a_0 and a_1 of four joints
        found.append(walker.strike(0.0, x, ba.Mode())[0][10:])
    np.testing.assert_allclose(found[0], found[1], rtol=0.0, atol=1e-10)
    assert np.max(np.abs(found[0])) > 0.1


# -- stride ----------------------------------------------------------------------------------------


def test_multipliers_of_the_loop_are_the_poles_predicted_from_the_zero_dynamics(bare, published):
    """The largest eigenvalues of the return map's Jacobian, of the whole robot, are the three poles that
    `stride_response` predicts from two degrees of freedom; all others are tracking, and small. own: the loop's
    states before impact, the duration of the step and two zeros.
    """
    gains = StrideGains(-0.9, -0.2)
    law = StridePI.on_gait(ba.NPDController(published.constraint), published, bare, gains)
    poles = stride_response(published, bare).poles(gains)
    P = ba.ReturnMap(ba.Walker(bare, law), RK4)
    own = (published.period, 0.0, 0.0)
    s = P.project(np.concatenate((published.q_minus, published.v_minus, own)))
    found = np.linalg.eigvals(P.jacobian(s))
    found = found[np.argsort(-np.abs(found))]
    np.testing.assert_allclose(found[:3], poles, rtol=0.0, atol=2e-4)
    assert np.max(np.abs(found[3:])) < 1e-3


def test_the_gains_give_three_equal_poles_and_no_others_are_quicker(bare, published):
    """The polynomial of the loop with the PI's gains is that of a triple root, and gains 10 % off in each
    direction have a slower pole.
    """
    response = stride_response(published, bare)
    best = response.gains()
    poles = response.poles(best)
    np.testing.assert_allclose(
        np.poly(poles), np.poly([np.mean(poles).real] * 3), rtol=0.0, atol=1e-9
    )
    for K_P in (0.9, 1.0, 1.1):
        for K_I in (0.9, 1.0, 1.1):
            other = StrideGains(K_P * best.K_P, K_I * best.K_I)
            assert abs(response.poles(other)[0]) > abs(np.mean(poles)) - 1e-6


def test_a_force_that_stops_the_walk_does_not_with_the_stride_controlled(bare, published):
    """-10 N on the hip stop a walk under NPD; with StridePI beta goes to its bound, the integral too
    (anti-windup), and the walk goes on.
    """
    force = HipForce(bare, (-10.0, 0.0))
    inner = ba.NPDController(published.constraint)
    # a step that lasts longer than 0.9 s counts as stalled
    alone = ba.walk(ba.Walker(bare, inner, force, max_step_time=0.9), published, 8, RK4)
    assert alone.trajectory.status in (ba.Status.FELL, ba.Status.STALLED)
    law = stride(ba.NPDController, published, bare)
    held = ba.walk(ba.Walker(bare, law, force), published, 5, RK4)
    assert held.trajectory.status.ok
    assert held.signals.peak_error == pytest.approx(largest_error(held), rel=1e-3), (
        "of what is in force"
    )
    own = held.walker.split_state(held.trajectory.final_state)[2].own
    assert own.beta == -law.gains.limit, "beta at its bound"
    assert pytest.approx(-law.gains.limit) == law.gains.K_I * own.I, "and the integral at its own"


# -- both, in every setting ------------------------------------------------------------------------


def test_what_cannot_be_corrected_is_refused(bare, published):
    """Refused are no constraint at all, a reference in time; a share above 1; two numbers as the direction of
    four joints; a negative speed; NaN; a curve that is no single polynomial; one number as direction; a
    response whose triple pole would be outside the unit circle.
    """
    h, gains = published.constraint, StrideGains(-1.0, -0.4)
    inner = ba.NPDController(h)
    in_time = TimeReference(lambda t: (np.zeros(4), np.zeros(4), np.zeros(4)))
    local = replace(published, constraint=replace(h, curve=BSpline(h.curve.coefficients)))
    for make in (
        lambda: ReferenceReset(ba.Passive()),
        lambda: ReferenceReset(ba.NPDController(in_time)),
        lambda: ReferenceReset(inner, 1.5),
        lambda: StridePI(inner, 0.7, 0.3, (1.0, 1.0), gains),
        lambda: StridePI(inner, -1.0, 0.3, TORSO_LEAN, gains),
        lambda: StrideGains(-1.0, np.nan),
        lambda: stride_response(local, bare),
        lambda: stride_response(published, bare, (1.0,)),
        lambda: StrideResponse(a=0.7, b=-0.2, c=1.0, d=1.0).gains(),
    ):
        with pytest.raises((InputError, GaitError)):
            make()


@dataclass(frozen=True)
class Counting(OuterLoop):
    """A loop with a state that corrects nothing."""

    def own_start(self, h, m):
        return np.zeros(1)

    def correction(self, w):
        return TORSO_LEAN


class Flows(Counting):
    """One whose own state moves in continuous time alone."""

    def own_flow(self, w):
        return np.ones(1)


class Corrects(Counting):
    """One whose own state moves at sample instants alone."""

    def own_correct(self, w, m):
        return w + 1e-3


@dataclass(frozen=True)
class Clock(Around):
    """A wrapper with a state that moves in continuous time alone."""

    def initial_state(self, m):
        return np.zeros(1)

    def flow(self, s, m, u):
        return np.ones(1)


def test_a_state_that_does_not_move_in_this_time_base_is_refused(bare, published):
    """Bases of wrappers write all methods, and that hid what a user's class does not write."""
    inner = ba.NPDController(published.constraint)
    for law in (Flows(inner), Clock(inner)):
        law.continuous()
        with pytest.raises(InputError, match=r"has no (method own_correct|discrete form); write"):
            law.at_ticks(1e-3)
    Corrects(inner).at_ticks(1e-3)
    with pytest.raises(InputError, match="Corrects has no form but one in sampled time only"):
        Corrects(inner).continuous()


def test_nothing_is_corrected_where_too_little_of_the_step_is_left_for_it(bare, published):
    """x = 1 at the start of the step, 0 at its share 0.5; below 0.2 the correction would fall abruptly. w: its
    coefficients; the rates are 5 % too fast, so there is an error.
    """
    law = ReferenceReset(ba.NPDController(published.constraint))
    walker, h = ba.Walker(bare, law), published.constraint
    for x, corrected in ((0.3, True), (0.1, False), (-0.1, False)):
        theta = h.theta_plus + 0.5 * (1.0 - x) * (h.theta_minus - h.theta_plus)
        q, v = published.start(bare)
        q = q + (theta - h.phase @ q) * h.phase / (h.phase @ h.phase)
        w = law.own_start(h, walker.measure(0.0, q, 1.05 * v, ba.Mode()))
        assert np.any(w != 0.0) == corrected
