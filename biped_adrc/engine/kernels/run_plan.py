"""What a compiled walk is given, what its codes mean, and the plan of a run.

The plan is what a run needs, flattened into the integers P and floats F of the kernels, once for any number of
runs.
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
)
"""By the code of a kernel; `layout.STRUCK` and `layout.FULL` are no statuses."""


class LawAddresses(NamedTuple):
    """Addresses of `void f(double* K, double* inp, double* out)`, 0 for none.

    zeta is (n,) [N m]; pivot, the least of the matrices inverted, makes a state that is not finite SINGULAR
    where it is exactly 0, and is infinite without one.
    """

    flow: int
    """(t, step, t_start, x, zeta) -> (dx, pivot); in sampled time only q and v flow."""
    tick: int
    """(t, step, t_start, x, zeta, outside) -> (x after the tick, pivot, q''), in sampled time. outside (5,):
    force from outside (2) [N], its impulse since the last tick (2) [N s], drop of the ground [m]."""
    strike: int
    """(t, step, x) -> (x+, pivot); step is that of the new single support."""
    watch: int
    """(t, t_start, drop, q) -> witnesses of the guards, in `layout`'s order, and x of the swing foot [m]."""
    to: int = 0
    """x -> y = (w, E), E (k, p) row by row; the coordinates of the exponential method."""
    back: int = 0
    """y -> x."""
    remainder: int = 0
    """(t, step, t_start, y, zeta) -> (N_w, N_E, pivot), N_E (r, p) in the forced rows only."""
    turn: int = 0
    """For a matrix M (k, k) in place of K: E -> M E."""


class StateSizes(NamedTuple):
    """n coordinates, nx states, p joints, nw and (k, p) numbers of y = (w, E).

    moving: how many of the first states flow, all for 0; the others are held between ticks.
    """

    n: int
    nx: int
    p: int
    nw: int = 0
    k: int = 0
    moving: int = 0


class GroundTable(NamedTuple):
    """least_step [m]; drops (m, 2): rows (single support, height [m])."""

    least_step: float
    drops: Array


class DisturbanceTable(NamedTuple):
    """zeta as a sum of parts, each a function (t, step, t_start, q, v) -> zeta (n,); 0 without any.

    Part i has the parameters K[offsets[i]:offsets[i + 1]]. switches (m, 2): rows (step, s); the torque is not
    smooth s [s] after that single support began, or for step 0 at the time s.
    """

    addresses: Ints = np.zeros(0, dtype=np.int64)
    K: Array = np.zeros(0)
    offsets: Ints = np.zeros(1, dtype=np.int64)
    switches: Array = np.zeros((0, 2))
    resultants: tuple[int, ...] = ()
    """Addresses of (t, step, t_start, q, v) -> force (2,) [N] on the robot as a whole, 0 for none."""


class ClockTable(NamedTuple):
    """Ticks every `period` [s], 0 for continuous time, from the arc's start or, without restart, t_first."""

    period: float = 0.0
    restart: int = 1
    t_first: float = 0.0
    part: float = 0.0
    """[s] after each tick at which the waiting torque acts, 0 for none."""


class MethodTable(NamedTuple):
    """Step or tolerances, and for ETD-RK4 phi (levels, 6, k, k) and the forced rows."""

    kind: int
    h: float = 1.0
    rtol: float = 1.0
    atol: float = 1.0
    max_step: float = 1.0
    phi: Array = np.zeros((0, layout.MATRICES, 0, 0))
    rows: Ints = np.zeros(0, dtype=np.int64)


TABLEAU = np.concatenate([getattr(DOP853, name).ravel() for name in ("A", "B", "C", "E3", "E5")])
"""Of `scipy.integrate.DOP853`."""
LEAST_PERIOD = 1e-9
"""[s]; what is shorter cannot be counted in floats."""


@dataclass(frozen=True)
class RunPlan:
    """P and F, read only, and the sizes of what a run needs beside them."""

    P: Ints
    F: Array
    nx: int
    width: int

    def work(self) -> Array:
        """Work rows; one matrix for each run that goes on at the same time."""
        return np.zeros((layout.ROWS, self.width))

    def start(self, x: Array, t: float, step: int, t_start: float, end: float) -> Array:
        """The vector s of a run from x at t [s], in the single support `step` that began at t_start [s].

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
    """Raises InputError for parts that do not fit together."""
    _check(code, sizes, push, clock, method)
    P = np.zeros(layout.P_HEAD, dtype=np.int64)
    P[: len(code)] = code
    P[layout.COORDINATES], P[layout.STATES], P[layout.JOINTS] = sizes.n, sizes.nx, sizes.p
    P[layout.SLOW], P[layout.STIFF] = sizes.nw, sizes.k
    P[layout.MOVING] = sizes.moving or sizes.nx
    P[layout.FORCED], P[layout.LEVELS] = len(method.rows), len(method.phi)
    P[layout.KIND], P[layout.RESTART] = method.kind, clock.restart
    P[layout.DROPS], P[layout.SWITCHES] = len(scene.drops), len(push.switches)
    P[layout.PARTS] = len(push.addresses)
    head = np.zeros(layout.F_HEAD)
    head[layout.PERIOD], head[layout.T_FIRST] = clock.period, clock.t_first
    head[layout.PERIOD_PART] = clock.part
    head[layout.LEAST_STEP], head[layout.H] = scene.least_step, method.h
    head[layout.RTOL], head[layout.ATOL] = method.rtol, method.atol
    head[layout.MAX_STEP] = method.max_step
    weights = method.phi if method.kind == layout.ETD else TABLEAU
    P[layout.WIDTH] = _width(sizes)
    F, at = _joined([head, scene.drops, push.switches, push.K, weights], np.float64)
    P[layout.DROPS_AT], P[layout.SWITCHES_AT], P[layout.WEIGHTS_AT] = at[1], at[2], at[4]
    resultants = push.resultants or (0,) * len(push.addresses)
    P[layout.RESULTANTS] = np.count_nonzero(resultants)
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
    """All in one vector, and where each begins."""
    flat: list[NDArray[T]] = [np.asarray(part, dtype=dtype).ravel() for part in parts]
    return np.concatenate(flat), [0, *accumulate(map(len, flat[:-1]))]


def _width(sizes: StateSizes) -> int:
    """Numbers of the longest row: a law's input or output, or the head of a run."""
    states = max(sizes.nx, sizes.nw + sizes.k * sizes.p)
    return max(layout.HEAD, 3 + states + max(sizes.n, 2) + layout.OUTSIDE)
