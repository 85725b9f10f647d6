"""The paper reproduced end to end: run everything, judge it, and write what it came to.

    Plan -> tasks (processes) -> Runs (results) -> table of claims and checks -> summary, figures, report

Written to the output folder: figures (PNG, SVG), the two headline runs (npz and JSON), walk.html, summary.json
and report.html. Each file is written whole or not at all, so that an interrupted run leaves readable files. The
command `reproduce` calls this; its exit code says whether all checks hold.

    plan             what to compute: presets (sets of masses of the robot RABBIT), pushes, parts left out
    NPD, ADRC        the two controllers: PD with decoupling of the inertia, and ADRC with an observer
    x*               the paper's fixed point: (q, q') [rad, rad/s] just before an impact of its periodic walk
    gait (a), (b)    that through x*, and that by the recipe of the paper's section IV
    headline runs    a walk of 25 impacts on gait (a) for each controller, with the push of the plan
    map of pushes    many pushes, tried under both controllers
    multipliers      eigenvalues of the derivative of the return map, from impact to impact, at a periodic walk
    Outcome          the numbers of one walk; `half` is the same walk at half of the integration step

Drawing takes longer than some of the walks, so each figure is a `Task`, drawn by one of several processes. The
drawing itself is in `view`; here is which signals each figure gets.

In summary.json: `holds` and `checks` (what is asserted), `tally` and `claims` (what became of the paper's
claims), `findings` and `tables` (what the report shows), `settings` and `versions`, and the wall time of each
task.
"""

import itertools
import json
import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from biped_adrc.analysis.feasibility import COUNTED
from biped_adrc.analysis.signals import Signals
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.core.files import check_folder, check_place, plain, write_bytes, write_text
from biped_adrc.core.processes import Task, TaskProgress, run_tasks
from biped_adrc.core.types import PlainRecord
from biped_adrc.core.versions import versions
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS, X_STAR
from biped_adrc.model.biped import Biped
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.paper.poincare import regression_of
from biped_adrc.paper.pushes import LOST, OUTCOME_WORDS, PushCell, word_of
from biped_adrc.paper.runs import PRELOADED, Runs, tasks
from biped_adrc.paper.scenarios import CONTROLLERS, Plan
from biped_adrc.paper.table import all_texts, checks, findings, rows, tally
from biped_adrc.scenario.recording import Outcome, Walk
from biped_adrc.scenario.stored import rebuilt_walk
from biped_adrc.view.from_the_side.check_figure import check_figure
from biped_adrc.view.meshcat.view import animation_html
from biped_adrc.view.pages import report_html
from biped_adrc.view.plots import figures
from biped_adrc.view.plots.study import map_figure
from biped_adrc.view.style import render

_WRITTEN = (".html", ".json", ".npz", ".png", ".svg")
"""Kinds of the files that a reproduction writes."""


def reproduce(
    plan: Plan, out: Path, command: str, workers: int | None, progress: TaskProgress | None
) -> dict[str, Any]:
    """Run the plan and write everything to the folder `out`; returns what summary.json holds.

    command: as the user typed it, for the report. workers: processes, one per core if None. progress: called
    after each task. Checks are judged before anything is drawn, and the summary is written last, when all other
    files are there. Raises OutputError before the first run when `out` cannot be written.
    """
    started = time.perf_counter()
    probe(out)
    named = tasks(plan)
    done = run_tasks(list(named.values()), workers, PRELOADED, progress)
    r = Runs.of(plan, {name: one.value for name, one in zip(named, done, strict=True)})
    summary = judgement(r)
    seconds = {name: one.seconds for name, one in zip(named, done, strict=True)}
    summary |= {"command": command, "seconds": seconds, "versions": versions()}
    # workers send back scenario and trajectory alone; the walk is made again from these
    walks = {c: rebuilt_walk(head.outcome.run, head.trajectory) for c, head in r.headline.items()}
    for c, walk in walks.items():
        walk.save(out / f"walk-{c.lower()}.npz")
    drawn = draw_all(r, walks, out, workers)
    animation = headline_animation(walks)
    write_text(out / "walk.html", animation)
    summary["wall_time_s"] = time.perf_counter() - started
    write_text(out / "report.html", report_html(summary, drawn, animation))
    write_text(out / "summary.json", json.dumps(summary, indent=1) + "\n")
    return summary


