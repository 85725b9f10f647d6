"""The certificate of a step: what a real robot on dry ground would have needed for it.

A planar model pinned at its foot cannot slip or lift off, so feasibility is checked afterwards: F_N and
friction |F_T| / F_N in the mean over a window (`ground_force`), the same ratio of the impulse at impact,
scuffing of the swing foot, torque. A step is feasible where these are within the `Limits`. A `Certificate`
adds what is known of a step that ended in an impact: whether the old foot lifts off, the forces at every
instant, and the joint work against the energy lost at impact, which on a periodic gait on level ground are
equal. Forces are those on the plant, along and perpendicular to its ground.

`certificates` and `supports` read the nodes of a walk; `feasibility` sums them up for the walk.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import asdict, dataclass
from itertools import repeat

import numpy as np
from numpy.typing import NDArray

from biped_adrc.analysis.ground_force import Nodes, impulse_ratios, mean_forces, ratios
from biped_adrc.analysis.quadrature import integrate
from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.robots.limits import ENDS, ROUND_OFF, SLIP, KnownLimits, Limits

IMPULSE = "impulse"
"""The reason that is counted apart: the impulse at impact alone leaves the friction cone."""
REASONS = ("normal_force", "friction", "torque", "scuffing", "slip", IMPULSE)
"""Why a single support is not feasible: keys of `Support.infeasible`."""


@dataclass(frozen=True)
class Support(Shown):
    """One single support, also an unfinished one. A friction is infinite where the ground never pushed."""

    step: int
    """Number of the single support, from 1."""
    duration: float
    """[s]."""
    mean_normal_force: float
    """Least F_N averaged over the window [N]; infinite where there was no time for one."""
    mean_friction: float
    """Largest |F_T| / F_N of the forces averaged over the window, of those with F_N > 0, dimensionless."""
    scuffing: float
    """How deep the swing foot is below the lower of the footholds, away from the ends of the step [m]."""
    slip: float
    """Largest distance that a foot slips on soft ground [m]; 0 on the rigid plant."""
    peak_torque: float
    """Largest |u_i| [N m]."""
    impulse_ratio: float
    """|F_T| / F_N of the impulse at the impact that ends it: infinite where the ground would have had to
    pull, 0 without an impact.
    """
    friction_limit: float
    """mu of the friction cone; infinite on soft ground, where friction is the simulator's."""
    torque_limit: float
    """Limit of every motor [N m]."""
    window: float
    """Length of the window of the means [s]."""

    def infeasible(self) -> dict[str, str]:
        """What is not within the limits, in words, by the names in `REASONS`; empty for a feasible step."""
        k = KnownLimits(self.friction_limit, self.torque_limit, self.window)
        cone, pulls = (1.0 + ROUND_OFF) * k.friction, not self.mean_normal_force > 0.0
        ratio, never = self.mean_friction, self.mean_friction == math.inf
        checks = {
            "normal_force": (self.mean_normal_force, not pulls),
            "friction": (ratio, ratio <= cone or (never and pulls)),
            "torque": (self.peak_torque, self.peak_torque <= k.torque),
            "scuffing": (self.scuffing, self.scuffing <= 0.0),
            "slip": (self.slip, self.slip <= SLIP),
            IMPULSE: (self.impulse_ratio, self.impulse_ratio <= cone),
        }
        return {name: violation(name, x, k) for name, (x, holds) in checks.items() if not holds}

    def record(self) -> dict[str, float]:
        """All fields as a dictionary of numbers."""
        return asdict(self)


@dataclass(frozen=True)
class Certificate(Support):
    """One single support and the impact that ends it."""

    least_normal_force: float
    """F_N at any instant [N]."""
    friction: float
    """Largest |F_T| / F_N of the instants with F_N > 0, dimensionless."""
    step_length: float
    """Distance of the footholds along the ground [m]."""
    old_foot_velocity: float
    """Velocity of the old stance foot after impact, perpendicular to the ground [m/s]; positive when
    it lifts off.
    """
    clearance: float
    """Least height [m] of the swing foot above the ground on which the step ends, without the first
    and last 3 % of the step. Negative when it scuffs.
    """
    joint_work: float
    """int u' q_b' dt, the net work of the motors [J]."""
    energy_lost: float
    """Kinetic energy lost at impact [J]."""
    cost_of_transport: float
    """int |u_i q_i'| dt, summed over motors, over m g times step length; dimensionless."""

    def violations(self, but: Collection[str] = ()) -> tuple[str, ...]:
        """As `infeasible`, as sentences, and in addition the old foot has to lift off; empty when all holds.

        but: names in `REASONS` that do not count.
        """
        result = [text for name, text in self.infeasible().items() if name not in but]
        if not self.old_foot_velocity > 0:
            result.append("the old stance foot does not lift off")
        return tuple(result)


def ratio_text(ratio: float) -> str:
    """A friction ratio as text; "no contact" where it is infinite."""
    return f"{ratio:.3f}" if math.isfinite(ratio) else "no contact"


def violation(name: str, x: float, k: KnownLimits) -> str:
    """What is wrong with a number x that is not within its limit, in words; name: in `REASONS`."""
    over = f"over {1e3 * k.window:g} ms"
    return {
        "normal_force": f"F_N = {x:.3g} N {over}",
        "friction": f"friction {x:.3g} > {k.friction:g} {over}",
        "torque": f"torque {x:.4g} N m > {k.torque:g}",
        "scuffing": f"the swing foot scuffs by {x:.2g} m",
        "slip": f"a foot slips by {1e3 * x:.2g} mm > {1e3 * SLIP:g}",
        IMPULSE: f"the impulse at impact asks for friction {ratio_text(x)} > {k.friction:g}",
    }[name]


