"""What a reproduction plans, how its pushes are said, how its results reach the documentation."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path

import pytest

from biped_adrc.errors import InputError, OutputError
from biped_adrc.model.biped import Biped
from biped_adrc.paper.plan import PAPER_PUSH, SINE, Plan, base_runs, tasks
from biped_adrc.paper.reproduction import probe
from biped_adrc.scenario.push import Push, parse_push


def test_a_quick_plan_leaves_out_what_it_says() -> None:
    whole, quick = tasks(Plan()), tasks(Plan(quick=True))
    assert set(quick) < set(whole)
    missing = set(whole) - set(quick)
    assert {"multipliers ADRC", "multipliers ADRC measured"} <= missing
    assert not [name for name in quick if name.startswith(("map", "reset", "as printed"))]
    assert not [name for name in quick if "tac2003" in name or "bare" in name]
    assert {"headline NPD", "headline ADRC", "multipliers NPD", "numerics"} <= set(quick)
    assert len(Plan(quick=True).left_out) == 5
    assert Plan().left_out == ("the map of pushes (--full)",)


def test_quick_and_full_exclude_one_another() -> None:
    with pytest.raises(InputError, match="exclude one another"):
        Plan(quick=True, full=True)


def test_a_link_in_its_folder_is_refused_before_minutes_of_walking(tmp_path: Path) -> None:
    probe(tmp_path / "out")
    (tmp_path / "out" / "notes.txt").symlink_to(tmp_path)  # nothing that is written
    probe(tmp_path / "out")
    (tmp_path / "out" / "report.html").symlink_to(tmp_path / "precious.html")
    with pytest.raises(OutputError, match=r"report\.html' is a link to"):
        probe(tmp_path / "out")


def test_the_map_of_pushes_is_of_the_full_plan() -> None:
    def cells(plan: Plan) -> int:
        return sum(len(t.arguments[1]) for name, t in tasks(plan).items() if name[:4] == "map ")

    assert cells(Plan(full=True)) == 3 * 2 * 10 * 5 * 8
    assert cells(Plan()) == cells(Plan(quick=True)) == 0
    assert Plan(full=True).left_out == ()


def test_both_controllers_are_run_alike() -> None:
    runs = base_runs(Plan())
    for name, run in runs.items():
        if name.endswith(" NPD"):
            other = runs[f"{name.removesuffix('NPD')}ADRC"]
            assert (other.pushes, other.mass, other.impacts) == (run.pushes, run.mass, run.impacts)


@pytest.mark.parametrize(
    "push",
    [
        PAPER_PUSH,
        SINE,
        Push({"q1": 30.0, "q3": -20.5, "q4": -20.5}, 7, 0.05, 0.15),
        Push({"q5": 20.0}, 2, 0.1, float("inf"), "step"),
        Push({"q1": 30.0}, 19, 0.1, 0.3, rise=0.01),
        Push({"q1": 30.0}, 19, 0.1, 0.3, rise=1e-05),
    ],
)
def test_a_push_is_said_as_it_is_read(push: Push) -> None:
    assert parse_push(push.text()) == push


def test_only_a_pulse_rises() -> None:
    with pytest.raises(InputError, match="which has a stop, has a rise"):
        parse_push("q1=30@19:0.1-:rise=0.01")
    with pytest.raises(InputError, match="'sine' has no rise"):
        Push({"q1": 30.0}, kind="sine", rise=0.01).disturbance(Biped.load("rabbit"))


# -- the results in the documentation ----------------------------------------------------------------
SUMMARY = {
    "command": "biped-adrc reproduce --out out",
    "preset": "identified",
    "wall_time_s": 12.0,
    "left_out": [],
    "findings": ["One | two *three*.", "Error 1.1e-05 rad."],
    "claims_preface": "Replication, no <data>.",
    "claims_words": {"depends": "in a share"},
    "claims": [
        {
            "claim": "a",
            "where": "II",
            "word": "depends",
            "number": "1",
            "share": "1 of 2",
            "convergence": "2 %",
            "reason": "<n>",
        }
    ],
    "checks": [
        {"name": "c", "kind": "law", "value": 1e-12, "limit": "<= 1e-9", "holds": True},
        {"name": "d", "kind": "reproduced", "value": 2.0, "limit": "<= 1", "holds": False},
    ],
    "tables": {"T": {"columns": ["x", "y"], "rows": [["p", [0.5, None]]]}},
    "notes": ["note"],
    "versions": {"python": "3"},
}


@pytest.fixture
def writer():
    path = Path(__file__).parents[1] / "docs" / "write_results.py"
    spec = importlib.util.spec_from_file_location("write_results", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def project(tmp_path: Path, writer, readme: str) -> tuple[Path, Path]:
    """A run's folder and a project's."""
    out, root = tmp_path / "out", tmp_path / "project"
    for folder in (out, root):
        folder.mkdir()
    (out / "summary.json").write_text(json.dumps(SUMMARY), encoding="utf-8")
    for name in writer.SHOWN:
        (out / f"{name}.svg").write_text(f"<svg>{name}</svg>", encoding="utf-8")
        (out / f"{name}.json").write_text(f'{{"panels": "{name}"}}', encoding="utf-8")
    (root / "README.md").write_text(readme, encoding="utf-8")
    return out, root


def test_results_are_written_from_the_summary(tmp_path: Path, writer) -> None:
    readme = f"# T\n\n{writer.BEGIN}\nold\n{writer.END}\n\nrest\n"
    out, root = project(tmp_path, writer, readme)
    texts = writer.files(out, root)
    found = texts[root / "README.md"]
    assert "old" not in found
    assert found.endswith(f"{writer.END}\n\nrest\n")
    assert "- One \\| two \\*three\\*.\n- Error 1.1e-05 rad.\n" in found
    page = texts[root / "docs" / "results.md"]
    assert "**1 of 2 checks hold.**" in page
    assert "| d | 2 | \\<= 1 | does not hold |" in page
    assert "| a | II | depends | 1 | 1 of 2 | 2 % | \\<n> |" in page
    assert page.index("Replication, no \\<data>.") < page.index("| a | II |")
    assert "- **depends**: in a share" in page
    assert "| p | 0.5, – |" in page
    for name in writer.SHOWN:
        assert f"results/{name}.svg" in page
        assert texts[root / "docs" / "results" / f"{name}.svg"] == f"<svg>{name}</svg>"
        assert texts[root / "docs" / "results" / f"{name}.json"] == f'{{"panels": "{name}"}}'
    assert texts == writer.files(out, root)


def test_results_need_a_run_and_markers(tmp_path: Path, writer) -> None:
    out, root = project(tmp_path, writer, "no markers")
    with pytest.raises(InputError, match="results: begin"):
        writer.files(out, root)
    with pytest.raises(InputError, match="make reproduce"):
        writer.files(tmp_path, root)
