"""What the commands print: text from files is data, and an output that cannot be written loses nothing.

A name in a file may hold what a terminal or rich would obey (escape sequences, "[/b]", ":bomb:").
`Terminal` prints it as it is, and control characters as \\x1b. `lasting` keeps a command going when
its reader has left (`| head -1`) or the disk is full: a result is not lost to a line about it.
"""

from __future__ import annotations

import errno
import io
import re
import select
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

_CONTROL = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069\ud800-\udfff]"
)
"""Characters that move the cursor, colour, turn the direction of reading, or are no text at all."""


def printable(text: str) -> str:
    """A text with its control characters written out, such as \\x1b; lines and tabs stay."""
    return _CONTROL.sub(lambda found: found[0].encode("unicode_escape").decode(), text)


class Terminal(Console):
    """rich's console, without markup and emoji: brackets, colons and control characters are text."""

    def __init__(self, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, markup=False, emoji=False)

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """The segments that are printed, all that is text made printable."""
        for segment in super().render(renderable, options):
            yield segment if segment.control else segment._replace(text=printable(segment.text))


class Lasting(io.FileIO):
    """A file descriptor to print to that takes everything, also when nobody reads or the disk is full."""

    lost: OSError | None = None
    """Why something could not be written; None while all was."""

    def write(self, data: ReadableBuffer, /) -> int:
        """Write what can be written; the number of bytes, all of them once something was lost."""
        if self.lost is None:
            try:
                count: int | None = super().write(data)
            except OSError as error:
                self.lost = error
            else:
                if count is None:  # a full pipe that does not block
                    select.select((), (self,), ())
                return count or 0
        return memoryview(data).nbytes


def lasting(name: str) -> Lasting | None:
    """Make sys.stdout or sys.stderr one that lasts; None where it is no file of the operating system."""
    old = getattr(sys, name)
    try:
        raw = Lasting(old.fileno(), "w", closefd=False)
    except (AttributeError, OSError, ValueError):
        return None
    old.flush()
    buffer = io.BufferedWriter(raw)
    new = io.TextIOWrapper(
        buffer, old.encoding, "backslashreplace", line_buffering=old.line_buffering
    )
    setattr(sys, name, new)
    return raw


def reason_lost(output: Lasting | None) -> str | None:
    """Why what was printed is not there; None where it is, or where a reader left early, such as `head`."""
    lost = None if output is None else output.lost
    return None if lost is None or lost.errno == errno.EPIPE else (lost.strerror or str(lost))
