"""The paper reproduced end to end: run everything, check it, and write what it came to.

    plan -> tasks (campaign.pool) -> Results -> claims, checks, tables, findings -> summary, figures, report

Written to the output folder: figures (PNG, SVG, JSON), the two headline runs (npz and JSON), walk.html,
summary.json and report.html. Each file is written whole or not at all, so that an interrupted run leaves
readable files. The command `reproduce` calls this; its exit code says whether all checks hold.

In summary.json: `holds` and `checks` (what is asserted), `claims` (the table of the paper's claims) with
`claims_evidence`, `tables` and `findings` (what the report shows), `convergence` (every figure of merit at two
steps), `settings` and `versions`, and the wall time of each task.
"""

from __future__ import annotations

import json
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from biped_adrc.analysis.regression import Regression
from biped_adrc.campaign.pool import TaskProgress, run_tasks
from biped_adrc.checks import Check
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.files import check_folder, check_place, plain, write_text
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.paper import verdicts
from biped_adrc.paper.claims.table import claims
from biped_adrc.paper.claims.tasks import gathered
from biped_adrc.paper.claims.words import MEANINGS, PREFACE, Claim, claim_checks
from biped_adrc.paper.convergence import observed_order, records
from biped_adrc.paper.figures import push_window
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.physical_laws import work_identity
from biped_adrc.paper.pictures import draw_all
from biped_adrc.paper.plan import Headline, Plan
from biped_adrc.paper.plan import tasks as planned_tasks
from biped_adrc.paper.results import Results
from biped_adrc.paper.tables import findings, notes, tables
from biped_adrc.scenario.stored import replay
from biped_adrc.versions import versions
from biped_adrc.viz.meshcat.view import Look, animation_html
from biped_adrc.viz.pages import write_report

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
    r = Results.of({name: found.value for name, found in zip(named, done, strict=True)})
    found = claims(plan, r)
    checks = _checks(plan, r) + claim_checks(found) + _laws(plan, r)
    simulated = time.perf_counter()
    made = {
        "command": command,
        **_said(plan, r, found),
        "holds": all(check.holds for check in checks),
        "checks": checks,
        "tables": tables(plan, r),
        **_numbers(plan, r),
        "push_map": [cell.row() for cell in r.cells],
        "seconds": {name: one.seconds for name, one in zip(named, done, strict=True)},
    }
    summary: dict[str, Any] = plain(made)
    for c, head in r.heads.items():
        _save(head, out / f"walk-{c.lower()}.npz")
    pictures = draw_all(plan, r, out, workers)
    animation = _animate(r)
    write_text(out / "walk.html", animation)
    summary["wall_time_s"] = time.perf_counter() - started
    write_report(out / "report.html", summary, pictures, animation)
    summary["seconds_writing"] = time.perf_counter() - simulated
    write_text(out / "summary.json", json.dumps(summary, indent=1) + "\n")
    return summary


def _laws(plan: Plan, r: Results) -> list[Check]:
    """The checks of physical laws that the runs were held against."""
    parts = [laws for laws, _ in r.numerics.values()] + [r.headline[c][1] for c in CONTROLLERS]
    nominal = dict(r.nominal(plan))
    for preset in plan.presets:
        works = [work_identity(nominal[f"{preset} {c}"]) for c in CONTROLLERS]
        parts += [r.model[preset], works]
    return [law for part in parts for law in part]


def _said(plan: Plan, r: Results, found: list[Claim]) -> dict[str, object]:
    """What the summary says in words: settings, findings, claims, notes."""
    return {
        "preset": plan.preset,
        "left_out": list(plan.left_out),
        "findings": findings(plan, r),
        "settings": _settings(plan),
        "versions": versions(),
        "claims_preface": PREFACE,
        "claims_words": MEANINGS,
        "claims": [claim.record() for claim in found],
        "notes": notes() + verdicts.recipe_notes(r, plan),
    }


