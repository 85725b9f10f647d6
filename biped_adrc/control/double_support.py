"""What is commanded while both feet may carry: policies across contact that act on the torque.

    last torque    u <- u_0                                at each tick with t_step < T
    ramp torque    u <- u_0 + w(t_step / T) (u - u_0)      w of `across_contact`
    damping        u <- -d q_b'

A contact that takes time leaves both feet on the ground for some milliseconds, in which the model of one foot
that is pinned is wrong. u_0 is the torque of the last tick before the touchdown that the controller was told
of, its legs swapped, so that every motor goes on as it did; at the start of a run it is the controller's own.
A touchdown within the window keeps u_0. The observer inside runs as without the policy, and is told the torque
that acts; put it around `Hold` and its like to have both.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.control.across_contact import ContactWindow, SettlingParameters, ramp
from biped_adrc.control.around import AroundParameters, tick_laws
from biped_adrc.control.base import ControllerLaws, Measurement
from biped_adrc.control.kept_torque import parts
from biped_adrc.errors import InputError
from biped_adrc.observers.base import Estimate
from biped_adrc.types import Array

Command = Callable[[Any, Array, Array, Measurement], Array]
"""command(k, u, u_0, m) -> torque (p,) [N m] within the window; k: the policy's own numbers, u (p,) [N m]: what
the controller inside asks for."""


@lru_cache(maxsize=64)
def commanding(inner: ControllerLaws, command: Command) -> ControllerLaws:
    """The laws of a policy around these, which commands so within its window."""
    start, jumped, corrected, predicted = tick_laws(inner)
    told = inner.estimate

    def of(s: Array, m: Measurement) -> tuple[Array, Array]:
        return parts(s, m.terms.kappa.shape[0])

    def output(k: AroundParameters, s: Array, m: Measurement) -> Array:
        z, u_0 = of(s, m)
        u = inner.output(k.inner, z, m)
        return np.where(m.t_step < k.own.until, command(k.own, u, u_0, m), u)

    def initial_state(k: AroundParameters, m: Measurement) -> Array:
        z = start(k.inner, m)
        return np.concatenate((z, inner.output(k.inner, z, m)))

    def jump(k: AroundParameters, s: Array, after: Measurement, swap: Array) -> Array:
        z, u_0 = of(s, after)
        return np.concatenate((jumped(k.inner, z, after, swap), u_0[swap]))

    def correct(k: AroundParameters, s: Array, m: Measurement) -> Array:
        z, u_0 = of(s, m)
        return np.concatenate((corrected(k.inner, z, m), u_0))

    def predict(k: AroundParameters, s: Array, m: Measurement, u: Array) -> Array:
        z, u_0 = of(s, m)
        kept = np.where(m.t_step < k.own.until, u_0, u)
        return np.concatenate((predicted(k.inner, z, m, u), kept))

    def estimate(k: AroundParameters, s: Array, m: Measurement) -> Estimate | None:
        return None if told is None else told(k.inner, of(s, m)[0], m)

    seen = None if told is None else estimate
    return ControllerLaws(None, output, initial_state, None, jump, correct, predict, seen)


@dataclass(frozen=True)
class DoubleSupport(ContactWindow):
    """Base of the policies that command another torque for `window` seconds T after touchdown."""

    window: float = 0.005

    @staticmethod
    @abstractmethod
    def command(k: Any, u: Array, u_0: Array, m: Measurement) -> Array:
        """The law of a leaf, as `Command` says; on symbols too."""

    def around(self, inner: ControllerLaws) -> ControllerLaws:
        return commanding(inner, type(self).command)


@dataclass(frozen=True)
class LastTorque(DoubleSupport):
    """Every motor gives the torque of before the touchdown for `window` seconds."""

    @staticmethod
    def command(k: SettlingParameters, u: Array, u_0: Array, m: Measurement) -> Array:
        return u_0


@dataclass(frozen=True)
class RampTorque(DoubleSupport):
    """The torque goes from that before the touchdown to that of `inner` within `window` seconds."""

    @staticmethod
    def command(k: SettlingParameters, u: Array, u_0: Array, m: Measurement) -> Array:
        return u_0 + ramp(k.rate * m.t_step) * (u - u_0)


class DampingParameters(NamedTuple):
    """until: T less round-off [s]. damping [N m s/rad]."""

    until: float
    damping: float


@dataclass(frozen=True)
class DampedJoints(DoubleSupport):
    """The joints are damped for `window` seconds, by `damping` [N m s/rad]; 0 is no torque.

    Raises InputError for a damping that is negative or not finite.
    """

    damping: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (math.isfinite(self.damping) and self.damping >= 0.0):
            raise InputError(
                f"the damping in double support is {self.damping} N m s/rad, expected 0 or more, such as 5"
            )

    @property
    def own(self) -> DampingParameters:  # type: ignore[override]
        return DampingParameters(super().own.until, float(self.damping))

    @staticmethod
    def command(k: DampingParameters, u: Array, u_0: Array, m: Measurement) -> Array:
        return -k.damping * m.v_b
