"""The walks that the benchmarks share: RABBIT on the published gait, with the paper's push or without."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import biped_adrc as ba
from biped_adrc.engine.batch import BatchWalk, Case, Preparation
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.paper.scenarios import PAPER_PUSH
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.scenario import Scenario

IMPACTS = 25
TICK = 1e-3  # [s], of sampled control


class Setting(NamedTuple):
    """A walker and the gait that it starts on."""

    walker: ba.Walker
    gait: ba.Gait

    def case(self, method: OneStepMethod, impacts: int = IMPACTS) -> Case:
        """The walk of so many impacts."""
        return Case(self.walker, *self.gait.start(self.walker.plant), method, impacts)

    def under(self, controller: ba.Controller) -> Setting:
        """The same with another controller."""
        return self._replace(walker=replace(self.walker, controller=controller))


def setting(controller: str = "ADRC", push: bool = False, **values: Any) -> Setting:
    """That of a scenario; the period [s] of sampled control is TICK unless it is given."""
    pushes = (PAPER_PUSH,) if push else ()
    run = Scenario(controller, pushes=pushes, **{"hardware.period": TICK, **values})
    scene = RobotAndGait.of(run)
    return Setting(build(run, scene), scene.walked)


def ready(case: Case) -> Callable[[], BatchWalk]:
    """A run of the case from its start, compiled before."""

    def walked() -> BatchWalk:
        return Preparation()(case)()

    walked()
    return walked


def load() -> str:
    """What else the machine does, for the note of a table."""
    return f"load average before {os.getloadavg()[0]:.2f} of {os.cpu_count()} cores"
