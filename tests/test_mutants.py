"""The tables of faults: every folder has its tests, and every fault is of a line that is still there."""

from __future__ import annotations

import importlib
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def tool() -> Iterator[object]:
    """benchmarks/mutants.py as a module."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(ROOT / "benchmarks")
        yield importlib.import_module("mutants")
    for name in ("mutants", "mutations"):
        del sys.modules[name]


def table(name: str) -> dict:
    return tomllib.loads((ROOT / "benchmarks" / name).read_text(encoding="utf-8"))


def test_every_folder_has_tests_that_there_are() -> None:
    tests = table("mutants.toml")["tests"]
    folders = {path.parent.name for path in (ROOT / "biped_adrc").glob("*/*.py")}
    assert set(tests) == folders | {"."}
    assert [name for names in tests.values() for name in names if not (ROOT / name).exists()] == []


def test_every_fault_of_the_table_can_be_put_in_and_names_its_test(tool) -> None:
    faults = table("faults.toml")["fault"]
    assert len(faults) > 60
    for fault in faults:
        text = (ROOT / fault["file"]).read_text(encoding="utf-8")
        assert text.count(fault["before"]) == 1, fault["what"]
        changed = tool.put_in(text, fault)
        assert changed == text.replace(fault["before"], fault["after"]) != text
        file, _, name = fault["test"].partition("::")
        assert f"def {name.partition('[')[0]}(" in (ROOT / file).read_text(encoding="utf-8")


def test_a_fault_is_put_in_at_the_line_nearest_to_its_own(tool) -> None:
    fault = {"before": "a = 1", "after": "a = 2", "line": 4}
    text = "a = 1\nb = 1\nc = 1\n\na = 1\n"
    assert tool.put_in(text, fault) == "a = 1\nb = 1\nc = 1\n\na = 2\n"
    assert tool.put_in(text, fault | {"line": 1}) == "a = 2\nb = 1\nc = 1\n\na = 1\n"
    assert tool.put_in("b = 1\n", fault) is None


def test_the_share_is_of_those_that_are_not_equivalent(tool) -> None:
    faults = [
        {"folder": "cli", "file": "f.py", "line": k, "before": f"a = {k}", "after": f"b = {k}"}
        for k in range(5)
    ]
    words = ("noticed", "noticed", "survived", "survived", "gone")
    results = {tool.key(f): f | {"verdict": w} for f, w in zip(faults, words, strict=True)}
    judged = [faults[2] | {"equivalent": "the same number"}]
    told = tool.report(faults, results, judged)
    assert "| cli | 4 | 2 | 1 | 1 | 67 % |" in told
    assert "| all | 4 | 2 | 1 | 1 | 67 % |" in told
    assert "f.py:2, equivalent: the same number" in told
    assert "f.py:3, open" in told
    assert "4 of 5 faults have been run" in told
