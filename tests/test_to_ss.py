"""State-space models for python-control against transfer functions written as products over the poles."""

from __future__ import annotations

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.linear_loop import estimation_error, tracking_error
from biped_adrc.observer_design.to_ss import error_to_ss, loop_to_ss, to_ss

OBSERVERS = {
    "table 1": ba.GPIObserver.from_poles(),
    "m = 1": ba.GPIObserver.from_bandwidth(500.0, 1),
    "m = 0": ba.GPIObserver.from_poles((-30.0, -50.0)),
    "complex": ba.GPIObserver.from_poles((-10 + 5j, -10 - 5j, -40.0, -8.0)),
}
FREQUENCIES = 1j * np.array([30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 1e5])


@pytest.fixture(params=OBSERVERS.values(), ids=list(OBSERVERS))
def observer(request):
    return request.param


def simple(observer):
    """Poles whose eigenvalues are well conditioned: an m-fold pole is found to eps^(1/m) only."""
    return len(set(observer.poles)) == len(observer.poles)


def same_poles(found, expected):
    found, expected = np.sort_complex(found), np.sort_complex(np.array(expected, complex))
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def test_poles_are_the_ones_chosen(observer):
    if not simple(observer):
        A = to_ss(observer).A / observer.poles[0].real  # all at 1: (A - I) is nilpotent
        np.testing.assert_allclose(
            np.linalg.matrix_power(A - np.eye(len(A)), len(A)), 0, atol=1e-12
        )
        return
    tracking = np.roots([1.0, 50.0, 5000.0])
    same_poles(to_ss(observer).poles(), observer.poles)
    same_poles(error_to_ss(observer).poles(), observer.poles)
    loop = loop_to_ss(ba.ADRCController(reference(), observer, ba.Gains(5000.0, 50.0)))
    same_poles(loop.poles(), [*observer.poles, *tracking])


def test_estimates_in_the_frequency_domain(observer):
    """x1^ = y - e1, xi^ = xi - (s^2 + l s + l') e1 with e1 = s^m / chi xi and xi = y'' - kappa u."""
    kappa, system = 0.7, to_ss(observer, 0.7)
    assert (system.input_labels, system.output_labels) == (["y", "u"], ["x1", "x2", "xi"])
    l1, l0 = observer.gains[:2]
    for s in FREQUENCIES:
        e1 = estimation_error(observer, s)
        for column, (y, xi) in enumerate(((1.0, s**2), (0.0, -kappa))):
            x1, x2, found = system(s)[:, column]
            scale = abs(xi * e1) + abs(y)
            assert abs(x1 - (y - xi * e1)) < 1e-8 * scale
            assert abs(x2 - (s * x1 - l1 * xi * e1)) < 1e-8 * (abs(s) + l1) * scale
            expected = xi * (1.0 - (s**2 + l1 * s + l0) * e1)
            assert abs(found - (expected if observer.m else 0.0)) < 1e-7 * abs(xi)


def test_error_and_loop_in_the_frequency_domain(observer):
    gains = ba.Gains(5000.0, 50.0)
    error = error_to_ss(observer)
    loop = loop_to_ss(ba.ADRCController(reference(), observer, gains))
    for s in FREQUENCIES:
        assert error(s)[0, 0] == pytest.approx(estimation_error(observer, s), rel=1e-6)
        assert loop(s)[0, 0] == pytest.approx(tracking_error(observer, gains, s), rel=1e-6)
        # e_q'' = v + xi for every input: Newton's law of the joint
        assert s**2 * loop(s)[0, 0] == pytest.approx(loop(s)[2, 0] + 1.0, rel=1e-6)
        assert s**2 * loop(s)[0, 1] == pytest.approx(loop(s)[2, 1], rel=1e-6)


def test_gains_at_rest(observer):
    """A constant position and torque: x1^ = y and xi^ = -kappa u; the loop cancels a constant xi."""
    at_rest = to_ss(observer, 0.7).dcgain()
    loop = loop_to_ss(ba.ADRCController(reference(), observer, ba.Gains(5000.0, 50.0))).dcgain()
    if observer.m > 0:
        np.testing.assert_allclose(at_rest, [[1.0, 0.0], [0.0, 0.0], [0.0, -0.7]], atol=1e-8)
        np.testing.assert_allclose(loop, [[0.0, -1.0], [0.0, -1.0], [-1.0, 0.0]], atol=1e-8)
    else:
        l1, l0 = observer.gains
        offset = 1.0 / l0
        np.testing.assert_allclose(at_rest[:, 1], [0.7 * offset, 0.7 * l1 * offset, 0.0])
        assert loop[1, 0] == pytest.approx(offset)
        assert loop[0, 0] == pytest.approx(offset + (50.0 * l1 * offset + 1.0) / 5000.0)


def test_coupled_joints_flow_as_the_observer_does():
    observer, random = OBSERVERS["table 1"], np.random.default_rng(4)
    kappa = random.normal(size=(2, 2))
    system = to_ss(observer, kappa)
    z, y, u = random.normal(size=18), random.normal(size=2), random.normal(size=2)
    flow = system.A @ z + system.B @ np.concatenate((y, u))
    np.testing.assert_allclose(flow, observer.flow(z, y, kappa @ u), rtol=1e-9)
    estimate = observer.estimate(z)
    np.testing.assert_allclose(system.C @ z, np.concatenate(estimate), rtol=1e-12)
    assert system.input_labels == ["y_1", "y_2", "u_1", "u_2"]
    assert system.state_labels[:3] == ["z_1_1", "z_1_2", "z_2_1"]


def reference():
    return ba.TimeReference(lambda t: (np.zeros(1),) * 3)
