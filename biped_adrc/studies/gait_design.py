"""Design of a gait for a speed or a step length, proved by a simulated walk before it is returned.

`gait.design` optimises on the zero dynamics and never integrates the robot. `certify` therefore walks the
result under NPD: it has to come back to its orbit within RETURNS, and its first step has to keep the limits.
What is returned is a `DesignedGait`, gait and proof together.

Besides: libraries of gaits over speed, one readable file each (`GaitLibrary`), and gait (b) of the paper as it
walks (`design_recipe_orbit`): the fixed point of the closed loop, since its impact leaves the constraint.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from biped_adrc.analysis.certificate import IMPULSE, Certificate
from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.columns import columns
from biped_adrc.control.npd import NPDController
from biped_adrc.errors import GaitError, InputError, SimulationError
from biped_adrc.files import read_json
from biped_adrc.gait.design.ipopt import IpoptProgress
from biped_adrc.gait.design.optimise import Optimum, optimise
from biped_adrc.gait.design.request import GaitRequest, Objective, StepLimits
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.gait.recipe import design_recipe_gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.hybrid.integrators import RK4, Adaptive
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.limits import ENDS, KnownLimits
from biped_adrc.parts import check_part
from biped_adrc.scenario.walk import walk
from biped_adrc.shown import Shown
from biped_adrc.types import Array

RETURNS = 1e-6
"""Largest distance of the walk from the gait's orbit after its steps [rad, rad/s]."""
STEPS = 2
"""Steps of the walk that proves a gait."""


@dataclass(frozen=True)
class DesignedGait(Shown):
    """A designed gait, with the walk that proves it."""

    gait: Gait
    request: GaitRequest
    """What was asked for."""
    objective: float
    """Value of the cost, in the units of its Objective."""
    certificate: Certificate
    """What its first simulated step asks of ground and motors."""
    multiplier: float
    """delta^2 of the zero dynamics."""
    gap: float
    """max |x- of the walk - x- of the gait| after its steps [rad, rad/s]."""
    iterations: int
    """Of IPOPT."""
    seconds: float
    """Wall time of the design [s]."""

    @property
    def speed(self) -> float:
        """Average speed along the ground [m/s]."""
        return self.certificate.step_length / self.gait.period

    def text(self) -> str:
        """A table of what was found, one line per number."""
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
    through: tuple[Array, Array] | None = None,
    degree: int = 6,
    nodes: int = 24,
    limits: StepLimits | None = None,
    curve: str = "bezier",
    progress: IpoptProgress | None = None,
) -> DesignedGait:
    """The periodic, hybrid-invariant gait of least objective, proved by a simulated walk.

    robot: a robot, its name or the path of its robot.toml. speed: along the ground [m/s]. step: between the
    feet [m]; one of the two may be left out and is then free. slope: [rad], positive downhill. through: (q-,
    q'-), each (n,) [rad, rad/s], which the orbit has to pass in place of speed and step. curve: its kind by
    name, one that lies between its ends. degree: of the curves. nodes: at which limits are kept. progress:
    called after each iteration of IPOPT. Raises GaitError naming what could not be met.
    """
    check_part(robot, "robot", Biped, str, Path)
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
        curve,
    )
    return certify(biped, request, optimise(biped, request, progress))


def objective_named(objective: Objective | str) -> Objective:
    """The objective of a name. Raises GaitError for a name that is none."""
    try:
        return Objective(objective)
    except ValueError:
        names = [o.value for o in Objective]
        raise GaitError(f"objective '{objective}' is unknown; choose one of {names}") from None


def certify(biped: Biped, request: GaitRequest, optimum: Optimum) -> DesignedGait:
    """Walk an optimised gait for STEPS steps under NPD and compare its first step with the limits.

    The simulation shares neither nodes nor quadrature with the design, only the robot; it has adaptive steps.

    Raises GaitError when it does not walk, violates a limit, or leaves the gait's orbit.
    """
    gait, limits = optimum.gait, request.limits.of(biped)
    longest = max(Walker.max_step_time, 2.0 * gait.period)
    walker = Walker(biped, NPDController(gait.constraint), slope=gait.slope, max_step_time=longest)
    made = walk(walker, gait, STEPS, Adaptive())
    status = made.trajectory.status
    if not status.ok:
        raise GaitError(f"the designed gait does not walk: {status.name}, {status.value}")
    certificate = made.certificates[0]
    allowed = KnownLimits(limits.friction, limits.torque, certificate.window)
    free = {
        "scuffing": limits.clearance is None,
        IMPULSE: limits.impulse_friction > limits.friction,
    }
    missed = certificate.violations(allowed, [name for name, is_free in free.items() if is_free])
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
    effort = optimum.iterations, optimum.seconds
    return DesignedGait(gait, request, optimum.objective, certificate, delta2, gap, *effort)


