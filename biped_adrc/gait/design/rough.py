"""Steps over rough ground as CasADi expressions: limits of a walk whose footholds are up to H higher or lower.

`control.reference_reset` bends the curve after each impact, up to the phase MIDDLE. Then y = sigma^2 / 2 at
that phase goes from step to step by the map of `analysis.stride_map`, over a foothold that is higher by h:

    y+ = delta^2(h) (y + W_2(h)) + W_1(h),   y*(h) = (delta^2 W_2 + W_1) / (1 - delta^2)

    s_h      phase of the landing on h; past its end the curve is continued
    W_2      work of gravity on sigma^2 / 2 from MIDDLE to s_h
    W_1      the same from the start of the next step to MIDDLE, on the bent curve
    delta    sigma after the impact over sigma before it

The map rises in y, so on footholds between -H and H y stays between the least and the largest y*(h). Torques
and forces are affine in Theta'^2 = 2 (y_0 + W) / I^2, with y_0 at the start of W: `limits` has them as rows at
y*(0), y*(H) and y*(-H), in the steps over H and over -H. `analysis.rough_ground` judges the gait over all
heights.
"""

import itertools
from collections.abc import Iterator
from typing import NamedTuple

import casadi as ca
import numpy as np

from biped_adrc.gait.constraint import FADE
from biped_adrc.gait.design.step import Bounded, Node, SymbolicStep, node_function, split_rows
from biped_adrc.gait.zero_dynamics import gauss_nodes
from biped_adrc.model.planar_robot import robot_of

MIDDLE = 0.5
"""Phase s at which y is taken: the usual share of `ReferenceReset`, where its bend ends."""
HIGHEST = 0.1
"""Largest H as a share of the leg's length [1]."""


class Half(NamedTuple):
    """Half a step at K phases, from its start to its end."""

    still: Node
    """The model at Theta' = 0."""
    moving: Node
    """The same at |Theta'| = 1 rad/s."""
    W: ca.MX
    """Work of gravity on sigma^2 / 2 from the start to each phase (1, K) [kg^2 m^4/s^2]."""

    def squared_rate(self, y_0: ca.MX) -> ca.MX:
        """Theta'^2 (1, K) [rad^2/s^2], with y_0 = sigma^2 / 2 [kg^2 m^4/s^2] at the start."""
        return 2.0 * (y_0 + self.W) / self.still.inertia**2

    def at(self, name: str, y_0: ca.MX) -> ca.MX:
        """A field of `Node` with y_0 = sigma^2 / 2 [kg^2 m^4/s^2] at the start."""
        A, B = getattr(self.still, name), getattr(self.moving, name)
        return A + (B - A) * ca.repmat(self.squared_rate(y_0), A.shape[0], 1)


class RoughLanding(NamedTuple):
    """The second half of a step, its landing on one height, and the first half of the next step."""

    second: Half
    first: Half
    foot: ca.MX
    """Height of the swing foot at the landing [m]."""
    down: ca.MX
    """Its speed out of the ground before impact, at |Theta'| = 1 rad/s [m/s]."""
    impulse: ca.MX
    """(F_T, F_N) of the impact at |Theta'| = 1 rad/s (2,) [N s]."""
    delta2: ca.MX
    """delta^2 [1]."""
    start: ca.MX
    """Phase s at which the next step begins [1]."""

    @property
    def steady(self) -> ca.MX:
        """y*(h) [kg^2 m^4/s^2]."""
        return (self.delta2 * self.second.W[-1] + self.first.W[-1]) / (1.0 - self.delta2)

    def halves(self, y: ca.MX) -> tuple[tuple[Half, ca.MX], ...]:
        """Both halves, each with sigma^2 / 2 at its start, for y in the middle [kg^2 m^4/s^2]."""
        return (self.second, y), (self.first, self.delta2 * (y + self.second.W[-1]))


