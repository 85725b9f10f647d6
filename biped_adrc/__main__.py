"""The command `biped-adrc`, also as `python -m biped_adrc`; Ctrl-C while it is imported leaves no traceback."""

import sys


def main() -> None:
    """Import the command, which takes its time, and run it."""
    try:
        from biped_adrc.cli import main as command
    except KeyboardInterrupt:
        print("interrupted; nothing was begun", file=sys.stderr)
        sys.exit(130)
    command()


if __name__ == "__main__":
    main()
