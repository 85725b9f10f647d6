"""A gait in one angle convention as plain arrays, the form in which gaits are exchanged.

    y(s) = H0 q'(s),   s = (theta - theta+) / (theta- - theta+),   theta = c' q'

The rows of `coefficients` are y: by default the outputs of the convention, or all of its coordinates, which the
number of rows tells. The record checks itself when it is made (shapes, finite numbers, a phase range), so that
`convert` and `closure` need not; whether the numbers are a gait is for `closure` to say.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from biped_adrc.errors import GaitError
from biped_adrc.gait.conventions import CONVENTIONS, OWN, Convention, convention
from biped_adrc.gait.curves import Curve, curve_kind
from biped_adrc.shown import Shown
from biped_adrc.types import Array, read_only

_COORDINATES = {5: True, 3: False}
"""By the number of coordinates, whether the robot has knees."""


@dataclass(frozen=True)
class GaitRecord(Shown):
    """A gait of a robot with n coordinates in one angle convention.

        record = GaitRecord("frost", alpha, theta_plus=-0.25, theta_minus=0.25, name="from FROST")
        gait = ba.import_gait(record, biped)

    Only convention, coefficients and the range of the phase are needed; everything else has a default or
    follows from the robot when the record is imported. Raises GaitError that names the entry, what was found,
    what was expected and what to try.
    """

    convention: str
    """Name of the angle convention, of `conventions.CONVENTIONS`."""
    coefficients: Array
    """Of the curves (rows, M + 1) [rad], one row per output or per coordinate."""
    theta_plus: float
    """[rad] just after impact."""
    theta_minus: float
    """[rad] just before the next impact."""
    phase: Array | None = None
    """c' (n,); the convention's own row when None."""
    outputs: Array | None = None
    """H0 (rows, n); the convention's own outputs, or all coordinates, when None."""
    curve: str = "bezier"
    """Kind of the curves, "bezier" or "polynomial"."""
    reverse: bool = False
    """True if the first coefficients belong to the end of the step (s runs from 1 to 0)."""
    q_minus: Array | None = None
    """(n,) just before impact [rad], in this convention; from the zero dynamics when None."""
    v_minus: Array | None = None
    """(n,) just before impact [rad/s]; given together with q_minus."""
    period: float | None = None
    """Duration of a step [s]; from the zero dynamics when None."""
    slope: float = 0.0
    """Of the ground [rad], positive downhill."""
    name: str = "imported"
    robot: str = ""
    preset: str = ""
    provenance: Mapping[str, object] = field(default_factory=dict)
    """Where the gait comes from, free text by name."""
    own: Convention | None = field(default=None, repr=False)
    """The robot's coordinates, `own_convention(biped)`, for the convention "own"."""

    def __post_init__(self) -> None:
        curve_kind(self.curve)
        for key in ("coefficients", "phase", "q_minus", "v_minus", "outputs"):
            value = getattr(self, key)
            if value is not None or key == "coefficients":
                dimensions = 2 if key in ("coefficients", "outputs") else 1
                object.__setattr__(self, key, self._array(key, value, dimensions))
        self._check_phase_range()
        layout = self.layout
        for key in ("phase", "q_minus", "v_minus"):
            value = getattr(self, key)
            if value is not None and value.shape != (layout.n,):
                raise self.error(
                    f"{key} has {len(value)} numbers, expected {layout.n}: {', '.join(layout.coordinates)}"
                )
        if (self.q_minus is None) != (self.v_minus is None):
            raise self.error("only one of q_minus and v_minus is given; give both or neither")

    @property
    def layout(self) -> Convention:
        """The convention, with knees or without, as the number of rows tells. Raises GaitError."""
        rows = self.coefficients.shape[0]
        if self.convention == OWN:
            return self._of_robot(rows)
        if self.outputs is not None:
            n = self.outputs.shape[1]
            if n not in _COORDINATES or self.outputs.shape[0] != rows:
                raise self.error(
                    f"outputs have shape {self.outputs.shape} for {rows} rows of coefficients; expected "
                    f"({rows}, 5), or ({rows}, 3) without knees"
                )
            return convention(self.convention, _COORDINATES[n])
        both = (convention(self.convention, knees) for knees in (True, False))
        fitting = [known for known in both if rows in _row_counts(known)]
        if not fitting:
            raise self._wrong_rows(rows)
        return fitting[0]

    @property
    def of_all_coordinates(self) -> bool:
        """True where the rows are the n coordinates themselves rather than outputs."""
        return self.outputs is None and self.coefficients.shape[0] == self.layout.n

    @property
    def curve_of_rows(self) -> Curve:
        """The curve y(s) of the rows [rad]."""
        return curve_kind(self.curve)(self.coefficients)

    def error(self, text: str) -> GaitError:
        """An error that names the gait and its convention."""
        return GaitError(f"gait '{self.name}' in convention '{self.convention}': {text}")

    def _of_robot(self, rows: int) -> Convention:
        """The robot's own coordinates. Raises GaitError."""
        if self.own is None:
            raise self.error(
                "the robot is not known; give own=own_convention(biped), or import_gait"
            )
        n = self.own.n if self.outputs is None else self.outputs.shape[1]
        counts = (len(self.own.outputs), n) if self.outputs is None else (len(self.outputs),)
        if n != self.own.n or rows not in counts:
            raise self.error(
                f"coefficients have {rows} rows for {self.own.source}, expected {counts[0]}, one per motor, or "
                f"{self.own.n}, one per coordinate ({', '.join(self.own.coordinates)}); rows are joints, "
                "columns k = 0..M"
            )
        return self.own

    def _wrong_rows(self, rows: int) -> GaitError:
        """The error for a number of rows that the convention does not have.

        The likely cause is another convention that has so many rows, or a matrix that is transposed.
        """
        takes = _counts_of(self.convention)
        others = [name for name in CONVENTIONS if rows in _counts_of(name)]
        columns = self.coefficients.shape[1]
        if others:
            cause = (
                f"the conventions {others} take {rows}: try one of them, or give all coordinates"
            )
        elif columns in takes:
            cause = f"it has {columns} columns, so it may be transposed: rows are joints, columns k = 0..M"
        else:
            cause = "give one row per joint, or the matrix `outputs` that makes the rows from the coordinates"
        expected = " or ".join(str(count) for count in takes)
        return self.error(f"coefficients have {rows} joints (rows), expected {expected}; {cause}")

    def _array(self, key: str, value: object, dimensions: int) -> Array:
        """An entry as a read-only real array of so many dimensions.

        Raises GaitError that says what is wrong.
        """
        try:
            a = np.array(value)
            if np.iscomplexobj(a):
                raise TypeError("its numbers are complex")
            a = read_only(a)
        except (TypeError, ValueError) as error:
            raise self.error(f"{key} is not an array of real numbers: {error}") from error
        if a.ndim != dimensions or a.size == 0 or (key == "coefficients" and a.shape[1] < 2):
            shape = "(joints, degree + 1) with degree >= 1" if dimensions == 2 else "one row"
            raise self.error(f"{key} has shape {a.shape}, expected {shape}")
        if not np.all(np.isfinite(a)):
            where = tuple(int(i) for i in np.argwhere(~np.isfinite(a))[0])
            kinds = ("joint", "column") if a.ndim == 2 else ("entry",)
            what = ", ".join(f"{kind} {i + 1}" for kind, i in zip(kinds, where, strict=True))
            raise self.error(
                f"{key}: {what} (counted from 1) is {a[where]}, expected finite numbers; was the file "
                "written by an optimisation that did not converge?"
            )
        return a

    def _check_phase_range(self) -> None:
        """Make the scalar entries floats.

        Raises GaitError for one that is not finite or a range without extent.
        """
        for key in ("theta_plus", "theta_minus", "period", "slope"):
            value = getattr(self, key)
            if key == "period" and value is None:
                continue
            try:
                number = float(value)
            except (TypeError, ValueError):
                number = math.nan
            if not math.isfinite(number):
                raise self.error(f"{key} is {value}, expected one finite number")
            object.__setattr__(self, key, number)
        if self.theta_plus == self.theta_minus:
            raise self.error(
                f"theta_plus and theta_minus are both {self.theta_plus} rad, expected two different ends; a "
                "normalised s in [0, 1] needs the phase at s = 0 and at s = 1"
            )


def _counts_of(name: str) -> tuple[int, ...]:
    """Numbers of rows that a gait may have in a convention, with knees and without."""
    return tuple(k for knees in (True, False) for k in _row_counts(convention(name, knees)))


def _row_counts(c: Convention) -> tuple[int, ...]:
    """Numbers of rows a gait may have without `outputs`."""
    return tuple(sorted({c.outputs.shape[0], c.n}))