def judgement(r: Runs) -> dict[str, Any]:
    """What summary.json holds of the results, in values that JSON has: claims, checks, tables and numbers.

    `holds` is whether all checks hold. Command, times and versions are added by `reproduce`.
    """
    plan, of_claims = r.plan, rows(r)  # rows: each claim with its verdict
    result = checks(r, of_claims)
    parts = {
        "preset": plan.preset,
        "left_out": list(plan.left_out),
        "holds": all(check.holds for check in result),
        "checks": result,
        "tally": tally(of_claims),
        "claims_preface": all_texts()["preface"],
        "claims_words": all_texts()["words"],
        "claims": of_claims,
        "findings": findings(r, of_claims),
        "notes": list(all_texts()["notes"].values()),
        "settings": {
            **{name: getattr(plan, name) for name in ("preset", "presets", "full", "quick")},
            "pushes": [push.in_words() for push in plan.pushes],
            "Table I, observer eigenvalues [rad/s]": list(TABLE_I),
            "Table II": {"K_p": TABLE_II.K_p, "K_d": TABLE_II.K_d},
        },
        "tables": tables(r),
        "members": [o for part in r.members.values() for o in part],
        "push_map": [cell.row() for cell in r.cells],
    }
    return plain(parts)


def probe(out: Path) -> None:
    """Make the folder and write a file in it, which is deleted again: a folder that cannot be written is found
    before the runs, which take a minute.

    Raises InputError where `out` is no folder; OutputError where it cannot be written, or where a link or a
    device in it has the suffix of a file that a reproduction writes, such as .html.
    """
    check_folder(out)
    marker = out / ".writable"
    write_text(marker, "")
    marker.unlink()
    for path in out.iterdir():
        if path.suffix in _WRITTEN:
            check_place(path)


def headline_animation(walks: dict[str, Walk]) -> str:
    """Text of an HTML page with both headline runs animated, ADRC solid and NPD translucent; the word "push" is
    shown while the push acts.
    """
    window = figures.push_window(walks["NPD"].signals)
    in_order = {c: walks[c] for c in CONTROLLERS}  # the last is solid
    return animation_html(in_order, marks=[] if window is None else [(*window, "push")])


# -- figures and tables -------------------------------------------------------------------------------
def draw_all(
    r: Runs, walks: Mapping[str, Walk], out: Path, workers: int | None = None
) -> dict[str, bytes]:
    """Write every figure to the folder `out` as .png and .svg; returns the SVG by name, for the report.

    r: all results. walks: the headline runs, by controller. workers: processes; one per core if None.
    """
    named = pictures(r, {c: walks[c].signals for c in CONTROLLERS})
    # PRELOADED: modules that are imported once for all processes; the `value` of a finished task is its result
    drawn = run_tasks(list(named.values()), workers, PRELOADED)
    result = {}
    for name, picture in zip(named, drawn, strict=True):
        png, svg = picture.value
        write_bytes(out / f"{name}.png", png)
        write_bytes(out / f"{name}.svg", svg)
        result[name] = svg
    return result


def pictures(r: Runs, signals: Mapping[str, Signals]) -> dict[str, Task[tuple[bytes, bytes]]]:
    """The figures of the paper and beyond, by file name, each as a task that returns it as (PNG, SVG).

    figure1 (the robot), figure4 to figure6 (the pushed walks) are those of the paper; the others show what it
    does not: the disturbance estimate, the ground's force, energies, multipliers of the return map, and the map
    of pushes, a figure for each preset, which only a full plan computes. r: all results. signals: of the pushed
    walks, by controller.
    """
    # window: start and stop of the push [s], the same under both controllers
    npd, adrc, window = signals["NPD"], signals["ADRC"], figures.push_window(signals["NPD"])
    # a quick plan has no multipliers of ADRC
    magnitudes = {c: r.multipliers[c].orbit.multipliers for c in CONTROLLERS if c in r.multipliers}
    biped = Biped.load("rabbit", r.plan.preset)
    mu = biped.description.friction_coefficient
    pushed = "ADRC under the push"
    inputs: dict[str, tuple[object, ...]] = {
        "figure1": (check_figure, biped),
        "figure4": (figures.tracking_figure, npd, "NPD under the push", window),
        "figure5": (figures.tracking_figure, adrc, pushed, window),
        "figure6": (figures.phase_figure, signals),
        "comparison": (figures.comparison_figure, signals, window),
        "disturbance": (figures.disturbance_figure, adrc, pushed, window),
        "ground": (figures.ground_figure, adrc, pushed, mu, 0.0, window),  # 0.0: level ground
        "energy": (figures.energy_figure, adrc, pushed, window),
        "multipliers": (figures.multiplier_figure, magnitudes, PUBLISHED_MULTIPLIERS),
    }
    for preset in r.plan.presets if r.plan.full else ():
        rows = [cell.row() for cell in r.cells if cell.push.preset == preset]
        inputs[f"push_map_{preset}"] = (push_map_figure, rows)
    return {name: Task(name, _rendered, arguments) for name, arguments in inputs.items()}


