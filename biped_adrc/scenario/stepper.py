"""Walks that are moved on by one sample at a time, N side by side, each under inputs of its own.

A learner, a search or a controller of another program gives torque and force before each sample and reads the
states after it:

    stepper = ba.Stepper(ba.Scenario("NPD", hardware="ideal"), count=2)
    sample = stepper.reset()
    begin = stepper.save(0)
    while sample.t[0] < 0.1:
        sample = stepper.step(force=[[0.0, 0.0], [-20.0, 0.0]])
    print(sample.x[:, 4], sample.status[1].name)  # pitch of the trunk without and with the force
    stepper.restore(1, begin)                     # walk 1 goes back to the start of walk 0

Without inputs each walk is that of `ba.walk_scenario`. Walks whose parts all compile are moved in one call of
machine code; the others one by one (`engine.samples`).

A sample is the motion from one sample instant to the next one, or to the end of the walk; it ends at an impact
if the clock restarts there. To judge a single support is to compare the ground forces and torques that it needs
with limits (`analysis.certificate`). A kernel is a function of the engine's machine code, which gets arrays as
addresses in memory. q, v (n,) [rad, rad/s] are coordinates and rates, the first p of them of joints with
motors; x (nx,) is the state of a walk, (q, v, controller, hardware); a mode is a single support, its number
from 1 and the time at which it began. A node is an instant whose signals are stored.
"""

import math
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from biped_adrc.analysis.certificate import Support, supports
from biped_adrc.analysis.ground_force import Nodes
from biped_adrc.closed_loop.other_plant import as_walked
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.checks import check_part, numbers
from biped_adrc.core.errors import InputError, check_count
from biped_adrc.core.shown import short, shown
from biped_adrc.core.types import Array, frozen
from biped_adrc.engine.kernels.compiled_run import STATUS
from biped_adrc.engine.kernels.record import Ints
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.numbers import Reading
from biped_adrc.engine.program import COMPILED
from biped_adrc.engine.samples import CompiledWalk, PythonWalk, SampledWalks, with_inputs
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.ground import Limits
from biped_adrc.scenario.build import RobotAndGait, build, soft_loop
from biped_adrc.scenario.integration import check_start, default_method, methods_of
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.scenario import Scenario

_STATUS = np.array([*STATUS, None], dtype=object)
"""Status of a walk by its code; the last one is for a walk that has not begun, with the code -1."""


@shown
class Sample(NamedTuple):
    """N walks, each at its last sample instant, or at its end; all arrays are read-only."""

    t: Array
    """Times (N,) [s] since the start of each walk."""
    x: Array
    """States (N, nx) just before the sample instant acts: q, q', then the states of controller and hardware."""
    step: Ints
    """Numbers of the single supports (N,)."""
    status: NDArray[np.object_]
    """`Status` (N,): COMPLETED for a walk that goes on, None for one that has not begun."""


Start = tuple[Array, Array]
"""(q, v), each (n,) [rad, rad/s], at the start of a walk."""
Snapshot = tuple[Walker, CompiledWalk | PythonWalk, int]
"""A walk as `Stepper.save` found it: its walker, the walk, and the code of its status."""


