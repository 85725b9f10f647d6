"""Times of the sample instants of a walk in real time: what was late, and by how much; no limit is set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from biped_adrc.deploy.loaded import OK
from biped_adrc.errors import InputError
from biped_adrc.shown import Shown
from biped_adrc.types import Array, frozen

HEADER = ("", "median [us]", "99.9 % [us]", "worst [us]")
"""Names of the columns of `TickTimes.rows`."""


class Tick(NamedTuple):
    """One sample instant; its due is when the clock on the wall says so."""

    t: float
    """The instant [s]."""
    reached: float
    """When the plant was there, after its due [s]; below 0 where it waited."""
    sent: float
    """When the measurement was sent, after its due [s]."""
    trip: float
    """From there to the answer [s]; NaN where it was not there at its deadline."""
    flag: int
    """What the function of the C returned; OK where no answer was there."""


@dataclass(frozen=True)
class TickTimes(Shown):
    """The sample instants of a walk in real time; arrays (K,) in [s]."""

    t: Array
    """The instants."""
    reached: Array
    """When the plant was there, after its due; below 0 where it waited."""
    sent: Array
    """When the measurement was sent, after its due: the jitter."""
    trip: Array
    """From there to the answer; NaN where it was missed."""
    without_result: int
    """Answers whose flag was not OK."""

    @classmethod
    def of(cls, ticks: Sequence[Tick]) -> Self:
        """Of ticks in order. Raises InputError for none."""
        if not ticks:
            raise InputError("there are no sample instants yet; walk first")
        *times, flags = zip(*ticks, strict=True)
        t, reached, sent, trip = (frozen(np.array(x)) for x in times)
        return cls(t, reached, sent, trip, sum(flag != OK for flag in flags))

    @property
    def missed(self) -> Array:
        """Instants [s] whose answer was not there at the deadline: the torque before went on."""
        return self.t[np.isnan(self.trip)]

    @property
    def overrun(self) -> Array:
        """Instants [s] that the plant reached after their due: it is slower than the clock there."""
        return self.t[self.reached > 0.0]

    def rows(self) -> list[tuple[str, ...]]:
        """Cells of a table with `HEADER`: the jitter, and the way to the controller and back."""
        found = [("measured after its due", self.sent)]
        found += [("answered after that", self.trip[~np.isnan(self.trip)])]
        return [(name, *map(_microseconds, spread(x))) for name, x in found]

    def text(self) -> str:
        """What was missed, in a sentence."""
        return (
            f"{len(self.t)} sample instants: {len(self.missed)} answers missed, {self.without_result} without "
            f"a result, {len(self.overrun)} instants reached late by the plant"
        )


def spread(x: Array) -> tuple[float, float, float]:
    """Median, 99.9 % and largest of some numbers; NaN where there are none."""
    if len(x) == 0:
        return (float("nan"),) * 3
    median, most = np.quantile(x, (0.5, 0.999), method="higher")
    return float(median), float(most), float(np.max(x))


def _microseconds(x: float) -> str:
    return f"{1e6 * x:.0f}" if x == x else "none"
