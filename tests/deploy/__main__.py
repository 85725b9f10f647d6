"""python -m tests.deploy: every thing of the registry exported, and proved over a step and its touchdown.

The table of docs/guide/robot.md; exit code 1 where one differs by more than is allowed. With --fuzz, 20000
calls of any numbers for the first thing of every name instead. Some minutes.
"""

import multiprocessing
import re
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from tests.deploy.pairs import pairs
from tests.deploy.whole import fuzzed, row

PAGE = Path(__file__).resolve().parents[2] / "docs" / "guide" / "robot.md"
BEGIN = "<!-- pairs: made by python -m tests.deploy -->"
END = "<!-- end of pairs -->"


HEAD = "| of the registry | exported | refused | a call | a walk | why refused |"


def main():
    """The exit code."""
    names, began = list(dict.fromkeys(pair[:2] for pair in pairs())), time.monotonic()
    fuzz = "--fuzz" in sys.argv[1:]
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        found = []
        for one in pool.map(fuzzed if fuzz else row, names):
            found.append(one)
            print(one, flush=True)
    if not fuzz:
        rows, exported, compiling, good = zip(*found, strict=True)
        minutes = (time.monotonic() - began) / 60.0
        write(
            "\n".join([HEAD, "| --- " * 6 + "|", *rows]),
            f"{sum(exported)} pairs in {minutes:.0f} min on the machine at hand, in two processes; "
            f"the compiler took {sum(compiling) / sum(exported):.1f} s for one.",
        )
        return 0 if all(good) else 1
    return 0


def write(table, words):
    """Table and words between their marks of the page."""
    text, between = PAGE.read_text(encoding="utf-8"), f"{BEGIN}\n{table}\n\n{words}\n\n{END}"
    found = re.sub(f"(?s){re.escape(BEGIN)}.*{re.escape(END)}", lambda _: between, text)
    PAGE.write_text(found, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
