"""Walks that are moved on by one sample at a time, N side by side, each under inputs of its own.

A learner, a search or a controller of another program gives torque and force before each sample and reads the
states after it:

    stepper = ba.Stepper(ba.Scenario("NPD", period=1e-3), count=2)
    sample = stepper.reset()
    begin = stepper.save(0)
    while sample.t[0] < 0.1:
        sample = stepper.step(force=[[0.0, 0.0], [-20.0, 0.0]])
    print(sample.x[:, 4], sample.status)                 # pitch of the trunk, with and without the force
    stepper.restore(1, begin)                            # walk 1 goes back to the start of walk 0

Without inputs each walk is that of `ba.walk_scenario`. Walks whose parts all compile are moved in one call of
machine code; the others one by one (`engine.samples`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.engine.compiled_signals import Reading
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.record import Ints
from biped_adrc.engine.kernels.run_plan import STATUS
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.samples import CompiledWalk, Driven, PythonWalk
from biped_adrc.errors import InputError, check_count, check_whole
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.parts import check_part, numbers
from biped_adrc.scenario.build import RobotAndGait, build, soft_loop
from biped_adrc.scenario.build import start as start_of
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import check_start, default_method
from biped_adrc.shown import Shown
from biped_adrc.types import Array, freeze, frozen

_STATUS = np.array([*STATUS, None], dtype=object)
"""By code; the last one is for a walk that has not begun, code -1."""


@dataclass(frozen=True)
class Sample(Shown):
    """N walks, each at its last sample instant, or at its end; all arrays are read-only."""

    rows: Array
    """t [s], number of the single support, and state of each (N, 2 + nx)."""
    codes: Ints
    """Of the statuses (N,), 0 for a walk that goes on."""

    def __post_init__(self) -> None:
        freeze(self, "rows", "codes")

    @property
    def t(self) -> Array:
        """Times of the walks (N,) [s]."""
        return self.rows[:, 0]

    @property
    def step(self) -> Ints:
        """Numbers of the single supports (N,)."""
        return frozen(self.rows[:, 1].astype(np.int64))

    @property
    def x(self) -> Array:
        """States (N, nx): q, q', then what controller and hardware keep; before the sample instant there."""
        return self.rows[:, 2:]

    @property
    def status(self) -> NDArray[np.object_]:
        """`Status` of each (N,): COMPLETED for a walk that goes on, None for one that has not begun."""
        return frozen(_STATUS[self.codes])


class Snapshot(NamedTuple):
    """A walk and where it is, for `Stepper.restore`."""

    walk: CompiledWalk | PythonWalk
    code: int


