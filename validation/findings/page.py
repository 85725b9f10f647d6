"""The two pages of the findings from their rows: every number that they print, and the pictures.

findings.md and comparison.md here are the texts with names in braces, such as {q1.value}; `fields` computes
what stands there. A test holds both pages in docs to that.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.core.files import write_bytes, write_text
from biped_adrc.view.plots.study import dots_figure
from biped_adrc.view.style import render
from validation.findings import comparison, statistics
from validation.findings.comparison import ROOT
from validation.findings.numbers import (
    HEIGHTS,
    HIP,
    LIGHT,
    LOADS,
    PUSH,
    Names,
    answers,
    by_condition,
    by_controller,
    compared,
    error_in_words,
    feasible,
    fine,
    largest_force,
    last_digits,
    lengths,
    of_all,
    of_soft,
    orders,
    pairs,
    place_of,
    question,
    ratios,
    rows,
    shares,
    shares_of,
    side,
    side_of,
    sizes,
    soft,
    stops,
    walks_of,
)
from validation.findings.searches import PLAN
from validation.findings.steps import OUTSIDE, WHY_GAIN, WHY_LIMIT

IMAGES = ROOT / "docs" / "images"
PAGES = [ROOT / "docs" / f"{name}.md" for name in ("findings", "comparison")]


def picture(
    name: str, numbers: Mapping[tuple[str, str], Sequence[float]], title: str, scale: str
) -> None:
    """Draw a finding's numbers, (row, series) -> (number, low, high), as docs/images/found_NAME.svg."""
    figure = dots_figure(numbers, title, scale, 1.0 if title.startswith("ratio") else None)
    write_bytes(IMAGES / f"found_{name}.svg", render(figure, "svg"))


def write() -> None:
    """Draw the pictures, and write the pages."""
    pictures()
    for path, text in texts().items():
        write_text(path, text)


def texts() -> dict[Path, str]:
    """Each page, with its numbers."""
    numbers = fields()
    here = Path(__file__).parent
    return {path: (here / path.name).read_text().format_map(numbers) for path in PAGES}


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
    by_load = shares(kept, [*LOADS])
    in_words = {(LOADS[c], name): x for (c, name), x in by_load.items()}
    picture("load", in_words, feasible_share, "linear")
    picture("soft", soft(), feasible_share, "linear")
    ends = (math.nan, math.nan)
    cases = dict.fromkeys((r["case"], r["condition"]) for r in rows("held_hip_force"))
    forces = {key: (largest_force(*key), *ends) for key in cases}
    picture("hip", forces, "largest force held on the hip [N]", "linear")
    heights = shares_of("laws_and_gaits", lambda r: (r["case"], r["condition"]))
    picture("heights", heights, feasible_share, "linear")
    least = {key: (e, *ends) for key, (e, _) in orders().items() if math.isfinite(e)}
    picture("orders", least, "least median rms error [mrad]", "log")


