"""Checks at their limits, exit codes of errors, and classes of values that cannot be changed."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

from biped_adrc import errors
from biped_adrc.checks import at_least, at_most, below, between

PACKAGE = Path(errors.__file__).parent


@pytest.mark.parametrize(
    ("check", "inside", "outside"),
    [
        (lambda x: at_most("x", "law", x, 2.0), (1.9, 2.0, -math.inf), (2.1, math.inf, math.nan)),
        (lambda x: at_least("x", "law", x, 2.0), (2.1, 2.0, math.inf), (1.9, -math.inf, math.nan)),
        (lambda x: below("x", "law", x, 2.0), (1.9, -math.inf), (2.0, 2.1, math.inf, math.nan)),
        (lambda x: between("x", "law", x, 1.0, 2.0), (1.0, 1.5, 2.0), (0.9, 2.1, math.nan)),
    ],
)
def test_a_check_holds_up_to_its_limit(check, inside, outside):
    assert [check(x).holds for x in inside] == [True] * len(inside)
    assert [check(x).holds for x in outside] == [False] * len(outside)


def test_errors_have_the_exit_codes_of_the_help():
    codes = {"BipedError": 3, "InputError": 3, "GaitError": 3, "ModelError": 3, "OutputError": 5}
    assert {name: getattr(errors, name).exit_code for name in codes} == codes


CHANGING = {
    "bench/compare_study.py": {"Stored"},
    "bench/table_reader.py": {"TableReader"},
    "campaign/execute.py": {"_Flight"},
    "campaign/workers.py": {"Kept"},
    "engine/ticks.py": {"NoReference"},
    "hybrid/simulator.py": {"Record"},
    "scenario/controllers.py": {"ControllerMaker"},
    "scenario/walker_record.py": {"Reader", "Writer"},
    "tuning/walks.py": {"StoredWalks"},
}
"""Dataclasses that change on purpose, by file: what a run counts, and what is filled while it goes on."""


def test_dataclasses_are_frozen_but_for_those_that_count():
    loose: dict[str, set[str]] = {}
    for path in PACKAGE.rglob("*.py"):
        found = re.findall(
            r"^ *@(?:\w+\.)?dataclass\b(.*)\n(?: *@.*\n)* *class (\w+)",
            path.read_text("utf-8"),
            re.M,
        )
        if changing := {name for options, name in found if "frozen=True" not in options}:
            loose[path.relative_to(PACKAGE).as_posix()] = changing
    assert loose == CHANGING
