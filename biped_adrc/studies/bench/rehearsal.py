"""What is looked at before a study starts: every level of each axis, and points spread over the whole.

The levels of an axis come with the first of all others; where an axis has very many numbers, those between
the ends are passed over evenly. All combinations of what is named by words come too.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import Any

from biped_adrc.errors import BipedError, InputError
from biped_adrc.studies.bench.parameters import Value, trial
from biped_adrc.studies.bench.study import CASE, SEED, Named, Study

MOST_LEVELS = 200
"""Numbers of one axis that are looked at."""
MOST_WORDS = 200
"""Combinations of words."""

At = dict[str, Value]


def rehearse(study: Study, spread: int = 100) -> None:
    """Make walks, without walking them, of points that stand for all; `spread` of them all over the study.

    Raises InputError for robots, gaits, presets, controllers, joints or coordinates that there are not, and
    for values that do not fit together.
    """
    from biped_adrc.studies.bench.build import case

    seen = set()
    for values, at in some_points(study, spread):
        try:
            s = trial(values)
            if s.key not in seen:
                seen.add(s.key)
                case(s)
        except BipedError as error:
            name = f", case '{at[CASE]}'" if CASE in at else ""
            rest = {k: x for k, x in at.items() if k != CASE}
            where = f"study '{study.name}'{name}" + (f", at {rest}" if rest else "")
            raise InputError(f"{where}: {error}") from error


def some_points(study: Study, spread: int) -> Iterator[tuple[At, At]]:
    """Values of a trial by name, and where the point lies; each case in turn, what stands out first."""
    for named in study.cases or (Named(name=""),):
        told: At = {CASE: named.name} if named.name else {}
        for at in _some_of_a_case(study, spread // max(len(study.cases), 1) + 1):
            yield study.fixed | named.values | at, told | at


def _some_of_a_case(study: Study, spread: int) -> Iterator[At]:
    axes: dict[str, Sequence[Value]] = dict(study.grid)
    if study.seeds:
        axes[SEED] = study.seeds
    samples = _samples(study)
    sample, first = next(samples), {name: levels[0] for name, levels in axes.items()}
    for name, levels in axes.items():
        for x in _spaced(levels):
            yield first | {name: x} | sample
    worded = {
        name: levels if any(isinstance(x, str) for x in levels) else levels[:1]
        for name, levels in axes.items()
    }
    for combined in itertools.islice(itertools.product(*worded.values()), MOST_WORDS):
        yield dict(zip(worded, combined, strict=True)) | sample
    for at in _spread(axes, spread):
        yield at | next(samples)


def _samples(study: Study) -> Iterator[dict[str, Any]]:
    """Samples without end."""
    if study.draw is None:
        return itertools.repeat({})
    return itertools.cycle(itertools.islice(study.draw.samples(), MOST_LEVELS))


def _spaced(levels: Sequence[Value]) -> Iterator[Value]:
    """All words; of many numbers some, with both ends."""
    step = max(1, math.ceil(len(levels) / MOST_LEVELS))
    for i, x in enumerate(levels):
        if i % step == 0 or i == len(levels) - 1 or not isinstance(x, (int, float)):
            yield x


def _spread(axes: dict[str, Sequence[Value]], most: int) -> Iterator[At]:
    """Combinations at even distances in the order of the study, the last among them."""
    count = math.prod(len(levels) for levels in axes.values())
    some = min(most, count)
    places = {round(k * (count - 1) / max(some - 1, 1)) for k in range(some)}
    for place in sorted(places):
        at: At = {}
        for name, levels in reversed(axes.items()):
            place, i = divmod(place, len(levels))
            at[name] = levels[i]
        yield {name: at[name] for name in axes}
