"""The commands there are: the tree of the command line, and how one of them is run."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

import typer

from biped_adrc.cli import app

PROGRAM = (sys.executable, "-m", "biped_adrc")
"""In front of the arguments."""


def tree() -> Iterator[tuple[str, ...]]:
    """The words of every command and group, from the program itself on."""
    yield from _below(typer.main.get_command(app), ())


def _below(command: Any, words: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    yield words
    for name, inner in sorted(getattr(command, "commands", {}).items()):
        yield from _below(inner, (*words, name))
