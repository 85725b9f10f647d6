"""The map of pushes: how each controller walks on after a push, over onset, amplitude and joints.

Drawn from the rows of `paper.push_map.PushCell`, of the reproduction with `--full` and of the
documentation. Each cell is cut by its diagonal and shows two controllers under the same push.
"""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Polygon

from biped_adrc.analysis.feasibility import COUNTED
from biped_adrc.core.types import PlainRecord
from biped_adrc.view.style import label, named_cells, new_figure

FATES: dict[str, tuple[str, str, str]] = {
    "feasible": ("walks on, feasible", "#FFFFFF", ""),
    "but_impact": ("walks on, feasible but for the impact", "#E8E8E8", "/"),
    "infeasible": ("makes all steps, beyond friction or torque", "#F0E442", "///"),
    "pulled": ("makes all steps, the ground would have had to pull", "#E69F00", "..."),
    "fell": ("falls", "#555555", "xxx"),
    "ended": ("ends otherwise: singular, diverged, stalled", "#CC79A7", "\\\\\\"),
    "marginal": ("the step of the method decides", "#56B4E9", "++"),
}
"""Outcome of a walk -> text of the legend, colour, hatch; the hatches tell them apart in a grey print too."""


def push_map_figure(rows: Sequence[PlainRecord]) -> Figure:
    """Draw which pushes each controller survives: a panel for each torque limit, a cell for each push.

    Columns are onsets, rows (pattern, amplitude); the upper left half of a cell is NPD, the lower right half
    ADRC. rows: "onset_ms" [ms], "amplitude" [N m], "pattern", "torque_limit" [N m] or None for unlimited,
    "npd_word" and "adrc_word" of `FATES`. Panels go from unlimited torque to the highest limit, rows of cells
    are in the order of the data. The title of a panel counts the pushes that are feasible, the impact aside.
    """
    limits = sorted({r["torque_limit"] for r in rows}, key=lambda v: (v is not None, v))
    kinds = list(dict.fromkeys((r["pattern"], r["amplitude"]) for r in rows))
    onsets = sorted({r["onset_ms"] for r in rows})
    height = 2.1 + 0.2 * max(len(kinds), 4)
    with new_figure(1.8 + len(limits) * (1.4 + 0.38 * max(len(onsets), 5)), height) as figure:
        panels = figure.subplots(1, len(limits), squeeze=False, sharey=True)[0]
        for axes, limit in zip(panels, limits, strict=True):
            here = [r for r in rows if r["torque_limit"] == limit]
            _cells(axes, here, kinds, onsets)
            name = "unlimited torque" if limit is None else f"torque within {limit:g} N m"
            label(axes, "onset of the push in the step [ms]", "", f"{name}\n{_count(here)}")
        panels[0].set_ylabel("joints and amplitude of the push [N m]")
        shown = {r[key] for r in rows for key in ("npd_word", "adrc_word")}
        handles = [
            Patch(fc=c, ec="black", hatch=h, label=t)
            for word, (t, c, h) in FATES.items()
            if word in shown
        ]
        figure.legend(
            handles=handles, loc="outside lower center", ncols=1 if len(limits) < 2 else 2
        )
        return figure


def _cells(
    axes: Axes,
    rows: Sequence[PlainRecord],
    kinds: list[tuple[str, float]],
    onsets: list[float],
) -> None:
    """Draw the cells of one panel, columns by onset [ms], rows by (pattern, amplitude [N m])."""
    for r in rows:
        x = onsets.index(r["onset_ms"]) - 0.5
        y = kinds.index((r["pattern"], r["amplitude"])) - 0.5
        upper = [(x, y), (x + 1, y), (x, y + 1)]  # the axis of y points down
        lower = [(x + 1, y), (x + 1, y + 1), (x, y + 1)]
        for key, corners in (("npd_word", upper), ("adrc_word", lower)):
            _, colour, hatch = FATES[r[key]]
            axes.add_patch(Polygon(corners, fc=colour, ec="black", lw=0.4, hatch=hatch))
    names = [f"{pattern}, {size:g}" for pattern, size in kinds]
    named_cells(axes, names, [f"{onset:g}" for onset in onsets])


def _count(rows: Sequence[PlainRecord]) -> str:
    """Text that counts, for each controller, the pushes after which the walk is feasible, the impact aside."""
    npd, adrc = (sum(r[f"{c}_word"] in COUNTED for r in rows) for c in ("npd", "adrc"))
    return f"feasible, the impact aside: NPD {npd}, ADRC {adrc} of {len(rows)}"
