"""Make the pictures README.md opens with, from the runs of a reproduction, and that of the zero dynamics.

Run: python docs/make_pictures.py OUT
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from biped_adrc.analysis.zero_report import zero_report
from biped_adrc.files import write_bytes
from biped_adrc.gait.gait import load_gait
from biped_adrc.model.biped import Biped
from biped_adrc.paper.figures import draw, push_window
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.stored import load_walks
from biped_adrc.viz.from_the_side.moving_parts import Motion
from biped_adrc.viz.from_the_side.moving_picture import write_moving_picture
from biped_adrc.viz.plots.zero_dynamics import zero_dynamics_figure
from biped_adrc.viz.style import render

IMAGES = Path(__file__).resolve().parent / "images"
BEFORE, AFTER = 0.15, 0.25
"""[s], shown before and after the push."""
MOTION = Motion(apart=True, magnify=30.0, slower=5.0, width=800)
Walks = Mapping[str, Walk]


def load(out: Path) -> Walks:
    """The pushed walks of a reproduction by controller."""
    return load_walks([out / "walk-npd.npz", out / "walk-adrc.npz"])


def part(walks: Walks) -> tuple[float, float]:
    """What of the walks the animation shows: the push and what is around it [s]."""
    window = push_window(walks["NPD"].signals)
    return (7.4, 8.2) if window is None else (window[0] - BEFORE, window[1] + AFTER)


def figures(walks: Walks) -> dict[str, Figure]:
    """The figures by name."""
    return {"comparison": draw("comparison", walks), "zero": zero_picture()}


def zero_picture() -> Figure:
    """What the zero dynamics say of RABBIT at 0.8 m/s."""
    biped = Biped.load("rabbit", "identified-bare")
    report = zero_report(biped, load_gait("v0.8", biped).constraint)
    return zero_dynamics_figure(report)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path, help="folder of 'biped-adrc reproduce'")
    walks = load(parser.parse_args().out)
    start, stop = part(walks)
    write_moving_picture(IMAGES / "walk.gif", walks, start=start, stop=stop, motion=MOTION)
    for name, figure in figures(walks).items():
        write_bytes(IMAGES / f"{name}.svg", render(figure, "svg"))


if __name__ == "__main__":
    main()
