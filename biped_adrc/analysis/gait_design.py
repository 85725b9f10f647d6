"""Design of a gait for a speed or a step length, proved by a simulated walk before it is returned.

`gait.design` optimises on the zero dynamics, the motion of the robot on the gait's curves without an error, and
never integrates the robot. `certify` therefore simulates the result under NPD, the paper's PD controller with
feedback linearisation: it has to return to its orbit within RETURNS, and its first step has to keep the limits.
The result is a `DesignedGait`, gait and proof together.

A family gives a gait for every speed and step length within a range. It is made of a library and two fits.

    library    one gait for each pair of speed and step length, by `optimise`, with limits that leave a reserve,
               and for rough ground where that is asked for
    curves     coefficients and Theta of the library as polynomials of degree 4 in (v, L)
    steps      2 W, J and delta^2 of random steps of the family, by quadrature, as polynomials of degree 4,
               and sigma^2 of the periodic walks by their mean speed, of degree 6

    v, L           speed [m/s] and step length [m]; a member of the family is the gait of one pair (v, L)
    Theta          phase of a gait, Theta = c q [rad]; Theta+ where a step begins, Theta- where it ends
    h(Theta)       the angles q_b (p,) [rad] of the joints with motors; the pitch q_N has no motor
    sigma          angular momentum about the stance foot [kg m^2/s]
    delta          sigma after an impact over sigma before it; delta^2 is the multiplier of a periodic gait
    I              sigma / Theta' on the curve [kg m^2]; G_N gravity's torque on the pitch [N m]
    W, J           int -G_N I dTheta, the work of gravity on sigma^2 / 2, and int I dTheta (`_integrals`)

A step goes from the member that ended the step before to another one, which is chosen during the step, at its
share DECISION in Theta (`control.footstep`). Integrals over Theta take the place of its simulation.
"""

import itertools
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.analysis.certificate import IMPULSE, Certificate, certificates
from biped_adrc.analysis.rough_ground import RoughGround, rough_ground
from biped_adrc.analysis.signals import signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.control.footstep import StepCurve, step_reset
from biped_adrc.control.npd import NPDController
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown, columns
from biped_adrc.core.types import Array
from biped_adrc.engine.program import COMPILED
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.constraint import VirtualConstraint, continued
from biped_adrc.gait.design.optimise import Optimum, optimise
from biped_adrc.gait.design.request import GaitRequest, Objective, StepLimits
from biped_adrc.gait.family import DECISION, GaitFamily, PolynomialMap, StepMap
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import JointCurve, ZeroDynamics, configuration, gauss_nodes
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.limits import ENDS, WINDOW, KnownLimits, Limits

RETURNS = 1e-6
"""Largest distance of the walk from the gait's orbit after its steps [rad, rad/s]."""
SHORT = 1e-3
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
            ("foot clearance", f"{1e3 * c.clearance:.1f} mm, {within}"),
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
    if not (1.0 - SHORT) * limits.rough <= H:
        raise GaitError(
            f"no gait with {request.in_words()} was found; the largest height found is {1e3 * H:.1f} mm, where "
            f"the limit '{cause}' stops it: ask for less height, or a slower or shorter step"
        )
    return rough


RESERVE = StepLimits(friction=0.5, impulse_friction=0.5, torque=130.0, clearance=0.08, lift_off=0.5)
"""Limits of the library. A step between two members asks for more friction and torque than the members do."""
STEEPEST = 0.08
"""Largest H of a gait of the library as a share of its step length [1]."""
CURVE_DEGREE, STEP_DEGREE, CYCLE_DEGREE = 4, 4, 6
"""Degrees of the polynomials."""
OF_LIBRARY = ("method", "curves", "minimised", "limits")
"""Entries of a gait's provenance that are the same for all gaits of the library."""
_SAMPLES, _GRID = 1200, 11
"""Number of random walking steps to which `StepMap` is fitted, and of speeds and of lengths of cycles; both
count the same."""
_NODES = 16
"""Number of Gauss nodes of each part of a step, before and after the decision (`control.footstep`)."""


