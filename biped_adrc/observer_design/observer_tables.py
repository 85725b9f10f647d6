"""The observer report as text: a verdict in one sentence, and five tables.

For a terminal (`ObserverReport.text`) or a page. Every function takes the report and asks it for
its numbers; nothing is computed here but the peaks after an impact. The columns "delay hidden" and
"known" are the delay unknown and known to the observer.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from biped_adrc.columns import columns
from biped_adrc.observer_design.observer_choice import KAPPA_RATIOS, SHARE, without_observer
from biped_adrc.observer_design.observer_impact import impact_peak
from biped_adrc.observers.base import ResetPolicy

if TYPE_CHECKING:
    from biped_adrc.observer_design.observer_report import ObserverReport


class Section(NamedTuple):
    """One table: its title, the heads of its columns, and its rows as text."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def lines(self) -> list[str]:
        """Title, header and rows, in columns of equal width."""
        return [self.title, *(f"  {line}" for line in columns((self.header, *self.rows)))]


# -- the verdict ---------------------------------------------------------------------------------
def verdict(report: ObserverReport) -> str:
    """Whether the observer can run on the robot, in words, with the numbers that decide.

    "cannot run": unstable, or torque noise above the limit. "can run, but": more noise than SHARE,
    or a worse rejection than without an observer.
    """
    k = report.hardware
    where = f"on {report.robot} at {1.0 / k.period:.0f} Hz with {k.counts:g} counts per revolution"
    share, torque = _torque(report)
    unstable = [_unstable(report)] if report.obstacle == "stability" else []
    if unstable or share > 1.0:
        reasons = [torque] if math.isfinite(share) else []
        reasons = [*reasons, *unstable] if share > 1.0 else [*unstable, *reasons]
        return f"{report.name} cannot run {where}: {'; '.join((*reasons, _bears(report)))}"
    facts = [torque, _bears(report), _use(report)]
    if not report.runs:
        wish = f", but not well: at most {100.0 * SHARE:g} % are asked for, and "
    elif report.against_none > 1.0:
        wish, facts = ", but is worse than no observer: ", [*facts[2:], *facts[:2]]
    else:
        wish = ": "
    return f"{report.name} can run {where}{wish}{'; '.join(facts)}"


def _bears(report: ObserverReport) -> str:
    """The largest delay that the sampled loop bears, in words."""
    margin = report.sampled_margins[int(report.hardware.known)]
    if math.isnan(margin):
        return "it bears no delay, since with the model's kappa it is unstable"
    if math.isinf(margin):
        return "with the model's kappa no delay was found that it does not bear"
    return f"with the model's kappa it bears {microseconds(margin)} of delay at this period"


def _torque(report: ObserverReport) -> tuple[float, str]:
    """The ripple relative to the torque limit, and in words."""
    limit = report.hardware.torque_limit
    share = report.ripple / limit
    part = f"{100.0 * share:.3g} % of" if share <= 1.0 else f"{share:.3g} times"
    return (
        share,
        f"one encoder count makes {report.ripple:.4g} N m rms, {part} the limit of {limit:g} N m",
    )


def _unstable(report: ObserverReport) -> str:
    """Which ratio of the robot's kappa to the model's makes the sampled loop unstable."""
    k, radius = report.hardware, report.spectral_radius
    late = f"a delay of {k.delay * 1e6:.0f} us" if k.delay > 0.0 else "no delay"
    if not radius < 1.0:
        return f"with {late} the sampled loop is unstable, spectral radius {radius:.4g}"
    ratio, radius = report.weakest
    return (
        f"with {late} and {ratio:g} times the model's kappa the sampled loop is unstable, spectral radius "
        f"{radius:.4g} (stability is asked for from {KAPPA_RATIOS[0]:g} to {KAPPA_RATIOS[-1]:g} times)"
    )


def _use(report: ObserverReport) -> str:
    """What the observer is good for: the error it leaves relative to a loop without it."""
    times = report.against_none
    error = f"a 5 Hz disturbance leaves {times:.2g} times the error of K_p and K_d alone"
    if report.observer.m == 0:
        error += "; with m = 0 no disturbance is estimated, and the weight is not compensated"
    return error


# -- the tables ----------------------------------------------------------------------------------
def sections(report: ObserverReport) -> list[Section]:
    """All tables: gains, stability, responses, impact and allowed bandwidths."""
    return [
        _gains(report),
        _stability(report),
        _responses(report),
        _impact(report),
        _allowed(report),
    ]


