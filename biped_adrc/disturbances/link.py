"""A force and a moment on a link: zeta = J(q)' (F_x, F_z, M), with J of a point of the link.

`wave` says how (F_x, F_z, M) goes with time: a pulse, a step, a sine, noise, or any other `Windowed` of
amplitude (3,). The force has the world's axes, not the link's. It enters the unactuated row too, and the ground
carries m (p_com'' - g) - F.

The wave is a function of time that knows nothing of links: its `torque` gives three numbers in place of n
torques, which are multiplied by J(q)'. So every wave of the package, and one of the user's own, pushes a link.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.part import SETUP, derived, setup
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Disturbance, Windowed
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import LinkPoint, link_point, wrench_torque

AT_REST = np.zeros(3), np.zeros(3)
"""What a wave is given for q and q', each (3,): it is a function of time."""


@dataclass(frozen=True)
class OnLink(Disturbance):
    """`wave` with amplitude (F_x, F_z, M) [N, N, N m] on `link` of `biped`, the plant.

    at: the point (x, z) [m] in the link's frame, as its URDF has it; its origin without. M is counter-clockwise
    with x to the right and z up. A link of the leg that the URDF draws as the stance leg is the
    stance leg's in every single support: the push changes legs at each impact, since coordinates do.
    Raises InputError for a wave that has not three amplitudes, ModelError for a link that the robot has not.

    >>> push = ba.OnLink(biped, "torso", ba.TorquePulse([50.0, 0.0, 0.0], step=3, stop=0.1))
    >>> push.net_force(1.0, 3, 0.95)
    array([50.,  0.])
    """

    biped: Biped
    link: str = field(metadata=SETUP)
    wave: Windowed
    at: tuple[float, float] | None = setup(None)

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

    @derived
    def point(self) -> LinkPoint:
        """Where it acts, in closed form: p(q) (2,) [m] and its Jacobian."""
        return link_point(self.biped, self.link, self.at)

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        return self.wave.switches

    def acts(self, t: float, step: int, t_start: float) -> float:
        return self.wave.acts(t, step, t_start)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """J(q)' (F_x, F_z, M) (n,) [N m]."""
        return wrench_torque(self.point, q, self.wave.torque(t, step, t_start, *AT_REST))

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        return self.wave.torque(t, step, t_start, *AT_REST)[:2]
