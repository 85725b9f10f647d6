"""Design of a gait for a speed or a step length, proved by a simulated walk before it is returned.

`gait.design` optimises on the zero dynamics, the motion of the robot on the gait's curves without an error, and
never integrates the robot. `certify` therefore simulates the result under NPD, the paper's PD controller with
feedback linearisation: it has to return to its orbit within RETURNS, and its first step has to keep the limits.
The result is a `DesignedGait`, gait and proof together.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.analysis.certificate import IMPULSE, Certificate, certificates
from biped_adrc.analysis.rough_ground import RoughGround, rough_ground
from biped_adrc.analysis.signals import signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.control.npd import NPDController
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown, columns
from biped_adrc.engine.program import COMPILED
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.constraint import continued
from biped_adrc.gait.design.optimise import Optimum, optimise
from biped_adrc.gait.design.request import GaitRequest, Objective, StepLimits
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ENDS, WINDOW, KnownLimits, Limits

RETURNS = 1e-6
"""Largest distance of the walk from the gait's orbit after its steps [rad, rad/s]."""
SHORTFALL = 1e-3
"""Share [1] by which H may fall short of the height that is asked for."""
_STEPS = 2
"""Steps of the walk that proves a gait."""
_H = 2.5e-4
"""Integration step of that walk [s]."""


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
    """delta^2 of the zero dynamics, by which a deviation of sigma-^2 is multiplied in each step [1]."""
    gap: float
    """max |x- of the walk - x- of the gait| after two steps [rad, rad/s], x- the state before impact."""
    iterations: int
    """Iterations of IPOPT."""
    seconds: float
    """Wall time of the design [s]."""
    rough: RoughGround | None = None
    """How rough a ground the gait bears, where that is asked for."""
    level: tuple[float, float] | None = None
    """Objective and speed [m/s] of the same request without rough ground."""

    @property
    def speed(self) -> float:
        """Average speed along the ground [m/s]."""
        return self.certificate.step_length / self.gait.period

    def text(self) -> str:
        """A table of the results, one line per number."""
        c, o = self.certificate, self.request.objective
        unit = {"torque": " N^2 m s", "transport": "", "peak": " N m"}[o.value]
        within = f"between the first and the last {100.0 * ENDS:g} % of the step"
        rows: list[tuple[str, ...]] = [
            ("speed", f"{self.speed:.6f} m/s"),
            ("step length", f"{c.step_length:.6f} m"),
            ("period", f"{self.gait.period:.6f} s"),
            (f"least {o.value}", f"{self.objective:.6g}{unit}"),
            ("delta^2", f"{self.multiplier:.6f}"),
            ("peak torque", f"{c.peak_torque:.2f} N m"),
            ("friction", f"{c.friction:.3f}, of the impulse {c.impulse_ratio:.3f}"),
            ("least F_N", f"{c.least_normal_force:.1f} N"),
            # to 1 um: the foot of legs without knees is within some of the ground; + 0.0 turns -0.0 into 0.0
            ("foot clearance", f"{round(1e3 * c.clearance, 3) + 0.0:g} mm at the least, {within}"),
            ("cost of transport", f"{c.cost_of_transport:.4f}"),
            *self._rough_rows(unit),
            (f"walked {_STEPS} steps under NPD, back within {self.gap:.1e}",),
            (f"designed in {self.seconds:.1f} s, {self.iterations} iterations",),
        ]
        return "\n".join(columns(rows, 19))  # 19: least width of the first column

    def _rough_rows(self, unit: str) -> list[tuple[str, str]]:
        """Rows of the table: what the gait bears, and the cost without that; unit: of the objective."""
        if self.rough is None or self.level is None:
            return []
        value, speed = self.level
        cost = f"{value:.6g}{unit} at {speed:.6f} m/s"
        return [("H on rough ground", str(self.rough.reach())), ("without rough ground", cost)]


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

    - robot: a robot, its name, or the path of its robot.toml; preset: of its parameters, by name.
    - speed [m/s]: along the ground. step [m]: between the feet. One of the two may be left out and is free.
    - slope [rad]: of the ground, positive downhill.
    - objective: the cost that is minimised, "torque", "transport" or "peak".
    - through: (q-, q'-), each (n,) [rad, rad/s], the state before impact that the orbit has to pass, in place
      of speed and step.
    - degree: of the curves, 4 to 12. nodes: the number of Gauss nodes at which limits are kept, 8 to 100.
    - limits: what the step must keep; None: `StepLimits()`.
    - curve: its kind by name, one that begins at its first coefficient and ends at its last one.

    Raises GaitError naming what could not be met, and KeyboardInterrupt on Ctrl-C.

    >>> design = ba.design_gait("three_link", speed=0.7, limits=ba.StepLimits(clearance=None))
    >>> print(f"{design.speed:.3f} m/s, peak {design.certificate.peak_torque:.1f} N m")
    0.700 m/s, peak 14.7 N m
    """
    check_part(robot, "robot", Biped, str, Path)
    biped = robot if isinstance(robot, Biped) else Biped.load(robot, preset)
    point = None if through is None else tuple(float(x) for x in np.concatenate(through))
    limits, cost = limits or StepLimits(), Objective(objective)
    request = GaitRequest(speed, step, slope, cost, degree, nodes, limits, point, curve)
    return certify(biped, request, optimise(biped, request))


def certify(biped: Biped, request: GaitRequest, optimum: Optimum) -> DesignedGait:
    """Simulate two steps of an optimised gait under NPD and check its first step against the limits.

    NPD is the paper's feedback linearisation with PD. optimum: the result of `optimise`. The simulation shares
    neither nodes nor quadrature with the design, only the robot.

    Raises GaitError when the gait does not walk, violates a limit, leaves its orbit, or does not bear the rough
    ground.
    """
    gait, limits = optimum.gait, request.limits.of(biped)
    # longest: time limit of one single support [s]
    longest = max(Walker.max_step_time, 2.0 * gait.period)
    walker = Walker(biped, NPDController(gait.constraint), slope=gait.slope, max_step_time=longest)
    # _STEPS: steps of the walk that proves the gait
    x, end = walker.initial_state(*gait.start(biped)), _STEPS * longest
    run = simulate_by(COMPILED, walker, x, Mode(), RK4(_H), impacts=_STEPS, t_end=end)
    if not run.status.ok:
        raise GaitError(f"the designed gait does not walk: {run.status.name}, {run.status.value}")
    # WINDOW, over which the force of the ground is averaged
    allowed = KnownLimits(limits.friction, limits.torque, WINDOW)
    certificate = certificates(walker, run, signals(walker, run, gait.constraint), allowed)[0]
    # reasons that do not count: scuffing where the request sets no clearance, and an impulse that the request
    # allows more friction than the certificate, which has one mu for both
    free = ["scuffing"] if limits.clearance is None else []
    free += [IMPULSE] if limits.impulse_friction > limits.friction else []
    missed = certificate.violations(free)
    if missed:
        raise GaitError(f"the designed gait does not pass its certificate: {'; '.join(missed)}")
    # the state (q, q') before the last impact; NPD has no states of its own
    before = run.before(FOOT_STRIKE)[-1]
    gap = float(np.max(np.abs(before - np.concatenate((gait.q_minus, gait.v_minus)))))
    if not gap <= RETURNS:
        raise GaitError(
            f"the designed gait is left by {gap:.1e} rad or rad/s after {_STEPS} steps, expected {RETURNS:g}: "
            "is its step cut short by the foot touching early?"
        )
    delta2 = ZeroDynamics.of(biped, gait.constraint).delta ** 2
    effort, rough = (optimum.iterations, optimum.seconds), _certify_rough(biped, gait, request)
    proof = certificate, delta2, gap, *effort, rough, optimum.level
    return DesignedGait(gait, request, optimum.objective, *proof)


def _certify_rough(biped: Biped, gait: Gait, request: GaitRequest) -> RoughGround | None:
    """How rough a ground a designed gait bears with ReferenceReset; None where none is asked for.

    Raises GaitError where that is less than asked for, with the largest height found and what stops it.
    """
    limits = request.limits.of(biped)
    if not limits.rough:
        return None
    law = ReferenceReset(NPDController(continued(gait.constraint)))
    judged = Limits(limits.friction, limits.torque)
    rough = rough_ground(Walker(biped, law), gait, judged, forces=())
    # an impulse that the request allows more friction does not count
    free = (IMPULSE,) if limits.impulse_friction > limits.friction else ()
    H, cause = rough.reach(but=free)
    if not (1.0 - SHORTFALL) * limits.rough <= H:
        raise GaitError(
            f"no gait with {request.in_words()} was found; the largest height found is {1e3 * H:.1f} mm, where "
            f"the limit '{cause}' stops it: ask for less height, or a slower or shorter step"
        )
    return rough
