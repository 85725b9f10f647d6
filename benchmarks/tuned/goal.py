"""ADRC on RABBIT's hardware beside the better of NPD and NPID, all tuned: walks on which nothing was chosen.

    python benchmarks/tuned/alike.py out/tuned --only "RABBIT, 1 ms"
    python benchmarks/tuned/reserve.py out/tuned_reserve
    python benchmarks/tuned/goal.py out/tuned out/tuned_reserve out/goal

Of all settings that the searches have chosen, one for each role is taken on the selection set of goal.toml:

    NPD, NPID     of the least median error
    the rival     the better of both
    closest       the ADRC of the least median error
    goal          of the ADRC's whose error is small enough beside the rival's those with the most legal walks,
                  and of them the one that needs the least friction

They walk the test set and outside of what was searched with; the largest legal push is bisected. Rows of walks
are kept in the folder, so that what was interrupted goes on. docs/write_robot_goal.py makes the page of
summary.json.
"""

from __future__ import annotations

import argparse
import json
import math
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from alike import HERE, Entry, contest, entries
from goal_numbers import beside, of_walks, plain, pushes_beside
from reserve import contests

from biped_adrc.bench.largest_push import Search, largest_pushes
from biped_adrc.bench.run import run_trials
from biped_adrc.bench.scenario_file import read_scenario
from biped_adrc.campaign.chunk import Record, Row, key_of, text_of
from biped_adrc.files import write_text
from biped_adrc.tuning.without_walk import numbers_without_walk

LINEAR = ("delay_margin", "disk_margin", "ripple")
"""Numbers of a setting that need no walk."""


class Setting(NamedTuple):
    """What a search has chosen."""

    contestant: str
    friction_limit: float
    """Limit of the search."""
    seed: int
    """Of its optimiser."""
    values: Record
    """Of a scenario, without seed and amplitude."""


class Walked:
    """Walks, each made once: rows are kept in a file, a line each."""

    def __init__(self, path: Path) -> None:
        self.path = path
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        self.rows: dict[str, Row] = dict(json.loads(line) for line in lines)

    def __call__(self, records: Sequence[Record]) -> list[Row]:
        """The rows of these walks, in order."""
        keys = [key_of(text_of(r)) for r in records]
        with self.path.open("a", encoding="utf-8") as file:
            for key, record in zip(keys, records, strict=True):
                if key not in self.rows:
                    self.rows[key] = run_trials([record])[0]
                    file.write(json.dumps([key, self.rows[key]]) + "\n")
                    file.flush()
        return [self.rows[key] for key in keys]


def seeds(of: Mapping[str, Any]) -> range:
    """Of a set of walks in goal.toml."""
    return range(of["seeds"]["from"], of["seeds"]["from"] + of["seeds"]["count"])


def settings(g: Mapping[str, Any], tuned: Path, reserve: Path) -> Iterator[Setting]:
    """What the searches of the goal's place and gait have chosen, the contest's first."""
    folders = [(tuned, contest()), *((reserve / name, c) for name, c in contests())]
    for folder, c in folders:
        for e in entries(c):
            best = folder / e.folder / "best.toml"
            if wanted(g, e) and best.is_file():
                values = read_scenario(best)
                yield Setting(e.contestant, c["limits"]["friction"], e.seed, values)


def wanted(g: Mapping[str, Any], e: Entry) -> bool:
    """Whether an entry belongs to the goal."""
    known = e.contestant in (*g["rivals"], *g["adrc"])
    return known and (e.place, e.gait) == (g["place"], g["gait"])


def selected(g: Mapping[str, Any], found: Sequence[Setting], walk: Walked) -> list[dict[str, Any]]:
    """Each setting with its numbers on the selection set, in plain values."""
    rows = []
    for s in found:
        walks = walk([{**s.values, **g["condition"], "seed": i} for i in seeds(g["selection"])])
        linear = numbers_without_walk(LINEAR, s.values)
        rows.append({**s._asdict(), **linear, **of_walks(walks)})
    return rows


