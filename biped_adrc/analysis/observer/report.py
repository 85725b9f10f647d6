"""What a GPI observer demands of a robot's encoders, sampling and motors, and which one they allow.

`observer_report` computes from the linear loop of one joint: gains and conditioning, transfer functions, delay
margins, the largest stable period, the torque noise of one encoder count, the peak after an impact, and the
largest bandwidth of each order that the robot allows. Each number is computed at its first use. `verdict` and
`sections` present them in words and tables. A delay is "unknown" where the observer is fed with the command,
"known" where it is fed with the torque that acts.

    e, u, n        tracking error [rad], torque [N m], error of the measured angle [rad]
    xi, xi^        total disturbance [rad/s^2] and its estimate; kappa is the input gain, q_b'' = kappa u + xi
    x1^, x2^       estimates of angle and velocity
    m              order: number of the observer's states for xi and its derivatives; it has m + 2 poles
    K_p, K_d       gains of the feedback on angle and velocity, which works without an observer too
    ripple         rms torque [N m] that the error of one encoder count causes
    Table I        the poles that the paper uses
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.observer.choice import KAPPA_RATIOS, SHARE, Hardware, OnHardware
from biped_adrc.analysis.observer.impact import ImpactStates, impact_peak, orbit_impact
from biped_adrc.analysis.observer.loop import largest_delay, largest_period
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.core.shown import columns
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.observers.base import ResetPolicy
from biped_adrc.observers.gpi import GPIObserver

COUNTS = 8192.0
"""Counts of RABBIT's encoders per revolution."""
PERIOD = 1.5e-3
"""Sampling period of RABBIT's controller [s]."""
ALLOWED = "m", "bandwidth", "limited by", "rms torque", "delay margin", "|e / xi| at 5 Hz [s^2]"
"""Columns of the table of allowed bandwidths."""


