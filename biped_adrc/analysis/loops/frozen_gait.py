"""A gait at some of its phases, and the robot linearised there, for a set of inertias.

At a phase of the periodic orbit the robot has (q, q', q''), and a small change of it obeys

    d q'' = A_q dq + A_v dq' + D^-1 B_s du                  about q'' of the orbit

The configuration is frozen: a controller that samples at 1 kHz sees it move by less than 1 % of the
step in a period. The same is done for robots whose trunk and legs are lighter or heavier than the
model. So an error of the model enters as it does in a walk, as a matrix L L_model^-1 with L = (I - H_b -
H_N A_N) kappa in place of one number: it couples the joints and reaches Theta.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from biped_adrc.core.errors import check_positive
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, read_only
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.model.derivatives import acceleration_derivatives

PHASES = (0.15, 0.4, 0.65, 0.9)
"""Shares of the step's time at which a loop is linearised [1]; the first is after the impact's transient."""
SPREAD = 0.2
"""Uncertainty of masses and inertias, as a share of them [1]."""


@dataclass(frozen=True)
class FrozenPoint:
    """The orbit at one phase, and the linearised dynamics (A, B) of each robot there."""

    t: float
    """Time since the step began [s]."""
    q: Array
    """Angles of the orbit (n,) [rad]."""
    v: Array
    """Rates of the orbit (n,) [rad/s]."""
    A: Array
    """(robots, 2 n, 2 n): (q, q')' = A (q, q') + B u for small changes."""
    B: Array
    """(robots, 2 n, p)."""


@dataclass(frozen=True)
class FrozenGait(Shown):
    """A gait linearised at some phases. Make it by `of`, once for all candidates on this robot and gait."""

    points: tuple[FrozenPoint, ...]
    period: float
    """Time of one step of the orbit [s]."""
    falling: float
    """sqrt(g / l) [1/s] of a body as high as the hip: the rate at which the robot falls over its foot."""

    @classmethod
    def of(
        cls,
        plant: Biped,
        gait: Gait,
        model: Biped | None = None,
        phases: tuple[float, ...] = PHASES,
        spread: float = SPREAD,
    ) -> FrozenGait:
        """Linearise the plant, and its like with other inertias, at phases of the gait's orbit.

        model: robot on which the orbit is computed, the plant itself when None. phases: shares of
        the step's time. Raises GaitError for a gait without a periodic orbit, InputError for a
        spread that is not between 0 and 1.
        """
        check_positive(1.0 - spread, f"the spread of inertias is {spread}")
        orbit = ZeroDynamics.of(plant if model is None else model, gait.constraint).cycle
        time = np.cumsum(orbit.time_weights) - 0.5 * orbit.time_weights
        robots = tuple(_robots(plant, spread))
        nodes = [int(np.argmin(np.abs(time - phase * orbit.period))) for phase in phases]
        points = (_point(robots, float(time[k]), orbit.q[k], orbit.v[k], orbit.a[k]) for k in nodes)
        height = float(plant.hip(orbit.q[nodes[0]])[1])
        return cls(tuple(points), orbit.period, float(np.sqrt(plant.description.gravity / height)))


def _robots(plant: Biped, spread: float) -> Iterator[Biped]:
    """Iterate over the plant; all of it lighter and heavier; trunk heavier and legs
    lighter, and the other way round.
    """
    yield plant
    if spread == 0.0:
        return
    d = plant.description
    legs = [link for link in d.links if link != d.trunk]
    for trunk, leg in ((-1, -1), (1, 1), (1, -1), (-1, 1)):
        factors = {d.trunk: 1.0 + trunk * spread} | dict.fromkeys(legs, 1.0 + leg * spread)
        yield plant.with_errors(mass=factors, inertia=factors)


def _point(robots: tuple[Biped, ...], t: float, q: Array, v: Array, a: Array) -> FrozenPoint:
    """Linearise all robots at q, v, a (n,) of the orbit, each under the force that
    gives it this acceleration a.
    """
    n, p = robots[0].n, robots[0].p
    A, B = np.zeros((len(robots), 2 * n, 2 * n)), np.zeros((len(robots), 2 * n, p))
    A[:, :n, n:] = np.eye(n)
    for A_i, B_i, robot in zip(A, B, robots, strict=True):
        force = robot.inertia(q) @ a + robot.bias(q, v)
        if robot.friction:
            force = force - robot.friction_torque(v)
        d = acceleration_derivatives(robot, q, v, force)
        A_i[n:, :n], A_i[n:, n:], B_i[n:] = d.dq, d.dv, d.dforce[:, :p]
    return FrozenPoint(t, read_only(q), read_only(v), read_only(A), read_only(B))
