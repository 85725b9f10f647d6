"""Sampled control in plain Python on the compiled plant: the controller is called once per tick.

Between ticks the plant is x = (q, q', u) with the torque held; the controller's own state is kept here and goes
back into the states of the trajectory.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

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
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Mode, SampledTime, Walker

TERMINAL = {Status.FELL: "hip_too_low", Status.STALLED: "step_too_long"}
"""The guards that end a run, by status."""


class _Nodes:
    """Of one arc, tick by tick: rows (t, x, x') of the plant, and the controller's state, which is held."""

    def __init__(self) -> None:
        self.rows: list[Array] = []
        self.states: list[Array] = []

    def add(self, rows: Array, s: Array) -> None:
        """Nodes between two ticks."""
        self.rows.append(rows)
        self.states.append(s)

    def arc(self, mode: Mode, event: Event | None, n: int) -> Arc:
        """All of them, with states (q, q', s, u)."""
        rows = np.vstack(self.rows)
        counts = [len(part) for part in self.rows]
        s = np.repeat(np.array(self.states), counts, axis=0)
        nx = (rows.shape[1] - 1) // 2
        x, dx = rows[:, 1 : 1 + nx], rows[:, 1 + nx :]
        end = 2 * n
        return Arc(
            mode,
            rows[:, 0].copy(),
            np.hstack((x[:, :end], s, x[:, end:])),
            np.hstack((dx[:, :end], np.zeros_like(s), dx[:, end:])),
            event,
        )


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
        n, p = self.walker.plant.n, self.walker.plant.p
        s = x0[2 * n : len(x0) - p]
        vector = self.plant.plan.start(
            np.concatenate((x0[: 2 * n], x0[-p:])), t0, mode.step, mode.start, t_end
        )
        arcs: list[Arc] = []
        status, detail = Status.COMPLETED, ""
        while True:
            nodes = _Nodes()
            try:
                with np.errstate(over="ignore", invalid="ignore"):  # ends as the status NOT_FINITE
                    code, vector, s = self._arc(vector, s, mode, t0, t_end, nodes)
                    t, x = float(vector[layout.TIME]), self._whole(vector, s)
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
                arcs.append(nodes.arc(mode, None if guard is None else Event(guard, t, x, None), n))
                break
            after, next_mode = struck
            arcs.append(nodes.arc(mode, Event(FOOT_STRIKE, t, x, after), n))
            mode, s = next_mode, after[2 * n : len(after) - p]
            vector = self._after(vector, after, mode)
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
        self, vector: Array, s: Array, mode: Mode, t_first: float, t_end: float, nodes: _Nodes
    ) -> tuple[int, Array, Array]:
        """Tick, flow, tick, to the first event or the end."""
        time = self.walker.timing
        assert isinstance(time, SampledTime)
        n, plan, K = self.walker.plant.n, self.plant.plan, self.plant.K
        origin = float(vector[layout.TIME]) if time.restart else t_first
        head, arc, act = layout.HEAD, kernels().arc, self._actor()
        end, period, every = layout.HEAD + 2 * n, time.period, float(self.every)
        W, R = plan.work(), np.empty((8, 1 + 2 * plan.nx))
        while True:
            t = float(vector[layout.TIME])
            k = round((t - origin) / period)
            if t == origin + k * period:
                s, vector[end:] = act(t, vector[head:end].copy(), s, mode)
            k = math.floor((t - origin) / period)
            while origin + k * period <= t:
                k += 1
            vector[layout.END] = min(origin + k * period, t_end)
            vector[layout.EVERY], vector[layout.COUNT] = every, 0.0
            code = arc(plan.P, plan.F, K, W, vector, R)
            while code == layout.FULL:
                R = np.empty((2 * len(R), R.shape[1]))
                vector[layout.COUNT] = 0.0
                code = arc(plan.P, plan.F, K, W, vector, R)
            nodes.add(R[: int(vector[layout.COUNT])].copy(), s)
            if code != layout.COMPLETED or vector[layout.TIME] >= t_end:
                return code, vector, s

    def _actor(self) -> Callable[[float, Array, Array, Mode], tuple[Array, Array]]:
        """`Walker.acted` at (q, q') in one array (2 n,), of which the loops know that it is finite."""
        walker, n, law, terms = (
            self.walker,
            self.walker.plant.n,
            self.walker.law,
            self.walker.nominal,
        )
        assert isinstance(terms, CompiledBiped)

        def act(t: float, x: Array, s: Array, mode: Mode) -> tuple[Array, Array]:
            q, v = x[:n], x[n:]
            body = terms.body_terms(q, v) if law.needs_body else None
            m = Measurement(t, mode.step, t - mode.start, q, v, terms.reduction_at(q, v), body)
            s = law.correct(s, m)
            u = walker.saturate(law.output(s, m))
            return law.predict(s, m, u), u

        return act

    def _whole(self, vector: Array, s: Array) -> Array:
        n, x = self.walker.plant.n, vector[layout.HEAD :]
        return np.concatenate((x[: 2 * n], s, x[2 * n :]))

    def _after(self, vector: Array, x: Array, mode: Mode) -> Array:
        """The run goes on from x+."""
        n, p = self.walker.plant.n, self.walker.plant.p
        vector = vector.copy()
        vector[layout.STEP], vector[layout.START] = mode.step, mode.start
        vector[layout.FIRED], vector[layout.ARMED] = layout.FOOT_STRIKE, 0.0
        vector[layout.HEAD :] = np.concatenate((x[: 2 * n], x[len(x) - p :]))
        return vector


def _single(vector: Array) -> Array:
    x = vector[layout.HEAD :]
    return np.concatenate((vector[[layout.TIME]], x, np.zeros_like(x)))[np.newaxis]