def fields() -> dict[str, Any]:
    """What stands in the places of the text, by name."""
    rabbit, exact = ("rabbit", "v0.6", "tracking"), ("exact", "v0.6", "tracking")
    rough = ("rabbit", "rough", "tracking")
    ground = {gait: ("rabbit", gait, "ground", "m = 1") for gait in PLAN["gaits"]}
    of_ground = ("exact", "v0.6", "ground", "NPD")
    best = comparison.best_of(rows("settings"))
    every_pair = pairs((*rabbit, "m = 1"), (*rabbit, "NPD"))
    walked_10, so_tuned = (
        [
            fine((hardware, "v0.6", tuning, c), "10 mm")
            for hardware in PLAN["hardware"]
            for c in PLAN["controllers"]
        ]
        for tuning in ("ground", "tracking")
    )
    # b0 and the three behind it are ADRC laws
    light = [fine((*rabbit, c), LIGHT) for c in PLAN["controllers"]]
    outside = sum(r["stop"] == OUTSIDE for r in rows("settings"))
    unstable = [r for r in rows("margins") if r["disk_margin"] == "0"]
    on_ground = [fine(("rabbit", "v0.6", "ground", c), LIGHT) for c in PLAN["controllers"]]
    on_20 = {
        gait: [
            fine((h, gait, "ground", c), "20 mm")
            for h in PLAN["hardware"]
            for c in PLAN["controllers"]
        ]
        for gait in PLAN["gaits"]
    }
    return {
        **{f"q{i}": question(*x) for i, x in enumerate(answers(), 1)},
        "walks": statistics.questions()["walks"],
        "table": by_condition("m = 1", "NPD"),
        "size": Names(
            m1=sizes((*rabbit, "m = 1")),
            npd=sizes((*rabbit, "NPD")),
            m1x=error_in_words((*exact, "m = 1")),
        ),
        "push": Names(
            m1=fine((*rabbit, "m = 1"), PUSH),
            npd=fine((*rabbit, "NPD"), PUSH),
            m1_hip=fine((*rabbit, "m = 1"), HIP),
            npd_hip=fine((*rabbit, "NPD"), HIP),
            b0_hip=fine((*rabbit, "ADRC b0"), HIP),
            m1_all=of_all((*rabbit, "m = 1"), HIP),
            npd_all=of_all((*rabbit, "NPD"), HIP),
        ),
        "limit": Names(least=min(fine(place_of(r), comparison.LATER) for r in best)),
        "range": Names(
            low=min(walked_10),
            tracking_words=f"at most {max(so_tuned)}" if any(so_tuned) else "none",
            rough_least=min(on_20["rough"]),
            pd20=fine(("rabbit", "v0.6", "ground", "PD"), "20 mm"),
            level20=sorted(on_20["v0.6"])[-2],
        ),
        "stop": stops(),
        "steps": Names(
            count=len(rows("settings")),
            missed=sum(r["why"] == WHY_LIMIT for r in rows("settings")),
            moved=sum(r["why"] == WHY_GAIN for r in rows("settings")),
            outside=f"; {outside} never did" if outside else "",
        ),
        "digits": last_digits(),
        "exact": Names(
            b0m=compared((*exact, "ADRC b0"), (*exact, "m = 1")),
            b0m_later=compared((*exact, "ADRC b0"), (*exact, "m = 1"), comparison.LATER),
            trunk=compared((*exact, "m = 1"), (*exact, "NPD"), "trunk +30 %"),
            st=compared((*exact, "super twisting"), (*exact, "NPD")),
        ),
        "ground": Names(
            each=", ".join(str(np.isfinite(x).sum()) for x in side_of(of_ground, "10 mm").errors),
        ),
        "again": Names(
            pid=compared((*rough, "m = 1"), (*rough, "PID")),
        ),
        "margin": Names(
            none=len(unstable),
            names=", ".join(sorted({r["controller"].removeprefix("ADRC ") for r in unstable})),
            count=len(rows("margins")),
        ),
        "gait": Names(
            level10=feasible(ground["v0.6"], "10 mm"),
            rough20=feasible(ground["rough"], "20 mm"),
            level20=feasible(ground["v0.6"], "20 mm"),
        ),
        "load": Names(
            m1=fine((*rabbit, "m = 1"), LIGHT),
            m1_ground=fine(("rabbit", "v0.6", "ground", "m = 1"), LIGHT),
            most=max(light[:4]),
            other=min(light[:4]),
            npd=light[1],
            rough=fine((*rough, "NPD"), LIGHT),
            rough_adrc=max(fine((*rough, c), LIGHT) for c in [*PLAN["controllers"]][4:]),
            adrc=max(light[4:]),
            ground=min(on_ground[:-1]),
            cascade=on_ground[-1],
        ),
        "soft": of_soft(),
        "hip": Names(
            npd=largest_force("NPD", "exact sensors"),
            step=largest_force("footstep, 0.25 m", "exact sensors"),
        ),
        "spread": Names(low=f"{min(every_pair):.2f}", high=f"{max(every_pair):.2f}"),
        "heights": Names(
            level=walks_of("reset, v0.6", "20 mm"),
            npd=walks_of("NPD, rough", "20 mm"),
            rough=walks_of("reset, rough", "20 mm"),
            step=walks_of("footstep, rough", "20 mm"),
        ),
        "plan": Names(**{tuning: lengths(tuning) for tuning in PLAN["tunings"]}),
        "orders": Names(
            first=orders()["m = 1", "push, 80 N m"][1],
            others=", ".join(orders()[f"m = {m}", "push, 80 N m"][1] for m in (2, 3, 5, 7)),
        ),
    }
