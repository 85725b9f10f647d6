"""References q_d of the driven joints, figure 2 of the paper: functions of time, or of the state.

A reference that depends on the state (a virtual constraint) has an acceleration which contains the joint
acceleration that the controller is about to cause. It is therefore split into

    q_d'' = drift + H q''

so that a controller can solve for its torque without an algebraic loop. For a function of time H = 0.

Controllers call the reference at each evaluation of the closed loop. A reference given as `laws` (pure
functions of a NamedTuple of parameters) is also compiled by the engine; one that only writes `__call__` runs in
Python.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from biped_adrc.composed import Composed
from biped_adrc.errors import InputError
from biped_adrc.parts import called_checked, point_returned
from biped_adrc.shown import one_line
from biped_adrc.types import Array


class ReferencePoint(NamedTuple):
    """The reference at one instant; p joints, n coordinates."""

    q_d: Array
    """(p,) [rad]."""
    dq_d: Array
    """(p,) [rad/s]."""
    drift: Array
    """(p,) [rad/s^2], the part of q_d'' that does not depend on q''."""
    H: Array
    """(p, n), q_d'' = drift + H q''."""

    def __repr__(self) -> str:
        return one_line(self)


class ReferenceLaws(NamedTuple):
    """The pure function behind a reference."""

    parameters: object
    """k, a NamedTuple of numbers and float64 arrays."""
    point: Callable[..., ReferencePoint]
    """point(k, t, q, v) -> q_d, q_d' and q_d'', with t [s], q (n,) [rad], v (n,) [rad/s]."""
    obstacle: str = ""
    """Why it runs in Python only; empty where it compiles."""

    def __repr__(self) -> str:
        return one_line(self)


class Reference(Composed):
    """Base class: q_d as a pure function of (t, q, q'). A subclass gives `laws`, or writes `__call__`."""

    _kind: ClassVar[str] = "reference"
    _methods: ClassVar[frozenset[str]] = frozenset(("__call__",))

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        called_checked(cls, ReferencePoint)

    @property
    def laws(self) -> ReferenceLaws | None:
        """The pure function that `__call__` calls; None for a reference written as a method."""
        return None

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        """The reference at time t [s] and state q (n,) [rad], v (n,) [rad/s].

        Raises InputError for a subclass that has neither laws nor this method.
        """
        laws: ReferenceLaws | None = self._laws
        if laws is None:
            raise InputError(
                f"{type(self).__name__} has neither laws nor a method __call__(t, q, v); write one of them: a "
                "ReferencePoint from time and state"
            )
        return laws.point(laws.parameters, t, q, v)


def reference_laws(reference: Reference) -> ReferenceLaws:
    """The laws of a reference: its method, of which the reference itself is the first argument."""
    if not reference._obstacle:
        laws: ReferenceLaws = reference._laws
        return laws
    return ReferenceLaws(reference, type(reference).__call__)


def check_point(reference: Reference, r: object, p: int, n: int) -> None:
    """Raise InputError unless r is a `ReferencePoint` with the shapes of p joints and n coordinates.

    Called once before a walk, since a wrong shape would broadcast silently.
    """
    point_returned(r, ReferencePoint, reference, n, p)


@dataclass(frozen=True)
class TimeReference(Reference):
    """q_d(t) given by a function that returns q_d, q_d', q_d'', each (p,) [rad, rad/s, rad/s^2]."""

    function: Callable[[float], tuple[Array, Array, Array]]

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        q_d, dq_d, ddq_d = self.function(t)
        return ReferencePoint(q_d, dq_d, ddq_d, np.zeros((len(q_d), len(q))))
