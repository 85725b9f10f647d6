"""A policy across contact: what is not the model's in xi^ is kept over a touchdown, as a torque in N m.

    w  = kappa^-1 (xi^ - xi)                  before, as of the last tick
    xi^ = xi + kappa w[swap]                  after

xi and kappa are the nominal model's, before and after. A push on the joints goes on through a touchdown as a
torque, while its kappa zeta jumps with kappa, and xi itself jumps with the rates: the policy keeps what stays.
Positions and rates begin as measured, derivatives of xi^ as zero, whatever the observer's reset. In sampled
time, since at a touchdown the measurement before it is gone: w is a state beside the observer's.

A torque from outside enters as one of the motors does, so that the policy goes around every observer; for
`momentum_dob`, which keeps its force r itself, w is the torque of equal effect on the joints, and what r has of
an unactuated coordinate is taken into it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from biped_adrc.control.across_contact import AcrossContact
from biped_adrc.control.around import AroundParameters, tick_laws
from biped_adrc.control.base import ControllerLaws, Measurement, controller_laws
from biped_adrc.errors import InputError
from biped_adrc.observers.base import Estimate
from biped_adrc.types import Array


def parts(s: Array, p: int) -> tuple[Array, Array]:
    """The inner state, and w (p,) [N m] at the end of s."""
    size = len(s) - p
    return s[:size], s[size:]


def outside_torque(x: Estimate | None, m: Measurement) -> Array:
    """w (p,) [N m] of the module, for what an observer says of the joints at m."""
    assert x is not None
    return m.terms.kappa_inverse @ (x.disturbance - m.terms.xi)


@lru_cache(maxsize=64)
def keeping(inner: ControllerLaws) -> ControllerLaws:
    """The laws of `KeepTorque` around these."""
    start, _, corrected, predicted = tick_laws(inner)
    begin, told = inner.begin, inner.estimate
    assert begin is not None
    assert told is not None

    def output(k: AroundParameters, s: Array, m: Measurement) -> Array:
        return inner.output(k.inner, parts(s, m.terms.kappa.shape[0])[0], m)

    def initial_state(k: AroundParameters, m: Measurement) -> Array:
        return np.concatenate((start(k.inner, m), np.zeros(m.terms.kappa.shape[0])))

    def jump(k: AroundParameters, s: Array, after: Measurement, swap: Array) -> Array:
        w = parts(s, len(swap))[1][swap]
        return np.concatenate((begin(k.inner, after, w), w))

    def correct(k: AroundParameters, s: Array, m: Measurement) -> Array:
        z = corrected(k.inner, parts(s, m.terms.kappa.shape[0])[0], m)
        return np.concatenate((z, outside_torque(told(k.inner, z, m), m)))

    def predict(k: AroundParameters, s: Array, m: Measurement, u: Array) -> Array:
        z, w = parts(s, len(u))
        return np.concatenate((predicted(k.inner, z, m, u), w))

    def estimate(k: AroundParameters, s: Array, m: Measurement) -> Estimate | None:
        return told(k.inner, parts(s, m.terms.kappa.shape[0])[0], m)

    return ControllerLaws(None, output, initial_state, None, jump, correct, predict, estimate)


@dataclass(frozen=True)
class KeepTorque(AcrossContact):
    """xi^ - xi of `inner` goes on over a touchdown as a torque.

    Raises InputError for a controller without an observer that can begin under a torque.
    """

    def __post_init__(self) -> None:
        if controller_laws(self.inner).begin is None:
            raise InputError(
                f"{type(self.inner).__name__} has no observer that begins under a torque from outside; "
                "expected one with the law `begin`, such as ADRCController"
            )

    def around(self, inner: ControllerLaws) -> ControllerLaws:
        return keeping(inner)
