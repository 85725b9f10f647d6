"""Make the maps of docs/guide/sweep.md from the two studies in examples/.

Run: python docs/make_maps.py OUT

OUT: folder for the results, which are gone on with where there are some.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from biped_adrc.files import write_bytes
from biped_adrc.studies.bench.maps import sweep_map
from biped_adrc.studies.bench.sweep import sweep
from biped_adrc.viz.style import render
from biped_adrc.viz.sweep_maps import Maps

ROOT = Path(__file__).resolve().parents[1]
UNITS = {
    "start.q5": "rad",
    "start.v5": "rad/s",
    "bandwidth": "rad/s",
    "period": "s",
    "noise": "rad",
}
PICTURES = {
    "basin": ("sweep.toml", Maps("start.q5", "start.v5", "controller", "survived", UNITS)),
    "robustness": (
        "robustness.toml",
        Maps("bandwidth", "period", "noise", "survived", UNITS, frozenset({"bandwidth"})),
    ),
}


def main() -> None:
    """Sweep, draw."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    out = parser.parse_args().out
    for name, (study, maps) in PICTURES.items():
        done = sweep(ROOT / "examples" / study, out / name)
        picture = render(sweep_map(done, maps), "svg")
        write_bytes(ROOT / "docs" / "images" / f"{name}.svg", picture)


if __name__ == "__main__":
    main()
