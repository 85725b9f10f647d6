"""The certificate of a step: what a real robot on dry ground would have needed for it.

A planar model pinned at its foot cannot slip or lift off, so feasibility is checked afterwards: F_N and
friction |F_T| / F_N in the mean over a window of 5 ms (`ground_force`), the same ratio of the impulse at
impact, scuffing of the swing foot, and torque, rate and range of the joints. F_N and F_T are the force of the
ground perpendicular to and along it. A step is feasible where these are within the `Limits`. A `Certificate`
adds numbers of a step that ended in an impact: whether the old foot lifts off, the forces at every instant, and
the joint work and the energy lost at impact, which on a periodic gait on level ground are equal. Forces are
those on the plant.

    node           an instant at which the run keeps its state; a walk has K of them
    arc            the nodes of one single support; a walk has S, of which the last may be unfinished
    mean force     of the ground, over a window that ends at a node; there is none at the first nodes of a
                   single support, where no window has passed yet
    impacts        how many single supports ended in an impact; only the last one of a walk may not have
    after          momentum (2,) [N s] just after the impact with which a walk ends, as no node follows it; None
                   for a walk that ends otherwise
    stones         places on which the feet have to land (`model.ground.Stones`)
    soft ground    that of a simulator with contacts, which limits the friction itself

`Limits` may leave numbers to the robot's record, `KnownLimits` has them all. `certificates` and `supports`
compute these numbers from the nodes, `first_violation` finds where a walk first violates a limit; `feasibility`
summarises them for the walk.
"""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.analysis.ground_force import Nodes, demands, impulse_ratios, ratios
from biped_adrc.analysis.signals import Signals, integrate
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ENDS, ROUND_OFF, SLIP, KnownLimits, Limits, ground_axes
from biped_adrc.model.robots.urdf import Joint

IMPULSE = "impulse"
"""Name of the reason that is counted apart: the impulse at impact alone leaves the friction cone."""
REASONS = {
    "normal_force": "mean_normal_force",
    "friction": "mean_friction",
    "torque": "peak_torque",
    "scuffing": "scuffing",
    "rate": "rate_share",
    "range": "beyond_range",
    "slip": "slip",
    "stones": "missed_stone",
    IMPULSE: "impulse_ratio",
}
"""Reason why a single support is not feasible, a key of `Support.infeasible` -> its field of `Support`."""
AT_NODES = ("normal_force", "friction", "scuffing", "torque", "rate", "range")
"""Reasons whose numbers are those of `ground_force.demands`."""
OF_JOINTS = ("torque", "rate", "range")
"""Reasons whose number belongs to one joint, the one in which it is largest."""


@dataclass(frozen=True)
class Support(Shown):
    """Forces, torques and clearance of one single support, also an unfinished one, with their limits.

    A friction ratio is infinite where the ground never pushed.
    """

    step: int
    """Number of the single support, from 1."""
    duration: float
    """Duration of the single support [s]."""
    mean_normal_force: float
    """Least F_N averaged over the window [N]; infinite for a single support too short for a mean."""
    mean_friction: float
    """Largest |F_T| / F_N of the forces averaged over the window, of those with F_N > 0, dimensionless."""
    scuffing: float
    """Largest depth of the swing foot below the lines between footholds [m], but near the ends of the step."""
    riser: float
    """The same on a harder ground, level up to a riser before each foothold [m], which does not count."""
    slip: float
    """Largest distance that a foot slips on soft ground [m]; 0 on the rigid plant."""
    missed_stone: float
    """By how much the foot lands off its stone [m], 0 on it and where there is none."""
    peak_torque: float
    """Largest |u_i| [N m]."""
    rate_share: float
    """Largest |q_i'| as a share of the limit that its joint states [1]; 0 where none states one."""
    beyond_range: float
    """By how much an angle is beyond the range that its joint states [rad], 0 within."""
    joints: Mapping[str, Joint]
    """The joints of the last three numbers: "torque", "rate" or "range" -> joint."""
    impulse_ratio: float
    """|F_T| / F_N of the impulse of its impact: infinite where the ground would have to pull, 0 without one."""
    limits: KnownLimits
    """The limits; mu is infinite on soft ground, where the simulator limits the friction itself."""

    def infeasible(self) -> dict[str, str]:
        """The numbers that are not within their limits: name in `REASONS` -> sentence about it; empty for a
        feasible step.
        """
        k, of = self.limits, self.joints.get
        # of(name): the joint of a number; None where it belongs to no joint
        numbers = ((name, getattr(self, field)) for name, field in REASONS.items())
        return {i: violation(i, x, k, of(i)) for i, x in numbers if not keeps(i, x, k)}


