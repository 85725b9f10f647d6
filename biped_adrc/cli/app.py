"""What the commands share: the typer app, the console, the progress bar, and checks of file names.

Names of inputs and outputs are looked at before anything is computed, so that a mistake costs no
time. Modules of the package that take long to load (Pinocchio, CasADi, numba, matplotlib) are
imported inside the functions that use them, in all of `cli`: `biped-adrc --help` is printed at
once.
"""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    SpinnerColumn,
    TextColumn,
    TimeElapsedColumn,
)

import biped_adrc
from biped_adrc.cli.terminal import Terminal
from biped_adrc.core.files import keep_inputs, output_path

EXIT_CHECK_FAILED, EXIT_FELL, EXIT_INTERRUPTED = 1, 4, 130
"""Exit codes beside those of the errors: a check does not hold, the robot fell, Ctrl-C."""

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Underactuated walking with active disturbance rejection control (ADRC with a GPI observer).\n\n"
    "Exit codes: 0 all is well, 1 a check of 'reproduce' or 'robot check' does not hold, "
    "2 wrong command line, 3 bad input, 4 the robot fell, 5 cannot write, 130 interrupted.",
)
gait_app = typer.Typer(
    no_args_is_help=True, rich_markup_mode=None, help="Design, show, import and export gaits."
)
app.add_typer(gait_app, name="gait")


def _say_version(flag: bool) -> None:
    if flag:
        typer.echo(f"biped-adrc {biped_adrc.__version__}")
        raise typer.Exit


@app.callback()
def _of_every_command(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_say_version, is_eager=True, help="Print the version."),
    ] = False,
) -> None:
    """Options of the command itself."""


console, errors = Terminal(), Terminal(stderr=True)
"""Where all commands print, and complain; rich fits tables to the terminal."""

FIGURES, GAITS = (".png", ".svg"), (".json",)
"""Suffixes of figures and of gaits."""


def command() -> str:
    """The command line as a shell takes it, for reports and summaries: the reader can repeat it."""
    return shlex.join(["biped-adrc", *sys.argv[1:]])


def bar() -> Progress:
    """A progress bar of this command: what is done, how far, and for how long."""
    return Progress(
        SpinnerColumn(),
        TextColumn("{task.description:<44.44}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=console,
    )


def inputs(robot: str, *others: str) -> tuple[Path, ...]:
    """The files that a robot and gaits are read from, so that no output may take their place; none for names.

    Raises ModelError for an unknown robot.
    """
    from biped_adrc.model.robots.robot_toml import load_description

    files = tuple(path for path in map(Path, (robot, *others)) if os.path.isfile(path))
    return (*files, load_description(robot).urdf)


def target(out: Path | None, suffixes: Sequence[str], read: Iterable[Path]) -> Path | None:
    """The path of an output, checked before anything is computed; None for none.

    Raises InputError for a name of another kind or one that is read, and OutputError.
    """
    if out is None:
        return None
    path = output_path(out, suffixes, default=True)
    keep_inputs((path,), read)
    return path


def say(text: str) -> None:
    """Print a text as it is, neither wrapped nor coloured, so that it can be searched and copied."""
    console.print(text, highlight=False, soft_wrap=True)


def complain(text: str) -> None:
    """As `say`, to the error stream."""
    errors.print(text, highlight=False, soft_wrap=True)


def say_written(path: Path | None) -> None:
    """Say which file was written; nothing for None."""
    if path is not None:
        say(f"written to {path}")
