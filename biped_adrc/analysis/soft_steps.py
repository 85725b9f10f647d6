"""Slips, support phases and depths of a walk on soft ground, single support by single support.

Soft ground is that of a simulator with contacts, such as MuJoCo, which records force, place and velocity of
both feet at each node, a stored instant of the run; K nodes make an arc, that of one single support.

    slips        |F_T| >= 0.99 mu F_N (AT_CONE) and |v_T| > slip_speed:  creep below the cone is no slip
    carries      F_N > carrying
    depth        of a foot point below the ground

F_N and F_T are the forces of the ground on a foot out of it and along it, v_T is the foot's velocity along it,
and mu the friction of the ground. Times are of the nodes (`closed_loop.other_plant`), each of which stands for
half the time to its neighbours, so that single support, double support and flight add up to the duration.

`contact_errors` separates the error that a touchdown leaves from the error that a push causes:

    settling   t - start of the single support <= SETTLING, 0.06 s
    pushed     t - (last time at which zeta != 0) <= AFTER, 0.05 s, and not settling; zeta: external torque
    settled    not settling

Contact that takes time moves the joints at every touchdown, whatever the controller. The largest error of a
step is then often this transient, and hides the effect of a push.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.signals import Signals
from biped_adrc.closed_loop.other_plant import FEET
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array, Flags
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.ground import SLIP

AT_CONE = 0.99
"""Share of mu F_N [1] from which on a tangential force is at the cone; the solver does not come closer."""
CARRYING = 1.0
"""Normal force from which on a foot carries weight [N]."""
SLIP_SPEED = 5e-3
"""Tangential speed from which on a foot at the cone slips [m/s]."""
SETTLING = 0.06
"""How long after a touchdown an error is the transient of contact [s]."""
AFTER = 0.05
"""How long after its end a push counts as the cause of an error [s]."""
PRESSED = 20.0
"""Normal force from which on |F_T| / F_N is taken [N]; below, it is a quotient of small numbers."""


@dataclass(frozen=True)
class SoftStep(Shown):
    """One single support on soft ground; pairs are of the stance foot and of the other one."""

    duration: float
    """Duration of the single support [s]."""
    double_support: float
    """Time in which both feet carry [s]."""
    flight: float
    """Time in which no foot carries [s]."""
    slip: tuple[float, float]
    """Distance along the ground while slipping [m]."""
    depth: float
    """Largest penetration [m]."""
    friction_used: float
    """Largest |F_T| / F_N of a foot with F_N > 20 N [1]."""

    @property
    def single_support(self) -> float:
        """Time in which one foot carries [s]."""
        return self.duration - self.double_support - self.flight


def recorded_steps(
    run: Trajectory, friction: float, axes: tuple[Array, Array]
) -> tuple[SoftStep, ...]:
    """Measure every single support of a run on soft ground, the unfinished last one included.

    run: with the readings of the feet at its nodes (`feet.with_readings`); a slip is off by up to the time
    between two nodes times the speed at which it begins. friction: mu of the ground [1]. axes: two unit
    vectors, along the ground and out of it, each (x, z) (2,).
    """
    return tuple(step_of(arc, friction, axes) for arc in run.arcs)


def slip_times(run: Trajectory, friction: float, axes: tuple[Array, Array]) -> tuple[float, ...]:
    """Time of the run [s] at which, in each single support, a foot has slipped by more than SLIP, 5 mm; inf
    for never.

    run: with the readings of the feet at its nodes. friction: mu of the ground [1]. axes: two unit vectors
    (2,), along the ground and out of it. A time is that of the first node beyond SLIP.
    """
    times = list[float]()
    for arc in run.arcs:
        # slips (K, 2): speed along the ground of each foot where it slips, else 0; slipped: the way so far;
        # spans: the time for which each node stands
        force, _, speed = feet_of(arc)
        slips = slipping(force, speed, friction, axes) * np.abs(speed @ axes[0])
        slipped = np.cumsum(spans(arc.t)[:, np.newaxis] * slips, axis=0)
        beyond = np.flatnonzero(np.max(slipped, axis=1) > SLIP)
        times.append(float(arc.t[beyond[0]]) if len(beyond) else math.inf)
    return tuple(times)


def feet_of(arc: Arc) -> list[Array]:
    """Forces [N], places [m] and velocities [m/s] of the feet at the K nodes of an arc, each (K, 2, 2): stance
    foot and the other one, each (x, z).
    """
    # FEET[:3]: names of the recorded forces, places and velocities
    return [arc.read[name].reshape(-1, 2, 2) for name in FEET[:3]]


def step_of(arc: Arc, friction: float, axes: tuple[Array, Array]) -> SoftStep:
    """Measure one single support, from the readings of the feet in its arc.

    friction: mu of the ground [1]. axes: two unit vectors (2,), along the ground and out of it.
    """
    along, out = axes
    force, place, velocity = feet_of(arc)
    # w @ x is the integral of x over the single support; all below is (K, 2), one column per foot
    w, normal, tangential = spans(arc.t), force @ out, np.abs(force @ along)
    # CARRYING: force from which on a foot carries
    speed, carries = np.abs(velocity @ along), normal > CARRYING
    slips = slipping(force, velocity, friction, axes)
    pressed = normal > PRESSED
    # used: |F_T| / F_N where a foot is pressed to the ground by more than PRESSED, else 0
    used = np.divide(tangential, normal, where=pressed, out=np.zeros_like(normal))
    feet, (stance, other) = carries.sum(axis=1), map(float, w @ (slips * speed))
    # feet: number of feet that carry, at each node. FEET[3]: heights (K, 2) of the ground below both feet, of
    # which the part along `out`, less the foot's, is the depth
    return SoftStep(
        duration=float(arc.t[-1] - arc.t[0]),
        double_support=float(w @ (feet == 2)),
        flight=float(w @ (feet == 0)),
        slip=(stance, other),
        depth=float(max(0.0, np.max(arc.read[FEET[3]] * out[1] - place @ out))),
        friction_used=float(np.max(used)),
    )


def slipping(force: Array, speed: Array, friction: float, axes: tuple[Array, Array]) -> Flags:
    """Whether each foot slips (...,), from its force [N] and its velocity `speed` [m/s], (x, z) in (..., 2).

    friction: mu of the ground [1]. axes: two unit vectors (2,), along the ground and out of it.
    """
    along, out = axes
    normal, tangential = force @ out, np.abs(force @ along)
    at_cone = tangential >= AT_CONE * friction * normal
    return (normal > CARRYING) & at_cone & (np.abs(speed @ along) > SLIP_SPEED)


def spans(t: Array) -> Array:
    """Weights (K,) [s] of the trapezoidal rule at times t (K,) [s]: half the time to both neighbours."""
    ways = np.diff(t)
    return 0.5 * (np.append(ways, 0.0) + np.append(0.0, ways))


# -- errors ------------------------------------------------------------------------------------------
class ContactErrors(NamedTuple):
    """Largest absolute tracking errors and their rms over the joints [rad]; None where there is no
    such time.
    """

    touchdown_error: float | None
    """Largest error while contact settles, from the second single support on."""
    pushed_error: float | None
    """Largest error from the onset of a push to `AFTER` its end, where contact has settled."""
    settled_error: float | None
    """Largest error where contact has settled."""
    settled_rms: float | None
    """rms over time where contact has settled."""


def contact_errors(x: Signals) -> ContactErrors:
    """Tracking errors of a walk at its nodes: those of touchdowns, of pushes, and all settled ones.

    The module says which nodes are settling and pushed; the settled ones include the pushed ones.
    """
    _, first, support = np.unique(x.step, return_index=True, return_inverse=True)
    # x.t[first][support]: at each node the time at which its single support began
    settling = x.t - x.t[first][support] <= SETTLING + SAME_INSTANT
    # acted: the last time up to each node at which zeta was not zero, -inf before the first push
    acted = np.maximum.accumulate(np.where(np.any(x.zeta != 0.0, axis=1), x.t, -np.inf))
    pushed = x.t - acted <= AFTER + SAME_INSTANT
    # nodes that a later time follows: of the two nodes at a jump only the second counts in the mean
    lasts = np.append(np.diff(x.t) > 0.0, False)
    settled = x.error[lasts & ~settling]
    return ContactErrors(
        # without the first single support, which no touchdown began
        _largest(x.error[settling & (x.step > x.step[0])]),
        _largest(x.error[pushed & ~settling]),
        _largest(x.error[~settling]),
        math.sqrt(float(np.mean(settled**2))) if settled.size else None,
    )


def _largest(error: Array) -> float | None:
    """Largest |error| [rad]; None of an empty array."""
    return float(np.max(np.abs(error))) if error.size else None
