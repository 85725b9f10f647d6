"""The page of findings from its rows: every number that it prints, and its pictures.

page.md is the text with names in braces, such as {first.ratio}; `fields` computes what stands there. A test
holds docs/findings.md to both.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.analysis.statistics import share
from biped_adrc.core.files import write_bytes, write_text
from biped_adrc.view.plots.study import dots_figure
from biped_adrc.view.style import render
from validation.findings import comparison, statistics
from validation.findings.comparison import ROOT
from validation.findings.searches import PLAN
from validation.findings.statistics import Answer, Side

ROWS, IMAGES = ROOT / "docs" / "findings", ROOT / "docs" / "images"
PAGE, TEXT = ROOT / "docs" / "findings.md", Path(__file__).parent / "page.md"
COUNT = 2.0 * math.pi / 8192
"""One count of RABBIT's encoders [rad]."""
LEG = 0.8
"""Length of RABBIT's leg [m]: an error e of a hip moves the foot by 0.8 e."""
DRAWN = 2000
"""Draws of an interval in a picture."""
PUSH, HEIGHTS = "80 N m", ("5 mm", "10 mm", "20 mm")
LOADS = (PUSH, "hip, 2 N", "trunk +30 %", "masses x 0.7", "masses x 1.5", "1 ms more")
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


def picture(
    name: str, numbers: Mapping[tuple[str, str], Sequence[float]], title: str, scale: str
) -> None:
    """Draw a finding's numbers, (row, series) -> (number, low, high), as docs/images/found_NAME.svg."""
    figure = dots_figure(numbers, title, scale, 1.0 if title.startswith("ratio") else None)
    write_bytes(IMAGES / f"found_{name}.svg", render(figure, "svg"))


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
    """The median error of the best search: in mrad, in counts of the encoder, in mm of the foot."""
    e = statistics.alone(side_of(at, condition), "error", DRAWN).value
    return f"{1e3 * e:.2g} mrad ({e / COUNT:.2g} counts, {1e3 * LEG * e:.2g} mm of the foot)"


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


def write(path: Path = PAGE) -> None:
    """Draw the pictures, and write the page."""
    pictures()
    write_text(path, text())


def text() -> str:
    """The page, with its numbers."""
    return TEXT.read_text().format_map(fields())


def pictures() -> None:
    """Draw all pictures."""
    error = "median rms error under 80 N m [mrad]"
    for hardware in ("rabbit", "exact"):
        picture(hardware, by_controller(hardware, "tracking", PUSH, "error"), error, "log")
        at = (hardware, "v0.6", "tracking", "m = 1")
        picture(f"{hardware}_ratio", ratios(at, PUSH), "ratio of errors to m = 1", "log")
    feasible_share = "share of feasible walks"
    exact = {f"tuned for {t}": ("exact", "v0.6", t, "NPD") for t in ("tracking", "ground")}
    picture("tuning", shares(exact, HEIGHTS), feasible_share, "linear")
    by_gait = {g: ("rabbit", g, "ground", "m = 1") for g in PLAN["gaits"]}
    picture("gait", shares(by_gait, HEIGHTS), feasible_share, "linear")
    some = {c: ("rabbit", "v0.6", "tracking", c) for c in ("NPD", "PID", "ADRC b0", "m = 1")}
    kept = {c: at for c, at in some.items() if side(at, PUSH)}
    picture("load", shares(kept, LOADS), feasible_share, "linear")
    picture("soft", soft(), feasible_share, "linear")
    ends = (math.nan, math.nan)
    cases = dict.fromkeys((r["case"], r["condition"]) for r in rows("held_hip_force"))
    forces = {key: (largest_force(*key), *ends) for key in cases}
    picture("hip", forces, "largest force held on the hip [N]", "linear")
    heights = shares_of("laws_and_gaits", lambda r: (r["case"], r["condition"]))
    picture("heights", heights, feasible_share, "linear")
    least = {key: (e, *ends) for key, (e, _) in orders().items() if math.isfinite(e)}
    picture("orders", least, "least median rms error [mrad]", "log")


def soft() -> dict[tuple[str, str], Any]:
    """Share of feasible walks on MuJoCo's ground, by controller and condition."""
    result = {}
    for r in rows("comparison_soft"):
        fine = comparison.errors_of(r)
        result[r["controller"], r["condition"]] = share(int(r["feasible"]), len(fine))
    return result


