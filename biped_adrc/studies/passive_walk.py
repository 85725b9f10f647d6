"""Robots without motors walking down a slope on their known cycle.

The cycle is the fixed point of the return map, found by Newton from the stored state; the walk starts just
after its impact.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.control.passive import Passive
from biped_adrc.errors import InputError, check_count
from biped_adrc.gait.passive_cycle import passive_cycle
from biped_adrc.gait.reference import Reference, TimeReference
from biped_adrc.hybrid.integrators import RK4, OneStepMethod
from biped_adrc.hybrid.simulator import Progress, simulate
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.studies.cycle_stability import known_cycle
from biped_adrc.studies.recording import Recording, RecordingViewer
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Mode, Walker

SETTLES = 1e-9
"""[rad, rad/s], residual of Newton on the return map: feet of almost no mass leave a round-off of 1e-10."""


def _nothing(t: float) -> tuple[Array, Array, Array]:
    return np.zeros(0), np.zeros(0), np.zeros(0)


@dataclass(frozen=True)
class PassiveWalk(Recording):
    """What a robot without motors did on its slope."""

    walker: Walker
    trajectory: Trajectory

    @property
    def reference(self) -> Reference:
        """Nothing (0,): there is no joint to be driven."""
        return TimeReference(_nothing)

    @property
    def note(self) -> str:
        """Robot, preset and slope."""
        plant = self.walker.plant
        return f"{plant.description.name} {plant.preset} without motors, slope {self.walker.slope:g} rad"

    @classmethod
    def of(cls, walker: Walker, trajectory: Trajectory) -> PassiveWalk:
        """The walk whose trajectory can draw itself."""
        viewer = RecordingViewer(lambda bare: cls(walker, bare))
        return cls(walker, replace(trajectory, viewer=viewer))


def passive_walk(
    robot: str | Path = "compass",
    impacts: int = 10,
    slope: float | None = None,
    preset: str | None = None,
    method: OneStepMethod | None = None,
    progress: Progress | None = None,
) -> PassiveWalk:
    """Walk on the cycle of a robot without motors, on its stored slope or another one nearby [rad].

    method: RK4 at 1 ms if None. A fall is a status of the trajectory. Raises InputError for a robot with
    motors or a number of impacts that is no walk, GaitError when no cycle is stored, and SimulationError when
    there is none on this slope.
    """
    check_count(impacts, f"the walk asks for {impacts} impacts")
    biped = Biped.load(robot, preset)
    _without_motors(biped)
    cycle = known_cycle(biped, slope)
    orbit, _ = periodic_orbit(cycle.P, cycle.guess, SETTLES)
    walker, n = cycle.P.walker, biped.n
    after = biped.impact(orbit.x_minus[:n], orbit.x_minus[n:])
    trajectory = simulate(
        walker,
        walker.initial_state(after.q, after.v),
        Mode(),
        RK4() if method is None else method,
        t_end=impacts * walker.max_step_time,
        stop_after=(FOOT_STRIKE, impacts),
        progress=progress,
    )
    record = {"robot": str(robot), "preset": biped.preset, "slope": walker.slope}
    settings = {**trajectory.settings, "passive": record}
    return PassiveWalk.of(walker, replace(trajectory, settings=settings))


def replayed(trajectory: Trajectory) -> PassiveWalk:
    """The walk of a stored trajectory: its walker is built again from its settings. Raises InputError."""
    record = trajectory.settings["passive"]
    try:
        biped = Biped.load(record["robot"], record["preset"])
        slope = float(record["slope"])
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"these settings do not describe a passive walk: {record}") from error
    known = passive_cycle(biped)
    walker = Walker(biped, Passive(), slope=slope, max_step_time=known.max_step_time)
    return PassiveWalk.of(walker, trajectory)


def _without_motors(biped: Biped) -> None:
    if biped.p:
        raise InputError(
            f"robot '{biped.description.name}' has {biped.p} motors, a passive walk needs a robot without; "
            "take 'compass', 'rimless_wheel' or 'simplest', or walk a gait with biped_adrc.walk"
        )
