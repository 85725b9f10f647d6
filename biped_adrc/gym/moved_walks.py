"""N walks of learners moved on sample by sample, one after the other: plants that move by themselves, such as
MuJoCo, and controllers in plain Python.

The samples are those of `gym.moving`. On soft ground friction and the direction of the force are what the
simulator makes them, so legality is another thing there: a single support is illegal where a foot slips, by the
numbers of `soft.meters`, or where a torque is beyond the limit.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.closed_loop.feet import OnFeet
from biped_adrc.closed_loop.semantics import parts, torque_held
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import PlantState
from biped_adrc.control.base import Measurement
from biped_adrc.engine.kernels.run_plan import STATUS
from biped_adrc.engine.strides import Strides
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.ground import ground_axes
from biped_adrc.gym.compiled_walks import place_of_torque
from biped_adrc.gym.episode import Episode
from biped_adrc.gym.moving import Moving
from biped_adrc.gym.view import learner_view
from biped_adrc.hybrid.status import Status
from biped_adrc.robots.limits import KnownLimits
from biped_adrc.soft.meters import PRESSED, slipping
from biped_adrc.types import Array


class MovedWalk:
    """One walk, where it is, and its legality so far as `view.LEGALITY`."""

    def __init__(self, episode: Episode, limits: KnownLimits):
        """At its start. Raises InputError for what cannot walk sample by sample."""
        self.episode, self.limits = episode, limits
        self.moving = Moving.of(episode.walker, episode.method, episode.loop)
        self.now = self.moving.start(episode.q, episode.v, episode.mode)
        self.legality, self.looks = np.zeros(4), 0

    def give(self, torque: Array) -> None:
        """The learner's torque (p,) [N m] of the coming sample, where the controller reads it."""
        self.episode.torque[:] = torque
        system = self.moving.system
        if isinstance(system, Strides) and system.code is not None:
            at = place_of_torque(system.code.numbers)
            system.code.K[at : at + len(torque)] = torque

    def sample(self) -> Status:
        """To the next sample instant; COMPLETED where it goes on, else `now` is at the end."""
        while True:
            until = self.moving.until(self.now)
            flown, now = self.moving.moved(self.now)
            if now is None:
                self.now = self.now._replace(t=float(flown.arc.t[-1]), x=flown.arc.x[-1])
                return flown.status
            self.now = now
            if flown.outcome is None or self.moving.timing.restart or now.t >= until:
                return Status.COMPLETED

    def seen(self, reference: Reference) -> Array:
        """The numbers of `view.LearnerView` where it is, in one row."""

        def point(s: Array, m: Measurement) -> ReferencePoint:
            return reference(m.t, m.q, m.v)

        view = learner_view(self.moving.loop, self.now.t, self.now.x, self.now.mode, point)
        return np.concatenate(
            [*view[:-1], view.legality if len(view.legality) else self._on_feet()]
        )

    def _on_feet(self) -> Array:
        """Legality (4,) of a walk on soft ground, with where it is now."""
        loop, now = self.moving.loop, self.now
        assert isinstance(loop, SteppingLoop)
        (q, v, _, tail), k = parts(loop, now.x), loop.held
        assert k is not None
        u, state = torque_held(k, tail), PlantState(now.t, q, v, tail[: k.sizes.own])
        if not isinstance(loop.plant, OnFeet) or now.t <= 0.0:
            return self.legality
        feet = loop.plant.footing(state, u, loop.load(now.t, q, v, now.mode))
        axes = along, out = ground_axes(self.episode.walker.slope)
        F_T, F_N = np.abs(feet.force @ along), feet.force @ out
        mu = self.episode.scenario.ground_friction
        slips = slipping(feet.force, feet.speed, mu, axes)
        first, friction, normal, peak = self.legality
        broken = np.any(slips) or np.max(np.abs(u)) > self.limits.torque
        self.legality = np.array(
            [
                first if first or not broken else now.mode.step,
                max(friction, *(F_T / np.where(F_N > PRESSED, F_N, np.inf))),
                min(normal, float(np.sum(F_N))) if self.looks else float(np.sum(F_N)),
                max(peak, float(np.max(np.abs(u)))),
            ]
        )
        self.looks += 1
        return self.legality


class MovedWalks:
    """N walks; what it hands out is as of `compiled_walks.CompiledWalks`."""

    def __init__(self, count: int, reference: Reference, limits: KnownLimits):
        """reference: the curve that errors refer to. limits: of ground and motors."""
        self.reference, self.limits = reference, limits
        self.walks: list[MovedWalk | None] = [None] * count
        self.codes = np.ones(count, dtype=np.int64)
        self.seen = np.zeros((count, 0))

    def begin(self, i: int, episode: Episode) -> None:
        """Walk i anew; row i of `seen` is what is to be seen at its start."""
        walk = self.walks[i] = MovedWalk(episode, self.limits)
        row = walk.seen(self.reference)
        if self.seen.shape[1] != len(row):
            self.seen = np.zeros((len(self.codes), len(row)))
        self.seen[i], self.codes[i] = row, 0

    def move(self, torques: Array) -> None:
        """Every walk whose code is 0 by one sample, under its row of torques (N, p) [N m]."""
        for i, walk in enumerate(self.walks):
            if walk is not None and self.codes[i] == 0:
                walk.give(torques[i])
                self.codes[i] = STATUS.index(walk.sample())
                self.seen[i] = walk.seen(self.reference)
