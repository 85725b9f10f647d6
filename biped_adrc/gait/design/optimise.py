"""Design of a gait: solve the nonlinear programme with IPOPT from a cold start, then make the result exact.

`optimise` goes from an easy programme to the one asked for; each solution is the first guess of the next one:

    cold start -> least torque, level ground -> least torque, slope -> the objective asked for

IPOPT meets the equations to about 1e-9. The Gait that is returned is therefore built anew from q-, the slopes
and the free coefficients alone (`exact_gait`): impact and zero dynamics are Pinocchio's, so that the constraint
is hybrid-invariant and the orbit periodic to round-off.

The programme keeps its limits at its Gauss nodes (phases of the step) only. `audit` evaluates the same rows
for the exact gait at many more; if one is missed there, the programme is solved once more with twice the
nodes. A programme without a solution ends in `nlp.relaxed`, which names the limits that contradict each
other. `analysis.gait_design` calls `optimise` and then walks the gait in simulation.

*The cold start* comes, for any planar biped, from its geometry alone.

1. `standing`: legs stretched, every other link upwards. 2. `apart`: least squares moves the feet apart by the
step length, the hip half way between, joints inside their ranges. 3. `cold_start`: rates that lead evenly from
the start of the step, the relabelled pose, to its end, the pose of 2.; the impact there; and Bezier curves
through both ends with their slopes.

A request through a given state takes the pose and the rates of that state in place of 1. and 2. Speeds and
steps out of reach of the legs are refused here, before IPOPT runs.

IPOPT finds a local optimum near its guess, so the guess decides which gait is found: knees bent the usual way,
feet on the ground, the hip between them, and no leg wound round by 2 pi. The guess need not be periodic or keep
any limit.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from time import perf_counter

import casadi as ca
import numpy as np
from scipy.optimize import least_squares

from biped_adrc.core.errors import GaitError
from biped_adrc.core.types import Array
from biped_adrc.gait.design import nlp
from biped_adrc.gait.design.request import GaitRequest, Objective, RobotLimits
from biped_adrc.gait.design.rough import HIGHEST
from biped_adrc.gait.design.step import Unknowns, at_gait, stacked
from biped_adrc.gait.gait import Gait, onto_section
from biped_adrc.gait.zero_dynamics import ZeroDynamics, ZeroDynamicsOrbit, invariant_constraint
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.planar import point, turned
from biped_adrc.model.planar_robot import PlanarRobot, robot_of

MOVED = 1e-3
"""Largest change of a joint by which a requested state is moved onto the ground [rad]."""
_STEP = 0.5
"""For a request without them: step length of the guess over the leg length, and speed over sqrt(g leg)."""


def standing(robot: PlanarRobot) -> Array:
    """Configuration (n,) with both legs stretched downwards and all other links upwards [rad].

    In the plane as complex numbers, a point lies at sum_i d_i exp(i a_i) from the stance foot, with the
    absolute angles a = A q of the links and vectors d_i that `robot.K` has for the swing foot and the hip. So
    each link is turned until its vector points upwards. Angles are kept in (-pi, pi].
    """
    K = robot.K  # foot, hip: vectors d of the two points; w: mass moments of the links [kg m]
    foot, hip, w = K.foot_re + 1j * K.foot_im, K.hip_re + 1j * K.hip_im, K.w_re + 1j * K.w_im
    leg = foot - hip
    # d of a link of the stance leg (towards the hip), of the swing leg (from foot to hip), else its mass moment
    vector = np.where(np.abs(hip) > 0, hip, np.where(np.abs(leg) > 0, -leg, w))
    a = np.pi / 2 - np.angle(vector)
    # into (-pi, pi]; round-off may leave -pi, which becomes pi
    a = np.pi - np.mod(np.pi - a, 2.0 * np.pi)
    a = np.where(np.abs(a + np.pi) < 1e-9, np.pi, a)
    return np.asarray(np.linalg.solve(robot.A, a), dtype=np.float64)


def apart(
    biped: Biped, step: float, slope: float, ranges: Mapping[str, tuple[float, float]]
) -> Array:
    """Pre-impact configuration (n,) [rad] with the swing foot `step` [m] ahead on ground of `slope` [rad],
    found by least squares.

    The foot's distance from its place weighs most, then that of the hip from half way between the feet, then
    that of the angles from `standing`. ranges: (low, high) [rad] by joint, kept as bounds.
    """
    robot = robot_of(biped)
    near, K = standing(robot), robot.K
    target = step * ground_axes(slope)[0]  # place of the swing foot (x, z) [m], along the ground
    bounds = np.full((2, biped.n), np.inf) * [[-1.0], [1.0]]
    for joint, (low, high) in ranges.items():
        k = biped.description.joint_index(joint)
        bounds[:, k] = low, high
        # the first guess is 0.2 rad inside, or a quarter of the range where that is less: at a bound it would
        # have only one direction to move in
        off = min(0.2, 0.25 * (high - low))
        near[k] = np.clip(near[k], low + off, high - off)

    def miss(q: Array) -> Array:
        """Weighted residuals (n + 3,): of foot (2,) and hip (x alone) [m], and of the angles (n,) [rad].

        The foot, to be at `target`, counts most; then the hip, to be half way; least that the angles stay near
        those of the first guess, `near`.
        """
        t = turned(robot.A, q)
        foot, hip = np.array(point(t, K.foot_re, K.foot_im)), point(t, K.hip_re, K.hip_im)
        off = 10.0 * (foot - target), [3.0 * (hip[0] - 0.5 * step)], 0.1 * (q - near)
        return np.concatenate(off)

    return least_squares(miss, near, bounds=bounds).x


def _given_state(biped: Biped, state: Array, slope: float) -> tuple[Array, Array]:
    """(q-, q'-), each (n,), of a requested state (2 n,) [rad, rad/s], with the swing foot of q- put onto ground
    of `slope` [rad], by a change of at most MOVED [rad].

    Raises GaitError for a state that is not just before the impact of a walk forwards.
    """
    n, c = biped.n, biped.phase
    if len(state) != 2 * n:
        raise GaitError(f"the state to pass through has {len(state)} numbers, expected {2 * n}")
    q = onto_section(biped, state[:n], slope)
    moved = float(np.max(np.abs(q - state[:n])))
    # Theta- less Theta+, and Theta'-, which have one sign where Theta runs forwards
    span, rate = float(c @ (q - biped.relabel(q))), float(c @ state[n:])
    if not (moved <= MOVED and span * rate > 0.0):
        raise GaitError(
            f"q of the state to pass through is {moved:.3g} rad from one with the swing foot on the ground, "
            f"Theta changes by {span:.4g} rad over the step, and its rate is {rate:.4g} rad/s; expected at "
            f"most {MOVED:g} rad, and one sign: the state just before the impact of a walk forwards"
        )
    return q, state[n:]


def cold_start(biped: Biped, request: GaitRequest, limits: RobotLimits) -> Unknowns[Array]:
    """First guess of the unknowns of a request, by the module's steps 1 to 3.

    The rate |Theta'| is constant over the step: the span of Theta over the duration that follows from speed
    and step. Raises GaitError for a speed or a step that legs of this length cannot walk.
    """
    c = biped.phase
    if request.through is None:
        leg = robot_of(biped).leg
        step = request.step or _STEP * leg  # half the leg, where no step length is asked for
        # most: largest speed that is searched [m/s], 1.5 times sqrt(g leg), at which an inverted pendulum
        # already leaves the ground; LONGEST_STEP: of the steps, as a share of the leg
        most = 1.5 * math.sqrt(biped.description.gravity * leg)
        if step > nlp.LONGEST_STEP * leg or (request.speed or 0.0) > most:
            raise GaitError(
                f"{request.in_words()} is asked for; legs of {leg:g} m cannot walk, one foot always on the "
                f"ground, faster than {most:.3g} m/s, or in steps of more than {nlp.LONGEST_STEP * leg:.3g} m: "
                "ask for less"
            )
        q = apart(biped, step, request.slope, limits.ranges)
        q_plus = biped.relabel(q)  # the start of a periodic step
        # a straight line from q_plus to q: dq/dTheta
        dq = (q - q_plus) / float(c @ (q - q_plus))
        # a walk at half of sqrt(g leg), where no speed is asked for
        duration = step / (request.speed or _STEP * math.sqrt(biped.description.gravity * leg))
        rate = abs(float(c @ (q - q_plus))) / duration
    else:
        q, v = _given_state(biped, np.array(request.through), request.slope)
        dq, rate = v / float(c @ v), abs(float(c @ v))  # dq/dTheta and |Theta'|
    h = invariant_constraint(request.kind, biped, q, dq, request.degree)
    # 0.5: a guess of the largest torque over its limit
    return at_gait(biped, h, q, dq, rate, np.full(request.nodes, rate), 0.5)


_EXACT = 1e-6
"""Largest violation of all other rows by an exact gait, dimensionless or [rad]."""


def audit(biped: Biped, gait: Gait, orbit: ZeroDynamicsOrbit, request: GaitRequest) -> list[str]:
    """Texts on the limits that the periodic step of a gait, `orbit`, violates at its nodes; empty for none.

    Friction, torque, ranges and rates are compared with the limits themselves, since the programme kept a
    reserve to them. It kept none to F_N, clearance, lift-off and slowest rate, so these may fall short of their
    limits by the reserve's share. The requested speed (relative) and step length (over the leg) may be missed
    by 5e-5.
    """
    limits, c = request.limits.of(biped), gait.constraint
    # loose: limits without a reserve at the upper ends, and less by the reserve's share at these lower ends
    names = ("normal_force", "clearance", "lift_off", "slowest")
    whole = {name: x for name in names if (x := getattr(limits, name)) is not None}
    left = {name: (1.0 - limits.reserve) * x for name, x in whole.items()}
    loose = replace(limits, reserve=0.0, rough=0.0, **left)
    rate = float(c.phase @ gait.v_minus)
    rates = np.abs(orbit.v @ c.phase)
    # 1.0: the largest torque allowed is the limit itself
    x = at_gait(biped, c, gait.q_minus, gait.v_minus / rate, abs(rate), rates, 1.0)
    # the same rows as in the design, but at all nodes of `orbit`; nothing is solved
    finer = replace(request, nodes=len(rates))
    programme, _ = nlp.transcribe(biped, finer, loose, float(np.sign(rate)))
    # ASKED: rows of speed and step length, which may be missed by 5e-5, relative and over the leg
    allowed = dict.fromkeys(nlp.ASKED, 5e-5)
    # a foot without a required clearance is kept above the ground at the programme's nodes alone
    # LATE: row on the swing foot where no clearance is asked for
    allowed[nlp.LATE] = np.inf
    # _EXACT: largest violation of all other rows
    gaps = programme.missed(stacked(x)).items()
    return programme.in_words({k: gap for k, gap in gaps if not gap <= allowed.get(k, _EXACT)})


def objective_of(biped: Biped, objective: Objective, gait: Gait, o: ZeroDynamicsOrbit) -> float:
    """Value of an objective over the periodic step o of a gait, with L the step length: the integral of u'u
    over time, over L [N^2 m s]; that of sum |u_i q_i'| over weight and L [1]; or the largest |u_i| [N m].
    """
    length = gait.step_length(biped)
    match objective:
        case Objective.TORQUE:
            return float(np.sum(o.u**2, axis=1) @ o.time_weights) / length
        case Objective.TRANSPORT:
            power = np.sum(np.abs(o.u * o.v[:, : biped.p]), axis=1)
            return float(power @ o.time_weights) / (biped.weight * length)
        case Objective.PEAK:
            return float(np.max(np.abs(o.u)))


@dataclass(frozen=True)
class Optimum:
    """The optimal gait, its objective, and the effort of its design."""

    gait: Gait
    objective: float
    """Value of the objective in the units of `Objective`, by Pinocchio."""
    iterations: int
    """Iterations of IPOPT, over all stages and attempts."""
    seconds: float
    """Wall time [s]."""
    level: tuple[float, float] | None = None
    """Objective and speed [m/s] of the same request without rough ground, where that is asked for."""
    height: float = 0.0
    """H [m] at which the programme keeps the limits on rough ground, with the reserve."""


def optimise(biped: Biped, request: GaitRequest) -> Optimum:
    """Find the gait of least objective from a cold start; as in every nonlinear programme the optimum is local.

    Where the exact gait misses a limit between the nodes, it is designed once more with twice the nodes. Where
    no gait is found that bears the rough ground, the one that bears most is returned. Raises GaitError naming
    the limits that would have to be relaxed, or the robot that has no such gait (exactly one unactuated
    coordinate is needed), and KeyboardInterrupt on Ctrl-C.
    """
    begin, spent, missed = perf_counter(), 0, list[str]()
    if biped.p != biped.n - 1 or biped.p == 0:
        raise GaitError(
            f"robot '{biped.description.name}' has {biped.n} coordinates and {biped.p} motors; gaits are "
            "designed for robots with one coordinate without a motor and at least one motor"
        )
    for nodes in (request.nodes, 2 * request.nodes):
        finer = replace(request, nodes=nodes)
        smooth = replace(finer, limits=replace(finer.limits, rough=0.0))
        results = [_solution(biped, smooth)]
        if request.limits.rough:
            results.append(_on_rough_ground(biped, finer, results[0][0]))
        spent += sum(iterations for _, iterations in results)
        try:
            exact = [exact_gait(biped, finer, x) for x, _ in results]
            missed = audit(biped, *exact[-1], finer)
        except GaitError as error:
            missed = [str(error)]
        if not missed:
            values = [objective_of(biped, request.objective, *pair) for pair in exact]
            level, gait = exact[0][0], exact[-1][0]
            effort = spent, perf_counter() - begin
            if not request.limits.rough:
                return Optimum(gait, values[0], *effort)
            without = values[0], level.step_length(biped) / level.period
            return Optimum(gait, values[1], *effort, without, float(results[1][0].rough.ravel()[0]))
    raise GaitError(
        f"the gait found with {request.in_words()} keeps its limits at {2 * request.nodes} nodes and not "
        f"between them: {'; '.join(missed)}; give more nodes, another degree, or StepLimits with more reserve"
    )


def _solution(biped: Biped, request: GaitRequest) -> tuple[Unknowns[Array], int]:
    """Solve the stages of the request (`GaitRequest.stages`) one after the other; returns the solution of the
    last one and the number of all iterations.

    IPOPT lowers its barrier parameter in the adaptive and, if that fails, in the monotone way. After a stage
    that is not solved, the next one starts from the same guess. If the last stage is not solved, `nlp.relaxed`
    finds a feasible point, from which IPOPT starts again; raises GaitError with the reason if that fails too.
    """
    stages, iterations, limits = request.stages(), 0, request.limits.of(biped)
    guess = cold_start(biped, stages[0], limits)
    direction = float(np.sign(guess.theta[1] - guess.theta[0]))
    for stage in stages:
        programme, unknowns = nlp.transcribe(biped, stage, limits, direction)
        x0, bounds = stacked(guess), _bounds(unknowns, guess, stage, limits)
        runs = [nlp.solve_nlp(programme, x0, bounds)]
        if not runs[-1].solved:
            runs.append(nlp.solve_nlp(programme, x0, bounds, "monotone"))
        if not runs[-1].solved and stage is stages[-1]:
            point = nlp.relaxed(programme, stage.in_words(), x0, bounds, runs[-1].status)
            runs.append(nlp.solve_nlp(programme, point, bounds))
            if not runs[-1].solved:
                raise GaitError(
                    f"no gait with {stage.in_words()} was found: IPOPT stopped with {runs[-1].status}, though "
                    "its limits can be met; try another degree or number of nodes"
                )
        iterations += sum(run.iterations for run in runs)
        if runs[-1].solved:
            guess = unknowns.split(runs[-1].x)
    return guess, iterations


def _on_rough_ground(
    biped: Biped, request: GaitRequest, level: Unknowns[Array]
) -> tuple[Unknowns[Array], int]:
    """Solve a request on rough ground from the solution `level` without that; returns the solution and the
    number of iterations.

    H is asked for with the reserve of the other limits, for the heights between. Where no gait is found that
    bears it, the largest H is searched; the solution is the gait of that, or, if that is H, of the least
    objective from there. Raises GaitError where IPOPT finds none of these.
    """
    limits, leg = request.limits.of(biped), robot_of(biped).leg
    H = min((1.0 + limits.reserve) * limits.rough, HIGHEST * leg)
    direction = float(np.sign(np.diff(level.theta.ravel())[0]))
    programme, unknowns = nlp.transcribe(biped, request, limits, direction)
    # landings at the end of the curve
    guess = level._replace(rough=np.array([0.0, 1.0, 1.0]))
    low, high = map(unknowns.split, _bounds(unknowns, guess, request, limits))
    # the foot lands at phases s from 0.55 to 1.5
    most = stacked(high._replace(rough=np.array([H, 1.5, 1.5])))
    fixed, free = (stacked(low._replace(rough=np.array([h, 0.55, 0.55]))) for h in (H, 0.0))
    # the largest H, as a share of what is asked for, with a little of the objective, which is about 1
    highest = replace(programme, objective=1e-2 * programme.objective - unknowns.rough[0] / H)
    x, iterations = stacked(guess), 0
    for each, least in ((programme, fixed), (highest, free), (programme, fixed)):
        run = nlp.solve_nlp(each, x, (least, most))
        iterations += run.iterations
        if each is highest and not run.solved:
            break
        x = run.x if run.solved else x
        if run.solved and (each is programme or unknowns.split(x).rough[0] < (1.0 - _EXACT) * H):
            return unknowns.split(x), iterations
    raise GaitError(
        f"no gait with {request.in_words()} was found: IPOPT stopped with {run.status}; ask for less height, "
        "or a slower or shorter step"
    )


def _bounds(
    unknowns: Unknowns[ca.MX], guess: Unknowns[Array], request: GaitRequest, limits: RobotLimits
) -> tuple[Array, Array]:
    """Lower and upper bounds (nx,) of the decision vector.

    Rates |Theta'| are from 0.02 to 60 rad/s, and coefficients stay within 1.5 rad of the guess, else a leg may
    wind round by 2 pi. The unknown `peak`, the bound on |torque| over the torque limit [1], is fixed at 1 less
    the reserve; if it is the objective it is free between 0 and that. A requested pre-impact state is fixed.
    All other unknowns are free.
    """
    # rate, rates: |Theta'| just before the impact and at the nodes; alpha: coefficients; q, slope: q- and
    # dq_b/dTheta just before the impact
    free = Unknowns[Array](*(np.full(part.shape, np.inf) for part in unknowns))
    # one, each: ones in the shapes of an unknown that is one number, and of one for each node
    one, each = np.ones(1), np.ones(request.nodes)
    peak = (1.0 - limits.reserve) * one
    least = 0.0 * one if request.objective is Objective.PEAK else peak
    low = Unknowns[Array](*(-part for part in free))
    low = low._replace(rate=0.02 * one, rates=0.02 * each, alpha=guess.alpha - 1.5, peak=least)
    high = free._replace(rate=60.0 * one, rates=60.0 * each, alpha=guess.alpha + 1.5, peak=peak)
    if request.through is not None:
        fixed = {"q": guess.q, "slope": guess.slope, "rate": guess.rate}
        low, high = low._replace(**fixed), high._replace(**fixed)
    return stacked(low), stacked(high)


def exact_gait(
    biped: Biped, request: GaitRequest, x: Unknowns[Array]
) -> tuple[Gait, ZeroDynamicsOrbit]:
    """The gait of a solution x, hybrid-invariant and periodic to round-off, and its step at 120 nodes,
    five times those at which the programme keeps its limits by default.

    Of x only q- (n,), the slopes dq_b/dTheta (p,) and the inner coefficients (p, M - 3) are used, with M the
    degree of the curves; the outer coefficients follow from Pinocchio's impact, the orbit from the quadrature
    of the zero dynamics. Raises GaitError where these have no periodic orbit.
    """
    p, c = biped.p, biped.phase
    # request.slope is that of the ground, x.slope is dq_b/dTheta
    q, dq_b = onto_section(biped, x.q.ravel(), request.slope), x.slope.ravel()
    # dq/dTheta of all coordinates: the last one follows from Theta = c q, so c dq = 1
    dq = np.append(dq_b, (1.0 - c[:p] @ dq_b) / c[p])
    h = invariant_constraint(request.kind, biped, q, dq, request.degree)
    # the two outer coefficients at either end follow from the impact, those between are the solution's
    alpha = np.array(h.curve.coefficients)
    alpha[:, 2:-2] = x.alpha[:, 2:-2]
    zero = ZeroDynamics.of(biped, replace(h, curve=request.kind(alpha)), nodes=120)
    # {}: the provenance is added below, as it has the step length
    gait = Gait.of_cycle(request.name(), zero, {}, request.slope)
    step = gait.step_length(biped)
    provenance = {
        "method": "direct optimisation on the zero dynamics, hybrid-invariant curves, IPOPT",
        "curves": f"{request.curve}, degree {request.degree}, limits kept at {request.nodes} nodes",
        "asked": request.in_words(),
        "minimised": request.objective.value,
        "limits": request.limits.of(biped).in_words(),
        "speed [m/s]": f"{step / gait.period:.6f}",
        "step length [m]": f"{step:.6f}",
    }
    return replace(gait, provenance=provenance), zero.cycle
