"""The text of docs/tuned.md from the numbers in its summary.json: `page`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import tuned_text as words
from soft_text import bullets
from tuned_entries import Entry, entries, group, reference
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
from tuned_text import MRAD, at, interval, legal, number, ratio, setting
from write_results import table

from biped_adrc.viz.pages import captions

COMMAND = "make tuned"
NO_DATA = "Not walked yet."
GOAL, GOAL_LEGAL = 0.5, 292 / 300
"""What was asked for on RABBIT's hardware: upper end of the ratio's interval, and the share of legal walks."""
GOAL_PLACE = "RABBIT, 1 ms"

INTRODUCTION = """Written by `python docs/write_tuned.py OUT` from the searches of `benchmarks/tuned/alike.py OUT`, both by
`{command}`, which goes on where it was interrupted. {done} of {asked} searches are there.

Each contestant is searched by [`biped-adrc tune`](guide/tune.md) at each place, on each gait, with the
same budget of {per_variable} candidates for each free parameter, the same ranges and the same limits,
which stand in `benchmarks/tuned/contest.toml`: a delay margin (of more delay in all motors, beside what
the place has already) of at least {margins}; at least {legal_share:.0f} % of the walks legal; and in no
walk a need of friction above {friction:g}. Each walk has {impacts} impacts, a push of random size and
direction on the joints, and a model that is wrong by 10 %. Candidates are searched on {training} walks
and chosen on {selection} others; the numbers below are those of {test} walks that no choice has touched
({seeds} seeds, each under {amplitudes} N m; the last is more than was trained).

