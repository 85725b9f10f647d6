"""A constant rearward force on the hip, with and without a controller from step to step.

Tracking cannot reject a force that enters the unactuated row: Westervelt, Grizzle, Canudas de Wit (IEEE CDC
2003) report that 3 N stop a gait of 0.50 m/s under any inner loop, and that a PI from step to step recovers
it. A case walks from the orbit of its gait under NPD or ADRC, alone or inside the PI of `control.stride` with
the gains of its triple pole; the force (-force, 0) acts from the first instant on. The quadratures of
`forced_steps` predict the force that stops it, without a simulation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.certificate import REASONS
from biped_adrc.analysis.feasibility import Feasibility, outcome_of
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.control.base import Controller
from biped_adrc.control.stride import StridePI
from biped_adrc.core.registry import find
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.status import Status
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import walk_scenario
from validation.forced_steps import stopping_force

STANCE_KNEE = (0.0, 0.0, 1.0, 0.0)
"""d for RABBIT's joints: beta < 0 bends the stance knee in the middle of the step and quickens the walk."""


class Parts(NamedTuple):
    """What walks."""

    biped: Biped
    """RABBIT in the preset of the case."""
    gait: Gait
    """Its stored gait."""
    law: Controller
    """The controller, the PI around it included."""


@dataclass(frozen=True)
class HipCase:
    """One walker to be pushed.

    Raises InputError for what no scenario takes.
    """

    tracking: str
    """Name of the inner controller."""
    stride: bool
    """Whether the PI from step to step goes around it."""
    preset: str = "identified-bare"
    """Of RABBIT."""
    gait: str = "v0.5"
    """Name of a stored gait."""
    direction: tuple[float, ...] = STANCE_KNEE
    """(p,) in which the PI moves the gait's curve."""
    limit: float = 0.5
    """Bound of the PI on |beta| [rad]."""
    steps: int = 25
    """Steps asked for."""
    h: float = 1e-3
    """Integration step [s]: of RK4 under NPD, of the exponential method under ADRC."""

    def __post_init__(self) -> None:
        self.scenario(0.0)
        find("controller", self.tracking)

    def scenario(self, force: float) -> Scenario:
        """The walk from the gait's orbit under a rearward force [N], which acts from its first instant on."""
        around = {"direction": self.direction, "limit": self.limit, "inner": self.tracking}
        return Scenario(
            {"name": "stride PI", **around} if self.stride else self.tracking,
            robot={"preset": self.preset},
            gait=self.gait,
            run={"impacts": self.steps, "h": self.h},
            pushes=[{"shape": "hip force", "force": force, "direction": math.pi}],
        )

    def parts(self) -> Parts:
        """Robot, gait and controller; the gains of the PI are those of the triple pole."""
        scene = RobotAndGait.of(self.scenario(0.0))
        walker = build(self.scenario(0.0), scene)
        return Parts(scene.biped, scene.walked, walker.controller)

    def walk(self, force: float) -> Walk:
        """The simulated walk under this force [N]."""
        return walk_scenario(self.scenario(force))

    def predicted(self) -> float:
        """The force [N] that stops it according to the quadratures on the zero dynamics, without a
        simulation.
        """
        biped, gait, law = self.parts()
        stride = law if isinstance(law, StridePI) else None
        return stopping_force(gait, biped, self.steps, stride)


@dataclass(frozen=True)
class PushedWalk:
    """What one force did, and what the finished steps needed; None where there is no finished step."""

    force: float
    """Rearward [N]."""
    status: Status
    """How the simulation ended."""
    speeds: tuple[float, ...]
    """L / T of every finished step [m/s]."""
    feasibility: Feasibility | None
    """Of the finished steps, within the limits of the robot's record."""
    clearance: float | None
    """Least height of the swing foot inside a step [m]."""

    @classmethod
    def of(cls, case: HipCase, force: float) -> PushedWalk:
        """Simulate the case under this force [N].

        The last step, in which the robot fell, is left out of speeds and feasibility.
        """
        made = case.walk(force)
        count = len(made.trajectory.events(FOOT_STRIKE))
        arcs = tuple(arc for arc in made.trajectory.arcs if arc.mode.step <= count)
        finished = replace(made, trajectory=replace(made.trajectory, arcs=arcs))
        steps = finished.certificates if arcs else ()
        return cls(
            force,
            made.trajectory.status,
            tuple(step.step_length / step.duration for step in steps),
            finished.feasibility if arcs else None,
            min((step.clearance for step in steps), default=None),
        )

    @property
    def walks(self) -> bool:
        """Whether all steps were made."""
        return self.status.ok

    @property
    def outcome(self) -> str:
        """One of the words in `analysis.feasibility.OUTCOMES`."""
        if self.feasibility is None:
            return outcome_of(self.status, REASONS)
        return self.feasibility.outcome

    def speed(self, last: int = 5) -> float | None:
        """Mean of the last steps [m/s]; None without one."""
        return float(np.mean(self.speeds[-last:])) if self.speeds else None
