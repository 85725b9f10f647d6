"""A gait at some of its phases, and the robot linearised there, for a set of inertias.

A phase is here a share of the time of a walking step. At a phase of the periodic orbit the robot has (q, q',
q''), and a small change of it obeys

    d q'' = A_q dq + A_v dq' + D^-1 B_s du                  about q'' of the orbit

    q              the n coordinates [rad]; q_b are the first p, the joints with motors, q_N is the pitch
    u              torques (p,) [N m] of the motors; B_s = [1; 0] (n, p) puts them into the rows of q_b
    D              inertia matrix (n, n) [kg m^2]
    A_q, A_v       derivatives of q'' with respect to q and q' (n, n)
    kappa          gain of the torques in q_b'' = kappa u + .., (p, p) [1/(kg m^2)]

The configuration is frozen: a controller that samples at 1 kHz sees it move by less than 1 % of the step in a
period.

The same is done for robots whose trunk and legs are lighter or heavier than the model: both lighter, both
heavier, and one lighter with the other heavier, four robots in all. The reference of q_b moves with the phase
Theta of the gait, q_d'' = drift + [H_b H_N] q'', and the unactuated row is q_N'' = A_N q_b'' + a_N. So the gain
from u to the second derivative of the tracking error q_b - q_d is

    L = (1 - H_b - H_N A_N) kappa       (p, p)

In `analysis.observer` an error of the model is one factor on kappa. Here, as in a walk, it is a matrix: L of
the robot times the inverse of L of the model. It is not diagonal, so an error of the model couples the joints,
and it depends on the reference, through H.

`tick_matrices` linearises the sample instant (tick) of a walker at the same phases:

    z+ = Z z + Y (q, q'),     u = C z + E (q, q')

for small changes of all; + is just after the tick. z is the walker's state from tick to tick: controller,
observer, sensors with their filter, and the torques that the controller knows of. The derivative is taken of
the methods themselves (`analysis.tick_derivative`), not of a formula for each controller; so it has the path of
an encoder's error through Theta and Theta' too.

Torque and rate limits are left out, and encoder counts are an error that is independent from tick to tick.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np

from biped_adrc.analysis.tick_derivative import tick_derivative
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.errors import InputError, check_positive
from biped_adrc.core.shown import Shown
from biped_adrc.core.tree import Layout
from biped_adrc.core.types import Array, read_only
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.model.derivatives import acceleration_derivatives
from biped_adrc.model.model_errors import ModelErrors

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
    """sqrt(g / l) [1/s], l the height of the hip: the rate at which the robot falls over its foot."""

    @classmethod
    def of(
        cls,
        plant: Biped,
        gait: Gait,
        model: Biped | None = None,
        phases: tuple[float, ...] = PHASES,
        spread: float = SPREAD,
    ) -> Self:
        """Linearise the plant, and its like with other inertias, at phases of the gait's orbit.

        model: robot on which the orbit is computed, the plant itself when None. phases: shares of the step's
        time [1]; the nearest stored instant (node) of the orbit is taken. spread: share [1] by which masses
        and inertias of the four other robots differ (`_robots`); 0 for the plant alone. Raises GaitError for
        a gait without a periodic orbit, InputError for a spread that is not between 0 and 1.
        """
        # below 1, since no mass may become zero
        check_positive(1.0 - spread, f"the spread of inertias is {spread}")
        orbit = ZeroDynamics.of(plant if model is None else model, gait.constraint).cycle
        # times of the orbit's nodes, each in the middle of its weight
        time = np.cumsum(orbit.time_weights) - 0.5 * orbit.time_weights
        robots = tuple(_robots(plant, spread))
        nodes = [int(np.argmin(np.abs(time - phase * orbit.period))) for phase in phases]
        points = (_point(robots, float(time[k]), orbit.q[k], orbit.v[k], orbit.a[k]) for k in nodes)
        height = float(plant.hip(orbit.q[nodes[0]])[1])
        return cls(tuple(points), orbit.period, float(np.sqrt(plant.description.gravity / height)))


def _robots(plant: Biped, spread: float) -> Iterator[Biped]:
    """Iterate over the plant and four robots like it: all lighter, all heavier, trunk heavier and legs lighter,
    trunk lighter and legs heavier, masses and inertias each by the share `spread` [1]; the plant alone for 0.
    """
    yield plant
    if spread == 0.0:
        return
    d = plant.description
    legs = [link for link in d.links if link != d.trunk]
    for trunk, leg in ((-1, -1), (1, 1), (1, -1), (-1, 1)):
        errors = {d.trunk: trunk * spread} | dict.fromkeys(legs, leg * spread)
        yield ModelErrors(errors, inertia=errors).apply(plant)


def _point(robots: tuple[Biped, ...], t: float, q: Array, v: Array, a: Array) -> FrozenPoint:
    """Linearise all robots at q [rad], v, a (n,) of the orbit at t [s] after its step began, each under the
    force that gives it this acceleration a.
    """
    # A = [[0, 1], [A_q, A_v]], B = [0; D^-1 B_s] of each robot
    n, p = robots[0].n, robots[0].p
    A, B = np.zeros((len(robots), 2 * n, 2 * n)), np.zeros((len(robots), 2 * n, p))
    A[:, :n, n:] = np.eye(n)
    for A_i, B_i, robot in zip(A, B, robots, strict=True):
        d = acceleration_derivatives(robot, q, v, a)
        A_i[n:, :n], A_i[n:, n:], B_i[n:] = d.dq, d.dv, d.dforce[:, :p]
    return FrozenPoint(t, read_only(q), read_only(v), read_only(A), read_only(B))


TICKS_BEFORE = 2
"""Ticks before the one that is differentiated, after which every sensor has a difference of its angles."""
SHIFT = 1e-6
"""By how much a shifted walker differs from its twin [rad, rad/s]."""
_SAME = 1e-12
"""Largest difference of two columns that count as equal; their largest entry is 1."""


class TickMatrices(NamedTuple):
    """Matrices of the module's tick at some phases (first axes); k numbers in z, n coordinates, p motors."""

    Z: Array
    """(.., k, k)."""
    Y: Array
    """(.., k, 2 n)."""
    C: Array
    """(.., p, k)."""
    E: Array
    """(.., p, 2 n)."""

    def reading(self, columns: slice) -> Self:
        """The tick that reads these columns of Y and E alone."""
        return self._replace(Y=self.Y[..., columns], E=self.E[..., columns])


