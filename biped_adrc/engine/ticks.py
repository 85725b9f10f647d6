"""Sampled control in Python on the compiled plant: the controller is called once per sample instant.

Between sample instants the plant is (q, q', u) with the torque held, or (q, q', u_m, u) where the
motors lag; it moves by itself in compiled code, disturbance and events included. There are two
systems for `hybrid.simulator`:

- `TicksWithHardware`, with sensors or delays, runs the walker's own sample instants of
  `closed_loop.semantics`, one call of a kernel between two of them;
- `TicksWithoutHardware` does a whole arc in one loop. One compiled call moves the plant, computes
  the model's terms and the reference at the next sample instant, and leaves them where Python reads
  them, so that a sample instant costs little more than the controller itself.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import repeat
from types import SimpleNamespace

import numpy as np

from biped_adrc.closed_loop.semantics import asked
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.control.base import Measurement
from biped_adrc.engine.compiled_biped import parts_of, pointer_call
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.controller_inputs import CompiledReference, ControllerInputs
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.record import PLACES
from biped_adrc.engine.kernels.run import arc
from biped_adrc.engine.kernels.run_plan import STATUS, CompiledRun
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.hardware.sample_hold import HeldSizes
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.constants import COMPLETED, FULL, STRUCK
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.on_arrays import next_tick
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import Clock, FoundEvent, HybridSystem, Mover
from biped_adrc.hybrid.trajectory import Event, Record, Trajectory
from biped_adrc.model.reduction import Reduction
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array, Indices, frozen

TERMINAL = {Status.FELL: "hip_too_low", Status.STALLED: "step_too_long"}
"""Names of the event functions that end a run, by status."""
BLOCK = 256
"""Sample instants whose inputs lie in one array."""
ROOM = 1024
"""Nodes of an arc to make room for at first."""


def run_ticks(
    walker: Walker,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    options: RunOptions,
    points: Sequence[CompiledReference] = (),
) -> Trajectory:
    """A run from x0 (nx,) of a walker with compiled dynamics whose controller runs in Python.

    points: the controller's references, compiled. The faster way is taken where nothing but
    the torque is held between sample instants. Raises NotCompiled for a disturbance or method
    that cannot be compiled.
    """
    plant = CompiledWalker.held(walker, method)
    assert walker.held is not None
    sizes = walker.held.sizes
    system: HybridSystem = TicksWithHardware(walker, plant, flowing(sizes, len(x0)))
    if sizes.total == sizes.p and not sizes.rate and walker.sensors is None:
        inputs = ControllerInputs(walker.nominal, points[0] if points else None)
        system = TicksWithoutHardware(walker, plant, inputs, options.t0)
    return simulator.run(system, x0, mode, method, options)


def ended(walker: Walker, code: int, t: float, x: Array, mode: Mode) -> FoundEvent | None:
    """The event behind a code of the kernels at t [s], x (nx,); None for COMPLETED.

    An impact is carried out here, by the walker itself. Raises one of `simulator.FAILURES` where
    the plant's motion was lost, or what the controller's jump raises.
    """
    if code == COMPLETED:
        return None
    if code == STRUCK:
        outcome = walker.struck(t, x, mode)
        return FoundEvent(Event(FOOT_STRIKE, t, x, outcome[0]), outcome)
    status = STATUS[code]
    if status in simulator.FAILURES:
        raise simulator.FAILURES[status](
            f"the plant's motion ends after t = {t:.6g} s: {status.name}"
        )
    return FoundEvent(Event(TERMINAL[status], t, x, None), None, status)


# -- with hardware ---------------------------------------------------------------------------------
def flowing(sizes: HeldSizes, length: int) -> Indices:
    """Where in a state of `length` numbers the held plant is: places of q, q', with lag u_m, and u."""
    motors = length - sizes.p * (sizes.waiting + 2)
    lagging = range(motors, motors + sizes.p) if sizes.lag else ()
    return np.array([*range(2 * sizes.n), *lagging, *range(length - sizes.p, length)])


def whole(x: Array, at: Indices, rows: Array) -> Array:
    """x (nx,) with other numbers at these places, in as many rows as there are: (nx,) or (N, nx).

    What does not move between sample instants is the same in every row.
    """
    out = np.tile(x, (*rows.shape[:-1], 1)) if rows.ndim > 1 else x.copy()
    out[..., at] = rows
    return out


