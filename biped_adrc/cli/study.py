"""`biped-adrc study` and `reproduce`: many walks on all cores.

`study` walks all scenarios that a study file (TOML) describes; each walk is stored when it is finished, so that
the same command goes on after an interruption. `reproduce` computes the numbers and figures of the paper again:
it makes of the options a `paper.scenarios.Plan`, which says what is computed, runs it (`paper.reproduction`),
and prints about ten lines: how many checks hold, the tally of the paper's claims, and the main findings. A
check that does not hold is printed by name and leads to exit code 1; all else is in report.html. The names of
joints in a push are checked before the first walk.

A command's docstring is its help text; its arguments are described in options.toml.
"""

import os
import signal
from pathlib import Path
from typing import Any

import typer

import biped_adrc as ba
from biped_adrc.cli.app import ExitCode, app, command_line, console, target
from biped_adrc.cli.options import options
from biped_adrc.core.errors import SimulationError


@app.command()
@options("study")
def study(
    study: Path,
    out: Path,
    workers: int | None = None,
    table: Path | None = None,
    dry_run: bool = False,
) -> None:
    """Walk a study: cases, conditions, grids, random draws, or a search; the same command resumes it."""
    from biped_adrc.studies.study import read_study

    result, table = read_study(study), target(table, (".csv",))
    if dry_run:
        # pairs (case, condition) in which nothing is drawn from the seed, so that one walk stands for all seeds
        undrawn = result.rehearse()
        most = "at most " if result.search else ""
        over = f", over {', '.join(result.axes)}" if result.axes else ""
        console.say(f"{result.name}: {most}{result.count_of(undrawn)} walks{over}")
        if undrawn:
            console.say(result.walked_once(undrawn))
        return
    from biped_adrc.studies.build import NO_WALK
    from biped_adrc.studies.page import choices, headings, texts, write_page
    from biped_adrc.studies.runner import StudyProgress

    try:
        with console.bar(result.name) as shown:

            def progress(p: StudyProgress) -> None:
                """Move the bar, and print a remark on the walk that ended, if there is one."""
                shown(p.done, p.total, result.name)
                if p.note:
                    console.print(p.note)

            done = ba.study(result, out, workers, progress=progress)
    except KeyboardInterrupt:
        # a second Ctrl-C must not cut off this message
        for each in (signal.SIGINT, signal.SIGTERM):
            signal.signal(each, signal.SIG_IGN)
        begun = "what is finished is in" if os.path.exists(out) else "nothing was begun in"
        console.say(f"{begun} {out}; the same command goes on from there")
        raise typer.Exit(ExitCode.INTERRUPTED) from None
    # the results by case, remarks, and of a search the values that it chose
    console.table(headings(done), (texts(line, short=True) for line in done.table()))
    for note in done.notes:
        console.say(note)
    for name, words in choices(done).items():
        console.say(f"{name}: {words}")
    statuses = done.statuses()
    for status, (count, detail) in statuses.items():
        if status in NO_WALK:
            console.say(f"{count} {status}, such as: {detail}")
    if table is not None:
        done.export(table)
    console.written(write_page(done), table)
    # NO_WALK: statuses of rows for which no walk could be made, such as values that do not fit together
    if statuses.keys() <= {*NO_WALK}:
        raise SimulationError("no walk of this study could be made")


@app.command()
@options("reproduce")
def reproduce(
    out: Path = Path("out"),
    preset: str = "identified",
    push: list[str] | None = None,
    full: bool = False,
    quick: bool = False,
    workers: int | None = None,
) -> None:
    """Reproduce the paper: runs, figures 1, 4, 5, 6, Tables I and II, stability; and say which claims hold."""
    from biped_adrc.model.robots.robot_toml import load_description
    from biped_adrc.paper.reproduction import reproduce as run
    from biped_adrc.paper.scenarios import PAPER_PUSH, Plan
    from biped_adrc.scenario.push import parse_push

    pushes = tuple(parse_push(text) for text in push or ())
    description = load_description("rabbit")
    # both calls are for their errors alone: an unknown preset, an unknown joint of a push
    description.preset(preset)
    for joint in (joint for p in pushes for joint in p.factors):
        description.joint_index(joint)
    plan = Plan(preset, pushes=pushes or (PAPER_PUSH,), full=full, quick=quick)
    with console.bar("starting") as progress:
        summary = run(plan, out, command_line(), workers, progress)
    console.say("\n".join(lines(summary, out)))
    if not summary["holds"]:
        raise typer.Exit(ExitCode.CHECK_FAILED)


def lines(summary: dict[str, Any], out: Path) -> list[str]:
    """The lines that `reproduce` prints. summary: the content of summary.json. out: folder of the report.

    They are the number of checks that hold, at most 5 that do not, the tally of claims, the main findings,
    what was left out, and where the report is.
    """
    checks = summary["checks"]
    broken = [check for check in checks if not check["holds"]]
    sentences = [f"does not hold: {x['name']}: {x['value']} {x['limit']}" for x in broken[:5]]
    left_out = summary["left_out"]
    return [
        f"{len(checks) - len(broken)} of {len(checks)} checks hold",
        *sentences,
        f"Claims of the paper: {summary['tally']}",
        *summary["findings"],
        *([f"Left out: {'; '.join(left_out)}"] if left_out else []),
        f"{out / 'report.html'}: every claim with its reason, checks, figures and walks",
    ]
