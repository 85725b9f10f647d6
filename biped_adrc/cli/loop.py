"""`biped-adrc loop`: the exported controller of a scenario as a process of its own, around the simulated plant.

The work is that of `deploy.in_the_loop`. No bar is drawn while it walks: that would take time from the loop.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.table import Table

from biped_adrc.cli.app import EXIT_CHECK_FAILED, EXIT_FELL, app, console, say
from biped_adrc.cli.options import of_scenario, texts, values_of
from biped_adrc.types import PlainRecord

if TYPE_CHECKING:
    from biped_adrc.deploy.in_the_loop import InTheLoop


@app.command("loop")
@of_scenario("plant", "impacts")
@texts("loop")
def loop_command(
    given: PlainRecord,
    scenario: Path,
    sets: list[str] | None = None,
    real_time: bool = False,
    deadline: float | None = None,
    real: str = "float64",
    port: int = 0,
) -> None:
    """Walk by the exported controller as a process of its own, in lock step and in real time."""
    from biped_adrc.deploy.in_the_loop import in_the_loop
    from biped_adrc.scenario.scenario import Scenario

    s = Scenario(**values_of(given, None, sets, scenario))
    last = ", in real time" if real_time else ""
    say(f"{s.controller}, {s.impacts} impacts: in this process, in lock step{last}")
    found = in_the_loop(s, real_time, deadline, real, port)
    _print(found)
    if not found.same_in_lock_step:
        raise typer.Exit(EXIT_CHECK_FAILED)
    if not all(walk.trajectory.status.ok for walk in found.walks):
        raise typer.Exit(EXIT_FELL)


def _print(found: InTheLoop) -> None:
    """Print how the walks ended, whether they are the same, and the times of the one in real time."""
    from biped_adrc.deploy.tick_times import HEADER

    for walk in found.walks:
        say(f"{walk}")
    say(f"lock step: {found.said(found.lock_step)}")
    if found.times is None or found.real_time is None:
        return
    say(f"real time: {found.said(found.real_time)}\n{found.times.text()}")
    table = Table(*HEADER)
    for row in found.times.rows():
        table.add_row(*row)
    console.print(table)
