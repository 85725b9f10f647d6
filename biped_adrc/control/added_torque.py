"""A torque from elsewhere beside that of any controller, such as a learner's.

    u = u_i + a

u_i is what the controller inside asks for, a (p,) [N m] a number for each motor. The controller inside is told
the sum that acts: its observer does not take a for a disturbance, and so does not fight it. Around `Passive` it
is the torque a itself.

a is a parameter: machine code reads it from its vector K, Python from the array that it was made with, which
stays its maker's to write. So `biped_adrc.gym` gives another a before each sample, and compiles nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from biped_adrc.control.around import Around, AroundParameters, passed_on
from biped_adrc.control.base import Controller, ControllerLaws, Measurement
from biped_adrc.types import Array, freeze


class AddedParameters(NamedTuple):
    """torque: a (p,) [N m]."""

    torque: Array


@lru_cache(maxsize=64)
def adding(inner: ControllerLaws) -> ControllerLaws:
    """The laws of `AddedTorque` around these."""

    def output(k: AroundParameters, s: Array, m: Measurement) -> Array:
        u: Array = inner.output(k.inner, s, m) + k.own.torque
        return u

    return passed_on(inner)._replace(output=output)


@dataclass(frozen=True)
class AddedTorque(Around):
    """The module's a = `torque` (p,) [N m] beside the torque of `inner`."""

    inner: Controller
    torque: Array

    def __post_init__(self) -> None:
        freeze(self, "torque")

    @property
    def own(self) -> AddedParameters:
        return AddedParameters(self.torque)

    def around(self, inner: ControllerLaws) -> ControllerLaws:
        return adding(inner)
