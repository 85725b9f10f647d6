"""What a hand does to a robot from one sample instant to the next: torques on coordinates, a force on a link.

    zeta = tau + J(q)' F

tau (n,) [N m] acts on q1..qN, F = (F_x, F_z) [N] at a point of one link; both are held over a sample, so that
what was done is a list of numbers. `Spring` is the hand that pulls by a spring: at each sample instant

    F = k (anchor - p) - d p',   |F| <= most

with p (2,) [m] the point in the world. A force that is held for a period T acts T / 2 late, which takes k T / 2
from the damping: the defaults leave 98 % of d at 1 kHz.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.stepping_plant import Load
from biped_adrc.errors import InputError
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import LinkPoint, jacobian, link_point, point, turned, wrench_torque
from biped_adrc.types import Array

MOST_FORCE = 300.0
"""Largest force of a hand [N], about the weight of RABBIT: what a person may do with one arm."""
MOST_TORQUE = 200.0
"""Largest torque of a hand on one coordinate [N m], above the 150 N m of RABBIT's motors."""


REACH = 3.0
"""Largest distance of a point from the origin of its link [m]: it is on the link, or on what that carries."""
MOST_POINTS = 64
"""Points kept in closed form."""


class Hand(NamedTuple):
    """What acts over one sample, in plain numbers."""

    torque: tuple[float, ...]
    """On q1..qN (n,) [N m]."""
    link: str
    """Name of the link that the force acts on."""
    at: tuple[float, float] = (0.0, 0.0)
    """Point (x, z) [m] in the frame of the link."""
    force: tuple[float, float] = (0.0, 0.0)
    """(F_x, F_z) [N] in the axes of the world."""

    @property
    def idle(self) -> bool:
        """Whether it does nothing."""
        return not (any(self.torque) or any(self.force))


class Spring(NamedTuple):
    """A spring from a point of a link to the hand."""

    link: str
    """Name of the link."""
    at: tuple[float, float]
    """Point (x, z) [m] in the frame of the link."""
    anchor: tuple[float, float]
    """Where the hand is, (x, z) [m] in the world."""
    stiffness: float = 1500.0
    """k [N/m]"""
    damping: float = 40.0
    """d [N s/m]"""
    most: float = MOST_FORCE
    """Largest force [N]."""

    def force(self, p: Array, rate: Array) -> tuple[float, float]:
        """F (2,) [N] on the point, which is at p (2,) [m] and moves with `rate` (2,) [m/s]."""
        pull = self.stiffness * (np.array(self.anchor) - p) - self.damping * rate
        size = math.hypot(*pull)
        x, z = (pull * min(1.0, self.most / size) if size > 0.0 else pull).tolist()
        return x, z


@dataclass(frozen=True)
class LinkPoints:
    """Points of the links of one robot in closed form, each made once."""

    biped: Biped
    made: dict[tuple[str, tuple[float, float]], LinkPoint] = field(default_factory=dict, repr=False)

    def of(self, link: str, at: tuple[float, float]) -> LinkPoint:
        """The point `at` [m] of a link. Raises ModelError for a link that the robot has not."""
        if (link, at) not in self.made:
            if len(self.made) >= MOST_POINTS:
                self.made.clear()
            self.made[link, at] = link_point(self.biped, link, at)
        return self.made[link, at]

    def place(self, link: str, at: tuple[float, float], q: Array, v: Array) -> tuple[Array, Array]:
        """p (2,) [m] from the stance foot and p' (2,) [m/s], at q (n,) [rad], v (n,) [rad/s]."""
        k = self.of(link, at)
        t = turned(k, q)
        return np.array(point(t, k.re, k.im)), jacobian(k, t, k.re, k.im) @ v

    def load(self, hand: Hand, q: Array) -> Load:
        """zeta (n,) [N m] and the resultant (2,) [N] of a hand at q (n,) [rad]."""
        wrench = np.array((*hand.force, 0.0))
        zeta = np.array(hand.torque) + wrench_torque(self.of(hand.link, hand.at), q, wrench)
        return Load(zeta, wrench[:2])


def check_hand(hand: Hand, n: int) -> None:
    """Raise InputError for numbers that are not finite, too large, or of another robot than one of n
    coordinates.
    """
    if len(hand.torque) != n:
        raise InputError(f"the hand has {len(hand.torque)} torques, expected {n}, one a coordinate")
    check_point(hand.at)
    if not all(map(math.isfinite, (*hand.torque, *hand.force))):
        raise InputError(f"the hand is {hand}, expected finite numbers")
    if (torque := max(map(abs, hand.torque), default=0.0)) > MOST_TORQUE:
        raise InputError(
            f"the torque of the hand is {torque:g} N m, expected at most {MOST_TORQUE:g}"
        )
    if (force := math.hypot(*hand.force)) > MOST_FORCE * (1.0 + 1e-9):
        raise InputError(f"the force of the hand is {force:g} N, expected at most {MOST_FORCE:g}")


def check_point(at: tuple[float, float]) -> None:
    """Raise InputError for a point (x, z) [m] of a link that is not finite, or beyond REACH."""
    if not math.hypot(*at) <= REACH:
        raise InputError(
            f"the point of the link is at {at} m in its frame, expected two numbers within {REACH:g} m"
        )
