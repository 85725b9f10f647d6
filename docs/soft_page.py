"""The text of docs/soft_walk.md from the numbers in its summary.json: `page`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import median, quantiles
from typing import Any

import soft_cells as cells
from soft_cells import NPD, Pair, Row
from soft_held_out import held_out
from soft_text import bullets, number, out_of, percent, rows_of
from write_results import table

from biped_adrc.viz.pages import captions

PICTURES = {"walk": "walk.gif", "touchdown": "touchdown.svg"}
MRAD = 1e3
"""mrad in a rad, and mm in a m."""


INTRODUCTION = """Written by `python docs/write_soft_walk.py` from `{command}`: {walks} walks of RABBIT in
MuJoCo, of {impacts} steps each, sampled at 1 kHz from exact angles and rates, with motors of 150 N m. {cases}
controllers, each with one [policy across contact](guide/contact.md) for all cells, walk {cells} cells: gaits
{gaits}; ground with friction {friction} and time constants T of {constants} ms ([solref](guide/mujoco.md));
no push, the paper's (30 N m on q1 to q4 from 0.1 to 0.3 s of step 3), and a random one, drawn once (up to
60 N m on each joint for 0.2 s of step 3). The engine's step is a tenth of the time constant, at most 0.2 ms.

Contact that takes time moves the joints at every touchdown, whatever the controller, so two errors are kept
apart:

- **touchdown**: the largest within 60 ms after a touchdown, from the second single support on;
- **push**: the largest from the onset of the push to 50 ms after its end, outside those 60 ms.

