"""Legality of N walks on soft ground, as `view.LEGALITY`.

Friction and the direction of the force are what the simulator makes them there, so legality is another thing: a
single support is illegal where a foot slips, by the numbers of `soft.meters`, or where a torque is beyond the
limit.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.closed_loop.feet import OnFeet
from biped_adrc.closed_loop.semantics import parts, torque_held
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import PlantState
from biped_adrc.engine.samples import PythonWalk
from biped_adrc.ground import ground_axes
from biped_adrc.soft.meters import PRESSED, slipping


class SoftLegality:
    """So far; slope [rad] and friction mu [1] of the ground, limit [N m] of the torques."""

    def __init__(self, count: int, slope: float, mu: float, limit: float):
        self.axes, self.mu, self.limit = ground_axes(slope), mu, limit
        self.rows, self.looks = np.zeros((count, 4)), np.zeros(count)

    def begin(self, i: int) -> None:
        """Walk i anew."""
        self.rows[i] = self.looks[i] = 0.0

    def look(self, i: int, walk: PythonWalk) -> None:
        """Walk i where it is now."""
        loop, now, along, out = walk.loop, walk.now, *self.axes
        assert isinstance(loop, SteppingLoop)
        (q, v, _, tail), k = parts(loop, now.x), loop.held
        assert k is not None
        u, state = torque_held(k, tail), PlantState(now.t, q, v, tail[: k.sizes.own])
        if not isinstance(loop.plant, OnFeet) or now.t <= 0.0:
            return
        feet = loop.plant.footing(state, u, loop.load(now.t, q, v, now.mode))
        F_T, F_N = np.abs(feet.force @ along), feet.force @ out
        slips = slipping(feet.force, feet.speed, self.mu, self.axes)
        first, friction, normal, peak = self.rows[i]
        broken = np.any(slips) or np.max(np.abs(u)) > self.limit
        self.rows[i] = (
            first if first or not broken else now.mode.step,
            max(friction, *(F_T / np.where(F_N > PRESSED, F_N, np.inf))),
            min(normal, float(np.sum(F_N))) if self.looks[i] else float(np.sum(F_N)),
            max(peak, float(np.max(np.abs(u)))),
        )
        self.looks[i] += 1
