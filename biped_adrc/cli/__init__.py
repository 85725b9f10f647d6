"""The command `biped-adrc`.

Each module of this folder adds its commands to the one typer app of `cli.app`; a command reads its
options, checks the names of its outputs, calls one function of `studies`, `scenario`, `study` or
`paper`, and prints or writes what comes back. No number is computed here. `main` is the entry
point: it turns errors of the package into one line of text and an exit code.

Exit codes: 0 all is well (for `reproduce`: every check holds); 1 a check of `reproduce` or `robot
check` does not hold; 2 the command line is wrong; 3 bad input (robot, gait, poles, duration, file);
4 the robot fell or did not come back; 5 a result cannot be written; 130 interrupted with Ctrl-C.
"""

from __future__ import annotations

import signal
import sys
import warnings
from importlib import import_module
from threading import Timer, main_thread
from typing import TYPE_CHECKING

from biped_adrc.cli.app import EXIT_INTERRUPTED, app, complain, gait_app
from biped_adrc.cli.terminal import lasting, reason_lost
from biped_adrc.core.errors import BipedError, OutputError

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

__all__ = ["app", "gait_app", "main"]

COMMANDS = (
    "design",
    "export",
    "gait",
    "look",
    "observer",
    "play",
    "replay",
    "reproduce",
    "robot",
    "study",
    "walk",
)
"""Modules, each of which adds its commands to the app, in the order of the help."""
for _module in COMMANDS:
    import_module(f"biped_adrc.cli.{_module}")


def main() -> None:
    """Entry point: run the command; an error becomes one message and an exit code.

    A reader that closes the pipe early, such as `head`, is no error: the rest of the output goes to
    nowhere. Where it cannot be written for another reason, that is said once all is done.
    """
    printed, _ = lasting("stdout"), lasting("stderr")
    warnings.showwarning = lambda message, *_: complain(f"warning: {message}")
    sys.unraisablehook = _once_more
    code = _run()
    sys.stdout.flush()
    lost = reason_lost(printed)
    if lost is not None:
        complain(
            f"error: what was printed cannot be written: {lost}; files that were to be written are complete"
        )
    sys.exit(OutputError.exit_code if lost is not None and code == 0 else code)


def _run() -> int:
    """Run the command; its exit code."""
    try:
        app(standalone_mode=True)
    except BipedError as error:
        complain(f"error: {error}")
        return error.exit_code
    except SystemExit as stop:
        if stop.code == EXIT_INTERRUPTED:
            _say_interrupted()
        return stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    except KeyboardInterrupt:
        _say_interrupted()
        return EXIT_INTERRUPTED
    return 0


def _once_more(lost: UnraisableHookArgs) -> None:
    """Give Ctrl-C again that came inside a callback of the interpreter, which cannot hand it on."""
    if not issubclass(lost.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(lost)
    elif (main := main_thread().ident) is not None:
        Timer(0.1, signal.pthread_kill, (main, signal.SIGINT)).start()


def _say_interrupted() -> None:
    """Say after Ctrl-C that no half-written file is left."""
    complain("interrupted; what was already written is complete")
