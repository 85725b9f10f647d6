"""The plan of a compiled run: what the kernels are given, and what the codes they return mean.

`engine.compiled_walker` fills the records below (addresses, sizes, ground, disturbance, clock,
method) with names; `plan` checks that they fit together and flattens them into the vectors of
integers P and floats F, whose places `layout` names. A plan is read only and serves any number of
runs, in any thread; what changes during a run is in the run vector s and in the work rows W.

In all records t is the time [s], `step` the number of the single support, t_start [s] when that began, x (nx,)
the state (q, q', and the states of the other parts), and zeta (n,) [N m] the disturbance. An arc is the flow
between two impacts, a tick a sample instant.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853

from biped_adrc.engine.kernels import layout
from biped_adrc.errors import InputError
from biped_adrc.hybrid.status import Status
from biped_adrc.types import Array

Ints = NDArray[np.int64]
T = TypeVar("T", np.int64, np.float64)

STATUS = (
    Status.COMPLETED,
    Status.TIME_OUT,
    Status.FELL,
    Status.STALLED,
    Status.NOT_FINITE,
    Status.SINGULAR,
    Status.STEP_FAILED,
    Status.EVENT_LIMIT,
    Status.RAN_AWAY,
)
"""The status for each code that a kernel returns; the codes `layout.STRUCK` and `layout.FULL` have none."""


class LawAddresses(NamedTuple):
    """Addresses of the walker's functions `void f(double* K, double* inp, double* out)`, 0 for none.

    K are the parameters, inp and out the values named below. pivot is the smallest |pivot| of the matrices that
    the controller inverts, infinite without one; 0 means a singular matrix, and the run ends as SINGULAR. Below
    0 it stands for a torque beyond the walker's bound, and the run ends as RAN_AWAY. The last four are for the
    exponential method, ETD-RK4, in its coordinates y = (w, E):

        w' = N_w,   E' = A E + N_E
    """

    flow: int
    """(t, step, t_start, x, zeta) -> (dx/dt, pivot); in sampled time only q, q' and lagging motors flow."""
    tick: int
    """(t, step, t_start, x, zeta, force) -> (x after the tick, pivot, q''), in sampled time. force (2,): from
    outside on the robot as a whole [N]."""
    strike: int
    """(t, step, x) -> (x+, pivot); step is that of the new single support."""
    watch: int
    """(t, t_start, drop, q) -> the event functions: clearance of the swing foot [m], height of the hip over its
    limit [m], time left for the step [s]; then x of the swing foot [m]. An event is where one falls to zero."""
    to: int = 0
    """x -> y = (w, E): the slow states w (nw,), and the stiff ones E (k, p) row by row."""
    back: int = 0
    """y -> x."""
    remainder: int = 0
    """(t, step, t_start, y, zeta) -> (N_w, N_E, pivot), N_E (r, p) only in the r rows `MethodTable.rows`."""
    turn: int = 0
    """E -> M E, with a matrix M (k, k) given in the argument K."""


class StateSizes(NamedTuple):
    """How many numbers the parts of a state have."""

    n: int
    """Coordinates."""
    nx: int
    """Numbers in x."""
    p: int
    """Actuated joints."""
    nw: int = 0
    """Numbers in w, read by the exponential method only."""
    k: int = 0
    """Rows of E (k, p); 0 without the exponential method."""
    moving: int = 0
    """How many states flow, the first in x; the rest is held between sample instants. 0 means all flow."""
    lag_at: int = 0
    """Where in x the torques of lagging motors are, which go to the last p numbers; 0 without a lag."""
    lag_speed: float = 0.0
    """How fast they go there, 1 / tau [1/s]."""
    fastest: Array = np.zeros(0)
    """Rates (n,) [rad/s] beyond which the run ends; empty for none."""
    farthest: float = math.inf
    """Angle [rad] beyond which it does."""


class GroundTable(NamedTuple):
    """The ground and what counts as a step on it."""

    least_step: float
    """Minimum step length [m]; shorter ground contacts are ignored."""
    drops: Array
    """(m, 2): rows (number of a single support, how much lower [m] the ground is at its end)."""


