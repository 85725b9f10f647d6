"""`biped-adrc observer`: what an observer asks of encoders, clock and motors, and which one a robot allows.

The report is that of `analysis.observer.report`, from the linear loop of one joint.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table

from biped_adrc.cli.app import FIGURES, app, console, say, say_written
from biped_adrc.cli.options import options, pairs, scenario_from
from biped_adrc.core.files import output_path
from biped_adrc.core.types import PlainRecord

if TYPE_CHECKING:
    from biped_adrc.analysis.observer.report import ObserverReport
    from biped_adrc.observers.gpi import GPIObserver
    from biped_adrc.scenario.scenario import ObserverRecord


@app.command("observer")
@options("observer", "gait", "preset", "robot", "period", "poles", "bandwidth", "order")
def observer_command(
    values: PlainRecord, sets: list[str] | None = None, out: Path | None = None
) -> None:
    """Say what an observer asks of encoders, clock and motors, and which one a robot allows.

    Encoders and clock are RABBIT's if not said otherwise.
    """
    from biped_adrc.analysis.observer.report import observer_report
    from biped_adrc.control.tracking import TABLE_II
    from biped_adrc.scenario.build import RobotAndGait

    path = None if out is None else output_path(out, FIGURES)
    if not {"hardware", "hardware.profile"} & pairs(sets).keys():
        values = {"hardware.profile": "rabbit", **values}
    s = scenario_from(values, sets)
    c, h, scene = s.controller, s.hardware, RobotAndGait.of(s)
    gains = replace(TABLE_II, **{k: x for k in ("K_p", "K_d") if (x := getattr(c, k)) is not None})
    report = observer_report(
        _observer(c.observer),
        gains,
        robot=scene.biped,
        gait=scene.walked,
        period=h.period or 1e-3,
        counts=h.encoders.counts or 8192.0,
        delay=h.delay,
        known=h.delay_known,
    )
    _print_report(report)
    if path is not None:
        from biped_adrc.view.plots.observer_figure import observer_figure
        from biped_adrc.view.style import write_figure

        write_figure(path, observer_figure(report))
        say_written(path)


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
