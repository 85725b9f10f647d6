"""Places of numbers in memory, shared by the kernels and by Python.

Every kernel function takes some of these vectors:

    P   integers of the plan: addresses, sizes, places in F     read only
    F   floats of the plan: clock, tolerances, matrices         read only
    K   parameters that the called laws read                    read only
    W   work rows (ROWS, width); row 0 is the head of the run   one per run
    s   the run vector: head, then x                            one per run
    R   nodes kept (rows, 1 + 2 nx): t, x, x'                   one per run

The names here are plain numbers, and so constants to the compiler; a structured record would say
more, and compile longer.
"""

from __future__ import annotations

# P: addresses
FLOW, TICK, STRIKE, WATCH, TO, BACK, REMAINDER = 0, 1, 2, 3, 4, 5, 6
"""P: addresses of the walker's functions, in the order of `run_plan.LawAddresses`."""
TURN = 7
# P: sizes n, nx, p, nw, k, the forced rows of E, and the levels of halving
COORDINATES, STATES, JOINTS, SLOW, STIFF, FORCED, LEVELS = 8, 9, 10, 11, 12, 13, 14
# P: method, clock, and how many drops, switching times and parts of the disturbance there are
KIND, RESTART, DROPS, SWITCHES, PARTS = 15, 16, 17, 18, 19
# P: where forced rows and parts begin in P; drops, switching times and weights in F; length of a work row
ROWS_AT, PARTS_AT, DROPS_AT, SWITCHES_AT, WEIGHTS_AT = 20, 21, 22, 23, 24
WIDTH = 25
# P: how many of the first states flow; the others are held
MOVING = 26
# P: parts of the disturbance with a force on the robot as a whole
RESULTANTS = 27
P_HEAD = 28
PART_SIZE = (
    3  # of a part: its torque's address, where its numbers begin, its resultant's address or 0
)
OUTSIDE = 5  # numbers for the meter behind a tick's input: force, impulse, drop
# F
PERIOD, T_FIRST, LEAST_STEP, H, RTOL, ATOL, MAX_STEP = 0, 1, 2, 3, 4, 5, 6
"""F: sampling period [s], start of the run [s], minimum step length [m], fixed step [s],
tolerances, longest step [s].
"""
PERIOD_PART = 7  # [s] after a tick, at which the waiting torque acts
F_HEAD = 8

# kinds of method
RK4, DOP853, ETD = 0, 1, 2
"""Kinds of method."""
# the matrices of one level of halving, in the order of PhiTable
HALF, HALF_PHI, FULL_STEP, FIRST, MIDDLE, LAST, MATRICES = 0, 1, 2, 3, 4, 5, 6
"""Matrices of one level of halving, in the order of `hybrid.integrators.PhiTable`."""
# the tableau: A (12, 12), B and C (12,), E3 and E5 (13,), one after the other
STAGES = 12
B_AT, C_AT, E3_AT, E5_AT, TABLEAU = 144, 156, 168, 181, 194

# guards, in the order in which they are watched
FOOT_STRIKE, HIP_TOO_LOW, STEP_TOO_LONG, GUARDS = 0, 1, 2, 3
"""Event functions in the order in which they are watched: touchdown, hip too low, single support too long."""
FOOT_X = 3  # beside the three witnesses: x of the swing foot

# codes that an arc ends with; the first eight are statuses
COMPLETED, TIME_OUT, FELL, STALLED = 0, 1, 2, 3
"""Codes that an arc ends with; the first eight are those of `run_plan.STATUS`."""
NOT_FINITE, SINGULAR, STEP_FAILED, EVENT_LIMIT = 4, 5, 6, 7
STRUCK, FULL = 8, 9
"""An impact ended the arc; R is full. No statuses: the caller goes on."""

# head of the vector s of a run, and of W: t [s]; single support; its start [s]; end of the arc or
# segment [s]; the guard that ended the last arc, -1 for none; every how many steps a node is kept; nodes kept;
# whether the witnesses are known; the witnesses; start of the arc [s]
TIME, STEP, START, END, FIRED, EVERY, COUNT, ARMED, VALUES, ARC = 0, 1, 2, 3, 4, 5, 6, 7, 8, 11
# W only: the steps down; no later than this [s]; whether a pivot was zero; time of the event [s]
DROP, LIMIT, ZERO_PIVOT, EVENT = 12, 13, 14, 15
# W only: rows of R; time reached and next step to try; time after the sub-steps, end and witness of the bracket
ROOM, REACHED, TRY, LANDED, FAR, FAR_VALUE = 16, 17, 18, 19, 20, 21
# W only: whether row DX0 has the slope at row X0 already
SLOPED = 22
HEAD = 23

# rows of W, after the head in row 0
INP, OUT, ZETA, PART, AFTER, TRIED = 1, 2, 3, 4, 5, 6
X0, DX0, X1, DX1, STAGE, K2, K3, K4 = 7, 8, 9, 10, 11, 12, 13, 14
XE, DXE, XB, DXB = 15, 16, 17, 18  # at the event; after the sub-steps towards it
Y0, N0, Y1, N1, YA, YB, NA, NB, NC = 19, 20, 21, 22, 23, 24, 25, 26, 27
E_HALF, Y_SUB, N_SUB, Y_TRY = 28, 29, 30, 31
SLOPES = 32  # 13 rows of DOP853
ROWS = 45

RESOLUTION = 2e-3  # [s], longest stretch of a step without a look at the witnesses
"""Longest stretch of a step without a look at the event functions [s]."""
MOST_STEPS = 10_000_000  # of one segment; more of them are a method that cannot go on
"""Of one segment; with more of them a method cannot go on (STEP_FAILED)."""
LANDING = 1e-9  # a last step longer than h by this fraction is still one step
"""A last step longer than h by this fraction [1] is still one step."""
SAME_STEP = 1e-9  # relative difference below which two steps share their matrices
"""Relative difference [1] below which two steps share their matrices."""
XTOL, XRTOL = 1e-15, 9e-16  # [s] and relative, of the time of an event
"""Tolerances [s] and [1] of the time of an event."""
