"""Design of a family, which has a gait for every speed and step length within a range.

It is made of a library and three fits.

    library    one gait for each pair of speed and step length, by `optimise`, with limits that leave a reserve,
               and for rough ground where that is asked for
    curves     coefficients and Theta of the library as polynomials of degree 4 in (v, L)
    steps      2 W, J and delta^2 of random steps of the family, by quadrature, as polynomials of degree 4,
               and sigma^2 of the periodic walks by their mean speed, of degree 6
    ends       least and largest speed of the member on which a step may end, of degree 4 in (v, L)

    v, L           speed [m/s] and step length [m]; a member of the family is the gait of one pair (v, L)
    Theta          phase of a gait, Theta = c q [rad]; Theta+ where a step begins, Theta- where it ends
    h(Theta)       the angles q_b (p,) [rad] of the joints with motors; the pitch q_N has no motor
    sigma          angular momentum about the stance foot [kg m^2/s]
    delta          sigma after an impact over sigma before it; delta^2 is the multiplier of a periodic gait
    I              sigma / Theta' on the curve [kg m^2]; G_N gravity's torque on the pitch [N m]
    W, J           int -G_N I dTheta, the work of gravity on sigma^2 / 2, and int I dTheta

A step goes from the member that ended the step before to another one, which is chosen during the step, at its
share DECISION in Theta (`control.footstep`). Integrals over Theta take the place of its simulation.
"""

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from biped_adrc.control.footstep import StepCurve, step_reset
from biped_adrc.core.errors import GaitError
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.design.optimise import optimise
from biped_adrc.gait.design.request import GaitRequest, StepLimits
from biped_adrc.gait.family import DECISION, GaitFamily, PolynomialMap, StepMap
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics, configuration
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import KnownLimits, Limits

RESERVE = StepLimits(friction=0.5, impulse_friction=0.5, torque=130.0, clearance=0.08, lift_off=0.5)
"""Limits of the library. A step between two members asks for more friction and torque than the members do."""
STEEPEST = 0.08
"""Largest H of a gait of the library as a share of its step length [1]."""
CURVE_DEGREE, STEP_DEGREE, CYCLE_DEGREE = 4, 4, 6
"""Degrees of the polynomials."""
OF_LIBRARY = ("method", "curves", "minimised", "limits")
"""Entries of a gait's provenance that are the same for all gaits of the library."""
_SAMPLES, _GRID = 1200, 11
"""Random steps, and speeds and lengths of periodic walks, to which `StepMap` is fitted; both count the same."""
_NODES = 16
"""Number of Gauss nodes of each part of a step, before and after the decision (`control.footstep`)."""
_HALVED = 8
"""How often the range of speeds is halved in which a step may end."""
_SHARES = (0.5, 0.9)
"""Shares of the way [1] from v to the least and to the largest speed that ground and motors bear on level
ground without a tracking error. With 1 in place of 0.5, 18 of 300 walks on ground of 43 mm behind encoders
fail, in place of 5; with 1 in place of 0.9 the foot slips in one of 400 random schedules of speeds."""