@dataclass(frozen=True)
class TicksWithHardware(HybridSystem):
    """The walker's own sample instants, hardware included, on the held plant."""

    walker: Walker
    """With compiled dynamics."""
    plant: CompiledWalker
    """The plant under a held torque."""
    flowing: Indices
    """Its places in a state of the walker."""

    def clocks(self) -> tuple[Clock, ...]:
        return self.walker.clocks()

    def mover(self, fired: str | None) -> Mover:
        return HeldMotion(self, fired)


class HeldMotion:
    """Moves `TicksWithHardware` from one of its sample instants to the next, over one arc.

    run: the plant's, made at the first call and carried on, so that an event function keeps its value across a
    sample instant, where the plant's q does not jump.
    """

    def __init__(self, system: TicksWithHardware, fired: str | None):
        self.system, self.fired = system, fired
        self.run: CompiledRun | None = None

    def __call__(
        self, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, FoundEvent | None]:
        """From (t, x) to `until` [s] or the first event, as `hybrid.system.Mover`."""
        plan, at, run = self.system.plant.plan, self.system.flowing, self.run
        if run is None:
            fired = self.fired is not None
            run = self.run = plan.start(x[at], t, mode.step, mode.start, until, fired)
        run.x[:], run["t_end"] = x[at], until
        nodes = arc(run, record.every, room=16)
        record.add(nodes.t.copy(), whole(x, at, nodes.x), whole(0.0 * x, at, nodes.dx))
        t, x = run["t"], whole(x, at, run.x)
        return t, x, ended(self.system.walker, nodes.code, t, x, mode)


# -- without hardware ------------------------------------------------------------------------------
_TERMS, _POINT = partial(tuple.__new__, Reduction), partial(tuple.__new__, ReferencePoint)
_MEASUREMENT = partial(tuple.__new__, Measurement)
_HOLD = ctypes.PYFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p)


@dataclass(frozen=True)
class TicksWithoutHardware(HybridSystem):
    """x = (q, q', s, u): sample instants and motion in one loop, since one costs little more than
    the controller itself.

    The call that moves the plant to a sample instant leaves what the controller is given there in a
    block of memory.
    """

    walker: Walker
    """With compiled dynamics and references."""
    plant: CompiledWalker
    """The plant under a held torque."""
    inputs: ControllerInputs
    """What the controller is given, compiled."""
    t_first: float
    """Start of the run [s]."""

    def mover(self, fired: str | None) -> Mover:
        return partial(self.move, fired)

    def move(
        self, fired: str | None, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, FoundEvent | None]:
        """Over all sample instants of an arc, from x (nx,) at t [s], as `hybrid.system.Mover`.

        Nodes are recorded even where the controller raises.
        """
        n, end = self.walker.plant.n, len(x) - self.walker.plant.p
        held = np.concatenate((x[: 2 * n], x[end:]))
        run = self.plant.plan.start(held, t, mode.step, mode.start, until, fired is not None)
        run["every"] = record.every
        seen, states, ends = TickInputs(run, self.inputs), [x[2 * n : end]], [0]
        try:
            code = self.ticks(seen, t, mode, until, states, ends)
        finally:
            self.keep(seen.kept, states, ends, record)
        t, x = run["t"], np.concatenate((run.x[: 2 * n], states[-1], run.x[2 * n :]))
        return t, x, ended(self.walker, code, t, x, mode)

    def ticks(
        self,
        seen: TickInputs,
        t: float,
        mode: Mode,
        until: float,
        states: list[Array],
        ends: list[int],
    ) -> int:
        """Sample, move, sample, to an event or to `until` [s]; a code of the kernels.

        After every sample instant the controller's state (size,) goes into `states`, and into
        `ends` how many nodes there were. The loop is written out, without calls that could be
        saved: it runs once per sample instant.
        """
        walker, law, time = self.walker, self.walker.law, self.walker.timing
        assert isinstance(time, SampledTime)
        origin, period, s = t if time.restart else self.t_first, time.period, states[0]
        body = walker.nominal.body_terms if law.needs_body else None
        run, size, t_end = seen.run, len(s), PLACES["t_end"]
        torque, numbers = run.x[2 * walker.plant.n :], run.numbers
        reference, (step, began) = self.inputs.point or SimpleNamespace(), mode
        due = next_tick(math.nextafter(t, -math.inf), origin, period)
        hold, at, output = seen.hold, seen.at, law.output
        saturate, bounded = walker.saturate, walker.bounded
        predict, s = walker.calls.predict, frozen(s)

        def measured(t: float, mode: Mode, q: Array, v: Array) -> Measurement:
            return walker.measure(t, q, v, mode)

        for q, v, terms, point, following in seen:
            reference.now = q, v, point
            if t == due:
                B = None if body is None else body(q, v)
                elsewhere = partial(measured, t, mode)
                m = _MEASUREMENT((t, step, t - began, q, v, terms, B, elsewhere))
                due = next_tick(t, origin, period)
                if not size:
                    torque[:] = bounded(saturate(output(s, m)))
                else:
                    s, u = asked(walker, s, m)
                    torque[:] = u
                    s = predict(s, m, u)
                    states.append(s)
                    ends.append(int(run["count"]))
            numbers[t_end] = t = due if due < until else until
            code = hold(at, following)
            while code == FULL:
                seen.grow(2 * len(seen.rows))
                code = hold(at, following)
            if code != COMPLETED or t >= until:
                return code
        raise AssertionError

    def keep(self, nodes: Array, states: list[Array], ends: list[int], record: Record) -> None:
        """Record the nodes (N, 1 + 2 nx), with the controller's state at each of them.

        The state changes at sample instants alone, so it is repeated from one to the next; its
        slope is zero.
        """
        n, nx = self.walker.plant.n, self.plant.plan.nx
        s = np.zeros((len(nodes), 0))
        if len(states[0]):
            s = np.repeat(np.array(states), np.diff([*ends, len(nodes)]), axis=0)
        x, dx = nodes[:, 1 : 1 + nx], nodes[:, 1 + nx :]
        parts = (x[:, : 2 * n], s, x[:, 2 * n :]), (dx[:, : 2 * n], 0.0 * s, dx[:, 2 * n :])
        if len(nodes):
            record.add(nodes[:, 0].copy(), *(np.hstack(part) for part in parts))