class DisturbanceTable(NamedTuple):
    """zeta as a sum of parts, each a function (t, step, t_start, q, v) -> zeta (n,) [N m]; 0 without any."""

    addresses: Ints = np.zeros(0, dtype=np.int64)
    """Of the parts' functions."""
    K: Array = np.zeros(0)
    """Parameters of all parts, one after the other."""
    offsets: Ints = np.zeros(1, dtype=np.int64)
    """Part i has the parameters K[offsets[i]:offsets[i + 1]]."""
    switches: Array = np.zeros((0, 2))
    """Times at which zeta is not smooth, where a step of integration has to end: (m, 2), rows (step, s), s [s]
    after single support `step` began, or for step 0 the time s itself.
    """
    resultants: tuple[int, ...] = ()
    """Addresses of (t, step, t_start, q, v) -> force (2,) [N] on the robot as a whole, 0 for none."""


class ClockTable(NamedTuple):
    """When the controller acts."""

    period: float = 0.0
    """Sampling period [s]; 0 for continuous time."""
    restart: int = 1
    """1 where sample instants are counted from the start of each arc, 0 where from t_first."""
    t_first: float = 0.0
    """Start of the run [s]."""
    part: float = 0.0
    """Time [s] from each tick until the torque that waits for a part of a period acts; 0 for none."""


class MethodTable(NamedTuple):
    """A one-step method with its numbers; made by `methods`."""

    kind: int
    """layout.RK4, DOP853 or ETD."""
    h: float = 1.0
    """Fixed step [s] of RK4 and ETD."""
    rtol: float = 1.0
    """Relative tolerance of DOP853 [1]."""
    atol: float = 1.0
    """Absolute tolerance of DOP853, one number for all states in their own units."""
    max_step: float = 1.0
    """Longest step of DOP853 [s]."""
    phi: Array = np.zeros((0, layout.MATRICES, 0, 0))
    """The six matrices of ETD-RK4, in the order of `PhiTable`, for h and its halvings (levels, 6, k, k)."""
    rows: Ints = np.zeros(0, dtype=np.int64)
    """The rows of E where the remainder N_E is not zero ("forced rows"), ints."""


TABLEAU = np.concatenate([getattr(DOP853, name).ravel() for name in ("A", "B", "C", "E3", "E5")])
"""Coefficients of `scipy.integrate.DOP853` in one vector of `layout.TABLEAU` numbers, in `layout`'s order."""
LEAST_PERIOD = 1e-9
"""Shortest sampling period [s]; with shorter ones ticks could not be counted exactly in floats."""


@dataclass(frozen=True)
class RunPlan:
    """What kernels read of a run: the vectors P and F, and the sizes of the state and of the work memory."""

    P: Ints
    """Integers: addresses, sizes, places in F."""
    F: Array
    """Floats: clock, tolerances, ground, disturbance, matrices."""
    nx: int
    """Numbers in a state."""
    width: int
    """Numbers in a work row."""

    def work(self) -> Array:
        """New work memory (ROWS, width) of zeros for one run; runs at the same time must not share it."""
        return np.zeros((layout.ROWS, self.width))

    def start(self, x: Array, t: float, step: int, t_start: float, end: float) -> Array:
        """The run vector s (HEAD + nx,) with which a run begins: its head, then the state x (nx,).

        From t [s] to `end` [s] at the latest, in the single support `step` that began at t_start [s].
        Raises InputError for a state that is not finite or has another shape.
        """
        x = np.asarray(x, dtype=float)
        if x.shape != (self.nx,) or not np.all(np.isfinite(x)):
            raise InputError(f"the initial state is {x}, expected {self.nx} finite numbers")
        s = np.zeros(layout.HEAD + self.nx)
        s[layout.TIME], s[layout.STEP], s[layout.START], s[layout.END] = t, step, t_start, end
        s[layout.FIRED], s[layout.ARC] = -1.0, t
        s[layout.HEAD :] = x
        return s