def linear_twin(walker: Walker) -> Walker:
    """The walker without its parts that have no derivative: limits, counts, noise, pushes.

    Its motors are left out too, since `walker_loop` adds their lag to the robot. Raises InputError for a walker
    in continuous time, or one that detects touchdowns.
    """
    if not walker.sampled or walker.touchdown is not None:
        raise InputError(
            f"the sampled loop of a walker was asked for, found {walker.timing} and touchdown="
            f"{walker.touchdown}; expected SampledTime(period), and None, since to notice is no linear part"
        )
    # smooth: the sensors without counts and noise
    smooth = None if walker.sensors is None else walker.sensors.smooth()
    return replace(walker, sensors=smooth, torque_limit=None, motors=None, disturbance=None)


def tick_matrices(
    twin: Walker, points: Sequence[FrozenPoint], shifted: Sequence[tuple[Walker, Walker]] = ()
) -> TickMatrices:
    """Linearise the tick of a walker at points of the gait; the matrices have a leading axis of points.

    twin: the walker without limits, counts and noise, from `linear_twin`. J is the derivative dx+/dx of the
    state x = (q, q', z); numbers of z without effect are dropped. shifted: pairs of walkers that differ from
    the twin by +SHIFT and -SHIFT in one number; Y and E have one more column per pair, the derivative by it.

    Raises NotFiniteError where a method has no finite derivative there, InputError for shifted walkers whose
    law does not compile, since one that branches on numbers is not linear.
    """
    n, T, mode = twin.plant.n, twin.clock.period, Mode()
    # ticked(t, x, mode) -> x after the tick, J; it is made once, for the first point
    result, ticked = [], None
    for point in points:
        # TICKS_BEFORE: after these each sensor has a difference of its angles
        x = twin.initial_state(point.q - TICKS_BEFORE * T * point.v, point.v, mode)
        layout = twin.layout_of(x)
        ticked = ticked or tick_derivative(twin, layout, exact=len(shifted) > 0)
        # the earlier ticks, at points that the rates v of the orbit lead to the frozen one, only fill the
        # memory of the sensors; J of the last one is kept
        for before in range(TICKS_BEFORE, -1, -1):
            x[:n], x[n : 2 * n] = point.q - before * T * point.v, point.v
            start = x
            x, J = ticked(point.t - before * T, x, mode)
        # behind the columns of x those of the shifted numbers
        for above, below in shifted:
            ends = [each.tick(point.t, start, mode) for each in (above, below)]
            J = np.column_stack((J, (ends[0] - ends[1]) / (2.0 * SHIFT)))
        # a row of J belongs to one number of x+, so J.T has x+ along its last axis, as a layout expects it.
        # u: the rows of J of the torque that this tick has sent. z: the rows of z, later in the period, when a
        # torque that waits for a fraction of it has begun to act in place of the one before (`_released`). Of
        # the columns the first 2 n are those of (q, q'), the others those of z
        u, z = layout.tree(J.T).tail.line.sent.T, _released(layout, J)[2 * n :]
        own = np.arange(2 * n, layout.size)  # columns of z
        result.append((z[:, own], np.delete(z, own, axis=1), u[:, own], np.delete(u, own, axis=1)))
    # _acting: drops the numbers of z without effect
    return _acting(TickMatrices(*(np.array(x) for x in zip(*result, strict=True))))


