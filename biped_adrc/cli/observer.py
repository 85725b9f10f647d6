"""`biped-adrc observer`: what an observer asks of encoders, clock and motors, and which one a robot allows.

The report is that of `analysis.observer.report`, from the linear loop of one joint.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from biped_adrc.cli.app import FIGURES, app, say, say_table, say_written, target
from biped_adrc.cli.options import options, pairs, scenario_from
from biped_adrc.core.types import PlainRecord


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
    from biped_adrc.observers.gpi import TABLE_I, GPIObserver
    from biped_adrc.scenario.build import RobotAndGait

    out = target(out, FIGURES)
    if not {"hardware", "hardware.profile"} & pairs(sets).keys():
        values = {"hardware.profile": "rabbit", **values}
    s = scenario_from(values, sets)
    c, h, scene = s.controller, s.hardware, RobotAndGait.of(s)
    o = c.observer
    if o.bandwidth is None:
        observer = GPIObserver.from_poles(o.poles or TABLE_I, o.order)
    else:
        observer = GPIObserver.from_bandwidth(o.bandwidth, 1 if o.order is None else o.order)
    gains = replace(TABLE_II, **{k: x for k in ("K_p", "K_d") if (x := getattr(c, k)) is not None})
    report = observer_report(
        observer,
        gains,
        robot=scene.biped,
        gait=scene.walked,
        period=h.period or 1e-3,
        counts=h.encoders.counts or 8192.0,
        delay=h.delay,
        known=h.delay_known,
    )
    say(report.verdict)
    for section in report.sections:
        say_table(section.header, section.rows, section.title)
    if out is not None:
        from biped_adrc.view.plots.figures import observer_figure
        from biped_adrc.view.style import write_figure

        write_figure(out, observer_figure(report))
        say_written(out)
