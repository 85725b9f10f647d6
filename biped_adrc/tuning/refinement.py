"""The later part of a search: CMA-ES from the best candidate that TPE has found.

TPE finds where in the box good settings are, and is slow to find the best of them. CMA-ES (Hansen, Ostermeier,
Evolutionary Computation 9(2), 2001; here the library `cmaes`) draws around a mean and learns from each
generation how variables act together. It begins around the best candidate, with the covariance of the best
fifth (Nomura, Watanabe, Akimoto, Ozaki, Onishi, AAAI 2021), and uses the order of candidates alone: by what
they miss, then by the first objective.

Ranges are mapped to [0, 1], by their scale; choices stay as those of the best candidate, and what is idle
beside them as well. As with the other samplers nothing is stored: what CMA-ES has learned is told to it anew
from finished generations, and its random numbers come from a seed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from biped_adrc.bench.parameters import Value
from biped_adrc.bench.study import Range
from biped_adrc.errors import InputError
from biped_adrc.tuning.candidate import Candidate, ranked
from biped_adrc.tuning.study import TuningStudy
from biped_adrc.types import Array

FIRST_PART = 0.4
"""The share of the budget that TPE has."""
BEST = 0.2
"""The share of TPE's walked candidates whose covariance CMA-ES begins with."""
LEAST_SPREAD = 0.05
"""A standard deviation that the first generation has besides, as a share of each range."""
SMALLEST = 4
"""Candidates, of a generation and of TPE's, below which TPE goes on alone."""
SMALLEST_SPACE = 2
"""Ranges that are searched, below which it does so too."""


def cma_library() -> Any:
    """The library `cmaes`. Raises InputError where it is missing."""
    try:
        import cmaes
    except ImportError:
        raise InputError(
            "tuning needs cmaes, which is not installed; pip install 'biped-adrc[tune]'"
        ) from None
    return cmaes


def refined(
    study: TuningStudy, found: Sequence[Candidate], generation: int, count: int, seed: int
) -> list[dict[str, Value]] | None:
    """`count` settings by CMA-ES, each with a value of every variable; None while TPE is to propose.

    TPE proposes until its part of the budget is spent, and goes on where there is little to refine.
    """
    library = cma_library()
    begin = _begin(study, [c for c in found if c.generation < generation])
    if begin is None:
        return None
    before = _places(study, [c for c in found if c.generation < begin])
    if min(len(before), study.generation) < SMALLEST:
        return None
    place, ranges = before[0], _searched(study, before[0])
    if len(ranges) < SMALLEST_SPACE:
        return None
    told = [(_in_box(ranges, x), float(i)) for i, x in enumerate(before)]
    _, sigma, cov = library.get_warm_start_mgd(told, max(BEST, SMALLEST / len(told)), LEAST_SPREAD)
    mean, box = told[0][0], np.tile([0.0, 1.0], (len(ranges), 1))
    evolution = library.CMA(mean, sigma, box, seed=seed, population_size=study.generation, cov=cov)
    for g in range(begin, generation):
        population = _places(study, [c for c in found if c.generation == g])
        if len(population) == study.generation:
            evolution.tell([(_in_box(ranges, x), float(i)) for i, x in enumerate(population)])
    return [{**place, **_values(ranges, evolution.ask())} for _ in range(count)]


def _places(study: TuningStudy, found: Sequence[Candidate]) -> list[dict[str, Value]]:
    """The settings of the walked candidates among these that lie in the ranges, best first."""
    return [x for c in ranked(study, found) if (x := c.chosen or study.place) is not None]


def _begin(study: TuningStudy, found: Sequence[Candidate]) -> int | None:
    """The first generation of CMA-ES, by the candidates of all generations so far; None if not yet."""
    walked = 0
    for generation in range(1 + max((c.generation for c in found), default=-1)):
        walked += sum(c.walked for c in found if c.generation == generation)
        if walked >= FIRST_PART * study.budget:
            return generation + 1
    return None


def _searched(study: TuningStudy, place: Mapping[str, Value]) -> dict[str, Range]:
    """The ranges of the variables that act beside the choices of `place`."""
    acting = study.values(place)
    return {
        name: v.range
        for name, v in study.variables.items()
        if v.range is not None and name in acting
    }


def _in_box(ranges: Mapping[str, Range], place: Mapping[str, Value]) -> Array:
    """Where a setting lies in the unit box, (number of ranges,)."""
    return np.array([r.share(float(place[name])) for name, r in ranges.items()])  # type: ignore[arg-type]


def _values(ranges: Mapping[str, Range], w: Array) -> dict[str, Value]:
    """The setting at w in the unit box."""
    return {
        name: r.at(min(x, math.nextafter(1.0, 0.0)))
        for (name, r), x in zip(ranges.items(), w.tolist(), strict=True)
    }