def library(
    biped: Biped,
    speeds: Sequence[float],
    lengths: Sequence[float],
    limits: StepLimits = RESERVE,
    done: Callable[[str], None] = lambda text: None,
) -> list[tuple[float, float, Gait]]:
    """Speed [m/s], step length [m] and the gait of least torque, for each pair that has one.

    The pairs are all of a speed in `speeds` [m/s] and a length in `lengths` [m]. done: is called after each
    pair with a line of text about it. Raises GaitError where fewer pairs have a gait than the fit needs.
    """
    # least: number of coefficients of a polynomial in two variables of this degree
    # CURVE_DEGREE, of the polynomials in speed and step length
    least, gaits = (CURVE_DEGREE + 1) * (CURVE_DEGREE + 2) // 2, []
    if min(len(set(speeds)), len(set(lengths))) <= CURVE_DEGREE:
        raise GaitError(
            f"the family has {len(set(speeds))} speeds and {len(set(lengths))} lengths, expected at least "
            f"{CURVE_DEGREE + 1} of both"
        )
    for v, L in itertools.product(speeds, lengths):
        try:
            gait, H = _in_library(biped, v, L, limits)
        except GaitError as error:
            done(f"{v:g} m/s, {L:g} m: none, {error}")
            continue
        gaits.append((v, L, gait))
        borne = f", rough ground of {1e3 * H:.3g} mm" if limits.rough else ""
        done(f"{v:g} m/s, {L:g} m: {gait.period:.3f} s{borne}")
    if len(gaits) < least:
        raise GaitError(
            f"{len(gaits)} of {len(speeds)} x {len(lengths)} pairs of speed and step length have a gait; "
            f"a family needs at least {least}"
        )
    return gaits


def _in_library(biped: Biped, v: float, L: float, limits: StepLimits) -> tuple[Gait, float]:
    """The gait of the library for v [m/s] and L [m], and H [m] of the rough ground that it was designed for:
    that of the limits, or STEEPEST times L if that is less; 0 where no gait bears it.
    """
    H = min(limits.rough, STEEPEST * L)
    if H:
        with suppress(GaitError):
            found = optimise(biped, GaitRequest(v, L, limits=replace(limits, rough=H)))
            if found.height >= H:
                return found.gait, H
    return optimise(biped, GaitRequest(v, L, limits=replace(limits, rough=0.0))).gait, 0.0


