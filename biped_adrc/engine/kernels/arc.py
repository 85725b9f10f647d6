"""The compiled functions that are called from outside: by Python, and by the page that walks in a browser.

`stride` runs one walk over arcs and impacts until it has made as many impacts as asked for, its time is over,
or it ends in another way. `samples` moves each of many walks from its sample instant to the next one, with
torques and forces that the caller may choose anew each time; impacts in between are made on the way. A clock
that restarts at impacts has a sample instant at the impact, and the sample ends there. A walk made by `stride`
and one made by `samples` are equal in all numbers. The page calls the two parts of both: `go_on` for an arc,
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
"""In one sample (EVENT_LIMIT)."""


@unit
def go_on(r: Run) -> int:
    """Move the run from x0 at t to the first event or to t_end; returns a code.

    An arc that ends before its first step leaves one node, so that no arc is empty.
    """
    count, r.lost = r.count, 0
    lower(r)
    if r.armed == 0:
        arm(r)  # type: ignore[arg-type]
    code = travel(r)  # type: ignore[arg-type]
    if r.count == count:
        for i in range(r.nx):
            r.dx0[i] = 0.0
        keep(r, r.t, r.x0, r.dx0)  # type: ignore[arg-type]
    return code


@unit
def land(r: Run) -> int:
    """Put x+ in place of x- in x0, and begin the next arc; returns a status, and changes nothing where it is
    not 0.

    step, t_start and t_arc become those of the single support that begins.
    """
    r.inp[0], r.inp[1] = r.t, r.step + 1.0
    copy(r.x0, shift(r.inp, 2), r.nx)
    r.x_e[0] = math.nan
    call(r.impact, r.K, r.inp, r.x_e)
    if r.x_e[r.nx] == 0.0:
        return SINGULAR
    if not finite(r.x_e, r.nx):
        return NOT_FINITE
    copy(r.x_e, r.x0, r.nx)
    r.step += 1.0
    r.t_start = r.t_arc = r.t
    r.fired, r.armed = FOOT_STRIKE, 0
    return 0


@unit
def stride(r: Run, impacts: int, strikes: Array) -> int:
    """Move the run over `impacts` impacts, or until t_end (TIME_OUT); returns a status.

    strikes (impacts, 1 + 2 nx) gets a row (t, x-, x+) of each.
    """
    nx = r.nx
    for count in range(impacts):
        code = go_on(r)
        if code == COMPLETED and r.look != 0:
            node(r, r.t, r.x0, r.dx0)
        if code != STRUCK:
            return TIME_OUT if code == COMPLETED else code
        row = shift(strikes, count * (1 + 2 * nx))
        copy(r.x0, shift(row, 1), nx)
        code = land(r)
        if code != 0:
            return code
        row[0] = r.t
        copy(r.x0, shift(row, 1 + nx), nx)
    return COMPLETED


@unit
def sample(r: Run) -> int:
    """Move the run from a sample instant to the next one, or to the end of the walk; returns a code, 0 for
    COMPLETED.
    """
    for _ in range(MOST_ARCS):
        r.t_end = after_tick(r.t, clock_start(r), r.period)
        code = go_on(r)
        if code == STRUCK:
            code = land(r)
        if code != COMPLETED:
            return code
        if at_tick(r.t, clock_start(r), r.period):
            return COMPLETED
    return EVENT_LIMIT


@unit
def look(r: Run, law: int, out: Array) -> None:
    """out = law(t, step, t_start, x, zeta, force) at the time and state of the run, with the inputs that a
    sample instant there would get.
    """
    lower(r)
    r.limit = math.inf
    measure(r, r.x0)
    call(law, r.K, r.inp, out)


@unit
def push(r: Run, x: float, z: float) -> None:
    """Set `force` to (x, z) [N]. Where it jumps, a row just before is kept; while it is zero, the last term of
    the disturbance is left out of the sum."""
    F = r.force
    if x != F[0] or z != F[1]:
        if r.look != 0:
            node(r, r.t, r.x0, r.dx0)
        r.n_parts += int(x != 0.0 or z != 0.0) - int(F[0] != 0.0 or F[1] != 0.0)
        F[0], F[1] = x, z
        load_of(r)


@unit
def samples(
    walks: Ints,
    count: int,
    width: int,
    inputs: Array,
    states: Array,
    codes: Ints,
    impacts: Ints,
) -> int:
    """One sample of each of `count` walks whose code is 0; how many of them end a single support, by an impact
    or with the walk.

    walks (count,): addresses of their runs, 0 for none; inputs (count, p + 2): torque [N m] and force [N].
    codes (count,) become those of `sample`; rows of states (count, width = 2 + nx) are (t, step, x) after it,
    as they were where a walk has ended. impacts (count,) are those made, -1 for a walk that is not moved.
    """
    over = 0
    for i in range(count):
        impacts[i] = -1
        if codes[i] == COMPLETED and walks[i] != 0:
            r = run_at(walks[i])
            u = shift(inputs, i * (r.p + 2))
            copy(u, r.torque, r.p)
            push(r, u[r.p], u[r.p + 1])
            step = r.step
            codes[i] = sample(r)
            impacts[i] = int(r.step - step)
            over += int(impacts[i] > 0 or codes[i] != COMPLETED)
            row = shift(states, i * width)
            row[0], row[1] = r.t, r.step
            copy(r.x0, shift(row, 2), r.nx)
    return over


@unit
def looks(walks: Ints, count: int, width: int, laws: Ints, views: Array) -> None:
    """Rows of views (count, width): what the functions at the addresses laws (count,) say of the walks where
    they are.
    """
    for i in range(count):
        if walks[i] != 0:
            look(run_at(walks[i]), laws[i], shift(views, i * width))
