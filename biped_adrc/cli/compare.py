"""`biped-adrc compare`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.progress import Progress
from rich.table import Table

from biped_adrc.cli.app import app, command, console
from biped_adrc.cli.sweep import interrupted, say, study_bar, study_workers

if TYPE_CHECKING:
    from biped_adrc.studies.bench.execute import Progress as Done


@app.command()
def compare(
    out: Annotated[
        Path,
        typer.Option("--out", "-o", help="Folder of results, figures and page; goes on there."),
    ] = Path("comparison"),
    controllers: Annotated[
        str | None,
        typer.Option(
            help="Comma separated, your own as package.module:Class; those of the tables if not given."
        ),
    ] = None,
    conditions: Annotated[
        str | None, typer.Option(help="Comma separated; all of them if not given.")
    ] = None,
    seeds: Annotated[int, typer.Option(help="Walks in each cell of the table.")] = 20,
    pushes: Annotated[
        bool,
        typer.Option(
            help="Look by bisection for the largest push walked legally, and with all steps made."
        ),
    ] = True,
    workers: Annotated[
        int | None, typer.Option(help="Processes or threads; by default one per core.")
    ] = None,
    threads: Annotated[
        bool, typer.Option("--threads", help="Threads in place of processes.")
    ] = False,
    scheduler: Annotated[
        str | None, typer.Option(help="Address of a Dask scheduler, such as tcp://host:8786.")
    ] = None,
    other_versions: Annotated[
        bool, typer.Option("--other-versions", help="Go on with results of other versions.")
    ] = False,
) -> None:
    """Which controller walks legally under what: controllers x conditions x seeds, with intervals and tests."""
    from biped_adrc.studies.bench.compare_study import RESULTS, run_comparison
    from biped_adrc.studies.bench.conditions import COMPARED, CONDITIONS

    crew = study_workers(workers, threads, scheduler)
    with study_bar() as shown:
        try:
            summary = run_comparison(
                out,
                command(),
                _names(controllers, COMPARED),
                _names(conditions, tuple(CONDITIONS)),
                seeds,
                pushes,
                crew,
                _progress(shown),
                other_versions,
            )
        except KeyboardInterrupt:
            shown.stop()
            raise interrupted(out / RESULTS) from None
    _print(summary)
    say(f"written to {out}: comparison.html, summary.json, figures, {RESULTS}")


def _progress(shown: Progress) -> Callable[[Done], None]:
    task = shown.add_task("walking", total=None, left="")

    def progress(p: Done) -> None:
        left = "" if p.left is None else f"{p.left:.0f} s left in this round"
        shown.update(task, completed=p.done, total=p.total, left=left)
        if p.note:
            shown.console.print(p.note, markup=False)

    return progress


def _names(text: str | None, every: tuple[str, ...]) -> tuple[str, ...]:
    return every if text is None else tuple(name.strip() for name in text.split(","))


def _print(summary: dict[str, Any]) -> None:
    """The share of walks that are legal, and of those that make all steps, in brackets."""
    from biped_adrc.viz.comparison_text import nominal_text

    controllers = list(summary["controllers"])
    table = Table("condition", *controllers, title="legal walks, % (all that make all steps, %)")
    found = {
        (
            c["condition"],
            c["controller"],
        ): f"{100 * c['legal'][0]:.0f} ({100 * c['survived'][0]:.0f})"
        for c in summary["cells"]
    }
    for condition in summary["conditions"]:
        table.add_row(condition, *(found[condition, name] for name in controllers))
    say(nominal_text(summary["nominal"]))
    console.print(table)
    say(summary["settings"])
    for line in (line for family in summary["findings"].values() for line in family):
        say(line)
