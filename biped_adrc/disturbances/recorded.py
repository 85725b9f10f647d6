"""Torques from rows of numbers: a recording, interpolated linearly, and pushes by a person with the mouse.

    zeta_i(t) = zeta_ij + (s - t_j) (zeta_i,j+1 - zeta_ij) / (t_j+1 - t_j),   t_j <= s < t_j+1,   s = t - start

for a recording, with zeta_ij [N m] the torque on coordinate i in row j, t_j [s] the time of that row, and
`start` [s] the time at which the recording begins; zero before its first row and from the last on. A corner at
a row is no switching time: a step of integration may go across it, since zeta does not jump there. It does jump
at the first row and at the last, and steps end there.

    zeta(t) = tau_k + J(q)' F_k,     t_k <= t - t_start < t_k+1

for pushes by hand: in row k torques tau_k (n,) on the coordinates, and a force F_k on a point of a link with
the Jacobian J, constant from row to row. t_start [s] is the time at which the single support of the rows began.
The rows belong to one single support, and the last one lasts until its end. The page on which a person pushes a
walking robot (`extras.play`) records them, one row for each sample in which the push changed. zeta jumps at
each row, so each is a switching time. "Hand" below stands for such pushes.

Both may have thousands of rows, while machine code has arrays of a fixed length. So they are cut into terms of
`PIECES` rows each, which share one machine code; only one term of a recording acts at a time.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.core.checks import PositiveInt, check_part, numbers
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import CsvTable, reading
from biped_adrc.core.types import Array, read_only
from biped_adrc.disturbances.base import Disturbance, Sum, Windowed
from biped_adrc.disturbances.force import OnLink
from biped_adrc.model.biped import Biped

PIECES = 16
"""Number of rows of a hand, or of linear pieces of a recording, in one term."""


@dataclass(frozen=True)
class Lines(Windowed):
    """One term of a recording: a piecewise linear torque in its window, amplitude (n,) [N m] at its beginning.

    begin, width (PIECES,) [s]: of its pieces, counted from where the window opens; slopes (n, PIECES) [N
    m/s]. Unused pieces have width 0.
    """

    begin: Array = field(kw_only=True)
    width: Array = field(kw_only=True)
    slopes: Array = field(kw_only=True)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta (n,) [N m]: the torque at the beginning plus the change over all pieces passed."""
        s = t - self.onset(t_start)
        # the clip is the time spent in each piece so far: 0 before it, its width after it
        return self.amplitude + self.slopes @ np.clip(s - self.begin, 0.0, self.width)


@dataclass(frozen=True)
class RecordedTorque(Disturbance):
    """A torque recorded as rows: times (K,) [s] of its own clock, increasing, and torques (K, n) [N m].

    start [s]: when time 0 of the recording is, after the start of single support `step`, from 1, with which it
    then ends at the latest; without `step`, after the start of the run. Make one from a file with `read`.
    Raises InputError for numbers that are not finite, times that do not increase, and a recording that begins
    before 0.
    """

    times: Array
    torques: Array
    step: PositiveInt | None = None
    start: float = 0.0

    def __post_init__(self) -> None:
        times = read_only(numbers(self.times, "the times of the recording"))
        torques = read_only(numbers(self.torques, "the torques of the recording"))
        if times.ndim != 1 or torques.ndim != 2 or len(torques) != len(times) or len(times) < 2:
            raise InputError(
                f"times of shape {times.shape} and torques of {torques.shape}, expected (K,) and (K, n), K >= 2"
            )
        finite = np.isfinite(times) & np.all(np.isfinite(torques), axis=1)
        # -inf in front of the times, so that the first row counts as later than the one before
        bad = np.flatnonzero(~finite | (np.diff(times, prepend=-math.inf) <= 0.0))
        if len(bad):
            raise InputError(
                f"row {bad[0] + 1} of the recording has t = {times[bad[0]]:g} s and torques "
                f"{torques[bad[0]].tolist()} N m, expected finite numbers, and times that increase"
            )
        if not 0.0 <= (begin := self.start + times[0]) < math.inf:
            raise InputError(f"the recording begins at {begin:g} s, expected a time from 0 on")
        vars(self).update(times=times, torques=torques)

    @classmethod
    def read(
        cls, file: str | Path, biped: Biped, step: int | None = None, start: float = 0.0
    ) -> RecordedTorque:
        """Read a recording from a CSV file: a column `t` [s], and one [N m] for each joint that is named.

        Joints are those of the robot, or q1..qN; the others have no torque. Raises InputError for a file that
        cannot be read, columns other than these, and a line that is not of as many numbers, with its number.
        """
        check_part(file, "the file of a recording", str, Path)
        check_part(biped, "the robot of a recording", Biped)
        with reading("recording", file, InputError):
            table = CsvTable.read(file)
            head = table.head
            # one column t, no name twice, and at least one joint
            if head.count("t") != 1 or len(set(head)) < max(len(head), 2):
                raise InputError(f"columns {head}, expected one 't' [s] and different joints")
            columns = {name: table.numbers(k) for k, name in enumerate(head)}
            # += below, since one joint may have two columns, by its name and as q_i: they add up
            times = columns.pop("t")
            torques = np.zeros((len(times), biped.n))
            for joint, values in columns.items():
                torques[:, biped.description.joint_index(joint)] += values
            return cls(times, torques, step, start)

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """The beginning and the end, where it jumps, as (step, or 0 for the run; time [s] since it began)."""
        return tuple((self.step or 0, float(self.start + t)) for t in self.times[[0, -1]])

    @cached_property
    def terms(self) -> tuple[Disturbance, ...]:
        """The recording as `Lines` of up to `PIECES` pieces; the last row of each is the first of the next."""
        ends = [*range(0, len(self.times) - 1, PIECES), len(self.times) - 1]
        return tuple(self._lines(*part) for part in pairwise(ends))

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        # zeta of the base class is the sum over `terms`, each in its window
        return self.zeta(t, step, t_start, q, v)

    def _lines(self, first: int, last: int) -> Lines:
        """The term with the linear pieces from row `first` to row `last`; unused pieces have width 0."""
        t, zeta = self.times[first : last + 1], self.torques[first : last + 1]
        begin, width = np.zeros(PIECES), np.zeros(PIECES)
        slopes = np.zeros((zeta.shape[1], PIECES))
        begin[: len(t) - 1], width[: len(t) - 1] = t[:-1] - t[0], np.diff(t)
        slopes[:, : len(t) - 1] = (np.diff(zeta, axis=0) / np.diff(t)[:, np.newaxis]).T
        opens, closes = float(self.start + t[0]), float(self.start + t[-1])
        return Lines(zeta[0], self.step, opens, closes, begin=begin, width=width, slopes=slopes)


