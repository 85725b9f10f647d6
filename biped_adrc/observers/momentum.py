"""Momentum observer: the generalised force zeta that the model does not know, from the momentum alone.

    pi = D q',   pi' = beta + zeta,   beta = C' q' - G + B u
    pi^' = beta + r   + l_1 (pi - pi^)
    r'   =        r'^ + l_2 (pi - pi^)
     ...

No acceleration and no inverse of D is needed. With one pole, r = l_1 (pi - pi^) is the residual of De Luca,
Albu-Schaeffer, Haddadin, Hirzinger, IROS 2006; with two, r is a state of its own as in the disturbance observer
of Chen, Ballance, Gawthrop, O'Reilly, IEEE Trans. Industrial Electronics 47(4), 2000, and a constant zeta is
found without error while pi - pi^ goes to zero too; with k poles a polynomial of degree k - 2 is.
With chi the polynomial of the poles

    zeta - r = s^(k-1) (s + l_1) / chi(s) zeta

States are scaled as in the GPI observer: z_1 = pi^, z_k = r^(k-2) / w^(k-1) for k from 2 on.

The rows are of all n coordinates, q_N among them, so r has a part that no motor can cancel.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.observers.base import Estimate, Observer, ObserverLaws
from biped_adrc.observers.chain import (
    MODEL,
    NONE,
    RELABEL,
    Chain,
    equal_poles,
    stable_poles,
    whole,
)
from biped_adrc.observers.gpi import (
    GPIObserver,
    SampledGPIObserver,
    SampledGPIParameters,
    gpi_correct,
    gpi_predict,
)
from biped_adrc.types import Array


class MomentumParameters(NamedTuple):
    """gains (k,), dimensionless; scale: w [rad/s] by which states are scaled; order: the number k of poles."""

    gains: Array
    scale: float
    order: int


def momentum_flow(k: MomentumParameters, Z: Array, y: Array, input: Array) -> Array:
    """Z' (k, n) for scaled states Z, momentum y (n,) and the known force beta (n,)."""
    w = k.scale
    dZ = w * np.outer(k.gains, y - Z[0])
    dZ[:-1] += w * Z[1:]
    dZ[0] += input
    return dZ


def momentum_state(k: Chain, x: Estimate) -> Array:
    """Z (k, n) that agrees with x, derivatives of r zero."""
    Z = np.zeros((k.order, len(x.position)))
    Z[0], Z[1] = x.position, x.disturbance / k.scale
    return Z


def momentum_estimate(k: Chain, Z: Array) -> Estimate:
    """pi^, 0 and r in Z (k, n)."""
    return Estimate(Z[0], np.zeros(Z.shape[1]), Z[1] * k.scale)


def momentum_reset(k: Chain, policy: int, Z: Array, swap: Array, x: Estimate) -> Array:
    """Z after impact; swap (n,) relabels the coordinates, x.position is the momentum after it.

    r is the force of something outside the model, which the impact does not end and the model does not know:
    all policies keep it, relabelled but for NONE. MODEL makes its derivatives zero.
    """
    if policy == NONE:
        return Z
    swapped = Z[:, swap]
    if policy != RELABEL:
        swapped[0] = x.position
    if policy == MODEL:
        swapped[2:] = 0.0
    return swapped


@dataclass(frozen=True)
class MomentumChain(Observer):
    """What the observer and its discrete form share; z is (k, n) flattened, poles and `scale` in [rad/s].

    A controller around it has to feed it with momentum and force of all n coordinates: `control.momentum_dob`.
    """

    poles: tuple[complex, ...]
    scale: float

    @property
    @abstractmethod
    def parameters(self) -> Chain:
        """What the laws need, a NamedTuple."""

    @property
    def order(self) -> int:
        return len(self.poles)


@dataclass(frozen=True)
class MomentumObserver(MomentumChain):
    """The module's equations. Make it with `from_poles` or `from_bandwidth`."""

    @classmethod
    def from_poles(cls, poles: Sequence[complex]) -> MomentumObserver:
        """Two stable poles [rad/s] or more; complex ones in conjugate pairs. Raises InputError."""
        checked = GPIObserver.from_poles(_stable(poles))
        return cls(checked.poles, checked.scale)

    @classmethod
    def from_bandwidth(cls, bandwidth: float, order: int = 2) -> MomentumObserver:
        """All poles at -bandwidth [rad/s]. Raises InputError."""
        number = whole(order, 2, "k", "the number of poles of a momentum observer")
        return cls.from_poles(equal_poles(bandwidth, number))

    @cached_property
    def parameters(self) -> MomentumParameters:
        """What the laws `momentum_...` need."""
        gains = np.real(np.poly(np.array(self.poles) / self.scale))[1:]
        return MomentumParameters(np.ascontiguousarray(gains), float(self.scale), self.order)

    @property
    def laws(self) -> ObserverLaws:
        return ObserverLaws(
            self.parameters, momentum_state, momentum_estimate, momentum_reset, flow=momentum_flow
        )

    def sampled(self, period: float) -> SampledMomentumObserver:
        """The current (filtered) discrete observer with poles exp(s T)."""
        return SampledMomentumObserver.from_poles(self.poles, period)


@dataclass(frozen=True)
class SampledMomentumObserver(MomentumChain):
    """The discrete observer for one period: that of a chain of integrators, beta entering at its first row.

    Exact for a beta that stays as it was at the tick; what it changes by until the next one is seen as a part
    of zeta, T beta' / 2.
    """

    period: float

    @classmethod
    def from_poles(cls, poles: Sequence[complex], period: float) -> SampledMomentumObserver:
        """Poles s [rad/s] of the continuous observer and the period T [s]. Raises InputError."""
        chain = SampledGPIObserver.from_poles(_stable(poles), period)
        return cls(chain.poles, chain.scale, period)

    @cached_property
    def parameters(self) -> SampledGPIParameters:
        """What the laws `gpi_correct`, `gpi_predict` and `momentum_...` need."""
        chain = SampledGPIObserver.from_poles(self.poles, self.period).parameters
        Gamma = np.zeros(self.order)
        Gamma[0] = self.period
        return chain._replace(Gamma=Gamma)

    @property
    def laws(self) -> ObserverLaws:
        return ObserverLaws(
            self.parameters,
            momentum_state,
            momentum_estimate,
            momentum_reset,
            correct=gpi_correct,
            predict=gpi_predict,
        )


def _stable(poles: Sequence[complex]) -> tuple[complex, ...]:
    return stable_poles(poles, "a momentum observer", ", one of them for r")
