"""A touchdown that is noticed by the swing foot: by where the measured angles say it is, or by its force.

    ByKinematics   z + tan(slope) x < height, and lower than at the tick before
    ByForce        free: F < off; then loaded: F > on, until F < off; noticed after debounce and delay

Both have a gate on the phase, which is told by how far the swing foot is ahead.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.hardware.touchdown import Look, Touchdown, check_finite, check_time
from biped_adrc.part import derived
from biped_adrc.shown import Shown
from biped_adrc.timing import SAME_INSTANT
from biped_adrc.types import Array


@dataclass(frozen=True)
class Gated(Shown, Touchdown):
    """Base of the leaves with a gate on the phase, which is told by how far the swing foot is ahead.

    ahead [m]: the controller's swing foot is more than that in front of its stance foot. after [s]: so long
    after the last notice no other comes. slope [rad]: of the ground as the controller takes it, positive
    downhill. Raises InputError for numbers that are not finite or a time that is negative.
    """

    ahead: float = 0.1
    """[m]"""
    after: float = 0.1
    """[s]"""
    slope: float = 0.0
    """[rad]"""

    def __post_init__(self) -> None:
        check_time(self.after, "after")
        for name in ("ahead", "slope"):
            check_finite(getattr(self, name), name)

    @derived
    def tangent(self) -> float:
        """tan(slope) [1]."""
        return math.tan(self.slope)

    def gate(self, look: Look) -> float:
        """1 where a touchdown may come: the swing foot is ahead and the last notice long ago; else 0."""
        ahead = 1.0 * (look.foot[0] > self.ahead)
        return ahead * (look.t_step >= self.after - SAME_INSTANT)


@dataclass(frozen=True)
class ByKinematics(Gated):
    """The swing foot, by the controller's model at the measured angles, comes below `height` [m].

    Above zero it is early, by height / speed of the foot but for a tick; a step of the ground, which no angle
    shows, makes it late or early too.
    """

    height: float = 0.0
    """[m]"""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_finite(self.height, "height")

    size = 1

    def notice(self, d: Array, look: Look) -> tuple[Array, float]:
        """d = (height before,) [m]: below the height, lower than at the tick before, and the gate open."""
        height = look.foot[1] + self.tangent * look.foot[0]
        low = 1.0 * (height < self.height) * (height < d[0])
        return np.array([height]), low * self.gate(look)


@dataclass(frozen=True)
class ByForce(Gated):
    """The controller's swing foot, free before (below `off`), carries more than `on`, and never below `off`
    for `debounce` seconds; noticed `delay` seconds later. A switch is one with its threshold and delay.

    Raises InputError unless 0 <= off <= on.
    """

    on: float = 50.0
    """[N]"""
    off: float = 20.0
    """[N]"""
    debounce: float = 0.0
    """[s]"""
    delay: float = 0.0
    """[s]"""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_time(self.debounce, "debounce")
        check_time(self.delay, "delay")
        if not (math.isfinite(self.on) and 0.0 <= self.off <= self.on):
            raise InputError(
                f"the touchdown's forces are off = {self.off} N and on = {self.on} N, expected 0 <= off <= on"
            )

    size = 5
    needs_force = True

    def notice(self, d: Array, look: Look) -> tuple[Array, float]:
        """d = (free, loaded, since, waits, due): a free foot is loaded for long enough, then the delay."""
        t = look.t
        free = np.maximum(d[0], 1.0 * (look.force < self.off))
        stays = d[1] * (look.force >= self.off)
        loaded = np.maximum(stays, 1.0 * (look.force > self.on) * free * self.gate(look))
        since = np.where(d[1] > 0.5, d[2], t)
        sure = loaded * (t - since >= self.debounce - SAME_INSTANT) * (1.0 - d[3])
        due = np.where(sure > 0.5, t + self.delay, d[4])
        waits = np.maximum(d[3], sure)
        fires = waits * (t >= due - SAME_INSTANT)
        left = 1.0 - fires
        return np.array([free * left, loaded * left, since, waits * left, due]), fires
