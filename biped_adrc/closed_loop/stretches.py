"""The record of one arc of a plant that moves by itself, stretch after stretch.

A stretch goes from a sample instant or an edge of a disturbance to the next. What is recorded at its nodes is
put together once per arc, since a stretch costs microseconds.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc, Event, Record

if TYPE_CHECKING:
    from biped_adrc.closed_loop.stepping import SteppingLoop


@dataclass
class Stretches(Record):
    """Points that the plant passes: both ends of every stretch, and what it tells of in between."""

    loop: SteppingLoop = field(kw_only=True)
    rows: list[Array] = field(default_factory=list)
    """The plant's (q, q', own) (2 n + k,) at every point."""
    zeta: list[Array] = field(default_factory=list)
    """(n,) [N m] at every point, where Python computes it."""
    begins: list[int] = field(default_factory=list)
    """First point of every stretch, the last one of the stretch before."""
    held: list[tuple[Array, Array]] = field(default_factory=list)
    """x (nx,) and the estimate of xi (p,) [rad/s^2] at the start of every stretch."""

    def row(self, x: Array) -> Array:
        """The plant's row of x (nx,) at the last point, or at the start of the arc."""
        if self.rows:
            return self.rows[-1]
        return np.concatenate((x[: 2 * self.loop.plant.n], x[self.loop.own_places]))

    def begin(self, t: float, row: Array, x: Array, xi: Array, mode: Mode) -> None:
        """A stretch begins at t [s]."""
        if not self.rows:
            self.point(t, row, mode)
        self.begins.append(len(self.t) - 1)
        self.held.append((x, xi))

    def point(self, t: float, row: Array, mode: Mode) -> None:
        """The plant passes a row at t [s]."""
        if self.loop.pushed_in_python:
            n = self.loop.plant.n
            self.zeta.append(self.loop.load(t, row[:n], row[n : 2 * n], mode).zeta)
        self.t.append(t)
        self.rows.append(row)

    def arc(self, mode: Mode, event: Event | None) -> Arc:
        """Both ends and each `every`-th point of every stretch as one arc.

        Read are the motors' torque (p,), zeta (n,) [N m] and the estimate (p,) [rad/s^2]. Slopes of the rates
        are their differences, since the plant does not give q''.
        """
        if not self.rows:
            return super().arc(mode, event)
        n, t, rows = self.loop.plant.n, np.array(self.t), np.array(self.rows)
        counts = np.diff(self.begins, append=len(t) - 1) + 1
        ends = np.cumsum(counts) - 1
        at = np.arange(ends[-1] + 1) - np.repeat(np.arange(len(counts)), counts)
        steps = at.copy()
        steps[ends[counts > 1]] -= 1
        v = rows[:, n : 2 * n]
        a = np.vstack((np.diff(v, axis=0) / np.diff(t)[:, np.newaxis], np.zeros(n)))
        x, xi = (np.repeat(np.array(part), counts, axis=0) for part in zip(*self.held, strict=True))
        x[:, : 2 * n], x[:, self.loop.own_places] = rows[at, : 2 * n], rows[at, 2 * n :]
        dx = np.zeros_like(x)
        dx[:, :n], dx[:, n : 2 * n] = v[at], a[steps]
        kept = (np.arange(len(at)) - np.repeat(ends - counts + 1, counts)) % self.every == 0
        kept[ends] = True
        zeta = np.array(self.zeta) if self.zeta else self.loop.zetas(t, rows, mode)
        read = {"u": self.loop.motor_torque(x), "zeta": zeta[at], "xi_estimate": xi}
        read = {name: result[kept] for name, result in read.items()}
        return Arc(mode, t[at][kept], x[kept], dx[kept], event, read)
