"""The report: one self-contained HTML page made from the summary of a reproduction and its figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

from biped_adrc.files import write_text
from biped_adrc.viz.meshcat_page import POLICY
from biped_adrc.viz.report_parts import frame, mark, picture, section, table, text

PAPER = (
    "J. Arcos-Legarda, J. Cortes-Romero, A. Tovar: Active Disturbance Rejection Control based on "
    "Generalized Proportional Integral Observer to Control a Bipedal Robot with Five Degrees of Freedom."
)

FIGURES = {
    "figure1": (
        "Figure 1: the robot and its coordinates",
        "Hips are relative to the torso, knees to the thigh, the torso to the vertical. "
        "Counter-clockwise is positive.",
    ),
    "figure4": (
        "Figure 4: NPD under the push",
        "The third row is the push. In the last row: how far the joints leave their references while it "
        "lasts, and how they come back. At the right, the first milliseconds after either edge of the push: "
        "NPD answers an error that has yet to grow.",
    ),
    "figure5": (
        "Figure 5: ADRC with GPI observer under the push",
        "The same push; mind the unit of the error. It comes and goes within milliseconds of either edge, as "
        "the two columns at the right show: the torque overshoots while the observer finds the push, and then "
        "answers it.",
    ),
    "figure6": (
        "Figure 6: limit cycles",
        "Theta against its rate. Lines that lie on one another are a periodic walk.",
    ),
    "comparison": (
        "The controllers side by side",
        "The push, the error before, under and after it on one logarithmic scale, and the milliseconds after "
        "either edge of the push. Where nothing pushes, both lines are at what the method leaves, below 1e-9 "
        "rad. Below: the size of the error, and what the motors gave for it.",
    ),
    "disturbance": (
        "What the observer sees",
        "Left: the total disturbance of (13) and its estimate. Then the torque the joints are pushed with, "
        "and the part of the estimate that the nominal model does not explain, as a torque; in the last two "
        "columns at either edge of the push, where the estimate overshoots and has settled after some 2 ms.",
    ),
    "ground": (
        "Ground reaction under the push, ADRC",
        "A foot would slip outside the cone and lift off below its tip. Impulses at impact are not in it.",
    ),
    "energy": (
        "Energy under the push, ADRC",
        "An impact takes kinetic energy; the motors have to give it back within the step.",
    ),
    "multipliers": (
        "Multipliers of the return map",
        "What lies inside the unit circle dies out from step to step. Numbers printed in the paper come from "
        "a regression and are no target.",
    ),
    "return_map": (
        "Return map",
        "The stairs lead from either end to where the map crosses the diagonal: the periodic walk.",
    ),
    "push_map": (
        "Map of pushes",
        "How each controller walks on, over when in the step the push comes, how strong it is and which "
        "joints it turns.",
    ),
}
"""Heading of each figure and what to look for in it, by the start of its name."""

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
    parts = {
        "walk": ("The walks", "" if animation is None else _walks(animation)),
        "claims": ("The claims of the paper", _claims(summary)),
        "figures": ("Figures", "\n".join(_figure(n, source) for n, source in figures.items())),
        "checks": ("Checks", _checks(summary.get("checks", []))),
        "tables": ("Tables", _tables(summary.get("tables", {}))),
        "notes": ("Notes", _list(summary.get("notes", []))),
        "settings": ("Settings and versions", _settings(summary)),
    }
    shown = {name: part for name, part in parts.items() if part[1]}
    links = "".join(f'<li><a href="#{n}">{text(title)}</a></li>' for n, (title, _) in shown.items())
    style = files("biped_adrc.viz").joinpath("report.css").read_text(encoding="utf-8")
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
        f"<title>The paper, replicated: preset {text(summary.get('preset', ''))}</title>\n"
        f'<style>{style}</style>\n</head>\n<body>\n<a class="skip" href="#content">to the content</a>\n'
        f'<main id="content">\n{_head(summary)}\n<nav aria-label="parts"><ul>{links}</ul></nav>\n'
        + "\n".join(section(name, title, body) for name, (title, body) in shown.items())
        + "\n</main>\n</body>\n</html>\n"
    )


def _head(summary: Mapping[str, Any]) -> str:
    checks = summary.get("checks", [])
    held = sum(bool(check["holds"]) for check in checks)
    verdict = mark(f"{held} of {len(checks)} checks hold.", held == len(checks))
    missing = summary.get("left_out", [])
    left_out = f"<p><b>Left out of this run:</b> {text('; '.join(missing))}.</p>" if missing else ""
    wall = summary.get("wall_time_s")
    took = f" It took {wall:.0f} s." if isinstance(wall, int | float) else ""
    return (
        "<header>\n<h1>The paper, replicated</h1>\n"
        f"<blockquote>{text(PAPER)}</blockquote>\n"
        f"<p>Robot parameters: preset <b>{text(summary.get('preset', ''))}</b>.{took} "
        f"Command: <code>{text(summary.get('command', ''))}</code></p>\n"
        f"<p>{verdict}</p>\n{left_out}{_list(summary.get('findings', []))}</header>"
    )


def _walks(animation: str) -> str:
    return (
        "<p>Both walks under the push, ADRC solid and NPD behind it. Space plays and pauses, the arrow keys "
        "go frame by frame, v changes the view; drag to look from elsewhere.</p>\n"
        + frame(animation)
    )


def _claims(summary: Mapping[str, Any]) -> str:
    """What the words mean, then one row for each claim."""
    claims = summary.get("claims", [])
    if not claims:
        return ""
    rows = [
        [_word(c[key]) if key == "word" else text(c[key]) for key in CLAIM_COLUMNS] for c in claims
    ]
    words = summary.get("claims_words", {})
    meaning = "".join(f"<li><b>{text(word)}</b>: {text(m)}</li>" for word, m in words.items())
    preface = text(summary.get("claims_preface", ""))
    shown = table("Each claim of the paper, and the word for it", CLAIM_COLUMNS, rows)
    return f"<p>{preface}</p>\n<ul>{meaning}</ul>\n{shown}"


def _word(word: str) -> str:
    """A word, marked where it is a verdict for or against the claim."""
    for_or_against = {"replicated": True, "contradicted": False}
    return mark(word, for_or_against[word]) if word in for_or_against else text(word)


def _figure(name: str, source: str | Path) -> str:
    known = [key for key in FIGURES if name == key or name.startswith(f"{key}_")]
    title, caption = FIGURES[known[0]] if known else (name, "")
    rest = name.removeprefix(known[0]).replace("_", " ").strip() if known else ""
    return picture(f"{title}, {rest}" if rest else title, caption, source)


def _checks(checks: Sequence[Mapping[str, Any]]) -> str:
    """One table per kind, in the order of KINDS; other kinds after them."""
    tables = []
    for kind in dict.fromkeys([*KINDS, *(check["kind"] for check in checks)]):
        rows = [
            [
                text(c["name"]),
                text(c["value"]),
                text(c["limit"]),
                mark("holds" if c["holds"] else "does not hold", c["holds"]),
            ]
            for c in checks
            if c["kind"] == kind
        ]
        if rows:
            caption = f"{kind}: {KINDS[kind]}" if kind in KINDS else kind
            tables.append(table(caption, ("check", "value", "limit", "verdict"), rows))
    return "\n".join(tables)


def _tables(tables: Mapping[str, Any]) -> str:
    return "\n".join(
        table(title, found["columns"], [[text(cell) for cell in row] for row in found["rows"]])
        for title, found in tables.items()
    )


def _list(items: Sequence[str]) -> str:
    if not items:
        return ""
    return "<ul>\n" + "\n".join(f"<li>{text(item)}</li>" for item in items) + "\n</ul>"


def _settings(summary: Mapping[str, Any]) -> str:
    """What was asked for, what the numbers depend on, and what took how long."""
    found = {
        "settings": ("setting", "value", "What was asked for"),
        "versions": ("part", "version", "What the numbers depend on"),
        "seconds": ("task", "seconds", "Time by task"),
    }
    parts = []
    for key, (left, right, caption) in found.items():
        entries = summary.get(key, {})
        if entries:
            rows = [[text(name), text(value)] for name, value in entries.items()]
            shown = table(caption, (left, right), rows)
            parts.append(f"<details><summary>{text(caption)}</summary>\n{shown}\n</details>")
    return "\n".join(parts)
