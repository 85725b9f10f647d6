"""The certificate of a step: what a real robot on dry ground would have needed for it.

A planar model pinned at its foot cannot slip or lift off, so that is looked up afterwards:
F_N > 0, friction |F_T| / F_N, the same ratio of the impulses at impact, whether the old foot lifts off,
scuffing of the swing foot, torque, and the joint work against the energy lost at impact. On a periodic gait on
level ground these two are equal.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass

import numpy as np

from biped_adrc.analysis.quadrature import integrate
from biped_adrc.analysis.signals import Signals
from biped_adrc.ground import ground_axes
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Walker

ENDS = 0.03  # share of a step at either end in which the swing foot may be at the ground


@dataclass(frozen=True)
class Certificate:
    """One single support and the impact that ends it."""

    step: int
    duration: float
    """[s]."""
    step_length: float
    """Along the ground [m]."""
    least_normal_force: float
    """F_N [N]."""
    friction: float
    """Largest |F_T| / F_N."""
    impulse_ratio: float
    """|F_T| / F_N of the impact."""
    old_foot_velocity: float
    """Vertical velocity of the old stance foot after impact [m/s]; positive when it lifts off."""
    clearance: float
    """Least height of the swing foot away from the ends of the step [m]; negative when it scuffs."""
    peak_torque: float
    """[N m]."""
    joint_work: float
    """int u' q_b' dt [J]."""
    energy_lost: float
    """Kinetic energy lost at impact [J]."""
    cost_of_transport: float
    """int |u_i q_i'| dt over m g times step length, summed over motors."""

    def violations(
        self, friction: float = 0.6, torque: float = 150.0, clearance: bool = True
    ) -> tuple[str, ...]:
        """What a robot with this friction and torque [N m] could not have done; empty when all holds.

        The impulse ratio is reported without a limit; scuffing counts unless `clearance` is False.
        """
        found = []
        if not self.least_normal_force > 0:
            found.append(f"F_N = {self.least_normal_force:.3g} N")
        if not self.friction <= friction:
            found.append(f"friction {self.friction:.3g} > {friction:g}")
        if not self.peak_torque <= torque:
            found.append(f"torque {self.peak_torque:.4g} N m > {torque:g}")
        if clearance and not self.clearance > 0:
            found.append(f"the swing foot scuffs by {-self.clearance:.2g} m")
        if not self.old_foot_velocity > 0:
            found.append("the old stance foot does not lift off")
        return tuple(found)

    def record(self) -> dict[str, float]:
        """As a dictionary of numbers."""
        return asdict(self)


def certificates(
    walker: Walker, trajectory: Trajectory, signals: Signals
) -> tuple[Certificate, ...]:
    """One certificate for every single support that ended in an impact."""
    return tuple(
        _certificate(walker, signals.of_step(arc.mode.step), arc.event.x_minus)
        for arc in trajectory.arcs
        if arc.event is not None and arc.event.guard == FOOT_STRIKE
    )


def _certificate(walker: Walker, s: Signals, x_minus: Array) -> Certificate:
    b, n, p = walker.plant, walker.plant.n, walker.plant.p
    q, v = x_minus[:n], x_minus[n : 2 * n]
    impact = b.impact(q, v)
    along, across = ground_axes(walker.slope)
    F_T, F_N = s.ground_reaction @ along, s.ground_reaction @ across
    height = s.swing_foot[:, 1] + math.tan(walker.slope) * s.swing_foot[:, 0]
    height += walker.drop(int(s.step[0]))
    time = s.t - s.t[0]
    inner = (time > ENDS * time[-1]) & (time < (1.0 - ENDS) * time[-1])
    power = s.u * s.v[:, :p]
    length = float(b.swing_foot(q)[0]) / math.cos(walker.slope)
    after = b.kinetic_energy(impact.q, impact.v)
    return Certificate(
        step=int(s.step[0]),
        duration=float(time[-1]),
        step_length=length,
        least_normal_force=float(np.min(F_N)),
        friction=float(np.max(np.abs(F_T) / np.where(F_N > 0, F_N, np.nan))),
        impulse_ratio=float(abs(impact.impulse @ along) / (impact.impulse @ across)),
        old_foot_velocity=float(impact.old_foot_velocity @ across),
        clearance=float(np.min(height[inner])),
        peak_torque=float(np.max(np.abs(s.u), initial=0.0)),
        joint_work=integrate(s.t, np.sum(power, axis=1)),
        energy_lost=b.kinetic_energy(q, v) - after,
        cost_of_transport=integrate(s.t, np.sum(np.abs(power), axis=1)) / (b.weight * length),
    )
