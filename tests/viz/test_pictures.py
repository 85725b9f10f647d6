"""The check of the pictures in docs/: a number that is off and a file that is missing are named."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from matplotlib.figure import Figure

from biped_adrc.errors import InputError
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.push_map import Fate, PushCell
from biped_adrc.scenario.run import walk_scenario as execute
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.viz.figure_numbers import Numbers, as_text, numbers_of
from biped_adrc.viz.plots.figures import comparison_figure

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture
def scripts(monkeypatch: pytest.MonkeyPatch) -> Iterator[dict[str, ModuleType]]:
    """The scripts of docs/, which import one another."""
    monkeypatch.syspath_prepend(str(DOCS))
    names = ("check_pictures", "make_pictures", "make_maps", "write_comparison")
    names += ("write_critical_phase", "write_results")
    for name in names:
        monkeypatch.delitem(sys.modules, name, raising=False)
    yield {name: __import__(name) for name in names}
    for name in names:
        sys.modules.pop(name, None)


def figure_numbers() -> Numbers:
    t = np.linspace(0.0, 1.0, 50)
    return {
        "panels": [{"lines": {"NPD": {"y": [0.0, 7.5e-3], "samples": (7e-3 * t[:5]).tolist()}}}]
    }


def shown(scripts: dict[str, ModuleType], folder: Path, now: Numbers) -> list[str]:
    picture = folder / "figure4.svg"
    return scripts["check_pictures"].complaints(
        [scripts["check_pictures"].Picture(picture, "make results", lambda _: now)]
    )


def test_a_number_off_by_two_percent_is_named(
    scripts: dict[str, ModuleType], tmp_path: Path
) -> None:
    old = figure_numbers()
    (tmp_path / "figure4.svg").write_text("<svg/>")
    (tmp_path / "figure4.json").write_text(as_text(old))
    now = json.loads(as_text(old))
    assert shown(scripts, tmp_path, now) == []
    now["panels"][0]["lines"]["NPD"]["y"][1] = 1.009 * 7.5e-3
    assert shown(scripts, tmp_path, now) == []
    now["panels"][0]["lines"]["NPD"]["y"][1] = 1.02 * 7.5e-3
    (line,) = shown(scripts, tmp_path, now)
    for part in ("figure4.svg", "NPD", "0.0075 in the file", "0.00765 now", "make results"):
        assert part in line


def test_missing_files_are_named(scripts: dict[str, ModuleType], tmp_path: Path) -> None:
    for name in ("figure4.svg", "figure4.json"):
        for found in ("figure4.svg", "figure4.json"):
            (tmp_path / found).write_text(as_text(figure_numbers()))
        (tmp_path / name).unlink()
        (line,) = shown(scripts, tmp_path, figure_numbers())
        assert f"'{name}' is not there" in line
    (tmp_path / "other.gif").write_text("GIF")
    (line,) = scripts["check_pictures"].without_numbers([tmp_path], [])[1:]
    assert "other.gif: no command makes it" in line


def test_every_picture_of_a_run_is_checked(
    scripts: dict[str, ModuleType], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All but the figures of a reproduction, which are taken from its folder, with two short walks."""
    walks = {c: execute(Scenario(c, impacts=1, h=2e-3)) for c in CONTROLLERS}
    made = scripts["make_pictures"]
    monkeypatch.setattr(made, "load", lambda out: walks)
    monkeypatch.setattr(made, "part", lambda walks: (0.1, 0.3))
    found = scripts["check_pictures"].pictures(tmp_path)
    names = {f"{picture.path.parent.name}/{picture.path.name}" for picture in found}
    on_pages = {
        f"{folder}/{path.name}"
        for folder in ("images", "results")
        for path in (DOCS / folder).iterdir()
        if path.suffix != ".json"
    }
    assert names == on_pages
    by_name = {
        picture.path.stem: picture for picture in found if picture.path.parent.name == "images"
    }
    signals = {name: walk.signals for name, walk in walks.items()}
    assert by_name["comparison"].now({}) == numbers_of(comparison_figure(signals))
    animated = by_name["walk"].now({})
    assert animated["clip"]["magnified"] == 30.0
    for name, s in signals.items():
        rows = (s.t >= 0.1) & (s.t <= 0.3)
        largest = animated["largest error [rad]"]["lines"][name]["y"][1]
        assert largest == pytest.approx(np.max(np.abs(s.error[rows])), rel=1e-4)


def test_a_map_is_checked_by_running_some_of_its_points_again(
    scripts: dict[str, ModuleType], monkeypatch: pytest.MonkeyPatch
) -> None:
    maps = scripts["make_maps"]
    asked = []

    def run(records):
        asked.extend(records)
        return [{"survived": 1, "legal": 0} for _ in records]

    monkeypatch.setattr(maps, "run_trials", run)
    old = {"points": 98, "survived": [0] * 98, "legal": [0] * 98}
    now = maps.again("basin", old)
    assert len(asked) == sum(now["survived"]) == 6
    assert len({record.get("controller") for record in asked}) == 2
    assert len(scripts["check_pictures"].differences(old, now)) == 6
    del old["legal"]
    assert len(scripts["check_pictures"].differences(old, now)) == 7


def test_pictures_of_long_runs_are_held_against_the_summaries_that_are_kept(
    scripts: dict[str, ModuleType], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a map of one cell and of a comparison of one figure; then a walk of the map was another."""
    check, compared, pushed = (
        scripts[name] for name in ("check_pictures", "write_comparison", "write_critical_phase")
    )
    folders = tmp_path / "comparison", tmp_path / "critical_phase"
    monkeypatch.setattr(compared, "FOLDER", folders[0])
    monkeypatch.setattr(pushed, "FOLDER", folders[1])
    monkeypatch.setattr(check, "figures", lambda summary: {summary["name"]: Figure()})
    monkeypatch.setattr(check.write_tuned, "figures", lambda summary: {})
    legal = Fate("legal", "COMPLETED", 100.0, 0.4, 0.5)
    cell = PushCell("identified", 0.1, 20.0, "all +", 150.0, legal, legal)
    for folder in folders:
        folder.mkdir()
    (folders[0] / "summary.json").write_text('{"name": "legal"}')
    (folders[1] / "summary.json").write_text(pushed.compact(pushed.Study([cell], [[]])))
    for picture in check.kept():
        picture.path.write_text("<svg/>")
        picture.path.with_suffix(".json").write_text(as_text(picture.now({})))
    assert {f"{p.path.parent.name}/{p.path.stem}" for p in check.kept()} == {
        "comparison/legal",
        "critical_phase/identified",
    }
    assert check.complaints(check.kept()) == check.without_numbers(folders, check.kept()) == []
    fell = replace(cell, adrc=Fate("fell", "FELL", None, None, None))
    (folders[1] / "summary.json").write_text(pushed.compact(pushed.Study([fell], [[]])))
    (line,) = check.complaints(check.kept())
    assert "critical_phase/identified.svg" in line
    (folders[0] / "survival.svg").write_text("<svg/>")
    (line,) = check.without_numbers(folders, check.kept())
    assert "survival.svg: no command makes it" in line
    (folders[0] / "summary.json").unlink()
    with pytest.raises(InputError, match="biped-adrc compare"):
        check.kept()
