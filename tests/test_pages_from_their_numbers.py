"""Pages that a script wrote from stored numbers say what these numbers say, to the letter."""

from __future__ import annotations

import importlib
import json
from pathlib import Path

import pytest

from biped_adrc.studies.plan import BOTH

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
    study = module.read(module.FOLDER / "summary.json")
    assert module.PAGE.read_text(encoding="utf-8") == module.page(study)
    assert module.compact(study) == (module.FOLDER / "summary.json").read_text(encoding="utf-8")


def test_the_caption_of_the_readme_has_the_numbers_of_the_runs():
    stored = (ROOT / "docs" / "results" / "summary.json").read_text(encoding="utf-8")
    runs = json.loads(stored)["tables"]["Runs"]
    peak = runs["columns"].index("peak error [rad]")
    npd, adrc = (next(r[peak] for r in runs["rows"] if r[0] == f"push {c}") for c in BOTH)
    readme = (ROOT / "README.md").read_text(encoding="utf-8").replace("\n", " ")
    assert (
        f"NPD leaves its reference by {1e3 * npd:.1f} mrad, ADRC by {1e6 * adrc:.1f} µrad" in readme
    )
