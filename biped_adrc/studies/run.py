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
from functools import partial
from threading import Lock

import numpy as np

from biped_adrc.analysis.certificate import REASONS, supports
from biped_adrc.analysis.feasibility import Feasibility, outcome_of
from biped_adrc.analysis.ground_force import Nodes
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.core.errors import BipedError
from biped_adrc.core.files import packaged
from biped_adrc.engine.batch import BatchWalk, Case, run_case
from biped_adrc.hybrid.status import Status
from biped_adrc.model.robots.limits import Limits
from biped_adrc.scenario.build import RIGID, limits
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.build import case, scene_of
from biped_adrc.studies.counted import WalkRow, counted, counted_in
from biped_adrc.studies.parameters import NO_WALK, RAISED, REFUSED, Record, scenario_of

COLUMNS: Mapping[str, str] = packaged("biped_adrc.studies", "columns.toml")
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
    walk = None
    try:
        s = scenario_of(record)
        with _PREPARING:
            task = case(s)
            run = run_case(task) if s.ground.plant == RIGID else None
        if run is None:
            walk = walk_scenario(s)
            run = partial(ends_of, walk)
    except BipedError as error:
        return _row({"status": REFUSED, "detail": str(error), "impacts": 0})
    except Exception as error:  # whatever a controller in Python may raise
        detail = f"{type(error).__name__}: {error}"
        return _row({"status": RAISED, "detail": detail, "impacts": 0})
    return _row(measured(s, task, run(), walk))


def measured(s: Scenario, task: Case, walked: BatchWalk, walk: Walk | None = None) -> WalkRow:
    """The row of a walk that has been carried out.

    s: its scenario; made: the walker and its start; walked: trajectory, impacts and status; walk: with all its
    nodes, on another plant. The cost of transport, work / (weight x distance), is None without forward motion.
    """
    row = ended(s, task, walked)
    if walk is None and walked.trajectory is None and walked.table is None:
        return row
    with _PREPARING:
        if walk is None and walked.trajectory is not None:
            walk = Walk(task.walker, scene_of(s).walked, walked.trajectory, s)
        result = _by_table(task, walked, limits(s)) if walk is None else counted_in(walk, limits(s))
    weighed = task.walker.plant.weight * float(row.get("distance") or 0.0)
    cost = float(result["work"] or 0.0) / weighed if weighed > 0.0 else None
    return row | result | {"cost_of_transport": cost}


def _by_table(task: Case, walked: BatchWalk, limits: Limits) -> WalkRow:
    """What is counted in a compiled walk."""
    walker, plant = task.walker, task.walker.plant
    assert walked.table is not None
    n, k = Nodes.of_table(walked.table, plant.p), limits.of(plant.description)
    after = None
    if walked.status is Status.COMPLETED:
        x = walked.final_state
        after = plant.momentum(x[: plant.n], x[plant.n : 2 * plant.n])
    result = supports(walker, n, k, walked.impacts, after)
    return counted(n, Feasibility(walked.status, result, k, walked.impacts))


def ends_of(task: Walk) -> BatchWalk:
    """Status, impacts and end of a walk that was recorded."""
    run = task.trajectory
    times = np.array([event.t for event in run.events(FOOT_STRIKE)])
    end, engine = run.final_state, str(run.settings["engine"])
    before = run.before(FOOT_STRIKE)
    return BatchWalk(run.status, run.detail, times, before, end, run.t_end, engine)


def ended(s: Scenario, task: Case, walked: BatchWalk) -> WalkRow:
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
        row |= _pace(s, task, walked)
    return row


def _pace(s: Scenario, task: Case, walked: BatchWalk) -> WalkRow:
    """Distance [m], mean speed and speed of the last two steps [m/s], relative change of speed against the
    gait's.

    Without an impact there is a distance of 0 and no speed.
    """
    if walked.impacts == 0:
        return {"distance": 0.0}
    plant, gait = task.walker.plant, scene_of(s).walked
    steps = [float(plant.swing_foot(x[: plant.n])[0]) for x in walked.x_minus]
    speed = sum(steps) / float(walked.times[-1] - walked.t_start)
    change = speed / (float(scene_of(s).biped.swing_foot(gait.q_minus)[0]) / gait.period) - 1.0
    last = sum(steps[-2:]) / float(np.sum(walked.durations[-2:]))
    return {"distance": sum(steps), "speed": speed, "speed_change": change, "last_speed": last}


def _row(known: WalkRow) -> WalkRow:
    """All columns in order, None where there is no number or it is not finite."""
    row: WalkRow = dict.fromkeys(COLUMNS)
    for k, x in known.items():
        if not isinstance(x, float):
            row[k] = x
        elif math.isfinite(x):
            row[k] = float(x)  # NumPy's floats too
    return row
