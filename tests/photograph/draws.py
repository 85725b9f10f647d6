"""Random values of one scenario: a generator of its own for every number, so that none depends on another."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np


def plain(x: float) -> float:
    """Six digits: readable, and read back as the same number."""
    return float(f"{x:.6g}")


class Draw:
    """Draws of scenario `k` of a photograph with `seed`."""

    def __init__(self, seed: int, k: int) -> None:
        self.random = np.random.default_rng(np.random.SeedSequence([seed, k]))

    def chance(self, share: float) -> bool:
        """True in that share of the scenarios."""
        return bool(self.random.random() < share)

    def one(self, *options: Any) -> Any:
        """One of the options, all alike."""
        return options[int(self.random.integers(len(options)))]

    def weighted(self, weights: Mapping[str, float]) -> str:
        """One of the names, by its weight."""
        names, total = list(weights), sum(weights.values())
        mark, at = self.random.random() * total, 0.0
        for name in names:
            at += weights[name]
            if mark < at:
                return name
        return names[-1]

    def even(self, low: float, high: float) -> float:
        """Evenly between two numbers."""
        return plain(low + (high - low) * self.random.random())

    def log(self, low: float, high: float) -> float:
        """Evenly in the logarithm."""
        return plain(math.exp(math.log(low) + math.log(high / low) * self.random.random()))

    def normal(self, scale: float, n: int) -> list[float]:
        """n numbers of that standard deviation."""
        return [plain(scale * x) for x in self.random.standard_normal(n)]

    def whole(self, low: int, high: int) -> int:
        """A whole number from low to high, both included."""
        return int(self.random.integers(low, high + 1))
