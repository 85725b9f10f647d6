"""A gait from samples of one step over time, as optimisers write them: t (K,), q (K, n), and perhaps q' (K, n).

The step runs from just after an impact to just before the next. Over Theta = c q every actuated joint is fitted
with a Bezier curve by least squares. Its two ends are not fitted but set, so that the gait closes and is
hybrid-invariant:

    h(1) = q_b(K),  h(0) = (R q(K))_b,  dh/dTheta(1): of the samples,  dh/dTheta(0): after the impact

The orbit and its period then come from the zero dynamics of the robot.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import GaitError, InputError
from biped_adrc.files import number_in, reading
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.conventions import OWN, Convention
from biped_adrc.gait.curves import Bezier
from biped_adrc.gait.exchange.closure import LARGEST, SLOPES
from biped_adrc.gait.exchange.convert import whole_turns
from biped_adrc.gait.gait import CLOSES, Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.parts import check_part, numbers
from biped_adrc.shown import one_line
from biped_adrc.types import Array

FITS = 5e-3
"""[rad]: largest distance of a sample from the curve in a fit that is good."""
LASTS = 0.05
"""Largest relative gap between the time that samples take and the period of the zero dynamics."""
DEGREES = range(4, 13)


class Samples(NamedTuple):
    """One step in the coordinates of the robot: t (K,) [s], q (K, n) [rad], v (K, n) [rad/s] or None."""

    t: Array
    q: Array
    v: Array | None = None

    def __repr__(self) -> str:
        return one_line(self)


def gait_of_samples(
    samples: Samples,
    biped: Biped,
    layout: Convention,
    degree: int = 6,
    slope: float = 0.0,
    name: str = "samples",
    source: str = "arrays",
) -> Gait:
    """The gait whose curves of this degree run through the samples, which are in the coordinates of `layout`.

    slope [rad]: of the ground. Raises InputError for arrays that are no samples of a step, and GaitError where
    they do not close through the impact of this robot, where the fit is bad, or where the zero dynamics take
    another time for the step than the samples.
    """
    check_part(biped, "biped", Biped)
    if degree not in DEGREES:
        raise InputError(f"the degree is {degree}, expected {DEGREES[0]} to {DEGREES[-1]}")
    s = _in_robot(_checked(samples, layout.n, degree), layout)
    _check_closure(s, biped)
    fitted = _fitted(s, biped, degree)
    joint, at, gap = _missed(fitted, s, biped)
    if gap > FITS:
        raise _bad_fit(s, biped, degree)
    provenance = {
        "method": f"Bezier curves of degree {degree} fitted to {len(s.t)} samples over time",
        "source": source,
        "misses the samples by at most": f"{gap:.2g} rad, {biped.description.joints[joint]} at {at:.4g} s",
    }
    gait = Gait.of_cycle(name, ZeroDynamics.of(biped, fitted), provenance, slope)
    _check_period(s, gait, biped)
    return gait.check(biped)


def _checked(samples: Samples, n: int, degree: int) -> Samples:
    """As float arrays of one step. Raises InputError."""
    t, q = numbers(samples.t, "t of the samples"), numbers(samples.q, "q of the samples")
    v = None if samples.v is None else numbers(samples.v, "q' of the samples")
    for what, x in (("q", q), ("q'", v)):
        if x is not None and x.shape != (len(np.atleast_1d(t)), n):
            raise InputError(
                f"{what} of the samples has shape {x.shape}, expected ({t.size}, {n}): a row for each time, a "
                "column for each coordinate"
            )
    finite = all(np.all(np.isfinite(x)) for x in (t, q, v) if x is not None)
    if not finite or t.ndim != 1 or len(t) <= degree or not np.all(np.diff(t) > 0.0):
        raise InputError(
            f"the samples are {t.size} times; expected finite numbers at more than {degree} times t "
            "(K,) that grow"
        )
    if np.max(np.abs(q)) > LARGEST:
        raise InputError(
            f"an angle of the samples is {np.max(np.abs(q)):.5g}, expected radians, at most {LARGEST:.4g}"
        )
    return Samples(t, q, v)


def _in_robot(s: Samples, layout: Convention) -> Samples:
    """In the robot's coordinates, with whole turns as the gaits of the package have them."""
    q = layout.to_paper.angles(s.q)
    if layout.name != OWN:
        q = q + 2.0 * np.pi * whole_turns(q[len(q) // 2])
    return Samples(s.t, q, None if s.v is None else layout.to_paper.rates(s.v))


def _check_closure(s: Samples, biped: Biped) -> None:
    """Raise GaitError where Theta turns back, or the last sample, relabelled, is not the first."""
    theta = s.q @ np.array(biped.description.phase)
    along = np.diff(theta) * np.sign(theta[-1] - theta[0])
    if not np.all(along > 0.0):
        k = int(np.argmin(along))
        raise GaitError(
            f"the samples: Theta turns back at t = {s.t[k]:.4g} s ({theta[k]:.5g} to {theta[k + 1]:.5g} rad), "
            "expected one step in which it only grows or falls; leave out samples of other steps, and look at "
            "order and sign of the joints"
        )
    begin, end = s.q[0], biped.relabel(s.q[-1])
    joint = int(np.argmax(np.abs(begin - end)))
    if abs(begin[joint] - end[joint]) > CLOSES:
        raise GaitError(
            f"the samples do not close: {biped.description.joints[joint]} begins at {begin[joint]:.6g} rad, "
            f"and the end of the step with the legs changed over is {end[joint]:.6g} rad, expected the same "
            f"within {CLOSES:g}; the first sample has to be just after an impact and the last just before the "
            "next, in the order and signs of the joints of the robot"
        )


def _fitted(s: Samples, biped: Biped, degree: int) -> VirtualConstraint:
    """The curve through the ends, with their slopes, and nearest to what is between. Raises GaitError."""
    c, p = np.array(biped.description.phase), biped.p
    minus = s.q[-1]
    ends = float(c @ biped.relabel(minus)), float(c @ minus)
    span = ends[1] - ends[0]
    x = (s.q @ c - ends[0]) / span
    H, dH, _ = (np.array(rows) for rows in zip(*map(Bezier(np.eye(degree + 1)), x), strict=True))
    slopes = None if s.v is None else span * s.v / (s.v @ c)[:, np.newaxis]
    rows, goal = (H, s.q) if slopes is None else (np.vstack((H, dH)), np.vstack((s.q, slopes)))
    last = _end_slope(rows, goal, degree) if slopes is None else slopes[-1]
    impact = biped.impact(minus, np.sign(span) * last / span)
    first = span * impact.v / float(c @ impact.v)
    _check_slopes(first, slopes, biped)
    a = np.zeros((degree + 1, p))
    a[0], a[-1] = impact.q[:p], minus[:p]
    a[1], a[-2] = a[0] + first[:p] / degree, a[-1] - last[:p] / degree
    inner = slice(2, degree - 1)
    rest = goal[:, :p] - rows @ a
    a[inner] = np.linalg.lstsq(rows[:, inner], rest, rcond=None)[0]
    return VirtualConstraint(Bezier(a.T), c, *ends)


def _end_slope(rows: Array, goal: Array, degree: int) -> Array:
    """dq/ds (n,) at s = 1 of a fit with free ends."""
    a = np.linalg.lstsq(rows, goal, rcond=None)[0]
    return np.asarray(degree * (a[-1] - a[-2]))


def _check_slopes(first: Array, slopes: Array | None, biped: Biped) -> None:
    """Raise GaitError where the samples do not begin as the impact at their end leaves the robot."""
    if slopes is None:
        return
    span = float(np.array(biped.description.phase) @ slopes[0])
    jump = (slopes[0] - first) / span
    joint = int(np.argmax(np.abs(jump)))
    if abs(jump[joint]) > SLOPES:
        raise GaitError(
            f"the samples do not begin as the impact at their end leaves robot '{biped.description.name}', "
            f"preset '{biped.preset}': {biped.description.joints[joint]} by {slopes[0][joint] / span:.5g} "
            f"rad/rad over Theta, after the impact it is {first[joint] / span:.5g}, expected the same within "
            f"{SLOPES:g}; take the robot with the masses that the samples were made with, or samples of a "
            "periodic step"
        )


def _missed(h: VirtualConstraint, s: Samples, biped: Biped) -> tuple[int, float, float]:
    """Joint and time [s] of the sample that is farthest from the curve, and how far [rad]."""
    gaps = np.abs(h.over(s.q @ h.phase) - s.q[:, : biped.p])
    k, joint = np.unravel_index(int(np.argmax(gaps)), gaps.shape)
    return int(joint), float(s.t[k]), float(gaps[k, joint])


def _bad_fit(s: Samples, biped: Biped, degree: int) -> GaitError:
    """What the fit misses, and which degree would do."""
    joint, at, gap = _missed(_fitted(s, biped, degree), s, biped)
    higher = range(degree + 1, min(len(s.t), DEGREES.stop))
    better = [m for m in higher if _missed(_fitted(s, biped, m), s, biped)[2] <= FITS]
    do = f"degree {better[0]} would do" if better else "no degree up to 12 does; are they smooth?"
    return GaitError(
        f"the fit is bad: curves of degree {degree} miss the samples of {biped.description.joints[joint]} by "
        f"{gap:.2g} rad at t = {at:.4g} s, expected at most {FITS:g} rad; {do}"
    )


def _check_period(s: Samples, gait: Gait, biped: Biped) -> None:
    """Raise GaitError where the robot would take another time for these curves."""
    lasted = float(s.t[-1] - s.t[0])
    if abs(gait.period - lasted) > LASTS * lasted:
        raise GaitError(
            f"the samples last {lasted:.4g} s, and robot '{biped.description.name}', preset '{biped.preset}', "
            f"takes {gait.period:.4g} s for the same curves in its own cycle, expected the same within "
            f"{100.0 * LASTS:g} %; the fit is good, so the samples are of other masses, another gravity, or of "
            "no periodic step"
        )


def read_csv(path: Path) -> dict[str, Array]:
    """t (K,), q (K, n) and, where there are such columns, v (K, n) of a CSV file with a first line of names.

    Columns are t, q1 .. qn and v1 .. vn, with or without units behind a space; others are left alone. Raises
    InputError.
    """
    with reading("samples", path, InputError):
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = csv.reader(file)
            read = [(lines.line_num, row) for row in lines if row]
        (_, header), *rows = read or [(1, [])]
        names = [name.strip().partition(" ")[0] for name in header]
        wanted = {"t": ["t"]}
        for letter in "qv":
            numbered = [name for name in names if re.fullmatch(letter + "[1-9][0-9]*", name)]
            wanted |= {letter: sorted(numbered, key=lambda name: int(name[1:]))} if numbered else {}
        missing = [name for name in ("t", "q1") if name not in names]
        if missing or not rows:
            lacks = f"no column '{missing[0]}'" if missing else "no row of numbers"
            raise InputError(
                f"it has {lacks}; its first line is {header}, expected names t, q1, q2, ... and perhaps v1, "
                "v2, ..., and numbers below"
            )
        for line, row in rows:
            if len(row) != len(names):
                raise InputError(
                    f"line {line} has {len(row)} entries, expected {len(names)}: {names}"
                )
        found = {
            key: np.array(
                [[number_in(row[names.index(x)], line, x) for x in of] for line, row in rows]
            )
            for key, of in wanted.items()
        }
        return {"t": found.pop("t")[:, 0], "q": found.pop("q"), **found}
