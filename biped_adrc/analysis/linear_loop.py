"""The linear loop per joint: the observer's error matrix (19) and the tracking transfer function (23).

With chi(s) the observer's polynomial, a total disturbance xi gives e1 = s^m / chi(s) xi. From (17),
x1^ = q_b - e1 and x2^ = q_b' - e1' - l_(m+1) e1, hence

    e_q = [K_d s + K_p + K_d l_(m+1)] / (s^2 + K_d s + K_p) e1 + (xi - xi^) / (s^2 + K_d s + K_p)
    xi - xi^ = (s^2 + l_(m+1) s + l_m) e1

(22) and (23) print l_(m+1) without its factor K_d; `printed` gives that version, to show the
difference. In the paper's own form and physical units; `observer_design.observer_loop` is the
well-conditioned form that design uses.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.control.tracking import Gains
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.types import Array


def error_matrix(observer: GPIObserver) -> Array:
    """A^ (m + 2, m + 2) of (19) in physical units, row i in [1/s^i]; badly conditioned, for display."""
    A = np.eye(observer.order, k=1)
    A[:, 0] = -observer.gains
    return A


def estimation_error(observer: GPIObserver, s: complex) -> complex:
    """e1(s) / xi(s) [s^2] = s^m / chi(s) at s [rad/s], as a product over the poles, which loses no digits."""
    value = 1.0 + 0.0j
    for k, pole in enumerate(observer.poles):
        value *= (s if k < observer.m else 1.0) / (s - pole)
    return complex(value)


def tracking_error(
    observer: GPIObserver, gains: Gains, s: complex, printed: bool = False
) -> complex:
    """e_q(s) / xi(s) [s^2] by (23) at s [rad/s], corrected, or with l_(m+1) as printed.

    gains: those of one joint; of several numbers the largest counts.
    """
    l1, l0 = observer.gains[0], observer.gains[1]
    K_p, K_d = float(np.max(gains.K_p)), float(np.max(gains.K_d))
    through_estimates = K_d * s + K_p + (l1 if printed else K_d * l1)
    through_disturbance = (
        s**2 + l1 * s + l0 if observer.m > 0 else 1.0 / estimation_error(observer, s)
    )
    e1 = estimation_error(observer, s)
    return complex((through_estimates + through_disturbance) / (s**2 + K_d * s + K_p) * e1)
