"""The first guess of the nonlinear programme, for any planar biped, from its geometry alone.

1. `standing`: legs stretched, every other link upwards. 2. `apart`: least squares moves the feet apart by the
step length, the hip half way between, joints inside their ranges. 3. `cold_start`: rates that lead evenly from
the relabelled pose to this one, the impact at its end, and Bezier curves through both ends with their slopes.

A request through a given state takes steps 1 and 2 from that state. Speeds and steps out of reach of the legs
are refused here, before IPOPT runs. Called by `optimise`.

IPOPT finds a local optimum near its guess, so the guess decides which gait is found: knees bent the usual way,
feet on the ground, the hip between them, and no leg wound round. It need not be periodic or keep any limit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from scipy.optimize import least_squares

from biped_adrc.core.errors import GaitError
from biped_adrc.core.types import Array
from biped_adrc.gait.design.request import GaitRequest, RobotLimits
from biped_adrc.gait.design.step import Unknowns, at_gait
from biped_adrc.gait.gait import onto_section
from biped_adrc.gait.zero_dynamics import invariant_constraint
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.planar import point, turned
from biped_adrc.model.planar_robot import PlanarRobot, robot_of

LONGEST = 1.2
"""Longest step that is searched, as a share of the leg length."""
FROUDE = 1.5
"""Largest speed over sqrt(g leg) that is searched; above 1 an inverted pendulum already leaves the ground."""
MOVED = 1e-3
"""Largest change of a joint by which a requested state is moved onto the ground [rad]."""
STEP = 0.5
"""Step length of the guess over the leg, and speed over sqrt(g leg), where the request leaves them free."""
BEND = 0.2
"""Distance of a joint of the guess from the end of its range [rad]; a quarter of a shorter range."""


def standing(robot: PlanarRobot) -> Array:
    """Configuration (n,) with both legs stretched downwards and all other links upwards [rad].

    Link directions are complex numbers, of which `robot` knows the vectors to feet and hip; absolute angles are
    kept in (-pi, pi].
    """
    K = robot.K
    foot, hip, w = K.foot_re + 1j * K.foot_im, K.hip_re + 1j * K.hip_im, K.w_re + 1j * K.w_im
    leg = foot - hip
    vector = np.where(np.abs(hip) > 0, hip, np.where(np.abs(leg) > 0, -leg, w))
    a = np.pi / 2 - np.angle(vector)
    a = np.pi - np.mod(np.pi - a, 2.0 * np.pi)
    a = np.where(np.abs(a + np.pi) < 1e-9, np.pi, a)
    return np.asarray(np.linalg.solve(robot.A, a), dtype=np.float64)


def inside(q: Array, biped: Biped, ranges: Mapping[str, tuple[float, float]]) -> Array:
    """Move the joints of q (n,) [rad] that have a range a little inside of it; returns the configuration.

    ranges: (low, high) [rad] by joint; the distance from an end is BEND or a quarter of the range. A guess at
    a bound would have no direction to move in.
    """
    q = q.copy()
    for joint, (low, high) in ranges.items():
        k = biped.description.joint_index(joint)
        off = min(BEND, 0.25 * (high - low))
        q[k] = np.clip(q[k], low + off, high - off)
    return q


def apart(
    biped: Biped, step: float, slope: float, ranges: Mapping[str, tuple[float, float]]
) -> Array:
    """Pre-impact configuration (n,) [rad] with the swing foot `step` [m] ahead on ground of `slope` [rad].

    Least squares: the foot weighs most, then the hip half way between the feet, then nearness to `standing`.
    """
    robot = robot_of(biped)
    near, K = inside(standing(robot), biped, ranges), robot.K
    target = step * ground_axes(slope)[0]
    bounds = np.full((2, biped.n), np.inf) * [[-1.0], [1.0]]
    for joint, ends in ranges.items():
        bounds[:, biped.description.joint_index(joint)] = ends

    def miss(q: Array) -> Array:
        """Residuals (n + 3,): foot from its target, hip from half way [m], q from standing [rad], weighted."""
        t = turned(robot, q)
        foot, hip = np.array(point(t, K.foot_re, K.foot_im)), point(t, K.hip_re, K.hip_im)
        return np.concatenate(
            (10.0 * (foot - target), [3.0 * (hip[0] - 0.5 * step)], 0.1 * (q - near))
        )

    result: Array = least_squares(miss, near, bounds=bounds).x
    return result


def _given_state(biped: Biped, state: Array, slope: float) -> tuple[Array, Array]:
    """(q-, q'-) of a requested state (2 n,), with q- moved onto the ground by at most MOVED [rad].

    Raises GaitError for a state that is not just before the impact of a walk forwards.
    """
    n, c = biped.n, biped.phase
    if len(state) != 2 * n:
        raise GaitError(f"the state to pass through has {len(state)} numbers, expected {2 * n}")
    q = onto_section(biped, state[:n], slope)
    moved = float(np.max(np.abs(q - state[:n])))
    span, rate = float(c @ (q - biped.relabel(q))), float(c @ state[n:])
    if not (moved <= MOVED and span * rate > 0.0):
        raise GaitError(
            f"q of the state to pass through is {moved:.3g} rad from one with the swing foot on the ground, "
            f"Theta changes by {span:.4g} rad over the step, and its rate is {rate:.4g} rad/s; expected at "
            f"most {MOVED:g} rad, and one sign: the state just before the impact of a walk forwards"
        )
    return q, state[n:]


def cold_start(biped: Biped, request: GaitRequest, limits: RobotLimits) -> Unknowns[Array]:
    """First guess of the unknowns of a request.

    The rate |Theta'| is constant over the step: the span of Theta over the duration that follows from speed
    and step. Raises GaitError for a speed or a step that legs of this length cannot walk.
    """
    c = biped.phase
    if request.through is None:
        leg = robot_of(biped).leg
        step = request.step or STEP * leg
        most = FROUDE * math.sqrt(biped.description.gravity * leg)
        if step > LONGEST * leg or (request.speed or 0.0) > most:
            raise GaitError(
                f"{request.in_words()} is asked for; legs of {leg:g} m cannot walk, one foot always on the "
                f"ground, faster than {most:.3g} m/s, or in steps of more than {LONGEST * leg:.3g} m: ask for "
                "less"
            )
        q = apart(biped, step, request.slope, limits.ranges)
        q_plus = biped.relabel(q)
        dq = (q - q_plus) / float(c @ (q - q_plus))
        duration = step / (request.speed or STEP * math.sqrt(biped.description.gravity * leg))
        rate = abs(float(c @ (q - q_plus))) / duration
    else:
        q, v = _given_state(biped, np.array(request.through), request.slope)
        dq, rate = v / float(c @ v), abs(float(c @ v))
    h = invariant_constraint(request.kind, biped, q, dq, request.degree)
    return at_gait(biped, h, q, dq, rate, np.full(request.nodes, rate), 0.5)
