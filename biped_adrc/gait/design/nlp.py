"""The periodic step as a nonlinear programme on the zero dynamics, and IPOPT on it.

Unknowns: the pre-impact configuration q-, the slopes of the constraint before impact, the Bezier coefficients
alpha, the phases Theta+ and Theta-, the state and impulse after an impact at Theta'- = 1, and the rates
|Theta'| before impact and at K Gauss nodes. With sigma = I Theta' (Westervelt, Grizzle, Koditschek, IEEE TAC
48(1), 2003),

    sigma_k^2 = sigma+^2 + 2 int -G_N I dTheta        at the nodes
    sigma-^2 - sigma+^2 = 2 W                         the step closes
    alpha_0, alpha_1 from the impact of alpha_M, alpha_(M-1)   the impact keeps to the constraint

Everything else (torque, ground reaction, foot height) is an explicit function of the unknowns, so that CasADi's
derivatives are exact and nothing is integrated in time. All rows (constraints of the programme) are
dimensionless: lengths over the leg, forces over the weight, speeds over sqrt(g leg), torques over their limit;
angles are in rad. Symbols: sigma angular momentum about the stance foot, I inertia, G_N gravity's torque, W the
integral of -G_N I over Theta in the step; + just after an impact, - just before it. In the functions below k is
the `SymbolicStep` of module `step`, and x its unknowns:

    k.node           model at the nodes: I, G_N, u, joint rates v_b, force of the ground, swing foot, q
    k.everywhere     the same at the nodes and both ends, k.places in [0, 1] of the step
    k.span, dt       Theta- - Theta+, and the time that belongs to each node; k.duration is the sum of dt
    k.until, work    integral of -G_N I dTheta from Theta+ to each node, and W
    k.along, out     unit vectors along the ground and out of it; k.length: distance of the feet along it
    k.dq             dq/dTheta before impact; q_plus, v_plus: state after an impact at Theta'- = 1, relabelled
    k.J_2, foot      Jacobian and place of the swing foot before impact
    k.direction      sign of Theta'; k.phase: row c of Theta = c q
    k.sigma(q, v)    sigma over its unit k.sigma_scale; k.leg, k.mass: length of the leg, mass of the robot
    x.q, x.slope     q-, and dq_b/dTheta before impact; x.alpha: coefficients; x.theta: (Theta+, Theta-)
    x.after          rates after an impact at Theta'- = 1, then the old foot's velocity; x.impulse: its impulse
    x.rate, rates    |Theta'| before impact, and at the nodes; x.peak: largest torque over its limit

`transcribe` writes the programme. `solve_nlp` runs IPOPT once. Where IPOPT finds no feasible point, `relaxed`
solves the same programme with a slack variable s >= 0 in each limit and sum s minimised (an elastic, or l1,
relaxation): a slack that stays above zero names a limit that cannot be kept, and an end without slack is a
feasible point to start from again. `optimise` calls all three.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from biped_adrc.core.errors import GaitError
from biped_adrc.core.types import Array
from biped_adrc.gait.design.request import GaitRequest, Objective, RobotLimits
from biped_adrc.gait.design.rough import RoughSteps
from biped_adrc.gait.design.step import Bounded, SymbolicStep, Unknowns
from biped_adrc.model.biped import Biped

LONGEST_STEP = 1.2
"""Longest step that is searched, as a share of the leg length."""
LATE = "the swing foot above the ground after 50% of the step"
"""Name of the limit on the swing foot where no clearance is required."""
ASKED = ("the speed", "the step length")
"""Names of the equality rows that state the request rather than the physics of the step."""


@dataclass(frozen=True)
class NonlinearProgram:
    """A nonlinear programme: minimise `objective` over x, subject to all rows."""

    x: ca.MX
    """Decision vector, one column."""
    objective: ca.MX
    """Cost (1, 1), dimensionless; |power| is smoothed so that it can be differentiated."""
    rows: tuple[Bounded, ...]
    """Equality and inequality constraints."""

    def missed(self, x: Array) -> dict[str, float]:
        """By name of a constraint, the largest violation of its rows by the decision vector x (nx,),
        dimensionless or [rad]; 0 if x keeps them.
        """
        values = ca.Function("rows", [self.x], [row.value for row in self.rows]).call([x])
        result = dict[str, float]()
        for row, value in zip(self.rows, values, strict=True):
            v = np.array(value).ravel()
            gaps = np.maximum(row.low - v, v - row.high)
            result[row.name] = float(np.max(gaps, initial=result.get(row.name, 0.0)))
        return result

    def in_words(self, missed: Mapping[str, float]) -> list[str]:
        """A text for each limit in `missed` (name -> violation), with violation and unit, the largest first."""
        units = {row.name: row.unit for row in self.rows}
        ordered = sorted(missed.items(), key=lambda pair: -pair[1])
        return [f"{name} by {amount:.3g} {units[name]}".rstrip() for name, amount in ordered]


def transcribe(
    biped: Biped, request: GaitRequest, limits: RobotLimits, direction: float
) -> tuple[NonlinearProgram, Unknowns[ca.MX]]:
    """Write the nonlinear programme of a request; returns it and the symbols of its unknowns.

    limits: the request's, completed by the robot's own. direction: sign of Theta' in the walk, from the first
    guess: Theta falls in a walk to +x with the paper's phase, but grows with the phase of other robots.
    """
    step = SymbolicStep(biped, request, limits, direction)
    rough = RoughSteps(step).rows() if limits.rough else ()
    rows = (*_equalities(step), *_limits(step), *rough)
    columns = tuple(row._replace(value=ca.vec(row.value)) for row in rows)
    x = ca.vertcat(*(ca.vec(part) for part in step.x))
    return NonlinearProgram(x, _objective(step), columns), step.x


def _equalities(k: SymbolicStep) -> list[Bounded]:
    """Equality rows: the walking step is one periodic orbit of the hybrid zero dynamics, with the requested
    speed and step length.

    The end of the curve is the pre-impact state, its start the state after the impact with the legs relabelled,
    in value and in slope; the angular momentum follows the quadrature to each node and closes over the step.
    Each row is an expression that has to be zero.
    """
    x, p, M = k.x, k.p, k.request.degree
    # |sigma-| and |sigma+| over sigma_scale, but for the sign of Theta', which the squares below do not see
    sigma_minus = k.sigma(x.q, k.dq) * x.rate
    sigma_plus = k.sigma(k.q_plus, k.v_plus) * x.rate
    sigma2 = (k.node.inertia * x.rates / k.sigma_scale) ** 2
    # slopes at the ends: dh/ds = (alpha_1 - alpha_0) / reach, and likewise at the end
    reach = float(k.request.kind.abscissae(M)[1])
    begin, end = x.alpha[:, 1] - x.alpha[:, 0], x.alpha[:, M] - x.alpha[:, M - 1]
    zero: list[tuple[str, ca.MX] | tuple[str, ca.MX, str]] = [
        ("the swing foot on the ground", k.out @ k.foot / k.leg),
        ("the constraint before impact", x.alpha[:, M] - x.q[:p]),
        # dh/ds = (Theta- - Theta+) dq_b/dTheta; after impact multiplied by Theta'+, which is not divided by
        ("the slope before impact", end / reach - k.span * x.slope),
        ("the constraint after impact", x.alpha[:, 0] - k.q_plus[:p]),
        ("the slope after impact", begin / reach * (k.phase @ k.v_plus) - k.span * k.v_plus[:p]),
        ("the phase", x.theta - ca.vertcat(k.phase @ k.q_plus, k.phase @ x.q)),
        ("the impact", k.impact()),
        ("the zero dynamics", sigma2 - sigma_plus**2 - 2.0 * k.until / k.sigma_scale**2),
        ("periodicity", sigma_minus**2 - sigma_plus**2 - 2.0 * k.work / k.sigma_scale**2),
    ]
    if k.request.step is not None:
        zero.append(("the step length", (k.length - k.request.step) / k.leg, "of the leg"))
    if k.request.speed is not None:
        zero.append(("the speed", k.length / k.duration / k.request.speed - 1.0, "of itself"))
    return [Bounded(name, value, 0.0, 0.0, *unit) for name, value, *unit in zero]


def _limits(k: SymbolicStep) -> list[Bounded]:
    """Inequality rows, at the nodes and both ends of the step: contact, torque, lift-off, stability, clearance,
    ranges and rates of the joints.

    Friction, torque, rates and ranges keep the share `limits.reserve` back for the phases between the nodes;
    the torque does by the bound of the unknown `x.peak`. The clearance required is a hump 16 h (s (1 - s))^2
    over the normalised phase, which is h in the middle of the step and 0, with slope 0, at its ends.
    """
    x, limits, inf = k.x, k.limits, np.inf
    weight, kept = k.biped.weight, 1.0 - limits.reserve
    speed = np.sqrt(k.gravity * k.leg)  # unit of speeds
    node, s = k.everywhere, k.places
    F_T, F_N = k.along @ node.force / weight, k.out @ node.force / weight
    # rate: Theta' before impact [rad/s], with its sign; impulse and speeds are those at Theta'- = 1 times it
    rate = k.direction * x.rate
    P_T, P_N = (rate * (row @ x.impulse) / (k.mass * speed) for row in (k.along, k.out))
    # speeds out of the ground: of the swing foot before the impact, of the old stance foot after it
    before, after = rate * (k.out @ k.J_2 @ k.dq), rate * (k.out @ x.after[k.n :])
    torque = node.u / limits.torque
    lift = limits.lift_off / speed
    mu, mu_i = kept * limits.friction, kept * limits.impulse_friction
    weights, legs, speeds = "of the weight", "of the leg", "of sqrt(g leg)"
    ratio = (k.sigma(k.q_plus, k.v_plus) / k.sigma(x.q, k.dq)) ** 2  # delta^2
    # steps from 0.05 to 1.2 of the leg are searched
    rows = [
        Bounded("the normal force", F_N, limits.normal_force, inf, weights),
        Bounded("friction", mu * F_N - F_T, 0.0, inf, weights),
        Bounded("friction", mu * F_N + F_T, 0.0, inf, weights),
        Bounded("the impulse", P_N, 0.0, inf),
        Bounded("the torque limit", torque - x.peak, -inf, 0.0, "of the limit"),
        Bounded("the torque limit", torque + x.peak, 0.0, inf, "of the limit"),
        Bounded("the swing foot coming down", before / speed, -inf, -lift, speeds),
        Bounded("the old foot lifting off", after / speed, lift, inf, speeds),
        # Theta goes one way all along and goes on so after impact; 0.05 rad and 0.02 keep the solver away from
        # a span and a rate of zero
        Bounded("one way of Theta", k.direction * k.span, 0.05, inf, "rad"),
        Bounded("one way of Theta after impact", k.phase @ k.v_plus, 0.02, inf),
        Bounded("the slowest rate", x.rates / x.rate, limits.slowest, inf, "of that before impact"),
        Bounded("stability, delta^2 below 1", ratio, -inf, limits.multiplier),
        Bounded("the range of steps", k.length / k.leg, 0.05, LONGEST_STEP, legs),
    ]
    if np.isfinite(mu_i):
        rows += [
            Bounded("the impulse cone", mu_i * P_N - P_T, 0.0, inf, "of m sqrt(g leg)"),
            Bounded("the impulse cone", mu_i * P_N + P_T, 0.0, inf, "of m sqrt(g leg)"),
        ]
    # nodes at which the foot has to be above the ground: without a clearance those in the later half of the
    # step alone, since a leg without a knee scuffs before
    scuffs = 0.5 if limits.clearance is None else 0.0
    above = [i for i, x in enumerate(s) if scuffs < x < 1.0]
    hump = (limits.clearance or 0.0) * 16.0 * (s * (1.0 - s))[above] ** 2
    height = (k.out @ node.foot)[:, above] / k.leg - hump[np.newaxis]
    # LATE: name of the row where no clearance is asked for
    name = LATE if limits.clearance is None else "foot clearance"
    rows.append(Bounded(name, height, 0.0, inf, legs))
    for joint, (low, high) in limits.ranges.items():
        j = k.biped.description.joint_index(joint)
        # the reserve at either end is a share of 0.25 rad, or of half the range where that is less
        kept_back = limits.reserve * min(0.25, 0.5 * (high - low))
        ends = low + kept_back, high - kept_back
        rows.append(Bounded(f"the range of {joint}", node.q[j, :], *ends, "rad"))
    for joint, most in limits.rates.items():
        share = node.v_b[k.biped.description.joint_index(joint), :] / most
        rows.append(Bounded(f"the rate of {joint}", share, -kept, kept, "of its limit"))
    return rows


def _objective(k: SymbolicStep) -> ca.MX:
    """The cost (1, 1) of the request's objective, made dimensionless so that it is about 1 in size.

    Torque: the integral of u'u over time and step length. Transport: that of sum |u_i q_i'| over weight and
    step length. Peak: the largest |u_i|. The last two have a little torque squared (`calm`) added, 0.01 times,
    since they leave the torque undetermined where it costs nothing.
    """
    u = k.node.u / k.limits.torque
    calm = ca.sum2(ca.sum1(u**2) * k.dt) / k.length * np.sqrt(k.leg * k.gravity)
    match k.request.objective:
        case Objective.TORQUE:
            return calm
        case Objective.TRANSPORT:
            # |x| as sqrt(x^2 + e^2) - e, which has a derivative at 0
            # e: share of the torque limit times 1 rad/s
            e = 1e-2
            power = ca.sum1(ca.sqrt((u * k.node.v_b) ** 2 + e**2) - e)
            work = ca.sum2(power * k.dt) * k.limits.torque
            cost = work / (k.biped.weight * k.length)
        case Objective.PEAK:
            cost = k.x.peak
    return cost + 1e-2 * calm


# -- IPOPT -----------------------------------------------------------------------------------------
class IpoptResult(NamedTuple):
    """Result of one run of IPOPT."""

    x: Array
    """Decision vector (nx,) of the last iteration, a solution or not."""
    status: str
    """IPOPT's return status, such as "Solve_Succeeded" or "Infeasible_Problem_Detected"."""
    solved: bool
    """Whether IPOPT met its tolerances, or its acceptable ones."""
    iterations: int


