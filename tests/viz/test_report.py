"""The report: what it states, that it escapes what it shows and stands alone."""

from __future__ import annotations

import re

import pytest

from biped_adrc.errors import InputError
from biped_adrc.model.biped import Biped
from biped_adrc.viz.report import report_html, write_report
from biped_adrc.viz.robot_figure import robot_figure
from biped_adrc.viz.style import render

SUMMARY = {
    "preset": "identified",
    "command": "biped-adrc reproduce --out <dir>",
    "versions": {"python": "3.11"},
    "figures_of_merit": [
        {
            "name": "a<b>",
            "published": "1 & 2",
            "measured": "3",
            "verdict": "reproduced",
            "note": '"',
        },
        {"name": "c", "published": "1", "measured": "2", "verdict": "not reproduced", "note": ""},
    ],
    "checks": [
        {"name": "energy", "kind": "law", "value": 1.23456e-12, "limit": "<= 1e-9", "holds": True},
        {"name": "x<y", "kind": "reproduced", "value": "inf", "limit": "<= 1", "holds": False},
    ],
    "tables": {
        "T <1>": {"columns": ["<col>", "v"], "rows": [["<script>alert(1)</script>", [0.5, None]]]}
    },
    "notes": ["<i>note</i>"],
}


def test_report_escapes_and_stands_alone(biped: Biped, tmp_path) -> None:
    svg = render(robot_figure(biped), "svg").decode()
    picture = tmp_path / "p.png"
    picture.write_bytes(render(robot_figure(biped), "png", dpi=30))
    text = report_html(SUMMARY, {"figure1": svg, "<other>": picture})
    assert text == report_html(SUMMARY, {"figure1": svg, "<other>": picture})
    for raw in ("<b>&", "a<b>", "<script", "<col>", "<i>", "x<y", "<dir>", "<other>"):
        assert raw not in text
    assert "&lt;script&gt;alert(1)" in text
    assert not re.search(r"https?:", text)
    assert set(re.findall(r'href="([^"]*)"', text)) == {"walk.html"}
    assert re.findall(r'src="([^;]*;base64),', text) == [
        "data:image/svg+xml;base64",
        "data:image/png;base64",
    ]
    assert text.count("<h1>") == 1
    assert text.count("<th scope") >= 12
    assert text.count("<section>") == text.count("</section>")


def test_report_states_the_verdicts(tmp_path) -> None:
    write_report(tmp_path / "report.html", SUMMARY, {}, animation=None)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "1 of 2 checks hold" in text
    assert "✗ does not hold" in text
    assert "✓ reproduced" in text
    assert "✗ not reproduced" in text
    assert "1.235e-12" in text
    assert "0.5, –" in text
    assert "href" not in text
    with pytest.raises(InputError, match="neither PNG nor SVG"):
        report_html(SUMMARY, {"f": "a drawing"})
