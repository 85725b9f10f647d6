"""Make the picture README.md opens with, and those of the pages. Run: python docs/make_pictures.py"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from PIL import Image

from biped_adrc.analysis.rough_ground import RoughGround, rough_ground
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
from biped_adrc.view.plots.zero_dynamics import DOMAIN, zero_dynamics_figure
from biped_adrc.view.style import DASHES, GREY, PALETTE, label, new_figure, render
from validation.findings import comparison, searches

IMAGES = Path(__file__).resolve().parent / "images"
WORST = 40
"""Number of steps of the worst ground that is drawn."""
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


def rough_ground_figure(ground: RoughGround, steps: Iterable[tuple[float, float]]) -> Figure:
    """Draw the map of a walk on rough ground: y*(h), the steps that keep all limits, the interval at H, and the
    worst ground within [-H, H].

    h is the height of the next foothold over the stance foot, y = sigma^2 / 2 in the middle of a step, as a
    share of its value on level ground (`analysis.stride_map`). On stairs that change by the same h in each step
    the walk comes to y*(h), so over heights in [-H, H] it stays between the least and the largest y*.

    steps: of walks, (h [m], y [kg^2 m^4/s^2]) each, as dots.
    """
    m, reach = ground.map, ground.reach()
    H = reach.height
    level, h = m.steady[m.level], 1e3 * m.heights
    lows, highs = (np.array([x[i] for x in ground.within.values()]) for i in (0, 1))
    low, high = np.max(lows, axis=0) / level, np.min(highs, axis=0) / level
    with new_figure(6.0, 4.0) as figure:
        axes = figure.subplots()
        top = 1.3 * max(y / level for y in ground.interval(min(1.5 * H, m.heights[-1])))
        axes.fill_between(h, low, np.minimum(high, top), color=DOMAIN, lw=0, label="walked")
        axes.plot(h, m.steady / level, color=PALETTE[0], label="y*, the same h in each step")
        for bound in ground.interval(H):
            axes.axhline(bound / level, color=GREY, ls=DASHES[1], lw=0.8)
        x, y = np.array(worst_steps(ground, H)).T
        axes.plot(1e3 * x, y / level, "o", color=PALETTE[1], ms=4, label="worst ground")
        x, y = np.reshape([*steps], (-1, 2)).T
        axes.plot(1e3 * x, y / level, ".", color="black", ms=3, label="walks")
        for end in (-H, H):
            axes.axvline(1e3 * end, color=GREY, ls=":", lw=0.8)
        axes.set(xlim=(-2e3 * H, 2e3 * H), ylim=(0.0, top))
        label(axes, "height of a step h [mm]", "y over y on level ground", f"H = {reach}")
        figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
        return figure


def worst_steps(ground: RoughGround, H: float) -> list[tuple[float, float]]:
    """(h, y) of WORST steps over heights in {-H, H}: first those that lead to the least y, then to the largest.

    H [m]; y [kg^2 m^4/s^2] in the middle of the step that ends on the height h.
    """
    m, result = ground.map, list[tuple[float, float]]()
    a, b = (np.interp([-H, H], m.heights, x) for x in (m.delta2, -m.delta2 * m.V_2 - m.V_1))
    y = float(m.steady[m.level])
    for k in range(WORST):
        after = a * y + b
        i = int(np.argmin(after) if k < WORST // 2 else np.argmax(after))
        result.append(((-H, H)[i], y))
        y = float(after[i])
    return result


def main() -> None:
    headline()
    write_bytes(IMAGES / "rough_ground.svg", render(rough_picture(), "svg"))
    for name, (values, cases, clip) in PICTURES.items():
        walks = {x: walk_scenario(Scenario(law, **values)) for x, law in cases.items()}
        moving_picture(IMAGES / f"{name}.gif", walks, clip)
    write_bytes(IMAGES / "zero.svg", render(zero_picture(), "svg"))


if __name__ == "__main__":
    main()
