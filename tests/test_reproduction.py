"""What a reproduction plans, and how its pushes are said."""

from __future__ import annotations

from biped_adrc.paper.runs import tasks
from biped_adrc.paper.scenarios import Plan, base_runs


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
            assert (other.pushes, other.errors) == (run.pushes, run.errors)
            assert other.run.impacts == run.run.impacts
