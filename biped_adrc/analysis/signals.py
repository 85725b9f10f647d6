"""All signals of a walk: references, errors, torques, estimates, energies, contact forces.

A trajectory stores states only. Controllers have no hidden state, so every other signal is computed again from
the stored states, at the stored nodes, by the same closed loop (`closed_loop.system`) that made them; compiled
where the walk was. Plots, metrics, certificates and exports read `Signals`.

    node           an instant at which the run stored its state
    arc            the nodes of one single support; `arc.t` are their times
    `arc.seen`     these times, but just before a jump where a signal jumps (the next smaller float): a signal
                   computed there has the value that acted until the jump

Symbols, with the equation numbers of the paper:

    q, v = q'      the n coordinates [rad] and their rates; q_b are the first p of them, the joints with motors
    Theta = c q    phase of the gait [rad]
    D q'' + Omega = B_s u + xi~    (11), the controller's nominal model: inertia matrix D, Coriolis and gravity
                   terms Omega, the torques u of the motors (B_s puts them into the first p rows)
    xi~            generalised force (n,) [N m] that this model does not know; zeta (n,) is the external one
    q_b'' = kappa u + xi           (13), the rows of q_b, solved: input gain kappa (p, p) [1/(kg m^2)]
    xi, xi^        total disturbance (p,) [rad/s^2], from xi~ by (14), and an observer's estimate of it

On another plant, such as MuJoCo's on soft ground, motion and forces of the ground are recorded and not
computed:

    q'' by differences from tick to tick,   F of the ground as recorded,   xi = q_b'' - kappa u

What the controller measures and computes follows from the states as on the rigid plant. xi~ then holds all that
the model, which is pinned at its foot, does not know: the touchdown's force, a foot that gives way.

`integrate` and `largest` are integrals and peaks of signals. Nodes are unevenly spaced, and a repeated time
marks a jump, at an impact or a sample instant: the signal has a left and a right value there. So they work
piece by piece between jumps.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from functools import partial

import numpy as np

from biped_adrc.closed_loop.instant_signals import InstantSignals, signals_at
from biped_adrc.closed_loop.other_plant import FEET
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.outer_loop import OuterLoop, tracked_by, tracked_point
from biped_adrc.core.errors import ModelError
from biped_adrc.core.linear import lapack
from biped_adrc.core.shown import Frozen
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.tree import Layout
from biped_adrc.core.types import Array, Flags
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.reduction import disturbance_parts, unknown_force

FORCE, PLACE, SPEED, _ = FEET
"""Names of the feet's readings in an arc's `read`, (K, 4) each: forces [N], places [m], velocities [m/s]."""
LONG = 2000
"""Number of nodes from which on compiling the signals is faster than NumPy."""
FALLS = Status.FELL, Status.STALLED, Status.RAN_AWAY
"""Ends of a walk in whose last single support the robot leaves the gait and does not come back."""


@dataclass(frozen=True)
class Signals(Frozen):
    """All signals of a walk; rows are the K stored nodes.

    Impacts and sample instants repeat their time, with the values before and after.
    """

    t: Array
    """(K,) [s]."""
    step: Array
    """Number of the single support (K,), from 1."""
    q: Array
    """(K, n) [rad]."""
    v: Array
    """(K, n) [rad/s]."""
    a: Array
    """(K, n) [rad/s^2]."""
    theta: Array
    """(K,) Theta [rad]."""
    dtheta: Array
    """(K,) Theta' [rad/s]."""
    q_d: Array
    """References of the actuated joints (K, p) [rad]."""
    dq_d: Array
    """Their rates (K, p) [rad/s]."""
    error: Array
    """(K, p) q_b - q_d [rad]; NaN in a fall, from where Theta has left the gait for good: a curve that is
    continued past its end is no reference."""
    u: Array
    """(K, p) torque applied [N m]."""
    zeta: Array
    """(K, n) external torque [N m]."""
    xi: Array
    """(K, p) total disturbance q_b'' - kappa u of the nominal model [rad/s^2]."""
    xi_estimate: Array
    """(K, p) estimate of xi [rad/s^2]; NaN without an observer."""
    xi_external: Array
    """(K, p) xi - xi_nominal: effects of zeta, matched and unmatched, and errors of the model [rad/s^2]."""
    xi_matched: Array
    """(K, p) kappa xi~_b, the matched part of xi_external: what a motor could cancel [rad/s^2]."""
    xi_nominal: Array
    """(K, p) (14) without xi~: the part of xi that the nominal model knows [rad/s^2]."""
    zeta_estimate: Array
    """(K, p) kappa^-1 (xi^ - xi_nominal): estimated torque beyond the model [N m]; NaN without an observer."""
    ground_reaction: Array
    """(K, 2), force of the ground (F_T, F_N) on the robot [N], horizontal and vertical on any slope."""
    outside: Array
    """(K, 2), resultant external force on the robot [N], along x and z."""
    momentum: Array
    """(K, 2), m v_com of the plant [N s], along x and z."""
    kinetic: Array
    """(K,) [J]."""
    potential: Array
    """(K,) [J], zero at the height of the first stance foot."""
    swing_foot: Array
    """(K, 2) place of the swing foot relative to the stance foot [m]."""
    hip: Array
    """(K, 2) place of the hip relative to the stance foot [m]."""
    foothold: Array
    """(K,) x of the stance foot in the world [m]."""
    foothold_height: Array
    """(K,) z of the stance foot in the world [m]."""

    def __repr__(self) -> str:
        ends = f"{self.t[0]:.4g} to {self.t[-1]:.4g} s"
        return f"Signals({len(self.t)} nodes, {ends}, n = {self.q.shape[1]}, p = {self.u.shape[1]})"

    @property
    def xi_unmatched(self) -> Array:
        """(K, p) the rest of `xi_external`: it enters through the unactuated rows of (11) [rad/s^2]."""
        return self.xi_external - self.xi_matched

    @property
    def peak_error(self) -> float:
        """max |q_b - q_d| [rad] up to a fall, also between the nodes."""
        s = self.before_fall
        return largest(s.t, s.error, s.v[:, : s.error.shape[1]] - s.dq_d)

    @property
    def before_fall(self) -> Signals:
        """These signals without their rows in a fall, where the error is NaN."""
        rows = ~np.any(np.isnan(self.error), axis=1)
        return self if np.all(rows) else self.of_rows(rows)

    def of_step(self, step: int) -> Signals:
        """The rows of one single support."""
        return self.of_rows(slice(*np.searchsorted(self.step, (step, step + 1))))

    def of_rows(self, rows: Flags | slice) -> Signals:
        """These rows of all signals."""
        return Signals(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})


