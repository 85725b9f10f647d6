"""`biped-adrc study`: all walks of a study, on all cores or a cluster; what is finished is never lost."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import typer

from biped_adrc.cli.app import EXIT_INTERRUPTED, app, bar, console, say, say_table
from biped_adrc.cli.options import options
from biped_adrc.core.errors import SimulationError


@app.command()
@options("study")
def study(
    study: Path,
    out: Path,
    workers: int | None = None,
    cluster: str | None = None,
    table: Path | None = None,
    dry_run: bool = False,
) -> None:
    """Walk a study: cases, conditions, grids, draws, or a search; killed, the same command goes on."""
    from biped_adrc.studies.study import read_study

    result = read_study(study)
    if table is not None:
        from biped_adrc.studies.results import check_table

        check_table(table)
    if dry_run:
        result.rehearse()
        most = "at most " if result.search else ""
        over = f", over {', '.join(result.axes)}" if result.axes else ""
        say(f"{result.name}: {most}{result.count} walks{over}")
        return
    from biped_adrc.studies.build import NO_WALK
    from biped_adrc.studies.carry import study as carry_out
    from biped_adrc.studies.page import chosen, headings, texts, write_page
    from biped_adrc.studies.runner import Progress

    try:
        with bar(result.name) as shown:

            def progress(p: Progress) -> None:
                shown(p.done, p.total, result.name)
                if p.note:
                    console.print(p.note)

            done = carry_out(result, out, workers, cluster=cluster, progress=progress)
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        begun = "what is finished is in" if os.path.exists(out) else "nothing was begun in"
        say(f"{begun} {out}; the same command goes on from there")
        raise typer.Exit(EXIT_INTERRUPTED) from None
    say_table(headings(done), (texts(line, short=True) for line in done.table()))
    for name, words in chosen(done).items():
        say(f"{name}: {words}")
    statuses = done.statuses()
    for status, (count, detail) in statuses.items():
        if status in NO_WALK:
            say(f"{count} {status}, such as: {detail}")
    written = [write_page(done)]
    if table is not None:
        done.export(table)
        written.append(table)
    say(f"written to {', '.join(map(str, written))}")
    if statuses.keys() <= {*NO_WALK}:
        raise SimulationError("no walk of this study could be made")
