"""What a comparison says in words: a sentence appears if a test of paired walks supports it, otherwise not.

A table of medians invites conclusions that noise explains. Each sentence has to pass three conditions here:

    test         sign test, or McNemar's for shares, on pairs of walks with the same seed, p < 5 % after Holm's
                 correction over all questions of its family
    effect       the whole 95 % interval lies beyond a margin (ratio 1.1, relative change of speed 1 %)
    settings     both controllers are tuned for the condition. Where settings are as published, the sentence
                 about a controller with an observer holds at equal bandwidth too, and none is said where
                 sensors or a delay limit the bandwidth, so that it is not one about two settings

Controllers are compared with NPD, which has no observer. Of tuned observers those of a higher order are
compared with the one of order 1; of those as published each with each other at equal bandwidth. Errors, torques
and costs are compared where both walks of a pair are legal.

Takes a `Comparison`, gives a `Question` each and sentences; `bench.compare_study` writes them.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.statistics import (
    CONFIDENCE,
    Interval,
    Tested,
    holm,
    mcnemar,
    median_ratio,
    paired_equal,
    paired_ratio,
    sign_test,
)
from biped_adrc.bench.cell import Cell, is_legal, number
from biped_adrc.bench.comparison import Comparison
from biped_adrc.bench.conditions import PUSH_PLACE, SAID
from biped_adrc.bench.largest_push import MATCHED, PHASES, Largest, median_span
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.settings import AS_PUBLISHED

EQUAL = "equal_bandwidth"
"""The family of questions about observers at equal bandwidth."""
REFERENCE = "NPD"
"""The controller that all others are compared with."""
MARGIN = 1.1
"""Ratios of medians nearer to 1 than this factor are not worth a sentence."""
SPEED = 0.01
"""Relative changes of speed that differ by less than this are called alike."""
ORDER = "order"
"""The family of questions about observers of a higher order."""
ORDERED = "LESO"
"""The controller whose orders are compared."""
RATIOS = ("rms_error", "peak_error", "rms_torque", "cost_of_transport")
"""Measures that are compared by ratios: positive numbers."""


class Question(NamedTuple):
    """One question to the numbers, the result of its test, and the words for it."""

    family: str
    """Questions of a family are corrected together: a measure, "legal", "pushes", `ORDER` or `EQUAL`."""
    condition: str
    """Under which the walks were made."""
    controller: str
    """Of which something may be said."""
    pairs: int
    """Pairs of walks, or of pushes, that the test uses."""
    words: str
    """What is said of this controller if the test supports it."""
    p: float
    """p-value of this question alone, or corrected for all of its family."""
    beyond: bool
    """Whether the effect lies beyond the margin with its whole interval, at every setting."""
    value: Interval | None = None
    """The effect with its 95 % interval; None for shares and pushes."""

    @property
    def carried(self) -> bool:
        """Whether it may be said; of a p that is corrected."""
        return self.beyond and self.p < 1.0 - CONFIDENCE

    def row(self) -> dict[str, object]:
        """In plain values, as in summary.json."""
        found = self._asdict()
        del found["beyond"]
        words, value = found.pop("words"), found.pop("value")
        p = found.pop("p")
        value = None if value is None else list(value)
        return {**found, "value": value, "p": p, "carried": self.carried, "words": words}


def answers(c: Comparison) -> list[Question]:
    """All questions that the walks allow, with p-values corrected by Holm within their family."""
    families: dict[str, list[Question]] = {}
    for q in _questions(c):
        families.setdefault(q.family, []).append(q)
    return [
        q._replace(p=p)
        for asked in families.values()
        for q, p in zip(asked, holm([q.p for q in asked]), strict=True)
    ]


def sentences(found: Sequence[Question]) -> dict[str, list[str]]:
    """What may be said, by family: one sentence for each condition; families without one are absent."""
    said: dict[str, list[str]] = {}
    for family, what in dict.fromkeys((q.family, q.condition) for q in found if q.carried):
        words = [q.words for q in found if q.carried and (q.family, q.condition) == (family, what)]
        opening = SAID["openings"][family]
        said.setdefault(family, []).append(f"{what}: {opening}: {'; '.join(words)}.")
    return said


def bandwidth_decides(condition: str) -> bool:
    """Whether a condition has sensor noise or delay, which limit the bandwidth.

    There no order of controllers as published is stated: another bandwidth or a filter would reverse it.
    """
    s = trial(AS_PUBLISHED.record(condition, REFERENCE, 0))
    noisy = s.counts is not None or s.noise + s.pitch_noise + s.rate_noise > 0.0
    return noisy or s.delay > 0.0 or s.velocity != "measured"


def _questions(c: Comparison) -> Iterable[Question]:
    """All questions, with p-values of their own."""
    for condition in (w for w in c.conditions if c.settings.alike or not bandwidth_decides(w)):
        cells = {
            x.controller: x for x in c.cells if x.condition == condition and not x.as_published
        }
        if REFERENCE in cells:
            for name in (name for name in cells if name != REFERENCE):
                again = c.at_equal(name, condition)
                yield from _against(cells[name], again, cells[REFERENCE])
        yield from _orders(c, cells)
    if REFERENCE in c.controllers:
        for name in (name for name in c.controllers if name != REFERENCE):
            if not c.settings.as_published(name, PUSH_PLACE):
                yield from _pushes(c.pushes, name)
    yield from _equal(c)


def _orders(c: Comparison, cells: Mapping[str, Cell]) -> Iterable[Question]:
    """Whether a higher order of the same observer has another rms error than order 1, each tuned.

    cells: those of one condition that are tuned, by contestant.
    """
    orders = {name: c.settings.contestants[name].get("order") for name in c.settings.contestants}
    same = [x for n, x in cells.items() if c.settings.controller(n) == ORDERED and orders.get(n)]
    for first in (x for x in same if orders[x.controller] == 1):
        for cell in (x for x in same if x is not first):
            found = paired_ratio(*_pair(cell, first, "rms_error"), MARGIN)
            if found is not None:
                yield _question(ORDER, cell, found, _side(found) != 0)


def _against(cell: Cell, again: Cell | None, usual: Cell) -> Iterable[Question]:
    """The questions about one controller under one condition: legality, ratios, and the change of speed.

    usual: the reference's cell; again: the controller's cell at equal bandwidth, None without an observer. The
    change of speed is asked about only where the disturbance reaches the unactuated row.
    """
    settings = [cell] if again is None else [cell, again]
    yield _legality(settings, usual)
    for name in RATIOS:
        each = [paired_ratio(*_pair(x, usual, name), MARGIN) for x in settings]
        if each[0] is not None:
            held = {_side(x) for x in each} in ({-1}, {1})
            yield _question(name, cell, each[0], held)
    unmatched = usual.medians({"peak_unmatched": ""})["peak_unmatched"]
    if unmatched is not None and unmatched.low > 0.0:
        changes = (_pair(x, usual, "speed_change", positive=False) for x in settings)
        alike = [paired_equal(*change, SPEED) for change in changes]
        if alike[0] is not None:
            held = all(
                x is not None and x.value.low > -SPEED and x.value.high < SPEED for x in alike
            )
            yield _question("speed_change", cell, alike[0], held)


def _side(found: Tested | None) -> int:
    """-1 or 1 where the whole interval of a ratio lies below or above 1 by more than the margin, else 0."""
    if found is None:
        return 0
    return int(found.value.low > MARGIN) - int(found.value.high < 1.0 / MARGIN)


def _question(family: str, cell: Cell, found: Tested, beyond: bool, text: str = "") -> Question:
    """A question about one measure; text: in place of "controller, interval, number of pairs"."""
    words = text or f"{cell.controller} {_interval(found.value)} in {found.pairs} pairs"
    return Question(
        family, cell.condition, cell.controller, found.pairs, words, found.p, beyond, found.value
    )


def _legality(settings: Sequence[Cell], usual: Cell) -> Question:
    """Whether the controller walks legally more or less often than the reference: McNemar's test.

    The first of the settings is the controller's own; the others have to agree in direction and significance.
    """
    b = [is_legal(w) for w in usual.walks]
    each = [[is_legal(w) for w in cell.walks] for cell in settings]
    more = {sum(a) > sum(b) for a in each}
    held = len(more) == 1 and all(mcnemar(a, b) < 1.0 - CONFIDENCE for a in each)
    a, own = each[0], settings[0]
    text = f"{own.controller} {sum(a)}, {REFERENCE} {sum(b)} of {len(a)}"
    return Question("legal", own.condition, own.controller, len(a), text, mcnemar(a, b), held)


def _both_legal(cells: Sequence[Cell], name: str, positive: bool = True) -> list[list[float]]:
    """The measure in each cell, for the seeds whose walks are legal and have a number in all of these cells."""
    found = []
    for walks in zip(*(cell.walks for cell in cells), strict=True):
        values = [number(w, name) for w in walks]
        known = all(x is not None and (x > 0.0 or not positive) for x in values)
        if known and all(is_legal(w) for w in walks):
            found.append([x for x in values if x is not None])
    return [list(column) for column in zip(*found, strict=True)] or [[] for _ in cells]


def _pair(x: Cell, y: Cell, name: str, positive: bool = True) -> tuple[list[float], list[float]]:
    """The measure of two cells for the seeds that are legal in both."""
    a, b = _both_legal([x, y], name, positive)
    return a, b


def _equal(c: Comparison) -> Iterable[Question]:
    """For each pair of observers and condition: does the ratio of their errors change at equal bandwidth?"""
    for pair in itertools.combinations(c.equal, 2):
        if pair[0].condition == pair[1].condition:
            own = [c.cell(x.controller, x.condition) for x in pair]
            yield from _changed(own, pair)


def _changed(own: Sequence[Cell], equal: Sequence[Cell]) -> Iterable[Question]:
    """The question about one pair; own, equal: their cells at their own settings and at equal bandwidth."""
    errors = [np.array(x) for x in _both_legal([*own, *equal], "peak_error")]
    before, after = errors[0] / errors[1], errors[2] / errors[3]
    found = paired_ratio(before.tolist(), after.tolist(), MARGIN)
    if found is None:
        return
    r, s = (median_ratio(x.tolist()) for x in (before, after))
    turned = (r.high < 1.0 < s.low) or (s.high < 1.0 < r.low)
    text = (
        f"{equal[0].controller} to {equal[1].controller} {_interval(r)} and {_interval(s)} in {found.pairs} "
        f"pairs{', the order changes' if turned else ''}"
    )
    yield _question(EQUAL, equal[0], found, _side(found) != 0, text)


def _pushes(pushes: Sequence[Largest], name: str) -> Iterable[Question]:
    """Whether one controller's largest legal pushes on the joints are larger or smaller than the reference's.

    The units of the sign test are the combinations of joint pattern and phase; one counts where the intervals
    of the two medians do not overlap.
    """
    settings: dict[float | None, tuple[int, int]] = {}
    spans = {
        (p.controller, p.bandwidth, p.direction, p.phase): median_span(p.legal) for p in pushes
    }
    for who, bandwidth, direction, phase in spans:
        usual = (REFERENCE, None, direction, phase)
        if who == name and direction in MATCHED and usual in spans:
            a, b = spans[who, bandwidth, direction, phase], spans[usual]
            larger, smaller = settings.get(bandwidth, (0, 0))
            settings[bandwidth] = (larger + (a.low >= b.high), smaller + (a.high <= b.low))
    if None in settings:
        larger, smaller = settings[None]
        held = len({x > y for x, y in settings.values()}) == 1 and all(
            sign_test(*x) < 1.0 - CONFIDENCE for x in settings.values()
        )
        count = len(MATCHED) * len(PHASES)
        text = (
            f"{name} larger in {larger}, smaller in {smaller} of {count} combinations of joints and "
            "phase"
        )
        p = sign_test(larger, smaller)
        yield Question("pushes", "pushes on joints", name, count, text, p, held)


def _interval(x: Interval) -> str:
    """ "value (low to high)" with two digits, 180 rather than 1.8e+02."""
    value, low, high = (f"{float(f'{number:.2g}'):g}" for number in x)
    return f"{value} ({low} to {high})"
