"""The command `biped-adrc`.

Each module of this folder adds its commands to the one typer app of `cli.app`; a command reads its
options, checks the names of its outputs, calls one function of `studies`, `scenario`, `bench` or
`paper`, and prints or writes what comes back. No number is computed here. `main` is the entry
point: it turns errors of the package into one line of text and an exit code.

Exit codes: 0 all is well (for `reproduce`: every check holds); 1 a check of `reproduce` or `robot
check` does not hold; 2 the command line is wrong; 3 bad input (robot, gait, poles, duration, file);
4 the robot fell or did not come back; 5 a result cannot be written; 130 interrupted with Ctrl-C.
"""

from __future__ import annotations

import os
import sys
from importlib import import_module

from rich.console import Console

from biped_adrc.cli.app import EXIT_INTERRUPTED, app, gait_app
from biped_adrc.errors import BipedError

__all__ = ["app", "gait_app", "main"]

COMMANDS = ("compare", "design", "gait", "look", "observer", "reproduce", "robot", "sweep", "walk")
"""Modules, each of which adds its commands to the app, in the order of the help."""
for _module in COMMANDS:
    import_module(f"biped_adrc.cli.{_module}")


def _say_interrupted() -> None:
    """Say after Ctrl-C that no half-written file is left."""
    Console(stderr=True).print("interrupted; what was already written is complete")


def main() -> None:
    """Entry point: run the command; an error becomes one message and an exit code.

    A reader that closes the pipe early, such as `head`, is no error: the rest of the output goes to
    nowhere.
    """
    try:
        app(standalone_mode=True)
    except BipedError as error:
        Console(stderr=True).print(f"error: {error}", markup=False, highlight=False, soft_wrap=True)
        sys.exit(error.exit_code)
    except SystemExit as stop:
        if stop.code == EXIT_INTERRUPTED:
            _say_interrupted()
        raise
    except KeyboardInterrupt:
        _say_interrupted()
        sys.exit(EXIT_INTERRUPTED)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
