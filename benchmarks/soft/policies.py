"""What policies across contact do on soft ground: one walk for each entry of a table, and by how much it moves.

Run: python benchmarks/soft/policies.py [OUT] [--quick] [--page docs/guide/contact.md]

Each walk is walked again at half the engine's step. An entry that moves by much says more of the contact's own
transient than of a policy. Rows are kept in OUT/soft_policies.jsonl, from where an interrupted run goes on.
About 5 minutes.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments
from soft.rows import Row, found, markdown, write_between

import biped_adrc as ba
from biped_adrc.analysis.contact_errors import contact_errors
from biped_adrc.scenario.run import walk_scenario

TIMES = (2e-3, 5e-3, 10e-3)
"""Time constants of the ground [s]."""
STEP = 2e-4
"""Of the engine [s]."""
PUSH = "q1,q2,q3,q4=30@4:0.1-0.3"
USUAL: dict[str, Any] = {
    "plant": "mujoco", "ground_friction": 0.8, "period": 1e-3, "torque_limit": 150.0, "impacts": 5,
}  # fmt: skip
SLOW = {"controller": "LESO", "bandwidth": 500.0}
OF_ORDER_2 = {"controller": "LESO", "bandwidth": 160.0, "order": 2}
TABLE_I, DOB, NPD = ({"controller": name} for name in ("ADRC", "DOB", "NPD"))


def across(name: str, window: float, **own: bool) -> Row:
    """A policy with its window [s] and what it takes beside."""
    return {"contact": name, "contact_window": window, **({"own": own} if own else {})}


INNOVATION = across("impact invariant", 5e-3, innovation=True, rates=False)
CASES: dict[tuple[str, str], Row] = {
    ("NPD", "–"): NPD,
    ("NPD", "`impact invariant`, rate error, 15 ms"): NPD | across("impact invariant", 15e-3),
    ("m = 1, 500 rad/s", "reset `relabel`"): SLOW | {"reset": "relabel"},
    ("m = 1, 500 rad/s", "reset `measured`"): SLOW | {"reset": "measured"},
    ("m = 1, 500 rad/s", "reset `model`"): SLOW | {"reset": "model"},
    ("m = 1, 500 rad/s", "`keep torque`"): SLOW | {"contact": "keep torque"},
    ("m = 1, 500 rad/s", "`hold`, 15 ms"): SLOW | across("hold", 15e-3),
    ("m = 1, 500 rad/s", "`hold`, 40 ms"): SLOW | across("hold", 40e-3),
    ("m = 1, 500 rad/s", "`fade`, 30 ms"): SLOW | across("fade", 30e-3),
    ("m = 1, 500 rad/s", "`freeze`, 15 ms"): SLOW | across("freeze", 15e-3),
    ("m = 1, 500 rad/s", "`impact invariant`, innovation, 5 ms"): SLOW | INNOVATION,
    ("m = 2, 160 rad/s", "`hold`, 20 ms"): OF_ORDER_2 | across("hold", 20e-3),
    ("Table I", "reset `model`"): TABLE_I | {"reset": "model"},
    ("Table I", "`hold`, 15 ms"): TABLE_I | across("hold", 15e-3),
    ("Table I", "`fade`, 40 ms"): TABLE_I | across("fade", 40e-3),
    ("DOB", "reset `model`"): DOB | {"reset": "model"},
    ("DOB", "`hold`, 15 ms"): DOB | across("hold", 15e-3),
    ("DOB", "`freeze`, 15 ms"): DOB | across("freeze", 15e-3),
}
"""Values of a scenario by observer and policy."""


def points(quick: bool) -> list[Row]:
    """Every case on every ground, at the usual step and at half of it."""
    cases = list(CASES)[:2] if quick else list(CASES)
    return [
        {"observer": observer, "policy": policy, "time_constant": T, "h": h}
        for observer, policy in cases
        for T in TIMES
        for h in (STEP, 0.5 * STEP)
    ]


def judged(observer: str, policy: str, time_constant: float, h: float) -> Row:
    """Largest errors [rad] of the walk without a push after touchdowns, and of the pushed one by its push."""
    given = USUAL | CASES[observer, policy] | {"time_constant": time_constant, "plant_step": h}
    alone, pushed = (walk_scenario(ba.Scenario(**given, pushes=push)) for push in ("", PUSH))
    if not (alone.trajectory.status.ok and pushed.trajectory.status.ok):
        return {"touchdown": None, "push": None}
    return {
        "touchdown": contact_errors(alone.signals).touchdown_error,
        "push": contact_errors(pushed.signals).pushed_error,
    }


def policy_table(rows: list[Row]) -> str:
    """Errors at the usual step [mrad], and the largest change of a row at half of it."""
    heads = [f"{what}, {1e3 * T:g} ms" for T in TIMES for what in ("after touchdowns", "push")]
    lines, before = [], ""
    for observer, policy in dict.fromkeys(
        (r["point"]["observer"], r["point"]["policy"]) for r in rows
    ):
        usual, half = (entries(rows, observer, policy, h) for h in (STEP, 0.5 * STEP))
        moved = [largest_change(usual[k::2], half[k::2]) for k in (0, 1)]
        shown = ["lost" if np.isnan(x) else f"{1e3 * x:.2g}" for x in usual]
        lines.append(["" if observer == before else observer, policy, *shown, *moved])
        before = observer
    return markdown(("observer", "policy", *heads, "moves, after touchdowns", "push"), lines)


def entries(rows: list[Row], observer: str, policy: str, h: float) -> list[float]:
    """Both errors on each ground [rad]; NaN for a walk that is lost."""
    at = {(r["point"]["time_constant"], r["point"]["h"]): r for r in rows
          if (r["point"]["observer"], r["point"]["policy"]) == (observer, policy)}  # fmt: skip
    found_ = [at[T, h][name] for T in TIMES for name in ("touchdown", "push")]
    return [np.nan if x is None else x for x in found_]


def largest_change(usual: list[float], half: list[float]) -> str:
    """Of numbers at half the step against those at the usual one; whether other walks are lost."""
    if not np.array_equal(np.isnan(usual), np.isnan(half)):
        return "other walks are lost"
    return f"{100.0 * np.nanmax(np.abs(np.divide(half, usual) - 1.0)):.1f} %"


def main() -> None:
    """Walk, show, and write."""
    parser = arguments(__doc__)
    parser.add_argument("--page", type=Path, help="where the table is written, between marks")
    given = parser.parse_args()
    rows = found(
        points(given.quick), judged, given.out / "soft_policies.jsonl" if given.out else None
    )
    table = Table("Policies across contact", "rad", __doc__ or "", ["mujoco-core"])
    for row in rows:
        table.add(
            row["point"]["observer"], **row["point"], touchdown=row["touchdown"], push=row["push"]
        )
    table.finish(given.out)
    if given.page:
        write_between(given.page, "policies", policy_table(rows))


if __name__ == "__main__":
    main()
