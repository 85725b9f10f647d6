"""Make the picture README.md opens with, and those of the pages. Run: python docs/make_pictures.py"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from PIL import Image

from biped_adrc.analysis.zero_report import zero_report
from biped_adrc.core.files import write_bytes
from biped_adrc.gait.gait import load_gait
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.view.from_the_side.moving_picture import write_moving_picture
from biped_adrc.view.placement import Clip
from biped_adrc.view.plots.zero_dynamics import zero_dynamics_figure
from biped_adrc.view.style import render

IMAGES = Path(__file__).resolve().parent / "images"
PUSH = "q1,q2=-150@4:0.3-0.5"
"""A push on both hips under which NPD falls and ADRC walks on, each step of it feasible."""
CLIP = Clip(start=1.95, stop=3.62, fps=16.0, apart=True, slower=2.0)
TOP, BOTTOM, WORDS = 75, 545, (0, 40, 800, 58)
"""[px], of a frame: names and robots alone, without legend, curves and the line of errors."""


FOOTSTEP = {"name": "footstep", "inner": "NPD"}
ON_GROUND = {"hardware.period": "1 ms", "hardware.torque_limit": 150.0, "run.impacts": 12}
HELD = {"shape": "hip force", "force": 14.4, "direction": "180 deg", "steps": (5, 99)}
FOOTSTEPS: dict[str, tuple[dict[str, Any], dict[str, Any], Clip]] = {
    "hip": (
        {"gait": "v0.5", "pushes": [HELD]},
        {
            "stride PI": {"name": "stride PI", "inner": "NPD"},
            "footstep": {**FOOTSTEP, "step": 0.25},
        },
        Clip(start=1.8, stop=4.6, fps=12.0, apart=True),
    ),
    "ground": (
        {"gait": "v0.6", "gait.continued": True, "ground.step_height": "20 mm", "run.seed": 11},
        {"NPD": {"name": "NPD"}, "footstep": {**FOOTSTEP, "speed": 0.6, "step": 0.38}},
        Clip(start=2.4, stop=7.2, fps=12.0, apart=True),
    ),
    "stones": (
        {"gait": "v0.6", "ground.stone_range": (0.2, 0.6), "run.seed": 8},
        {"footstep": {**FOOTSTEP, "speed": 0.5, "step": 0.4}},
        Clip(start=0.5, stop=6.0, fps=12.0),
    ),
}
"""By picture: the scenario, the controllers, and what is shown."""


def footstep_picture(path: Path, values: dict[str, Any], cases: dict[str, Any], clip: Clip) -> None:
    """The footstep controller, feasible, beside one that does not walk on, where there is one."""
    walks = {
        name: walk_scenario(Scenario(controller, **ON_GROUND | values))
        for name, controller in cases.items()
    }
    assert walks["footstep"].feasibility.outcome == "feasible"
    write_moving_picture(path, walks, clip)


def push_picture(path: Path) -> None:
    """Both controllers under the same push, from just before it until one robot lies on the ground."""
    values = {"gait": "v0.8", "hardware.torque_limit": 150.0, "pushes": PUSH, "run.impacts": 9}
    walks = {name: walk_scenario(Scenario(name, **values)) for name in ("NPD", "ADRC")}
    assert walks["ADRC"].feasibility.outcome == "feasible"
    assert walks["NPD"].feasibility.outcome == "fell"
    write_moving_picture(path, walks, CLIP)
    with Image.open(path) as picture:
        frames = []
        for i in range(picture.n_frames):
            picture.seek(i)
            frames.append(picture.convert("RGB").crop((0, TOP, picture.width, BOTTOM)))
            frames[-1].paste(frames[-1].getpixel((0, 0)), WORDS)
    same = frames[len(frames) // 4].quantize(32)  # a frame with the push in it
    frames = [frame.quantize(palette=same, dither=Image.Dither.NONE) for frame in frames]
    times = [62] * (len(frames) - 1) + [1500]
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=times, loop=0)


def zero_picture() -> Figure:
    """What the zero dynamics say of RABBIT at 0.8 m/s."""
    biped = Biped.load("rabbit", "identified-bare")
    report = zero_report(biped, load_gait("v0.8", biped).constraint)
    return zero_dynamics_figure(report)


def main() -> None:
    push_picture(IMAGES / "push.gif")
    for name, (values, cases, clip) in FOOTSTEPS.items():
        footstep_picture(IMAGES / f"footstep_{name}.gif", values, cases, clip)
    write_bytes(IMAGES / "zero.svg", render(zero_picture(), "svg"))


if __name__ == "__main__":
    main()
