"""Print or write the rows: published results and closed forms beside what is found here.

Run: python -m validation [--only GROUP] [--out docs/verification.csv]

Fails when a row does not hold. All rows take about four minutes.
"""

from __future__ import annotations

import argparse
import csv
import io
import sys
from pathlib import Path
from time import perf_counter

from biped_adrc.core.errors import BipedError
from biped_adrc.core.files import write_text
from validation.groups import Group, group_named, groups
from validation.row import COLUMNS, Row


def rows_of(group: Group) -> tuple[Row, ...]:
    """All rows of a group, with a line on stderr for each part."""
    rows: list[Row] = []
    for number, maker in enumerate(group.makers, 1):
        begin = perf_counter()
        rows += maker()
        spent = perf_counter() - begin
        print(f"{group.name} {number}/{len(group.makers)}, {spent:.1f} s", file=sys.stderr)
    return tuple(rows)


def table(found: dict[Group, tuple[Row, ...]]) -> str:
    """All rows as CSV."""
    text = io.StringIO()
    lines = csv.writer(text, lineterminator="\n")
    lines.writerow(("group", *COLUMNS))
    lines.writerows([group.name, *row.cells()] for group, rows in found.items() for row in rows)
    return text.getvalue()


def count(rows: list[Row]) -> str:
    """How many rows hold."""
    targets = [row for row in rows if row.has_target]
    held = sum(row.holds for row in targets)
    return f"{held} of {len(targets)} rows hold, {len(rows) - len(targets)} without a target"


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m validation", description=__doc__)
    parser.add_argument("--only", metavar="GROUP", help="the rows of this group alone")
    parser.add_argument("--out", type=Path, metavar="CSV", help="write them here")
    arguments = parser.parse_args()
    try:
        chosen = groups() if arguments.only is None else (group_named(arguments.only),)
        found = {group: rows_of(group) for group in chosen}
        if arguments.out is None:
            print(table(found), end="")
        else:
            write_text(arguments.out, table(found))
    except BipedError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code
    rows = [row for each in found.values() for row in each]
    for row in rows:
        if row.has_target and not row.holds:
            print(f"does not hold: {row.system}, {row.quantity}", file=sys.stderr)
    print(count(rows), file=sys.stderr)
    return int(any(row.has_target and not row.holds for row in rows))


if __name__ == "__main__":
    sys.exit(main())
