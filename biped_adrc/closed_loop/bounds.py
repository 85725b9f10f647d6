"""The largest angles, rates and torques that a run may have; beyond them it ends as run away (RAN_AWAY)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from biped_adrc.core.errors import RanAwayError
from biped_adrc.core.types import Array, read_only
from biped_adrc.model.biped import Biped

TURN = 2.0 * math.pi
"""Range of a joint to either side [rad]: a whole turn, more than cables and legs of a biped allow."""


class Bounds(NamedTuple):
    """Of angles, rates and torques."""

    farthest: float
    """Angle of a joint or of the pitch [rad]; infinite for none."""
    fastest: Array
    """Rates (n,) [rad/s]; infinite for none."""
    strongest: float
    """Torque [N m]; infinite for none."""

    @classmethod
    def of(cls, robot: object, n: int, speed: float, torque: float) -> Bounds:
        """A whole turn, so many times the speed limits of the URDF, and the peak torque of the robot's record.

        None for the torque of a robot without motors, and for a model of n coordinates that is no Biped.
        """
        if not isinstance(robot, Biped):
            return cls(math.inf, read_only(np.full(n, math.inf)), math.inf)
        peak = robot.description.peak_torque if robot.p else math.inf
        return cls(TURN, read_only(speed * robot.speed_limits), torque * peak)

    def check(self, t: float, q: Array, v: Array) -> None:
        """Raise RanAwayError for an angle of q (n,) [rad] or a rate of v (n,) [rad/s] at t [s] beyond them."""
        if np.all((np.abs(q) <= self.farthest) & (np.abs(v) <= self.fastest)):
            return
        i, j = int(np.argmax(np.abs(q))), int(np.argmax(np.abs(v) / self.fastest))
        if abs(q[i]) > self.farthest:
            raise RanAwayError(f"t = {t:.6g} s: q{i + 1} is {q[i]:.3g} rad, beyond a whole turn")
        raise RanAwayError(
            f"t = {t:.6g} s: |q{j + 1}'| is {abs(v[j]):.3g} rad/s, above {self.fastest[j]:.3g} rad/s"
        )

    def bounded(self, u: Array) -> Array:
        """u (p,) [N m] itself. Raises RanAwayError for one beyond `strongest`."""
        # one product tests all of them, at every sample
        if u.dot(u) > self.strongest**2 and np.max(np.abs(u)) > self.strongest:
            raise RanAwayError(f"torque {u} N m, above {self.strongest:.3g} N m")
        return u
