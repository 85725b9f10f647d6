"""What the commands share: the app, options, the progress bar."""

from __future__ import annotations

import shlex
import sys
from typing import TYPE_CHECKING, Annotated

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

if TYPE_CHECKING:
    from biped_adrc.studies.push import Push

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
Pushes = Annotated[
    list[str] | None,
    typer.Option(
        "--push",
        help="Torque [N m] on joints in one single support, JOINTS=TORQUE@STEP:START-STOP [s]; e.g. "
        "'q1,q2=30@19:0.1-0.3'. End with ':sine=5' for a sine of 5 Hz, ':rise=0.01' for edges of 10 ms, or "
        "give 'START-' for one that stays. "
        "Joints are q1..q5 or names of the URDF; q5 is the unactuated torso. May be repeated; "
        "several joints with different torques: 'q1=30,q3=-20@19:0.1-0.3'.",
    ),
]


def parse_pushes(texts: list[str] | None) -> tuple[Push, ...]:
    from biped_adrc.studies.push import parse_push

    return tuple(parse_push(text) for text in texts or ())


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