MOST_SPEEDS = 1000
"""Largest number of speeds in a range FIRST:LAST:STEP."""


@dataclass(frozen=True)
class GaitLibrary(Shown):
    """Gaits of one robot and preset over speed.

    Gaits are not interpolated: a mean of two hybrid-invariant constraints is not hybrid-invariant in general,
    so a speed is served by the nearest gait.
    """

    gaits: Mapping[float, Gait]
    """By average speed [m/s]; sorted, slowest first."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "gaits", dict(sorted(self.gaits.items())))

    @property
    def speeds(self) -> tuple[float, ...]:
        """Average speeds of the gaits [m/s], slowest first."""
        return tuple(self.gaits)

    def nearest(self, speed: float) -> Gait:
        """The gait whose speed is nearest to `speed` [m/s]."""
        return self.gaits[min(self.gaits, key=lambda known: abs(known - speed))]

    @classmethod
    def load(cls, folder: Path | str, biped: Biped) -> GaitLibrary:
        """The gaits of a folder that are of this robot and preset.

        Raises GaitError for none, or a damaged file.
        """
        gaits = {}
        for path in sorted(Path(folder).glob(f"*-{biped.preset}.json")):
            if _robot_of(path) == biped.description.name:
                gait = load_gait(path, biped)
                gaits[speed_of(gait, biped)] = gait
        if not gaits:
            raise GaitError(
                f"folder '{folder}' has no gait of robot '{biped.description.name}', preset "
                f"'{biped.preset}'; 'biped-adrc gait design --speeds' writes them"
            )
        return cls(gaits)


def _robot_of(path: Path) -> str:
    """Name of the robot in a gait file; empty where the file has none or cannot be read."""
    try:
        return str(read_json(path, "gait file").get("robot", ""))
    except (InputError, AttributeError):
        return ""


def speed_of(gait: Gait, biped: Biped) -> float:
    """Average speed of a gait along the ground [m/s]: distance of the feet before impact over the period."""
    return float(np.hypot(*biped.swing_foot(gait.q_minus)) / gait.period)


def speeds_named(text: str) -> tuple[float, ...]:
    """Speeds [m/s] from "0.4,0.5" or "0.4:1.1:0.1", the last one counted where it is met. Raises InputError."""
    try:
        if ":" in text:
            first, last, by = (float(word) for word in text.split(":"))
            if not (by > 0.0 and last >= first and (last - first) / by < MOST_SPEEDS):
                raise ValueError
            count = math.floor((last - first) / by + 1e-9) + 1
            return tuple(round(first + k * by, 9) for k in range(count))
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise InputError(
            f"speeds are '{text}', expected numbers as '0.4,0.5,0.6' or FIRST:LAST:STEP as '0.4:1.1:0.1' [m/s]"
        ) from None


SETTLE = 25
"""Impacts that are walked before Newton's method starts."""


def design_recipe_orbit(biped: Biped) -> Gait:
    """Gait (b) with the pre-impact state and the period of its walking cycle under NPD.

    Its impact leaves the constraint, so the closed loop does not walk on the orbit of the zero dynamics. A walk
    settles near the cycle, from where Newton's method on the return map finds it. When there is none the state
    of the zero dynamics is kept, and the provenance says so. Raises GaitError as `design_recipe_gait`.
    """
    gait = design_recipe_gait(biped)
    walker = Walker(biped, NPDController(gait.constraint))
    settled = walk(walker, gait, SETTLE, RK4(1e-3))
    try:
        if not settled.trajectory.status.ok:
            raise SimulationError(settled.trajectory.status.value)
        guess = settled.trajectory.before(FOOT_STRIKE)[-1]
        orbit = ReturnMap(walker, RK4(1e-3)).fixed_point(guess)
    except SimulationError as error:
        return replace(gait, provenance={**gait.provenance, "cycle": f"none found: {error}"})
    q, v = np.split(orbit.x_minus[: 2 * biped.n], 2)
    said = "fixed point of the return map under NPD, Table II, continuous time; largest multiplier"
    told = {**gait.provenance, "cycle": f"{said} {abs(orbit.multipliers[0]):.4f}"}
    found = replace(gait, q_minus=q, v_minus=v, provenance=told)
    step = walk(walker, found, 1, RK4(1e-3))
    return replace(found, period=step.trajectory.t_end)
