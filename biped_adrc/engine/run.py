"""One run of a walker by the engine asked for; what ran is in the trajectory's settings.

Entry to the engine for `scenario.walk` and the reproduction of the paper. "pinocchio" runs the
Python loop on Pinocchio's dynamics, "compiled" tries machine code first. numba and LLVM are
imported only when they are needed.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.core.errors import InputError, ModelError
from biped_adrc.core.types import Array
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.trajectory import Trajectory

PINOCCHIO, COMPILED, COMPILED_PLANT = "pinocchio", "compiled", "compiled plant"
"""Names of the engines in settings and records; "compiled plant" is what ran where a part does not compile."""
ENGINES = (PINOCCHIO, COMPILED)
"""Those that can be asked for."""


def check_engine(engine: str) -> None:
    """Raise InputError for an engine that does not exist."""
    if engine not in ENGINES:
        raise InputError(f"engine '{engine}' is unknown; choose one of {list(ENGINES)}")


def simulate_by(
    engine: str,
    walker: Walker,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    *,
    impacts: int | None = None,
    **options: Any,
) -> Trajectory:
    """A run of a walker from x0 (nx,) with Pinocchio's dynamics, or compiled; options as of `RunOptions`.

    impacts: end after that many. A robot that is no planar tree is simulated with Pinocchio
    whatever was asked for. settings["engine"] says what ran, settings["why"] why it is not what was
    asked for. Raises InputError.
    """
    check_engine(engine)
    if impacts is not None:
        options["stop_after"] = FOOT_STRIKE, impacts
    run_options, why = RunOptions(**options), {}
    if engine == COMPILED:
        from biped_adrc.engine.simulate import run_compiled

        try:
            return run_compiled(walker, x0, mode, method, run_options)
        except ModelError as error:
            why = {"why": f"{error}; Pinocchio was used instead"}
    run = simulator.run(walker, x0, mode, method, run_options)
    return replace(run, settings={**run.settings, "engine": PINOCCHIO, **why})
