"""What Python calls: an arc of a run, its impact, a whole walk, and a sample under a controller in Python.

`stride` is the whole walk in compiled code, for many walks at once: arcs and impacts until enough of them,
the end, or a terminal status. `hold` is for controllers in Python: it moves the plant to the next sample
instant and computes there what the controller is given.
"""

from __future__ import annotations

from biped_adrc.engine.kernels.call import *
from biped_adrc.engine.kernels.operations import *
from biped_adrc.engine.kernels.record import FOOT_STRIKE, Ints, Run
from biped_adrc.hybrid.constants import *
from biped_adrc.hybrid.march import arm, travel
from biped_adrc.types import Array


@unit
def go_on(r: Run) -> int:
    """From x0 at t to the first event or t_end; a code.

    Where there is no room for the nodes (FULL) all is as before, so that the call can be repeated with more. An
    arc that ends before its first step leaves one node, so that no arc is empty.
    """
    t, armed, count, t_arc, columns = r.t, r.armed, r.count, r.t_arc, r.columns
    copy(r.x0, r.x_first, r.nx)
    copy(r.values, r.values_first, r.guards)
    r.lost = 0
    lower(r)
    if armed == 0:
        arm(r)  # type: ignore[arg-type]
    code = travel(r)  # type: ignore[arg-type]
    if r.every > 0 and r.count == 0 and code != FULL:
        for i in range(r.nx):
            r.dx0[i] = 0.0
        if not node(r, r.t, r.x0, r.dx0):
            code = FULL
    if r.look != 0 and r.columns == columns and code != FULL and table_row(r, r.t, r.x0) == 0:
        code = FULL
    if code == FULL:
        r.t, r.armed, r.count, r.t_arc, r.columns = t, armed, count, t_arc, columns
        copy(r.x_first, r.x0, r.nx)
        copy(r.values_first, r.values, r.guards)
    return code


@kernel
def arc(run: Ints) -> int:
    """Go on to the first event or t_end; a code."""
    return go_on(data(run))


@unit
def hold(call_of: Ints, out: Array) -> int:
    """As `go_on`; then in `out` (t, q, q') there, and behind them what a function says of these.

    call_of (3,): addresses of the run, of the function, and of its numbers. By addresses, so that Python
    passes two pointers and no arrays.
    """
    r = ints_at(call_of[0])
    code, size = go_on(r), 2 * r.n
    if code != FULL:
        out[0] = r.t
        copy(r.x0, shift(out, 1), size)
        call(call_of[1], floats_at(call_of[2]), out, shift(out, 1 + size))
    return code


@unit
def land(r: Run) -> int:
    """x+ in place of x- in x0, and the start of the next arc; a status, all as before where it is not 0."""
    code = jump(r, r.x0, r.x_e)
    if code == 0:
        copy(r.x_e, r.x0, r.nx)
        r.fired, r.armed, r.count = FOOT_STRIKE, 0, 0
    return code


@kernel
def strike(run: Ints) -> int:
    """x+ in place of x-, as `land`; a status."""
    return land(data(run))


@kernel
def stride(run: Ints, impacts: int, strikes: Rows) -> tuple[int, int]:
    """Over `impacts` impacts, or over any number until t_end for 0: status and how many were made.

    strikes (m, 1 + 2 nx) gets a row (t, x-, x+) of each; more than m of them end as EVENT_LIMIT. No nodes are
    kept in between, but columns of `table`; where there is no room for those (FULL), the run is at the start of
    its arc.
    """
    r, count = data(run), 0
    r.every = 0
    while True:
        code = go_on(r)
        if code == COMPLETED:
            code = TIME_OUT if count < impacts else COMPLETED
            break
        if code != STRUCK:
            break
        if count >= strikes.shape[0]:
            code = EVENT_LIMIT
            break
        for i in range(r.nx):
            strikes[count, 1 + i] = r.x0[i]
        code = land(r)
        if code != 0:
            break
        strikes[count, 0] = r.t
        for i in range(r.nx):
            strikes[count, 1 + r.nx + i] = r.x0[i]
        count += 1
        if count == impacts:
            break
    return code, count
