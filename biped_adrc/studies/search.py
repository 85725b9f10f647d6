"""What a search looks for, and on which walks: variables, an objective, limits, three sets of walks.

    [search]              budget, generation, finalists, seed, objective, limits
    [search.variables]    p = {from, to, scale, whole, when} or p = {choices, when}
    [search.walks]        search, choice, test = {seeds, conditions}

A case is a named set of values of the study, from which a search starts; each case has its own search, with
the same budget. A condition is a named set of other values, under which each is walked. A candidate is the case
with other values of the variables: these are its setting. A row is the results of one walk by column. Counted
in candidates are

- budget: how many of a case are walked in the first round of its search, for each variable that has an effect
  there; the case itself is one of them;
- doublings: most rounds after it, each of as many as all before it;
- generation: how many are proposed together, before any of them is walked;
- finalists: how many of the best are walked on the second set; where none of them keeps the limits there, as
  many of the ones after them, MOST_GROUPS times at most.

objective = {column, over, goal} is one number of a candidate: that column of the results, in its unit, over all
walks of a set (the median, or as `over` says), to be minimised or maximised. limits = [{column, over, least or
most}, ...] bound other columns in the same way. seeds and conditions of a set say which walks it has: one for
each seed and named condition.

p is the name of a field of the scenario. Its variable has

- from, to: the ends of an interval, in the unit of the field; scale: "linear" or "log"; whole = true: integers;
- or choices: a list of values;
- when = {field = values}: it has an effect only where another field has one of these values.

Candidates are searched on the first set of walks. On the second the finalists and the case itself are walked
again, and one is chosen; on the third the chosen one and the case are walked once. A measure that was minimised
over noise is too good on the walks it was minimised on: no two sets share a seed.

Some columns need no walk (`measure`). A candidate that misses a limit on one of them is judged and not walked,
and does not count in the budget. The case itself is candidate number 0. How candidates are proposed, and when
a search ends, is in `proposals`.
"""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Annotated, Any, NamedTuple

from pydantic import BeforeValidator, Field

from biped_adrc.scenario.dotted import flat
from biped_adrc.scenario.hardware import PROFILES
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.build import Values
from biped_adrc.studies.measure import Aim, Limit, Measure, Row, numbers_without_walk
from biped_adrc.studies.space import Section, Seeds, Span, by_entry, read_list, read_range, table

ENOUGH = 0.02
"""The objective has changed if it did by more than this share of itself [1]."""
MOST_GROUPS = 8
"""Most times that finalists are walked. The best of many candidates may keep limits on the first set by chance:
of 640 candidates none of the best 8 kept them on other seeds, in five searches of forty."""
STEPS = {"down": -0.1, "up": 0.1}
"""By which shares of its range a variable of the chosen candidate is moved, to see what stopped the search."""

Walks = Sequence[tuple[str, Row]]
"""Walks of a candidate: for each the name of its condition, and its row of results."""


class WalkSet(Section):
    """A set of walks by which each candidate is judged: one for each seed under each condition."""

    seeds: Seeds = Field(min_length=1)
    conditions: tuple[str, ...] = ()
    """Names of the study's conditions; empty: all."""


class WalkSets(Section):
    """The three sets of walks, without a seed in common; a candidate is searched, chosen and tested on them."""

    search: WalkSet
    choice: WalkSet
    test: WalkSet


class Variable(Section):
    """One thing that the search may change: the numbers of a range, or one of several choices."""

    range: Span | None = None
    """The interval of a variable that is a number; None for one with choices."""
    choices: tuple[Any, ...] = ()
    """Values to choose from; empty for a range."""
    when: dict[str, tuple[Any, ...]] = Field(default_factory=dict)
    """Name of another field -> those of its values with which this variable has an effect. Empty: always."""

    @property
    def middle(self) -> Any:
        """The first choice, or the middle of the range: on a logarithmic scale the geometric mean."""
        return self.choices[0] if self.range is None else self.range.at(0.5)

    def acts(self, values: Values, free: Collection[str] = ()) -> bool:
        """Whether the variable has an effect in a scenario with these values: by `when`, where a field without
        a value has that of the hardware's profile, or its default. free: names of fields that may still get any
        value; these count as met.
        """
        profile = PROFILES.get(values.get("hardware.profile", ""), {})
        known = {**flat({"hardware": profile}), **values}
        # those: the values of the field `name` with which this variable has an effect
        return all(
            name in free or known.get(name, Scenario.field_of(name).default) in those
            for name, those in self.when.items()
        )


