"""Trials walked on the compiled engine and reported as rows of plain numbers, whatever becomes of them.

Nothing raises: values that do not fit give a row with the status REFUSED, a controller that raises one with
RAISED, so that one bad trial of a study spoils no other. A number that does not exist is None and never NaN,
which JSON and SQL do not have.

The columns are computed at the nodes of a walk (its sample instants and events): from the signals of its stored
run, or from the table that machine code fills at the same instants, without a stored run. On the rigid plant a
walk is judged by its certificate, that is by the forces of the ground and torques that each walking step needs,
on soft ground by how far its feet slip (`analysis.feasibility`). On soft ground the friction is the ratio of
the forces of the ground itself, so it is never above the ground's coefficient, and an impact is part of the
forces.

`rows_of(run_trials, records)` is what `studies.runner` hands to workers. The meaning and the unit of each
column are in columns.toml.

A record is the values of one walk's scenario by dotted name, a row its results by column. A trial is a walk
that is built and not yet simulated: its scenario, robot and gait (`scene`), walker, start and method (`case`),
and for another plant than the rigid one its loop. A stage is one of build, walk, measure; where one raises, the
row that says why takes the trial's place in the stages after it. A verdict is whether ground and motors could
have carried the walk (feasible), and if not why.
"""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from functools import partial
from itertools import pairwise
from threading import RLock
from typing import Any

import numpy as np

from biped_adrc.analysis.certificate import IMPULSE, REASONS, supports
from biped_adrc.analysis.feasibility import Feasibility, outcome_of
from biped_adrc.analysis.ground_force import Nodes, totals
from biped_adrc.analysis.signals import FALLS
from biped_adrc.analysis.soft_steps import contact_errors
from biped_adrc.closed_loop.other_plant import walk_on
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.control.foot_barrier import infeasible_instants
from biped_adrc.core.errors import BipedError
from biped_adrc.core.files import packaged
from biped_adrc.core.registry import FOLDERS
from biped_adrc.engine.batch import BatchWalk, Preparation, Ready, left_by, walks_of
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.hybrid.status import Status
from biped_adrc.model.ground import Limits
from biped_adrc.scenario.build import limits
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.walk import walk_scenario
from biped_adrc.studies.build import NO_WALK, RAISED, REFUSED, Trial, Values, scenario_of, trial_of

COLUMNS: Mapping[str, str] = packaged("biped_adrc.studies", "columns.toml")
"""The columns of a row and what each means, with units."""
WORDS = ("status", "detail", "outcome", "engine")
"""Columns that hold text."""
WalkRow = dict[str, float | int | str | None]
"""Results by column name."""
Function = Callable[[Sequence[Values]], Sequence[Any]]
"""What workers run: from records (values of one walk each) to a row of plain values for each, in order."""
JUDGED = (
    *("feasible_impacts", "mean_normal_force", "mean_friction", "scuffing", "riser"),
    "peak_torque",
)
"""Columns that `Feasibility` has under the same names."""
OF_TOTALS = ("peak_error", "rms_error", "rms_torque", "work", "net_work")
"""Columns of `analysis.ground_force.totals`."""
_AT_ONCE = 400
"""Most impacts, over all walks in memory together: the nodes of a walk take some 80 kB for each impact."""
_PREPARING = RLock()
"""Held while walkers are built or plants used: threads of a process share robots and compiled code. A walk with
a table is judged without it, by compiled loops beside which other threads run."""


def rows_of(
    function: Function, records: Sequence[Values], folders: Mapping[str, str] | None = None
) -> list[tuple[str, str | None]]:
    """Walk each record, and return its row as JSON with the row's status; worker processes call this.

    folders: name of a module of the user's -> its folder, as `registry.FOLDERS` has it in the calling process.
    The status is None in a row that has none. Where the function raises on several records it is called again
    with one at a time; a record on which it raises alone has a row with the status RAISED, so that one bad
    record spoils no other.
    """
    FOLDERS.update(folders or {})  # where this process looks for modules of the user's
    try:
        # strict: an error where the function does not return a row for each record
        rows = zip(function(records), records, strict=True)
        return [(json.dumps(dict(row), allow_nan=False), row.get("status")) for row, _ in rows]
    except (Exception, SystemExit) as error:
        if len(records) > 1:
            return [one for record in records for one in rows_of(function, [record])]
        detail = f"{type(error).__name__}: {error}"
        return [(json.dumps({"status": RAISED, "detail": detail}), RAISED)]


