"""Runs of which a part has no laws: it runs in Python on the compiled plant.

In sampled time the controller is called once per tick and the plant flows between ticks in compiled code. In
continuous time, and for disturbances or methods without a compiled form, the Python engine runs with compiled
D_s, Omega and q''.
"""

from __future__ import annotations

from dataclasses import replace

from biped_adrc.engine.compiled_biped import CompiledBiped
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.ticks import TickByTick
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Mode, Walker

ENGINE = "compiled plant"


def on_compiled_plant(walker: Walker) -> Walker:
    """The walker with compiled dynamics. Raises ModelError for a robot that is no planar tree."""
    model = None if walker.model is None else CompiledBiped.of(walker.model)
    return replace(walker, plant=CompiledBiped.of(walker.plant), model=model)


def partly(
    walker: Walker,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    reason: str,
    *,
    t_end: float,
    t0: float,
    impacts: int | None,
    store_every: int,
    progress: Progress | None,
) -> Trajectory:
    """The run, with `reason` in its settings. Raises as `simulate`."""
    compiled = on_compiled_plant(walker)
    settings = {"engine": ENGINE, "why": reason}
    if walker.sampled:
        try:
            ticks = TickByTick.of(compiled, method, store_every)
        except NotCompiled:
            pass
        else:
            run = ticks.run(x0, mode, t0, t_end, impacts, method.label, progress)
            return replace(run, settings={**run.settings, **settings})
    stop_after = None if impacts is None else (FOOT_STRIKE, impacts)
    run = simulator.simulate(
        compiled,
        x0,
        mode,
        method,
        t_end=t_end,
        t0=t0,
        stop_after=stop_after,
        store_every=store_every,
        progress=progress,
    )
    return replace(run, settings={**run.settings, **settings})
