"""Domain of attraction of a walking cycle on the zero dynamics: how slow and how fast the steps may be.

`zero_orbits.ZeroOrbits` describes a step by one number, zeta = sigma-^2 / 2 [kg^2 m^4/s^2], where sigma-
[kg m^2/s] is the angular momentum about the stance foot just before the impact that begins it. It gives:

    delta = sigma+ / sigma-       with sigma+ [kg m^2/s] about the new stance foot just after the impact
    I(Theta) = sigma / Theta'     inertia [kg m^2]
    V_zero(Theta), V_max          potential [kg^2 m^4/s^2] and its largest value in a step, at least 0
    rho, zeta* = rho(zeta*)       the return map, from zeta to that of the next step, and its fixed point

On the constraint each force of the ground and each torque, here F, is affine in Theta'^2, hence in zeta:

    F(Theta) = F_0(Theta) + F_1(Theta) Theta'^2,   Theta'^2 = 2 (delta^2 zeta - V_zero(Theta)) / I(Theta)^2

So each of F_N > 0, mu F_N -+ F_T > 0, u_max -+ u_i > 0 reads A(Theta) + B(Theta) zeta > 0, with the normal
and tangential force F_N and F_T [N], the friction mu [1], and the torques u_i and their limit u_max [N m]. All
Theta of a step together leave an interval of zeta. rho is increasing, so a walk that starts inside an interval
around zeta* stays inside it: the interval is a domain of attraction that the ground and the motors allow.
The unilateral contact is what Westervelt, Grizzle, Koditschek (IEEE TAC 48(1), 2003) ask of an orbit.

`domain` cuts the interval in which the next step is completed, zeta > V_max / delta^2, by these limits. Used by
`analysis.zero_report` and the command line.

    domain(orbits, DomainLimits(friction=0.6))     published gait: zeta from 82.3 (V_max) to 484.1 (friction)
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from biped_adrc.core.checks import Checked, PositiveFloat
from biped_adrc.core.types import Array
from biped_adrc.gait.zero_orbits import ZeroOrbits, grid, series
from biped_adrc.model.ground import Slope, ground_axes

PASSING = "V_max"
"""Name of the lower bound by the highest point of V_zero, which the step has to pass."""
UNLIMITED = "no limit"
"""Name of the upper bound where nothing limits zeta."""


@dataclass(frozen=True)
class DomainLimits(Checked):
    """Limits of ground and motors for `domain`; None for no such limit. F_N > 0 is always required.

    Raises InputError for a limit that is not positive or a slope of a right angle and more.
    """

    friction: PositiveFloat | None = None
    """mu, largest |F_T| / F_N."""
    torque: PositiveFloat | None = None
    """Largest |u_i| [N m]."""
    slope: Slope = 0.0
    """Slope of the ground [rad], positive downhill."""


class Bound(NamedTuple):
    """One end of the domain, and the limit that sets it."""

    zeta: float
    """zeta of the bound [kg^2 m^4/s^2]."""
    cause: str
    """"V_max", "lift-off", "friction", "torque", or "no limit"."""
    theta: float
    """Phase at which the limit is reached first [rad]; NaN without limit."""


class Domain(NamedTuple):
    """The interval lower.zeta < zeta < upper.zeta [kg^2 m^4/s^2] in which the next step keeps all limits."""

    lower: Bound
    upper: Bound

    @property
    def empty(self) -> bool:
        """Whether no zeta, and so no speed, keeps all limits."""
        return not self.lower.zeta < self.upper.zeta

    def holds(self, zeta: float) -> bool:
        """Whether zeta is inside, both ends excluded."""
        return self.lower.zeta < zeta < self.upper.zeta


def domain(orbits: ZeroOrbits, limits: DomainLimits | None = None) -> Domain:
    """The interval of zeta from which the next step is completed and keeps the limits; with None only F_N > 0.

    Each limit leaves an interval, and the domain is their intersection. It contains zeta* when the periodic
    orbit keeps the limits, and is then a domain of attraction.
    """
    # zeta is at least V_max / delta^2 (`orbits.lowest`), so that the step passes the highest point of V_zero
    # PASSING: the step has to pass the highest point of V_zero
    lower = Bound(orbits.lowest, PASSING, orbits.theta_max)
    upper = Bound(math.inf, UNLIMITED, math.nan)
    # sign 1: the lower bound of zeta by a limit, sign -1: the upper one; the strictest of all limits stay
    for margin in _margins(orbits, DomainLimits() if limits is None else limits):
        lower = max(lower, _end(orbits, margin, 1.0), key=lambda bound: bound.zeta)
        upper = min(upper, _end(orbits, margin, -1.0), key=lambda bound: bound.zeta)
    return Domain(lower, upper)


class Margin(NamedTuple):
    """One limit as the condition still + moving Theta'^2 > 0 on the distance to it, a force [N] or a torque
    [N m], at the K Gauss nodes of the zero dynamics.

    cause: name of the limit, as in `Bound.cause`. still: distance at rest (K,). moving: its change with
    Theta'^2 (K,), per rad^2/s^2.
    """

    cause: str
    still: Array
    moving: Array


def _margins(orbits: ZeroOrbits, limits: DomainLimits) -> list[Margin]:
    """All limits as margins, one for each sign where a limit has two.

    At one Theta forces and torques are affine in Theta'^2, so the model at two rates, 0 and 1 rad/s, gives them
    at all speeds.
    """
    zero = orbits.zero
    # at each node (q'', u, ground reaction); [1] is u (p,) [N m], [2] the reaction (2,) [N]
    rest, moving = ([zero.dynamics(k, rate) for k in range(len(zero.theta))] for rate in (0.0, 1.0))
    u_0, u_1 = (np.array([result[1] for result in rows]) for rows in (rest, moving))
    F_0, F_1 = (np.array([result[2] for result in rows]) for rows in (rest, moving))
    along, across = ground_axes(limits.slope)  # unit vectors along the ground and out of it
    # of each condition row @ F > 0 on the ground reaction F: its name and row
    rows = [("lift-off", across)]
    if limits.friction is not None:
        rows += [("friction", limits.friction * across + sign * along) for sign in (-1.0, 1.0)]
    result = [Margin(cause, F_0 @ row, (F_1 - F_0) @ row) for cause, row in rows]
    if limits.torque is not None:
        for j in range(zero.biped.p):
            for sign in (-1.0, 1.0):
                still = limits.torque + sign * u_0[:, j]
                result.append(Margin("torque", still, sign * (u_1 - u_0)[:, j]))
    return result


def _end(orbits: ZeroOrbits, margin: Margin, sign: float) -> Bound:
    """The lower (sign 1) or upper (sign -1) bound of zeta by one margin, still + moving Theta'^2 > 0: of all
    Theta of a step the strictest zeta = -A / B at which A + B zeta = 0.

    The bound is -inf (lower) or inf (upper) where the margin limits zeta nowhere from this side.
    """
    # as functions of Theta, by Legendre series through the values at the nodes
    still, moving = series(orbits.zero, margin.still), series(orbits.zero, margin.moving)

    def reach(theta: Array) -> Array:
        """sign * zeta at which the margin is 0, at each theta; -inf where the margin does not limit this end,
        inf where no zeta keeps it. The largest one is the strictest, for either sign.
        """
        # the margin is still + moving Theta'^2, in place of F_0 and F_1; moving Theta'^2 = gain (delta^2 zeta -
        # V_zero)
        gain = 2.0 * moving(theta) / orbits.inertia(theta) ** 2
        A, B = still(theta) - gain * orbits.potential(theta), sign * orbits.delta**2 * gain
        crossing = -A / np.where(B > 0, B, 1.0)
        return np.where(B > 0, crossing, np.where((B == 0) & (A <= 0), math.inf, -math.inf))

    theta = grid(orbits.zero)
    result = reach(theta)
    k = int(np.argmax(result))
    # the maximum is searched further between the neighbours on the grid
    near = slice(max(k - 1, 0), k + 2)
    where, most = float(theta[k]), float(result[k])
    if np.all(np.isfinite(result[near])):
        ends = sorted((theta[near][0], theta[near][-1]))
        best = minimize_scalar(
            lambda x: -float(reach(x)), bounds=ends, method="bounded", options={"xatol": 1e-12}
        )
        if -best.fun > most:
            where, most = float(best.x), -float(best.fun)
    return Bound(sign * most, margin.cause, where)
