"""`biped-adrc observer`: what an observer asks of encoders, clock and motors, and which one a robot allows.

The report is that of `analysis.observer.report`, from the linear loop of one joint;
--confirm walks with a late torque and with encoders (`analysis.observer.check`) and prints whether
the robot agrees.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from rich.table import Table

from biped_adrc.cli.app import FIGURES, app, console, say, say_written
from biped_adrc.cli.options import of_scenario, pairs, scenario_from, texts
from biped_adrc.files import output_path
from biped_adrc.types import PlainRecord

if TYPE_CHECKING:
    from biped_adrc.analysis.observer.check import CheckedWalk
    from biped_adrc.analysis.observer.report import ObserverReport
    from biped_adrc.control.tracking import Gains
    from biped_adrc.gait.gait import Gait
    from biped_adrc.model.biped import Biped
    from biped_adrc.observers.gpi import GPIObserver
    from biped_adrc.scenario.scenario import ObserverRecord


@app.command("observer")
@of_scenario("gait", "preset", "robot", "period", "poles", "bandwidth", "order")
@texts("observer")
def observer_command(
    given: PlainRecord,
    sets: list[str] | None = None,
    confirm: bool = False,
    out: Path | None = None,
) -> None:
    """Say what an observer asks of encoders, clock and motors, and which one a robot allows.

    Encoders and clock are RABBIT's if not said otherwise.
    """
    from biped_adrc.analysis.observer.report import observer_report
    from biped_adrc.control.tracking import TABLE_II
    from biped_adrc.scenario.build import RobotAndGait

    path = None if out is None else output_path(out, FIGURES)
    if not {"hardware", "hardware.profile"} & pairs(sets).keys():
        given = {"hardware.profile": "rabbit", **given}
    s = scenario_from(given, sets)
    c, h, scene = s.controller, s.hardware, RobotAndGait.of(s)
    gains = replace(TABLE_II, **{k: x for k in ("K_p", "K_d") if (x := getattr(c, k)) is not None})
    chosen = _observer(c.observer)
    clock = Clock(h.period or 1e-3, h.encoders.counts or 8192.0, h.delay, h.delay_known)
    report = observer_report(chosen, gains, robot=scene.biped, gait=scene.walked, **clock._asdict())
    _print_report(report)
    if confirm:
        _confirm(scene.biped, scene.walked, chosen, gains, clock)
    if path is not None:
        from biped_adrc.view.plots.observer_figure import observer_figure
        from biped_adrc.view.style import write_figure

        write_figure(path, observer_figure(report))
        say_written(path)


class Clock(NamedTuple):
    """Sampling and encoders."""

    period: float
    """[s]."""
    counts: float | None
    """Per revolution; None: exact."""
    delay: float
    """[s]."""
    known: bool
    """Whether the observer knows the delay."""


def _print_report(report: ObserverReport) -> None:
    """Print the verdict, and the sections of the report as tables."""
    say(report.verdict)
    for section in report.sections:
        table = Table(*section.header, title=section.title, title_justify="left")
        for row in section.rows:
            table.add_row(*row)
        console.print(table)


def _observer(o: ObserverRecord) -> GPIObserver:
    """The observer that the options describe; Table I of the paper where they say nothing."""
    from biped_adrc.observers.gpi import TABLE_I, GPIObserver

    if o.bandwidth is not None:
        return GPIObserver.from_bandwidth(o.bandwidth, 1 if o.order is None else o.order)
    return GPIObserver.from_poles(o.poles or TABLE_I, o.order)


def _confirm(
    biped: Biped,
    gait: Gait,
    observer: GPIObserver,
    gains: Gains,
    clock: Clock,
) -> None:
    """Walk at the delay margin with unknown and known delay, then without and with encoders, and print
    the walks.
    """
    from biped_adrc.analysis.observer.check import (
        ABOVE,
        BELOW,
        DelayCase,
        check_encoders,
        robot_margin,
    )

    with console.status("walks with a late torque, then with encoders"):
        walks, said = [], []
        for known in (False, True):
            case = DelayCase(biped, gait, observer, gains, known)
            below, above = (case.walked(share * case.margin) for share in (BELOW, ABOVE))
            limit = biped.description.peak_torque
            walks += [below, above, case.walked(ABOVE * case.margin, torque_limit=limit)]
            own = robot_margin(case)
            words = f"{1e6 * own:.4g} us ({100 * (own / case.margin - 1.0):+.2g} %)"
            words = words if math.isfinite(own) else "far from it"
            said.append(
                f"delay {'known' if known else 'hidden'}: linear margin {1e6 * case.margin:.4g} us, "
                f"{'confirmed' if below.tracks and not above.tracks else 'NOT confirmed'}; "
                f"the robot's own {words}"
            )
        clocks = [clock._replace(counts=counts)._asdict() for counts in (None, clock.counts)]
        walks += [check_encoders(biped, gait, observer, gains, **x) for x in clocks]
    _print_walks(walks)
    for line in said:
        say(line)


def _print_walks(walks: list[CheckedWalk]) -> None:
    """Print how each walk ended and whether its errors stay."""
    header = ("walk", "status", "errors stay", "error of later steps [rad]")
    table = Table(*header, title="Confirmed by walking", title_justify="left")
    for walked in walks:
        tracks = "yes" if walked.tracks else "no"
        table.add_row(walked.condition, walked.status.name, tracks, f"{walked.amplitude:.3g}")
    console.print(table)
