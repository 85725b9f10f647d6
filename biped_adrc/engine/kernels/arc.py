"""The compiled functions that are called from outside: by Python, and by the page that walks in a browser.

r is the run in memory (`record.Run`), with its time t [s], its state x0 (nx,) and nodes, the instants that it
stores; `step` is the number of the single support, t_start [s] its beginning, zeta (n,) [N m] the disturbance.
An arc is the flow between two impacts. Codes are those of `hybrid.constants`: a place in `Status`, with 0 for
COMPLETED, or STRUCK for an arc that ended at a touchdown.

`stride` runs one walk over arcs and impacts until it has made as many impacts as asked for, its time is over,
or it ends in another way. `sample` moves a walk from its sample instant to the next one, with a torque and a
force that the caller may choose anew each time; impacts in between are made on the way. A clock that restarts
at impacts has a sample instant at the impact, and the sample ends there. A walk made by `stride` and one made
by `sample` are equal in all numbers. The page calls the two parts of both: `go_on` for an arc,
`land` for an impact.
"""

from __future__ import annotations

import math

from biped_adrc.core.types import Array

# Stars, as in `hybrid.march`: in the joined text these imports are gone, and bare names are what is left. The
# `type: ignore[arg-type]` below are for the type checker, to which `march.travel` takes the Run of `on_arrays`.
from biped_adrc.engine.kernels.call import *
from biped_adrc.engine.kernels.operations import *
from biped_adrc.engine.kernels.record import FOOT_STRIKE, Ints, Run
from biped_adrc.hybrid.constants import *
from biped_adrc.hybrid.march import arm, keep, travel

MOST_ARCS = 100
"""Most arcs in one sample; with more of them the walk ends as EVENT_LIMIT."""


@unit
def go_on(r: Run) -> int:
    """Move the run from x0 at t to the first event or to t_end; returns a code, COMPLETED at t_end.

    An arc that ends before its first step leaves one node with the slope 0, so that no arc is empty.
    """
    # count: nodes stored before; r.lost = 0: no singular matrix and no runaway so far
    count, r.lost = r.count, 0
    lower(r)  # sets r.drop, how much lower the ground is at the end of this single support
    # `arm` computes the event functions at the start of an arc; an arc that goes on (armed = 1) has them
    if r.armed == 0:
        arm(r)  # type: ignore[arg-type]
    code = travel(r)  # type: ignore[arg-type]
    # `travel` has stored no node; in the middle of an arc there are those of before
    if r.count == count and r.t == r.t_arc:
        for i in range(r.nx):
            r.dx0[i] = 0.0
        keep(r, r.t, r.x0, r.dx0)  # type: ignore[arg-type]
    return code


@unit
def land(r: Run) -> int:
    """Compute the impact at t: x+ takes the place of x- in x0, and the next arc begins.

    step, t_start and t_arc become those of the single support that begins. Returns 0, or the code of a failure,
    which leaves the run as it was.
    """
    r.inp[0], r.inp[1] = r.t, r.step + 1.0
    copy(r.x0, shift(r.inp, 2), r.nx)
    # where `impact` is a function in Python that Ctrl-C stops, this NaN stays and ends the run
    r.x_e[0] = math.nan
    call(r.impact, r.K, r.inp, r.x_e)
    # behind x+ stands the least pivot of the matrices that were inverted
    if r.x_e[r.nx] == 0.0:
        return SINGULAR
    if not finite(r.x_e, r.nx):
        return NOT_FINITE
    copy(r.x_e, r.x0, r.nx)
    r.step += 1.0
    r.t_start = r.t_arc = r.t
    # the event function that ended the arc; armed = 0: the next arc has to compute its event functions
    r.fired, r.armed = FOOT_STRIKE, 0
    return 0


@unit
def land_and_note(r: Run) -> int:
    """Compute the impact at t as `land` does, and store its row (t, x-, x+) in `strikes`; returns the code."""
    nx, row = r.nx, shift(r.strikes, r.struck * (1 + 2 * r.nx))
    copy(r.x0, shift(row, 1), nx)
    code = land(r)
    if code == 0:
        row[0] = r.t
        copy(r.x0, shift(row, 1 + nx), nx)
        r.struck += 1
    return code


@unit
def stride(r: Run) -> int:
    """Move the run over impacts until `struck` of them are `most` (COMPLETED), or until t_end (TIME_OUT) or a
    failure; returns its code.
    """
    while r.struck < r.most:
        code = go_on(r)
        # r.look: function whose output `node` stores at the start of each step; the end of the run is added
        if code == COMPLETED and r.look != 0:
            node(r, r.t, r.x0, r.dx0)
        if code != STRUCK:
            return TIME_OUT if code == COMPLETED else code
        code = land_and_note(r)
        if code != 0:
            return code
    return COMPLETED


@unit
def sample(r: Run) -> int:
    """Move the run from a sample instant to the next one (COMPLETED), or to the end of the walk (another code).

    Impacts in between are made. Returns the code.
    """
    # after_tick: the next sample instant; clock_start: time from which these are counted; at_tick: whether
    # r.t is one
    for _ in range(MOST_ARCS):
        r.t_end = after_tick(r.t, clock_start(r), r.period)
        code = go_on(r)
        if code == STRUCK:
            code = land(r)  # 0, the same number as COMPLETED, where the impact was made
        if code != COMPLETED:
            return code
        # with a clock that restarts at the impact this is true right after it
        if at_tick(r.t, clock_start(r), r.period):
            return COMPLETED
    return EVENT_LIMIT


@unit
def look(r: Run, law: int, out: Array) -> None:
    """Compute out = law(t, step, t_start, x, zeta, force) at the time and state of the run, with the inputs
    that a sample instant there would get; law: address of the function.
    """
    lower(r)  # sets r.drop, the ground's fall in this single support
    r.limit = math.inf  # an input that switches now has its value after the switch
    measure(r, r.x0)  # writes the inputs of a sample instant to r.inp
    call(law, r.K, r.inp, out)


@unit
def push(r: Run, x: float, z: float) -> None:
    """Set `force`, the force from outside on the trunk, to (x, z) [N].

    Where it jumps, a row of `nodes` just before is kept, if the run stores signals (r.look, the address of the
    function that computes them, is not 0). `force` is the last term of the disturbance: n_parts
    counts it only while it is not zero.
    """
    F = r.force
    if x != F[0] or z != F[1]:
        if r.look != 0:
            node(r, r.t, r.x0, r.dx0)
        r.n_parts += int(x != 0.0 or z != 0.0) - int(F[0] != 0.0 or F[1] != 0.0)
        F[0], F[1] = x, z
        # r.load is the sum over the terms; without a term nothing else would set it back to zero
        load_of(r)


@unit
def looks(walks: Ints, count: int, width: int, laws: Ints, views: Array) -> None:
    """Write the rows of views (count, width): the output of function laws[i] at the present state of walk i.

    walks (count,): addresses of runs, 0 for none, whose row is left as it is; laws (count,): addresses of
    functions (t, step, t_start, x, zeta, force) -> numbers, with the inputs of a sample instant.
    """
    for i in range(count):
        if walks[i] != 0:
            look(run_at(walks[i]), laws[i], shift(views, i * width))
