"""What a search tries next: Optuna's samplers, asked for whole generations.

A generation is proposed after all earlier ones have been judged, in this process alone, and told in the order
of its numbers: what is proposed depends on the seed and on finished candidates, and neither on workers nor on
kills.

The first part of the budget is proposed by TPE (Bergstra et al., NeurIPS 2011), which takes ranges, whole
numbers and choices together; the rest by CMA-ES (Hansen, Ostermeier, Evolutionary Computation 9(2), 2001)
from the best candidates so far (Nomura et al., AAAI 2021), with the choices of the best one. Both use the
order of candidates alone: a number stands for it, the objective of those that keep all limits, and more than
any for the others.
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Callable, Sequence
from typing import Any

from biped_adrc.core.errors import optional
from biped_adrc.studies.build import Values
from biped_adrc.studies.search import Candidate, Search, Variable, Walks, judged, ranked

FIRST_PART = 0.4
"""The share of the budget that TPE has."""
SMALLEST = 10
"""Candidates of TPE below which it goes on alone; CMA-ES begins from the best tenth."""
ASKED = 8
"""How often a generation asks again in place of candidates that miss a limit without a walk."""
MISSED = 1e30
"""What the sampler is told of a candidate that misses limits, times 1 + what it misses."""

Walk = Callable[[Sequence[Candidate]], Sequence[Walks]]
"""From candidates to their walks, in the same order."""


def optuna_library() -> Any:
    """Optuna, which says warnings alone. Raises InputError where it or cmaes is missing."""
    with optional("study", "a search needs Optuna and cmaes, which are not installed"):
        import cmaes  # noqa: F401
        import optuna
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    warnings.simplefilter("ignore", optuna.exceptions.ExperimentalWarning)
    return optuna


def searched(
    search: Search, base: Values, walk: Walk, report: Callable[[Candidate], None]
) -> list[Candidate]:
    """All candidates of a case by number; number 0 is the case itself, with the values `base`.

    told: called with the best candidate after each generation. Raises InputError where none may be walked.
    """
    proposals = _Proposals(optuna_library(), search, base)
    result: list[Candidate] = []
    numbers = itertools.count()
    while (left := search.budget - sum(c.walked for c in result)) > 0:
        batch: list[Candidate] = []
        new: list[Candidate] = []
        for number in itertools.islice(numbers, ASKED * search.generation):
            c = judged(search, base, number, proposals.ask(number) if number else {})
            if any(c.missed) and number:
                new.append(c)
                proposals.tell(c)
                continue
            batch.append(c)
            if len(batch) == min(left, search.generation):
                break
        if not batch:
            break
        for c, walks in zip(batch, walk(batch), strict=True):
            new.append(judged(search, base, c.number, c.chosen, walks))
            proposals.tell(new[-1])
        result += sorted(new, key=lambda c: c.number)
        report(ranked(search, result)[0])
        proposals.refine(result)
    return result


class _Proposals:
    """Optuna's study of one case, and its trials that are not judged yet, by number of the candidate."""

    def __init__(self, optuna: Any, search: Search, base: Values) -> None:
        self.optuna, self.search = optuna, search
        self.space = {n: self._distribution(v) for n, v in search.acting(base).items()}
        self.fixed: dict[str, Any] = {}
        self.open: dict[int, Any] = {}
        self.refining = False
        sampler = optuna.samplers.TPESampler(seed=search.seed, n_startup_trials=10)
        self.study = optuna.create_study(sampler=sampler)

    def _distribution(self, variable: Variable) -> Any:
        """One variable as Optuna has it."""
        of, r = self.optuna.distributions, variable.range
        if r is None:
            return of.CategoricalDistribution(variable.choices)
        if r.whole:
            return of.IntDistribution(int(r.low), int(r.high))
        return of.FloatDistribution(r.low, r.high, log=r.scale == "log")

    def ask(self, number: int) -> dict[str, Any]:
        """The next candidate, with a value of every variable."""
        trial = self.open[number] = self.study.ask(self.space)
        return {**self.fixed, **trial.params}

    def tell(self, c: Candidate) -> None:
        """Tell Optuna how a candidate was judged; that of the case itself was not asked for."""
        if c.number in self.open:
            self.study.tell(self.open.pop(c.number), self.score(c))

    def score(self, c: Candidate) -> float:
        """A number by which candidates have their order."""
        if any(c.missed) or not c.walked:
            return MISSED * (1.0 + sum(c.missed) + (not c.walked))
        return min(self.search.objective.sign * c.objective, MISSED)

    def refine(self, found: Sequence[Candidate]) -> None:
        """Go on with CMA-ES, once TPE's part of the budget is spent and where there is something to refine."""
        best = [c for c in ranked(self.search, found) if c.number]
        if self.refining or len(best) < max(SMALLEST, FIRST_PART * self.search.budget):
            return
        self.refining = True
        choices = self.optuna.distributions.CategoricalDistribution
        space = {
            name: x
            for name, x in self.space.items()
            if name in best[0].values and not isinstance(x, choices)
        }
        if len(space) < 2 or self.search.generation < 4:
            return
        trials = [
            self.optuna.trial.create_trial(
                params={name: c.chosen[name] for name in space},
                distributions=space,
                value=self.score(c),
            )
            for c in best
        ]
        self.space, self.fixed = space, {n: x for n, x in best[0].chosen.items() if n not in space}
        sampler = self.optuna.samplers.CmaEsSampler(
            seed=self.search.seed, popsize=self.search.generation, source_trials=trials
        )
        self.study = self.optuna.create_study(sampler=sampler)
        self.study.add_trials(trials)
