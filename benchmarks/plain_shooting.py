"""A gait by plain single shooting: the designer's problem simulated in time, without its derivatives.

Unknowns: q-, dq_b/dTheta before impact, the inner Bezier coefficients, |Theta'-|, and the duration T. The
impact gives the first two coefficients of each joint, so that the constraint is hybrid-invariant. On it

    Theta'' = -(Omega_N + D_N d2q/dTheta2 Theta'^2) / (D_N dq/dTheta)

is integrated by `solve_ivp` from the impact to T (Westervelt, Grizzle, Koditschek, IEEE TAC 48(1), 2003).
Theta(T) = Theta-, |Theta'(T)| = |Theta'-|, the foot on level ground, and the speed are equations; the limits
are kept at Gauss nodes of [0, T] and at its ends; int u'u dt / L is a sum over these nodes. SLSQP takes
finite differences. T is an unknown, for at the cold start the robot falls back and no event ends the step.
"""

from __future__ import annotations

import time
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize

from biped_adrc.errors import BipedError, GaitError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Bezier
from biped_adrc.gait.design.nlp import SHORTEST
from biped_adrc.gait.design.optimise import FASTEST, SLOWEST, WINDING
from biped_adrc.gait.design.request import GaitRequest
from biped_adrc.gait.design.start import LONGEST, cold_start
from biped_adrc.gait.zero_dynamics import configuration, gauss_nodes
from biped_adrc.model.biped import Biped
from biped_adrc.model.contact import Impact
from biped_adrc.model.planar import PlanarTree
from biped_adrc.types import Array

RTOL, ATOL, STEP, FTOL = 1e-8, 1e-10, 1e-6, 1e-6  # STEP of the finite differences
LOST, LOST_OBJECTIVE = 10.0, 1e8  # rows and objective of a simulation that does not get to T


class Shot(NamedTuple):
    """One simulated step: objective [N^2 m s], the same scaled, equations = 0, limits >= 0."""

    objective: float
    cost: float
    equations: Array
    limits: Array

    @property
    def violation(self) -> float:
        """By how much the worst row is missed."""
        return float(max(np.max(np.abs(self.equations)), -np.min(self.limits)))


class Shooting(NamedTuple):
    """What SLSQP ends with; `message` is empty when it converged, else `shot` missed its rows least."""

    message: str
    iterations: int
    simulations: int
    shot: Shot


class Curve(NamedTuple):
    """What the unknowns make; the impact is at Theta' = 1."""

    constraint: VirtualConstraint
    dq: Array
    impact: Impact


