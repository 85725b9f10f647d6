"""The text of docs/tuned.md from the numbers in its summary.json: `page`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from soft_text import bullets
from tuned_entries import Entry, entries, group
from tuned_questions import (
    LEVEL,
    ORDERS,
    RUNGS,
    Answer,
    Group,
    against_reference,
    answered,
    between,
)
from tuned_seeds import other_seeds
from tuned_sentences import goal, order_pays, rung_worths, who_is_legal, winners
from tuned_tables import answer_table, of_group
from tuned_text import MRAD, at, name, number

from biped_adrc.viz.pages import captions

COMMAND = "make tuned"
NO_DATA = "Not walked yet."
INTRODUCTION = """Written by `python docs/write_tuned.py OUT` from the searches of
`benchmarks/tuned/alike.py OUT`, both by `{command}`, which goes on where it was interrupted. {done} of {asked}
searches are there.

Each contestant is searched by [`biped-adrc tune`](guide/tune.md) at each place, on each gait, with the
same budget of {per_variable} candidates for each free parameter, the same ranges and the same limits,
which stand in `benchmarks/tuned/contest.toml`: a delay margin (of more delay in all motors, beside what
the place has already) of at least {margins}; at least {legal_share:.0f} % of the walks legal; and a need of
friction of at most {friction:g} in nine of ten walks. Each walk has {impacts} impacts, a push of random
size and direction on the joints, and a model that is wrong by 10 %. Candidates are searched on {training} walks
and chosen on {selection} others; the numbers below are those of {test} walks that no choice has touched
({seeds} seeds, each under {amplitudes} N m; the last is more than was trained).

**This budget is small.** A longer search may find a better setting for any of them; what another seed of
the optimiser finds is told [below](#another-seed-of-the-optimiser).

A walk that falls or is not legal counts as one with an infinite error, torque and cost, and is never
dropped; a contestant without a setting that keeps the limits ranks last. Medians and their intervals of
95 % draw seeds, each with all of its walks. Ratios are those of the same walk under two settings. A
difference is *carried* where the exact sign test over seeds has p below {level:g} after Holm's correction
over all questions of its kind, and the interval agrees; what is not carried is *open*, and has the factor
within which both are of each other with 95 %. The *reference* is the better of NPD and NPID, by the selection
set. The first seed of the optimiser speaks, except where others are named."""

LEFT_OUT = (
    "Leaves that a contestant may choose are the filter of the rates and its own gains. **Left out**: friction "
    "feedforward, prediction over the known delay, and the policy at impact, which stay as they are.",
    "**Left out**: MuJoCo's contact. All walks are on the rigid ground of the paper.",
    "Controllers that run in Python alone (CLF-QP, reference governors) are **left out**.",
)


def page(summary: Mapping[str, Any]) -> str:
    """The text of docs/tuned.md."""
    found = entries(summary)
    groups = first_groups(found)
    contest, ladder, orders = families(groups)
    parts = [
        "# Tuned alike",
        introduction(summary),
        *missing(summary, found),
        "## What the numbers say",
        told([*winners(groups, contest), *who_is_legal(contest), *goal(contest)]),
        "## Does an order above 1 pay?",
        told(order_pays(orders)),
        answer_table(orders),
        "## The ladder",
        LADDER,
        told(rung_worths(ladder)),
        answer_table(ladder),
        *(part for picture in captions("tuned") for part in figure(picture)),
        "## The tables",
        *(part for g in groups for part in of_group(g, contest)),
        "## Another seed of the optimiser",
        told(other_seeds(found)),
        "## What was left out",
        bullets([*LEFT_OUT, *at_ends(summary["contest"], found)]),
        *without_setting(found),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


LADDER = (
    "From NPD on filtered rates to the observer's xi^, one thing at a time. A ratio below 1 is what the rung "
    "is worth; each contestant is searched anew, so a rung is held against the best setting below it. There "
    "are more questions here than above, so that the correction may leave open what is carried there."
)


def told(sentences: Sequence[str]) -> str:
    """Sentences as a list, or that there are none yet."""
    return bullets(sentences) if sentences else NO_DATA


def figure(picture: str) -> list[str]:
    """A figure with its heading and caption."""
    title, caption = captions("tuned")[picture]
    return [f"## {title}", f"![{title}](tuned/{picture}.svg)", caption]


def first_groups(found: Sequence[Entry]) -> list[Group]:
    """The searches of the first seed of the optimiser, for each place and gait."""
    if not found:
        return []
    first = min(e.seed for e in found)
    spots = dict.fromkeys((e.place, e.gait) for e in found if e.seed == first)
    return [group(found, *spot, first) for spot in spots]


def families(groups: Sequence[Group]) -> tuple[list[Answer], list[Answer], list[Answer]]:
    """The answers of the contest, of the ladder and of the orders, each corrected as one family."""
    asked = (against_reference(groups), between(groups, RUNGS), between(groups, ORDERS))
    contest, ladder, orders = (answered(pairs) for pairs in asked)
    return contest, ladder, orders


def introduction(summary: Mapping[str, Any]) -> str:
    """What was searched, how, and how to read it."""
    c = summary["contest"]
    walks = {
        kind: c[kind]["seeds"]["count"] * len(c[kind]["amplitudes"])
        for kind in ("training", "selection", "test")
    }
    margins = ", ".join(f"{MRAD * p['margin']:g} ms ({name})" for name, p in c["places"].items())
    return INTRODUCTION.format(
        command=COMMAND,
        done=len(summary["searches"]),
        asked=len(summary["asked"]),
        per_variable=c["search"]["per_variable"],
        margins=margins,
        legal_share=100.0 * c["limits"]["legal"],
        friction=c["limits"]["friction"],
        impacts=c["walk"]["impacts"],
        seeds=c["test"]["seeds"]["count"],
        amplitudes=" and ".join(f"{x:g}" for x in c["test"]["amplitudes"]),
        level=LEVEL,
        **walks,
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


NEAR = 1.1
"""A value within this factor of an end of its range is at the end."""


def at_ends(contest: Mapping[str, Any], found: Sequence[Entry]) -> list[str]:
    """The chosen values at an end of their range, beyond which a better setting may lie."""
    lines = []
    for e in found:
        own = (contest["contestants"][e.contestant] or {}).get("own", {})
        ranges = {**contest["gains"], **own, **contest["places"][e.place].get("leaves", {})}
        ends = [
            f"{key.removeprefix('own.')} = {number(x)} of {r['from']:g} to {r['to']:g}"
            for key, x in e.chosen.items()
            if (r := ranges[key]) and not NEAR * r["from"] < x < r["to"] / NEAR
        ]
        if ends:
            lines.append(f"{at(e)}, {name(e)}, seed {e.seed} ({', '.join(ends)})")
    told = "At an end of its range, so that a wider one may find better, is a value of "
    return [f"{told}{'; '.join(lines)}."] if lines else []


def without_setting(found: Sequence[Entry]) -> list[str]:
    """The searches that found no setting, with the reason."""
    lines = [
        f"{at(e)}, {name(e)}, seed {e.seed} of the optimiser: {reason(e)}."
        for e in found
        if not e.found
    ]
    return ["## Searches without a setting", bullets(lines)] if lines else []


def reason(e: Entry) -> str:
    """Why a search found nothing: what excluded how many."""
    told = e.why.split("': ", 1)[-1].split(". The nearest")[0]
    return f"{told}. {UNWALKED}" if "that need no walk" in told else told


UNWALKED = (
    "So none was walked. This excludes the ranges that were searched and no more: whether a value outside them "
    "bears the delay is not answered here"
)
