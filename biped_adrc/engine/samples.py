"""A walk that is moved on sample by sample, under a torque and a force from outside.

    u = u_c + torque,    zeta = zeta_w + J(q)' force

    u, u_c         torque on the p actuated joints, and the part that the walker's own controller asks for [N m]
    zeta, zeta_w   disturbance on the n coordinates, and the part from the walker's own disturbance [N m]
    torque         torque from outside (p,) [N m] (`control.around`)
    force          force from outside (2,) [N] on the origin of the trunk, whose Jacobian is J (2, n) [m]

A sample goes from one sample instant to the next; where an impact restarts the clock, it ends there. An arc is
the flow between two events, a node a stored instant (t, x, x') of it. A `Reading` is a function that reads
arrays, such as signals, off a closed loop at one instant.

A `CompiledWalk` is a walk in machine code, and the compiled function `samples` (`engine.kernels.lanes`), called
the kernel, moves many of them in one call. A `PythonWalk` is moved by `hybrid.simulator.flow_arc`, which
integrates one arc: a controller in Python on the compiled plant, or a plant of its own.
"""

import math
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self, cast

import numpy as np

from biped_adrc.closed_loop.instant_signals import step_reading
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.around import AddedTorque
from biped_adrc.core.checks import handing_out
from biped_adrc.core.errors import RaisedError
from biped_adrc.core.part import once
from biped_adrc.core.tree import flatten
from biped_adrc.core.types import Array, read_only
from biped_adrc.disturbances.force import AddedForce
from biped_adrc.engine.kernels.compiled_run import STATUS, CompiledRun
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.record import Ints
from biped_adrc.engine.lanes import SIDE_BY_SIDE, Lanes, Team
from biped_adrc.engine.numbers import Reading
from biped_adrc.engine.on_plant import CompiledLoop
from biped_adrc.engine.program import CompiledWalker, Program
from biped_adrc.engine.run import compiled_plant
from biped_adrc.engine.structure import floats
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.constants import next_tick
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import RunOptions, finite_part, flow_arc
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Event
from biped_adrc.model.planar import link_point

At = tuple[ClosedLoop[Any], float, Array, Mode]
"""Arguments of a `Reading`: the loop, the time [s] that a walk has reached, the state (nx,) there before the
sample instant, and the single support."""


_trunk = once(lambda biped: link_point(biped, biped.description.trunk))
"""The origin of a robot's trunk as a `LinkPoint`; computed once for each robot."""
_unmoved = once(lambda controller, p: AddedTorque(controller, read_only(np.zeros(p))))
"""A controller under no torque from outside."""
_unpushed = once(lambda plant: AddedForce(read_only(np.zeros(2)), _trunk(plant)))
"""No force on the trunk of a robot."""


def with_inputs(walker: Walker, outside: Array | None = None) -> Walker:
    """The walker under a torque [N m] and a force [N] from outside: views of `outside` (p + 2,), which its
    owner overwrites before a sample that runs in Python.

    None: read-only zeros, for machine code, which has its inputs elsewhere. Such walkers share their parts, and
    what is computed once for these.
    """
    plant, p = walker.plant, walker.plant.p
    if outside is None:
        law, force = _unmoved(walker.controller, p), _unpushed(plant)
    else:
        law = AddedTorque(walker.controller, outside[:p])
        force = AddedForce(outside[p:], _trunk(plant))
    push = force if walker.disturbance is None else walker.disturbance + force
    return replace(walker, controller=law, disturbance=push)


def torque_place(program: Program) -> int:
    """Index in K (`Program.K`) at which the torque from outside (p,) begins, for a walker of `with_inputs`.

    It is the last field of the controller, and so has the last p of the controller's numbers.
    """
    numbers = program.numbers
    return program.first + len(floats(numbers.controller)) - numbers.plant.p


