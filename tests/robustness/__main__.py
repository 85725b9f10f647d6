"""python -m tests.robustness ATTACK [--number N] [--page PAGE.md]; exit code 1 for a fault."""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import re
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from tests.robustness import contact, engines, searches, steps

ATTACKS = {
    "engines": (engines, 2000),
    "contact": (contact, 1000),
    "steps": (steps, 200),
    "searches": (searches, searches.ATTACKS),
}
"""The module of each, and how many scenarios it draws."""


def main() -> int:
    """The exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.robustness")
    parser.add_argument("attack", choices=ATTACKS)
    parser.add_argument("--number", type=int, help="scenarios")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes")
    parser.add_argument("--page", type=Path, help="where the table is written, between its marks")
    parser.add_argument(
        "--out", type=Path, help="what was found, as JSON lines; goes on where it ended"
    )
    given = parser.parse_args()
    module, usual = ATTACKS[given.attack]
    number = usual if given.number is None else given.number
    found = kept(given.out)
    todo = sorted(set(range(given.first, given.first + number)) - {x["k"] for x in found})
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(given.workers, mp_context=context) as pool:
        for i, record in enumerate(pool.map(module.judged, todo), 1):
            found.append(record)
            if given.out:
                with given.out.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(record) + "\n")
            if i % 100 == 0:
                print(f"{i} of {len(todo)}", file=sys.stderr, flush=True)
    found.sort(key=lambda x: x["k"])
    text = module.table(found)
    print("\n".join([text, *module.faults(found)]))
    if given.page:
        write(given.page, given.attack, text)
    return 1 if module.faults(found) else 0


def kept(path: Path | None) -> list[dict[str, object]]:
    """What an interrupted run has found."""
    if path is None or not path.is_file():
        return []
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def write(page: Path, name: str, text: str) -> None:
    """The table between the marks of this attack in a page."""
    marks = f"<!-- {name} -->", f"<!-- end of {name} -->"
    whole = page.read_text(encoding="utf-8")
    pattern = f"(?s)(?<={re.escape(marks[0])}\n).*(?={re.escape(marks[1])})"
    page.write_text(re.sub(pattern, lambda _: text + "\n", whole), encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
