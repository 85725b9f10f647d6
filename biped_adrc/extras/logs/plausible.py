"""Whether the numbers of a log can be those of this robot: units and columns that were taken for others.

    r_i = sum over stretches of Delta q_i D_i / sum of D_i^2,     D_i = integral of v_i over the stretch

r_i is 1 where v_i is the rate of q_i, 1/57 where one of both is in degrees, -1 where it has the other sign.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.model.biped import Biped

MOST_ANGLE = 4.0 * math.pi
"""[rad]: a joint that turned twice is one in degrees."""
MOST_TORQUE = 100.0
"""In peak torques of the robot: beyond it torques are in another unit."""
STRETCH = 0.01
"""Length of a stretch [s]: long enough for counts of encoders, short beside a step."""
LEAST_MOTION = 0.002
"""Root mean square of an angle's change in a stretch [rad], below which nothing is said of its rate."""
RATIOS = 0.5, 2.0
"""Within these r_i is believed."""


def check_plausible(log: tuple[Array, ...], has: Array, biped: Biped, names: list[str]) -> None:
    """Raise InputError for angles, rates or torques that the robot cannot have had.

    log: t, step, q, u, v as in `RobotLog`, in the labels of the file. has (n,): whether a rate was
    measured; names (K,): of the rows.
    """
    t, step, q, u, v = log
    for k, i in np.argwhere(np.abs(q) > MOST_ANGLE)[:1]:
        raise InputError(
            f"{names[k]} has q{i + 1} = {q[k, i]:g} rad, expected at most two turns; if the column is in "
            f"degrees, call it 'q{i + 1} [deg]'"
        )
    same = np.diff(step) == 0.0
    for k, i in np.argwhere(same[:, np.newaxis] & (np.abs(np.diff(q, axis=0)) > math.pi))[:1]:
        raise InputError(
            f"{names[k + 1]} has q{i + 1} = {q[k + 1, i]:g} rad, after {q[k, i]:g} rad, expected angles "
            "that go on without a jump; add or take away whole turns"
        )
    most = MOST_TORQUE * biped.description.peak_torque
    for k, i in np.argwhere(np.abs(u) > most)[:1]:
        raise InputError(
            f"{names[k]} has u{i + 1} = {u[k, i]:g} N m, expected at most {most:g} N m, {MOST_TORQUE:g} times "
            f"the robot's peak; if the column is in mN m, call it 'u{i + 1} [mN m]'"
        )
    turned, integral = _stretches(t, step, q, v)
    for i in np.flatnonzero(has).tolist() if len(turned) else []:
        _check_rate(turned[:, i], integral[:, i], i)


def _stretches(t: Array, step: Array, q: Array, v: Array) -> tuple[Array, Array]:
    """Changes of the angles and integrals of the rates (M, n) [rad], over stretches of single supports."""
    ways = np.diff(t)[:, np.newaxis]
    area = np.vstack((np.zeros_like(v[:1]), np.cumsum(0.5 * ways * (v[1:] + v[:-1]), axis=0)))
    rows = max(1, round(STRETCH / float(np.median(ways))))
    begins = np.flatnonzero(step[:-rows] == step[rows:])[::rows]
    return q[begins + rows] - q[begins], area[begins + rows] - area[begins]


def _check_rate(turned: Array, integral: Array, i: int) -> None:
    """Raise InputError where a rate is not that of its angle, by changes and integrals (M,) [rad]."""
    if max(float(np.sqrt(np.mean(x**2))) for x in (turned, integral)) < LEAST_MOTION:
        return
    square = float(integral @ integral)
    ratio = float(turned @ integral) / square if square > 0.0 else math.inf
    if not RATIOS[0] <= ratio <= RATIOS[1]:
        raise InputError(
            f"q{i + 1} changes by {ratio:.3g} times what v{i + 1} says, expected 1; look at the units, "
            f"signs and order of both, or leave v{i + 1} out"
        )
