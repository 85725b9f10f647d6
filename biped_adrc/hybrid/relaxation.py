"""A quantity that goes to a constant, y' = -y / tau, in a step of length h: exactly, however short tau is.

    y(t + c h) = e^(-theta c) y(t),   theta = h / tau,   0 <= c <= 1

A motion driven by y has its stages at c = 0, 1/2 and 1, which miss what decays in between. They are given the
quadratic P(c) with the same moments instead:

    integral of c^j (e^(-theta c) - P(c)) dc = 0,   j = 0, 1, 2

Then a classical step of order 4 stays one for every tau. What the layer after a break adds to its error,
h^2 tau / 24 times the second derivative of the response, goes to zero with tau, where the step is the one
without y.

The compiled loops have this file in their text (`engine.kernels.load`).
"""

from __future__ import annotations

import math


def relaxation(theta: float) -> tuple[float, float, float, float]:
    """P(0), P(1/2), P(1) and e^(-theta), for theta >= 0 [1].

    The moments m_j = integral of c^j e^(-theta c) follow from each other by parts, upwards where theta is
    large and downwards from a series where it is small.
    """
    end = math.exp(-theta)
    if theta < 1.0:
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
    a1, a2 = 3.0 * (2.0 * m1 - m0), 5.0 * (6.0 * m2 - 6.0 * m1 + m0)
    return m0 - a1 + a2, m0 - 0.5 * a2, m0 + a1 + a2, end
