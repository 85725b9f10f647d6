"""A few scenarios of every attack, as CI has time for; the long ones are `make attacks`."""

from __future__ import annotations

import pytest

from tests.robustness import contact, engines, searches, steps

SOME = (0, 5, 55)
"""Of the engines' scenarios; in 55 the slope is lost within a step of the stiff method."""
SOFT = (1, 3)
"""Of the walks across contact: one on soft ground, one whose touchdowns are told."""


@pytest.mark.parametrize("k", SOME)
def test_scenario_in_both_engines(k: int) -> None:
    found = engines.judged(k)
    assert found["word"] not in engines.FAULTS, found


def no_walk(*_: object) -> None:
    """A walk that is never made."""
    raise AssertionError


@pytest.mark.parametrize("k", SOFT)
def test_walk_across_contact_in_both_engines(k: int) -> None:
    found = contact.judged(k)
    assert found["word"] not in contact.FAULTS, found


def test_what_is_wrong_is_told() -> None:
    end = {"status": "FELL", "impacts": 1, "times": [0.4], "states": [1.0], "bad": []}
    assert engines.verdict(no_walk, [end, end])[0] == engines.SAME
    assert engines.verdict(no_walk, [end, {**end, "bad": ["arc 0 x"]}])[0] == engines.NAN
    assert (
        engines.verdict(no_walk, [end, {"traceback": "ValueError: f(a)"}])[0] == engines.TRACEBACK
    )
    assert engines.verdict(no_walk, [end, {"refused": "no"}])[0] == engines.STATUSES
    row = {**dict.fromkeys(steps.FLOORS, 1.0), "status": "COMPLETED"}
    assert steps.agrees("speed", row, {**row, "speed": 1.04})
    assert not steps.agrees("speed", row, {**row, "speed": 1.06})
    assert not steps.agrees("speed", row, {**row, "speed": None})
    assert steps.agrees("peak_error", {"peak_error": 1e-5}, {"peak_error": 9e-5})


@pytest.mark.parametrize("k", [0])
def test_walk_at_a_quarter_of_the_step(k: int) -> None:
    found = steps.judged(k)
    assert not found["off"], found
    assert not found["changed"] or found["edge"], found


def test_a_table_has_a_row_for_every_word() -> None:
    found = {"k": 3, "kind": "walker", "word": engines.NAN, "why": "x", "status": ["FELL"]}
    assert f"| {engines.NAN} | 1 | 1 |" in engines.table([found])
    assert engines.faults([found]) == ["3 walker: NAN x"]
    changed = {"k": 1, "status": ["FELL", "COMPLETED"], "off": {}, "edge": False, "changed": True}
    changed["chatters"] = None
    assert "| another end, not near an edge | 1 |" in steps.table([changed])
    killed = {"k": 2, "way": "killed", "found": 9, "rows": 90, "same": {"rows": False}}
    assert "| killed | 9 | 90 | NO |" in searches.table([killed])
    assert searches.faults([killed]) == ["2 killed: {'rows': False}"]
    few = "0 of 1 agree, expected 95 %"
    assert steps.faults([changed]) == ["1: ['FELL', 'COMPLETED']", few]
