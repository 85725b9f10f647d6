"""A few scenarios and a call are as the stored photograph has them, and a change would be seen."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import pytest

from . import commands
from .compare import (
    DIFFERS,
    EQUAL,
    WITHIN,
    Comparison,
    allowed_in,
    call_words,
    scenario_words,
    text_word,
)
from .compare import (
    compared as compared_folders,
)
from .scenarios import scenario
from .take import scenario_record

HERE = Path(__file__).parent
SOME = ("010", "027", "035", "103")


def stored(name: str) -> Any:
    """A file of the stored photograph."""
    return json.loads((HERE / "before" / f"{name}.json").read_text(encoding="utf-8"))


def compared(before: Any, after: Any) -> Comparison:
    """Scenarios, with what is allowed to differ."""
    c = Comparison()
    scenario_words(c, before, after)
    c.allow(allowed_in(HERE / "allowed.txt"))
    return c


@pytest.mark.parametrize("k", SOME)
def test_scenario_is_as_stored(k: str) -> None:
    before = stored("scenarios")[k]
    c = compared({k: before}, {k: scenario_record(before["scenario"])})
    assert len(c.findings) > 10
    assert not c.broken, "\n".join(f"{f.key} {f.text}" for f in c.broken)


def test_call_is_as_stored(tmp_path: Path) -> None:
    call = next(call for call in commands.CHAINS["gaits"] if call.name == "show")
    after = json.loads(json.dumps(commands.called(call, tmp_path, {})))
    c = Comparison()
    call_words(c, "gaits/show", stored("commands")["gaits/show"], after)
    c.allow(allowed_in(HERE / "allowed.txt"))
    assert not c.broken, "\n".join(f"{f.key} {f.text}" for f in c.broken)


def test_scenarios_are_drawn_as_stored() -> None:
    for k, record in stored("scenarios").items():
        assert scenario(int(k)) == record["scenario"]


def test_a_change_is_seen() -> None:
    before = {SOME[0]: stored("scenarios")[SOME[0]]}
    walk = before[SOME[0]]["found"]["compiled"]
    for share, word in ((0.0, EQUAL), (1e-14, WITHIN), (1e-5, DIFFERS)):
        after = copy.deepcopy(before)
        numbers = after[SOME[0]]["found"]["compiled"]["numbers"]["x"]
        numbers[0] += share
        found = {f.key: f.word for f in compared(before, after).findings}
        assert found[f"scenarios/{SOME[0]}/compiled/x"] == word
    other = "FELL" if walk["words"]["status"] != "FELL" else "STALLED"
    after[SOME[0]]["found"]["compiled"]["words"]["status"] = other
    assert f"scenarios/{SOME[0]}/compiled/status" in {f.key for f in compared(before, after).broken}


def test_texts_may_differ_by_round_off_alone() -> None:
    assert text_word("peak 0.0075391 rad", "peak 0.0075392 rad") == WITHIN
    assert text_word("residual 1.2e-13", "residual 4.7e-13") == WITHIN
    assert text_word("3 impacts", "4 impacts") == DIFFERS
    assert text_word("peak 0.0075391 rad", "peak 0.0075411 rad") == DIFFERS
    assert text_word("it fell", "it walked") == DIFFERS


def test_an_allowed_difference_needs_a_reason(tmp_path: Path) -> None:
    path = tmp_path / "allowed.txt"
    path.write_text("# a comment\n\nscenarios/*/why  # compiled now\n", encoding="utf-8")
    assert allowed_in(path) == [("scenarios/*/why", "compiled now")]
    path.write_text("scenarios/*/why\n", encoding="utf-8")
    with pytest.raises(ValueError, match="has no reason"):
        allowed_in(path)


def test_what_is_not_there_is_not_the_same(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="nothing in common"):
        compared_folders(HERE / "before", tmp_path)