def fields() -> dict[str, Any]:
    """What stands in the places of the text, by name."""
    rabbit, exact = ("rabbit", "v0.6", "tracking"), ("exact", "v0.6", "tracking")
    rough = ("rabbit", "rough", "tracking")
    ground = {gait: ("rabbit", gait, "ground", "m = 1") for gait in PLAN["gaits"]}
    of_ground, of_tracking = ("exact", "v0.6", "ground", "NPD"), (*exact, "NPD")
    plans = (PLAN["search"], *PLAN["search_more"].values())
    budgets = [x["budget"] for x in plans]
    walked_10 = [
        fine((hardware, "v0.6", "ground", c), "10 mm")
        for hardware in PLAN["hardware"]
        for c in PLAN["controllers"]
    ]
    return {
        **{f"q{i}": question(*x) for i, x in enumerate(answers(), 1)},
        "walks": statistics.questions()["walks"],
        "versions": versions(),
        "size": Names(
            m1=sizes((*rabbit, "m = 1")),
            npd=sizes((*rabbit, "NPD")),
            m1x=micro((*exact, "m = 1")),
            npdx=micro((*exact, "NPD")),
        ),
        "push": Names(
            m1=fine((*rabbit, "m = 1"), PUSH),
            npd=fine((*rabbit, "NPD"), PUSH),
            m1hip=fine((*rabbit, "m = 1"), "hip, 2 N"),
            npdhip=fine((*rabbit, "NPD"), "hip, 2 N"),
            hip=compared((*rabbit, "m = 1"), (*rabbit, "NPD"), "hip, 2 N", "share"),
            heavy=compared((*rabbit, "m = 1"), (*rabbit, "NPD"), "masses x 1.5"),
        ),
        "limit": Names(
            npd=fine((*rabbit, "NPD"), comparison.LATER),
            m1=fine((*rabbit, "m = 1"), comparison.LATER),
        ),
        "range": Names(low=min(walked_10), high=max(walked_10)),
        "failed": failures(),
        "stop": stops(),
        "exact": Names(
            b0m=compared((*exact, "ADRC b0"), (*exact, "m = 1")),
            st=compared((*exact, "super twisting"), (*exact, "NPD")),
        ),
        "ground": Names(
            each=", ".join(str(np.isfinite(x).sum()) for x in side_of(of_ground, "10 mm").errors),
        ),
        "gains": Names(ground=gains(of_ground), tracking=gains(of_tracking)),
        "again": Names(
            npd=compared((*rough, "m = 1"), (*rough, "NPD")),
            npd_value=compared((*rough, "m = 1"), (*rough, "NPD")).partition(" ")[0],
            pid=compared((*rough, "m = 1"), (*rough, "PID")),
            b0=compared((*rough, "ADRC b0"), (*rough, "m = 1")),
        ),
        "margin": Names(
            b0=margin((*exact, "ADRC b0"), "disk_margin"),
            none=sum(r["disk_margin"] == "0" for r in rows("margins")),
            count=len(rows("margins")),
        ),
        "gait": Names(
            rough20=feasible(ground["rough"], "20 mm"),
            level20=feasible(ground["v0.6"], "20 mm"),
            b0=fine((*rough, "ADRC b0"), "10 mm"),
            m1=fine((*rough, "m = 1"), "10 mm"),
        ),
        "load": Names(
            light=by_name(rabbit, "masses x 0.7"),
            light_rough=by_name(rough, "masses x 0.7"),
            light_ground=by_name(ground["v0.6"][:3], "masses x 0.7"),
        ),
        "soft": of_soft(),
        "hip": Names(
            npd=largest_force("NPD", "exact sensors"),
            step=largest_force("footstep, 0.25 m", "exact sensors"),
        ),
        "spread": Names(npd=spread((*rabbit, "NPD")), m1=spread((*rabbit, "m = 1"))),
        "heights": Names(
            level=walks_of("reset, v0.6", "20 mm"),
            npd=walks_of("NPD, rough", "20 mm"),
            rough=walks_of("reset, rough", "20 mm"),
        ),
        "plan": Names(low=min(budgets), high=max(budgets)),
        "orders": Names(
            most=", ".join(orders()[f"m = {m}", "push, 80 N m"][1] for m in (1, 2, 3, 5, 7)),
        ),
    }


class Names:
    """Texts by name, so that {size.m1} finds its own."""

    def __init__(self, **texts: object) -> None:
        vars(self).update(texts)


def question(q: dict[str, Any], answer: Answer | None, p: float) -> Names:
    """The answer to a question: its number with the interval, and p."""
    value = "" if answer is None else f"{answer.value:.2g}"
    return Names(value=value, said=in_words(answer), p=p_in_words(p) + warning(q["one"]))


def versions() -> str:
    """Each committed version of the questions' text, by hash and date."""
    with (statistics.HERE / "versions.csv").open() as file:
        return "; ".join(f"{r['hash']} of {r['date']}, {r['what']}" for r in csv.DictReader(file))


