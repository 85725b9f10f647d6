"""`biped-adrc simulate` for a robot without motors: it walks its stored cycle down the slope."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer
from rich.markup import escape
from rich.table import Table

from biped_adrc.cli.app import EXIT_FELL, bar, console
from biped_adrc.errors import InputError

if TYPE_CHECKING:
    from biped_adrc.model.limits import Limits
    from biped_adrc.studies.passive_walk import PassiveWalk

FITTING = ("robot", "preset", "impacts", "friction_limit", "force_window", "out")


def simulate_passive(
    context: typer.Context,
    robot: str,
    preset: str | None,
    impacts: int,
    limits: Limits,
    out: Path | None,
) -> None:
    """Walk, print the steps, write the run. Raises InputError for an option that needs motors."""
    from biped_adrc.hybrid.storage import save
    from biped_adrc.studies.passive_walk import passive_walk
    from biped_adrc.studies.versions import versions

    _refuse_what_needs_motors(context, robot)
    with bar() as shown:
        task = shown.add_task("walking, passive", total=impacts)
        walk = passive_walk(
            robot, impacts, preset=preset, progress=lambda t, n: shown.update(task, completed=n)
        )
    _print_steps(walk, limits)
    if out is not None and out.suffix == ".mat":
        walk.export(out)
        console.print(f"written to {out}")
    elif out is not None:
        save(walk.trajectory, out, {"versions": versions()})
        console.print(f"written to {out.with_suffix('.npz')}")
    if not walk.trajectory.status.ok:
        raise typer.Exit(EXIT_FELL)


def _refuse_what_needs_motors(context: typer.Context, robot: str) -> None:
    passive = str(context.params["controller"]).lower() == "passive"
    fitting = {*FITTING, "controller"} if passive else set(FITTING)
    asked = [name for name in context.params if name not in fitting and _given(context, name)]
    if asked:
        options = ", ".join("--" + name.replace("_", "-") for name in asked)
        raise InputError(
            f"robot '{robot}' has no motors, so it takes no {options}; leave that out, or take a robot with "
            "motors ('biped-adrc robot list')"
        )


def _given(context: typer.Context, name: str) -> bool:
    """Whether an option was on the command line."""
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def _print_steps(walk: PassiveWalk, limits: Limits) -> None:
    from biped_adrc.analysis.certificate import ratio_text
    from biped_adrc.walker import FOOT_STRIKE

    names = ("step", "time [s]", "length [m]", "drop [m]", "friction", "at impact", "F_N [N]")
    table = Table(*map(escape, names), escape("lost [J]"))
    n, plant = walk.walker.plant.n, walk.walker.plant
    events = walk.trajectory.events(FOOT_STRIKE)
    for c, event in zip(walk.certified(limits), events, strict=True):
        table.add_row(
            f"{c.step}",
            f"{c.duration:.4f}",
            f"{c.step_length:.4f}",
            f"{-float(plant.swing_foot(event.x_minus[:n])[1]):.4f}",
            ratio_text(c.mean_friction),
            ratio_text(c.impulse_ratio),
            f"{c.mean_normal_force:.1f}",
            f"{c.energy_lost:.4f}",
        )
    console.print(table)
    status = walk.trajectory.status
    legality = walk.legal_within(limits)
    console.print(
        f"{status.name}: {status.value}\n{len(events)} impacts, {walk.note}; friction and F_N in the mean of "
        f"{1e3 * limits.window:g} ms\n{legality.text()}"
    )
