"""N walks of one task side by side: what a learner is given of them, and how they go on.

`env` is one of them, `vector` N; both are this class, so that a walk among many is the same as alone, bit for
bit. Walks are moved on in machine code where all their parts compile, else one by one.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from biped_adrc.engine.kernels.run_plan import STATUS
from biped_adrc.engine.program import NotCompiled
from biped_adrc.errors import InputError
from biped_adrc.gym.compiled_walks import CompiledWalks
from biped_adrc.gym.episode import Episode
from biped_adrc.gym.moved_walks import MovedWalks
from biped_adrc.gym.task import FALLEN_FROM, LearnerTask
from biped_adrc.scenario.build import RIGID, RobotAndGait
from biped_adrc.types import Array

TURNS = 4.0 * np.pi
"""Largest angle of an observation [rad], two turns."""
FASTEST = 1000.0
"""Largest rate of an observation [rad/s] for a robot whose record has none."""
NAMES = np.array(
    ["walks", *(status.name.lower().replace("_", " ") for status in STATUS[1:])], dtype=object
)
"""Of the statuses, by code."""

Flags = NDArray[np.bool_]


class Stage:
    """N walks. Raises InputError for a task that cannot be walked."""

    def __init__(self, task: LearnerTask, count: int):
        self.scene = RobotAndGait.of(task.scenario)
        self.limits = task.limits(self.scene)
        self.task = replace(task, scenario=replace(task.scenario, torque_limit=self.limits.torque))
        self.plant, self.phase = self.scene.biped, self.scene.walked.constraint.phase
        self.walks = self._walks(count)
        self.walks.codes[:] = 1
        n, p = self.plant.n, self.plant.p
        self.first = 2 * n + 3 * p
        self.highest = np.concatenate(
            (self._fastest(), np.full(p, self.limits.torque), [2.0 * TURNS])
        )
        self.seeds = np.zeros(count, dtype=np.int64)

    def _walks(self, count: int) -> CompiledWalks | MovedWalks:
        """Compiled where that is possible; one is begun, so that what is wrong is said here."""
        episode, reference = self._episode(self.task.scenario.seed), self.scene.walked.constraint
        if self.task.scenario.plant == RIGID:
            compiled = CompiledWalks(count, reference)
            try:
                compiled.begin(0, episode)
                return compiled
            except NotCompiled:
                pass
        moved = MovedWalks(count, reference)
        moved.begin(0, episode)
        return moved

    def _fastest(self) -> Array:
        """Bounds of q, q', e and e', one after the other, for what is measured."""
        n, p = self.plant.n, self.plant.p
        v = self.task.scenario.runaway_speed * self.plant.speed_limits
        v = np.where(np.isfinite(v), v, FASTEST)
        return np.concatenate((np.full(n, TURNS), v, np.full(p, 2.0 * TURNS), 2.0 * v[:p]))

    def _episode(self, seed: int) -> Episode:
        """Of the scenario with this seed. Raises InputError for a seed out of its range."""
        return Episode.of(replace(self.task.scenario, seed=seed), self.scene, self.task.action)

    def begin(self, i: int, seed: int) -> None:
        """Walk i anew, with this seed of its scenario."""
        self.walks.begin(i, self._episode(seed))
        self.seeds[i] = seed

    def move(self, actions: Array) -> None:
        """One sample of all that walk, under actions (N, p), shares of the motors' limit [1].

        Raises InputError for another shape, and for what is not finite.
        """
        try:
            shares = np.asarray(actions, dtype=float)
        except (TypeError, ValueError):
            raise InputError(f"the action is {actions!r:.60}, expected numbers") from None
        expected = len(self.seeds), self.plant.p
        if shares.shape != expected:
            alone = expected[0] == 1
            raise InputError(
                f"the action has shape {shares.shape[alone:]}, expected {expected[alone:]}: a share of the "
                "torque limit for each motor"
            )
        if not np.isfinite(shares).all():
            raise InputError(f"the action is {shares}, expected finite numbers from -1 to 1")
        self.walks.move(np.ascontiguousarray(self.limits.torque * shares))

    # -- where they are ----------------------------------------------------------------------------
    def observations(self) -> Array:
        """(N, first + 1), within the bounds."""
        seen = self.walks.seen
        found = np.empty((len(seen), self.first + 1))
        found[:, :-1] = seen[:, : self.first]
        found[:, -1] = np.vecdot(seen[:, : self.plant.n], self.phase)
        return np.minimum(np.maximum(found, -self.highest, out=found), self.highest, out=found)

    def rewards(self) -> Array:
        """(N,) of the sample that has just been made."""
        squares = self.walks.seen[:, self.first + 2 : self.first + 4]
        return self.task.rewards(squares, self.walks.codes == 0)

    def ended(self) -> tuple[Flags, Flags]:
        """Whether each walk has fallen, or was lost (N,), and whether its time or its impacts are over (N,)."""
        s, seen = self.task.scenario, self.walks.seen
        fallen = self.walks.codes != 0
        late = seen[:, self.first] >= self.task.seconds - FALLEN_FROM
        late |= seen[:, self.first + 1] >= s.first_step + s.impacts
        return fallen, late & ~fallen

    def infos(self) -> dict[str, Any]:
        """What is known beside the observation, (N,) each; `episode.Needs` has the second four."""
        at, needed = self.walks.seen[:, self.first :], self.walks.needs.rows
        return {
            "t": at[:, 0].copy(),
            "step": at[:, 1].astype(np.int64),
            "seed": self.seeds.copy(),
            "feasible": needed[:, 0] > 0.0,
            "friction": needed[:, 1].copy(),
            "normal_force": needed[:, 2].copy(),
            "peak_torque": needed[:, 3].copy(),
            "status": NAMES[self.walks.codes],
        }
