"""One joint under sampled ADRC beside pyadrc and python-control, on the same plant.

pyadrc has the second-order law with m = 1 in state space, and by coefficients of transfer functions (Herbst:
A minimum-footprint implementation of discrete-time ADRC, 2021), written by others from the papers: w_c is the
bandwidth of the feedback, K_p = w_c^2, K_d = 2 w_c, and its observer has its poles at -k w_c. The plant is a
double integrator, exact under a held input. Called by `validation.groups`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import control
import numpy as np
import pyadrc

from biped_adrc.analysis.observer.loop import ObserverLoop
from biped_adrc.analysis.observer.transfer import transfer_functions
from biped_adrc.control.tracking import Gains
from biped_adrc.core.types import Array
from biped_adrc.observers.gpi import GPIObserver
from validation.row import Row, nothing

T, W_C, K, KAPPA = 1e-3, 30.0, 10.0, 2.5
"""Period [s], w_c [rad/s], k [1], and kappa [1/(kg m^2)]."""
GAINS = Gains(W_C**2, 2.0 * W_C)
OBSERVER = GPIObserver.from_bandwidth(K * W_C, 1)
SYSTEM = f"joint under ADRC, m = 1 at {K * W_C:g} rad/s, T = 1 ms"
PYADRC = f"pyadrc {pyadrc.__version__}"
CONTROL = "python-control"
Law = Callable[[float, float], float]
"""u(y, r) [N m]: torque for a measured angle and a reference [rad], at each tick once."""


def pyadrc_rows() -> tuple[Row, ...]:
    """Gains of the observer, coefficients of C(z), and a step of the reference with a step of the load."""
    other = pyadrc.StateSpace(2, T, KAPPA, W_C, K)
    L = OBSERVER.sampled(T).L / T ** np.arange(3)  # in physical units
    names = ("l_1", "l_2 [1/s]", "l_3 [1/s^2]")
    gains = (
        Row(SYSTEM, name, x, y, 1e-12, PYADRC)
        for name, x, y in zip(names, other.L.ravel(), L, strict=True)
    )
    # a = K_p r - (G y + B u) / A, so num / den = G / (A + B)
    c, f = pyadrc.FeedbackTF(2, T, KAPPA, W_C, K).coeff, transfer_functions(OBSERVER, GAINS, T)
    G = KAPPA * np.array([c["g0"], c["g1"], c["g2"], 0.0])
    A = np.array([1.0, c["a1"], c["a2"], c["a3"]])
    den = A + np.array([0.0, c["b0"], c["b1"], c["b2"]])
    gap = {
        "C(z), over its first": (f.num - G) / G[0],
        "V(z)": f.chi - A,
        "the denominator": f.den - den,
    }
    words = "coefficients of {}, largest difference"
    coefficients = (
        nothing(SYSTEM, words.format(name), np.max(np.abs(x)), 1e-11, PYADRC)
        for name, x in gap.items()
    )
    by_pyadrc, own = (stepped(law) for law in (other_law(other), own_law()))
    far = np.max(np.abs(by_pyadrc - own))
    walk = nothing(SYSTEM, "step response, largest difference [rad]", far, 1e-9, PYADRC)
    return (*gains, *coefficients, walk)


def other_law(other: Any) -> Law:
    """The law of pyadrc, which is told its last u."""
    last = [0.0]

    def u(y: float, r: float) -> float:
        last[0] = float(other(y, last[0], r))
        return last[0]

    return u


def own_law() -> Law:
    """The law by the sampled observer of the package."""
    o = OBSERVER.sampled(T)
    state = [np.zeros((3, 1))]

    def u(y: float, r: float) -> float:
        z = o.correct(state[0], np.array([y]))
        x = o.estimate(z)
        a = GAINS.K_p * (r - x.position) - GAINS.K_d * x.velocity - x.disturbance
        state[0] = o.predict(z, a)
        return float(a[0]) / KAPPA

    return u


def stepped(law: Law, ticks: int = 2000) -> Array:
    """Angles (ticks,) [rad] under a reference of 1 rad, and 3 rad/s^2 from outside in the second half."""
    q = v = 0.0
    angles = np.zeros(ticks)
    for i in range(ticks):
        angles[i] = q
        a = KAPPA * law(q, 1.0) + 3.0 * (i >= ticks // 2)
        q, v = q + T * v + 0.5 * T**2 * a, v + T * a
    return angles


def control_rows() -> tuple[Row, ...]:
    """The delay margin in continuous time, from the loop as python-control connects it."""
    f = transfer_functions(OBSERVER, GAINS)
    _, phase, _, at = control.margin(control.tf(f.num, np.append(f.den, [0.0, 0.0])))
    found, margin = ObserverLoop(OBSERVER, GAINS).delay_margin(), float(np.radians(phase) / at)
    return (
        Row(SYSTEM, "delay margin, continuous time [s]", margin, found.delay, 1e-6, CONTROL),
        Row(SYSTEM, "its frequency [rad/s]", float(at), found.frequency, 1e-6, CONTROL),
    )
