"""What a reproduction plans, and how its pushes are said."""

from __future__ import annotations

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
