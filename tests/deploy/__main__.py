"""python -m tests.deploy: every name of the registry exported and proved over a touchdown, as CI does.

The table of docs/guide/robot.md; exit code 1 where one differs by more than is allowed. With --whole, all that
the rows of a name have, controllers on all hardware, over a step: minutes. With --fuzz, 20000 calls of any
numbers for every name instead, and no table.
"""

import multiprocessing
import re
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from tests.deploy.pairs import pairs
from tests.deploy.whole import fuzzed, row

PAGE = Path(__file__).resolve().parents[2] / "docs" / "guide" / "robot.md"
BEGIN = "<!-- pairs: made by python -m tests.deploy -->"
END = "<!-- end of pairs -->"
HEAD = "| of the registry | exported | refused | a call | a walk | why refused |"


def main():
    """The exit code."""
    given, names = sys.argv[1:], list(dict.fromkeys(pair[:2] for pair in pairs()))
    each = fuzzed if "--fuzz" in given else partial(row, whole="--whole" in given)
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        found = []
        for one in pool.map(each, names):
            found.append(one)
            print(one, flush=True)
    if each is fuzzed:
        return 0
    rows, exported, good, used = zip(*found, strict=True)
    own, compiler = sum(used)
    how = ", of a step and its touchdown," if "--whole" in given else ""
    spent = f"took {own:.0f} s of a processor of the machine at hand, and {compiler:.0f} s of"
    write(
        "\n".join([HEAD, "| --- " * 6 + "|", *rows]),
        f"{sum(exported)} pairs{how} {spent} its C compiler, without optimisation.",
    )
    return 0 if all(good) else 1


def write(table, words):
    """Table and words between their marks of the page."""
    text, between = PAGE.read_text(encoding="utf-8"), f"{BEGIN}\n{table}\n\n{words}\n\n{END}"
    found = re.sub(f"(?s){re.escape(BEGIN)}.*{re.escape(END)}", lambda _: between, text)
    PAGE.write_text(found, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