**This budget is small.** A longer search may find a better setting for any of them; what another seed of
the optimiser finds is told [below](#another-seed-of-the-optimiser).

A walk that falls or is not legal counts as one with an infinite error, torque and cost, and is never
dropped; a contestant without a setting that keeps the limits ranks last. Medians and their intervals of
95 % draw seeds, each with all of its walks. Ratios are those of the same walk under two settings. A
difference is *carried* where the exact sign test over seeds has p below {level:g} after Holm's correction
over all questions of its kind, and the interval agrees; what is not carried is *open*, and has the factor
within which both are of each other with 95 %. The first seed of the optimiser speaks, except where others
are named."""

LEFT_OUT = (
    "Leaves that a contestant may choose are the filter of the rates and its own gains. **Left out**: friction "
    "feedforward, prediction over the known delay, and the policy at impact, which stay as they are.",
    "**Left out**: MuJoCo's contact. All walks are on the rigid ground of the paper.",
    "Controllers that run in Python alone (CLF-QP, reference governors) are **left out**.",
    "NPID filters its rates by itself, so it goes without the leaf; its bandwidth is the same parameter.",
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
        table(list(ANSWERS), [answer_texts(x) for x in orders]) if orders else "",
        "## The ladder",
        LADDER,
        told(rung_worths(ladder)),
        table(list(ANSWERS), [answer_texts(x) for x in ladder]) if ladder else "",
        *(part for name in captions("tuned") for part in figure(name)),
        "## The tables",
        *(part for g in groups for part in of_group(g, contest)),
        "## Another seed of the optimiser",
        told(other_seeds(found)),
        "## What was left out",
        bullets(LEFT_OUT),
        *without_setting(found),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


LADDER = (
    "From NPD on filtered rates to the observer's xi^, one thing at a time. A ratio below 1 is what the rung "
    "is worth; each contestant is searched anew, so a rung is held against the best setting below it."
)


def told(sentences: Sequence[str]) -> str:
    """Sentences as a list, or that there are none yet."""
    return bullets(sentences) if sentences else NO_DATA


def figure(name: str) -> list[str]:
    """A figure with its heading and caption."""
    title, caption = captions("tuned")[name]
    return [f"## {title}", f"![{title}](tuned/{name}.svg)", caption]


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
    for place, gait, name, seed in gone:
        spots.setdefault(f"{place}, gait {gait}, seed {seed} of the optimiser", []).append(name)
    names = list(summary["contest"]["contestants"])
    lines = [f"{at}: {'all' if len(x) == len(names) else '; '.join(x)}" for at, x in spots.items()]
    return ["Searches that are not there; nothing is said of them:", bullets(lines)]


def winners(groups: Sequence[Group], contest: Sequence[Answer]) -> list[str]:
    """For each place and gait who has the smallest error, and what is carried against the reference."""
    lines = []
    for g in groups:
        some = [e for e in g.values() if e.found]
        if not some:
            lines.append(
                f"**{at(next(iter(g.values())))}**: nobody has a setting that keeps the limits."
            )
            continue
        best = min(some, key=lambda e: float(np.median(e.tuned.rms_error)))
        lines.append(f"**{at(best)}**: {winner(best)} {held_against(g, contest)}".strip())
    return lines


def winner(best: Entry) -> str:
    """Who has the smallest error, and how legally."""
    return (
        f"the smallest median error is that of {best.contestant}, {words.error(best.tuned)} mrad, with "
        f"{legal(best.tuned)} walks legal."
    )


def held_against(g: Group, contest: Sequence[Answer]) -> str:
    """What is carried against the better of NPD and NPID."""
    base = reference(g)
    if base is None:
        return "NPD and NPID are not both there."
    if not base.found:
        return "Neither NPD nor NPID has a setting that keeps the limits."
    kinds = words.by_verdict([x for x in contest if x.b is base], against)
    heads = {
        "smaller": "A smaller error is carried for",
        "larger": "A larger one for",
        "open": "Open are",
    }
    parts = [f"{heads[kind]} {'; '.join(x)}." for kind, x in kinds.items() if x]
    return " ".join(
        [
            f"Held against {base.contestant}, the better of NPD and NPID on the selection set:",
            *parts,
        ]
    )


def against(x: Answer) -> str:
    """A contestant with its ratio, and its bound where it is open."""
    if not x.a.found:
        return f"{x.a.contestant} (no setting that keeps the limits)"
    bound = f"; {words.within(x)}" if x.verdict == "open" else ""
    return f"{x.a.contestant} {ratio(x.ratio)}{bound}"


def who_is_legal(contest: Sequence[Answer]) -> list[str]:
    """Whether some walk legally more often than the reference."""
    if not contest:
        return []
    carried = [x for x in contest if x.legal_p < LEVEL]
    lines = [
        f"{at(x.a)}: {x.a.contestant} walks {legal(x.a.tuned)} legally, {x.b.contestant} {legal(x.b.tuned)} "
        f"(McNemar's test over seeds, p {words.p_value(x.legal_p)})."
        for x in carried
    ]
    rest = [x for x in contest if x.legal_p >= LEVEL]
    bound = 100.0 * max((x.legal_bound for x in rest), default=0.0)
    if rest:
        lines.append(
            f"In {len(rest)} of {len(contest)} questions no difference of legal walks to the reference is "
            f"carried; the shares of seeds of which all walks are legal differ there by at most {bound:.0f} % with 95 %."
        )
    return lines


def goal(contest: Sequence[Answer]) -> list[str]:
    """How near anyone with an observer comes to the goal on RABBIT's hardware."""
    lines = []
    for gait in dict.fromkeys(x.a.gait for x in contest if x.a.place == GOAL_PLACE):
        here = [x for x in contest if (x.a.place, x.a.gait) == (GOAL_PLACE, gait)]
        some = [x for x in here if x.a.found and x.a.contestant not in ("NPD", "NPID")]
        if not some:
            continue
        near = min(some, key=lambda x: x.ratio.high)
        share = float(near.a.tuned.legal.mean())
        met = near.ratio.high <= GOAL and share >= GOAL_LEGAL
        lines.append(
            f"The goal on {GOAL_PLACE} was a ratio to the reference with an upper end of at most {GOAL:g} and "
            f"{100 * GOAL_LEGAL:.1f} % of the walks legal. On gait {gait} it is {'met' if met else 'not met'}: "
            f"nearest is {near.a.contestant} with {ratio(near.ratio)} and {100 * share:.1f} %, "
            f"{legal(near.a.tuned)}, where the reference has {legal(near.b.tuned)}."
        )
    return lines


def order_pays(orders: Sequence[Answer]) -> list[str]:
    """For each place and gait whether an order above 1 makes the error smaller."""
    lines = []
    for spot in dict.fromkeys(at(x.a) for x in orders):
        here = [x for x in orders if at(x.a) == spot]
        kinds = words.by_verdict(here, lambda x: f"{x.a.contestant} {ratio(x.ratio)}")
        heads = {"smaller": "pays", "larger": "costs", "open": "is open"}
        said = "; ".join(f"{heads[k]}: {', '.join(x)}" for k, x in kinds.items() if x)
        first = here[0].b
        margin = (
            "" if first.margins[0] is None else f" ({MRAD * first.margins[0]:.2g} ms of margin)"
        )
        lines.append(f"**{spot}**, as ratio to m = 1{margin}: {said}.")
    paid = sum(x.verdict == "smaller" for x in orders)
    if orders:
        lines.insert(
            0,
            f"An order above 1 pays in {paid} of {len(orders)} questions{' alone' if paid else ''}.",
        )
    return lines


def rung_worths(ladder: Sequence[Answer]) -> list[str]:
    """What each rung is worth, over places and gaits."""
    lines = []
    for a, b, what in RUNGS:
        here = [x for x in ladder if (x.a.contestant, x.b.contestant) == (a, b)]
        if not here:
            continue
        counts = {k: sum(x.verdict == k for x in here) for k in ("smaller", "larger", "open")}
        ends = [ratio(x.ratio).split(" (")[0] for x in sorted(here, key=lambda x: x.ratio.value)]
        span = ends[0] if len(ends) == 1 else f"{ends[0]} to {ends[-1]}"
        lines.append(
            f"{b} to {a}, {what}: ratio {span}; of {len(here)} pairs of place and gait the error is smaller in "
            f"{counts['smaller']}, larger in {counts['larger']}, and {counts['open']} are open."
        )
    return lines


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


def answer_texts(x: Answer) -> list[str]:
    """An answer as the row of a table."""
    seeds = x.a.tuned.legal.shape[1]
    told = [ratio(x.ratio), f"{x.won} of {seeds}", words.p_value(x.p)]
    verdict = words.verdict(x, "smaller", "larger")
    return [at(x.a), x.a.contestant, x.b.contestant, *told, verdict]


CELLS = (
    *("contestant", "chosen setting", "delay margin [ms]", "rms error [mrad]", "rms torque [N m]"),
    *("cost of transport", "legal", "ratio to the reference", "as published: error [mrad]"),
    *("margin [ms] as published", "legal as published"),
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
        interval(words.middle(e.tuned.rms_torque)),
        interval(words.middle(e.tuned.cost_of_transport)),
    ]
    held = "–" if x is None else ratio(x.ratio)
    was = "–" if e.published is None else words.error(e.published)
    share = "–" if e.published is None else legal(e.published)
    chosen, published = ("–" if m is None else number(MRAD * m) for m in e.margins)
    told = legal(e.tuned) if e.found else "–"
    return [e.contestant, setting(e), chosen, *tuned, told, held, was, published, share]


def without_setting(found: Sequence[Entry]) -> list[str]:
    """The searches that found no setting, with the reason."""
    lines = [
        f"{at(e)}, {e.contestant}, seed {e.seed} of the optimiser: {e.why.split(': ', 1)[-1]}"
        for e in found
        if not e.found
    ]
    return ["## Searches without a setting", bullets(lines)] if lines else []
