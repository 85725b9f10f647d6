"""The memory of one compiled run: a block of cells of 8 bytes, which the march, the compiled loop over time
(`hybrid.march`), reads and writes.

The block begins with one cell for each field of `Run`, in the order below. A field that is a vector holds the
address of its first number, which stands further back in the same block: first the vectors of TABLES, then the
work vectors of ROWS, which all have one length. `compiled_run.plan` writes the block before a run. The march
changes the fields behind the comment "what changes"; of the others a run changes torque and push alone
(`arc.samples`). Two runs never share a cell, so they may run in two threads.

Symbols: t time and t_start the beginning of the single support with the number `step`, both [s]; x (nx,) state,
q (n,) its angles [rad]; zeta (n,) disturbance [N m]; x+ the state after an impact; q'' acceleration [rad/s^2];
tau time constant of lagging motors [s]. A node is a stored instant, a tick a sample instant.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from biped_adrc.core.types import Array
from biped_adrc.hybrid.constants import X_ROWS, Y_ROWS

Ints = NDArray[np.int64]
FOOT_STRIKE, HIP_TOO_LOW, FOOT_X = 0, 1, 3
"""Indices in the output of a walker's function `events`: two event functions; x of the swing foot [m]."""
PART = 2
"""How many numbers `parts` has for each term of a disturbance."""
OUTSIDE = 2
"""How many numbers the inputs of a sample instant have at their end: the force from outside (2,), or the
vertical forces on both feet."""


# A block of several walks has rows, each with one number of every walk. Its first rows are t, the number of the
# single support and its start; the others begin at the places that `block_rows` returns, in this order:
X, LOAD, T1, LIMIT, DROP, FARTHEST, FASTEST, BREAK, NEXT = range(9)
VALUES, MARK, SLOPE, WEIGHTS, STAGE, STAGE_LOAD, END = range(9, 16)
"""State (nx,); disturbance (n,) and force from outside (OUTSIDE,) at t; end of the step [s]; latest time [s] at
which the disturbance is evaluated in it; how much lower the ground is at the end of this single support [m];
bounds of angles [rad] and rates (n,) [rad/s]; time [s] from which the waiting torque acts, and of the next
sample instant; event functions (3,) at t; mark, 1 where nothing else happened, else 0; x' (nx,) at t; weights
of lagging torques (4,); time, single support and (q, v) at a stage, and disturbance and force there. At END
stand two cells: the address of the compiled disturbance, 0 for none, and of its numbers."""


