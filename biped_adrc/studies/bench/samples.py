"""Values of a range: evenly spaced levels, and samples at random or of a Sobol sequence, drawn when needed.

p = low + (high - low) w,   or   p = low (high / low)^w on a logarithmic scale,   w in [0, 1]
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from biped_adrc.types import Array

BLOCK = 1024
"""Samples that are drawn at once; a power of two, as Sobol's sequences ask for."""

Scale = Literal["linear", "log"]


class Range(BaseModel):
    """From low to high, in the parameter's SI unit; `whole` for numbers without a fraction."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    low: float
    high: float
    scale: Scale = "linear"
    whole: bool = False

    def at(self, w: float) -> float | int:
        """The value at w in [0, 1)."""
        if self.whole:
            return int(self.low) + min(
                int(w * (self.high - self.low + 1)), int(self.high - self.low)
            )
        if self.scale == "log":
            return self.low * (self.high / self.low) ** w
        return self.low + (self.high - self.low) * w

    def levels(self, count: int) -> list[float]:
        """So many values with both ends among them, exactly."""
        if count == 1:
            return [self.low]
        a, b = self.low, self.high
        if self.scale == "log":
            a, b = math.log(a), math.log(b)
        inner = [((count - 1 - k) * a + k * b) / (count - 1) for k in range(1, count - 1)]
        if self.scale == "log":
            inner = [math.exp(x) for x in inner]
        return [self.low, *inner, self.high]


class Draw(BaseModel):
    """`count` samples of all ranges together, by a generator of this seed."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    kind: Literal["random", "sobol"]
    count: int = Field(ge=1)
    seed: int = Field(ge=0)
    ranges: dict[str, Range] = Field(min_length=1)

    def samples(self) -> Iterator[dict[str, float | int]]:
        """The samples in their order, the same each time."""
        left = self.count
        for block in self._blocks():
            for w in block[:left]:
                yield {
                    name: r.at(float(x))
                    for (name, r), x in zip(self.ranges.items(), w, strict=True)
                }
            left -= len(block)
            if left <= 0:
                return

    def _blocks(self) -> Iterator[Array]:
        """(BLOCK, number of ranges) each, in [0, 1)."""
        random, n = np.random.default_rng(self.seed), len(self.ranges)
        if self.kind == "random":
            while True:
                yield random.random((BLOCK, n))
        from scipy.stats import qmc

        sobol = qmc.Sobol(n, seed=random)
        while True:
            yield sobol.random(BLOCK)
