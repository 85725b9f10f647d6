"""The map of pushes: who walks on after a push, over its onset in the step, its amplitude and the joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from biped_adrc.errors import InputError
from biped_adrc.viz.style import label, new_figure, style

VERDICTS: dict[tuple[bool, bool], tuple[str, str, str]] = {
    (True, True): ("both walk", "#FFFFFF", ""),
    (False, True): ("only NPD falls", "#E69F00", "///"),
    (True, False): ("only ADRC falls", "#56B4E9", "..."),
    (False, False): ("both fall", "#555555", "xxx"),
}
"""(NPD finished, ADRC finished) -> text, colour, hatch; the hatches survive a print in grey."""


def push_map_figure(rows: Sequence[Mapping[str, Any]]) -> Figure:
    """One panel per torque limit; a cell per onset and (pattern, amplitude).

    rows: "onset_ms" [ms], "amplitude" [N m], "pattern", "torque_limit" [N m] or None for unlimited,
    "npd" and "adrc", True for a walk that finished. Raises InputError when there are no rows.
    """
    if not rows:
        raise InputError("the map of pushes has no cells; expected at least one row")
    limits = sorted({r["torque_limit"] for r in rows}, key=lambda v: (v is not None, v))
    kinds = list(dict.fromkeys((r["pattern"], r["amplitude"]) for r in rows))
    onsets = sorted({r["onset_ms"] for r in rows})
    with style():
        height = 1.7 + 0.2 * max(len(kinds), 4)
        figure = new_figure(1.8 + len(limits) * (1.4 + 0.38 * max(len(onsets), 5)), height)
        panels = figure.subplots(1, len(limits), squeeze=False, sharey=True)[0]
        for axes, limit in zip(panels, limits, strict=True):
            here = [r for r in rows if r["torque_limit"] == limit]
            _cells(axes, here, kinds, onsets)
            name = "unlimited torque" if limit is None else f"torque within {limit:g} N m"
            label(axes, "onset of the push in the step [ms]", "", f"{name}\n{_count(here)}")
        panels[0].set_ylabel("joints and amplitude of the push [N m]")
        handles = [Patch(fc=c, ec="black", hatch=h, label=t) for t, c, h in VERDICTS.values()]
        figure.legend(handles=handles, loc="outside lower center", ncols=4)
        return figure


def _cells(
    axes: Axes,
    rows: Sequence[Mapping[str, Any]],
    kinds: list[tuple[str, float]],
    onsets: list[float],
) -> None:
    for r in rows:
        x = onsets.index(r["onset_ms"]) - 0.5
        y = kinds.index((r["pattern"], r["amplitude"])) - 0.5
        _, colour, hatch = VERDICTS[bool(r["npd"]), bool(r["adrc"])]
        axes.add_patch(Rectangle((x, y), 1, 1, fc=colour, ec="black", lw=0.4, hatch=hatch))
    axes.set_xlim(-0.5, len(onsets) - 0.5)
    axes.set_ylim(len(kinds) - 0.5, -0.5)
    axes.set_xticks(range(len(onsets)), [f"{onset:g}" for onset in onsets])
    axes.set_yticks(range(len(kinds)), [f"{pattern}, {size:g}" for pattern, size in kinds])
    axes.grid(False)


def _count(rows: Sequence[Mapping[str, Any]]) -> str:
    """How many pushes threw each controller."""
    npd, adrc = (sum(not r[c] for r in rows) for c in ("npd", "adrc"))
    return f"NPD falls {npd}, ADRC {adrc} of {len(rows)}"
