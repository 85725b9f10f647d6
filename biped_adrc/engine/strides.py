"""A loop around a plant that moves by itself, a whole arc at a time, with little Python at a sample instant.

From one sample instant, or edge of a disturbance, to the next the plant makes a stride
(`closed_loop.stepping_plant.StridingPlant`). What is recorded is put together once per arc. Order, statuses and
nodes are those of `hybrid.simulator` and `closed_loop.stepping.SteppingLoop.move`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import Advanced, Contact, PlantState, StridingPlant
from biped_adrc.engine.compiled_push import PlantPush
from biped_adrc.engine.compiled_tick import CompiledTick
from biped_adrc.errors import NotFiniteError
from biped_adrc.hybrid.system import FoundEvent, HybridSystem, Mover
from biped_adrc.hybrid.trajectory import Record
from biped_adrc.types import Array, Indices


class Breaks:
    """What interrupts an arc from t to `until` [s]: sample instants, edges of the disturbance, its end."""

    def __init__(
        self, loop: SteppingLoop, mode: Mode, t: float, t_first: float, until: float, began: float
    ):
        """t_first [s]: start of the run. began [s]: of the arc."""
        self.origin, self.period = began if loop.timing.restart else t_first, loop.timing.period
        self.count = max(0, math.floor((t - self.origin) / self.period))
        while self.origin + self.count * self.period < t:
            self.count += 1
        self.due = self.origin + self.count * self.period
        self.edges = [*sorted(s for s in loop.switching_times(mode) if t < s < until), until]

    def sampled(self, t: float) -> bool:
        """Whether t [s], never asked for twice, is a sample instant."""
        if t != self.due:
            return False
        self.count += 1
        self.due = self.origin + self.count * self.period
        return True

    def after(self, t: float) -> float:
        """The first break after t [s]."""
        while self.edges[0] <= t:
            del self.edges[0]
        return min(self.due, self.edges[0])


@dataclass(frozen=True)
class Stretches:
    """One arc so far: the plant's rows (2 n + k,) at K + 1 times, and what was held in the K stretches."""

    at: Indices
    """Places in x of the plant's row."""
    t: list[float]
    """[s]"""
    rows: list[Array]
    held: list[Array] = field(default_factory=list)
    """x (nx,) after the sample instant and the estimate of xi (p,), in one row; one more row while a stretch
    is being made.
    """

    def add(self, t: float, row: Array) -> None:
        """A stretch to t [s], where the plant is in `row`."""
        self.t.append(t)
        self.rows.append(row)

    def nodes(self, n: int, p: int, lost: bool) -> tuple[Array, Array, Array, Array]:
        """t (2 K,) [s], x, x' (2 K, nx) and the estimate (2 K, p) at both ends of every stretch.

        Slopes of the rates are their differences, since the plant does not give q''. lost: the last node is
        left out.
        """
        t, rows = np.array(self.t), np.array(self.rows)
        twice = np.repeat(np.array(self.held[: len(t) - 1]), 2, axis=0)
        ends = np.repeat(np.arange(len(rows)), 2)[1:-1]
        x, v = twice[:, :-p], rows[:, n : 2 * n]
        x[:, self.at] = rows[ends]
        dx = np.zeros_like(x)
        dx[:, :n] = v[ends]
        dx[:, n : 2 * n] = np.repeat(np.diff(v, axis=0) / np.diff(t)[:, np.newaxis], 2, axis=0)
        kept = len(x) - lost
        if lost:
            dx[-2, n : 2 * n] = 0.0
        return t[ends[:kept]], x[:kept], dx[:kept], twice[:kept, -p:]


