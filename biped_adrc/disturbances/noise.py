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
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.disturbances.base import (
    DisturbanceLaw,
    Windowed,
    WindowParameters,
    onset,
    window_acts,
)
from biped_adrc.errors import check_positive, check_whole
from biped_adrc.types import Array


class NoiseParameters(NamedTuple):
    """The window, and f [Hz] and phi [rad] of the sines, each (n, K): a row for each coordinate."""

    window: WindowParameters
    frequencies: Array
    phases: Array


def noise_torque(
    k: NoiseParameters, t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m] of the module's equation at t [s], asked for in the window alone."""
    s, count = t - onset(k.window, t_start), k.frequencies.shape[1]
    total = np.sin(2.0 * math.pi * k.frequencies * s + k.phases).sum(axis=1)
    return k.window.amplitude * math.sqrt(2.0 / count) * total


@dataclass(frozen=True)
class TorqueNoise(Windowed):
    """Root mean square `amplitude` (n,) [N m], flat up to `bandwidth` [Hz], different on every coordinate.

    The same seed gives the same noise. sines: K, their number per coordinate; the more, the closer
    to a normal distribution, and the slower to evaluate.
    Raises InputError for a bandwidth or a number that is not positive, or a seed that is no whole number >= 0.
    """

    bandwidth: float = field(kw_only=True)
    """[Hz]; the spectrum is flat below it, and zero above."""
    seed: int = field(kw_only=True)
    """Of frequencies and phases; trials of a study have seeds of their own."""
    sines: int = field(default=32, kw_only=True)
    """K, per coordinate."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_positive(self.bandwidth, f"noise bandwidth is {self.bandwidth} Hz")
        check_whole(self.seed, f"noise seed is {self.seed}")
        check_whole(self.sines, f"noise sines is {self.sines}", 1)

    @cached_property
    def parameters(self) -> NoiseParameters:
        """What the law `noise_torque` takes: frequencies and phases drawn once, from the seed."""
        random, shape = np.random.default_rng(self.seed), (len(self.amplitude), self.sines)
        part = np.arange(self.sines) + random.uniform(size=shape)
        frequencies = self.bandwidth * part / self.sines
        return NoiseParameters(self.window, frequencies, random.uniform(0.0, 2.0 * math.pi, shape))

    @property
    def windowed(self) -> DisturbanceLaw:
        return DisturbanceLaw(self.parameters, noise_torque, active=window_acts)
