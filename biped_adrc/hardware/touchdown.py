"""How a controller is told of a touchdown: late, early, not at all, or of one that was none.

    d <- touchdown(d, other, t)               at a true touchdown
    (d, fires) = notice(d, look)              at a tick, fires 0 or 1

Without such a part a controller, its observer and the labels of its measurement change at the true touchdown.
With one they change at the tick at which `notice` fires, and what the controller holds for true meanwhile, its
belief, is a part of the walker's state:

    b = (other, step, start, d)       other: 1 where its legs have the labels of the other foot, else 0

A touchdown and a notice each turn `other`. So a notice before its touchdown is an early one, and a touchdown
that is not noticed before the next one leaves the labels right again and the belief two steps behind. Both
engines run these methods, which are pure functions; randomness is a part of d.

Leaves are in `detectors`: one has errors that are asked for, the others go by the measured angles, or
by the force on the foot that the controller takes for the swing foot.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar, NamedTuple

import numpy as np

from biped_adrc.core.checks import Checked
from biped_adrc.core.types import Array

HEAD = 3
"""Numbers in b before d."""


class Belief(NamedTuple):
    """What a controller takes for the present single support, the parts of b."""

    other: float
    """1 where its labels differ from the plant's, else 0."""
    step: int
    """Single support, counted by notices."""
    start: float
    """Time of the last notice [s]."""
    d: Array
    """The leaf's own state (size,)."""


class Look(NamedTuple):
    """What a leaf may look at, at a tick."""

    t: float
    """[s]"""
    t_step: float
    """Since the last notice [s]."""
    foot: Array
    """The controller's swing foot (x, z) from its stance foot (2,) [m], by its model at the measured angles."""
    force: float
    """Vertical force of the ground on the controller's swing foot [N]; 0 unless `needs_force`."""
    other: float
    """1 where the controller's labels differ from the plant's; for errors that are asked for."""
    step: float
    """The plant's single support; for errors that are asked for."""
    age: float
    """Since the last true touchdown [s]; for errors that are asked for."""


class Touchdown(Checked, ABC):
    """Base of all leaves: frozen dataclasses that `notice` touchdowns; one with a memory has a `size` too.

    >>> @dataclass(frozen=True)
    ... class Low(ba.Touchdown):
    ...     height: float  # [m]
    ...
    ...     def notice(self, d, look):
    ...         return d, 1.0 * (look.t_step > 0.2) * (look.foot[1] < self.height)
    >>> timing = ba.SampledTime(1e-3, restart=False)
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, touchdown=Low(0.001))
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    needs_force: ClassVar[bool] = False
    """Whether `Look.force` is needed."""

    @property
    def size(self) -> int:
        """Numbers in d."""
        return 0

    def start(self) -> Array:
        """d (size,) at the start of a run."""
        return np.zeros(self.size)

    def touchdown(self, d: Array, other: float, t: float) -> Array:
        """d (size,) after a true touchdown at t [s]; `other` is that after it."""
        return d

    @abstractmethod
    def notice(self, d: Array, look: Look) -> tuple[Array, float]:
        """d (size,) after a tick, and 1 where a touchdown is noticed, else 0."""

    @property
    def noisy(self) -> bool:
        """Whether anything is random."""
        return False


def belief_of(b: Array) -> Belief:
    """The parts of b."""
    return Belief(b[0], b[1], b[2], b[HEAD:])


def numbers_of(belief: Belief) -> Array:
    """b of its parts, the inverse of `belief_of`."""
    return np.concatenate((np.array([belief.other, belief.step, belief.start]), belief.d))
