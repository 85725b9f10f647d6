"""Nested plain values (tables of tables), and the same values under dotted names.

    {"run": {"seed": 1}}   <->   {"run.seed": 1}

An item of a list of tables has its number from 0 in the name: "pushes.0.torque" is of the first push. A table
is a mapping, as TOML and JSON have it. A record (`scenario.records`) is a checked table; one that has an
obvious name may be written as that name alone, so "ADRC" stands for {"name": "ADRC"}.
"""

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
        # "run.seed" is split at its first dot; dot is empty where there is none
        head, dot, rest = str(name).partition(".")
        inner = tables({rest: x}) if dot else tables(x) if isinstance(x, Mapping) else x
        result[head] = merged(result.get(head), inner)
    return result


def merged(before: Any, more: Any) -> Any:
    """The nested values `before`, overridden level by level by the values `more`.

    What is no table in `more` replaces all of `before`. A table in `more` also changes single items of a list
    `before`, by their numbers {"0": ..}; single values of a record; and adds values to a text `before` that
    stands for a record, which is kept under the key NAME.
    """
    if not isinstance(more, dict):
        return more
    if isinstance(before, list | tuple) and all(name.isdigit() for name in more):
        before = {str(i): x for i, x in enumerate(before)}
    if isinstance(before, str):
        before = {NAME: before}
    if hasattr(before, "record"):  # a record: those of its values that are not the defaults
        before = before.record()
    if not isinstance(before, dict):
        return more
    return before | {name: merged(before.get(name), x) for name, x in more.items()}


def flat(table: Mapping[str, Any], before: str = "", whole: Collection[str] = ()) -> dict[str, Any]:
    """Values by dotted name, of nested ones: the inverse of `tables`. Lists of other values become tuples.

    before: what all names begin with, such as "run.". whole: a table with one of these keys stays one value.
    """
    result: dict[str, Any] = {}
    for name, x in table.items():
        if isinstance(x, list) and x and all(isinstance(y, Mapping) for y in x):
            x = {str(i): y for i, y in enumerate(x)}
        if isinstance(x, Mapping) and not set(x) & set(whole):
            result |= flat(x, f"{before}{name}.", whole)
        else:
            result[f"{before}{name}"] = tuple(x) if isinstance(x, list) else x
    return result
