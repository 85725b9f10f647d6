"""The largest rates and torques that a run may have; beyond them it ends as run away (RAN_AWAY)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import RanAwayError
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array, read_only


class Bounds(NamedTuple):
    """Of rates and torques."""

    fastest: Array
    """Rates (n,) [rad/s]; infinite for none."""
    strongest: float
    """Torque [N m]; infinite for none."""

    @classmethod
    def of(cls, robot: object, n: int, speed: float, torque: float) -> Bounds:
        """So many times the speed limits of the URDF, and the peak torque of the robot's record.

        None for the torque of a robot without motors, and for a model of n coordinates that is no Biped.
        """
        if not isinstance(robot, Biped):
            return cls(read_only(np.full(n, math.inf)), math.inf)
        peak = robot.description.peak_torque if robot.p else math.inf
        return cls(read_only(speed * robot.speed_limits), torque * peak)

    def slow(self, v: Array) -> Array:
        """Whether rates v (n,) or (K, n) [rad/s] are not beyond `fastest`; not so for NaN."""
        within: Array = np.all(np.abs(v) <= self.fastest, axis=-1)
        return within

    def check_rates(self, t: float, v: Array) -> None:
        """Raise RanAwayError for a rate v (n,) [rad/s] at t [s] beyond `fastest`."""
        if not self.slow(v):
            v = np.abs(v)
            i = int(np.argmax(v / self.fastest))
            raise RanAwayError(
                f"t = {t:.6g} s: |q{i + 1}'| is {v[i]:.3g} rad/s, above {self.fastest[i]:.3g} rad/s"
            )

    def bounded(self, u: Array) -> Array:
        """u (p,) [N m] itself. Raises RanAwayError for one beyond `strongest`."""
        # one product tests all of them, at every sample
        if u.dot(u) > self.strongest**2 and np.max(np.abs(u)) > self.strongest:
            raise RanAwayError(f"torque {u} N m, above {self.strongest:.3g} N m")
        return u
