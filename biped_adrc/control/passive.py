"""No torque at all: u = 0, for passive walkers and for seeing what a robot does by itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.control.base import Controller, ControllerLaws, Measurement
from biped_adrc.types import Array


class PassiveParameters(NamedTuple):
    """None."""


def passive_output(k: PassiveParameters, s: Array, m: Measurement) -> Array:
    """u = 0 (p,) [N m]."""
    return np.zeros(m.terms.kappa.shape[0])


@dataclass(frozen=True)
class Passive(Controller):
    """u = 0 (p,) [N m]."""

    def output(self, s: Array, m: Measurement) -> Array:
        return passive_output(self.parameters, s, m)

    @property
    def parameters(self) -> PassiveParameters:
        """What the law `passive_output` needs: nothing."""
        return PassiveParameters()

    @property
    def laws(self) -> ControllerLaws:
        return ControllerLaws(self.parameters, passive_output)
