"""References of the joints, figure 2 of the paper: functions of time or of the state.

A reference gives q_d, q_d' and q_d'' where q_d'' may contain the acceleration that the controller is about
to cause:

    q_d'' = drift + H q''
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

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


class Reference(ABC):
    """A pure function of (t, q, q')."""

    @abstractmethod
    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        """The reference at time t [s] and state (q, v), each (n,)."""


@dataclass(frozen=True)
class TimeReference(Reference):
    """q_d(t) given by a function that returns q_d, q_d', q_d'', each (p,) [rad, rad/s, rad/s^2]."""

    function: Callable[[float], tuple[Array, Array, Array]]

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        q_d, dq_d, ddq_d = self.function(t)
        return ReferencePoint(q_d, dq_d, ddq_d, np.zeros((len(q_d), len(q))))
