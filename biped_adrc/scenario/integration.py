"""Which method integrates a walk, with which integration step, and the run of its parts one after the other.

Where a push switches on or off, ADRC's observer has a transient of 1 to 2 ms, not much longer than the
integration step that suffices elsewhere. A walk is therefore cut at impacts into parts (`WalkPart`): a fine
integration step in the single supports in which the disturbance switches and those right after them, a usual
one in the others. The trajectories of the parts are joined.

    refined(walker, 8, 1, RK4(), 5e-5)    # 8 single supports from number 1 on, fine steps of 5e-5 s
                                          # -> parts: usual, fine where the push switches, usual

A method here is an integration method with its step or tolerance, such as RK4(h=1e-3), h in [s]. The
exponential method integrates a linear stiff part of the loop exactly; `Walker.split` gives this part, or None.
q, v (n,) [rad, rad/s] are coordinates and rates, x (nx,) is the state (q, v, the controller's, the hardware's).
A mode is a single support: its number from 1 (step), and the time [s] at which it began (start). An arc of a
trajectory is one single support. The engine is "compiled" (machine code) or "pinocchio" (Python).
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.checks import numbers
from biped_adrc.core.errors import InputError
from biped_adrc.core.tree import Layout, flatten
from biped_adrc.core.types import Array
from biped_adrc.engine.program import COMPILED
from biped_adrc.engine.run import simulate_by
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.scenario import RunRecord


class WalkPart(NamedTuple):
    """Consecutive single supports of a walk that are integrated by one method."""

    impacts: int
    """Number of its single supports; the part ends with the impact of the last one."""
    method: OneStepMethod


METHODS: dict[str, type[RK4 | Exponential]] = {"rk4": RK4, "exponential": Exponential}
"""Methods of fixed step by name."""
FINE_STEP = 5e-5
"""Integration step of the exponential method where a push switches [s]. After a switching time the error of
ADRC is a spike of 1 to 2 ms; this step gives its peak within 0.2 %, one of 1 ms is wrong by a factor of
five."""


HARDWARE_STEP = 2.5e-4
"""Integration step of RK4 for a walker with sensors, motors or a torque limit [s]. Of 200 random walks 191 have
the same results at a quarter of this step; at 1 ms only 176."""
STABLE = 2.5
"""Largest |lambda| h [1] that is used with RK4, for an eigenvalue lambda and the integration step h; RK4 is
stable up to 2.78 on the real axis."""
_RESOLVED = 0.5
"""Largest |lambda| h [1] for the fast decay of rates by static friction around zero rate, which RK4 then
follows within 0.05 %."""


ASIDE = 1e-12
"""Offset of a start [rad, rad/s] by which rounding is judged: larger than round-off, smaller than the error of
an integration step."""
DECIDES = 1e-7
"""Largest distance at an impact [rad, s] of two walks that begin ASIDE of each other and do not depend on
rounding. Without comparisons (encoder counts, limits) the distance grew 400 times at most, for 22 controllers
and robots, so this bound of 1e5 times is far above that."""

# walks of a study share these, so that they are compared by identity
_USUAL, _WITH_HARDWARE = RK4(), RK4(HARDWARE_STEP)


def default_method(walker: Walker) -> OneStepMethod:
    """The integration method for a walker: the exponential one at 0.5 ms where `Walker.split` gives a linear
    stiff part (an observer in continuous time), RK4 at 1 ms for others.

    RK4 takes a shorter integration step with sensors, motors or a torque limit, whose counts and limits magnify
    an error of the motion, and where the controller's states are so fast that 1 ms would be unstable, such as
    those of a short delay. Both take a shorter one where static friction acts on little inertia.
    """
    method: Exponential | RK4 = _USUAL if walker.split(Mode()) is None else Exponential()
    hardware = (walker.sensors, walker.motors, walker.torque_limit)
    if walker.sampled and any(x is not None for x in hardware):
        method = _WITH_HARDWARE
    # STABLE is for the decision; the new step has h rate = 1, well inside RK4's region of stability
    if isinstance(method, RK4) and method.h * (rate := rate_of_law(walker)) >= STABLE:
        method = RK4(1.0 / rate)
    # friction decays rates by `rubs` [1/s]: the step is at most _RESOLVED of this time
    rubs = rate_of_friction(walker.plant)
    return method if method.h * rubs <= _RESOLVED else replace(method, h=_RESOLVED / rubs)


def rate_of_friction(plant: Biped) -> float:
    """Largest |eigenvalue| [1/s] of D^-1 dF/dq' (n, n) at q = q' = 0, with the mass matrix D and the joint
    friction F (n,) [N m]: the rate at which friction alone makes rates decay; 0 without friction.
    """
    if not plant.friction:
        return 0.0
    still = np.zeros(plant.n)
    J = np.linalg.solve(plant.inertia(still), plant.friction_derivative(still))
    return float(np.max(np.abs(np.linalg.eigvals(J))))


def rate_of_law(walker: Walker) -> float:
    """Largest |eigenvalue| [1/s] of ds'/ds, with s (k,) the controller's state, by central differences at
    q = q' = 0; 0 without a state, and in sampled time, where the state changes at sample instants only.
    """
    if walker.sampled:
        return 0.0
    still = np.zeros(walker.plant.n)
    try:
        m = walker.measure(0.0, still, still, Mode())
        state, law = walker.law.initial_state(m), walker.law
        layout, s, u = Layout.of(state), flatten(state), law.output(state, m)
        if len(s) == 0:
            return 0.0
        # rows: s moved in one entry by the half width of the differences; most flows are linear in s, so that
        # any width will do
        moved = np.diag(1e-3 * np.maximum(1.0, np.abs(s)))
        flows = [flatten(law.flow(layout.tree(x), m, u)) for x in (*(s + moved), *(s - moved))]
        ahead, behind = np.split(np.array(flows), 2)
        # row i is the derivative to s_i: J is the transpose of ds'/ds, with the same eigenvalues
        J = (ahead - behind) / (2.0 * np.diag(moved))[:, np.newaxis]
        return float(np.max(np.abs(np.linalg.eigvals(J))))
    except Exception:  # whatever a method may raise: the walk itself says what is wrong
        return 0.0


def methods_of(run: RunRecord, walker: Walker) -> tuple[OneStepMethod, float | None]:
    """The integration method of a walk, and the integration step [s] where a push switches; None: that of the
    method there too.

    A record without method and step takes the walker's default, and on the compiled engine `FINE_STEP` for the
    exponential method. On Pinocchio the fine steps would take minutes; there they have to be asked for, and
    `Walk.remarks` says so.
    """
    if run.method == "adaptive":
        # the same number relative [1] and absolute [rad, rad/s]
        return Adaptive(run.tolerance, run.tolerance), None
    method = default_method(walker) if run.method is None else METHODS[run.method]()
    if run.h is not None:
        return replace(method, h=run.h), run.fine  # type: ignore[type-var]
    # nothing is stated, and the engine is fast enough for fine steps
    left_open = run.fine is None and run.method is None and run.engine == COMPILED
    return method, FINE_STEP if left_open and isinstance(method, Exponential) else run.fine


def refined(
    walker: Walker, impacts: int, first_step: int, usual: OneStepMethod, fine: float | None
) -> tuple[WalkPart, ...]:
    """Parts of a walk, with the integration step `fine` [s] in the single supports in which the disturbance
    switches and those after, and the method `usual` in the others.

    impacts: number of single supports. first_step: number of the first one. fine None: one part with the method
    `usual`. A disturbance that switches at times of the walk rather than of a single support makes all of the
    walk fine, since its single support is not known beforehand.
    """
    if fine is None:
        return (WalkPart(impacts, usual),)
    steps = range(first_step, first_step + impacts)
    times = walker.disturbance.switching_times if walker.disturbance else lambda *at: ()
    late, short = walker.max_step_time, replace(usual, h=fine)  # type: ignore[type-var]
    # times(k, begin): when the disturbance switches in single support k. When k begins is not known: k * late
    # stands for it, as all that matters is whether there is a finite time
    switched = {k for k in steps if any(map(math.isfinite, times(k, k * late)))}
    # {k, k - 1}: fine where it switches, and in the single support after
    methods = (short if {k, k - 1} & switched else usual for k in steps)
    return tuple(WalkPart(len(list(group)), method) for method, group in groupby(methods))


def in_parts(
    walker: Walker,
    start: tuple[Array, Array],
    mode: Mode,
    parts: Sequence[WalkPart],
    engine: str,
    progress: Progress | None = None,
) -> Trajectory:
    """Simulate a walk from `start` by the methods of its parts in turn, and join the trajectories.

    Each part begins after the last impact of the one before; a fall ends the walk early. start: (q, v), each
    (n,) [rad, rad/s], in the single support `mode`. engine: "compiled" or "pinocchio". progress: called after
    every event with the time [s] and the number of events. Raises InputError for a start that is no state, or
    whose touchdown is past; and for more than one part under a clock that does not restart at impact, since a
    part begins with a sample instant.
    """
    # True: continuous time has no clock, and nothing that a new part could shift
    if len(parts) > 1 and not getattr(walker.timing, "restart", True):
        raise InputError(
            f"a walk of {len(parts)} parts needs a clock that restarts at impact, SampledTime(restart=True)"
        )
    check_start(*start, walker)
    walker.check_foot(*start, mode)
    x = walker.initial_state(*start, mode)
    return _joined(list(runs_in_parts(walker, x, mode, parts, progress, engine)))


def runs_in_parts(
    walker: Walker,
    x: Array,
    mode: Mode,
    parts: Sequence[WalkPart],
    progress: Progress | None = None,
    engine: str = COMPILED,
) -> Iterator[Trajectory]:
    """Iterate over the trajectories of the parts, from state x (nx,) in this mode on; the iteration ends after
    a fall.

    engine: "compiled" or "pinocchio". progress: called after every event with the time [s] and the number of
    events since the start of the first part.
    """
    done = 0  # events of the parts before
    report = progress and (lambda t, events: progress(t, done + events))
    for part in parts:
        t0, count = mode.start, part.impacts
        end = t0 + count * walker.max_step_time
        run = simulate_by(
            engine, walker, x, mode, part.method, t0=t0, t_end=end, impacts=count, progress=report
        )
        yield run
        # each arc ends with one event
        event, done = run.arcs[-1].event, done + len(run.arcs)
        # without a state after the event (x_plus) the walk has ended
        if not run.status.ok or event is None or event.x_plus is None:
            return
        x, mode = event.x_plus, Mode(run.arcs[-1].mode.step + 1, event.t)


def check_start(q: Array, v: Array, walker: Walker) -> None:
    """Raise InputError for a start that is no state, or has angles beyond a whole turn, as in degrees."""
    n = walker.plant.n
    for name, x in (("q", q), ("q'", v)):
        if np.shape(x) != (n,) or not np.all(np.isfinite(numbers(x, f"the start {name}"))):
            raise InputError(f"the start {name} is {x}, expected {n} finite numbers")
    if np.max(np.abs(q)) > 2.0 * math.pi:
        raise InputError(f"the start q is {q} rad, beyond a whole turn; give np.radians(q)")


def _joined(runs: Sequence[Trajectory]) -> Trajectory:
    """Join runs that follow one another to one trajectory, with the status and detail of the last one.

    Its settings["method"] says which single supports each method took.
    """
    last = runs[-1]
    if len(runs) == 1:
        return last
    # "steps" are the single supports of a run, one arc each
    labels = [
        f"{run.settings['method']} (steps {run.arcs[0].mode.step} to {run.arcs[-1].mode.step})"
        for run in runs
    ]
    arcs = tuple(arc for run in runs for arc in run.arcs)
    return replace(last, arcs=arcs, settings={**last.settings, "method": "; ".join(labels)})


def rounding(walker: Walker, run: Trajectory, parts: Sequence[WalkPart]) -> float:
    """The larger of max |dq| [rad] and max |dt| [s] over all impacts and the end, between `run`, which was
    simulated in these parts, and a run whose start differs by ASIDE; infinite if one makes more impacts.

    Where a comparison decides, as in an encoder, the two may read other counts and walk apart from then on;
    around an unstable motion a quantised loop does so sooner or later (Delchamps, IEEE TAC 35(8), 1990), at
    every integration step. Raises InputError for a walk without parts.
    """
    if not parts:
        raise InputError("a walk from a file, on another plant or cut has no steps; ask a new one")
    n, first = walker.plant.n, run.arcs[0]
    k = np.arange(len(first.x[0]))
    # q and v, the first 2 n numbers, are moved by ASIDE cos(k), in rad and rad/s: a direction
    # that no symmetry prefers
    x = first.x[0] + np.where(k < 2 * n, ASIDE * np.cos(k), 0.0)
    beside = runs_in_parts(walker, x, first.mode, parts)
    # of each arc the time and q at its last stored instant, just before the impact
    runs = run.arcs, [arc for other in beside for arc in other.arcs]
    a, b = (np.array([(arc.t[-1], *arc.x[-1, :n]) for arc in arcs]) for arcs in runs)
    return float(np.max(np.abs(a - b))) if len(a) == len(b) else math.inf
