"""Several walks side by side, each with the numbers that it has alone.

The walks sit in the lanes of two blocks (`record.block_rows`): `now` has the states at a sample instant, `then`
those on the way to the next one; in continuous time a sample is a step of integration. Generated functions
(`engine.stretch`) move all of them at once. Where another thing happens to a walk, `move_alone` moves it as a
walk alone is moved, and it comes back at its next sample instant: at an impact and right after it, where a push
switches, at an end of any kind. While a walk is in a lane, its run r has the time, and the block has its state.

A team s is what the lanes have in common, in a `Run` of its own: K, push and functions are for all lanes. Its
`tick`, `flow` and `events` are `tick`, `slope` and `step` of `engine.stretch`.
"""

from __future__ import annotations

import math

import numpy as np

from biped_adrc.core.types import Array

# Stars, as in `hybrid.march`: in the joined text these imports are gone, and bare names are what is left.
from biped_adrc.engine.kernels.arc import go_on, land_and_note, push, sample
from biped_adrc.engine.kernels.call import *
from biped_adrc.engine.kernels.operations import *
from biped_adrc.engine.kernels.record import *
from biped_adrc.hybrid.constants import *
from biped_adrc.hybrid.march import left, weights

GOES_ON, MOVED = -1, -2
"""Code of a walk that is not over; number of impacts that stands for a walk that has been moved."""


# -- one walk --------------------------------------------------------------------------------------
@unit
def move_alone(r: Run) -> int:
    """Move a run to its next sample instant (GOES_ON), or to its end as `stride` does, whose code it
    returns."""
    while True:
        r.t_end = min(r.last, tick_time(r)) if r.period > 0.0 else r.last
        r.pause = int(r.period == 0.0)
        code = go_on(r)
        r.pause = 0
        if code == PAUSED:
            return GOES_ON
        if code == COMPLETED:
            if r.t < r.last:
                return GOES_ON
            if r.look != 0:
                node(r, r.t, r.x0, r.dx0)
            return TIME_OUT
        if code == STRUCK:
            code = land_and_note(r)
        if code != 0 or r.struck == r.most:
            return code
        # with a clock that restarts at impacts this is true right after one
        if r.period > 0.0 and at_tick(r.t, clock_start(r), r.period):
            return GOES_ON


@inner
def tick_time(r: Run) -> float:
    """The first sample instant after r.t [s]."""
    return after_tick(r.t, clock_start(r), r.period)


@inner
def release_time(r: Run) -> float:
    """The first time after r.t [s] from which a torque acts that has waited for a part of the period."""
    return after_tick(r.t, clock_start(r) + r.part, r.period)


@inner
def steps(r: Run, t: float, t_next: float) -> int:
    """Number of integration steps from t to t_next [s], as `march.through` counts them."""
    return int(max(1.0, np.ceil((t_next - t) / r.h - LANDING)))


@unit
def is_plain(r: Run) -> int:
    """1 where nothing is due in the next sample of a run but what is due in each: the torque that waits, and
    steps in their usual numbers; else 0.
    """
    # an arc begins with `arm`
    t, part, plain = r.t, r.part, r.armed == 1 and r.t > r.t_arc
    if r.period == 0.0:  # the last step before a break is for `move_alone`
        r.t_end = r.last
        return int(plain and 0 < r.done < steps(r, r.t_from, next_break(r)) - 1)
    t1 = tick_time(r)
    plain = plain and at_tick(t, clock_start(r), r.period)
    plain = plain and t1 <= r.last and next_switch(r, t, t1) == t1
    if part == 0.0:
        return int(plain and steps(r, t, t1) == steps(r, 0.0, r.period))
    # steps between these floats, and between the walker's numbers
    half = release_time(r)
    plain = plain and half < t1 and steps(r, half, t1) == steps(r, part, r.period)
    return int(plain and steps(r, t, half) == steps(r, 0.0, part))


# -- into and out of a lane ------------------------------------------------------------------------
@inner
def part_of(s: Run, block: Array, part: int) -> Array:
    """The rows of a part of a block, X, LOAD, .."""
    return shift(block, s.at[part] * s.lanes)