def basis_function(k: SymbolicStep) -> ca.Function:
    """Make the CasADi function s -> b, db/ds, d2b/ds2 (M + 3,): b of the M + 1 coefficients of the continued
    curve, and of the coefficients a_0, a_1 of the bend z^3 (a_0 + a_1 z), z = 1 - s / MIDDLE.

    Raises GaitError for a kind of curve of several pieces.
    """
    s, M = ca.SX.sym("s"), k.request.degree
    T = k.request.kind(np.eye(M + 1)).power_coefficients
    x, j = ca.fmin(ca.fmax(s, 0.0), 1.0), np.arange(T.shape[1])
    h, dh, ddh = (
        a @ ca.vertcat(*(x**i for i in range(a.shape[1])))
        for a in (T, T[:, 1:] * j[1:], T[:, 2:] * (j[2:] * j[1:-1]))
    )
    # past an end as `constraint.past_end`, with functions that CasADi differentiates
    y, left = s - x, ca.exp(-ca.fabs(s - x) / FADE)
    h = h + y * dh + FADE * (ca.fabs(y) - FADE * (1.0 - left)) * ddh
    dh = dh + ca.sign(y) * FADE * (1.0 - left) * ddh
    z, m = 1.0 - s / MIDDLE, -1.0 / MIDDLE
    rows = (
        ca.vertcat(h, z**3, z**4),
        ca.vertcat(dh, 3.0 * m * z**2, 4.0 * m * z**3),
        ca.vertcat(left * ddh, 6.0 * m**2 * z, 12.0 * m**2 * z**2),
    )
    return ca.Function("basis", [s], [*rows])


