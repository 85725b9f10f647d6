"""The law of one joint under ADRC as transfer functions, in sampled and in continuous time.

The law (20) of the paper, with the sampled observer of `observers.gpi`, is at each sample instant

    Z <- Z + L (y - Z_1),   a = w - F Z,   Z <- Phi Z + Gamma a         w = q_d'' + K_d q_d' + K_p q_d

    y, a           measured angle [rad] and commanded acceleration a = kappa u [rad/s^2], u the torque
    q_d, w         the joint's reference [rad], and what the law makes of it [rad/s^2]
    Z, L           the observer's scaled states and its gains; Phi, Gamma: its transition and input matrices
    F              gains of the feedback on Z, T^-2 (T^2 K_p, T K_d, 1, 0, ..), T the period [s]

Eliminating Z leaves two transfer functions with one denominator,

    a = V(z) w - C(z) y,    V = chi(z) / den(z),    C = num(z) / den(z)

chi(z) = det(z - Phi (1 - L C_1)) has the zeros exp(s T), s the poles of the observer; V / C is the prefilter of
the reference in a loop with two degrees of freedom. With M = (Phi - Gamma F) (1 - L C_1), C_1 = (1, 0, ..),

    den = det(z - M),    num = F L det(z - (Phi - Gamma F) (1 - L F / (F L)) (1 - L C_1))

In error form the observer has e = y - q_d in place of y, and a = q_d'' - F Z. Its C(z) is the same, so are its
loop and its margins; the forms differ in the reference alone, and not at all where q_d'' is constant between
sample instants. In continuous time, with P and Q of `loop`, C = P / (s^m Q) and V = chi / (s^m Q).

C has m poles at z = 1, so its coefficients lose digits with m. Over 10 000 samples, of an observer at 300 rad/s
with T = 1 ms, they repeat the law to 1e-11 of its largest torque for m = 2, and to 1e-8 for m = 4.

    G. Herbst, R. Madonski: Tuning and implementation variants of discrete-time ADRC. Control Theory and
    Technology 21, 2023. R. Madonski, G. Herbst, M. Stankovic: ADRC in output and error form. Ibid.
"""

from typing import NamedTuple

import numpy as np

from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.core.types import Array
from biped_adrc.observers.gpi import InjectedChain


class TransferFunctions(NamedTuple):
    """Coefficients of a = V w - C y, the highest power of z, or of s, first."""

    num: Array
    """Of C, from the measured angle [rad] to -a [rad/s^2]: (m + 3,) sampled, (m + 2,) in continuous time."""
    chi: Array
    """Of V, from w to a, both [rad/s^2]; (m + 3,)."""
    den: Array
    """Of both; (m + 3,), the first is 1."""


def transfer_functions(
    observer: InjectedChain, gains: Gains = TABLE_II, period: float | None = None
) -> TransferFunctions:
    """The transfer functions of ADRC for one joint; sampled with this period [s], or continuous for None.

    gains: K_p and K_d, of which those of the first joint count. Raises InputError for a period that is not > 0.
    """
    (K_p, K_d), k = gains.first, observer.order
    if period is None:
        chi = np.concatenate(([1.0], observer.gains))
        product = np.asarray(np.polymul([1.0, K_d, K_p], chi), dtype=float)  # s^(m+2) Q + P
        return TransferFunctions(product[3:], chi, np.append(product[:3], np.zeros(k - 2)))
    o, T, F = observer.sampled(period), period, np.zeros(k)
    F[:3] = (K_p, K_d / T, T**-2)[:k]
    corrected = np.eye(k)
    corrected[:, 0] -= o.L
    M = (o.Phi - np.outer(o.Gamma, F)) @ corrected
    # where y makes a = 0, Z after the correction is 1 - L F / (F L) times (1 - L C_1) Z
    FL = F @ o.L
    zeros = (o.Phi - np.outer(o.Gamma, F)) @ (np.eye(k) - np.outer(o.L, F) / FL) @ corrected
    num, chi, den = (np.asarray(np.poly(x), float) for x in (zeros, o.Phi @ corrected, M))
    return TransferFunctions(FL * num, chi, den)