def _variable(name: str, value: Any) -> Variable:
    """The variable of the field `name`, from its table in a file, with its values read with units. A single
    value in `when` may stand without a list. Raises ValueError.
    """
    keys = table(value)  # a copy, from which `when` can be taken out
    beside = keys.pop("when", {})
    when = by_entry(beside, lambda n, x: read_list(n, x if isinstance(x, list | tuple) else [x]))
    if "choices" in keys:
        choices = read_list(name, keys["choices"], 2)  # two at least
        return Variable.model_validate({**keys, "choices": choices, "when": when})
    return Variable(range=read_range(name, keys), when=when)


Variables = Annotated[
    dict[str, Variable], BeforeValidator(lambda value: by_entry(value, _variable))
]
"""Variables by name, read with their units."""


class Candidate(NamedTuple):
    """A setting that was proposed, and how its walks were judged."""

    number: int
    """Its place in the search; 0 is the setting of the case itself."""
    chosen: dict[str, Any]
    """A value of every variable; empty for number 0."""
    values: dict[str, Any]
    """All values of its scenario, without condition and seed."""
    objective: float
    """In the unit of its column; infinite, on the worse side, where walks that are infeasible decide it."""
    missed: tuple[float, ...]
    """By how much each limit is missed, as a share of its bound; 0 where it is kept."""
    walked: bool
    """False where it missed a limit that is known without a walk, so that no walk was spent on it."""

    @property
    def feasible(self) -> bool:
        """Whether the candidate was walked and keeps all limits."""
        return self.walked and not any(self.missed)


