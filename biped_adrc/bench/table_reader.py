"""The parts of which files of studies are read: tables, ranges, seeds, named sets of values.

What cannot be read is collected with its place in the file, so that one error reports all of it. Used by
`bench.study_file` and `tuning.study_file`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from biped_adrc.bench.parameters import (
    Refused,
    Value,
    check_name,
    flat,
    is_number,
    is_whole,
    read,
    reason,
)
from biped_adrc.bench.scenario_file import read_scenario
from biped_adrc.bench.study import Named, Range
from biped_adrc.errors import InputError
from biped_adrc.files import check_regular
from biped_adrc.scenario.scenario import MOST_SEED

T = TypeVar("T")
"""What is read of one value."""

MOST = 1_000_000
"""Most levels of one parameter, and most seeds."""


def read_toml(path: Path) -> dict[str, object]:
    """The tables of a study's TOML file. Raises InputError where it cannot be read."""
    check_regular(path, f"study file '{path}'", InputError)
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise InputError(
            f"cannot read the study file '{path}': {error.strerror}; expected a TOML file"
        ) from error
    except (
        ValueError,
        RecursionError,
    ) as error:  # TOML's own, of UTF-8, of long integers, of nesting
        raise InputError(f"study file '{path}' is not TOML: {error}") from error


@dataclass
class TableReader:
    """Collects what is wrong, in the order of reading, so that one error can report all of it."""

    problems: list[str] = field(default_factory=list)
    """Each is "place in the file: what was found and what was expected"."""

    def wrong(self, key: str, text: object) -> None:
        """Note a problem at this place of the file; reading goes on."""
        self.problems.append(f"{key}: {text}")

    def each(
        self, table: Mapping[str, object], where: str, read: Callable[[str, object], T]
    ) -> dict[str, T]:
        """`read(name, value)` for each entry of a table, by name; entries that it refuses are noted and left
        out.
        """
        found = {}
        for name, x in table.items():
            try:
                found[name] = read(name, x)
            except (Refused, ValidationError) as error:
                self.wrong(f"{where}{name}", reason(error))
        return found

    def known(self, key: str, names: tuple[str, ...], where: str) -> None:
        """Note a key that there is not, with the nearest name that there is."""
        if key not in names:
            near = get_close_matches(key, names, 1)
            hint = f"did you mean '{near[0]}'?" if near else f"expected one of {list(names)}"
            self.wrong(f"{where}{key}", f"unknown key; {hint}")

    def table(self, tables: Mapping[str, object], name: str) -> dict[str, object]:
        """The table `name`, empty if absent, as parameters by name: start.v5 = .. is one parameter
        "start.v5".
        """
        found = tables.get(name, {})
        if not isinstance(found, Mapping):
            self.wrong(name, f"found {found!r}, expected a table [{name}]")
            return {}
        return flat(found)

    def text(
        self, table: Mapping[str, object], key: str, where: str, default: str | None = None
    ) -> str:
        """The text at `key`; without a default it is required and not blank."""
        found = table.get(key, default)
        if not isinstance(found, str) or (default is None and not found.strip()):
            self.wrong(f"{where}{key}", f"found {found!r}, expected a text")
        return str(found)

    def natural(self, table: Mapping[str, object], key: str, where: str, least: int) -> int:
        """The whole number at `key`, at least `least`."""
        found = table.get(key)
        if type(found) is not int or found < least:
            self.wrong(f"{where}{key}", f"found {found!r}, expected a whole number from {least} on")
            return least
        return found

    def check(self, where: str) -> None:
        """Raises InputError with all problems, one line each; `where` names the origin of the tables."""
        if len(self.problems) == 1:
            raise InputError(f"{where}, {self.problems[0]}")
        if self.problems:
            raise InputError(
                "\n  ".join([f"{where} has {len(self.problems)} problems:", *self.problems])
            )


def read_base(r: TableReader, head: Mapping[str, object]) -> dict[str, Value]:
    """The values of the scenario file that [study] names, over which other values go; empty without one."""
    if "scenario" not in head:
        return {}
    try:
        return read_scenario(Path(r.text(head, "scenario", "study.")))
    except InputError as error:
        r.wrong("study.scenario", error)
        return {}


def read_range(name: str, given: object, keys: tuple[str, ...]) -> Range:
    """The range {from, to, scale} of a number, read with its unit; keys: what may stand in it.
    Raises Refused.
    """
    check_name(name)
    if not isinstance(given, Mapping) or not {"from", "to"} <= set(given) <= set(keys):
        raise Refused(f"found {given!r}, expected {{{', '.join(keys)}}}")
    if not is_number(name):
        raise Refused("has no ranges; give a list of values")
    low, high = read(name, given["from"]), read(name, given["to"])
    scale = given.get("scale", "linear")
    if scale not in ("linear", "log"):
        raise Refused(f"found scale {scale!r}, expected 'linear' or 'log'")
    if not isinstance(low, (int, float)) or not isinstance(high, (int, float)) or low >= high:
        raise Refused(f"found from {given['from']!r} to {given['to']!r}, expected from < to")
    if scale == "log" and (low <= 0.0 or is_whole(name)):
        raise Refused("a logarithmic scale expects a parameter with a fraction and from > 0")
    return Range(low=low, high=high, scale=scale, whole=is_whole(name))


def read_seeds(r: TableReader, given: object, key: str = "study.seeds") -> tuple[int, ...]:
    """The seeds 0 .. n-1 of a number n, or those of a list, each between 0 and `MOST_SEED` and all
    different.
    """
    if given is None:
        return ()
    if type(given) is int and 1 <= given <= MOST:
        return tuple(range(given))
    found = given if isinstance(given, list) else []
    seeds = {x for x in found if type(x) is int and 0 <= x <= MOST_SEED}
    if not found or len(seeds) < len(found):
        r.wrong(key, f"found {given!r}, expected how many, or a list of different seeds")
        return ()
    return tuple(found)


def read_sets(r: TableReader, kind: str, given: object) -> tuple[Named, ...]:
    """The sets [[cases]] or [[conditions]], with different names."""
    if not isinstance(given, list) or not all(isinstance(one, Mapping) for one in given):
        r.wrong(kind, f"found {given!r}, expected tables [[{kind}]]")
        return ()
    found = []
    for i, one in enumerate(given, 1):
        where = f"{kind}[{i}]."
        name = r.text(one, "name", where)
        rest = flat({key: x for key, x in one.items() if key != "name"})
        found.append(Named(name=name, values=r.each(rest, where, read)))
    names = [one.name for one in found]
    if len(set(names)) < len(names):
        r.wrong(kind, f"have the names {names}, expected different ones")
    return tuple(found)
