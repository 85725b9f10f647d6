"""One style for all figures: settings of matplotlib, colours, line styles, and how a figure becomes a file.

The colours are the palette of Okabe and Ito, which readers with any colour vision can tell apart. Most lines,
points and bars have a dash, marker or hatch besides their colour, so that figures can also be read in grey.
Sizes of arrows are here too, as the views from the side and in Meshcat share them.

Figures are `matplotlib.figure.Figure` objects made by `with new_figure(..) as figure:`; pyplot and its global
state are not used, so a notebook's own settings are not changed, and do not change the figures.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from importlib.resources import files
from pathlib import Path

import matplotlib as mpl
import matplotlib.style
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.typing import LineStyleType

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import write_bytes
from biped_adrc.core.types import Array

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Blue, vermillion, bluish green, reddish purple, orange, sky blue, black (Okabe and Ito, 2008)."""
GREY = "#666666"
"""Colour of lines that are not data: limits, diagonals, reference lines."""
PUSH = "#F0E442"
"""Yellow, for the time in which a push acts."""
STANCE, SWING, TRUNK = "#0072B2", "#E69F00", "#333333"
"""Colours of stance leg, swing leg and trunk: blue, orange, dark grey; in grey print dark, light and black."""
REACTION, TORQUE = "#009E73", "#CC79A7"
"""Colours of the ground reaction, bluish green, and of a torque from outside, reddish purple."""
WEIGHT_LENGTH = 0.4
"""Length [m] of the arrow of a ground reaction that is as large as the robot's weight."""
LONGEST = 1.2
"""Longest arrow of a ground reaction [m]; that of a larger one is cut, and the picture says so."""
METRES_PER_NEWTON_METRE = 0.004
"""Radius of the ring that shows an external torque, per torque [m / N m]; the same for all robots."""
DASHES: tuple[LineStyleType, ...] = ("-", (0, (6, 1.5)), (0, (1.5, 1)), (0, (6, 1.5, 1, 1.5)))
"""Line styles for the first four colours of `PALETTE`; callers repeat them, so the fifth is as the first."""

_PATH = re.compile(rb'\bd="[^"]*"')
_LONG = re.compile(rb"-?\d+\.\d{3,}")

SETTINGS = str(files("biped_adrc.view") / "style.mplstyle")
"""File with this package's settings of matplotlib."""


def style() -> AbstractContextManager[None]:
    """Context in which matplotlib has this package's settings; afterwards they are as before.

    They start from matplotlib's defaults, so a user's matplotlibrc has no effect on the figures.
    """
    return mpl.style.context(SETTINGS, after_reset=True)


@contextmanager
def new_figure(width: float, height: float, title: str = "") -> Iterator[Figure]:
    """Context with an empty figure of width x height [inch], in this package's style; its layout keeps room for
    labels and legends.
    """
    with style():
        figure = Figure(figsize=(width, height), layout="constrained")
        if title:
            figure.suptitle(title)
        yield figure


def label(axes: Axes, x: str, y: str, title: str = "") -> None:
    """Set the labels x and y, which should have their units in brackets, and a title at the left if given."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if title:
        axes.set_title(title, loc="left")


def literal(text: str) -> str:
    """A text of somebody's file as matplotlib draws it: a dollar begins no formula."""
    return text.replace("$", r"\$")


def bent_arrow(radius: float, points: int = 30) -> Array:
    """Outline (2 points + 3, 2) [m] of an arrow bent around 0, counter-clockwise for a positive radius [m].

    Outer rim, head and inner rim, from -60 to 240 degrees: the opening below leaves a joint visible.
    """
    angle, tip = np.radians(np.linspace(-60.0, 200.0, points)), np.radians(240.0)
    rim = np.column_stack((np.cos(angle), np.sin(angle)))
    head = 1.3 * rim[-1], (np.cos(tip), np.sin(tip)), 0.7 * rim[-1]
    return np.vstack((1.12 * rim, head, 0.88 * rim[::-1])) * [radius, abs(radius)]


def named_cells(
    axes: Axes, rows: Sequence[str], columns: Sequence[str], rotation: float = 0.0
) -> None:
    """Prepare axes for a table drawn as cells, with the names of rows and columns as tick labels.

    Rows run from the top, columns from the left; cell (i, j) is at x = j, y = i. rotation [deg]: of column
    names.
    """
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    aligned = "right" if rotation else "center"
    axes.set_xticks(range(len(columns)), columns, rotation=rotation, ha=aligned)
    axes.set_yticks(range(len(rows)), rows)
    axes.grid(False)


def render(figure: Figure, kind: str, dpi: float = 150.0) -> bytes:
    """The figure as the bytes of a "png" or "svg" file, without the date (SVG) or the program's name (PNG).

    So the same figure gives the same bytes. dpi [1/inch]: of a PNG. Raises InputError for another kind.
    """
    if kind not in ("png", "svg"):
        raise InputError(f"a figure was asked for as '{kind}', expected 'png' or 'svg'")
    metadata = {"Date": None} if kind == "svg" else {"Software": None}
    buffer = io.BytesIO()
    with style():
        figure.savefig(buffer, format=kind, dpi=dpi, metadata=metadata)
    return _shortened(buffer.getvalue()) if kind == "svg" else buffer.getvalue()


def write_figure(path: Path, figure: Figure) -> None:
    """Write a figure as PNG or SVG, by the suffix of `path`.

    Raises InputError for another suffix, OutputError where the file cannot be written.
    """
    write_bytes(path, render(figure, path.suffix.lower().removeprefix(".")))


def _shortened(svg: bytes) -> bytes:
    """The SVG with the coordinates of its paths rounded to a hundredth of a point, for smaller files."""
    return _PATH.sub(lambda path: _LONG.sub(lambda n: b"%.2f" % float(n[0]), path[0]), svg)
