"""Numbers and lists in words, for the page of soft ground."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from soft_cells import Row


def rows_of(summary: Mapping[str, Any]) -> list[Row]:
    """The walks by column name."""
    return [dict(zip(summary["columns"], row, strict=True)) for row in summary["rows"]]


def bullets(items: Sequence[str]) -> str:
    """A list of Markdown, of texts that are Markdown."""
    return "\n".join(f"- {item}" for item in items)


def percent(part: int, whole: int) -> str:
    return f"{100.0 * part / whole:.0f} %" if whole else "–"


def out_of(part: int, whole: int) -> str:
    return f"{part} of {whole}" if whole else "–"


def number(x: float | None) -> str:
    return "–" if x is None else f"{x:.3g}"
