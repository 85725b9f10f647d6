"""What a reproduction plans, and how its pushes are said."""

from __future__ import annotations

import pytest

from biped_adrc.paper.runs import tasks
from biped_adrc.paper.scenarios import PAPER_PUSH, SINE, Plan, base_runs
from biped_adrc.scenario.push import Push, parse_push


def test_a_quick_plan_leaves_out_what_it_says() -> None:
    whole, quick = tasks(Plan()), tasks(Plan(quick=True))
    assert set(quick) < set(whole)
    missing = set(whole) - set(quick)
    assert {"multipliers/ADRC", "multipliers/ADRC measured"} <= missing
    assert not [name for name in quick if name.startswith(("runs/reset", "runs/as printed"))]
    assert not [name for name in quick if "tac2003" in name or "bare" in name]
    assert {"headline/NPD", "headline/ADRC", "multipliers/NPD"} <= set(quick)
    assert len(Plan(quick=True).left_out) == 5
    assert len(Plan().left_out) == 1
    full = [task for name, task in tasks(Plan(full=True)).items() if name.startswith("map/")]
    assert sum(len(task.arguments[0]) for task in full) == 2400


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
