"""python -m tests.deploy: every thing of the registry on all hardware, exported and proved over two steps.

The table of docs/guide/robot.md; exit code 1 where one differs by more than is allowed. 15 minutes on one core.
"""

import re
import sys
import time
from itertools import groupby
from pathlib import Path

from biped_adrc.deploy.apart import TIMES
from biped_adrc.hybrid.simulator import RunOptions
from tests.deploy.pairs import gait, pairs, proved, robot

PAGE = Path(__file__).resolve().parents[2] / "docs" / "guide" / "robot.md"
BEGIN = "<!-- pairs: made by python -m tests.deploy -->"
END = "<!-- end of pairs -->"
OPTIONS = RunOptions(4.0, stop_after=("foot_strike", 2))


def main():
    """The exit code."""
    began = time.monotonic()
    begin, rows, faults = gait().start(robot()), [], []
    for (kind, name), group in groupby(pairs(), lambda x: (x.kind, x.name)):
        found = [(pair, proved(pair, begin, OPTIONS)) for pair in group]
        rows.append(row(kind, name, [x for _, x in found]))
        print(rows[-1], flush=True)
        faults += [(repr(pair)[:90], x) for pair, x in found if not (x.refused or good(x))]
    text = PAGE.read_text(encoding="utf-8")
    table = "\n".join([HEAD, "| --- " * 6 + "|", *rows])
    exported = sum(int(x.split(" | ")[1]) for x in rows)
    spent = f"{exported} pairs in {(time.monotonic() - began) / 60:.0f} min on this machine."
    pattern = f"(?s){re.escape(BEGIN)}.*{re.escape(END)}"
    PAGE.write_text(
        re.sub(pattern, lambda _: f"{BEGIN}\n{table}\n\n{spent}\n\n{END}", text), encoding="utf-8"
    )
    print(spent, *faults, sep="\n")
    return 1 if faults else 0


HEAD = (
    "| of the registry | exported | refused | C - Python / one ulp, a call | a walk | why refused |"
)


def good(found):
    """Whether a pair differs by no more than is allowed."""
    return found.rounding.worst <= TIMES and found.apart.proved


def row(kind, name, found):
    """A row of the table: pairs, and the worst of them."""
    made = [x for x in found if not x.refused]
    refused = [x.refused.split(",")[0] for x in found if x.refused]
    worst = [
        f"{max(x.rounding.worst for x in made):.2f}",
        f"{max(x.apart.worst for x in made):.2f}",
    ]
    cells = [f"{kind} {name}", len(made), len(refused), *(worst if made else ["", ""])]
    return f"| {' | '.join(map(str, [*cells, refused[0] if refused else '']))} |"


if __name__ == "__main__":
    sys.exit(main())
