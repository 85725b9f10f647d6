"""`biped-adrc reproduce`: the paper carried out again, with a word for each of its claims.

It makes a `paper.plan.Plan` of the options, runs it (`paper.reproduction`), and prints the table of
claims and the checks that do not hold; these decide the exit code. Joints of a push are checked
first, before minutes of walking.
"""

from __future__ import annotations

from pathlib import Path

import typer
from rich.table import Table

from biped_adrc.cli.app import (
    EXIT_CHECK_FAILED,
    app,
    bar,
    command,
    console,
)
from biped_adrc.cli.options import texts


@app.command()
@texts("reproduce")
def reproduce(
    out: Path = Path("out"),
    preset: str = "identified",
    push: list[str] | None = None,
    full: bool = False,
    quick: bool = False,
    workers: int | None = None,
) -> None:
    """Reproduce the paper: runs, figures 1, 4, 5, 6, Tables I and II, stability, and a word for each claim."""
    from biped_adrc.paper.plan import PAPER_PUSH, Plan
    from biped_adrc.paper.reproduction import failed, main_table
    from biped_adrc.paper.reproduction import reproduce as run
    from biped_adrc.robots.robot_toml import load_description
    from biped_adrc.scenario.push import parse_push

    pushes = tuple(parse_push(text) for text in push or ())
    description = load_description("rabbit")
    description.preset(preset)
    for joint in (joint for p in pushes for joint in p.factors):
        description.joint_index(joint)
    plan = Plan(preset, pushes=pushes or (PAPER_PUSH,), full=full, quick=quick)
    with bar() as shown:
        task = shown.add_task("starting", total=None)

        def progress(done: int, total: int, name: str) -> None:
            shown.update(task, completed=done, total=total, description=name)

        summary = run(plan, out, command(), workers, progress)
    table = Table("claim", "section", "word", "holds in", title="The claims of the paper")
    for row in main_table(summary):
        table.add_row(*row)
    console.print(table)
    if plan.left_out:
        console.print(f"left out of this run: {', '.join(plan.left_out)}")
    broken = failed(summary["checks"])
    console.print(f"{len(summary['checks']) - len(broken)} of {len(summary['checks'])} checks hold")
    for check in broken:
        console.print(f"does not hold: {check['name']}: {check['value']} {check['limit']}")
    console.print(f"written to {out}: report.html, walk.html, summary.json, figures and runs")
    if broken:
        raise typer.Exit(EXIT_CHECK_FAILED)
