"""References q_d of the actuated joints, figure 2 of the paper: functions of time, or of the state.

A reference that depends on the state (a virtual constraint) has an acceleration which contains the joint
acceleration that the controller is about to cause. It is therefore split into

    q_d'' = drift + H q''

so that a controller can solve for its torque without an algebraic loop. For a function of time H = 0.

Controllers call the reference at each evaluation of the closed loop, and the engine compiles it with them.
"""

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.core.checks import called_checked, point_returned
from biped_adrc.core.part import Part
from biped_adrc.core.shown import shown
from biped_adrc.core.types import Array


@shown
class ReferencePoint(NamedTuple):
    """The reference at one instant; p joints, n coordinates.

    >>> r = gait.constraint(0.0, gait.q_minus, gait.v_minus)
    >>> r.q_d.shape, r.H.shape
    ((4,), (4, 5))
    """

    q_d: Array
    """Angles (p,) [rad]."""
    dq_d: Array
    """Rates (p,) [rad/s]."""
    drift: Array
    """Part of q_d'' (p,) [rad/s^2] that does not depend on q''."""
    H: Array
    """Matrix (p, n) of q_d'' = drift + H q'', dimensionless."""


class Reference(Part):
    """Base of all references: q_d as a pure function of (t, q, q'). What a subclass returns is checked.

    >>> @dataclass(frozen=True)
    ... class Still(ba.Reference):
    ...     pose: tuple[float, ...]  # [rad]
    ...
    ...     def __call__(self, t, q, v):
    ...         q_d = np.array(self.pose)
    ...         return ba.ReferencePoint(q_d, 0.0 * q_d, 0.0 * q_d, np.zeros((4, 5)))
    >>> Still((0.1, 0.2, 0.3, 0.4))(0.0, gait.q_minus, gait.v_minus).dq_d
    array([0., 0., 0., 0.])
    """

    SUCH_AS = "gait.constraint"  # an example of such an object, for error messages

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        called_checked(cls, ReferencePoint)  # wraps the `__call__` of the subclass

    @abstractmethod
    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        """The reference at time t [s] and state q (n,) [rad], v (n,) [rad/s]."""


def check_point(reference: Reference, r: object, p: int, n: int) -> None:
    """Raise InputError unless r, which `reference` returned, has the shapes of p joints and n coordinates.

    Called once before a walk, since a wrong shape would broadcast silently.
    """
    point_returned(r, ReferencePoint, reference, n, p)


@dataclass(frozen=True)
class TimeReference(Reference):
    """A reference q_d(t): `function` returns q_d [rad], q_d' [rad/s], q_d'' [rad/s^2], each (p,), at t [s]."""

    function: Callable[[float], tuple[Array, Array, Array]]

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        q_d, dq_d, ddq_d = self.function(t)  # q_d'' does not depend on q'', so it is all drift
        return ReferencePoint(q_d, dq_d, ddq_d, np.zeros((len(q_d), len(q))))


@dataclass(frozen=True)
class ZeroReference(Reference):
    """q_d = 0 of p joints, for signals of which only torques and forces are asked."""

    p: int

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        zero = np.zeros(self.p)
        return ReferencePoint(zero, zero, zero, np.zeros((self.p, len(q))))