def roles(g: Mapping[str, Any], rows: Sequence[dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """The setting of each role, by the rules of the module. Raises ValueError where there is none."""
    of, least = g["selection"], lambda some, key: min(some, key=lambda r: r[key])
    legal = [r for r in rows if r["legal"][0] >= of["legal"]]
    found = {
        name: least([r for r in legal if r["contestant"] == name], "error") for name in g["rivals"]
    }
    rival = least(found.values(), "error")
    adrc = [r for r in legal if r["contestant"] in g["adrc"]]
    most = of["ratio"] * rival["error"]
    good = [r for r in adrc if r["error"] <= most]
    return found | {
        "rival": rival,
        "closest": least(adrc, "error"),
        "goal": min(good, key=lambda r: (-r["legal"][0], r["friction"])),
    }


def largest(
    g: Mapping[str, Any], sides: Mapping[str, dict[str, Any]], walk: Walked
) -> dict[str, list[Any]]:
    """Intervals of the largest legal push of each role [N m], one of each seed."""

    def carry(records: Sequence[Record]) -> list[Row]:
        """The walks of the goal's condition in place of those of the comparison."""
        return walk(
            [
                {
                    **sides[str(r["controller"])]["values"],
                    **g["condition"],
                    "amplitude": r["amplitude"],
                    "seed": r["seed"],
                }
                for r in records
            ]
        )

    begun = [Search(role, "all joints +", "early", i) for role in sides for i in seeds(g["push"])]
    found: dict[str, list[Any]] = {role: [] for role in sides}
    for s in largest_pushes(begun, carry):
        found[s.controller].append(s.legal.ends)
    return found


def judged(g: Mapping[str, Any], found: Sequence[Setting], walk: Walked) -> dict[str, Any]:
    """All numbers of the page, in plain values."""
    rows = selected(g, found, walk)
    sides = roles(g, rows)
    print({role: (r["contestant"], r["friction_limit"], r["error"]) for role, r in sides.items()})

    def walks(role: str, over: Mapping[str, Any], of: Mapping[str, Any]) -> list[Row]:
        return walk([{**sides[role]["values"], **over, "seed": i} for i in seeds(of)])

    test = {role: walks(role, g["condition"], g["test"]) for role in sides}
    outside = {
        name: {role: walks(role, over, g["outside"]) for role in sides}
        for name, over in g["outside"]["conditions"].items()
    }
    pushes = largest(g, {role: sides[role] for role in ("rival", "closest", "goal")}, walk)
    return {
        "settings": rows,
        "roles": {role: rows.index(r) for role, r in sides.items()},
        "test": _table(test, g["rivals"]),
        "outside": {name: _table(walked, g["rivals"]) for name, walked in outside.items()},
        "push": {role: pushes_beside(b, pushes["rival"]) for role, b in pushes.items()},
    }


def _table(walked: Mapping[str, list[Row]], rivals: Sequence[str]) -> dict[str, dict[str, Any]]:
    """The numbers of each role, and those of the ADRC's beside the rivals."""
    both = [walked[name] for name in rivals]
    return {
        role: of_walks(rows)
        | (beside(rows, walked["rival"], both) if role in ("closest", "goal") else {})
        for role, rows in walked.items()
        if role != "rival"
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("tuned", "reserve", "out"):
        parser.add_argument(name, type=Path)
    parser.add_argument("--share", type=float, default=1.0, help="of the walks, for a first look")
    given = parser.parse_args()
    g = tomllib.loads((HERE / "goal.toml").read_text(encoding="utf-8"))
    for kind in ("test", "outside", "push"):
        g[kind]["seeds"]["count"] = math.ceil(given.share * g[kind]["seeds"]["count"])
    given.out.mkdir(parents=True, exist_ok=True)
    found = list(settings(g, given.tuned, given.reserve))
    summary = judged(g, found, Walked(given.out / "rows.jsonl"))
    text = json.dumps(plain(summary), indent=1, allow_nan=False)
    write_text(given.out / "summary.json", text + "\n")
    print(np.round(summary["test"]["goal"]["ratio"], 3))


if __name__ == "__main__":
    main()
