"""Logs as CSV files, a column for each signal with its unit in the name.

    t [s], contact, q1 [rad] .. qN [rad], v1 [rad/s] .., u1 [N m] .. up [N m]

N is the number n of coordinates, and p that of motors. contact is 1 or 2, the number of the leg that stands.
The columns are then of the robot's own joints, which keep their names while it walks. The package names joints
by stance and swing leg: with contact 1 the names agree; with contact 2 the legs are exchanged when the file is
read. A file that has `step` in place of `contact`, the number of the single support, has the package's names
already.

Rates may be left out, all or some. Units are those of studies ("deg", "ms", "mN m"). Other columns are
ignored, and the log's remarks name them.

`check_reading` tries whether a log fits the model best as it stands, or in another *reading*: with the legs
exchanged, with other signs, or in degrees. On windows of time, each within one single support, the momentum
D q' of the pinned robot changes by the impulses that act on it:

    a = Delta(D q') - integral of (C' q' - G) dt,   b = integral of B u dt,   r = |a - b| / sqrt(|a|^2 + |b|^2)

    D, C        inertia matrix [kg m^2] and Coriolis matrix [kg m^2/s] of the nominal model; C' is the transpose
    G, B        gravity's torque (n,) [N m]; B u (n,) is the motors' torque on the coordinates
    a, b        impulses (n,) [N m s] by the motion and by the motors; Delta: change over the window

with q' from differences of the angles and norms over all windows; on exact data a = b. r is about 0.1 for the
right reading on exact sensors, 0.5 with encoders, friction and masses that are 30 % off, and 0.9 or more for a
wrong one. The mirror image of a walk, angles and torques with the other sign, fits as well, but its swing foot
lands behind the stance foot.
"""

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import CsvTable, reading, write_csv
from biped_adrc.core.types import Array, Flags, relabelled
from biped_adrc.extras.logs.robot_log import RobotLog, check_rows
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.units import quantity

_UNITS = {"t": "s", "q": "rad", "v": "rad/s", "u": "N m"}
"""First letter of a column -> its unit in the package."""
CONTACT, STEP = "contact", "step"
"""Names of the two columns of which a file has one."""
LEGS = (1.0, 2.0)
"""Values that `contact` may have."""

MOST_ANGLE = 4.0 * math.pi
"""Largest plausible angle [rad], two turns; a larger one is probably in degrees."""
MOST_TORQUE = 100.0
"""Largest plausible torque, as a multiple of the robot's peak torque."""
STRETCH = 0.01
"""Interval over which a rate is compared with its angle [s]: many encoder counts, little of a walking step."""
LEAST_MOTION = 0.002
"""Least rms change of an angle in an interval [rad]; with less motion its rate is not checked."""
RATIOS = 0.5, 2.0
"""Range of the ratio r_i of a change of angle to the integral of its rate [1] (`check_plausible`), in which the
rate is accepted."""

HALF, WINDOW = 0.01, 0.04
"""Half of the interval over which angles are differenced, so long that encoder counts do not matter, and the
length of a window [s]."""
FITS, POOR = 1.25, 0.8
"""Another reading is right where r of the log as it stands is more than FITS times its r; above POOR no r is
small enough for a verdict."""

_COLUMN = re.compile(r"\s*(\w+?)\s*(?:\[(.*)\])?\s*")
"""The name of a column, and its unit in brackets."""


def read_log(file: str | Path, biped: Biped) -> RobotLog:
    """Read the log of a robot from a CSV file.

    file: its path. biped: the robot, with whose numbers of joints and motors the columns must agree.

    Raises InputError for a file that cannot be read, with the line or the column, what was found
    there and what was expected.

    >>> from biped_adrc.extras.logs.log_file import write_log
    >>> from biped_adrc.extras.logs.robot_log import logged
    >>> walk = ba.walk_scenario(ba.Scenario("NPD", hardware="ideal", run={"impacts": 2}))
    >>> file = write_log(logged(walk), folder / "log.csv", biped)
    >>> ba.read_log(file, biped).q.shape[1]
    5
    """
    with reading("log", file, InputError):
        table = CsvTable.read(file)
        # name of a column -> its index in the file, and the factor to SI units
        wanted = _wanted(table.head, biped)
        columns = {name: factor * table.numbers(at) for name, (at, factor) in wanted.items()}
        names = [f"line {line}" for line, _ in table.rows]
        return _log(columns, biped, names, _said(table.head, wanted))