class _Section(NamedTuple):
    """A table as text: its title, the headings of its columns, and its rows."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def lines(self) -> list[str]:
        """Title, header and rows, in columns of equal width."""
        return [self.title, *(f"  {line}" for line in columns((self.header, *self.rows)))]


@dataclass(frozen=True)
class ObserverReport(OnHardware):
    """All numbers for one observer, the gains of one joint and a robot; `text()` presents them."""

    robot: str = field(kw_only=True)
    """Name and preset of the robot."""
    impact: ImpactStates = field(kw_only=True)
    """Impact of the gait's periodic orbit."""

    # -- numbers -------------------------------------------------------------------------------------
    @cached_property
    def sampled_margins(self) -> tuple[float, float]:
        """The largest stable delays [s] at this period: one that is unknown to the observer, and a known one.

        NaN where the loop is unstable without a delay, infinite where none is found.
        """
        unknown, known = (largest_delay(replace(self.sampled(), known=k)) for k in (False, True))
        return unknown, known

    @property
    def runs(self) -> bool:
        """Whether the observer is allowed: stable for all KAPPA_RATIOS, the ripple within SHARE of the limit.

        It may be allowed and still of no use: see `against_none`.
        """
        return not self.obstacle

    @cached_property
    def against_none(self) -> float:
        """Tracking error that a 5 Hz disturbance leaves, over the error with K_p and K_d alone [1]; above 1 the
        observer does harm.
        """
        return self.rejection / self.without_observer

    # -- words ---------------------------------------------------------------------------------------
    @property
    def name(self) -> str:
        """Name of the observer: "Table I", or m and the poles [rad/s]."""
        poles, m = self.observer.poles, self.observer.m
        if poles == GPIObserver.from_poles().poles:
            return "Table I"
        if all(pole == poles[0] for pole in poles):
            return f"m = {m} at {-poles[0].real:g} rad/s"
        slow, fast = (f(abs(pole) for pole in poles) for f in (min, max))
        return f"m = {m} with poles of {slow:g} to {fast:g} rad/s"

    @property
    def verdict(self) -> str:
        """Whether the observer can run on this robot, in words, with the numbers that decide.

        "cannot run": unstable, or torque noise above the limit. "can run, but": more noise than SHARE,
        or a worse rejection than without an observer.
        """
        k, limit = self.hardware, self.hardware.torque_limit
        share, unstable = self.ripple / limit, self.obstacle == "stability"
        part = f"{100.0 * share:.3g} % of" if share <= 1.0 else f"{share:.3g} times"
        ripple = f"{self.ripple:.4g} N m rms"
        noise = f"one encoder count makes {ripple}, {part} the limit of {limit:g} N m"
        # sampled_margins: (unknown delay, known delay)
        margin = milliseconds(self.sampled_margins[int(k.known)])
        bears = f"with the model's kappa its delay margin at this period is {margin}"
        # _unstable, _use: sentences about the kappa that makes it unstable, and about the error it leaves
        facts = [noise] if math.isfinite(share) else []
        facts += [self._unstable(), bears] if unstable else [bears, self._use()]
        word = "can run"
        if unstable or share > 1.0:
            word = "cannot run"
        elif not self.runs:
            word = f"can run, but not well, with more than {100.0 * SHARE:g} % of the limit,"
        elif self.against_none > 1.0:
            word = "can run, but is worse than no observer,"
        where = f"{self.robot} at {1.0 / k.period:.0f} Hz with {k.counts:g} counts per revolution"
        return f"{self.name} {word} on {where}: {'; '.join(facts)}"

    def _unstable(self) -> str:
        """Sentence with the ratio of the robot's kappa to the model's that makes the sampled loop unstable."""
        (ratio, radius), late = self.weakest, 1e3 * self.hardware.delay
        return (
            f"with a delay of {late:g} ms and {ratio:g} times the model's kappa the sampled loop is unstable,"
            f" spectral radius {radius:.4g} (stability is asked for from {KAPPA_RATIOS[0]:g} to "
            f"{KAPPA_RATIOS[-1]:g} times)"
        )

    def _use(self) -> str:
        """Sentence with the error that the observer leaves, relative to a loop without it."""
        times = self.against_none
        error = f"a 5 Hz disturbance leaves {times:.2g} times the error of K_p and K_d alone"
        if self.observer.m == 0:
            error += "; with m = 0 no disturbance is estimated, and the weight is not compensated"
        return error

    # -- tables --------------------------------------------------------------------------------------
    @property
    def sections(self) -> list[_Section]:
        """All tables: gains, stability, estimate, impact and allowed bandwidths."""
        return [self._gains(), self._stability(), self._estimate(), self._impact(), self._allowed()]

    def text(self) -> str:
        """The verdict and the tables it is based on."""
        tables = ("\n".join(section.lines()) for section in self.sections)
        return "\n\n".join((self.verdict, *tables))

    def _gains(self) -> _Section:
        """Table of the gains l of (19) of the paper, physical [1/s^i] and scaled (dimensionless)."""
        o = self.observer
        rows = (
            (f"l_{o.m + 1 - i} [1/s^{i + 1}]", f"{physical:.6g}", f"{scaled:.6g}")
            for i, (physical, scaled) in enumerate(zip(o.gains, o.scaled_gains, strict=True))
        )
        title = f"Gains of the observer; states scaled by w = {o.scale:.6g} rad/s"
        return _Section(title, ("", "physical", "scaled"), tuple(rows))

    def _stability(self) -> _Section:
        """Table of delay margins and largest periods, for an unknown and for a known delay."""
        margins = [self.loop.delay_margin(known) for known in (False, True)]
        loop, period = self.sampled(), milliseconds(self.hardware.period)
        rows = [
            ("delay margin, continuous", *(milliseconds(m.delay) for m in margins)),
            ("  root on the axis at", *(of_stable(m.frequency, "rad/s") for m in margins)),
            (f"delay margin, period {period}", *map(milliseconds, self.sampled_margins)),
        ]
        for name, late in (("no delay", 0.0), ("a delay of one period", 1.0)):
            # without a delay there is nothing to know, and both columns have the same loop
            known = (replace(loop, known=k and late > 0.0) for k in (False, True))
            periods = (milliseconds(largest_period(one, late)) for one in known)
            rows.append((f"largest period, {name}", *periods))
        title = "Stability of the linear loop, kappa as in the model"
        return _Section(title, ("", "unknown delay", "known delay"), tuple(rows))

    def _estimate(self) -> _Section:
        """Table of xi^ / xi: peak, and the frequency at which it is 3 dB below its level at low frequency."""
        grid = self.loop.frequencies
        level = np.abs(self.loop.estimate(grid))
        top, low = int(np.argmax(level)), np.flatnonzero(level < level[0] / np.sqrt(2.0))
        # for m = 0 there is no xi^, and the response is zero
        some = f"{level[top]:.4g} at {grid[top]:.4g} rad/s", f"{grid[[*low, -1][0]]:.4g} rad/s"
        row = ("|xi^ / xi|", *(some if level[top] > 0.0 else ("0: no xi^", "")))
        return _Section("Estimate of the disturbance", ("", "peak", "-3 dB"), (row,))

    def _impact(self) -> _Section:
        """Table of the peaks of the estimation error after the gait's impact, one row per reset policy."""
        rows = []
        for policy in ResetPolicy:
            p = impact_peak(self.observer, self.impact, policy, self.gains)
            y, dy = f"{p.position:.3g} rad", f"{p.velocity:.3g} rad/s"
            xi, torque = f"{p.disturbance:.4g} rad/s^2", f"{p.torque:.4g} N m"
            rows.append((policy.value, y, dy, xi, torque))
        title = "Peak after the gait's impact: error of the estimates, and the torque it costs"
        return _Section(title, ("reset", "x1^", "x2^", "xi^", "torque"), tuple(rows))

    def _allowed(self) -> _Section:
        """Table of the largest allowed bandwidth for every order m; the last row is the loop without observer.

        "rms torque" [N m] is what the error of one encoder count causes, "|e / xi|" [s^2] the tracking error
        [rad] per disturbance [rad/s^2] of 5 Hz.
        """
        rows: list[tuple[str, ...]] = []
        for r in self.recommended:
            if math.isnan(r.bandwidth):
                rows.append((str(r.m), "none", "", "", "", ""))
                continue
            margin, bandwidth = milliseconds(r.delay_margin), f"{r.bandwidth:.4g} rad/s"
            noise, error = f"{r.ripple:.3g} N m", f"{r.rejection:.3g}"
            rows.append((str(r.m), bandwidth, r.because, noise, margin, error))
        rows.append(("none", "", "", "", "", f"{self.without_observer:.3g}"))
        title = (
            f"Largest bandwidth of m + 2 equal poles: rms torque of one count within {100 * SHARE:g} % of "
            f"the limit, stable for kappa off by {KAPPA_RATIOS[0]:g} to {KAPPA_RATIOS[-1]:g}"
        )
        return _Section(title, ALLOWED, tuple(rows))


