"""Band-limited noise over a window, without a state: a sum of K sines with random phases.

    zeta_i = amplitude_i sqrt(2/K) sum_k sin(2 pi f_ik s + phi_ik),   s = t - start

f_ik is drawn evenly from the k-th of K equal parts of (0, bandwidth), so the spectrum is flat, the mean square
over a long window is amplitude_i^2, and the sum is close to normally distributed (Shinozuka, Deodatis, Applied
Mechanics Reviews 44(4), 1991). It is smooth and a pure function of time: it asks for no ticks and repeats
by its seed. White noise drawn at each sample instant would be neither: its effect would depend on the step of
the integrator.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from biped_adrc.disturbances.base import Windowed
from biped_adrc.errors import check_positive, check_whole
from biped_adrc.part import SETUP, derived
from biped_adrc.types import Array


@dataclass(frozen=True)
class TorqueNoise(Windowed):
    """Root mean square `amplitude` (n,) [N m], flat up to `bandwidth` [Hz], different on every coordinate.

    The same seed gives the same noise. sines: K, their number per coordinate; the more, the closer
    to a normal distribution, and the slower to evaluate.
    Raises InputError for a bandwidth or a number that is not positive, or a seed that is no whole number >= 0.
    """

    bandwidth: float = field(kw_only=True)
    """[Hz]; the spectrum is flat below it, and zero above."""
    seed: int = field(kw_only=True, metadata=SETUP)
    """Of frequencies and phases; trials of a study have seeds of their own."""
    sines: int = field(default=32, kw_only=True)
    """K, per coordinate."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_positive(self.bandwidth, f"noise bandwidth is {self.bandwidth} Hz")
        check_whole(self.seed, f"noise seed is {self.seed}")
        check_whole(self.sines, f"noise sines is {self.sines}", 1)

    @derived
    def drawn(self) -> tuple[Array, Array]:
        """f [Hz] and phi [rad] of the sines, each (n, K): a row for each coordinate."""
        random, shape = np.random.default_rng(self.seed), (len(self.amplitude), self.sines)
        part = np.arange(self.sines) + random.uniform(size=shape)
        return self.bandwidth * part / self.sines, random.uniform(0.0, 2.0 * math.pi, shape)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        s, (frequencies, phases) = t - self.onset(t_start), self.drawn
        total = np.sin(2.0 * math.pi * frequencies * s + phases).sum(axis=1)
        return self.amplitude * math.sqrt(2.0 / self.sines) * total
