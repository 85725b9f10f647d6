"""How a search proposes candidates, and when it ends.

Candidates are proposed by Optuna's samplers in whole generations, after all earlier ones have been judged, in
this process alone, and the sampler is told the results in a fixed order: what is proposed depends on the seed
and on judged candidates, and neither on workers nor on kills. The first part of the budget is proposed by TPE
(Bergstra et al., NeurIPS 2011), which takes ranges, whole numbers and choices together; the rest by CMA-ES
(Hansen, Ostermeier, Evolutionary Computation 9(2), 2001) from the best candidates so far (Nomura et al., AAAI
2021), with the choices of the best one. Both use only the order of the candidates, so each is told to them as
one number, less for a better one: the objective, with its sign changed where more is better; or, for a
candidate that misses limits, a number above every objective, larger the more it misses.

A search goes round by round, each of as many candidates as all before it. After a round a variable whose best
value stands at an end of its range (`Span.beyond`) has that end moved by the width of the range, so that only
limits and the objective stop a search. Which of them does is asked of settings beside the chosen one
(`Search.stop`). All cases of a study go on while a round of one of them still moves something, so that each has
as many candidates for a variable as the others (`last_rounds`).
"""

import itertools
import math
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from biped_adrc.core.errors import optional
from biped_adrc.studies.build import Values
from biped_adrc.studies.search import ENOUGH, Candidate, Search, Variable, Walks
from biped_adrc.studies.space import Span

FIRST_PART = 0.4
"""The share of the budget that TPE proposes at least."""
_SMALLEST = 10
"""Least number of candidates of TPE before CMA-ES takes over, which begins from the best tenth of them."""
_ASKED = 8
"""Most proposals for each place of a generation, since some miss a limit that is known without a walk."""
_MISSED = 1e30
"""The sampler minimises; a candidate that misses limits has this number times 1 + the sum of its misses, above
every objective."""

_APART = 1000
"""Between the seeds of a sampler and of the one after it."""

WalkAll = Callable[[Sequence[Candidate]], Sequence[Walks]]
"""A function that walks candidates, and returns their walks in the same order."""
Report = Callable[[Candidate], None]
"""A function that is called with the best candidate so far."""


def optuna_library() -> Any:
    """Import Optuna, and let it print warnings only. Raises InputError where it or cmaes is missing."""
    with optional("study", "a search needs Optuna and cmaes, which are not installed"):
        import cmaes  # noqa: F401
        import optuna
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    warnings.simplefilter("ignore", optuna.exceptions.ExperimentalWarning)
    return optuna


class Round(NamedTuple):
    """A search after a round."""

    candidates: list[Candidate]
    """All candidates by number; number 0 is the case itself."""
    gain: float
    """The share [1] that the round gained; infinite without a round before it."""
    ends: tuple[str, ...]
    """Variables that stand at an end of their range in the best candidate: the search is not over."""

    @property
    def still(self) -> bool:
        """Whether the round moved nothing: it gained less than ENOUGH, with no variable at an end."""
        return not self.ends and self.gain < ENOUGH


def searched(
    search: Search, base: Values, walk: WalkAll, report: Report, seed: int | None = None
) -> Iterator[Round]:
    """Search a case with the values `base`; yield it after each round.

    walk: walks the candidates of a generation. report: called with the best candidate after each generation.
    seed: of the sampler, that of the search if None. It ends with the last doubling, or when all of a
    generation's proposals miss limits that are known without a walk. Raises InputError where Optuna is missing.
    """
    proposals = _Proposals(optuna_library(), search, base, search.seed if seed is None else seed)
    result, ends = proposals.judged, dict[str, Span]()
    for doubled in range(search.doublings + 1):
        if doubled:
            proposals.widen(ends)
            proposals.refine(result, again=True)
        before, most = search.ranked(result)[:1], search.first(base) << doubled
        proposals.round(most, walk, report)
        best = search.ranked(result)[0]
        ends = proposals.ends(best)
        yield Round(result, search.gain(before[0], best) if before else math.inf, tuple(ends))
        if _walked(result) < most:
            break


def last_rounds(searches: Mapping[str, Iterator[Round]]) -> dict[str, Round]:
    """The last rounds of several searches, which go on while a round of one of them moves something."""
    last = {name: next(rounds) for name, rounds in searches.items()}
    while not all(x.still for x in last.values()):
        new = {name: x for name, rounds in searches.items() if (x := next(rounds, None))}
        if not new:
            break
        last |= new
    return last


def _walked(found: Sequence[Candidate]) -> int:
    """How many of the candidates were walked."""
    return sum(c.walked for c in found)