class Stepper:
    """`count` walks of a scenario, or of a walker, in sampled time.

    what: a scenario or a walker, in sampled time. count: number of walks. within: limits by which the single
    supports of a scenario are judged when they end, for `over`. Raises InputError for continuous time, a
    scenario with `run.fine`, a robot without motors, and parts that do not fit together.

    >>> stepper = ba.Stepper(ba.Scenario("NPD", hardware={"period": 1e-3}), count=2)
    >>> stepper.reset(seed=1).t
    array([0., 0.])
    >>> stepper.step(np.zeros((2, 4))).t
    array([0.001, 0.001])
    """

    def __init__(self, what: Scenario | Walker, count: int = 1, within: Limits | None = None):
        check_part(what, "what is moved by samples", Scenario, Walker)
        check_count(count, f"the number of walks is {count}")
        check_part(within, "within", Limits, type(None))
        self.what = what
        self.within = within if isinstance(what, Scenario) else None
        self.curve: Reference | None = None
        """The curve of the scenario's gait, from which errors are measured; None for a walker."""
        # read as: (period is None) of a scenario, (not sampled) of a walker
        if what.hardware.period is None if isinstance(what, Scenario) else not what.sampled:
            raise InputError("no sample instants; give hardware.period or timing=SampledTime(1e-3)")
        if isinstance(what, Scenario):
            if what.run.fine is not None:
                raise InputError(f"steps have one length; leave out run.fine = {what.run.fine:g} s")
            self.scene = RobotAndGait.of(what)
            self.curve = self.scene.walked.constraint
        p = what.plant.p if isinstance(what, Walker) else self.scene.biped.p
        self.walks = SampledWalks(count, p)
        self.walkers: list[Walker | None] = [None] * count
        """Walkers of the walks, with inputs for torque and force."""
        self.why = ""
        """Why walks that begin are not moved in machine code; empty where they are."""
        self.over: list[tuple[int, Support]] = []
        """Single supports that ended in the last sample, each with the number of its walk; empty without
        `within`."""

    def __repr__(self) -> str:
        return f"Stepper({len(self.walkers)} walks of {short(self.what)})"

    @property
    def sample(self) -> Sample:
        """Time, number of the single support, state and status of each walk now; the arrays are copies."""
        # columns of a row: time, number of the single support, state x; _STATUS: the status of each code
        rows, codes = self.walks.rows.copy(), self.walks.codes
        return frozen(Sample(rows[:, 0], rows[:, 2:], rows[:, 1].astype(np.int64), _STATUS[codes]))

    def reset(
        self, i: int | None = None, seed: int | None = None, start: Start | None = None
    ) -> Sample:
        """Begin walk i anew, or all walks if i is None.

        seed: of the scenario; where all begin, walk i has seed + i. None is the scenario's own, for each.
        start: (q, v), each (n,) [rad, rad/s]; None is the scenario's. A walker has no seed, and needs a start.
        """
        if i is None:
            for k in range(len(self.walkers)):
                self._begin(k, None if seed is None else seed + k, start)
        else:
            self._begin(i, seed, start)
        return self.sample

    def _begin(self, i: int, seed: int | None, start: Start | None) -> None:
        """Begin walk i, with seed and start as in `reset`: None takes the scenario's own.

        It becomes a `CompiledWalk`, or a `PythonWalk` where its plant moves by itself or one of its parts has
        no machine code; from then on this stepper tries to compile no walk that begins (`why`), as all walks
        have the same parts.
        """
        walk: CompiledWalk | PythonWalk | None = None
        if not self.why:
            walker, loop, method, x, mode = self._start(seed, start)
            # curve: the gait, from which errors are read; of the compiled walk the nodes are kept (last
            # argument) only if single supports are to be judged
            judged = self.within is not None
            try:
                if loop is not walker:
                    raise NotCompiled("the plant moves by itself")
                walk = CompiledWalk.of(walker, method, x, mode, self.curve, judged)
            except NotCompiled as reason:
                self.why = str(reason)
        if walk is None:
            # torque and force that a sample in Python reads
            outside = np.zeros(self.walks.inputs.shape[1])
            walker, loop, method, x, mode = self._start(seed, start, outside)
            walk = PythonWalk.of(loop, outside, method, x, mode)
        self.walkers[i] = walker
        self.walks.put(i, walk, 0)  # 0 is the code of a walk that goes on

    def _start(
        self, seed: int | None, start: Start | None, outside: Array | None = None
    ) -> tuple[Walker, ClosedLoop[Any], OneStepMethod, Array, Mode]:
        """Build a walk, with seed and start as in `reset`: its walker, the closed loop that moves, the method
        of integration, the state x (nx,) and the single support at the start.

        outside (p + 2,): torque and force of the walk, overwritten before each sample; None for machine code.
        """
        s, mode = self.what, Mode()
        if isinstance(s, Scenario):
            mode = Mode(s.run.first_step)
            if seed is not None:  # only the seed changes, so nothing else is checked again
                s = s.model_copy(update={"run": s.run.replace(seed=seed)})
            walker = with_inputs(build(s, self.scene), outside)
            start = self.scene.start(s) if start is None else start
            loop, method = soft_loop(s, walker) or walker, methods_of(s.run, walker)[0]
        elif start is None or seed is not None:
            raise InputError("a walker has no seed or start; call reset(start=gait.start(biped))")
        else:
            walker = with_inputs(s, outside)
            loop, method = walker, default_method(walker)
        check_start(*start, walker)
        x = loop.initial_state(*start, mode)
        if loop is walker:
            walker.check_foot(*start, mode)
        return walker, loop, method, x, mode

    def step(self, torque: ArrayLike | None = None, force: ArrayLike | None = None) -> Sample:
        """One sample of every walk that goes on.

        torque (N, p) [N m]: added to what the controller asks for. force (N, 2) [N]: (F_x, F_z) on the origin
        of the trunk. None is zero. Raises InputError for other shapes, for what is not finite, and before all
        walks have begun.
        """
        if self.walks.codes.min() < 0:
            raise InputError("there is a walk that has not begun; call reset() first")
        # a row of inputs (p + 2,) has the torques, then the force
        torques, forces = self.walks.inputs[:, :-2], self.walks.inputs[:, -2:]
        torques[:] = 0.0 if torque is None else finite_numbers("torque", torque, torques.shape)
        forces[:] = 0.0 if force is None else finite_numbers("force", force, forces.shape)
        self.move()
        return self.sample

    def move(self) -> None:
        """Move the walks that go on by one sample as `step` does, without its checks; renews `over`, a list of
        (number of a walk, judgement of a single support of it that ended in this sample).
        """
        # compiled: whether a single support ended in machine code; in_python: (walk, loop, arc) of other ends
        compiled, in_python = self.walks.move()
        self.over = self._judged() if compiled and self.within is not None else []
        self.over += [(i, self._needed(i, loop, arc)) for i, loop, arc in in_python if self.within]

    def _judged(self) -> list[tuple[int, Support]]:
        """Judge the single supports that ended in the last sample of compiled walks, by an impact or with the
        walk; returns each with the number of its walk.
        """
        result, within = list[tuple[int, Support]](), cast(Limits, self.within)
        for i, walk, impacts, ended in self.walks.struck():
            walker, plant = walk.compiled.walker, walk.compiled.walker.plant
            # impacts: those of this walk in the sample; ended: whether it has ended
            # the nodes since the last single support that was judged; n.steps are the numbers of the single
            # supports in them, n.edges the index of the first node of each
            n = Nodes(walk.run.rows(), plant.n, plant.p)
            q, v = walk.run.x[: plant.n], walk.run.x[plant.n : 2 * plant.n]
            # right after an impact there is no node of the next single support: the state gives the momentum
            after = plant.momentum(q, v) if len(n.steps) == impacts else None
            judged = supports(walker, n, within.of(plant.description), impacts, after)
            # of a walk that goes on, the single supports with an impact; of one that ended, the last one too
            result += [(i, s) for s in judged[: None if ended else impacts]]
            # the nodes of the single support that goes on are kept, those of finished ones are dropped
            on = n.rows[n.edges[impacts] :]
            walk.run.nodes[: len(on)], walk.run["count"] = on, len(on)
        return result

    def _needed(self, i: int, loop: ClosedLoop[Any], arc: Arc) -> Support:
        """Judge one single support of walk i, moved in Python by `loop`; `arc` has all its nodes."""
        # the status, COMPLETED, says nothing here; with this engine in its settings signals are computed in
        # machine code where that is possible
        run = Trajectory((arc,), Status.COMPLETED, settings={"engine": COMPILED})
        # states of a plant that moves by itself are brought into the layout of a walker's
        run = as_walked(loop, run) if isinstance(loop, SteppingLoop) else run
        walk = Walk(cast(Walker, self.walkers[i]), self.scene.walked, run)
        # the run has one arc, so one single support
        return walk.feasible_within(cast(Limits, self.within)).supports[0]

    def save(self, i: int = 0) -> Snapshot:
        """A copy of walk i (from 0) as it is now, for `restore`. Raises InputError before it has begun."""
        walk, walker = self.walks.all[i], self.walkers[i]
        if walk is None or walker is None:
            raise InputError(f"walk {i} has not begun; call reset({i}) first")
        return walker, walk.copy(), int(self.walks.codes[i])

    def restore(self, i: int, snapshot: Snapshot) -> None:
        """Let walk i go on from where a walk, this or another one, was saved.

        Raises InputError for a walk with another number of states, and, if this stepper judges its walks
        (`within`), for one that was saved by a stepper that does not.
        """
        walker, walk, code = snapshot
        # at[2]: the state; a row has time and number of the single support before it
        size, expected = len(walk.at[2]), self.walks.rows.shape[1] - 2
        if self.walks.rows.size and size != expected:
            raise InputError(f"the walk has {size} states, expected {expected}")
        if self.within and isinstance(walk, CompiledWalk) and not walk.run.nodes.size:
            raise InputError("the walk was saved without `within`, and here walks are judged")
        self.walkers[i] = walker
        self.walks.put(i, walk.copy(), code)

    def read(self, view: Reading) -> Array:
        """The numbers that the function view(loop, t, x, mode, reference), such as `signals_at`, returns for
        each of N walks at its present instant, its arrays one after the other: an array (N, size).

        The reference is the curve of the scenario's gait; the row of a walk that has not begun is 0. Raises
        InputError for a stepper of a walker, and if no walk has begun.
        """
        if self.curve is None or not self.walks.rows.size:
            raise InputError("there is no gait to refer to, or no walk; call reset() of a scenario")
        return self.walks.read(view, self.curve)


def finite_numbers(what: str, values: ArrayLike, shape: tuple[int, ...]) -> Array:
    """Values as an array of floats. Raises InputError for another shape, and for numbers that are not finite.

    what: name of the values, for messages.
    """
    x = numbers(values, f"the {what}")
    if x.shape != shape:
        raise InputError(f"the {what} has shape {x.shape}, expected {shape}")
    flat = x.ravel()
    # the product is fast; it may overflow for finite numbers, so these are looked at one by one
    if not math.isfinite(flat.dot(flat)) and not np.isfinite(x).all():
        raise InputError(f"the {what} is {x}, expected finite numbers")
    return x
