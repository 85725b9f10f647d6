"""What is tried next: Optuna's samplers, asked so that neither workers nor kills change the answer.

A sampler that is told results as they arrive proposes something else on another machine. Here every request
makes a fresh study in memory, adds what is finished in the order of numbers, and seeds the sampler by

    (seed of the study, generation, round)

so that what is proposed depends on these and on finished candidates alone, and no sampler is ever stored.

For one objective the sampler is "cma-es": TPE (Bergstra et al., NeurIPS 2011; with constraints) for the first
part of the budget, CMA-ES around its best candidate for the rest (`tuning.refinement`). TPE takes ranges,
whole numbers and choices together, and uses only the order of results, so that an infinite one does no
harm; Optuna's Gaussian processes need torch. Its own CMA-ES knows neither choices nor limits. For several
objectives it is NSGA-II (Deb et al., IEEE Trans. Evol. Comp. 6, 2002): on a linear plant whose front is known,
TPE may stay in one part of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from biped_adrc.bench.parameters import Value
from biped_adrc.errors import InputError
from biped_adrc.tuning.candidate import Candidate
from biped_adrc.tuning.refinement import refined
from biped_adrc.tuning.study import TuningStudy
from biped_adrc.tuning.variables import Variable

NOT_WALKED = 1.0
"""By how much a candidate without walks counts as missing a limit on them: as much as one without any feasible
walk misses a share of them. With 0 a search stays with candidates that are not worth a walk."""
STARTUP = 10
"""Candidates that are drawn at random before TPE begins."""
GENERATION = "generation"
"""Under this name Optuna's trials carry the generation of their candidate."""


@contextmanager
def optuna_quiet() -> Iterator[Any]:
    """Context that gives Optuna, which says warnings alone meanwhile. Raises InputError where it is missing."""
    try:
        import optuna
    except ImportError:
        raise InputError(
            "tuning needs Optuna, which is not installed; pip install 'biped-adrc[tune]'"
        ) from None
    before = optuna.logging.get_verbosity()
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    try:
        yield optuna
    finally:
        optuna.logging.set_verbosity(before)


def proposed(
    study: TuningStudy, found: Sequence[Candidate], generation: int, round_: int, count: int
) -> list[dict[str, Value]]:
    """`count` settings to try, each with a value of every variable, after the candidates `found`."""
    seed = _seed(study, generation, round_)
    if study.sampler == "cma-es":
        settings = refined(study, found, generation, count, seed)
        if settings is not None:
            return settings
    with optuna_quiet() as optuna:
        made = optuna_study(optuna, study, found, _sampler(optuna, study, generation, seed))
        space = _distributions(optuna, study.variables)
        return [dict(made.ask(space).params) for _ in range(count)]


def optuna_study(
    optuna: Any,
    study: TuningStudy,
    found: Sequence[Candidate],
    sampler: Any = None,
    storage: Any = None,
) -> Any:
    """An Optuna study with the candidates that lie in the ranges, in their order."""
    made = optuna.create_study(
        storage=storage,
        sampler=sampler,
        study_name=study.name,
        directions=[m.goal.replace("ise", "ize") for m in study.objectives],
    )
    space = _distributions(optuna, study.variables)
    made.add_trials(
        optuna.trial.create_trial(
            params=place,
            distributions=space,
            values=c.objectives,
            user_attrs={"candidate": c.number, GENERATION: c.generation, "walked": c.walked},
            constraints=_missed(study, c),
        )
        for c in found
        if (place := c.chosen or study.place) is not None
    )
    return made


def _missed(study: TuningStudy, c: Candidate) -> dict[str, float]:
    """By how much the candidate misses each limit, as the sampler is told; `NOT_WALKED` where it is unknown."""
    each = zip(study.limits, c.limits, c.excess, strict=True)
    return {m.sentence: NOT_WALKED if x is None else excess for m, x, excess in each}


def importances(study: TuningStudy, found: Sequence[Candidate]) -> dict[str, float]:
    """How much each variable decides whether a candidate is among the best tenth, in shares of 1.

    By PED-ANOVA (Watanabe et al., IJCAI 2023). Empty where there are too few candidates, or one variable.
    """
    if len(study.variables) < 2 or len(found) < 2 * STARTUP:
        return {}
    with optuna_quiet() as optuna:
        made = optuna_study(optuna, study, [c for c in found if c.walked])
        evaluator = optuna.importance.PedAnovaImportanceEvaluator()
        shares = optuna.importance.get_param_importances(made, evaluator=evaluator)
    return {name: float(x) for name, x in shares.items()}


def _seed(study: TuningStudy, generation: int, round_: int) -> int:
    """Of the random numbers of this generation and round."""
    sequence = np.random.SeedSequence(study.seed, spawn_key=(generation, round_))
    return int(sequence.generate_state(1)[0])


def _sampler(optuna: Any, study: TuningStudy, generation: int, seed: int) -> Any:
    """The sampler of the study."""
    if study.sampler == "random":
        return optuna.samplers.RandomSampler(seed=seed)
    if study.sampler == "nsga-ii":
        return _nsga_ii(optuna, study, generation, seed)
    return optuna.samplers.TPESampler(seed=seed, n_startup_trials=STARTUP)


def _nsga_ii(optuna: Any, study: TuningStudy, generation: int, seed: int) -> Any:
    """NSGA-II whose generations are those of the study, and not counted from how many trials there are."""

    class OfGeneration(optuna.samplers.NSGAIISampler):  # type: ignore[misc]
        """NSGA-II that proposes for one generation."""

        def get_trial_generation(self, _: Any, trial: Any) -> int:
            return int(trial.user_attrs.get(GENERATION, generation))

        def get_population(self, made: Any, wanted: int) -> list[Any]:
            trials = made.get_trials(deepcopy=False)
            return [t for t in trials if t.user_attrs.get(GENERATION) == wanted]

    return OfGeneration(seed=seed, population_size=study.generation)


def _distributions(optuna: Any, variables: dict[str, Variable]) -> dict[str, Any]:
    """The variables as Optuna has them."""
    return {name: _distribution(optuna.distributions, x) for name, x in variables.items()}


def _distribution(distributions: Any, variable: Variable) -> Any:
    """One variable as Optuna has it."""
    r = variable.range
    if r is None:
        return distributions.CategoricalDistribution(variable.choices)
    if r.whole:
        return distributions.IntDistribution(int(r.low), int(r.high))
    return distributions.FloatDistribution(r.low, r.high, log=r.scale == "log")
