"""The walks that the benchmarks of the compiled engine share: RABBIT, the published gait, the paper's push."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

BENCHMARKS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(BENCHMARKS), str(BENCHMARKS / "peers")]

import biped_adrc as ba  # noqa: E402
from biped_adrc.engine.batch import BatchWalk, Case, run_case  # noqa: E402
from biped_adrc.engine.run import simulate_by  # noqa: E402
from biped_adrc.hybrid.integrators import OneStepMethod  # noqa: E402
from biped_adrc.paper.plan import PAPER_PUSH  # noqa: E402
from biped_adrc.scenario.build import RobotAndGait, build  # noqa: E402
from biped_adrc.scenario.scenario import Scenario  # noqa: E402

simulate = partial(simulate_by, "compiled")

IMPACTS = 25
TICK = 1e-3  # [s], of sampled control


class Setting(NamedTuple):
    """A walker and the gait that it starts on."""

    walker: ba.Walker
    gait: ba.Gait

    def case(self, method: OneStepMethod, impacts: int = IMPACTS) -> Case:
        """The walk of so many impacts."""
        return Case(self.walker, *self.gait.start(self.walker.plant), method, impacts)

    def walk(self, method: OneStepMethod, engine: str) -> ba.Trajectory:
        """The paper's 25 impacts."""
        return ba.walk(self.walker, self.gait, IMPACTS, method, engine=engine).trajectory

    def thinned(self, method: OneStepMethod, every: int) -> ba.Trajectory:
        """The same on the compiled engine, every so many steps a node: for angles, not for peaks."""
        x, limit = self.walker.initial_state(*self.gait.start(self.walker.plant)), IMPACTS * 2.0
        asked = {"t_end": limit, "impacts": IMPACTS, "store_every": every}
        return simulate(self.walker, x, ba.Mode(), method, **asked)


def paper(controller: str = "ADRC", period: float | None = None, push: bool = True) -> Setting:
    """The paper's run; period [s] of sampled control, or continuous time."""
    run = Scenario(controller, period=period, pushes=(PAPER_PUSH,) if push else ())
    scene = RobotAndGait.of(run)
    return Setting(build(run, scene), scene.walked)


def with_observer(order: int, bandwidth: float, period: float | None) -> Setting:
    """ADRC with the observer of that order, all poles at -bandwidth [rad/s], no push."""
    run = Scenario("ADRC", period=period, bandwidth=bandwidth, order=order)
    scene = RobotAndGait.of(run)
    return Setting(build(run, scene), scene.walked)


def with_controller(setting: Setting, controller: ba.Controller) -> Setting:
    """The same with another controller."""
    return setting._replace(walker=replace(setting.walker, controller=controller))


def ready(case: Case) -> Callable[[], BatchWalk]:
    """What carries a case out from its start, as often as it is called; compiled before."""

    def walked() -> BatchWalk:
        return run_case(case)()

    walked()
    return walked


def load() -> str:
    """What else the machine does, for the note of a table made before the runs."""
    return f"load average before {os.getloadavg()[0]:.2f} of {os.cpu_count()} cores"
