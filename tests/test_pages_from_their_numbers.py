"""Pages that a script wrote from stored numbers say what these numbers say, to the letter."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def script(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    return importlib.import_module


def test_results_and_readme_are_those_of_the_stored_summary(script):
    found = script("write_results").files(ROOT / "docs" / "results")
    assert {ROOT / "README.md", ROOT / "docs" / "results.md"} <= set(found)
    for path, text in found.items():
        assert path.read_text(encoding="utf-8") == text, f"{path} is not what its numbers say"


def test_the_page_of_the_map_is_that_of_its_cells(script):
    module = script("write_critical_phase")
    cells = module.read(module.FOLDER / "summary.json")
    assert module.PAGE.read_text(encoding="utf-8") == module.page(cells)
    assert module.compact(cells) == (module.FOLDER / "summary.json").read_text(encoding="utf-8")
