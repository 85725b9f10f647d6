"""What a GPI observer demands of a robot's encoders, sampling and motors, and which one they allow.

`observer_report` puts together what the linear loop of one joint says: gains and conditioning,
transfer functions, delay margins, the largest stable period, the torque noise of one encoder count,
the peak after an impact, and the largest bandwidth of each order that the robot allows. The numbers
come from the other modules of this folder, each computed when first asked for; `observer_tables`
turns them into text. The command `biped-adrc observer` calls it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.observer_design.observer_choice import (
    ORDERS,
    Hardware,
    OnHardware,
    Recommended,
    recommend,
    without_observer,
)
from biped_adrc.observer_design.observer_impact import ImpactStates, orbit_impact
from biped_adrc.observer_design.observer_loop import bandwidth
from biped_adrc.observer_design.observer_sampled import largest_delay, largest_period
from biped_adrc.observer_design.observer_tables import Section, sections, verdict
from biped_adrc.observers.base import Observer
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array, ComplexArray

COUNTS = 8192.0
"""Counts of RABBIT's encoders per revolution."""
PERIOD = 1.5e-3
"""Sampling period of RABBIT's controller [s]."""


class Response(NamedTuple):
    """Magnitude of one transfer function: at low frequency, at its peak, and where it falls off.

    The unit of `low` and `peak` is that of the transfer function.
    """

    low: float
    """At the lowest frequency of the grid."""
    peak: float
    """Largest value."""
    at: float
    """Frequency of the peak [rad/s]."""
    bandwidth: float
    """Where it is 3 dB below [rad/s]: below `low` for xi^ / xi, below the peak for the others."""


@dataclass(frozen=True)
class ObserverReport(OnHardware):
    """All numbers for one observer, the gains of one joint and a robot; `text()` shows them."""

    robot: str = field(kw_only=True)
    """Name and preset of the robot."""
    impact: ImpactStates = field(kw_only=True)
    """Impact of the gait's periodic orbit."""

    @cached_property
    def sampled_margins(self) -> tuple[float, float]:
        """The largest stable delay [s] at this period, unknown and known to the observer."""
        hidden, known = (largest_delay(replace(self.sampled(), known=k)) for k in (False, True))
        return hidden, known

    @cached_property
    def largest_periods(self) -> dict[str, tuple[float, float]]:
        """The largest stable period [s], for a delay unknown and known, by delay."""
        return {
            "no delay": self._periods(0.0),
            "a delay of one period": self._periods(1.0),
        }

    def _periods(self, delay_periods: float) -> tuple[float, float]:
        """The largest stable periods [s] with a delay of that many periods, unknown and known."""
        loop, told = self.sampled(), (False, delay_periods > 0.0)
        hidden, known = (largest_period(replace(loop, known=k), delay_periods) for k in told)
        return hidden, known

    @cached_property
    def spectral_radius(self) -> float:
        """Of the sampled loop at this period and delay, dimensionless; below 1 if it is stable."""
        return self.sampled().spectral_radius

    @property
    def frequencies(self) -> Array:
        """Grid (2000,) [rad/s] for the responses, from far below the slowest pole to far above the fastest."""
        rates = np.abs(self.observer.poles)
        slow = min(rates.min(), math.sqrt(self.loop.K_p))
        return np.geomspace(0.01 * slow, 100.0 * max(rates.max(), self.loop.K_d), 2000)

    @cached_property
    def responses(self) -> dict[str, Response]:
        """Of xi to e [s^2], of xi to xi^ [1], and of the measurement's error to the torque [N m/rad]."""
        grid = self.frequencies

        def torque(frequency: Array) -> ComplexArray:
            return self.loop.noise(frequency) * self.hardware.inertia

        found = {}
        for name, f in (
            ("e / xi", self.loop.tracking_error),
            ("xi^ / xi", self.loop.estimate),
            ("u / n", torque),
        ):
            level = np.abs(f(grid))
            top = int(np.argmax(level))
            start = grid[0] if name == "xi^ / xi" else grid[top]
            edge = bandwidth(f, start, grid[-1]) if level[top] > 0.0 else math.nan
            found[name] = Response(
                float(level[0]), float(level[top]), float(grid[top]), float(edge)
            )
        return found

    @cached_property
    def recommended(self) -> tuple[Recommended, ...]:
        """For each m of ORDERS the largest bandwidth that encoders, period and delay allow."""
        return tuple(recommend(self.hardware, self.gains, m) for m in ORDERS)

    @property
    def runs(self) -> bool:
        """Whether it is allowed: stable for all KAPPA_RATIOS, the ripple within SHARE of the limit.

        Not whether it is of use: see `against_none`.
        """
        return not self.obstacle

    @cached_property
    def against_none(self) -> float:
        """Tracking error that a 5 Hz disturbance leaves, relative to that with K_p and K_d alone."""
        return self.rejection / without_observer(self.gains)

    @property
    def verdict(self) -> str:
        """Whether the observer can run on this robot, in words, with the numbers that decide."""
        return verdict(self)

    @property
    def sections(self) -> list[Section]:
        """The tables."""
        return sections(self)

    @property
    def name(self) -> str:
        """The observer in words."""
        return observer_name(self.observer)

    def text(self) -> str:
        """The verdict and the tables it is based on."""
        tables = ("\n".join(section.lines()) for section in sections(self))
        return "\n\n".join((self.verdict, *tables))