@dataclass(frozen=True)
class Certificate(Support):
    """A single support with the impact that ends it."""

    least_normal_force: float
    """Least F_N at any instant [N]."""
    friction: float
    """Largest |F_T| / F_N of the instants with F_N > 0, dimensionless."""
    step_length: float
    """Distance of the footholds along the ground [m]."""
    old_foot_velocity: float
    """Velocity of the old stance foot after impact out of the ground [m/s]; positive when it lifts off."""
    clearance: float
    """Least height [m] of the swing foot, but for the first and last 3 % of the step; negative if it scuffs."""
    joint_work: float
    """int u' q_b' dt, the net work of the motors [J]."""
    energy_lost: float
    """Kinetic energy lost at impact [J]."""
    cost_of_transport: float
    """int |u_i q_i'| dt, summed over motors, over m g times step length; dimensionless."""

    def violations(self, but: Collection[str] = ()) -> tuple[str, ...]:
        """Sentences on all numbers outside their limits, and on an old foot that does not lift
        off; empty when all is well.

        but: names in `REASONS` that do not count.
        """
        result = [text for name, text in self.infeasible().items() if name not in but]
        # `not >`, so that NaN is a violation too
        if not self.old_foot_velocity > 0:
            result.append("the old stance foot does not lift off")
        return tuple(result)


def ratio_text(ratio: float) -> str:
    """Text of a friction ratio; "no contact" where it is infinite."""
    return f"{ratio:.3f}" if math.isfinite(ratio) else "no contact"


def keeps(name: str, x: Any, k: KnownLimits) -> Any:
    """Whether numbers x (...,), of the kind `name` in `REASONS`, are within the limits k; NaN is not.

    An infinite friction ratio, where the ground never pushed, counts as within: the normal force then violates
    its own limit. Scuffing, angles beyond a range and missed stones have to be 0, rates are shares of their
    limits. The friction cone is wider by ROUND_OFF.
    """
    if name == "normal_force":
        return x > 0.0
    cone = (1.0 + ROUND_OFF) * k.friction
    # most: the largest number that is within the limits, 0 of a kind that is not here; SLIP [m]: largest slip
    most = {"friction": cone, "torque": k.torque, "rate": 1.0, "slip": SLIP, IMPULSE: cone}
    fine = x <= most.get(name, 0.0)
    return fine | (x == math.inf) if name == "friction" else fine


def violation(name: str, x: float, k: KnownLimits, j: Joint | None) -> str:
    """Text about a number x of the kind `name` in `REASONS` that is not within its limit in k.

    j: the joint that has the number; None for numbers that belong to no joint. A rate is a share of j.speed
    [rad/s], the joint's limit.
    """
    # without a joint these are placeholders, for sentences that are not chosen then
    i, speed, (low, high) = (j.name, j.speed, j.range) if j else ("a joint", 1.0, (0.0, 0.0))
    over = f"over {1e3 * k.window:g} ms"
    return {
        "normal_force": f"F_N = {x:.3g} N {over}",
        "friction": f"friction {x:.3g} > {k.friction:g} {over}",
        "torque": f"{i} has the torque {x:.4g} N m > {k.torque:g}",
        "rate": f"{i} turns at {x * speed:.4g} rad/s > {speed:g}",
        "range": f"{i} is {x:.3g} rad beyond its range from {low:g} to {high:g} rad",
        "scuffing": f"the swing foot scuffs by {x:.2g} m",
        "slip": f"a foot slips by {1e3 * x:.3g} mm > {1e3 * SLIP:g}",
        "stones": f"the foot lands {1e3 * x:.3g} mm beyond the edge of its stone",
        IMPULSE: f"the impulse at impact asks for friction {ratio_text(x)} > {k.friction:g}",
    }[name]


def at_ends(
    walker: Walker, n: Nodes, k: KnownLimits, impacts: int, after: Array | None = None
) -> dict[str, Array]:
    """The numbers that limits apply to at the ends of the single supports (S,), by name in `REASONS`: of stones
    and impulses. Where friction is not limited, on soft ground, impulses are 0.

    n: the nodes. k: the limits. impacts: number of single supports that ended in an impact. after (2,) [N s]:
    momentum just after the impact with which the walk ends, as no node follows it, else None.
    """
    limited = k.friction < math.inf
    impulses = impulse_ratios(walker, n, impacts, after) if limited else np.zeros(len(n.steps))
    return {"stones": missed_stones(walker, n, impacts), IMPULSE: impulses}