def block_rows(n: int, nx: int) -> Ints:
    """First rows of the parts of a block, for n coordinates and states of nx numbers."""
    push = n + OUTSIDE
    return np.cumsum((3, nx, push, 1, 1, 1, 1, n, 1, 1, 3, 1, nx, 4, 3 + 2 * n, push))


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
    """Address of a function with the inputs of `tick`, whose output the rows of `nodes` hold in place of
    states; 0 for none."""
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
    """Number of lengths of step h, h / 2, h / 4, .. for which there are matrices."""
    guards: int
    """Number of event functions."""
    kind: int
    """Method of integration, RK4 or ETD of `hybrid.constants`."""
    restart: int
    """1 where the clock restarts with each arc."""
    lags: int
    """Index in x of the first torque of lagging motors; 0 without."""
    n_K: int
    """Numbers in `K`."""
    n_push: int
    """Numbers in `push`."""
    n_drops: int
    """Rows of `drops`."""
    n_switches: int
    """Rows of `switches`."""
    n_parts: int
    """Number of the disturbance's terms."""
    pulled: int
    """1 where one of them, other than `force`, is a force from outside."""
    period: float
    """Time between sample instants [s]; 0 for continuous time."""
    part: float
    """Time after a sample instant [s] from which the waiting torque acts, for a delay that is no whole number
    of periods; else 0."""
    t_first: float
    """Start of the run [s]."""
    least_step: float
    """Shortest walking step [m]: a touchdown less far ahead of the stance foot is ignored."""
    h: float
    """Step of integration [s]."""
    lag_speed: float
    """1 / tau of lagging motors [1/s]."""
    farthest: float
    """Bound of |angles| [rad], beyond which the run ends as RAN_AWAY."""
    K: Array
    """Numbers that the walker's functions read."""
    drops: Array
    """Rows (number of the single support, how much lower the ground is at its end [m])."""
    switches: Array
    """Times at which the disturbance is not smooth: rows (number of the single support, time since its start
    [s]), or (0, time of the run [s])."""
    fastest: Array
    """Bounds of |rates| (n,) [rad/s], as `farthest`."""
    phi: Array
    """Matrices of ETD-RK4 (levels, 6, k, k)."""
    push: Array
    """Numbers of the disturbance, term after term."""
    parts: Ints
    """Of each term: address of its function (t, step, t_start, q, v) -> (zeta, force), length of its `push`."""
    torque: Array
    """Place in K of the torque from outside (p,) [N m], which is added to the motors'; only `arc.samples` uses
    it and `force`."""
    force: Array
    """Place in `push` of the force from outside on the trunk (2,) [N]."""
    # -- what changes
    t: float
    """Time that the run has reached [s]."""
    step: float
    """Number of the single support."""
    t_start: float
    """Start of the single support [s]."""
    t_end: float
    """End of the arc, at the latest [s]."""
    t_arc: float
    """Start of the arc [s]."""
    fired: int
    """Index of the guard, that is the event function, that ended the last arc; -1 for none."""
    armed: int
    """1 where `values` are those of this arc, 0 before its first step."""
    every: int
    """A node is kept every so many integration steps; 0 for never."""
    count: int
    """Number of nodes kept so far."""
    pause: int
    """1 where the march returns after each step, PAUSED."""
    done: int
    """Steps since the last break, of a march that has paused."""
    t_from: float
    """Time of that break [s]."""
    kept: int
    """Number of nodes before the sample that is made side by side."""
    room: int
    """Rows of `nodes`, more than the arcs can have."""
    width: int
    """Numbers in a row of `nodes`."""
    sloped: int
    """1 where dx0 is the slope at x0 already."""
    most: int
    """Number of impacts after which the run ends as COMPLETED; `strikes` has rows for them."""
    struck: int
    """Number of impacts so far."""
    last: float
    """End of the run [s], at the latest, where t_end is that of a sample."""
    lost: int
    """Status for which a pivot of 0 or below stands, SINGULAR or RAN_AWAY; 0 for none."""
    drop: float
    """How much lower the ground is at the end of this single support [m]."""
    limit: float
    """Time of the next break [s] but for the last bit: functions of time are evaluated no later, so that they
    give limits from the left there."""
    t_event: float
    """Time of the event that was found [s]."""
    t_b: float
    """Time of the state x_b, at which the sub-steps towards an event end [s]."""
    t_far: float
    """End of the bracket of an event [s]."""
    f_far: float
    """The event function at t_far."""
    strikes: Array
    """Rows (t, x-, x+) of the impacts."""
    nodes: Array
    """Rows (t, x, x'); with `look` (t, step, force from outside (2,), output of `look`) at each integration
    step and at the end, at a break after what happens there; where a force from outside may jump, before it
    too."""
    # -- of a team of walks side by side (`kernels.lanes`)
    lanes: int
    """How many they are."""
    pushes: int
    """Address of the disturbance's function for all of them."""
    at: Ints
    """`block_rows` a block."""
    now: Array
    """Block of rows at a sample instant."""
    then: Array
    """Block of rows after it."""
    results: Array
    """Results of `look` (.., lanes)."""
    team: Ints
    """Addresses of their runs (lanes,), 0 for none."""
    seats: Ints
    """Which walk sits in each lane (lanes,), -1 for none."""
    ready: Ints
    """Of samples under inputs from outside, for each lane: 1 where its walk may go side by side, 2 once K and
    push have its numbers, else 0."""

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Array:
            """One of the vectors in ROWS."""


FUNCTIONS = ("flow", "tick", "impact", "events", "to", "back", "remainder", "matvec")
"""Fields that are addresses of the walker's functions."""
TABLES = ("K", "drops", "switches", "fastest", "phi", "push", "parts")
"""Fields that are vectors of numbers, written before the run."""
ROWS = (*("inp", "out", "load", "one"), *("values", "after", "tried"), *(*X_ROWS, *Y_ROWS))
"""Work vectors: inputs and outputs of a function; zeta with the force, and those of one term; event functions
at the start of a step, at its end, and at a time tried in it; those of `hybrid.constants`."""
# The annotations are strings ("int", "Array"), which `call` turns into numba's types. The order of the fields
# is the layout of the memory: nothing else says where r.t is.
KINDS: dict[str, str] = {**Run.__annotations__, **dict.fromkeys(ROWS, "Array")}
"""Kind of each field, by name: int, float, Array or Ints."""
PLACES: dict[str, int] = {name: place for place, name in enumerate(KINDS)}
"""Cell of each field, by name."""
