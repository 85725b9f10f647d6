"""What the tasks of a reproduction returned, sorted by kind into typed fields.

Tasks have names such as "multipliers ADRC" or "recipe tac2003 NPD": the first word is the kind, the rest the
key in that kind's mapping. Names of no kind are walks. Made by `paper.reproduction`; read by `paper.verdicts`,
`paper.tables`, `paper.pictures` and the claims.

A missing kind is an empty mapping, so that a quick plan, which has no map of pushes, needs no other type.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from biped_adrc.analysis.regression import Regression
from biped_adrc.checks import Check
from biped_adrc.paper.claims.tasks import Evidence
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.plan import Headline, Plan, RecipeResult
from biped_adrc.paper.push_map import PushCell
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.studies.cycle_stability import PoincareResult, regression_of
from biped_adrc.types import Array


@dataclass(frozen=True)
class Results:
    """By kind, with the rest of the task's name as key: a controller, a preset, or both."""

    headline: Mapping[str, tuple[Headline, list[Check]]]
    """The pushed walks by controller, each with the laws that it was held against."""
    multipliers: Mapping[str, PoincareResult]
    """Walking cycles with their multipliers, by controller (and reset policy)."""
    engines: Mapping[str, Outcome]
    """The pushed step on Pinocchio's dynamics, the same compiled in `half`, by controller."""
    recipe: Mapping[str, RecipeResult]
    """What became of gait (b), by preset and controller."""
    model: Mapping[str, list[Check]]
    """Laws of the model, by preset."""
    map: Mapping[str, list[PushCell]]
    """Parts of the map of pushes; empty where it was not asked for."""
    numerics: Mapping[str, tuple[list[Check], dict[str, float]]]
    """Laws and figures of the numerical methods, one entry."""
    returns: Mapping[str, tuple[Array, Array]]
    """By "map": Theta' before an impact and before the next one [rad/s], both (K,)."""
    claims: Mapping[str, Evidence]
    """The evidence for the claims, in parts."""
    runs: Mapping[str, Outcome] = field(default_factory=dict)
    """All other walks, by their whole names."""

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> Results:
        """Sort what the tasks of a plan returned, by their names.

        The first word is looked up among the fields; "return map" is the only kind of two words; what is left
        is a walk.
        """
        kinds: dict[str, dict[str, Any]] = {kind: {} for kind in cls.__dataclass_fields__}
        for name, value in values.items():
            kind, _, rest = name.partition(" ")
            if kind in kinds:
                kinds[kind][rest] = value
            elif name == "return map":
                kinds["returns"]["map"] = value
            else:
                kinds["runs"][name] = value
        return cls(**kinds)

    @property
    def heads(self) -> dict[str, Headline]:
        """The pushed walks by controller, without their laws."""
        return {c: self.headline[c][0] for c in CONTROLLERS if c in self.headline}

    @property
    def regressions(self) -> dict[str, Regression]:
        """The regression (26), (27) on the pushed walks, by controller."""
        return {c: regression_of(head.outcome) for c, head in self.heads.items()}

    @property
    def cells(self) -> list[PushCell]:
        """The map of pushes, all parts of it."""
        return [cell for part in self.map.values() for cell in part]

    @property
    def figures(self) -> dict[str, float]:
        """Figures of the numerical laws, by name with unit."""
        return {k: v for _, found in self.numerics.values() for k, v in found.items()}

    def pair(self, name: str) -> tuple[Outcome, Outcome]:
        """A walk under NPD and under ADRC."""
        npd, adrc = (self.runs[f"{name} {c}"] for c in CONTROLLERS)
        return npd, adrc

    def nominal(self, plan: Plan) -> Iterator[tuple[str, Outcome]]:
        """The undisturbed walks on gait (a), by "preset controller"."""
        for name in (f"{preset} {c}" for preset in plan.presets for c in CONTROLLERS):
            yield name, self.runs[f"nominal {name}"]

    def recipes(self, plan: Plan) -> Iterator[RecipeResult]:
        """What became of gait (b), preset by preset, in the order of the plan."""
        return (self.recipe[f"{preset} {c}"] for preset in plan.presets for c in CONTROLLERS)

    @property
    def run_twice(self) -> dict[str, Outcome]:
        """Every walk that was computed at two steps, by name."""
        found = {f"push {c}": self.heads[c].outcome for c in CONTROLLERS} | dict(self.runs)
        for r in self.recipe.values():
            if r.outcome is not None:
                found[f"gait (b) {r.preset} {r.controller}"] = r.outcome
        return {name: o for name, o in found.items() if o.half is not None}
