"""Say which picture of README.md and docs/ no longer shows what a run gives now.

Run: python docs/check_pictures.py OUT

OUT: folder of `biped-adrc reproduce`, quick or not. Each picture has a JSON file of its numbers beside it,
written by the script that made it. Here they are compared with the runs in OUT, within 1 %; of the maps of
docs/guide/sweep.md some points are run again. Pictures of longer runs, those of the comparison and the maps of
pushes, are held against the summaries kept beside them. A picture ages with its numbers and not with each
commit.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

import make_maps
import make_pictures
import make_soft_pictures
import write_comparison
import write_critical_phase
import write_replay
import write_results
import write_tuned

from biped_adrc.bench.compare_study import figures
from biped_adrc.errors import BipedError
from biped_adrc.viz.figure_numbers import Numbers, differences, numbers_of
from biped_adrc.viz.plots.push_map import push_map_figure

DOCS = Path(__file__).resolve().parent
KINDS = (".svg", ".gif", ".png")
MOST = 8
"""Lines about one picture."""


class Picture(NamedTuple):
    """A picture, what makes it, and what its numbers are now, given those in its file."""

    path: Path
    command: str
    now: Callable[[Numbers], Numbers]


def pictures(out: Path, docs: Path = DOCS) -> list[Picture]:
    """All pictures that are made of runs."""
    shown = make_pictures.numbers(make_pictures.load(out))
    images, results = docs / "images", docs / "results"
    suffix = {"walk": ".gif"}
    return [
        *(
            Picture(
                results / f"{n}.svg", "make reproduce && make results", _stored(out / f"{n}.json")
            )
            for n in write_results.SHOWN
        ),
        *(
            Picture(
                images / f"{n}{suffix.get(n, '.svg')}",
                "make reproduce && make pictures",
                lambda _, found=found: found,
            )
            for n, found in shown.items()
        ),
        *(
            Picture(
                images / f"{n}.svg",
                "python docs/make_maps.py OUT",
                lambda old, n=n: make_maps.again(n, old),
            )
            for n in make_maps.PICTURES
        ),
    ]


def soft() -> list[Picture]:
    """The pictures of walks on soft ground, which are walked again."""
    folder, command = make_soft_pictures.FOLDER, "python docs/make_soft_pictures.py"
    suffix = {"walk": ".gif"}
    return [
        Picture(folder / f"{n}{suffix.get(n, '.svg')}", command, lambda _, found=found: found)
        for n, found in make_soft_pictures.numbers().items()
    ]


def replayed() -> list[Picture]:
    """The picture of logs, which are walked and replayed again."""
    drawn, command = write_replay.recovered(write_replay.found()), "python docs/write_replay.py"
    return [Picture(write_replay.FOLDER / "recovered.svg", command, lambda _: numbers_of(drawn))]


def kept() -> list[Picture]:
    """The pictures of the runs whose summaries are kept in docs/. Raises InputError without a summary."""
    compared, pushed = write_comparison.FOLDER, write_critical_phase.FOLDER
    cells = write_critical_phase.read(pushed / "summary.json").cells
    maps = {
        preset: push_map_figure([cell.row() for cell in cells if cell.preset == preset])
        for preset in write_critical_phase.presets_of(cells)
    }
    tuned = write_tuned.figures(write_tuned.read(write_tuned.FOLDER / "summary.json"))
    commands = {
        "make tuned": (write_tuned.FOLDER, tuned),
        "make comparison": (compared, figures(write_comparison.read(compared / "summary.json"))),
        "python docs/write_critical_phase.py OUT": (pushed, maps),
    }
    return [
        Picture(folder / f"{name}.svg", command, lambda _, drawn=drawn: numbers_of(drawn))
        for command, (folder, found) in commands.items()
        for name, drawn in found.items()
    ]


def _stored(path: Path) -> Callable[[Numbers], Numbers]:
    return lambda _: json.loads(path.read_text(encoding="utf-8"))


def complaints(shown: Iterable[Picture]) -> list[str]:
    """A line for every number that differs, and for every picture or file of numbers that is missing."""
    found = []
    for path, command, now in shown:
        beside = path.with_suffix(".json")
        missing = [p for p in (path, beside) if not p.is_file()]
        if missing:
            lines = [f"'{p.name}' is not there" for p in missing]
        else:
            old = json.loads(beside.read_text(encoding="utf-8"))
            lines = differences(old, now(old))
            if len(lines) > MOST:
                lines = [*lines[:MOST], f"{len(lines) - MOST} numbers more differ"]
        found += [
            f"{path.parent.name}/{path.name}: {line}; make it again: {command}" for line in lines
        ]
    return found


def without_numbers(folders: Iterable[Path], shown: Iterable[Picture]) -> list[str]:
    """A line for every picture in the folders that none of the commands makes."""
    known = {picture.path for picture in shown}
    return [
        f"{path.parent.name}/{path.name}: no command makes it; add it to docs/check_pictures.py"
        for folder in folders
        for path in sorted(folder.iterdir())
        if path.suffix in KINDS and path not in known
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path, help="folder of 'biped-adrc reproduce'")
    try:
        shown = [*pictures(parser.parse_args().out), *soft(), *replayed(), *kept()]
        folders = dict.fromkeys(picture.path.parent for picture in shown)
        lines = complaints(shown) + without_numbers(folders, shown)
    except (BipedError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    for line in lines:
        print(line)
    return int(bool(lines))


if __name__ == "__main__":
    sys.exit(main())
