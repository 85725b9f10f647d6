"""What a hand did: torques on the coordinates, and a force on a point of a link, held from row to row.

    zeta(t) = tau_k + J(q)' F_k,     t_k <= t - t_start < t_k+1

in one single support, whose end is the end of the last row. It is what a page on which a walk is pushed writes
down (`extras.play`): one row for each sample in which the hand changed.

Rows jump, so each is a switching time. As a recording, they are cut into terms of `PIECES` rows, which share
one machine code.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.core.checks import numbers
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Disturbance, Sum, Windowed
from biped_adrc.disturbances.link import OnLink
from biped_adrc.model.biped import Biped

PIECES = 16
"""Rows in one term."""


@dataclass(frozen=True)
class HeldRows(Windowed):
    """One term of a hand, in its window; amplitude is its first row.

    times (PIECES,) [s]: of its rows, counted as `start`. jumps (size, PIECES): what each of them adds.
    """

    times: Array = field(kw_only=True)
    jumps: Array = field(kw_only=True)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        past = 1.0 * (t >= t_start + self.times)
        return self.amplitude + self.jumps @ past

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        ends = {self.start, *self.times.tolist(), self.stop}
        return tuple((self.step or 0, float(s)) for s in sorted(ends) if np.isfinite(s))


def by_hand(
    biped: Biped,
    step: int,
    times: ArrayLike,
    torques: ArrayLike = (),
    on: str | None = None,
    point: tuple[float, float] = (0.0, 0.0),
    forces: ArrayLike = (),
) -> Disturbance:
    """What a hand did in single support `step`: torques (K, n) [N m] from times (K,) [s] on, counted in it, and
    forces (K, 2) [N] on `point` (x, z) [m] of the link `on`.

    Raises InputError for rows that are not as many as times, and times that do not increase from 0.
    """
    t = numbers(times, "the times of the hand")
    if t.ndim != 1 or not len(t) or t[0] < 0.0 or np.any(np.diff(t) <= 0.0):
        raise InputError(f"the times of the hand are {t}, expected numbers that increase from 0")
    result = list[Disturbance](_terms("torques", torques, t, step, biped.n))
    if on is not None:
        pieces = _terms("forces", forces, t, step, 2, moment=1)
        result += [OnLink(biped, on, piece, (point[0], point[1])) for piece in pieces]
    return Sum(tuple(result))


def _terms(
    what: str, rows: ArrayLike, t: Array, step: int, size: int, moment: int = 0
) -> list[HeldRows]:
    """Rows (K, size) in terms of PIECES, with so many zeros behind each; none of no rows."""
    y = numbers(rows, f"the {what} of the hand")
    if not y.size:
        return []
    if y.shape != (len(t), size) or not np.all(np.isfinite([*y.ravel(), *t])):
        raise InputError(
            f"the {what} of the hand have shape {y.shape}, expected finite numbers ({len(t)}, {size})"
        )
    y, windows = np.pad(y, ((0, 0), (0, moment))), list[HeldRows]()
    for first, last in pairwise([*range(0, len(t), PIECES), len(t)]):
        at, jumps = np.full(PIECES, np.inf), np.zeros((size + moment, PIECES))
        at[: last - first] = t[first:last]
        jumps[:, 1 : last - first] = np.diff(y[first:last], axis=0).T
        stop = float(t[last]) if last < len(t) else np.inf
        windows.append(HeldRows(y[first], step, float(t[first]), stop, times=at, jumps=jumps))
    return windows
