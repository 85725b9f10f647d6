"""`biped-adrc reproduce`: the paper carried out again, with a word for each of its claims.

It makes a `paper.scenarios.Plan` of the options, runs it (`paper.reproduction`), and prints ten lines: the
checks, the tally of claims, and the main findings. A check that does not hold is said by name, and decides
the exit code; all else is in report.html. Joints of a push are checked before the first walk.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import typer

from biped_adrc.cli.app import EXIT_CHECK_FAILED, app, bar, command, say
from biped_adrc.cli.options import options

SHOWN = 5
"""Checks that do not hold and are said by name; more are in the report."""


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
    """Reproduce the paper: runs, figures 1, 4, 5, 6, Tables I and II, stability, and a word for each claim."""
    from biped_adrc.model.robots.robot_toml import load_description
    from biped_adrc.paper.reproduction import reproduce as run
    from biped_adrc.paper.scenarios import PAPER_PUSH, Plan
    from biped_adrc.scenario.push import parse_push

    pushes = tuple(parse_push(text) for text in push or ())
    description = load_description("rabbit")
    description.preset(preset)
    for joint in (joint for p in pushes for joint in p.factors):
        description.joint_index(joint)
    plan = Plan(preset, pushes=pushes or (PAPER_PUSH,), full=full, quick=quick)
    with bar("starting") as progress:
        summary = run(plan, out, command(), workers, progress)
    say("\n".join(lines(summary, out)))
    if not summary["holds"]:
        raise typer.Exit(EXIT_CHECK_FAILED)


def lines(summary: dict[str, Any], out: Path) -> list[str]:
    """What the command prints, one thing a line."""
    checks = summary["checks"]
    broken = [check for check in checks if not check["holds"]]
    sentences = [f"does not hold: {x['name']}: {x['value']} {x['limit']}" for x in broken[:SHOWN]]
    left_out = summary["left_out"]
    return [
        f"{len(checks) - len(broken)} of {len(checks)} checks hold",
        *sentences,
        f"Claims of the paper: {summary['tally']}",
        *summary["findings"],
        *([f"Left out: {'; '.join(left_out)}"] if left_out else []),
        f"{out / 'report.html'}: every claim with its reason, checks, figures and walks",
    ]
