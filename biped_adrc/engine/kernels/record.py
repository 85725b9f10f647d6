"""The memory of one compiled run: a block of cells of 8 bytes, which the compiled march reads and writes.

The block begins with one cell for each field of `Run`, in the order below. A field that is a vector holds the
address of its first number, which stands further back in the same block: first the vectors of TABLES, then the
work vectors of ROWS, which all have one length. `compiled_run.plan` writes the block before a run. The march
changes the fields behind the comment "what changes"; of the others a run changes torque and push alone
(`arc.samples`). Two runs never share a cell, so they may run in two threads.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from biped_adrc.core.types import Array
from biped_adrc.hybrid.constants import X_ROWS, Y_ROWS

Ints = NDArray[np.int64]
FOOT_STRIKE, HIP_TOO_LOW, FOOT_X = 0, 1, 3
"""Places in what a walker's `events` gives: two event functions; x of the swing foot [m]."""
PART = 2
"""Numbers in `parts` for one."""
OUTSIDE = 2
"""Numbers behind the inputs of a sample instant: force from outside, or those on both feet."""


class Run:
    """The fields of a run by name: in compiled code r.name reads its cell, and r.name = x writes it.

    The first fields are addresses of functions `void f(double* K, double* inp, double* out)`, 0 for a function
    that the walker does not have. K are its parameters; the text of each field says what inp and out contain.
    `pivot` is the smallest |pivot| of the matrices that the controller inverts, infinite without one; 0 means
    a singular matrix, and the run ends as SINGULAR. A pivot below 0 stands for a torque beyond the walker's
    bound, and the run ends as RAN_AWAY. `to` and the three after it serve the exponential method, ETD-RK4, in
    its coordinates y = (w, E):

        w' = N_w,   E' = A E + N_E
    """

    flow: int
    """(t, step, t_start, x, zeta) -> (dx/dt, pivot); in sampled time only q, q' and lagging motors flow."""
    tick: int
    """(t, step, t_start, x, zeta, force) -> (x after the tick, pivot, q''), in sampled time. force (2,): from
    outside on the robot as a whole [N]."""
    impact: int
    """(t, step, x) -> (x+, pivot); step is that of the new single support."""
    events: int
    """(t, t_start, drop, q) -> the event functions: clearance of the swing foot [m], height of the hip over its
    limit [m], time left for the step [s]; then x of the swing foot [m]. An event is where one falls to zero."""
    to: int
    """x -> y = (w, E): the slow states w (nw,), and the stiff ones E (k, p) row by row."""
    back: int
    """y -> x."""
    remainder: int
    """(t, step, t_start, y, zeta) -> (N_w, N_E, pivot), N_E (p,) in row 1 alone, the others being zero."""
    matvec: int
    """E -> M E, with a matrix M (k, k) in the argument K."""
    look: int
    """Address of what rows of `nodes` hold in place of states; 0 for none."""
    n: int
    """Coordinates."""
    nx: int
    """Numbers in x."""
    p: int
    """Actuated joints."""
    moving: int
    """How many of the first states flow, the others being held."""
    n_slow: int
    """Numbers in w, for ETD-RK4."""
    k: int
    """Rows of E (k, p)."""
    nN: int
    """Numbers in the remainder (N_w, row 1 of N_E)."""
    levels: int
    """Halvings of h for which there are matrices, h included."""
    guards: int
    """Event functions."""
    kind: int
    """RK4 or ETD."""
    restart: int
    """1 where the clock restarts with each arc."""
    lags: int
    """Where in x the torques of lagging motors are; 0 without."""
    n_drops: int
    n_switches: int
    n_parts: int
    """Terms of the disturbance."""
    pulled: int
    """1 where one of them, other than `force`, is a force from outside."""
    period: float
    """Of sample instants [s]; 0 for continuous time."""
    part: float
    """Time after a sample instant at which the waiting torque acts [s]; 0 for none."""
    t_first: float
    """Start of the run [s]."""
    least_step: float
    """Minimum step length [m]."""
    h: float
    """Step of integration [s]."""
    lag_speed: float
    """1 / tau of lagging motors [1/s]."""
    farthest: float
    """Bound of the angles [rad]."""
    K: Array
    """Numbers that the walker's functions read."""
    drops: Array
    """Rows (single support, how much lower the ground is at its end [m])."""
    switches: Array
    """Rows (single support, time in it [s]), or (0, time of the run [s])."""
    fastest: Array
    """Bounds of the rates (n,) [rad/s]."""
    phi: Array
    """Matrices of ETD-RK4 (levels, 6, k, k)."""
    push: Array
    """Numbers of the disturbance, term after term."""
    parts: Ints
    """Of each term: address of its function (t, step, t_start, q, v) -> (zeta, force), and how many numbers it
    has."""
    torque: Array
    """In K, what is added to the torques of the motors (p,) [N m]; set for `samples` alone, as `force` is."""
    force: Array
    """In `push`, the force on the trunk (2,) [N]."""
    # -- what changes
    t: float
    """[s]"""
    step: float
    """Single support."""
    t_start: float
    """Start of the single support [s]."""
    t_end: float
    """End of the arc, at the latest [s]."""
    t_arc: float
    """Start of the arc [s]."""
    fired: int
    """The guard that ended the last arc; -1 for none."""
    armed: int
    """Whether `values` are those of this arc."""
    every: int
    """Every how many steps a node is kept; 0 for never."""
    count: int
    """Nodes kept."""
    room: int
    """Rows of `nodes`, more than an arc can have."""
    width: int
    """Numbers in one of them."""
    sloped: int
    """1 where dx0 is the slope at x0 already."""
    lost: int
    """The status that a function's last output asks for; 0 for none."""
    drop: float
    """Of the ground at the end of this single support [m]."""
    limit: float
    """Functions are asked for no later time than this [s]."""
    t_event: float
    """Time of the event [s]."""
    t_b: float
    """Time of x_b [s]."""
    t_far: float
    """End of the bracket of an event [s], and the event function there."""
    f_far: float
    nodes: Array
    """Rows (t, x, x'); with `look` (t, step, force from outside (2,), what it says) at each step and the end,
    at a break just after it, where a force from outside may jump just before it too."""

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Array:
            """One of ROWS."""


FUNCTIONS = ("flow", "tick", "impact", "events", "to", "back", "remainder", "matvec")
"""Addresses of the walker's functions."""
TABLES = ("K", "drops", "switches", "fastest", "phi", "push", "parts")
"""Vectors of the plan."""
ROWS = (*("inp", "out", "load", "one"), *("values", "after", "tried"), *(*X_ROWS, *Y_ROWS))
"""Work vectors: inputs and outputs of a function; zeta with the force, and those of one term; event functions
at the start of a step, at its end, and at a time tried in it; those of `hybrid.constants`."""
# The annotations are strings ("int", "Array"), which `call` turns into numba's types. The order of the fields
# is the layout of the memory: nothing else says where r.t is.
KINDS: dict[str, str] = {**Run.__annotations__, **dict.fromkeys(ROWS, "Array")}
"""int, float, Array or Ints, by the name of a field."""
PLACES: dict[str, int] = {name: place for place, name in enumerate(KINDS)}
"""Cell of a field."""
