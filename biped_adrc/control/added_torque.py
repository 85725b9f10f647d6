"""A torque from elsewhere beside that of any controller, such as a learner's.

    u = u_i + a

u_i is what the controller inside asks for, a (p,) [N m] a number for each motor. The controller inside gets
the sum that acts: its observer does not take a for a disturbance, and so does not fight it. Around `Passive` it
is the torque a itself.

a is a parameter: machine code reads it from its vector K, Python from the array that it was made with, which
stays its maker's to write. So a `Stepper` gives another a before each sample, and compiles nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

from biped_adrc.control.around import Around
from biped_adrc.control.base import Measurement
from biped_adrc.core.types import Array, freeze


@dataclass(frozen=True)
class AddedTorque(Around):
    """The module's a = `torque` (p,) [N m] beside the torque of `inner`."""

    torque: Array

    def __post_init__(self) -> None:
        freeze(self, "torque")

    def output(self, s: Array, m: Measurement) -> Array:
        return self.inner.output(s, m) + self.torque

    def projected_output(self, s: Array, m: Measurement, a: Array) -> Array:
        return self.inner.projected_output(s, m, a) + self.torque
