"""A study read from a TOML file, and checked as a whole: every mistake is reported in one error.

    [study]            name, description, seeds (a number of them, or a list)
    [fixed]            parameters of every trial
    [grid]             p = [..] or p = {from, to, count, scale = "linear" | "log"}: all combinations
    [random], [sobol]  count, seed, p = {from, to, scale}: samples, of all p together
    [[cases]]          name, parameters: each set is crossed with grid and samples
    [[conditions]]     name, parameters: as cases, and each condition is crossed with each case

Values are numbers in the SI unit, or text such as "1.5 ms"; "none" for no value.

The file goes through three steps: each table is read key by key, and what cannot be read is collected with
its place in the file; then the places are compared, since no parameter may be given twice; then scenarios of
points all over the study are built, without robots, to see whether their values fit together. A user who has
to mend five mistakes gets them at once. pydantic alone would report the fields of our classes; here the
places of the user's file are named, which is why the tables are walked by hand.

`bench.sweep` and the command `sweep` call `load_study`; what a parameter is, is known to `bench.parameters`.

An example of 50 points, 2 cases x 5 delays x 5 seeds:

    [study]
    name = "delay and encoders"
    seeds = 5
    [fixed]
    push = "pulse"
    amplitude = "60 N m"
    [grid]
    delay = {from = 0, to = "4 ms", count = 5}
    [[cases]]
    name = "ideal"
    [[cases]]
    name = "encoders"
    counts = 8192
    velocity = "differences"
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import partial
from pathlib import Path
from typing import TypeVar, get_args

from pydantic import ValidationError

from biped_adrc.bench.parameters import (
    Refused,
    Value,
    check_name,
    flat,
    is_number,
    is_whole,
    read,
    trial,
)
from biped_adrc.bench.study import (
    MOST_POINTS,
    SEED,
    Draw,
    Kind,
    Named,
    Range,
    Study,
    some_points,
    too_many,
)
from biped_adrc.errors import InputError
from biped_adrc.scenario.scenario import MOST_SEED
from biped_adrc.scenario.values import reason

T = TypeVar("T")
"""What is read of one value."""

TABLES = ("study", "fixed", "grid", "random", "sobol", "cases", "conditions")
"""The tables that a study file may have."""
SETS = ("cases", "conditions")
"""Those that are lists of named sets of values."""
MOST = 1_000_000
"""Most levels of one parameter, and most seeds."""
SPREAD = 3000
"""Points all over a study whose scenarios are built beforehand.