def push_map_figure(rows: Sequence[PlainRecord]) -> Figure:
    """Draw the map of pushes of one preset: a panel for each controller and torque limit, onset [ms] against
    joints and amplitude [N m]. rows: of each push its values and how the walks under it end, by the names of
    `PushCell.row`; "npd_word" and "adrc_word" are the outcomes.

    The number of a push is 1 if the walk makes all steps and is feasible, or would be but for the impulses at
    impact; 0.5 if it makes all steps and is infeasible; 0 if it does not make all steps; NaN, an empty cell, if
    the walk ends in another way at half of the integration step ("marginal").
    """
    # COUNTED and LOST: the outcomes that count as 1 and as 0; all that are not named here as 0.5
    ends = dict.fromkeys(COUNTED, 1.0) | dict.fromkeys(LOST, 0.0) | {"marginal": np.nan}
    panels: dict[str, list[tuple[float, str, float]]] = {}
    for c, r in itertools.product(CONTROLLERS, rows):
        limit = "unlimited" if r["torque_limit"] is None else f"{r['torque_limit']:g} N m"
        # amplitudes of equal width, so that the texts sort by number
        push = r["onset_ms"], f"{r['pattern']} {r['amplitude']:3.0f}"
        end = ends.get(r[f"{c.lower()}_word"], 0.5)
        panels.setdefault(f"{c}, {limit}", []).append((*push, end))
    columns = ((name, zip(*panel, strict=True)) for name, panel in panels.items())
    numbers = {name: (x, y, np.array(end)) for name, (x, y, end) in columns}
    names = "onset in the step [ms]", "joints, amplitude [N m]"
    # log=False: a linear scale of colours from 0 to 1
    return map_figure(numbers, names, "1 feasible, 0.5 makes all steps, 0 does not", log=False)


def _rendered(draw: Callable[..., Figure], *arguments: object) -> tuple[bytes, bytes]:
    """The figure that draw(*arguments) makes, as PNG and as SVG; the layout is computed once, for the PNG, so
    that both are alike.
    """
    figure = draw(*arguments)
    png = render(figure, "png")
    figure.set_layout_engine("none")
    return png, render(figure, "svg")


PRINTED_TABLE_I = (-180, -324, -583, -1050, -1890, -3401, -6122, -11020, -19836)
"""Table I as the paper prints it [rad/s]; its "-11.020" and "-19.836" have thousands separators."""

Table = dict[str, Sequence[object]]
"""A table of the report: "columns" -> their names, "rows" -> for each row a list of its cells."""


def tables(r: Runs) -> dict[str, Table]:
    """All tables of the report, by title."""
    poles = zip(PRINTED_TABLE_I, TABLE_I, strict=True)
    constants = ("K_p [1/s^2]", 5000, TABLE_II.K_p), ("K_d [1/s]", 50, TABLE_II.K_d)
    return {
        "Table I: observer eigenvalues [rad/s]": _table(
            {"paper, rounded": a, "here, 180 x 1.8^k": b} for a, b in poles
        ),
        "Table II: controller constants": _table(
            {"constant": name, "paper": a, "here": b} for name, a, b in constants
        ),
        "Runs": _table(_run(name, o) for name, o in r.run_twice.items()),
        "Stability: multipliers": _multipliers(r),
        "Gait (b), the paper's recipe": _recipe(r),
        "Numerics": _table({"figure": k, "value": v} for k, v in r.figures.items()),
        "Map of pushes": _map(r.cells),
    }


def _table(rows: Iterable[dict[str, object]]) -> Table:
    """A table of one or more rows, each column name -> cell, all with the same columns."""
    rows = list(rows)
    return {"columns": list(rows[0]), "rows": [list(row.values()) for row in rows]}