def library(
    biped: Biped,
    speeds: Sequence[float],
    lengths: Sequence[float],
    limits: StepLimits = RESERVE,
    done: Callable[[str], None] = lambda text: None,
) -> list[tuple[float, float, Gait]]:
    """Speed [m/s], step length [m] and the gait of least torque, for each pair that has one.

    The pairs are all of a speed in `speeds` [m/s] and a length in `lengths` [m]. done: is called after each
    pair with a line of text about it. Raises GaitError where fewer pairs have a gait than the fit needs.
    """
    # least: number of coefficients of a polynomial in two variables of this degree
    # CURVE_DEGREE, of the polynomials in speed and step length
    least, gaits = (CURVE_DEGREE + 1) * (CURVE_DEGREE + 2) // 2, []
    if min(len(set(speeds)), len(set(lengths))) <= CURVE_DEGREE:
        raise GaitError(
            f"the family has {len(set(speeds))} speeds and {len(set(lengths))} lengths, expected at least "
            f"{CURVE_DEGREE + 1} of both"
        )
    for v, L in itertools.product(speeds, lengths):
        try:
            gait, H = _in_library(biped, v, L, limits)
        except GaitError as error:
            done(f"{v:g} m/s, {L:g} m: none, {error}")
            continue
        gaits.append((v, L, gait))
        borne = f", rough ground of {1e3 * H:.3g} mm" if limits.rough else ""
        done(f"{v:g} m/s, {L:g} m: {gait.period:.3f} s{borne}")
    if len(gaits) < least:
        raise GaitError(
            f"{len(gaits)} of {len(speeds)} x {len(lengths)} pairs of speed and step length have a gait; "
            f"a family needs at least {least}"
        )
    return gaits


def _in_library(biped: Biped, v: float, L: float, limits: StepLimits) -> tuple[Gait, float]:
    """The gait of the library for v [m/s] and L [m], and H [m] of the rough ground that it was designed for:
    that of the limits, or STEEPEST times L if that is less; 0 where no gait bears it.
    """
    H = min(limits.rough, STEEPEST * L)
    if H:
        with suppress(GaitError):
            found = optimise(biped, GaitRequest(v, L, limits=replace(limits, rough=H)))
            if found.height >= H:
                return found.gait, H
    return optimise(biped, GaitRequest(v, L, limits=replace(limits, rough=0.0))).gait, 0.0


