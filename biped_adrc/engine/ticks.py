"""Sampled control in plain Python on the compiled plant: the controller is called once per tick.

Between ticks the plant is (q, q', u) with the torque held, or (q, q', u_m, u) where the motors lag; the rest
of x, the controller's own state first, is kept here and goes back into the states of the trajectory.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from biped_adrc.control.base import Measurement
from biped_adrc.engine.compiled_biped import CompiledBiped
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.tables import STATUS
from biped_adrc.errors import NotFiniteError, SingularError
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Mode, Walker

Update = Callable[[float, Array, Mode], Array]
"""Of a clock: x+ at (t, x, mode)."""
Act = Callable[[Update, float, Array, Array, Mode], tuple[Array, Array]]
TERMINAL = {Status.FELL: "hip_too_low", Status.STALLED: "step_too_long"}
"""The guards that end a run, by status."""


class _Nodes:
    """Of one arc, tick by tick: rows (t, x, x') of the plant, and the rest of the state, which is held."""

    def __init__(self) -> None:
        self.rows: list[Array] = []
        self.states: list[Array] = []

    def add(self, rows: Array, kept: Array) -> None:
        """Nodes between two ticks."""
        self.rows.append(rows)
        self.states.append(kept)

    def arc(self, mode: Mode, event: Event | None, places: Places) -> Arc:
        """All of them, with whole states."""
        rows = np.vstack(self.rows)
        kept = np.repeat(np.array(self.states), [len(part) for part in self.rows], axis=0)
        nx = (rows.shape[1] - 1) // 2
        x = places.whole(rows[:, 1 : 1 + nx], kept)
        dx = places.whole(rows[:, 1 + nx :], np.zeros_like(kept))
        return Arc(mode, rows[:, 0].copy(), x, dx, event)


@dataclass(frozen=True)
class Places:
    """Where in x what flows between ticks is, and where the rest."""

    flowing: NDArray[np.int_]
    kept: NDArray[np.int_]

    @classmethod
    def of(cls, walker: Walker, length: int) -> Places:
        """For states of `length` numbers."""
        assert walker.held is not None
        sizes, n = walker.held.sizes, walker.plant.n
        motors = length - sizes.p * (sizes.waiting + 2) if sizes.lag else length
        parts = (range(2 * n), range(motors, min(motors + sizes.p, length)))
        flowing = np.array([*parts[0], *parts[1], *range(length - sizes.p, length)])
        return cls(flowing, np.setdiff1d(np.arange(length), flowing))

    def whole(self, flowing: Array, kept: Array) -> Array:
        """x, or rows of them."""
        x = np.empty((*kept.shape[:-1], len(self.flowing) + len(self.kept)))
        x[..., self.flowing], x[..., self.kept] = flowing, kept
        return x


@dataclass(frozen=True)
class TickByTick:
    """`walker` has compiled dynamics, `plant` is what flows between its ticks."""

    walker: Walker
    plant: CompiledWalker
    every: int

    @classmethod
    def of(cls, walker: Walker, method: OneStepMethod, every: int) -> TickByTick:
        """Raises NotCompiled for a disturbance or method without a compiled form."""
        return cls(walker, CompiledWalker.held(walker, method), every)

    def run(
        self,
        x0: Array,
        mode: Mode,
        t0: float,
        t_end: float,
        impacts: int | None,
        label: str,
        progress: Progress | None,
    ) -> Trajectory:
        """Arcs until enough impacts, the end or a terminal status."""
        places = Places.of(self.walker, len(x0))
        s = x0[places.kept]
        vector = self.plant.plan.start(x0[places.flowing], t0, mode.step, mode.start, t_end)
        arcs: list[Arc] = []
        status, detail = Status.COMPLETED, ""
        while True:
            nodes = _Nodes()
            try:
                with np.errstate(over="ignore", invalid="ignore"):  # ends as the status NOT_FINITE
                    code, vector, s = self._arc(vector, s, places, mode, t0, t_end, nodes)
                    t, x = float(vector[layout.TIME]), places.whole(vector[layout.HEAD :], s)
                    struck = self.walker.struck(t, x, mode) if code == layout.STRUCK else None
                status = Status.COMPLETED if struck is not None else STATUS[code]
            except (NotFiniteError, SingularError) as error:
                struck, detail = None, str(error)
                singular = isinstance(error, SingularError)
                status = Status.SINGULAR if singular else Status.NOT_FINITE
                if not nodes.rows:
                    nodes.add(_single(vector), s)
            if struck is None:
                guard = TERMINAL.get(status)
                arcs.append(
                    nodes.arc(mode, None if guard is None else Event(guard, t, x, None), places)
                )
                break
            after, next_mode = struck
            arcs.append(nodes.arc(mode, Event(FOOT_STRIKE, t, x, after), places))
            mode, s = next_mode, after[places.kept]
            vector = self._after(vector, after[places.flowing], mode)
            if progress is not None:
                progress(t, len(arcs))
            if impacts is not None and len(arcs) >= impacts:
                return Trajectory(tuple(arcs), Status.COMPLETED, "", {"method": label})
            if t >= t_end:
                break
        if status is Status.COMPLETED and impacts is not None:
            status = Status.TIME_OUT
        return Trajectory(tuple(arcs), status, detail, {"method": label})

    def _arc(
        self,
        vector: Array,
        s: Array,
        places: Places,
        mode: Mode,
        t_first: float,
        t_end: float,
        nodes: _Nodes,
    ) -> tuple[int, Array, Array]:
        """Tick, flow, tick, to the first event or the end."""
        time = self.walker.timing
        assert isinstance(time, SampledTime)
        plan, K = self.plant.plan, self.plant.K
        origin = float(vector[layout.TIME]) if time.restart else t_first
        head, arc, act = layout.HEAD, kernels().arc, self._actor(places)
        clocks = [(origin + clock.offset, clock.update) for clock in self.walker.clocks()]
        period, every = time.period, float(self.every)
        W, R = plan.work(), np.empty((8, 1 + 2 * plan.nx))
        while True:
            t, end = float(vector[layout.TIME]), t_end
            for first, update in clocks:
                k = max(0, round((t - first) / period))
                if t == first + k * period:
                    vector[head:], s = act(update, t, vector[head:], s, mode)
                k = max(0, math.floor((t - first) / period))
                while first + k * period <= t:
                    k += 1
                end = min(end, first + k * period)
            vector[layout.END] = end
            vector[layout.EVERY], vector[layout.COUNT] = every, 0.0
            code = arc(plan.P, plan.F, K, W, vector, R)
            while code == layout.FULL:
                R = np.empty((2 * len(R), R.shape[1]))
                vector[layout.COUNT] = 0.0
                code = arc(plan.P, plan.F, K, W, vector, R)
            nodes.add(R[: int(vector[layout.COUNT])].copy(), s)
            if code != layout.COMPLETED or vector[layout.TIME] >= t_end:
                return code, vector, s

    def _actor(self, places: Places) -> Act:
        """A clock's update on the two parts of x; without hardware a tick takes a shorter way."""
        walker, n, p = self.walker, self.walker.plant.n, self.walker.plant.p

        def act(
            update: Update, t: float, flowing: Array, kept: Array, mode: Mode
        ) -> tuple[Array, Array]:
            x = update(t, places.whole(flowing, kept), mode)
            return x[places.flowing], x[places.kept]

        law, terms = walker.law, walker.nominal
        assert isinstance(terms, CompiledBiped)
        assert walker.held is not None

        def plain(
            update: Update, t: float, flowing: Array, s: Array, mode: Mode
        ) -> tuple[Array, Array]:
            q, v = flowing[:n].copy(), flowing[n : 2 * n].copy()
            body = terms.body_terms(q, v) if law.needs_body else None
            m = Measurement(t, mode.step, t - mode.start, q, v, terms.reduction_at(q, v), body)
            s = law.correct(s, m)
            u = walker.saturate(law.output(s, m))
            flowing[2 * n :] = u
            return flowing, law.predict(s, m, u)

        return plain if walker.held.sizes.total == p and not walker.held.sizes.rate else act

    def _after(self, vector: Array, x: Array, mode: Mode) -> Array:
        """The run goes on from x+."""
        vector = vector.copy()
        vector[layout.STEP], vector[layout.START] = mode.step, mode.start
        vector[layout.FIRED], vector[layout.ARMED] = layout.FOOT_STRIKE, 0.0
        vector[layout.HEAD :] = x
        return vector


def _single(vector: Array) -> Array:
    x = vector[layout.HEAD :]
    return np.concatenate((vector[[layout.TIME]], x, np.zeros_like(x)))[np.newaxis]