def solve_nlp(
    programme: NonlinearProgram, x0: Array, bounds: tuple[Array, Array], strategy: str = "adaptive"
) -> IpoptResult:
    """Run IPOPT once from the first guess x0 (nx,), within lower and upper bounds (nx,), solved or not.

    strategy: how IPOPT lowers its barrier parameter, "adaptive" (fast) or "monotone" (more robust). Raises
    KeyboardInterrupt on Ctrl-C, which CasADi notices at its next evaluation.
    """
    rows = programme.rows
    g = ca.vertcat(*(row.value for row in rows))
    low = np.concatenate([np.full(row.value.numel(), row.low) for row in rows])
    high = np.concatenate([np.full(row.value.numel(), row.high) for row in rows])
    problem = {"x": programme.x, "f": programme.objective, "g": g}
    options: dict[str, Any] = {
        "print_time": False,
        "show_eval_warnings": False,
        "ipopt.print_level": 0,
        "ipopt.sb": "yes",  # no banner
        "ipopt.max_iter": 250,
        "ipopt.max_wall_time": 300.0,  # [s]
        "ipopt.mu_strategy": strategy,
        "ipopt.acceptable_tol": 1e-6,
        "ipopt.acceptable_constr_viol_tol": 1e-9,
        "ipopt.acceptable_iter": 5,
    }
    solver = ca.nlpsol("gait", "ipopt", problem, options)
    try:
        result = solver(x0=x0, lbx=bounds[0], ubx=bounds[1], lbg=low, ubg=high)
    except SystemError as error:
        # Python 3.13 says so of CasADi after Ctrl-C: a result is returned while KeyboardInterrupt is set
        raise error.__cause__ or error from None
    status, solved, count = (solver.stats()[k] for k in ("return_status", "success", "iter_count"))
    # how CasADi reports Ctrl-C, in an evaluation or between two of them
    if status in ("NonIpopt_Exception_Thrown", "User_Requested_Stop"):
        raise KeyboardInterrupt
    return IpoptResult(np.array(result["x"]).ravel(), status, solved, count)