def design_family(
    name: str,
    biped: Biped,
    gaits: Sequence[tuple[float, float, Gait]],
    provenance: Mapping[str, object],
    seed: int = 0,
) -> GaitFamily:
    """The family fitted to a library of gaits, (v, L, gait) as `library` returns them.

    name: of the family. provenance: how the library was made, beside what its gaits say. seed: of the random
    steps. Raises GaitError where a member that was designed has no periodic walk in the family.
    """
    # a row of y: all coefficients of the curve, Theta+, Theta-
    mu, first = np.array([(v, L) for v, L, _ in gaits]), gaits[0][2].provenance
    constraints = [gait.constraint for _, _, gait in gaits]
    y = [(*c.curve.coefficients.ravel(), c.theta_plus, c.theta_minus) for c in constraints]
    curves = PolynomialMap.fit(mu, np.array(y), CURVE_DEGREE)
    # a placeholder: the functions below need the family's curves alone, and give its real `steps`
    empty = PolynomialMap(((0,),), np.zeros((1, 1)), np.zeros(1), np.ones(1))
    family = GaitFamily(
        name,
        biped.description.name,
        biped.preset,
        curves,
        StepMap(empty, empty, empty, empty),
        constraints[0].phase,
        mu.min(axis=0),
        mu.max(axis=0),
        # OF_LIBRARY: entries that are the same for all gaits
        provenance={**{k: first[k] for k in OF_LIBRARY}, **provenance},
    )
    # _member: v and L with the friction, peak torque and least F_N of the periodic step
    members = tuple(_member(biped, v, L, family.member(v, L)) for v, L, _ in gaits)
    random, low, high = np.random.default_rng(seed), family.low, family.high
    # a row of `pairs` is a random pair of steps, as `TwoSteps.of` takes it: speed v and length L of the
    # member at the impact between them, length `before` of the step before both, speed `end` and length
    # `ahead` of the member that ends the second step; low and high are ends of the ranges (speed, length)
    # _SAMPLES random steps, and those of the periodic walks, which decide on the speed that is held
    grid = itertools.product(*(np.linspace(*ends, _GRID) for ends in zip(low, high, strict=True)))
    cycles = [cycle for v, L in grid if (cycle := _cycle(biped, family, v, L))]
    periodic = np.array([(v, L, L, v, L) for v, L, *_ in cycles])
    pairs = random.uniform((*low, low[1], *low), (*high, high[1], *high), (_SAMPLES, 5))
    pairs = np.concatenate((pairs, np.repeat(periodic, 1 + _SAMPLES // len(periodic), axis=0)))
    steps = np.array([TwoSteps.of(biped, family, x).numbers() for x in pairs])
    v, before, L, end, ahead = pairs.T
    # columns of steps: delta^2 of the impact, 2 W', J' from it to the second step's decision, dq_b/dTheta after
    # it; the last two are 2 W, J from that decision to the second step's own impact
    to_impact = PolynomialMap.fit(np.column_stack((v, end, L, ahead)), steps[:, -2:], STEP_DEGREE)
    earlier = np.column_stack((v, before, L, ahead))
    to_decision = PolynomialMap.fit(earlier, steps[:, :-2], STEP_DEGREE)
    _, L, speed, y = np.transpose(cycles)
    of_cycle = PolynomialMap.fit(np.column_stack((speed, L)), y[:, np.newaxis], CYCLE_DEGREE)
    step_map = StepMap(to_impact, to_decision, of_cycle, step_ends(biped, family, cycles))
    return replace(family, steps=step_map, members=members)


def _cycle(biped: Biped, family: GaitFamily, v: float, L: float) -> tuple[float, ...]:
    """v, L, mean speed [m/s], and sigma^2 at the decision of the periodic walk on the member; () for none."""
    delta2, twice_W_next, *_, twice_W, _ = TwoSteps.of(biped, family, (v, L, L, v, L)).numbers()
    try:
        period = ZeroDynamics.of(biped, family.member(v, L)).cycle.period
    except GaitError:
        return ()
    return v, L, L / period, (delta2 * twice_W + twice_W_next) / (1.0 - delta2)


@dataclass(frozen=True)
class TwoSteps:
    """Two steps in a row of a family, the second one with the two parts of its curve.

    The first step is L [m] long, follows one of length `before` [m], and ends on the member (v [m/s], L). The
    second one begins with dq_b/dTheta just after that impact, on the member (v, ahead [m]), and ends on the
    member (end [m/s], ahead).
    """

    delta2: float
    """delta^2 of the impact between the steps."""
    slope: Array
    """dq_b/dTheta (p,) just after that impact."""
    first: ZeroDynamics
    """The second step from its start to its decision."""
    last: ZeroDynamics
    """The second step from there to its end."""

    @classmethod
    def of(cls, biped: Biped, family: GaitFamily, pair: Sequence[float]) -> Self:
        """Compute both; pair (5,): v [m/s], before [m], L [m], end [m/s], ahead [m], as the class has them."""
        v, before, L, end, ahead = pair
        c, p, mu = family.phase, biped.p, np.array((v, L))
        # plus, minus: Theta at the start and end of the first step; the step before it ended on `earlier`.
        # configuration(..)[:2] are q and dq/dTheta on a curve; `relabel` exchanges stance and swing leg in q
        earlier = family.member(v, before)
        plus = float(c @ biped.relabel(configuration(c, earlier.h, earlier.theta_minus)[0]))
        # curve()[2] is Theta-, h(mu, Theta+, Theta) the member's curve in a step that begins at Theta+
        minus = family.curve(mu)[2]
        q, dq, _ = configuration(c, lambda theta: family.h(mu, plus, theta), minus)
        # q' at |Theta'| = 1 rad/s, in the sense in which Theta runs; delta does not depend on the speed
        v_minus = np.sign(minus - plus) * dq
        impact = biped.impact(q, v_minus)
        delta = biped.angular_momentum(impact.q, impact.v) / biped.angular_momentum(q, v_minus)
        # the second step: it begins at Theta = start with `slope`, `reset` blends that into the curve
        start = float(c @ impact.q)
        slope = impact.v[:p] / float(c @ impact.v)
        reset = step_reset(family, np.array((v, ahead)), start, impact.q[:p], slope)
        curve = StepCurve(family, v, end, ahead, start, reset)
        decision = start + DECISION * (family.curve(np.array((v, ahead)))[2] - start)
        over = family.curve(np.array((end, ahead)))[2]
        ends = (start, decision), (decision, over)  # Theta at the start and end of each part
        parts = (VirtualConstraint(earlier.curve, c, *plus_minus) for plus_minus in ends)
        first, last = (ZeroDynamics.of(biped, part, _NODES, curve) for part in parts)
        return cls(delta**2, slope, first, last)

    def numbers(self) -> Array:
        """delta^2, 2 W', J', dq_b/dTheta (p,), 2 W, J, together (p + 5,), with ' from the second step's start
        to its decision, without from there to its end.
        """
        (W, J), (W_first, J_first) = (
            (2.0 * z.work, z.weights @ z.inertia) for z in (self.last, self.first)
        )
        return np.array((self.delta2, W_first, J_first, *self.slope, W, J))

    def keeps(self, y: float, limits: KnownLimits) -> bool:
        """Whether the second step keeps the limits of friction and torque from its decision on, where sigma^2
        is y [kg^2 m^4/s^2].
        """
        span = self.last.constraint.theta_minus - self.last.constraint.theta_plus
        try:
            # sigma has the sign of I Theta'
            orbit = self.last.orbit(math.copysign(math.sqrt(y), span * self.last.inertia[0]))
        except GaitError:  # it stops
            return False
        F_T, F_N = orbit.ground_reaction.T
        grip = np.all(np.abs(F_T) <= limits.friction * F_N)
        return bool(grip and np.max(np.abs(orbit.u)) <= limits.torque)


def step_ends(
    biped: Biped, family: GaitFamily, cycles: Sequence[tuple[float, ...]]
) -> PolynomialMap:
    """`StepMap.ends`, fitted to the periodic walks `cycles`: at each of them it lies between the speeds that
    are _SHARES of the way from v to the extreme ones (`_extreme`).
    """
    found = []
    for v, L, _, y in cycles:
        ends = (_extreme(biped, family, v, L, y, far) for far in (family.low[0], family.high[0]))
        found.append((v, L, *(v + s * (end - v) for s, end in zip(_SHARES, ends, strict=True))))
    mu, signs = np.array(found)[:, :2], np.array((1.0, -1.0))
    inside = PolynomialMap.above(mu, signs * np.array(found)[:, 2:], STEP_DEGREE)
    return replace(inside, coefficients=signs * inside.coefficients)


def _extreme(biped: Biped, family: GaitFamily, v: float, L: float, y: float, far: float) -> float:
    """The speed [m/s] nearest to `far` of a member on which a step that begins on the member v [m/s] may end,
    within the robot's limits, between periodic steps of length L [m].

    y: sigma^2 at its decision [kg^2 m^4/s^2]. It is found by bisection between v and `far`, and is v where that
    itself misses a limit.
    """
    limits, near, end = Limits().of(biped.description), v, far
    for _ in range(_HALVED):
        if TwoSteps.of(biped, family, (v, L, L, end, L)).keeps(y, limits):
            near = end
        else:
            far = end
        end = 0.5 * (near + far)
    return near


def _member(biped: Biped, v: float, L: float, h: VirtualConstraint) -> tuple[float, ...]:
    """(v, L, friction, peak torque [N m], least F_N [N]) of the periodic step of the member (v, L).

    h: the member's constraint.
    """
    orbit = ZeroDynamics.of(biped, h).cycle
    # at the nodes of the orbit, on level ground
    F_T, F_N = orbit.ground_reaction.T
    numbers = np.max(np.abs(F_T) / F_N), np.max(np.abs(orbit.u)), np.min(F_N)
    return (v, L, *(round(float(x), 3) for x in numbers))