def run_trials(records: Sequence[Values], aside: bool = False) -> list[WalkRow]:
    """Walk the records, and return a row with all columns for each, in their order. aside: whether rows have a
    value of the column `rounding`, for which a walk from a start beside the first one is made too.

    Stage by stage (build, walk, measure) all trials that memory holds well are worked on together: the code of
    one stage stays in the processor's cache, which takes a fifth less time than trial by trial.
    """
    # _PREPARING is a lock: threads of a process share robots and compiled code. Walking itself needs no lock
    # _attempt and, for a list, _each call a stage; a row that says why stands for what it raised
    with _PREPARING:
        trials = _each(trial_of, [_attempt(scenario_of, record) for record in records])
    impacts = (t.case.impacts for t in trials if isinstance(t, Trial))
    # size: how many walks are in memory together, by the longest of them
    # _AT_ONCE: most impacts in memory together
    size, rows = max(1, _AT_ONCE // max(impacts, default=1)), list[WalkRow]()
    prepared = partial(_run_of, Preparation())
    for i in range(0, len(trials), size):
        some = trials[i : i + size]
        with _PREPARING:
            runs = _each(prepared, some)
            walks = walks_of([x if isinstance(x, Ready) else partial(_walked, x) for x in runs])
        pairs = zip(some, walks(), strict=True)
        rows += [_row(x if isinstance(x, dict) else _measured(t, x, aside)) for t, x in pairs]
    return rows


def _run_of(prepare: Preparation, t: Trial) -> Callable[[], BatchWalk]:
    """The function that walks a trial; unlike building and measuring, it may run in several threads at once. On
    another plant than the rigid one, `t.loop` is walked in place of the walker; `left_by` brings its run into
    the form of the others. prepare: what prepared the trials before it.
    """
    c, loop = t.case, t.loop
    if loop is None:
        return prepare(c)
    return lambda: left_by(c, walk_on(loop, c.walker, (c.q, c.v), c.mode, c.impacts))


def _walked(run: Any) -> Any:
    """The walk that a run returns; a row that an earlier stage left is passed on."""
    return run if isinstance(run, dict) else _attempt(lambda run: run(), run)


def _each(step: Callable[[Any], Any], items: Sequence[Any]) -> list[Any]:
    """Apply one stage of a study (`step`) to each trial. An item that is a row already, because an earlier
    stage raised, is passed on unchanged.
    """
    return [x if isinstance(x, dict) else _attempt(step, x) for x in items]


def _attempt(step: Callable[[Any], Any], x: Any) -> Any:
    """step(x), or the row that says why it raised: REFUSED by an error of this package, RAISED by any other."""
    try:
        return step(x)
    except BipedError as error:
        return {"status": REFUSED, "detail": str(error), "impacts": 0}
    except Exception as error:  # whatever a controller in Python may raise
        return {"status": RAISED, "detail": f"{type(error).__name__}: {error}", "impacts": 0}


def _measured(t: Trial, walked: BatchWalk, aside: bool) -> WalkRow:
    """The row of a walk, for which a plant is used where it has no table or is walked again; see `_counts`."""
    with _PREPARING if walked.table is None or aside else nullcontext():
        return _counts(t, walked, aside)


def _counts(t: Trial, walked: BatchWalk, aside: bool) -> WalkRow:
    """The row of a walk that has been carried out: how it ended, how fast it was, and what is counted in it.

    aside: whether to walk again for the column `rounding`, on the rigid plant. The cost of transport, work [J]
    over weight [N] times distance [m], is None without forward motion. A walk that left no nodes, since it
    raised before the first one, has neither errors nor torques.
    """
    s, walker, run, status = t.scenario, t.case.walker, walked.trajectory, walked.status.name
    plant = walker.plant
    n = None if walked.table is None else Nodes(walked.table, plant.n, plant.p)
    # NO_WALK: statuses of what was no walk
    row: WalkRow = {"status": status, "detail": walked.detail, "impacts": walked.impacts}
    row |= {"t_end": walked.t_end, "engine": walked.engine, **_pace(t, walked, n)}
    if status not in NO_WALK:
        row["survived"] = int(walked.status is Status.COMPLETED)
        # until `counted` has looked at the nodes: not feasible, as if all limits, named in REASONS, were broken
        row |= {"outcome": outcome_of(walked.status, REASONS), "feasible": 0, "but_impact": 0}
        row |= {"rounding": walk_scenario(s).rounding()} if aside and t.loop is None else {}
        # parts(..).s is the controller's state, in which a barrier for the foot has counted these instants
        row["infeasible_qp"] = infeasible_instants(parts(walker, walked.final_state).s)
    # signals at the nodes: from the whole run, or from the table that the compiled walk filled
    if run is not None:
        result = counted_in(Walk(walker, t.scene.walked, run, s), limits(s))
    elif n is not None:
        # k: limits as numbers; after (2,) [N s]: momentum after the last impact, for its impulse, if the walk
        # ends with that impact
        k, after = limits(s).of(plant.description), None
        if walked.status is Status.COMPLETED:
            # q and q', the first 2 n numbers of x+
            with _PREPARING:
                after = plant.momentum(*np.split(walked.final_state[: 2 * plant.n], 2))
        judged = supports(walker, n, k, walked.impacts, after)
        tracked, h = n, t.case.curve
        # FALLS: ends of a walk in which the robot leaves the gait. Then errors count only as long as the phase
        # is on the curve h
        if walked.status in FALLS and isinstance(h, VirtualConstraint):
            tracked = n.before_fall(h, plant.phase)
        result = counted(n, tracked, Feasibility(walked.status, judged, walked.impacts))
    else:
        return row
    weighed = plant.weight * float(row.get("distance") or 0.0)
    cost = float(result["work"] or 0.0) / weighed if weighed > 0.0 else None
    return row | result | {"cost_of_transport": cost}


def counted(n: Nodes, tracked: Nodes, found: Feasibility, soft: bool = False) -> WalkRow:
    """The columns for errors, torques, work and feasibility of a walk.

    n: all its nodes, for torques and work. tracked: those of them that have a tracking error, in a fall not the
    last ones. found: its verdict. soft: whether the walk was made on soft ground, where slips are judged in
    place of impulses at impact.
    """
    outcome, judged = found.outcome, set(REASONS) - {IMPULSE if soft else "slip"}
    # totals: largest and rms error, of `tracked`; rms torque, work and net work, of all nodes. The ratio of
    # impulses is None without an impact
    # OF_TOTALS: columns that are sums over the nodes; JUDGED: those that `Feasibility` has
    of_all = totals(n)
    errors = of_all[:2] if tracked is n else totals(tracked)[:2]
    return {
        **dict(zip(OF_TOTALS, (*errors, *of_all[2:]), strict=True)),
        "outcome": outcome,
        "feasible": int(outcome == "feasible"),
        "but_impact": int(outcome == "but_impact"),
        **{f"bad_{name}": int(name in found.reasons) for name in judged},
        **{name: getattr(found, name) for name in JUDGED},
        "impulse_ratio": found.impulse_ratio if found.touchdowns and not soft else None,
    }


def counted_in(walk: Walk, limits: Limits) -> WalkRow:
    """The columns of `counted` for a walk whose whole trajectory is stored; on soft ground those of the feet
    too, and with a detector of touchdowns those of its delays and faults.
    """
    nodes, tracked = Nodes.of(walk.signals), Nodes.of(walk.signals.before_fall)
    row = counted(nodes, tracked, walk.feasible_within(limits), walk.soft)
    row |= _on_the_ground(walk) if walk.soft else {}
    return row | ({} if walk.walker.touchdown is None else walk.touchdowns.rates._asdict())


def _on_the_ground(walk: Walk) -> WalkRow:
    """Columns of a walk on soft ground: the errors that touchdowns and pushes leave [rad], and, only if the
    plant records its feet, the largest slip and penetration [m], flight and double support [s] of a walking
    step.
    """
    row, steps = contact_errors(walk.signals.before_fall)._asdict(), walk.soft_steps
    if not steps:
        return row
    return row | {
        "slip": max(max(step.slip) for step in steps),
        "flight": max(step.flight for step in steps),
        "double_support": max(step.double_support for step in steps),
        "penetration": max(step.depth for step in steps),
    }


def _pace(t: Trial, walked: BatchWalk, n: Nodes | None) -> WalkRow:
    """Distance [m], mean speed and speed of the last two walking steps [m/s], and the mean speed's difference
    from the gait's speed, as a share of it, over the walking steps that ended in an impact. Without an impact
    the distance is 0 and there is no speed. n: the nodes, if the walk has a table.
    """
    if walked.impacts == 0:
        return {"distance": 0.0}
    plant, gait = t.case.walker.plant, t.scene.walked
    # x_minus: states just before the impacts, of which the first n numbers are q; times: start and impacts [s].
    # length of a step: x of the swing foot from the stance foot [m], horizontal on any slope
    if n is None:
        steps = [float(plant.swing_foot(x[: plant.n])[0]) for x in walked.x_minus]
    else:
        steps = n.at.reading.swing_foot[n.last[: walked.impacts], 0].tolist()
    times = [walked.t_start, *walked.times.tolist()]
    speed = sum(steps) / (times[-1] - times[0])
    change = speed / (float(t.scene.biped.swing_foot(gait.q_minus)[0]) / gait.period) - 1.0
    last = sum(steps[-2:]) / sum(b - a for a, b in pairwise(times[-3:]))
    return {"distance": sum(steps), "speed": speed, "speed_change": change, "last_speed": last}


def _row(known: WalkRow) -> WalkRow:
    """The row with all columns in the order of columns.toml: the `known` ones, None where there is no value or
    a number is not finite.
    """
    kept = {k: x for k, x in known.items() if not isinstance(x, float) or math.isfinite(x)}
    plain = {k: float(x) if isinstance(x, float) else x for k, x in kept.items()}  # NumPy's floats
    return dict.fromkeys(COLUMNS) | plain