@dataclass(frozen=True)
class HeldRows(Windowed):
    """One term of a hand: piecewise constant in its window, with its first row as amplitude.

    times (PIECES,) [s]: of its rows, since single support `step` began; infinite for rows that are not used.
    jumps (size, PIECES): change at each of them, 0 at the first, in [N m] for size = n torques, or in [N, N, N
    m] for (F_x, F_z, M), size = 3, as the wave of an `OnLink`.
    """

    times: Array = field(kw_only=True)
    jumps: Array = field(kw_only=True)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        # 1 for each row whose time has come, whose jump counts then
        past = 1.0 * (t >= t_start + self.times)
        return self.amplitude + self.jumps @ past

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        # (step, or 0 for the run; time [s] since it began); a set, as the first row is at `start`
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
    """Make the disturbance of a hand that pushes in single support `step`, constant from row to row.

    times (K,) [s]: of the rows, since the single support began; the last row acts until its end. torques (K, n)
    [N m]: on the coordinates, empty for none. forces (K, 2) [N]: (F_x, F_z) on `point` (x, z) [m] in the frame
    of the link `on`; not read where `on` is None. The result is the sum of torques and force.

    Raises InputError for rows that are not as many as times, and times that do not increase from 0.
    """
    t = numbers(times, "the times of the hand")
    if t.ndim != 1 or not len(t) or t[0] < 0.0 or np.any(np.diff(t) <= 0.0):
        raise InputError(f"the times of the hand are {t}, expected numbers that increase from 0")
    result = list[Disturbance](_terms("torques", torques, t, step, biped.n))
    if on is not None:
        # moment=1 puts the moment M = 0 behind (F_x, F_z), since OnLink takes (F_x, F_z, M)
        pieces = _terms("forces", forces, t, step, 2, moment=1)
        result += [OnLink(biped, on, piece, (point[0], point[1])) for piece in pieces]
    return Sum(tuple(result))


def _terms(
    what: str, rows: ArrayLike, t: Array, step: int, size: int, moment: int = 0
) -> list[HeldRows]:
    """Cut rows (K, size) at times t (K,) [s] into terms of PIECES rows.

    size: numbers in a row. moment: number of zeros put behind each row: 1 for forces (F_x, F_z), which become
    (F_x, F_z, M), 0 for torques. what: name of the rows for messages. No rows give no terms. A term ends where
    the next begins, the last one never, so that the last row acts until the end of single support `step`.
    """
    y = numbers(rows, f"the {what} of the hand")
    if not y.size:
        return []
    if y.shape != (len(t), size) or not np.all(np.isfinite([*y.ravel(), *t])):
        shape = f"{y.shape}, expected finite numbers ({len(t)}, {size})"
        raise InputError(f"{what} of the hand have the shape {shape}")
    y, windows = np.pad(y, ((0, 0), (0, moment))), list[HeldRows]()
    for first, last in pairwise([*range(0, len(t), PIECES), len(t)]):
        # times of unused rows stay inf, so they never come
        at, jumps = np.full(PIECES, np.inf), np.zeros((size + moment, PIECES))
        at[: last - first] = t[first:last]
        jumps[:, 1 : last - first] = np.diff(y[first:last], axis=0).T
        stop = float(t[last]) if last < len(t) else np.inf
        windows.append(HeldRows(y[first], step, float(t[first]), stop, times=at, jumps=jumps))
    return windows