def _acting(tick: TickMatrices) -> TickMatrices:
    """The tick without the numbers of z on which, at all phases, neither the torque nor z+ depends.

    Numbers whose columns of Z and C are proportional, such as the old angle of an encoder and the rate of its
    filter, have the same effect and become one, their weighted sum. Without the dropped numbers others may have
    no effect, so the function calls itself until none is dropped.
    """
    Z, Y, C, E = tick
    columns = np.concatenate((*Z, *C)).T  # row i: all effects of number i of z
    k = len(columns)
    # shape: columns over their largest entries, alike: pairs of proportional columns, first: first of each kind
    largest = columns[range(k), np.argmax(np.abs(columns), axis=1)] if k else np.zeros(0)
    shape = columns / np.where(largest == 0.0, 1.0, largest)[:, np.newaxis]
    # _SAME: columns that differ by less count as equal
    alike = np.max(np.abs(shape[:, np.newaxis] - shape), axis=-1, initial=0.0) < _SAME
    first = np.argmax(alike, axis=1) if k else np.zeros(0, dtype=int)
    some = np.flatnonzero((first == np.arange(k)) & (largest != 0.0))
    if len(some) == k:
        return tick
    # share (kept numbers, k): the kept number becomes the sum of all of its kind, each with the factor of its
    # column
    share = (first == some[:, np.newaxis]) * largest / largest[some, np.newaxis]
    return _acting(TickMatrices(share @ Z[:, :, some], share @ Y, C[:, :, some], E))


def _released(layout: Layout, J: Array) -> Array:
    """The derivative J = dx+/dx (nx, nx) of a tick, with x+ taken later: when a torque that waits for a part
    of the period begins to act. Its rows replace those of u, the torque that acts. Unchanged where none waits,
    for a delay of whole periods.
    """
    # at that instant the waiting torque is only copied to u, so the derivative moves the same rows
    u, waiting = (layout.place("tail", "line", name) for name in ("u", "waiting"))
    if waiting.start < waiting.stop:
        J = J.copy()
        J[u] = J[waiting]
    return J
