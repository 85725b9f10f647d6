"""Check of a log's conventions: does it fit the model best as it stands, or read in another way?

A reading is a way to understand the numbers of a log: as they stand, with the legs exchanged, with other signs,
or in degrees. On windows of time, each within one single support, the momentum D q' of the pinned robot changes
by the impulses that act on it:

    a = Delta(D q') - integral of (C' q' - G) dt,   b = integral of B u dt,   r = |a - b| / sqrt(|a|^2 + |b|^2)

    D, C        inertia matrix [kg m^2] and Coriolis matrix [kg m^2/s] of the nominal model; C' is the transpose
    G, B        gravity's torque (n,) [N m]; B u (n,) is the motors' torque on the coordinates
    a, b        impulses (n,) [N m s] by the motion and by the motors; Delta: change over the window

with q' from differences of the angles and norms over all windows; on exact data a = b. r is about 0.1 for the
right reading on exact sensors, 0.5 with encoders, friction and masses that are 30 % off, and 0.9 or more for a
wrong one. The mirror image of a walk, angles and torques with the other sign, fits as well, but its swing foot
lands behind the stance foot.
"""

from collections.abc import Iterator

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.extras.logs.log_file import relabel_legs
from biped_adrc.extras.logs.robot_log import RobotLog
from biped_adrc.model.biped import Biped

HALF, WINDOW = 0.01, 0.04
"""Half of the interval over which angles are differenced, so long that encoder counts do not matter, and the
length of a window [s]."""
FITS, POOR = 1.25, 0.8
"""Another reading is right where r of the log as it stands is more than FITS times its r; above POOR no r is
small enough for a verdict."""


def check_reading(log: RobotLog, biped: Biped) -> tuple[str, ...]:
    """Check that no other reading of the log fits the model better than the log as it stands.

    Returns a remark if no reading fits, else none, also for a log that is too short to tell. Raises InputError
    with the better reading where there is one.
    """
    # behind, best_behind: whether the swing foot lands behind the stance foot, in the log as it stands and in
    # the best reading; that is worse than any r
    fits = list(_fits(log, biped))
    if not fits:
        return ()
    behind, r, _ = fits[0]
    # r of two digits: of equal fits `min` takes the first, so the log as it stands goes before the others
    best_behind, least, words = min(fits, key=lambda fit: (fit[0], round(fit[1], 2)))
    lands = ", and the swing foot lands behind the stance foot" if behind else ""
    # POOR: r above which no reading fits; FITS: times by which r of another reading has to be smaller
    off = f"the log is {r:.0%} off the model's balance of momentum{lands}"
    if least > POOR:
        return (f"{off}; look at the order, signs and units of its columns, and at its noise",)
    if behind > best_behind or r > FITS * least:
        raise InputError(f"{off}; it is {least:.0%} off if {words}: change that")
    return ()


def _fits(log: RobotLog, biped: Biped) -> Iterator[tuple[bool, float, str]]:
    """Iterate over the readings, the log as it stands first; empty where no window fits into a single support.

    Of each: whether the swing foot lands behind the stance foot, r, and text that names the reading. Without a
    touchdown in the log it is taken to land in front, so that a walk and its mirror image look alike.
    """
    # `half` rows on each side of a window are needed for differences; all lie in one single support
    # HALF: half the interval of a difference
    half, rows = (max(1, round(length / log.period)) for length in (HALF, WINDOW))
    begins = np.arange(half, len(log.t) - rows - half)
    begins = begins[log.step[begins - half] == log.step[begins + rows + half]][::rows]
    begins = begins[:: len(begins) // 60 + 1]  # evenly over a long log
    # (q, v, u) with the legs exchanged in all rows, as if leg 2 stood in each
    other = relabel_legs(np.full(len(log.t), 2.0), log.q, log.rates, log.u, biped)
    readings = {
        "": (log.q, log.u),
        "the other leg stands (exchange 1 and 2 of 'contact')": (other[0], other[2]),
        "all angles have the other sign": (-log.q, log.u),
        "all angles are in degrees ('q1 [deg]')": (np.radians(log.q), log.u),
        "all angles are in radians ('q1 [rad]')": (np.degrees(log.q), log.u),
    }
    for words, (q, u) in readings.items() if len(begins) else ():
        # ahead: x of the swing foot from the stance foot [m] in the last row before each touchdown
        ahead = [biped.swing_foot(q[k])[0] for k in np.flatnonzero(np.diff(log.step))] or [0.0]
        # the impulses a and b of the module
        free, driven = _impulses(log.t, q, u, biped, begins, half, rows)
        # 1 where both are zero, for r = 0 and not 0/0
        whole = float(np.sum(free**2 + driven**2)) or 1.0
        for sign, also in ((1.0, ""), (-1.0, "all torques have the other sign")):
            r = float(np.sum((free - sign * driven) ** 2) / whole) ** 0.5
            yield bool(np.median(ahead) < 0.0), r, " and ".join(filter(None, (words, also)))


def _impulses(
    t: Array, q: Array, u: Array, biped: Biped, begins: Array, half: int, rows: int
) -> tuple[Array, Array]:
    """The impulses a = Delta(D q') - integral of (C' q' - G) dt and b = integral of B u dt, each (M, n) [N m
    s], over M windows.

    t (K,) [s], q (K, n) [rad], u (K, p) [N m]: the log. begins (M,): index of the first row of each window.
    rows: number of rows of a window. q' is the difference of q over `half` rows on each side by its time.
    """
    free, driven = np.zeros((2, len(begins), biped.n))
    for i, k in enumerate(begins):
        # at: five rows of the window, from its first one to its end, for the integral by trapezoids
        at = np.linspace(k, k + rows, 5).round().astype(int)
        v = (q[at + half] - q[at - half]) / (t[at + half] - t[at - half])[:, np.newaxis]
        # own: C' q' - G
        own = [biped.coriolis(x, w).T @ w - biped.gravity(x) for x, w in zip(q[at], v, strict=True)]
        change = biped.inertia(q[at[-1]]) @ v[-1] - biped.inertia(q[k]) @ v[0]
        free[i] = change - np.trapezoid(own, t[at], axis=0)
        # the first p coordinates are those of the joints with motors
        driven[i, : biped.p] = np.mean(u[k : k + rows], axis=0) * (t[k + rows] - t[k])
    return free, driven
