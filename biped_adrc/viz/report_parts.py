"""Escaped pieces of the report: text, tables, figures, the frame of the animation."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from biped_adrc.errors import InputError

MAGIC = {b"\x89PNG": "image/png", b"<?xml": "image/svg+xml", b"<svg": "image/svg+xml"}


def text(value: Any) -> str:
    """A value as escaped text; numbers to four significant digits."""
    return html.escape(plain(value))


def plain(value: Any) -> str:
    """A value as text."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, Mapping):
        return ", ".join(f"{key}: {plain(item)}" for key, item in value.items())
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ", ".join(plain(item) for item in value)
    return str(value)


def table(caption: str, columns: Iterable[Any], rows: Iterable[Sequence[str]]) -> str:
    """A table that scrolls by itself; `rows` hold cells that are escaped already, the first heads its row."""
    head = "".join(f'<th scope="col">{text(column)}</th>' for column in columns)
    body = "\n".join(
        f'<tr><th scope="row">{row[0]}</th>' + "".join(f"<td>{c}</td>" for c in row[1:]) + "</tr>"
        for row in rows
    )
    return (
        f'<div class="wide" tabindex="0" role="region" aria-label="{text(caption)}"><table>'
        f"<caption>{text(caption)}</caption><thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody>\n"
        "</table></div>"
    )


def mark(words: str, good: bool) -> str:
    """A verdict whose meaning does not hang on its colour alone."""
    sign, tone = ("✓", "good") if good else ("✗", "bad")
    return f'<span class="{tone}">{sign} {text(words)}</span>'


def section(name: str, title: str, body: str) -> str:
    """A part of the page that can be linked to; nothing for an empty body."""
    if not body:
        return ""
    return f'<section id="{html.escape(name)}">\n<h2>{text(title)}</h2>\n{body}\n</section>'


def picture(title: str, caption: str, source: str | Path) -> str:
    """A figure as a data URI: nothing in an SVG can run or clash with the page. Raises InputError."""
    data = source.read_bytes() if isinstance(source, Path) else source.encode("utf-8")
    kinds = [kind for start, kind in MAGIC.items() if data.lstrip().startswith(start)]
    if not kinds:
        raise InputError(
            f"figure '{title}' is neither PNG nor SVG; give SVG text or a Path to a file"
        )
    uri = f"data:{kinds[0]};base64,{base64.b64encode(data).decode('ascii')}"
    return (
        f'<figure>\n<h3>{text(title)}</h3>\n<img src="{uri}" alt="{text(title)}">\n'
        f"<figcaption>{text(caption)}</figcaption>\n</figure>"
    )


def frame(page: str) -> str:
    """A page of the animation inside this one; it may run scripts and nothing else."""
    return (
        '<iframe title="animation of both walks" sandbox="allow-scripts" loading="lazy" '
        f'srcdoc="{html.escape(page)}"></iframe>'
    )
