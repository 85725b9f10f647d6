"""The page of a comparison: one self-contained HTML file, made from its summary and figures."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from biped_adrc.viz import comparison_text as t
from biped_adrc.viz.pages import captions, data_uri, rendered

TITLE = "Which controller walks legally under what"


def comparison_html(summary: Mapping[str, Any], figures: Mapping[str, str]) -> str:
    """The text of the page; figures: name -> SVG text. The same summary gives the same text."""
    shown, cells = captions("comparison").items(), t.by_condition(summary["cells"])
    return rendered(
        "comparison",
        s=summary,
        figures=[(*said, data_uri(said[0], figures[n])) for n, said in shown if n in figures],
        title=TITLE,
        t=t,
        shares=[t.share_texts(cell) for cell in cells],
        medians=[t.median_texts(cell) for cell in cells],
        pushed=[t.push_texts(push) for push in t.by_direction(summary["pushes"])],
    )
