"""`biped-adrc study`: all walks of a study, on all cores or a cluster; what is finished is never lost."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Table

from biped_adrc.cli.app import EXIT_INTERRUPTED, app, console, say
from biped_adrc.cli.options import options
from biped_adrc.core.files import output_path

if TYPE_CHECKING:
    from biped_adrc.studies.results import Results
    from biped_adrc.studies.runner import Progress as Done


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
        from biped_adrc.studies.results import TABLES

        output_path(table, TABLES)
    if dry_run:
        result.rehearse()
        most = "at most " if result.search else ""
        say(
            f"{result.name}: {most}{result.count} walks, over {', '.join(result.axes) or 'no grid'}"
        )
        return
    from biped_adrc.studies.carry import study as carry_out
    from biped_adrc.studies.page import write_page

    with _shown(result.name, out) as progress:
        done = carry_out(result, out, workers, cluster=cluster, progress=progress)
    _print(done)
    written = [write_page(done)]
    if table is not None:
        done.export(table)
        written.append(table)
    say(f"written to {', '.join(map(str, written))}")


def _print(done: Results) -> None:
    """Print the table, what a search chose, and why some walks could not be made."""
    from biped_adrc.studies.build import NO_WALK
    from biped_adrc.studies.page import chosen, headings, texts

    shown = Table(*headings(done))
    for line in done.table():
        shown.add_row(*texts(line, short=True))
    console.print(shown)
    for name, words in chosen(done).items():
        say(f"{name}: {words}")
    for status, (count, detail) in done.statuses().items():
        if status in NO_WALK:
            say(f"{count} {status}, such as: {detail}")


@contextmanager
def _shown(name: str, out: Path) -> Iterator[Callable[[Done], None]]:
    """Context with a progress bar; on Ctrl-C it says how to go on, and raises the exit."""
    text = TextColumn("{task.description:<24.24}", markup=False)
    times = TimeElapsedColumn(), TextColumn("left"), TimeRemainingColumn()
    with Progress(text, BarColumn(), MofNCompleteColumn(), *times, console=console) as shown:
        task = shown.add_task(name, total=None)

        def progress(p: Done) -> None:
            shown.update(task, completed=p.done, total=p.total)
            if p.note:
                shown.console.print(p.note)

        try:
            yield progress
        except KeyboardInterrupt:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            shown.stop()
            begun = "what is finished is in" if os.path.exists(out) else "nothing was begun in"
            say(f"{begun} {out}; the same command goes on from there")
            raise typer.Exit(EXIT_INTERRUPTED) from None
