"""The command `biped-adrc`, also as `python -m biped_adrc`; Ctrl-C while it is imported leaves no traceback."""

import atexit
import gc
import io
import os
import sys
from contextlib import suppress


def main() -> None:
    """Import the command, which takes its time, and run it."""
    gc.set_threshold(200_000)  # a walk makes 130 000 objects, which stay
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")  # it looks through all packages
    codes: list[int] = []
    atexit.register(_leave, codes)  # before all else, so that it is the last to be called
    try:
        from biped_adrc.cli import main as command
    except KeyboardInterrupt:
        print("interrupted; nothing was begun", file=sys.stderr)
        sys.exit(130)
    try:
        command()
    except SystemExit as stop:
        codes.append(int(stop.code or 0))
        raise


def _leave(codes: list[int]) -> None:
    """End with this exit code, open files written; to take all objects apart would take as long as a walk."""
    for x in gc.get_objects():
        if type(x) in (io.TextIOWrapper, io.BufferedWriter):
            with suppress(OSError, ValueError):
                x.flush()
    if codes:
        os._exit(codes[0])


if __name__ == "__main__":
    main()
