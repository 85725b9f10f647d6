"""Logs as files: read as they were written, and refused with a sentence where they are damaged."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.extras.logs.log_file import write_log

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
    back = ba.read_log(write_log(log, tmp_path / "log", biped), biped)
    assert all(np.array_equal(getattr(back, x), getattr(log, x)) for x in ARRAYS)
    assert back.remarks == ()
    some = replace(log, measured=[1.0, 1.0, 0.0, 0.0, 1.0])
    back = ba.read_log(write_log(some, tmp_path / "some.csv", biped), biped)
    assert back.measured.tolist() == some.measured.tolist()
    assert np.array_equal(back.v[:, 4], log.v[:, 4])


def test_in_the_file_a_joint_keeps_its_name_over_a_touchdown(log, lines):
    """No angle jumps in the labels of the robot's legs; in those of the package the legs change places."""
    q = np.array([[float(x) for x in line[2:7]] for line in lines[1:]])
    assert np.max(np.abs(np.diff(q, axis=0))) < 0.02
    at = int(np.flatnonzero(log.step == 2)[0])
    assert np.max(np.abs(log.q[at] - log.q[at - 1])[:4]) > 0.3
    legs, rows = [1, 0, 3, 2], slice(at, at + 12)
    swapped = (log.q[rows][:, [*legs, 4]], log.v[rows][:, [*legs, 4]], log.u[rows][:, legs])
    numbers = np.array([[float(x) for x in line[2:]] for line in lines[13:]])
    assert np.array_equal(numbers, np.hstack(swapped))


def test_labels_of_stance_and_swing_are_read_by_step(log, biped, lines, read):
    legs = read(lines)
    at = column(lines, "contact")
    swapped = [[*lines[0][:at], "step", *lines[0][at + 1 :]]]
    for row, q, v, u in zip(lines[1:], legs.q, legs.v, legs.u, strict=True):
        number = "1" if row[at] == "1" else "2"
        swapped.append([row[0], number, *(f"{x!r}" for x in np.concatenate((q, v, u)).tolist())])
    back = read(swapped)
    assert all(np.array_equal(getattr(back, x), getattr(legs, x)) for x in ARRAYS)


def test_other_units_are_converted_and_it_is_said(lines, read):
    at, head = column(lines, "q2"), list(lines[0])
    head[0], head[at] = "t [ms]", "q2 [deg]"
    rows = [[*row] for row in lines[1:]]
    for row in rows:
        row[0], row[at] = repr(1e3 * float(row[0])), repr(float(np.rad2deg(float(row[at]))))
    head, rows = [*head, "current [A]"], [[*row, "3"] for row in rows]
    found, usual = read([head, *rows]), read(lines)
    assert np.allclose(found.t, usual.t, atol=1e-12)
    assert np.allclose(found.q, usual.q, atol=1e-12)
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
}


@pytest.mark.parametrize("kind", DAMAGE)
def test_damage_is_named_with_its_place(lines, read, kind):
    change, said = DAMAGE[kind]
    with pytest.raises(InputError, match=f"log.csv.*{said}"):
        read(change(lines))