def signals(walker: Walker, trajectory: Trajectory, reference: Reference) -> Signals:
    """Compute the signals of a walk; `reference` gives q_d (usually the controller's own).

    In a fall the error is NaN (`nodes_before_fall`). Where outer loops correct the reference, q_d is the
    corrected one. Of a compiled run, and of a long one, they are computed in compiled code where that is
    possible.
    """
    # tracked: the outer loop itself, where there is one, else `reference`; found: the signals at all nodes
    # LONG: from so many nodes on compiling is faster than NumPy
    many = sum(len(arc.t) for arc in trajectory.arcs) >= LONG
    compiled = trajectory.settings.get("engine") == "compiled"
    tracked = tracked_by(walker.law, reference)
    found = compiled_readings(walker, trajectory, tracked) if compiled or many else None
    result = signals_of(walker, trajectory, found or readings(walker, trajectory, tracked))
    # FALLS: ends of a walk in which the robot leaves the gait for good; only the curve of a VirtualConstraint
    # has an end, behind which no error is defined
    if trajectory.status in FALLS and isinstance(reference, VirtualConstraint):
        error = result.error.copy()
        error[nodes_before_fall(result.step, result.theta, reference) :] = np.nan
        return replace(result, error=error)
    return result


def nodes_before_fall(step: Array, theta: Array, h: VirtualConstraint) -> int:
    """How many nodes of a walk that fell have a tracking error: all up to the last node at which Theta is
    between both ends of the curve h, and at least up to the first node of the last single support.

    step (K,): numbers of the single supports at the nodes. theta (K,) [rad]: Theta there.
    """
    # sorted, as Theta may rise or fall along a step; first: first node of the last single support
    first, ends = int(np.searchsorted(step, step[-1])), sorted((h.theta_plus, h.theta_minus))
    on_curve = np.flatnonzero((ends[0] <= theta[first:]) & (theta[first:] <= ends[1]))
    return first + int(np.max(on_curve, initial=0)) + 1