class Problem:
    """The step as a function of SLSQP's unknowns x."""

    def __init__(self, biped: Biped, speed: float) -> None:
        request = GaitRequest(speed)
        self.biped, self.speed, self.lim = biped, speed, request.limits.of(biped)
        self.s, self.weights, _ = gauss_nodes(request.nodes)
        self.leg = float(np.abs(PlanarTree.of(biped).hip).sum())
        self.froude = float(np.sqrt(biped.description.gravity * self.leg))
        self.unit = self.lim.torque**2 / self.froude
        self.direction, guess = cold_start(biped, request, self.lim)
        T = abs(guess["theta"][1] - guess["theta"][0]) / guess["rate"]
        line = guess["alpha"][:, 2:-2].ravel()
        self.x0 = np.concatenate((guess["q"], guess["slope"], line, (guess["rate"], T)))
        free = [(None, None)] * (biped.n + biped.p)
        self.bounds = [*free, *((y - WINDING, y + WINDING) for y in line)]
        self.bounds += [(SLOWEST, FASTEST), (0.2 * T, 5.0 * T)]
        some = np.ones((len(self.s) + 2, 2))
        rows = len(self.rows(self.x0, self.curve(self.x0), some).limits)
        self.lost = Shot(
            LOST_OBJECTIVE, LOST_OBJECTIVE / self.unit, np.full(4, LOST), np.full(rows, -LOST)
        )

    def curve(self, x: Array) -> Curve:
        """The hybrid-invariant constraint of x."""
        b, n, p = self.biped, self.biped.n, self.biped.p
        q, slope, inner = x[:n], x[n : n + p], x[n + p : -2].reshape(p, -1)
        dq = np.append(slope, (1.0 - b.phase[:p] @ slope) / b.phase[p])
        impact = b.impact(q, dq)
        begin, end = float(b.phase @ impact.q), float(b.phase @ q)
        reach, first, last = (end - begin) / (inner.shape[1] + 3), impact.q[:p], q[:p]
        second = first + impact.v[:p] / float(b.phase @ impact.v) * reach
        alpha = np.column_stack((first, second, inner, last - slope * reach, last))
        constraint = VirtualConstraint(Bezier(alpha), b.phase, begin, end)
        return Curve(constraint, dq, impact)

    def forward(self, c: VirtualConstraint, theta: float, rate: float) -> tuple[Array, ...]:
        """q, q', q'', u on the constraint."""
        q, dq, ddq = configuration(c, theta)
        v, bend = dq * rate, ddq * rate**2
        D, Omega = self.biped.inertia(q), self.biped.bias(q, v)
        a = bend - dq * (Omega[-1] + D[-1] @ bend) / (D[-1] @ dq)
        return q, v, a, (D @ a + Omega)[: self.biped.p]

    def simulate(self, x: Array, k: Curve) -> Array:
        """(Theta, Theta') at 0, the nodes, and T, (K + 2, 2). Raises GaitError when it gets lost."""
        c, phase, T = k.constraint, self.biped.phase, x[-1]

        def flow(t: float, y: Array) -> tuple[float, float]:
            return y[1], float(phase @ self.forward(c, y[0], y[1])[2])

        def away(t: float, y: Array) -> float:
            return float(min(FASTEST - abs(y[1]), 1.0 - abs(y[0] - c.theta_minus)))

        away.terminal = True  # type: ignore[attr-defined]
        start = (c.theta_plus, self.direction * x[-2] * float(phase @ k.impact.v))
        t = T * np.concatenate(([0.0], self.s, [1.0]))
        made = solve_ivp(flow, (0.0, T), start, "DOP853", t, events=away, rtol=RTOL, atol=ATOL)
        if made.status != 0:
            raise GaitError("the step does not get to its end")
        return np.asarray(made.y.T)

    def shot(self, x: Array) -> Shot:
        """The step of x; `lost` where there is none."""
        try:
            with np.errstate(divide="raise", over="raise", invalid="raise"):
                k = self.curve(x)
                return self.rows(x, k, self.simulate(x, k))
        except (BipedError, ArithmeticError, np.linalg.LinAlgError):
            return self.lost

    def rows(self, x: Array, k: Curve, states: Array) -> Shot:
        """The rows of the designer, at the simulated states."""
        c, b, lim = k.constraint, self.biped, self.lim
        q, v, a, u = map(np.array, zip(*(self.forward(c, *y) for y in states), strict=True))
        F_T, F_N = np.array([b.ground_reaction(*y) for y in zip(q, v, a, strict=True)]).T / b.weight
        length, foot = b.swing_foot(x[: b.n])
        objective = float(x[-1] * self.weights @ np.sum(u[1:-1] ** 2, axis=1) / length)
        ends = states[-1, 0] - c.theta_minus, abs(states[-1, 1]) / x[-2] - 1.0
        equations = np.array([foot / self.leg, *ends, length / x[-1] / self.speed - 1.0])
        kept, load = 1.0 - lim.reserve, u.ravel() / lim.torque
        limits = [F_N - lim.normal_force, kept - load, kept + load, self.impact_rows(x, k)]
        limits += [kept * lim.friction * F_N + sign * F_T for sign in (-1.0, 1.0)]
        s = (states[1:-1, 0] - c.theta_plus) / (c.theta_minus - c.theta_plus)
        height = np.array([b.swing_foot(y)[1] for y in q[1:-1]]) / self.leg
        limits.append(height - (lim.clearance or 0.0) * 16.0 * (s * (1.0 - s)) ** 2)
        for joint, (low, high) in lim.ranges.items():
            angle = q[1:-1, b.description.joint_index(joint)]
            limits += [angle - low, high - angle]
        return Shot(objective, objective / self.unit, equations, np.concatenate(limits))

    def impact_rows(self, x: Array, k: Curve) -> Array:
        """Length of the step, impulse, feet, phase and delta^2."""
        b, lim, rate = self.biped, self.lim, self.direction * x[-2]
        P_T, P_N = rate * k.impact.impulse / (b.mass * self.froude)
        foot, old = b.swing_foot_velocity(x[: b.n], k.dq)[1], k.impact.old_foot_velocity[1]
        delta = b.angular_momentum(*k.impact[:2]) / b.angular_momentum(x[: b.n], k.dq)
        span = self.direction * (k.constraint.theta_minus - k.constraint.theta_plus)
        feet = (np.array([-foot, old]) * rate - lim.lift_off) / self.froude
        step, turn = b.swing_foot(x[: b.n])[0] / self.leg, b.phase @ k.impact.v
        rows = [step - SHORTEST, LONGEST - step, P_N, span - 0.05, turn - 0.02]
        mu = (1.0 - lim.reserve) * lim.impulse_friction
        return np.array([*rows, *feet, lim.multiplier - delta**2, mu * P_N - P_T, mu * P_N + P_T])


def shoot(biped: Biped, speed: float, limit: float) -> Shooting:
    """SLSQP from the designer's cold start, for at most `limit` seconds of wall time."""
    begin, problem = time.perf_counter(), Problem(biped, speed)
    shots: dict[bytes, Shot] = {}

    def at(x: Array) -> Shot:
        if (key := x.tobytes()) not in shots:
            if time.perf_counter() - begin > limit:
                raise TimeoutError
            shots[key] = problem.shot(x)
        return shots[key]

    steps: list[Array] = []
    rows = (("eq", lambda x: at(x).equations), ("ineq", lambda x: at(x).limits))
    both = [{"type": kind, "fun": row} for kind, row in rows]
    given = {"bounds": problem.bounds, "callback": steps.append, "constraints": both}
    options = {"eps": STEP, "ftol": FTOL, "maxiter": 1000}
    try:
        found = minimize(lambda x: at(x).cost, problem.x0, method="SLSQP", options=options, **given)
        message = "" if found.success else str(found.message)
    except TimeoutError:
        message = f"stopped after {limit:g} s"
    least = min(shots.values(), key=lambda shot: shot.violation)
    return Shooting(message, len(steps), len(shots), least if message else at(found.x))
