"""Tables of plain text in columns of equal width."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest


def columns(rows: Sequence[Sequence[str]], least: int = 0, gap: int = 2) -> list[str]:
    """A line for each row; a row of one text is a line of its own and has no part in the widths.

    least, gap: width of the first column at least, and spaces between columns.
    """
    table = [row for row in rows if len(row) > 1]
    widths = [max(map(len, column)) for column in zip_longest(*table, fillvalue="")]
    widths[:1] = [max(width, least) for width in widths[:1]]
    return [
        (" " * gap).join(cell.ljust(w) for cell, w in zip(row, widths, strict=False)).rstrip()
        if len(row) > 1
        else "".join(row)
        for row in rows
    ]
