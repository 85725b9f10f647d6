"""Logs as files: read as they were written, and refused with a sentence where they are damaged.

Fixtures: log, of a walk of three steps, sampled at 1 kHz with exact sensors; lines, the lines of its file
around the first touchdown, a list of texts each; read, which writes such lines to a file and reads the log in
it.
"""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.extras.logs.log_file import check_plausible, check_reading, write_log
from biped_adrc.extras.logs.robot_log import RobotLog, logged

ARRAYS = ("t", "step", "q", "u", "v", "measured")


@pytest.fixture
def lines(log, biped, tmp_path):
    """The lines of a file around its first touchdown, a list of texts each."""
    text = write_log(log, tmp_path / "whole.csv", biped).read_text(encoding="utf-8")
    head, *rows = [line.split(",") for line in text.splitlines()]
    first = int(np.flatnonzero(log.step == 2)[0])
    return [head, *rows[first - 12 : first + 12]]


@pytest.fixture
def read(biped, tmp_path):
    """Reads such lines from a file."""

    def from_lines(lines, robot=biped):
        path = tmp_path / "log.csv"
        path.write_text("\n".join(",".join(line) for line in lines), encoding="utf-8")
        return ba.read_log(path, robot)

    return from_lines


def column(lines, name):
    """Where a column is."""
    return next(i for i, text in enumerate(lines[0]) if text.partition(" ")[0] == name)


def test_a_log_comes_back_to_the_last_bit(log, biped, tmp_path):
    """All arrays, with all rates measured, and with those of knees not measured (measured = 0), whose columns
    the file then does not have; the rate of q5 is measured in both.
    """
    back = ba.read_log(write_log(log, tmp_path / "log", biped), biped)
    assert all(np.array_equal(getattr(back, x), getattr(log, x)) for x in ARRAYS)
    assert back.remarks == ()
    some = replace(log, measured=[1.0, 1.0, 0.0, 0.0, 1.0])
    back = ba.read_log(write_log(some, tmp_path / "some.csv", biped), biped)
    assert back.measured.tolist() == some.measured.tolist()
    assert np.array_equal(back.v[:, 4], log.v[:, 4])


def test_in_the_file_a_joint_keeps_its_name_over_a_touchdown(log, lines):
    """`lines` has 12 rows before and after the first touchdown. In the labels of the robot's legs no angle
    jumps; in the log, labelled by stance and swing, the legs change places there.
    """
    # columns of the file: t, contact, then five q, five v and four u
    q = np.array([[float(x) for x in line[2:7]] for line in lines[1:]])
    assert np.max(np.abs(np.diff(q, axis=0))) < 0.02
    at = int(np.flatnonzero(log.step == 2)[0])
    assert np.max(np.abs(log.q[at] - log.q[at - 1])[:4]) > 0.3
    legs, rows = [1, 0, 3, 2], slice(at, at + 12)
    swapped = (log.q[rows][:, [*legs, 4]], log.v[rows][:, [*legs, 4]], log.u[rows][:, legs])
    numbers = np.array([[float(x) for x in line[2:]] for line in lines[13:]])
    assert np.array_equal(numbers, np.hstack(swapped))


def test_labels_of_stance_and_swing_are_read_by_step(log, biped, lines, read):
    """A file with the column `step` (number of the single support) in place of `contact` (the leg that stands)
    has the labels of stance and swing already: both forms give the same log.
    """
    legs = read(lines)
    at = column(lines, "contact")
    swapped = [[*lines[0][:at], "step", *lines[0][at + 1 :]]]
    for row, q, v, u in zip(lines[1:], legs.q, legs.v, legs.u, strict=True):
        number = "1" if row[at] == "1" else "2"
        swapped.append([row[0], number, *(f"{x!r}" for x in np.concatenate((q, v, u)).tolist())])
    back = read(swapped)
    assert all(np.array_equal(getattr(back, x), getattr(legs, x)) for x in ARRAYS)


def test_other_units_are_converted_and_it_is_said(lines, read):
    """Time in ms and one angle in degrees give the same log; a column that is none of a log, the current, is
    left alone. Both are remarked.
    """
    at, head = column(lines, "q2"), list(lines[0])
    head[0], head[at] = "t [ms]", "q2 [deg]"
    rows = [[*row] for row in lines[1:]]
    for row in rows:
        row[0], row[at] = repr(1e3 * float(row[0])), repr(float(np.rad2deg(float(row[at]))))
    head, rows = [*head, "current [A]"], [[*row, "3"] for row in rows]
    found, usual = read([head, *rows]), read(lines)
    assert np.allclose(found.t, usual.t, rtol=0.0, atol=1e-12)
    assert np.allclose(found.q, usual.q, rtol=0.0, atol=1e-12)
    assert found.remarks == (
        "converted to the package's units: t [ms], q2 [deg]",
        "columns left alone: current [A]",
    )