class _Proposals:
    """Optuna's proposals for one case: first those of its sampler TPE, then (`refine`) those of CMA-ES.

    space: variable -> Optuna's distribution from which its values are proposed. fixed: values of the variables
    that are not proposed any more. open: Optuna's trials that are not judged yet, by number of the candidate.
    study: Optuna's, which proposes values and is told how good they were. refining: whether TPE's part is over.
    ranges: of variables that are numbers, which `widen` moves. judged: all candidates so far. base: values of
    the case. numbers: of the candidates to come.
    """

    def __init__(self, optuna: Any, search: Search, base: Values, seed: int) -> None:
        """optuna: the module. base: values of the case, by which variables without an effect are left out.
        seed: of the samplers.
        """
        self.optuna, self.search, self.base, self.seed = optuna, search, base, seed
        self.numbers, acting = itertools.count(), search.acting(base)
        self.ranges = {n: v.range for n, v in acting.items() if v.range is not None}
        self.space = {n: self._distribution(n, v) for n, v in acting.items()}
        self.judged: list[Candidate] = []
        self.fixed: dict[str, Any] = {}
        self.open: dict[int, Any] = {}
        self.refining = False
        # the first 10 are random
        sampler = optuna.samplers.TPESampler(seed=seed, n_startup_trials=10)
        self.study = optuna.create_study(sampler=sampler)

    def _distribution(self, name: str, variable: Variable) -> Any:
        """The distribution of Optuna for a variable: of its choices, integers, or floats on its scale."""
        of, r = self.optuna.distributions, self.ranges.get(name)
        if r is None:
            return of.CategoricalDistribution(variable.choices)
        if r.whole:
            return of.IntDistribution(int(r.low), int(r.high))
        return of.FloatDistribution(r.low, r.high, log=r.scale == "log")

    def round(self, most: int, walk: WalkAll, report: Report) -> None:
        """Walk candidates, generation by generation, until `most` have been walked in all, and add them to
        `judged`. There are fewer where all proposals of a generation miss limits that are known without a walk.
        """
        search, base = self.search, self.base
        while (left := most - _walked(self.judged)) > 0:
            # those to be walked in this generation, and all that are judged in it
            batch, new = list[Candidate](), list[Candidate]()
            for number in itertools.islice(self.numbers, _ASKED * search.generation):
                # without walks: judged by limits that need none; number 0 is the case itself, with no other
                # values
                c = search.judged(base, number, self.ask(number) if number else {})
                # the case itself is walked in any event, as it is what the others are compared with
                if number == 0 or not any(c.missed):
                    batch.append(c)
                else:
                    new.append(c)
                    self.tell(c)
                if len(batch) == min(left, search.generation):
                    break
            if not batch:  # all of _ASKED proposals for each place missed limits: the search ends
                break
            for c, walks in zip(batch, walk(batch), strict=True):
                new.append(search.judged(base, c.number, c.chosen, walks))
                self.tell(new[-1])
            self.judged += sorted(new, key=lambda c: c.number)
            report(search.ranked(self.judged)[0])  # the best one so far
            self.refine(self.judged)  # to CMA-ES, when TPE's part is spent

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

    def ends(self, best: Candidate) -> dict[str, Span]:
        """The variables of the best candidate that stand at an end of their range, with the range moved there.

        An end at 0 is none: what the variable weighs is left out there.
        """
        moved = {n: r.beyond(best.chosen[n]) for n, r in self.ranges.items() if n in best.chosen}
        return {n: r for n, r in moved.items() if r is not None}

    def widen(self, ends: Mapping[str, Span]) -> None:
        """Propose from these ranges from now on, in place of the old ones."""
        self.ranges |= ends
        self.space |= {n: self._distribution(n, self.search.variables[n]) for n in ends}

    def refine(self, found: Sequence[Candidate], again: bool = False) -> None:
        """Change from TPE to CMA-ES, once TPE's part of the budget is spent; later calls do nothing. again:
        whether to begin CMA-ES in any event, anew from the best candidates, as a new round does.

        CMA-ES needs two variables with ranges and generations of four; else TPE goes on. It keeps the choices
        of the best candidate (`fixed`).
        """
        # walked candidates, best first, without the case itself, number 0
        # TPE's part: the share FIRST_PART of the budget, and at least _SMALLEST of them
        best = [c for c in self.search.ranked(found) if c.number]
        first = FIRST_PART * self.search.budget * max(1, len(self.space))
        if not best or (not again and (self.refining or len(best) < max(_SMALLEST, first))):
            return
        self.refining, seed = True, self.seed
        self.seed += _APART
        # CMA-ES takes ranges alone, and of these the ones that have an effect beside the best one's choices
        acting, variables = best[0].values, self.search.variables
        space = {n: self._distribution(n, variables[n]) for n in self.ranges if n in acting}
        if len(space) < 2 or self.search.generation < 4:
            return
        # the candidates so far, by their values of these variables, become the trials from which CMA-ES begins
        create, scores = self.optuna.trial.create_trial, [(c.chosen, self.score(c)) for c in best]
        trials = [
            create(params={n: chosen[n] for n in space}, distributions=space, value=score)
            for chosen, score in scores
        ]
        self.space, self.fixed = space, {n: x for n, x in best[0].chosen.items() if n not in space}
        sampler = self.optuna.samplers.CmaEsSampler(
            seed=seed, popsize=self.search.generation, source_trials=trials
        )
        self.study = self.optuna.create_study(sampler=sampler)
        self.study.add_trials(trials)
