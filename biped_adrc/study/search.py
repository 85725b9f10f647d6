"""What a search looks for, and on which walks: variables, an objective, limits, three sets of walks.

    [search]              budget, generation, finalists, seed, objective, limits
    [search.variables]    p = {from, to, scale, whole, when} or p = {choices, when}
    [search.walks]        search, choice, test = {seeds, conditions}

Candidates are searched on the first set of walks. On the second the best few and the setting of the case itself
are walked again, and one is chosen; on the third the chosen one and that of the case are walked once. A measure
that was minimised over noise is too good on the walks it was minimised on: no two sets share a seed. Each case
is searched by itself, with the same budget.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from pydantic import Field, model_validator

from biped_adrc.study.measure import Limit, Measure, Objective, Row
from biped_adrc.study.parameters import SEED, Refused, Values, field_of, flat, read
from biped_adrc.study.space import Part, Range, Seeds, each, read_range

Walks = Sequence[tuple[str, Row]]
"""Walks of a candidate: the name of the condition of each, and its row."""
FINALISTS = 5
"""Candidates on the second set of walks where the file does not say."""


class WalkSet(Part):
    """On what candidates are walked: each of the seeds under each of the conditions."""

    seeds: Seeds = Field(min_length=1)
    conditions: tuple[str, ...] = ()
    """Names of the study's conditions; empty: all."""


class WalkSets(Part):
    """The three sets of walks, without a seed in common."""

    search: WalkSet
    choice: WalkSet
    test: WalkSet

    @model_validator(mode="after")
    def _disjoint(self) -> WalkSets:
        """Raises ValueError for seeds in two sets."""
        for (a, x), (b, y) in itertools.combinations(self, 2):
            if both := sorted({*x.seeds} & {*y.seeds}):
                raise ValueError(
                    f"{a} and {b} share the seeds {both[:5]}, expected others: a choice made on walks makes "
                    "them look better than they are"
                )
        return self


class Variable(Part):
    """One thing that the search may change: the numbers of a range, or one of several choices."""

    range: Range | None = None
    """Of a number; None for choices."""
    choices: tuple[Any, ...] = ()
    """Values to choose from; empty for a range."""
    when: dict[str, tuple[Any, ...]] = Field(default_factory=dict)
    """By name of another field: those of its values with which this variable has an effect. Empty: always."""

    @property
    def middle(self) -> Any:
        """The first choice, or the middle of the range."""
        return self.choices[0] if self.range is None else self.range.at(0.5)

    def holds(self, x: object) -> bool:
        """Whether x is among its values."""
        if self.range is None:
            return x in self.choices
        return isinstance(x, float | int) and self.range.low <= x <= self.range.high

    def acts(self, values: Values) -> bool:
        """Whether it has an effect beside these values of a scenario."""
        return all(
            values.get(name, field_of(name).default) in those for name, those in self.when.items()
        )


def _variable(name: str, given: Any) -> Variable:
    """One variable of a file. Raises ValueError."""
    field_of(name)
    if name == SEED:
        raise Refused("the sets of walks have the seeds; a search may not choose its luck")
    if not isinstance(given, Mapping):
        raise Refused(f"found {given!r}, expected {{from, to}} or {{choices}}")
    beside = flat(dict(given.get("when", {})))
    lists = {n: x if isinstance(x, list) else [x] for n, x in beside.items()}
    when = {n: tuple(read(n, x) for x in values) for n, values in lists.items()}
    rest = {key: x for key, x in given.items() if key != "when"}
    if "choices" not in rest:
        return Variable(range=read_range(name, rest), when=when)
    choices = tuple(read(name, x) for x in rest["choices"])
    if set(rest) != {"choices"} or len({repr(x) for x in choices}) < max(len(choices), 2):
        raise Refused(f"found {given!r}, expected {{choices, when}} with different choices")
    return Variable(choices=choices, when=when)


