"""The numbers a figure shows, as a small JSON file beside it, and how two such files differ.

Pictures cannot be compared as bytes: another version of matplotlib or of a font changes all of
them. A picture in the documentation therefore has a file with the numbers that its reader would
read off, and a check draws the figure anew and compares (`docs/check_pictures.py`).

Of a line these are its least and largest value within the limits of its panel, and its values at
fixed shares of the panel's width. They depend neither on where the nodes of a walk are nor on how
the line was thinned.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from typing import TypeGuard

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.container import BarContainer, ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from numpy.typing import ArrayLike

from biped_adrc.types import Array

SHARES = (0.137, 0.293, 0.487, 0.617, 0.831)
"""Where a line is sampled, as shares of the panel's width from the left."""
TOLERANCE = 0.01
"""By which two numbers may differ, as a share of the largest in their list."""
SMALL = 1e-3
"""Share of the largest number of a panel below which differences count as nothing."""

Numbers = dict[str, object]
"""Plain values by name, ready for JSON."""


def numbers_of(figure: Figure) -> Numbers:
    """The numbers of a figure: {"panels": [...]}, a dict for each panel.

    A panel has its labels, lines, bars, marks with their intervals, outlines of patches, values of
    maps and the texts written into them; what it does not have is left out. Lines, bars and marks
    go by their labels in the legend, those without a label are skipped.
    """
    return {"panels": [_panel(axes) for axes in figure.axes]}


def _panel(axes: Axes) -> Numbers:
    """The numbers of one panel."""
    found: Numbers = {"x": axes.get_xlabel(), "y": axes.get_ylabel()}
    if axes.get_title(loc="left"):
        found["title"] = axes.get_title(loc="left")
    lines = {str(line.get_label()): line for line in axes.get_lines() if _named(line)}
    data = axes.transData  # axhline's lines are in other coordinates: limits, no data
    drawn = {name: _line(axes, x) for name, x in lines.items() if x.get_transform() == data}
    bars = {
        str(bar.get_label()): rounded([_size(bar, patch) for patch in bar.patches])
        for bar in axes.containers
        if isinstance(bar, BarContainer)
    }
    marks = {
        str(c.get_label()): _marks(c)
        for c in axes.containers
        if isinstance(c, ErrorbarContainer) and not str(c.get_label()).startswith("_")
    }
    grouped = {id(p) for c in axes.containers if isinstance(c, BarContainer) for p in c.patches}
    loose = [patch for patch in axes.patches if id(patch) not in grouped]
    arrays = [c.get_array() for c in axes.collections if c.get_array() is not None]
    maps = [rounded(np.ravel(np.ma.filled(a, np.nan))) for a in arrays if a is not None]
    cells = any(isinstance(c, QuadMesh) for c in axes.collections)
    texts = [t.get_text() for t in axes.texts] if cells else []
    parts = {
        "lines": drawn,
        "bars": bars,
        "marks": marks,
        "patches": _extents(loose),
        "maps": maps,
        "texts": texts,
    }
    return found | {name: part for name, part in parts.items() if part}


def _named(artist: Line2D) -> bool:
    """Whether a line has a label; matplotlib gives others one that begins with an underscore."""
    return not str(artist.get_label()).startswith("_")


def _size(bar: BarContainer, patch: Rectangle) -> float:
    """What a bar shows: its length along the axis of values."""
    return float(patch.get_width() if bar.orientation == "horizontal" else patch.get_height())


def _marks(found: ErrorbarContainer) -> Numbers:
    """Where the marks are, and from where to where their lines along x go."""
    points, _, bars = found.lines
    x, y = (np.asarray(values, dtype=float) for values in points.get_data())
    ends = np.array([s[:, 0] for bar in bars for s in bar.get_segments()]).reshape(-1, 2)
    numbers: Numbers = {"x": rounded(x), "y": rounded(y)}
    return numbers | {"from": rounded(ends[:, 0]), "to": rounded(ends[:, 1])} if bars else numbers


def _extents(patches: list[Patch]) -> list[float | None]:
    """[left, bottom, right, top] of all patches together, in data coordinates; empty for none."""
    boxes = [patch.get_path().get_extents(patch.get_patch_transform()).extents for patch in patches]
    if not boxes:
        return []
    low, high = np.min(boxes, axis=0), np.max(boxes, axis=0)
    return rounded([low[0], low[1], high[2], high[3]])


