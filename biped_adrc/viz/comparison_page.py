"""The page of a comparison: one self-contained HTML file, made from its summary and figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import Any

from biped_adrc.viz.comparison_text import (
    EQUAL,
    MEDIANS,
    PUSHES,
    SHARES,
    WHAT_COUNTS,
    by_condition,
    by_direction,
    equal_texts,
    median_texts,
    nominal_text,
    push_texts,
    said,
    share_texts,
)
from biped_adrc.viz.meshcat_page import POLICY
from biped_adrc.viz.report_parts import picture, section, table, text

CAPTIONS = {
    "legal": (
        "Who walks legally",
        "Share of the walks that make all steps legally with its interval of 95 % (Wilson); below it, smaller, "
        "the share that makes all steps at all.",
    ),
    "peak_error": (
        "Largest tracking error of the legal walks",
        "Medians over seeds with bootstrap intervals of 95 %. Hollow: no walk is legal, and the median is over "
        "those that make all steps. No mark: none makes them.",
    ),
    "rms_torque": (
        "What the motors give for it",
        "Root mean square of the torque over joints and time, of the same walks.",
    ),
    "cost_of_transport": (
        "Cost of transport",
        "Integral of |u|'|q_b'| by weight and distance, of the same walks. Chattering torques show here first.",
    ),
    "pushes": (
        "The largest push",
        "By bisection: torque on the joints named, for 0.2 s, early to late in the step. Filled: walked "
        "legally, hollow: all steps made; median over seeds, and a line over all of them. An arrow says at "
        "least: the highest torque tried was passed. The torso has no motor: what is pushed there no tracking "
        "controller can cancel.",
    ),
}
"""Heading of each figure and what to look for in it."""
TITLE = "Which controller walks legally under what"


def comparison_html(summary: Mapping[str, Any], figures: Mapping[str, str]) -> str:
    """The text of the page; figures: name -> SVG text. The same summary gives the same text."""
    shown = [name for name in CAPTIONS if name in figures]
    parts = {
        "equal": ("At equal bandwidth", _equal(summary)),
        "figures": ("Figures", "\n".join(picture(*CAPTIONS[n], figures[n]) for n in shown)),
        "table": ("The table", _cells(summary)),
        "pushes": ("Largest pushes", _pushes(summary["pushes"])),
        "who": ("Controllers and conditions", _who(summary)),
        "versions": ("Settings and versions", _settings(summary)),
    }
    style = files("biped_adrc.viz").joinpath("report.css").read_text(encoding="utf-8")
    count = summary["walks"]
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
        f"<title>{TITLE}</title>\n<style>{style}</style>\n</head>\n<body>\n"
        '<a class="skip" href="#content">to the content</a>\n<main id="content">\n'
        f"<header>\n<h1>{TITLE}</h1>\n"
        f"<p><strong>{text(summary['settings'])}</strong></p>\n"
        f"<p>{count} walks of RABBIT on the gait through the published x*, {summary['seeds']} seeds per "
        f"cell. Command: <code>{text(summary['command'])}</code></p>\n<p>{text(WHAT_COUNTS)}</p>\n"
        f"{_list(said(summary, equal=False))}</header>\n"
        + "\n".join(section(name, title, body) for name, (title, body) in parts.items())
        + "\n</main>\n</body>\n</html>\n"
    )


def _escaped(rows: Sequence[Sequence[str]]) -> list[list[str]]:
    return [[text(x) for x in row] for row in rows]


def _cells(summary: Mapping[str, Any]) -> str:
    cells = by_condition(summary["cells"])
    shares = _escaped([share_texts(cell) for cell in cells])
    medians = _escaped([median_texts(cell) for cell in cells])
    needs = "Shares of walks; what they need: medians over the walks that make all steps, 95 % intervals"
    return (
        f"<p>{text(nominal_text(summary['nominal']))}</p>\n"
        f"{table(needs, SHARES, shares)}\n"
        f"{table('Medians over legal walks, 95 % intervals', MEDIANS, medians)}"
    )


def _equal(summary: Mapping[str, Any]) -> str:
    equal = summary["equal_bandwidth"]
    if not equal:
        return ""
    words = "Observers at their own settings, and with all poles at one bandwidth; 95 % intervals"
    return (
        f"{table(words, EQUAL, _escaped(equal_texts(equal)))}\n{_list(said(summary, equal=True))}"
    )


def _pushes(pushes: Sequence[Mapping[str, Any]]) -> str:
    if not pushes:
        return ""
    rows = _escaped([push_texts(p) for p in by_direction(pushes)])
    return table("Between what the median over seeds, and all seeds, lie [N m]", PUSHES, rows)


def _who(summary: Mapping[str, Any]) -> str:
    return "\n".join(
        table(f"{kind.capitalize()} of the comparison", ("name", "what it is"), rows)
        for kind in ("controllers", "conditions")
        if (rows := [[text(name), text(words)] for name, words in summary[kind].items()])
    )


def _list(items: Sequence[str]) -> str:
    if not items:
        return "<p>No difference is carried by its test.</p>\n"
    return "<ul>\n" + "\n".join(f"<li>{text(item)}</li>" for item in items) + "\n</ul>"


def _settings(summary: Mapping[str, Any]) -> str:
    rows = [[text(k), text(v)] for k, v in {**summary["base"], **summary["versions"]}.items()]
    return table("What all walks share, and what the numbers depend on", ("name", "value"), rows)
