"""Make the maps of docs/guide/sweep.md from the two studies in examples/.

Run: python docs/make_maps.py OUT

OUT: folder for the results, which are gone on with where there are some. Beside each map a JSON file holds for
every point, in the order of its study, what the map shows and whether the walk is legal;
docs/check_pictures.py runs some of them again.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from biped_adrc.bench.export import sweep_map
from biped_adrc.bench.run import run_trials
from biped_adrc.bench.study_file import load_study
from biped_adrc.bench.sweep import Sweep, sweep
from biped_adrc.files import write_bytes, write_text
from biped_adrc.viz.figure_numbers import Numbers, as_text
from biped_adrc.viz.plots.sweep_maps import Maps
from biped_adrc.viz.style import render

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
UNITS = {
    "start.q5": "rad",
    "start.v5": "rad/s",
    "bandwidth": "rad/s",
    "period": "s",
    "noise": "rad",
}
PICTURES = {
    "basin": ("sweep.toml", Maps("start.q5", "start.v5", "case", "survived", UNITS)),
    "robustness": (
        "robustness.toml",
        Maps("bandwidth", "period", "noise", "survived", UNITS, frozenset({"bandwidth"})),
    ),
}
AGAIN = 6
"""Points of each study that are run again to check its map."""


def numbers(done: Sweep, maps: Maps) -> Numbers:
    """What is shown, of every point, and whether its walk is legal."""
    rows = [result.row for result in done.results()]
    return {"points": len(rows)} | {name: [row.get(name) for row in rows] for name in stored(maps)}


def stored(maps: Maps) -> tuple[str, ...]:
    """The columns of the file."""
    return tuple(dict.fromkeys((maps.value, "legal")))


def again(name: str, old: Numbers) -> Numbers:
    """The numbers in the file with `AGAIN` of them run again, spread evenly over the study."""
    source, maps = PICTURES[name]
    study = load_study(ROOT / "examples" / source)
    columns: dict[str, list[Any]] = {c: list(old.get(c, [])) for c in stored(maps)}
    for values in columns.values():
        values += [None] * (study.count - len(values))
    chosen = [(2 * k + 1) * study.count // (2 * AGAIN) for k in range(AGAIN)]
    records = [point.record for k, point in enumerate(study.points()) if k in chosen]
    for k, row in zip(chosen, run_trials(records), strict=True):
        for column, values in columns.items():
            values[k] = row.get(column)
    return {"points": study.count, **columns}


def main() -> None:
    """Sweep, draw."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    out = parser.parse_args().out
    for name, (study, maps) in PICTURES.items():
        done = sweep(ROOT / "examples" / study, out / name)
        write_bytes(IMAGES / f"{name}.svg", render(sweep_map(done, maps), "svg"))
        write_text(IMAGES / f"{name}.json", as_text(numbers(done, maps)))


if __name__ == "__main__":
    main()