def _line(axes: Axes, line: Line2D) -> Numbers:
    """What a line shows within the limits of its panel; empty for a line outside of them.

    For a function of x: range of y and samples at `SHARES`, by linear interpolation. For a curve
    that turns back, such as a phase portrait: ranges of x and y, as there is no y at a given x.
    """
    x, y = (np.asarray(values, dtype=float) for values in line.get_data())
    known = np.isfinite(x) & np.isfinite(y)
    x, y = x[known], y[known]
    low, high = sorted(axes.get_xlim())
    within = (x >= low) & (x <= high)
    if np.all(np.diff(x) >= 0.0) and len(x) > len(SHARES):
        ends = [t for t in (low, high) if x[0] <= t <= x[-1]]
        shown = np.concatenate((y[within], np.interp(ends, x, y)))
        at = low + np.array(SHARES) * (high - low)
        samples = np.interp(at, x, y)[(at >= x[0]) & (at <= x[-1])]
        return {"y": _range(shown), "samples": rounded(samples)} if len(shown) else {}
    return {"y": _range(y[within]), "x": _range(x[within])} if within.any() else {}


def _range(values: Array) -> list[float | None]:
    """[least, largest] of the values."""
    return rounded([values.min(), values.max()])


def rounded(values: ArrayLike) -> list[float | None]:
    """The values, of any shape (...,), as a flat list to five significant digits, None for what is not
    finite.
    """
    flat = np.ravel(np.asarray(values, dtype=float))
    return [float(f"{v:.5g}") if math.isfinite(v) else None for v in flat]


def as_text(numbers: Numbers) -> str:
    """The numbers as JSON; every panel has a line of its own, so that a difference shows which one it is in."""
    parts = []
    for name, value in numbers.items():
        body = json.dumps(value, ensure_ascii=False)
        if isinstance(value, list) and value and isinstance(value[0], dict):
            lines = ",\n".join("  " + json.dumps(item, ensure_ascii=False) for item in value)
            body = f"[\n{lines}\n ]"
        parts.append(f" {json.dumps(name, ensure_ascii=False)}: {body}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def differences(old: object, new: object, tolerance: float = TOLERANCE) -> list[str]:
    """Where two `Numbers` differ by more than the tolerance, one sentence each; empty where they agree.

    old: of the file; new: of the figure as it is drawn now. Numbers of one list are compared with
    the largest of it, samples of a line with the largest of the line. What is below `SMALL` of the
    largest of its panel counts as nothing: it is not visible.
    """
    return list(_compared("", old, new, tolerance, 0.0, 0.0))


def _compared(
    where: str, old: object, new: object, tolerance: float, scale: float, floor: float
) -> Iterator[str]:
    """Differences below one place of the two trees; `where` names it, in words.

    tolerance [1]: as a share of `scale`, the largest magnitude beside these values, or of `floor`,
    the least that can be told apart in this panel.
    """
    if isinstance(old, Mapping) and isinstance(new, Mapping):
        if "lines" in old:
            floor = SMALL * _largest([old["lines"], new.get("lines")])
        for name in dict.fromkeys([*old, *new]):
            at = f"{where}, {name}" if where else str(name)
            if name not in old or name not in new:
                yield f"{at}: is {'no longer' if name in old else 'not yet'} drawn"
                continue
            of = [old.get("y"), new.get("y")] if name == "samples" else [old[name], new[name]]
            yield from _compared(at, old[name], new[name], tolerance, _largest(of), floor)
    elif isinstance(old, list) and isinstance(new, list):
        if len(old) != len(new):
            yield f"{where}: {len(old)} in the file, {len(new)} now"
            return
        for k, (one, other) in enumerate(zip(old, new, strict=True), start=1):
            yield from _compared(f"{where} {k}", one, other, tolerance, scale, floor)
    elif _number(old) and _number(new):
        if not abs(new - old) <= tolerance * max(scale, abs(old), abs(new), floor):
            yield f"{where}: {old:g} in the file, {new:g} now"
    elif old != new:
        yield f"{where}: {old!r} in the file, {new!r} now"


def _number(value: object) -> TypeGuard[float]:
    """Whether a value is a number; True and False are none."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def _largest(value: object) -> float:
    """The largest magnitude inside, at any depth; 0 where there is no number. Positions x have no part
    in it.
    """
    if isinstance(value, Mapping):
        return max((_largest(v) for name, v in value.items() if name != "x"), default=0.0)
    if isinstance(value, list):
        return max((_largest(v) for v in value), default=0.0)
    return abs(float(value)) if _number(value) else 0.0
