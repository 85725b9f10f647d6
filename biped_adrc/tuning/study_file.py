"""A tuning study read from a TOML file, and checked as a whole: every mistake is reported in one error.

    [study]            name, description, budget, generation, finalists, seed, sampler, scenario (a file)
    [fixed]            values of all candidates; by themselves the as-published setting
    [variables]        p = {from, to, scale, whole, when} or p = {choices, when}
    [[objectives]]     column, goal, over, condition, counts
    [[limits]]         column, least or most, over, condition, counts
    [training], [selection], [test]       seeds: a list, or {from, count}
    [[training.conditions]]               name, values that go before those of a candidate

Read key by key as the file of a sweep is (`bench.study_file`); then it is looked at as a whole: sets of walks
that share seeds, conditions that no set has, columns that no walk has.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

from pydantic import ValidationError

from biped_adrc.bench.parameters import Refused, Value, check_name, read, reason
from biped_adrc.bench.run import COLUMNS, WORDS
from biped_adrc.bench.study import SEED, Range
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
from biped_adrc.scenario.dotted import unknown
from biped_adrc.tuning.measure import Aim, Limit, Measure
from biped_adrc.tuning.study import SETS, TuningStudy, WalkSet
from biped_adrc.tuning.variables import Variable
from biped_adrc.tuning.without_walk import WITHOUT_WALK

HEAD = ("name", "description", "budget", "generation", "finalists", "seed", "sampler", "scenario")
"""What [study] may hold."""
TABLES = ("study", "fixed", "variables", "objectives", "limits", *SETS)
"""The tables that the file may have."""
OF_RANGE = ("from", "to", "scale", "whole", "when")
"""What a variable with a range may hold."""
SMALLEST_POPULATION = 4
"""Fewest candidates of a generation of NSGA-II, which pairs them."""
FINALISTS = 5
"""Candidates on the selection set where the file does not say."""


def walk_columns() -> tuple[str, ...]:
    """The columns with numbers that a candidate has, from walks and without any."""
    return (*(name for name in COLUMNS if name not in WORDS), *WITHOUT_WALK)


def load_tuning(path: Path | str) -> TuningStudy:
    """The tuning study in a TOML file. Raises InputError with everything that is wrong in it."""
    path = Path(path)
    return read_tuning(read_toml(path), f"study file '{path}'")


def read_tuning(
    tables: Mapping[str, object],
    where: str = "the study",
    columns: Collection[str] | None = None,
) -> TuningStudy:
    """The tuning study of plain tables, as a TOML file has them; `where` names their origin in an error.

    columns: that rows have, of walks if None. Raises InputError with a line for each problem.
    """
    r = TableReader()
    for table in tables:
        r.known(table, TABLES, "")
    head = r.table(tables, "study")
    for key in head:
        r.known(key, HEAD, "study.")
    several = isinstance(found := tables.get("objectives"), list) and len(found) > 1
    usual = "nsga-ii" if several else "cma-es"
    made = {
        "name": r.text(head, "name", "study."),
        "description": r.text(head, "description", "study.", ""),
        "sampler": r.text(head, "sampler", "study.", usual),
        "budget": r.natural(head, "budget", "study.", 1),
        "generation": r.natural(head, "generation", "study.", 1),
        "seed": r.natural(head, "seed", "study.", 0),
        "finalists": r.natural({"finalists": FINALISTS, **head}, "finalists", "study.", 1),
        "fixed": read_base(r, head) | r.each(r.table(tables, "fixed"), "fixed.", read),
        "variables": r.each(r.table(tables, "variables"), "variables.", _variable),
        "objectives": _measures(r, tables, "objectives", Aim),
        "limits": _measures(r, tables, "limits", Limit),
        **{kind: _walk_set(r, tables, kind) for kind in SETS},
    }
    r.check(where)
    try:
        study = TuningStudy.model_validate(made)
    except ValidationError as error:
        raise InputError(f"{where}, {reason(error)}") from error
    _check_together(r, study, walk_columns() if columns is None else columns)
    r.check(where)
    return study


def _variable(name: str, given: object) -> Variable:
    """One variable: a range, or choices. Raises Refused."""
    check_name(name)
    if name == SEED:
        raise Refused("seeds are given by the sets of walks; a search may not choose its luck")
    if not isinstance(given, Mapping):
        raise Refused(f"found {given!r}, expected {{from, to}} or {{choices}}")
    when = _when(given.get("when", {}))
    if "choices" not in given:
        return Variable(range=_range(name, given), when=when)
    choices = given["choices"]
    if set(given) - {"choices", "when"} or not isinstance(choices, list) or len(choices) < 2:
        raise Refused(f"found {given!r}, expected {{choices, when}} with at least two choices")
    values = tuple(read(name, x) for x in choices)
    if len({repr(x) for x in values}) < len(values) or any(isinstance(x, tuple) for x in values):
        raise Refused(f"found the choices {choices}, expected different numbers or texts")
    return Variable(choices=values, when=when)


def _range(name: str, given: Mapping[str, object]) -> Range:
    """The range of a variable; an own parameter is whole where the file says so. Raises Refused."""
    found = read_range(
        name, {k: x for k, x in given.items() if k not in ("when", "whole")}, OF_RANGE
    )
    whole = given.get("whole", found.whole)
    if type(whole) is not bool or (whole and found.scale == "log"):
        raise Refused(f"found whole = {whole!r}, expected true or false, and a linear scale")
    return found.model_copy(update={"whole": whole})


def _when(given: object) -> dict[str, tuple[Value, ...]]:
    """By name the values with which a variable has an effect, each one value or a list. Raises Refused."""
    if not isinstance(given, Mapping):
        raise Refused(f"found when = {given!r}, expected {{name = value}} or {{name = [values]}}")
    lists = {name: x if isinstance(x, list) else [x] for name, x in given.items()}
    return {name: tuple(read(name, x) for x in values) for name, values in lists.items()}


def _measures(
    r: TableReader, tables: Mapping[str, object], kind: str, of: type[Aim] | type[Limit]
) -> tuple[Aim | Limit, ...]:
    """The measures of [[objectives]] or [[limits]]."""
    given = tables.get(kind, [])
    if not isinstance(given, list) or not all(isinstance(one, Mapping) for one in given):
        r.wrong(kind, f"found {given!r}, expected tables [[{kind}]]")
        return ()
    found = []
    for i, one in enumerate(given, 1):
        before = len(r.problems)
        for key in one:
            r.known(key, tuple(of.model_fields), f"{kind}[{i}].")
        over, bounds = one.get("over", ""), [k for k in ("least", "most") if k in one]
        if not isinstance(over, str) and not (isinstance(over, float) and 0.0 < over < 1.0):
            r.wrong(f"{kind}[{i}].over", f"found {over!r}, expected a quantile between 0 and 1")
        if of is Limit and len(bounds) != 1:
            r.wrong(f"{kind}[{i}]", f"has {bounds}, expected one of least and most")
        if len(r.problems) > before:
            continue
        try:
            found.append(of.model_validate(one))
        except ValidationError as error:
            r.wrong(f"{kind}[{i}]", reason(error))
    return tuple(found)


def _walk_set(r: TableReader, tables: Mapping[str, object], kind: str) -> WalkSet:
    """The set of walks of a table such as [training]."""
    given = tables.get(kind)
    if not isinstance(given, Mapping):
        r.wrong(kind, f"found {given!r}, expected a table [{kind}] with seeds")
        return WalkSet(seeds=(0,))
    for key in given:
        r.known(key, ("seeds", "conditions"), f"{kind}.")
    seeds = given.get("seeds")
    if isinstance(seeds, Mapping):
        first, count = (
            r.natural(seeds, k, f"{kind}.seeds.", n) for k, n in (("from", 0), ("count", 1))
        )
        seeds = list(range(first, first + min(count, MOST)))
    found = read_seeds(r, [] if seeds is None else seeds, f"{kind}.seeds") or (0,)
    return WalkSet(
        seeds=found, conditions=read_sets(r, f"{kind}.conditions", given.get("conditions", []))
    )


def _check_together(r: TableReader, study: TuningStudy, columns: Collection[str]) -> None:
    """What no single entry shows: seeds in two sets, and measures of what there is not."""
    if study.sampler == "nsga-ii" and study.generation < SMALLEST_POPULATION:
        r.wrong(
            "study.generation",
            f"found {study.generation}, expected at least {SMALLEST_POPULATION} for the sampler 'nsga-ii'",
        )
    for i, kind in enumerate(SETS):
        for other in SETS[:i]:
            both = sorted({*study.walks(kind).seeds} & {*study.walks(other).seeds})
            if both:
                r.wrong(
                    f"{kind}.seeds",
                    f"share {both[:5]} with {other}.seeds; expected others, since a choice made on walks makes "
                    "them look better than they are",
                )
    _check_given(r, study)
    for place, measure in _placed(study):
        if measure.column not in columns:
            r.wrong(f"{place}.column", f"'{measure.column}': {unknown(measure.column, columns)}")
        for kind in SETS:
            names = [one.name for one in study.walks(kind).conditions]
            if measure.condition is not None and measure.condition not in names:
                r.wrong(
                    f"{place}.condition",
                    f"found '{measure.condition}', expected one that all sets have; {kind} has {names}",
                )


def _check_given(r: TableReader, study: TuningStudy) -> None:
    """Seeds beside those of the sets, and variables that a condition would overrule."""
    for kind in SETS:
        for i, one in enumerate(study.walks(kind).conditions, 1):
            for name in {*study.variables, SEED} & one.values.keys():
                r.wrong(
                    f"{kind}.conditions[{i}].{name}", "is given for candidates; leave it out here"
                )
    if SEED in study.fixed:
        r.wrong(f"fixed.{SEED}", "seeds are given by the sets of walks; leave it out")


def _placed(study: TuningStudy) -> list[tuple[str, Measure]]:
    """Each measure with its place in the file."""
    objectives = [(f"objectives[{i}]", m) for i, m in enumerate(study.objectives, 1)]
    return [*objectives, *((f"limits[{i}]", m) for i, m in enumerate(study.limits, 1))]
