"""Which reading of a log fits the model: as it stands, with the legs exchanged, other signs, or degrees.

On windows of single support the momentum D q' of the pinned robot changes by the impulses that act on it:

    Delta(D q') = integral of (C' q' - G + B u) dt,     r = |left - right| / |D q', C' q' - G, B u|

with q' from differences of the angles. r is about 0.1 for the right reading on exact sensors, 0.5 with
encoders, friction and masses that are 30 % off, and 0.9 or more for a wrong one. The mirror image of a walk,
angles and torques with the other sign, fits as well, but its swing foot lands behind the stance foot.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.extras.logs.log_file import exchanged
from biped_adrc.extras.logs.robot_log import RobotLog
from biped_adrc.model.biped import Biped

HALF = 0.01
"""Half of the interval of differences [s]: encoder steps are small beside the motion in it."""
WINDOW = 0.04
"""Length of a window [s]: torques change, and a step has several."""
MOST = 60
"""Largest number of windows; those of a longer log are chosen evenly."""
FITS = 1.25
"""Ratio of the residuals of two readings from which on the better one is meant."""
POOR = 0.8
"""Residual above which no reading is trusted."""


class Fit(NamedTuple):
    """How well one reading fits."""

    behind: bool
    """Whether the swing foot lands behind the stance foot in most touchdowns."""
    residual: float
    """r."""
    words: str
    """What the reading is, behind "if"."""


def check_reading(log: RobotLog, biped: Biped) -> tuple[str, ...]:
    """A remark where no reading of the log fits the model; a log that is too short has none.

    Raises InputError where another reading fits better than the log as it stands, with its name.
    """
    fits = list(_fits(log, biped))
    if not fits:
        return ()
    asked, best = fits[0], min(fits, key=lambda fit: (fit.behind, round(fit.residual, 2)))
    lands = ", and the swing foot lands behind the stance foot" if asked.behind else ""
    off = f"the log is {asked.residual:.0%} off the model's balance of momentum{lands}"
    if best.residual > POOR:
        return (f"{off}; look at the order, signs and units of its columns, and at its noise",)
    if asked.behind > best.behind or asked.residual > FITS * best.residual:
        raise InputError(f"{off}; it is {best.residual:.0%} off if {best.words}: change that")
    return ()


def _fits(log: RobotLog, biped: Biped) -> Iterator[Fit]:
    """Iterate over the readings, the log as it stands first; none where no window fits into a support.

    Before a touchdown a walk and its mirror image are not told apart.
    """
    half, rows = (max(1, round(length / log.period)) for length in (HALF, WINDOW))
    begins = np.arange(half, len(log.t) - rows - half)
    begins = begins[log.step[begins - half] == log.step[begins + rows + half]][::rows]
    begins = begins[:: len(begins) // MOST + 1]
    landed = np.flatnonzero(np.diff(log.step))
    other = exchanged(np.full(len(log.t), 2.0), log.q, log.rates, log.u, biped)
    readings = {
        "": (log.q, log.u),
        "the other leg stands (exchange 1 and 2 of 'contact')": (other[0], other[2]),
        "all angles have the other sign": (-log.q, log.u),
        "all angles are in degrees ('q1 [deg]')": (np.radians(log.q), log.u),
        "all angles are in radians ('q1 [rad]')": (np.degrees(log.q), log.u),
    }
    for words, (q, u) in readings.items() if len(begins) else ():
        ahead = [float(biped.swing_foot(q[k])[0]) for k in landed]
        free, driven = _impulses(log.t, q, u, biped, begins, (half, rows))
        whole = float(np.sum(free**2) + np.sum(driven**2))
        for sign, also in ((1.0, ""), (-1.0, "all torques have the other sign")):
            r = float(np.sqrt(np.sum((free - sign * driven) ** 2) / whole)) if whole else 0.0
            said = " and ".join(filter(None, (words, also)))
            yield Fit(bool(ahead) and float(np.median(ahead)) < 0.0, r, said)


def _impulses(
    t: Array, q: Array, u: Array, biped: Biped, begins: Array, rows: tuple[int, int]
) -> tuple[Array, Array]:
    """What moved without motors, Delta(D q') - integral of (C' q' - G) dt, and the motors' impulse, B u dt.

    Both (M, n) [N m s], of the windows from the rows `begins` (M,) on. rows: of half a difference, and of a
    window.
    """
    half, length = rows
    free, driven = np.zeros((2, len(begins), biped.n))
    for i, k in enumerate(begins):
        at = np.linspace(k, k + length, 5).round().astype(int)
        v = (q[at + half] - q[at - half]) / (t[at + half] - t[at - half])[:, np.newaxis]
        own = [biped.coriolis(x, w).T @ w - biped.gravity(x) for x, w in zip(q[at], v, strict=True)]
        change = biped.inertia(q[at[-1]]) @ v[-1] - biped.inertia(q[k]) @ v[0]
        free[i] = change - np.trapezoid(own, t[at], axis=0)
        driven[i, : biped.p] = np.mean(u[k : k + length], axis=0) * (t[k + length] - t[k])
    return free, driven
