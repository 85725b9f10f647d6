"""A study: a base scenario, named cases, conditions, a grid or draws, seeds, and perhaps a search.

    name, description, seeds           the head
    scenario = "best.toml"             values that all others override
    column = "rms_error"               whose median the table and the page show
    [base]                             values of all walks
    [cases]       NAME = {..}          sets of values, the first one is what the others are compared with
    [conditions]  NAME = {..}          sets of other values, each crossed with each case
    [grid]        p = [..] or {from, to, count, scale}
    [draw]        kind, count, seed, p = {from, to, scale}
    [search]                           as in `studies.search`

p is a value of a scenario by its dotted name, such as controller.K_p; NAME = {..} is a table of such values.

A point is one walk: the points are the Cartesian product of cases, conditions, levels (of the grid), samples
(of the draw) and seeds, the seeds varying fastest. Its place is its number in this order; what locates it in
the study, `at`, are case, condition and the values that vary. Where no part of a walker uses random numbers,
the seed `run.seed` changes nothing, and one walk stands for all seeds (`Undrawn`). A row is the results of one
walk by column, a measure one number of many rows, such as the median of a column. A search looks for good
values of its variables by walks on three sets, "search", "choice" and "test", without a seed in common. To
rehearse is to build walkers without walking them.

Whatever is wrong in a file is reported in one error. Values are numbers in the SI unit or texts with a unit.
Names of values are those of a scenario, such as "controller.K_p".
"""

import hashlib
import itertools
import json
import math
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Self

from pydantic import Field, ValidationError, model_validator

from biped_adrc.core.errors import BipedError, InputError, ReachError, problem, unknown
from biped_adrc.core.files import beside, reading
from biped_adrc.core.registry import FOLDERS, is_own, top_of
from biped_adrc.core.versions import numerical_versions, packages
from biped_adrc.scenario.scenario import Scenario, read_scenario
from biped_adrc.studies.build import SEED, Values, differ, scenario_of, trial_of, versions_of
from biped_adrc.studies.measure import Aim, Column, Limit, Measure
from biped_adrc.studies.search import Search, Variable, WalkSets
from biped_adrc.studies.space import Draw, Grid, Named, Section, Seeds

Undrawn = frozenset[tuple[str, str]]
"""Pairs (case, condition) in whose walks nothing that acts is drawn from the seed: each is walked once."""
MOST_LEVELS = 200
"""Most levels of one axis, most samples, and most combinations of text values that `rehearse` builds."""
_LONGEST = 100
"""Most letters in the name of a file that a search writes."""


def walk_names(**names: object) -> dict[str, Any]:
    """Collect the names that say to what a walk belongs, without those that are empty (""), as a study without
    cases has no `case`.

    Every walk may have `case` and `condition`. Those of a search also have `set`, which is "search", "choice"
    or "test", and `candidate`, a number; in the set "test" they have `setting`, which is "chosen" for what the
    search chose, or "before" for the case as it was.
    """
    return {name: x for name, x in names.items() if x != ""}


def place_of(names: Mapping[str, Any]) -> tuple[str, str]:
    """The pair (case, condition) of a walk, from the `names` that locate it; "" where it has none."""
    return str(names.get("case", "")), str(names.get("condition", ""))


class Point(NamedTuple):
    """A walk of a study: its place (number in the order of the study, from 0), `at` (case, condition, and the
    values that vary, by name), and `record` (all values that the study states for its scenario, by name).
    """

    place: int
    at: Values
    record: Values


