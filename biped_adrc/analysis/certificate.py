"""The certificate of a step: what a real robot on dry ground would have needed for it.

A planar model pinned at its foot cannot slip or lift off, so feasibility is checked afterwards: F_N
and friction |F_T| / F_N at every instant and in the mean over a window, the same ratio of the
impulses at impact, whether the old foot lifts off, scuffing of the swing foot, torque, and the
joint work against the energy lost at impact. On a periodic gait on level ground these two are
equal. Forces are those on the plant, along and perpendicular to its ground. A step is feasible within
the `Limits`: by the mean of the force, not by an instant, and by the impulse of its impact.

`certificates` and `supports` read the `Signals` of a walk; `feasibility` sums them up for the walk.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

from biped_adrc.analysis.quadrature import integrate, window_means
from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.errors import InputError
from biped_adrc.ground import ground_axes
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.robots.limits import ENDS, ROUND_OFF, SLIP, KnownLimits, Limits, completed
from biped_adrc.shown import Shown
from biped_adrc.types import Array

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
    least_normal_force: float
    """F_N at any instant [N]."""
    friction: float
    """Largest |F_T| / F_N of the instants with F_N > 0, dimensionless."""
    share_outside: float
    """Share of the time in which the force is outside the friction cone, from 0 to 1."""
    mean_normal_force: float
    """Least F_N averaged over the window [N]."""
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

    def infeasible(self, limits: Limits | KnownLimits | None = None) -> dict[str, str]:
        """What is not within the limits, in words, by the names in `REASONS`; empty for a feasible step.

        limits: None takes those that this was made with; a None inside `Limits` does so, too.
        Raises InputError for limits with another window, since the means would have to be computed
        anew.
        """
        k = self._known(limits)
        over = f"over {1e3 * k.window:g} ms"
        normal, ratio = self.mean_normal_force, self.mean_friction
        contact = "" if math.isfinite(self.friction) else ", no contact"
        found = {}
        if not normal > 0.0:
            found["normal_force"] = f"F_N = {normal:.3g} N {over}{contact}"
        cone = (1.0 + ROUND_OFF) * k.friction
        if not (ratio <= cone or (ratio == math.inf and not normal > 0.0)):
            found["friction"] = f"friction {ratio:.3g} > {k.friction:g} {over}"
        if not self.peak_torque <= k.torque:
            found["torque"] = f"torque {self.peak_torque:.4g} N m > {k.torque:g}"
        if not self.scuffing <= 0.0:
            found["scuffing"] = f"the swing foot scuffs by {self.scuffing:.2g} m"
        if not self.slip <= SLIP:
            found["slip"] = f"a foot slips by {1e3 * self.slip:.2g} mm > {1e3 * SLIP:g}"
        if not self.impulse_ratio <= cone:
            found[IMPULSE] = impulse_text(self.impulse_ratio, k)
        return found

    def _known(self, limits: Limits | KnownLimits | None) -> KnownLimits:
        """The limits with every number known. Raises InputError for another window."""
        own = KnownLimits(self.friction_limit, self.torque_limit, self.window)
        if limits is None:
            return own
        if not math.isclose(limits.window, self.window):
            raise InputError(
                f"the certificate is of forces averaged over {self.window:g} s, the limits ask for "
                f"{limits.window:g} s; take the certificates anew, with walk.certified(limits)"
            )
        return completed(limits, own)

    def record(self) -> dict[str, float]:
        """All fields as a dictionary of numbers."""
        return asdict(self)


@dataclass(frozen=True)
class Certificate(Support):
    """One single support and the impact that ends it."""

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

    def violations(
        self, limits: Limits | KnownLimits | None = None, but: Collection[str] = ()
    ) -> tuple[str, ...]:
        """As `infeasible`, as sentences, and in addition the old foot has to lift off; empty when all holds.

        but: names in `REASONS` that do not count.
        """
        found = [text for name, text in self.infeasible(limits).items() if name not in but]
        if not self.old_foot_velocity > 0:
            found.append("the old stance foot does not lift off")
        return tuple(found)


def ratio_text(ratio: float) -> str:
    """A friction ratio as text; "no contact" where it is infinite."""
    return f"{ratio:.3f}" if math.isfinite(ratio) else "no contact"


def impulse_text(ratio: float, k: KnownLimits) -> str:
    """What an impulse outside the friction cone asks for, in words."""
    return f"the impulse at impact asks for friction {ratio_text(ratio)} > {k.friction:g}"


def certificates(
    walker: Walker, trajectory: Trajectory, signals: Signals, limits: Limits | None = None
) -> tuple[Certificate, ...]:
    """One certificate for every single support that ended in an impact; None takes the robot's limits."""
    k = (limits or Limits()).of(walker.plant.description)
    return tuple(
        _certificate(walker, signals.of_step(arc.mode.step), arc, k)
        for arc in trajectory.arcs
        if ended_in_impact(arc)
    )


def supports(
    walker: Walker,
    trajectory: Trajectory,
    signals: Signals,
    limits: Limits | None = None,
    slips: Sequence[float] | None = None,
) -> tuple[Support, ...]:
    """What every single support needed, the last unfinished one included; None takes the robot's limits.

    slips: of each single support on soft ground [m], in place of the friction cone; None on the rigid plant.
    """
    k, arcs = (limits or Limits()).of(walker.plant.description), trajectory.arcs
    if slips is None:
        asked = [impulse_ratio(walker, arc) for arc in arcs]
        rest = [(0.0, ratio) for ratio in asked]
    else:
        k, rest = k._replace(friction=math.inf), [(slip, 0.0) for slip in slips]
    return tuple(
        support(walker, signals.of_step(arc.mode.step), k, ended_in_impact(arc), *of)
        for arc, of in zip(arcs, rest, strict=True)
    )


