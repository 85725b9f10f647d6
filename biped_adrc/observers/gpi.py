"""The Generalized Proportional Integral observer (17) of any order m >= 0.

    x1^' = x2^ + l_(m+1) (y - x1^)
    x2^' = x3^ + l_m     (y - x1^) + kappa u
    x3^' = x4^ + l_(m-1) (y - x1^)
     ...
    x_(m+2)^' = l_0 (y - x1^)

Its error obeys (19) with the poles chosen. States are scaled by w, the geometric mean of the poles:
z_k = x_k / w^(k-1), and the gains are the coefficients of the polynomial of the poles divided by w. The
injection is written l (y - x1^), never l y - l x1^: with gains up to 1e29 that form is lost in round-off.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.observers.base import ErrorSystem, ObserverLaws
from biped_adrc.observers.chain import (
    ChainObserver,
    chain_laws,
    equal_poles,
    stable_poles,
    whole,
)
from biped_adrc.observers.gpi_sampled import SampledGPIObserver
from biped_adrc.types import Array

TABLE_I = tuple(-180.0 * 1.8**k for k in range(9))
"""Table I [rad/s]; the paper rounds them ("-11.020" and "-19.836" use the dot for thousands)."""


class GPIParameters(NamedTuple):
    """Scaled gains (m + 2,), w [rad/s] by which states are scaled, and m + 2."""

    gains: Array
    scale: float
    order: int


def gpi_flow(k: GPIParameters, Z: Array, y: Array, input: Array) -> Array:
    """Z' (m + 2, p) for scaled states Z, measurement y (p,) and input kappa u (p,)."""
    w = k.scale
    dZ = w * np.outer(k.gains, y - Z[0])
    dZ[:-1] += w * Z[1:]
    dZ[1] += input / w
    return dZ


@dataclass(frozen=True)
class GPIObserver(ChainObserver):
    """(17) with the same m + 2 poles for every joint. Make it with `from_poles` or `from_bandwidth`."""

    poles: tuple[complex, ...] = ()

    @classmethod
    def from_poles(cls, poles: Sequence[complex] = TABLE_I, m: int | None = None) -> GPIObserver:
        """m + 2 stable poles [rad/s]; complex ones in conjugate pairs.

        m, when given, is checked against their number. Raises InputError.
        """
        poles = stable_poles(poles, "a GPI observer", " (m >= 0)")
        if m is not None and len(poles) != m + 2:
            raise InputError(f"a GPI observer with m = {m} has {m + 2} poles, found {len(poles)}")
        w = float(np.exp(np.mean(np.log(np.abs(poles)))))
        return cls(len(poles) - 2, w, poles)

    @classmethod
    def from_bandwidth(cls, bandwidth: float, m: int = 1) -> GPIObserver:
        """All m + 2 poles at -bandwidth [rad/s]; m = 1 is the linear extended state observer.

        Raises InputError.
        """
        return cls.from_poles(equal_poles(bandwidth, whole(m, 0, "m", "observer order") + 2))

    @cached_property
    def parameters(self) -> GPIParameters:
        """What the laws `gpi_flow` and `chain_...` need."""
        gains = np.real(np.poly(np.array(self.poles) / self.scale))[1:]
        return GPIParameters(np.ascontiguousarray(gains), float(self.scale), self.order)

    @property
    def gains(self) -> Array:
        """l_(m+1), l_m, ..., l_0 of (17) in physical units."""
        l: Array = self.parameters.gains * self.scale ** np.arange(1, self.order + 1)  # noqa: E741
        return l

    @property
    def laws(self) -> ObserverLaws:
        return chain_laws(self.parameters, gpi_flow)

    def sampled(self, period: float) -> SampledGPIObserver:
        """The current (filtered) discrete observer with poles exp(s T)."""
        return SampledGPIObserver.from_poles(self.poles, period)

    def error_system(self) -> ErrorSystem:
        """(19) in scaled states: e' = A e + b (q_b'' - kappa u)."""
        A = self.scale * np.eye(self.order, k=1)
        A[:, 0] = -self.scale * self.parameters.gains
        return ErrorSystem(A, 1.0 / self.scale)
