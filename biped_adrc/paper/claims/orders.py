"""One extended state against the paper's seven: gains, what they do to noise, and the error left."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from biped_adrc.observer_design.observer_loop import observer_loop
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.paper.claims.admissible import Member, declared
from biped_adrc.paper.claims.tally import AtTwoSteps
from biped_adrc.paper.claims.walks import walked

SLOW = 2.0 * np.pi * 5.0
"""[rad/s], a disturbance of 5 Hz."""


class Order(NamedTuple):
    """An observer and what it costs."""

    name: str
    m: int
    bandwidth: float
    """Geometric mean of the poles [rad/s]."""
    largest_gain: float
    """max |l_k|, l_0 here, in the units of (17)."""
    noise_gain: float
    """Largest acceleration asked for per error of measured position [1/s^2]."""
    delay_margin: float
    """[s]."""
    slow: float
    """Tracking error at 5 Hz per unit of disturbance [s^2]."""
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
    return observer_loop(observer).delay_margin().delay


def bandwidth_with(margin: float, m: int) -> float:
    """Of m + 2 equal poles [rad/s] with this delay margin [s]."""

    def excess(log_w: float) -> float:
        return float(np.log(_margin(GPIObserver.from_bandwidth(np.exp(log_w), m)) / margin))

    return float(np.exp(brentq(excess, np.log(10.0), np.log(1e6))))


def _order(preset: str, name: str, observer: GPIObserver) -> Order:
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
    joints = ("q1", "q2", "q3", "q4")
    member = Member(preset, 30.0, 0.12, joints, 0.0, "model", "solved")
    run = member.run("ADRC", declared()["steps"]["ADRC"])
    poles = tuple(float(np.real(pole)) for pole in observer.poles)
    return walked(replace(run, poles=poles)).peak
