"""A gait from a wish: designed on the zero dynamics, then walked and certified before it is handed over."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from biped_adrc.analysis.certificate import Certificate
from biped_adrc.columns import columns
from biped_adrc.control.npd import NPDController
from biped_adrc.errors import GaitError
from biped_adrc.gait.design.ipopt import Progress
from biped_adrc.gait.design.optimise import Optimum, optimise
from biped_adrc.gait.design.request import GaitRequest, Objective, StepLimits
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.hybrid.integrators import Adaptive
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots import KnownLimits
from biped_adrc.scenario.walk import walk
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Walker

RETURNS = 1e-6
"""[rad, rad/s]: how far the walk may be from the gait's orbit after its steps."""
STEPS = 2


@dataclass(frozen=True)
class DesignedGait:
    """A gait with the certificate of its simulated step."""

    gait: Gait
    request: GaitRequest
    objective: float
    """In the units of its Objective."""
    certificate: Certificate
    multiplier: float
    """delta^2 of the zero dynamics."""
    gap: float
    """max |x- of the walk - x- of the gait| after its steps [rad, rad/s]."""
    iterations: int
    seconds: float
    """Wall time of the design."""

    @property
    def speed(self) -> float:
        """Along the ground [m/s]."""
        return self.certificate.step_length / self.gait.period

    def text(self) -> str:
        """What was found, one line per figure."""
        c, o = self.certificate, self.request.objective
        unit = {"torque": " N^2 m s", "transport": "", "peak": " N m"}[o.value]
        rows = [
            ("speed", f"{self.speed:.6f} m/s"),
            ("step length", f"{c.step_length:.6f} m"),
            ("period", f"{self.gait.period:.6f} s"),
            (f"least {o.value}", f"{self.objective:.6g}{unit}"),
            ("delta^2", f"{self.multiplier:.6f}"),
            ("peak torque", f"{c.peak_torque:.2f} N m"),
            ("friction", f"{c.friction:.3f}, of the impulse {c.impulse_ratio:.3f}"),
            ("least F_N", f"{c.least_normal_force:.1f} N"),
            (
                "foot clearance",
                f"{1e3 * c.clearance:.1f} mm, between the first and the last 3 % of the step",
            ),
            ("cost of transport", f"{c.cost_of_transport:.4f}"),
            (f"walked {STEPS} steps under NPD, back within {self.gap:.1e}",),
            (f"designed in {self.seconds:.1f} s, {self.iterations} iterations",),
        ]
        return "\n".join(columns(rows, 19))


def design_gait(
    robot: Biped | str | Path = "rabbit",
    speed: float | None = None,
    step: float | None = None,
    *,
    preset: str | None = None,
    slope: float = 0.0,
    objective: Objective | str = Objective.TORQUE,
    through: tuple[Array, Array] | None = None,
    degree: int = 6,
    nodes: int = 24,
    limits: StepLimits | None = None,
    progress: Progress | None = None,
) -> DesignedGait:
    """The periodic, hybrid-invariant gait of least objective, certified by simulating it.

    speed [m/s] along the ground, step [m] between the feet; what is left out is free. through: (q-, q'-) that
    the orbit has to pass instead. Raises GaitError naming what could not be met.
    """
    biped = robot if isinstance(robot, Biped) else Biped.load(robot, preset)
    request = GaitRequest(
        speed,
        step,
        slope,
        objective_named(objective),
        degree,
        nodes,
        limits or StepLimits(),
        None if through is None else tuple(float(x) for x in np.concatenate(through)),
    )
    return certify(biped, request, optimise(biped, request, progress))


def objective_named(objective: Objective | str) -> Objective:
    """Raises GaitError for a name that is none."""
    try:
        return Objective(objective)
    except ValueError:
        names = [o.value for o in Objective]
        raise GaitError(f"objective '{objective}' is unknown; choose one of {names}") from None


def certify(biped: Biped, request: GaitRequest, optimum: Optimum) -> DesignedGait:
    """Walk the gait and hold its first step against the limits. Raises GaitError when it misses one."""
    gait, limits = optimum.gait, request.limits.of(biped)
    longest = max(Walker.max_step_time, 2.0 * gait.period)
    walker = Walker(biped, NPDController(gait.constraint), slope=gait.slope, max_step_time=longest)
    made = walk(walker, gait, STEPS, Adaptive())
    status = made.trajectory.status
    if not status.ok:
        raise GaitError(f"the designed gait does not walk: {status.name}, {status.value}")
    certificate = made.certificates[0]
    allowed = KnownLimits(limits.friction, limits.torque, certificate.window)
    missed = certificate.violations(allowed, limits.clearance is not None)
    if missed:
        raise GaitError(f"the designed gait does not pass its certificate: {'; '.join(missed)}")
    end = made.trajectory.before(FOOT_STRIKE)[-1]
    gap = float(np.max(np.abs(end - np.concatenate((gait.q_minus, gait.v_minus)))))
    if not gap <= RETURNS:
        raise GaitError(
            f"the designed gait is left by {gap:.1e} rad or rad/s after {STEPS} steps, expected {RETURNS:g}: "
            "is its step cut short by the foot touching early?"
        )
    delta2 = ZeroDynamics.of(biped, gait.constraint).delta ** 2
    return DesignedGait(
        gait,
        request,
        optimum.objective,
        certificate,
        delta2,
        gap,
        optimum.iterations,
        optimum.seconds,
    )
