"""The certificate of a step: what a real robot on dry ground would have needed for it.

A planar model pinned at its foot cannot slip or lift off, so that is looked up afterwards: F_N and friction
|F_T| / F_N at every instant and in the mean over a window, the same ratio of the impulses at impact, whether
the old foot lifts off, scuffing of the swing foot, torque, and the joint work against the energy lost at
impact. On a periodic gait on level ground these two are equal. Forces are those on the plant, along and across
its ground. A step is legal within the `Limits`: by the mean of the force, not by an instant, and not by the
impulse.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from biped_adrc.analysis.quadrature import integrate, window_means
from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.errors import InputError
from biped_adrc.ground import ground_axes
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.robots.robot_toml import ENDS, ROUND_OFF, KnownLimits, Limits
from biped_adrc.shown import Shown
from biped_adrc.types import Array

REASONS = ("normal_force", "friction", "torque", "scuffing")
"""Why a single support is not legal."""


@dataclass(frozen=True)
class Support(Shown):
    """One single support, as far as it went. A friction is infinite where the ground never pushed."""

    step: int
    duration: float
    """[s]."""
    least_normal_force: float
    """F_N at any instant [N]."""
    friction: float
    """Largest |F_T| / F_N of the instants with F_N > 0."""
    share_outside: float
    """Share of the time in which the force is outside the friction cone."""
    mean_normal_force: float
    """Least F_N averaged over the window [N]."""
    mean_friction: float
    """Largest |F_T| / F_N of the forces averaged over the window, of those with F_N > 0."""
    scuffing: float
    """How deep the swing foot is below the lower of the footholds, away from the ends of the step [m]."""
    peak_torque: float
    """[N m]."""
    friction_limit: float
    """mu of the cone that `share_outside` is of."""
    torque_limit: float
    """[N m]."""
    window: float
    """Of the means [s]."""

    def illegal(self, limits: Limits | KnownLimits | None = None) -> dict[str, str]:
        """What is not within the limits, by the names in `REASONS`, in words; empty for a legal step.

        None takes the limits that this was made with, as an open `Limits` does. Raises InputError for limits
        with another window.
        """
        k = self._known(limits)
        over = f"over {1e3 * k.window:g} ms"
        normal, ratio = self.mean_normal_force, self.mean_friction
        contact = "" if math.isfinite(self.friction) else ", no contact"
        found = {}
        if not normal > 0.0:
            found["normal_force"] = f"F_N = {normal:.3g} N {over}{contact}"
        if not (
            ratio <= (1.0 + ROUND_OFF) * k.friction or (ratio == math.inf and not normal > 0.0)
        ):
            found["friction"] = f"friction {ratio:.3g} > {k.friction:g} {over}"
        if not self.peak_torque <= k.torque:
            found["torque"] = f"torque {self.peak_torque:.4g} N m > {k.torque:g}"
        if not self.scuffing <= 0.0:
            found["scuffing"] = f"the swing foot scuffs by {self.scuffing:.2g} m"
        return found

    def _known(self, limits: Limits | KnownLimits | None) -> KnownLimits:
        own = KnownLimits(self.friction_limit, self.torque_limit, self.window)
        if limits is None:
            return own
        if not math.isclose(limits.window, self.window):
            raise InputError(
                f"the certificate is of forces averaged over {self.window:g} s, the limits ask for "
                f"{limits.window:g} s; take the certificates anew, with walk.certified(limits)"
            )
        return KnownLimits(
            own.friction if limits.friction is None else limits.friction,
            own.torque if limits.torque is None else limits.torque,
            own.window,
        )

    def record(self) -> dict[str, float]:
        """As a dictionary of numbers."""
        return asdict(self)


@dataclass(frozen=True)
class Certificate(Support):
    """One single support and the impact that ends it."""

    step_length: float
    """Along the ground [m]."""
    impulse_ratio: float
    """|F_T| / F_N of the impact; infinite where the ground would have had to pull."""
    old_foot_velocity: float
    """Vertical velocity of the old stance foot after impact [m/s]; positive when it lifts off."""
    clearance: float
    """Least height of the swing foot above the ground on which the step ends, over the inner part of the step
    alone: without its first and last 3 % [m]. Negative when it scuffs."""
    joint_work: float
    """int u' q_b' dt [J]."""
    energy_lost: float
    """Kinetic energy lost at impact [J]."""
    cost_of_transport: float
    """int |u_i q_i'| dt over m g times step length, summed over motors."""

    def violations(
        self, limits: Limits | KnownLimits | None = None, clearance: bool = True
    ) -> tuple[str, ...]:
        """What a robot within these limits could not have done; empty when all holds.

        As `illegal`, and that the old foot has to lift off. The impulse ratio is reported without a limit;
        scuffing counts unless `clearance` is False.
        """
        illegal = self.illegal(limits)
        found = [text for name, text in illegal.items() if clearance or name != "scuffing"]
        if not self.old_foot_velocity > 0:
            found.append("the old stance foot does not lift off")
        return tuple(found)


def ratio_text(ratio: float) -> str:
    """A friction in words."""
    return f"{ratio:.3f}" if math.isfinite(ratio) else "no contact"


