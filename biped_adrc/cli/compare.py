"""`biped-adrc compare`: the comparison of controllers over conditions and seeds.

It checks the names, starts workers as `sweep` does, and leaves the walks, figures, page and summary to
`bench.compare_study.run_comparison`. What is printed is made from the summary alone, so it can be had again
from its file.
"""

from __future__ import annotations

from pathlib import Path

from rich.table import Column, Table

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
    plant: str = "rigid",
    settings: str | None = None,
    workers: int | None = None,
    threads: bool = False,
    scheduler: str | None = None,
) -> None:
    """Whose walks are feasible under what: controllers x conditions x seeds, with intervals."""
    crew = study_workers(workers, threads, scheduler)
    from biped_adrc.bench.compare_study import RESULTS, run_comparison
    from biped_adrc.bench.conditions import conditions_on
    from biped_adrc.bench.settings import TUNED, settings_of

    chosen = TUNED if settings is None else settings_of(settings)
    every = tuple(chosen.contestants), conditions_on(plant, chosen.alike)
    asked = _names(controllers, every[0]), _names(conditions, every[1]), seeds
    with carried_out(
        "walking", out / RESULTS, None, "{:.0f} s left in this round".format
    ) as progress:
        summary = run_comparison(out, command(), *asked, crew, progress, plant, chosen)
    _print(summary)
    say(f"written to {out}: comparison.html, summary.json, figures, {RESULTS}")


def _names(text: str | None, every: tuple[str, ...]) -> tuple[str, ...]:
    """The names in a text between commas; all of `every` where none is given. A known name may have commas."""
    if text is None:
        return every
    found: list[str] = []
    rest = text.strip()
    while rest:
        known = [name for name in every if rest == name or rest.startswith(f"{name},")]
        name = max(known, key=len, default=rest.partition(",")[0])
        found.append(name.strip())
        rest = rest[len(name) :].lstrip(", ")
    return tuple(found)


def _print(summary: PlainRecord) -> None:
    """Print the shares of walks: feasible + feasible but for the impact (all that make all steps)."""
    from biped_adrc.viz.comparison_text import nominal_text

    controllers = list(summary["controllers"])
    columns = (Column(name, overflow="fold") for name in controllers)
    title = "feasible walks + feasible but for the impact, % (all that make all steps, %)"
    table = Table("condition", *columns, title=title, padding=(0, 0, 0, 1))
    found = {(c["condition"], c["controller"]): _shares(c) for c in summary["cells"]}
    for condition in summary["conditions"]:
        table.add_row(condition, *(found[condition, name] for name in controllers))
    say(nominal_text(summary["nominal"]))
    console.print(table)
    say(summary["settings"])


def _shares(cell: PlainRecord) -> str:
    kinds = ("feasible", "but_impact", "survived")
    feasible, apart, made = (f"{100 * cell[kind][0]:.0f}" for kind in kinds)
    counted = feasible if apart == "0" else f"{feasible} + {apart}"
    return counted if feasible == made else f"{counted} ({made})"
