"""The numbers that are kept of a scenario's walk: small enough to be sent back by a worker process.

A walk itself holds megabytes of states. Studies of thousands of walks and the reproduction of the paper compare
outcomes; `Walk.outcome` makes one, `run.execute` returns it.

`Outcome.half` is the outcome at half the integration step, where it was asked for: the difference of the two is
an estimate of the error of integration in every number here, since RK4's error falls by 16.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from biped_adrc.analysis.certificate import Certificate
from biped_adrc.analysis.feasibility import Feasibility
from biped_adrc.analysis.quadrature import integrate
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, freeze

if TYPE_CHECKING:
    from biped_adrc.scenario.recording import Walk
    from biped_adrc.scenario.scenario import Scenario


@dataclass(frozen=True)
class Outcome(Shown):
    """Status, impacts, errors, torque and feasibility of one walk."""

    run: Scenario
    """The scenario that was walked."""
    status: str
    """Name of the trajectory's status, "COMPLETED" for a walk of all impacts asked for."""
    impacts: int
    """Number of impacts made."""
    x_minus: Array
    """States just before each impact (impacts, states) [rad, rad/s], the controller's behind."""
    durations: Array
    """Durations of the single supports (impacts,) [s]."""
    peak_error: float
    """max |q_b - q_d| [rad], also between the nodes of the method; 0 where no joint is driven."""
    rms_error: float
    """Root of the mean over time and joints of (q_b - q_d)^2 [rad]; 0 where no joint is driven."""
    peak_torque: float
    """max |u_i| [N m]; 0 without motors."""
    certificates: tuple[Certificate, ...]
    """What each finished step would have asked of ground and motors."""
    feasibility: Feasibility
    """Whether ground and motors could have carried the walk, within the limits of the robot's record."""
    method: str
    """Integration method, with its step."""
    engine: str
    """The engine that ran, "compiled" or "pinocchio"; "unknown" for a run that does not say."""
    half: Outcome | None = None
    """The same run with every step half as long; its own half is None."""

    def __post_init__(self) -> None:
        freeze(self, "x_minus", "durations")

    @property
    def walked(self) -> bool:
        """True where all impacts asked for were made."""
        return self.status == "COMPLETED"


def outcome_of(walk: Walk) -> Outcome:
    """The outcome of a scenario's walk.

    The mean of squared errors is over time, by quadrature between nodes. Raises InputError for a walk that is
    not of a scenario.
    """
    if walk.scenario is None:
        raise InputError(
            "this walk was made of a walker, and an outcome is a scenario's; take its trajectory, signals and "
            "feasibility, or walk with biped_adrc.walk_scenario"
        )
    trajectory, s = walk.trajectory, walk.signals
    events = trajectory.events(FOOT_STRIKE)
    times = np.array([0.0, *(event.t for event in events)])
    squares = np.sum(s.error**2, axis=1) / max(s.error.shape[1], 1)
    duration = s.t[-1] - s.t[0]
    mean = integrate(s.t, squares) / duration if duration > 0 else float(squares[0])
    return Outcome(
        walk.scenario,
        trajectory.status.name,
        len(events),
        trajectory.before(FOOT_STRIKE),
        np.diff(times),
        s.peak_error,
        float(np.sqrt(max(mean, 0.0))),
        walk.peak_torque,
        walk.certificates,
        walk.feasibility,
        str(trajectory.settings["method"]),
        str(trajectory.settings.get("engine", "unknown")),
    )