class Study(Section):
    """The parameters that a study varies and those that it does not, in SI units, checked; `read_study` makes
    it of a file or of tables.
    """

    name: str = Field(min_length=1)
    description: str = ""
    """A text for the reader; it takes no part in the hash."""
    column: Column = "rms_error"
    """The column of the results whose median the table and the page show."""
    base: Named = Field(default_factory=dict)
    cases: dict[str, Named] = Field(default_factory=dict)
    conditions: dict[str, Named] = Field(default_factory=dict)
    grid: Grid = Field(default_factory=dict)
    draw: Draw | None = None
    seeds: Seeds = ()
    search: Search | None = None

    @model_validator(mode="after")
    def _together(self) -> Self:
        """Check entries against each other. Raises ValueError with all that do not go together."""
        # _twice: values that two places set; _searched: faults of the search
        wrong = [*self._twice(), *(() if self.search is None else self._searched(self.search))]
        if wrong:
            raise ValueError("; ".join(wrong))
        return self

    def _twice(self) -> Iterator[str]:
        """Yield a sentence for each value that two places of the file set.

        Allowed are those in `over`: cases, conditions and variables override the base, variables the cases.
        """
        # SEED: the name "run.seed", which the keys for seeds set
        places: dict[str, Mapping[str, object]] = {
            "base": self.base,
            "cases": dict.fromkeys(n for x in self.cases.values() for n in x),
            "conditions": dict.fromkeys(n for x in self.conditions.values() for n in x),
            "grid": self.grid,
            "draw": {} if self.draw is None else self.draw.ranges,
            "seeds": dict.fromkeys([SEED] if self.seeds or self.search else []),
            "search.variables": {} if self.search is None else self.search.variables,
        }
        # pairs of places (a, b) of which b may override a
        over = {("base", "cases"), ("base", "conditions"), ("base", "search.variables")}
        over |= {("cases", "search.variables")}
        for (a, x), (b, y) in itertools.combinations(places.items(), 2):
            for name in x.keys() & y.keys() if (a, b) not in over else ():
                yield f"{name} is in '{a}' and in '{b}', expected one place"

    def _searched(self, search: Search) -> Iterator[str]:
        """Yield the faults of a study with a search, each as a sentence."""
        # iterating over search.walks gives (kind, set of walks) for "search", "choice" and "test"
        if self.grid or self.draw or self.seeds:
            yield "a search has variables and sets of walks; leave out grid, draw and seeds"
        files = [chosen_file(name) for name in self.cases]
        if len(set(files)) < len(files) or any(len(name) > _LONGEST for name in files):
            yield f"cases: their files would be {files}, expected different, shorter names"
        for (a, x), (b, y) in itertools.combinations(search.walks, 2):
            if both := sorted({*x.seeds} & {*y.seeds}):
                why = "a choice made on walks makes them look better than they are"
                yield f"search.walks: {a} and {b} share the seeds {both[:5]}, expected others: {why}"
        for kind, walks in search.walks:
            for name in {*walks.conditions} - self.conditions.keys():
                yield f"search.walks.{kind}: there is no condition '{name}'"
        for m in search.measures:
            for kind, walks in search.walks:
                if m.condition is not None and m.condition not in self.conditions_of(walks):
                    yield f"'{m.words}': the walks of {kind} have no condition '{m.condition}'"

    def conditions_of(self, walks: Any) -> tuple[str, ...]:
        """The conditions under which a set of walks of a search, a `WalkSet`, is walked: those that it names,
        else all of the study; a single one named "" where the study has none.
        """
        return tuple(walks.conditions or self.conditions or ("",))

    @property
    def count(self) -> int:
        """The number of walks of the study, if each is walked once per seed."""
        return self.count_of(frozenset())

    def count_of(self, undrawn: Undrawn) -> int:
        """The number of walks of a study; for a search the largest number that it may need, each walked with
        every seed.

        undrawn: pairs (case, condition) in which no part uses the seed: one walk stands for all their seeds.
        """
        if self.search is not None:
            # kind of the set -> number of walks of one candidate
            sets = {k: len(x.seeds) * len(self.conditions_of(x)) for k, x in self.search.walks}
            every = (self.values_of(name) for name in self.cases or ("",))
            return sum(self.search.count(sets, values) for values in every)
        samples = 1 if self.draw is None else self.draw.count
        # named: {"case": .., "condition": ..}; each has as many walks as seeds, one if undrawn or without seeds
        walks = sum(len(self.seeded(self.seeds, named, undrawn)) for _, named in self.sets())
        return walks * samples * math.prod(map(len, self.grid.values()))

    @property
    def every_seed(self) -> tuple[int, ...]:
        """The seeds of the study, and those of the three sets of walks of a search."""
        sets = () if self.search is None else self.search.walks
        return (*self.seeds, *(seed for _, walks in sets for seed in walks.seeds))

    def seeded(self, seeds: Sequence[int], at: Values, undrawn: Undrawn) -> list[dict[str, int]]:
        """A table {"run.seed": seed} for each seed, that is for each walk. One empty table, for a single walk,
        where there are no seeds, or where case and condition in `at` are a pair of `undrawn`.
        """
        # place_of: (case, condition)
        return [{SEED: seed} for seed in seeds if place_of(at) not in undrawn] or [{}]

    def walked_once(self, undrawn: Iterable[tuple[str, str]]) -> str:
        """A sentence that names these pairs (case, condition), in which nothing is drawn; empty for no pairs.
        The pair ("", "") is named by the study.
        """
        # filter: without an empty case or condition
        words = "; ".join(", ".join(filter(None, one)) or self.name for one in sorted(undrawn))
        return words and f"Walked once, as nothing that acts is drawn from the seed: {words}."

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the values that the grid and the samples vary, such as "controller.K_p"."""
        return (*self.grid, *(() if self.draw is None else self.draw.ranges))

    @property
    def drawn(self) -> bool:
        """Whether its walks are a sample, so that intervals mean something; not those of a declared grid."""
        return bool(self.search or self.draw or len(self.seeds) > 1) and not self.grid

    @property
    def measure(self) -> Measure:
        """The measure that table and page show: the objective of a search, or the median of the column."""
        return Measure(column=self.column) if self.search is None else self.search.objective

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of the results that the study uses, of the table, of the objective and of the limits."""
        return (self.column, *(m.column for m in (self.search.measures if self.search else ())))

    @property
    def hash(self) -> str:
        """A hash of everything but the description: results of another hash are never mixed with these."""
        text = json.dumps(self.model_dump(mode="json", exclude={"description"}), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:32]

    @property
    def versions(self) -> dict[str, str]:
        """Versions of the packages, and hashes of the files and classes, that the study's walks use, by name:
        results that were made with others are not continued.

        Raises InputError for a class that cannot be imported.
        """
        result = dict(numerical_versions()) | versions_of(self.values())
        return {**result, **(packages(["optuna", "cmaes"]) if self.search else {})}

    def values(self) -> Iterator[tuple[str, object]]:
        """Yields (name, value) for each value that at least one walk uses; not those drawn from a range."""
        for values in (self.base, *self.cases.values(), *self.conditions.values()):
            yield from values.items()
        yield from ((name, x) for name, levels in self.grid.items() for x in levels)
        if self.search is not None:
            for name, variable in self.search.variables.items():
                yield from ((name, x) for x in variable.choices)

    def sets(self) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
        """Yield, for each case under each condition, the values that its walks share, by name, and the names
        {"case": .., "condition": ..}. (These are not the sets of walks of a search.)
        """
        # "": of a study without cases or conditions; `walk_names` leaves such a name out
        for case_, condition in itertools.product(self.cases or ("",), self.conditions or ("",)):
            values = self.values_of(case_) | self.conditions.get(condition, {})
            yield values, walk_names(case=case_, condition=condition)

    def values_of(self, name: str) -> dict[str, Any]:
        """The values of the base and, over them, of a case; name "" is the base alone."""
        return {**self.base, **self.cases.get(name, {})}

    def points(self, undrawn: Undrawn = frozenset()) -> Iterator[Point]:
        """Yield all points of a study without a search, in their order. Values that do not fit together are not
        left out: their row will say so.
        """
        places = itertools.count()
        samples = [{}] if self.draw is None else self.draw.samples()
        for values, named in self.sets():
            seeds = self.seeded(self.seeds, named, undrawn)
            for levels in itertools.product(*self.grid.values()):
                level = dict(zip(self.grid, levels, strict=True))
                for sample, seed in itertools.product(samples, seeds):
                    at = level | sample | seed
                    yield Point(next(places), named | at, values | at)

    def rehearse(self) -> Undrawn:
        """Build the walkers of some points, so that mistakes show before the first walk; walk none of them.

        Case by case under each condition it builds each level of each axis, and combinations of values that are
        texts; of a search the values of the case, the middle of all variables, and each choice. Each is built
        again with the second seed: returned are the pairs (case, condition) in which that changed nothing, none
        for a study with fewer than two seeds. Raises InputError that names the point.
        """
        # the second seed, or none; result: the pairs in which no difference has been found yet
        other = [{SEED: seed} for seed in self.every_seed[1:2]]
        result = {place_of(names) for _, names in self.sets() if other}
        for values, names in self.sets():
            for at in self._some(values):  # some points, each as the values that vary
                try:
                    trial = trial_of(scenario_of(values | at))
                    if place_of(names) in result:
                        again = trial_of(scenario_of(values | at | other[0]))
                        result -= {place_of(names)} if differ(trial, again) else set()
                except ReachError:  # a stone out of reach: the row of this one walk will say so
                    result.discard(place_of(names))
                except BipedError as error:
                    where = ", ".join(f"{k} = {x}" for k, x in (names | at).items()) or "base"
                    raise InputError(f"study '{self.name}', at {where}: {error}") from error
        return frozenset(result)

    def _some(self, values: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
        """Yield the points that `rehearse` builds of one case under one condition, each as the values that
        vary, by name.

        values: those that all walks of this case and condition share, by name.
        """
        if self.search is not None:
            seed = {SEED: self.search.walks.search.seeds[0]}
            yield seed
            yield from (seed | at for at in self.search.some(values))
            return
        axes = self.grid | ({SEED: self.seeds[:1]} if self.seeds else {})
        first = {name: levels[0] for name, levels in axes.items()}
        samples = [{}] if self.draw is None else self.draw.samples()[:MOST_LEVELS]
        # each sample with the first levels; each other level of one axis with the first ones of the others;
        # then combinations of the axes that have texts, up to MOST_LEVELS: two names may not go together
        yield from (first | sample for sample in samples)
        for name, levels in axes.items():
            step = math.ceil(len(levels) / MOST_LEVELS)  # of a long axis only each step-th level
            yield from (first | samples[0] | {name: x} for x in levels[1::step])
        worded = (x if any(isinstance(y, str) for y in x) else x[:1] for x in axes.values())
        # from 1 on: the first combination, of all first levels, has been yielded above
        for combined in itertools.islice(itertools.product(*worded), 1, MOST_LEVELS):
            yield dict(zip(axes, combined, strict=True)) | samples[0]


def read_study(source: Path | str | Mapping[str, Any]) -> Study:
    """The study of a TOML file (source: its path), or of its tables. Raises InputError with everything that is
    wrong in it.

    Modules of the user's and a scenario file that a study file names are looked for in its folder. The values
    of the scenario file stand below the base, without those that the study varies.
    """
    where, tables, here = "the study", source, Path()
    if not isinstance(source, Mapping):
        where = f"study file '{source}'"
        with reading("study file", source, InputError):
            # -sig: also with the mark that some editors put first
            tables = tomllib.loads(Path(source).read_text(encoding="utf-8-sig"))
        here = Path(source).absolute().parent
    tables = dict(tables)  # type: ignore[arg-type]
    below = {}
    if "scenario" in tables:
        name = str(tables.pop("scenario"))
        file = Path(name) if isinstance(source, Mapping) else beside(Path(source), name)
        below = read_scenario(file).dotted()
    try:
        study = Study.model_validate(tables)
        # over: names of the values that the study varies
        over = {*study.axes, *([SEED] if study.seeds or study.search else [])}
        kept = {name: x for name, x in below.items() if name not in over}
        study = study.model_copy(update={"base": kept | study.base})
    except ValidationError as error:
        lines = [_problem(one) for one in error.errors()]
        head = f"{where}, " if len(lines) == 1 else f"{where} has {len(lines)} problems:\n  "
        raise InputError(head + "\n  ".join(lines)) from error
    # a class module:Class of the user's is looked for in the folder of the study file, by workers too; top_of:
    # the package or module that lies in this folder
    for name, x in study.values():
        if Scenario.field_of(name).kind and is_own(str(x)):
            FOLDERS[top_of(str(x))] = str(here)
    return study


def _problem(error: Any) -> str:
    """Sentence on one fault of a file, an entry of pydantic's `ValidationError.errors()`; for an unknown key it
    names the nearest known ones.
    """
    if error["type"] != "extra_forbidden":
        return problem(error)
    # the tables in which the key could have been; loc: the names of the tables around it, and its own
    inside = (Search, WalkSets, Variable, Aim, Limit)
    parts = (Study,) if len(error["loc"]) == 1 else inside
    known = sorted({name for part in parts for name in part.model_fields})
    # the sentence of `unknown` speaks of a name
    text = unknown(str(error["loc"][-1]), known).replace("name;", "key;")
    return f"{'.'.join(map(str, error['loc']))}: {text}"


def chosen_file(case: str) -> str:
    """The name of the scenario file in which a search writes what it chose for a case: "chosen", then the words
    of the case's name, joined by -; case "" is that of a study without cases.
    """
    return "-".join(["chosen", *re.findall(r"\w+", case)]) + ".toml"
