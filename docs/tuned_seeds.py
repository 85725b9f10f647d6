"""Whether another seed of the optimiser moves a conclusion of the contest."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from tuned_entries import Entry, group
from tuned_questions import ORDERS, Answer, against_reference, answered, between
from tuned_text import MRAD, at, number, ratio


def other_seeds(found: Sequence[Entry]) -> list[str]:
    """For each place and gait with several seeds of the optimiser: how errors and conclusions move."""
    lines = []
    for place, gait in dict.fromkeys((e.place, e.gait) for e in found):
        here = [e for e in found if (e.place, e.gait) == (place, gait)]
        seeds = sorted({e.seed for e in here})
        if len(seeds) < 2:
            continue
        groups = [group(found, place, gait, seed) for seed in seeds]
        lines.append(f"**{at(here[0])}**, seeds {', '.join(map(str, seeds))}: {errors(here)}.")
        for question, pairs in (
            ("the reference", against_reference(groups)),
            ("m = 1", between(groups, ORDERS)),
        ):
            lines.append(f"Held against {question}: {moved(answered(pairs))}.")
    return lines


def errors(here: Sequence[Entry]) -> str:
    """The median errors of the contestants that were searched with several seeds."""
    told = []
    for name in dict.fromkeys(e.contestant for e in here):
        medians = [float(np.median(e.tuned.rms_error)) for e in here if e.contestant == name]
        if len(medians) > 1:
            told.append(f"{name} {', '.join(number(MRAD * x) for x in medians)}")
    return "median errors in mrad: " + "; ".join(told)


def moved(answers: Sequence[Answer]) -> str:
    """Which verdicts differ between the seeds, all of one family."""
    by_name: dict[str, list[Answer]] = {}
    for x in answers:
        by_name.setdefault(x.a.contestant, []).append(x)
    asked = {name: found for name, found in by_name.items() if len(found) > 1}
    turned = [
        f"{name} ({', '.join(f'seed {x.a.seed}: {x.verdict}, {ratio(x.ratio)}' for x in found)})"
        for name, found in asked.items()
        if len({x.verdict for x in found}) > 1
    ]
    if not asked:
        return "asked with one seed alone so far"
    if turned:
        return f"another seed moves {len(turned)} of {len(asked)} conclusions: {'; '.join(turned)}"
    return f"another seed moves none of {len(asked)} conclusions"
