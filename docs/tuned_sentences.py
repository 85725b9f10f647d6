"""What the contest says in words: sentences that follow from the answers to its questions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
import tuned_text as words
from tuned_entries import Entry, reference
from tuned_questions import LEVEL, RUNGS, Answer, Group, first_of, partly_failed
from tuned_text import MRAD, at, interval, legal, name, number, ratio

from biped_adrc.analysis.statistics import share

GOAL, GOAL_LEGAL = 0.5, 292 / 300
"""What was asked for on RABBIT's hardware: upper end of the ratio's interval, and the share of legal walks."""
GOAL_PLACE = "RABBIT, 1 ms"


def winners(
    groups: Sequence[Group], contest: Sequence[Answer], firsts: Sequence[Answer] = ()
) -> list[str]:
    """For each place and gait who is the best, how far ahead, and what is carried against NPD and NPID.

    firsts: the answers of the best beside the next.
    """
    ahead = {at(x.a): x for x in firsts}
    lines = [tally(groups)] if groups else []
    for g in groups:
        best = first_of(g)
        spot = at(next(iter(g.values())))
        if best is None:
            lines.append(f"**{spot}**: nobody has a setting that keeps the limits.")
            continue
        lines.append(f"**{spot}**: {winner(best, ahead.get(spot))} {held_against(g, contest)}")
    return lines


def tally(groups: Sequence[Group]) -> str:
    """How often each contestant is the best on the selection set."""
    counts = Counter(name(best) for g in groups if (best := first_of(g)) is not None)
    told = ", ".join(f"{who} {count}" for who, count in counts.most_common())
    spots = "place and gait" if len(groups) == 1 else "places and gaits"
    return f"Best on the selection set, over {len(groups)} {spots}: {told or 'nobody'}."


def winner(best: Entry, ahead: Answer | None) -> str:
    """Who was the best on the selection set, how legally, and how far ahead of the next."""
    parts = [
        f"the best on the selection set is {name(best)}, with {words.error(best.tuned)} mrad and "
        f"{legal(best.tuned)} walks legal, at {interval(words.middle(best.tuned.rms_torque))} N m"
    ]
    if ahead is not None:
        smaller = words.verdict(ahead, "carried", "carried, against it")
        parts.append(f"its ratio to the next, {name(ahead.b)}, is {ratio(ahead.ratio)} ({smaller})")
    return "; ".join(parts) + "."


def held_against(g: Group, contest: Sequence[Answer]) -> str:
    """What is carried against the better of NPD and NPID."""
    base = reference(g)
    if base is None:
        return "NPD and NPID are not both there."
    if not base.found:
        return "Neither NPD nor NPID has a setting that keeps the limits."
    kinds = words.by_verdict([x for x in contest if x.b is base], against)
    heads = {"smaller": "a smaller error of", "larger": "a larger one of"}
    parts = [f"{heads[kind]} {', '.join(kinds[kind])}" for kind in heads if kinds[kind]]
    said = f"Against {name(base)}, the reference"
    said += f", carried are {'; '.join(parts)}." if parts else ", nothing is carried."
    return said + (f" Open: {', '.join(kinds['open'])}." if kinds["open"] else "")


def against(x: Answer) -> str:
    """A contestant with its ratio, and its bound where it is open."""
    if not x.a.found:
        return f"{name(x.a)} (no setting that keeps the limits)"
    bound = f", {words.within(x)}" if x.verdict == "open" else ""
    return f"{name(x.a)} {ratio(x.ratio)}{bound}"


def who_is_legal(contest: Sequence[Answer]) -> list[str]:
    """Whether some walk legally more often than the reference."""
    found = [x for x in contest if x.a.found]
    some = [x for x in found if not (partly_failed(x.a) or partly_failed(x.b))]
    lines = [
        f"{at(x.a)}: {name(x.a)} walks {legal(x.a.tuned)} legally, {name(x.b)} {legal(x.b.tuned)} "
        f"(McNemar's test over seeds, p {words.p_value(x.legal_p)})."
        for x in some
        if x.legal_p < LEVEL
    ]
    rest = [x for x in some if x.legal_p >= LEVEL]
    if rest:
        bound = 100.0 * max(x.legal_bound for x in rest)
        lines.append(
            f"Legal walks: of {len(some)} settings that keep the limits, {len(rest)} have no carried "
            "difference to the reference; the shares of seeds of which all walks are legal differ there by at "
            f"most {bound:.0f} % with 95 %."
        )
    return lines + not_asked([x for x in found if x not in some])


def not_asked(rest: Sequence[Answer]) -> list[str]:
    """Of whom legality is not asked, as a search of several found nothing, which made no walks."""
    if not rest:
        return []
    told = [
        f"{spot}, beside {tried(next(x.b for x in rest if at(x.a) == spot))} "
        + ", ".join(tried(x.a) for x in rest if at(x.a) == spot)
        for spot in dict.fromkeys(at(x.a) for x in rest)
    ]
    return [
        "Not asked is who walks legally more often where some searches found nothing, whose walks are counted "
        f"as not legal and were never made (so many searches): {'; '.join(told)}."
    ]


def tried(e: Entry) -> str:
    """A contestant with how many of its searches found nothing."""
    return name(e) + (f" ({e.failed} of {e.searches})" if e.failed else "")


def goal(first: Sequence[Answer], contest: Sequence[Answer]) -> list[str]:
    """How near the best one comes to the goal on RABBIT's hardware.

    first: the answers by the first seed of the optimiser alone. contest: by all.
    """
    lines = []
    for gait in dict.fromkeys(x.a.gait for x in first if x.a.place == GOAL_PLACE):
        here = [x for x in first if (x.a.place, x.a.gait) == (GOAL_PLACE, gait)]
        some = [x for x in here if x.a.found and x.a.contestant not in ("NPD", "NPID")]
        if some:
            best = min(some, key=lambda x: x.a.rank)
            lines.append(beside_goal(best, [x for x in contest if at(x.a) == at(best.a)]))
    return lines


def beside_goal(x: Answer, contest: Sequence[Answer]) -> str:
    """The setting of one search beside the goal, and the ratio over all searches of its contestant.

    A seed is what is independent, so that the lower end is that of the share of seeds with legal walks alone.
    """
    walked = x.a.tuned.legal
    found = float(walked.mean())
    low = share(int(np.sum(np.all(walked == 1.0, axis=0))), walked.shape[1]).low
    every = [ratio(y.ratio) for y in contest if y.a.contestant == x.a.contestant]
    over_all = f", over all its searches {every[0]}" if every else ""
    met = "met" if x.ratio.high <= GOAL else f"missed by {number(x.ratio.high - GOAL, 2)}"
    shown = "shown" if low >= GOAL_LEGAL else "not shown by so few walks"
    if found < GOAL_LEGAL:
        shown = f"missed by {100 * (GOAL_LEGAL - found):.1f} %"
    return (
        f"The goal on {GOAL_PLACE} was a ratio to the reference with an upper end of at most {GOAL:g}, and "
        f"{100 * GOAL_LEGAL:.1f} % of the walks legal. On gait {x.a.gait} {name(x.a)} of optimiser "
        f"seed {x.a.seed} has {ratio(x.ratio)}{over_all}. By that seed "
        f"the first is {met}. Of its walks {legal(x.a.tuned)} are legal, which is at least "
        f"{100 * low:.1f} % with 95 %: the second is {shown}."
    )


def order_pays(orders: Sequence[Answer]) -> list[str]:
    """For each place and gait whether an order above 1 makes the error smaller."""
    lines = []
    for spot in dict.fromkeys(at(x.a) for x in orders):
        here = [x for x in orders if at(x.a) == spot]
        kinds = words.by_verdict(here, lambda x: against(x) + loop(x.a))
        heads = {"smaller": "pays", "larger": "costs", "open": "is open"}
        said = "; ".join(f"{heads[k]}: {', '.join(x)}" for k, x in kinds.items() if x)
        lines.append(f"**{spot}**, as ratio to m = 1{loop(here[0].b)}: {said}.")
    return [pays_at_all(orders), *lines] if orders else []


def pays_at_all(orders: Sequence[Answer]) -> str:
    """In how many questions an order above 1 pays."""
    paid = [f"{name(x.a)} at {at(x.a)}" for x in orders if x.verdict == "smaller"]
    where = f": {', '.join(paid)}" if paid else ""
    costs, still_open = (sum(x.verdict == kind for x in orders) for kind in ("larger", "open"))
    return (
        f"An order above 1 pays in {len(paid)} of {len(orders)} questions{where}. It costs in {costs}, and "
        f"{still_open} are open."
    )


def loop(e: Entry) -> str:
    """Delay margin and ripple of a setting in brackets."""
    told = []
    if e.margins[0] is not None:
        told.append(f"{MRAD * e.margins[0]:.2g} ms of margin")
    if e.ripple is not None:
        told.append(f"{e.ripple:.2g} N m of ripple")
    return f" ({', '.join(told)})" if told else ""


def rung_worths(ladder: Sequence[Answer]) -> list[str]:
    """What each rung is worth, over places and gaits."""
    lines = []
    for a, b, what in RUNGS:
        here = [x for x in ladder if (x.a.contestant, x.b.contestant) == (a, b)]
        if not here:
            continue
        ends = [ratio(x.ratio).split(" (")[0] for x in sorted(here, key=lambda x: x.ratio.value)]
        span = ends[0] if len(ends) == 1 else f"{ends[0]} to {ends[-1]}"
        kinds = words.by_verdict(here, lambda x: at(x.a))
        where = "; ".join(f"{kind} at {' and at '.join(x)}" for kind, x in kinds.items() if x)
        lines.append(f"*{b}* to *{a}* ({what}): ratio {span}; {where}.")
    return lines
