"""What the commands share: the typer app, what they print to, the progress bar, and checks of file names.

Names of inputs and outputs are looked at before anything is computed, so that a mistake costs no
time. Modules of the package that take long to load (Pinocchio, CasADi, matplotlib) are
imported inside the functions that use them, in all of `cli`: `biped-adrc --help` is printed at
once.

A name in a file may hold what a terminal or rich would obey (escape sequences, "[/b]", ":bomb:"):
`Terminal` prints it as it is, and control characters as \\x1b. `Lasting` keeps a command going when
its reader has left (`| head -1`) or the disk is full, so that no result is lost because a message about it
could not be printed.
"""

import os
import shlex
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from enum import IntEnum
from io import TextIOWrapper
from pathlib import Path
from typing import Annotated, Any, TextIO, TypeVar

import typer
from rich import progress
from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment
from rich.table import Column, Table

import biped_adrc
from biped_adrc.core.files import keep_inputs, one_line, output_path

_P = TypeVar("_P", Path, Path | None)


class ExitCode(IntEnum):
    """Exit codes beside those of the errors: a check does not hold, the robot fell, Ctrl-C."""

    CHECK_FAILED = 1
    FELL = 4
    INTERRUPTED = 130


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


def _say_version(flag: bool) -> None:
    """Print the version and end the command, if --version is there."""
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
    """Options of `biped-adrc` itself, before the name of a command; typer acts on them."""


def group(name: str, text: str) -> typer.Typer:
    """Add a group of commands under one name, such as `gait`, to the app; returns it. text: its help."""
    result = typer.Typer(no_args_is_help=True, rich_markup_mode=None, help=text)
    app.add_typer(result, name=name)
    return result


class Terminal(Console):
    """rich's console, without markup and emoji: brackets, colons and control characters are text."""

    def __init__(self, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, markup=False, emoji=False)

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """rich's method that returns what is printed, in segments; here with unprintable characters of texts as
        \\x1b. Control segments are rich's own commands to the terminal, such as those of a progress bar.
        """
        for segment in super().render(renderable, options):
            # line breaks and tabs are wanted in a printed text
            text = one_line(segment.text, keep="\n\t")
            yield segment if segment.control else segment._replace(text=text)

    def say(self, text: str) -> None:
        """Print a text as it is, neither wrapped nor coloured, so that it can be searched and copied."""
        self.print(text, highlight=False, soft_wrap=True)

    def written(self, *paths: Path | None) -> None:
        """Print a line for each file that was written; none for None."""
        for path in filter(None, paths):
            self.say(f"written to {path}")

    def draw(self, path: Path, figure: Any) -> None:
        """Write a figure of matplotlib, and print a line for the file."""
        from biped_adrc.view.style import write_figure

        write_figure(path, figure)
        self.written(path)

    def table(
        self, header: Iterable[str | Column], rows: Iterable[Iterable[str]], **style: Any
    ) -> None:
        """Print a table: texts of its header and of each row. style: more arguments of rich's `Table`, such as
        title.
        """
        table = Table(*header, title_justify="left", **style)
        for row in rows:
            table.add_row(*row)
        self.print(table)

    @contextmanager
    def bar(self, name: str) -> Iterator[Callable[[int, int | None, str], None]]:
        """Context of a progress bar; its value is a function f(done, total, now) that moves the bar.

        The bar appears at the first call. total: of what is counted; None while it is not known. now: text of
        what is done at the moment. name: text before the first call.
        """
        text = progress.TextColumn("{task.description:<44.44}", markup=False)
        counts = progress.BarColumn(), progress.MofNCompleteColumn(), progress.TimeElapsedColumn()
        left = progress.TextColumn("left"), progress.TimeRemainingColumn()
        with progress.Progress(text, *counts, *left, console=self) as shown:
            task = shown.add_task(name, total=None, visible=False)
            yield lambda done, total, now: shown.update(
                task, completed=done, total=total, description=now, visible=True
            )


class Lasting:
    """A text stream around another one, `stream`, whose writing never raises: when nobody reads or the disk is
    full, the text is dropped. All but `write` is that of `stream`.
    """

    lost: OSError | None = None
    """First error in writing; None while all was written."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream
        # characters that the terminal's encoding lacks are escaped; a pipe that is full is waited for
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
            with suppress(OSError):  # no file of the operating system
                os.set_blocking(stream.fileno(), True)

    def __getattr__(self, name: str) -> Any:
        """What this class does not have itself is the stream's."""
        return getattr(self.stream, name)

    def write(self, text: str) -> int:
        """Write the text, or drop it and all later ones if that fails; returns the length of the text, as the
        caller of a stream expects, in either case.
        """
        try:
            self.stream.write(text)
            self.stream.flush()
        except OSError as error:
            self.lost = self.lost or error
            # the stream's own file becomes the null device, so that nothing later fails, not even its closing
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.stream.fileno())
        return len(text)


console, errors = Terminal(), Terminal(stderr=True)
"""Where all commands print, and complain; rich fits tables to the terminal."""


def command_line() -> str:
    """The command line of this run, quoted for a shell, for reports and provenance: a reader can repeat it."""
    return shlex.join(["biped-adrc", *sys.argv[1:]])


FIGURES, GAITS = (".png", ".svg"), (".json",)
"""Suffixes of figures and of gaits."""


def inputs(robot: str, *others: str) -> tuple[Path, ...]:
    """The files that robot and gaits are read from, which no output may overwrite (`target`).

    robot, others: names, or paths of files. A path of a file is in the result, the name of a stored gait is
    left out. The robot's URDF is always in the result. Raises ModelError for an unknown robot.
    """
    from biped_adrc.model.robots.robot_toml import load_description

    files = tuple(path for path in map(Path, (robot, *others)) if os.path.isfile(path))
    return (*files, load_description(robot).urdf)


def target(out: _P, suffixes: Sequence[str], read: Iterable[Path] = ()) -> _P:
    """The path of an output file, checked before anything is computed; None (no output) stays None.

    A name without a suffix gets the first of the suffixes. read: files that the command reads, such as the
    URDF, and that it therefore must not overwrite. Raises InputError for another suffix or a file that is read,
    and OutputError for a name that cannot be written.
    """
    if out is None:
        return None
    path = output_path(out, suffixes, default=True)
    keep_inputs((path,), read)
    return path
