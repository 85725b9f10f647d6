"""What a comparison says in words: a sentence is there when a test of paired walks carries it, or absent.

Controllers are held against NPD, which has the same gains and no observer; two observers only at equal
bandwidth beside their own. Walks are paired by seed, and what is compared of a pair asks both to be legal. Each
family of questions has a sign test or McNemar's, corrected by Holm for all questions of the family; an effect
must lie beyond a margin with its whole interval of 95 %.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from biped_adrc.studies.bench.cell import Cell, is_legal, number
from biped_adrc.studies.bench.comparison import Comparison
from biped_adrc.studies.bench.conditions import record
from biped_adrc.studies.bench.largest_push import MATCHED, Largest, median_span
from biped_adrc.studies.bench.statistics import (
    CONFIDENCE,
    Interval,
    Tested,
    holm,
    mcnemar,
    paired_equal,
    paired_ratio,
    sign_test,
)
from biped_adrc.studies.bench.trial import Trial

EQUAL = "equal_bandwidth"
"""The family of questions about observers at equal bandwidth."""
REFERENCE = "NPD"
"""Whom the others are held against."""
MARGIN = 1.1
"""A ratio of two medians nearer to 1 than this is not worth a sentence."""
SPEED = 0.01
"""Changes of speed that differ by less than this are alike."""
RATIOS = {
    "peak_error": "largest tracking error",
    "rms_torque": "rms torque",
    "cost_of_transport": "cost of transport",
}


@dataclass(frozen=True)
class Question:
    """One question to the numbers, and what its test says."""

    family: str
    condition: str
    controller: str
    pairs: int
    words: str
    """What is said of this controller where the test carries it."""
    p: float
    """Of this question alone."""
    beyond: bool
    """Whether the effect lies beyond the margin with its whole interval."""
    value: Interval | None = None


@dataclass(frozen=True)
class Answer:
    """A question, its p-value corrected for all of its family, and whether it is carried."""

    question: Question
    p: float

    @property
    def carried(self) -> bool:
        """Whether it may be said."""
        return self.question.beyond and self.p < 1.0 - CONFIDENCE

    def row(self) -> dict[str, Any]:
        """As plain values."""
        q = self.question
        return {
            "family": q.family,
            "condition": q.condition,
            "controller": q.controller,
            "pairs": q.pairs,
            "value": None if q.value is None else list(q.value),
            "p": self.p,
            "carried": self.carried,
            "words": q.words,
        }


def answers(c: Comparison) -> list[Answer]:
    """To all questions that the walks allow."""
    families: dict[str, list[Question]] = {}
    for q in _questions(c):
        families.setdefault(q.family, []).append(q)
    return [
        Answer(q, p)
        for asked in families.values()
        for q, p in zip(asked, holm([q.p for q in asked]), strict=True)
    ]


def sentences(found: Sequence[Answer]) -> dict[str, list[str]]:
    """What is carried, by family: one sentence for each condition, and no family without one."""
    words: dict[tuple[str, str], list[str]] = {}
    for a in found:
        if a.carried:
            words.setdefault((a.question.family, a.question.condition), []).append(a.question.words)
    said: dict[str, list[str]] = {}
    for (family, what), each in words.items():
        said.setdefault(family, []).append(f"{what}: {OPENINGS[family]}: {'; '.join(each)}.")
    return said


OPENINGS = {
    "legal": f"legal walks, in pairs of the same seed as {REFERENCE}",
    **{
        name: f"{text} as a multiple of that of {REFERENCE}, median over pairs of legal walks (95 %)"
        for name, text in RATIOS.items()
    },
    "speed_change": f"the speed changes as under {REFERENCE}; median difference of the relative changes over "
    "pairs of legal walks (95 %)",
    EQUAL: "ratio of the largest errors of two observers at their own settings, and all at equal "
    "bandwidth, median over pairs of legal walks (95 %)",
    "pushes": f"the largest push that is walked legally, median over seeds, against that of {REFERENCE}",
}
"""What the sentences of a family are about."""


def bandwidth_decides(condition: str) -> bool:
    """Whether sensors or a delay limit the bandwidth: there another bandwidth or a filter reverses an order."""
    trial = Trial(**record(condition, REFERENCE, 0))
    noisy = trial.counts is not None or trial.noise + trial.pitch_noise + trial.rate_noise > 0.0
    return noisy or trial.delay > 0.0 or trial.velocity != "measured"


def _questions(c: Comparison) -> Iterable[Question]:
    others = [name for name in c.controllers if name != REFERENCE]
    if REFERENCE in c.controllers:
        for condition in c.conditions:
            if not bandwidth_decides(condition):
                usual = c.cell(REFERENCE, condition)
                for name in others:
                    yield from _against(c.cell(name, condition), usual)
        for name in others:
            yield from _pushes(c.pushes, name)
    yield from _equal(c)


def _against(cell: Cell, usual: Cell) -> Iterable[Question]:
    """One controller against the reference, under one condition."""
    yield _legality(cell, usual)
    for name in RATIOS:
        a, b = _both_legal([cell, usual], name)
        found = paired_ratio(a, b, MARGIN)
        if found is not None:
            text = f"{cell.controller} {_interval(found.value)} in {found.pairs} pairs"
            yield _question(name, cell, found, text, _beyond(found.value))
    unmatched = usual.medians({"peak_unmatched": ""})["peak_unmatched"]
    if unmatched is not None and unmatched.low > 0.0:
        a, b = _both_legal([cell, usual], "speed_change", positive=False)
        found = paired_equal(a, b, SPEED)
        if found is not None:
            text = f"{cell.controller} {_interval(found.value)} in {found.pairs} pairs"
            alike = found.value.low > -SPEED and found.value.high < SPEED
            yield _question("speed_change", cell, found, text, alike)


def _question(family: str, cell: Cell, found: Tested, text: str, beyond: bool) -> Question:
    return Question(
        family, cell.condition, cell.controller, found.pairs, text, found.p, beyond, found.value
    )


def _legality(cell: Cell, usual: Cell) -> Question:
    a, b = ([is_legal(w) for w in x.walks] for x in (cell, usual))
    text = f"{cell.controller} {sum(a)}, {REFERENCE} {sum(b)} of {len(a)}"
    return Question("legal", cell.condition, cell.controller, len(a), text, mcnemar(a, b), True)


def _both_legal(cells: Sequence[Cell], name: str, positive: bool = True) -> list[list[float]]:
    """The numbers of each cell, for the seeds that are legal in all of them and have a number there."""
    found = []
    for walks in zip(*(cell.walks for cell in cells), strict=True):
        values = [number(w, name) for w in walks]
        known = all(x is not None and (x > 0.0 or not positive) for x in values)
        if known and all(is_legal(w) for w in walks):
            found.append([x for x in values if x is not None])
    return [list(column) for column in zip(*found, strict=True)] or [[] for _ in cells]


def _beyond(ratio: Interval) -> bool:
    return ratio.high < 1.0 / MARGIN or ratio.low > MARGIN


def _equal(c: Comparison) -> Iterable[Question]:
    """Whether the ratio of two observers' errors is another at equal bandwidth."""
    for i, a in enumerate(c.equal):
        for b in c.equal[i + 1 :]:
            if a.condition == b.condition:
                own = [c.cell(x.controller, x.condition) for x in (a, b)]
                yield from _changed(own, [a, b])


