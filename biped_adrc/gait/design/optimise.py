"""Design of a gait: solve the nonlinear programme with IPOPT from a cold start, then make the result exact.

`optimise` goes from an easy programme to the one asked for (level ground and least torque first, then the
slope, then the objective), each solution being the next first guess.

IPOPT meets the equations to about 1e-9. The Gait handed back is therefore built anew from q-, the slopes and
the free coefficients alone (`exact_gait`): impact and zero dynamics are Pinocchio's, so that the constraint is
hybrid-invariant and the orbit periodic to round-off.

The programme keeps its limits at the nodes only. `audited` evaluates the exact gait at many more, and
`missed_limits` compares all limits there; if one is missed, the programme is solved once more with twice the
nodes. `analysis.gait_design` calls `optimise` and then walks the gait in simulation.

The stages of one attempt (`_staged`), each from the solution of the one before:

    cold start -> least torque, level ground -> least torque, slope -> the objective asked for

A solution that fails its audit starts a second attempt at twice the nodes; a programme without a solution ends
in `ipopt.relaxed`, which names the limits that contradict each other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from time import perf_counter
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import GaitError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.design.ipopt import IpoptProgress, IpoptResult, relaxed, solve
from biped_adrc.gait.design.nlp import transcribe
from biped_adrc.gait.design.request import GaitRequest, Objective, RobotLimits
from biped_adrc.gait.design.start import cold_start, curve_through
from biped_adrc.gait.design.step import Unknowns
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.through_state import onto_section
from biped_adrc.gait.zero_dynamics import ZeroDynamics, ZeroDynamicsOrbit
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.planar import PlanarTree
from biped_adrc.types import Array

NODES = 120
"""Gauss nodes of the audit, five times those at which the programme keeps its limits by default."""
SPEED = 1e-4
"""Largest relative difference of speed and step length from those asked for."""


class Audited(NamedTuple):
    """The periodic step of a gait at K nodes, by Pinocchio."""

    orbit: ZeroDynamicsOrbit
    delta2: float
    """delta^2, the multiplier of the zero dynamics."""
    length: float
    """Distance between the feet at impact [m]."""
    F_T: Array
    """Ground reaction along the ground (K,) [N]."""
    F_N: Array
    """Ground reaction normal to the ground (K,) [N]."""
    height: Array
    """Height of the swing foot above the ground (K,) [m]."""


def audited(biped: Biped, gait: Gait, nodes: int = NODES) -> Audited:
    """Evaluate the periodic step of a gait at so many nodes.

    Raises GaitError where it has no periodic orbit.
    """
    zero = ZeroDynamics.of(biped, gait.constraint, nodes)
    o = zero.cycle
    along, out = ground_axes(gait.slope)
    height = np.array([biped.swing_foot(q) @ out for q in o.q])
    length = float(np.hypot(*biped.swing_foot(gait.q_minus)))
    reaction = o.ground_reaction
    return Audited(o, zero.delta**2, length, reaction @ along, reaction @ out, height)


def objective_of(biped: Biped, objective: Objective, a: Audited) -> float:
    """The value of an objective over the step, in the units of `Objective`."""
    o = a.orbit
    match objective:
        case Objective.TORQUE:
            return float(np.sum(o.u**2, axis=1) @ o.time_weights) / a.length
        case Objective.TRANSPORT:
            power = np.sum(np.abs(o.u * o.v[:, : biped.p]), axis=1)
            return float(power @ o.time_weights) / (biped.weight * a.length)
        case Objective.PEAK:
            return float(np.max(np.abs(o.u)))


def missed_limits(
    biped: Biped, gait: Gait, limits: RobotLimits, a: Audited | None = None
) -> tuple[str, ...]:
    """A sentence for each limit that the periodic step violates anywhere; empty when it keeps all of them.

    Friction, torque and joint ranges are compared with the limits themselves, since the programme kept a
    reserve to them. F_N, clearance and lift-off have no such reserve, so they may fall short by that share.
    """
    a = audited(biped, gait) if a is None else a
    o, c, left = a.orbit, gait.constraint, 1.0 - limits.reserve
    along, out = ground_axes(gait.slope)
    impact = biped.impact(gait.q_minus, gait.v_minus)
    P_T, P_N = float(along @ impact.impulse), float(out @ impact.impulse)
    s = (o.theta - c.theta_plus) / (c.theta_minus - c.theta_plus)
    hump = (limits.clearance or 0.0) * PlanarTree.of(biped).leg * 16.0 * (s * (1.0 - s)) ** 2
    came_down = -float(out @ biped.swing_foot_velocity(gait.q_minus, gait.v_minus))
    rates = np.abs(o.v @ c.phase)
    slowest = float(np.min(rates) / abs(c.phase @ gait.v_minus))
    lifted = float(impact.old_foot_velocity @ out)
    found = [
        ("F_N", np.min(a.F_N), left * limits.normal_force * biped.weight, "N"),
        ("friction left", np.min(limits.friction * a.F_N - np.abs(a.F_T)), 0.0, "N"),
        ("torque left", limits.torque - np.max(np.abs(o.u)), 0.0, "N m"),
        ("downward speed of the swing foot", came_down, left * limits.lift_off, "m/s"),
        ("upward speed of the old foot", lifted, left * limits.lift_off, "m/s"),
        ("slowest rate over that before impact", slowest, left * limits.slowest, ""),
        ("stability left, limit - delta^2", limits.multiplier - a.delta2, -1e-6, ""),
        ("normal impulse", P_N, 0.0, "N s"),
    ]
    if limits.clearance is not None:
        found.append(("swing foot over its hump", np.min(a.height - left * hump), 0.0, "m"))
    if np.isfinite(limits.impulse_friction):
        found.append(
            ("impulse friction left", limits.impulse_friction * P_N - abs(P_T), 0.0, "N s")
        )
    for joint, (low, high) in limits.ranges.items():
        angle = o.q[:, biped.description.joint_index(joint)]
        found.append((f"{joint} above its least", np.min(angle) - low, 0.0, "rad"))
        found.append((f"{joint} below its largest", high - np.max(angle), 0.0, "rad"))
    return tuple(
        f"{name} is {value:.3g} {unit}".rstrip() + f", expected at least {least:.3g}"
        for name, value, least, unit in found
        if not value >= least
    )


def missed_wishes(request: GaitRequest, a: Audited) -> tuple[str, ...]:
    """A sentence each for a speed or a step length that differs from the one asked for by more than SPEED."""
    reached = {
        "speed": (request.speed, a.length / a.orbit.period),
        "step": (request.step, a.length),
    }
    return tuple(
        f"the {name} is {found:.6g}, asked {asked:.6g}"
        for name, (asked, found) in reached.items()
        if asked is not None and not abs(found - asked) <= SPEED * asked
    )


SLOWEST, FASTEST = 0.02, 60.0  # [rad/s], |Theta'|
"""Bounds of the unknown rates."""
WINDING = 1.5
"""Largest distance of a Bezier coefficient from the first guess [rad]; angles repeat every 2 pi, so that
without bounds a leg may wind round."""


@dataclass(frozen=True)
class Optimum:
    """The optimal gait and what it took to find it."""

    gait: Gait
    objective: float
    """Its value in the units of `Objective`, by Pinocchio."""
    iterations: int
    """Of IPOPT, over all stages and attempts."""
    seconds: float
    """Wall time [s]."""


def optimise(biped: Biped, request: GaitRequest, progress: IpoptProgress | None = None) -> Optimum:
    """The gait of least objective, from a cold start; local optimum, as of any nonlinear programme.

    1. Solve the programme in stages at the nodes of the request (`_staged`).
    2. Build the exact gait of the solution (`exact_gait`), and evaluate it at NODES nodes (`audited`).
    3. Compare speed, step length and all limits (`missed_wishes`, `missed_limits`). Done if nothing is missed;
       otherwise start again with twice the nodes, and give up if that misses something too.

    progress: called after each iteration of IPOPT. Raises
    GaitError naming the limits that would have to give, or the robot that has no such gait (exactly one
    unactuated coordinate is needed), and KeyboardInterrupt on Ctrl-C.
    """
    begin, limits, spent = perf_counter(), request.limits.of(biped), 0
    if biped.p != biped.n - 1 or biped.p == 0:
        raise GaitError(
            f"robot '{biped.description.name}' has {biped.n} coordinates and {biped.p} motors; gaits are "
            "designed for robots with one coordinate without a motor and at least one motor"
        )
    missed: tuple[str, ...] = ()
    for nodes in (request.nodes, 2 * request.nodes):
        found, iterations = _staged(biped, replace(request, nodes=nodes), limits, progress)
        spent += iterations
        try:
            gait = exact_gait(biped, request, limits, found)
            a = audited(biped, gait)
        except GaitError as error:
            missed = (str(error),)
            continue
        missed = (*missed_wishes(request, a), *missed_limits(biped, gait, limits, a))
        if not missed:
            value = objective_of(biped, request.objective, a)
            return Optimum(gait, value, spent, perf_counter() - begin)
    raise GaitError(
        f"the gait found with {request.in_words()} keeps its limits at {2 * request.nodes} nodes and not "
        f"between them: {'; '.join(missed)}; give more nodes, another degree, or StepLimits with more reserve"
    )


def _staged(
    biped: Biped, request: GaitRequest, limits: RobotLimits, progress: IpoptProgress | None
) -> tuple[dict[str, Array], int]:
    """The unknowns by name and the number of iterations, stage after stage of the request.

    A stage that is not solved hands the guess of the one before on; only the last one has to be solved.
    """
    stages, iterations = request.stages(), 0
    direction, guess = cold_start(biped, stages[0], limits)
    for stage in stages:
        found, x = _solve(biped, stage, limits, direction, guess, progress, stage is stages[-1])
        iterations += found.iterations
        if found.solved:
            guess = x
    return x, iterations


def _solve(
    biped: Biped,
    request: GaitRequest,
    limits: RobotLimits,
    direction: float,
    guess: Mapping[str, Array],
    progress: IpoptProgress | None,
    diagnose: bool,
) -> tuple[IpoptResult, dict[str, Array]]:
    """IPOPT from a guess, with the adaptive and then the monotone barrier strategy.

    diagnose: where both fail, relax the limits, start again from the feasible point found, and raise GaitError
    with the reason if that fails too.
    """
    programme, unknowns = transcribe(biped, request, limits, direction)
    x0 = np.concatenate([np.ravel(guess[name], order="F") for name in Unknowns._fields])
    bounds = _bounds(unknowns, guess, request, limits)
    found = solve(programme, x0, bounds, progress)
    iterations = found.iterations
    if not found.solved:
        found = solve(programme, x0, bounds, progress, "monotone")
        iterations += found.iterations
    if not found.solved and diagnose:
        point = relaxed(programme, request.in_words(), x0, bounds, found.status)
        found = solve(programme, point, bounds, progress)
        iterations += found.iterations
        if not found.solved:
            raise GaitError(
                f"no gait with {request.in_words()} was found: IPOPT stopped with {found.status}, though its "
                "limits can be met; try another degree or number of nodes"
            )
    return replace(found, iterations=iterations), unknowns.parts(found.x)


def _bounds(
    unknowns: Unknowns, guess: Mapping[str, Array], request: GaitRequest, limits: RobotLimits
) -> tuple[Array, Array]:
    """Lower and upper bounds (nx,) of the decision vector.

    Rates are positive, coefficients stay within WINDING of the guess (angles repeat every 2 pi), the peak
    torque is fixed at its limit unless it is the objective, and a given pre-impact state is fixed.
    """
    low, high = {}, {}
    for name, part in zip(Unknowns._fields, unknowns, strict=True):
        low[name] = np.full(part.numel(), -np.inf)
        high[name] = np.full(part.numel(), np.inf)
    for name in ("rate", "rates"):
        low[name][:], high[name][:] = SLOWEST, FASTEST
    line = np.ravel(guess["alpha"], order="F")
    low["alpha"][:], high["alpha"][:] = line - WINDING, line + WINDING
    high["peak"][:] = 1.0 - limits.reserve
    low["peak"][:] = 0.0 if request.objective.value == "peak" else high["peak"]
    if request.through is not None:
        for name in ("q", "slope", "rate"):
            low[name][:] = high[name][:] = np.ravel(guess[name])
    join = [np.concatenate([side[name] for name in Unknowns._fields]) for side in (low, high)]
    return join[0], join[1]


# -- the exact gait --------------------------------------------------------------------------------
def exact_gait(
    biped: Biped, request: GaitRequest, limits: RobotLimits, x: Mapping[str, Array]
) -> Gait:
    """The gait that a solution x stands for, hybrid-invariant and periodic to round-off.

    Of x only q- (n,), the slopes (p,) and the inner coefficients (p, M - 3) are used, in the units of
    `Unknowns`; the outer coefficients follow from Pinocchio's impact, the orbit from the quadrature of the zero
    dynamics. Raises GaitError where these have no periodic orbit.
    """
    p, M, c = biped.p, request.degree, biped.phase
    q = onto_section(biped, x["q"].ravel(), request.slope)
    slope = x["slope"].ravel()
    dq = np.append(slope, (1.0 - c[:p] @ slope) / c[p])
    _, theta_plus, theta_minus, alpha = curve_through(request.kind, biped, q, dq, M)
    alpha[:, 2:-2] = x["alpha"][:, 2:-2]
    constraint = VirtualConstraint(request.kind(alpha), c, theta_plus, theta_minus)
    zero = ZeroDynamics.of(biped, constraint, NODES)
    gait = Gait.of_cycle(request.name(), zero, {}, request.slope)
    step = float(np.hypot(*biped.swing_foot(gait.q_minus)))
    provenance = {
        "method": "direct optimisation on the zero dynamics, hybrid-invariant curves, IPOPT",
        "asked": request.in_words(),
        "minimised": request.objective.value,
        "limits": ", ".join(f"{k} {v}" for k, v in vars(limits).items()),
        "speed [m/s]": f"{step / gait.period:.6f}",
        "step length [m]": f"{step:.6f}",
        "command": request.command(biped),
    }
    return replace(gait, provenance=provenance)
