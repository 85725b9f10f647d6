"""`biped-adrc compare`: the comparison of controllers over conditions and seeds, as it is or frozen (--bench).

It checks the names, starts workers as `sweep` does, and leaves the walks, figures, page and summary
to `bench.compare_study.run_comparison`, those of a benchmark to `bench.benchmark_run.run_benchmark`. What
is printed is made from the summary or the result alone, so it can be had again from their files.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Column, Table

from biped_adrc.cli.app import app, command, console, say
from biped_adrc.cli.options import texts
from biped_adrc.cli.sweep import carried_out, study_workers
from biped_adrc.errors import InputError
from biped_adrc.types import PlainRecord

if TYPE_CHECKING:
    from biped_adrc.campaign.workers import Workers


@app.command()
@texts("compare")
def compare(
    controller: str | None = None,
    out: Path = Path("comparison"),
    bench: str | None = None,
    controllers: str | None = None,
    conditions: str | None = None,
    seeds: int = 20,
    pushes: bool = True,
    plant: str = "rigid",
    settings: str | None = None,
    workers: int | None = None,
    threads: bool = False,
    scheduler: str | None = None,
    other_versions: bool = False,
) -> None:
    """Which controller walks legally under what: controllers x conditions x seeds, with intervals and tests."""
    crew = study_workers(workers, threads, scheduler)
    if bench is not None:
        told = {"--controllers": controllers, "--conditions": conditions}
        frozen = told | {"--no-pushes": not pushes, "--plant": plant != "rigid"}
        _check_bench(controller, [name for name, given in frozen.items() if given])
        _bench(bench, str(controller), out, settings, seeds, crew, other_versions)
        return
    if controller is not None:
        raise InputError(
            f"'{controller}' goes with --bench; without it give --controllers {controller}"
        )
    from biped_adrc.bench.compare_study import RESULTS, run_comparison
    from biped_adrc.bench.conditions import conditions_on
    from biped_adrc.bench.settings import TUNED, settings_of

    chosen = TUNED if settings is None else settings_of(settings)
    every = tuple(chosen.contestants), conditions_on(plant, chosen.alike)
    asked = _names(controllers, every[0]), _names(conditions, every[1]), seeds, pushes
    with carried_out(
        "walking", out / RESULTS, None, "{:.0f} s left in this round".format
    ) as progress:
        summary = run_comparison(
            out, command(), *asked, crew, progress, other_versions, plant, chosen
        )
    _print(summary)
    say(f"written to {out}: comparison.html, summary.json, figures, {RESULTS}")


def _check_bench(controller: str | None, frozen: list[str]) -> None:
    """Raises InputError for a benchmark without a controller, or with options of what is frozen in it."""
    if controller is None:
        raise InputError("--bench needs the controller that is walked, as package.module:Class")
    if frozen:
        raise InputError(
            f"--bench has its own conditions and controllers; leave out {', '.join(frozen)}"
        )


def _bench(
    name: str,
    controller: str,
    out: Path,
    settings: str | None,
    seeds: int,
    crew: Workers,
    other_versions: bool,
) -> None:
    """Walk a controller under a benchmark, and print its result beside those of NPD and m = 1."""
    from biped_adrc.bench.benchmark_run import run_benchmark

    given = None if settings is None else Path(settings)
    with carried_out(
        "walking", out / f"{name}.sqlite", None, "{:.0f} s left in this round".format
    ) as progress:
        asked = name, controller, out, command(), given, seeds
        result = run_benchmark(*asked, crew, progress, other_versions)
    _print_bench(result)
    say(f"written to {out / f'{name}.json'}")


BESIDE = ("NPD", "m = 1")
"""Reference controllers that are printed beside the result; the file has all of them."""


def _print_bench(result: PlainRecord) -> None:
    """The table of legal walks [%] and rms errors [mrad], and whether the result may be published."""
    from biped_adrc.viz.comparison_text import interval

    title = "legal walks, %, and the median of their rms errors, mrad"
    own = result["controller"]["name"]
    beside = [name for name in BESIDE if name in result["reference"]]
    table = Table("condition", *(Column(x, overflow="fold") for x in (own, *beside)), title=title)
    every = [result["cells"], *(result["reference"][name] for name in beside)]
    for condition in result["cells"]:
        told = (
            f"{100 * of[condition]['legal'][0]:.0f}; {interval(of[condition]['rms_error'], 3, 1e3)}"
            for of in every
        )
        table.add_row(condition, *told)
    console.print(table)
    say("publishable" if result["publishable"] else f"not publishable: {result['why']}")


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
    """The table of the share of walks that are legal, in brackets of those that make all steps where they are
    more, and all sentences.
    """
    from biped_adrc.viz.comparison_text import nominal_text

    controllers = list(summary["controllers"])
    columns = (Column(name, overflow="fold") for name in controllers)
    title = "legal walks, % (all that make all steps, %)"
    table = Table("condition", *columns, title=title, padding=(0, 0, 0, 1))
    found = {(c["condition"], c["controller"]): _shares(c) for c in summary["cells"]}
    for condition in summary["conditions"]:
        table.add_row(condition, *(found[condition, name] for name in controllers))
    say(nominal_text(summary["nominal"]))
    console.print(table)
    say(summary["settings"])
    for line in (line for family in summary["findings"].values() for line in family):
        say(line)


def _shares(cell: PlainRecord) -> str:
    legal, made = (f"{100 * cell[kind][0]:.0f}" for kind in ("legal", "survived"))
    return legal if legal == made else f"{legal} ({made})"
