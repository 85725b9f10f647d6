"""The command `biped-adrc`, also as `python -m biped_adrc`; Ctrl-C while it is imported leaves no traceback."""

import gc
import sys

OBJECTS = 200_000
"""New ones after which Python looks for cycles among them: a walk makes 130 000, which stay."""


def main() -> None:
    """Import the command, which takes its time, and run it."""
    gc.set_threshold(OBJECTS)
    try:
        from biped_adrc.cli import main as command
    except KeyboardInterrupt:
        print("interrupted; nothing was begun", file=sys.stderr)
        sys.exit(130)
    command()


if __name__ == "__main__":
    main()
