"""Steps after the searches: each setting as it is stored, walked again, and moved while that helps.

A search ends near a limit, where the last digits of a gain decide whether 20 of 20 walks keep it. So what it
chose is written with the digits that are stored and walked again on the walks of choice. Steps of one gain
follow: of SMALL of its range while the setting misses a limit, or of twice as much where none of them misses
less; then of LARGE while one of them gains ENOUGH, also beyond the end of a range. Each time the best setting
beside it takes its place.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from contextlib import suppress
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.studies.build import REFUSED, Values, scenario_of, trial_of
from biped_adrc.studies.search import ENOUGH, STEPS, Candidate, Search
from biped_adrc.studies.space import Span
from biped_adrc.studies.study import Study, read_study

SMALL, LARGE = 0.005, STEPS["up"]
"""Steps as shares of a variable's range; LARGE is that by which a search says what stopped it."""
MOST = 10
"""Most steps of a setting."""
WHY_GAIN, WHY_LIMIT = "moved: a step gained", "as stored it missed a limit"
OUTSIDE, STILL = "no step came within the limits", "not tuned: still moving after the last step"
"""Words of the rows: why a setting was moved, and where its steps ended without a stop."""


def digits(x: float) -> float:
    """A number as it is stored."""
    return float(f"{x:.8g}")


def stop_in_words(stop: str) -> str:
    """What stopped a search, in fewer words: without the tables of its variables and the bounds of limits."""
    stop = re.sub(r"(controller|observer|hardware|encoders)\.", "", stop)
    stop = stop.replace("stopped by nothing, as it is flat", "flat").replace("stopped by ", "")
    return re.sub(r"mean feasible under (.+?) at least [\d.]+", r"the limit under \1", stop)


def builds(values: Values) -> bool:
    """Whether the values of a scenario fit together."""
    with suppress(InputError):
        return bool(trial_of(scenario_of(values)))
    return False


class Searches(NamedTuple):
    """The searches of a place: the study that searched, where walks go, and how many processes walk."""

    study: Study
    folder: Path
    workers: int | None

    @property
    def search(self) -> Search:
        """The search of all its cases."""
        assert self.study.search is not None
        return self.study.search

    def judge(self, number: int, asked: Mapping[str, dict[str, Any]]) -> dict[str, Candidate]:
        """Settings "case" or "case: step", by their values of the variables, judged by the walks of choice.
        number: of the round, whose rows have a folder of their own.
        """
        study = self.study
        of = {name: name.partition(": ")[0] for name in asked}
        cases = {name: study.cases[of[name]] | x for name, x in asked.items()}
        # gains that do not go together are refused, and miss the limits
        rows = {name: [(c, {"status": REFUSED}) for c in study.conditions] for name in asked}
        tables = {
            "name": f"{study.name}, steps {number}",
            "base": study.base,
            "conditions": study.conditions,
            "cases": {name: x for name, x in cases.items() if builds(study.base | x)},
            "seeds": list(self.search.walks.choice.seeds),
        }
        # a study of its own for other settings, as after more doublings
        folder = self.folder / f"{number}-{read_study(tables).hash[:8]}"
        found = ba.study(tables, folder, self.workers)
        for name, some in groupby(found.results(), lambda x: str(x.at["case"])):
            rows[name] = [(str(x.at["condition"]), x.row) for x in some]
        judged = self.search.judged
        return {k: judged(study.values_of(of[k]), number, x, rows[k]) for k, x in asked.items()}

    def ranges(self, case: str) -> dict[str, Span]:
        """The ranges of the variables that act in a case."""
        acting = self.search.acting(self.study.values_of(case))
        return {n: v.range for n, v in acting.items() if v.range is not None}

    def beside(self, case: str, c: Candidate, w: float) -> dict[str, dict[str, Any]]:
        """Settings a step w beside that of a case, each as its values of the variables."""
        moved = {
            f"{n} {word}": c.chosen | {n: digits(r.shift(c.chosen[n], by))}
            for n, r in self.ranges(case).items()
            for word, by in (("down", -w), ("up", w))
        }
        return {k: x for k, x in moved.items() if x != c.chosen}


def is_better(search: Search, new: Candidate, old: Candidate) -> bool:
    """Whether a setting misses less of the limits than the old one, or, where both keep them, gains ENOUGH."""
    if new.feasible and old.feasible:
        return search.gain(old, new) >= ENOUGH
    return sum(new.missed) < sum(old.missed)


def move_all(at: Searches, rows: list[dict[str, Any]]) -> None:
    """Walk the settings of these rows as they are stored, and move those that miss a limit or are not tuned.
    The rows get the values, the objective, what stopped the setting, and why it was moved.

    A search that found nothing better than its case has no setting to be moved. A row whose setting never keeps
    the limits loses it.
    """
    by_case = {f"{r['controller']} #{r['search']}": r for r in rows if r["values"]}
    if not by_case:
        return
    now = at.judge(0, {case: json.loads(r["values"]) for case, r in by_case.items()})
    first = dict(now)
    moving = [
        case
        for case, x in now.items()
        if at.ranges(case).keys() <= x.chosen.keys()
        and (not x.feasible or by_case[case]["stop"].startswith("not tuned"))
    ]
    size = {case: LARGE if now[case].feasible else SMALL for case in moving}
    for number in range(1, MOST + 1):
        beside = {case: at.beside(case, now[case], size[case]) for case in moving}
        asked = {f"{case}: {k}": x for case, some in beside.items() for k, x in some.items()}
        found = at.judge(number, asked) if asked else {}
        for case in [*moving]:
            some = {k: found[f"{case}: {k}"] for k in beside[case]}
            best, x = at.search.ranked([*some.values()])[0], now[case]
            if x.feasible:
                by_case[case]["stop"] = stop_in_words(at.search.stop(x, some))
            if is_better(at.search, best, x):
                now[case] = best
                size[case] = LARGE if best.feasible else size[case]
            elif size[case] < LARGE:
                size[case] *= 2.0
            else:
                moving.remove(case)
    for case in moving:
        by_case[case]["stop"] = STILL
    for case, x in now.items():
        row = by_case[case]
        row |= {"on choice": digits(x.objective), "values": json.dumps(x.chosen)}
        if x is not first[case]:
            row["why"] = WHY_GAIN if first[case].feasible else WHY_LIMIT
        if not x.feasible:
            row |= {"values": "", "on choice": "", "stop": OUTSIDE, "why": WHY_LIMIT}
