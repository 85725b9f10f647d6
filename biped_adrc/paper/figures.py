"""The figures of the reproduction: which signals each gets; the drawing is in `view`.

Drawing takes longer than some of the walks, so each figure is a `Task`, drawn by one of several processes.

    controllers      NPD (PD with decoupling of the inertia) and ADRC (with an observer of disturbances)
    headline runs    one walk of 25 impacts for each controller, with a push on the joints
    signals          angles, torques, errors, forces of a walk over time (`analysis.signals`)
    map of pushes    many short walks, which differ in onset, amplitude and joints of the push
    plan             what a reproduction computes: its presets (sets of masses of the robot RABBIT), the push of
                     the headline runs, and whether it is full (the whole map of pushes) or quick
"""

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from biped_adrc.analysis.feasibility import COUNTED
from biped_adrc.analysis.signals import Signals
from biped_adrc.core.files import write_bytes
from biped_adrc.core.processes import Task, run_tasks
from biped_adrc.core.types import PlainRecord
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS
from biped_adrc.model.biped import Biped
from biped_adrc.paper.pushes import LOST
from biped_adrc.paper.runs import PRELOADED, Runs
from biped_adrc.paper.scenarios import CONTROLLERS
from biped_adrc.scenario.recording import Walk
from biped_adrc.view.from_the_side.check_figure import check_figure
from biped_adrc.view.plots import figures
from biped_adrc.view.plots.study import map_figure
from biped_adrc.view.style import render


def draw_all(
    r: Runs, walks: Mapping[str, Walk], out: Path, workers: int | None = None
) -> dict[str, bytes]:
    """Write every figure to the folder `out` as .png and .svg; returns the SVG by name, for the report.

    r: all results. walks: the headline runs, by controller. workers: processes; one per core if None.
    """
    named = pictures(r, {c: walks[c].signals for c in CONTROLLERS})
    # PRELOADED: modules that are imported once for all processes; the `value` of a finished task is its result
    drawn = run_tasks(list(named.values()), workers, PRELOADED)
    result = {}
    for name, picture in zip(named, drawn, strict=True):
        png, svg = picture.value
        write_bytes(out / f"{name}.png", png)
        write_bytes(out / f"{name}.svg", svg)
        result[name] = svg
    return result


def pictures(r: Runs, signals: Mapping[str, Signals]) -> dict[str, Task[tuple[bytes, bytes]]]:
    """The figures of the paper and beyond, by file name, each as a task that returns it as (PNG, SVG).

    figure1 (the robot), figure4 to figure6 (the pushed walks) are those of the paper; the others show what it
    does not: the disturbance estimate, the ground's force, energies, multipliers of the return map, and the map
    of pushes, a figure for each preset, which only a full plan computes. r: all results. signals: of the pushed
    walks, by controller.
    """
    # window: start and stop of the push [s], the same under both controllers
    npd, adrc, window = signals["NPD"], signals["ADRC"], figures.push_window(signals["NPD"])
    # a quick plan has no multipliers of ADRC
    magnitudes = {c: r.multipliers[c].orbit.multipliers for c in CONTROLLERS if c in r.multipliers}
    biped = Biped.load("rabbit", r.plan.preset)
    mu = biped.description.friction_coefficient
    pushed = "ADRC under the push"
    inputs: dict[str, tuple[object, ...]] = {
        "figure1": (check_figure, biped),
        "figure4": (figures.tracking_figure, npd, "NPD under the push", window),
        "figure5": (figures.tracking_figure, adrc, pushed, window),
        "figure6": (figures.phase_figure, signals),
        "comparison": (figures.comparison_figure, signals, window),
        "disturbance": (figures.disturbance_figure, adrc, pushed, window),
        "ground": (figures.ground_figure, adrc, pushed, mu, 0.0, window),  # 0.0: level ground
        "energy": (figures.energy_figure, adrc, pushed, window),
        "multipliers": (figures.multiplier_figure, magnitudes, PUBLISHED_MULTIPLIERS),
    }
    for preset in r.plan.presets if r.plan.full else ():
        rows = [cell.row() for cell in r.cells if cell.push.preset == preset]
        inputs[f"push_map_{preset}"] = (push_map_figure, rows)
    return {name: Task(name, _rendered, arguments) for name, arguments in inputs.items()}


def push_map_figure(rows: Sequence[PlainRecord]) -> Figure:
    """Draw the map of pushes of one preset: a panel for each controller and torque limit, onset [ms] against
    joints and amplitude [N m]. rows: of each push its values and how the walks under it end, by the names of
    `PushCell.row`; "npd_word" and "adrc_word" are the outcomes.

    The number of a push is 1 if the walk makes all steps and is feasible, or would be but for the impulses at
    impact; 0.5 if it makes all steps and is infeasible; 0 if it does not make all steps; NaN, an empty cell, if
    the walk ends in another way at half of the integration step ("marginal").
    """
    # COUNTED and LOST: the outcomes that count as 1 and as 0; all that are not named here as 0.5
    ends = dict.fromkeys(COUNTED, 1.0) | dict.fromkeys(LOST, 0.0) | {"marginal": math.nan}
    panels: dict[str, list[tuple[float, str, float]]] = {}
    for c, r in itertools.product(CONTROLLERS, rows):
        limit = "unlimited" if r["torque_limit"] is None else f"{r['torque_limit']:g} N m"
        # amplitudes of equal width, so that the texts sort by number
        push = r["onset_ms"], f"{r['pattern']} {r['amplitude']:3.0f}"
        end = ends.get(r[f"{c.lower()}_word"], 0.5)
        panels.setdefault(f"{c}, {limit}", []).append((*push, end))
    columns = ((name, zip(*panel, strict=True)) for name, panel in panels.items())
    numbers = {name: (x, y, np.array(end)) for name, (x, y, end) in columns}
    names = "onset in the step [ms]", "joints, amplitude [N m]"
    # log=False: a linear scale of colours from 0 to 1
    return map_figure(numbers, names, "1 feasible, 0.5 makes all steps, 0 does not", log=False)


def _rendered(draw: Callable[..., Figure], *arguments: object) -> tuple[bytes, bytes]:
    """The figure that draw(*arguments) makes, as PNG and as SVG; the layout is computed once, for the PNG, so
    that both are alike.
    """
    figure = draw(*arguments)
    png = render(figure, "png")
    figure.set_layout_engine("none")
    return png, render(figure, "svg")