class Search(Part):
    """What is searched, and how candidates are judged."""

    variables: dict[str, Variable] = Field(min_length=1)
    objective: Objective
    limits: tuple[Limit, ...] = ()
    """What a candidate has to keep."""
    walks: WalkSets
    budget: int = Field(ge=1)
    """Candidates of each case that are walked on the first set, the setting of the case among them."""
    generation: int = Field(ge=1)
    """Candidates that are proposed together, without knowing of each other's walks."""
    finalists: int = Field(default=FINALISTS, ge=1)
    """Candidates that are walked on the second set."""
    seed: int = Field(default=0, ge=0)
    """Of the sampler."""

    @model_validator(mode="before")
    @classmethod
    def _read(cls, given: Any) -> Any:
        """Variables are read with their units."""
        if isinstance(given, Mapping) and "variables" in given:
            return {**given, "variables": each(given["variables"], _variable)}
        return given

    @property
    def measures(self) -> tuple[Measure, ...]:
        """The objective, then the limits."""
        return (self.objective, *self.limits)

    def count(self, sets: Mapping[str, int]) -> int:
        """Walks of one case at most. sets: walks of a candidate, by name of the set."""
        return (
            self.budget * sets["search"] + (self.finalists + 1) * sets["choice"] + 2 * sets["test"]
        )

    def acting(self, values: Values) -> dict[str, Variable]:
        """The variables that may have an effect beside these values, which no variable changes."""
        fixed = {name: x for name, x in values.items() if name not in self.variables}
        return {
            name: v
            for name, v in self.variables.items()
            if all(
                n in self.variables or Variable(when={n: x}).acts(fixed) for n, x in v.when.items()
            )
        }

    def values(self, base: Values, chosen: Values) -> dict[str, Any]:
        """The values of a candidate's scenario: the base, and what was chosen that has an effect."""
        made = {**base, **chosen}
        while idle := [
            n for n, v in self.variables.items() if n in chosen and n in made and not v.acts(made)
        ]:
            for name in idle:  # and in the next round those that depend on one of them
                del made[name]
        return made

    def some(self, values: Values) -> Iterator[dict[str, Any]]:
        """Candidates that stand for all: the middle of all variables, and each choice with the others there.

        Corners of ranges may be refused, as gains that do not go together are: their walks rank worst.
        """
        acting = self.acting(values)
        middle = {name: v.middle for name, v in acting.items()}
        for name, v in {"": Variable(choices=("",)), **acting}.items():
            for x in v.choices:
                chosen = middle | ({name: x} if name else {})
                made = self.values(values, chosen)
                yield {n: made[n] for n in chosen if n in made}


class Candidate(NamedTuple):
    """A setting that was proposed, and how its walks were judged."""

    number: int
    """Its place in the search; 0 is the setting of the case itself."""
    chosen: dict[str, Any]
    """A value of every variable; empty for number 0."""
    objective: float
    """Infinite where walks that rank worst decide."""
    limits: tuple[float | None, ...]
    """The numbers that are limited; None for those of walks where it was not walked."""
    missed: tuple[float, ...]
    """By how much each limit is missed, as a share of its bound; 0 where it is kept."""
    walked: bool
    """False where it missed a limit that needs no walk."""

    @property
    def feasible(self) -> bool:
        """Whether it was walked and keeps all limits."""
        return self.walked and not any(self.missed)


def judged(
    search: Search,
    number: int,
    chosen: Values,
    walks: Walks | None,
    known: Mapping[str, float | None],
) -> Candidate:
    """The candidate with these walks, None where it is not walked. known: its columns that need no walk."""
    found = [
        None if walks is None and m.column not in known else m.of(walks or (), known)
        for m in search.limits
    ]
    missed = [0.0 if x is None else m.excess(x) for m, x in zip(search.limits, found, strict=True)]
    objective = search.objective.worst if walks is None else search.objective.of(walks, known)
    return Candidate(
        number, dict(chosen), objective, tuple(found), tuple(missed), walks is not None
    )


def ranked(search: Search, found: Sequence[Candidate]) -> list[Candidate]:
    """The walked candidates, best first: by what they miss, by the objective, by number."""
    sign = 1.0 if search.objective.less_is_better else -1.0
    walked = [c for c in found if c.walked]
    return sorted(walked, key=lambda c: (sum(c.missed), sign * c.objective, c.number))
