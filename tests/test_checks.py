"""Checks at their limits, exit codes of errors, and classes of values that cannot be changed."""

from __future__ import annotations

import math

import pytest

from biped_adrc.core import errors
from biped_adrc.core.verdict import at_least, at_most, below, between


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
