"""Make the pictures README.md opens with, from the runs of a reproduction, and that of the zero dynamics.

Run: python docs/make_pictures.py OUT
"""

from __future__ import annotations

import argparse
from pathlib import Path

from biped_adrc.analysis.zero_report import zero_report
from biped_adrc.files import write_bytes
from biped_adrc.gait.gait import load_gait
from biped_adrc.model.biped import Biped
from biped_adrc.studies.figures import draw, push_window
from biped_adrc.studies.runs import load_walks
from biped_adrc.viz.gif import write_gif
from biped_adrc.viz.plots.zero_dynamics import zero_dynamics_figure
from biped_adrc.viz.style import render

IMAGES = Path(__file__).resolve().parent / "images"
BEFORE, AFTER = 0.5, 1.3
"""[s], shown before and after the push."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path, help="folder of 'biped-adrc reproduce'")
    out = parser.parse_args().out
    walks = load_walks([out / "walk-npd.npz", out / "walk-adrc.npz"])
    window = push_window(walks["NPD"].signals)
    start, stop = (7.4, 8.4) if window is None else (window[0] - BEFORE, window[1] + AFTER)
    write_gif(IMAGES / "walk.gif", walks, start=start, stop=stop, fps=25.0)
    write_bytes(IMAGES / "comparison.svg", render(draw("comparison", walks), "svg"))
    zero_picture()


def zero_picture() -> None:
    """What the zero dynamics say of RABBIT at 0.8 m/s."""
    biped = Biped.load("rabbit", "identified-bare")
    report = zero_report(biped, load_gait("v0.8", biped).constraint)
    write_bytes(IMAGES / "zero.svg", render(zero_dynamics_figure(report), "svg"))


if __name__ == "__main__":
    main()
