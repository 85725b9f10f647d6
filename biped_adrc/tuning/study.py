"""A tuning study: what is searched, by which measures candidates are judged, and on which walks.

Three sets of walks share no seed. On the training set candidates are searched; on the selection set the best
few of them and the as-published setting are walked again, and one is chosen; on the test set the chosen one and
the as-published setting are walked once, after every choice has been made. A measure that was minimised over
noise is too good to be true on the walks it was minimised on, which is why each choice needs walks of its own.

`tuning.study_file` makes a `TuningStudy` from TOML, `tuning.tune` carries it out.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from typing import Literal

from pydantic import Field

from biped_adrc.bench.parameters import Value
from biped_adrc.bench.study import CONDITION, SEED, Named, Part, record_of
from biped_adrc.campaign.chunk import Point, key_of, text_of
from biped_adrc.tuning.measure import Aim, Limit, Measure
from biped_adrc.tuning.variables import Values, Variable, published_place, scenario_values

SETS = ("training", "selection", "test")
"""The sets of walks, in the order in which they are walked."""
SET, CANDIDATE = "set", "candidate"
"""Names under which the set and the candidate's number stand beside the condition and the seed of a walk."""

Sampler = Literal["cma-es", "tpe", "nsga-ii", "random"]
"""What proposes candidates."""


class WalkSet(Part):
    """On what candidates are walked: each of the seeds under each of the conditions."""

    seeds: tuple[int, ...] = Field(min_length=1)
    conditions: tuple[Named, ...] = ()
    """Values that go before those of a candidate; empty: none."""

    @property
    def count(self) -> int:
        """Walks of one candidate."""
        return len(self.seeds) * max(len(self.conditions), 1)

    @property
    def named(self) -> tuple[Named, ...]:
        """The conditions; one without a name and values where there are none."""
        return self.conditions or (Named(name=""),)

    def points(self, values: Values, at: Mapping[str, Value]) -> Iterator[Point]:
        """The walks of a candidate with these values; at: where it lies in the study."""
        for condition, seed in itertools.product(self.named, self.seeds):
            made = {**values, **condition.values, SEED: seed}
            yield Point(record_of(made), {**at, CONDITION: condition.name, SEED: seed})


class TuningStudy(Part):
    """What is searched, and how candidates are judged; made by `read_tuning`, which checks it as a whole."""

    name: str
    """How results, tables and errors call it."""
    description: str = ""
    """A text for the reader; it takes no part in the hash."""
    fixed: dict[str, Value] = Field(default_factory=dict)
    """Values that all candidates share; by themselves they are the as-published setting."""
    variables: dict[str, Variable] = Field(min_length=1)
    """What is searched, by name; of a name that `fixed` has too, that value is the as-published one."""
    objectives: tuple[Aim, ...] = Field(min_length=1)
    """The first one decides which candidate is chosen."""
    limits: tuple[Limit, ...] = ()
    """What every candidate has to keep."""
    training: WalkSet
    selection: WalkSet
    test: WalkSet
    budget: int = Field(ge=1)
    """Candidates that are walked on the training set, the as-published setting among them."""
    generation: int = Field(ge=1)
    """Candidates that are proposed together, without knowing of each other's walks."""
    finalists: int = Field(ge=1)
    """Candidates that are walked on the selection set."""
    seed: int = Field(ge=0)
    """Of the sampler."""
    sampler: Sampler = "cma-es"

    @property
    def measures(self) -> tuple[Measure, ...]:
        """Objectives, then limits."""
        return (*self.objectives, *self.limits)

    def walks(self, kind: str) -> WalkSet:
        """The set of this name."""
        found: WalkSet = getattr(self, kind)
        return found

    def values(self, chosen: Values) -> dict[str, Value]:
        """The values of the scenario of a candidate; {} is the as-published setting."""
        return scenario_values(self.variables, self.fixed, chosen) if chosen else dict(self.fixed)

    @property
    def place(self) -> dict[str, Value] | None:
        """The as-published setting as a candidate among others; None where it lies outside of the ranges."""
        return published_place(self.variables, self.fixed)

    @property
    def configuration(self) -> dict[str, object]:
        """The whole study as plain values, with the hash of the test set; stored before the first walk."""
        return {**self.model_dump(mode="json"), "test_hash": self.test_hash}

    @property
    def hash(self) -> str:
        """A hash of everything but the description."""
        return key_of(text_of(self.model_dump(mode="json", exclude={"description"})))

    @property
    def test_hash(self) -> str:
        """A hash of the seeds and conditions of the test set."""
        return key_of(text_of(self.test.model_dump(mode="json")))
