"""`biped-adrc sweep`: every point of a study, on all cores or a cluster; what is finished is never lost.

The study is a TOML file (`bench.study_file`); `bench.sweep` walks its points and stores each result
as it comes. The options of workers, the progress bar and the way Ctrl-C is met are shared with
`compare`.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from biped_adrc.cli.app import EXIT_INTERRUPTED, app, console, say
from biped_adrc.cli.options import texts
from biped_adrc.errors import InputError

if TYPE_CHECKING:
    from biped_adrc.bench.study import Study
    from biped_adrc.bench.sweep import Sweep
    from biped_adrc.campaign.execute import Progress as Done
    from biped_adrc.campaign.workers import Workers
    from biped_adrc.viz.plots.sweep_maps import Maps


@app.command()
@texts("sweep")
def sweep(
    study: Path,
    out: Path,
    workers: int | None = None,
    threads: bool = False,
    scheduler: str | None = None,
    export: list[str] | None = None,
    plot: list[str] | None = None,
    dry_run: bool = False,
    no_run: bool = False,
) -> None:
    """Walk every point of a study, on all cores or a cluster; what is finished is never lost."""
    from biped_adrc.bench.export import check_kind, write_map
    from biped_adrc.bench.export import export as export_results
    from biped_adrc.bench.study import rehearse
    from biped_adrc.bench.study_file import load_study

    found = load_study(study)
    maps = [_maps(text, found) for text in plot or ()]
    for kind in export or []:
        check_kind(kind)
    crew = study_workers(workers, threads, scheduler)
    if dry_run:
        rehearse(found)
        _print_study(found)
        return
    if no_run:
        done = _finished(found, out)
    else:
        from biped_adrc.bench.sweep import RESULTS
        from biped_adrc.bench.sweep import sweep as run

        with carried_out(found.name, out / RESULTS, found.count, clock) as progress:
            done = run(found, out, crew, progress=progress)
    _print_statuses(done)
    for kind in export or []:
        export_results(done, out / f"results.{kind}")
        say(f"written to {out / f'results.{kind}'}")
    for m in maps:
        say(f"written to {write_map(done, m, out)}")


def _finished(study: Study, out: Path) -> Sweep:
    """What is there of this study. Raises InputError."""
    from biped_adrc.bench.sweep import load_sweep

    done = load_sweep(out)
    if done.study.hash != study.hash:
        raise InputError(
            f"'{done.path}' holds the study '{done.study.name}' ({done.study.hash[:8]}), and the file is of "
            f"'{study.name}' ({study.hash[:8]}); expected the same, choose another folder"
        )
    return done


def _print_statuses(done: Sweep) -> None:
    """Print how many walks ended in each way, and why some could not be walked."""
    counts = ", ".join(f"{count} {status}" for status, count in done.statuses().items())
    say(f"{done.path}: {counts or 'nothing is finished'}")
    for status, detail in done.no_walks().items():
        say(f"one that is {status}: {detail}")


def interrupted(results: Path) -> typer.Exit:
    """Say what to do after Ctrl-C, and give the exit to raise; a second Ctrl-C meanwhile is ignored."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if os.path.exists(results):
        say(f"what is finished is in {results.parent}; the same command goes on from there")
    else:
        say(f"nothing was begun in {results.parent}")
    return typer.Exit(EXIT_INTERRUPTED)


@contextmanager
def carried_out(
    name: str, results: Path, total: int | None, left: Callable[[float], str]
) -> Iterator[Callable[[Done], None]]:
    """Context with a progress bar of the walks of a study; it gives the function that is told how far it is.

    results: file that is there once something is finished. total: number of walks, None if not
    known. left: seconds to go, in words. On Ctrl-C it says how to go on and raises the exit.
    """
    text = TextColumn("{task.description:<24.24}", markup=False)
    told = TextColumn("{task.fields[left]}")
    columns = (text, BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(), told)
    with Progress(*columns, console=console) as shown:
        task = shown.add_task(name, total=total, left="")

        def progress(p: Done) -> None:
            words = "" if p.left is None else left(p.left)
            shown.update(task, completed=p.done, total=p.total, left=words)
            if p.note:
                shown.console.print(p.note)

        try:
            yield progress
        except KeyboardInterrupt:
            stop = interrupted(results)
            shown.stop()
            raise stop from None


def clock(seconds: float) -> str:
    """Seconds to go as "h:mm:ss left"."""
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02}:{rest:02} left"


def study_workers(number: int | None, threads: bool, scheduler: str | None) -> Workers:
    """The workers that the options ask for: processes, threads, or a Dask cluster.

    Raises InputError for a scheduler together with a number or threads: a cluster brings its own
    workers.
    """
    from biped_adrc.campaign.workers import Processes, Threads

    if scheduler is None:
        return Threads(number) if threads else Processes(number)
    if threads or number is not None:
        raise InputError("--scheduler brings its own workers; leave out --workers and --threads")
    from biped_adrc.campaign.dask_cluster import Cluster

    return Cluster(scheduler)


def _maps(text: str, study: Study) -> Maps:
    """What a text of --plot asks for, X,Y or X,Y,PANEL and perhaps :COLUMN.

    Raises InputError for what the study does not vary or have as a result, before any walk.
    """
    from biped_adrc.bench.parameters import unit
    from biped_adrc.bench.study import NAMES
    from biped_adrc.viz.plots.sweep_maps import Maps

    axes, _, value = text.partition(":")
    names = [name.strip() for name in axes.split(",")]
    if not 2 <= len(names) <= 3 or len(set(names)) < len(names):
        raise InputError(f"--plot is '{text}', expected X,Y or X,Y,PANEL, and perhaps :COLUMN")
    for name in names:
        if name not in study.varied:
            raise InputError(
                f"--plot names '{name}', which the study does not vary; choose from {list(study.varied)}"
            )
    value = value.strip() or "survived"
    _check_map(text, study, value, names[2:])
    units = {name: unit(name) for name in study.varied if name not in NAMES}
    ranges = {} if study.draw is None else study.draw.ranges
    log = frozenset(name for name, r in ranges.items() if r.scale == "log")
    panel = names[2] if len(names) == 3 else None
    return Maps(names[0], names[1], panel, value, units, log)


def _check_map(text: str, study: Study, value: str, panels: list[str]) -> None:
    """Raises InputError for a result that there will not be, or too many panels."""
    from biped_adrc.bench.parameters import is_number
    from biped_adrc.bench.run import COLUMNS, WORDS
    from biped_adrc.bench.study import NAMES
    from biped_adrc.viz.plots.sweep_maps import MOST_PANELS

    shown = [name for name in COLUMNS if name not in WORDS]
    shown += [name for name in study.varied if name not in NAMES and is_number(name)]
    if value not in shown:
        raise InputError(f"--plot is '{text}': '{value}' is no result; choose from {shown}")
    for name in panels:
        count = study.levels(name)
        if count > MOST_PANELS:
            raise InputError(
                f"--plot is '{text}': {count} panels over '{name}', expected at most {MOST_PANELS}; put it on "
                "an axis"
            )


def _print_study(study: Study) -> None:
    """Print what a study varies, the number of its points, and the first of them."""
    say(f"{study.name}: {study.count} points, over {', '.join(study.varied) or 'nothing'}")
    first = next(study.points())
    say(f"the first of them: {dict(first.at)}")
