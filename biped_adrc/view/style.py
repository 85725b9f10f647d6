"""One style for all figures: settings of matplotlib, colours, line styles, and how a figure becomes a file.

The colours are the palette of Okabe and Ito, which readers with any colour vision can tell apart. Most lines,
points and bars have a dash, marker or hatch besides their colour, so that figures can also be read in grey.
The colours of the robot, and of the arrows of forces and torques on it, are in `view.colours`.

Figures are `matplotlib.figure.Figure` objects made by `with new_figure(..) as figure:`; pyplot and its global
state are not used, so a notebook's own settings are not changed, and do not change the figures.
"""

import io
import re
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from importlib.resources import files
from pathlib import Path

import matplotlib.style
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.typing import LineStyleType

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import write_bytes

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Blue, vermillion, bluish green, reddish purple, orange, sky blue, black (Okabe and Ito, 2008)."""
GREY = "#666666"
"""Colour of lines that are not data: limits, diagonals, reference lines."""
PUSH = "#F0E442"
"""Yellow, for the time in which a push acts."""
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
    return matplotlib.style.context(SETTINGS, after_reset=True)


@contextmanager
def new_figure(width: float, height: float, title: str = "") -> Iterator[Figure]:
    """Context with an empty figure of width x height [inch], in this package's style,
    with a title above if given.

    Its layout keeps room for labels and legends.
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
    """Escape the dollars in a text from a user's file, so that matplotlib does not read them as formulas."""
    return text.replace("$", r"\$")


def render(figure: Figure, kind: str, dpi: float = 150.0) -> bytes:
    """Encode a figure as the bytes of a "png" or "svg" file, without date (SVG) or name of the program (PNG).

    Without them the same figure has the same bytes every day. dpi [1/inch]: of a PNG. Raises InputError for
    another kind.
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
    """Round the coordinates in the paths of an SVG to a hundredth of a point, for a smaller file; only numbers
    with three decimals or more.
    """
    return _PATH.sub(lambda path: _LONG.sub(lambda n: b"%.2f" % float(n[0]), path[0]), svg)