def support(
    walker: Walker,
    s: Signals,
    k: KnownLimits,
    finished: bool = True,
    slip: float = 0.0,
    ratio: float = 0.0,
) -> Support:
    """What the single support in s needed; `finished` where it ended in an impact.

    s: the signals of this single support alone; k: the limits, for the window and the friction
    cone; slip [m]: of a foot on soft ground; ratio: of the impulse at its end.
    """
    F = forces(walker, s)
    duration = float(s.t[-1] - s.t[0])
    _, means = window_means(s.t, F, k.window)
    out = outside(F, k.friction).astype(float)
    share = float(np.trapezoid(out, s.t)) / duration if duration > 0.0 else float(out[-1])
    return Support(
        step=int(s.step[0]),
        duration=duration,
        least_normal_force=float(np.min(F[:, 1])),
        friction=largest_ratio(F),
        share_outside=share,
        mean_normal_force=float(np.min(means[:, 1])),
        mean_friction=largest_ratio(means),
        scuffing=float(np.max(depths(walker, s, finished))),
        slip=slip,
        peak_torque=float(np.max(np.abs(s.u), initial=0.0)),
        impulse_ratio=ratio,
        friction_limit=k.friction,
        torque_limit=k.torque,
        window=k.window,
    )


def ended_in_impact(arc: Arc) -> bool:
    """Whether a single support ended in an impact of the swing foot."""
    return arc.event is not None and arc.event.guard == FOOT_STRIKE


def forces(walker: Walker, s: Signals) -> Array:
    """(F_T, F_N) (K, 2) [N], along the ground and perpendicular to it."""
    return s.ground_reaction @ np.array(ground_axes(walker.slope)).T


def depths(walker: Walker, s: Signals, finished: bool) -> Array:
    """How far the swing foot is below the ground (K,) [m], 0 near the ends of the step.

    The ground is taken at the height of the lower of the two footholds. It counts once the foot has
    been above it, since it may come from lower ground. The end of a step that is not finished
    counts.
    """
    height = _height(walker, s) + max(walker.drop(int(s.step[0])), 0.0)
    counts = inner(s.t, finished) & np.logical_or.accumulate(height > 0.0)
    return np.where(counts, np.maximum(-height, 0.0), 0.0)


def inner(t: Array, finished: bool = True) -> NDArray[np.bool_]:
    """Whether a node is away from the ends of the step (K,), for the times t (K,) [s].

    The share ENDS of the step is left out at the begin, and at the end where it is finished.
    """
    since, last = t - t[0], t[-1] - t[0]
    found: NDArray[np.bool_] = since > ENDS * last
    return found & (since < (1.0 - ENDS) * last) if finished else found


def _height(walker: Walker, s: Signals) -> Array:
    """Height (K,) [m] of the swing foot above the line of the ground through the stance foot, measured
    vertically.
    """
    return s.swing_foot[:, 1] + math.tan(walker.slope) * s.swing_foot[:, 0]


def outside(F: Array, mu: float) -> NDArray[np.bool_]:
    """Whether (F_T, F_N) (K, 2) [N] is outside the friction cone (K,); a force with NaN is."""
    return ~((F[:, 1] > 0.0) & (np.abs(F[:, 0]) / ((1.0 + ROUND_OFF) * mu) <= F[:, 1]))


def largest_ratio(F: Array) -> float:
    """Largest |F_T| / F_N of the rows of F (K, 2) [N] with F_N > 0; infinite if there is none."""
    pushes = F[F[:, 1] > 0.0]
    if len(pushes) == 0:
        return math.inf
    return float(np.max(np.abs(pushes[:, 0]) / pushes[:, 1]))


def impulse_ratio(walker: Walker, arc: Arc) -> float:
    """|F_T| / F_N of the impulse that ends an arc: infinite where the ground would pull, 0 without one."""
    if not ended_in_impact(arc):
        return 0.0
    impulse = walker.plant.impact(*walker.split_state(arc.x[-1])[:2]).impulse
    return largest_ratio(impulse[np.newaxis] @ np.array(ground_axes(walker.slope)).T)


def _certificate(walker: Walker, s: Signals, arc: Arc, k: KnownLimits) -> Certificate:
    """The certificate of a step that ended in an impact at x- = (q, q', ...), the end of its arc."""
    b, p = walker.plant, walker.plant.p
    q, v, _ = walker.split_state(arc.x[-1])
    impact = b.impact(q, v)
    height = _height(walker, s) + walker.drop(int(s.step[0]))
    power = s.u * s.v[:, :p]
    length = float(b.swing_foot(q)[0]) / math.cos(walker.slope)
    after = b.kinetic_energy(impact.q, impact.v)
    return Certificate(
        **vars(support(walker, s, k, ratio=impulse_ratio(walker, arc))),
        step_length=length,
        old_foot_velocity=float(impact.old_foot_velocity @ ground_axes(walker.slope)[1]),
        clearance=float(np.min(height[inner(s.t)])),
        joint_work=integrate(s.t, np.sum(power, axis=1)),
        energy_lost=b.kinetic_energy(q, v) - after,
        cost_of_transport=integrate(s.t, np.sum(np.abs(power), axis=1)) / (b.weight * length),
    )