def certificates(
    walker: Walker, trajectory: Trajectory, signals: Signals, limits: Limits | None = None
) -> tuple[Certificate, ...]:
    """One certificate for every single support that ended in an impact; `limits` as in `supports`."""
    k = (limits or Limits()).of(walker.plant.description)
    return tuple(
        _certificate(walker, signals.of_step(arc.mode.step), arc.event.x_minus, k)
        for arc in trajectory.arcs
        if arc.event is not None and arc.event.guard == FOOT_STRIKE
    )


def supports(
    walker: Walker, trajectory: Trajectory, signals: Signals, limits: Limits | None = None
) -> tuple[Support, ...]:
    """What every single support needed, the last unfinished one too; without limits, those of the robot."""
    k = (limits or Limits()).of(walker.plant.description)
    return tuple(
        support(walker, signals.of_step(arc.mode.step), k, struck(arc)) for arc in trajectory.arcs
    )


def support(walker: Walker, s: Signals, k: KnownLimits, finished: bool = True) -> Support:
    """What the single support in s needed; `finished` where it ended in a foot strike."""
    return Support(**_needs(walker, s, k, finished))


def struck(arc: Arc) -> bool:
    """Whether a single support ended in a foot strike."""
    return arc.event is not None and arc.event.guard == FOOT_STRIKE


def forces(walker: Walker, s: Signals) -> Array:
    """(F_T, F_N) (K, 2) along the ground and out of it [N]."""
    return s.ground_reaction @ np.array(ground_axes(walker.slope)).T


def depths(walker: Walker, s: Signals, finished: bool) -> Array:
    """(K,) how far the swing foot is in the ground, 0 near the ends of the step [m].

    The ground is level with the lower of the two footholds. It counts once the foot has been above it, since
    it may come from lower ground. Of a step that is not finished the end counts.
    """
    height = _height(walker, s) + max(walker.drop(int(s.step[0])), 0.0)
    counts = inner(s.t, finished) & np.logical_or.accumulate(height > 0.0)
    return np.where(counts, np.maximum(-height, 0.0), 0.0)


def inner(t: Array, finished: bool = True) -> NDArray[np.bool_]:
    """(K,) whether a node is away from the ends of the step."""
    since, last = t - t[0], t[-1] - t[0]
    found: NDArray[np.bool_] = since > ENDS * last
    return found & (since < (1.0 - ENDS) * last) if finished else found


def _height(walker: Walker, s: Signals) -> Array:
    """(K,) of the swing foot above the line of the ground through the stance foot, along the vertical [m]."""
    return s.swing_foot[:, 1] + math.tan(walker.slope) * s.swing_foot[:, 0]


def _needs(walker: Walker, s: Signals, k: KnownLimits, finished: bool) -> dict[str, Any]:
    F = forces(walker, s)
    duration = float(s.t[-1] - s.t[0])
    _, means = window_means(s.t, F, k.window)
    out = outside(F, k.friction).astype(float)
    share = float(np.trapezoid(out, s.t)) / duration if duration > 0.0 else float(out[-1])
    return {
        "step": int(s.step[0]),
        "duration": duration,
        "least_normal_force": float(np.min(F[:, 1])),
        "friction": largest_ratio(F),
        "share_outside": share,
        "mean_normal_force": float(np.min(means[:, 1])),
        "mean_friction": largest_ratio(means),
        "scuffing": float(np.max(depths(walker, s, finished))),
        "peak_torque": float(np.max(np.abs(s.u), initial=0.0)),
        "friction_limit": k.friction,
        "torque_limit": k.torque,
        "window": k.window,
    }


def outside(F: Array, mu: float) -> NDArray[np.bool_]:
    """(K,) whether (F_T, F_N) (K, 2) is outside the friction cone; a force that is no number is."""
    return ~((F[:, 1] > 0.0) & (np.abs(F[:, 0]) <= (1.0 + ROUND_OFF) * mu * F[:, 1]))


def largest_ratio(F: Array) -> float:
    """Largest |F_T| / F_N of the rows of F (K, 2) with F_N > 0; infinite without any."""
    pushes = F[F[:, 1] > 0.0]
    if len(pushes) == 0:
        return math.inf
    return float(np.max(np.abs(pushes[:, 0]) / pushes[:, 1]))


def _certificate(walker: Walker, s: Signals, x_minus: Array, k: KnownLimits) -> Certificate:
    b, n, p = walker.plant, walker.plant.n, walker.plant.p
    q, v = x_minus[:n], x_minus[n : 2 * n]
    impact = b.impact(q, v)
    along, across = ground_axes(walker.slope)
    normal = float(impact.impulse @ across)
    height = _height(walker, s) + walker.drop(int(s.step[0]))
    power = s.u * s.v[:, :p]
    length = float(b.swing_foot(q)[0]) / math.cos(walker.slope)
    after = b.kinetic_energy(impact.q, impact.v)
    return Certificate(
        **_needs(walker, s, k, True),
        step_length=length,
        impulse_ratio=float(abs(impact.impulse @ along)) / normal if normal > 0.0 else math.inf,
        old_foot_velocity=float(impact.old_foot_velocity @ across),
        clearance=float(np.min(height[inner(s.t)])),
        joint_work=integrate(s.t, np.sum(power, axis=1)),
        energy_lost=b.kinetic_energy(q, v) - after,
        cost_of_transport=integrate(s.t, np.sum(np.abs(power), axis=1)) / (b.weight * length),
    )
