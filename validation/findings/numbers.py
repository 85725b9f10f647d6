"""The numbers of the findings, from their rows, and texts such as "0.43 (0.31 to 0.58)" for the page."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np

from biped_adrc.analysis.statistics import share
from biped_adrc.studies.search import ENOUGH
from validation.findings import comparison, statistics
from validation.findings.comparison import ROOT
from validation.findings.searches import PLAN, places
from validation.findings.statistics import Answer, Side

ROWS = ROOT / "docs" / "findings"
COUNT = 2.0 * math.pi / 8192
"""One count of RABBIT's encoders [rad]."""
LEG = 0.8
"""Length of RABBIT's leg [m]: an error e of a hip moves the foot by 0.8 e."""
DRAWN = 10_000
"""Draws of an interval beside those of the six questions."""
PUSH, HIP, LIGHT, HEIGHTS = "80 N m", "hip, 2 N", "masses x 0.7", ("5 mm", "10 mm", "20 mm")
LOADS = {
    PUSH: "pushes of 80 N m",
    HIP: "2 N held on the hip",
    "trunk +30 %": "30 % more mass on the trunk",
    LIGHT: "30 % less mass",
    "masses x 1.5": "50 % more mass",
    comparison.LATER: "1 ms more of delay",
}
"""Conditions in words."""
Place = tuple[str, str, str, str]
"""(hardware, gait, tuning, controller)."""