def design_family(
    name: str,
    biped: Biped,
    gaits: Sequence[tuple[float, float, Gait]],
    provenance: Mapping[str, object],
    seed: int = 0,
) -> GaitFamily:
    """The family fitted to a library of gaits, (v, L, gait) as `library` returns them.

    name: of the family. provenance: how the library was made, beside what its gaits say. seed: of the random
    steps. Raises GaitError where a member that was designed has no periodic walk in the family.
    """
    # a row of y: all coefficients of the curve, Theta+, Theta-
    mu, first = np.array([(v, L) for v, L, _ in gaits]), gaits[0][2].provenance
    constraints = [gait.constraint for _, _, gait in gaits]
    y = [(*c.curve.coefficients.ravel(), c.theta_plus, c.theta_minus) for c in constraints]
    curves = PolynomialMap.fit(mu, np.array(y), CURVE_DEGREE)
    # a placeholder: the functions below need the family's curves alone, and give its real `steps`
    empty = PolynomialMap(((0,),), np.zeros((1, 1)), np.zeros(1), np.ones(1))
    family = GaitFamily(
        name,
        biped.description.name,
        biped.preset,
        curves,
        StepMap(empty, empty, empty),
        constraints[0].phase,
        mu.min(axis=0),
        mu.max(axis=0),
        # OF_LIBRARY: entries that are the same for all gaits
        provenance={**{k: first[k] for k in OF_LIBRARY}, **provenance},
    )
    # _member: v and L with the friction, peak torque and least F_N of the periodic step
    members = tuple(_member(biped, v, L, family.member(v, L)) for v, L, _ in gaits)
    random, low, high = np.random.default_rng(seed), family.low, family.high
    # a row of `ends` is a random pair of steps, the arguments of `step_integrals`: speed v and length L of the
    # member at the impact between them, length `before` of the step before both, speed `end` and length
    # `ahead` of the member that ends the second step; low and high are ends of the ranges (speed, length)
    # _SAMPLES random steps, and those of the periodic walks, which decide on the speed that is held
    grid = itertools.product(*(np.linspace(*ends, _GRID) for ends in zip(low, high, strict=True)))
    cycles = [cycle for v, L in grid if (cycle := _cycle(biped, family, v, L))]
    periodic = np.array([(v, L, L, v, L) for v, L, *_ in cycles])
    ends = random.uniform((*low, low[1], *low), (*high, high[1], *high), (_SAMPLES, 5))
    ends = np.concatenate((ends, np.repeat(periodic, 1 + _SAMPLES // len(periodic), axis=0)))
    steps = np.array([step_integrals(biped, family, *x) for x in ends])
    v, before, L, end, ahead = ends.T
    # columns of steps: delta^2 of the impact, 2 W', J' from it to the second step's decision, dq_b/dTheta after
    # it; the last two are 2 W, J from that decision to the second step's own impact
    to_impact = PolynomialMap.fit(np.column_stack((v, end, L, ahead)), steps[:, -2:], STEP_DEGREE)
    earlier = np.column_stack((v, before, L, ahead))
    to_decision = PolynomialMap.fit(earlier, steps[:, :-2], STEP_DEGREE)
    _, L, speed, y = np.transpose(cycles)
    of_cycle = PolynomialMap.fit(np.column_stack((speed, L)), y[:, np.newaxis], CYCLE_DEGREE)
    return replace(family, steps=StepMap(to_impact, to_decision, of_cycle), members=members)


def _cycle(biped: Biped, family: GaitFamily, v: float, L: float) -> tuple[float, ...]:
    """v, L, mean speed [m/s], and sigma^2 at the decision of the periodic walk on the member; () for none."""
    delta2, twice_W_next, *_, twice_W, _ = step_integrals(biped, family, v, L, L, v, L)
    try:
        period = ZeroDynamics.of(biped, family.member(v, L)).cycle.period
    except GaitError:
        return ()
    return v, L, L / period, (delta2 * twice_W + twice_W_next) / (1.0 - delta2)


def step_integrals(
    biped: Biped, family: GaitFamily, v: float, before: float, L: float, end: float, ahead: float
) -> Array:
    """The numbers of two steps in a row: delta^2, 2 W', J', dq_b/dTheta (p,), 2 W, J, together (p + 5,).

    The first step is L [m] long, follows one of length `before` [m], and ends on the member (v [m/s], L); delta
    is of its impact. The second step begins with dq_b/dTheta just after that impact, on the member (v, ahead
    [m]), and ends on the member (end [m/s], ahead). W [kg^2 m^4/s^2] and J [kg m^2] are those of `_integrals`
    of the second step: with ' from its start to its decision, without from there to its end.
    """
    c, p, mu = family.phase, biped.p, np.array((v, L))
    # plus, minus: Theta at the start and end of the first step; the step before it ended on `earlier`.
    # configuration(..)[:2] are q and dq/dTheta on a curve; `relabel` exchanges stance and swing leg in q
    earlier = family.member(v, before)
    plus = float(c @ biped.relabel(configuration(c, earlier.h, earlier.theta_minus)[0]))
    # curve()[2] is Theta-, h(mu, Theta+, Theta) the member's curve in a step that begins at Theta+
    minus = family.curve(mu)[2]
    q, dq, _ = configuration(c, lambda theta: family.h(mu, plus, theta), minus)
    # q' at |Theta'| = 1 rad/s, in the sense in which Theta runs; delta does not depend on the speed
    v_minus = np.sign(minus - plus) * dq
    impact = biped.impact(q, v_minus)
    delta = biped.angular_momentum(impact.q, impact.v) / biped.angular_momentum(q, v_minus)
    # the second step: it begins at Theta = start with `slope` = dq_b/dTheta, `reset` blends that into the curve
    start = float(c @ impact.q)
    slope = impact.v[:p] / float(c @ impact.v)
    reset = step_reset(family, np.array((v, ahead)), start, impact.q[:p], slope)
    curve = StepCurve(family, v, end, ahead, start, reset)
    decision = start + DECISION * (family.curve(np.array((v, ahead)))[2] - start)
    first = _integrals(biped, c, curve, start, decision)
    last = _integrals(biped, c, curve, decision, family.curve(np.array((end, ahead)))[2])
    return np.array((delta**2, *first, *slope, *last))


def _integrals(
    biped: Biped, c: Array, curve: JointCurve, start: float, end: float
) -> tuple[float, float]:
    """2 W = -2 int G_N I dTheta [kg^2 m^4/s^2] and J = int I dTheta [kg m^2], Theta from start to end [rad].

    c (n,): Theta = c q. G_N is gravity's torque on the unactuated row, and sigma = I(Theta) Theta' on the
    curve.
    """
    # s, weights: on [0, 1]; `inertia` is I = D_N dq/dTheta, D_N the row of the pitch in the inertia matrix
    # _NODES: number of Gauss nodes
    s, weights, _ = gauss_nodes(_NODES)
    W = J = 0.0
    for theta, weight in zip(start + (end - start) * s, (end - start) * weights, strict=True):
        q, dq, _ = configuration(c, curve, float(theta))
        inertia = float(biped.inertia(q)[-1] @ dq)
        W -= weight * inertia * float(biped.gravity(q)[-1])
        J += weight * inertia
    return 2.0 * W, J


def _member(biped: Biped, v: float, L: float, h: VirtualConstraint) -> tuple[float, ...]:
    """(v, L, friction, peak torque [N m], least F_N [N]) of the periodic step of the member (v, L).

    h: the member's constraint.
    """
    orbit = ZeroDynamics.of(biped, h).cycle
    # at the nodes of the orbit, on level ground
    F_T, F_N = orbit.ground_reaction.T
    numbers = np.max(np.abs(F_T) / F_N), np.max(np.abs(orbit.u)), np.min(F_N)
    return (v, L, *(round(float(x), 3) for x in numbers))
