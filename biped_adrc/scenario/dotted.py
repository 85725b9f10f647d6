"""Dotted names of nested plain values: "controller.observer.bandwidth"."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from difflib import get_close_matches
from typing import Any

NAME = ""
"""Key of a record's obvious name in plain values."""
MANY = 20
"""Names that a message lists at most, before it names the records alone."""


def nested(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by dotted name as nested ones: {"run.seed": 1} becomes {"run": {"seed": 1}}."""
    made: dict[str, Any] = {}
    for name, x in values.items():
        head, dot, rest = str(name).partition(".")
        inner = nested({rest: x}) if dot else nested(x) if isinstance(x, Mapping) else x
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
    """The inverse of `nested`; records in a list have numbers in their names.

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


def unknown(name: str, known: Iterable[str]) -> str:
    """The sentence for a name that does not exist: alike ends, near ones, or all of its record."""
    known, (record, dot, last) = list(known), name.rpartition(".")
    beside = [whole for whole in known if dot and whole.startswith(record + dot)]
    ends: dict[str, list[str]] = {}
    for whole in known:
        parts = whole.split(".")
        for k in range(len(parts)):  # records have names too
            ends.setdefault(parts[k], []).append(".".join(parts[: k + 1]))
    alike = [ends[end][0] for end in get_close_matches(last, ends, 2)]
    near = ends.get(last) or [*get_close_matches(name, known, 2, 0.8), *alike]
    if last not in ends and beside:
        known, near = beside, [x for x in near if x in beside]
    near = list(dict.fromkeys(near))[:3]
    if near:
        return f"unknown name; did you mean {' or '.join(map(repr, near))}?"
    if len(known) > MANY:
        known = list(dict.fromkeys(whole.partition(".")[0] for whole in known))
    return f"unknown name; choose from {known}" if known else "unknown name; leave it out"
