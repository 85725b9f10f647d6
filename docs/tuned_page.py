"""The text of docs/tuned.md from the numbers in its summary.json: `page`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from soft_text import bullets
from tuned_entries import Entry, entries, group, groups_of, of_place
from tuned_equal import equal_loops
from tuned_gaps import LEFT_OUT, at_ends, missing, of_places, without_setting
from tuned_leaves import unsearched_sentences, with_all_leaves, worth_rows, worth_sentences
from tuned_pushes import push_sentences, pushes
from tuned_questions import LEVEL, WORST, Group, against_reference, answered, first_two
from tuned_seeds import placebo_sentences, repeated, scatter_of
from tuned_sentences import goal, order_pays, rung_worths, who_is_legal, winners
from tuned_steady import families, other_seeds, steadied
from tuned_steps import step_sentences
from tuned_tables import answer_table, of_group
from tuned_text import MRAD
from write_results import table

from biped_adrc.viz.pages import captions

COMMAND = "make tuned"
NO_DATA = "Not walked yet."
INTRODUCTION = """Written by `python docs/write_tuned.py OUT` from the searches of
`benchmarks/tuned/alike.py OUT` and the walks of `benchmarks/tuned/beside.py OUT`, all by `{command}`, which
goes on where it was interrupted. {done} of {asked} searches are there.

Each contestant is searched by [`biped-adrc tune`](guide/tune.md) at each place, on each gait, with the same
number of candidates for each free parameter, the same ranges and the same limits, which stand in
`benchmarks/tuned/contest.toml`: a delay margin of at least {margins}
(of more delay in all motors, beside what the place has already; of the loop on rigid ground); at least
{legal_share:.0f} % of the walks legal; and a need of friction of at most {friction:g} in nine of ten walks.
Each walk has a push of random size and direction on the joints, and a model that is wrong by 10 %. All may have
the leaves of the place.

{places}

Candidates are searched on the walks of training and chosen on those of selection; the numbers below are those
of the test, which no choice has touched. The order m of an observer divides the range of its bandwidth, and its
first value.

**This budget is small.** A longer search may find a better setting for any of them.

Changed after something had been seen. A first contest had only the filter as a leaf, 25 candidates for each
parameter and 6 training walks. m = 7 then kept the limits in training and not in selection, so that there are
more training walks, and one rule for the ranges of all orders; fewer candidates, to pay for the leaves. In a
second contest, searched by TPE alone, searches of one contestant ended far apart, placebos were found different
and another seed of the optimiser moved conclusions; so this third one goes on with CMA-ES after TPE, with the
same number of candidates, and has test seeds that none has seen. The rule that a difference
has to exceed that of two searches came when two searches of one contestant were found different by their walks;
that the walks of all seeds of the optimiser count together came after a first look at numbers of a test. While
few searches were repeated that rule had one factor for all contestants; with searches of all contestants
repeated it is a test with the scatter of the two that are compared. That was taken over all places at first,
and some placebos were found different, as searches at the ideal place end closer to each
other than on the robot; so it is taken over places of the same hardware and plant. That a seed of the walks
counts by the median of its walks came when three searches made six of them, of which a single one that is not
legal decided their mean; that a conclusion has to stand without any one seed of the optimiser came last. A
check of the page then found that ratios depended on which seed of the optimiser stood beside which, that the t
test asked about their median and not about the means that scatter, and that of NPD and NPID one without any
setting could be the reference though the other had one; all three were mended. All this changes verdicts and no
setting.

A walk that falls or is not legal counts as one with an infinite error, torque and cost, and is never dropped; a
search that found nothing counts with so many of them, though none was made, and a contestant without a setting
that keeps the limits ranks last. The interquartile mean is that of the middle half of the walks. Intervals of
95 % draw seeds, each with all of its walks. Ratios are those of the same walk under two settings, of each
search of one contestant beside each of the other, between 1 / {most:.0f} and {most:.0f}, which stand for walks
that are not legal. A difference is *carried* where the larger p of two tests is below {level:g} after Holm's
correction over all questions of its kind, where the interval of the ratio does not reach 1, and where all this
holds without any one seed of the optimiser, too. The tests are the exact sign test over seeds of walks, each by
the median of its ratios, and Welch's t test over searches: of the means of the logarithms of their median
errors, with the scatter of each contestant's [repeated searches](#another-seed-of-the-optimiser) over places of
the same hardware and plant. A contestant without a scatter there has the largest that another one has. Where
only some searches of a contestant found something, the t test is asked about the two single searches that are
nearest to each other, and nothing is carried where not all pairs have the same sign. Where none of its searches
did, and all of the other, it is asked about that bound of ratios, which is always carried: by a rule, and not
by a scatter. What is not carried is *open*, and has the factor within which both are of each other with 95 %,
after other searches too.

