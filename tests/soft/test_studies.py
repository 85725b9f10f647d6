"""The studies of soft ground: what they keep is not computed again, and their tables are of their rows."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from soft import legality, limit, multipliers, policies, rows


def test_rows_that_are_kept_are_not_computed_again(tmp_path):
    asked, kept = [], tmp_path / "deep" / "rows.jsonl"

    def judged(x):
        asked.append(x)
        return {"square": x**2}

    points = [{"x": 2}, {"x": 3}]
    first = rows.found(points[:1], judged, kept)
    assert rows.found(points, judged, kept) == [*first, {"point": {"x": 3}, "square": 9}]
    assert asked == [2, 3]


def test_a_table_is_put_between_its_marks(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("a\n<!-- one -->\nold\n<!-- end of one -->\nb\n")
    for _ in range(2):
        rows.write_between(page, "one", rows.markdown(["x"], [[1]]))
    assert page.read_text() == "a\n<!-- one -->\n| x |\n| --- |\n| 1 |\n<!-- end of one -->\nb\n"


def test_orders_are_those_of_powers():
    assert limit.orders([1.0 + 3.0 * s**2 for s in (0.8, 0.4, 0.2, 0.1)]) == "2.0, 2.0"


def test_the_path_is_soft_and_stiff_as_it_says():
    for point in limit.path(quick=False):
        T = point["time_constant"]
        assert point["h"] <= 0.1 * T
        assert point["period"] / point["h"] == pytest.approx(round(point["period"] / point["h"]))
    usual = limit.path(quick=False)[3]
    assert usual == pytest.approx(limit.USUAL)
    for name, values in limit.HALVED.items():
        np.testing.assert_allclose(np.divide(values[:-1], values[1:]), 2.0)
        assert limit.USUAL[name] in values


def test_what_slips_is_counted():
    def row(rigid, slip, ratio, needed=0.5):
        return {"rigid": rigid, "slip": slip, "impulse ratio": ratio, "friction": 0.6, "needed": needed,
                "soft": "COMPLETED"}  # fmt: skip

    told = legality.summary([row("legal", 1e-3, 0.5), row("legal", 6e-3, 0.7), row("friction", 8e-3, 0.7, 0.8),
                             {"rigid": "other"}])  # fmt: skip
    assert "| legal | 2 | 2 | 1 | 50 % | 1.00, 3.50, 6.00 mm |" in told
    assert "cone too | 1 | 1 | 1 | 100 % | 1.00, 1.00, 1.00 mm |" in told
    assert "| illegal by friction | 1 | 1 | 0 | 0 % |" in told
    assert "Of 4 walks drawn, 1 fell" in told


def test_a_table_of_policies_says_what_moves_at_half_the_step():
    """Of three grounds: 10 % of a touchdown's error and 2 % of a push's, and a walk that is lost."""
    found = []
    for point in policies.points(quick=True):
        half = point["h"] < policies.STEP
        first = (point["policy"], point["time_constant"]) == ("–", 5e-3)
        row = {"touchdown": 2.2e-3 if half and first else 2e-3, "push": 4.9e-3 if half else 5e-3}
        if (point["policy"] != "–") and point["time_constant"] == 10e-3:
            row = {"touchdown": None, "push": None}
        found.append({"point": point, **row})
    *_, npd, lost = policies.policy_table(found).splitlines()
    assert npd == "| NPD | – | 2 | 5 | 2 | 5 | 2 | 5 | 10.0 % | 2.0 % |"
    assert lost == (
        "|  | `impact invariant`, rate error, 15 ms | 2 | 5 | 2 | 5 | lost | lost | 0.0 % | 2.0 % |"
    )
    found[-1].update(touchdown=1e-3, push=1e-3)
    assert policies.policy_table(found).count("other walks are lost") == 2


def test_a_table_of_multipliers_says_what_is_below_the_floor():
    row = {"point": {"controller": "NPD", "period": 1e-3, "size": 0.25, "time_constant": 2e-3},
           "status": "cycle", "magnitudes": [0.7, 0.002], "low": 0.6, "high": 0.8, "floor": 0.01, "rigid": 0.71,
           "nearby": 0.72, "left": 1.0, "scatter": 1e-5}  # fmt: skip
    (line,) = multipliers.study_table([row]).splitlines()[2:]
    assert line == (
        "| NPD | 1 ms | 1.25 mrad | 0.7000 | 0.6000 to 0.8000 | 0.7100 | 0.7200 | 0.0100 | 0.0020 (below) | "
        "1.0 | 0.01 mrad/s |"
    )
    lost = {"point": row["point"], "status": "no cycle", "rigid": 0.71, "nearby": 0.72}
    assert (
        multipliers.path_table([lost]).splitlines()[2].startswith("| NPD | 2 ms | no cycle | – |")
    )
    assert "0.0020 |" in multipliers.study_table([row | {"floor": 0.001}])
