"""What a hand did, as a table of text: a row for each sample from which on something else acts.

    sample,link,x [m],z [m],F_x [N],F_z [N],q1 [N m],q2 [N m],q3 [N m],q4 [N m],q5 [N m]
    200,torso,0.0,0.3,-60.0,10.0,,,,,
    250,,,,,,,,,,

(x, z) is the point of the link in its frame, (F_x, F_z) the force in the axes of the world, and q1..qN are
torques on the coordinates. An empty number is 0, and a row without a link says that nothing acts. Numbers are
read back to the same bits.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import NamedTuple

from biped_adrc.errors import InputError
from biped_adrc.files import number_in
from biped_adrc.live.hand import Hand

NAMES = ("sample", "link", "x [m]", "z [m]", "F_x [N]", "F_z [N]")
"""Columns before the torques."""


class HandRow(NamedTuple):
    """What the hand does from a sample on."""

    sample: int
    hand: Hand | None
    """None: nothing."""


def header(n: int) -> list[str]:
    """The columns for a robot of n coordinates."""
    return [*NAMES, *(f"q{i + 1} [N m]" for i in range(n))]


def to_table(rows: Sequence[HandRow]) -> str:
    """The rows as text, each ended by a new line; empty for none."""
    n = max((len(row.hand.torque) for row in rows if row.hand is not None), default=0)
    if not rows:
        return ""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(header(n))
    for sample, hand in rows:
        numbers = [0.0] * (4 + n) if hand is None else [*hand.at, *hand.force, *hand.torque]
        link = "" if hand is None else hand.link
        table.writerow([sample, link, *(repr(float(x)) if x else "" for x in numbers)])
    return text.getvalue()


def from_table(text: str) -> tuple[HandRow, ...]:
    """The rows of a table. Raises InputError, with the line, for what is no such table."""
    first, *lines = list(csv.reader(io.StringIO(text))) or [[]]
    if not first and not lines:
        return ()
    names = header(len(first) - len(NAMES))
    if first != names:
        raise InputError(f"the hand's table has the columns {first}, expected {names}")
    return tuple(_row(line, names, k) for k, line in enumerate(lines, start=2))


def _row(cells: list[str], names: list[str], line: int) -> HandRow:
    """One row of the table."""
    if len(cells) != len(names):
        raise InputError(
            f"line {line} of the hand's table has {len(cells)} cells, expected {len(names)}"
        )
    sample, link, *told = cells
    if not (sample.isascii() and sample.isdecimal()):
        raise InputError(
            f"line {line} of the hand's table has the sample {sample!r:.30}, expected a whole number"
        )
    x, z, F_x, F_z, *tau = (
        number_in(text, line, name) if text else 0.0
        for text, name in zip(told, names[2:], strict=True)
    )
    if link:
        return HandRow(int(sample), Hand(tuple(tau), link, (x, z), (F_x, F_z)))
    if any(told):
        raise InputError(f"line {line} of the hand's table has numbers and no link; name the link")
    return HandRow(int(sample), None)
