"""The ground of a walk, seen from the side: a slope that steps down fall off from.

    z(x) = -tan(slope) x - sum of the heights of the steps down behind x

A step's edge is drawn half way between the footholds on either side of it; where it is has no part in the walk.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from biped_adrc.types import Array

TILE = 0.5
"""[m], along x, of the light and dark tiles."""


class Tile(NamedTuple):
    """A piece of the surface without a step."""

    ends: Array
    """(2, 2), x and z of both ends [m]."""
    even: bool
    """Light ones are even, dark ones odd."""


@dataclass(frozen=True)
class Surface:
    """slope [rad], positive downhill; steps down of `heights` (E,) [m] at x = `edges` (E,) [m], in order."""

    slope: float
    edges: Array
    heights: Array

    def height(self, x: float, before: bool = False) -> float:
        """z at x [m]; at an edge below it, or above it if `before`."""
        passed = self.edges < x if before else self.edges <= x
        return -math.tan(self.slope) * x - float(np.sum(self.heights[passed]))

    def line(self, low: float, high: float) -> Array:
        """(K, 2), x and z of the corners from x = low to high [m]."""
        inside = self.edges[(low < self.edges) & (self.edges < high)]
        corners = [(x, self.height(x, before)) for x in inside for before in (True, False)]
        return np.array([(low, self.height(low)), *corners, (high, self.height(high, True))])

    def tiles(self, low: int, high: int) -> list[Tile]:
        """The pieces from x = low TILE to high TILE, cut at multiples of TILE and at edges."""
        inside = self.edges[(low * TILE < self.edges) & (self.edges < high * TILE)]
        cuts = np.unique([*(k * TILE for k in range(low, high + 1)), *inside])
        return [
            Tile(
                np.array([(a, self.height(a)), (b, self.height(b, True))]),
                math.floor(a / TILE) % 2 == 0,
            )
            for a, b in pairwise(cuts)
        ]
