"""`biped-adrc observer`: what an observer asks of encoders, clock and motors, and which one a robot allows.

The report is that of `observer_design.observer_report`, from the linear loop of one joint;
--confirm walks with a late torque and with encoders (`studies.observer_check`) and prints whether
the robot agrees.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table

from biped_adrc.cli.app import FIGURES, app, bar, console, say, say_written
from biped_adrc.cli.options import texts
from biped_adrc.errors import InputError
from biped_adrc.files import output_path

if TYPE_CHECKING:
    from biped_adrc.control.tracking import Gains
    from biped_adrc.gait.gait import Gait
    from biped_adrc.model.biped import Biped
    from biped_adrc.observer_design.observer_report import ObserverReport
    from biped_adrc.observers.gpi import GPIObserver
    from biped_adrc.studies.observer_check import CheckedWalk, DelayCheck


@app.command("observer")
@texts("observer")
def observer_command(
    poles: str | None = None,
    bandwidth: float | None = None,
    order: int | None = None,
    k_p: float = 5000.0,
    k_d: float = 50.0,
    period: float = 1.5e-3,
    counts: float = 8192.0,
    delay: float = 0.0,
    known: bool = False,
    robot: str = "rabbit",
    preset: str | None = None,
    gait: str = "published",
    confirm: bool = False,
    out: Path | None = None,
) -> None:
    """Say what an observer asks of encoders, clock and motors, and which one a robot allows."""
    from biped_adrc.control.tracking import Gains
    from biped_adrc.gait.gait import load_gait
    from biped_adrc.model.biped import Biped
    from biped_adrc.observer_design.observer_report import observer_report

    chosen, gains = _observer(poles, bandwidth, order), Gains(k_p, k_d)
    path = None if out is None else output_path(out, FIGURES)
    biped = Biped.load(robot, preset)
    found = load_gait(gait, biped)
    report = observer_report(
        chosen, gains, period, robot=biped, gait=found, counts=counts, delay=delay, known=known
    )
    _print_report(report)
    if confirm:
        _confirm(biped, found, chosen, gains, (period, counts, delay, known))
    if path is not None:
        from biped_adrc.viz.plots.observer_figure import observer_figure
        from biped_adrc.viz.style import write_figure

        write_figure(path, observer_figure([report]))
        say_written(path)


def _print_report(report: ObserverReport) -> None:
    """Print the verdict, and the sections of the report as tables."""
    say(report.verdict)
    for section in report.sections:
        table = Table(*section.header, title=section.title, title_justify="left")
        for row in section.rows:
            table.add_row(*row)
        console.print(table)


def _observer(poles: str | None, bandwidth: float | None, order: int | None) -> GPIObserver:
    """The observer that the options describe; Table I of the paper where they say nothing.

    Raises InputError where poles and a bandwidth are both given, or a pole is no number.
    """
    from biped_adrc.observers.gpi import TABLE_I, GPIObserver

    if poles is not None and bandwidth is not None:
        raise InputError("both --poles and --bandwidth are given; give one of them")
    if bandwidth is not None:
        return GPIObserver.from_bandwidth(bandwidth, 1 if order is None else order)
    if poles is None:
        return GPIObserver.from_poles(TABLE_I, order)
    try:
        values = [complex(text) for text in poles.replace(" ", "").split(",")]
    except ValueError:
        raise InputError(
            f"--poles is '{poles}', expected numbers separated by commas, as -300,-400+50j,-400-50j"
        ) from None
    return GPIObserver.from_poles(values, order)


def _confirm(
    biped: Biped,
    gait: Gait,
    observer: GPIObserver,
    gains: Gains,
    clock: tuple[float, float, float, bool],
) -> None:
    """Walk at the delay margin with unknown and known delay, then without and with encoders, and print
    the walks.

    clock: period [s], counts of an encoder per turn, delay [s], and whether the observer knows the
    delay.
    """
    from biped_adrc.studies.observer_check import DelayCase, check_delay, check_encoders

    period, counts, delay, known = clock
    with bar() as progress:
        task = progress.add_task("walks with a late torque, then with encoders", total=4)
        checks = []
        for aware in (False, True):
            checks.append(check_delay(DelayCase(biped, gait, observer, gains, aware)))
            progress.advance(task)
        walks = []
        for seen in (None, counts):
            walks.append(
                check_encoders(
                    biped,
                    gait,
                    observer,
                    gains,
                    period=period,
                    counts=seen,
                    delay=delay,
                    known=known,
                )
            )
            progress.advance(task)
    _print_walks(checks, walks)


def _print_walks(checks: list[DelayCheck], walks: list[CheckedWalk]) -> None:
    """Print how each walk ended and whether its errors stay, and the delay margins in [us]."""
    header = ("walk", "status", "errors stay", "error of later steps [rad]")
    table = Table(*header, title="Confirmed by walking", title_justify="left")
    rows = [walked for check in checks for walked in (check.below, check.above, check.limited)]
    for walked in (*rows, *walks):
        tracks = "yes" if walked.tracks else "no"
        table.add_row(walked.condition, walked.status.name, tracks, f"{walked.amplitude:.3g}")
    console.print(table)
    for check in checks:
        own = f"{1e6 * check.robot_margin:.4g} us ({100 * check.shift:+.2g} %)"
        own = own if math.isfinite(check.robot_margin) else "far from it"
        say(
            f"delay {'known' if check.known else 'hidden'}: linear margin {1e6 * check.margin:.4g} us, "
            f"{'confirmed' if check.confirmed else 'NOT confirmed'}; the robot's own "
            f"{own}; a finer approximant changes errors "
            f"by {check.order_effect:.1g} rad"
        )
