"""What the study of soft ground says on cells on which nothing was chosen: a section of docs/soft_walk.md."""

from __future__ import annotations

from collections.abc import Sequence

import soft_cells as cells
from soft_cells import NPD, Row
from soft_text import number, out_of, percent
from write_results import table

HELD_OUT = """Bandwidths and windows were chosen on the cells above. `{command}`
walks {walks} others: friction {friction}, no push, the paper's and {draws} fresh draws of the random one; gaits
and time constants are the same. The cells of one draw differ in gait and ground alone. They are easier in two
ways: NPD walks without slip in {dry} ({dry_study} in the study), and the paper's push, in whose window the last
touchdown is not over on the softest ground, is one of {pushed} pushes ({pushed_study} in the study)."""
SHARES = (
    "push at most 1/4",
    "of the paper's push",
    "touchdown at most 1.1",
    "walks where NPD walks",
)
"""Headings of what is held against the study."""


def held_out(rows: Sequence[Row], fresh: Sequence[Row], command: str) -> list[str]:
    """Heading, text and table: the shares of the goal in fresh rows beside those of the study.

    command: that walked the fresh ones.
    """
    levels = {name: list(dict.fromkeys(row[name] for row in fresh)) for name in cells.WHERE}
    told = HELD_OUT.format(
        command=command,
        walks=len(fresh),
        friction=", ".join(f"{x:g}" for x in levels["ground_friction"]),
        draws=sum(name.startswith("random") for name in levels["condition"]),
        dry=dry(fresh),
        dry_study=dry(rows),
        pushed=len(levels["condition"]) - 1,
        pushed_study=len({row["condition"] for row in rows}) - 1,
    )
    named = [case for case in cells.cases(fresh) if case != NPD]
    met = [case for case in named if cells.meets(cells.pairs(fresh, case))]
    verdict = f"by {', '.join(met)}" if met else "by no case"
    head = ["case", *(text for name in SHARES for text in (name, "held out"))]
    lines = [beside(case, rows, fresh) for case in named]
    return [
        "## On cells that chose nothing",
        f"{told} The goal is met there {verdict}.",
        table(head, lines),
    ]


def dry(rows: Sequence[Row]) -> str:
    """In how many cells NPD walks without slip."""
    npd = cells.of(rows, case=NPD)
    return f"{out_of(sum(map(cells.without_slip, npd)), len(npd))} cells"


def beside(case: str, rows: Sequence[Row], fresh: Sequence[Row]) -> list[str]:
    """A row of the table: each share of the study, and held out."""
    both = zip(shown(rows, case), shown(fresh, case), strict=True)
    return [case, *(text for pair in both for text in pair)]


def shown(rows: Sequence[Row], case: str) -> list[str]:
    """Of a case, what SHARES says, with the largest touchdown."""
    found = cells.pairs(rows, case)
    those = cells.pushed(found)
    paper = [pair for pair in those if pair.case["condition"] == "paper"]
    touch = cells.kept(found, "touchdown_error", cells.TRANSIENT)
    largest = number(max(cells.ratios(found, "touchdown_error"), default=None))
    walked = sum(bool(pair.case["survived"]) for pair in found)
    quarters = [(cells.kept(x, "pushed_error", cells.AT_MOST), len(x)) for x in (those, paper)]
    return [
        *(f"{out_of(*x)} ({percent(*x)})" for x in quarters),
        f"{out_of(touch, len(found))} ({percent(touch, len(found))}; largest {largest})",
        out_of(walked, len(found)),
    ]
