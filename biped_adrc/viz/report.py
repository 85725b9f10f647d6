"""The report: one self-contained HTML page made from the summary of a reproduction and its figures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from biped_adrc.files import write_text
from biped_adrc.viz.pages import captions, data_uri, rendered

PAPER = (
    "J. Arcos-Legarda, J. Cortes-Romero, A. Tovar: Active Disturbance Rejection Control based on "
    "Generalized Proportional Integral Observer to Control a Bipedal Robot with Five Degrees of Freedom."
)
CLAIM_COLUMNS = ("claim", "where", "word", "number", "share", "convergence", "reason")
KINDS = {
    "reproduced": "what the paper claims and what could have failed",
    "law": "physics and numerics that hold whatever the paper says",
    "consistency": "what was built in and has to come out again",
}


def write_report(
    path: Path,
    summary: Mapping[str, Any],
    figures: Mapping[str, str | Path],
    animation: str | None = None,
) -> None:
    """Write the page.

    summary: as in summary.json; what is missing is left out. figures: name -> SVG text, or the path of an SVG
    or PNG file. animation: text of the page of `meshcat.animation_html`. Raises InputError and OutputError.
    """
    write_text(path, report_html(summary, figures, animation))


def report_html(
    summary: Mapping[str, Any],
    figures: Mapping[str, str | Path],
    animation: str | None = None,
) -> str:
    """The text of the page of `write_report`; the same summary gives the same text."""
    return rendered(
        "report",
        s=summary,
        figures=[_figure(name, source) for name, source in figures.items()],
        animation=animation,
        paper=PAPER,
        columns=CLAIM_COLUMNS,
        kinds=KINDS,
    )


def _figure(name: str, source: str | Path) -> tuple[str, str, str]:
    """Heading, what to look for, and the picture itself; of a map the preset is in the heading too."""
    known = captions("report")
    key = next((key for key in known if name == key or name.startswith(f"{key}_")), "")
    title, caption = known.get(key, (name, ""))
    rest = name.removeprefix(key).replace("_", " ").strip() if key else ""
    title = f"{title}, {rest}" if rest else title
    return title, caption, data_uri(title, source)
