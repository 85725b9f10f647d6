"""The delay margin of the linear loop compared with the walking robot, and an observer with encoders.

`DelayCase` walks with the torque late by a share of the margin, in continuous time, from the orbit of the
gait with one rate off by NUDGE. It tracks when it finishes and its errors do not grow from step to step:

    max |q_b - h| of the last two steps < GROWTH * that of the step after the first impact

The linear loop takes kappa u(t - d) for what is kappa(q(t)) u(t - d), and its reference moves by itself, while
Theta moves with the joints: `robot_margin` finds by bisection where the robot itself stops tracking.

`loop` computes margins from transfer functions and never walks; this module gives the proof in
simulation. Called by `biped-adrc observer` and by users who design an observer.

    case = DelayCase(biped, gait, GPIObserver.from_bandwidth(300.0, 1))
    case.margin, case.walked(BELOW * case.margin).tracks, case.walked(ABOVE * case.margin).tracks
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.observer.loop import ObserverLoop
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.delayed import Delayed
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array
from biped_adrc.engine.run import COMPILED, simulate_by
from biped_adrc.gait.gait import Gait
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.observers.gpi import GPIObserver

IMPACTS = 6
"""Impacts of each walk of a check."""
NUDGE = 1e-3
"""Added to q_1' at the start [rad/s], so that an unstable loop has something to grow from."""
GROWTH = 3.0
"""Growth of the error over the walk from which on it counts as diverging; near its margin the loop's
oscillation beats with the impacts, which alone changes the error by a factor of up to 2."""
BELOW, ABOVE = 0.95, 1.05
"""Delays of the two walks, as shares of the margin."""
ORDER = 4
"""Of the rational approximant of the delay."""
LOW, HIGH, RESOLUTION = 0.8, 1.2, 2e-3
"""Interval of the bisection for the robot's own margin and its resolution, as shares of the linear margin."""
LONGEST_STEP, REACH = 1e-4, 0.5
"""Longest step h of RK4 [s], and largest h |p| for the fastest pole of observer and delay line; RK4 is stable
up to
2.8."""


@dataclass(frozen=True)
class CheckedWalk:
    """A walk with a delay or with encoders, reduced to its errors."""

    condition: str
    """Delay or encoders, in words."""
    status: Status
    errors: Array
    """max |q_b - h| of each single support that was begun (M,) [rad]."""

    @property
    def tracks(self) -> bool:
        """True where the walk finished and its errors did not grow by GROWTH."""
        if self.status is not Status.COMPLETED or len(self.errors) < 3:
            return False
        return bool(np.max(self.errors[-2:]) < GROWTH * self.errors[1])

    @property
    def amplitude(self) -> float:
        """max |q_b - h| over the second half of the steps [rad]: the size of a limit cycle."""
        return float(np.max(self.errors[len(self.errors) // 2 :]))


class DelayCase(NamedTuple):
    """A robot, a gait and ADRC with an observer and gains, to be walked with delayed torque."""

    biped: Biped
    gait: Gait
    observer: GPIObserver
    gains: Gains = TABLE_II
    known: bool = False
    """Whether the observer knows the delay."""
    impacts: int = IMPACTS

    @property
    def margin(self) -> float:
        """Delay margin of the linear loop of one joint [s]."""
        return ObserverLoop(self.observer, self.gains).delay_margin(self.known).delay

    def walked(
        self, delay: float, order: int = ORDER, torque_limit: float | None = None
    ) -> CheckedWalk:
        """A walk whose torque acts `delay` [s] late, by an approximant of that order.

        torque_limit: [N m], applied to the torque that the controller asks for and to the one that acts.
        """
        inner = ADRCController(self.gait.constraint, self.observer, self.gains)
        controller = Delayed(inner, delay, order, self.known, torque_limit)
        walker = Walker(self.biped, controller, torque_limit=torque_limit)
        q, v = self.gait.start(self.biped)
        v = v + NUDGE * (np.arange(len(v)) == 0)
        poles = np.roots(controller.pade[1][::-1]) / delay
        fastest = max(np.max(np.abs(x)) for x in (poles, self.observer.poles))
        run = _walk(walker, q, v, self.impacts, RK4(min(LONGEST_STEP, REACH / float(fastest))))
        limit = "no torque limit" if torque_limit is None else f"within {torque_limit:g} N m"
        words = f"{1e6 * delay:.4g} us {'known' if self.known else 'hidden'}, {limit}"
        return CheckedWalk(words, run.status, step_errors(self.gait, run))


def robot_margin(case: DelayCase) -> float:
    """The delay [s] at which the robot stops tracking, by bisection to RESOLUTION of the linear margin.

    nan where the robot does not track at LOW times the linear margin, or still does at HIGH times it.
    """
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
) -> CheckedWalk:
    """A walk in sampled time with encoders on all angles, exact rates and the torque limit of the robot's
    record.

    period: of sampling [s]. counts: per revolution, None for exact angles. delay: from a sample instant to the
    torque's effect [s]. known: whether the observer knows it. Rates are exact, so that the errors show the
    observer alone: differences of counts would disturb the rate of the reference, which no observer filters.
    """
    walker = Walker(
        biped,
        ADRCController(gait.constraint, observer, gains),
        timing=SampledTime(period, delay=delay, delay_known=known),
        torque_limit=biped.description.peak_torque,
        sensors=Sensors(counts=counts, velocity="measured"),
    )
    run = _walk(walker, *gait.start(biped), impacts, RK4(min(5e-4, 0.25 * period)))
    encoders = "exact angles" if counts is None else f"{counts:g} counts"
    words = f"{1.0 / period:.0f} Hz, {encoders}, delay {1e6 * delay:.4g} us"
    return CheckedWalk(words, run.status, step_errors(gait, run))


def _walk(walker: Walker, q: Array, v: Array, impacts: int, method: RK4) -> Trajectory:
    x, t_end = walker.initial_state(q, v), impacts * walker.max_step_time
    return simulate_by(COMPILED, walker, x, Mode(), method, impacts=impacts, t_end=t_end)


def step_errors(gait: Gait, trajectory: Trajectory) -> Array:
    """max |q_b - h(Theta)| of each single support (M,) [rad], over the stored nodes of a trajectory."""
    h, n = gait.constraint, len(gait.constraint.phase)
    angles = (arc.x[:, :n] for arc in trajectory.arcs)
    return np.array([np.max(np.abs(q[:, : n - 1] - h.over(q @ h.phase))) for q in angles])