Both are held against NPD, which has the same gains (those of the paper) and no observer, in the same cell. The
goal was set before: with one observer and one policy for all cells, an error of the push of at most {at_most:g}
of NPD's in at least {share:.0f} % of the pushed cells in which NPD walks, and a touchdown of at most
{transient:g} times NPD's. A walk that does not make its steps misses the goal. The bandwidths and windows below
were chosen by looking at cells of this study, and **no claim is made here against controllers that are tuned
alike**: NPD with other gains, or a filter of the rates, would be another row."""


def page(summary: Mapping[str, Any], fresh: Mapping[str, Any]) -> str:
    """The text of docs/soft_walk.md; fresh: of the study on cells that chose nothing."""
    rows = rows_of(summary)
    near = cells.nearest(rows)
    parts = [
        "# What survives on soft ground",
        introduction(summary["command"], rows),
        "## The goal",
        bullets(verdicts(rows, near)),
        table(list(GOAL), [goal_texts(rows, case) for case in cells.cases(rows) if case != NPD]),
        "Counts are over all cells; medians, largest values and *95 %*, below which 95 % of the ratios lie, "
        "are of the walks that are made.",
        *held_out(rows, rows_of(fresh), fresh["command"]),
        f"## What stands in the way of {near}",
        bullets([*obstacles(rows, near), *by_difference(summary["caused"])]),
        "Pushed cells in which it keeps within a quarter:",
        table(["", *heads(rows)], shares(rows, near)),
        "## Who walks",
        bullets(walkers(rows)),
        table(*by_friction(rows)),
        f"Without slip: all steps made, and in none a foot slips further than {MRAD * cells.NO_SLIP:g} mm, "
        "moving faster than 5 mm/s at the edge of the friction cone; read at the sample instants.",
        "## Errors",
        "Medians in mrad over the pushed cells in which both the case and NPD walk, NPD's in brackets; "
        "*settled*: without the 60 ms after each touchdown.",
        table(["case", "cells", *NAMES.values()], [errors(rows, c) for c in cells.cases(rows)[1:]]),
        "Push as a multiple of NPD's, median over the pushed cells in which both walk:",
        table(*by_constant(rows)),
        *(
            part
            for name, (title, caption) in captions("soft_walk").items()
            for part in (f"## {title}", f"![{title}](soft_walk/{PICTURES[name]})", caption)
        ),
        "## At half the engine's step",
        bullets(at_half(summary["halved"])),
    ]
    return "\n\n".join(parts) + "\n"


def introduction(command: str, rows: Sequence[Row]) -> str:
    """What was walked."""
    levels = {name: list(dict.fromkeys(row[name] for row in rows)) for name in cells.WHERE}
    return INTRODUCTION.format(
        command=command,
        walks=len(rows),
        impacts=max(row["impacts"] for row in rows),
        cases=len(cells.cases(rows)),
        cells=len({cells.cell(row) for row in rows}),
        gaits=", ".join(f"`{x}`" for x in levels["gait"]),
        friction=", ".join(f"{x:g}" for x in levels["ground_friction"]),
        constants=", ".join(f"{MRAD * x:g}" for x in levels["time_constant"]),
        at_most=cells.AT_MOST,
        share=100.0 * cells.SHARE,
        transient=cells.TRANSIENT,
    )


def verdicts(rows: Sequence[Row], near: str) -> list[str]:
    """Whether the goal is met, and by how much not."""
    named = [c for c in cells.cases(rows) if c != NPD]
    met = [case for case in named if cells.meets(cells.pairs(rows, case))]
    found = cells.pairs(rows, near)
    those = cells.pushed(found)
    quarter, touch = (
        cells.kept(those, "pushed_error", cells.AT_MOST),
        cells.kept(found, "touchdown_error", cells.TRANSIENT),
    )
    said = f"**The goal is met by {', '.join(met)}.**" if met else "**No case meets the goal.**"
    largest = cells.ratios(found, "touchdown_error")[-1]
    share = f"{percent(quarter, len(those))}, where {100 * cells.SHARE:.0f} % were asked"
    return [
        f"{said} Nearest, among the cases that walk wherever NPD walks, is {near}: its error of the push is at "
        f"most a quarter of NPD's in {quarter} of {len(those)} cells ({share}), and its touchdown within "
        f"{cells.TRANSIENT:g} times NPD's in {touch} of {len(found)} (largest {largest:.2f}).",
        *beside(rows, named, near),
    ]


def beside(rows: Sequence[Row], named: Sequence[str], near: str) -> list[str]:
    """The case with the smallest errors of a push, where that is another one."""
    medians = {
        c: cells.middle(cells.ratios(cells.pushed(cells.pairs(rows, c)), "pushed_error"))
        for c in named
    }
    least = min((c for c in named if medians[c] is not None), key=lambda c: medians[c] or 0.0)
    if least == near:
        return []
    found = cells.pairs(rows, least)
    lost = sum(not pair.case["survived"] for pair in found)
    return [
        f"The smallest errors are those of {least}: the median is {medians[least]:.3f} of NPD's. It does not "
        f"make its steps in {lost} of the {len(found)} cells in which NPD does."
    ]


GOAL = (
    *("case", "walks where NPD walks", "push at most 1/4", "push, median", "push, 95 %"),
    *(
        "touchdown at most 1.1",
        "touchdown, median",
        "touchdown, largest",
        "the same without a push",
    ),
)
"""Headings of the table of the goal."""


def goal_texts(rows: Sequence[Row], case: str) -> list[str]:
    """A case against the goal, as the row of a table."""
    found = cells.pairs(rows, case)
    those = cells.pushed(found)
    push, touch = cells.ratios(those, "pushed_error"), cells.ratios(found, "touchdown_error")
    still = cells.ratios(cells.unpushed(found), "touchdown_error")
    return [
        case,
        out_of(sum(bool(pair.case["survived"]) for pair in found), len(found)),
        out_of(cells.kept(those, "pushed_error", cells.AT_MOST), len(those)),
        number(cells.middle(push)),
        number(quantiles(push, n=20, method="inclusive")[-1] if len(push) > 1 else None),
        out_of(cells.kept(found, "touchdown_error", cells.TRANSIENT), len(found)),
        number(cells.middle(touch)),
        number(touch[-1] if touch else None),
        number(still[-1] if still else None),
    ]


def obstacles(rows: Sequence[Row], case: str) -> list[str]:
    """Where a case misses a quarter, and what NPD's error is there without any push."""
    those = cells.pushed(cells.pairs(rows, case))
    missed = cells.missed(those)
    slips = sum(not (cells.without_slip(p.npd) and cells.without_slip(p.case)) for p in missed)
    dry = [p for p in those if cells.without_slip(p.npd) and cells.without_slip(p.case)]
    good = cells.kept(dry, "pushed_error", cells.AT_MOST)
    low = cells.floors(rows, missed)
    above = sum(x > cells.AT_MOST for _, x in low)
    rest = [p for p in dry if p.case["time_constant"] < SOFT]
    hard = cells.kept(rest, "pushed_error", cells.AT_MOST)
    return [
        f"It misses a quarter in {len(missed)} of {len(those)} cells. In {slips} of these a foot slips under "
        "NPD, under the case, or under both.",
        f"Of the {len(dry)} cells in which neither slips it keeps within a quarter in {good} "
        f"({percent(good, len(dry))}); of those with a time constant below {MRAD * SOFT:g} ms in {hard} of "
        f"{len(rest)} ({percent(hard, len(rest))}).",
        f"Of the {len(low)} cells missed under the paper's push, NPD has in {above} more than a quarter of its "
        "error in the same window of the walk *without* a push: there the touchdown is not over after 100 ms, "
        "and no controller that leaves it as it is can keep within a quarter.",
    ]


