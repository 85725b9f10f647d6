"""What a search looks for, and on which walks: variables, an objective, limits, three sets of walks.

    [search]              budget, generation, finalists, seed, objective, limits
    [search.variables]    p = {from, to, scale, whole, when} or p = {choices, when}
    [search.walks]        search, choice, test = {seeds, conditions}

A case is a named set of values of the study, from which a search starts; each case has its own search, with
the same budget. A condition is a named set of other values, under which each is walked. A candidate is the case
with other values of the variables: these are its setting. A row is the results of one walk by column. Counted
in candidates are

- budget: how many of a case are walked in the search, the case itself among them;
- generation: how many are proposed together, before any of them is walked;
- finalists: how many of the best are walked on the second set.

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

Candidates are proposed by Optuna's samplers in whole generations, after all earlier ones have been judged, in
this process alone, and the sampler is told the results in a fixed order: what is proposed depends on the seed
and on judged candidates, and neither on workers nor on kills. The first part of the budget is proposed by TPE
(Bergstra et al., NeurIPS 2011), which takes ranges, whole numbers and choices together; the rest by CMA-ES
(Hansen, Ostermeier, Evolutionary Computation 9(2), 2001) from the best candidates so far (Nomura et al., AAAI
2021), with the choices of the best one. Both use only the order of the candidates, so each is told to them as
one number, less for a better one: the objective, with its sign changed where more is better; or, for a
candidate that misses limits, a number above every objective, larger the more it misses.

Some columns need no walk (`measure`). A candidate that misses a limit on one of them is judged and not walked,
and does not count in the budget. The case itself is candidate number 0.
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from typing import Annotated, Any, NamedTuple

from pydantic import BeforeValidator, Field

from biped_adrc.core.errors import optional
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.build import Values
from biped_adrc.studies.measure import Aim, Limit, Measure, Row, numbers_without_walk
from biped_adrc.studies.space import Section, Seeds, Span, by_entry, read_list, read_range, table

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
        a value has its default. free: names of fields that may still get any value; these count as met.
        """
        # those: the values of the field `name` with which this variable has an effect
        return all(
            name in free or values.get(name, Scenario.field_of(name).default) in those
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
    """Candidates of each case that are walked on the first set, the setting of the case among them."""
    generation: int = Field(ge=1)
    """Candidates that are proposed together, without knowing of each other's walks."""
    finalists: int = Field(default=5, ge=1)
    """Candidates that are walked on the second set."""
    seed: int = Field(default=0, ge=0)
    """Seed of the sampler."""

    @property
    def measures(self) -> tuple[Measure, ...]:
        """The objective, then the limits."""
        return (self.objective, *self.limits)

    def count(self, sets: Mapping[str, int]) -> int:
        """Largest number of walks of the search of one case. sets: "search", "choice", "test" -> number of
        walks of one candidate in this set.

        The case itself is walked beside the finalists, and on the test set beside the chosen one: + 1, and 2.
        """
        again = (self.finalists + 1) * sets["choice"] + 2 * sets["test"]
        return self.budget * sets["search"] + again

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


FIRST_PART = 0.4
"""The share of the budget that TPE proposes at least."""
_SMALLEST = 10
"""Least number of candidates of TPE before CMA-ES takes over, which begins from the best tenth of them."""
_ASKED = 8
"""Most proposals for each place of a generation, since some miss a limit that is known without a walk."""
_MISSED = 1e30
"""The sampler minimises; a candidate that misses limits has this number times 1 + the sum of its misses, above
every objective."""

WalkAll = Callable[[Sequence[Candidate]], Sequence[Walks]]
"""A function that walks candidates, and returns their walks in the same order."""


def optuna_library() -> Any:
    """Import Optuna, and let it print warnings only. Raises InputError where it or cmaes is missing."""
    with optional("study", "a search needs Optuna and cmaes, which are not installed"):
        import cmaes  # noqa: F401
        import optuna
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    warnings.simplefilter("ignore", optuna.exceptions.ExperimentalWarning)
    return optuna


def searched(
    search: Search, base: Values, walk: WalkAll, report: Callable[[Candidate], None]
) -> list[Candidate]:
    """Search a case: returns all its candidates by number; number 0 is the case itself, with the values `base`.

    walk: walks the candidates of a generation. report: called with the best candidate after each generation.
    The search ends with the budget, or when a whole round of proposals misses limits that are known without a
    walk. Raises InputError where Optuna is missing.
    """
    proposals = _Proposals(optuna_library(), search, base)
    result: list[Candidate] = []
    numbers = itertools.count()
    while (left := search.budget - sum(c.walked for c in result)) > 0:
        # those to be walked in this generation, and all that are judged in it
        batch, new = list[Candidate](), list[Candidate]()
        for number in itertools.islice(numbers, _ASKED * search.generation):
            # without walks: judged by limits that need none; number 0 is the case itself, with no other values
            c = search.judged(base, number, proposals.ask(number) if number else {})
            # the case itself is walked in any event, as it is what the others are compared with
            if number == 0 or not any(c.missed):
                batch.append(c)
            else:
                new.append(c)
                proposals.tell(c)
            if len(batch) == min(left, search.generation):
                break
        if not batch:  # all of _ASKED proposals for each place missed limits: the search ends
            break
        for c, walks in zip(batch, walk(batch), strict=True):
            new.append(search.judged(base, c.number, c.chosen, walks))
            proposals.tell(new[-1])
        result += sorted(new, key=lambda c: c.number)
        report(search.ranked(result)[0])  # the best one so far
        proposals.refine(result)  # to CMA-ES, when TPE's part is spent
    return result


class _Proposals:
    """Optuna's proposals for one case: first those of its sampler TPE, then (`refine`) those of CMA-ES.

    space: variable -> Optuna's distribution from which its values are proposed. fixed: values of the variables
    that are not proposed any more. open: Optuna's trials that are not judged yet, by number of the candidate.
    study: Optuna's, which proposes values and is told how good they were. refining: whether TPE's part is over.
    """

    def __init__(self, optuna: Any, search: Search, base: Values) -> None:
        """optuna: the module. base: values of the case, by which variables without an effect are left out."""
        self.optuna, self.search = optuna, search
        self.space = {n: self._distribution(v) for n, v in search.acting(base).items()}
        self.fixed: dict[str, Any] = {}
        self.open: dict[int, Any] = {}
        self.refining = False
        # the first 10 are random
        sampler = optuna.samplers.TPESampler(seed=search.seed, n_startup_trials=10)
        self.study = optuna.create_study(sampler=sampler)

    def _distribution(self, variable: Variable) -> Any:
        """The distribution of Optuna for a variable: of its choices, integers, or floats on its scale."""
        of, r = self.optuna.distributions, variable.range
        if r is None:
            return of.CategoricalDistribution(variable.choices)
        if r.whole:
            return of.IntDistribution(int(r.low), int(r.high))
        return of.FloatDistribution(r.low, r.high, log=r.scale == "log")

    def ask(self, number: int) -> dict[str, Any]:
        """Propose values, by name, of all variables that may have an effect for the candidate `number`."""
        trial = self.open[number] = self.study.ask(self.space)
        return {**self.fixed, **trial.params}

    def tell(self, c: Candidate) -> None:
        """Tell Optuna how a candidate was judged; nothing for number 0, the case itself, which it did not
        propose.
        """
        if c.number in self.open:
            self.study.tell(self.open.pop(c.number), self.score(c))

    def score(self, c: Candidate) -> float:
        """The number that Optuna minimises: the objective, with its sign changed where more is better; for
        missed limits a number above all of these, larger with what is missed, and by one miss more if no walk
        was spent on it.
        """
        if any(c.missed) or not c.walked:
            # _MISSED, above every objective
            return _MISSED * (1.0 + sum(c.missed) + (not c.walked))
        return min(self.search.objective.sign * c.objective, _MISSED)

    def refine(self, found: Sequence[Candidate]) -> None:
        """Change from TPE to CMA-ES, once TPE's part of the budget is spent; later calls do nothing.

        CMA-ES needs two variables with ranges and generations of four; else TPE goes on. It keeps the choices
        of the best candidate (`fixed`).
        """
        # walked candidates, best first, without the case itself, number 0
        # TPE's part: the share FIRST_PART of the budget, and at least _SMALLEST of them
        best = [c for c in self.search.ranked(found) if c.number]
        if self.refining or len(best) < max(_SMALLEST, FIRST_PART * self.search.budget):
            return
        self.refining = True
        # CMA-ES takes ranges alone, and of these the ones that have an effect beside the best one's choices
        acting, variables = best[0].values, self.search.variables
        space = {n: x for n, x in self.space.items() if n in acting and variables[n].range}
        if len(space) < 2 or self.search.generation < 4:
            return
        # the candidates so far, by their values of these variables, become the trials from which CMA-ES begins
        create, scores = self.optuna.trial.create_trial, [(c.chosen, self.score(c)) for c in best]
        trials = [
            create(params={n: chosen[n] for n in space}, distributions=space, value=score)
            for chosen, score in scores
        ]
        self.space, self.fixed = space, {n: x for n, x in best[0].chosen.items() if n not in space}
        seed, size = self.search.seed, self.search.generation
        sampler = self.optuna.samplers.CmaEsSampler(seed=seed, popsize=size, source_trials=trials)
        self.study = self.optuna.create_study(sampler=sampler)
        self.study.add_trials(trials)
