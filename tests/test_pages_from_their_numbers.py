"""Pages that a script wrote from stored numbers say what these numbers say, to the letter."""

from __future__ import annotations

import importlib
import json
import tomllib
from itertools import combinations
from pathlib import Path

import pytest

from biped_adrc.analysis.statistics import paired_ratio
from biped_adrc.bench.compare_study import figures
from biped_adrc.bench.study_file import load_study
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.viz.figure_numbers import as_text, differences, numbers_of
from biped_adrc.viz.plots.push_map import push_map_figure

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"


def read(path):
    """The text of a file of docs/."""
    return (DOCS / path).read_text(encoding="utf-8")


def marked(page, marks):
    """What is between two marks of a page."""
    return page.split(marks[0])[1].split(marks[1])[0].strip()


def leaves(x):
    """The values in nested dictionaries and lists, in order."""
    if isinstance(x, dict | list):
        return [leaf for y in (x.values() if isinstance(x, dict) else x) for leaf in leaves(y)]
    return [x]


def check_numbers(folder, drawn):
    """The files beside the pictures are what the figures drawn now show, and no picture is left over."""
    names = {path.stem for path in (DOCS / folder).glob("*.svg")}
    assert names == set(drawn), (
        f"docs/{folder} has other pictures than its page; remove or make them"
    )
    for name, figure in drawn.items():
        now = json.loads(as_text(numbers_of(figure)))
        assert now["panels"]
        stored = json.loads(read(f"{folder}/{name}.json"))
        assert differences(stored, now) == [], f"docs/{folder}/{name}.svg shows other numbers"
        for old, new in zip(leaves(stored), leaves(now), strict=True):
            same = pytest.approx(new, rel=0.01, abs=0.0) if isinstance(new, float) else new
            assert old == same, name


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
    npd, adrc = (next(r[peak] for r in runs["rows"] if r[0] == f"push {c}") for c in CONTROLLERS)
    readme = (ROOT / "README.md").read_text(encoding="utf-8").replace("\n", " ")
    assert (
        f"NPD leaves its reference by {1e3 * npd:.1f} mrad, ADRC by {1e6 * adrc:.1f} µrad" in readme
    )


def test_the_page_of_the_comparison_is_that_of_its_summary(script):
    module = script("write_comparison")
    summary = module.read(module.FOLDER / "summary.json")
    assert read("comparison.md") == module.page(summary)
    assert module.compact(summary) == read("comparison/summary.json")
    check_numbers("comparison", figures(summary))


def test_observer_guide_and_readme_are_those_of_the_comparison(script):
    module = script("write_comparison")
    summary = module.read(module.FOLDER / "summary.json")
    marks = (module.BEGIN, module.END)
    assert marked(read("guide/observer.md"), marks) == module.guide_part(summary)
    assert marked(read("../README.md"), marks) == module.readme_part(summary)


def test_the_tuned_settings_are_those_of_the_contest(script):
    module = script("write_tuned_sets")
    summary = json.loads(module.SUMMARY.read_text(encoding="utf-8"))
    assert module.SETS.read_text(encoding="utf-8") == module.text(summary)


def test_the_observer_guide_is_that_of_its_walks(script):
    module = script("write_observer_walks")
    walks = module.read()
    assert marked(read("guide/observer.md"), (module.BEGIN, module.END)) == module.part(walks)
    assert module.compact(walks) == module.STORED.read_text(encoding="utf-8")


