"""A walk as an environment of Gymnasium: `gymnasium.make("biped_adrc.extras.gym:biped_adrc/Walk-v0")`.

    env = gymnasium.make("biped_adrc.extras.gym:biped_adrc/Walk-v0", condition="push on joints")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(action)

A step is a sample of the walk, from one sample instant to the next (1 ms by default); one in which the foot
strikes ends there, where the clock restarts. `view` has the observation, `task` the reward.
"""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.extras.gym.picture import Picture
from biped_adrc.extras.gym.stage import Stage
from biped_adrc.extras.gym.task import LearnerTask
from biped_adrc.scenario.scenario import MOST_SEED, Scenario
from biped_adrc.scenario.stepper import finite_numbers


def spaces_of(stage: Stage) -> tuple[Box, Box]:
    """Gymnasium's spaces of one observation and of one action."""
    observations = Box(-stage.highest, stage.highest, dtype=np.float64)
    return observations, Box(-1.0, 1.0, (stage.plant.p,), np.float64)


def check_options(options: dict[str, Any] | None) -> None:
    """Raise InputError for options of a reset: there are none."""
    if options:
        raise InputError(f"reset has the options {sorted(options)}, expected none")


class WalkEnv(gymnasium.Env[Any, Any]):
    """One walk.

    - scenario: `biped_adrc.Scenario`, or a condition by name ("nothing" without), on the base of
      its comparisons. values: fields of the scenario by name, such as plant, gait, push, amplitude.
    - action: "torques", all of the torque, or "added", beside that of the scenario's controller. For each motor
      a share of its limit, the scenario's where that is lower [N m]; the motors give no more than that.
    - seconds [s]: longest walk. alive, tracking, effort: weights of the reward (`task.LearnerTask`).
    - render_mode: "rgb_array"; with "human" `gymnasium.make` shows these pictures in a window of pygame's.

    `reset(seed=k)` walks the scenario with seed = k; without a seed another one is drawn. Raises InputError.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 1000}  # noqa: RUF012

    def __init__(
        self,
        scenario: Scenario | None = None,
        condition: str | None = None,
        render_mode: str | None = None,
        **values: Any,
    ):
        task, self.render_mode = LearnerTask.of(scenario, condition, **values), render_mode
        self.stage = Stage(task, 1, render_mode is not None)
        self.observation_space, self.action_space = spaces_of(self.stage)
        self.picture = Picture(self.stage) if render_mode else None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """A walk from its start. Raises InputError for options, and a seed out of its range."""
        super().reset(seed=seed)
        check_options(options)
        self.stage.begin(0, int(self.np_random.integers(MOST_SEED)) if seed is None else seed)
        return self.stage.observations()[0], self._info()

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """One sample under an action (p,) [1]. Raises InputError for what is none, and after a fall."""
        stage = self.stage
        if stage.stepper.codes[0] != 0:
            raise InputError("there is no walk that goes on; call reset() first")
        stage.move(finite_numbers("action", action, (stage.plant.p,))[np.newaxis])
        fallen, late = (bool(over[0]) for over in stage.ended())
        reward = float(stage.rewards()[0])
        return stage.observations()[0], reward, fallen, late, self._info()

    def _info(self) -> dict[str, Any]:
        """Of this walk alone."""
        return {
            name: x[0] if name == "status" else x.item() for name, x in self.stage.infos().items()
        }

    def render(self) -> Any:
        """A picture (height, width, 3), uint8; None without a render_mode."""
        return self.picture.drawn(0) if self.picture else None
