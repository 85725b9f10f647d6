"""The task of a learner: a scenario, the meaning of its action, when a walk is over, and the reward.

    reward of a sample = alive + tracking / (1 + |e|^2 / e_1^2) - effort |u|^2 / u_1^2

with the true error e = q_b - h(Theta) [rad] and the torque u [N m] that acts, both at the end of the sample,
e_1 = 0.1 rad, and u_1^2 the square of all motors at their limit. The sample in which the walk falls has the
reward 0. No reward is negative, as effort is at most alive: to walk on pays more than to fall, and to track
well most.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated, Any

import numpy as np

from biped_adrc.core.checks import Checked, NonNegativeFloat, PositiveFloat, one_of
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import packaged
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.model.robots.limits import KnownLimits
from biped_adrc.scenario.build import RIGID, RobotAndGait, limits
from biped_adrc.scenario.dotted import flat, merged, nested
from biped_adrc.scenario.scenario import Scenario

_TABLES = packaged("biped_adrc.extras.gym", "conditions.toml")
BASE: dict[str, object] = flat(_TABLES["base"])
"""Values that all conditions share."""
CONDITIONS: dict[str, dict[str, object]] = {
    name: flat({k: x for k, x in table.items() if k != "words"})
    for name, table in _TABLES["conditions"].items()
}
"""Name of a condition -> fields of the scenario, on top of `BASE`."""
OF_RIGID = "errors.impact_width"
"""A field of the scenario that only walks on the rigid plant have."""
TORQUES, ADDED = "torques", "added"
"""Meaning of an action: all of the torque, or an addition to the torque of the scenario's controller."""
NEAR = 0.1
"""e_1 of the reward [rad]."""
FALLEN_FROM = 1e-9
"""Tolerance of the time limit [s]: a sample that ends so little before it is the last."""


@dataclass(frozen=True)
class LearnerTask(Checked, Shown):
    """A scenario, the meaning of its action, the time limit and the weights of the reward.

    Raises InputError for an action that does not exist, a time or weight out of range, and fields of the
    scenario that would have no effect.
    """

    scenario: Scenario
    """The scenario; its seed is replaced by that of each walk."""
    action: Annotated[str, one_of((TORQUES, ADDED))] = TORQUES
    """ "torques": the action is the whole torque; "added": it is added to that of the scenario's controller."""
    seconds: PositiveFloat = 10.0
    """Longest walk [s]."""
    alive: NonNegativeFloat = 1.0
    """Reward of a sample that does not end the walk [1]."""
    tracking: NonNegativeFloat = 1.0
    """Reward of a sample without tracking error [1]."""
    effort: NonNegativeFloat = 0.1
    """Cost of a sample with all motors at their limit [1], at most `alive`."""

    def __post_init__(self) -> None:
        if self.effort > self.alive:
            raise InputError(
                f"effort = {self.effort} is above alive = {self.alive}: to fall would pay"
            )
        mine = flat({"controller": self.scenario.controller.record()})
        if self.action == TORQUES and mine:
            raise InputError(
                f"{', '.join(mine)} would do nothing where the action is all of the torque; leave it out, or "
                "take action = 'added'"
            )

    @classmethod
    def of(cls, scenario: Scenario | None, condition: str | None, **values: Any) -> LearnerTask:
        """Make the task of a scenario, or of a condition by name on the base of all conditions.

        values: fields of the task, and of the scenario, by name. Raises InputError for a condition that does
        not exist on this plant, and for values that are no scenario.
        """
        if scenario is not None and condition is not None:
            raise InputError("a scenario and a condition were given, expected one of them")
        how = {f.name: values.pop(f.name) for f in fields(cls) if f.name in values}
        record = nested(values)
        if scenario is not None:
            return cls(scenario.replace(record), **how)
        ground = record.get("ground", RIGID)
        plant = ground if isinstance(ground, str) else ground.get("plant", RIGID)
        there = [name for name, x in CONDITIONS.items() if plant == RIGID or OF_RIGID not in x]
        name = condition or "nothing"
        if name not in there:
            raise InputError(
                f"there is no condition {name!r} on plant '{plant}', expected one of {there}"
            )
        return cls(Scenario(**merged(nested({**BASE, **CONDITIONS[name]}), record)), **how)

    def limits(self, scene: RobotAndGait) -> KnownLimits:
        """Limits of ground and motors; the torque limit is the scenario's where that is lower."""
        known = limits(self.scenario).of(scene.biped.description)
        limit = self.scenario.hardware.torque_limit
        return known if limit is None else known._replace(torque=min(limit, known.torque))

    def rewards(self, squares: Array, goes_on: Array, most: float) -> Array:
        """Rewards (N,) [1] of N walks, from |e|^2 [rad^2] and |u|^2 [N^2 m^2] (N, 2) and
        whether each goes on (N,).

        most: u_1^2 [N^2 m^2].
        """
        e, u = squares[:, 0] / NEAR**2, squares[:, 1] / most
        paid: Array = self.alive + self.tracking / (1.0 + e) - self.effort * u
        return np.where(goes_on, paid, 0.0)