def joint_of(plant: Biped, i: float, step: float) -> Joint:
    """The joint of the URDF with the angle i, from 0, in the single support of this number."""
    # q_1 .. q_p are angles of these joints in odd single supports; in even ones the legs are swapped
    # % p: an entry of swap from p on is joint swap - p with the other sign
    own = plant.motor_joints[1]
    return own[int(i) if step % 2.0 else plant.swap[int(i)] % plant.p]


def supports(
    walker: Walker,
    n: Nodes,
    k: KnownLimits,
    impacts: int,
    after: Array | None = None,
    slips: Sequence[float] | None = None,
) -> tuple[Support, ...]:
    """Extremes of each of the S single supports of a walk, of which the first `impacts` ended in an impact.

    n: the nodes. k: the limits. after (2,) [N s]: momentum just after the impact with which the walk ends, as
    no node follows it, else None. slips: slip of each single support on soft ground [m], in place of the
    friction cone; None on the rigid plant.
    """
    k = k if slips is None else k._replace(friction=math.inf)
    t, plant, count = n.at.t, walker.plant, len(n.steps)
    # rows 0 to 5: the numbers of AT_NODES; 6 to 8: the joint that has each of the last three; 9: with risers
    _, needed = demands(walker, n, k.window, impacts)
    # not strict: the rows of the joints are left out
    worst = dict(zip(AT_NODES, needed, strict=False)) | at_ends(walker, n, k, impacts, after)
    # `demands` has no mean force as F_N = inf and ratio = -inf, a mean that does not push as ratio -inf alone.
    # So a largest ratio of -inf says that no mean force pushed; a least F_N of inf says that there was none, in
    # a single support too short for it. Then the friction is 0, since nothing is to be judged; else the ground
    # never pushed, and it is infinite.
    never = np.where(worst["normal_force"] == np.inf, 0.0, np.inf)
    worst["friction"] = np.where(worst["friction"] == -np.inf, never, worst["friction"])
    worst["slip"] = np.zeros(count) if slips is None else np.asarray(slips, dtype=float)
    # OF_JOINTS: the numbers that belong to one joint: torque, rate, range
    which = needed[len(AT_NODES) : -1].T.tolist() if n.p else [()] * count
    joints = [
        {name: joint_of(plant, i, step) for name, i in zip(OF_JOINTS, each, strict=False)}
        for step, each in zip(n.steps, which, strict=True)
    ]
    numbers = (t[n.last] - t[n.edges[:-1]], needed[-1], *(worst[name] for name in REASONS))
    columns: list[Any] = [n.steps, joints, *(x.tolist() for x in numbers)]
    names = ("step", "joints", "duration", "riser", *REASONS.values())
    rows = (dict(zip(names, row, strict=True)) for row in zip(*columns, strict=True))
    return tuple(Support(**row, limits=k) for row in rows)


class Violation(NamedTuple):
    """The first limit that a walk violates."""

    t: float
    """Time of the violation [s]."""
    support: int
    """Index of its single support, from 0."""
    what: str
    """The violation in words."""


def first_violation(
    walker: Walker,
    n: Nodes,
    k: KnownLimits,
    impacts: int,
    after: Array | None = None,
    slipped: Sequence[float] = (),
) -> Violation | None:
    """Find the first node, impact, or end of a window of the mean force, at which a walk violates a limit, or
    a foot has slipped too far; or None.

    n: its nodes. k: the limits. impacts: number of its single supports that ended in an impact. after (2,)
    [N s]: momentum just after the impact with which the walk ends, as no node follows it, else None. slipped:
    on soft ground, the time [s] in each single support when a foot has slipped by SLIP, infinite for never.
    """
    # slips, then the first violation of each kind; a number that is one per single support counts at its end
    text = f"a foot slips by more than {1e3 * SLIP:g} mm"
    result = [Violation(t, i, text) for i, t in enumerate(slipped) if t < math.inf]
    # rows 0 to 5: the numbers of AT_NODES; rows 6 to 8: the joint that has each of the last three
    needed, _ = demands(walker, n, k.window, impacts)
    which = dict(zip(OF_JOINTS, needed[len(AT_NODES) :], strict=False)) if n.p else {}
    # numbers: what the limits apply to, by the limit's name; not strict: the rows of joints are left out
    numbers = dict(zip(AT_NODES, needed, strict=False)) | at_ends(walker, n, k, impacts, after)
    for name, x in numbers.items():
        # [:1]: the first only, if there is any
        for i in np.flatnonzero(~keeps(name, x, k))[:1]:
            # AT_NODES: names of the numbers that exist at each node, others at the end of a support
            at = i if name in AT_NODES else n.last[i]
            has = name in which  # whether the number belongs to one joint
            joint = joint_of(walker.plant, which[name][i], n.at.step[i]) if has else None
            support = int(np.searchsorted(n.last, at))
            text = violation(name, x[i], k, joint)
            result.append(Violation(float(n.at.t[at]), support, text))
    return min(result, default=None, key=lambda one: one.t)


