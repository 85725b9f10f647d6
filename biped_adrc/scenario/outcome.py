"""What a walk leaves that is small enough to come back from another process."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from biped_adrc.analysis.certificate import Certificate
from biped_adrc.analysis.legality import Legality
from biped_adrc.analysis.quadrature import integrate
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.shown import Shown
from biped_adrc.types import Array

if TYPE_CHECKING:
    from biped_adrc.scenario.recording import Walk
    from biped_adrc.scenario.scenario import Scenario


@dataclass(frozen=True)
class Outcome(Shown):
    """What a run leaves; small enough to come back from another process."""

    run: Scenario
    status: str
    message: str
    impacts: int
    x_minus: Array
    """(impacts, states) before each impact."""
    durations: Array
    """(impacts,) of the single supports [s]."""
    peak_error: float
    """max |q_b - q_d| [rad], inside the steps of the method too; 0 where no joint is driven."""
    rms_error: float
    """Root of the mean over time and joints of (q_b - q_d)^2 [rad]; 0 where no joint is driven."""
    peak_torque: float
    """[N m]; 0 without motors."""
    certificates: tuple[Certificate, ...]
    legality: Legality
    """What ground and motors would have had to give, within the limits of the robot's record."""
    method: str
    engine: str
    """What ran; "unknown" in runs of version 0.1."""
    half: Outcome | None = None
    """The same run with every step half as long; its own half is None."""

    @property
    def walked(self) -> bool:
        """Whether all impacts asked for were made."""
        return self.status == "COMPLETED"


def outcome_of(made: Walk) -> Outcome:
    """What is left of a walk for another process."""
    assert made.scenario is not None
    trajectory, s = made.trajectory, made.signals
    events = trajectory.events(FOOT_STRIKE)
    times = np.array([0.0, *(event.t for event in events)])
    squares = np.sum(s.error**2, axis=1) / max(s.error.shape[1], 1)
    duration = s.t[-1] - s.t[0]
    mean = integrate(s.t, squares) / duration if duration > 0 else float(squares[0])
    return Outcome(
        made.scenario,
        trajectory.status.name,
        f"{trajectory.status.value} {trajectory.detail}".strip(),
        len(events),
        trajectory.before(FOOT_STRIKE),
        np.diff(times),
        s.peak_error,
        float(np.sqrt(max(mean, 0.0))),
        float(np.max(np.abs(s.u), initial=0.0)),
        made.certificates,
        made.legality,
        str(trajectory.settings["method"]),
        str(trajectory.settings.get("engine", "unknown")),
    )