@cache
def rows(name: str) -> list[dict[str, str]]:
    """The rows of a finding."""
    with (ROWS / f"{name}.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def side(at: Place, condition: str, name: str = "") -> Side | None:
    """The searches of a controller at a place, walked under a condition."""
    walked = rows(name or f"comparison_{at[0]}_{at[2]}")
    return comparison.side(rows("settings"), walked, at, condition)


def side_of(at: Place, condition: str) -> Side:
    """The same where a search kept the limits."""
    found = side(at, condition)
    assert found is not None, (at, condition)
    return found


@cache
def answers() -> list[tuple[dict[str, Any], Answer | None, float]]:
    """Each question with its answer, None where one side has no setting within the limits, and Holm's p."""
    asked = statistics.questions()
    result: list[tuple[dict[str, Any], Answer | None]] = []
    for q in asked["question"]:
        one, other = (side(tuple(q[k]), q["condition"]) for k in ("one", "other"))
        found = None
        if one is not None and other is not None:
            found = statistics.compare(one, other, q["measure"], asked["draws"])
        result.append((q, found))
    corrected = statistics.holm([1.0 if x is None else x.p for _, x in result])
    return [(q, x, p) for (q, x), p in zip(result, corrected, strict=True)]


def in_words(x: Answer | None) -> str:
    """ "0.43 (0.31 to 0.58)"."""
    if x is None:
        return "no setting within the limits"
    return f"{x.value:.3g} ({x.low:.3g} to {x.high:.3g})"


def p_in_words(p: float) -> str:
    """ "p = 0.0012", or a bound."""
    return f"p = {p:.2g}" if p >= 1e-3 else "p < 0.001"


def warning(place: Sequence[str]) -> str:
    """A warning where the questions' text is not that with which these walks were made; else nothing."""
    hashes = {r["question"] for r in rows(f"comparison_{place[0]}_{place[2]}")}
    return "" if hashes == {statistics.text_hash()} else ", **question changed after its walks**"


def by_controller(
    hardware: str, tuning: str, condition: str, measure: str
) -> dict[tuple[str, str], Any]:
    """Median error [mrad], or share of feasible walks, of the best search of each controller on both gaits."""
    result = {}
    for gait in PLAN["gaits"]:
        for controller in PLAN["controllers"]:
            if found := side((hardware, gait, tuning, controller), condition):
                x = statistics.alone(found, measure, DRAWN)
                factor = 1e3 if measure == "error" else 1.0
                result[controller, gait] = tuple(factor * y for y in x[:3])
    return result


def ratios(at: Place, condition: str) -> dict[tuple[str, str], Any]:
    """Ratio of each controller's error to that of the one at `at`, on both gaits."""
    result = {}
    for gait in PLAN["gaits"]:
        for controller in PLAN["controllers"]:
            one, other = (side((at[0], gait, at[2], c), condition) for c in (controller, at[3]))
            if controller != at[3] and one and other:
                result[controller, gait] = statistics.compare(one, other, "error", DRAWN)[:3]
    return result


def shares(cases: Mapping[str, Place], conditions: Sequence[str]) -> dict[tuple[str, str], Any]:
    """Share of feasible walks by condition, a series for each of the named places."""
    return {
        (condition, name): statistics.alone(side_of(at, condition), "share", DRAWN)[:3]
        for name, at in cases.items()
        for condition in conditions
    }


def shares_of(
    name: str, where: Callable[[dict[str, str]], tuple[str, str] | None]
) -> dict[tuple[str, str], Any]:
    """Share of feasible walks of a declared study, with Wilson's interval; where: row -> (row, series)."""
    keyed = ((where(r), r) for r in rows(name))
    return {key: share(int(r["feasible"]), int(r["walks"])) for key, r in keyed if key}


def sizes(at: Place, condition: str = PUSH) -> str:
    """Cells of a table, the median error of the best search: in mrad, in counts of the encoder, in mm of the
    foot.
    """
    e = statistics.alone(side_of(at, condition), "error", DRAWN).value
    return f"{1e3 * e:.2g} mrad | {e / COUNT:.2g} | {1e3 * LEG * e:.2g} mm"


def feasible(at: Place, condition: str = PUSH, name: str = "") -> str:
    """ "19 of 20": feasible walks of the best search."""
    found = side(at, condition, name)
    if found is None:
        return "no setting"
    return f"{np.isfinite(found.errors[found.best]).sum()} of {found.errors.shape[1]}"


@cache
def orders() -> dict[tuple[str, str], tuple[float, str]]:
    """By (order, condition) of the study `orders`: the least median error [mrad] over bandwidths, where most
    walks are feasible, and how many are at most feasible.
    """
    result: dict[tuple[str, str], tuple[float, str]] = {}
    for r in rows("orders"):
        errors = [math.inf if x == "-" else 1e-3 * float(x) for x in r["errors"].split()]
        key, e = (r["case"], r["condition"]), float(np.median(errors))
        best, count = result.get(key, (math.inf, "0"))
        result[key] = min(best, e), str(max(int(count), int(r["feasible"])))
    return result


def largest_force(case: str, condition: str) -> int:
    """The largest force [N] up to which all smaller ones of the study `held_hip_force` are walked feasibly."""
    walked = [r for r in rows("held_hip_force") if (r["case"], r["condition"]) == (case, condition)]
    forces = sorted((float(r["pushes.0.force"]), r["feasible"] == "1") for r in walked)
    return next((round(f) - 1 for f, fine in forces if not fine), round(forces[-1][0]))


def soft() -> dict[tuple[str, str], Any]:
    """Share of feasible walks on MuJoCo's ground, by controller and condition."""
    result = {}
    for r in rows("comparison_soft"):
        fine = comparison.errors_of(r)
        result[r["controller"], r["condition"]] = share(int(r["feasible"]), len(fine))
    return result


def last_digits() -> Names:
    """What the ninth digit of K_p changes: the least and largest ratio of the first question, and counts of
    feasible walks with a force held on the hip, over all values of K_p.
    """
    walked = [(r["case"].partition(", ")[0], r) for r in rows("last_digits")]
    pushed, held = (
        {
            c: [r for name, r in walked if (name, r["condition"]) == (c, at)]
            for c in ("m = 1", "NPD")
        }
        for at in (PUSH, HIP)
    )
    one, other = (np.array([comparison.errors_of(r) for r in x]) for x in pushed.values())
    ratios = np.exp(np.median(statistics.logs(one, other), axis=2))
    counts = {c: [int(r["feasible"]) for r in x] for c, x in held.items()}
    return Names(
        low=f"{ratios.min():.3g}",
        high=f"{ratios.max():.3g}",
        **{
            f"{name}_{k}": f(counts[c])
            for name, c in (("m1", "m = 1"), ("npd", "NPD"))
            for k, f in (("low", min), ("high", max))
        },
    )


class Names:
    """Texts by name, so that {size.m1} finds its own."""

    def __init__(self, **texts: object) -> None:
        vars(self).update(texts)


def question(q: dict[str, Any], answer: Answer | None, p: float) -> Names:
    """The answer to a question: its number with the interval, and p."""
    value = "" if answer is None else f"{answer.value:.2g}"
    return Names(value=value, said=in_words(answer), p=p_in_words(p) + warning(q["one"]))


def error_in_words(at: Place) -> str:
    """The median error under the push, in mrad, or in urad where it is small."""
    e = statistics.alone(side_of(at, PUSH), "error", DRAWN).value
    return f"{1e6 * e:.2g} µrad" if e < 1e-4 else f"{1e3 * e:.2g} mrad"


def compared(one: Place, other: Place, condition: str = PUSH, measure: str = "error") -> str:
    """Ratio of errors, or difference of shares, with its interval."""
    sides = side_of(one, condition), side_of(other, condition)
    return in_words(statistics.compare(*sides, measure, DRAWN))


def lengths(tuning: str) -> str:
    """ "40 to 160": the most settings for each gain that a search may try at the places of a tuning."""
    names = [", ".join(at) for at in places() if at[2] == tuning]
    plans = [PLAN["search"] | PLAN["search_more"].get(name, {}) for name in names]
    most = [p["budget"] << p["doublings"] for p in plans]
    return f"{min(most)} to {max(most)}"


def stops() -> Names:
    """Of how many best settings a step breaks a limit, and which ones a step would improve; how many of them,
    and of those in the questions, gained in the last doubling; how many searches found nothing.
    """
    best = comparison.best_of(rows("settings"))
    untuned = [place_of(r) for r in best if r["stop"].startswith("not tuned")]
    questions = statistics.questions()["question"]
    sides: set[Place] = {tuple(q[k]) for q in questions for k in ("one", "other")}
    nothing = [r["controller"] for r in rows("settings") if "nothing better" in r["stop"]]
    gaining = [at for r in best if gain(at := place_of(r)) >= ENOUGH]
    return Names(
        count=len(best),
        limit=sum("the limit under" in r["stop"] for r in best),
        nothing=f"{len(nothing)} searches ({', '.join(dict.fromkeys(nothing))})",
        but=f", but for {', '.join(map(' '.join, untuned))}" if untuned else "",
        gaining=len(gaining),
        sides=sum(at in sides for at in gaining) or "none",
        asked_count=len(sides),
    )


def pairs(one: Place, other: Place) -> list[float]:
    """The ratio of errors under the push for each pair of searches of two controllers."""
    a, b = side_of(one, PUSH), side_of(other, PUSH)
    return [
        statistics.compare(Side(np.ones(1), x[None]), Side(np.ones(1), y[None]), "error", 1).value
        for x in a.errors
        for y in b.errors
    ]


def of_all(at: Place, condition: str) -> str:
    """The share [%] of feasible walks under a condition, over all searches at a place."""
    return f"{100.0 * np.isfinite(side_of(at, condition).errors).mean():.1f}"


def place_of(row: Mapping[str, str]) -> Place:
    """The place and controller of a row."""
    return row["hardware"], row["gait"], row["tuning"], row["controller"]


def gain(at: Place) -> float:
    """The share [1] by which the last doubling made the best search of a controller at a place better on the
    walks of choice; infinite where none kept the limits before it.
    """
    sign = comparison.sign_of(at[2])
    mine = [r for r in rows("settings") if place_of(r) == at and r["values"]]
    before, after = (
        min((sign * float(r[k]) for r in mine if r[k]), default=math.inf)
        for k in ("before", "doubled")
    )
    return (before - after) / abs(before) if before < math.inf else math.inf


def of_soft() -> Names:
    """Feasible walks on MuJoCo's ground, level and pushed, by controller; trunk: of m = 1 with +30 %."""
    names = {"m = 1": "m1", "ADRC b0": "b0", "NPD": "npd"}
    walked = {
        (r["controller"], r["condition"]): int(r["feasible"]) for r in rows("comparison_soft")
    }
    sums = {short: walked[k, "level"] + walked[k, PUSH] for k, short in names.items()}
    return Names(**sums, trunk=walked["m = 1", "trunk +30 %"])


def fine(at: Place, condition: str) -> int:
    """The number of feasible walks of the best search."""
    found = side_of(at, condition)
    return int(np.isfinite(found.errors[found.best]).sum())


def walks_of(case: str, condition: str) -> str:
    """Feasible walks of a case of the study `laws_and_gaits` under a condition."""
    return next(
        r["feasible"]
        for r in rows("laws_and_gaits")
        if (r["case"], r["condition"]) == (case, condition)
    )


def by_condition(one: str, other: str) -> str:
    """A table of two controllers behind encoders, tuned for tracking: feasible walks and ratio of errors on
    both gaits, by condition; no ratio where one walks fewer than half.
    """
    lines = ["| condition | walks, v0.6 | ratio, v0.6 | walks, rough | ratio, rough |"]
    lines.append("|---" * 5 + "|")
    for condition, words in LOADS.items():
        cells = [words]
        for gait in PLAN["gaits"]:
            a, b = ("rabbit", gait, "tracking", one), ("rabbit", gait, "tracking", other)
            walked = fine(a, condition), fine(b, condition)
            enough = min(walked) >= statistics.questions()["walks"] / 2
            cells += [f"{walked[0]}, {walked[1]}", compared(a, b, condition) if enough else "–"]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)
