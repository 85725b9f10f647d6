"""A walk inside a notebook: its animation in a frame of its own and its figures, without a server."""

from __future__ import annotations

import base64
import html
from collections.abc import Sequence

from matplotlib.figure import Figure

from biped_adrc.viz.style import render

HEIGHT = 480
"""[px] of the animation."""


def inline(summary: str, animation: str, figures: Sequence[Figure] = ()) -> str:
    """HTML of a cell's output: a line of text, the page `animation` in a frame, the figures below it."""
    pictures = "".join(
        f'<img alt="figure {k}" style="max-width:100%" src="data:image/png;base64,{_png(figure)}">'
        for k, figure in enumerate(figures, start=1)
    )
    return (
        f"<p>{html.escape(summary)}</p>"
        f'<iframe title="animation of the walk" sandbox="allow-scripts" loading="lazy" '
        f'style="width:100%;height:{HEIGHT}px;border:1px solid #ccc" '
        f'srcdoc="{html.escape(animation)}"></iframe>{pictures}'
    )


def _png(figure: Figure) -> str:
    return base64.b64encode(render(figure, "png", dpi=80.0)).decode("ascii")
