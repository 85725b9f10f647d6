"""A force and a moment on a link: zeta = J(q)' (F_x, F_z, M), with J of a point of the link.

`wave` says how (F_x, F_z, M) goes with time: a pulse, a step, a sine, noise, or any other `Windowed` of
amplitude (3,). The force has the world's axes, not the link's. It enters the unactuated row too, and the ground
carries m (p_com'' - g) - F.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from biped_adrc.disturbances.base import Disturbance, DisturbanceLaw, Windowed, WindowParameters
from biped_adrc.disturbances.noise import NoiseParameters, noise_torque
from biped_adrc.disturbances.pulse import PulseParameters, pulse_torque
from biped_adrc.disturbances.sine import SineParameters, sine_torque
from biped_adrc.disturbances.step import step_torque
from biped_adrc.errors import InputError
from biped_adrc.model.biped import Biped
from biped_adrc.model.link_point import LinkPoint, link_point, wrench_torque
from biped_adrc.types import Array

_K = TypeVar("_K")


class LinkParameters(NamedTuple, Generic[_K]):
    """The point, and the wave's own parameters."""

    point: LinkPoint
    wave: _K


def link_pulse(
    k: LinkParameters[PulseParameters], t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]."""
    return wrench_torque(k.point, q, pulse_torque(k.wave, t, step, t_start, q, v))


def link_step(
    k: LinkParameters[WindowParameters], t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]."""
    return wrench_torque(k.point, q, step_torque(k.wave, t, step, t_start, q, v))


def link_sine(
    k: LinkParameters[SineParameters], t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]."""
    return wrench_torque(k.point, q, sine_torque(k.wave, t, step, t_start, q, v))


def link_noise(
    k: LinkParameters[NoiseParameters], t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """zeta (n,) [N m]."""
    return wrench_torque(k.point, q, noise_torque(k.wave, t, step, t_start, q, v))


def pulse_force(
    k: LinkParameters[PulseParameters], t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """(F_x, F_z) [N]."""
    return pulse_torque(k.wave, t, step, t_start, q, v)[:2]


def step_force(
    k: LinkParameters[WindowParameters], t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """(F_x, F_z) [N]."""
    return step_torque(k.wave, t, step, t_start, q, v)[:2]


def sine_force(
    k: LinkParameters[SineParameters], t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """(F_x, F_z) [N]."""
    return sine_torque(k.wave, t, step, t_start, q, v)[:2]


def noise_force(
    k: LinkParameters[NoiseParameters], t: float, step: int, t_start: float, q: Array, v: Array
) -> Array:
    """(F_x, F_z) [N]."""
    return noise_torque(k.wave, t, step, t_start, q, v)[:2]


_ON_LINK: dict[Callable[..., Array], tuple[Callable[..., Array], Callable[..., Array]]] = {
    pulse_torque: (link_pulse, pulse_force),
    step_torque: (link_step, step_force),
    sine_torque: (link_sine, sine_force),
    noise_torque: (link_noise, noise_force),
}
"""Torque and resultant, by the law of the wave."""


@dataclass(frozen=True)
class OnLink(Disturbance):
    """`wave` with amplitude (F_x, F_z, M) [N, N, N m] on `link` of `biped`, the plant.

    at: the point (x, z) [m] in the link's frame, as its URDF has it; its origin without. M is counter-clockwise
    with x to the right and z up. A link of the leg that the URDF draws as the stance leg is the
    stance leg's in every single support.
    Raises InputError for a wave that has not three amplitudes, ModelError for a link that the robot has not.
    """

    biped: Biped
    link: str
    wave: Windowed
    at: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.wave, Windowed):
            raise InputError(
                f"the wave on link '{self.link}' is a {type(self.wave).__name__}, expected a TorquePulse, "
                "TorqueStep, TorqueSine, TorqueNoise or another Windowed; add up several OnLink for a sum"
            )
        if len(self.wave.amplitude) != 3:
            raise InputError(
                f"the wave on link '{self.link}' has the amplitude {self.wave.amplitude}, expected three "
                "numbers (F_x, F_z, M) [N, N, N m]"
            )
        if self.at is not None and not (len(self.at) == 2 and all(map(math.isfinite, self.at))):
            raise InputError(
                f"the point on link '{self.link}' is {self.at}, expected two finite numbers (x, z) [m]"
            )
        _ = self.point

    @cached_property
    def point(self) -> LinkPoint:
        """Where it acts, in closed form."""
        return link_point(self.biped, self.link, self.at)

    def wrench(self, t: float, step: int, t_start: float) -> Array:
        """(F_x, F_z, M) [N, N, N m]."""
        still = np.zeros(3)
        return self.wave.torque(t, step, t_start, still, still)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return wrench_torque(self.point, q, self.wrench(t, step, t_start))

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        return self.wrench(t, step, t_start)[:2]

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        return self.wave.switching_times(step, t_start)

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...] | None:
        waves = self.wave.laws
        if waves is None or len(waves) != 1 or waves[0].torque not in _ON_LINK:
            return None
        law = waves[0]
        k = LinkParameters(self.point, law.parameters)
        torque, resultant = _ON_LINK[law.torque]
        return (DisturbanceLaw(k, torque, law.switches, resultant),)