def readings(
    walker: Walker, trajectory: Trajectory, reference: Reference | OuterLoop
) -> InstantSignals:
    """Evaluate the closed loop at all nodes of a walk, in NumPy; fields (K, ...).

    reference: the curve from which errors are taken. Times are `arc.seen`, so that signals that jump at a node
    have their value from before.
    """
    # tracked_point: the point (q_d, q_d', ..) of the reference at a measurement
    rows = [
        signals_at(walker, float(t), x, arc.mode, partial(tracked_point, reference))
        for arc in trajectory.arcs
        for t, x in zip(arc.seen, arc.x, strict=True)
    ]
    return InstantSignals(*(np.array(column) for column in zip(*rows, strict=True)))


def compiled_readings(
    walker: Walker, trajectory: Trajectory, reference: Reference | OuterLoop
) -> InstantSignals | None:
    """`readings` in compiled code: all signals at all K nodes; None where a part has no compiled form.

    reference: the curve from which errors are taken, which need not be the one the controller tracked. Where
    the disturbance jumps at a node it has its value from before, as `_inputs` takes the times `arc.seen`.
    """
    from biped_adrc.engine.calls import Call
    from biped_adrc.engine.not_compiled import NotCompiled
    from biped_adrc.engine.numbers import numbers_of
    from biped_adrc.engine.program import COMPILED, Program

    # program, K: the walker's code and its numbers; layout: what stands where in its state; point: the point of
    # the reference at a measurement
    first, point = trajectory.arcs[0], partial(tracked_point, reference)
    try:
        layout = walker.layout_of(first.x[0])
        program = Program(layout, numbers_of(walker, curve=reference))
        if trajectory.settings.get("engine") != COMPILED:
            # a run in Python may have a controller without machine code: then this raises NotCompiled
            _ = program.machine
        code, K = program.reading(signals_at), program.K
    except (NotCompiled, ModelError):
        return None
    # one instant in Python, for the layout of the results alone
    result = Layout.of(signals_at(walker, first.t[0], first.x[0], first.mode, point))
    # 0 inputs of its own: `rows` gets them; all results of a node lie in one row
    call = Call(code, "reading", K, 0, result.size)
    out = np.vstack([call.rows(_inputs(walker, arc)) for arc in trajectory.arcs])
    return result.tree(out)


def _inputs(walker: Walker, arc: Arc) -> Array:
    """Inputs of the compiled `signals_at` at the K nodes of an arc, in rows (t, step, start, x, zeta, zeros).

    t is of `arc.seen`: just before a jump, where zeta has its value from before. step, start: number of the
    single support, and the time at which it began. The OUTSIDE zeros at the end stand for forces on the feet,
    which no signal needs.
    """
    from biped_adrc.engine.calls import pushes, zeta_rows
    from biped_adrc.engine.kernels.record import OUTSIDE
    from biped_adrc.engine.not_compiled import NotCompiled

    n, t, x, mode = walker.plant.n, arc.seen, arc.x, arc.mode
    q, v, ones = x[:, :n], x[:, n : 2 * n], np.ones((len(t), 1))
    # zeta_rows: the disturbance at all times, in machine code; one without such code is called node by node
    try:
        zeta = zeta_rows(pushes(walker.disturbance, n), t, x, mode, n)
    except NotCompiled:
        zeta = np.array([walker.external(*at, mode) for at in zip(t.tolist(), q, v, strict=True)])
    head = (t[:, np.newaxis], mode.step * ones, mode.start * ones)
    return np.hstack((*head, x, zeta, np.zeros((len(t), OUTSIDE))))


def signals_of(walker: Walker, trajectory: Trajectory, r: InstantSignals) -> Signals:
    """Make the signals from the closed loop's values r at the nodes, the states and the footholds.

    In r the ground force includes the force from outside, which is subtracted, and the potential energy is zero
    at the height of the stance foot of each step.
    """
    arcs, n, c = trajectory.arcs, walker.plant.n, walker.plant.phase
    r = as_recorded(walker, trajectory, r)  # on another plant with what it recorded
    x = np.vstack([arc.x for arc in arcs])
    q, v = x[:, :n], x[:, n : 2 * n]
    # recorded: (x, z) of the stance foot, then of the other one, which is not used; None on the rigid plant
    # PLACE: name of the feet's recorded places [m]
    foot = recorded(trajectory, PLACE)
    if foot is None:
        foot = np.repeat(footholds(walker, trajectory), [len(arc.t) for arc in arcs], axis=0)
    # `pulls`: a force from outside may act on the robot; t of `arc.seen` is just before a jump
    outside = np.zeros((len(x), 2))
    if walker.disturbance is not None and walker.disturbance.pulls:
        outside = np.array([walker.resultant(float(t), arc.mode) for arc in arcs for t in arc.seen])
    r = r._replace(ground_reaction=r.ground_reaction - outside)
    r = r._replace(potential=r.potential + walker.plant.weight * foot[:, 1])
    t = np.concatenate([arc.t for arc in arcs])
    step = np.concatenate([np.full(len(arc.t), arc.mode.step) for arc in arcs])
    return Signals(
        t=t,
        step=step,
        q=q,
        v=v,
        theta=q @ c,
        dtheta=v @ c,
        error=q[:, : walker.plant.p] - r.q_d,
        foothold=foot[:, 0],
        foothold_height=foot[:, 1],
        outside=outside,
        **r._asdict(),
    )