def _changed(own: Sequence[Cell], equal: Sequence[Cell]) -> Iterable[Question]:
    errors = [np.array(x) for x in _both_legal([*own, *equal], "peak_error")]
    before, after = errors[0] / errors[1], errors[2] / errors[3]
    found = paired_ratio(list(before), list(after), MARGIN)
    if found is None:
        return
    ones = [1.0] * found.pairs
    r, s = (paired_ratio(list(x), ones, 1.0) for x in (before, after))
    assert r is not None
    assert s is not None
    turned = (r.value.high < 1.0 < s.value.low) or (s.value.high < 1.0 < r.value.low)
    text = (
        f"{equal[0].controller} to {equal[1].controller} {_interval(r.value)} and {_interval(s.value)} in "
        f"{found.pairs} pairs{', the order changes' if turned else ''}"
    )
    yield _question(EQUAL, equal[0], found, text, _beyond(found.value))


def _pushes(pushes: Sequence[Largest], name: str) -> Iterable[Question]:
    """Whether one controller's largest legal pushes on the joints are larger or smaller than the reference's.

    The units of the test are the combinations of joints and phase; one counts where the medians' intervals do
    not overlap.
    """
    spans = {(p.controller, p.direction, p.phase): median_span(p.legal) for p in pushes}
    places = [key[1:] for key in spans if key[0] == REFERENCE and key[1] in MATCHED]
    both = [(spans[name, *place], spans[REFERENCE, *place]) for place in places]
    larger = sum(a.low >= b.high for a, b in both)
    smaller = sum(a.high <= b.low for a, b in both)
    if places:
        text = (
            f"{name} larger in {larger}, smaller in {smaller} of {len(places)} combinations of "
            "joints and phase"
        )
        p = sign_test(larger, smaller)
        yield Question("pushes", "pushes on joints", name, len(places), text, p, True)


def _interval(x: Interval) -> str:
    return f"{x.value:.2g} ({x.low:.2g} to {x.high:.2g})"
