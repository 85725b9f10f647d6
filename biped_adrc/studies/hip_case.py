"""One walker pulled backwards at the hip, and what it made of one force: J' F with F = (-force, 0) constant.

The walk starts on the orbit of its gait and the force acts from its first instant on; NPD or ADRC track, alone
or inside the PI of `control.stride` with the gains of its triple pole.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.forced_steps import stopping_force
from biped_adrc.analysis.legality import Legality, outcome_of
from biped_adrc.analysis.stride_gain import STANCE_KNEE
from biped_adrc.control.base import Controller
from biped_adrc.control.stride import StridePI
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.status import Status
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.build import Scene, build
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.registry import find
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.walker import FOOT_STRIKE


class Parts(NamedTuple):
    """The robot, the gait and the controller of a case."""

    biped: Biped
    gait: Gait
    law: Controller


@dataclass(frozen=True)
class HipCase:
    """One walker to be pushed. h [s]: of RK4 under NPD, of the exponential method under ADRC.

    stride: whether the PI goes around the tracking; limit [rad]: its bound on |beta|.
    Raises InputError for what no scenario is, or a resolution [N] that is not positive.
    """

    tracking: str
    stride: bool
    preset: str = "identified-bare"
    gait: str = "v0.5"
    direction: tuple[float, ...] = STANCE_KNEE
    limit: float = 0.5
    steps: int = 25
    resolution: float = 0.1
    h: float = 1e-3

    def __post_init__(self) -> None:
        self.scenario(0.0)
        find("controller", self.tracking)
        if not (math.isfinite(self.resolution) and self.resolution > 0):
            raise InputError(f"the resolution is {self.resolution} N, expected a positive number")

    @property
    def name(self) -> str:
        """Of the controller."""
        return f"{self.tracking} with PI" if self.stride else self.tracking

    def scenario(self, force: float) -> Scenario:
        """The walk from the gait's orbit under a rearward force [N], which acts from its first instant on."""
        around = {"inner": self.tracking, "direction": self.direction, "limit": self.limit}
        return Scenario(
            controller="stride PI" if self.stride else self.tracking,
            own=around if self.stride else {},
            preset=self.preset,
            gait=self.gait,
            impacts=self.steps,
            h=self.h,
            push="hip force",
            pushed_step=1,
            force=force,
            direction=math.pi,
        )

    def parts(self) -> Parts:
        """What walks; the gains of the PI are those of the triple pole."""
        scene = Scene.of(self.scenario(0.0))
        walker = build(self.scenario(0.0), scene)
        return Parts(scene.biped, scene.walked, walker.controller)

    def walk(self, force: float) -> Walk:
        """The walk under this force [N]."""
        return walk_scenario(self.scenario(force))

    def predicted(self) -> float:
        """The force [N] that stops it according to the quadratures."""
        biped, gait, law = self.parts()
        stride = law if isinstance(law, StridePI) else None
        return stopping_force(gait, biped, self.steps, stride)


@dataclass(frozen=True)
class PushedWalk:
    """What one force did, and what the finished steps needed; None where there is no finished step."""

    force: float
    """Rearward [N]."""
    status: Status
    speeds: tuple[float, ...]
    """L / T of every finished step [m/s]."""
    legality: Legality | None
    """Of the finished steps, within the limits of the robot's record."""
    clearance: float | None
    """Least height of the swing foot inside a step [m]."""

    @classmethod
    def of(cls, case: HipCase, force: float) -> PushedWalk:
        """Simulate it."""
        made = case.walk(force)
        arcs = tuple(arc for arc in made.trajectory.arcs if arc.mode.step <= _finished(made))
        finished = replace(made, trajectory=replace(made.trajectory, arcs=arcs))
        steps = finished.certificates if arcs else ()
        return cls(
            force,
            made.trajectory.status,
            tuple(step.step_length / step.duration for step in steps),
            finished.legality if arcs else None,
            min((step.clearance for step in steps), default=None),
        )

    @property
    def walks(self) -> bool:
        """Whether all steps were made."""
        return self.status.ok

    @property
    def outcome(self) -> str:
        """One of the words in `analysis.legality.OUTCOMES`."""
        return outcome_of(self.status, False) if self.legality is None else self.legality.outcome

    def speed(self, last: int = 5) -> float | None:
        """Mean of the last steps [m/s]."""
        return float(np.mean(self.speeds[-last:])) if self.speeds else None


def _finished(made: Walk) -> int:
    return len(made.trajectory.events(FOOT_STRIKE))
