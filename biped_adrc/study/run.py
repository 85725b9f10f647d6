"""A trial walked on the compiled engine and reported as one row of plain numbers, whatever becomes of it.

Nothing raises: values that do not fit give a row with the status REFUSED, a controller that raises one with
RAISED, so that one bad trial of a study spoils no other. A number that does not exist is None and never NaN,
which JSON and SQL do not have. What is counted in a walk is in `study.counted`.

`run_trials` is the function that `study.runner` hands to workers. The meaning of the columns is in
columns.toml.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from threading import Lock

import numpy as np

from biped_adrc.analysis.certificate import REASONS, supports
from biped_adrc.analysis.feasibility import Feasibility, outcome_of
from biped_adrc.analysis.ground_force import Nodes
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.engine.batch import BatchWalk, Case, run_case
from biped_adrc.errors import BipedError
from biped_adrc.hybrid.status import Status
from biped_adrc.model.robots.limits import Limits
from biped_adrc.resources import packaged
from biped_adrc.scenario.build import RIGID, limits
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.study.build import case, scene_of
from biped_adrc.study.counted import WalkRow, counted, counted_in
from biped_adrc.study.parameters import NO_WALK, REFUSED, Record, scenario_of

COLUMNS: Mapping[str, str] = packaged("biped_adrc.study", "columns.toml")
"""The columns of a row and what each means, with units."""
WORDS = ("status", "detail", "outcome", "engine")
"""Columns that hold text."""

_PREPARING = Lock()
"""Held while a walker is built or its plant is used: threads of a process share robots and compiled code."""


def run_trials(records: Sequence[Record]) -> list[WalkRow]:
    """A row for each trial, in their order: the function that workers run."""
    return [run_trial(record) for record in records]


def run_trial(record: Record) -> WalkRow:
    """The row of one trial. record: values of a scenario by name; those not given have their defaults."""
    try:
        s = scenario_of(record)
        with _PREPARING:
            made = case(s)
            run = None if s.ground.plant != RIGID else run_case(made)
        if run is None:
            return _row(_recorded(s, made))
    except BipedError as error:
        return _row({"status": REFUSED, "detail": str(error), "impacts": 0})
    return _row(measured(s, made, run()))


def _recorded(s: Scenario, made: Case) -> WalkRow:
    """The row of a walk on another plant. Raises InputError for values that do not fit together."""
    try:
        walk = walk_scenario(s)
    except BipedError:
        raise
    except Exception as error:  # whatever a controller in Python may raise
        return {
            "status": Status.RAISED.name,
            "detail": f"{type(error).__name__}: {error}",
            "impacts": 0,
        }
    row = ended(s, made, ends_of(walk))
    return row | _with_cost(made, row, counted_in(walk, limits(s)))


def measured(s: Scenario, made: Case, walked: BatchWalk) -> WalkRow:
    """The row of a walk that has been carried out.

    s: its scenario; made: the walker and its start; walked: trajectory, impacts and status.
    """
    row = ended(s, made, walked)
    if walked.trajectory is None and walked.table is None:
        return row
    with _PREPARING:
        if walked.trajectory is None:
            found = _by_table(made, walked, limits(s))
        else:
            walk = Walk(made.walker, scene_of(s).walked, walked.trajectory, s)
            found = counted_in(walk, limits(s))
    return row | _with_cost(made, row, found)


def _by_table(made: Case, walked: BatchWalk, limits: Limits) -> WalkRow:
    """What is counted in a compiled walk."""
    walker, plant = made.walker, made.walker.plant
    assert walked.table is not None
    n, k = Nodes.of_table(walked.table, plant.p), limits.of(plant.description)
    after = None
    if walked.status is Status.COMPLETED:
        x = walked.final_state
        after = plant.momentum(x[: plant.n], x[plant.n : 2 * plant.n])
    found = supports(walker, n, k, walked.impacts, after)
    return counted(n, Feasibility(walked.status, found, k, walked.impacts))


def _with_cost(made: Case, row: WalkRow, found: WalkRow) -> WalkRow:
    """What was counted, and the cost of transport work / (weight x distance), None without forward motion."""
    distance, work = row.get("distance"), found["work"]
    assert isinstance(work, float)
    forward = isinstance(distance, float) and distance > 0.0
    cost = work / (made.walker.plant.weight * distance) if forward else None  # type: ignore[operator]
    return found | {"cost_of_transport": cost}


def ends_of(made: Walk) -> BatchWalk:
    """Status, impacts and end of a walk that was recorded."""
    run = made.trajectory
    times = np.array([event.t for event in run.events(FOOT_STRIKE)])
    end, engine = run.final_state, str(run.settings["engine"])
    before = run.before(FOOT_STRIKE)
    return BatchWalk(run.status, run.detail, times, before, end, run.t_end, engine)


def ended(s: Scenario, made: Case, walked: BatchWalk) -> WalkRow:
    """How a walk ended, and how fast it was."""
    status = walked.status.name
    row: WalkRow = {
        "status": status,
        "detail": walked.detail,
        "survived": None if status in NO_WALK else int(walked.status is Status.COMPLETED),
        "impacts": walked.impacts,
        "t_end": walked.t_end,
        "engine": walked.engine,
    }
    if status not in NO_WALK:
        row |= {"outcome": outcome_of(walked.status, REASONS), "feasible": 0, "but_impact": 0}
    with _PREPARING:
        row |= _pace(s, made, walked)
    return row


def _pace(s: Scenario, made: Case, walked: BatchWalk) -> WalkRow:
    """Distance [m], mean speed and speed of the last two steps [m/s], relative change of speed against the
    gait's.

    Without an impact there is a distance of 0 and no speed.
    """
    if walked.impacts == 0:
        return {"distance": 0.0}
    plant, gait = made.walker.plant, scene_of(s).walked
    steps = [float(plant.swing_foot(x[: plant.n])[0]) for x in walked.x_minus]
    speed = sum(steps) / float(walked.times[-1] - walked.t_start)
    usual = float(scene_of(s).biped.swing_foot(gait.q_minus)[0]) / gait.period
    last = sum(steps[-2:]) / float(np.sum(walked.durations[-2:]))
    return {
        "distance": sum(steps),
        "speed": speed,
        "speed_change": speed / usual - 1.0,
        "last_speed": last,
    }


def _row(known: WalkRow) -> WalkRow:
    """All columns in order, None where there is no number or it is not finite."""
    found = {k: float(x) if isinstance(x, float) else x for k, x in known.items()}
    finite = {k: x for k, x in found.items() if not isinstance(x, float) or math.isfinite(x)}
    return dict.fromkeys(COLUMNS) | finite
