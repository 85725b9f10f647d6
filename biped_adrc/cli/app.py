"""What the commands share: the app, options, the progress bar."""

from __future__ import annotations

import shlex
import sys
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    SpinnerColumn,
    TextColumn,
    TimeElapsedColumn,
)

EXIT_CHECK_FAILED, EXIT_FELL, EXIT_INTERRUPTED = 1, 4, 130

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Underactuated walking with active disturbance rejection control (ADRC with a GPI observer).\n\n"
    "Exit codes: 0 all is well, 1 a check of 'reproduce' or 'robot check' does not hold, 2 wrong command "
    "line, 3 bad input, 4 the robot fell, 5 cannot write, 130 interrupted.",
)
gait_app = typer.Typer(
    no_args_is_help=True, rich_markup_mode=None, help="Design, show, import and export gaits."
)
app.add_typer(gait_app, name="gait")
console = Console()

Preset = Annotated[
    str, typer.Option(help="Parameters of RABBIT: identified, identified-bare or tac2003.")
]
Robot = Annotated[
    str, typer.Option(help="Robot by name ('biped-adrc robot list'), or the path of a robot.toml.")
]
RobotPreset = Annotated[
    str | None, typer.Option(help="Parameters of the robot; its record's default if not given.")
]
StoredGait = Annotated[str, typer.Argument(help="A stored gait by name, or a .json file.")]


def command() -> str:
    """The command as a shell takes it."""
    return shlex.join(["biped-adrc", *sys.argv[1:]])


def bar() -> Progress:
    return Progress(
        SpinnerColumn(),
        TextColumn("{task.description:<44.44}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=console,
    )
