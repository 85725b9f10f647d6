"""`biped-adrc tune`: the best setting of a controller, and what it is worth on held-out walks.

The study is a TOML file (`tuning.study_file`); `tuning.tune` searches, stores each walk as it comes
and writes scenario file and page. Workers, progress bar and Ctrl-C are those of `sweep`.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table

from biped_adrc.cli.app import app, command, console, say
from biped_adrc.cli.options import texts
from biped_adrc.cli.sweep import carried_out, clock, study_workers

if TYPE_CHECKING:
    from biped_adrc.tuning.tuned import Tuned


@app.command()
@texts("tune")
def tune(
    study: Path,
    out: Path,
    workers: int | None = None,
    threads: bool = False,
    scheduler: str | None = None,
    dry_run: bool = False,
) -> None:
    """The best setting that a study finds for a controller, and what it is worth on held-out walks."""
    from biped_adrc.bench.sweep import RESULTS
    from biped_adrc.tuning.study_file import load_tuning
    from biped_adrc.tuning.tune import rehearse
    from biped_adrc.tuning.tune import tune as run

    found = load_tuning(study)
    crew = study_workers(workers, threads, scheduler)
    if dry_run:
        rehearse(found)
        walks = found.budget * found.training.count
        say(f"{found.name}: {found.budget} candidates, {walks} walks on the training set")
        return
    with carried_out(found.name, out / RESULTS, None, clock) as progress:
        tuned = run(
            found,
            out,
            crew,
            progress=progress,
            command=command(),
        )
    _print(tuned)


def _print(tuned: Tuned) -> None:
    """Print the chosen setting, and the table of its held-out numbers."""
    from biped_adrc.files import plain
    from biped_adrc.viz.tuning_text import held_out_texts

    table = Table("on held-out walks", "chosen", "as published", "ratio")
    for row in tuned.held_out:
        table.add_row(*held_out_texts(plain(row)))
    say(f"chosen: candidate {tuned.chosen.number}, {tuned.scenario.record()}")
    console.print(table)
    say(f"written to {tuned.out}: best.toml, tuning.html, summary.json, study.journal")
