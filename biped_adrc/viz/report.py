"""The report: one self-contained HTML page made from the summary of a reproduction and its figures."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from biped_adrc.errors import InputError
from biped_adrc.files import write_text

TITLES = {
    "figure1": "Figure 1: the robot and its coordinates",
    "figure4": "Figure 4: tracking, torque and error under NPD",
    "figure5": "Figure 5: tracking, torque and error under ADRC",
    "figure6": "Figure 6: limit cycles",
    "multipliers": "Multipliers of the return map",
    "return_map": "Return map",
    "push_map": "Map of pushes: which controller falls",
}
"""Headings of the figures by name; another name is its own heading."""

KINDS = {
    "law": "physics and numerics",
    "consistency": "what was built in",
    "reproduced": "what could have failed",
}

MAGIC = {b"\x89PNG": "image/png", b"<?xml": "image/svg+xml", b"<svg": "image/svg+xml"}


def write_report(
    path: Path,
    summary: Mapping[str, Any],
    figures: Mapping[str, str | Path],
    animation: str | None = "walk.html",
) -> None:
    """Write the page.

    summary: "preset", "command", "versions", "figures_of_merit", "checks", "tables" and "notes" as in
    summary.json; what is missing is left out. figures: name -> SVG text, or the path of an SVG or PNG
    file. animation: where the page links to. Raises InputError and OutputError.
    """
    write_text(path, report_html(summary, figures, animation))


def report_html(
    summary: Mapping[str, Any],
    figures: Mapping[str, str | Path],
    animation: str | None = "walk.html",
) -> str:
    """The text of the page of `write_report`."""
    sections = [
        _head(summary, animation),
        _merits(summary.get("figures_of_merit", [])),
        _checks(summary.get("checks", [])),
        *(_figure(name, source) for name, source in figures.items()),
        *(_reported(title, table) for title, table in summary.get("tables", {}).items()),
        _notes(summary.get("notes", [])),
        _versions(summary.get("versions", {})),
    ]
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta http-equiv="Content-Security-Policy" '
        "content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'\">\n"
        f"<title>Reproduction, preset {_text(summary.get('preset', ''))}</title>\n"
        f"<style>{STYLE}</style>\n</head>\n<body>\n<main>\n"
        + "\n".join(section for section in sections if section)
        + "\n</main>\n</body>\n</html>\n"
    )


def _text(value: Any) -> str:
    """A value as escaped text; numbers to four significant digits."""
    return html.escape(_plain(value))


def _plain(value: Any) -> str:
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, Mapping):
        return ", ".join(f"{key}: {_plain(item)}" for key, item in value.items())
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ", ".join(_plain(item) for item in value)
    return str(value)


def _table(
    caption: str, columns: Iterable[Any], rows: Iterable[Sequence[str]], shown: bool = True
) -> str:
    """A table; `rows` hold cells that are escaped already, the first one heads its row.

    shown: print the caption; without, it is for screen readers only.
    """
    title = f"<caption>{_text(caption)}</caption>" if shown else ""
    head = "".join(f'<th scope="col">{_text(column)}</th>' for column in columns)
    body = "\n".join(
        f'<tr><th scope="row">{row[0]}</th>' + "".join(f"<td>{c}</td>" for c in row[1:]) + "</tr>"
        for row in rows
    )
    return (
        f'<div class="wide" tabindex="0" role="region" aria-label="{_text(caption)}"><table>'
        f"{title}<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody>\n</table></div>"
    )


def _head(summary: Mapping[str, Any], animation: str | None) -> str:
    checks = summary.get("checks", [])
    failed = sum(not check["holds"] for check in checks)
    verdict = f"{len(checks) - failed} of {len(checks)} checks hold."
    tone = "bad" if failed else "good"
    link = ""
    if animation:
        link = f'<p><a href="{html.escape(animation)}">Watch the walk</a> (plays without a network).</p>'
    wall = summary.get("wall_time_s")
    took = f" It took {wall:.0f} s." if isinstance(wall, int | float) else ""
    return (
        "<header>\n<h1>The paper, reproduced</h1>\n"
        f"<p>Active disturbance rejection control with a GPI observer of a planar biped, preset "
        f"<b>{_text(summary.get('preset', ''))}</b>.{took}</p>\n"
        f'<p class="{tone}">{verdict}</p>\n'
        f"<p>Command: <code>{_text(summary.get('command', ''))}</code></p>\n{link}</header>"
    )


def _mark(text: str, good: bool) -> str:
    """A verdict whose meaning does not hang on its colour alone."""
    sign, tone = ("✓", "good") if good else ("✗", "bad")
    return f'<span class="{tone}">{sign} {_text(text)}</span>'


def _merits(merits: Sequence[Mapping[str, Any]]) -> str:
    if not merits:
        return ""
    rows = [
        [
            _text(m["name"]),
            _text(m["published"]),
            _text(m["measured"]),
            _mark(m["verdict"], not str(m["verdict"]).startswith("not")),
            _text(m.get("note", "")),
        ]
        for m in merits
    ]
    columns = ("figure of merit", "published", "measured", "verdict", "note")
    table = _table("Each published figure of merit beside ours", columns, rows)
    return f"<section>\n<h2>Published and measured</h2>\n{table}\n</section>"


def _checks(checks: Sequence[Mapping[str, Any]]) -> str:
    """One table per kind, in the order of KINDS; other kinds after them."""
    tables = []
    for kind in dict.fromkeys([*KINDS, *(check["kind"] for check in checks)]):
        rows = [
            [
                _text(c["name"]),
                _text(c["value"]),
                _text(c["limit"]),
                _mark("holds" if c["holds"] else "does not hold", c["holds"]),
            ]
            for c in checks
            if c["kind"] == kind
        ]
        if rows:
            caption = f"{kind}: {KINDS[kind]}" if kind in KINDS else kind
            tables.append(_table(caption, ("check", "value", "limit", "verdict"), rows))
    if not tables:
        return ""
    return "<section>\n<h2>Checks</h2>\n" + "\n".join(tables) + "\n</section>"


def _figure(name: str, source: str | Path) -> str:
    """The picture as a data URI: nothing in an SVG can run or clash with the page."""
    data = source.read_bytes() if isinstance(source, Path) else source.encode("utf-8")
    kinds = [kind for start, kind in MAGIC.items() if data.lstrip().startswith(start)]
    if not kinds:
        raise InputError(
            f"figure '{name}' is neither PNG nor SVG; give SVG text or a Path to a file"
        )
    title = _text(TITLES.get(name, name))
    uri = f"data:{kinds[0]};base64,{base64.b64encode(data).decode('ascii')}"
    return (
        f'<section>\n<h2>{title}</h2>\n<figure><img src="{uri}" alt="{title}"></figure>\n</section>'
    )


def _reported(title: str, table: Mapping[str, Any]) -> str:
    rows = [[_text(cell) for cell in row] for row in table["rows"]]
    return (
        f"<section>\n<h2>{_text(title)}</h2>\n{_table(title, table['columns'], rows)}\n</section>"
    )


def _notes(notes: Sequence[str]) -> str:
    if not notes:
        return ""
    items = "\n".join(f"<li>{_text(note)}</li>" for note in notes)
    return f"<section>\n<h2>Notes</h2>\n<ul>\n{items}\n</ul>\n</section>"


def _versions(versions: Mapping[str, Any]) -> str:
    if not versions:
        return ""
    rows = [[_text(name), _text(number)] for name, number in versions.items()]
    table = _table("What the numbers depend on", ("part", "version"), rows)
    return f"<section>\n<h2>Versions</h2>\n{table}\n</section>"


STYLE = """
body { margin: 0; font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; background: #fff; }
main { max-width: 68rem; margin: 0 auto; padding: 1.5rem; }
h1 { margin: 0 0 0.5rem; } h2 { margin: 2rem 0 0.5rem; font-size: 1.25rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 0.5rem 0 1rem; font-size: 0.875rem; }
caption { text-align: left; color: #444; padding-bottom: 0.25rem; }
th, td { border-bottom: 1px solid #ccc; padding: 0.3rem 0.6rem; text-align: left; vertical-align: top; }
thead th { border-bottom: 2px solid #555; } tbody th { font-weight: normal; }
td { font-variant-numeric: tabular-nums; overflow-wrap: break-word; max-width: 24rem; }
figure { margin: 0; } img { max-width: 100%; height: auto; }
code { background: #f2f2f2; padding: 0.1rem 0.3rem; overflow-wrap: anywhere; }
.good { color: #00593f; font-weight: 600; } .bad { color: #a33a00; font-weight: 600; }
a { color: #00508a; }
@media (prefers-color-scheme: dark) {
  body { color: #eee; background: #161616; } caption { color: #bbb; } th, td { border-color: #444; }
  code { background: #2a2a2a; } .good { color: #5fd3ac; } .bad { color: #ff9d66; } a { color: #7cc4ff; }
}
@media print { .wide { overflow: visible; } section { break-inside: avoid-page; } }
"""