def test_walks_put_the_observers_in_the_order_of_the_table_above_them(script):
    walks = script("write_observer_walks").read()
    lines = read("guide/observer.md").split("at 5 Hz [s²] |\n")[1].splitlines()[1:8]
    rows = [[x.strip() for x in line.strip("|").split("|")] for line in lines]
    response = {"NPD" if row[0] == "none" else row[0]: float(row[-1]) for row in rows}
    order = sorted(walks, key=lambda m: response[m])
    assert order == ["2", "1", "3", "NPD", "5", "7"]
    for sensors, usual in walks["NPD"].items():
        e = {m: [row["rms_error"] for row in walks[m][sensors]] for m in walks}
        found = {
            m: paired_ratio(e[m], [row["rms_error"] for row in usual], 1.0).value for m in order
        }
        for first, second in combinations(order, 2):
            assert found[first].low <= found[second].high, (sensors, first, second)
        told = [(a, b) for a, b in combinations(order, 2) if found[a].high < found[b].low]
        assert len(told) >= 13  # of 15 pairs


def test_the_pictures_of_the_map_are_those_of_its_cells(script):
    module = script("write_critical_phase")
    cells = module.read(module.FOLDER / "summary.json").cells
    drawn = {
        preset: push_map_figure([cell.row() for cell in cells if cell.preset == preset])
        for preset in module.presets_of(cells)
    }
    check_numbers("critical_phase", drawn)


def test_the_guide_to_sweeps_says_how_many_walks_of_its_maps_are_legal():
    basin, robustness = (json.loads(read(f"images/{n}.json")) for n in ("basin", "robustness"))
    guide = " ".join(read("guide/sweep.md").split())
    for found in (basin, robustness):
        made, legal = (sum(x or 0 for x in found[name]) for name in ("survived", "legal"))
        assert (
            f"{made} of the {found['points']} walks make all steps, {legal} of them legally"
            in guide
        )


def test_the_table_of_replayed_logs_is_that_of_its_numbers(script):
    module = script("write_replay")
    assert marked(read("guide/replay.md"), (module.BEGIN, module.END)) == module.part(module.read())


def test_the_page_of_soft_ground_is_that_of_its_summary(script):
    module, pictures = script("write_soft_walk"), script("soft_page").PICTURES
    summary = module.read(module.FOLDER / "summary.json")
    fresh = module.read(module.FOLDER / "held_out.json")
    assert read("soft_walk.md") == module.page(summary, fresh)
    for name, kept, file in (
        ("summary", summary, module.STUDY),
        ("held_out", fresh, module.HELD_OUT),
    ):
        assert module.compact(kept) == read(f"soft_walk/{name}.json")
        points = load_study(ROOT / file).points()
        assert [row[0] for row in kept["rows"]] == [point.at["case"] for point in points]
    kept = {path.name for path in (DOCS / "soft_walk").iterdir()}
    assert kept == {
        "summary.json",
        "held_out.json",
        *pictures.values(),
        *(f"{name}.json" for name in pictures),
    }


def test_the_page_of_the_contest_is_that_of_its_searches(script):
    module = script("write_tuned")
    summary = module.read(module.FOLDER / "summary.json")
    assert read("tuned.md") == module.page(summary)
    assert module.compact(summary) == read("tuned/summary.json")
    contest, orders = (
        tomllib.loads((module.TUNED / name).read_text(encoding="utf-8"))
        for name in ("contest.toml", "orders.toml")
    )
    assert summary["contest"] == contest, "the searches are of another contest"
    assert summary["orders"]["contest"] == contest | orders, "the orders are of another contest"
    check_numbers("tuned", module.figures(summary))


def test_what_the_walk_needs_is_read_off_the_table_of_runs(script):
    module = script("write_critical_phase")
    columns = ["run", "controller", *module.NEEDS]
    rows = [
        ["nominal bare NPD", "NPD", "bare", "legal", 0.3, 210.0, 63.0, 0.86],
        ["nominal bare ADRC", "ADRC", "bare", "legal", 0.3, 210.0, 63.0, 0.86],
        ["sine NPD", "NPD", "bare", "made", 0.9, 10.0, 99.0, 0.86],
    ]
    summary = {"tables": {"Runs": {"columns": columns, "rows": rows}}}
    assert module.undisturbed(summary) == [["bare", "legal", 0.3, 210.0, 63.0, 0.86]]
