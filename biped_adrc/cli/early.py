"""Ctrl-C while the command is still being imported ends it without a traceback; imported before all else."""

import os
import signal
import sys
from pathlib import PurePath

STARTED_AS = ("biped-adrc", "__main__.py")
"""The program's name while this is the command, and not a module that somebody else imports."""


def _leave(*_: object) -> None:
    os.write(2, b"interrupted; nothing was begun\n")
    os._exit(130)


def ready() -> None:
    """All is imported: Ctrl-C is KeyboardInterrupt again."""
    if signal.getsignal(signal.SIGINT) is _leave:
        signal.signal(signal.SIGINT, signal.default_int_handler)


if PurePath(sys.argv[0]).name in STARTED_AS and (
    signal.getsignal(signal.SIGINT) is signal.default_int_handler
):
    signal.signal(signal.SIGINT, _leave)