def supports(
    walker: Walker,
    n: Nodes,
    k: KnownLimits,
    impacts: int,
    after: Array | None = None,
    slips: Sequence[float] | None = None,
) -> tuple[Support, ...]:
    """What each of the S single supports needed, of which the first `impacts` ended in an impact.

    after: as of `impulse_ratios`. slips: of each single support on soft ground [m], in place of the friction
    cone; None on the rigid plant.
    """
    first, last, _ = n.supports
    if slips is None:
        slips, impulses = [0.0] * len(first), impulse_ratios(walker, n, impacts, after)
    else:
        k, impulses = k._replace(friction=math.inf), np.zeros(len(first))
    of, _, F = mean_forces(walker, n, k.window)
    normal, friction = np.full(len(first), np.inf), np.full(len(first), -np.inf)
    with np.errstate(invalid="ignore"):  # NaN stays, and is judged
        np.minimum.at(normal, of, F[:, 1])
        np.maximum.at(friction, of, ratios(F, -np.inf))
    friction = np.where(friction == -np.inf, np.where(normal == np.inf, 0.0, np.inf), friction)
    depth = np.maximum.reduceat(depths(walker, n, impacts), first)
    torque = np.maximum.reduceat(np.max(np.abs(n.u), axis=1, initial=0.0), first)
    columns = (n.step[first], n.t[last] - n.t[first], normal, friction, depth, slips, torque)
    numbers = (np.asarray(x).tolist() for x in (*columns, impulses))
    limits = (k.friction, k.torque, k.window)
    return tuple(Support(*row) for row in zip(*numbers, *map(repeat, limits), strict=False))


def depths(walker: Walker, n: Nodes, impacts: int) -> Array:
    """How far the swing foot is below the ground at the nodes (K,) [m], 0 near the ends of a single support.

    The ground is taken at the height of the lower of the two footholds. It counts once the foot has been above
    it, since it may come from lower ground. The end of a single support that is not finished, one behind the
    first `impacts`, counts.
    """
    first, last, of = n.supports
    drops = np.array([max(walker.drop(int(step)), 0.0) for step in n.step[first]])
    height = heights(walker, n) + drops[of]
    since, duration = n.t - n.t[first][of], (n.t[last] - n.t[first])[of]
    counts = since > ENDS * duration
    counts &= (of >= impacts) | (since < (1.0 - ENDS) * duration)
    at = np.arange(len(of))
    rises = np.minimum.reduceat(np.where(height > 0.0, at, len(at)), first)
    return np.where(counts & (at >= rises[of]), np.maximum(-height, 0.0), 0.0)


def heights(walker: Walker, n: Nodes) -> Array:
    """Height (K,) [m] of the swing foot above the line of the ground through the stance foot, vertically."""
    return n.swing_foot[:, 1] + math.tan(walker.slope) * n.swing_foot[:, 0]


def ended_in_impact(arc: Arc) -> bool:
    """Whether a single support ended in an impact of the swing foot."""
    return arc.event is not None and arc.event.guard == FOOT_STRIKE


def after_last_impact(walker: Walker, trajectory: Trajectory) -> Array | None:
    """Momentum (2,) [N s] after the impact with which a walk ended; None where it did not end with one."""
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
    """One certificate for every single support that ended in an impact; None takes the robot's limits."""
    k = limits
    if not isinstance(k, KnownLimits):
        k = (k or Limits()).of(walker.plant.description)
    arcs = [arc for arc in trajectory.arcs if ended_in_impact(arc)]
    after = after_last_impact(walker, trajectory)
    result = supports(walker, Nodes.of(signals), k, len(arcs), after)
    return tuple(
        _certificate(walker, signals.of_step(arc.mode.step), arc, s)
        for arc, s in zip(arcs, result, strict=False)
    )


def _certificate(walker: Walker, s: Signals, arc: Arc, support: Support) -> Certificate:
    """The certificate of a step that ended in an impact at x- = (q, q', ...), the end of its arc."""
    b, p = walker.plant, walker.plant.p
    q, v, _ = walker.split_state(arc.x[-1])
    impact = b.impact(q, v)
    height = heights(walker, Nodes.of(s)) + walker.drop(support.step)
    power = s.u * s.v[:, :p]
    length = float(b.swing_foot(q)[0]) / math.cos(walker.slope)
    after = b.kinetic_energy(impact.q, impact.v)
    F = s.ground_reaction @ np.array(ground_axes(walker.slope)).T
    friction = float(np.max(ratios(F, -np.inf)))
    return Certificate(
        **vars(support),
        least_normal_force=float(np.min(F[:, 1])),
        friction=math.inf if friction == -math.inf else friction,
        step_length=length,
        old_foot_velocity=float(impact.old_foot_velocity @ ground_axes(walker.slope)[1]),
        clearance=float(np.min(height[inner(s.t)])),
        joint_work=integrate(s.t, np.sum(power, axis=1)),
        energy_lost=b.kinetic_energy(q, v) - after,
        cost_of_transport=integrate(s.t, np.sum(np.abs(power), axis=1)) / (b.weight * length),
    )


def inner(t: Array) -> NDArray[np.bool_]:
    """Whether a node is away from both ends of a step by the share ENDS (K,), for its times t (K,) [s]."""
    since, last = t - t[0], t[-1] - t[0]
    result: NDArray[np.bool_] = (since > ENDS * last) & (since < (1.0 - ENDS) * last)
    return result
