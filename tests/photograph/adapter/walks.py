"""Walking a scenario in either engine, and what of the walk is recorded.

`numbers` of a record are lists of floats by name; the same names are in `deviation`, how far each of them comes
when the start is moved by `MOVE` of itself, in units of max(1, |x|).
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import replace
from typing import Any, NamedTuple
from unittest.mock import patch

import numpy as np

import biped_adrc as ba
from biped_adrc.engine.batch import run_case
from biped_adrc.gait.published import passive_cycle
from biped_adrc.scenario import build as scenario
from biped_adrc.scenario.push import parse_push
from biped_adrc.scenario.run import parts_of
from biped_adrc.scenario.scenario import FREE
from biped_adrc.scenario.walk import Part, default_parts, walk_in_parts
from biped_adrc.study import build
from biped_adrc.study.parameters import scenario_of
from biped_adrc.study.run import measured, run_trial
from tests.photograph.adapter import walkers
from tests.photograph.adapter.names import dotted

ENGINES = ("pinocchio", "compiled")
MOVE = 1e-14
Plain = dict[str, Any]
Numbers = dict[str, list[float]]


class Ready(NamedTuple):
    """A walk that can begin at (q, v) (n,)."""

    walker: Any
    gait: Any
    q: Any
    v: Any
    parts: Callable[[str], Any]
    """By engine."""
    first_step: int = 1
    more: Callable[[Any], Numbers] | None = None
    """Other numbers of the walk."""


# -- scenarios by kind -----------------------------------------------------------------------------
def effective(fields: Plain) -> Plain:
    """Fields of a drawn run without those that have no effect, which a scenario refuses."""
    idle = {"store_every", "poles" if fields.get("bandwidth") else "order"}
    if fields.get("controller") == "NPD":
        idle |= {"observer", "poles", "bandwidth", "order", "reset"}
    idle |= set() if fields.get("method") in FREE else {"tolerance"}
    return {name: x for name, x in fields.items() if name not in idle}


def as_before() -> AbstractContextManager[object]:
    """While it lasts the default step behind hardware is the 1 ms with which `before` was taken."""
    return patch("biped_adrc.scenario.walk.HARDWARE_STEP", 1e-3)


def _walker(s: Plain) -> Ready:
    biped = walkers.robot(s["robot"], s["preset"], s["joint_friction"])
    g = walkers.gait(s, biped)
    w, chosen, count, first = (
        walkers.walker(s, biped, g),
        s["method"],
        s["impacts"],
        s["first_step"],
    )
    q, v = walkers.start(s, g, biped)
    made = walkers.method(chosen)

    def parts(engine: str) -> Any:
        return default_parts(w, count, first, engine) if made is None else (Part(count, made),)

    return Ready(w, g, q, v, parts, first)


def _trial(s: Plain) -> Ready:
    t = scenario_of(dotted(s["fields"]))
    case = build.case(t)
    parts = (Part(case.impacts, case.method),)
    g = build.scene_of(t).walked
    return Ready(case.walker, g, case.q, case.v, lambda engine: parts)


def _run(s: Plain) -> Ready:
    pushes = tuple(parse_push(text) for text in s["pushes"])
    run = ba.Scenario(pushes=pushes, **dotted(effective(s["fields"])))
    scene = scenario.RobotAndGait.of(run)
    g, w = scene.walked, scenario.build(run, scene)
    q, v = g.start(w.nominal)

    def more(walk: Any) -> Numbers:
        o = ba.Walk(walk.walker, g, walk.trajectory, run).outcome
        return {"outcome": [o.peak_error, o.rms_error, o.peak_torque]}

    def parts(engine: str) -> Any:
        return parts_of(run.replace(run={"engine": engine}), w)

    return Ready(w, g, q, v, parts, run.run.first_step, more)


def _passive(s: Plain) -> Ready:
    biped = walkers.robot(s["robot"], None, False)
    known = passive_cycle(biped)
    push = None if s["hip"] is None else ba.HipForce(biped, tuple(s["hip"]))
    w = ba.Walker(
        biped,
        ba.Passive(),
        push,
        slope=known.slope + s["slope"],
        max_step_time=known.max_step_time,
    )
    made = walkers.method(s["method"]) or ba.RK4()
    parts = (Part(s["impacts"], made),)
    v = known.v_plus * (1.0 + s["speed"])
    return Ready(w, None, known.q_plus, v, lambda engine: parts)


READY = {"walker": _walker, "trial": _trial, "run": _run, "passive": _passive}


# -- walking ---------------------------------------------------------------------------------------
def walked(ready: Ready, engine: str, q: Any, v: Any) -> tuple[Plain, Numbers]:
    """The words and the numbers of one walk."""
    walk = walk_in_parts(
        ready.walker,
        ready.gait,
        ready.parts(engine),
        start=(q, v),
        first_step=ready.first_step,
        engine=engine,
    )
    found = walk.trajectory
    events = found.events("foot_strike")
    words = {
        "status": found.status.name,
        "detail": found.detail,
        "impacts": len(events),
        "method": found.settings["method"],
        "engine": found.settings["engine"],
        "why": found.settings.get("why", ""),
    }
    numbers: Numbers = {
        "t_end": [float(found.arcs[-1].t[-1])],
        "times": [float(e.t) for e in events],
        **state(ready.walker, found.final_state),
    }
    n = ready.walker.plant.n
    for k, e in enumerate(events):
        numbers[f"x_minus {k + 1}"] = _floats(e.x_minus[: 2 * n])
    if events:
        numbers["s_minus"] = state(ready.walker, events[-1].x_minus)["s"]
    if ready.more is not None:
        numbers |= ready.more(walk)
    return words, {name: x for name, x in numbers.items() if x}


def state(walker: Any, x: Any) -> Numbers:
    """The parts of a state by name: plant, controller, and what is held between ticks."""
    q, v, s = walker.split_state(x)
    parts: Numbers = {"x": _floats(np.concatenate((q, v))), "s": _floats(s)}
    if walker.held is not None:
        h = walker.held_at(x)
        parts["sensors"] = _floats(h.w)
        parts["motors"] = _floats(np.concatenate([np.ravel(part) for part in h.line]))
    return parts


def _floats(x: Any) -> list[float]:
    return [float(value) for value in np.ravel(x)]


def record(s: Plain) -> Plain:
    """What both engines make of a scenario, and the row of a trial."""
    found: Plain = {}
    for engine in ENGINES:
        found[engine] = attempt(lambda engine=engine: both_starts(s, engine))
    if s["kind"] == "trial":
        found["row"] = attempt(lambda: rows(s))
    return found


def attempt(make: Callable[[], Plain]) -> Plain:
    """What is made, or the error."""
    try:
        return make()
    except Exception as error:
        return {"error": type(error).__name__, "text": str(error)}


def both_starts(s: Plain, engine: str) -> Plain:
    """The walk, and how far it comes from a start moved by `MOVE`."""
    ready = READY[s["kind"]](s)
    words, numbers = walked(ready, engine, ready.q, ready.v)
    q, v = moved(s, ready.q, ready.v)
    again, other = walked(ready, engine, q, v)
    same = (again["status"], again["impacts"]) == (words["status"], words["impacts"])
    deviation = {name: apart(x, other.get(name, [])) for name, x in numbers.items()}
    return {"words": words, "numbers": numbers, "deviation": deviation if same else None}


def moved(s: Plain, q: Any, v: Any) -> tuple[Any, Any]:
    """The start moved in the scenario's direction."""
    d, n = np.array(s["moved"]), len(q)
    return q * (1.0 + MOVE * d[:n]), v * (1.0 + MOVE * d[n : 2 * n])