def put(k, name, text):
    """A change of one entry; k: index of the row, 0 the first line."""

    def change(lines):
        lines[k][column(lines, name)] = text
        return lines

    return change


def scaled(name, factor):
    """A change of a whole column, in another unit than its name says."""

    def change(lines):
        at = column(lines, name)
        for row in lines[1:]:
            row[at] = repr(factor * float(row[at]))
        return lines

    return change


DAMAGE = {
    "gap": (lambda x: x[:4] + x[8:], "line 5 of the log comes 0.005 s after .* expected 0.001 s"),
    "back": (lambda x: [*x[:5], x[2], *x[5:]], "line 6 .* 0.002 s before the row before"),
    "nan": (put(3, "q2", "nan"), "line 4, column 'q2 \\[rad\\]': found 'nan'"),
    "no unit": (put(0, "q1", "q1"), "column 'q1' has no unit, .* 'q1 \\[rad\\]'"),
    "unknown unit": (put(0, "u1", "u1 [Nn]"), "column 'u1 \\[Nn\\]': the unit 'Nn' is not known"),
    "degrees": (scaled("q1", 57.3), "line 2 has q1 = .* call it 'q1 \\[deg\\]'"),
    "rates in degrees": (scaled("v3", 57.3), "q3 changes by 0.0175 times what v3 says"),
    "a rate that rests": (scaled("v3", 0.0), "q3 changes by inf times what v3 says"),
    "doubled": (put(0, "v2", "v1 [rad/s]"), "two of its columns are called 'v1'"),
    "absent": (put(0, "u4", "w4 [N m]"), r"expected u4 \[N m\] too; rates v1 \.\. may be left out"),
    "no leg": (put(0, "contact", "leg"), "expected one of contact, step too"),
    "a third leg": (put(3, "contact", "3"), "line 4, column 'contact': found 3, expected 1 or 2"),
    "rate of one leg": (put(0, "v2", "w2"), "the log has v1 and not v2, of which it is made"),
    "whole turn": (put(3, "q5", "6.3"), r"line 4 has q5 = 6\.3 rad, after .* without a jump"),
    "torque": (
        put(3, "u2", "-15000.1"),
        "line 4 has u2 = -15000.1 N m, expected at most 15000 N m",
    ),
}


@pytest.mark.parametrize("kind", DAMAGE)
def test_damage_is_named_with_its_place(lines, read, kind):
    """DAMAGE[kind] is (change of the file's lines, text of the error): the line or column has to be named."""
    change, said = DAMAGE[kind]
    with pytest.raises(InputError, match=f"^log '.*log.csv': .*{said}"):
        read(change(lines))


def log_of(ways=(1, 1, 1, 1, 1), step=(1,) * 6, **arrays):
    """Six rows of one coordinate and one motor at rest; ways: times between them [1/64 s]."""
    t = np.cumsum((0.0, *ways)) / 64.0
    return RobotLog(
        **{"t": t, "step": step, "q": np.zeros((6, 1)), "u": np.zeros((6, 1)), **arrays}
    )


LATER = (1, 1, 1, 2, 2, 2)


@pytest.mark.parametrize(
    ("arrays", "said"),
    [
        ({"t": np.zeros((6, 1))}, r"the log has t \(6, 1\), .* expected K rows of each"),
        ({"q": np.zeros((5, 1))}, r"q \(5, 1\), u \(6, 1\)"),
        ({"u": np.zeros(6)}, r"u \(6,\)"),
        ({"v": np.zeros((6, 2))}, r"v \(6, 2\), expected K rows"),
        ({"measured": [1.0, 0.0]}, r"measured of the log has the shape \(2,\), expected \(1,\)"),
        ({"u": [[0.0]] * 4 + [[np.nan]] * 2}, "row 5 of the log has .* expected finite numbers"),
        ({"step": (1, 1, 1, 1.5, 2, 2)}, "row 4 of the log is of single support 1.5"),
        ({"step": (0, 0, 0, 1, 1, 1)}, "row 1 of the log is of single support 0"),
        ({"step": LATER[::-1]}, "row 4 of the log is of single support 1"),
        ({"step": (1, 1, 1, 3, 3, 3)}, "row 4 of the log is of single support 3"),
        ({"ways": (1, 0, 1, 1, 1)}, "row 3 of the log has t = 0.015625 s, the same time as the"),
        ({"ways": (1, 1, -0.5, 1, 1)}, r"row 4 of the log has .*, 0.0078125 s before the row"),
        ({"ways": (9, 9, 9, 9, 9)}, r"6 rows that are 0.140625 s apart, .* 1e-05 to 0.1 s apart"),
        ({"ways": (6e-4,) * 5}, "6 rows that are 9.375e-06 s apart"),
        # no single support has two rows, so there is no period
        ({"step": (1, 2, 3, 4, 5, 6)}, "6 rows that are nan s apart"),
        (
            {"ways": (1, 1, 1.6, 1, 1)},
            r"row 4 .* 0.025 s after the row before, expected 0.015625 s",
        ),
        ({"ways": (1, 1, 0.49, 1, 1)}, r"row 4 .* comes 0.00765625 s after"),
        ({"ways": (1, 1, 1.6, 1, 1), "step": LATER}, r"row 4 .* 0.025 s after"),
    ],
)
def test_arrays_that_are_no_log_are_named_by_the_row(arrays, said):
    """Six rows, with one thing wrong each; ways: times between rows in 1/64 s, which binary numbers hold
    exactly; step: numbers of the single supports, with LATER the second from row 4 on. Rows may be 1e-5 to 0.1
    s apart, and half a period early or late.
    """
    with pytest.raises(InputError, match=said):
        log_of(**arrays)


