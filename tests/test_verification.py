"""The rows of docs/verification.csv hold; of the slow groups some of them.

A row compares a number of the package (found) with one that was published or has a closed form (expected),
within a tolerance. `PARTS` are functions that compute the rows of a group; `check(rows)`: all hold, and the
stored table has their numbers.
"""

from __future__ import annotations

import csv
import math
import sys
from functools import cache, partial
from pathlib import Path

import pytest

from biped_adrc.core.errors import InputError
from biped_adrc.gait.gait import gait_names
from biped_adrc.model.robots.robot_toml import robot_names
from validation import __main__ as command
from validation import frost_urdf, gaits, other_tools, passive, rabbit, three_link
from validation.groups import Group, Maker, group_named, groups
from validation.rabbit import SPEEDS, design_rows
from validation.row import COLUMNS, PRESETS, Measure, Row, at_most

PARTS: dict[str, Maker] = {
    "bouncing ball": passive.ball_rows,
    "rimless wheel": passive.wheel_rows,
    "simplest walker": passive.simplest_rows,
    "its short step": passive.short_step_rows,
    "its heavy feet": passive.heavy_feet_rows,
    "compass gait": passive.compass_rows,
    "three-link walker": partial(three_link.three_link_rows, source=False),
    "1.05 m/s as printed": rabbit.printed_rows,
    "1.05 m/s designed": rabbit.designed_rows,
    "Table I": rabbit.poles_row,
    "x* identified": partial(rabbit.fixed_point_rows, "identified"),
    "other coordinates": frost_urdf.sense_rows,
    "pyadrc": other_tools.pyadrc_rows,
    "python-control": other_tools.control_rows,
    **{f"multipliers, {x}": partial(gaits.robot_rows, x) for x in gaits.ROBOTS},
    "design identified": partial(design_rows, "identified", 0.7),
}


STORED = Path(__file__).resolve().parents[1] / "docs" / "verification.csv"


@cache
def stored() -> dict[tuple[str, str], list[dict[str, str]]]:
    """The rows of docs/verification.csv by system and quantity, cells by column."""
    found: dict[tuple[str, str], list[dict[str, str]]] = {}
    with STORED.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault((row["system"], row["quantity"]), []).append(row)
    return found


def is_stored(row: Row, shown: dict[str, str]) -> bool:
    """Whether a stored row has this row's numbers: within 1 %, or within what the row allows."""
    allowed = {Measure.ABSOLUTE: row.tolerance or 0.0, Measure.AT_MOST: row.expected}
    limit = max(0.01 * abs(row.found), allowed.get(row.measure, 0.0))
    expected = float(shown["expected"].removeprefix("at most "))
    close = abs(expected - row.expected) <= max(1e-6 * abs(row.expected), 1e-12)
    return close and shown["verdict"] == "holds" and abs(float(shown["found"]) - row.found) <= limit


def check(rows: tuple[Row, ...]) -> None:
    """All rows with a target hold, and docs/verification.csv has their numbers."""
    targets = [row for row in rows if row.has_target]
    assert targets
    for row in targets:
        assert row.holds, (row.system, row.quantity, row.expected, row.found)
        lines = stored()[row.system, row.quantity]
        assert any(is_stored(row, shown) for shown in lines), (row.expected, row.found, lines)


def test_a_number_changed_in_the_table_is_noticed() -> None:
    """The comparison of a row with the stored one takes 1 % of what was found: 2 % more, or an expected
    number 0.1 % off, is not the same row."""
    row = passive.ball_rows()[0]
    shown = stored()[row.system, row.quantity][0]
    assert is_stored(row, shown)
    assert not is_stored(row, {**shown, "found": f"{1.02 * row.found}"})
    assert not is_stored(row, {**shown, "expected": f"{1.001 * row.expected}"})


@pytest.mark.parametrize("name", PARTS)
def test_each_group_of_the_verification_holds(name: str) -> None:
    """The group is computed again here: every row with a target holds and is in docs/verification.csv."""
    check(PARTS[name]())


@pytest.mark.parametrize("preset", PRESETS)
def test_work_of_every_stored_gait(preset: str) -> None:
    """For each gait whose impact keeps its constraint: the work of the joints in a step is the energy that
    the impact loses."""
    rows = gaits.work_rows(preset)
    assert len(rows) == len(gaits.invariant_gaits(preset))
    check(rows)


@pytest.mark.parametrize(
    ("preset", "gait"), [*zip(PRESETS, ["published", "v1.1", "published"], strict=True)]
)
def test_multiplier_of_stored_gaits(preset: str, gait: str) -> None:
    """The largest multiplier of the simulated walk is delta^2 of the zero dynamics; one gait of each
    preset stands for all, as the walks are slow."""
    check(gaits.multiplier_rows(preset, gait))