TickInput = tuple[Array, Array, Reduction, ReferencePoint | None, int]
"""q, v, terms of the model and reference at a sample instant; and the address where the next ones go."""


class TickInputs:
    """What the controller is given at one sample instant after the other, all arrays read-only.

    hold(at, following) moves the plant on, writes the next inputs at the address `following`, and
    returns a code; `at` is the address of the addresses that the kernel reads.
    """

    def __init__(self, run: CompiledRun, inputs: ControllerInputs):
        """run: of the plant; inputs: the compiled function behind it."""
        self.run, self.inputs, self.n = run, inputs, inputs.robot.structure.n
        self.shapes = [(), (self.n,), (self.n,), *inputs.shapes]
        self.width = sum(map(math.prod, self.shapes))
        self.hold = _HOLD(kernels().ADDRESSES["hold"])
        addresses = run.address, inputs.address, inputs.K.ctypes.data
        self.addresses = np.array(addresses, dtype=np.int64)
        self.at = self.addresses.ctypes.data
        self.rows = np.empty((0, 1 + 2 * run.nx))
        self.grow(ROOM)

    def grow(self, rows: int) -> None:
        """Make room for so many nodes; those that there are stay."""
        more = np.empty((rows, self.rows.shape[1]))
        more[: len(self.rows)] = self.rows
        self.rows = more
        self.run.set_nodes(more)

    @property
    def kept(self) -> Array:
        """The nodes so far (N, 1 + 2 nx): t [s], x, x'."""
        return self.rows[: int(self.run["count"])]

    def __iter__(self) -> Iterator[TickInput]:
        """Inputs at one sample instant after the other, views into blocks of BLOCK rows.

        The first row is computed here; every other one is filled by the call of `hold` before. A
        new block is made each time, since controllers may keep what they were given.
        """
        last = np.empty((1, self.width))
        last[0, 0] = self.run["t"]
        last[0, 1 : 1 + 2 * self.n] = self.run.x[: 2 * self.n]
        pointer_call(self.inputs.machine, "inputs", self.inputs.K, last, last[:, 1 + 2 * self.n :])
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
