"""The command `biped-adrc`.

Each module of this folder adds its commands to the one typer app of `cli.app`; a command reads its
options, checks the names of its outputs, calls one function of `studies`, `scenario` or `paper`, and
prints or writes what comes back. No number is computed here. `main` is the entry point: it turns
errors of the package into one line of text and an exit code.

Exit codes: 0 all is well (for `reproduce`: every check holds); 1 a check of `reproduce` or `robot
check` does not hold; 2 the command line is wrong; 3 bad input (robot, gait, poles, duration, file);
4 the robot fell or did not come back; 5 a result cannot be written; 130 interrupted with Ctrl-C.
"""

import signal
import sys
import warnings

# each of these modules adds its commands to the app when it is imported, in the order of the help
from biped_adrc.cli import controller, gait, robot, study, walk  # noqa: F401
from biped_adrc.cli.app import ExitCode, Lasting, app, errors
from biped_adrc.core.errors import BipedError, OutputError

__all__ = ["app", "main"]


def main() -> None:
    """Entry point: run the command; an error becomes one message and an exit code.

    A reader that closes the pipe early, such as `head`, is no error: the rest of the output is dropped.
    Where the output cannot be written for another reason, an error says so once all is done. Warnings are
    printed as one line each.
    """
    # a stream is None where Python runs without a console; `Lasting` never raises when it cannot write
    for name in ("stdout", "stderr"):
        if (stream := getattr(sys, name)) is not None:
            setattr(sys, name, Lasting(stream))
    # the signal to end (of kill) raises KeyboardInterrupt as Ctrl-C does: worker processes are ended too
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    warnings.showwarning = lambda message, *_: errors.say(f"warning: {message}")
    code, lost = _run(), getattr(sys.stdout, "lost", None)
    if lost is not None and not isinstance(lost, BrokenPipeError):
        what = f"what was printed cannot be written: {lost.strerror}"
        errors.say(f"error: {what}; files that were to be written are complete")
        code = code or OutputError.exit_code  # an error of the command itself counts more
    sys.exit(code)


def _run() -> int:
    """Run the command and return its exit code. An error of the package is printed as one line; after Ctrl-C a
    line says that no half-written file is left.
    """
    code = 0
    try:
        app(standalone_mode=True)
    except BipedError as error:
        errors.say(f"error: {error}")
        return error.exit_code
    except SystemExit as stop:
        # typer ends every command so, also one that is all right; its code is a number, None (0) or a text (1)
        code = stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    except KeyboardInterrupt:
        code = ExitCode.INTERRUPTED
    if code == ExitCode.INTERRUPTED:
        errors.say("interrupted; what was already written is complete")
    return code
