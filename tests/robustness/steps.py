"""Random walks at default settings, at the step that is taken and at a quarter of it.

A column of the results agrees where it is within `SHARE` of itself or within its floor. A walk whose status
changes is near a fall, or at the edge of another end, where rates of the start changed by EDGE change it too.
Torques that chatter at a limit or between counts of an encoder are as random as that: where rates changed by
one of MOVES move a column at least half as far as the step did, it says nothing of the step, and is reported as
such with the least of them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from biped_adrc.bench import build
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.run import measured
from biped_adrc.engine.batch import run_case
from tests.photograph.draws import Draw
from tests.photograph.scenarios import scenario

SEED = 16_002
SHARE, EDGE, MOVES = 0.05, 1e-2, (1e-8, 1e-7, 1e-6)
FLOORS = {
    "t_end": 1e-4,
    "peak_error": 1e-4,
    "rms_error": 1e-5,
    "peak_torque": 0.5,
    "rms_torque": 0.1,
    "work": 0.1,
    "net_work": 0.1,
    "distance": 1e-3,
    "cost_of_transport": 1e-3,
    "speed": 1e-3,
    "speed_change": 2e-3,
    "last_speed": 1e-3,
    "peak_matched": 0.5,
    "peak_unmatched": 0.5,
    "least_normal_force": 1.0,
    "mean_normal_force": 1.0,
    "friction": 5e-3,
    "mean_friction": 5e-3,
    "share_outside": 5e-3,
    "scuffing": 1e-4,
    "impulse_ratio": 5e-3,
}
"""Differences that do not count, in the unit of the column (`bench/columns.toml`)."""
RATIOS, STEEP = ("friction", "mean_friction", "impulse_ratio"), 2.0
"""Ratios of forces, of which any above STEEP says the same: no ground holds, F_N is about zero."""
Plain = dict[str, Any]


def drawn(k: int) -> Plain:
    """Fields of trial k: those of the photograph at default settings, with motors of any lag."""
    d, j = Draw(SEED, k), 1000 * k
    while (s := scenario(j, SEED))["kind"] != "trial" or not walks(s["fields"]):
        j += 1
    fields = {name: x for name, x in s["fields"].items() if name not in ("h", "method")}
    if d.chance(0.3):
        fields["lag"] = d.log(1e-6, 5e-3)
    return fields


def walks(fields: Plain) -> bool:
    """Whether a trial is not refused."""
    try:
        build.case(trial(fields))
    except ValueError:
        return False
    return True


def judged(k: int) -> Plain:
    """What columns of trial k differ, and whether its status does."""
    fields = drawn(k)
    whole, quarter = row(fields, 1.0), row(fields, 0.25)
    record = {
        "k": k,
        "status": [whole["status"], quarter["status"]],
        "off": {},
        "edge": False,
        "chatters": None,
    }
    if whole["status"] != quarter["status"] or whole["impacts"] != quarter["impacts"]:
        return record | {"edge": at_edge(fields), "changed": True, "fields": fields}
    off = {
        name: [whole[name], quarter[name]] for name in FLOORS if not agrees(name, whole, quarter)
    }
    if off:
        record["chatters"] = moved(fields, off, whole, quarter)
    return record | {"off": off, "changed": False, "fields": fields if off else {}}


def moved(fields: Plain, off: Plain, whole: Plain, quarter: Plain) -> float | None:
    """The least of MOVES up to which every column that is off has moved half as far as by the step, or None."""
    left = set(off)
    for move in MOVES:
        others = [row(fields, share, 1.0 + c * move) for share in (1.0, 0.25) for c in (-1.0, 1.0)]
        left = {name for name in left if not random(name, whole, quarter, others)}
        if not left:
            return move
    return None


def random(name: str, whole: Plain, quarter: Plain, others: list[Plain]) -> bool:
    """Whether a column differs among moved starts by half as much as between the steps."""
    found = [x.get(name) for x in (whole, quarter, *others)]
    if any(x is None for x in found):
        return any(x is not None for x in found[2:])
    moved = max(abs(found[0] - x) for x in found[2:4]), max(abs(found[1] - x) for x in found[4:])
    return bool(max(moved) >= 0.5 * abs(found[0] - found[1]))


def row(fields: Plain, share: float, scale: float = 1.0) -> Plain:
    """The results of a trial with steps of `share` of the usual length, its start's rates times `scale`."""
    s = trial(fields)
    case = build.case(s)
    case = replace(case, v=scale * case.v)
    if share != 1.0:
        case = replace(case, method=replace(case.method, h=share * case.method.h))
    return measured(s, case, run_case(case)())


def at_edge(fields: Plain) -> bool:
    """Whether rates of the start changed by up to `EDGE` change how the walk at the short step ends."""
    ends = {
        (x["status"], x["impacts"])
        for x in (row(fields, 0.25, 1.0 + EDGE * c) for c in (-1.0, -0.3, 0.0, 0.3, 1.0))
    }
    return len(ends) > 1


def agrees(name: str, a: Plain, b: Plain) -> bool:
    """Whether a column is the same at both steps."""
    x, y = a.get(name), b.get(name)
    if x is None or y is None:
        return x is y
    if name in RATIOS:
        x, y = min(x, STEEP), min(y, STEEP)
    return abs(x - y) <= max(SHARE * max(abs(x), abs(y)), FLOORS[name])


def table(found: list[Plain]) -> str:
    """How many walks agree, and those that do not, as Markdown."""
    changed = [x for x in found if x["changed"]]
    lines = [
        "| | walks |",
        "|---|---|",
        f"| drawn | {len(found)} |",
        f"| all columns agree | {sum(not x['changed'] and not x['off'] for x in found)} |",
        *(
            f"| some column differs, as with rates of the start changed by {move:g} | "
            f"{sum(x['chatters'] == move for x in found)} |"
            for move in MOVES
        ),
        f"| some column differs otherwise | {sum(bool(x['off']) and not x['chatters'] for x in found)} |",
        f"| another end, near the edge of it | {sum(x['edge'] for x in changed)} |",
        f"| another end, not near an edge | {sum(not x['edge'] for x in changed)} |",
    ]
    rows = [f"- {x['k']}: {' at h, '.join(x['status'])} at h/4" for x in changed]
    for x in found:
        off = (
            f"{name} {a:.4g}, {b:.4g}" if a is not None and b is not None else f"{name} {a}, {b}"
            for name, (a, b) in dict(x["off"]).items()
        )
        why = f", as random as {x['chatters']:g}" if x["chatters"] else ""
        rows += [f"- {x['k']} ({x['status'][0]}{why}): {'; '.join(off)}"] if x["off"] else []
    return "\n".join([*lines, "", "Those that do not agree (value at h, at h/4):", "", *rows])


def faults(found: list[Plain]) -> list[str]:
    """A line for each walk with another end that is not near an edge, and one where too few agree."""
    told = [f"{x['k']}: {x['status']}" for x in found if x["changed"] and not x["edge"]]
    agreeing = sum(not x["changed"] and not x["off"] for x in found)
    if agreeing < 0.95 * len(found):
        told.append(f"{agreeing} of {len(found)} agree, expected 95 %")
    return told