@unit
def put(s: Run, lane: int, x: Array, out: Array, size: int) -> None:
    """The numbers of a lane in the rows `out` (size, lanes) become x (size,)."""
    for i in range(size):
        out[i * s.lanes + lane] = x[i]


@unit
def get(s: Run, lane: int, x: Array, out: Array, size: int) -> None:
    """out (size,) = the numbers of a lane in the rows x (size, lanes)."""
    for i in range(size):
        out[i] = x[i * s.lanes + lane]


@unit
def put_numbers(s: Run, lane: int, r: Run) -> None:
    """Put the numbers of a walk and of its disturbance into a lane."""
    put(s, lane, r.K, s.K, r.n_K)
    put(s, lane, r.push, s.push, r.n_push)


@unit
def leave(s: Run, lane: int, r: Run, block: Array) -> None:
    """Take the state and the event functions of a run out of its lane of a block."""
    get(s, lane, part_of(s, block, X), r.x0, r.nx)
    get(s, lane, part_of(s, block, VALUES), r.values, r.guards)
    get(s, lane, part_of(s, block, SLOPE), r.dx0, r.moving)
    # zeta of the last slope, which a node at a jump of the force from outside reads
    get(s, lane, part_of(s, block, STAGE_LOAD), shift(r.inp, 3 + r.nx), r.n)


@unit
def begin_sample(s: Run, lane: int, r: Run, block: Array) -> None:
    """Write the times of the next sample of a run, and its mark, to its lane of a block."""
    t1 = tick_time(r) if r.period > 0.0 else r.t_from + (r.done + 1) * r.h
    block[lane] = r.t
    part_of(s, block, BREAK)[lane] = release_time(r) if r.part > 0.0 else t1
    part_of(s, block, NEXT)[lane] = t1
    part_of(s, block, MARK)[lane] = 1.0
    r.kept = r.count


@unit
def enter(s: Run, lane: int, r: Run, block: Array) -> None:
    """Put a run into a lane of a block."""
    put(s, lane, r.x0, part_of(s, block, X), r.nx)
    put(s, lane, r.values, part_of(s, block, VALUES), r.guards)
    put(s, lane, r.dx0, part_of(s, block, SLOPE), r.moving)
    block[s.lanes + lane], block[2 * s.lanes + lane] = r.step, r.t_start
    part_of(s, block, DROP)[lane] = r.drop
    part_of(s, block, FARTHEST)[lane] = r.farthest
    put(s, lane, r.fastest, part_of(s, block, FASTEST), r.n)
    begin_sample(s, lane, r, block)


# -- a sample of all -------------------------------------------------------------------------------
@unit
def store_nodes(s: Run, load_of: int) -> None:
    """Store a node of each walk at its time in the block `then`, if nodes are kept; load_of: LOAD or
    STAGE_LOAD, the part that has the force from outside there.
    """
    if s.look != 0:
        call(s.look, s.K, s.then, s.results)
        load, size = shift(part_of(s, s.then, load_of), s.n * s.lanes), s.width - 4
        for lane in range(s.lanes):
            if s.team[lane] != 0:
                r = run_at(s.team[lane])
                row = shift(r.nodes, r.count * r.width)
                row[0], row[1] = s.then[lane], r.step
                row[2], row[3] = load[lane], load[s.lanes + lane]
                get(s, lane, s.results, shift(row, 4), size)
                r.count = min(r.count + 1, r.room - 1)


@unit
def set_end(s: Run, j: int, count: int, t0: Array, t_next: Array) -> None:
    """Write the end of the j-th of `count` steps from t0 to t_next (lanes,) [s], and what depends on it."""
    block, w = s.then, part_of(s, s.then, WEIGHTS)
    for lane in range(s.lanes):
        t1 = t0[lane] + j * s.h if j < count else t_next[lane]
        part_of(s, block, T1)[lane] = t1
        part_of(s, block, LIMIT)[lane] = left(t_next[lane]) if s.period > 0.0 else math.inf
        if s.lags > 0 and s.team[lane] != 0:
            four = weights(run_at(s.team[lane]).lag_speed * (t1 - block[lane]))
            w[lane], w[s.lanes + lane] = four[0], four[1]
            w[2 * s.lanes + lane], w[3 * s.lanes + lane] = four[2], four[3]


