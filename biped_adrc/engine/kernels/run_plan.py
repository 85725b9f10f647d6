"""The plan of a compiled run: its block of cells as it begins, and what the codes that it ends with mean.

`engine.compiled_walker` fills the records below (addresses, sizes, ground, disturbance, clock, method) with
names; `plan` lays them out as `record` says. A plan is read only and serves
any number of runs, in any thread: each has a copy of the block.

In all records t is the time [s], `step` the number of the single support, t_start [s] when that began, x (nx,)
the state (q, q', and the states of the other parts), and zeta (n,) [N m] the disturbance. An arc is the flow
between two impacts, a tick a sample instant.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.engine.kernels.record import (
    FOOT_STRIKE,
    KINDS,
    OUTSIDE,
    PART,
    PLACES,
    ROWS,
    TABLES,
    Ints,
)
from biped_adrc.errors import InputError
from biped_adrc.hybrid.constants import MATRICES, STRUCK
from biped_adrc.hybrid.status import Status
from biped_adrc.types import Array, frozen

STATUS = tuple(Status)[:STRUCK]
"""The status for each code of `hybrid.constants`; STRUCK and FULL have none."""


class Functions(NamedTuple):
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
    impact: int
    """(t, step, x) -> (x+, pivot); step is that of the new single support."""
    events: int
    """(t, t_start, drop, q) -> the event functions: clearance of the swing foot [m], height of the hip over its
    limit [m], time left for the step [s]; then x of the swing foot [m]. An event is where one falls to zero."""
    to: int = 0
    """x -> y = (w, E): the slow states w (nw,), and the stiff ones E (k, p) row by row."""
    back: int = 0
    """y -> x."""
    remainder: int = 0
    """(t, step, t_start, y, zeta) -> (N_w, N_E, pivot), N_E (p,) in row 1 alone, the others being zero."""
    matvec: int = 0
    """E -> M E, with a matrix M (k, k) in the argument K."""


class StateSizes(NamedTuple):
    """How many numbers the parts of a state have."""

    n: int
    """Coordinates."""
    nx: int
    """Numbers in x."""
    p: int
    """Actuated joints."""
    n_slow: int = 0
    """Numbers in w, read by the exponential method only."""
    k: int = 0
    """Rows of E (k, p); 0 without the exponential method."""
    moving: int = 0
    """How many states flow, the first in x; the rest is held between sample instants. 0 means all flow."""
    lags: int = 0
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
    """A one-step method with its numbers."""

    kind: int
    """RK4 or ETD."""
    h: float
    """Step [s]."""
    phi: Array = np.zeros((0, MATRICES, 0, 0))
    """The matrices of ETD-RK4 (levels, 6, k, k), by `hybrid.exponential.phi_levels`."""


LEAST_PERIOD = 1e-9
"""Shortest sampling period [s]; with shorter ones ticks could not be counted exactly in floats."""


class CompiledRun:
    """One run in memory, by name: run["t"], run["x0"]. Runs at the same time must not share it."""

    def __init__(self, cells: Ints, pointers: Ints, nx: int):
        """cells: of the plan, copied; pointers: which of them point into the block, from its start."""
        self.cells, self.pointers, self.nx = cells.copy(), pointers, nx
        self.cells[pointers] += self.address
        self.numbers = self.cells.view(np.float64)

    @property
    def address(self) -> int:
        """Of the block."""
        return int(self.cells.ctypes.data)

    @property
    def x(self) -> Array:
        """State (nx,), as a view."""
        at = self.place("x0")
        return self.numbers[at : at + self.nx]

    @property
    def width(self) -> int:
        """Numbers in a work vector."""
        return self.place("dx0") - self.place("x0")

    @property
    def block(self) -> Ints:
        """The cells, pointers as distances from its start [bytes] again."""
        block = self.cells.copy()
        block[self.pointers] -= self.address
        return block

    def place(self, name: str) -> int:
        """Cell of the first number of a vector."""
        return (int(self.cells[PLACES[name]]) - self.address) // 8

    def __getitem__(self, name: str) -> float:
        """A number."""
        where = self.numbers if KINDS[name] == "float" else self.cells
        return where[PLACES[name]].item()

    def __setitem__(self, name: str, value: float) -> None:
        """A number, or the address of a vector outside the block."""
        where = self.numbers if KINDS[name] == "float" else self.cells
        where[PLACES[name]] = value

    def set_nodes(self, rows: Array) -> None:
        """Room for nodes (N, 1 + 2 nx), C-contiguous; whoever gives it keeps it alive."""
        self["nodes"], self["room"] = rows.ctypes.data, len(rows)

    def set_table(self, look: int, table: Array) -> None:
        """Room for columns of `table` (height, N), likewise; look: address of the function that fills them."""
        self["look"], self["table"] = look, table.ctypes.data
        self["height"], self["most_columns"] = table.shape


def table_height(p: int) -> int:
    """Numbers in a column of `table` with a `StepReading` of p joints behind the first four."""
    return 4 + 3 * p + 4


@dataclass(frozen=True)
class RunPlan:
    """The block of a run as it begins."""

    cells: Ints
    """Fields, tables and rows."""
    pointers: Ints
    """Cells that point into the block; they hold the distance from its start [bytes]."""
    places: dict[str, int]
    """Cell at which each of TABLES begins."""
    nx: int
    """Numbers in a state."""

    def number(self, name: str) -> float:
        """A field, such as the step h [s]."""
        return float(self.cells.view(np.float64)[PLACES[name]])

    def term(self, k: int) -> int:
        """Cell at which the numbers of term k of the disturbance begin."""
        return int(self.cells[self.places["parts"] + PART * k + 1]) // 8

    def start(
        self, x: Array, t: float, step: int, t_start: float, t_end: float, fired: bool = False
    ) -> CompiledRun:
        """A run from x (nx,) at t [s] to t_end [s] at the latest, in the single support `step` that began at
        t_start.

        fired: whether an impact has just been. Raises InputError for a state that is not finite or has another
        shape.
        """
        x = np.asarray(x, dtype=float)
        if x.shape != (self.nx,) or not np.all(np.isfinite(x)):
            raise InputError(f"the initial state is {x}, expected {self.nx} finite numbers")
        run = CompiledRun(self.cells, self.pointers, self.nx)
        run["t"] = run["t_arc"] = t
        run["step"], run["t_start"], run["t_end"] = step, t_start, t_end
        run["fired"] = FOOT_STRIKE if fired else -1
        run.x[:] = x
        return run


def plan(
    functions: Functions,
    sizes: StateSizes,
    K: Array,
    ground: GroundTable,
    push: DisturbanceTable,
    clock: ClockTable,
    method: MethodTable,
) -> RunPlan:
    """Lay these parts out; K: numbers that the functions read. Raises InputError for a period too short."""
    if 0.0 < clock.period < LEAST_PERIOD:
        raise InputError(
            f"the sampling period is {clock.period} s, expected at least {LEAST_PERIOD:g} s"
        )
    n, nx, p = sizes.n, sizes.nx, sizes.p
    fields: dict[str, float] = {
        **functions._asdict(),
        **sizes._asdict(),
        "moving": sizes.moving or nx,
        "guards": 3,
        "ny": sizes.n_slow + sizes.k * p,
        "nN": sizes.n_slow + p,
        "levels": len(method.phi),
        **clock._asdict(),
        "kind": method.kind,
        "h": method.h,
        "least_step": ground.least_step,
        "n_drops": len(ground.drops),
        "n_switches": len(push.switches),
        "n_parts": len(push.addresses),
        "pulled": int(any(push.resultants)),
    }
    fastest = sizes.fastest if len(sizes.fastest) else np.full(n, np.inf)
    floats = (K, ground.drops, push.switches, fastest, method.phi, push.K)
    tables = [np.ascontiguousarray(x, dtype=float).ravel().view(np.int64) for x in floats]
    resultants = push.resultants or (0,) * len(push.addresses)
    parts = np.array([push.addresses, push.offsets[:-1], resultants], dtype=np.int64).T
    width = 3 + max(nx, int(fields["ny"])) + max(n, 2) + OUTSIDE
    tables.append(parts.ravel())
    lengths = [*map(len, tables), *(width for _ in ROWS)]
    starts = np.cumsum([len(KINDS), *lengths])
    cells = np.concatenate([np.zeros(len(KINDS), dtype=np.int64), *tables])
    cells = np.append(cells, np.zeros(starts[-1] - len(cells), dtype=np.int64))
    places = dict(zip((*TABLES, *ROWS), starts[:-1].tolist(), strict=True))
    for name, value in fields.items():
        if name in PLACES and name not in TABLES:
            cells.view(np.float64 if KINDS[name] == "float" else np.int64)[PLACES[name]] = value
    for name, start in places.items():
        cells[PLACES[name]] = 8 * start
    numbers = np.arange(len(parts)) * PART + 1 + places["parts"]
    cells[numbers] = 8 * (places["push"] + cells[numbers])
    pointers = np.concatenate(([PLACES[name] for name in places], numbers)).astype(np.int64)
    return RunPlan(frozen(cells), frozen(pointers), {k: places[k] for k in TABLES}, nx)
