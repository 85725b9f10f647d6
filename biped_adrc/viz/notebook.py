"""A walk inside a notebook: its animation in a frame of its own and its figures, without a server."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from biped_adrc.viz.pages import data_uri, rendered
from biped_adrc.viz.style import render

HEIGHT = 480
"""[px] of the animation."""


def inline(summary: str, animation: str, figures: Sequence[Figure] = ()) -> str:
    """HTML of a cell's output: a line of text, the page `animation` in a frame, the figures below it."""
    uris = [data_uri("walk", render(figure, "png", dpi=80.0)) for figure in figures]
    return rendered("notebook", summary=summary, animation=animation, figures=uris, height=HEIGHT)