def micro(at: Place) -> str:
    """The median error in urad."""
    return f"{1e6 * statistics.alone(side_of(at, PUSH), 'error', DRAWN).value:.2g} µrad"


def compared(one: Place, other: Place, condition: str = PUSH, measure: str = "error") -> str:
    """Ratio of errors, or difference of shares, with its interval."""
    sides = side_of(one, condition), side_of(other, condition)
    return in_words(statistics.compare(*sides, measure, DRAWN))


def best_row(at: Place) -> dict[str, str]:
    """The row of the best search at a place."""
    keys = ("hardware", "gait", "tuning", "controller")
    best = comparison.best_of(rows("settings"))
    return next(r for r in best if tuple(r[k] for k in keys) == at)


def gains(at: Place) -> str:
    """K_p and K_d of the best search."""
    values = json.loads(best_row(at)["values"])
    return " / ".join(f"{values[f'controller.{k}']:.3g}" for k in ("K_p", "K_d"))


def stops() -> Names:
    """Of how many best searches a limit, or nothing, is what stopped them."""
    best = comparison.best_of(rows("settings"))
    every = [r["stop"] for r in best]
    limit = sum("1 ms more" in x for x in every if not x.startswith("not tuned"))
    untuned = [r["tuning"] for r in best if r["stop"].startswith("not tuned")]
    tunings = [r["tuning"] for r in best]
    words = f"{untuned.count('ground')} of {tunings.count('ground')}"
    questions = statistics.questions()["question"]
    sides = (tuple(q[k]) for q in questions for k in ("one", "other"))
    asked = {at: best_row(at)["stop"].partition(";")[0] for at in sides}
    some = [f"{at[-1]} ({x})" for at, x in asked.items() if x.startswith("not tuned")]
    sides_in_words = ", ".join(dict.fromkeys(some)).replace("not tuned: ", "")
    one, four = (questions[i] for i in (0, 3))
    return Names(
        count=len(every),
        limit=limit,
        untuned=len(untuned),
        ground=words,
        asked=sides_in_words,
        gaining=sum(float(x.rstrip("%")) >= 2.0 for x in map(gained, best)),
        npd=gained(best_row(tuple(one["other"]))),
        m1=gained(best_row(tuple(one["one"]))),
        b0=gained(best_row(tuple(four["one"]))),
    )


def gained(row: dict[str, str]) -> str:
    """What the last doubling of a search gained."""
    return row["stop"].rpartition("gained ")[2]


def by_name(at: tuple[str, str, str], condition: str) -> str:
    """Feasible walks of the best search of each controller at a place, such as "PD 8, NPD 5"."""
    found = {c.removeprefix("ADRC "): fine((*at, c), condition) for c in PLAN["controllers"]}
    return ", ".join(f"{c.removesuffix(', m = 1')} {n}" for c, n in found.items())


def of_soft() -> Names:
    """Feasible walks on MuJoCo's ground, level and pushed, by controller."""
    names = {"m = 1": "m1", "assisted, m = 1": "assisted", "ADRC b0": "b0"}
    names |= {"cascade": "cascade", "NPD": "npd"}
    hard = [r for r in rows("comparison_soft") if r["condition"] != "trunk +30 %"]
    mine = {k: [int(r["feasible"]) for r in hard if r["controller"] == k] for k in names}
    return Names(**{names[k]: sum(x) for k, x in mine.items()})


def fine(at: Place, condition: str) -> int:
    """The number of feasible walks of the best search."""
    found = side_of(at, condition)
    return int(np.isfinite(found.errors[found.best]).sum())


def failures() -> str:
    """How many searches found no setting within the limits, and how many chose the case as it was."""
    every = [r["values"] for r in rows("settings")]
    none, before = every.count(""), every.count("{}")
    return f"{none} of {len(every)} found no setting, {before} chose the controller's defaults"


def walks_of(case: str, condition: str) -> str:
    """Feasible walks of a case of the study `laws_and_gaits` under a condition."""
    return next(
        r["feasible"]
        for r in rows("laws_and_gaits")
        if (r["case"], r["condition"]) == (case, condition)
    )


def spread(at: Place) -> str:
    """Largest over least median error of a controller's searches, on the walks of choice."""
    keys = ("hardware", "gait", "tuning", "controller")
    mine = [r for r in rows("settings") if tuple(r[k] for k in keys) == at and r["values"]]
    errors = [float(r["on choice"]) for r in mine]
    return f"{max(errors) / min(errors):.2g}"


def margin(at: Place, column: str) -> str:
    """A number of margins.csv of the best search at a place."""
    keys = ("hardware", "gait", "tuning", "controller")
    search = best_row(at)["search"]
    mine = (r for r in rows("margins") if tuple(r[k] for k in keys) == at)
    return next(r[column] for r in mine if r["search"] == search)