def relaxed(
    programme: NonlinearProgram, request: str, x0: Array, bounds: tuple[Array, Array], status: str
) -> Array:
    """Find a decision vector (nx,) that keeps all limits, from x0 (nx,), by a relaxation with slacks s.

        minimise  w . s + 1e-6 f(x)   subject to  low - s <= g(x) <= high + s,  s >= 0

    Each name of a limit has one slack, so that all rows of that name give way together; the small share of the
    objective keeps the solution unique. The equations of the model have no slack; the requested speed and step
    length have one of weight w = 100, all other limits one of w = 1, so that a limit gives way before the
    request does.

    bounds: lower and upper ones of x (nx,). request, status: the request in words, and the status with which
    IPOPT failed before, for the message. Raises GaitError naming the limits whose slack stays above 1e-5,
    dimensionless or [rad].
    """
    # soft: rows that get a slack; ASKED: names of the rows of the requested speed and step length; rows: first
    # the equations of the model, as they are, then the soft ones
    soft = [row for row in programme.rows if row.low != row.high or row.name in ASKED]
    rows = [row for row in programme.rows if row.low == row.high and row.name not in ASKED]
    names = list(dict.fromkeys(row.name for row in soft))
    slack = ca.MX.sym("slack", len(names))
    for row in soft:
        give = ca.repmat(slack[names.index(row.name)], row.value.numel(), 1)
        if np.isfinite(row.low):
            rows.append(Bounded(row.name, row.value + give, row.low, np.inf))
        if np.isfinite(row.high):
            rows.append(Bounded(row.name, row.value - give, -np.inf, row.high))
    weight = np.array([100.0 if name in ASKED else 1.0 for name in names])
    count = len(names)
    cost = ca.dot(weight, slack) + 1e-6 * programme.objective
    softened = NonlinearProgram(ca.vertcat(programme.x, slack), cost, tuple(rows))
    ends = np.append(bounds[0], np.zeros(count)), np.append(bounds[1], np.full(count, np.inf))
    # slacks of 1 at first; "monotone": the more robust way in which IPOPT lowers its barrier
    result = solve_nlp(softened, np.concatenate((x0, np.ones(count))), ends, "monotone")
    # a slack above 1e-5 is a limit that cannot be kept
    missed = {k: s for k, s in zip(names, result.x[-count:], strict=True) if s > 1e-5}
    if missed or not result.solved:
        why = f"; these would have to give: {'; '.join(programme.in_words(missed))}"
        if not result.solved:
            why = f" ({status}), and no limits that would have to; ask for a slower or shorter step, or less"
        raise GaitError(f"no gait with {request} keeps the limits{why}")
    return result.x[:-count]  # without the slacks
