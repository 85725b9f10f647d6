"""What the studies of soft ground share: rows kept as they are found, and tables written into a page."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

Row = dict[str, Any]


def found(
    todo: Iterable[Mapping[str, Any]], judged: Callable[..., Row], kept: Path | None
) -> list[Row]:
    """The row of each point; those in `kept`, a file of JSON lines, are not computed again.

    A row holds its point under `point`, plain numbers by name.
    """
    lines = kept.read_text(encoding="utf-8").splitlines() if kept and kept.is_file() else []
    rows = {_key(row["point"]): row for row in map(json.loads, lines)}
    points = list(todo)
    for point in points:
        if _key(point) in rows:
            continue
        rows[_key(point)] = row = {"point": dict(point), **judged(**point)}
        print(json.dumps(row), flush=True)
        if kept:
            kept.parent.mkdir(parents=True, exist_ok=True)
            with kept.open("a", encoding="utf-8") as file:
                file.write(json.dumps(row) + "\n")
    return [rows[_key(point)] for point in points]


def _key(point: Mapping[str, Any]) -> str:
    return json.dumps(point, sort_keys=True)


def markdown(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table of Markdown; numbers as they are given."""
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def write_between(page: Path, name: str, text: str) -> None:
    """Put a text between the marks `<!-- NAME -->` and `<!-- end of NAME -->` of a page."""
    whole = page.read_text(encoding="utf-8")
    begin, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
    pattern = f"(?s)(?<={re.escape(begin)}\n).*(?={re.escape(end)})"
    page.write_text(re.sub(pattern, lambda _: text + "\n", whole), encoding="utf-8")
