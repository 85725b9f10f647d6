"""Controllers tuned alike: one study of `biped-adrc tune` for each place, gait, contestant and optimiser seed.

    python benchmarks/tuned/alike.py out/tuned [--share 1/2] [--only "RABBIT, 1 ms"]
    python benchmarks/tuned/alike.py out/tuned_orders --contest benchmarks/tuned/orders.toml

What may be chosen, the sets of walks and the limits are the same for all and stand in contest.toml; the budget
grows with the number of free parameters. A candidate has to bear a delay margin, and its walks have to be
legal. A share k/n carries out every n-th study, so that several processes share the work; what was
interrupted goes on. docs/write_tuned.py makes the page of what is in the folder.
"""

from __future__ import annotations

import argparse
import itertools
import json
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from biped_adrc.campaign.workers import Threads
from biped_adrc.errors import InputError
from biped_adrc.tuning.candidate import NoneKeepsLimits
from biped_adrc.tuning.study_file import read_tuning
from biped_adrc.tuning.tune import tune

HERE = Path(__file__).parent
NOTE = "entry.json"
"""What came of a search, in its folder."""


class Entry(NamedTuple):
    """One search: where, on which gait, of whom, with which seed of the optimiser."""

    place: str
    gait: str
    contestant: str
    seed: int

    @property
    def folder(self) -> str:
        """Its folder below that of all."""
        named = "/".join((self.place, self.gait, self.contestant, str(self.seed)))
        return named.replace(" ", "_").replace(",", "").replace("'", "").replace("=", "")


CONTEST = HERE / "contest.toml"


def contest(path: Path = CONTEST) -> dict[str, dict]:
    """The tables of contest.toml, with those of another file in their place."""
    return {**read(CONTEST), **read(path)} if path != CONTEST else read(path)


def read(path: Path) -> dict[str, dict]:
    """The tables of a file."""
    return tomllib.loads(path.read_text(encoding="utf-8"))


def entries(c: dict[str, dict]) -> Iterator[Entry]:
    """All searches, those of the first optimiser seed first, then by place and gait."""
    found = [
        Entry(place, gait, name, seed)
        for place, p in c["places"].items()
        for gait, seeds in p["seeds"].items()
        for name in p.get("contestants", c["contestants"])
        for seed in seeds
    ]
    return iter(sorted(found, key=lambda e: e.seed))


def of_place(c: dict[str, dict], place: str, table: str) -> dict[str, Any]:
    """A table such as "walk" with the values that a place has in place of those of all."""
    return {**c[table], **c["places"][place].get(table, {})}


def variables(c: dict[str, dict], e: Entry) -> dict[str, Any]:
    """What a search may choose: gains, the contestant's own, and the leaves of the place."""
    leaves = (c["leaves"][name]["variables"] for name in c["places"][e.place]["leaves"])
    who = c["contestants"][e.contestant]
    gains = c["gains"] if who.get("gains", True) else {}
    return dict(
        itertools.chain(gains.items(), who.get("own", {}).items(), *(x.items() for x in leaves))
    )


def tables(c: dict[str, dict], e: Entry) -> dict[str, object]:
    """The study of one search, as plain tables."""
    place, who = c["places"][e.place], c["contestants"][e.contestant]
    search, searched = of_place(c, e.place, "search"), variables(c, e)

    def walks(kind: str) -> dict[str, object]:
        of = of_place(c, e.place, kind)
        more = of.get("values", {})
        given = [{"name": f"{a:g} N m", "amplitude": a, **more} for a in of["amplitudes"]]
        return {"seeds": of["seeds"], "conditions": given}

    walk = of_place(c, e.place, "walk")
    return {
        "study": {
            "name": f"{e.contestant}: {e.place}, {e.gait}",
            "budget": search["per_variable"] * len(searched),
            "generation": search["generation"],
            "finalists": search["finalists"],
            "seed": e.seed,
        },
        "fixed": {**walk, **place["values"], **who["values"], "gait": e.gait},
        "variables": searched,
        "objectives": [{"column": "rms_error"}],
        "limits": [
            {"column": "delay_margin", "least": place["margin"]},
            *([{"column": "ripple", "most": place["ripple"]}] if "ripple" in place else []),
            {"column": "legal", "least": c["limits"]["legal"]},
            {
                "column": "mean_friction",
                "over": 0.9,
                "most": c["limits"]["friction"],
                "counts": "made",
            },
        ],
        "training": walks("training"),
        "selection": walks("selection"),
        "test": walks("test"),
    }


def carry_out(c: dict[str, dict], e: Entry, out: Path) -> dict[str, object]:
    """Search for one entry. The note says what came of it, or why nothing did.

    Raises InputError where the folder has the note of another study.
    """
    folder = out / e.folder
    folder.mkdir(parents=True, exist_ok=True)
    told, study = folder / NOTE, read_tuning(tables(c, e), e.folder)
    if told.is_file():
        note: dict[str, object] = json.loads(told.read_text(encoding="utf-8"))
        if note.get("study") != study.hash:
            raise InputError(f"'{told}' is of another study than contest.toml says; move it away")
        return note
    note = {**e._asdict(), "study": study.hash}
    try:
        tuned = tune(study, folder, Threads(1))
        note |= {"chosen": tuned.chosen.chosen, "found": True}
    except NoneKeepsLimits as error:
        note |= {"found": False, "why": str(error)}
    told.write_text(json.dumps(note, indent=1) + "\n", encoding="utf-8")
    return note


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--share", default="1/1", help="k/n: every n-th search, from the k-th")
    parser.add_argument("--only", help="name of one place")
    parser.add_argument("--contest", type=Path, default=CONTEST, help="file of other places")
    given = parser.parse_args()
    k, n = (int(x) for x in given.share.split("/"))
    c = contest(given.contest)
    mine = [e for e in entries(c) if given.only in (None, e.place)][k - 1 :: n]
    for i, e in enumerate(mine, 1):
        note = carry_out(c, e, given.out)
        print(f"{i}/{len(mine)} {e.folder}: {note.get('chosen', note.get('why'))}", flush=True)


if __name__ == "__main__":
    main()