A point in between whose values do not fit together is found when it is run: it has a row that says so.
"""


def load_study(path: Path | str) -> Study:
    """The study in a TOML file. Raises InputError with everything that is wrong in it, or why it cannot be
    read.
    """
    path = Path(path)
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise InputError(
            f"cannot read the study file '{path}': {error.strerror}; expected a TOML file"
        ) from error
    except (
        ValueError,
        RecursionError,
    ) as error:  # TOML's own, of UTF-8, of long integers, of nesting
        raise InputError(f"study file '{path}' is not TOML: {error}") from error
    return read_study(tables, f"study file '{path}'")


def read_study(tables: Mapping[str, object], where: str = "the study") -> Study:
    """The study of plain tables, as a TOML file has them; `where` names their origin in an error.

    Raises InputError: one line for a single problem, otherwise their number and a line for each.
    """
    r = _Reader()
    for table in tables:
        r.known(table, TABLES, "")
    head = r.table(tables, "study")
    for key in head:
        r.known(key, ("name", "description", "seeds"), "study.")
    made = {
        "fixed": r.each(r.table(tables, "fixed"), "fixed.", read),
        "grid": r.each(r.table(tables, "grid"), "grid.", _levels),
        "draw": _draw(r, tables),
        "name": r.text(head, "name", "study."),
        "description": r.text(head, "description", "study.", ""),
        "seeds": _seeds(r, head.get("seeds")),
        **{name: _sets(r, name, tables.get(name, [])) for name in SETS},
    }
    if not r.problems:
        study = Study.model_validate(made)
        _check_together(r, study)
        if not r.problems:
            return study
    if len(r.problems) == 1:
        raise InputError(f"{where}, {r.problems[0]}")
    raise InputError("\n  ".join([f"{where} has {len(r.problems)} problems:", *r.problems]))


@dataclass
class _Reader:
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


def _levels(name: str, given: object) -> tuple[Value, ...]:
    """The levels of one parameter of the grid, from a list or a range with a count. Raises Refused.

    A level that is given twice is refused: its points would be run once and counted twice.
    """
    check_name(name)
    if isinstance(given, Mapping):
        count = given.get("count")
        if type(count) is not int or not 1 <= count <= MOST:
            raise Refused(f"found count {count!r}, expected a whole number from 1 to {MOST}")
        numbers = _range(name, given, ("from", "to", "count", "scale")).levels(count)
        levels = [read(name, x) for x in numbers]
    elif isinstance(given, list) and given:
        levels = [read(name, x) for x in given]
    else:
        raise Refused(f"found {given!r}, expected a list of values or {{from, to, count}}")
    twice = {repr(x) for i, x in enumerate(levels) if x in levels[:i]} if len(levels) < 1000 else ()
    if twice:
        raise Refused(f"{', '.join(twice)} is given twice")
    return tuple(levels)


def _range(name: str, given: object, keys: tuple[str, ...]) -> Range:
    """The range {from, to, scale} of a number, read with its unit; keys: what may stand in it.
    Raises Refused.
    """
    check_name(name)
    if not isinstance(given, Mapping) or not {"from", "to"} <= set(given) <= set(keys):
        raise Refused(f"found {given!r}, expected {{{', '.join(keys)}}}")
    if not is_number(name):
        raise Refused("has no ranges; give a list of values in [grid]")
    low, high = read(name, given["from"]), read(name, given["to"])
    scale = given.get("scale", "linear")
    if scale not in ("linear", "log"):
        raise Refused(f"found scale {scale!r}, expected 'linear' or 'log'")
    if not isinstance(low, (int, float)) or not isinstance(high, (int, float)) or low >= high:
        raise Refused(f"found from {given['from']!r} to {given['to']!r}, expected from < to")
    if scale == "log" and (low <= 0.0 or is_whole(name)):
        raise Refused("a logarithmic scale expects a parameter with a fraction and from > 0")
    return Range(low=low, high=high, scale=scale, whole=is_whole(name))


def _draw(r: _Reader, tables: Mapping[str, object]) -> Draw | None:
    """The samples of [random] or [sobol], of which a study has one at most; None without, or after
    a problem.
    """
    kinds: list[Kind] = [kind for kind in get_args(Kind) if kind in tables]
    if not kinds:
        return None
    if len(kinds) == 2:
        r.wrong("sobol", "there is [random] too; expected one of them")
    kind = kinds[0]
    table, where = r.table(tables, kind), f"{kind}."
    count, seed = r.natural(table, "count", where, 1), r.natural(table, "seed", where, 0)
    rest = {name: x for name, x in table.items() if name not in ("count", "seed")}
    ranges = r.each(rest, where, partial(_range, keys=("from", "to", "scale")))
    if not rest:
        r.wrong(kind, "names no parameter; expected p = {from, to}")
    if r.problems:
        return None
    return Draw(kind=kind, count=count, seed=seed, ranges=ranges)


def _seeds(r: _Reader, given: object) -> tuple[int, ...]:
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
        r.wrong("study.seeds", f"found {given!r}, expected how many, or a list of different seeds")
        return ()
    return tuple(found)


def _sets(r: _Reader, kind: str, given: object) -> tuple[Named, ...]:
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


def _check_together(r: _Reader, study: Study) -> None:
    """What no single entry shows: a parameter given in two places, too many points, values that do not fit.

    A case may give again what is fixed or what other cases give, and so may a condition; the grid and the
    samples may not. The first point of each of them whose scenario cannot be built is reported.
    """
    drawn = () if study.draw is None else study.draw.ranges
    places: dict[str, Iterable[str]] = {"fixed": study.fixed, "grid": study.grid, "samples": drawn}
    for kind, sets in zip(SETS, (study.cases, study.conditions), strict=True):
        places |= {f"{kind}[{i}]": one.values for i, one in enumerate(sets, 1)}
    seeds = {"study.seeds": {SEED}} if study.seeds else {}
    seen: dict[str, list[str]] = {}
    for place, names in (places | seeds).items():
        kind = place.partition("[")[0]
        beside = ("fixed", kind) if kind in SETS else ()
        for name in names:
            earlier = seen.setdefault(name, [])
            if taken := [one for one in earlier if one.partition("[")[0] not in beside]:
                r.wrong(f"{place}.{name}", f"is given in '{taken[0]}' too; expected one place")
            earlier.append(place)
    if not r.problems and study.count > MOST_POINTS:
        r.wrong("study", too_many(study))
    for alone in () if r.problems else _alone(study):
        for values, at in some_points(alone, SPREAD // study.sets):
            try:
                trial(values)
            except InputError as error:
                r.wrong(f"at {at}", error)
                break


def _alone(study: Study) -> Iterator[Study]:
    """The study with one of its cases and one of its conditions, for each of both."""
    for case in [study.cases[i : i + 1] for i in range(max(len(study.cases), 1))]:
        for condition in [
            study.conditions[i : i + 1] for i in range(max(len(study.conditions), 1))
        ]:
            yield study.model_copy(update={"cases": case, "conditions": condition})
