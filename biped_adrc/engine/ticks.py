"""Sampled control in plain Python on the compiled plant: the controller is called once per tick.

Between ticks the plant is (q, q', u) with the torque held, or (q, q', u_m, u) where the motors lag; it moves by
itself in compiled code, disturbance and events included.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray

from biped_adrc.closed_loop.semantics import asked
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.control.base import Measurement
from biped_adrc.engine.compiled_biped import parts_of, pointer_call
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.controller_inputs import Point, Told
from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.layout import COMPLETED, END
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.run import arc
from biped_adrc.engine.kernels.tables import STATUS
from biped_adrc.errors import NotFiniteError, SingularError
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.hardware.sample_hold import HeldSizes
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.integrators import OneStepMethod, StepFailed
from biped_adrc.hybrid.simulator import Record, RunOptions
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import Clock, Found, HybridSystem, Mover
from biped_adrc.hybrid.trajectory import Event, Trajectory
from biped_adrc.model.reduction import Reduction
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array

TERMINAL = {Status.FELL: "hip_too_low", Status.STALLED: "step_too_long"}
"""The guards that end a run, by status."""
BLOCK = 256
"""Ticks of which the measurements lie in one array."""
ROOM = 1024
"""Nodes of an arc to make room for at first."""


def run_ticks(
    walker: Walker,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    options: RunOptions,
    points: Sequence[Point] = (),
) -> Trajectory:
    """A run of a walker with compiled dynamics, whose controller has references with the laws `points`.

    Raises NotCompiled for a disturbance or method without laws.
    """
    plant = CompiledWalker.held(walker, method)
    assert walker.held is not None
    sizes = walker.held.sizes
    system: HybridSystem = Ticked(walker, plant, flowing(sizes, len(x0)))
    if sizes.total == sizes.p and not sizes.rate:
        told = Told(walker.nominal, points[0] if points else None)
        system = Bare(walker, plant, told, options.t0)
    return simulator.run(system, x0, mode, method, options)


LOST = {
    Status.NOT_FINITE: NotFiniteError,
    Status.SINGULAR: SingularError,
    Status.STEP_FAILED: StepFailed,
}
"""What is raised for these statuses."""


def ended(walker: Walker, code: int, t: float, x: Array, mode: Mode) -> Found | None:
    """The event behind a code of the kernels, None for none. Raises one of LOST, or what the jump raises."""
    if code == COMPLETED:
        return None
    if code == layout.STRUCK:
        outcome = walker.struck(t, x, mode)
        return Found(Event(FOOT_STRIKE, t, x, outcome[0]), outcome)
    status = STATUS[code]
    if status in LOST:
        raise LOST[status](f"the plant's motion ends after t = {t:.6g} s: {status.name}")
    return Found(Event(TERMINAL[status], t, x, None), None, status)


def start(
    plant: CompiledWalker, x: Array, t: float, mode: Mode, end: float, fired: str | None, every: int
) -> Array:
    """The vector s of a held plant's run over one arc."""
    s = plant.plan.start(x, t, mode.step, mode.start, end)
    s[layout.FIRED] = -1.0 if fired is None else layout.FOOT_STRIKE
    s[layout.EVERY] = every
    return s


# -- with hardware ---------------------------------------------------------------------------------
def flowing(sizes: HeldSizes, length: int) -> NDArray[np.int_]:
    """Where in a state of `length` numbers what flows between ticks is: q, q', with lag u_m, and u."""
    motors = length - sizes.p * (sizes.waiting + 2)
    lagging = range(motors, motors + sizes.p) if sizes.lag else ()
    return np.array([*range(2 * sizes.n), *lagging, *range(length - sizes.p, length)])


def whole(x: Array, at: NDArray[np.int_], rows: Array) -> Array:
    """x with other numbers at these places, in as many rows as there are."""
    out = np.tile(x, (*rows.shape[:-1], 1)) if rows.ndim > 1 else x.copy()
    out[..., at] = rows
    return out


@dataclass(frozen=True)
class Ticked(HybridSystem):
    """The walker's own ticks, hardware and meter included, on the held plant."""

    walker: Walker
    plant: CompiledWalker
    flowing: NDArray[np.int_]

    def clocks(self) -> tuple[Clock, ...]:
        return self.walker.clocks()

    def mover(self, fired: str | None) -> Mover:
        return Between(self, fired)


class Between:
    """Moves `Ticked` from one of its ticks to the next."""

    def __init__(self, system: Ticked, fired: str | None):
        self.system, self.fired = system, fired
        self.s: Array | None = None

    def __call__(
        self, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, Found | None]:
        plant, at = self.system.plant, self.system.flowing
        if self.s is None:
            self.s = start(plant, x[at], t, mode, until, self.fired, record.every)
        self.s[layout.HEAD :], self.s[END] = x[at], until
        found = arc(plant.plan, plant.K, self.s, record.every, room=16)
        self.s = found.s
        record.add(found.t.copy(), whole(x, at, found.x), whole(0.0 * x, at, found.dx))
        t, x = float(self.s[layout.TIME]), whole(x, at, self.s[layout.HEAD :])
        return t, x, ended(self.system.walker, found.code, t, x, mode)


# -- without hardware ------------------------------------------------------------------------------
_TERMS, _POINT = partial(tuple.__new__, Reduction), partial(tuple.__new__, ReferencePoint)
_MEASUREMENT = partial(tuple.__new__, Measurement)
_HOLD = ctypes.PYFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)


