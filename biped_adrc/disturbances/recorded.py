"""Torques from a recording: straight lines between its rows, zero before the first and from the last on.

    zeta_i(t) = zeta_ij + (s - t_j) (zeta_i,j+1 - zeta_ij) / (t_j+1 - t_j),   t_j <= s < t_j+1,   s = t - start

A corner at a row is no switching time: a step of integration may go across it, since zeta does not jump there.
Where it does jump, at the first row and at the last, none does.

A recording may have thousands of rows, while machine code has arrays of a fixed length. So it is cut into terms
of `PIECES` straight pieces each, of which one acts at a time; all of them share one machine code.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np

from biped_adrc.core.checks import PositiveInt, check_part, numbers
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import CsvTable, reading
from biped_adrc.core.types import Array, read_only
from biped_adrc.disturbances.base import Disturbance, Windowed
from biped_adrc.model.biped import Biped

PIECES = 16
"""Straight pieces in one term of a recording."""


@dataclass(frozen=True)
class Lines(Windowed):
    """One term of a recording, in its window; amplitude (n,) [N m] is the torque where it opens.

    begin, width (PIECES,) [s]: of its pieces, counted from where it opens; slopes (n, PIECES) [N m/s]. Pieces
    that it has not are of width 0.
    """

    begin: Array = field(kw_only=True)
    width: Array = field(kw_only=True)
    slopes: Array = field(kw_only=True)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """zeta (n,) [N m]: the torque where it opens, and what each piece passed has added."""
        s = t - self.onset(t_start)
        return self.amplitude + self.slopes @ np.clip(s - self.begin, 0.0, self.width)


@dataclass(frozen=True)
class RecordedTorque(Disturbance):
    """times (K,) [s] that increase, torques (K, n) [N m]. Read a file with `read`.

    start [s]: where time 0 of the recording is, after the start of single support `step`, with which it then
    ends at the latest; without `step`, after the start of the run. Raises InputError for numbers that are not
    finite, times that do not increase, and a recording that begins before 0.
    """

    times: Array
    """(K,) [s], of the recording's own clock."""
    torques: Array
    """(K, n) [N m]."""
    step: PositiveInt | None = None
    """Single support, counted from 1."""
    start: float = 0.0
    """[s] from the start of that step, or of the run."""

    def __post_init__(self) -> None:
        times = read_only(numbers(self.times, "the times of the recording"))
        torques = read_only(numbers(self.torques, "the torques of the recording"))
        if times.ndim != 1 or torques.ndim != 2 or len(torques) != len(times) or len(times) < 2:
            raise InputError(
                f"the recording has times of shape {times.shape} and torques of shape {torques.shape}, "
                "expected (K,) and (K, n) for K >= 2 rows and n coordinates"
            )
        finite = np.isfinite(times) & np.all(np.isfinite(torques), axis=1)
        bad = np.flatnonzero(~finite | (np.diff(times, prepend=-math.inf) <= 0.0))
        if len(bad):
            raise InputError(
                f"row {bad[0] + 1} of the recording has t = {times[bad[0]]:g} s and torques "
                f"{torques[bad[0]].tolist()} N m, expected finite numbers, and times that increase"
            )
        if not (math.isfinite(self.start) and self.start + times[0] >= 0.0):
            raise InputError(
                f"the recording begins at {self.start + times[0]:g} s, expected a time from 0 on"
            )
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "torques", torques)

    @classmethod
    def read(
        cls, file: str | Path, biped: Biped, step: int | None = None, start: float = 0.0
    ) -> RecordedTorque:
        """The recording in a CSV file: a column `t` [s], and one [N m] for each joint that is named.

        Joints are those of the robot, or q1..qN; the others have no torque. Raises InputError for a file that
        cannot be read, columns other than these, and a line that is not of as many numbers, with its number.
        """
        check_part(file, "the file of a recording", str, Path)
        check_part(biped, "the robot of a recording", Biped)
        check_part(start, "the start of a recording", float)
        with reading("recording", file, InputError):
            table = CsvTable.read(file)
            head = table.head
            if head.count("t") != 1 or len(set(head)) < max(len(head), 2):
                raise InputError(
                    f"its columns are {head}, expected one 't' [s] and different joints, as t,q1,q3"
                )
            columns = {name: table.numbers(k) for k, name in enumerate(head)}
            times = columns.pop("t")
            torques = np.zeros((len(times), biped.n))
            for joint, values in columns.items():
                torques[:, biped.description.joint_index(joint)] += values
            return cls(times, torques, step, start)

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """Where it begins and ends."""
        return tuple((self.step or 0, float(self.start + t)) for t in self.times[[0, -1]])

    @cached_property
    def terms(self) -> tuple[Disturbance, ...]:
        """`Lines` of `PIECES` pieces each."""
        ends = [*range(0, len(self.times) - 1, PIECES), len(self.times) - 1]
        return tuple(self._lines(*part) for part in pairwise(ends))

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        return self.zeta(t, step, t_start, q, v)

    def _lines(self, first: int, last: int) -> Lines:
        """The pieces from one row to another."""
        t, zeta = self.times[first : last + 1], self.torques[first : last + 1]
        begin, width = np.zeros(PIECES), np.zeros(PIECES)
        slopes = np.zeros((zeta.shape[1], PIECES))
        begin[: len(t) - 1], width[: len(t) - 1] = t[:-1] - t[0], np.diff(t)
        slopes[:, : len(t) - 1] = (np.diff(zeta, axis=0) / np.diff(t)[:, np.newaxis]).T
        opens, closes = float(self.start + t[0]), float(self.start + t[-1])
        return Lines(zeta[0], self.step, opens, closes, begin=begin, width=width, slopes=slopes)
