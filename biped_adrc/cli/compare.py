"""`biped-adrc compare`: the comparison of controllers over conditions and seeds.

It checks the names, starts workers as `sweep` does, and leaves the walks, figures, page and summary
to `bench.compare_study.run_comparison`. What is printed is made from the summary alone, so it can
be had again from summary.json.
"""

from __future__ import annotations

from pathlib import Path

from rich.table import Table

from biped_adrc.cli.app import app, command, console, say
from biped_adrc.cli.options import texts
from biped_adrc.cli.sweep import carried_out, study_workers
from biped_adrc.types import PlainRecord


@app.command()
@texts("compare")
def compare(
    out: Path = Path("comparison"),
    controllers: str | None = None,
    conditions: str | None = None,
    seeds: int = 20,
    pushes: bool = True,
    plant: str = "rigid",
    workers: int | None = None,
    threads: bool = False,
    scheduler: str | None = None,
    other_versions: bool = False,
) -> None:
    """Which controller walks legally under what: controllers x conditions x seeds, with intervals and tests."""
    from biped_adrc.bench.compare_study import RESULTS, run_comparison
    from biped_adrc.bench.conditions import COMPARED, conditions_on

    crew = study_workers(workers, threads, scheduler)
    asked = _names(controllers, COMPARED), _names(conditions, conditions_on(plant)), seeds, pushes
    with carried_out(
        "walking", out / RESULTS, None, "{:.0f} s left in this round".format
    ) as progress:
        summary = run_comparison(out, command(), *asked, crew, progress, other_versions, plant)
    _print(summary)
    say(f"written to {out}: comparison.html, summary.json, figures, {RESULTS}")


def _names(text: str | None, every: tuple[str, ...]) -> tuple[str, ...]:
    """The names in a text between commas; all of `every` where none is given."""
    return every if text is None else tuple(name.strip() for name in text.split(","))


def _print(summary: PlainRecord) -> None:
    """The table of the share of walks that are legal, in brackets of those that make all steps, and
    all sentences.
    """
    from biped_adrc.viz.comparison_text import nominal_text

    controllers = list(summary["controllers"])
    table = Table("condition", *controllers, title="legal walks, % (all that make all steps, %)")
    found = {(c["condition"], c["controller"]): _shares(c) for c in summary["cells"]}
    for condition in summary["conditions"]:
        table.add_row(condition, *(found[condition, name] for name in controllers))
    say(nominal_text(summary["nominal"]))
    console.print(table)
    say(summary["settings"])
    for line in (line for family in summary["findings"].values() for line in family):
        say(line)


def _shares(cell: PlainRecord) -> str:
    return f"{100 * cell['legal'][0]:.0f} ({100 * cell['survived'][0]:.0f})"