def _gains(report: ObserverReport) -> Section:
    """Gains l of (19), physical [1/s^i] and scaled."""
    o = report.observer
    names = [f"l_{o.order - 1 - i} [1/s^{i + 1}]" for i in range(o.order)]
    rows = [
        (name, f"{physical:.6g}", f"{scaled:.6g}")
        for name, physical, scaled in zip(names, o.gains, o.scaled_gains, strict=True)
    ]
    title = f"Gains of the observer; states scaled by w = {o.scale:.6g} rad/s"
    return Section(title, ("", "physical", "scaled"), tuple(rows))


def _stability(report: ObserverReport) -> Section:
    """Delay margins and largest periods, the delay unknown and known."""
    hidden, known = (report.loop.delay_margin(told) for told in (False, True))
    sampled = report.sampled_margins
    period = microseconds(report.hardware.period)
    rows = [
        ("delay margin, continuous", microseconds(hidden.delay), microseconds(known.delay)),
        ("  root on the axis at", *(of_stable(m.frequency, "rad/s") for m in (hidden, known))),
        (f"delay margin, period {period}", *(microseconds(d) for d in sampled)),
        *(
            (f"largest period, {name}", *(microseconds(T) for T in periods))
            for name, periods in report.largest_periods.items()
        ),
    ]
    return Section(
        "Stability of the linear loop, kappa as in the model",
        ("", "delay hidden", "known"),
        tuple(rows),
    )


def _responses(report: ObserverReport) -> Section:
    """Level, peak and -3 dB frequency of the three transfer functions."""
    rows = tuple(
        (
            f"|{name}|",
            f"{r.low:.3g}",
            f"{r.peak:.4g} at {r.at:.4g} rad/s" if r.peak > 0.0 else "0: no xi^",
            f"{r.bandwidth:.4g} rad/s" if math.isfinite(r.bandwidth) else "",
        )
        for name, r in report.responses.items()
    )
    header = ("", "at low frequency", "peak", "-3 dB")
    title = "Transfer functions: disturbance to error [s^2] and to its estimate, angle to torque [N m/rad]"
    return Section(title, header, rows)


def _impact(report: ObserverReport) -> Section:
    """Peak of the estimation error after the gait's impact, one row per reset policy."""
    rows = tuple(
        (
            policy.value,
            f"{p.position:.3g} rad",
            f"{p.velocity:.3g} rad/s",
            f"{p.disturbance:.4g} rad/s^2",
            f"{p.torque:.4g} N m",
        )
        for policy in ResetPolicy
        for p in [impact_peak(report.observer, report.impact, policy, report.gains)]
    )
    title = "Peak after the gait's impact: error of the estimates, and the torque it costs"
    return Section(title, ("reset", "x1^", "x2^", "xi^", "torque"), rows)


def _allowed(report: ObserverReport) -> Section:
    """The largest allowed bandwidth for every order m, and the loop without an observer."""
    rows = [
        (str(r.m), "none", "", "", "", "")
        if math.isnan(r.bandwidth)
        else (
            str(r.m),
            f"{r.bandwidth:.4g} rad/s",
            r.because,
            f"{r.ripple:.3g} N m",
            microseconds(r.delay_margin),
            f"{r.rejection:.3g}",
        )
        for r in report.recommended
    ]
    alone = without_observer(report.gains)
    rows.append(("none", "", "", "", "", f"{alone:.3g}"))
    low, high = KAPPA_RATIOS[0], KAPPA_RATIOS[-1]
    title = (
        f"Largest bandwidth of m + 2 equal poles: rms torque of one count within {100 * SHARE:g} % of the "
        f"limit, stable for kappa off by {low:g} to {high:g}"
    )
    header = (
        "m",
        "bandwidth",
        "limited by",
        "rms torque",
        "delay margin",
        "|e / xi| at 5 Hz [s^2]",
    )
    return Section(title, header, tuple(rows))


def microseconds(seconds: float) -> str:
    """A time [s] in microseconds, or that there is no limit; NaN is the margin of an unstable loop."""
    return of_stable(1e6 * seconds, "us")


def of_stable(number: float, unit: str) -> str:
    """A margin, period or frequency of a stable loop with its unit; "unstable" for NaN."""
    if math.isnan(number):
        return "unstable"
    return f"{number:.4g} {unit}" if math.isfinite(number) else "no limit found"
