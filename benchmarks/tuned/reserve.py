"""The contest once more with less friction allowed and more candidates: what a reserve of friction costs.

    python benchmarks/tuned/reserve.py out/tuned_reserve

Contestants, limits and budget stand in reserve.toml; the folder has one of the contest's form for each limit of
friction. What was interrupted goes on. `goal` takes its settings from there.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from alike import HERE, carry_out, entries, read


def contests() -> Iterator[tuple[str, dict[str, dict]]]:
    """For each limit of friction its folder and the tables of a contest with it."""
    c = read(HERE / "reserve.toml")
    for friction in c["limits"]["friction"]:
        yield f"friction_{friction:g}", c | {"limits": {**c["limits"], "friction": friction}}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    given = parser.parse_args()
    for folder, c in contests():
        for e in entries(c):
            note = carry_out(c, e, given.out / folder)
            print(folder, e.contestant, note.get("chosen", note.get("why")), flush=True)


if __name__ == "__main__":
    main()
