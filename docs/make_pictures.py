"""Make the pictures README.md opens with, from the runs of a reproduction, and that of the zero dynamics.

Scenario: python docs/make_pictures.py OUT

Beside each picture a JSON file holds the numbers that it shows; docs/check_pictures.py compares them with runs.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from biped_adrc.analysis.zero_report import zero_report
from biped_adrc.files import write_bytes, write_text
from biped_adrc.gait.gait import load_gait
from biped_adrc.model.biped import Biped
from biped_adrc.paper.figures import draw, push_window
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.stored import load_walks
from biped_adrc.viz.figure_numbers import SHARES, Numbers, as_text, numbers_of, rounded
from biped_adrc.viz.from_the_side.moving_parts import Motion
from biped_adrc.viz.from_the_side.moving_picture import write_moving_picture
from biped_adrc.viz.from_the_side.side_view import SideView
from biped_adrc.viz.placement import WalkScene
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


def numbers(walks: Walks) -> dict[str, Numbers]:
    """What the pictures show, by name."""
    drawn = {name: numbers_of(figure) for name, figure in figures(walks).items()}
    return {"walk": animated(walks, part(walks), MOTION), **drawn}


def animated(walks: Walks, part: tuple[float, float], motion: Motion) -> Numbers:
    """What an animation shows: its part [s] and speed; error, hip and push over time."""
    start, stop = part
    times = start + np.array(SHARES) * (stop - start)
    error, hip, push = {}, {}, {}
    for name, walk in walks.items():
        s, view = walk.signals, SideView(WalkScene.of(walk))
        rows = (s.t >= start) & (s.t <= stop)
        sizes = np.max(np.abs(s.error[rows]), axis=1)
        found = np.interp(times, s.t[rows], sizes)
        error[name] = {"y": rounded([sizes.min(), sizes.max()]), "samples": rounded(found)}
        hip[name] = rounded([view.points(float(t))[:2] for t in times])
        push[name] = rounded(np.max(np.abs(s.zeta[rows]), axis=0))
    shown = {"start": start, "stop": stop, "magnified": motion.magnify, "slower": motion.slower}
    return {
        "clip": {**shown, "frames per second": motion.fps, "width": motion.width},
        "largest error [rad]": {"lines": error},
        "hip, x and z [m]": hip,
        "largest push on each joint [N m]": push,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path, help="folder of 'biped-adrc reproduce'")
    walks = load(parser.parse_args().out)
    start, stop = part(walks)
    write_moving_picture(IMAGES / "walk.gif", walks, start=start, stop=stop, motion=MOTION)
    for name, figure in figures(walks).items():
        write_bytes(IMAGES / f"{name}.svg", render(figure, "svg"))
    for name, found in numbers(walks).items():
        write_text(IMAGES / f"{name}.json", as_text(found))


if __name__ == "__main__":
    main()
