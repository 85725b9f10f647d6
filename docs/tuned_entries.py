"""The searches of the contest, in plain values and as records with the walks of their test set.

`collected` reads a folder of benchmarks/tuned/alike.py, `entries` the summary that is made of it. A walk that
is not legal counts with an infinite error, torque and cost; a search that found no setting that keeps the
limits counts as one whose walks are all not legal.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.campaign.store_open import read_store
from biped_adrc.types import Array

KEPT = ("rms_error", "rms_torque", "cost_of_transport", "legal")
"""Columns of a walk in the summary."""
RESULTS, NOTE, SUMMARY, TEST_SET = (
    "results.sqlite",
    "entry.json",
    "summary.json",
    "test_set.json",
)
"""Files of a search."""
BESIDE = "beside.json"
"""What beside.py found, in the folder of all searches."""
KEEPS = "keeps all limits"
"""What the reason says where no candidate keeps the limits."""


class Walks(NamedTuple):
    """The walks of one setting on the test set, each (conditions, seeds)."""

    rms_error: Array
    """[rad], infinite where the walk is not legal; so are the other two."""
    rms_torque: Array
    """[N m]"""
    cost_of_transport: Array
    """[1]"""
    legal: Array
    """1 or 0."""


class Entry(NamedTuple):
    """One search: where, on which gait, of whom, with which seed of the optimiser, and what it found."""

    place: str
    gait: str
    contestant: str
    seed: int
    chosen: Mapping[str, float | str | None]
    """The chosen values; empty where no candidate keeps the limits."""
    why: str
    """Why none does; empty where one does."""
    selected: float
    """Median error on the selection set [rad], infinite without a setting."""
    margins: tuple[float | None, float | None]
    """Delay margin [s] of the chosen and the first setting; None where unknown."""
    tuned: Walks
    """Of the chosen setting."""
    published: Walks | None
    """Of the first setting, which was not tuned; None where it was not walked."""
    ripple: float | None = None
    """rms torque of the encoders' counts [N m], of the chosen setting; None where unknown."""
    searches: int = 1
    """How many searches its walks are of."""
    failed: int = 0
    """How many of them found no setting that keeps the limits."""
    kind: str = ""
    """Hardware and plant of the place; searches at places of one kind scatter alike."""

    @property
    def found(self) -> bool:
        """Whether there is a setting that keeps the limits."""
        return not self.why

    @property
    def rank(self) -> tuple[float, int]:
        """By the error on the selection set; where that is infinite, by how many searches found nothing."""
        return self.selected, self.failed

    @property
    def medians(self) -> Array:
        """Median error of the walks of each search (searches,) [rad]."""
        return np.asarray(np.median(self.tuned.rms_error.reshape(self.searches, -1), axis=1))


def collected(out: Path, contest: Mapping[str, Any], asked: Sequence[Any]) -> dict[str, Any]:
    """The summary of what is in a folder, finished or not.

    A search that ended for another reason than its limits is left out: it says nothing of its contestant.
    contest: the tables of contest.toml. asked: the searches of the contest, as `alike.entries` gives them.
    """
    there = [out / e.folder for e in asked if (out / e.folder / NOTE).is_file()]
    found = [_search(folder, contest) for folder in there]
    found = [told for told in found if not told["why"] or KEEPS in told["why"]]
    beside = out / BESIDE
    return {
        "contest": dict(contest),
        "columns": list(KEPT),
        "asked": [list(e) for e in asked],
        "searches": found,
        "beside": json.loads(beside.read_text(encoding="utf-8")) if beside.is_file() else {},
    }


def _search(folder: Path, contest: Mapping[str, Any]) -> dict[str, Any]:
    """One finished search in plain values."""
    told = json.loads((folder / NOTE).read_text(encoding="utf-8"))
    told.setdefault("why", "")
    if not told.pop("found"):
        return told
    summary = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))
    best = summary["selected"][0]
    margin = next(x for x in summary["held_out"] if x["words"] == "mean delay_margin")
    told["chosen"] = _acting(contest, told["chosen"])
    told["selected"] = _short(best["objectives"][0])
    told["margins"] = [_short(margin[side]["value"]) for side in ("chosen", "published")]
    ripple = [x["chosen"]["value"] for x in summary["held_out"] if x["words"] == "mean ripple"]
    if ripple:
        told["ripple"] = _short(ripple[0])
    test = json.loads((folder / TEST_SET).read_text(encoding="utf-8"))
    with closing(read_store(folder / RESULTS)) as store:
        rows = [(r.at, r.row) for r in store.results() if r.at["set"] == "test"]
    for side, number in (("tuned", best["number"]), ("published", 0)):
        told[side] = _kept({_where(at): row for at, row in rows if at["candidate"] == number}, test)
    return told


def _acting(contest: Mapping[str, Any], chosen: Mapping[str, Any]) -> dict[str, Any]:
    """The chosen values that have an effect beside the others: a leaf's may need one of them."""
    needs = {
        name: variable.get("when", {})
        for leaf in contest["leaves"].values()
        for name, variable in leaf["variables"].items()
    }
    return {
        name: _short(x)
        for name, x in chosen.items()
        if all(chosen.get(k) in values for k, values in needs.get(name, {}).items())
    }


