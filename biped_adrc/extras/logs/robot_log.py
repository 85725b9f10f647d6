"""The log of a robot's computer during a walk: t, q, u, and the number of the single support, at its sample
instants.

    row k      q_k, and where there are rates v_k, as the sensors measured them at t_k
               u_k, the mean torque of the motors from t_k until t_(k+1)

The q (n,) [rad] are the coordinates, v (n,) [rad/s] their rates, u (p,) [N m] the torques of the p motors. The
joints have the names (labels) of the package, by stance and swing leg, which exchange at a touchdown. Rows of
one single support are one period apart; the first row of the next may come earlier. `log_file` reads and writes
logs, also with names by the robot's own legs; `logged` makes the log that the computer of a simulated robot
would have written, so that estimates can be compared with the true values. An arc of a trajectory is one single
support, a node of it a stored instant.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from biped_adrc.closed_loop.semantics import in_other_names, parts
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.checks import numbers
from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import LONGEST_PERIOD, SAME_INSTANT, SampledTime
from biped_adrc.core.types import Array, Flags, Indices, read_only, relabelled
from biped_adrc.hardware.sample_hold import motor_torque
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.scenario.recording import Walk

GAP = 0.5
"""Share of the period by which a row may come too early or too late after the one before; beyond it rows are
missing or too many."""
SHORTEST_PERIOD = 1e-5
"""Shortest plausible period [s]; with rows closer together the times are in another unit."""
EVEN = 1e-3
"""Largest deviation of the distance of two rows from the period, as a share of it, for an even clock."""


@dataclass(frozen=True)
class RobotLog(Shown):
    """A log of K rows, with n coordinates and p motors.

    Raises InputError for arrays that are no log, with the row, what was found there and what was expected.
    """

    t: Array
    """(K,) [s]."""
    step: Array
    """Number of the single support (K,); it grows by 1 at a touchdown."""
    q: Array
    """(K, n) [rad], in the labels of stance and swing leg."""
    u: Array
    """(K, p) [N m], the mean torque until the next row."""
    v: Array | None = None
    """(K, n) [rad/s]; None where no rate was measured."""
    measured: Array | None = None
    """(n,), 1 where v has a measured rate, 0 where it has none; None: all of v, none without v."""
    remarks: tuple[str, ...] = ()
    """Sentences on what was converted, ignored or resampled."""

    def __post_init__(self) -> None:
        """Replace the arrays by read-only copies, None by arrays, and check them; see the class."""
        n = np.shape(self.q)[-1:]
        usual = {"v": np.zeros(np.shape(self.q)), "measured": np.full(n, self.v is not None)}
        for name in ("t", "step", "q", "u", "v", "measured"):
            x = getattr(self, name)
            values = numbers(usual.get(name) if x is None else x, f"{name} of the log")
            object.__setattr__(self, name, read_only(values))
        if self.has_rate.shape != n:
            raise InputError(
                f"measured of the log has the shape {self.has_rate.shape}, expected {n}, 1 or 0 for each rate"
            )
        names = [f"row {k}" for k in range(1, self.t.size + 1)]
        check_rows(self.t, self.step, self.q, self.u, self.rates, names)

    @property
    def rates(self) -> Array:
        """v (K, n) [rad/s], zero where no rate was measured: `__post_init__` has put zeros for None."""
        return np.asarray(self.v)

    @property
    def has_rate(self) -> Flags:
        """Whether the rate of each coordinate was measured (n,)."""
        return np.asarray(self.measured) > 0.5

    @cached_property
    def period(self) -> float:
        """Median time between two rows of a single support [s], without the round-off of the times."""
        return float(f"{np.median(self._ways):.9g}")

    @property
    def _ways(self) -> Array:
        """Times between neighbouring rows of the same single support [s]."""
        return np.diff(self.t)[np.diff(self.step) == 0.0]

    def even(self, period: float) -> bool:
        """Whether the rows of every single support are `period` [s] apart, to the share EVEN of it."""
        # _ways: times between neighbouring rows of one single support
        return bool(np.all(np.abs(self._ways - period) <= EVEN * period))

    def resampled(self, period: float) -> RobotLog:
        """The log on an even clock that starts anew with every single support, rows `period` [s] apart.

        Angles and rates are interpolated linearly between rows; the torque of a new row is the mean, over its
        period, of the torques that were held. A remark says so.
        """
        supports = np.split(np.arange(len(self.t)), np.flatnonzero(np.diff(self.step)) + 1)
        # _support: t, step, q, u, v of one single support on the new clock
        parts = zip(*(self._support(rows, period) for rows in supports), strict=True)
        t, step, q, u, v = (np.concatenate(x) for x in parts)
        remark = f"resampled from {self.period:.6g} s to {period:.6g} s: straight lines for q, means of held u"
        return replace(self, t=t, step=step, q=q, u=u, v=v, remarks=(*self.remarks, remark))

    def _support(self, rows: Indices, period: float) -> tuple[Array, ...]:
        """t, step, q, u, v of one single support on the even clock, M rows of each.

        rows (K,): indices of its rows in the log. The mean torque of a new row is the impulse (integral of the
        torque) over its period, divided by the period.
        """
        # impulse (K + 1, p) [N m s]: from the first row until each of `edges`, the times of the rows and the
        # end of the last one; at: the new times; the last period may end early
        t, u, line = self.t[rows], self.u[rows], (self.q[rows], self.rates[rows])
        # EVEN: share of a period by which the last new row may be late
        at = t[0] + period * np.arange(math.floor((t[-1] - t[0]) / period + EVEN) + 1)
        edges = np.append(t, t[-1] + self.period)
        impulse = np.cumsum(u * np.diff(edges)[:, np.newaxis], axis=0)
        impulse = np.vstack((np.zeros_like(u[:1]), impulse))
        end = np.minimum(at + period, edges[-1])
        mean = _between(end, edges, impulse) - _between(at, edges, impulse)
        q, v = (_between(at, t, x) for x in line)
        return at, np.full(len(at), self.step[rows[0]]), q, mean / (end - at)[:, np.newaxis], v


def _between(at: Array, t: Array, x: Array) -> Array:
    """Interpolate x (K, k), given at t (K,) [s], linearly at the times `at` (M,) [s]; returns (M, k)."""
    return np.column_stack([np.interp(at, t, column) for column in x.T])


def check_rows(t: Array, step: Array, q: Array, u: Array, v: Array, names: list[str]) -> None:
    """Raise InputError for arrays of different length, numbers that are not finite, and numbers of single
    supports or times that are not those of a sampled walk.

    t, step (K,), q, v (K, n), u (K, p): as a `RobotLog` has them. names (K,): what each row is called in
    messages, such as "line 7".
    """
    K = (len(names),)
    fits = t.shape == step.shape == q.shape[:1] == u.shape[:1] == K and q.ndim == u.ndim == 2
    if not fits or v.shape != q.shape:
        raise InputError(
            f"the log has t {t.shape}, step {step.shape}, q {q.shape}, u {u.shape} and v {v.shape}, expected K "
            "rows of each: (K,), (K,), (K, n), (K, p), (K, n)"
        )
    table = np.column_stack((t, step, q, v, u))
    # `[:1]`: the first wrong row is reported
    for k in np.flatnonzero(~np.all(np.isfinite(table), axis=1))[:1]:
        raise InputError(f"{names[k]} of the log has {table[k]}, expected finite numbers")
    grows = np.isin(np.diff(step, prepend=step[:1]), (0.0, 1.0))
    for k in np.flatnonzero((step != np.round(step)) | (step < 1.0) | ~grows)[:1]:
        raise InputError(
            f"{names[k]} of the log is of single support {step[k]:g}, expected whole numbers from 1 that grow "
            "by 1 at a touchdown"
        )
    _check_times(t, step, names)


def _check_times(t: Array, step: Array, names: list[str]) -> None:
    """Raise InputError for times (K,) [s] that do not grow, are in another unit, or have a gap.

    names (K,): what each row is called in messages; of several wrong rows the first is named.
    """
    ways, same = np.diff(t), np.diff(step) == 0.0
    for k in np.flatnonzero(ways <= 0.0)[:1]:
        result = "the same time as" if ways[k] == 0.0 else f"{-ways[k]:g} s before"
        raise InputError(
            f"{names[k + 1]} of the log has t = {t[k + 1]:.9g} s, {result} the row before, expected times that "
            "grow; leave doubled rows out"
        )
    period = float(np.median(ways[same])) if np.count_nonzero(same) > 1 else math.nan
    # plausible periods; others are times in another unit
    if not SHORTEST_PERIOD <= period <= LONGEST_PERIOD:
        raise InputError(
            f"the log has {len(t)} rows that are {period:g} s apart, expected three of one single support or "
            f"more, {SHORTEST_PERIOD} to {LONGEST_PERIOD} s apart; if its times are in another unit, say so in "
            "the name of the column, as 't [ms]'"
        )
    # GAP: share of a period by which a row may be early or late; after a touchdown it may be earlier, since the
    # clock may restart there
    late = ways > (1.0 + GAP) * period
    for k in np.flatnonzero(late | (same & (ways < (1.0 - GAP) * period)))[:1]:
        raise InputError(
            f"{names[k + 1]} of the log comes {ways[k]:.6g} s after the row before, expected {period:.6g} s as "
            f"most rows do; rows are missing there, or too many: fill them in, or replay the parts one by one"
        )


def logged(walk: Walk) -> RobotLog:
    """Make the log of a simulated walk in sampled time: angles and rates as its sensors measured them, mean
    torques that acted.

    Single supports and names of the legs are those of the controller, which may detect touchdowns. Raises
    InputError for a walk in continuous time, which has no sample instants.
    """
    time = walk.walker.timing
    if not isinstance(time, SampledTime):
        raise InputError(
            "the walk is in continuous time and has no sample instants to log; give a period, as period=1e-3"
        )
    run = walk.trajectory
    # _ticks: (node just after a sample instant, node just before the next one), the arguments of `_row`
    ticks = ((arc, *tick) for arc in run.arcs for tick in _ticks(arc, time, run.t_start))
    rows = [_row(walk.walker, *tick) for tick in ticks]
    if not rows:
        raise InputError(
            f"the walk ended at t = {run.t_end:g} s, before a second sample instant, and has nothing to log"
        )
    t, step, q, u, v = (np.array(x) for x in zip(*rows, strict=True))
    return RobotLog(t, step, q, u, v)


def _ticks(arc: Arc, time: SampledTime, start: float) -> list[tuple[int, int]]:
    """For each sample instant of an arc (single support): index of the node just after it, and of the node just
    before the next one, or of the last node.

    start [s]: start of the run, from which a clock without restart counts. At a sample instant a time occurs in
    two nodes, before and after the jump.
    """
    t, period = arc.t, time.period
    since = t - (t[0] if time.restart else start)
    # due: nodes at a sample instant; of two nodes of equal time the later one is followed by a longer time
    due = np.abs(since - period * np.round(since / period)) < SAME_INSTANT
    after = np.flatnonzero(due[:-1] & (np.diff(t) > 0.0))
    before = [*(int(np.searchsorted(t, t[k])) for k in after[1:]), len(t) - 1]
    return list(zip(after.tolist(), before[: len(after)], strict=True))


def _row(walker: Walker, arc: Arc, k: int, end: int) -> tuple[float, float, Array, Array, Array]:
    """A row of the log: the measurement at node k of an arc, and the mean torque until node `end`.

    Returns t [s], number of the single support, q (n,) [rad], u (p,) [N m], v (n,) [rad/s], with the legs named
    as the controller believes. A walk whose controller detects touchdowns has a `belief`: its number of the
    single support, and other = 1 while its names of the legs are not the true ones.
    """
    q, v, _, tail = parts(walker, arc.x[k])
    held = walker.held
    assert held is not None
    step, other = float(arc.mode.step), 0.0
    if tail.belief is not None:
        step, other = float(tail.belief.step), tail.belief.other
    q, v = held.reading(tail.sensors, *in_other_names(walker, other, q, v))
    nodes = slice(k, end + 1)
    t, acted = arc.t[nodes], motor_torque(parts(walker, arc.x[nodes]).tail.line)
    u = np.trapezoid(acted, t, axis=0) / (t[-1] - t[0])  # also where it is late or lags
    return float(arc.t[k]), step, q, relabelled(u, walker.plant.swap) if other > 0.5 else u, v