@dataclass(frozen=True)
class Strides(HybridSystem):
    """The system for `hybrid.simulator`; without clocks, since sample instants are inside its mover."""

    loop: SteppingLoop
    """Without torques that wait for a fraction of a period."""
    plant: StridingPlant
    """The loop's."""
    code: CompiledTick | None
    """Sample instants in machine code; None for Python."""
    push: PlantPush
    t_first: float
    """Start of the run [s]."""
    began: float | None = None
    """Where the arc did [s], for what goes on from the middle of one."""

    def mover(self, fired: str | None) -> Mover:
        return self.move

    def move(
        self, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, FoundEvent | None]:
        """Over a whole arc from x (nx,) at t [s], as `hybrid.system.Mover`."""
        n, plant, at = self.plant.n, self.plant, self.places(x)
        began = t if self.began is None else self.began
        arc = Stretches(at, [t], [x[at]])
        breaks = Breaks(self.loop, mode, t, self.t_first, until, began)
        try:
            contacts = self.strides(arc, breaks, x, mode, until)
        finally:
            last = self.keep(arc, len(x), mode, record)
        t, row, x = arc.t[-1], arc.rows[-1], last.copy()
        if not contacts:
            return t, x, None
        after = plant.landed(PlantState(t, row[:n], row[n : 2 * n], row[2 * n :]), contacts)
        return t, x, self.loop.found(t, x, mode, Advanced(after, contacts, ()))

    def keep(self, arc: Stretches, nx: int, mode: Mode, record: Record) -> Array:
        """Record the nodes of an arc, and of one that failed at once where it began; the last x (nx,)."""
        n, p = self.plant.n, self.plant.p
        if len(arc.t) == 1:
            x: Array = arc.held[0][:nx] if arc.held else np.zeros(0)
            if arc.held:
                record.add(arc.t[0], x, np.zeros(nx))
            return x
        t, x, dx, xi = arc.nodes(n, p, not self.good(arc.rows[-1]))
        zeta = self.push.zeta(t, x[:, :n], x[:, n : 2 * n], mode)
        record.add(t, x, dx, u=self.loop.motor_torque(x), zeta=zeta, xi_estimate=xi)
        return x[-1]

    def places(self, x: Array) -> Indices:
        """Places in x (nx,) of the plant's row (q, q', own)."""
        assert self.loop.held is not None
        rates, own = 2 * self.plant.n, self.loop.held.sizes.own
        after = rates + self.loop.controller_size(x)
        return np.array([*range(rates), *range(after, after + own)])

    def strides(
        self, arc: Stretches, breaks: Breaks, x: Array, mode: Mode, until: float
    ) -> tuple[Contact, ...]:
        """Sample, move, sample, into `arc`: from x (nx,) to a contact or to `until` [s].

        Raises what ends a run.
        """
        nx, n, p, at = len(x), self.plant.n, self.plant.p, arc.at
        stride, load, t, row = self.plant.stride, self.push.load, arc.t[0], arc.rows[0]
        bounds = self.loop.bounds
        near, slow = bounds.farthest**2, float(np.min(bounds.fastest)) ** 2
        while True:
            held = (self.sampled if breaks.sampled(t) else self.passed)(t, x, mode)
            arc.held.append(held)
            end = breaks.after(t)
            outside = load(0.5 * (t + end), row[:n], row[n : 2 * n], mode)
            row, contacts = stride(t, row, held[nx - p : nx], outside, end)
            arc.add(end, row)
            q = row[:n]
            if not (q.dot(q) < near and row.dot(row) < slow):  # two products test all of them
                self.check(t, end, row)
            if contacts or end >= until:
                return contacts
            t, x = end, held[:nx].copy()
            x[at] = row

    def good(self, row: Array) -> bool:
        """Whether a row is finite, and its angles and rates are within the bounds."""
        n = self.plant.n
        return bool(np.all(np.isfinite(row)) and self.loop.bounds.hold(row[:n], row[n : 2 * n]))

    def check(self, t: float, end: float, row: Array) -> None:
        """Raise what ends a run in `row` at `end` [s], after a stride from t [s]."""
        if not np.all(np.isfinite(row)):
            raise NotFiniteError(f"the state of the plant is not finite after t = {t:.6g} s")
        n = self.plant.n
        self.loop.bounds.check(end, row[:n], row[n : 2 * n])

    def sampled(self, t: float, x: Array, mode: Mode) -> Array:
        """x (nx,) after a sample instant at t [s] and the estimate of xi (p,), in one row."""
        found = None if self.code is None else self.code(t, x, mode)
        return self.passed(t, self.loop.tick(t, x, mode), mode) if found is None else found

    def passed(self, t: float, x: Array, mode: Mode) -> Array:
        """x (nx,) at an edge of a disturbance and the estimate of xi (p,), in one row."""
        return np.concatenate((x, self.loop.estimated(t, x, mode)))
