"""Tables of plain text in columns of equal width.

For texts that are printed, stored or compared as they are: the stability table, the report of the
zero dynamics. The commands print their own tables with `rich`, which fits them to the terminal.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest


def columns(rows: Sequence[Sequence[str]], least: int = 0, gap: int = 2) -> list[str]:
    """The rows of a table as lines of text, cells padded at the right to the width of their column.

    A row of one text is a line of its own, such as a heading between rows, and has no part in the
    widths. least: least width of the first column, in characters. gap: spaces between two columns.
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