def _numbers(plan: Plan, r: Results) -> dict[str, object]:
    """The numbers of the runs, at the steps at which they were made."""
    return {
        "claims_evidence": gathered(r.claims.values()),
        "nominal": {name: [s.record() for s in o.certificates] for name, o in r.nominal(plan)},
        "multipliers": {c: r.multipliers[c].record() for c in CONTROLLERS if c in r.multipliers},
        "headline": {c: _three_steps(head) for c, head in r.heads.items()},
        "convergence": list(records(r.run_twice)),
        "regression": {c: _regression(c, found) for c, found in r.regressions.items()},
    }


def _checks(plan: Plan, r: Results) -> list[Check]:
    """What the runs have to show, besides physical laws and claims."""
    return (
        verdicts.consistency_checks(plan, r)
        + verdicts.push_checks(r)
        + verdicts.engine_checks(r)
        + verdicts.convergence_checks(r)
        + verdicts.multiplier_checks(r)
        + verdicts.recipe_checks(plan, r)
        + verdicts.certificate_checks(plan, r)
    )


def probe(out: Path) -> None:
    """Make the folder and try to write in it, since the runs take minutes.

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


def _settings(plan: Plan) -> dict[str, object]:
    """What was asked for, and the constants of the paper that all runs use."""
    fields = [name for name in Plan.__dataclass_fields__ if name != "pushes"]
    return {
        **{name: getattr(plan, name) for name in fields},
        "presets": list(plan.presets),
        "pushes": [push.in_words() for push in plan.pushes],
        "Table I, observer eigenvalues [rad/s]": list(TABLE_I),
        "Table II": {"K_p": TABLE_II.K_p, "K_d": TABLE_II.K_d},
    }


def _three_steps(head: Headline) -> dict[str, object]:
    """The largest error under the push [rad] at the step used, its half and its quarter, and the order from
    them.
    """
    o = head.outcome
    assert o.half is not None
    assert o.half.half is not None
    peaks = [x.peak_error for x in (o, o.half, o.half.half)]
    order = observed_order(o, lambda x: x.peak_error)
    return {"step": o.run.run.fine, "peak_error": peaks, "order": order}


STORED_APART = 1e-3
"""Distance of the stored nodes of a headline run [s], except in the single supports with fine steps."""


def _save(head: Headline, path: Path) -> None:
    """Store a headline run as npz and JSON, from which it can be drawn and animated again."""
    replay(head.outcome.run, _stored(head)).save(path)


def _stored(head: Headline) -> Trajectory:
    """The trajectory without nodes that no picture needs: where nothing switches the solution is smooth."""
    pushed = {push.step + k for push in head.outcome.run.pushes for k in (0, 1)}
    arcs = (
        arc if arc.mode.step in pushed else arc.thinned(STORED_APART)
        for arc in head.trajectory.arcs
    )
    return replace(head.trajectory, arcs=tuple(arcs))


def _regression(controller: str, found: Regression) -> dict[str, object]:
    """The regression (27) on a pushed walk in plain values, with the warning that its data do not
    determine it.
    """
    names = ("magnitudes", "rank", "condition", "samples", "warning")
    return {"controller": controller, **{name: getattr(found, name) for name in names}}


def _animate(r: Results) -> str:
    """The animation of both headline runs as one HTML page, with the window of the push marked."""
    walks = {c: replay(head.outcome.run, head.trajectory) for c, head in r.heads.items()}
    window = push_window(r.heads["NPD"].signals)
    return animation_html(walks, Look("ADRC", [] if window is None else [(*window, "push")]))


def failed(checks: list[dict[str, object]]) -> list[dict[str, object]]:
    """The checks that do not hold, of those of a summary."""
    return [check for check in checks if not check["holds"]]


def main_table(summary: dict[str, Any]) -> list[tuple[str, str, str, str]]:
    """Claim, place in the paper, word, share of the cases: what the command prints."""
    return [(row["claim"], row["where"], row["word"], row["share"]) for row in summary["claims"]]
