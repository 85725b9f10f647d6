"""The GPI observer in discrete time, in its *current* (filtered) form.

    Z- <- Phi Z + Gamma T^2 kappa u          prediction over one period
    Z  <- Z- + L (y - Z-_1)                  correction at the tick

Phi is the Taylor matrix of a chain of integrators in states z_k = x_k T^(k-1), Phi_ij = 1/(j - i)!, and
Gamma = (1/2, 1, 0, ...). L places the eigenvalues of (I - L C) Phi at exp(s T) by Ackermann's formula.
The held-measurement observer with the same poles is unstable at 1 kHz; this form is stable there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import factorial
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import check_positive
from biped_adrc.observers.base import ObserverLaws
from biped_adrc.observers.chain import (
    ChainObserver,
    chain_laws,
    stable_poles,
)
from biped_adrc.types import Array


class SampledGPIParameters(NamedTuple):
    """Phi (k, k), Gamma T^2 (k,) and L (k,), 1/T [1/s] by which states are scaled, and k = m + 2."""

    Phi: Array
    Gamma: Array
    L: Array
    scale: float
    order: int


def gpi_correct(k: SampledGPIParameters, Z: Array, y: Array) -> Array:
    """Z at the tick with y (p,) taken in."""
    corrected: Array = Z + np.outer(k.L, y - Z[0])
    return corrected


def gpi_predict(k: SampledGPIParameters, Z: Array, input: Array) -> Array:
    """Z one period later under constant input kappa u (p,)."""
    predicted: Array = k.Phi @ Z + np.outer(k.Gamma, input)
    return predicted


@dataclass(frozen=True)
class SampledGPIObserver(ChainObserver):
    """The discrete observer for one period; `scale` is 1/T."""

    period: float = 0.0
    poles: tuple[complex, ...] = ()

    @classmethod
    def from_poles(cls, poles: Sequence[complex], period: float) -> SampledGPIObserver:
        """Poles s [rad/s] of the continuous observer, as those of GPIObserver, and the period T [s].

        Raises InputError.
        """
        poles = stable_poles(poles, "a discrete GPI observer", " (m >= 0)")
        check_positive(period, f"the sampling period is {period} s")
        return cls(len(poles) - 2, 1.0 / period, period, poles)

    @cached_property
    def parameters(self) -> SampledGPIParameters:
        """What the laws `gpi_correct`, `gpi_predict` and `chain_...` need."""
        k = self.order
        N = np.zeros((k, k))
        for i in range(k):
            for j in range(i + 1, k):
                N[i, j] = 1.0 / factorial(j - i)
        Phi = np.eye(k) + N
        Gamma = np.zeros(k)
        Gamma[0], Gamma[1] = 0.5 * self.period**2, self.period**2
        roots = np.exp(np.array(self.poles) * self.period)
        p_of_Phi = np.eye(k, dtype=complex)
        for root in roots:  # factors (1 - root) I + N: no cancellation for real roots in (0, 1)
            p_of_Phi = p_of_Phi @ ((1.0 - root) * np.eye(k) + N)
        rows = [Phi[0]]
        for _ in range(k - 1):
            rows.append(rows[-1] @ Phi)
        last = np.linalg.solve(np.array(rows), np.eye(k)[-1])
        L = np.ascontiguousarray(np.real(p_of_Phi @ last))
        return SampledGPIParameters(Phi, Gamma, L, float(self.scale), k)

    @property
    def laws(self) -> ObserverLaws:
        return chain_laws(self.parameters, correct=gpi_correct, predict=gpi_predict)