# -- on another plant ---------------------------------------------------------------------------------
def recorded(trajectory: Trajectory, name: str) -> Array | None:
    """A reading of the feet at all K nodes (K, 4): (x, z) of the stance foot, then of the other one.

    name: FORCE, PLACE or SPEED, forces [N] of the ground, places [m] or velocities [m/s] of the feet. Plants
    with contacts of their own record it in each arc; None for a walk on the rigid plant, which does not.
    """
    if any(name not in arc.read for arc in trajectory.arcs):
        return None
    return np.vstack([arc.read[name] for arc in trajectory.arcs])


def footholds(walker: Walker, trajectory: Trajectory) -> Array:
    """x and z [m] of the stance foot at the start of each arc (arcs, 2).

    The first stands at x = z = 0, and each impact moves it by the place of the swing foot relative to it, at
    the state x- before the impact; on soft ground it is recorded.
    """
    foot, feet, plant = np.zeros(2), [], walker.plant
    for arc in trajectory.arcs:
        # read[PLACE]: recorded places (x, z) of stance and swing foot at the nodes (K, 4)
        feet.append(arc.read[PLACE][0, :2] if PLACE in arc.read else foot)
        if arc.event is not None and arc.event.x_plus is not None:
            foot = foot + plant.swing_foot(arc.event.x_minus[: plant.n])
    return np.array(feet)


def as_recorded(walker: Walker, trajectory: Trajectory, found: InstantSignals) -> InstantSignals:
    """The signals `found` by the closed loop, with q'', ground force, momentum and xi of the plant that
    walked in place of the rigid model's.

    On the rigid plant, which records nothing, they stay as they are. The ground force of `InstantSignals`
    includes the external force, so it is added here too. The momentum in `found` is that relative to the stance
    foot, so the robot's mass times the velocity of this foot (the first two columns of `speed`) is added.
    """
    # FORCE, SPEED: names of the feet's recorded forces [N] and velocities [m/s]
    force, speed = recorded(trajectory, FORCE), recorded(trajectory, SPEED)
    if force is None or speed is None:
        return found
    n, p, arcs = walker.plant.n, walker.plant.p, trajectory.arcs
    x, a = np.vstack([arc.x for arc in arcs]), np.vstack([accelerations(arc, n) for arc in arcs])
    outside = [walker.resultant(float(t), arc.mode) for arc in arcs for t in arc.seen]
    rows = []
    for x_k, a_k, u in zip(x, a, found.u, strict=True):
        # xi is defined by the controller's model: xi = q_b'' - kappa u with its kappa, whatever moved
        # unknown_force is xi~ of (11), disturbance_parts its matched and unmatched part in xi
        terms = walker.nominal.reduction(x_k[:n], x_k[n : 2 * n])
        matched, unmatched = disturbance_parts(terms, unknown_force(terms, a_k, u))
        rows.append((a_k[:p] - terms.kappa @ u, matched + unmatched, matched, terms.xi))
    xi, external, matched, nominal = map(np.array, zip(*rows, strict=True))
    found = found._replace(xi=xi, xi_external=external, xi_matched=matched, xi_nominal=nominal)
    ground = force[:, :2] + np.array(outside)
    momentum = found.momentum + walker.plant.mass * speed[:, :2]
    return found._replace(a=a, ground_reaction=ground, momentum=momentum)


def accelerations(arc: Arc, n: int) -> Array:
    """q'' (K, n) [rad/s^2] of n coordinates at the nodes of an arc, as recorded there by differences of rates.

    Over less than SAME_INSTANT, as where a push ends at a sample instant up to round-off, a difference is
    round-off too: there q'' is that of the interval before, or after it at the start.
    """
    # arc.dx is the recorded x' = (q', q'') at the nodes; ways: the intervals between them [s]
    ways = np.diff(arc.t)
    short = (ways > 0.0) & (ways < SAME_INSTANT)
    bad = np.append(short, False) | np.append(False, short)
    good = np.flatnonzero(~bad)
    if len(good) == 0:
        return arc.dx[:, n : 2 * n]
    # of each node the last good node up to it, -1 where there is none, which becomes the first good one
    before = np.searchsorted(good, np.arange(len(arc.t)), side="right") - 1
    return arc.dx[good[np.maximum(before, 0)], n : 2 * n]


