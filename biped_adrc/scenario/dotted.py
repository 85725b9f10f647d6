"""Dotted names of nested plain values: "controller.observer.bandwidth"."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

NAME = ""
"""Key, in nested plain values, of the text that may stand for a whole record (`Record.SHORT`)."""


def tables(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by dotted name as nested ones: {"run.seed": 1} becomes {"run": {"seed": 1}}."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        head, dot, rest = str(name).partition(".")
        inner = tables({rest: x}) if dot else tables(x) if isinstance(x, Mapping) else x
        made[head] = merged(made.get(head), inner)
    return made


def merged(before: Any, more: Any) -> Any:
    """Nested values with others put on top; the items of a list are named by their numbers."""
    if not isinstance(more, dict):
        return more
    if isinstance(before, list | tuple) and all(name.isdigit() for name in more):
        before = {str(i): x for i, x in enumerate(before)}
    if isinstance(before, str):
        before = {NAME: before}
    if hasattr(before, "record"):
        before = before.record()
    if not isinstance(before, dict):
        return more
    return before | {name: merged(before.get(name), x) for name, x in more.items()}


def flat(
    values: Mapping[str, Any], before: str = "", whole: Collection[str] = ()
) -> dict[str, Any]:
    """The inverse of `tables`; records in a list have numbers in their names.

    whole: a table with one of these keys is a value.
    """
    made: dict[str, Any] = {}
    for name, x in values.items():
        if isinstance(x, list) and x and all(isinstance(y, Mapping) for y in x):
            x = {str(i): y for i, y in enumerate(x)}
        if isinstance(x, Mapping) and not set(x) & set(whole):
            made |= flat(x, f"{before}{name}.", whole)
        else:
            made[f"{before}{name}"] = tuple(x) if isinstance(x, list) else x
    return made
