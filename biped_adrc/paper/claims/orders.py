"""Is the order of the observer worth it? One extended state against the seven of the paper (section III.A).

The paper says that more extended states avoid high gains. Two observers with m = 1 are compared with that of
Table I: one of the same bandwidth, one of the same delay margin, since a comparison of gains alone depends on
which of the two is kept. Linear closed forms give gains, noise and errors (`observer_design.observer_loop`);
the error under the push comes from a walk. Part of `claims.evidence`; judged in `rows_control.high_gains`.

The observer of order m estimates position, rate, xi and the first m - 1 derivatives of xi, with m + 2 poles: of
Table I there are nine, so that m = 7.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from biped_adrc.observer_design.observer_loop import observer_loop
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.paper.claims.admissible import Member, declared
from biped_adrc.paper.claims.tally import AtTwoSteps
from biped_adrc.paper.claims.walks import walked

SLOW = 2.0 * np.pi * 5.0
"""Frequency of a slow disturbance, 5 Hz [rad/s]."""


class Order(NamedTuple):
    """An observer, and what its order costs and gives."""

    name: str
    """For a reader."""
    m: int
    """Number of extended states: xi and its first m - 1 derivatives; the observer has m + 2 poles."""
    bandwidth: float
    """Geometric mean of the poles [rad/s]."""
    largest_gain: float
    """max |l_k|, in the units of (17)."""
    noise_gain: float
    """Largest gain from an error of the measured position to the acceleration asked for [1/s^2]."""
    delay_margin: float
    """Largest delay in the loop with which it is stable [s]."""
    slow: float
    """Amplitude of the tracking error at 5 Hz per unit of disturbance [s^2]."""
    worst: float
    """The same at the frequency where it is largest [s^2]."""
    pushed: AtTwoSteps
    """Peak error under the push [rad]."""


def orders(preset: str) -> tuple[Order, ...]:
    """Table I, and m = 1 with its bandwidth and with its delay margin."""
    table = GPIObserver.from_poles()
    same_bandwidth = GPIObserver.from_bandwidth(table.scale, 1)
    same_margin = GPIObserver.from_bandwidth(bandwidth_with(_margin(table), 1), 1)
    named = {
        "Table I": table,
        "m = 1, equal bandwidth": same_bandwidth,
        "m = 1, equal delay margin": same_margin,
    }
    return tuple(_order(preset, name, o) for name, o in named.items())


def _margin(observer: GPIObserver) -> float:
    """Delay margin [s]."""
    return observer_loop(observer).delay_margin().delay


def bandwidth_with(margin: float, m: int) -> float:
    """The position of m + 2 equal poles [rad/s] whose delay margin is `margin` [s], by root finding
    on log w.
    """

    def excess(log_w: float) -> float:
        return float(np.log(_margin(GPIObserver.from_bandwidth(np.exp(log_w), m)) / margin))

    return float(np.exp(brentq(excess, np.log(10.0), np.log(1e6))))


def _order(preset: str, name: str, observer: GPIObserver) -> Order:
    """The record of one observer."""
    loop, w = observer_loop(observer), np.geomspace(1.0, 1e7, 2000)
    return Order(
        name,
        observer.m,
        observer.scale,
        float(np.max(np.abs(observer.gains))),
        float(np.max(np.abs(loop.noise(w)))),
        _margin(observer),
        float(np.abs(loop.tracking_error(np.array([SLOW])))[0]),
        float(np.max(np.abs(loop.tracking_error(w)))),
        _pushed(preset, observer),
    )


def _pushed(preset: str, observer: GPIObserver) -> AtTwoSteps:
    """Peak error of ADRC with this observer under a push of 30 N m on all joints [rad]."""
    joints = ("q1", "q2", "q3", "q4")
    member = Member(preset, 30.0, 0.12, joints, 0.0, "model", "solved")
    run = member.run("ADRC", declared()["steps"]["ADRC"])
    poles = tuple(float(np.real(pole)) for pole in observer.poles)
    return walked(run.replace(controller={"observer": {"poles": poles}})).peak
