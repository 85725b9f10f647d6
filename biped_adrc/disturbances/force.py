"""A force and a moment on a point of the robot: zeta = J(q)' (F_x, F_z, M), with J of that point.

F_x is horizontal, F_z vertical, J(q)' the transposed Jacobian, and zeta the generalised force (n,) [N m]. The
force has the world's axes, not the link's. It enters the unactuated row too, so no tracking loop rejects it
(Westervelt, Grizzle, Canudas de Wit, IEEE CDC 2003): the speed of walking changes, and an outer loop such as
`control.stride` has to bring it back. The force of the ground is m (p_com'' - g) - F, with p_com the COM. J is
that of the plant: a plant with model errors has other geometry than the nominal robot, and the push acts on
what walks. step is the number of the single support, from 1, and t_start [s] the time at which it began.

`OnLink` has (F_x, F_z, M) of a wave: a pulse, a step, a sine, noise, or any other `Windowed` of amplitude (3,).
The wave is a function of time that knows nothing of links: its `torque` gives three numbers in place of n
torques, which are multiplied by J(q)'. So every wave of the package, and one of the user's own, pushes a link.

`HipForce` is constant on the hip; F_x < 0 pulls backwards. `AddedForce` is set from outside, by a hand or a
learner: F is a number that machine code reads at run time, as the torque of `control.around.AddedTorque`. Its
owner, the program that runs the walk, writes another F before each sample, and nothing is compiled anew.
"""

import math
from dataclasses import dataclass, field
from typing import Annotated

import numpy as np

from biped_adrc.core.checks import Range, TwoFloats
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import SETUP, derived, setup
from biped_adrc.core.types import Array, freeze
from biped_adrc.disturbances.base import Disturbance, Windowed
from biped_adrc.model import planar
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import LinkPoint, hip_point, link_point, wrench_torque

COUNT_UP = Range("(first, last) with 1 <= first <= last", lambda x: 1 <= x[0] <= x[1])
AT_REST = np.zeros(3), np.zeros(3)
"""q and q', each (3,), for calls of a wave, which is a function of time alone."""


@dataclass(frozen=True)
class OnLink(Disturbance):
    """A force and a moment from outside on a link, of a shape in time.

    biped: the plant. link: its name. wave: a pulse, step, sine or noise of amplitude (F_x, F_z, M) (3,)
    [N, N, N m]. at (2,) [m]: the point (x, z) in the link's frame, as its URDF has it; its origin if None. M is
    counter-clockwise with x to the right and z up. A link of the leg that the URDF draws as the stance leg is
    the stance leg's in every single support: the push changes legs at each impact, since coordinates do.
    Raises InputError for a wave that has not three amplitudes, ModelError for a link that the robot has not.

    >>> push = ba.OnLink(biped, "torso", ba.TorquePulse([50.0, 0.0, 0.0], step=3, stop=0.1))
    >>> push.net_force(1.0, 3, 0.95)
    array([50.,  0.])
    """

    biped: Biped
    link: str = field(metadata=SETUP)
    wave: Windowed
    at: TwoFloats | None = setup(None)

    def __post_init__(self) -> None:
        if len(self.wave.amplitude) != 3:
            raise InputError(
                f"amplitude {self.wave.amplitude} on link '{self.link}', expected (F_x, F_z, M) [N, N, N m]"
            )
        # computed now, so that an unknown link is an error at once
        _ = self.point

    @derived
    def point(self) -> LinkPoint:
        """The point where it acts, in closed form: p(q) (2,) [m] and its Jacobian."""
        return link_point(self.biped, self.link, self.at)

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        return self.wave.switches

    def acts(self, t: float, step: int, t_start: float) -> float:
        return self.wave.acts(t, step, t_start)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta = J(q)' (F_x, F_z, M) (n,) [N m], with the three numbers of the wave at t."""
        # AT_REST: zeros for q and q', which a wave does not read
        return wrench_torque(self.point, q, self.wave.torque(t, step, t_start, *AT_REST))

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        # (F_x, F_z) without the moment
        return self.wave.torque(t, step, t_start, *AT_REST)[:2]


@dataclass(frozen=True)
class HipForce(Disturbance):
    """A constant force from outside on the hip.

    biped: the plant. force (2,) [N]: (F_x, F_z), forwards and up. steps: the first and the last single support
    (from 1) in which it acts; all of them if None. It switches at impacts alone, so integrators have no times
    to stop at. Raises InputError for a force that is not two finite numbers, or steps that do not count up from
    1.

    >>> push = ba.HipForce(biped, (20.0, 0.0), steps=(4, 6))
    >>> push.net_force(2.0, 4, 1.9)
    array([20.,  0.])
    """

    biped: Biped
    force: TwoFloats
    steps: Annotated[tuple[int, int], COUNT_UP] | None = setup(None)

    @derived
    def hip(self) -> LinkPoint:
        """The hip as a point in closed form, with its Jacobian."""
        return hip_point(self.biped)

    @derived
    def span(self) -> tuple[float, float]:
        """The first and the last single support in which it acts, as floats; (0, inf) for all."""
        first, last = self.steps or (0, math.inf)
        return float(first), float(last)

    def acts(self, t: float, step: int, t_start: float) -> float:
        """1 from the first to the last single support, else 0."""
        first, last = self.span
        return 1.0 * (step >= first) * (step <= last)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta = J(q)' F (n,) [N m]; no moment acts."""
        return wrench_torque(self.hip, q, np.array([*self.force, 0.0]))

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        return 1.0 * np.array(self.force)


@dataclass(frozen=True)
class AddedForce(Disturbance):
    """A force on `point`; the program that runs the walk may change the force before each sample.

    force: (F_x, F_z) (2,) [N]. `acts` is its square, so that nothing is computed while it is zero. There is no
    moment, so the torque is J(q)' force with the Jacobian J (2, n) of the point.
    """

    force: Array
    point: LinkPoint

    def __post_init__(self) -> None:
        freeze(self, "force")

    def acts(self, t: float, step: int, t_start: float) -> float:
        # the square of the force: any number above 0 says that it acts
        return 1.0 * (self.force[0] ** 2 + self.force[1] ** 2)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        # J(q)' force; A, re and im are the constants of the point's closed form
        k = self.point
        return self.force @ planar.jacobian(k.A, planar.turned(k.A, q), k.re, k.im)

    def resultant(self, t: float, step: int, t_start: float) -> Array:
        return 1.0 * self.force