def by_difference(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """What the push alone causes."""
    if not found:
        return []
    ratios = sorted(x["case"] / x["npd"] for x in found)
    within = sum(x <= cells.AT_MOST for x in ratios)
    return [
        "What the push alone causes, as the largest difference of the errors with and without it under the "
        f"same controller in the same step, is within a quarter of NPD's in {within} of {len(found)} cells "
        f"({percent(within, len(found))}); the median is {number(median(ratios))}, the largest "
        f"{number(ratios[-1])}. This is not the figure that the goal was set for."
    ]


SOFT = 2e-2
"""From this time constant on a touchdown lasts into the window of the paper's push [s]."""


def heads(rows: Sequence[Row]) -> list[str]:
    """Time constants, as headings."""
    return [f"T = {MRAD * x:g} ms" for x in dict.fromkeys(row["time_constant"] for row in rows)]


def shares(rows: Sequence[Row], case: str) -> list[list[str]]:
    """In how many pushed cells a case keeps within a quarter, by friction and gait, and by time constant."""
    those, table_rows = cells.pushed(cells.pairs(rows, case)), []
    for by in ("ground_friction", "gait"):
        for x in dict.fromkeys(row[by] for row in rows):
            line = [f"{by.removeprefix('ground_')} {x}"]
            for T in dict.fromkeys(row["time_constant"] for row in rows):
                here = [p for p in those if (p.case[by], p.case["time_constant"]) == (x, T)]
                line.append(out_of(cells.kept(here, "pushed_error", cells.AT_MOST), len(here)))
            table_rows.append(line)
    return table_rows


def walkers(rows: Sequence[Row]) -> list[str]:
    """In how many cells NPD walks, and nobody."""
    npd = cells.of(rows, case=NPD)
    here = {cells.cell(row) for row in npd}
    walked = {cells.cell(row) for row in rows if row["survived"]}
    dry = sum(map(cells.without_slip, npd))
    ends = dict.fromkeys(row["status"] for row in rows if not row["survived"])
    counts = [f"{name} {sum(row['status'] == name for row in rows)}" for name in ends]
    return [
        f"NPD makes all steps in {sum(bool(row['survived']) for row in npd)} of {len(here)} cells, in {dry} "
        f"without slip. In {len(here - walked)} cells nobody walks.",
        f"Ends of the walks that did not make all steps: {', '.join(counts) or 'none'}.",
    ]


def by_friction(rows: Sequence[Row]) -> tuple[list[str], list[list[str]]]:
    """Walks made, and made without slip, by friction."""
    levels = list(dict.fromkeys(row["ground_friction"] for row in rows))
    heads = [f"{what} {mu:g}" for mu in levels for what in ("walks, friction", "without slip,")]
    lines = []
    for case in cells.cases(rows):
        line = [case]
        for mu in levels:
            here = cells.of(rows, case=case, ground_friction=mu)
            line.append(out_of(sum(bool(row["survived"]) for row in here), len(here)))
            line.append(out_of(sum(map(cells.without_slip, here)), len(here)))
        lines.append(line)
    return ["case", *heads], lines


NAMES = {
    "pushed_error": "push",
    "touchdown_error": "touchdown",
    "peak_error": "peak",
    "settled_error": "settled peak",
    "rms_error": "rms",
    "settled_rms": "settled rms",
}
"""Columns of the table of errors."""


def errors(rows: Sequence[Row], case: str) -> list[str]:
    """Medians of a case and of NPD in the same cells."""
    both = [p for p in cells.pushed(cells.pairs(rows, case)) if p.case["survived"]]
    return [case, str(len(both)), *(_beside(both, column) for column in NAMES)]


def _beside(both: Sequence[Pair], column: str) -> str:
    """Median of a case and, in brackets, of NPD; a dash of nothing."""
    if not both:
        return "–"
    mine, its = (median(pair[k][column] for pair in both) for k in (0, 1))
    return f"{MRAD * mine:.2f} ({MRAD * its:.2f})"


def by_constant(rows: Sequence[Row]) -> tuple[list[str], list[list[str]]]:
    """Median ratio of the push's error by time constant."""
    lines = []
    for case in cells.cases(rows)[1:]:
        those = cells.pushed(cells.pairs(rows, case))
        line = [case]
        for T in dict.fromkeys(row["time_constant"] for row in rows):
            here = [p for p in those if p.case["time_constant"] == T]
            line.append(number(cells.middle(cells.ratios(here, "pushed_error"))))
        lines.append(line)
    return ["case", *heads(rows)], lines


def at_half(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """How much errors, and their ratios to NPD's, change at half the engine's step."""
    npd = {cells.cell(row): row for row in found if row["case"] == NPD}
    lines = []
    for case in dict.fromkeys(row["case"] for row in found):
        walked = [row for row in found if row["case"] == case]
        here = [row for row in walked if row["half"]["survived"]]
        beside = [
            (row, npd[cells.cell(row)]) for row in here if cells.cell(row) in npd and case != NPD
        ]
        texts, moved = [], 0.0
        for name, word in (("pushed_error", "push"), ("touchdown_error", "touchdown")):
            texts.append(f"{word} by {_changes([_change(row, name) for row in here])}")
            ratios = [_change(row, name) / _change(its, name) for row, its in beside]
            if ratios:
                texts.append(f"as a multiple of NPD's by {_changes(ratios)}")
                moved = max(abs(x - 1.0) for x in ratios)
        fell = len(walked) - len(here)
        walk = f"{fell} do not make their steps" if fell else "all make their steps"
        lines.append(
            f"{case}, {len(walked)} pushed walks spread over the study: {'; '.join(texts)}; {walk}."
        )
        if moved:
            low, high = (cells.TRANSIENT * (1.0 + sign * moved) for sign in (-1.0, 1.0))
            lines.append(
                f"So a touchdown between {low:.2f} and {high:.2f} times NPD's is at this step neither within "
                f"{cells.TRANSIENT:g} nor beyond it."
            )
    return lines


def _change(row: Mapping[str, Any], name: str) -> float:
    """An error at half the step over that at the whole one."""
    return float(row["half"][name] / row[name])


def _changes(factors: Sequence[float]) -> str:
    """Factors near 1 in words."""
    sizes = sorted(abs(x - 1.0) for x in factors)
    return f"{100 * median(sizes):.2g} % in the median and {100 * sizes[-1]:.2g} % at most"