@dataclass(frozen=True)
class CompiledWalk:
    """One walk in machine code."""

    compiled: CompiledWalker
    """Its walker and code; walks may share it."""
    run: CompiledRun
    """The walk's present state in memory, moved on by the kernel `samples`. Its nodes are those of the present
    single support, rows as in `engine.batch.BatchWalk.table`; it keeps none where no verdict is asked for."""

    @classmethod
    def of(
        cls,
        walker: Walker,
        method: OneStepMethod,
        x: Array,
        mode: Mode,
        curve: Reference | None,
        judged: bool,
    ) -> Self:
        """Make the walk of a walker of `with_inputs` that starts at x (nx,) in the single support `mode`.

        curve: reference from which errors are measured; None for none. judged: whether nodes are kept, for the
        verdicts on ground and motors, which need a curve. Raises NotCompiled for a part without machine code.
        """
        compiled = CompiledWalker.of(walker, method, walker.layout_of(x), mode.start, curve)
        # the kernel sets t_end to the end of each sample, and the walk has no end of its own
        run = compiled.plan.start(x, mode.start, *mode, math.inf)
        if judged and curve is not None:
            look = compiled.program.reading(step_reading).addresses["reading"]
            run.keep(walker.max_step_time, 1, look)  # the nodes of one arc
        assert walker.disturbance is not None
        # addresses (8 bytes a number) where the kernel writes torque and force. The last term of the
        # disturbance is the `AddedForce`: the kernel counts it among the terms only while it is not zero
        run["torque"] = run["K"] + 8 * torque_place(compiled.program)
        run["force"] = run["push"] + 8 * len(floats(walker.disturbance.terms[:-1]))
        # pulled: whether a term besides it has a force from outside, so that nodes need that force
        run["pulled"] = any(term.pulls for term in walker.disturbance.terms[:-1])
        run["n_parts"] -= 1
        return cls(compiled, run)

    @property
    def at(self) -> At:
        """Walker, time [s], state (nx,) and mode of the walk now; the state is a view, which the next sample
        overwrites.
        """
        run = self.run
        return self.compiled.walker, run["t"], run.x, Mode(int(run["step"]), run["t_start"])

    def copy(self) -> Self:
        """The same walk in memory of its own."""
        return replace(self, run=self.run.copy())


@dataclass(frozen=True)
class PythonWalk:
    """One walk in Python, moved on by `flow_arc`, with the plant in machine code where that is possible.

    A clock without restart has its sample instants at multiples of the period from 0 s on.
    """

    loop: ClosedLoop[Any]
    method: OneStepMethod
    """Method of integration; not used by a plant that moves by itself."""
    places: tuple[tuple[Array, slice], ...]
    """The arrays from which the walk's parts read their inputs, each with the slice of (torque, force) (p + 2,)
    that belongs there."""
    t: float
    """Time that the walk has reached [s]."""
    x: Array
    """State (nx,) before the sample instant at t."""
    mode: Mode
    """Single support at t."""
    fired: Event | None = None
    """The event that ended the arc before at t; None where the walk goes on in the middle of an arc."""
    arcs: tuple[Arc, ...] = ()
    """Arcs of the present single support so far."""

    @classmethod
    def of(
        cls, loop: ClosedLoop[Any], outside: Array, method: OneStepMethod, x: Array, mode: Mode
    ) -> Self:
        """Make the walk that starts at x (nx,) in the single support `mode`.

        loop: a walker of `with_inputs`, or the `SteppingLoop` of such a walker around another plant. outside
        (p + 2,): the array of torque and force of `with_inputs`.
        """
        # places: (array to be written, which of the p + 2 inputs go there); all of them into `outside`
        p, places = loop.plant.p, [(outside, slice(None))]
        if isinstance(loop, Walker):
            loop, _ = compiled_plant(loop)  # without the list of its compiled references
        elif isinstance(loop, CompiledLoop):
            loop, _ = loop.prepared(x)  # without the settings that say what was compiled
            # machine code reads its numbers from vectors K, so the inputs are written there too
            if loop.program is not None:
                at = torque_place(loop.program)
                places.append((loop.program.K[at : at + p], slice(p)))
            if loop.pushes is not None:  # K of the last term, `AddedForce`, begins with its force
                places.append((loop.pushes[-1].K[:2], slice(p, None)))
        return cls(loop, method, tuple(places), mode.start, x, mode)

    @property
    def at(self) -> At:
        """Loop, time [s], state and mode of the walk now."""
        return self.loop, self.t, self.x, self.mode

    def copy(self) -> Self:
        """The walk itself: it never changes, since `sample` returns another one."""
        return self

    def sample(self, inputs: Array) -> tuple[Self, Status, list[Arc]]:
        """Move on by one sample: return the walk at its next sample instant, with the status COMPLETED, or at
        its end, with another status; and one arc for each single support that ended on the way.

        inputs (p + 2,): torque [N m] and force [N], constant over the sample. Raises RaisedError where a class
        of the user's raises.
        """
        for place, part in self.places:
            place[:] = inputs[part]
        # over: arcs of the single supports that ended. The loop goes round again after an impact before `until`
        # with a clock that goes on: the rest of the sample is walked in the next single support
        walk, over, timing = self, list[Arc](), self.loop.clock
        while True:
            start = walk.mode.start if timing.restart else 0.0
            until = next_tick(walk.t, start, timing.period)
            # the last one is the start of the arc, from which a clock that restarts counts; any other counts
            # from 0 s, the start in `RunOptions`
            at = (walk.t, walk.x, walk.mode, walk.fired, walk.mode.start)
            # `handing_out` turns an exception of the user's code into a RaisedError with its class and line;
            # NumPy does not warn of an overflow, which ends the walk: `finite_part` cuts what is not finite
            with handing_out(), np.errstate(over="ignore", invalid="ignore"):
                flown = finite_part(flow_arc(self.loop, self.method, RunOptions(until, 0.0), *at))
            if flown.status is Status.RAISED:
                raise RaisedError(flown.detail)
            event, arcs = flown.arc.event, (*walk.arcs, flown.arc)
            if event is not None or flown.status is not Status.COMPLETED:
                over.append(_joined(arcs))
                arcs = ()
            # no state after an event: the sample is complete, or the walk has ended, as the status says
            if flown.outcome is None or event is None:
                t, x = float(flown.arc.t[-1]), flown.arc.x[-1].copy()
                return replace(walk, t=t, x=x, fired=None, arcs=arcs), flown.status, over
            t, (x, mode) = event.t, flown.outcome
            walk = replace(walk, t=t, x=x, mode=mode, fired=event, arcs=arcs)
            # an impact: with a clock that restarts, or exactly at `until`, it is itself a sample instant
            if timing.restart or t >= until:
                return walk, flown.status, over


