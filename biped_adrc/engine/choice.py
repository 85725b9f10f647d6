"""One run by the engine asked for; what ran is in the trajectory's settings."""

from __future__ import annotations

from dataclasses import replace

from biped_adrc.errors import InputError, ModelError
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Mode, Walker

PINOCCHIO, COMPILED = "pinocchio", "compiled"
ENGINES = (PINOCCHIO, COMPILED)


def check_engine(engine: str) -> None:
    """Raise InputError for an engine that there is not."""
    if engine not in ENGINES:
        raise InputError(f"engine '{engine}' is unknown; choose one of {list(ENGINES)}")


def simulate_by(
    engine: str,
    walker: Walker,
    x0: Array,
    mode: Mode,
    method: OneStepMethod,
    *,
    t_end: float,
    t0: float = 0.0,
    impacts: int | None = None,
    progress: Progress | None = None,
) -> Trajectory:
    """`hybrid.simulate` with Pinocchio's dynamics, or the compiled run.

    A robot that is no planar tree is simulated with Pinocchio whatever was asked for. settings["engine"] says
    what ran, settings["why"] why it is not what was asked for. Raises InputError.
    """
    check_engine(engine)
    why = {}
    if engine == COMPILED:
        from biped_adrc.engine.simulate import simulate

        try:
            return simulate(
                walker,
                x0,
                mode,
                method,
                t_end=t_end,
                t0=t0,
                impacts=impacts,
                progress=progress,
            )
        except ModelError as error:
            why = {"why": f"{error}; Pinocchio was used instead"}
    run = simulator.simulate(
        walker,
        x0,
        mode,
        method,
        t_end=t_end,
        t0=t0,
        stop_after=None if impacts is None else (FOOT_STRIKE, impacts),
        progress=progress,
    )
    return replace(run, settings={**run.settings, "engine": PINOCCHIO, **why})
