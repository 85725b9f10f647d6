"""The momentum observer: how fast it finds a force, what it knows, and what an impact does to it.

It estimates the generalised force zeta from outside by the momentum D q', whose rate is beta + zeta; beta is
what the model knows, and r the estimate.
"""

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.observers.momentum import MomentumObserver

from .off_orbit import off_orbit

NO_STATE = np.zeros(0)


def test_the_force_is_found_with_the_poles_chosen(biped, gait):
    """r = zeta (1 - (b e^(a t) - a e^(b t)) / (b - a)) for all coordinates, whatever the robot does: the step
    response of two poles a and b, under a constant zeta in a walk.
    """
    a, b = -40.0, -60.0
    zeta = np.array([20.0, -10.0, 5.0, 15.0, -8.0])
    law = MomentumDOBController(gait.constraint, MomentumObserver.from_poles((a, b)))
    walker = Walker(biped, law, ba.TorqueStep(zeta))
    run = ba.walk(walker, gait, 1, ba.RK4(5e-4), engine="compiled").trajectory
    arc = run.arcs[0]
    settled = (b * np.exp(a * arc.t) - a * np.exp(b * arc.t)) / (b - a)
    r = np.array([law.observer.estimate(walker.split_state(x)[2]).disturbance for x in arc.x])
    assert arc.t[-1] > 0.2
    assert np.max(np.abs(r - np.outer(1.0 - settled, zeta))) < 1e-5 * np.max(np.abs(zeta))


@pytest.mark.parametrize("poles", [(-40.0, -60.0), (-30 + 20j, -30 - 20j, -50.0)])
def test_the_error_has_the_transfer_function_of_the_module(poles):
    """The error is zeta - r = s^(k-1) (s + l_1) / chi(s) zeta, from the matrices of its flow at s = i w: chi is
    the polynomial with the k poles as roots, l_1 its first coefficient, w any frequency.
    """
    observer, w = MomentumObserver.from_poles(poles), 37.0
    order, l_1 = observer.order, -float(np.sum(poles).real)
    zero, unit = np.zeros((order, order)), np.eye(order)
    A = observer.flow(unit, zero[0], zero[0])
    by_y = observer.flow(zero[:, :1], np.ones(1), np.zeros(1))[:, 0]
    s = 1j * w
    Z = np.linalg.solve(s * unit - A, by_y / s)  # the momentum is zeta / s, with beta = 0
    error = 1.0 - Z[1] * observer.scale
    chi = np.prod([s - pole for pole in poles])
    assert error == pytest.approx(s ** (order - 1) * (s + l_1) / chi, rel=1e-9)


def test_a_constant_force_on_a_mass_is_found_without_error_in_discrete_time():
    """p' = beta + zeta on one coordinate: after 500 ticks of 1 ms, 40 time constants of poles at -80 1/s, r is
    zeta.
    """
    observer, T = MomentumObserver.from_bandwidth(80.0).sampled(1e-3), 1e-3
    zeta, beta, momentum = np.array([7.0]), np.array([-3.0]), np.array([0.4])
    z = observer.initial_state(momentum, NO_STATE, np.zeros(1))
    for _ in range(500):
        z = observer.predict(z, beta)
        momentum = momentum + T * (beta + zeta)
        z = observer.correct(z, momentum)
    assert observer.estimate(z).disturbance == pytest.approx(zeta, rel=1e-9)
    assert observer.estimate(z).position == pytest.approx(momentum, rel=1e-12)


def test_what_is_known_of_the_momentum_is_its_rate(biped, gait):
    """beta = d(D q')/dt, by differences along the plant's motion without forces from outside."""
    law = MomentumDOBController(gait.constraint)
    walker = Walker(biped, ba.NPDController(gait.constraint))
    x, h = walker.initial_state(*off_orbit(gait, biped)), 1e-5
    i = walker.instant(0.0, x, Mode())
    q, v, a = x[:5], x[5:], i.a

    def momentum(t):
        return biped.inertia(q + v * t + 0.5 * a * t**2) @ (v + a * t)

    m = i.measurement._replace(body=biped.body_terms(q, v))
    rate = (momentum(h) - momentum(-h)) / (2.0 * h)
    assert law.observer_input(m, i.u) == pytest.approx(rate, rel=1e-6, abs=1e-6)
    assert law.measured_output(m).position == pytest.approx(momentum(0.0), rel=1e-12)


def test_an_impact_relabels_the_force_and_keeps_it(biped, gait):
    """This holds under all policies but "none"; "measured" and "model" set the momentum, "model" the slopes to
    0.

    The states are five momenta of 1, the five forces 1 to 5, and their slopes, 9 each.
    """
    q, v = gait.start(biped)
    law = MomentumDOBController(gait.constraint, MomentumObserver.from_bandwidth(50.0, 3))
    walker = Walker(biped, law)
    after = walker.measure(0.0, q, v, Mode())
    r, swap = np.arange(1.0, 6.0), biped.swap
    s = law.observer.initial_state(np.ones(5), NO_STATE, r)
    s[10:] = 9.0
    for policy in ba.ResetPolicy:
        new = replace(law, reset=policy).jump(s, after, swap)
        x = law.observer.estimate(new)
        unchanged = policy is ba.ResetPolicy.NONE
        assert x.disturbance == pytest.approx(r if unchanged else r[[1, 0, 3, 2, 4]])
        told = policy in (ba.ResetPolicy.MEASURED, ba.ResetPolicy.MODEL)
        assert x.position == pytest.approx(biped.inertia(q) @ v if told else np.ones(5))
        assert np.all(new[10:] == (0.0 if policy is ba.ResetPolicy.MODEL else 9.0))
