"""A force and a moment on a link: zeta = J(q)' (F_x, F_z, M), with J of a point of the link.

`wave` says how (F_x, F_z, M) goes with time: a pulse, a step, a sine, noise, or any other `Windowed` of
amplitude (3,). The force has the world's axes, not the link's. It enters the unactuated row too, and the ground
carries m (p_com'' - g) - F.

The wave is a function of time that knows nothing of links: its law gives three numbers in place of n torques,
and `link_law` multiplies them by J(q)'. So every wave of the package, and one of the user's own, pushes a link
without code here, in both engines.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np

from biped_adrc.disturbances.base import Disturbance, DisturbanceLaw, Windowed, disturbance_laws
from biped_adrc.errors import InputError
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import LinkPoint, link_point, wrench_torque
from biped_adrc.types import Array


class LinkParameters(NamedTuple):
    """point: p(q) of the link and its J in closed form. wave: the parameters of the wave's own law."""

    point: LinkPoint
    wave: object


AT_REST = np.zeros(3), np.zeros(3)
"""What a wave is given for q and q', each (3,): it is a function of time."""


@lru_cache(maxsize=64)
def link_law(wave: DisturbanceLaw) -> DisturbanceLaw:
    """The law of a force and a moment that go as a wave does, both without their parameters.

    Cached by the wave's functions: pushes that differ in numbers alone have the same law, hence one machine
    code.
    """
    torque, active = wave.torque, wave.active

    def on_coordinates(
        k: LinkParameters, t: float, step: int, t_start: float, q: Array, v: Array
    ) -> Array:
        """J(q)' (F_x, F_z, M) (n,) [N m]."""
        return wrench_torque(k.point, q, torque(k.wave, t, step, t_start, *AT_REST))

    def force(k: LinkParameters, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return torque(k.wave, t, step, t_start, *AT_REST)[:2]

    def acts(k: LinkParameters, t: float, step: int, t_start: float) -> float:
        return 1.0 if active is None else active(k.wave, t, step, t_start)

    return DisturbanceLaw(None, on_coordinates, resultant=force, active=acts)


@dataclass(frozen=True)
class OnLink(Disturbance):
    """`wave` with amplitude (F_x, F_z, M) [N, N, N m] on `link` of `biped`, the plant.

    at: the point (x, z) [m] in the link's frame, as its URDF has it; its origin without. M is counter-clockwise
    with x to the right and z up. A link of the leg that the URDF draws as the stance leg is the
    stance leg's in every single support: the push changes legs at each impact, since coordinates do.
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
        super().__post_init__()
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
        """Where it acts, in closed form: p(q) (2,) [m] and its Jacobian."""
        return link_point(self.biped, self.link, self.at)

    def switching_times(self, step: int, t_start: float) -> tuple[float, ...]:
        """Those of the wave [s]."""
        return self.wave.switching_times(step, t_start)

    @property
    def laws(self) -> tuple[DisturbanceLaw, ...]:
        """A law for each of the wave's, which says itself why it does not compile where it does not."""
        return tuple(
            link_law(law._replace(parameters=None, switches=(), obstacle=""))._replace(
                parameters=LinkParameters(self.point, law.parameters),
                switches=law.switches,
                obstacle=law.obstacle,
            )
            for law in disturbance_laws(self.wave)
        )