def apart(a: list[float], b: list[float]) -> float:
    """max |a - b| / max(1, |a|); infinite where the lengths differ, or one is no number and the other is."""
    if len(a) != len(b):
        return float("inf")
    x, y = np.array(a), np.array(b)
    with np.errstate(invalid="ignore"):
        gap = np.abs(x - y) / np.maximum(1.0, np.abs(x))
    same = (x == y) | (np.isnan(x) & np.isnan(y))
    gap = np.where(same, 0.0, np.where(np.isfinite(gap), gap, np.inf))
    return float(np.max(gap, initial=0.0))


BEFORE = {"feasible": "legal", "feasible_impacts": "legal_impacts", "infeasible": "made"}
"""Names of columns and of outcomes that the stored photograph has under others."""


def named_before(row: Plain) -> Plain:
    """A row with the names of the stored photograph."""
    row = {BEFORE.get(name, name): x for name, x in row.items()}
    return row | {"outcome": BEFORE.get(str(row["outcome"]), row["outcome"])}


def rows(s: Plain) -> Plain:
    """The row of a trial, compiled, and its change from the moved start."""
    fields = dotted(s["fields"])
    row = named_before(run_trial(fields))
    words = {name: x for name, x in row.items() if isinstance(x, str) or x is None}
    numbers = {name: [float(x)] for name, x in row.items() if isinstance(x, int | float)}
    if row["status"] in ("REFUSED", "RAISED"):
        return {"words": words, "numbers": numbers, "deviation": None}
    t = scenario_of(fields)
    case = build.case(t)
    q, v = moved(s, case.q, case.v)
    case = replace(case, q=q, v=v)
    other = named_before(measured(t, case, run_case(case)()))
    same = (other["status"], other["impacts"]) == (row["status"], row["impacts"])
    change = {name: apart(x, [float(other[name])]) for name, x in numbers.items()}
    return {"words": words, "numbers": numbers, "deviation": change if same else None}