def write_log(log: RobotLog, path: str | Path, biped: Biped) -> Path:
    """Write a log as CSV with the column `contact`, the joints named by the robot's own legs; returns the path.

    The leg that stands in single supports 1, 3, .. is called 1. Raises InputError where a rate was measured on
    one leg alone, and OutputError.
    """
    _check_pairs(log.has_rate, biped)
    legs = 2.0 - log.step % 2.0
    q, v, u = relabel_legs(legs, log.q, log.rates, log.u, biped)
    columns = {"t [s]": log.t, CONTACT: legs.astype(int)}
    for letter, x in {"q": q, "v": v, "u": u}.items():
        for i, column in enumerate(x.T):
            if letter != "v" or log.has_rate[i]:
                columns[f"{letter}{i + 1} [{_UNITS[letter]}]"] = column
    return write_csv(columns, path)


def relabel_legs(
    legs: Array, q: Array, v: Array, u: Array, biped: Biped
) -> tuple[Array, Array, Array]:
    """Exchange the names of the legs in the rows in which leg 2 stands; returns q, v (K, n) and u (K, p).

    legs (K,): 1 or 2, the leg that stands. From the robot's own legs to stance and swing leg, and back: the
    function is its own inverse.
    """
    # R (n, n): matrix of the exchange, q+ = R q- + offset, v+ = R v-; `swap` is that of the torques
    # LEGS: values of `contact`, 1 and 2; with 2 the legs are exchanged
    other = (legs == LEGS[1])[:, np.newaxis]
    turned = np.array([biped.relabel(x) for x in q]).reshape(q.shape)
    q, v = np.where(other, turned, q), np.where(other, v @ biped.R.T, v)
    return q, v, np.where(other, relabelled(u, biped.swap), u)


def _check_pairs(measured: Flags, biped: Biped) -> None:
    """Raise InputError where the rate of a joint is measured on one leg and not on the other; measured (n,)."""
    # R (n, n), q+ = R q-, exchanges the names of the legs: it has an entry i, j where v_j becomes v_i
    # [:1]: the first pair is reported; + 1: joints are counted from 1
    for i, j in np.argwhere((biped.R != 0.0) & measured[:, np.newaxis] & ~measured)[:1] + 1:
        raise InputError(
            f"the log has v{i} and not v{j}, of which it is made when the legs are exchanged; expected both, "
            "or none of them"
        )


def _wanted(head: list[str], biped: Biped) -> dict[str, tuple[int, float]]:
    """For each column of the log, by its name without unit: its index in the file, and the factor to its SI
    unit.

    head: headings of the file. Raises InputError for a column that is missing, or there twice, and for units.
    """
    sizes, result = {"q": biped.n, "v": biped.n, "u": biped.p}, dict[str, tuple[int, float]]()
    numbered = (f"{letter}{i}" for letter, size in sizes.items() for i in range(1, size + 1))
    known = ["t", CONTACT, STEP, *numbered]
    for at, text in enumerate(head):
        # _COLUMN: name of a column and its unit in brackets
        match = _COLUMN.fullmatch(text)
        if match is None or match[1] not in known:
            continue  # a column that the log does not use
        name, unit = match[1], match[2]
        if name in result:
            raise InputError(f"two of its columns are called '{name}', in {head}; leave one out")
        result[name] = at, 1.0 if name in (CONTACT, STEP) else _factor(text, name, unit)
    # t, q and u have to be there, and one of contact and step; rates may be missing
    missing = [x for x in known if x[0] in "tqu" and x not in result]
    if missing or (CONTACT in result) == (STEP in result):
        asked = [f"{x} [{_UNITS[x[0]]}]" for x in missing] or [f"one of {CONTACT}, {STEP}"]
        raise InputError(
            f"its columns are {head}, expected {', '.join(asked)} too; rates v1 .. may be left out"
        )
    return result


def _factor(column: str, name: str, unit: str | None) -> float:
    """Factor from `unit` to the SI unit of column `name`. Raises InputError without a unit, or for another
    dimension.

    column: its heading in the file, for messages.
    """
    expected = _UNITS[name[0]]  # by the first letter: t, q, v or u
    if not unit:
        raise InputError(
            f"column '{column}' has no unit, expected one in brackets, as '{name} [{expected}]'"
        )
    try:
        return quantity(f"1 {unit}", expected)
    except ValueError as error:
        raise InputError(f"column '{column}': {error}") from None


def _said(head: list[str], wanted: dict[str, tuple[int, float]]) -> tuple[str, ...]:
    """Sentences that name the columns which were converted or ignored, for the log's remarks.

    head: headings of the file. wanted: name of a column -> (its index in the file, factor to its SI unit).
    """
    used = {at for at, _ in wanted.values()}
    scaled = [head[at] for at, factor in wanted.values() if factor != 1.0]
    rest = [text for at, text in enumerate(head) if at not in used]
    remarks = [f"converted to the package's units: {', '.join(scaled)}"] if scaled else []
    return (*remarks, *([f"columns left alone: {', '.join(rest)}"] if rest else []))


