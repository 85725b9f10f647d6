"""Orders of the observer that were searched at equal delay margin and ripple, as a part of docs/tuned.md."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import tuned_text as words
from soft_text import bullets
from tuned_entries import Entry, entries, groups_of
from tuned_gaps import missing
from tuned_questions import Answer, Group
from tuned_seeds import repeated, scatter_of
from tuned_sentences import against
from tuned_steady import orders, steadied
from tuned_text import MRAD, interval, legal, name, ratio, setting
from write_results import table

FIRST = "m = 1"
"""The order that others are held against."""
HEADINGS = (
    *("contestant", "chosen setting", "delay margin [ms]", "ripple [N m]", "rms error [mrad]"),
    *("rms torque [N m]", "legal", "ratio to m = 1"),
)
INTRODUCTION = """Places of `benchmarks/tuned/orders.toml`, on RABBIT's hardware with 1 ms of delay and gait
v0.5. Budget, leaves and walks are those of the contest; the ripple, which is the rms torque that the counts of
the encoders alone cause, has a limit beside that of the delay margin. How searches scatter is taken from these
and those of the contest on the same hardware."""


def equal_loops(summary: Mapping[str, Any], contest: Sequence[Entry]) -> list[str]:
    """The section; nothing where no such search is there. contest: its searches, which scatter alike."""
    given = summary.get("orders")
    if not given or not given["searches"]:
        return []
    found = entries(given)
    groups = groups_of(found)
    asked = steadied(groups, found, orders, scatter_of(repeated([*contest, *found])))
    return [
        "## An order above 1 at equal delay margin and ripple",
        INTRODUCTION,
        *missing(given, found),
        bullets([said(g, asked) for g in groups if FIRST in g]),
        *(part for g in groups for part in (f"### {place(g)}", shown(g, asked))),
    ]


def place(g: Group) -> str:
    """The limits of a group in words: its place."""
    return next(iter(g.values())).place


def said(g: Group, asked: Sequence[Answer]) -> str:
    """Which orders pay under the limits of a group."""
    here = [x for x in asked if x.b is g[FIRST]]
    if not g[FIRST].found:
        return f"**{place(g)}**: m = 1 has no setting that keeps the limits."
    heads = {"smaller": "pays", "larger": "costs", "open": "is open"}
    kinds = words.by_verdict(here, against)
    told = "; ".join(f"{heads[k]}: {', '.join(x)}" for k, x in kinds.items() if x)
    error = words.error(g[FIRST].tuned)
    return f"**{place(g)}**: {name(g[FIRST])} has {error} mrad. As ratio to it {told}."


def shown(g: Group, asked: Sequence[Answer]) -> str:
    """The table of a group, by order."""
    rows = []
    for e in g.values():
        x = next((x for x in asked if x.a is e), None)
        margin = "–" if e.margins[0] is None else words.number(MRAD * e.margins[0])
        rows.append(
            [
                e.contestant,
                setting(e),
                margin,
                "–" if e.ripple is None else words.number(e.ripple),
                words.error(e.tuned) if np.isfinite(e.tuned.rms_error).any() else "–",
                interval(words.middle(e.tuned.rms_torque)),
                legal(e.tuned),
                "1" if x is None else f"{ratio(x.ratio)} ({x.verdict})",
            ]
        )
    return table(list(HEADINGS), rows)
