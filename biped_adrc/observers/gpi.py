"""The Generalized Proportional Integral observer (17) of any order m >= 0.

    x1^' = x2^ + l_(m+1) (y - x1^)
    x2^' = x3^ + l_m     (y - x1^) + kappa u
    x3^' = x4^ + l_(m-1) (y - x1^)
     ...
    x_(m+2)^' = l_0 (y - x1^)

Its error obeys (19) with the poles chosen. States are scaled by w, the geometric mean of the poles:
z_k = x_k / w^(k-1), and the gains are the coefficients of the polynomial of the poles divided by w. The
injection is written l (y - x1^), never l y - l x1^: with gains up to 1e29 that form is lost in round-off.

In discrete time it has its *current* (filtered) form,

    Z- <- Phi Z + Gamma T^2 kappa u          prediction over one period
    Z  <- Z- + L (y - Z-_1)                  correction at the tick

Phi is the Taylor matrix of a chain of integrators in states z_k = x_k T^(k-1), Phi_ij = 1/(j - i)!, and
Gamma = (1/2, 1, 0, ...). L places the eigenvalues of (I - L C) Phi at exp(s T) by Ackermann's formula.
The held-measurement observer with the same poles is unstable at 1 kHz; this form is stable there.

m = 0 estimates position and velocity alone, m = 1 is the linear extended state observer, and m extended states
follow a disturbance that is a polynomial of degree m - 1 in time without a steady error. `high_gain` and
`kalman` are the same observer with gains from other considerations, and run by the laws of this module.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import factorial
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import InputError, check_positive
from biped_adrc.observers.base import ErrorSystem, ObserverLaws
from biped_adrc.observers.chain import ChainObserver, chain_laws, equal_poles, stable_poles, whole
from biped_adrc.types import Array

TABLE_I = tuple(-180.0 * 1.8**k for k in range(9))
"""Table I [rad/s]; the paper rounds them ("-11.020" and "-19.836" use the dot for thousands)."""


class GPIParameters(NamedTuple):
    """gains (m + 2,), dimensionless: l_(m+1)/w, l_m/w^2, ...; scale: w [rad/s]; order: m + 2."""

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
class InjectedChain(ChainObserver):
    """(17) with any gains: what its leaves share, whose `poles` say how they were chosen."""

    @property
    @abstractmethod
    def poles(self) -> tuple[complex, ...]:
        """(m + 2,) [rad/s]."""

    @cached_property
    def parameters(self) -> GPIParameters:
        """What the laws `gpi_flow` and `chain_...` need: the polynomial of the poles over w has these gains."""
        gains = np.real(np.poly(np.array(self.poles) / self.scale))[1:]
        return GPIParameters(np.ascontiguousarray(gains), float(self.scale), self.order)

    @property
    def laws(self) -> ObserverLaws:
        return chain_laws(self.parameters, gpi_flow)

    @property
    def gains(self) -> Array:
        """l_(m+1), l_m, ..., l_0 of (17) in physical units (m + 2,): [1/s], [1/s^2], ..., [1/s^(m+2)]."""
        return self.parameters.gains * self.scale ** np.arange(1, self.order + 1)

    def sampled(self, period: float) -> ChainObserver:
        """The current (filtered) discrete observer with poles exp(s T)."""
        return SampledGPIObserver.from_poles(self.poles, period)

    def error_system(self) -> ErrorSystem:
        """(19) in scaled states: e' = A e + b (q_b'' - kappa u)."""
        A = self.scale * np.eye(self.order, k=1)
        A[:, 0] = -self.scale * self.parameters.gains
        return ErrorSystem(A, 1.0 / self.scale)


@dataclass(frozen=True)
class GPIObserver(InjectedChain):
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


class SampledGPIParameters(NamedTuple):
    """Of the discrete form: Phi (k, k), Gamma T^2 (k,), L (k,); scale: 1/T [1/s]; order: k = m + 2.

    Also those of the sampled Kalman and momentum observers, whose Phi is the same.
    """

    Phi: Array
    Gamma: Array
    L: Array
    scale: float
    order: int


def gpi_correct(k: SampledGPIParameters, Z: Array, y: Array) -> Array:
    """Z (k, p) at the sample instant with y (p,) [rad] taken in."""
    return Z + np.outer(k.L, y - Z[0])


def gpi_predict(k: SampledGPIParameters, Z: Array, input: Array) -> Array:
    """Z (k, p) one period later under constant input kappa u (p,) [rad/s^2]."""
    return k.Phi @ Z + np.outer(k.Gamma, input)


def held_chain(order: int, period: float) -> tuple[Array, Array]:
    """Phi (k, k) and Gamma T^2 (k,) of the module's equation, for k = order states per joint and T [s]."""
    Phi = np.array(
        [[1.0 / factorial(j - i) if j >= i else 0.0 for j in range(order)] for i in range(order)]
    )
    Gamma = np.zeros(order)
    Gamma[0], Gamma[1] = 0.5 * period**2, period**2
    return Phi, Gamma


@dataclass(frozen=True)
class SampledGPIObserver(ChainObserver):
    """The discrete observer for one period T [s]; `scale` is 1/T, so that Phi has no T in it."""

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
        Phi, Gamma = held_chain(k, self.period)
        N = Phi - np.eye(k)
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
