"""`python -m tests.photograph take OUT` and `python -m tests.photograph compare BEFORE AFTER`."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

CACHE = "BIPED_ADRC_CACHE"
ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
"""Of sums in NumPy, which would depend on the number of threads; set before NumPy is imported."""


def arguments() -> argparse.Namespace:
    """From the command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.photograph")
    commands = parser.add_subparsers(dest="command", required=True)
    take = commands.add_parser("take", help="record what the package does")
    take.add_argument("out", type=Path, help="folder of the JSON files")
    take.add_argument("--scenarios", type=int, help="only so many, from number 0 on")
    take.add_argument("--like", type=Path, help="the scenarios stored in this photograph")
    take.add_argument("--workers", type=int, default=2, help="processes")
    take.add_argument("--only", help="comma separated, of scenarios, help, commands, reports")
    take.add_argument("--cache", action="store_true", help="use the user's cache of compiled code")
    compare = commands.add_parser("compare", help="say what differs; exit code 1 if anything does")
    compare.add_argument("before", type=Path)
    compare.add_argument("after", type=Path)
    compare.add_argument(
        "--allow", type=Path, help="file of allowed differences, PATTERN  # reason"
    )
    compare.add_argument("--most", type=int, default=40, help="differences that are printed")
    return parser.parse_args()


def main() -> int:
    """The exit code."""
    given = arguments()
    if given.command == "compare":
        return compare(given)
    os.environ.update(dict.fromkeys(ONE_THREAD, "1"))
    from tests.photograph.take import PARTS, take

    parts = PARTS if given.only is None else tuple(given.only.split(","))
    with tempfile.TemporaryDirectory(prefix="photograph-cache") as folder:
        if not given.cache:
            os.environ[CACHE] = folder
        take(given.out, parts, given.scenarios, given.like, given.workers)
    return 0


def compare(given: argparse.Namespace) -> int:
    """Print the table and what differs."""
    from tests.photograph.compare import UNJUDGED, allowed_in, compared

    found = compared(given.before, given.after)
    found.allow(allowed_in(given.allow))
    for f in found.broken[: given.most]:
        print(f"{f.key}\n" + "".join(f"    {line}\n" for line in f.text.splitlines()))
    if len(found.broken) > given.most:
        print(f"and {len(found.broken) - given.most} more; --most prints them\n")
    print(found.table())
    print(found.distribution())
    unjudged = sum(f.word == UNJUDGED for f in found.findings)
    print(
        f"{found.sensitive} walks end otherwise from a start moved by 1e-14; {unjudged} groups unjudged"
    )
    if found.left_out:
        print(f"not compared, as only one of them has it: {', '.join(found.left_out)}")
    print("differs" if found.broken else "the same, but for what is allowed")
    return 1 if found.broken else 0


if __name__ == "__main__":
    sys.exit(main())
