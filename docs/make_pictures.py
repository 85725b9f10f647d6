"""Make the picture README.md opens with, and those of the pages. Run: python docs/make_pictures.py"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from PIL import Image

from biped_adrc.analysis.rough_ground import rough_ground
from biped_adrc.analysis.zero_report import zero_report
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.npd import NPDController
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.core.files import write_bytes
from biped_adrc.gait.constraint import continued
from biped_adrc.gait.gait import load_gait
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import stepped
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import walk, walk_scenario
from biped_adrc.studies.build import SEED
from biped_adrc.studies.run import run_trials
from biped_adrc.studies.study import read_study
from biped_adrc.view.from_the_side.moving_picture import write_moving_picture
from biped_adrc.view.placement import Clip
from biped_adrc.view.plots.zero_dynamics import rough_ground_figure, zero_dynamics_figure
from biped_adrc.view.style import render
from validation.findings import comparison, searches

IMAGES = Path(__file__).resolve().parent / "images"
SAMPLED = {"hardware.torque_limit": 150.0, "hardware.period": "1 ms", "run.impacts": 12}
HELD = {"shape": "hip force", "force": 14.4, "direction": "180 deg", "steps": (5, 99)}
FOOTSTEP = {"name": "footstep", "inner": "NPD"}
PICTURES: dict[str, tuple[dict[str, Any], dict[str, Any], Clip]] = {
    "footstep_hip": (
        {**SAMPLED, "gait": "v0.5", "pushes": [HELD]},
        {
            "stride PI": {"name": "stride PI", "inner": "NPD"},
            "footstep": {**FOOTSTEP, "step": 0.25},
        },
        Clip(start=2.6, stop=4.45, fps=10.0, apart=True),
    ),
    "footstep_ground": (
        {**SAMPLED, "gait": "v0.6", "ground.step_height": "20 mm", "run.seed": 11},
        {"NPD": "NPD", "footstep": {**FOOTSTEP, "speed": 0.6, "step": 0.38}},
        Clip(start=3.6, stop=5.8, fps=8.0, apart=True),
    ),
    "footstep_stones": (
        {**SAMPLED, "gait": "v0.6", "ground.stone_range": (0.2, 0.6), "run.seed": 8},
        {"footstep": {**FOOTSTEP, "speed": 0.5, "step": 0.4}},
        Clip(start=0.5, stop=4.5, fps=10.0),
    ),
}
"""By name: a scenario, controllers of which the last one alone walks on, and what is shown."""


SEEDS, SHOWN = range(50000, 50020), 50004
"""The grounds that README.md counts, and the one that it shows."""


def on_ground(gait: str) -> dict[str, Any]:
    """Values of README's walk: NPD behind RABBIT's encoders, tuned for the ground by the searches of the
    findings on this gait, on ground of 30 mm.
    """
    (row,) = (
        r
        for r in comparison.best_of(comparison.settings())
        if (r["hardware"], r["gait"], r["tuning"], r["controller"])
        == ("rabbit", gait, "ground", "NPD")
    )
    tables = comparison.tables_of("rabbit", "ground", [row])
    (case,) = tables["cases"].values()
    more = {"run": {"impacts": 12}, "ground": {"step_height": 0.03}}
    return searches.merge(tables["base"], case, more)


def outcomes(gait: str) -> Counter[str]:
    """How README's walks on the grounds SEEDS end."""
    values = read_study({"name": gait, "base": on_ground(gait)}).base
    return Counter(row["outcome"] for row in run_trials([{**values, SEED: i} for i in SEEDS]))


def headline() -> None:
    """README's picture: the same ground with two gaits."""
    walks = {
        name: walk_scenario(Scenario(**searches.merge(on_ground(gait), {"run": {"seed": SHOWN}})))
        for name, gait in (("v0.6", "v0.6"), ("gait for rough ground", "rough"))
    }
    moving_picture(IMAGES / "ground.gif", walks, Clip(start=3.6, stop=5.9, fps=10.0, apart=True))


def moving_picture(path: Path, walks: dict[str, Any], clip: Clip) -> None:
    """The walks side by side: the last one feasible, the others not finished."""
    *others, last = walks.values()
    assert last.feasibility.outcome == "feasible"
    assert not any(walk.trajectory.status.ok for walk in others)
    write_moving_picture(path, walks, clip)
    with Image.open(path) as picture:
        frames = []
        for i in range(picture.n_frames):
            picture.seek(i)
            frames.append(picture.convert("RGB"))
    same = frames[len(frames) // 4].quantize(32)  # a frame with the push in it
    frames = [frame.quantize(palette=same, dither=Image.Dither.NONE) for frame in frames]
    times = [round(1000.0 / clip.fps)] * (len(frames) - 1) + [1500]
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=times, loop=0)


def zero_picture() -> Figure:
    """What the zero dynamics say of RABBIT at 0.8 m/s."""
    biped = Biped.load("rabbit", "identified-bare")
    report = zero_report(biped, load_gait("v0.8", biped).constraint)
    return zero_dynamics_figure(report)


def rough_picture() -> Figure:
    """The map of v0.6 on rough ground, with the steps of a walk over random heights of 0.97 H."""
    biped = Biped.load("rabbit")
    gait = load_gait("v0.6", biped)
    h = continued(gait.constraint)
    law = ReferenceReset(NPDController(h))
    ground = rough_ground(Walker(biped, law), gait)
    heights = np.random.default_rng(1).uniform(-1.0, 1.0, 40) * 0.97 * ground.reach().height
    result = walk(Walker(biped, law, ground_steps=stepped(-heights)), gait, impacts=40)
    assert result.feasibility.outcome == "feasible"
    steps = []
    for arc, height in zip(result.trajectory.arcs, heights, strict=True):
        q, v = arc.x[:, : biped.n], arc.x[:, biped.n : 2 * biped.n]
        s = h.rate * (q @ biped.phase - h.theta_plus)
        k = int(np.searchsorted(s, law.share))
        steps.append((height, 0.5 * biped.angular_momentum(q[k], v[k]) ** 2))
    return rough_ground_figure(ground, steps)


def main() -> None:
    headline()
    write_bytes(IMAGES / "rough_ground.svg", render(rough_picture(), "svg"))
    for name, (values, cases, clip) in PICTURES.items():
        walks = {x: walk_scenario(Scenario(law, **values)) for x, law in cases.items()}
        moving_picture(IMAGES / f"{name}.gif", walks, clip)
    write_bytes(IMAGES / "zero.svg", render(zero_picture(), "svg"))


if __name__ == "__main__":
    main()
