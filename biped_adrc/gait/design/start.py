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

from biped_adrc.errors import GaitError
from biped_adrc.gait.curves import ControlledCurve
from biped_adrc.gait.design.request import GaitRequest, RobotLimits
from biped_adrc.gait.through_state import onto_section
from biped_adrc.model.biped import Biped
from biped_adrc.model.contact import Impact
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.planar import PlanarTree, point, turned
from biped_adrc.types import Array

LONGEST = 1.2
"""Longest step that is looked for, as a share of the leg length."""
FROUDE = 1.5
"""Largest speed over sqrt(g leg) that is looked for; above 1 an inverted pendulum already leaves the ground."""
MOVED = 1e-3
"""Largest change of a joint that puts the swing foot of a given state on the ground [rad]."""
STEP = 0.5
"""Step length of the guess over the leg where none is asked for, and speed over sqrt(g leg) where none is."""
BEND = 0.2
"""Largest distance of a joint of the guess from the end of its range [rad]; a quarter of a shorter range."""


def standing(tree: PlanarTree) -> Array:
    """Configuration (n,) with both legs stretched downwards and all other links upwards [rad].

    Link directions are complex numbers, of which `tree` knows the vectors to feet and hip; absolute angles are
    kept in (-pi, pi].
    """
    leg, w = tree.foot - tree.hip, tree.K.w_re + 1j * tree.K.w_im
    vector = np.where(np.abs(tree.hip) > 0, tree.hip, np.where(np.abs(leg) > 0, -leg, w))
    a = np.pi / 2 - np.angle(vector)
    a = np.pi - np.mod(np.pi - a, 2.0 * np.pi)
    a = np.where(np.abs(a + np.pi) < 1e-9, np.pi, a)
    return np.asarray(np.linalg.solve(tree.A, a), dtype=np.float64)


def inside(q: Array, biped: Biped, ranges: Mapping[str, tuple[float, float]]) -> Array:
    """q (n,) [rad] with the joints that have a range moved a little inside of it (BEND or a quarter of it).

    ranges: (low, high) [rad] by joint. A guess at a bound would have no direction to move in.
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
    tree = PlanarTree.of(biped)
    near, K = inside(standing(tree), biped, ranges), tree.K
    target = step * ground_axes(slope)[0]
    bounds = np.full((2, biped.n), np.inf) * [[-1.0], [1.0]]
    for joint, ends in ranges.items():
        bounds[:, biped.description.joint_index(joint)] = ends

    def miss(q: Array) -> Array:
        """Residuals (n + 3,): foot from its target, hip from half way [m], q from standing [rad], weighted."""
        t = turned(tree, q)
        foot, hip = np.array(point(t, K.foot_re, K.foot_im)), point(t, K.hip_re, K.hip_im)
        return np.concatenate(
            (10.0 * (foot - target), [3.0 * (hip[0] - 0.5 * step)], 0.1 * (q - near))
        )

    found: Array = least_squares(miss, near, bounds=bounds).x
    return found


def _given_state(biped: Biped, state: Array, slope: float) -> tuple[Array, Array]:
    """(q-, q'-) of a state (2 n,) to pass through, q- moved onto the ground by at most MOVED [rad].

    Raises GaitError for a state that is not just before the impact of a walk forwards.
    """
    n, c = biped.n, biped.phase
    if len(state) != 2 * n:
        raise GaitError(f"the state to pass through has {len(state)} numbers, expected {2 * n}")
    q = onto_section(biped, state[:n], slope)
    moved = float(np.max(np.abs(q - state[:n])))
    if moved > MOVED:
        raise GaitError(
            f"the state to pass through has its swing foot off the ground: q would have to move by {moved:.3g} "
            f"rad, expected at most {MOVED:g}; give the state just before impact"
        )
    span, rate = float(c @ (q - biped.relabel(q))), float(c @ state[n:])
    if not span * rate > 0.0:
        raise GaitError(
            f"Theta changes by {span:.4g} rad over the step that ends in this state, and its rate there is "
            f"{rate:.4g} rad/s; they need one sign: the state before impact of a walk forwards"
        )
    return q, state[n:]


def curve_through(
    kind: type[ControlledCurve], biped: Biped, q: Array, dq: Array, degree: int
) -> tuple[Impact, float, float, Array]:
    """The Bezier curves that are hybrid-invariant for an impact from (q, dq), with evenly spaced inner points.

    q: pre-impact configuration (n,) [rad], dq (n,): dq/dTheta there. Returns the impact (at Theta' = 1 rad/s),
    Theta+ and Theta- [rad], and coefficients alpha (p, M + 1) [rad] whose end slopes fit the impact.
    """
    p, c, impact = biped.p, biped.phase, biped.impact(q, dq)
    plus, minus = float(c @ impact.q), float(c @ q)
    slopes = impact.v[:p] / float(c @ impact.v) * (minus - plus), dq[:p] * (minus - plus)
    return impact, plus, minus, kind.between(impact.q[:p], *slopes, q[:p], degree)


def cold_start(
    biped: Biped, request: GaitRequest, limits: RobotLimits
) -> tuple[float, dict[str, Array]]:
    """Sign of Theta' and a first guess of the unknowns, such as q (n,) [rad], by the names of `step.Unknowns`.

    The rate |Theta'| is constant over the step: the span of Theta over the duration that speed and step give.
    Raises GaitError for a speed or a step that legs of this length cannot walk.
    """
    p, c, M = biped.p, biped.phase, request.degree
    if request.through is None:
        leg = PlanarTree.of(biped).leg
        step = request.step or STEP * leg
        most = FROUDE * math.sqrt(biped.description.gravity * leg)
        if request.speed is not None and request.speed > most:
            raise GaitError(
                f"{request.speed:g} m/s is asked for; legs of {leg:g} m cannot walk, one foot always on the "
                f"ground, faster than {most:.3g} m/s: ask for less"
            )
        if step > LONGEST * leg:
            raise GaitError(
                f"a step of {step:g} m is asked for, the legs are {leg:g} m long: ask for at most "
                f"{LONGEST * leg:.3g} m"
            )
        q = apart(biped, step, request.slope, limits.ranges)
        q_plus = biped.relabel(q)
        dq = (q - q_plus) / float(c @ (q - q_plus))
        duration = step / (request.speed or STEP * math.sqrt(biped.description.gravity * leg))
        rate = abs(float(c @ (q - q_plus))) / duration
    else:
        q, v = _given_state(biped, np.array(request.through), request.slope)
        dq, rate = v / float(c @ v), abs(float(c @ v))
    impact, plus, minus, alpha = curve_through(request.kind, biped, q, dq, M)
    guess = {
        "q": q,
        "slope": dq[:p],
        "alpha": alpha,
        "theta": np.array([plus, minus]),
        "after": impact.v_e,
        "impulse": impact.impulse,
        "rate": np.array(rate),
        "rates": np.full(request.nodes, rate),
        "peak": np.array(0.5),
    }
    return float(np.sign(minus - plus)), guess
