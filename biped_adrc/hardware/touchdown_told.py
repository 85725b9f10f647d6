"""A touchdown that is told late, never, or where there was none, as asked for.

    told at the first tick at t >= t_touchdown + late, with probability 1 - missed

The state d is (waits, due, done, r): whether a touchdown waits to be told and when it is due [s], whether the
false notice has been given, and the state r of the random numbers (`hardware.sensors`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.errors import InputError, check_whole
from biped_adrc.hardware.sensors import seeded, uniforms
from biped_adrc.hardware.touchdown import Look, Touchdown, check_time
from biped_adrc.part import derived, setup
from biped_adrc.parts import check_part
from biped_adrc.shown import Shown
from biped_adrc.timing import SAME_INSTANT
from biped_adrc.types import Array


@dataclass(frozen=True)
class Told(Shown, Touchdown):
    """The true touchdown, told `late` seconds after it, and errors that are asked for.

    missed [1]: probability that a touchdown is never told, by `seed`. false_at: (step, time [s]) of one notice
    without a touchdown, at the first tick so long after the step began; shortly before its end it is an early
    one. A touchdown that leaves the labels right, as after a missed or an early one, is not told. Raises
    InputError for a time that is negative and a probability that is none.
    """

    late: float = 0.0
    """[s]"""
    missed: float = 0.0
    """[1]"""
    false_at: tuple[int, float] | None = setup(None)
    """Step, and time in it [s]."""
    seed: int = setup(0)
    """A whole number from 0."""

    def __post_init__(self) -> None:
        check_time(self.late, "late")
        if not 0.0 <= self.missed <= 1.0:
            raise InputError(
                f"the probability of a missed touchdown is {self.missed}, expected 0 to 1"
            )
        check_whole(self.seed, f"the seed of missed touchdowns is {self.seed}", 0)
        if self.false_at is not None:
            if not isinstance(self.false_at, tuple | list) or len(self.false_at) != 2:
                raise InputError(
                    f"false_at is {self.false_at}, expected a step and a time in it [s], such as (2, 0.3)"
                )
            check_whole(self.false_at[0], f"false_at has the step {self.false_at[0]}", 1)
            check_part(self.false_at[1], "the time of false_at", float)
            check_time(self.false_at[1], "false_at")

    @property
    def noisy(self) -> bool:
        return self.missed > 0.0

    @derived
    def random(self) -> Array:
        """r at the start of a run: (6,), or none where no touchdown is missed."""
        return seeded(self.seed) if self.noisy else np.zeros(0)

    @derived
    def false(self) -> Array:
        """Step, and time in it [s], of the false notice (2,); step 0 for none."""
        return np.array((0, 0.0) if self.false_at is None else self.false_at, dtype=float)

    @property
    def size(self) -> int:
        return 3 + len(self.random)

    def start(self) -> Array:
        return np.concatenate((np.zeros(2), [float(self.false_at is None)], self.random))

    def touchdown(self, d: Array, other: float, t: float) -> Array:
        """It is told late, if the labels differ now and it is not missed."""
        missed, r = 0.0, d[3:]
        if len(r) > 0:
            r, u = uniforms(r, 1)
            missed = 1.0 * (u[0] < self.missed)
        waits = np.where(other > 0.5, 1.0 - missed, 0.0)
        return np.concatenate((np.array([waits, t + self.late, d[2]]), r))

    def notice(self, d: Array, look: Look) -> tuple[Array, float]:
        """When it is due and the labels still differ; and once at the false time."""
        due = 1.0 * (d[0] * look.other > 0.5) * (look.t >= d[1] - SAME_INSTANT)
        at_step = 1.0 * (abs(look.step - self.false[0]) < 0.5) * (d[2] < 0.5)
        false = at_step * (look.age >= self.false[1] - SAME_INSTANT)
        fires = np.maximum(due, false)
        left = np.array([d[0] * (1.0 - fires), d[1], np.maximum(d[2], false)])
        return np.concatenate((left, d[3:])), fires
