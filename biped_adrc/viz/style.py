"""One style for all figures: settings of matplotlib, colours, dashes, and the way to a file.

The colours are the palette of Okabe and Ito, which readers with any colour vision can tell apart;
every colour comes with a dash or a hatch of its own, so figures can also be read in grey. Sizes of
arrows are here too, as the views from the side and in Meshcat share them.

Figures are `matplotlib.figure.Figure` objects made inside `with style():`; pyplot and its global
state are not used, so a notebook's own settings neither change nor are changed.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.resources import files
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.typing import LineStyleType

from biped_adrc.errors import InputError
from biped_adrc.files import write_bytes

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Blue, vermillion, bluish green, reddish purple, orange, sky blue, black (Okabe and Ito, 2008)."""
GREY = "#666666"
"""Of what is not data: limits, diagonals, reference lines."""
PUSH = "#F0E442"
"""Yellow, for the window of a push."""
STANCE, SWING, TRUNK = "#0072B2", "#E69F00", "#333333"
"""Of legs and trunk: blue, orange, dark grey; dark, light and black in print."""
REACTION, TORQUE = "#009E73", "#CC79A7"
"""Bluish green and reddish purple: the ground reaction, a torque from outside."""
WEIGHT_LENGTH = 0.4
"""Length [m] of the arrow of a ground reaction as large as the robot's weight."""
METRES_PER_NEWTON_METRE = 0.004
"""Radius of the ring of an external torque [m / N m], the same for all robots."""
DASHES: tuple[LineStyleType, ...] = ("-", (0, (6, 1.5)), (0, (1.5, 1)), (0, (6, 1.5, 1, 1.5)))
"""Line styles in the order of `PALETTE`, repeated from the fifth colour on."""

_PATH = re.compile(rb'\bd="[^"]*"')
_LONG = re.compile(rb"-?\d+\.\d{3,}")

RC = mpl.rc_params_from_file(
    str(files("biped_adrc.viz") / "style.mplstyle"), use_default_template=False
)
"""Matplotlib's settings of this package, from style.mplstyle."""


@contextmanager
def style() -> Iterator[None]:
    """Context with matplotlib's settings of this package; afterwards they are what they were before.

    It starts from matplotlib's defaults, so a user's matplotlibrc has no part in the figures.
    """
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(RC)
        yield


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of width x height [inch] whose constrained layout makes room for labels and legends."""
    return Figure(figsize=(width, height), layout="constrained")


def label(axes: Axes, x: str, y: str, title: str = "") -> None:
    """Set the labels of both axes, with their units in brackets, and a title at the left."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if title:
        axes.set_title(title, loc="left")


def named_cells(
    axes: Axes, rows: Sequence[str], columns: Sequence[str], rotation: float = 0.0
) -> None:
    """Set up axes for a table of cells: rows from the top, columns from the left, cell (i, j) at x = j, y = i.

    rotation [deg]: of the names of the columns.
    """
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    aligned = "right" if rotation else "center"
    axes.set_xticks(range(len(columns)), columns, rotation=rotation, ha=aligned)
    axes.set_yticks(range(len(rows)), rows)
    axes.grid(False)


def render(figure: Figure, kind: str, dpi: float = 150.0) -> bytes:
    """The figure as the bytes of a file, "png" or "svg"; dates are left out, so the same figure gives
    the same bytes.

    dpi [1/inch]: of a PNG. Raises InputError for another kind.
    """
    if kind not in ("png", "svg"):
        raise InputError(f"a figure was asked for as '{kind}', expected 'png' or 'svg'")
    metadata = {"Date": None} if kind == "svg" else {"Software": None}
    buffer = io.BytesIO()
    with style():
        figure.savefig(buffer, format=kind, dpi=dpi, metadata=metadata)
    return _shortened(buffer.getvalue()) if kind == "svg" else buffer.getvalue()


def write_figure(path: Path, figure: Figure) -> None:
    """Write a figure as .png or .svg, by the suffix of `path`. Raises InputError and OutputError."""
    write_bytes(path, render(figure, path.suffix.lower().removeprefix(".")))


def _shortened(svg: bytes) -> bytes:
    """Coordinates of paths to a hundredth of a point, in place of a millionth."""
    return _PATH.sub(lambda path: _LONG.sub(lambda n: b"%.2f" % float(n[0]), path[0]), svg)