@unit
def take_steps(s: Run, t0: Array, until: int, count: int) -> None:
    """Take `count` steps in the block `then`, from t0 (lanes,), where the slope is known, to the times in its
    part `until`.
    """
    t_next = part_of(s, s.then, until)
    for j in range(1, count + 1):
        set_end(s, j, count, t0, t_next)
        call(s.events, s.K, s.then, s.then)
        copy(part_of(s, s.then, T1), s.then, s.lanes)
        if j < count:
            call(s.flow, s.K, s.then, s.then)
            store_nodes(s, STAGE_LOAD)
        elif s.look != 0 and s.pulled != 0:
            # the node before a break, as `operations.node` stores it: zeta is that of the last slope, the force
            # that just before the break
            copy(part_of(s, s.then, STAGE_LOAD), part_of(s, s.then, LOAD), s.n * s.lanes)
            copy(part_of(s, s.then, LIMIT), s.then, s.lanes)
            call(s.pushes, s.push, s.then, part_of(s, s.then, STAGE_LOAD))
            copy(part_of(s, s.then, T1), s.then, s.lanes)
            store_nodes(s, STAGE_LOAD)


@unit
def sample_all(s: Run) -> None:
    """Move all walks by one sample, from the block `now` to the block `then`."""
    if s.period == 0.0:
        copy(s.now, s.then, s.at[END] * s.lanes)
        take_steps(s, s.now, NEXT, 1)
        call(s.flow, s.K, s.then, s.then)
        return
    call(s.tick, s.K, s.now, s.then)
    store_nodes(s, LOAD)
    if s.part == 0.0:
        take_steps(s, s.now, NEXT, steps(s, 0.0, s.period))
    else:
        take_steps(s, s.now, BREAK, steps(s, 0.0, s.part))
        # the waiting torque acts, as in `operations.due`
        end = shift(part_of(s, s.then, X), (s.nx - s.p) * s.lanes)
        copy(shift(end, -s.p * s.lanes), end, s.p * s.lanes)
        set_end(s, 1, 1, s.now, part_of(s, s.then, NEXT))
        call(s.flow, s.K, s.then, s.then)
        store_nodes(s, STAGE_LOAD)
        take_steps(s, part_of(s, s.then, BREAK), NEXT, steps(s, s.part, s.period))


@unit
def side_by_side(s: Run, walks: Ints, count: int, codes: Ints) -> int:
    """Move `count` walks to their ends, so many at a time as the team s has lanes; returns how many samples
    were made side by side.

    walks (count,): addresses of their runs; codes (count,) get the codes of their ends.
    """
    waiting, busy, samples = 0, 0, 0
    for lane in range(s.lanes):
        s.seats[lane], s.team[lane] = -1, 0
    while True:
        for lane in range(s.lanes):
            i, code, r = s.seats[lane], GOES_ON, run_at(walks[0])
            if i >= 0:
                r = run_at(walks[i])
                if part_of(s, s.then, MARK)[lane] == 1.0:
                    r.t, r.done = s.then[lane], r.done + int(r.period == 0.0)
                    if is_plain(r) == 1:
                        begin_sample(s, lane, r, s.then)
                        continue
                    leave(s, lane, r, s.then)
                else:
                    leave(s, lane, r, s.now)
                    r.count = r.kept
                    code = move_alone(r)
            # others take the place of a walk that is over, and each goes by itself until a lane serves it
            while i >= 0 or waiting < count:
                if i < 0:
                    i, waiting, busy, code = waiting, waiting + 1, busy + 1, GOES_ON
                    r = run_at(walks[i])
                    put_numbers(s, lane, r)
                while code == GOES_ON and is_plain(r) == 0:
                    code = move_alone(r)
                if code == GOES_ON:
                    enter(s, lane, r, s.then)
                    break
                codes[i] = code
                i, busy = -1, busy - 1
            s.seats[lane], s.team[lane] = i, walks[i] if i >= 0 else 0
        if busy == 0:
            return samples
        s.now, s.then = s.then, s.now
        sample_all(s)
        samples += 1


