"""One walk as a table: CSV, pandas, and back as samples.

The fixture walk is RABBIT under NPD for two steps; biped and gait are RABBIT and its published gait.
"""

from __future__ import annotations

import csv
from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from tests.commands import command


@pytest.fixture(scope="module")
def walk(biped, gait):
    return ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 2)


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    return {name: [row[i] for row in rows] for i, name in enumerate(header)}


def test_columns_have_units_and_the_last_bit(walk, tmp_path):
    """Each signal has its columns, numbered from 1, with its unit; read back, each number is equal, and no
    column is left over but those of time, step and event.
    """
    found, s = read(walk.to_csv(tmp_path / "walk.csv")), walk.signals
    assert list(found)[:4] == ["t [s]", "step", "event", "q1 [rad]"]
    assert np.array_equal(np.array(found["t [s]"], dtype=float), s.t)
    assert found["step"] == [str(int(k)) for k in s.step]
    for name, unit, signal in (
        ("q", "rad", s.q),
        ("v", "rad/s", s.v),
        ("u", "N m", s.u),
        ("q_d", "rad", s.q_d),
        ("v_d", "rad/s", s.dq_d),
        ("error", "rad", s.error),
    ):
        for i in range(signal.shape[1]):
            column = np.array(found.pop(f"{name}{i + 1} [{unit}]"), dtype=float)
            assert np.array_equal(column, signal[:, i])
    for i, name in enumerate(("F_T [N]", "F_N [N]")):
        assert np.array_equal(np.array(found.pop(name), dtype=float), s.ground_reaction[:, i])
    assert set(found) == {"t [s]", "step", "event"}


def test_forces_are_along_the_ground_and_out_of_it(walk):
    """Downhill by 0.02 rad; `Signals` has them along x and z of the world."""
    walk = replace(walk, walker=replace(walk.walker, slope=0.02))
    table, (x, z) = walk.to_pandas(), walk.signals.ground_reaction.T
    c, s = np.cos(0.02), np.sin(0.02)
    assert table["F_T [N]"].to_numpy() == pytest.approx(c * x - s * z)
    assert table["F_N [N]"].to_numpy() == pytest.approx(s * x + c * z)


def test_events_are_where_they_happen(walk):
    """The row named foot_strike has the time of the event and the angles before the impact."""
    table = walk.to_pandas()
    at = table.index[table["event"] == "foot_strike"]
    events = walk.trajectory.events("foot_strike")
    assert list(table["t [s]"][at]) == [event.t for event in events]
    assert set(table["event"]) == {"", "foot_strike"}
    q = [f"q{i} [rad]" for i in range(1, 6)]
    for k, event in zip(at, events, strict=True):
        assert np.array_equal(table[q].to_numpy()[k], event.x_minus[:5])
    assert table["step"].dtype.kind == "i"
    assert table.attrs["note"] == walk.note


def test_the_last_row_of_a_fall_names_what_ended_it(biped, gait):
    """Motors of 5 N m cannot hold the robot: the last row has the name of the event that ended the walk."""
    weak = ba.Walker(biped, ba.NPDController(gait.constraint), torque_limit=5.0)
    fallen = ba.walk(weak, gait, 4)
    assert not fallen.trajectory.status.ok
    assert fallen.to_pandas()["event"].iloc[-1] == fallen.trajectory.arcs[-1].event.guard


def test_the_command_writes_it_and_reads_a_step_of_it(biped, gait, tmp_path):
    """The table of one step, imported as samples, gives back the gait's curves, which NPD tracks."""
    path, out = tmp_path / "step.csv", tmp_path / "gait.json"
    command("simulate", "--controller", "NPD", "--impacts", "1", "-o", path)
    assert list(tmp_path.iterdir()) == [path]
    command("gait", "import", path, "-o", out)
    fitted = ba.load_gait(out, biped).constraint.curve.coefficients
    assert np.allclose(fitted, gait.constraint.curve.coefficients, rtol=0.0, atol=1e-6)
