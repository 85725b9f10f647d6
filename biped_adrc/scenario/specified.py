"""The specification of a scenario: columns of a candidate that need no walk.

    specified(ba.Scenario({"name": "LESO", "observer": {"bandwidth": 160.0, "order": 2}}, hardware="rabbit"))

gives `stable`, `growth` [1/s], `delay_margin` [s], `disk_margin`, `ripple` [N m] by name, each a number. An
unstable loop has margins 0 and an infinite ripple. What the scenario does to the walk, such as pushes,
ground and start, has no part in it; what it does to the robot has, as plant beside the model.
"""

from __future__ import annotations

from functools import lru_cache

from biped_adrc.analysis.loops.frozen_gait import FrozenGait
from biped_adrc.analysis.loops.specification import Specification, specification
from biped_adrc.core.errors import InputError
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, plant_of
from biped_adrc.scenario.scenario import ErrorRecord, Scenario


def specification_of(s: Scenario, scene: RobotAndGait | None = None) -> Specification:
    """Of the walker that a scenario describes.

    scene: robot and gait where they are at hand; for many candidates give the same, whose linearisations are
    kept. Raises InputError for a scenario in continuous time, on
    another plant than the rigid one, without motors, or whose controller has to notice touchdowns.
    """
    if s.ground.plant != RIGID:
        raise InputError(
            f"a specification was asked for on plant '{s.ground.plant}', expected '{RIGID}', whose equations "
            "it linearises"
        )
    scene = RobotAndGait.of(s) if scene is None else scene
    return specification(build(s, scene), _frozen(scene, s.errors, s.run.seed))


@lru_cache(maxsize=16)
def _frozen(scene: RobotAndGait, errors: ErrorRecord, seed: int) -> FrozenGait:
    """The gait linearised for a plant with the model errors of a scenario.

    No controller has a part in it, so the candidates of a search share it.
    """
    plant = plant_of(Scenario(errors=errors, run={"seed": seed}), scene.biped)
    return FrozenGait.of(plant, scene.walked, scene.biped)


def specified(s: Scenario, scene: RobotAndGait | None = None) -> dict[str, float]:
    """The numbers of `specification_of` by name, none of them NaN. Raises InputError as it."""
    return specification_of(s, scene).columns()