def observer_report(
    observer: GPIObserver | Sequence[complex],
    gains: Gains = TABLE_II,
    period: float = PERIOD,
    *,
    robot: Biped,
    gait: Gait,
    counts: float = COUNTS,
    delay: float = 0.0,
    known: bool = False,
) -> ObserverReport:
    """The report of an observer, or of poles [rad/s], on a robot that walks a gait.

    period [s]: of the sampling; counts: of the encoders per revolution; delay [s]: from a sample
    instant to its torque, `known` to the observer or not. Of gains with one number per joint those
    of the first count. Raises InputError for what is impossible, and names it.
    """
    if isinstance(observer, Observer) and not isinstance(observer, GPIObserver):
        raise InputError(
            f"a report on a {type(observer).__name__} was asked for, expected a GPIObserver in continuous "
            "time or its poles [rad/s]"
        )
    if not isinstance(observer, GPIObserver):
        observer = GPIObserver.from_poles(observer)
    SampledTime(period, delay=delay)
    if not (math.isfinite(counts) and counts >= 1.0):
        raise InputError(f"the encoders have {counts} counts per revolution, expected at least 1")
    gains.check(robot.p)
    hardware = Hardware(
        period,
        delay,
        known,
        float(counts),
        robot.description.peak_torque,
        worst_inertia(robot, gait),
    )
    OnHardware(hardware, observer, gains).sampled()  # refuses an order that round-off spoils
    name = f"{robot.description.name} ({robot.preset})"
    impact = orbit_impact(robot, gait, observer.order)
    return ObserverReport(hardware, observer, gains, robot=name, impact=impact)


def worst_inertia(biped: Biped, gait: Gait) -> float:
    """The largest sqrt(sum_j (kappa^-1)_ij^2) over joints i and along the gait [kg m^2].

    It turns independent errors of the commanded accelerations into the torque of the worst joint.
    """
    still = np.zeros(biped.n)
    along = ZeroDynamics.of(biped, gait.constraint).q
    return float(
        max(np.max(np.linalg.norm(biped.reduction(q, still).kappa_inverse, axis=1)) for q in along)
    )


def observer_name(observer: GPIObserver) -> str:
    """The observer for a heading: Table I, or m and the poles [rad/s]."""
    if observer.poles == GPIObserver.from_poles().poles:
        return "Table I"
    first = observer.poles[0]
    if all(pole == first for pole in observer.poles):
        return f"m = {observer.m} at {-first.real:g} rad/s"
    slow, fast = (f(abs(pole) for pole in observer.poles) for f in (min, max))
    return f"m = {observer.m} with poles of {slow:g} to {fast:g} rad/s"
