"""The plan of a compiled run: its block of cells as it begins, and what the codes that it ends with mean.

`engine.compiled_walker` gives addresses, tables and fields by name; `plan` lays them out as `record` says.
A plan is read only and serves
any number of runs, in any thread: each has a copy of the block.

In all records t is the time [s], `step` the number of the single support, t_start [s] when that began, x (nx,)
the state (q, q', and the states of the other parts), and zeta (n,) [N m] the disturbance. An arc is the flow
between two impacts, a tick a sample instant.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array, frozen
from biped_adrc.engine.kernels.load import kernels
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
from biped_adrc.hybrid.constants import FULL, STRUCK
from biped_adrc.hybrid.status import Status

STATUS: tuple[Status, ...] = tuple(Status)[:STRUCK]
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


class Push(NamedTuple):
    """A disturbance as a sum of terms, each a function (t, step, t_start, q, v) -> zeta (n,) [N m]."""

    parts: Ints = np.zeros((0, PART), dtype=np.int64)
    """As `record.Run.parts`, the numbers' addresses as their places in `K`."""
    K: Array = np.zeros(0)
    """Numbers of all terms, one after the other."""
    switches: Array = np.zeros((0, 2))
    """Times at which zeta is not smooth, where a step of integration has to end, as `record.Run.switches`."""


class ArcNodes(NamedTuple):
    """Nodes of one arc and how it ended."""

    code: int
    """One of `hybrid.constants`; after STRUCK the run is at x-."""
    t: Array
    """Node times (m,) [s]."""
    x: Array
    """States (m, nx), in their own units."""
    dx: Array
    """Their time derivatives (m, nx)."""


LEAST_PERIOD = 1e-9
"""Shortest sampling period [s]; with shorter ones ticks could not be counted exactly in floats."""


class CompiledRun:
    """One run in memory, by name: run["t"], run["x0"]. Runs at the same time must not share it."""

    def __init__(self, cells: Ints, pointers: Ints, nx: int):
        """cells: of the plan, copied; pointers: which of them point into the block, from its start."""
        self.cells, self.pointers, self.nx = cells.copy(), pointers, nx
        self.address = int(self.cells.ctypes.data)
        self.cells[pointers] += self.address
        self.numbers = self.cells.view(np.float64)
        at = self.place("x0")
        self.x = self.numbers[at : at + nx]
        """State (nx,), as a view."""

    @property
    def block(self) -> Ints:
        """The cells, pointers as distances from its start [bytes] again."""
        block = self.cells.copy()
        block[self.pointers] -= self.address
        return block

    @property
    def inputs(self) -> int:
        """Address of the inputs of its functions."""
        return int(self.cells[PLACES["inp"]])

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

    def arc(self, every: int, rows: Array) -> ArcNodes:
        """March to the first event, or to run["t_end"] [s].

        every: each so many-th step is kept as a node. rows (room, 1 + 2 nx), C-contiguous: overwritten with the
        nodes; where they do not suffice, the arc is marched again with twice as many new ones.
        """
        nx, self["every"], self["count"] = self.nx, every, 0
        while True:
            self["nodes"], self["room"] = rows.ctypes.data, len(rows)
            code = kernels().go_on(self.address)
            if code != FULL:
                rows = rows[: int(self["count"])]
                return ArcNodes(code, rows[:, 0], rows[:, 1 : 1 + nx], rows[:, 1 + nx :])
            rows = np.empty((2 * len(rows), 1 + 2 * nx))

    def land(self) -> int:
        """x+ in place of x- after an arc that has STRUCK; a status."""
        return kernels().land(self.address)

    def stride(self, impacts: int, strikes: Array) -> tuple[int, int]:
        """Over `impacts` impacts, or until run["t_end"] for 0: status and how many were made.

        strikes (m, 1 + 2 nx), C-contiguous, gets a row (t, x-, x+) of each.
        """
        step = self["step"]
        code = kernels().stride(self.address, impacts, strikes.ctypes.data, len(strikes))
        return code, int(self["step"] - step)

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
    functions: Functions, push: Push, tables: Mapping[str, Array], fields: Mapping[str, float]
) -> RunPlan:
    """Lay out a run: other tables and fields by their names in `record.Run`; those left out are empty and 0.

    Raises InputError for a period too short.
    """
    values = {"moving": fields["nx"], "guards": 3, **functions._asdict(), **fields}
    if 0.0 < values.get("period", 0.0) < LEAST_PERIOD:
        raise InputError(
            f"the sampling period is {values['period']} s, expected at least {LEAST_PERIOD:g} s"
        )
    n, nx, p, k = (int(values.get(name, 0)) for name in ("n", "nx", "p", "k"))
    slow, none, parts = int(values.get("n_slow", 0)), np.zeros(0), push.parts.copy()
    vectors = {"fastest": np.full(n, np.inf), "push": push.K, "switches": push.switches, **tables}
    values |= {"ny": slow + k * p, "nN": slow + p, "levels": len(vectors.get("phi", none))}
    values |= {"n_drops": len(vectors.get("drops", none)), "n_switches": len(push.switches)}
    values |= {"n_parts": len(parts), "pulled": int(np.any(parts[:, 2]))}
    floats = (vectors.get(name, none) for name in TABLES[:-1])
    blocks = [np.ascontiguousarray(x, dtype=float).ravel().view(np.int64) for x in floats]
    width = 3 + max(nx, values["ny"]) + max(n, 2) + OUTSIDE
    lengths = [*map(len, blocks), parts.size, *(width for _ in ROWS)]
    starts = np.cumsum([len(KINDS), *lengths])
    places = dict(zip((*TABLES, *ROWS), starts[:-1].tolist(), strict=True))
    parts[:, 1] = 8 * (places["push"] + parts[:, 1])
    cells = np.zeros(starts[-1], dtype=np.int64)
    filled = np.concatenate([*blocks, parts.ravel()])
    cells[len(KINDS) : len(KINDS) + len(filled)] = filled
    for name, value in values.items():
        cells.view(np.float64 if KINDS[name] == "float" else np.int64)[PLACES[name]] = value
    for name, start in places.items():
        cells[PLACES[name]] = 8 * start
    numbers = np.arange(len(parts)) * PART + 1 + places["parts"]
    pointers = np.concatenate(([PLACES[name] for name in places], numbers)).astype(np.int64)
    return RunPlan(frozen(cells), frozen(pointers), {k: places[k] for k in TABLES}, nx)