def _run(name: str, o: Outcome) -> dict[str, object]:
    """The row of one walk in the table "Runs": how it ended, errors, torques, forces. name: of the walk.

    A walk that ended early has no peak error or torque in the table (None): they would be those of a fall. The
    impulse ratio is the largest of its impacts.
    """
    steps = o.certificates
    return {
        "run": name,
        "controller": o.run.controller.name,
        "preset": o.run.robot.preset,
        "status": o.status,
        "outcome": o.feasibility.outcome,
        "impacts": o.impacts,
        "peak error [rad]": o.peak_error if o.walked else None,
        "at half the step [rad]": o.half.peak_error if o.walked and o.half else None,
        "rms error [rad]": o.rms_error,
        "peak torque [N m]": o.peak_torque if o.walked else None,
        "median step [s]": float(np.median([s.duration for s in steps])) if steps else None,
        "mean friction": o.feasibility.mean_friction,
        "mean F_N [N]": o.feasibility.mean_normal_force,
        "impulse ratio": float(np.max([s.impulse_ratio for s in steps])) if steps else None,
        "method": o.method,
        "engine": o.engine,
    }


NO_MULTIPLIERS = "of n states on a section of n - 1 dimensions: no multipliers"
"""Remark where samples of (27) of the paper span all n directions, by round-off or an observer alone."""


def _multipliers(r: Runs) -> Table:
    """The table of |multipliers| by method, largest first, at most ten: central differences of the return map,
    delta^2 of the zero dynamics (the largest one alone), the regression (27), and those of the paper.
    """
    result: dict[str, tuple[list[float], str]] = {}
    for name, x in r.multipliers.items():
        # "ADRC measured": at impact the measurement sets the observer's angle and rate, and xi^ is kept
        z, of = np.abs(x.orbit.multipliers), name.replace(" measured", ", reset 'measured'")
        remembers = "the observer's xi^ and its derivatives live on through the impact"
        remark = remembers if name.endswith("measured") else ""
        result[f"central differences, {of}, {len(z)} coordinates"] = z[:10].tolist(), remark
    result["delta^2 of the zero dynamics"] = [r.multipliers["NPD"].delta_squared], ""
    for c, head in r.headline.items():
        test = regression_of(head.outcome)
        # the warning is empty where the data span all directions
        name, remark = f"regression (27) on the pushed walk, {c}", test.warning or NO_MULTIPLIERS
        result[name] = test.magnitudes.tolist(), remark
    result["printed in the paper"] = list(PUBLISHED_MULTIPLIERS), "from a regression: no target"
    return _table(
        {"method": method, "magnitudes": z, "remark": remark}
        for method, (z, remark) in result.items()
    )


def _recipe(r: Runs) -> Table:
    """The table of the periodic walks on gait (b), by preset and controller: whether each is stable, its three
    largest |multipliers|, the jump of a joint's rate against the gait at impact, and x- - x* [rad, rad/s] with
    x- the state before impact; None where no periodic walk was found, and the remark says why.
    """
    rows = []
    for name, x in r.named("cycles", "(b)").items():
        result = None if isinstance(x, str) else x.orbit  # a text is the reason why there is none
        row: dict[str, object] = {"gait": name, "stable": result and result.stable}
        row["largest multipliers"] = result and np.abs(result.multipliers[:3]).tolist()
        # the name is "gait (b), preset, controller"
        row["rate jump at impact [rad/s]"] = r.jumps[name.split(", ")[1]]["recipe"]
        row["x- minus x*"] = result and (result.x_minus[: len(X_STAR)] - X_STAR).tolist()
        rows.append(row | {"remark": x if isinstance(x, str) else ""})
    return _table(rows)


COLUMN = {"pulled": "the ground would pull", "marginal": "other at half the step"}
"""Headings in place of those outcomes of the map that do not explain themselves."""


def _map(cells: list[PushCell]) -> Table:
    """How many walks of the map end in each outcome: a row for each preset, torque limit and controller."""
    # x[1:]: the walks of NPD and of ADRC under this push
    fates = [
        (x.setting, c, word_of(w)) for x in cells for c, w in zip(CONTROLLERS, x[1:], strict=True)
    ]
    count = Counter(fates)
    return _table(
        {"preset, torque limit": name, "controller": c}
        | {COLUMN.get(word, word): count[name, c, word] for word in OUTCOME_WORDS}
        for name, c in dict.fromkeys(fate[:2] for fate in fates)
    )