class RoughSteps:
    """Steps over the heights H and -H on the curve of a `SymbolicStep` k, and one over level ground.

    over: the two landings by name. level: y*(0) [kg^2 m^4/s^2]. They use H and s_h among the unknowns of k.
    """

    def __init__(self, k: SymbolicStep) -> None:
        self.k, self.basis = k, basis_function(k)
        M = k.request.degree + 2  # a_0, a_1 are two coefficients more
        alpha, theta, s = ca.SX.sym("a", k.p * (M + 1)), ca.SX.sym("t", 2), ca.SX.sym("s")
        node = node_function(robot_of(k.biped), k.biped.phase, M, k.direction)
        # coefficients of the curve and its bend (p (M + 1),), (Theta+, Theta-) and s -> the rows of `Node` at
        # Theta' = 0, and at |Theta'| = 1 rad/s; in one function, so that CasADi computes what they share once
        rows = [node(alpha, theta, s, *self.basis(s), rate) for rate in (0.0, 1.0)]
        self.function = ca.Function("curve", [alpha, theta, s], rows, {"cse": True})
        self.gauss = gauss_nodes(k.request.nodes // 2)
        self.straight = ca.MX.zeros(k.p, 2)
        H, up, down = ca.vertsplit(k.x.rough)
        # a step down goes on past the end of the curve, s = 1, where forces jump
        self.over = {"up": (H, self.landing(up)), "down": (-H, self.landing(1.0, down))}
        sigma_plus = k.sigma(k.q_plus, k.v_plus) * k.x.rate * k.sigma_scale
        self.level = 0.5 * sigma_plus**2 + self.half(self.straight, 0.0, MIDDLE).W[-1]

    def model(self, bend: ca.MX, s: ca.MX) -> tuple[Node, Node]:
        """The model at phases s (1, K) on the curve with a bend (p, 2) [rad], at Theta' = 0 and at |Theta'| = 1
        rad/s.
        """
        x, K = self.k.x, s.shape[1]
        columns = ca.repmat(ca.vec(ca.horzcat(x.alpha, bend)), 1, K), ca.repmat(x.theta, 1, K)
        still, moving = self.function.map(K)(*columns, s)
        return split_rows(still, self.k.n), split_rows(moving, self.k.n)

    def half(self, bend: ca.MX, *ends: ca.MX | float) -> Half:
        """Half a step over the phases `ends`: at each of them, and at Gauss nodes between."""
        nodes, w, C = self.gauss
        parts, W, done = list(itertools.pairwise(ends)), list[ca.MX](), ca.MX(0.0)
        s = ca.horzcat(*(a + (b - a) * ca.DM([0.0, *nodes, 1.0]).T for a, b in parts))
        still, moving = self.model(bend, s)
        drives = ca.horzsplit(-still.gravity * still.inertia * self.k.span, len(nodes) + 2)
        for (a, b), drive in zip(parts, drives, strict=True):
            inner = (b - a) * drive[1:-1]
            W += [done, done + inner @ C.T, done + inner @ w]
            done = W[-1]
        return Half(still, moving, ca.horzcat(*W))

    def landing(self, *ends: ca.MX | float) -> RoughLanding:
        """The landing at the last of the phases `ends`, with the halves before and after it."""
        k, n, p, x = self.k, self.k.n, self.k.p, self.k.x
        _, at = self.model(self.straight, ca.MX(ends[-1]))
        dq = k.slope(k.direction * at.v_b)
        D, J_m, J_2, foot = k.pose(at.q)
        # the impact (7), solved for the jumps of q' and of the old foot's velocity, and for the impulse
        one, zero = ca.DM.eye(2), ca.DM.zeros(2, 2)
        A = ca.blockcat([[D, J_m.T, -J_2.T], [J_m, k.mass * one, -one], [J_2, one, zero]])
        jump = ca.solve(A, ca.vertcat(ca.DM.zeros(n + 2), -J_2 @ dq))
        q, v = k.R @ at.q + k.r, k.R @ (dq + jump[:n])
        # the bend takes away the error and its slope where the step begins, as `control.reference_reset`, which
        # stands above this room
        start, rate = (k.phase @ q - x.theta[0]) / k.span, k.phase @ v
        (b, db, _), z = self.basis(start), 1.0 - start / MIDDLE
        e = (q[:p] - x.alpha @ b[:-2]) / z**3
        de = -MIDDLE * (v[:p] * k.span / rate - x.alpha @ db[:-2]) / z**2
        bend = ca.horzcat(4.0 * e - de, (de - 3.0 * e) / z)
        delta2 = (k.sigma(q, v) / k.sigma(at.q, dq)) ** 2
        second, first = self.half(self.straight, MIDDLE, *ends), self.half(bend, start, MIDDLE)
        impulse, down = k.direction * jump[n + 2 :], k.direction * (J_2 @ dq)[1]
        return RoughLanding(second, first, foot[1], down, impulse, delta2, start)

    def rows(self) -> Iterator[Bounded]:
        """Rows of the programme: the landings, and the limits of both steps at all y*."""
        k, limits, inf = self.k, self.k.limits, np.inf
        levels = (self.level, *(landing.steady for _, landing in self.over.values()))
        for way, (h, at) in self.over.items():
            F_T, F_N = ca.vertsplit(at.impulse / (k.mass * k.leg))
            mu = (1.0 - limits.reserve) * limits.impulse_friction
            # lengths over the leg, as all rows
            gap = (at.foot - h) / k.leg
            yield Bounded(f"the landing on a step {way}", gap, 0.0, 0.0, "of the leg")
            yield Bounded(f"the foot coming down on a step {way}", at.down / k.leg, -inf, 0.0)
            # a step that begins later than 0.8 of MIDDLE is not bent (`control.reference_reset`, LEAST_REACH)
            yield Bounded(f"the start after a step {way}", at.start, -inf, 0.8 * MIDDLE)
            yield Bounded(f"stability on steps {way}", at.delta2, -inf, limits.multiplier)
            yield Bounded(f"the impulse on a step {way}", F_N, 0.0, inf)
            if np.isfinite(mu):
                cone = ca.vertcat(mu * F_N - F_T, mu * F_N + F_T)
                yield Bounded(f"the impulse cone on a step {way}", cone, 0.0, inf)
            for half, y_0 in (pair for y in levels for pair in at.halves(y)):
                yield from self.limits(half, y_0)

    def limits(self, half: Half, y_0: ca.MX) -> Iterator[Bounded]:
        """The limits of half a step, with y_0 = sigma^2 / 2 [kg^2 m^4/s^2] at its start."""
        k, limits, inf = self.k, self.k.limits, np.inf
        squared, kept = half.squared_rate(y_0), 1.0 - limits.reserve
        F_T, F_N = ca.vertsplit(half.at("force", y_0) / k.biped.weight)
        cone = (kept * limits.friction * F_N + sign * F_T for sign in (1.0, -1.0))
        torque = half.at("u", y_0) / limits.torque
        # the share `reserve` of the usual speed and weight is kept for the phases between the nodes
        yield Bounded("stall on rough ground", squared / k.x.rate**2, limits.reserve, inf)
        yield Bounded("the normal force on rough ground", F_N, limits.reserve, inf, "of the weight")
        yield Bounded("friction on rough ground", ca.vertcat(*cone), 0.0, inf, "of the weight")
        yield Bounded("the torque on rough ground", torque, -kept, kept, "of the limit")
        for joint, rate in limits.rates.items():
            share = half.moving.v_b[k.biped.description.joint_index(joint), :] / rate
            yield Bounded("rates on rough ground", share**2 * squared, 0.0, kept**2)
