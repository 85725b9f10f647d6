"""Write docs/comparison.md and its figures, and what tuned orders are worth into the observer guide and README.

Run: python docs/write_comparison.py OUT

OUT: folder of `biped-adrc compare`, or docs/comparison, whose summary.json has all that is needed: the figures
are drawn anew from it, with a file of their numbers beside each. All sentences about controllers are those of
the summary, which tests of paired walks carry; nothing is said here that is not there.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tuned_orders import guide_part, readme_part
from write_results import bullets, table

from biped_adrc.bench.compare_study import figures
from biped_adrc.errors import InputError
from biped_adrc.files import write_bytes, write_text
from biped_adrc.viz.comparison_text import (
    MEDIANS,
    PUSHES,
    SETTINGS,
    SHARES,
    TITLE,
    UNDER,
    WHAT_COUNTS,
    by_condition,
    by_direction,
    condition_texts,
    median_texts,
    nominal_text,
    push_texts,
    said,
    setting_texts,
    share_texts,
)
from biped_adrc.viz.figure_numbers import as_text, numbers_of
from biped_adrc.viz.pages import captions
from biped_adrc.viz.style import render

DOCS = Path(__file__).resolve().parent
PAGE, GUIDE, README = (
    DOCS / "comparison.md",
    DOCS / "guide" / "observer.md",
    DOCS.parent / "README.md",
)
FOLDER = DOCS / "comparison"
BEGIN, END = "<!-- tuned orders: begin -->", "<!-- tuned orders: end -->"


def page(summary: dict[str, Any]) -> str:
    """The text of docs/comparison.md."""
    cells = by_condition(summary["cells"])
    pushes = summary["pushes"]
    parts = [
        f"# {TITLE}",
        f"**{summary['settings']}**",
        f"Written by `python docs/write_comparison.py` from `{summary['command']}`: {summary['walks']} "
        f"walks of RABBIT, {len(summary['controllers'])} controllers, {len(summary['conditions'])} conditions, "
        f"{summary['seeds']} seeds. Every controller meets the same draws. {WHAT_COUNTS}",
        "## What the numbers say",
        WORDS,
        bullets(said(summary, equal=False)) or NONE,
        *(figure(name) for name in captions("comparison") if name != "pushes" or pushes),
        "## The table",
        nominal_text(summary["nominal"]),
        "Shares of walks with Wilson's intervals; what walks need, over those that make all steps:",
        table(list(SHARES), [share_texts(c) for c in cells]),
        "Medians over legal walks with bootstrap intervals:",
        table(list(MEDIANS), [median_texts(c) for c in cells]),
        "## Largest pushes",
        *([PUSH_WORDS, table(list(PUSHES), _pushes(pushes))] if pushes else [NO_PUSHES]),
        "## Controllers and conditions",
        table(["controller", "what it is"], [list(x) for x in summary["controllers"].items()]),
        table(list(UNDER), condition_texts(summary)),
        SETTINGS_WORDS,
        table(list(SETTINGS), setting_texts(summary["set"], summary["places"])),
        "## Versions",
        table(["part", "version"], [list(x) for x in summary["versions"].items()]),
    ]
    return "\n\n".join(parts) + "\n"


NONE = "No difference is carried by its test."
WORDS = (
    "Each sentence stands on walks paired by their seeds and on an exact test (McNemar's for shares, the sign "
    "test for the rest, Holm's correction over all questions of a kind); what no test carries is not here. "
    "Controllers are held against NPD, and higher orders of the observer against m = 1, each at its own tuned "
    "setting. The seeds are none of those that a search has walked."
)
PUSH_WORDS = (
    "In N m, between what the median over seeds lies, and between what all seeds lie. Where the highest torque "
    "tried is passed it is only known to be at least that, so there are no means."
)
NO_PUSHES = (
    "These walks were made with `--no-pushes`: the largest push that each controller bears was not searched. "
    "Without that option `compare` searches it, over 12 combinations of joints and phase, which takes some "
    "seven times as many walks."
)
SETTINGS_WORDS = (
    "Values of a scenario, by the place where they were tuned. PD, ADRC of the outputs and CLF-QP have no "
    "tuned setting and are not compared; `--controllers` takes them, as published, and `--settings "
    "as-published` compares all as their authors or examples set them."
)


def _pushes(pushes: list[dict[str, Any]]) -> list[list[str]]:
    return [push_texts(p) for p in by_direction(pushes)]


def figure(name: str) -> str:
    """A figure with its caption."""
    title, caption = captions("comparison")[name]
    return f"## {title}\n\n![{title}](comparison/{name}.svg)\n\n{caption}"


def put(text: str, part: str, marks: tuple[str, str] = (BEGIN, END)) -> str:
    """A page with `part` between its marks. Raises InputError."""
    begin, end = marks
    if text.count(begin) != 1 or text.count(end) != 1:
        raise InputError(
            f"the page has not one '{begin}' and one '{end}'; put them where the part belongs"
        )
    before, rest = text.split(begin)
    return f"{before}{begin}\n\n{part}\n\n{end}{rest.split(end)[1]}"


def read(path: Path) -> dict[str, Any]:
    """A summary. Raises InputError where there is none."""
    if not path.is_file():
        raise InputError(f"'{path}' is not there; run 'biped-adrc compare' to its end first")
    summary: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return summary


def compact(summary: Mapping[str, Any]) -> str:
    """The summary as `read` reads it: a line for each of its parts, and for each item of a list."""
    parts = []
    for name, part in summary.items():
        body = json.dumps(part, ensure_ascii=False, separators=(",", ":"))
        if isinstance(part, list) and part:
            lines = (json.dumps(x, ensure_ascii=False, separators=(",", ":")) for x in part)
            body = "[\n" + ",\n".join(lines) + "\n]"
        parts.append(f"{json.dumps(name)}: {body}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def main() -> None:
    """Read, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    summary = read(parser.parse_args().out / "summary.json")
    for path, part in ((GUIDE, guide_part(summary)), (README, readme_part(summary))):
        write_text(path, put(path.read_text(encoding="utf-8"), part))
    for name, drawn in figures(summary).items():
        write_bytes(FOLDER / f"{name}.svg", render(drawn, "svg"))
        write_text(FOLDER / f"{name}.json", as_text(numbers_of(drawn)))
    write_text(FOLDER / "summary.json", compact(summary))
    write_text(PAGE, page(summary))


if __name__ == "__main__":
    main()
