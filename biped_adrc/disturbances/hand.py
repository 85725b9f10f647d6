"""Torques and forces of a hand as they were recorded: constant from one row to the next.

    zeta(t) = tau_k + J(q)' F_k,   t_k <= t < t_k+1

Rows begin where the walk was at a sample instant, in the time of the run, since a hand knows no steps. It is
written as methods that look a row up: a recording may have thousands of rows, and a walk is simulated
again from its session (`play`), where each row is held over its sample in machine code.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from biped_adrc.disturbances.base import Disturbance
from biped_adrc.errors import InputError
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import LinkPoint, link_point, wrench_torque
from biped_adrc.parts import numbers
from biped_adrc.types import Array, freeze


@dataclass(frozen=True)
class RecordedHand(Disturbance):
    """times (K,) [s] that increase, torques (K, n) [N m], forces (K, 2) [N], and where the forces act.

    links: names (K,); points (K, 2) [m] in the frames of these links of `biped`, the plant. Nothing acts before
    the first row, and the last one stays. Raises InputError for rows that do not fit together, ModelError for a
    link that the robot has not.
    """

    biped: Biped
    times: Array
    torques: Array
    forces: Array
    links: tuple[str, ...]
    points: Array

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("times", "torques", "forces", "points"):
            rows = numbers(getattr(self, name), f"{name} of a recorded hand")
            object.__setattr__(self, name, rows)
        K, n = len(self.links), self.biped.n
        found = tuple(x.shape for x in (self.times, self.torques, self.forces, self.points))
        if found != ((K,), (K, n), (K, 2), (K, 2)):
            raise InputError(
                f"times, torques, forces and points of a recorded hand have the shapes {found}, expected rows "
                f"for {K} links and {n} coordinates: ({K},), ({K}, {n}), ({K}, 2), ({K}, 2)"
            )
        rows = np.column_stack((self.times, self.torques, self.forces, self.points))
        if not np.all(np.isfinite(rows)) or np.any(np.diff(self.times) <= 0.0):
            raise InputError(
                "the rows of a recorded hand are not finite, or their times do not increase"
            )
        freeze(self, "times", "torques", "forces", "points")
        _ = self.made

    @cached_property
    def made(self) -> tuple[LinkPoint, ...]:
        """Where each force acts, in closed form (K,)."""
        places = [(x, (a, b)) for x, (a, b) in zip(self.links, self.points.tolist(), strict=True)]
        found = {place: link_point(self.biped, *place) for place in dict.fromkeys(places)}
        return tuple(found[place] for place in places)

    def check_size(self, n: int) -> None:
        if n != self.biped.n:
            raise InputError(
                f"the recorded hand is of a robot with {self.biped.n} coordinates, expected {n}"
            )

    def _row(self, t: float) -> int:
        """The row that acts at t [s]; -1 before the first."""
        return int(np.searchsorted(self.times, t, side="right")) - 1

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        k = self._row(t)
        if k < 0:
            return np.zeros(len(q))
        wrench = np.array((*self.forces[k], 0.0))
        return self.torques[k] + wrench_torque(self.made[k], q, wrench)

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        k = self._row(t)
        return np.zeros(2) if k < 0 else self.forces[k].copy()

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        return tuple(self.times.tolist())
