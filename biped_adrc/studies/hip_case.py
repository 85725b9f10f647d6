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
from biped_adrc.analysis.stride_directions import STANCE_KNEE
from biped_adrc.analysis.stride_gain import stride_response
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.base import Controller
from biped_adrc.control.npd import NPDController
from biped_adrc.control.stride import StridePI
from biped_adrc.disturbances.hip_force import HipForce
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.status import Status
from biped_adrc.model.biped import Biped
from biped_adrc.studies.walk import Walk, walk
from biped_adrc.walker import FOOT_STRIKE, Walker

TRACKING = ("NPD", "ADRC")


class Parts(NamedTuple):
    """The robot, the gait and the controller of a case."""

    biped: Biped
    gait: Gait
    law: Controller


@dataclass(frozen=True)
class HipCase:
    """One walker to be pushed. h [s]: of RK4 under NPD, of the exponential method under ADRC.

    stride: whether the PI goes around the tracking; limit [rad]: its bound on |beta|.
    Raises InputError for an unknown law, less than one step, or a resolution [N] or h that is not positive.
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
        if self.tracking not in TRACKING:
            raise InputError(f"tracking law '{self.tracking}' is unknown, choose one of {TRACKING}")
        if self.steps < 1:
            raise InputError(f"a walk of {self.steps} steps was asked for, expected at least 1")
        for name, value, unit in (("resolution", self.resolution, "N"), ("step", self.h, "s")):
            if not (math.isfinite(value) and value > 0):
                raise InputError(f"the {name} is {value} {unit}, expected a positive number")

    @property
    def name(self) -> str:
        """Of the controller."""
        return f"{self.tracking} with PI" if self.stride else self.tracking

    def parts(self) -> Parts:
        """What walks; the gains of the PI are those of the triple pole."""
        biped = Biped.load("rabbit", self.preset)
        gait = load_gait(self.gait, biped)
        h = gait.constraint
        law: Controller = NPDController(h) if self.tracking == "NPD" else ADRCController(h)
        if self.stride:
            gains = stride_response(gait, biped, self.direction).gains(self.limit)
            law = StridePI.on_gait(law, gait, biped, gains, direction=self.direction)
        return Parts(biped, gait, law)

    def walk(self, force: float) -> Walk:
        """The walk from the gait's orbit under a rearward force [N], which acts from its first instant on."""
        biped, gait, law = self.parts()
        walker = Walker(biped, law, HipForce(biped, (-force, 0.0)))
        method = RK4(self.h) if self.tracking == "NPD" else Exponential(self.h)
        return walk(walker, gait, self.steps, method)

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