The *reference* is the better of NPD and NPID, by the selection set: by the geometric mean of the errors of its
searches, infinite where one found nothing, and then by how many did. Where there are several seeds of the
optimiser the walks of all their settings count; leaves and pushes are those of the first seed."""

LADDER = (
    "From NPD on filtered rates to the observer's xi^, one thing at a time. A ratio below 1 is what the rung "
    "is worth; each contestant is searched anew, so a rung is held against the best setting below it."
)
LEAVES = (
    "Each setting with one leaf taken away and not tuned again, on the test set. So what is lost is more than "
    "the leaf is worth to a contestant that would be tuned without it. A ratio below 1 is the error with the "
    "leaf to that without; it is 0 where without it most walks are not legal."
)
SETTINGS = (
    "With several seeds of the optimiser the setting, its margin and the first setting are of the first seed, "
    "and the walks of all."
)
PUSHES = (
    "Of each setting the push is made larger until its walk is not legal, and the largest legal one is "
    "bisected, with the pushed joints and the time drawn by seed. So each is known to an interval alone; a "
    "seed counts where the intervals of both do not overlap, and bounds of a ratio take the ends that are "
    "worst for it."
)
STEPS = (
    "The settings of the first seed of the optimiser once more under the first condition of the test, with "
    "every step of integration half as long. Behind encoders a walk is one of many that differ by a count, so "
    "that single walks move more than their median."
)


def page(summary: Mapping[str, Any]) -> str:
    """The text of docs/tuned.md."""
    found = entries(summary)
    groups, repeats = groups_of(found), repeated(found)
    scatter = scatter_of(repeats)
    asked = families(groups, found, scatter)
    contest, ladder, orders = asked.values()
    first = against_reference(first_groups(found))
    parts = [
        "# Tuned alike",
        introduction(summary),
        *missing(summary, found),
        "## What the numbers say",
        told(
            [
                *winners(groups, contest, steadied(groups, found, first_two, scatter)),
                *who_is_legal(contest),
                *goal(answered(first), contest),
            ]
        ),
        "## Does an order above 1 pay?",
        told([*order_pays(orders), *unsearched_sentences(summary, groups)]),
        *equal_loops(summary, found),
        "## The ladder",
        LADDER,
        told(rung_worths(ladder)),
        "## What the leaves are worth",
        LEAVES,
        told([*worth_sentences(summary, found), *with_all_leaves(summary, groups)]),
        "## The largest legal push",
        PUSHES,
        told(push_sentences(pushes(summary, groups))),
        "## Another seed of the optimiser",
        told([*placebo_sentences(found), *other_seeds(found, asked)]),
        "## Half the step",
        STEPS,
        told(step_sentences(summary, found)),
        *(part for picture in captions("tuned") for part in figure(picture)),
        "## The settings",
        SETTINGS,
        *(part for g in groups for part in of_group(g, contest)),
        "## All answers",
        *titled("Orders", answer_table(orders)),
        *titled("The ladder", answer_table(ladder)),
        *titled("Leaves, ratio with to without", leaf_table(summary, found)),
        "## What was left out",
        bullets([*LEFT_OUT, *of_places(summary["contest"]), *at_ends(summary["contest"], found)]),
        *without_setting(found),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def titled(title: str, text: str) -> list[str]:
    """A table below its heading; nothing where it is empty."""
    return [f"### {title}", text] if text else []


def leaf_table(summary: Mapping[str, Any], found: Sequence[Entry]) -> str:
    """The table of what leaves are worth; empty where nothing was walked."""
    head, rows = worth_rows(summary, found)
    return table(head, rows) if rows else ""


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


def introduction(summary: Mapping[str, Any]) -> str:
    """What was searched, how, and how to read it."""
    c = summary["contest"]
    margins = ", ".join(f"{MRAD * p['margin']:g} ms ({name})" for name, p in c["places"].items())
    return INTRODUCTION.format(
        command=COMMAND,
        done=len(summary["searches"]),
        asked=len(summary["asked"]),
        margins=margins,
        legal_share=100.0 * c["limits"]["legal"],
        friction=c["limits"]["friction"],
        places=place_table(c),
        level=LEVEL,
        most=WORST,
    )


def place_table(c: Mapping[str, Any]) -> str:
    """What differs between the places: leaves, candidates and walks."""
    head = ["place", "leaves", "candidates for each parameter", "impacts", "walks of training"]
    rows = []
    for place, p in c["places"].items():
        leaves = "; ".join(c["leaves"][x]["words"] for x in p["leaves"]) or "none"
        walks = [of_place(c, place, kind) for kind in ("training", "selection", "test")]
        told = [
            f"{w['seeds']['count']} seeds under {' and '.join(f'{x:g}' for x in w['amplitudes'])} N m"
            for w in walks
        ]
        search, walk = of_place(c, place, "search"), of_place(c, place, "walk")
        rows.append([place, leaves, f"{search['per_variable']}", f"{walk['impacts']}", *told])
    return table([*head, "of selection", "of the test"], rows)