class Search(Section):
    """A search: the variables that it changes, its objective and limits, and the walks by which it judges
    them.
    """

    variables: Variables = Field(min_length=1)
    objective: Aim
    limits: tuple[Limit, ...] = ()
    """What a candidate has to keep."""
    walks: WalkSets
    budget: int = Field(ge=1)
    """Candidates of a case that are walked on the first set, for each variable that has an effect in it."""
    doublings: int = Field(default=0, ge=0, le=8)
    """Most times that they are doubled, for all cases, while that gains ENOUGH in one of them or one has a
    variable at an end of its range. With more of them a study goes on in the folder of its results."""
    generation: int = Field(ge=1)
    """Candidates that are proposed together, without knowing of each other's walks."""
    finalists: int = Field(default=5, ge=1)
    """Candidates that are walked on the second set together."""
    seed: int = Field(default=0, ge=0)
    """Seed of the sampler for the first case, + 1 for the next: so equal cases are several searches."""

    @property
    def measures(self) -> tuple[Measure, ...]:
        """The objective, then the limits."""
        return (self.objective, *self.limits)

    def first(self, values: Values) -> int:
        """The number of candidates in the first round of a case with these values."""
        return self.budget * max(1, len(self.acting(values)))

    def count(self, sets: Mapping[str, int], values: Values) -> int:
        """Largest number of walks of the search of a case with these values. sets: "search", "choice", "test"
        -> number of walks of one candidate in this set.

        The case itself is walked beside the finalists, and on the test set beside the chosen one: + 1, and 2.
        Two settings beside the chosen one are walked for each variable.
        """
        beside = MOST_GROUPS * self.finalists + 1 + 2 * len(self.acting(values))
        again = beside * sets["choice"] + 2 * sets["test"]
        return (self.first(values) << self.doublings) * sets["search"] + again

    def acting(self, values: Values) -> dict[str, Variable]:
        """The variables, by name, that may have an effect in a case with these values, whatever values the
        search gives to the other variables.
        """
        # all variables are free, so only fields that are no variables can make one idle
        return {name: v for name, v in self.variables.items() if v.acts(values, self.variables)}

    def values(self, base: Values, chosen: Values) -> dict[str, Any]:
        """The values of a candidate's scenario: those of the case (`base`), and over them the chosen values of
        the variables that have an effect.
        """
        candidate = {**base, **chosen}
        acts = {n: v.acts for n, v in self.variables.items() if n in chosen}
        # an idle variable is left out with all its values, that of the case too: the scenario has its default
        while idle := [n for n in acts if n in candidate and not acts[n](candidate)]:
            for name in idle:  # and in the next round those that depend on one of them
                del candidate[name]
        return candidate

    def judged(
        self, base: Values, number: int, chosen: dict[str, Any], walks: Walks | None = None
    ) -> Candidate:
        """Judge the setting `chosen` (values of the variables, by name) of a case as candidate `number`: its
        objective, and by how much it misses each limit.

        base: values of the case. walks: its walks; None for a candidate that has not been walked, of which only
        limits on columns that need no walk are judged, and whose objective is the worst.
        """
        values = self.values(base, chosen)
        # column -> number, of those columns that need no walk; m.excess: by how much a limit is missed
        known = numbers_without_walk([m.column for m in self.measures], values)
        # before the walks, a limit that needs them counts as kept
        missed = (
            0.0 if walks is None and m.column not in known else m.excess(m.of(walks or (), known))
            for m in self.limits
        )
        objective = self.objective.worst if walks is None else self.objective.of(walks, known)
        return Candidate(number, chosen, values, objective, tuple(missed), walks is not None)

    def ranked(self, found: Sequence[Candidate]) -> list[Candidate]:
        """The walked ones of the candidates `found`, best first: by the sum of what they miss of limits, then
        by the objective, then by number.
        """
        walked, sign = [c for c in found if c.walked], self.objective.sign
        return sorted(walked, key=lambda c: (sum(c.missed), sign * c.objective, c.number))

    def gain(self, before: Candidate, after: Candidate) -> float:
        """The share [1] of the objective by which a candidate is better than another one, negative where it is
        worse; infinite where one of them misses a limit, or the objective is 0 or infinite.
        """
        x, y, fine = before.objective, after.objective, before.feasible and after.feasible
        return (
            self.objective.sign * (x - y) / abs(x) if fine and x and abs(x) < math.inf else math.inf
        )

    def beside(self, base: Values, c: Candidate) -> dict[str, dict[str, Any]]:
        """Settings beside that of a candidate, each as its values of the variables: one variable that is a
        number shifted by STEPS of its range, down or up. The keys say which, as "controller.K_p up".
        """
        ranges = {n: v.range for n, v in self.acting(base).items() if v.range and n in c.chosen}
        moves = ((n, r, word, w) for n, r in ranges.items() for word, w in STEPS.items())
        beside = {f"{n} {word}": (n, r.shift(c.chosen[n], w)) for n, r, word, w in moves}
        return {key: c.chosen | {n: x} for key, (n, x) in beside.items() if x != c.chosen[n]}

    def stop(self, c: Candidate, beside: Mapping[str, Candidate]) -> str:
        """What stopped the search at a candidate, in words. beside: the settings of `beside`, walked; none for
        the case itself.

        A step misses a limit, makes the objective worse, or changes it by less than ENOUGH, which is flat. A
        step that makes it better by more says that the candidate is not tuned.
        """
        if not beside:
            return "not tuned: nothing better than the case itself was found"
        gains = {k: self.gain(c, x) for k, x in beside.items() if x.feasible}
        if better := [f"{k} by {x:.0%}" for k, x in gains.items() if x >= ENOUGH]:
            return f"not tuned: better with {', '.join(better)}"
        words = {
            m.sentence: [k for k, x in beside.items() if x.missed[i] > 0.0]
            for i, m in enumerate(self.limits)
        }
        words["the objective"] = [k for k, x in gains.items() if x <= -ENOUGH]
        words["nothing, as it is flat"] = [k for k, x in gains.items() if abs(x) < ENOUGH]
        return "; ".join(f"stopped by {k}: {', '.join(x)}" for k, x in words.items() if x)

    def some(self, values: Values) -> Iterator[dict[str, Any]]:
        """Yield settings that stand for all in a case with these values: the middle of all variables, and each
        choice beside the middle of the others; each as the values of those variables that have an effect.

        It is for a check that walkers can be built. Corners of ranges are not tried: they may be refused, as
        gains that do not go together are, and then only their walks rank worst.
        """
        acting = self.acting(values)
        middle = {name: v.middle for name, v in acting.items()}
        choices = ({name: x} for name, v in acting.items() for x in v.choices)
        for choice in ({}, *choices):
            candidate = self.values(values, middle | choice)
            yield {n: candidate[n] for n in middle if n in candidate}