def missed_stones(walker: Walker, n: Nodes, impacts: int) -> Array:
    """Distance (S,) [m] by which the foot lands off its stone at the end of each single support.

    It is 0 on the stone, without stones, and for the single supports after the first `impacts`, which did not
    end in an impact. n: the nodes; n.steps: numbers of the supports, n.last: their last nodes, (S,) each.
    """
    missed = np.zeros(len(n.steps))
    if walker.stones is not None:
        # from horizontal lengths to lengths along the ground
        lengths = n.at.reading.swing_foot[n.last, 0] / math.cos(walker.ground_slope)
        for k, step in enumerate(n.steps[:impacts]):
            missed[k] = walker.stones.missed(step, float(lengths[k]))
    return missed


def ended_in_impact(arc: Arc) -> bool:
    """Whether a single support ended in an impact of the swing foot."""
    return arc.event is not None and arc.event.guard == FOOT_STRIKE


def after_last_impact(walker: Walker, trajectory: Trajectory) -> Array | None:
    """Momentum m v_com (2,) [N s] after the impact with which a walk ended; None where it ended otherwise."""
    # x_plus: the state (q, q', ..) just after the impact, of which the first 2 n numbers are q and q'
    event, n = trajectory.arcs[-1].event, walker.plant.n
    if not ended_in_impact(trajectory.arcs[-1]) or event is None or event.x_plus is None:
        return None
    return walker.plant.momentum(event.x_plus[:n], event.x_plus[n : 2 * n])


def certificates(
    walker: Walker,
    trajectory: Trajectory,
    signals: Signals,
    limits: Limits | KnownLimits | None = None,
) -> tuple[Certificate, ...]:
    """Certificate of every single support that ended in an impact.

    signals: those of the trajectory. limits: None for those of the robot's record.
    """
    # `of` takes the numbers that the limits leave open from the robot's record
    k = limits or Limits()
    k = k.of(walker.plant.description) if isinstance(k, Limits) else k
    arcs = [arc for arc in trajectory.arcs if ended_in_impact(arc)]
    after = after_last_impact(walker, trajectory)
    result = supports(walker, Nodes.of(signals), k, len(arcs), after)
    # not strict: the last single support, if it is unfinished, has no arc here and no certificate
    pairs = zip(arcs, result, strict=False)
    return tuple(_certificate(walker, signals.of_step(arc.mode.step), arc, s) for arc, s in pairs)


def _certificate(walker: Walker, s: Signals, arc: Arc, support: Support) -> Certificate:
    """Certificate of a step that ended in an impact at x- = (q, q', ...), the end of its arc.

    s: signals of the step. support: its extremes. The height of the swing foot is above the straight lines from
    the foothold that it left to the stance foot and on to the next one. Friction is infinite where the ground
    never pushed.
    """
    b, p = walker.plant, walker.plant.p
    q, v, _ = walker.split_state(arc.x[-1])
    impact = b.impact(q, v)
    since, duration = s.t - s.t[0], s.t[-1] - s.t[0]
    # the middle of the step, up to round-off of times
    # ENDS: share of the step at either end, where the foot may touch the ground
    inner = np.abs(since - 0.5 * duration) < (0.5 - ENDS) * duration - SAME_INSTANT
    (x, z), ends = s.swing_foot.T, np.array([s.swing_foot[0], (0.0, 0.0), s.swing_foot[-1]]).T
    height = z - np.interp(x, *ends)
    power = s.u * s.v[:, :p]
    length = float(b.swing_foot(q)[0]) / math.cos(walker.ground_slope)
    # F (nodes, 2): force along the ground and out of it; its ratio is -inf at nodes where it does not push
    F = s.ground_reaction @ np.array(ground_axes(walker.ground_slope)).T
    friction = float(np.max(ratios(F, -np.inf)))
    return Certificate(
        **vars(support),
        least_normal_force=float(np.min(F[:, 1])),
        friction=math.inf if friction == -math.inf else friction,
        step_length=length,
        old_foot_velocity=float(impact.old_foot_velocity @ ground_axes(walker.ground_slope)[1]),
        clearance=float(np.min(height[inner])),
        joint_work=integrate(s.t, np.sum(power, axis=1)),
        energy_lost=b.kinetic_energy(q, v) - b.kinetic_energy(impact.q, impact.v),
        cost_of_transport=integrate(s.t, np.sum(np.abs(power), axis=1)) / (b.weight * length),
    )
