"""A quantity that relaxes to a constant, in an RK4 step of length h [s]: exactly, however short tau [s] is.

y is its distance from the constant, such as the torque of a lagging motor minus the command: y' = -y / tau.

    y(t + c h) = e^(-theta c) y(t),   theta = h / tau,   0 <= c <= 1

The stages of RK4 for a motion driven by y lie at c = 0, 1/2 and 1 and miss what decays in between. In place of
e^(-theta c) they use the quadratic P(c) with the same moments:

    integral of c^j (e^(-theta c) - P(c)) dc = 0,   j = 0, 1, 2

Then the step keeps its order 4 for every tau. The fast decay after a jump of the constant adds an error of
h^2 tau / 24 times the second derivative of the response. It goes to zero with tau, and for tau = 0 the step is
the one without y.

The compiled loops are made from the text of this file too (`engine.kernels.load`).
"""

from __future__ import annotations

import math


def relaxation(theta: float) -> tuple[float, float, float, float]:
    """P(0), P(1/2), P(1) and e^(-theta), each a factor [1] of y(t), for theta = h / tau >= 0 [1].

    The moments m_j = integral of c^j e^(-theta c) dc over 0 <= c <= 1 follow from each other by parts: upwards
    where theta is large, and downwards from a series of m_2 where it is small; the other direction would lose
    digits.
    """
    end = math.exp(-theta)
    if theta < 1.0:
        # m_2 = e^(-theta) (1/3 + theta/(3 4) + theta^2/(3 4 5) + ..); 18 terms more are enough for theta < 1
        term = m2 = end / 3.0
        for k in range(4, 22):
            term *= theta / k
            m2 += term
        m1 = 0.5 * (theta * m2 + end)
        m0 = theta * m1 + end
    else:
        m0 = (1.0 - end) / theta
        m1 = (m0 - end) / theta
        m2 = (2.0 * m1 - end) / theta
    # P(c) = m0 + a1 (2 c - 1) + a2 (6 c^2 - 6 c + 1), in the Legendre polynomials of 0 <= c <= 1
    a1, a2 = 3.0 * (2.0 * m1 - m0), 5.0 * (6.0 * m2 - 6.0 * m1 + m0)
    return m0 - a1 + a2, m0 - 0.5 * a2, m0 + a1 + a2, end
