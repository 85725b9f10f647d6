"""The paper reproduced end to end: run everything, judge it, and write what it came to.

    Plan -> tasks (processes) -> Results -> the one table of claims and checks -> summary, figures, report

Written to the output folder: figures (PNG, SVG), the two headline runs (npz and JSON), walk.html, summary.json
and report.html. Each file is written whole or not at all, so that an interrupted run leaves readable files. The
command `reproduce` calls this; its exit code says whether all checks hold.

In summary.json: `holds` and `checks` (what is asserted), `tally` and `claims` (what became of the paper's
claims), `findings` and `tables` (what the report shows), `settings` and `versions`, and the wall time of each
task.
"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

from biped_adrc.control.tracking import TABLE_II
from biped_adrc.core.files import check_folder, check_place, plain, write_text
from biped_adrc.core.processes import TaskProgress, run_tasks
from biped_adrc.core.versions import versions
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.paper.figures import draw_all, push_window
from biped_adrc.paper.results import Results
from biped_adrc.paper.runs import tasks as planned_tasks
from biped_adrc.paper.scenarios import CONTROLLERS, Plan
from biped_adrc.paper.table import checks, rows
from biped_adrc.paper.tables import tables
from biped_adrc.paper.verdict import tally, texts
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.stored import replay
from biped_adrc.view.meshcat.view import animation_html
from biped_adrc.view.pages import report_html

WRITTEN = (".html", ".json", ".npz", ".png", ".svg")
"""Kinds of the files that a reproduction writes."""


def reproduce(
    plan: Plan,
    out: Path,
    command: str,
    workers: int | None = None,
    progress: TaskProgress | None = None,
) -> dict[str, Any]:
    """Run the plan and write everything to `out`; returns what summary.json holds.

    command: as typed, for the report. workers: processes, one per core if None. progress: called after each
    task. Checks are judged before anything is drawn, and the summary is written last, when all other files are
    there. Raises OutputError before the first run when `out` cannot be written.
    """
    started = time.perf_counter()
    probe(out)
    named = planned_tasks(plan)
    done = run_tasks(list(named.values()), workers, progress)
    r = Results.of(plan, {name: one.value for name, one in zip(named, done, strict=True)})
    summary = judgement(r)
    seconds = {name: one.seconds for name, one in zip(named, done, strict=True)}
    summary |= {"command": command, "seconds": seconds, "versions": versions()}
    walks = {c: replay(head.outcome.run, head.trajectory) for c, head in r.headline.items()}
    for c, walk in walks.items():
        walk.save(out / f"walk-{c.lower()}.npz")
    pictures = draw_all(r, walks, out, workers)
    animation = headline_animation(walks)
    write_text(out / "walk.html", animation)
    summary["wall_time_s"] = time.perf_counter() - started
    write_text(out / "report.html", report_html(summary, pictures, animation))
    write_text(out / "summary.json", json.dumps(summary, indent=1) + "\n")
    return summary


def judgement(r: Results) -> dict[str, Any]:
    """Claims, checks, tables and numbers of a reproduction, in plain values."""
    plan, of_claims = r.plan, rows(r)
    result = checks(r, of_claims)
    parts = {
        "preset": plan.preset,
        "left_out": list(plan.left_out),
        "holds": all(check.holds for check in result),
        "checks": result,
        "tally": tally(of_claims),
        "claims_preface": texts()["preface"],
        "claims_words": texts()["words"],
        "claims": of_claims,
        "findings": [row.finding for row in of_claims if row.finding],
        "notes": list(texts()["notes"].values()),
        "settings": {
            **{name: getattr(plan, name) for name in ("preset", "presets", "full", "quick")},
            "pushes": [push.in_words() for push in plan.pushes],
            "Table I, observer eigenvalues [rad/s]": list(TABLE_I),
            "Table II": {"K_p": TABLE_II.K_p, "K_d": TABLE_II.K_d},
        },
        "tables": tables(r),
        "members": [o for part in r.members.values() for o in part],
        "multipliers": {name: result.record() for name, result in r.multipliers.items()},
        "push_map": [cell.row() for cell in r.cells],
    }
    summary: dict[str, Any] = plain(parts)
    return summary


def probe(out: Path) -> None:
    """Make the folder and try to write in it, since the runs take a minute.

    Raises InputError for what is no folder, and OutputError, also where a file there that may be written over
    is a link or a device.
    """
    check_folder(out)
    marker = out / ".writable"
    write_text(marker, "")
    marker.unlink()
    for path in out.iterdir():
        if path.suffix in WRITTEN:
            check_place(path)


def headline_animation(walks: dict[str, Walk]) -> str:
    """The animation of both headline runs as one HTML page, ADRC solid, with the window of the push marked."""
    window = push_window(walks["NPD"].signals)
    in_order = {c: walks[c] for c in CONTROLLERS}  # the last is solid
    return animation_html(in_order, marks=[] if window is None else [(*window, "push")])
