"""What the leaves of tuned settings are worth, and settings that no search made, from what beside.py walked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import tuned_text as words
from tuned_entries import Entry, key_of, walks_of
from tuned_questions import Answer, Group, answered
from tuned_text import MRAD, at, name, number, ratio

from biped_adrc.analysis.statistics import Interval


class Worth(NamedTuple):
    """A setting held against the same one without a leaf."""

    leaf: str
    """Its name in contest.toml."""
    answer: Answer
    """a: with it, b: without."""


def worths(summary: Mapping[str, Any], found: Sequence[Entry]) -> list[Worth]:
    """Every setting held against itself without each leaf, one family."""
    by_key = {key_of(e._asdict()): e for e in found}
    leaves, pairs = [], []
    for told in summary["beside"].get("without", []):
        e = by_key.get(key_of(told))
        if e is not None:
            leaves.append(told["leaf"])
            pairs.append((e, e._replace(tuned=walks_of(told["walks"]))))
    return [Worth(*x) for x in zip(leaves, answered(pairs), strict=True)]


def worth_sentences(summary: Mapping[str, Any], found: Sequence[Entry]) -> list[str]:
    """For each leaf what it is worth at each place, over contestants and gaits."""
    asked, lines = worths(summary, found), []
    for leaf, given in summary["contest"]["leaves"].items():
        here = [x.answer for x in asked if x.leaf == leaf]
        places = dict.fromkeys(x.a.place for x in here)
        told = [at_place(place, [x for x in here if x.a.place == place]) for place in places]
        if told:
            lines.append(f"**{given['words']}**: {'; '.join(told)}.")
    return lines


def at_place(place: str, here: Sequence[Answer]) -> str:
    """What one leaf is worth at one place: how many errors are smaller with it, larger, or open."""
    kinds = words.by_verdict(here, lambda x: f"{name(x.a)} at gait {x.a.gait}")
    typical = sorted(x.ratio.value for x in here)[(len(here) - 1) // 2]
    middle = ratio(Interval(typical, typical, typical)).split(" (")[0]
    said = f"{place}, smaller with it in {len(kinds['smaller'])} of {len(here)}, the middle ratio is {middle}"
    if kinds["larger"]:
        said += f", larger in {len(kinds['larger'])} ({', '.join(kinds['larger'])})"
    if kinds["open"]:
        bound = max(x.within for x in here if x.verdict == "open")
        finite = f"within a factor {number(bound)}"
        unbound = "walks that are not legal leave some without a bound"
        told = finite if bound < words.NEVER else unbound
        said += f", open in {len(kinds['open'])} ({told})"
    return said


def worth_rows(
    summary: Mapping[str, Any], found: Sequence[Entry]
) -> tuple[list[str], list[list[str]]]:
    """Headings and rows of a table: settings down, leaves across, the ratio with to without."""
    leaves = list(summary["contest"]["leaves"])
    cells: dict[tuple[str, str], dict[str, str]] = {}
    for x in worths(summary, found):
        told = ratio(x.answer.ratio) + (" (open)" if x.answer.verdict == "open" else "")
        cells.setdefault((at(x.answer.a), x.answer.a.contestant), {})[x.leaf] = told
    head = [
        "place, gait",
        "contestant",
        *(summary["contest"]["leaves"][k]["words"] for k in leaves),
    ]
    return head, [[*key, *(row.get(k, "–") for k in leaves)] for key, row in cells.items()]


def with_all_leaves(summary: Mapping[str, Any], groups: Sequence[Group]) -> list[str]:
    """What NPD reaches with all leaves, beside the best one, where leaves are offered."""
    lines = []
    for g in groups:
        npd = g.get("NPD")
        if npd is None or not summary["contest"]["places"][npd.place]["leaves"]:
            continue
        some = [e for e in g.values() if e.found and e is not npd]
        if not npd.found:
            lines.append(f"{at(npd)}: with all leaves *NPD* has no setting that keeps the limits.")
        elif some:
            best = min(some, key=lambda e: e.rank)
            lines.append(
                f"{at(npd)}: with all leaves *NPD* reaches {words.error(npd.tuned)} mrad with "
                f"{words.legal(npd.tuned)} walks legal; {name(best)}, the best of the others, "
                f"{words.error(best.tuned)} mrad with {words.legal(best.tuned)}."
            )
    return lines


def unsearched_sentences(summary: Mapping[str, Any], groups: Sequence[Group]) -> list[str]:
    """What settings that no search has made do beside the best searched one, and which limit they miss."""
    lines = []
    for told in summary["beside"].get("unsearched", []):
        walks = walks_of(told["walks"])
        least = summary["contest"]["places"][told["place"]]["margin"]
        here = [
            e
            for g in groups
            for e in g.values()
            if (e.place, e.gait) == (told["place"], told["gait"])
        ]
        some = [e for e in here if e.found]
        beside = ""
        if some:
            best = min(some, key=lambda e: e.rank)
            beside = (
                f", beside {words.error(best.tuned)} mrad of {name(best)}, the best of those tuned"
            )
        margin = told["margin"] or 0.0
        kept = "keeps" if margin >= least else "misses"
        lines.append(
            f"*{told['name']}*, not tuned, at {told['place']}, gait {told['gait']}: "
            f"{words.error(walks)} mrad, {words.legal(walks)} walks legal{beside}. Its delay margin of "
            f"{MRAD * margin:.2g} ms {kept} the limit of {MRAD * least:g} ms."
        )
    return lines
