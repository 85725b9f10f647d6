"""Constants of the march (`hybrid.march`), the loop that moves a hybrid system through one arc.

An arc is the flow from one event to the next. The march runs in Python and as machine code; both use these
codes of methods and of ends of an arc, tolerances, names of work arrays, and formulas of sample instants.

Symbols: x state of nx numbers; h length of an integration step [s]; ETD the exponential Runge-Kutta method in
its coordinates y = (w, E), where w' = N_w and E' = A E + N_E, N = (N_w, N_E) being called the remainder.
"""

from __future__ import annotations

import math

RK4, ETD, SOLVER = 0, 1, 2
"""Kinds of integration method; SOLVER is a method in Python, such as SciPy's, which takes its own steps."""
HALF, HALF_PHI, FULL_STEP, FIRST, MIDDLE, LAST, MATRICES = 0, 1, 2, 3, 4, 5, 6
"""Places of the matrices of ETD-RK4 for one step length, in the order of `exponential.matrices`; MATRICES is
their number."""

COMPLETED, TIME_OUT, FELL, STALLED = 0, 1, 2, 3
NOT_FINITE, SINGULAR, STEP_FAILED, EVENT_LIMIT, RAN_AWAY = 4, 5, 6, 7, 8
"""Codes of how an arc ends: places in `hybrid.status.Status`. Inside the march 0 means that it goes on."""
STRUCK, PAUSED = 9, 10
"""Codes that are no status: an event with a reset ended the arc; the march stopped after a step, to go on."""

RESOLUTION = 2e-3
"""Longest stretch of a step without a look at the event functions [s]."""
TOGETHER, CROWD = 1e-6, 10
"""Events of one event function that are closer than this [s] are not told apart, and so many events within that
time accumulate: both end as EVENT_LIMIT."""
MOST_STEPS = 10_000_000
"""Most integration steps between two breaks, which are sample instants and switching times of inputs; with more
of them the run ends as STEP_FAILED."""
LANDING = 1e-9
"""A last step longer than h by this fraction [1] is still one step: round-off in the count of steps."""
SAME_STEP = 1e-9
"""Relative difference [1] below which two step lengths share their matrices."""
XTOL, XRTOL, ITERATIONS = 1e-15, 9e-16, 10_000
"""Tolerances [s] and [1] of the time of an event, and most iterations of its root finder: an event function
that touches zero flatly takes more than 100."""

# `on_arrays.Run` and `engine.kernels.record` both make their arrays from these names, so that the march finds
# r.x_e in either run; a name in one of them alone would be an AttributeError in one engine and unknown in the
# other.
X_ROWS = ("x0", "dx0", "x1", "dx1", "stage", "k1", "k2", "k3", "k4", "x_e", "dx_e", "x_b", "dx_b")
"""Arrays (nx,) of a run: state and slope at both ends of a step; state of a stage, and slopes of RK4; state and
slope at the event, and after sub-steps towards it."""
Y_ROWS = (
    *("y0", "y1", "y_a", "y_b", "e_half", "y_sub", "y_try"),
    *("N0", "N1", "N_a", "N_b", "N_c", "N_sub"),
)
"""Arrays (nx,) of a run by ETD-RK4, y = (w, E) and remainders: at both ends of a step; at stages; e^(hA/2) E;
of sub-steps, and of one that is tried."""


def is_tick(t: float, start: float, period: float) -> bool:
    """Whether t [s], not before `start` [s], is exactly a sample instant (tick) start + k period, period [s].

    k is rounded to the nearest integer. Sample instants are always computed by this expression, so that an
    exact comparison of floats is right.
    """
    return t == start + math.floor((t - start) / period + 0.5) * period


def next_tick(t: float, start: float, period: float) -> float:
    """The first of the sample instants start + k period [s], k = 0, 1, .., strictly after t [s]."""
    # by round-off one too small; t itself may be an instant
    k = max(0, math.floor((t - start) / period))
    while start + k * period <= t:
        k += 1
    return start + k * period
