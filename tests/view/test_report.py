"""The report: what it states, that it escapes what it shows and stands alone."""

from __future__ import annotations

import html
import re

import pytest

from biped_adrc.model.biped import Biped
from biped_adrc.view.from_the_side.check_figure import check_figure
from biped_adrc.view.pages import report_html
from biped_adrc.view.style import render

SUMMARY = {
    "preset": "identified",
    "command": "biped-adrc reproduce --out <dir>",
    "versions": {"python": "3.11"},
    "claims_preface": "no <data>",
    "claims_words": {"replicated": "held", "contradicted": "did not"},
    "claims": [
        {
            "claim": "a<b>",
            "where": "II",
            "word": "replicated",
            "number": "1 & 2",
            "share": "2 of 2",
            "reason": '"',
        },
        {
            "claim": "c",
            "where": "VI",
            "word": "contradicted",
            "number": "1",
            "share": "0 of 2",
            "reason": "",
        },
    ],
    "checks": [
        {"name": "energy", "kind": "law", "value": 1.23456e-12, "limit": "<= 1e-9", "holds": True},
        {"name": "x<y", "kind": "reproduced", "value": "inf", "limit": "<= 1", "holds": False},
    ],
    "tables": {
        "T <1>": {"columns": ["<col>", "v"], "rows": [["<script>alert(1)</script>", [0.5, None]]]}
    },
    "notes": ["<i>note</i>"],
    "findings": ["<found> 1"],
    "settings": {"pushes": ["q1=30@19:0.1-0.3"]},
    "seconds": {"numerics": 1.25},
}


@pytest.fixture(scope="module")
def svg(biped: Biped) -> bytes:
    return render(check_figure(biped), "svg")


ANIMATION = '<!DOCTYPE html><html><body><p id="a">"&amp;\'</p></body></html>'


def test_report_escapes_and_stands_alone(biped: Biped, svg: bytes) -> None:
    """SUMMARY has markup in texts of every kind: none of it is markup in the page. The page is the same twice,
    has no address of another, and holds its figures and the animation itself.
    """
    picture = render(check_figure(biped), "png", dpi=30)
    figures = {"figure1": svg, "<other>": picture}
    text = report_html(SUMMARY, figures, ANIMATION)
    assert text == report_html(SUMMARY, figures, ANIMATION)
    for raw in ("<b>&", "a<b>", "<script", "<col>", "<i>", "x<y", "<dir>", "<other>", "<found>"):
        assert raw not in text
    assert "&lt;script&gt;alert(1)" in text
    assert not re.search(r"https?:", text)
    assert all(link.startswith("#") for link in re.findall(r'href="([^"]*)"', text))
    assert re.findall(r'src="([^;]*;base64),', text) == [
        "data:image/svg+xml;base64",
        "data:image/png;base64",
    ]
    frame = re.search(r'<iframe title="[^"]+" sandbox="allow-scripts"[^>]*srcdoc="([^"]*)"', text)
    assert html.unescape(frame.group(1)) == ANIMATION


def test_report_states_verdicts_and_what_was_left_out() -> None:
    """One of the two checks of SUMMARY holds, one of its claims is replicated; numbers have four digits."""
    text = report_html({**SUMMARY, "left_out": ["the map"]}, {})
    for part in ("1 of 2 checks hold", "✗ does not hold", "✓ replicated", "1.235e-12", "the map"):
        assert part in text