def test_what_lies_at_the_limits_is_a_log(biped):
    """A row may be half a period late or early, and come soon after a touchdown; the clock is even to 0.1 % of
    the period (0.9991, not 0.9989). An angle may change by half a turn, and by more at a touchdown; two turns
    and 100 times the peak torque of 150 N m are plausible. log_of(ways): six rows with these times between
    them, in units of 1/64 s.
    """
    logs = [log_of((1, 1, x, 1, 1)) for x in (1.5, 0.5, 0.9991, 1.0009, 0.9989, 1.0011)]
    assert [x.period for x in logs] == [1.0 / 64.0] * 6
    assert [x.even(1.0 / 64.0) for x in logs] == [False, False, True, True, False, False]
    assert log_of((1, 1, 0.1, 1, 1), LATER).even(1.0 / 64.0)
    q = np.zeros((6, 5))
    for half, step in ((np.pi, (1,) * 6), (3.2, LATER)):  # at a touchdown the labels change
        for other in (0.0, 4.0 * np.pi, -4.0 * np.pi):
            q[3:, 0], q[:, 1] = half, other
            log = np.arange(6.0) / 64.0, np.array(step), q, np.full((6, 4), -15000.0), 0.0 * q
            check_plausible(log, np.zeros(5), biped, ["row"] * 6)  # zeros: no rate was measured


@pytest.mark.parametrize(
    ("speed", "rate", "refused"),
    [
        *((1.0, 2.0, 0), (1.0, 0.5, 0), (1.0, 2.01, 1), (1.0, 0.49, 1)),
        *((0.06, 0.0, 0), (0.07, 0.0, 1), (0.0, 0.06, 0), (0.0, 0.07, 1)),
    ],
)
def test_a_rate_is_within_half_and_twice_that_of_its_angle(biped, speed, rate, refused):
    """speed of q4, and rate logged as v4 [rad/s]; refused: 1 or 0. Over one interval of 1/32 s; nothing is said
    where both change by less than 0.002 rad in it, as at 0.06 rad/s.
    """
    t, one = np.arange(6.0) / 32.0, np.eye(5)[3]
    log = t, np.ones(6), np.outer(speed * t, one), np.zeros((6, 4)), np.tile(rate * one, (6, 1))
    said = pytest.raises(InputError, match=r"q4 changes by .* times what v4 says, expected 1")
    with said if refused else nullcontext():
        check_plausible(log, one > 0.0, biped, ["row"] * 6)
    check_plausible(log, one > 1.0, biped, ["row"] * 6)  # no rate was measured


def test_a_log_of_one_window_is_compared_with_the_model_and_a_shorter_one_is_not(log, biped):
    """A window of 40 periods of 1 ms has 41 rows; with 10 on each side for the differences it takes 61, and of
    60 rows nothing can be said. All torques have the wrong sign here, so that a = -b in the balance of momentum
    and |a - b| is sqrt(2) = 141 % of sqrt(|a|^2 + |b|^2).
    """
    one, short = (RobotLog(log.t[:K], log.step[:K], log.q[:K], -log.u[:K]) for K in (61, 60))
    assert check_reading(short, biped) == ()
    with pytest.raises(
        InputError, match=r"141% off .*; it is 0% off if all torques have the other"
    ):
        check_reading(one, biped)


@pytest.mark.parametrize(
    ("hardware", "said"),
    [("none", "continuous time and has no sample"), ("ideal", "t = 0 s, before")],
)
def test_a_walk_without_sample_instants_has_no_log(hardware, said):
    """Neither a walk in continuous time has a log, nor one that starts at 1e5 rad/s and is ended at t = 0,
    before it has a sample.
    """
    walk = ba.walk_scenario(ba.Scenario("NPD", hardware=hardware, start={"v5": 1e5}))
    with pytest.raises(InputError, match=said):
        logged(walk)
