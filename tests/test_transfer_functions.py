"""Transfer functions of the law of one joint against the law itself, closed forms, and python-control.

a = V w - C y: y is the measured angle, a the commanded acceleration, w what the law makes of the reference.
`stepped` runs the package's own controller tick by tick for one joint with kappa = 1.
"""

from __future__ import annotations

from types import SimpleNamespace

import control
import numpy as np
import pytest
from scipy.signal import lfilter

import biped_adrc as ba
from biped_adrc.analysis.observer.loop import ObserverLoop
from biped_adrc.analysis.observer.transfer import transfer_functions
from biped_adrc.control.base import Measurement
from biped_adrc.gait.reference import ReferencePoint, ZeroReference

T = 1e-3
GAINS = ba.Gains(900.0, 60.0)
ONE = SimpleNamespace(
    kappa=np.eye(1), kappa_inverse=np.eye(1), xi=np.zeros(1), A_N=np.zeros((0, 1)), a_N=np.zeros(0)
)
"""The model of one joint, q'' = u + xi."""


def stepped(observer, y, q_d, dq_d, ddq_d):
    """a (K,) of the controller for the angles y and the reference (K,), from the state zero."""
    law = ba.ADRCController(ZeroReference(1), observer, GAINS).sampled(T)
    z, still = np.zeros((observer.order, 1)), np.zeros(1)
    a = []
    for here, *point in zip(y, q_d, dq_d, ddq_d, strict=True):
        m = Measurement(0.0, 1, 0.0, np.array([here]), still, ONE)
        z = law.correct(z, m)
        r = ReferencePoint(*(np.array([x]) for x in point), np.zeros((1, 1)))
        u = law.torque(r, law.estimated(z), m)
        z = law.predict(z, m, u)
        a.append(u[0])
    return np.array(a)


@pytest.mark.parametrize("m", [0, 1, 2])
def test_filtering_by_the_coefficients_is_the_sampled_law(m):
    """10 000 random angles and references; with m poles at z = 1 the output grows as a random walk of that
    order, so the error is taken relative to its largest value."""
    observer, random = ba.GPIObserver.from_bandwidth(300.0, m), np.random.default_rng(1)
    y, q_d, dq_d, ddq_d = random.standard_normal((4, 10_000))
    f = transfer_functions(observer, GAINS, T)
    w = ddq_d + GAINS.K_d * dq_d + GAINS.K_p * q_d
    a = lfilter(f.chi, f.den, w) - lfilter(f.num, f.den, y)
    law = stepped(observer, y, q_d, dq_d, ddq_d)
    assert np.max(np.abs(a - law)) < 1e-9 * np.max(np.abs(law))


@pytest.mark.parametrize("w_o", [40.0, 300.0, 2000.0])
def test_coefficients_are_the_published_ones(w_o):
    """The closed forms for a second-order law with one extended state (Herbst: A minimum-footprint
    implementation of discrete-time ADRC, 2021): a = K_p r - (G y + B a) / A in powers of 1/z.

    beta = exp(-w_o T), w the bandwidth of the feedback, K_p = w^2 and K_d = 2 w, c = w T.
    """
    w, beta = 30.0, np.exp(-w_o * T)
    c, b, b2, b3 = w * T, beta, beta**2, beta**3
    A = [1.0, -3.0 * b, 3.0 * b2, -b3]
    B = 0.5 * np.array(
        [
            -c * b3 * (4.0 - c) + c * (1.0 + b) ** 3 - (1.0 - b) ** 3,
            -c * (1.0 + b) ** 3 - (1.0 - b) ** 3,
            c * b3 * (4.0 - c),
        ]
    )
    G = np.array(
        [
            c**2 * (1.0 - b3) + 3.0 * c * (1.0 - b - b2 + b3) + (1.0 - b) ** 3,
            3.0 * c**2 * (b3 - b) + 4.0 * c * (-1.0 + 3.0 * b2 - 2.0 * b3) - 2.0 * (1.0 - b) ** 3,
            3.0 * c**2 * (b2 - b3) + c * (1 + 3 * b - 9 * b2 + 5 * b3) + (1.0 - b) ** 3,
            0.0,
        ]
    )
    f = transfer_functions(ba.GPIObserver.from_bandwidth(w_o, 1), ba.Gains(w**2, 2.0 * w), T)
    for found, printed in ((f.num * T**2, G), (f.chi, A), (f.den, A + np.append(0.0, B))):
        np.testing.assert_allclose(found, printed, rtol=0.0, atol=1e-12)
    # gains of the observer: l1, l2 T and l3 T^2 in its scaled states
    L = ba.GPIObserver.from_bandwidth(w_o, 1).sampled(T).L
    printed = [1.0 - b3, 1.5 * (1.0 - b) ** 2 * (1.0 + b), (1.0 - b) ** 3]
    np.testing.assert_allclose(L, printed, rtol=1e-12)


@pytest.mark.parametrize("m", [0, 1, 3])
def test_error_form_and_output_form_are_one_law(m):
    """V (1 + F (z - Phi)^-1 Gamma) = 1 + C (z - Phi)^-1 Gamma: with the reference of a q_d'' that is constant
    between ticks the output form commands what the error form does, a = q_d'' - C (y - q_d).
    """
    pair = (-300 + 100j, -300 - 100j, -200.0, -80.0, -500.0)
    observer = ba.GPIObserver.from_poles(pair[: m + 2])
    f, z = transfer_functions(observer, GAINS, T), np.exp(1j * np.geomspace(1e-3, 3.0, 50))
    C, V = (np.polyval(x, z) / np.polyval(f.den, z) for x in (f.num, f.chi))
    # q_d and q_d' of a held q_d'': the sampled double integrator
    q_d, dq_d = 0.5 * T**2 * (z + 1.0) / (z - 1.0) ** 2, T / (z - 1.0)
    output = V * (1.0 + GAINS.K_d * dq_d + GAINS.K_p * q_d)
    np.testing.assert_allclose(output, 1.0 + C * q_d, rtol=1e-9)


@pytest.mark.parametrize("m", [0, 1, 4])
def test_continuous_coefficients_are_those_of_the_loop_and_of_the_state_space(m):
    """C / s^2 is the loop gain, and C and V are those of python-control for z' = A z + l (y - z_1) + b a."""
    observer, w = ba.GPIObserver.from_bandwidth(200.0, m), np.geomspace(1.0, 1e4, 40)
    f, k = transfer_functions(observer, GAINS), m + 2
    C, V = (np.polyval(x, 1j * w) / np.polyval(f.den, 1j * w) for x in (f.num, f.chi))
    np.testing.assert_allclose(C / (1j * w) ** 2, ObserverLoop(observer, GAINS).gain(w), rtol=1e-10)
    F, b = np.array([[GAINS.K_p, GAINS.K_d, 1.0, *[0.0] * k]])[:, :k], np.eye(k)[:, 1:2]
    gains = observer.gains[:, np.newaxis]
    A = np.eye(k, k=1) - b @ F
    A[:, :1] -= gains
    for B, D, found in ((gains, 0.0, -C), (b, 1.0, V)):
        expected = control.ss(A, B, -F, D)(1j * w)
        np.testing.assert_allclose(found, expected, rtol=1e-7)