# -- samples under inputs from outside -------------------------------------------------------------
@unit
def move_beside(s: Run, walks: Ints, first: int, impacts: Ints) -> None:
    """Move by one sample those of the walks `first`, first + 1, .. in the lanes of a team for which it is a
    plain one; their `impacts`, 0 before, become MOVED. See `samples`.
    """
    some, pushed = 0, 0
    for lane in range(s.lanes):
        i = first + lane
        s.team[lane] = 0
        if s.ready[lane] != 0 and impacts[i] == 0:
            r = run_at(walks[i])
            if s.ready[lane] == 1:
                put_numbers(s, lane, r)
                s.ready[lane] = 2
            put(s, lane, r.torque, s.torque, r.p)
            put(s, lane, r.force, s.force, 2)
            if is_plain(r) == 1:
                enter(s, lane, r, s.now)
                s.team[lane], some, pushed = walks[i], some + 1, max(pushed, r.n_parts)
    if some > 1:
        for block in (s.now, s.then):
            # the first cell behind the rows; without a push nothing writes its rows, which may have old numbers
            cell_of(part_of(s, block, END))[0] = s.pushes if pushed > 0 else 0
            for k in range((s.n + OUTSIDE) * s.lanes):
                part_of(s, block, LOAD)[k] = part_of(s, block, STAGE_LOAD)[k] = 0.0
        sample_all(s)
        for lane in range(s.lanes):
            if s.team[lane] != 0:
                r = run_at(s.team[lane])
                if part_of(s, s.then, MARK)[lane] == 1.0:
                    leave(s, lane, r, s.then)
                    r.t, impacts[first + lane] = s.then[lane], MOVED
                else:
                    r.count = r.kept


@unit
def samples(
    walks: Ints,
    count: int,
    width: int,
    inputs: Array,
    states: Array,
    codes: Ints,
    impacts: Ints,
    teams: Ints,
) -> int:
    """Move each of `count` walks whose code is COMPLETED by one sample. Returns how many of them ended a single
    support, by an impact or with the walk.

    walks (count,): addresses of their runs, 0 for none; inputs (count, p + 2): torque [N m] and force [N] of
    each. The others are written: codes (count,), COMPLETED or how the walk ended; states (count, width = 2 +
    nx), rows (t, step, x) after it, unchanged for a walk that is not moved; impacts (count,), how many were
    made, -1 for a walk that is not moved.

    teams: how many lanes each has, 0 for none, then the addresses of teams, in whose lanes the walks sit one
    after the other; `ready` of a team is 1 for a walk that may go side by side, and 2 once the team has its
    numbers.
    """
    over = 0
    for i in range(count):
        impacts[i] = -1
        if codes[i] == COMPLETED and walks[i] != 0:
            r = run_at(walks[i])  # the run at this address
            u = shift(inputs, i * (r.p + 2))
            copy(u, r.torque, r.p)
            push(r, u[r.p], u[r.p + 1])
            impacts[i] = 0
    if teams[0] > 0:
        for k in range((count - 1) // teams[0] + 1):
            move_beside(run_at(teams[1 + k]), walks, k * teams[0], impacts)
    for i in range(count):
        if impacts[i] != -1:
            r = run_at(walks[i])
            step = r.step
            codes[i] = COMPLETED if impacts[i] == MOVED else sample(r)
            impacts[i] = int(r.step - step)
            over += int(impacts[i] > 0 or codes[i] != COMPLETED)
            row = shift(states, i * width)
            row[0], row[1] = r.t, r.step
            copy(r.x0, shift(row, 2), r.nx)
    return over