def _where(at: Mapping[str, Any]) -> tuple[str, int]:
    return str(at["condition"]), int(at["seed"])


def _kept(rows: Mapping[tuple[str, int], Mapping[str, Any]], test: Mapping[str, Any]) -> list[Any]:
    """The kept columns of walks, each a list of seeds for each condition."""
    names = [one["name"] for one in test["conditions"]]
    return [[[_short(rows[n, s][c]) for s in test["seeds"]] for n in names] for c in KEPT]


def _short(x: Any) -> Any:
    """A number to four digits."""
    return float(f"{x:.4g}") if isinstance(x, float) else x


def entries(summary: Mapping[str, Any]) -> list[Entry]:
    """The finished searches of a summary, in the order of the contest."""
    c = summary["contest"]
    ripples = {key_of(told): told["ripple"] for told in summary["beside"].get("linear", [])}
    found = [
        _entry(told, shape(c, told["place"]))._replace(
            ripple=told.get("ripple", ripples.get(key_of(told))), kind=kind_of(c, told["place"])
        )
        for told in summary["searches"]
    ]
    places, names = (list(c[x]) for x in ("places", "contestants"))

    def place_of(e: Entry) -> tuple[int, ...]:
        gaits = list(c["places"][e.place]["seeds"])
        at = (places.index(e.place), gaits.index(e.gait))
        return (*at, e.seed, names.index(e.contestant))

    return sorted(found, key=place_of)


def kind_of(c: Mapping[str, Any], place: str) -> str:
    """Hardware and plant of a place."""
    values = c["places"][place].get("values", {})
    return " ".join(values[x] for x in ("hardware", "plant") if x in values)


def key_of(told: Mapping[str, Any]) -> tuple[str, str, str, int]:
    """By what a search is named: place, gait, contestant, seed."""
    return told["place"], told["gait"], told["contestant"], told["seed"]


def of_place(c: Mapping[str, Any], place: str, table: str) -> dict[str, Any]:
    """A table of contest.toml with the values that a place has in place of those of all."""
    return {**c[table], **c["places"][place].get(table, {})}


def shape(c: Mapping[str, Any], place: str) -> tuple[int, int]:
    """Conditions and seeds of the test set of a place."""
    test = of_place(c, place, "test")
    return len(test["amplitudes"]), test["seeds"]["count"]


def _entry(told: Mapping[str, Any], size: tuple[int, int]) -> Entry:
    at = (told["place"], told["gait"], told["contestant"], told["seed"])
    worst = Walks(*(np.full(size, np.inf) for _ in KEPT[:-1]), np.zeros(size))
    if told["why"]:
        return Entry(*at, {}, told["why"], np.inf, (None, None), worst, None, failed=1)
    margins = tuple(float(x) for x in told["margins"])
    sides = (walks_of(told["tuned"]), walks_of(told["published"]))
    return Entry(*at, told["chosen"], "", float(told["selected"]), margins, *sides)


def walks_of(columns: Sequence[Any]) -> Walks:
    """Walks with their columns as arrays, infinite where not legal."""
    legal = np.array(columns[-1], dtype=float)
    numbers = (np.array(x, dtype=float) for x in columns[:-1])
    return Walks(*(np.where(legal == 1.0, x, np.inf) for x in numbers), legal)


def pooled(same: Sequence[Entry]) -> Entry:
    """The searches of one contestant with several seeds of the optimiser as one: the walks of all of them.

    Its setting is that of the first that found one; its error on the selection set is the geometric mean, and
    infinite where a search found none.
    """
    first = next((e for e in same if e.found), same[0])
    tuned = Walks(
        *(np.concatenate(columns) for columns in zip(*(e.tuned for e in same), strict=True))
    )
    selected = float(np.exp(np.mean(np.log([e.selected for e in same]))))
    failed = sum(e.failed for e in same)
    return first._replace(tuned=tuned, selected=selected, searches=len(same), failed=failed)


def groups_of(found: Sequence[Entry]) -> list[dict[str, Entry]]:
    """For each place and gait the contestants, each with the walks of all of its searches.

    Seeds of the optimiser with which only some contestants have been searched so far do not count.
    """
    spots: dict[tuple[str, str], dict[str, list[Entry]]] = {}
    for e in found:
        spots.setdefault((e.place, e.gait), {}).setdefault(e.contestant, []).append(e)
    groups = []
    for spot in spots.values():
        seeds = [{e.seed for e in same} for same in spot.values()]
        all_of = {
            name: [e for e in same if e.seed in set.intersection(*seeds)]
            for name, same in spot.items()
        }
        groups.append({name: pooled(same) for name, same in all_of.items() if same})
    return groups


def group(found: Sequence[Entry], place: str, gait: str, seed: int) -> dict[str, Entry]:
    """The searches of one place, gait and seed of the optimiser, by contestant."""
    same = [e for e in found if (e.place, e.gait, e.seed) == (place, gait, seed)]
    return {e.contestant: e for e in same}


def reference(contestants: Mapping[str, Entry]) -> Entry | None:
    """The better of NPD and NPID on the selection set; None where one of them has not been searched yet."""
    if not {"NPD", "NPID"} <= set(contestants):
        return None
    return min((contestants[name] for name in ("NPD", "NPID")), key=lambda e: e.rank)
