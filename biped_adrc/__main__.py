"""The command `biped-adrc`, also as `python -m biped_adrc`; Ctrl-C while it is imported leaves no traceback."""

import atexit
import gc
import io
import os
import sys
from contextlib import suppress


def main() -> None:
    """Import the command, which takes its time, and run it."""
    # a walk makes 130 000 objects, which stay: to search them for garbage would be in vain
    gc.set_threshold(200_000)
    # else pydantic searches all installed packages for plugins
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    codes: list[int] = []  # the command's exit code, once it has one
    atexit.register(_leave, codes)  # before all else: the first to register is called last
    try:
        from biped_adrc.cli import main as command
    except KeyboardInterrupt:
        print("interrupted; nothing was begun", file=sys.stderr)
        sys.exit(130)  # a shell's code for Ctrl-C
    try:
        command()
    except SystemExit as stop:
        codes.append(int(stop.code or 0))
        raise


def _leave(codes: list[int]) -> None:
    """Write out all open files, and end the process at once with the exit code in `codes`.

    For Python to take all objects apart would last as long as a walk. It does so where `codes` is empty.
    """
    for x in gc.get_objects():
        if type(x) in (io.TextIOWrapper, io.BufferedWriter):
            with suppress(OSError, ValueError):
                x.flush()
    if codes:
        os._exit(codes[0])


if __name__ == "__main__":
    main()
