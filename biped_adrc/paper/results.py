"""What the tasks of a reproduction returned, by kind and name; a kind that was not computed is empty.

Tasks have names such as "multipliers/ADRC" or "cycles/gait (b), tac2003, NPD": kind, and key in its mapping.
Made by `paper.reproduction`; read by the claims, tables and pictures.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from biped_adrc.core.types import Array
from biped_adrc.paper.members import MemberOutcome
from biped_adrc.paper.poincare import PoincareResult, Regression, regression_of
from biped_adrc.paper.push_map import PushCell
from biped_adrc.paper.runs import Headline, Order, Start
from biped_adrc.paper.scenarios import CONTROLLERS, Plan
from biped_adrc.scenario.recording import Outcome


@dataclass(frozen=True)
class Results:
    """By kind of task, the results by name."""

    plan: Plan
    """What was asked for."""
    headline: Mapping[str, Headline] = field(default_factory=dict)
    """The pushed walks, by controller."""
    runs: Mapping[str, Outcome] = field(default_factory=dict)
    """Walks at two steps, by the names of `scenarios.base_runs`."""
    claim_runs: Mapping[str, Outcome] = field(default_factory=dict)
    """Those of the claims alone, by the names of `scenarios.claim_runs`."""
    members: Mapping[str, list[MemberOutcome]] = field(default_factory=dict)
    """The push on the joints at all declared choices, by preset."""
    pushed_recipe: Mapping[str, list[MemberOutcome]] = field(default_factory=dict)
    """A push on gait (b), by preset."""
    engines: Mapping[str, float] = field(default_factory=dict)
    """Difference of the engines over the pushed step [rad, rad/s], by controller."""
    multipliers: Mapping[str, PoincareResult] = field(default_factory=dict)
    """Walking cycles with all multipliers, by controller (and reset policy)."""
    cycles: Mapping[str, PoincareResult | str] = field(default_factory=dict)
    """Walking cycles by gait, preset, controller and Theta'', or why there is none."""
    starts: Mapping[str, list[Start]] = field(default_factory=dict)
    """Walks around the least speed, by preset."""
    jumps: Mapping[str, dict[str, float]] = field(default_factory=dict)
    """What is not smooth, by preset."""
    orders: Mapping[str, dict[str, Order]] = field(default_factory=dict)
    """Observers of different order, by preset."""
    model: Mapping[str, dict[str, float]] = field(default_factory=dict)
    """Violations of the laws of the model, by preset."""
    map: Mapping[str, list[PushCell]] = field(default_factory=dict)
    """Parts of the map of pushes."""
    numerics: Mapping[str, dict[str, float]] = field(default_factory=dict)
    """Figures of the numerical methods, one entry."""
    returns: Mapping[str, tuple[Array, Array]] = field(default_factory=dict)
    """By "map": Theta' before an impact and before the next one [rad/s], both (K,)."""

    @classmethod
    def of(cls, plan: Plan, values: Mapping[str, Any]) -> Results:
        """Sort what the tasks of a plan returned, by their names."""
        kinds: dict[str, dict[str, Any]] = {}
        for of, value in values.items():
            kind, _, name = of.partition("/")
            kinds.setdefault(kind.replace(" ", "_"), {})[name] = value
        return cls(plan, **kinds)

    @property
    def regressions(self) -> dict[str, Regression]:
        """The regression (26), (27) on the pushed walks, by controller."""
        return {c: regression_of(head.outcome) for c, head in self.headline.items()}

    @property
    def cells(self) -> list[PushCell]:
        """The map of pushes, all parts of it."""
        return [cell for part in self.map.values() for cell in part]

    @property
    def figures(self) -> dict[str, float]:
        """Figures of the numerical methods, by name with unit."""
        return {name: x for result in self.numerics.values() for name, x in result.items()}

    def pair(self, name: str) -> tuple[Outcome, Outcome]:
        """A walk under NPD and under ADRC, of the headline where the name is "push"."""
        if name == "push":
            npd, adrc = (self.headline[c].outcome for c in CONTROLLERS)
        else:
            npd, adrc = ({**self.runs, **self.claim_runs}[f"{name} {c}"] for c in CONTROLLERS)
        return npd, adrc

    def on_gait(self, gait: str) -> dict[str, Outcome]:
        """The undisturbed walks on gait "a" or "b", by "gait (.), preset, controller"."""
        word = {"a": "nominal", "b": "gait (b)"}[gait]
        return {
            f"gait ({gait}), {preset}, {c}": self.runs[f"{word} {preset} {c}"]
            for preset in self.plan.presets
            for c in CONTROLLERS
        }

    @property
    def run_twice(self) -> dict[str, Outcome]:
        """Every walk that is checked at two steps, by name."""
        heads = {f"push {c}": head.outcome for c, head in self.headline.items()}
        return heads | dict(self.runs)