def test_groups_are_complete() -> None:
    """Every stored gait but the one whose impact leaves its constraint, every robot and every speed."""
    count = {group.name: len(group.makers) for group in groups()}
    stored = {preset: set(gaits.invariant_gaits(preset)) for preset in PRESETS}
    for preset, names in stored.items():
        assert names == set(gait_names("rabbit", preset)) - {"recipe"}
        assert names >= {"published", *(f"v{speed:g}" for speed in SPEEDS)}
    assert count["multipliers"] == sum(map(len, stored.values()))
    # each of two presets: a gait for each speed, and the one through x* of the paper
    assert count["design"] == 2 * (1 + len(SPEEDS))
    assert set(gaits.ROBOTS) == set(robot_names())
    with pytest.raises(InputError, match=r"no group 'coffee'; choose one of \['passive'"):
        group_named("coffee")


# -- the rows themselves ---------------------------------------------------------------------------
def row(found: float, tolerance: float | None = 0.1, **more: object) -> Row:
    return Row("s", "q", 2.0, found, tolerance, "source", **more)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("one", "verdict"),
    [
        (row(2.19), "holds"),
        (row(1.79), "DOES NOT HOLD"),
        (row(2.2, measure=Measure.ABSOLUTE), "DOES NOT HOLD"),
        (row(1.91, measure=Measure.ABSOLUTE), "holds"),
        (row(7.0, None), "no target"),
        (row(math.nan), "DOES NOT HOLD"),
        (row(math.nan, measure=Measure.ABSOLUTE), "DOES NOT HOLD"),
        (at_most("s", "q", 1.0, 1.0, "source"), "holds"),
        (at_most("s", "q", 1.0, 1.0001, "source"), "DOES NOT HOLD"),
        (at_most("s", "q", 1.0, math.nan, "source"), "DOES NOT HOLD"),
    ],
)
def test_the_verdict_of_a_row_follows_from_its_numbers(one: Row, verdict: str) -> None:
    """`row(found)` expects 2.0 with a tolerance of 0.1: relative by default (1.8 to 2.2), or absolute (1.9 to
    2.1). Without a tolerance there is no target; NaN never holds."""
    assert one.verdict == verdict
    assert one.holds == (verdict == "holds")
    assert len(one.cells()) == len(COLUMNS)


def test_a_row_with_a_negative_tolerance_or_one_relative_to_zero_is_refused() -> None:
    """A negative tolerance can never hold, and a share of zero is zero: an absolute one has to be taken."""
    with pytest.raises(InputError, match="tolerance of 'q' is -1"):
        row(2.0, -1.0)
    with pytest.raises(InputError, match=r"take Measure\.ABSOLUTE"):
        Row("s", "q", 0.0, 1.0, 0.1, "source")  # target 0, found 1, tolerance 0.1


# -- the command -----------------------------------------------------------------------------------
def test_the_command_prints_a_group_and_names_those_there_are(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Group "senses" has 9 rows: the table on stdout, the count on stderr. A group that is not there ends
    with an error's code and the names of those that are."""
    monkeypatch.setattr(sys, "argv", ["validation", "--only", "senses"])
    assert command.main() == 0
    out = capsys.readouterr()
    rows = list(csv.DictReader(out.out.splitlines()))
    assert [row["verdict"] for row in rows] == ["holds"] * len(frost_urdf.sense_rows())
    assert "9 of 9 rows hold, 0 without a target" in out.err
    monkeypatch.setattr(sys, "argv", ["validation", "--only", "coffee"])
    assert command.main() == InputError.exit_code
    assert "no group 'coffee'" in capsys.readouterr().err


def test_a_row_that_does_not_hold_fails_the_command(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """A made-up group of 3.0 and 2.0 where 2.0 is expected, and a row without a target: exit code 1, and the
    table is written all the same."""
    group = Group("g", (lambda: (row(3.0), row(2.0), row(7.0, None)),))
    monkeypatch.setattr(command, "groups", lambda: (group,))
    monkeypatch.setattr(sys, "argv", ["validation", "--out", str(tmp_path / "rows.csv")])
    assert command.main() == 1
    said = capsys.readouterr().err
    assert "does not hold: s, q" in said
    assert "1 of 2 rows hold, 1 without a target" in said
    assert (tmp_path / "rows.csv").read_text().splitlines()[1].startswith("g,s,q,2,3,")


def test_every_row_of_the_groups_is_stored() -> None:
    """326 rows in docs/verification.csv, of which 313 hold and 13 have no target: none was dropped, and no
    group of the code is missing."""
    count = sum(len(rows) for rows in stored().values())
    held = [row["verdict"] for rows in stored().values() for row in rows]
    assert (count, held.count("holds"), held.count("no target")) == (326, 313, 13)
    assert {row["group"] for rows in stored().values() for row in rows} == {
        g.name for g in groups()
    }