def _log(
    table: dict[str, Array], biped: Biped, names: list[str], remarks: tuple[str, ...]
) -> RobotLog:
    """Make the log of K rows, from a table of columns (K,) in SI units by name, such as q1.

    names: what each row is called in messages. Raises InputError for rows that are no log of this robot.
    """
    rows = len(names)
    none = np.zeros(rows)  # in place of a rate that was not measured
    q, v, u = (
        np.array([table.get(f"{x}{i}", none) for i in range(1, size + 1)]).reshape(size, rows).T
        for x, size in (("q", biped.n), ("v", biped.n), ("u", biped.p))
    )
    measured, step = np.array([f"v{i}" in table for i in range(1, biped.n + 1)]), table.get(STEP)
    if step is None:
        # each rate has to be measured on both legs, as their names are exchanged below
        _check_pairs(measured, biped)
        legs = table[CONTACT]
        for k in np.flatnonzero(~np.isin(legs, LEGS))[:1]:
            raise InputError(
                f"{names[k]}, column '{CONTACT}': found {legs[k]:g}, expected 1 or 2, the leg that stands"
            )
        # single supports are counted from 1; the stance leg changes at each touchdown
        step = 1.0 + np.cumsum(np.diff(legs, prepend=legs[:1]) != 0.0)
    # checked before the legs are exchanged, so that messages name the columns of the file
    log = table["t"], step, q, u, v
    check_rows(*log, names)
    check_plausible(log, measured, biped, names)
    if CONTACT in table:
        q, v, u = relabel_legs(table[CONTACT], q, v, u, biped)
        log = table["t"], step, q, u, v
    return RobotLog(*log, measured.astype(float), remarks)


def check_plausible(log: tuple[Array, ...], has: Array, biped: Biped, names: list[str]) -> None:
    """Raise InputError for angles, rates or torques that the robot cannot have had, since units or columns are
    wrong.

        r_i = sum over intervals of Delta q_i D_i / sum of D_i^2,     D_i = integral of v_i over the interval

    is 1 where v_i is the rate of q_i, 1/57 where v_i is in degrees and q_i in radians, 57 the other way round,
    -1 where one of them has the wrong sign.

    log: t (K,), step (K,) the number of the single support, q (K, n), u (K, p), v (K, n), in SI units, with the
    joints named as in the file. has (n,): whether a rate was measured; names (K,): what each row is called in
    messages.
    """
    # `[:1]` in the loops below: the first wrong number is reported
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
    # of angle and of rate, over intervals; no intervals where the log is too short
    turned, integral = _stretches(t, step, q, v)
    for i in np.flatnonzero(has).tolist() if len(turned) else []:
        _check_rate(turned[:, i], integral[:, i], i)


def _stretches(t: Array, step: Array, q: Array, v: Array) -> tuple[Array, Array]:
    """Changes of the angles, and integrals of the rates, over M intervals, both (M, n) [rad].

    Each interval, about STRETCH long, lies within one single support. Both results are equal in a log whose
    rates are those of its angles.
    """
    # area: integral of the rates from the first row on, by trapezoids
    ways = np.diff(t)[:, np.newaxis]
    area = np.vstack((np.zeros_like(v[:1]), np.cumsum(0.5 * ways * (v[1:] + v[:-1]), axis=0)))
    rows = max(1, round(STRETCH / float(np.median(ways))))
    # begins: first rows of intervals whose ends are in the same single support; every rows-th of them
    begins = np.flatnonzero(step[:-rows] == step[rows:])[::rows]
    return q[begins + rows] - q[begins], area[begins + rows] - area[begins]


def _check_rate(turned: Array, integral: Array, i: int) -> None:
    """Raise InputError where rate i, counted from 0, is not that of its angle.

    turned, integral (M,) [rad]: change of the angle, and integral of the rate, over each of M intervals.
    """
    if max(float(np.sqrt(np.mean(x**2))) for x in (turned, integral)) < LEAST_MOTION:
        return  # too little motion for a verdict
    square = float(integral @ integral)
    # the factor from `integral` to `turned` by least squares; RATIOS: its accepted range
    ratio = float(turned @ integral) / square if square > 0.0 else math.inf
    if not RATIOS[0] <= ratio <= RATIOS[1]:
        raise InputError(
            f"q{i + 1} changes by {ratio:.3g} times what v{i + 1} says, expected 1; look at the units, "
            f"signs and order of both, or leave v{i + 1} out"
        )


# -- whether a log fits the model as it stands ---------------------------------------------------------
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
