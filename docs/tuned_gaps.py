"""What the contest does not answer: searches that are missing or found nothing, values at ends of ranges."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from soft_text import bullets
from tuned_entries import Entry
from tuned_text import at, name

LEFT_OUT = (
    "An observer's reset at the instant of impact stays as it is; the leaf is a policy for the time after it.",
    "**Left out** are controllers that run in Python alone (*CLF-QP*, *output NPD*, *finite time*), *stride "
    "PI*, which learns from step to step, and *delayed*, which has no samples.",
)


def missing(summary: Mapping[str, Any], found: Sequence[Entry]) -> list[str]:
    """Which searches are not there yet."""
    there = {(e.place, e.gait, e.contestant, e.seed) for e in found}
    gone = [x for x in map(tuple, summary["asked"]) if x not in there]
    if not gone:
        return []
    spots: dict[str, list[str]] = {}
    for place, gait, who, seed in gone:
        spots.setdefault(f"{place}, gait {gait}, seed {seed} of the optimiser", []).append(who)
    names = list(summary["contest"]["contestants"])
    lines = [f"{at}: {'all' if len(x) == len(names) else '; '.join(x)}" for at, x in spots.items()]
    return ["Searches that are not there; nothing is said of them:", bullets(lines)]


def of_places(contest: Mapping[str, Any]) -> list[str]:
    """Which contestants were not searched at a place."""
    lines = []
    for place, p in contest["places"].items():
        gone = [name for name in contest["contestants"] if name not in p.get("contestants", [name])]
        if gone:
            lines.append(
                f"At {place}, where a walk takes long, are **left out** {'; '.join(gone)}."
            )
    return lines


NEAR = 0.02
"""A value within this share of its range of an end is at the end."""


def at_ends(contest: Mapping[str, Any], found: Sequence[Entry]) -> list[str]:
    """How often a chosen value is at an end of its range, beyond which a better setting may lie."""
    ends: dict[str, list[str]] = {}
    for e in found:
        leaves = (contest["leaves"][x]["variables"] for x in contest["places"][e.place]["leaves"])
        ranges = {**contest["gains"], **contest["contestants"][e.contestant].get("own", {})}
        for one in leaves:
            ranges |= one
        for key, x in e.chosen.items():
            if (r := ranges[key]) and "from" in r and is_end(r, x):
                ends.setdefault(e.place, []).append(
                    f"{key.removeprefix('own.')} of {name(e)} ({e.gait}, seed {e.seed})"
                )
    told = "At an end of its range, so that a wider one may find better, is at"
    return [f"{told} {place}: {'; '.join(some)}." for place, some in ends.items()]


def is_end(r: Mapping[str, Any], x: float) -> bool:
    """Whether x is within the share `NEAR` of an end of a range other than 0, by its scale."""
    low, high = r["from"], r["to"]
    if r.get("scale") == "log":
        low, high, x = (float(np.log(y)) for y in (low, high, x))
    edge = NEAR * (high - low)
    return bool(x > high - edge or (r["from"] > 0.0 and x < low + edge))


def without_setting(found: Sequence[Entry]) -> list[str]:
    """The searches that found no setting, with the reason, those of a place and gait together."""
    spots: dict[str, list[str]] = {}
    for e in found:
        if not e.found:
            told = f"{name(e)}, seed {e.seed} of the optimiser: {reason(e)}"
            spots.setdefault(at(e), []).append(told)
    lines = [f"{spot}: {'. '.join(some)}." for spot, some in spots.items()]
    return ["## Searches without a setting", bullets(lines)] if lines else []


def reason(e: Entry) -> str:
    """Why a search found nothing: what excluded how many."""
    told = e.why.split("': ", 1)[-1].split(". The nearest")[0]
    return f"{told}. {UNWALKED}" if "that need no walk" in told else told


UNWALKED = (
    "So none was walked. This excludes the ranges that were searched and no more: whether a value outside them "
    "bears the delay is not answered here"
)
