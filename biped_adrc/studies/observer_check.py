"""The delay margin of the linear loop held against a robot that walks, and an observer against its encoders.

`check_delay` walks with the torque late by a share of the margin, in continuous time, from the orbit of the
gait with one rate off by NUDGE. It tracks when it finishes and its errors do not grow from step to step:

    max |q_b - h| of the last two steps < GROWTH * that of the step after the first impact

The linear loop takes kappa u(t - d) for what is kappa(q(t)) u(t - d), and its reference moves by itself, while
Theta moves with the joints: `robot_margin` finds by bisection where the robot itself stops tracking.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.delayed import Delayed
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.observer_design.observer_loop import observer_loop
from biped_adrc.observer_design.observer_report import observer_name
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.scenario.walk import walk
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array

IMPACTS = 6
"""Of a check."""
NUDGE = 1e-3
"""[rad/s] on q_1' at the start, so that an unstable loop has something to grow from."""
GROWTH = 3.0
"""Of the error from step to step, beyond which a walk counts as diverging; the beat of a loop near its margin
with the impacts changes it by up to 2."""
BELOW, ABOVE = 0.95, 1.05
"""Shares of the margin that are walked with."""
ORDER, FINER = 4, 6
"""Of the approximant of the delay, and of the one it is held against."""
LONGEST_STEP, REACH = 1e-4, 0.5
"""[s] of RK4, and h times the fastest rate of observer and delay line, within 2.8 of its stability."""
LOW, HIGH, RESOLUTION = 0.8, 1.2, 2e-3
"""Shares of the linear margin between which the robot's own is looked for, and to what."""


