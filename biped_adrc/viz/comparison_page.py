"""The page of a comparison: one self-contained HTML file, made from its summary and figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import Any

from biped_adrc.viz.meshcat_page import POLICY
from biped_adrc.viz.report_parts import picture, section, table, text

CAPTIONS = {
    "survival": (
        "Who makes all steps",
        "Share of the walks, and between what it lies with 95 % confidence (Wilson).",
    ),
    "peak_error": (
        "Largest tracking error of the walks that make all steps",
        "Medians over seeds with bootstrap intervals of 95 %. Where no walk survives there is no mark.",
    ),
    "rms_torque": (
        "What the motors give for it",
        "Root mean square of the torque over joints and time.",
    ),
    "cost_of_transport": (
        "Cost of transport",
        "Integral of |u|'|q_b'| by weight and distance. Chattering torques show here first.",
    ),
    "pushes": (
        "The largest push survived",
        "By bisection: torque on the joints named, for 0.2 s, early to late in the step. The torso has no "
        "motor: what is pushed there no tracking controller can cancel.",
    ),
}
"""Heading of each figure and what to look for in it."""


def comparison_html(summary: Mapping[str, Any], figures: Mapping[str, str]) -> str:
    """The text of the page; figures: name -> SVG text. The same summary gives the same text."""
    shown = [name for name in CAPTIONS if name in figures]
    parts = {
        "figures": ("Figures", "\n".join(picture(*CAPTIONS[n], figures[n]) for n in shown)),
        "table": ("The table", _cells(summary["cells"])),
        "pushes": ("Largest pushes", _pushes(summary["pushes"])),
        "who": ("Controllers and conditions", _who(summary)),
        "settings": ("Settings and versions", _settings(summary)),
    }
    style = files("biped_adrc.viz").joinpath("report.css").read_text(encoding="utf-8")
    count = summary["walks"]
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
        f"<title>Which controller survives what</title>\n<style>{style}</style>\n</head>\n<body>\n"
        '<a class="skip" href="#content">to the content</a>\n<main id="content">\n'
        "<header>\n<h1>Which controller survives what</h1>\n"
        f"<p>{count} walks of RABBIT on the gait through the published x*, {summary['seeds']} seeds per "
        f"cell. Command: <code>{text(summary['command'])}</code></p>\n"
        f"{_list(summary['findings'])}</header>\n"
        + "\n".join(section(name, title, body) for name, (title, body) in parts.items())
        + "\n</main>\n</body>\n</html>\n"
    )


def interval(found: Sequence[float] | None, digits: int = 2, factor: float = 1.0) -> str:
    """A number with its interval as text."""
    if found is None:
        return "–"
    value, low, high = (factor * x for x in found)
    return f"{value:.{digits}g} ({low:.{digits}g} to {high:.{digits}g})"


COLUMNS: dict[str, str] = {
    "peak_error": "largest error [rad]",
    "rms_torque": "rms torque [N m]",
    "cost_of_transport": "cost of transport",
    "speed_change": "change of speed",
    "peak_matched": "matched [rad/s^2]",
    "peak_unmatched": "unmatched [rad/s^2]",
}
"""Of the table, beside who, what and the share."""


def cell_texts(cell: Mapping[str, Any]) -> list[str]:
    """A row of the table as plain text."""
    falls = ", ".join(f"{n} {status.lower()}" for status, n in cell["falls"].items())
    share = interval([100 * x for x in cell["survived"]], 3) + " %"
    measures = [interval(cell[name]) for name in COLUMNS]
    return [cell["condition"], cell["controller"], share, *measures, falls or "–"]


HEADINGS = ("condition", "controller", "survive", *COLUMNS.values(), "others")


def _cells(cells: Sequence[Mapping[str, Any]]) -> str:
    ordered = sorted(cells, key=lambda c: _place(cells, c["condition"]))
    rows = [[text(x) for x in cell_texts(cell)] for cell in ordered]
    return table("Medians over the walks that make all steps, 95 % intervals", HEADINGS, rows)


def _place(cells: Sequence[Mapping[str, Any]], condition: str) -> int:
    return list(dict.fromkeys(c["condition"] for c in cells)).index(condition)


def _pushes(pushes: Sequence[Mapping[str, Any]]) -> str:
    if not pushes:
        return ""
    rows = [
        [
            text(x)
            for x in (
                p["direction"],
                p["phase"],
                p["controller"],
                ("at least " if p["beyond"] else "") + interval(p["push"], 3),
            )
        ]
        for p in sorted(pushes, key=lambda p: (p["direction"], p["phase"]))
    ]
    return table("Median over seeds [N m]", ("joints", "phase", "controller", "push"), rows)


def _who(summary: Mapping[str, Any]) -> str:
    return "\n".join(
        table(f"{kind.capitalize()} of the comparison", ("name", "what it is"), rows)
        for kind in ("controllers", "conditions")
        if (rows := [[text(name), text(words)] for name, words in summary[kind].items()])
    )


def _list(items: Sequence[str]) -> str:
    if not items:
        return ""
    return "<ul>\n" + "\n".join(f"<li>{text(item)}</li>" for item in items) + "\n</ul>"


def _settings(summary: Mapping[str, Any]) -> str:
    rows = [[text(k), text(v)] for k, v in {**summary["base"], **summary["versions"]}.items()]
    return table("What all walks share, and what the numbers depend on", ("name", "value"), rows)
