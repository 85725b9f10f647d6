"""Nested plain values (tables of tables), and the same values under dotted names.

    {"run": {"seed": 1}}   <->   {"run.seed": 1}

An item of a list of tables has its number from 0 in the name: "pushes.0.torque" is of the first push.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

NAME = ""
"""Key, in nested plain values, of the text that may stand for a whole record (`Record.SHORT`)."""


def tables(values: Mapping[str, Any]) -> dict[str, Any]:
    """Nest values that stand under dotted names: {"run.seed": 1} becomes {"run": {"seed": 1}}.

    Where two of them meet, such as "run" and "run.seed", the later one counts.
    """
    result: dict[str, Any] = {}
    for name, x in values.items():
        head, dot, rest = str(name).partition(".")
        inner = tables({rest: x}) if dot else tables(x) if isinstance(x, Mapping) else x
        result[head] = merged(result.get(head), inner)
    return result


def merged(before: Any, more: Any) -> Any:
    """The nested values `before`, overridden level by level by the values `more`.

    What is no table in `more` replaces all that was there. A table in `more` also changes single items of a
    list, by their numbers {"0": ..}; values of a record; and those beside a text that stands for a record.
    """
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
    """Values by dotted name, of nested ones: the inverse of `tables`. Lists of other values become tuples.

    before: what all names begin with, such as "run.". whole: a table with one of these keys stays one value.
    """
    result: dict[str, Any] = {}
    for name, x in values.items():
        if isinstance(x, list) and x and all(isinstance(y, Mapping) for y in x):
            x = {str(i): y for i, y in enumerate(x)}
        if isinstance(x, Mapping) and not set(x) & set(whole):
            result |= flat(x, f"{before}{name}.", whole)
        else:
            result[f"{before}{name}"] = tuple(x) if isinstance(x, list) else x
    return result