def _joined(arcs: Sequence[Arc]) -> Arc:
    """Join arcs of one single support, which follow one another, into one arc."""
    # an arc that failed at its first node has no readings; with it the columns would differ in length
    kept = [arc for arc in arcs if arc.read] or arcs
    t, x, dx = (np.concatenate([getattr(arc, name) for arc in kept]) for name in ("t", "x", "dx"))
    read = {name: np.concatenate([arc.read[name] for arc in kept]) for name in kept[0].read}
    return Arc(arcs[0].mode, t, x, dx, arcs[-1].event, read)


def python_row(walk: CompiledWalk | PythonWalk, view: Reading, curve: Reference) -> Array:
    """Evaluate the `Reading` `view` at a walk's present state in Python; returns its arrays joined in one row.

    Tracking errors in it are relative to the reference `curve`, whatever the controller tracks.
    """
    # the reference of a `Reading` is a function of the controller's state s, not used here, and measurement m
    return flatten(view(*walk.at, lambda s, m: curve(m.t, m.q, m.v)))


class SampledWalks:
    """N walks side by side, moved on by one sample: those in machine code in one call, the others one by one.

    p: number of motors. The kernels read and write the arrays of this class at their addresses.
    """

    def __init__(self, count: int, p: int):
        self.all: list[CompiledWalk | PythonWalk | None] = [None] * count
        """Each walk in its present state; None before it has begun."""
        self.inputs = np.zeros((count, p + 2))
        """Torque (p,) [N m] and force (2,) [N] from outside in the next sample."""
        self.rows = np.zeros((count, 0))
        """A row for each walk: t [s], number of the single support, x."""
        self.codes = np.full(count, -1, dtype=np.int64)
        """Places in `STATUS`: 0 for a walk that goes on, -1 for one that has not begun."""
        self._impacts = np.zeros(count, dtype=np.int64)
        """Impacts of each walk in the last sample; -1 for a walk that machine code did not move."""
        self._addresses = np.zeros(count, dtype=np.int64)
        """Address of each compiled walk in memory; 0 for a walk that machine code does not move."""
        self._laws = dict[Reading, tuple[Ints, Array]]()
        """For each function that was read: addresses of its machine code (N,), and its results (N, size)."""
        self._kernels = kernels()
        self._arguments: tuple[int, ...] = ()
        """Of the kernel `samples`, from the first walk on."""
        self._key: Hashable = None
        """What walks that go side by side have in common (`Lanes.key`); None for none."""
        self._teams = list[Team]()
        """Teams in whose lanes compiled walks sit, one after the other; empty where none go side by side."""
        self._addresses_of_teams = np.zeros(1, dtype=np.int64)
        """How many lanes each team has, and the addresses of teams."""

    def put(self, i: int, walk: CompiledWalk | PythonWalk, code: int) -> None:
        """Put a walk, with the code of its status (a place in `STATUS`), into place i."""
        _, t, x, mode = walk.at  # its loop, time [s], state and single support
        if not self.rows.size:  # the first walk says how many numbers x has
            self.rows = np.zeros((len(self.all), 2 + len(x)))
        self.rows[i] = (t, mode.step, *x)
        self.all[i], self.codes[i] = walk, code
        self._addresses[i] = walk.run.address if isinstance(walk, CompiledWalk) else 0
        self._sit(i, walk)
        arrays = (self._addresses, self.inputs, self.rows, self.codes, self._impacts)
        at, *others = (x.ctypes.data for x in (*arrays, self._addresses_of_teams))
        self._arguments = at, len(self.all), self.rows.shape[1], *others
        # the functions that were read have other machine code for another walk
        for view, (laws, _) in self._laws.items():
            laws[i] = self._law(i, view)

    def _sit(self, i: int, walk: CompiledWalk | PythonWalk) -> None:
        """Put walk i into its lane, if it may go side by side with the first one that may."""
        key: Hashable = None
        if len(self.all) >= SIDE_BY_SIDE and isinstance(walk, CompiledWalk):
            key = Lanes.key(walk.compiled, bool(walk.run["look"]))
            if key is not None and not self._teams:
                self._begin_teams(walk, key)
        if self._teams:
            team, lane = divmod(i, len(self._teams[0].ready))
            self._teams[team].ready[lane] = key is not None and key == self._key

    def _begin_teams(self, walk: CompiledWalk, key: Hashable) -> None:
        """Make teams for walks like this one."""
        lanes, run, self._key = Lanes.of(walk.compiled, bool(walk.run["look"])), walk.run, key
        self._teams = [lanes.team(run) for _ in range(0, len(self.all), lanes.lanes)]
        for team in self._teams:
            # the places of torque and force in K and `push`, which have so many numbers for one here
            for name, vector in (("torque", "K"), ("force", "push")):
                team.run[name] = team.run[vector] + lanes.lanes * (run[name] - run[vector])
        addresses = (team.run.address for team in self._teams)
        self._addresses_of_teams = np.array([lanes.lanes, *addresses])

    def _in_python(self) -> Iterator[tuple[int, PythonWalk]]:
        """Iterate over the walks that are moved in Python, with their numbers."""
        # `all` is quick where each has an address in memory, as most often
        places = () if self._addresses.all() else np.flatnonzero(self._addresses == 0).tolist()
        for i in places:
            if self.codes[i] >= 0:
                yield i, cast(PythonWalk, self.all[i])

    def move(self) -> tuple[bool, list[tuple[int, ClosedLoop[Any], Arc]]]:
        """Move the walks that go on by one sample under `inputs`; `rows` and `codes` are then theirs.

        Returns whether a single support ended in machine code (`struck` says which), and of those that ended in
        Python the number of the walk, its loop and the arc.
        """
        ends = self._kernels.samples(*self._arguments)
        over = list[tuple[int, ClosedLoop[Any], Arc]]()
        for i, walk in self._in_python():
            if self.codes[i] == 0:  # the walk goes on; below 0 it has not begun, above it has ended
                after, status, arcs = walk.sample(self.inputs[i])
                self.put(i, after, STATUS.index(status))
                over += [(i, walk.loop, arc) for arc in arcs]
        return ends > 0, over

    def struck(self) -> Iterator[tuple[int, CompiledWalk, int, bool]]:
        """Iterate over the compiled walks whose single support ended in the last sample: number of the walk,
        the walk, its impacts in this sample, and whether it has ended.
        """
        # -1 impacts are of walks that machine code did not move
        struck = (self._impacts > 0) | ((self._impacts == 0) & (self.codes != 0))
        for i in np.flatnonzero(struck).tolist():
            walk = cast(CompiledWalk, self.all[i])
            yield i, walk, int(self._impacts[i]), bool(self.codes[i] != 0)

    def read(self, view: Reading, curve: Reference) -> Array:
        """What view(loop, t, x, mode, reference) returns for each walk now, its arrays one after the other: an
        array (N, size). The row of a walk that has not begun is 0.

        curve: the reference.
        """
        if view not in self._laws:
            # one row is computed in Python for its size
            first = next(walk for walk in self.all if walk is not None)
            laws = np.array([self._law(i, view) for i in range(len(self.all))], dtype=np.int64)
            self._laws[view] = laws, np.zeros((len(laws), len(python_row(first, view, curve))))
        laws, result = self._laws[view]
        for i, walk in self._in_python():
            result[i] = python_row(walk, view, curve)
        walks, *at = (x.ctypes.data for x in (self._addresses, laws, result))
        self._kernels.looks(walks, len(laws), result.shape[1], *at)
        return result.copy()

    def _law(self, i: int, view: Reading) -> int:
        """Address of the machine code of the function `view` for walk i, which the kernel `looks` calls; 0
        where machine code does not move the walk.
        """
        if not isinstance(walk := self.all[i], CompiledWalk):
            return 0
        return walk.compiled.program.reading(view).addresses["reading"]