@dataclass(frozen=True)
class Bare(HybridSystem):
    """x = (q, q', s, u): ticks and motion in one, since a tick costs little more than the controller itself.

    The call that moves the plant to a tick leaves what the controller is given there in a block of memory.
    """

    walker: Walker
    plant: CompiledWalker
    told: Told
    t_first: float

    def mover(self, fired: str | None) -> Mover:
        return partial(self.move, fired)

    def move(
        self, fired: str | None, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, Found | None]:
        """Over all ticks of an arc, as `system.Mover`."""
        n, end = self.walker.plant.n, len(x) - self.walker.plant.p
        held = np.concatenate((x[: 2 * n], x[end:]))
        s = start(self.plant, held, t, mode, until, fired, record.every)
        seen, states, ends = Seen(self.plant, self.told, s), [x[2 * n : end]], [0]
        try:
            code = self.ticks(seen, t, mode, until, states, ends)
        finally:
            self.keep(seen.kept, states, ends, record)
        x = s[layout.HEAD :]
        t, x = float(s[layout.TIME]), np.concatenate((x[: 2 * n], states[-1], x[2 * n :]))
        return t, x, ended(self.walker, code, t, x, mode)

    def ticks(
        self,
        seen: Seen,
        t: float,
        mode: Mode,
        until: float,
        states: list[Array],
        ends: list[int],
    ) -> int:
        """Tick, move, tick, to an event or to `until`; a code. After every tick s goes into `states`.

        ends: how many nodes there were at each tick.
        """
        walker, law, time = self.walker, self.walker.law, self.walker.timing
        assert isinstance(time, SampledTime)
        origin, period, s = t if time.restart else self.t_first, time.period, states[0]
        body = walker.nominal.body_terms if law.needs_body else None
        run, size = seen.s, len(s)
        torque = run[layout.HEAD + 2 * walker.plant.n :]
        count = max(0, math.floor((t - origin) / period))
        while origin + count * period < t:
            count += 1
        told, (step, began) = self.told.point or Unasked(), mode
        due = origin + count * period
        hold, at, output, saturate = seen.hold, seen.at, law.output, walker.saturate
        for q, v, terms, point, following in seen:
            told.now = q, v, point
            if t == due:
                B = None if body is None else body(q, v)
                m = _MEASUREMENT((t, step, t - began, q, v, terms, B))
                count += 1
                due = origin + count * period
                if not size:
                    torque[:] = saturate(output(s, m))
                else:
                    s, u = asked(walker, s, m)
                    torque[:] = u
                    s = law.predict(s, m, u)
                    states.append(s)
                    ends.append(int(run[layout.COUNT]))
            run[END] = t = due if due < until else until
            code = hold(at, following)
            while code == layout.FULL:
                seen.grow(2 * len(seen.rows))
                code = hold(at, following)
            if code != COMPLETED or t >= until:
                return code
        raise AssertionError

    def keep(self, nodes: Array, states: list[Array], ends: list[int], record: Record) -> None:
        """The nodes, with the state of the controller at each of them."""
        n, nx = self.walker.plant.n, self.plant.plan.nx
        s = np.zeros((len(nodes), 0))
        if len(states[0]):
            s = np.repeat(np.array(states), np.diff([*ends, len(nodes)]), axis=0)
        x, dx = nodes[:, 1 : 1 + nx], nodes[:, 1 + nx :]
        parts = (x[:, : 2 * n], s, x[:, 2 * n :]), (dx[:, : 2 * n], 0.0 * s, dx[:, 2 * n :])
        if len(nodes):
            record.add(nodes[:, 0].copy(), *(np.hstack(part) for part in parts))


@dataclass
class Unasked:
    """In place of a reference that there is none of."""

    now: Any = None


class Seen:
    """(q, v, terms, point) at one tick after the other, all read only, and where `hold` writes the next.

    hold(at, following) takes the plant on; a code.
    """

    def __init__(self, plant: CompiledWalker, told: Told, s: Array):
        self.plan, self.K, self.work, self.s = plant.plan, plant.K, plant.plan.work(), s
        self.told, self.n = told, told.robot.structure.n
        self.shapes = [(), (self.n,), (self.n,), *told.shapes]
        self.width = sum(map(math.prod, self.shapes))
        self.hold = _HOLD(kernels().ADDRESSES["hold"])
        self.given = np.zeros(8, dtype=np.int64)
        self.rows = np.empty((0, 1 + 2 * self.plan.nx))
        self.grow(ROOM)
        self.at = self.given.ctypes.data

    def grow(self, rows: int) -> None:
        """Room for so many nodes; those that there are stay."""
        more = np.empty((rows, self.rows.shape[1]))
        more[: len(self.rows)] = self.rows
        self.rows, self.s[layout.ROOM] = more, rows
        arrays = (self.plan.P, self.plan.F, self.K, self.work, self.s, self.rows)
        addresses = [array.ctypes.data for array in arrays]
        self.given[:] = *addresses, self.told.address, self.told.K.ctypes.data

    @property
    def kept(self) -> Array:
        """The nodes so far."""
        return self.rows[: int(self.s[layout.COUNT])]

    def __iter__(self) -> Iterator[Any]:
        last = np.empty((1, self.width))
        last[0, 0] = self.s[layout.TIME]
        last[0, 1 : 1 + 2 * self.n] = self.s[layout.HEAD : layout.HEAD + 2 * self.n]
        pointer_call(self.told.machine, "told", self.told.K, last, last[:, 1 + 2 * self.n :])
        while True:
            block = np.empty((BLOCK + 1, self.width))
            block[0], first, row = last[0], block.ctypes.data, 8 * self.width
            block.flags.writeable = False
            _, q, v, *rest = parts_of(block[:-1], self.shapes)
            terms = map(_TERMS, zip(*rest[:7], strict=True))
            points = map(_POINT, zip(*rest[7:], strict=True)) if rest[7:] else repeat(None)
            following = range(first + row, first + len(block) * row, row)
            yield from zip(q, v, terms, points, following, strict=False)
            last = block[-1:]