def integrate(t: Array, y: Array) -> float:
    """Integrate y (K,) over t (K,) [s]; a repeated time separates smooth pieces.

    Cubic splines, of order 4 in the distance of the nodes; the trapezoidal rule where a piece
    has fewer than four nodes. Infinite where y is not finite, as in a walk that diverges. The
    result has the unit of y times [s].
    """
    if not np.all(np.isfinite(y)):
        return math.inf
    width = np.diff(t)
    # first node of each smooth piece; the interval at a jump and the one added at the end have no area
    starts = np.append(0, np.flatnonzero(width == 0.0) + 1)
    area = np.append(width * (y[1:] + y[:-1]) / 2.0, 0.0)
    pieces = np.add.reduceat(area, starts)
    for i in np.flatnonzero(np.diff(starts, append=len(t)) >= 4):
        piece = slice(starts[i], starts[i + 1] if i + 1 < len(starts) else None)
        pieces[i] = _under_spline(t[piece], y[piece])
    # cumsum adds in the order of time, np.sum in another one with other round-off
    return float(np.cumsum(pieces)[-1])


def _under_spline(t: Array, y: Array) -> float:
    """Integral of the cubic spline through y (K,) at t (K,), K >= 4, not-a-knot at both ends.

    Its slopes s solve a tridiagonal system; each interval adds h (y_0 + y_1) / 2 + h^2 (s_0 - s_1) / 12. As
    SciPy's CubicSpline, whose module takes long to load.
    """
    h = np.diff(t)
    m = np.diff(y) / h
    A, b = np.zeros((3, len(t))), np.empty(len(t))  # above, on and below the diagonal
    A[0, 2:], A[1, 1:-1], A[2, :-2] = h[:-1], 2.0 * (h[:-1] + h[1:]), h[1:]
    b[1:-1] = 3.0 * (h[1:] * m[:-1] + h[:-1] * m[1:])
    # the not-a-knot conditions, in the first and the last equation: i the outer interval and node, j the next
    # one, row the diagonal of A with the coefficient beside it
    for i, j, row in ((0, 1, 0), (-1, -2, 2)):
        d = h[i] + h[j]
        A[1, i], A[row, j] = h[j], d
        b[i] = ((h[i] + 2.0 * d) * h[j] * m[i] + h[i] ** 2 * m[j]) / d
    # [3] of its results is the solution
    s = lapack.dgtsv(A[2, :-1], A[1], A[0, 1:], b)[3]
    return float(np.trapezoid(y, t) + np.sum(h * h * (s[:-1] - s[1:])) / 12.0)


def largest(t: Array, y: Array, dy: Array) -> float:
    """max |y| over [t_0, t_K] [s] for y (K, p) with slopes dy (K, p), at the nodes and between them.

    Between two nodes y is the cubic through both with their slopes, which has the order of the integration
    method; its extrema are where its derivative a s^2 + b s + c is zero, s from 0 to 1. A repeated time is a
    jump: both sides count. Infinite where y is not finite.
    """
    if not (np.all(np.isfinite(y)) and np.all(np.isfinite(dy))):
        return math.inf
    h = np.diff(t)[:, np.newaxis]
    rise, d0, d1 = np.diff(y, axis=0), h * dy[:-1], h * dy[1:]
    a, b, c = 3.0 * (d0 + d1 - 2.0 * rise), 2.0 * (3.0 * rise - 2.0 * d0 - d1), d0
    # the roots are root / a and c / root, without cancellation; NaN and those outside of (0, 1) become s = 0
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        root = -0.5 * (b + np.copysign(np.sqrt(b * b - 4.0 * a * c), b))
        result = [np.abs(y).max(initial=0.0)]
        for s in (root / a, c / root):
            inside = np.where((s > 0.0) & (s < 1.0), s, 0.0)
            # the cubic y + c s + b s^2 / 2 + a s^3 / 3
            between = y[:-1] + inside * (d0 + inside * (0.5 * b + inside * a / 3.0))
            result.append(np.abs(between).max(initial=0.0))
    return float(max(result))