@dataclass(frozen=True)
class Walked:
    """A walk with a delay or with encoders."""

    observer: str
    condition: str
    """In words."""
    status: Status
    errors: Array
    """max |q_b - h| of each step begun (M,) [rad]."""

    @property
    def tracks(self) -> bool:
        """Whether it finished without errors that grow."""
        if self.status is not Status.COMPLETED or len(self.errors) < 3:
            return False
        return bool(np.max(self.errors[-2:]) < GROWTH * self.errors[1])

    @property
    def amplitude(self) -> float:
        """max |q_b - h| of the second half of the steps [rad]."""
        return float(np.max(self.errors[len(self.errors) // 2 :]))


class DelayCheck(NamedTuple):
    """What the robot says of one margin."""

    observer: str
    known: bool
    margin: float
    """Of the linear loop [s]."""
    below: Walked
    """At BELOW of it."""
    above: Walked
    """At ABOVE of it."""
    robot_margin: float
    """[s], where the robot stops tracking; nan if far from the margin."""
    order_effect: float
    """Largest change of a step's error [rad] with an approximant of order FINER, at BELOW."""
    limited: Walked
    """At ABOVE with the torque limit of the robot's record: a limit cycle or a fall."""

    @property
    def confirmed(self) -> bool:
        """Tracks below the margin and diverges above it."""
        return self.below.tracks and not self.above.tracks

    @property
    def shift(self) -> float:
        """Of the robot's margin against the linear one, as a share of it."""
        return self.robot_margin / self.margin - 1.0


class DelayCase(NamedTuple):
    """A robot, a gait and a controller, to be walked with delays."""

    biped: Biped
    gait: Gait
    observer: GPIObserver
    gains: Gains = TABLE_II
    known: bool = False
    impacts: int = IMPACTS

    @property
    def margin(self) -> float:
        """Of the linear loop of the first joint [s]."""
        return observer_loop(self.observer, self.gains).delay_margin(self.known).delay

    def walked(self, delay: float, order: int = ORDER, torque_limit: float | None = None) -> Walked:
        """A walk with that delay [s]; the limit acts on what is asked for and on what acts."""
        inner = ADRCController(self.gait.constraint, self.observer, self.gains)
        controller = Delayed(inner, delay, order, self.known, torque_limit)
        walker = Walker(self.biped, controller, torque_limit=torque_limit)
        q, v = self.gait.start(self.biped)
        v = v + NUDGE * (np.arange(len(v)) == 0)
        h = _step(self.observer, controller)
        run = walk(walker, self.gait, self.impacts, RK4(h), start=(q, v), engine="compiled")
        limit = "no torque limit" if torque_limit is None else f"within {torque_limit:g} N m"
        words = f"{1e6 * delay:.4g} us {'known' if self.known else 'hidden'}, {limit}"
        name, errors = observer_name(self.observer), step_errors(self.gait, run.trajectory)
        return Walked(name, words, run.trajectory.status, errors)


def check_delay(case: DelayCase) -> DelayCheck:
    """The linear margin against walks below and above it. Raises InputError for a loop that has none."""
    margin = case.margin
    if not (math.isfinite(margin) and margin > 0.0):
        raise InputError(
            f"the linear loop's delay margin is {margin} s, expected a positive number; nothing to confirm"
        )
    below, finer = (case.walked(BELOW * margin, order) for order in (ORDER, FINER))
    count = min(len(below.errors), len(finer.errors))
    change = float(np.max(np.abs(below.errors[:count] - finer.errors[:count])))
    limited = case.walked(ABOVE * margin, torque_limit=case.biped.description.peak_torque)
    walks = (below, case.walked(ABOVE * margin), robot_margin(case), change, limited)
    return DelayCheck(observer_name(case.observer), case.known, margin, *walks)


def robot_margin(case: DelayCase) -> float:
    """The delay [s] at which the robot stops tracking, by bisection; nan if not in LOW to HIGH."""
    margin, low, high = case.margin, LOW, HIGH
    if not case.walked(low * margin).tracks or case.walked(high * margin).tracks:
        return math.nan
    while high - low > RESOLUTION:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if case.walked(middle * margin).tracks else (low, middle)
    return 0.5 * (low + high) * margin


def check_encoders(
    biped: Biped,
    gait: Gait,
    observer: GPIObserver,
    gains: Gains = TABLE_II,
    *,
    period: float,
    counts: float | None,
    delay: float = 0.0,
    known: bool = False,
    impacts: int = 25,
) -> Walked:
    """A walk at ticks with encoders on all angles, exact rates and the torque limit of the robot's record.

    Rates are exact so that what is seen is the observer's doing: differences of counts shake the reference's
    rate, which no observer filters.
    """
    walker = Walker(
        biped,
        ADRCController(gait.constraint, observer, gains),
        timing=SampledTime(period, delay=delay, delay_known=known),
        torque_limit=biped.description.peak_torque,
        sensors=Sensors(counts=counts, velocity="measured"),
    )
    run = walk(walker, gait, impacts, RK4(min(5e-4, 0.25 * period)), engine="compiled")
    seen = "exact angles" if counts is None else f"{counts:g} counts"
    words = f"{1.0 / period:.0f} Hz, {seen}, delay {1e6 * delay:.4g} us"
    errors = step_errors(gait, run.trajectory)
    return Walked(observer_name(observer), words, run.trajectory.status, errors)


def step_errors(gait: Gait, trajectory: Trajectory) -> Array:
    """max |q_b - h(Theta)| of each single support (M,) [rad], at the stored instants."""
    h, n = gait.constraint, len(gait.constraint.phase)
    p = n - 1

    def error(x: Array) -> float:
        return float(np.max(np.abs(x[:p] - h.h(float(h.phase @ x[:n]))[0])))

    return np.array([max(error(x) for x in arc.x) for arc in trajectory.arcs])


def _step(observer: GPIObserver, controller: Delayed) -> float:
    """h [s] of RK4, by the fastest rate of the observer and the line."""
    line = controller.line
    rates = np.abs(np.roots(line.denominator[::-1])) * line.rate
    fastest = max(float(np.max(rates)), float(np.max(np.abs(observer.poles))))
    return min(LONGEST_STEP, REACH / fastest)
