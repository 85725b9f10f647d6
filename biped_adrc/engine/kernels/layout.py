"""Places of numbers in memory, shared by the kernels and by Python.

Every kernel function takes some of these vectors:

    P   integers of the plan: addresses, sizes, places in F     read only
    F   floats of the plan: clock, tolerances, matrices         read only
    K   numbers that the called functions read                   read only
    W   work rows (ROWS, width); row 0 is the head of the run   one per run
    s   the run vector: head, then x                            one per run
    R   nodes kept (rows, 1 + 2 nx): t, x, x'                   one per run

The names here are plain numbers, and so constants to the compiler. Where several names stand in one
line, the text below it explains them in their order.
"""

from __future__ import annotations

FLOW, TICK, STRIKE, WATCH, TO, BACK, REMAINDER, TURN = 0, 1, 2, 3, 4, 5, 6, 7
"""P: addresses of the walker's functions, in the order of `run_plan.LawAddresses`."""
COORDINATES, STATES, JOINTS, SLOW, STIFF, FORCED, LEVELS = 8, 9, 10, 11, 12, 13, 14
"""P: sizes n, nx, p, nw, k; number of forced rows of E; number of levels of halving."""
KIND, RESTART, DROPS, SWITCHES, PARTS = 15, 16, 17, 18, 19
"""P: kind of method; whether the clock restarts with each arc; how many drops of the ground, switching
times, and parts of the disturbance there are.
"""
ROWS_AT, PARTS_AT, DROPS_AT, SWITCHES_AT, WEIGHTS_AT = 20, 21, 22, 23, 24
"""P: where forced rows and parts of the disturbance begin in P; where drops, switching times and
matrices (or the tableau) begin in F.
"""
WIDTH, MOVING, LAG_AT, FASTEST_AT, P_HEAD = 25, 26, 27, 28, 29
"""P: numbers in a work row; how many of the first states flow, the others being held; where in x the
torques of lagging motors are, 0 without; where the bounds of rates and angles begin in F; length of this head.
"""
PART_SIZE = 3
"""P, of a part of the disturbance: its torque's address, where its parameters begin in F, its
resultant's address or 0.
"""
OUTSIDE = 2
"""Numbers behind the inputs of a sample instant: force from outside, or those on both feet."""

PERIOD, T_FIRST, LEAST_STEP, H, RTOL, ATOL, MAX_STEP = 0, 1, 2, 3, 4, 5, 6
"""F: sampling period [s], 0 for continuous time; start of the run [s]; minimum step length [m]; fixed
step [s]; tolerances [1] and absolute; longest step [s].
"""
PERIOD_PART, LAG_SPEED, F_HEAD = 7, 8, 9
"""F: time after a sample instant at which the waiting torque acts [s]; 1 / tau of lagging motors
[1/s]; length of this head.
"""

RK4, DOP853, ETD = 0, 1, 2
"""Kinds of method."""
HALF, HALF_PHI, FULL_STEP, FIRST, MIDDLE, LAST, MATRICES = 0, 1, 2, 3, 4, 5, 6
"""Matrices of one level of halving, in the order of `hybrid.exponential.PhiTable`; their number."""
STAGES = 12
"""Of DOP853."""
B_AT, C_AT, E3_AT, E5_AT, TABLEAU = 144, 156, 168, 181, 194
"""Tableau of DOP853: behind A (12, 12) come B and C (12,), E3 and E5 (13,); length of all."""

FOOT_STRIKE, HIP_TOO_LOW, STEP_TOO_LONG, GUARDS = 0, 1, 2, 3
"""Event functions in the order in which they are watched; their number."""
FOOT_X = 3
"""Behind the values of the event functions: x of the swing foot [m]."""

COMPLETED, TIME_OUT, FELL, STALLED = 0, 1, 2, 3
"""Codes that an arc ends with; these, the next four and RAN_AWAY are those of `run_plan.STATUS`."""
NOT_FINITE, SINGULAR, STEP_FAILED, EVENT_LIMIT = 4, 5, 6, 7
RAN_AWAY, STRUCK, FULL = 8, 9, 10
"""One more status; an impact ended the arc; R is full. The last two are no statuses: the caller goes on."""

TIME, STEP, START, END, FIRED, EVERY, COUNT, ARMED, VALUES, ARC = 0, 1, 2, 3, 4, 5, 6, 7, 8, 11
"""Head of s and of W: time [s]; single support; its start [s]; end of the arc or segment [s]; the guard
that ended the last arc, -1 for none; every how many steps a node is kept, 0 for never; nodes kept;
whether the event functions have values; their values (3); start of the arc [s].
"""
DROP, LIMIT, LOST, EVENT = 12, 13, 14, 15
"""Head of W: drop of the ground [m]; functions are asked for no later time than this [s]; the
status that a function's last output asks for, 0 for none; time of the event [s].
"""
ROOM, REACHED, TRY, LANDED, FAR, FAR_VALUE = 16, 17, 18, 19, 20, 21
"""Head of W: rows of R; of an adaptive step the time reached and the next length to try [s]; of
sub-steps their last time, the end of the bracket [s] and the event function there.
"""
SLOPED, HEAD = 22, 23
"""Head of W: 1 where row DX0 has the slope at row X0 already; length of the head."""

INP, OUT, ZETA, PART, AFTER, TRIED = 1, 2, 3, 4, 5, 6
"""Rows of W behind the head: inputs and outputs of a function; zeta and one part of it; event functions at
the end of a step, and at a time tried in it.
"""
X0, DX0, X1, DX1, STAGE, K2, K3, K4 = 7, 8, 9, 10, 11, 12, 13, 14
"""Rows of W: state and slope at both ends of a step; state of a stage, and slopes of RK4."""
XE, DXE, XB, DXB = 15, 16, 17, 18
"""Rows of W: state and slope at the event, and after the sub-steps towards it."""
Y0, N0, Y1, N1, YA, YB, NA, NB, NC = 19, 20, 21, 22, 23, 24, 25, 26, 27
"""Rows of W for ETD-RK4: y and remainder at both ends; stages a and b; remainders at a, b and c."""
E_HALF, Y_SUB, N_SUB, Y_TRY = 28, 29, 30, 31
"""Rows of W for ETD-RK4: e^(hA/2) E; y and remainder of the sub-steps, and y of one that is tried."""
SLOPES, ROWS = 32, 45
"""Rows of W: the first of 13 slopes of DOP853; number of all rows."""

RESOLUTION = 2e-3
"""Longest stretch of a step without a look at the event functions [s]."""
MOST_STEPS = 10_000_000
"""Of one segment; with more of them a method cannot go on (STEP_FAILED)."""
CROWDED, CROWDED_STEP = 1000, 1e-6
"""So many steps of DOP853 in a row may not be shorter on average than this [s] (STEP_FAILED)."""
LANDING = 1e-9
"""A last step longer than h by this fraction [1] is still one step."""
SAME_STEP = 1e-9
"""Relative difference [1] below which two steps share their matrices."""
XTOL, XRTOL, ITERATIONS = 1e-15, 9e-16, 10_000
"""Tolerances [s] and [1] of the time of an event, and most iterations of its root finder."""
