"""Write docs/soft_walk.md: which controller and which policy across contact survive on soft ground.

Run: python docs/write_soft_walk.py OUT HELD_OUT

OUT, HELD_OUT: folders of `biped-adrc sweep examples/soft_ground.toml --out OUT` and of the same with
examples/soft_ground_held_out.toml, or docs/soft_walk, where summary.json and held_out.json have all that the
page says of them. From OUT some walks are walked again at half the engine's step, and some up to the end of
the push, ten minutes in all. Sentences follow from the numbers (`soft_page`); pictures are made by
make_soft_pictures.py.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import soft_cells as cells
from soft_cells import NPD, Row
from soft_page import page
from write_comparison import compact

from biped_adrc.analysis.contact_errors import AFTER, since_pushed
from biped_adrc.analysis.signals import Signals
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.run import run_trial
from biped_adrc.bench.study import Study
from biped_adrc.bench.study_file import load_study
from biped_adrc.bench.sweep import load_sweep
from biped_adrc.errors import InputError
from biped_adrc.files import write_text
from biped_adrc.scenario.run import walk_scenario

DOCS = Path(__file__).resolve().parent
PAGE, FOLDER = DOCS / "soft_walk.md", DOCS / "soft_walk"
STUDY = "examples/soft_ground.toml"
HELD_OUT = "examples/soft_ground_held_out.toml"
COMMAND = f"biped-adrc sweep {STUDY} --out out/soft"
HELD_OUT_COMMAND = f"biped-adrc sweep {HELD_OUT} --out out/soft-held-out"
ERRORS = ("peak_error", "rms_error", "settled_error", "settled_rms")
FEET = ("slip", "flight", "double_support", "penetration")
NUMBERS = ("pushed_error", "touchdown_error", *ERRORS, *FEET, "peak_torque")
KEPT = ("case", *cells.WHERE, "status", "survived", "impacts", *NUMBERS)
"""Columns of a walk in the summary."""
AGAIN = 24
"""Walks of each case that is walked again at half the engine's step."""
FELT = 1e-3
"""A torque from which on it is a push [N m]."""


def summarised(out: Path) -> dict[str, Any]:
    """What the page is written from, of the finished study. Raises InputError for an unfinished one."""
    rows = finished(out, COMMAND)
    return {
        "command": COMMAND,
        "columns": list(KEPT),
        "halved": halved(rows),
        "caused": caused(rows),
        "rows": [list(row.values()) for row in rows],
    }


def held_out(out: Path) -> dict[str, Any]:
    """The same of the finished study of cells that chose nothing: its walks alone."""
    rows = finished(out, HELD_OUT_COMMAND)
    return {
        "command": HELD_OUT_COMMAND,
        "columns": list(KEPT),
        "rows": [list(row.values()) for row in rows],
    }


def finished(out: Path, command: str) -> list[dict[str, Any]]:
    """All walks of a sweep, what is kept of them. Raises InputError for an unfinished one."""
    done = load_sweep(out)
    rows = [{name: _short(row.get(name)) for name in KEPT} for row in done.rows()]
    if len(rows) < done.study.count:
        raise InputError(
            f"'{out}' has {len(rows)} of {done.study.count} walks; run '{command}' to its end first"
        )
    return rows


def _short(x: Any) -> Any:
    """A number to four digits."""
    return float(f"{x:.4g}") if isinstance(x, float) else x


def halved(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Pushed walks of NPD and of the nearest case, spread over the study, at half the engine's step."""
    points = list(_study().points())
    found = []
    for case in (NPD, cells.nearest(rows)):
        those = [k for k, row in enumerate(rows) if row["case"] == case]
        those = [k for k in those if rows[k]["condition"] != cells.UNPUSHED and rows[k]["survived"]]
        for k in those[:: max(1, len(those) // AGAIN)]:
            step = min(2e-4, 0.1 * rows[k]["time_constant"])
            again = run_trial({**points[k].record, "plant_step": 0.5 * step})
            names = ("survived", "pushed_error", "touchdown_error")
            found.append({**rows[k], "half": {name: _short(again[name]) for name in names}})
    kept = ("case", *cells.WHERE, "pushed_error", "touchdown_error", "half")
    return [{name: row[name] for name in kept} for row in found]


def caused(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """What a push alone causes under the nearest case and under NPD, in each pushed cell.

    That is the largest difference of the errors with and without the push, under the same controller, from its
    onset to 50 ms after its end or to the end of the step.
    """
    records = {(p.at["case"], *cells.cell(p.at)): p.record for p in _study().points()}
    found = []
    for pair in cells.pushed(cells.pairs(rows, cells.nearest(rows))):
        at = cells.cell(pair.case)
        alone = (*at[:-1], cells.UNPUSHED)
        sizes = {
            name: _difference(records[row["case"], *at], records[row["case"], *alone])
            for name, row in (("case", pair.case), ("npd", pair.npd))
        }
        found.append({**dict(zip(cells.WHERE, at, strict=True)), **sizes})
    return found


def _difference(pushed: Mapping[str, Any], alone: Mapping[str, Any]) -> float:
    """Largest difference of the errors of two walks that are the same up to the push [rad]."""
    x, y = (_short_walk(json.dumps(record)) for record in (pushed, alone))
    onset = np.flatnonzero(np.any(np.abs(x.zeta) > FELT, axis=1))[0]
    beside = y.step == x.step[onset]
    rows = (x.step == x.step[onset]) & (x.t >= x.t[onset]) & (x.t <= y.t[beside][-1])
    rows &= since_pushed(x) <= AFTER
    found = [
        x.error[rows, k] - np.interp(x.t[rows], y.t[beside], y.error[beside, k])
        for k in range(x.error.shape[1])
    ]
    return float(_short(float(np.max(np.abs(found)))))


@cache
def _short_walk(record: str) -> Signals:
    """A walk of the study, up to the end of the pushed step."""
    return walk_scenario(trial({**json.loads(record), "impacts": 3})).signals


def _study() -> Study:
    return load_study(DOCS.parent / STUDY)


def read(path: Path) -> dict[str, Any]:
    """A summary. Raises InputError where there is none."""
    if not path.is_file():
        raise InputError(f"'{path}' is not there; give the folder of '{COMMAND}'")
    summary: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return summary


def main() -> None:
    """Read, walk, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("held_out", type=Path)
    given = parser.parse_args()
    for out, name, made in (
        (given.out, "summary.json", summarised),
        (given.held_out, "held_out.json", held_out),
    ):
        if out.resolve() != FOLDER:
            write_text(FOLDER / name, compact(made(out)))
    write_text(PAGE, page(read(FOLDER / "summary.json"), read(FOLDER / "held_out.json")))


if __name__ == "__main__":
    main()
