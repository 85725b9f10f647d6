"""Many walks as a vector environment: one call of machine code for all of them.

    envs = gymnasium.make_vec("biped_adrc.extras.gym:biped_adrc/Walk-v0", num_envs=64)

Each walk is that of `env.WalkEnv`, bit for bit. A walk that has ended begins anew at the next step
(`AutoresetMode.NEXT_STEP`): its action of that step is not looked at, and its reward is 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from biped_adrc.core.errors import InputError, check_count
from biped_adrc.core.types import Array
from biped_adrc.extras.gym.env import check_options, spaces_of
from biped_adrc.extras.gym.picture import Picture
from biped_adrc.extras.gym.stage import Flags, Stage
from biped_adrc.extras.gym.task import LearnerTask
from biped_adrc.scenario.scenario import MOST_SEED, Scenario
from biped_adrc.scenario.stepper import finite_numbers


class WalkVectorEnv(VectorEnv[Array, Array, Any]):
    """num_envs walks; what else it takes is as of `env.WalkEnv`.

    `reset(seed=k)` gives walk i the seed k + i, as Gymnasium's own vectors do; a list has one for each.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012
        "render_modes": ["rgb_array"],
        "render_fps": 1000,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        num_envs: int = 1,
        scenario: Scenario | None = None,
        condition: str | None = None,
        render_mode: str | None = None,
        **values: Any,
    ):
        check_count(num_envs, f"num_envs is {num_envs}")
        self.num_envs, self.render_mode = num_envs, render_mode
        task = LearnerTask.of(scenario, condition, **values)
        self.stage = Stage(task, num_envs, render_mode is not None)
        self.single_observation_space, self.single_action_space = spaces_of(self.stage)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.generators = [np.random.default_rng() for _ in range(num_envs)]
        self.over: Flags = np.ones(num_envs, dtype=bool)
        self.picture = Picture(self.stage) if render_mode else None

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Array, dict[str, Any]]:
        """All walks from their starts. Raises InputError for options, and seeds that are too few or many."""
        check_options(options)
        N = self.num_envs
        seeds = [seed + i for i in range(N)] if isinstance(seed, int) else seed
        seeds = [None] * N if seeds is None else list(seeds)
        if len(seeds) != N:
            raise InputError(f"reset has {len(seeds)} seeds, expected {N}, one for each walk")
        for i, seed_of in enumerate(seeds):
            self._begin(i, seed_of)
        self.over[:] = False
        return self.stage.observations(), self._infos()

    def _begin(self, i: int, seed: int | None) -> None:
        """Walk i from its start; its generator is as that of `WalkEnv`, made of a seed where there is one."""
        if seed is not None:
            self.generators[i], _ = seeding.np_random(seed)
        drawn = int(self.generators[i].integers(MOST_SEED)) if seed is None else seed
        self.stage.begin(i, drawn)

    def step(self, actions: Array) -> tuple[Array, Array, Flags, Flags, dict[str, Any]]:
        """One sample of each walk under actions (N, p) [1]; those that had ended begin anew."""
        stage, again = self.stage, self.over
        stage.move(finite_numbers("action", actions, (self.num_envs, stage.plant.p)))
        for i in np.flatnonzero(again):
            self._begin(int(i), None)
        fallen, late = stage.ended()
        rewards = stage.rewards()
        rewards[again] = 0.0
        self.over = fallen | late
        return stage.observations(), rewards, fallen, late, self._infos()

    def _infos(self) -> dict[str, Any]:
        """Arrays (N,), each with its mask of those that have it: all."""
        result, there = self.stage.infos(), np.ones(self.num_envs, dtype=bool)
        return result | {f"_{name}": there.copy() for name in result}

    def render(self) -> tuple[Any, ...] | None:
        """A picture (height, width, 3), uint8, of each walk; None without a render_mode."""
        return tuple(map(self.picture.drawn, range(self.num_envs))) if self.picture else None
