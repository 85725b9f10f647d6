"""A study read from a TOML file, and checked as a whole: every mistake is reported in one error.

    [study]            name, description, seeds (a number of them, or a list), scenario (a file)
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

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any, get_args

from biped_adrc.bench.parameters import Refused, Value, check_name, read, trial
from biped_adrc.bench.study import (
    MOST_POINTS,
    SEED,
    Draw,
    Kind,
    Study,
    some_points,
    too_many,
)
from biped_adrc.bench.table_reader import (
    MOST,
    TableReader,
    read_base,
    read_range,
    read_seeds,
    read_sets,
    read_toml,
)
from biped_adrc.errors import InputError

TABLES = ("study", "fixed", "grid", "random", "sobol", "cases", "conditions")
"""The tables that a study file may have."""
SETS = ("cases", "conditions")
"""Those that are lists of named sets of values."""
SPREAD = 3000
"""Points all over a study whose scenarios are built beforehand.

A point in between whose values do not fit together is found when it is run: it has a row that says so.
"""


def load_study(path: Path | str) -> Study:
    """The study in a TOML file. Raises InputError with everything that is wrong in it, or why it cannot be
    read.
    """
    path = Path(path)
    return read_study(read_toml(path), f"study file '{path}'")


def read_study(tables: Mapping[str, object], where: str = "the study") -> Study:
    """The study of plain tables, as a TOML file has them; `where` names their origin in an error.

    Raises InputError: one line for a single problem, otherwise their number and a line for each.
    """
    r = TableReader()
    for table in tables:
        r.known(table, TABLES, "")
    head = r.table(tables, "study")
    for key in head:
        r.known(key, ("name", "description", "seeds", "scenario"), "study.")
    base = read_base(r, head)
    made: dict[str, Any] = {
        "fixed": r.each(r.table(tables, "fixed"), "fixed.", read),
        "grid": r.each(r.table(tables, "grid"), "grid.", _levels),
        "draw": _draw(r, tables),
        "name": r.text(head, "name", "study."),
        "description": r.text(head, "description", "study.", ""),
        "seeds": read_seeds(r, head.get("seeds")),
        **{name: read_sets(r, name, tables.get(name, [])) for name in SETS},
    }
    r.check(where)
    varied = Study.model_validate(made).varied
    made["fixed"] = {k: x for k, x in base.items() if k not in varied} | made["fixed"]
    study = Study.model_validate(made)
    _check_together(r, study)
    r.check(where)
    return study


def _levels(name: str, given: object) -> tuple[Value, ...]:
    """The levels of one parameter of the grid, from a list or a range with a count. Raises Refused.

    A level that is given twice is refused: its points would be run once and counted twice.
    """
    check_name(name)
    if isinstance(given, Mapping):
        count = given.get("count")
        if type(count) is not int or not 1 <= count <= MOST:
            raise Refused(f"found count {count!r}, expected a whole number from 1 to {MOST}")
        numbers = read_range(name, given, ("from", "to", "count", "scale")).levels(count)
        levels = [read(name, x) for x in numbers]
    elif isinstance(given, list) and given:
        levels = [read(name, x) for x in given]
    else:
        raise Refused(f"found {given!r}, expected a list of values or {{from, to, count}}")
    twice = {repr(x) for i, x in enumerate(levels) if x in levels[:i]} if len(levels) < 1000 else ()
    if twice:
        raise Refused(f"{', '.join(twice)} is given twice")
    return tuple(levels)


def _draw(r: TableReader, tables: Mapping[str, object]) -> Draw | None:
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
    ranges = r.each(rest, where, partial(read_range, keys=("from", "to", "scale")))
    if not rest:
        r.wrong(kind, "names no parameter; expected p = {from, to}")
    if r.problems:
        return None
    return Draw(kind=kind, count=count, seed=seed, ranges=ranges)


def _check_together(r: TableReader, study: Study) -> None:
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
