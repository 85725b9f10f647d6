"""A posture whose deviation from the reference is drawn larger than it is: q_d + k (q_b - q_d).

The unactuated joint and the stance foot stay where they are. k = 1 is the walk itself, k = 0 its reference.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from biped_adrc.analysis.signals import Signals
from biped_adrc.errors import InputError
from biped_adrc.types import Array
from biped_adrc.viz.placement import Recorded


@runtime_checkable
class Tracked(Recorded, Protocol):
    """A walk whose signals are at hand."""

    @property
    def signals(self) -> Signals: ...


@dataclass(frozen=True)
class Deviation:
    """The tracking error of a walk and the factor k it is drawn with."""

    signals: Signals
    factor: float

    @classmethod
    def of(cls, walk: Recorded, factor: float) -> Deviation:
        """Raises InputError for a factor that is negative or not finite, or a walk without a reference."""
        if not (math.isfinite(factor) and factor >= 0.0):
            raise InputError(f"magnify is {factor}, expected a number that is not negative")
        if not isinstance(walk, Tracked) or walk.walker.plant.p == 0:
            raise InputError(
                "a walk without motors has no reference to deviate from; leave 'magnify' and 'apart' out"
            )
        return cls(walk.signals, factor)

    def error(self, t: float, step: int) -> Array:
        """q_b - q_d (p,) [rad] in single support `step`, linear between nodes; its ends outside them."""
        s = self.signals
        first, last = np.searchsorted(s.step, [step, step + 1])
        rows = slice(int(first), int(last))
        return np.array([np.interp(t, s.t[rows], column) for column in s.error[rows].T])

    def change(self, t: float, step: int) -> Array:
        """What is added to q_b (p,) [rad]: (k - 1)(q_b - q_d)."""
        return (self.factor - 1.0) * self.error(t, step)