def plan(
    code: LawAddresses,
    sizes: StateSizes,
    scene: GroundTable,
    push: DisturbanceTable,
    clock: ClockTable,
    method: MethodTable,
) -> RunPlan:
    """Check these parts and put them into the vectors P and F. Raises InputError where they do not fit."""
    _check(code, sizes, push, clock, method)
    P = np.zeros(layout.P_HEAD, dtype=np.int64)
    P[: len(code)] = code
    P[layout.COORDINATES], P[layout.STATES], P[layout.JOINTS] = sizes.n, sizes.nx, sizes.p
    P[layout.SLOW], P[layout.STIFF] = sizes.nw, sizes.k
    P[layout.MOVING], P[layout.LAG_AT] = sizes.moving or sizes.nx, sizes.lag_at
    P[layout.FORCED], P[layout.LEVELS] = len(method.rows), len(method.phi)
    P[layout.KIND], P[layout.RESTART] = method.kind, clock.restart
    P[layout.DROPS], P[layout.SWITCHES] = len(scene.drops), len(push.switches)
    P[layout.PARTS] = len(push.addresses)
    head = np.zeros(layout.F_HEAD)
    head[layout.PERIOD], head[layout.T_FIRST] = clock.period, clock.t_first
    head[layout.PERIOD_PART], head[layout.LAG_SPEED] = clock.part, sizes.lag_speed
    head[layout.LEAST_STEP], head[layout.H] = scene.least_step, method.h
    head[layout.RTOL], head[layout.ATOL] = method.rtol, method.atol
    head[layout.MAX_STEP] = method.max_step
    weights = method.phi if method.kind == layout.ETD else TABLEAU
    P[layout.WIDTH] = _width(sizes)
    fastest = sizes.fastest if len(sizes.fastest) else np.full(sizes.n, np.inf)
    bounds = np.append(fastest, sizes.farthest)
    F, at = _joined([head, scene.drops, push.switches, push.K, weights, bounds], np.float64)
    P[layout.FASTEST_AT] = at[5]
    P[layout.DROPS_AT], P[layout.SWITCHES_AT], P[layout.WEIGHTS_AT] = at[1], at[2], at[4]
    resultants = push.resultants or (0,) * len(push.addresses)
    given = zip(push.addresses, push.offsets[:-1], resultants, strict=True)
    parts = [(a, at[3] + o, r) for a, o, r in given]
    P, where = _joined([P, method.rows, np.array(parts, dtype=np.int64)], np.int64)
    P[layout.ROWS_AT], P[layout.PARTS_AT] = where[1], where[2]
    return RunPlan(P, F, sizes.nx, _width(sizes))


def _check(
    code: LawAddresses,
    sizes: StateSizes,
    push: DisturbanceTable,
    clock: ClockTable,
    method: MethodTable,
) -> None:
    """Raise InputError for parts that do not fit together: compiled code would read elsewhere in memory."""
    if len(push.offsets) != len(push.addresses) + 1 or push.offsets[-1] > len(push.K):
        raise InputError(
            f"{len(push.addresses)} parts of a disturbance with {len(push.K)} parameters have offsets "
            f"{push.offsets}, expected one more than parts, the last one the number of parameters"
        )
    if not (math.isfinite(clock.period) and (clock.period == 0.0 or clock.period >= LEAST_PERIOD)):
        raise InputError(
            f"the sampling period is {clock.period} s, expected at least {LEAST_PERIOD:g} s, or 0 for none"
        )
    k, phi = sizes.k, method.phi
    if method.kind == layout.ETD and (k == 0 or phi.shape[1:] != (layout.MATRICES, k, k)):
        raise InputError(
            f"the matrices have shape {phi.shape}, expected (levels, 6, {k}, {k}), k > 0"
        )
    needed = {"flow": True, "watch": True, "strike": True, "tick": clock.period > 0.0}
    needed |= dict.fromkeys(("to", "back", "remainder", "turn"), method.kind == layout.ETD)
    missing = [name for name, is_needed in needed.items() if is_needed and not getattr(code, name)]
    if missing:
        raise InputError(f"no address of {', '.join(missing)}, which this method and clock call")


def _joined(parts: Sequence[Array | Ints], dtype: type[T]) -> tuple[NDArray[T], list[int]]:
    """All parts in one vector, and where each begins."""
    flat: list[NDArray[T]] = [np.asarray(part, dtype=dtype).ravel() for part in parts]
    return np.concatenate(flat), [0, *accumulate(map(len, flat[:-1]))]


def _width(sizes: StateSizes) -> int:
    """Numbers of the longest row: a function's input or output, or the head of a run."""
    states = max(sizes.nx, sizes.nw + sizes.k * sizes.p)
    return max(layout.HEAD, 3 + states + max(sizes.n, 2) + layout.OUTSIDE)
