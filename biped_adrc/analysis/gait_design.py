"""Design of a gait for a speed or a step length, proved by a simulated walk before it is returned.

`gait.design` optimises on the zero dynamics and never integrates the robot. `certify` therefore simulates the
result under NPD: it has to return to its orbit within RETURNS, and its first step has to keep the limits. The
result is a `DesignedGait`, gait and proof together.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.analysis.certificate import IMPULSE, Certificate, certificates
from biped_adrc.analysis.signals import signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.control.npd import NPDController
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown, columns
from biped_adrc.engine.run import COMPILED, simulate_by
from biped_adrc.gait.design.optimise import Optimum, optimise
from biped_adrc.gait.design.request import GaitRequest, Objective, StepLimits
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.hybrid.integrators import Adaptive
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.robot_toml import ENDS, WINDOW, KnownLimits

RETURNS = 1e-6
"""Largest distance of the walk from the gait's orbit after its steps [rad, rad/s]."""
STEPS = 2
"""Steps of the walk that proves a gait."""


@dataclass(frozen=True)
class DesignedGait(Shown):
    """A designed gait, with the walk that proves it."""

    gait: Gait
    request: GaitRequest
    """The speed, step and limits that the gait was designed for."""
    objective: float
    """Value of the cost, in the units of its Objective."""
    certificate: Certificate
    """Forces and torques of its first simulated step."""
    multiplier: float
    """delta^2 of the zero dynamics."""
    gap: float
    """max |x- of the walk - x- of the gait| after STEPS steps [rad, rad/s]."""
    iterations: int
    """Iterations of IPOPT."""
    seconds: float
    """Wall time of the design [s]."""

    @property
    def speed(self) -> float:
        """Average speed along the ground [m/s]."""
        return self.certificate.step_length / self.gait.period

    def text(self) -> str:
        """A table of the results, one line per number."""
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
                f"{1e3 * c.clearance:.1f} mm, between the first and the last {100.0 * ENDS:g} % of the step",
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
    through: tuple[ArrayLike, ArrayLike] | None = None,
    degree: int = 6,
    nodes: int = 24,
    limits: StepLimits | None = None,
    curve: str = "bezier",
) -> DesignedGait:
    """Design the periodic, hybrid-invariant gait of least objective, proved by a simulated walk.

    robot: a robot, its name or the path of its robot.toml. speed: along the ground [m/s]. step: between the
    feet [m]; one of the two may be left out and is then free. slope: [rad], positive downhill. through: (q-,
    q'-), each (n,) [rad, rad/s], the state before impact that the orbit has to pass, in place of speed and
    step. curve: its kind by name, one that lies between its ends. degree: of the curves. nodes: at which
    limits are kept. Raises GaitError naming what could not be met, and KeyboardInterrupt on Ctrl-C.

    >>> design = ba.design_gait("rabbit", speed=0.7, limits=ba.StepLimits(torque=100.0))
    >>> print(f"{design.speed:.3f} m/s, peak {design.certificate.peak_torque:.1f} N m")
    0.700 m/s, peak 27.3 N m
    """
    check_part(robot, "robot", Biped, str, Path)
    biped = robot if isinstance(robot, Biped) else Biped.load(robot, preset)
    point = None if through is None else tuple(float(x) for x in np.concatenate(through))
    limits = limits or StepLimits()
    request = GaitRequest(
        speed, step, slope, Objective(objective), degree, nodes, limits, point, curve
    )
    return certify(biped, request, optimise(biped, request))


def certify(biped: Biped, request: GaitRequest, optimum: Optimum) -> DesignedGait:
    """Simulate STEPS steps of an optimised gait under NPD and check its first step against the limits.

    The simulation shares neither nodes nor quadrature with the design, only the robot; it has adaptive steps.

    Raises GaitError when the gait does not walk, violates a limit, or leaves its orbit.
    """
    gait, limits = optimum.gait, request.limits.of(biped)
    longest = max(Walker.max_step_time, 2.0 * gait.period)
    walker = Walker(biped, NPDController(gait.constraint), slope=gait.slope, max_step_time=longest)
    x, end = walker.initial_state(*gait.start(biped)), STEPS * longest
    run = simulate_by(COMPILED, walker, x, Mode(), Adaptive(), impacts=STEPS, t_end=end)
    if not run.status.ok:
        raise GaitError(f"the designed gait does not walk: {run.status.name}, {run.status.value}")
    allowed = KnownLimits(limits.friction, limits.torque, WINDOW)
    certificate = certificates(walker, run, signals(walker, run, gait.constraint), allowed)[0]
    free = {
        "scuffing": limits.clearance is None,
        IMPULSE: limits.impulse_friction > limits.friction,
    }
    missed = certificate.violations([name for name, is_free in free.items() if is_free])
    if missed:
        raise GaitError(f"the designed gait does not pass its certificate: {'; '.join(missed)}")
    before = run.before(FOOT_STRIKE)[-1]
    gap = float(np.max(np.abs(before - np.concatenate((gait.q_minus, gait.v_minus)))))
    if not gap <= RETURNS:
        raise GaitError(
            f"the designed gait is left by {gap:.1e} rad or rad/s after {STEPS} steps, expected {RETURNS:g}: "
            "is its step cut short by the foot touching early?"
        )
    delta2 = ZeroDynamics.of(biped, gait.constraint).delta ** 2
    effort = optimum.iterations, optimum.seconds
    return DesignedGait(gait, request, optimum.objective, certificate, delta2, gap, *effort)
