"""The tables of docs/tuned.md: one of answers, and one of contestants for each place and gait."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import tuned_text as words
from tuned_entries import Entry
from tuned_questions import Answer, Group
from tuned_text import MRAD, at, interval, legal, number, ratio, setting
from write_results import table

ANSWERS = (
    "place, gait",
    "contestant",
    "held against",
    "ratio of errors",
    "seeds smaller",
    "p",
    "verdict",
)
"""Headings of a table of answers, by `answer_texts`."""


def answer_table(found: Sequence[Answer]) -> str:
    """A table of answers; empty for none."""
    return table(list(ANSWERS), [answer_texts(x) for x in found]) if found else ""


def answer_texts(x: Answer) -> list[str]:
    """An answer as the row of a table."""
    seeds = x.a.tuned.legal.shape[1]
    told = [ratio(x.ratio), f"{x.won} of {seeds}", words.p_value(x.p)]
    verdict = words.verdict(x, "smaller", "larger")
    return [at(x.a), x.a.contestant, x.b.contestant, *told, verdict]


CELLS = (
    *("contestant", "chosen setting", "delay margin [ms]", "rms error [mrad]"),
    *("interquartile mean [mrad]", "rms torque [N m]", "cost of transport", "legal"),
    *("ratio to the reference", "first setting: error [mrad]", "margin [ms]", "legal"),
)
"""Headings of the table of a place and gait, by `contestant_texts`."""


def of_group(g: Group, contest: Sequence[Answer]) -> list[str]:
    """The table of a place and gait, best first."""
    ranked = sorted(g.values(), key=lambda e: float(np.median(e.tuned.rms_error)))
    lines = [contestant_texts(e, next((x for x in contest if x.a is e), None)) for e in ranked]
    return [f"### {at(ranked[0])}", table(list(CELLS), lines)]


def contestant_texts(e: Entry, x: Answer | None) -> list[str]:
    """A contestant as the row of a table."""
    tuned = [
        words.error(e.tuned),
        interval(words.interquartile(e.tuned.rms_error), MRAD),
        interval(words.middle(e.tuned.rms_torque)),
        interval(words.middle(e.tuned.cost_of_transport)),
    ]
    held = "–" if x is None else ratio(x.ratio)
    was = "–" if e.published is None else words.error(e.published)
    was_legal = "–" if e.published is None else legal(e.published)
    chosen, first = map(margin, e.margins)
    told = legal(e.tuned) if e.found else "–"
    return [e.contestant, setting(e), chosen, *tuned, told, held, was, first, was_legal]


def margin(x: float | None) -> str:
    """A delay margin [ms]; minus infinite is a loop that is not stable without any delay."""
    if x is None:
        return "–"
    return "not stable" if x == -np.inf else number(MRAD * x)
