"""Runs of a walker in compiled code, with the trajectory that the Python engine would leave.

What has no laws runs in Python on the compiled plant: a controller in sampled time tick by tick, with the
plant's flow between ticks compiled; anything else through the Python engine with compiled dynamics.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.run import ArcRun
from biped_adrc.engine.kernels.run import arc as run_arc
from biped_adrc.engine.kernels.tables import STATUS
from biped_adrc.engine.partly import partly
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.ticks import TERMINAL
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import Progress, check_start
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Mode, Walker

COMPILED = "compiled"


def simulate(
    walker: Walker,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    *,
    t_end: float,
    t0: float = 0.0,
    impacts: int | None = None,
    store_every: int = 1,
    progress: Progress | None = None,
) -> Trajectory:
    """As `hybrid.simulate` for a walker; impacts: end after that many foot strikes.

    The trajectory's settings say which engine ran and, where it is not all compiled, why. Raises InputError
    for a start that is not finite or parts that do not fit, ModelError for a robot that is no planar tree.
    """
    stop_after = None if impacts is None else (FOOT_STRIKE, impacts)
    check_start(np.asarray(x0), t0, t_end, stop_after, store_every)
    try:
        compiled = CompiledWalker.of(walker, method, walker.controller_size(x0), t0)
    except NotCompiled as reason:
        return partly(
            walker,
            x0,
            mode,
            method,
            str(reason),
            t_end=t_end,
            t0=t0,
            impacts=impacts,
            store_every=store_every,
            progress=progress,
        )
    run = _Run(compiled, method.label, impacts, store_every, progress)
    return run.from_(x0, mode, t0, t_end)


@dataclass(frozen=True)
class _Run:
    compiled: CompiledWalker
    label: str
    impacts: int | None
    every: int
    progress: Progress | None

    @property
    def room(self) -> int:
        """Nodes of an arc to make room for at first: those of a long single support, two at each tick."""
        F, longest = self.compiled.plan.F, 0.6
        shortest = F[layout.H] if self.compiled.plan.P[layout.KIND] != layout.DOP853 else 1e-3
        ticks = longest / F[layout.PERIOD] if F[layout.PERIOD] > 0.0 else 0.0
        return 64 + min(100_000, int(longest / shortest / max(1, self.every) + 2.0 * ticks))

    def from_(self, x: Array, mode: Mode, t0: float, t_end: float) -> Trajectory:
        """Arcs until enough impacts, the end, or a terminal status."""
        c = self.compiled
        s = c.plan.start(x, t0, mode.step, mode.start, t_end)
        arcs: list[Arc] = []
        while True:
            found = run_arc(c.plan, c.K, s, self.every, self.room)
            s = found.s
            if found.code != layout.STRUCK:
                status = STATUS[found.code]
                arcs.append(_arc(found, mode, _terminal(found, status)))
                break
            t, x_minus = float(s[layout.TIME]), s[layout.HEAD :].copy()
            code = kernels().strike(c.plan.P, c.plan.F, c.K, c.plan.work(), s)
            if code != 0:
                status = STATUS[code]
                arcs.append(_arc(found, mode, None))
                break
            arcs.append(_arc(found, mode, Event(FOOT_STRIKE, t, x_minus, s[layout.HEAD :].copy())))
            mode = Mode(int(s[layout.STEP]), t)
            if self.progress is not None:
                self.progress(t, len(arcs))
            status = Status.COMPLETED
            if self.impacts is not None and len(arcs) >= self.impacts:
                return self.trajectory(arcs, status)
            if t >= t_end:
                break
        if status is Status.COMPLETED and self.impacts is not None:
            status = Status.TIME_OUT
        return self.trajectory(arcs, status)

    def trajectory(self, arcs: list[Arc], status: Status) -> Trajectory:
        """With the engine's name in its settings."""
        detail = ""
        if status in (Status.NOT_FINITE, Status.SINGULAR, Status.STEP_FAILED):
            detail = f"after t = {arcs[-1].t[-1]:.6g} s"
        return Trajectory(tuple(arcs), status, detail, {"method": self.label, "engine": COMPILED})


def _terminal(found: ArcRun, status: Status) -> Event | None:
    if status not in TERMINAL:
        return None
    return Event(TERMINAL[status], float(found.s[layout.TIME]), found.s[layout.HEAD :].copy(), None)


def _arc(found: ArcRun, mode: Mode, event: Event | None) -> Arc:
    return Arc(mode, found.t.copy(), found.x.copy(), found.dx.copy(), event)
