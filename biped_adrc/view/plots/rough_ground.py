"""The map of a walk on rough ground: the interval of y in which it stays, against the limits.

y = sigma^2 / 2 in the middle of a step, as a share of its value on level ground; h is the height of the next
foothold over the stance foot (`analysis.stride_map`). On stairs that change by the same h in each step the walk
comes to y*(h), so over heights in [-H, H] it stays between the least and the largest y*. A step from (h, y) is
walked where no limit is broken.
"""

from collections.abc import Iterable

import numpy as np
from matplotlib.figure import Figure

from biped_adrc.analysis.rough_ground import RoughGround
from biped_adrc.core.types import Array
from biped_adrc.view.plots.zero_dynamics import DOMAIN
from biped_adrc.view.style import DASHES, GREY, PALETTE, label, new_figure

WORST = 40
"""Number of steps of the worst ground that is drawn."""


def rough_ground_figure(ground: RoughGround, steps: Iterable[tuple[float, float]] = ()) -> Figure:
    """Draw y*(h), the steps that keep all limits, the interval at H, and the worst ground within [-H, H].

    steps: of walks, (h [m], y [kg^2 m^4/s^2]) each, as dots.
    """
    m, reach = ground.map, ground.reach()
    level, h = m.steady[m.level], 1e3 * m.heights
    lows, highs = (np.array([x[i] for x in ground.within.values()]) for i in (0, 1))
    low, high = np.max(lows, axis=0) / level, np.min(highs, axis=0) / level
    with new_figure(6.0, 4.0) as figure:
        axes = figure.subplots()
        top = 1.3 * max(y / level for y in ground.interval(min(1.5 * reach.height, m.heights[-1])))
        axes.fill_between(h, low, np.minimum(high, top), color=DOMAIN, lw=0, label="walked")
        axes.plot(h, m.steady / level, color=PALETTE[0], label="y*, the same h in each step")
        for bound in ground.interval(reach.height):
            axes.axhline(bound / level, color=GREY, ls=DASHES[1], lw=0.8)
        worst = worst_steps(ground, reach.height)
        for points, mark, colour, size, name in (
            (worst, "o", PALETTE[1], 4, "worst ground"),
            (list(steps), ".", "black", 3, "walks"),
        ):
            x, y = np.array(points).reshape(-1, 2).T
            if len(y):
                axes.plot(1e3 * x, y / level, mark, color=colour, ms=size, label=name)
        for end in (-reach.height, reach.height):
            axes.axvline(1e3 * end, color=GREY, ls=":", lw=0.8)
        axes.set(xlim=(-2e3 * reach.height, 2e3 * reach.height), ylim=(0.0, top))
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
        after: Array = a * y + b
        i = int(np.argmin(after) if k < WORST // 2 else np.argmax(after))
        result.append(((-H, H)[i], y))
        y = float(after[i])
    return result
