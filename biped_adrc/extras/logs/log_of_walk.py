"""The log that the computer of a simulated robot would have written: its measurements at the sample instants.

So a log with known disturbances can be replayed, and the estimates compared with the true ones.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.closed_loop.semantics import parts, turned
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.errors import InputError
from biped_adrc.core.timing import SAME_INSTANT, SampledTime
from biped_adrc.core.types import Array, relabelled
from biped_adrc.extras.logs.robot_log import RobotLog
from biped_adrc.hardware.sample_hold import motor_torque, read
from biped_adrc.hardware.touchdown import belief_of
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.scenario.recording import Walk

LoggedRow = tuple[float, float, Array, Array, Array]
"""t [s], number of the single support, q (n,) [rad], u (p,) [N m], v (n,) [rad/s]."""


def logged(walk: Walk) -> RobotLog:
    """Make the log of a walk in sampled time: angles and rates as measured by the
    sensors, torques as they acted.

    Single supports and labels are those of the controller, detected or known. Raises InputError for a walk in
    continuous time, which has no sample instants.
    """
    time = walk.walker.timing
    if not isinstance(time, SampledTime):
        raise InputError(
            "the walk is in continuous time and has no sample instants to log; give a period, as period=1e-3"
        )
    run = walk.trajectory
    rows = [
        row
        for arc in run.arcs
        for k, end in _ticks(arc, time, run.t_start)
        for row in [_row(walk.walker, arc, k, end)]
    ]
    if not rows:
        raise InputError(
            f"the walk ended at t = {run.t_end:g} s, before a second sample instant, and has nothing to log"
        )
    t, step, q, u, v = (np.array(x) for x in zip(*rows, strict=True))
    return RobotLog(t, step, q, u, v)


def _ticks(arc: Arc, time: SampledTime, start: float) -> list[tuple[int, int]]:
    """For each sample instant of an arc: index of the node just after it, and of the
    node just before the next one.
    """
    t, period = arc.t, time.period
    since = t - (t[0] if time.restart else start)
    due = np.abs(since - period * np.round(since / period)) < SAME_INSTANT
    after = np.flatnonzero(due[:-1] & (np.diff(t) > 0.0))
    before = [*(int(np.searchsorted(t, t[k])) for k in after[1:]), len(t) - 1]
    return list(zip(after.tolist(), before[: len(after)], strict=True))


def _row(walker: Walker, arc: Arc, k: int, end: int) -> LoggedRow:
    """Measurement at node k, in the labels of the controller, and the mean torque until node `end`."""
    q, v, _, tail = parts(walker, arc.x[k])
    held = walker.held
    assert held is not None
    h, step, other = read(held.sizes, tail), float(arc.mode.step), 0.0
    if held.sizes.belief > 0:
        b = belief_of(h.b)
        step, other = float(b.step), b.other
    q, v = held.reading(h.w, *turned(walker, other, q, v))
    nodes = slice(k, end + 1)
    t, tails = arc.t[nodes], (parts(walker, x)[3] for x in arc.x[nodes])
    acted = np.array([motor_torque(read(held.sizes, x).line) for x in tails])
    u = np.trapezoid(acted, t, axis=0) / (t[-1] - t[0])  # also where it is late or lags
    return float(arc.t[k]), step, q, relabelled(u, walker.swap) if other > 0.5 else u, v
