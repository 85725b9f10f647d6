"""Write docs/verification.md: published results and closed forms beside what is found here.

Run: python docs/write_verification.py [--only GROUP]

--only: print the table of one group and write nothing. Fails when a row does not hold.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from time import perf_counter

from write_results import table

from biped_adrc.errors import BipedError
from biped_adrc.files import write_text
from biped_adrc.versions import versions
from validation.groups import Group, group_named, groups
from validation.row import COLUMNS, Row

PAGE = Path(__file__).resolve().parent / "verification.md"
COMMAND = "python docs/write_verification.py"

LITERATURE = """\
## Literature

- P. Bhounsule: *passivewalker.m*, a simulation for MATLAB, 2009.
- M. Garcia, A. Chatterjee, A. Ruina, M. Coleman: *The simplest walking model: stability, complexity, and
  scaling.* J. Biomechanical Engineering 120(2), 1998, and the simulation of M. Garcia that goes with it.
- A. Goswami, B. Thuilot, B. Espiau: *A study of the passive gait of a compass-like biped robot.* Int. J.
  Robotics Research 17(12), 1998.
- J. W. Grizzle, G. Abba, F. Plestan: *Asymptotically stable walking for biped robots: analysis via systems with
  impulse effects.* IEEE Trans. Automatic Control 46(1), 2001.
- T. McGeer: *Passive dynamic walking.* Int. J. Robotics Research 9(2), 1990.
- E. R. Westervelt, J. W. Grizzle, D. E. Koditschek: *Hybrid zero dynamics of planar biped walkers.* IEEE Trans.
  Automatic Control 48(1), 2003.
- E. R. Westervelt, J. W. Grizzle, C. Chevallereau, J. H. Choi, B. Morris: *Feedback Control of Dynamic Bipedal
  Robot Locomotion.* CRC Press, 2007."""


def rows_of(group: Group) -> tuple[Row, ...]:
    """All rows of a group, with a line on stderr for each part."""
    rows: list[Row] = []
    for number, maker in enumerate(group.makers, 1):
        begin = perf_counter()
        rows += maker()
        spent = perf_counter() - begin
        print(f"{group.name} {number}/{len(group.makers)}, {spent:.1f} s", file=sys.stderr)
    return tuple(rows)


def count(rows: tuple[Row, ...]) -> str:
    """How many rows hold."""
    targets = [row for row in rows if row.has_target]
    beside = len(rows) - len(targets)
    held = f"{sum(row.holds for row in targets)} of {len(targets)} rows hold"
    return held + (f", {beside} without a target" if beside else "")


def markdown(rows: tuple[Row, ...]) -> str:
    """One table; columns that are empty in all rows are left out."""
    cells = [row.cells() for row in rows]
    kept = [k for k in range(len(COLUMNS)) if any(line[k] for line in cells)]
    return table([COLUMNS[k] for k in kept], [[line[k] for k in kept] for line in cells])


def page(found: dict[Group, tuple[Row, ...]], seconds: float) -> str:
    """The page."""
    everything = tuple(row for rows in found.values() for row in rows)
    parts = [
        "# Verification",
        "What others published, what has a closed form, and what physics asks of any gait, each beside what\n"
        f"this package finds. Written by `{COMMAND}` (`make verification`) in {seconds / 60.0:.0f} minutes.\n"
        f"**{count(everything)}.** A row without a target shows two numbers that need not agree.\n"
        "`tests/test_verification.py` asserts the same rows, but for some of the slow ones.",
    ]
    for group, rows in found.items():
        parts += [
            f"## {group.title}",
            group.text,
            f"{count(rows)}: `{COMMAND} --only {group.name}`",
            markdown(rows),
        ]
    parts += [
        LITERATURE,
        "## Versions",
        table(["part", "version"], [[k, v] for k, v in versions().items()]),
    ]
    return "\n\n".join(parts) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", metavar="GROUP", help="print the table of this group")
    arguments = parser.parse_args()
    begin = perf_counter()
    try:
        chosen = groups() if arguments.only is None else (group_named(arguments.only),)
        found = {group: rows_of(group) for group in chosen}
    except BipedError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code
    if arguments.only is None:
        write_text(PAGE, page(found, perf_counter() - begin))
    else:
        print(markdown(found[chosen[0]]))
    failed = [row for rows in found.values() for row in rows if row.has_target and not row.holds]
    for row in failed:
        print(f"does not hold: {row.system}, {row.quantity}", file=sys.stderr)
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
