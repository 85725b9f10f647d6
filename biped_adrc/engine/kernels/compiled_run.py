"""A compiled run in memory: its block of cells of 8 bytes by name, and the status for each code of its end.

The block holds the numbers of the run, its vectors ("tables") and the addresses of its functions.
`engine.program` has them by name; `plan` puts each into its cell, whose place `record` says. A plan is the
block of a run that has not begun. It serves any number of runs, in any thread: each starts in a copy of it.

In all records t is the time [s], `step` the number of the single support, t_start [s] when that began, x (nx,)
the state (q, q', and the states of the other parts), and zeta (n,) [N m] the disturbance. An arc is the flow
between two impacts, a tick a sample instant, a node a stored instant.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from itertools import accumulate
from typing import Any

import numpy as np

from biped_adrc.closed_loop.instant_signals import node_layout
from biped_adrc.core.types import Array
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.record import KINDS, OUTSIDE, PLACES, ROWS, TABLES, Ints
from biped_adrc.hybrid.constants import RESOLUTION, STRUCK
from biped_adrc.hybrid.status import Status

STATUS: tuple[Status, ...] = tuple(Status)[:STRUCK]
"""The status for each code of `hybrid.constants`; STRUCK has none."""
NO_ROWS = np.zeros((0, 0))
"""The array of nodes of a run that keeps none."""


class CompiledRun:
    """One run, whose fields are read and set by name: run["t"]. Runs at the same time must not share it."""

    def __init__(self, block: Ints, pointers: Ints):
        """block: its cells, which become the run's own memory. pointers: indices of the cells that hold the
        address of a vector in the block; in `block` they are distances from its start [bytes].
        """
        self.cells, self.pointers = block, pointers
        self.address = int(self.cells.ctypes.data)
        self.cells[pointers] += self.address
        self.numbers = self.cells.view(np.float64)
        self.nx = int(self["nx"])
        at = self.place("x0")
        self.x = self.numbers[at : at + self.nx]
        """State (nx,), as a view."""
        self.nodes = NO_ROWS

    @property
    def block(self) -> Ints:
        """A copy of the cells that does not depend on where they lie: addresses are distances from the start of
        the block [bytes], as `__init__` takes them.
        """
        block = self.cells.copy()
        block[self.pointers] -= self.address
        return block

    def place(self, name: str) -> int:
        """Index of the cell with the first number of the vector `name`."""
        return (int(self.cells[PLACES[name]]) - self.address) // 8

    def __getitem__(self, name: str) -> float:
        """The field `name` of `record.Run`: a number, or the address of a vector."""
        where: Any = self.numbers if KINDS[name] == "float" else self.cells
        return where[PLACES[name]].item()

    def __setitem__(self, name: str, value: float) -> None:
        """Set the field `name`: a number, or the address of a vector."""
        # the same memory, read as floats or as whole numbers
        where = self.numbers if KINDS[name] == "float" else self.cells
        where[PLACES[name]] = value

    def copy(self) -> CompiledRun:
        """A copy of the run as it is now, with its nodes, that shares no memory with it."""
        run, count = CompiledRun(self.block, self.pointers), int(self["count"])
        run._keep_in(np.empty_like(self.nodes))
        run.nodes[:count] = self.nodes[:count]
        return run

    def filled(self, tables: Mapping[str, Array]) -> CompiledRun:
        """A copy of a plan with other numbers in these vectors, by name, each of the size that it has in the
        plan."""
        run = CompiledRun(self.block, self.pointers)
        for name, table in tables.items():
            at = run.place(name)
            run.numbers[at : at + table.size] = table.ravel()
        return run

    def start(self, x: Array, t: float, step: int, t_start: float, t_end: float) -> CompiledRun:
        """A run of this plan, not moved yet, from x (nx,) at t [s] to t_end [s] at the latest; it begins in the
        single support with the number `step`, which began at t_start [s].
        """
        run = CompiledRun(self.block, self.pointers)
        run["t"] = run["t_arc"] = t
        # fired -1: no event has ended an arc before
        run["step"], run["t_start"], run["t_end"], run["fired"] = step, t_start, t_end, -1
        run["last"] = t_end
        run.x[:] = x
        return run

    def keep(self, longest: float, arcs: int = 1, look: int = 0) -> None:
        """Take memory for nodes, so that the run keeps them: for so many arcs, none longer than `longest` [s].

        look: address of a function that computes signals (`StepReading`); each row then has time, step, force
        from outside and these signals (`NodeRow`). 0: rows are (t, x, x'). Rows that are never written cost no
        memory, so their number is estimated from above.
        """
        # an arc has stretches between sample instants, switching times and its ends; each stores its start, and
        # its last step may be short; a step longer than RESOLUTION has nodes inside. With `part`, the time
        # after a sample instant at which a waiting torque acts, each period has two breaks
        h, T, clocks = self["h"], self["period"], 1 + (self["part"] > 0.0)
        time = longest + T + h  # longest arc [s], with room for a sample instant and a step more
        stretches = 2 + self["n_switches"] + (clocks * (1.0 + time / T) if T > 0.0 else 0.0)
        rows = 1 + (time / h + 2.0 * stretches) * math.ceil(h / RESOLUTION)
        width = node_layout(int(self["n"]), int(self["p"])).size if look else 1 + 2 * self.nx
        self["look"], self["width"] = look, width
        self._keep_in(np.empty((arcs * math.ceil(rows), width)))

    def _keep_in(self, nodes: Array) -> None:
        """Set the array to which the run writes its nodes; room: how many nodes fit."""
        self.nodes, self["nodes"], self["room"] = nodes, nodes.ctypes.data, len(nodes)

    def rows(self) -> Array:
        """The nodes kept since the last call, rows (t, x, x'), or those of signals where `keep` got a function:
        a view, to be copied before the run goes on.
        """
        # count 0: the run overwrites them from the first row on
        count, self["count"] = int(self["count"]), 0
        return self.nodes[:count]

    def stride(self) -> Status:
        """Move the run over the impacts for which `strikes` took memory, or until t_end (TIME_OUT) or a
        failure; returns how it ended.
        """
        return STATUS[kernels().stride(self.address)]

    def strikes(self, impacts: int) -> Array:
        """Take memory for so many impacts, and return it: rows (t, x-, x+), of which the first `struck` are
        written when the run has been moved."""
        strikes = np.zeros((impacts, 1 + 2 * self.nx))
        # the owner of the run keeps the array; the run has its address alone
        self["strikes"], self["most"], self["struck"] = strikes.ctypes.data, impacts, 0
        return strikes


def plan(tables: Mapping[str, Array], fields: Mapping[str, float]) -> CompiledRun:
    """Lay out a plan, a run that has not begun, in memory. tables, fields: vectors and numbers by their names
    in `record.Run`; fields left out are 0.
    """
    # width: of all work vectors, at least the longest inputs (t, step, t_start, x, zeta, force); slow: numbers
    # in w of (w, E)
    n, nx, p, k = (int(fields[name]) for name in ("n", "nx", "p", "k"))
    width, slow = 3 + nx + max(n, 2) + OUTSIDE, nx - k * p
    # guards: a walker has three event functions; nN: of N_E only row 1 is stored, since the others are zero
    values = {**fields, "guards": 3, "n_slow": slow, "nN": slow + p, "levels": len(tables["phi"])}
    values |= {f"n_{name}": len(tables[name]) for name in ("drops", "switches", "parts")}
    values |= {f"n_{name}": tables[name].size for name in ("K", "push")}
    # ends: first cell of each vector, then the number of all cells; places: cells of addresses, where they lead
    ends, places = _places(tuple(tables[name].size for name in TABLES), width)
    cells = np.zeros(ends[-1], dtype=np.int64)
    numbers = cells.view(np.float64)
    for name, start, end in zip(TABLES, ends, ends[1:], strict=False):
        numbers[start:end] = tables[name].ravel()
    for name, value in values.items():
        (numbers if KINDS[name] == "float" else cells)[PLACES[name]] = value
    # addresses as distances from the start of the block [bytes]
    cells[places[0]] = 8 * places[1]
    return CompiledRun(cells, places[0])


@lru_cache(maxsize=64)
def _places(sizes: tuple[int, ...], width: int) -> tuple[list[int], Ints]:
    """Where the vectors of a block lie: the first index of each vector in TABLES and ROWS, and the number of
    all cells; and (2, ..), of each vector the cell with its address and its first index.

    sizes: of the vectors in TABLES. width: of all those in ROWS.
    """
    ends = [*accumulate((len(KINDS), *sizes, *[width] * len(ROWS)))]
    places = dict(zip((*TABLES, *ROWS), ends, strict=False))
    # both are addresses inside K and `push`, which `engine.samples` sets; they are in this list, since a copy
    # of the block corrects the addresses in it alone
    places |= {"torque": places["K"], "force": places["push"]}
    return ends, np.array([[PLACES[name] for name in places], [*places.values()]])
