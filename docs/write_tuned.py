"""Write docs/tuned.md and its figures: which controller is best where, each tuned by the same search.

Run: python docs/write_tuned.py OUT

OUT: folder of `python benchmarks/tuned/alike.py OUT`, finished or not, with that of orders.toml beside it as
OUT_orders; or docs/tuned, whose summary.json has all that the page says. Searches that are not there yet are
named on the page. Sentences follow from the numbers (`tuned_page`).
"""

from __future__ import annotations

import argparse
import json
import runpy
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from tuned_entries import collected, entries
from tuned_figures import drawn
from tuned_page import page
from write_comparison import compact

from biped_adrc.errors import InputError
from biped_adrc.files import write_bytes, write_text
from biped_adrc.viz.figure_numbers import as_text, numbers_of
from biped_adrc.viz.style import render

DOCS = Path(__file__).resolve().parent
PAGE, FOLDER = DOCS / "tuned.md", DOCS / "tuned"
TUNED = DOCS.parent / "benchmarks" / "tuned"
ORDERS = "_orders"
"""What a folder of searches of orders.toml is called after that of the contest."""


def summarised(out: Path) -> dict[str, Any]:
    """What the page is written from, of a folder of searches. Raises InputError where none is finished."""
    alike = runpy.run_path(str(TUNED / "alike.py"))
    contest = alike["contest"]()
    summary = collected(out, contest, list(alike["entries"](contest)))
    orders = alike["contest"](TUNED / "orders.toml")
    beside = out.with_name(out.name + ORDERS)
    summary["orders"] = collected(beside, orders, list(alike["entries"](orders)))
    if not summary["searches"]:
        raise InputError(
            f"'{out}' has no finished search; run 'python benchmarks/tuned/alike.py {out}' first"
        )
    return summary


def read(path: Path) -> dict[str, Any]:
    """A summary. Raises InputError where there is none."""
    if not path.is_file():
        raise InputError(f"'{path}' is not there; run 'make tuned' first")
    summary: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return summary


def figures(summary: Mapping[str, Any]) -> dict[str, Figure]:
    """The figures of the page by name."""
    return drawn(entries(summary))


def main() -> None:
    """Read, draw, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    out = parser.parse_args().out
    if out.resolve() != FOLDER:
        write_text(FOLDER / "summary.json", compact(summarised(out)))
    summary = read(FOLDER / "summary.json")
    for name, figure in figures(summary).items():
        write_bytes(FOLDER / f"{name}.svg", render(figure, "svg"))
        write_text(FOLDER / f"{name}.json", as_text(numbers_of(figure)))
    write_text(PAGE, page(summary))


if __name__ == "__main__":
    main()
