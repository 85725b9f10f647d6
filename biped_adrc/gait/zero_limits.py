"""How fast and how slow the zero dynamics may run before the ground or the motors say no.

On the constraint the ground reaction and the torques are affine in Theta'^2, hence in zeta = sigma-^2 / 2
before the last impact:

    F(Theta) = F_0 + F_1 Theta'^2,   Theta'^2 = 2 (delta^2 zeta - V_zero(Theta)) / I^2

so each of  F_N > 0,  mu F_N -+ F_T > 0,  u_max -+ u_i > 0  reads  A(Theta) + B(Theta) zeta > 0, and all
Theta together leave an interval of zeta. rho is increasing, so a walk that starts inside an interval
around zeta* stays inside it: the interval is a domain of attraction that the ground and the motors allow.
The unilateral contact is what Westervelt, Grizzle, Koditschek (IEEE TAC 48(1), 2003) ask of an orbit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from biped_adrc.errors import InputError
from biped_adrc.gait.zero_orbits import ZeroOrbits, grid, series
from biped_adrc.ground import ground_axes
from biped_adrc.types import Array

LIFT_OFF, FRICTION, TORQUE = "lift-off", "friction", "torque"
PASSING = "V_max"
"""The step has to pass the highest point of V_zero."""
UNLIMITED = "no limit"


@dataclass(frozen=True)
class Limits:
    """friction: mu, largest |F_T| / F_N. torque: largest |u_i| [N m]; None leaves a limit out.

    slope [rad]: of the ground, positive downhill.
    """

    friction: float | None = None
    torque: float | None = None
    slope: float = 0.0

    def __post_init__(self) -> None:
        for name in ("friction", "torque"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise InputError(f"limit of {name} is {value}, expected a positive number or None")
        if not abs(self.slope) < 0.5 * math.pi:
            raise InputError(f"the slope is {self.slope} rad, expected less than a right angle")


class Bound(NamedTuple):
    """One end of the domain."""

    zeta: float
    """[kg^2 m^4/s^2]."""
    cause: str
    """"V_max", "lift-off", "friction", "torque", or "no limit"."""
    theta: float
    """Where it happens first [rad]; NaN without limit."""


class Domain(NamedTuple):
    """The interval lower.zeta < zeta < upper.zeta."""

    lower: Bound
    upper: Bound

    @property
    def empty(self) -> bool:
        """Whether no speed keeps all limits."""
        return not self.lower.zeta < self.upper.zeta

    def holds(self, zeta: float) -> bool:
        """Whether zeta is inside."""
        return self.lower.zeta < zeta < self.upper.zeta


def domain(orbits: ZeroOrbits, limits: Limits | None = None) -> Domain:
    """The zeta whose next step is finished and keeps the limits; without limits, F_N > 0 still holds.

    It contains zeta* when the periodic orbit keeps them, and is then a domain of attraction.
    """
    lower = Bound(orbits.lowest, PASSING, orbits.theta_max)
    upper = Bound(math.inf, UNLIMITED, math.nan)
    for margin in _margins(orbits, Limits() if limits is None else limits):
        lower = max(lower, _end(orbits, margin, 1.0), key=lambda bound: bound.zeta)
        upper = min(upper, _end(orbits, margin, -1.0), key=lambda bound: bound.zeta)
    return Domain(lower, upper)


class Margin(NamedTuple):
    """still + moving Theta'^2 > 0 is asked for; values (K,) at the Gauss nodes."""

    cause: str
    still: Array
    moving: Array


def _margins(orbits: ZeroOrbits, limits: Limits) -> list[Margin]:
    zero = orbits.zero
    rest, moving = ([zero.dynamics(k, rate) for k in range(len(zero.theta))] for rate in (0.0, 1.0))
    u_0, u_1 = (np.array([found[1] for found in rows]) for rows in (rest, moving))
    F_0, F_1 = (np.array([found[2] for found in rows]) for rows in (rest, moving))
    along, across = ground_axes(limits.slope)
    rows = [(LIFT_OFF, across)]
    if limits.friction is not None:
        rows += [(FRICTION, limits.friction * across + sign * along) for sign in (-1.0, 1.0)]
    found = [Margin(cause, F_0 @ row, (F_1 - F_0) @ row) for cause, row in rows]
    if limits.torque is not None:
        for j in range(zero.biped.p):
            for sign in (-1.0, 1.0):
                still = limits.torque + sign * u_0[:, j]
                found.append(Margin(TORQUE, still, sign * (u_1 - u_0)[:, j]))
    return found


def _end(orbits: ZeroOrbits, margin: Margin, sign: float) -> Bound:
    """The lower (sign 1) or upper (sign -1) end that one margin leaves: the extreme of -A / B over Theta."""
    still, moving = series(orbits.zero, margin.still), series(orbits.zero, margin.moving)

    def reach(theta: Array) -> Array:
        """sign * zeta of the crossing; -inf where this end is not limited, inf where nothing helps."""
        gain = 2.0 * moving(theta) / orbits.inertia(theta) ** 2
        A, B = still(theta) - gain * orbits.potential(theta), sign * orbits.delta**2 * gain
        crossing = -A / np.where(B > 0, B, 1.0)
        return np.where(B > 0, crossing, np.where((B == 0) & (A <= 0), math.inf, -math.inf))

    theta = grid(orbits.zero)
    found = reach(theta)
    k = int(np.argmax(found))
    near = slice(max(k - 1, 0), k + 2)
    where, most = float(theta[k]), float(found[k])
    if np.all(np.isfinite(found[near])):
        ends = sorted((theta[near][0], theta[near][-1]))
        best = minimize_scalar(
            lambda x: -float(reach(x)), bounds=ends, method="bounded", options={"xatol": 1e-12}
        )
        if -best.fun > most:
            where, most = float(best.x), -float(best.fun)
    return Bound(sign * most, margin.cause, where)