def milliseconds(seconds: float) -> str:
    """Text of a time [s] in milliseconds: "no limit found" if infinite, "unstable" for NaN."""
    return of_stable(1e3 * seconds, "ms")


def of_stable(number: float, unit: str) -> str:
    """Text of a margin, period or frequency with its unit: "no limit found" if infinite, "unstable" if NaN."""
    if math.isnan(number):
        return "unstable"
    return f"{number:.4g} {unit}" if math.isfinite(number) else "no limit found"


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
    """Make the report of an observer, or of poles [rad/s], on a robot that walks a gait.

    period [s]: of the sampling; counts: of the encoders per revolution; delay [s]: from a sample instant to
    its torque, `known` to the observer or not. Of gains with one number per joint those of the first are used.
    Raises InputError for an impossible value, and names it.
    """
    if not isinstance(observer, GPIObserver):
        observer = GPIObserver.from_poles(observer)
    gains.check(robot.p)
    limit, inertia = robot.description.peak_torque, worst_inertia(robot, gait)
    hardware = Hardware(period, delay, known, float(counts), limit, inertia)
    # raises InputError at once for what has no sampled form
    OnHardware(hardware, observer, gains).sampled()
    name = f"{robot.description.name} ({robot.preset})"
    impact = orbit_impact(robot, gait, observer.order)
    return ObserverReport(hardware, observer, gains, robot=name, impact=impact)


def worst_inertia(biped: Biped, gait: Gait) -> float:
    """The largest sqrt(sum_j (kappa^-1)_ij^2) over joints i and along the gait [kg m^2].

    Independent errors of the commanded accelerations, all of one standard deviation [rad/s^2], make a torque of
    this times that deviation [N m] in the worst joint.
    """
    still = np.zeros(biped.n)  # kappa depends on q alone, so any rates will do
    along = ZeroDynamics.of(biped, gait.constraint).q
    inertias = (biped.reduction(q, still).kappa_inverse for q in along)
    return float(max(np.max(np.linalg.norm(rows, axis=1)) for rows in inertias))
