"""What is tried next: Optuna's samplers, asked so that neither workers nor kills change the answer.

A sampler that is told results as they arrive proposes something else on another machine. Here every request
makes a fresh study in memory, adds what is finished in the order of numbers, and seeds the sampler by

    (seed of the study, generation, round)

so that what is proposed depends on these and on finished candidates alone, and no sampler is ever stored.

For one objective the sampler is TPE (Bergstra et al., NeurIPS 2011; multivariate, with constraints). It takes
ranges, whole numbers and choices together, uses only the order of results, so that an infinite one does no
harm, and needs no more than NumPy; Optuna's Gaussian processes need torch, and its CMA-ES knows neither choices
nor limits. For several objectives it is NSGA-II (Deb et al., IEEE Trans. Evol. Comp. 6, 2002): on a linear
plant whose front is known, TPE may stay in one part of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from biped_adrc.bench.parameters import Value
from biped_adrc.errors import InputError
from biped_adrc.tuning.candidate import Candidate
from biped_adrc.tuning.study import TuningStudy
from biped_adrc.tuning.variables import Variable

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
    with optuna_quiet() as optuna:
        made = optuna_study(optuna, study, found, _sampler(optuna, study, generation, round_))
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
            constraints={m.sentence: x for m, x in zip(study.limits, c.excess, strict=True)},
        )
        for c in found
        if (place := c.chosen or study.place) is not None
    )
    return made


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


def _sampler(optuna: Any, study: TuningStudy, generation: int, round_: int) -> Any:
    """The sampler of the study, with the random numbers of this generation and round."""
    sequence = np.random.SeedSequence(study.seed, spawn_key=(generation, round_))
    seed = int(sequence.generate_state(1)[0])
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