class Stepper:
    """`count` walks of a scenario, or of a walker, in sampled time.

    walker_of(scenario, robot and gait): the walker in place of `scenario.build`. Raises InputError for
    continuous time, a scenario with `fine`, a robot without motors, and parts that do not fit together.
    """

    def __init__(
        self,
        what: Scenario | Walker,
        count: int = 1,
        walker_of: Callable[[Scenario, RobotAndGait], Walker] = build,
    ):
        check_part(what, "what is moved by samples", Scenario, Walker)
        check_count(count, f"the number of walks is {count}")
        self.what, self.walker_of = what, walker_of
        sampled = what.sampled if isinstance(what, Walker) else what.period is not None
        if not sampled:
            raise InputError(
                "a stepper goes from one sample instant to the next, and there are none; give a period, as "
                "period = 0.001 in a scenario, or timing=SampledTime(1e-3) of a walker"
            )
        if isinstance(what, Scenario):
            if what.fine is not None:
                raise InputError(
                    f"steps of a sample have one length; leave out fine = {what.fine:g} s"
                )
            self.scene = RobotAndGait.of(what)
            self.p = self.scene.biped.p
            self.reference: Reference | None = self.scene.walked.constraint
        else:
            self.p, self.reference = what.plant.p, None
        self.why = ""
        """Why walks are not moved in machine code; empty where they are."""
        self.walks: list[CompiledWalk | PythonWalk | None] = [None] * count
        self.addresses = np.zeros((count, kernels().WALK), dtype=np.int64)
        self.codes = np.full(count, -1, dtype=np.int64)
        self.rows = np.zeros((count, 0))
        self._views = dict[Reading, tuple[Ints, int]]()
        """By function that `read` has had: addresses of its machine code for each walk (N,), and its width."""
        self._codes = dict[tuple[Reading, int], LoadedCode]()
        """By function and address of the walk's own code, with which it changes."""

    @property
    def sample(self) -> Sample:
        """Where the walks are."""
        return Sample(self.rows.copy(), self.codes.copy())

    def reset(
        self,
        i: int | None = None,
        seed: int | None = None,
        start: tuple[Array, Array] | None = None,
    ) -> Sample:
        """Walk i anew, or all of them.

        seed: of the scenario; where all begin, walk i has seed + i. None is the scenario's own, for each.
        start: (q, v), each (n,) [rad, rad/s]; None is the scenario's. A walker has no seed, and needs a start.
        """
        if i is None:
            for k in range(len(self.walks)):
                self._begin(k, None if seed is None else seed + k, start)
        else:
            self._begin(self._checked(i), seed, start)
        return self.sample

    def step(self, torque: ArrayLike | None = None, force: ArrayLike | None = None) -> Sample:
        """One sample of every walk that goes on.

        torque (N, p) [N m]: added to what the controller asks for. force (N, 2) [N]: (F_x, F_z) on the origin
        of the trunk. One row is for all walks, None is zero. Raises InputError for other shapes, for what is
        not finite, and before all walks have begun.
        """
        if np.any(self.codes < 0):
            raise InputError("there is a walk that has not begun; call reset() first")
        given = np.empty((len(self.walks), self.p + 2))
        given[:, : self.p] = self._inputs("torque", torque, self.p)
        given[:, self.p :] = self._inputs("force", force, 2)
        in_python = np.flatnonzero((self.addresses[:, 0] == 0) & (self.codes == 0))
        kernels().samples(self.addresses.ravel(), given, self.rows, self.codes)
        for i in in_python:
            walk = self.walks[i]
            assert isinstance(walk, PythonWalk)
            walk, status = walk.sample(given[i, : self.p], given[i, self.p :])
            self.walks[i], self.rows[i], self.codes[i] = walk, walk.row, STATUS.index(status)
        return self.sample

    def save(self, i: int = 0) -> Snapshot:
        """Walk i as it is, with all that it is made of. Raises InputError for a walk that has not begun."""
        walk = self.walks[self._checked(i)]
        if walk is None:
            raise InputError(f"walk {i} has not begun; call reset({i}) first")
        return Snapshot(walk.copied(), int(self.codes[i]))

    def restore(self, i: int, snapshot: Snapshot) -> None:
        """Walk i goes on from where a walk, this or another one, was saved."""
        self._put(self._checked(i), snapshot.walk.copied(), snapshot.code)

    def read(self, view: Reading) -> Array:
        """What view(loop, t, x, mode, reference) says of each walk where it is, as `signals_at`, in N rows.

        The reference is the scenario's gait. Raises InputError for a walker, and where no walk has begun.
        """
        N, begun = len(self.walks), next((walk for walk in self.walks if walk is not None), None)
        if self.reference is None or begun is None:
            raise InputError("there is no gait to refer to, or no walk; call reset() of a scenario")
        if view not in self._views:
            width = len(begun.read(view, self.reference))
            self._views[view] = np.zeros(N, dtype=np.int64), width
        laws, width = self._views[view]
        found = np.zeros((N, width))
        for i in np.flatnonzero(laws == 0):
            walk = self.walks[i]
            if isinstance(walk, CompiledWalk):
                laws[i] = self._law(view, walk, self.reference)
            elif walk is not None:
                found[i] = walk.read(view, self.reference)
        kernels().looks(self.addresses.ravel(), laws, found)
        return found

    def _law(self, view: Reading, walk: CompiledWalk, reference: Reference) -> int:
        """Address of the machine code of `view` for a walk."""
        key = view, walk.made.program.address("tick")
        if key not in self._codes:
            self._codes[key] = walk.code(view, reference)
        return self._codes[key].addresses["read"]

    def _begin(self, i: int, seed: int | None, start: tuple[Array, Array] | None) -> None:
        """Walk i as `reset` has it."""
        what, mode, loop = self.what, Mode(), None
        if isinstance(what, Scenario):
            s = what if seed is None else replace(what, seed=seed)
            driven, mode = Driven.of(self.walker_of(s, self.scene)), Mode(s.first_step)
            method, loop = method_of(s, driven.walker), soft_loop(s, driven.walker)
            start = start_of(s, self.scene) if start is None else start
        elif start is None or seed is not None:
            raise InputError(
                "a walker has no seed and no start of its own; call reset(start=gait.start(biped))"
            )
        else:
            driven = Driven.of(what)
            method = default_method(driven.walker)
        check_start(*start, driven.walker)
        self._put(i, self._walk(driven, loop, method, start, mode), 0)

    def _walk(
        self,
        driven: Driven,
        loop: SteppingLoop | None,
        method: OneStepMethod,
        start: tuple[Array, Array],
        mode: Mode,
    ) -> CompiledWalk | PythonWalk:
        """A walk at its start, in machine code where that can be; what cannot is not tried again."""
        if loop is not None:
            self.why = "the plant moves by itself"
        if not self.why:
            try:
                return CompiledWalk.of(driven, method, start, mode, self.reference)
            except NotCompiled as reason:
                self.why = str(reason)
        return PythonWalk.of(driven, loop, method, start, mode)

    def _put(self, i: int, walk: CompiledWalk | PythonWalk, code: int) -> None:
        """A walk in place i. Raises InputError for a state of another size than the others have."""
        row = walk.row
        if len(row) != self.rows.shape[1]:
            if np.any(self.codes >= 0):
                raise InputError(
                    f"the walk has {len(row) - 2} numbers in its state, and the others have "
                    f"{self.rows.shape[1] - 2}; expected a walk of this stepper"
                )
            self.rows = np.zeros((len(self.walks), len(row)))
        self.walks[i], self.rows[i], self.codes[i] = walk, row, code
        self.addresses[i] = walk.addresses if isinstance(walk, CompiledWalk) else 0
        for laws, _ in self._views.values():
            laws[i] = 0

    def _checked(self, i: int) -> int:
        """The number of a walk. Raises InputError for one that there is not."""
        check_whole(i, f"the walk is {i}")
        if i >= len(self.walks):
            raise InputError(f"there is no walk {i}, expected 0 to {len(self.walks) - 1}")
        return i

    def _inputs(self, name: str, values: ArrayLike | None, size: int) -> Array:
        """Inputs as floats, (size,) or (N, size). Raises InputError."""
        if values is None:
            return np.zeros(size)
        x, N = numbers(values, f"the {name}"), len(self.walks)
        if x.shape not in ((size,), (N, size)) or not np.all(np.isfinite(x)):
            raise InputError(
                f"the {name} is {x}, expected finite numbers, {size} for each of {N} walks, or one row for all"
            )
        return x
