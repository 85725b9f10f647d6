"""The sample instant (tick) of a walker at frozen phases of its gait, as matrices.

    z+ = Z z + Y (q, q'),     u = C z + E (q, q')                   d z+ / d(z, q, q')

z is the walker's state from tick to tick: controller, observer, sensors with their filter, and the torques
that the controller knows of. The derivative is taken of the methods themselves (`engine.tick_derivative`), so
that the path of an encoder's error through Theta and Theta' is in it, and no controller has a formula here.

Torque and rate limits are left out, and encoder counts are an error that is independent from tick to tick.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.loops.frozen_gait import FrozenPoint
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.errors import InputError
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array
from biped_adrc.engine.tick_derivative import tick_derivative
from biped_adrc.hardware.sample_hold import HeldSizes

TICKS_BEFORE = 2
"""Ticks before the one that is differentiated, after which every sensor has a difference of its angles."""
SAME = 1e-12
"""Largest difference of two columns that count as equal; their largest entry is 1."""


class TickMatrices(NamedTuple):
    """The tick at some phases, their axes in front: k numbers in z, n coordinates, p motors."""

    Z: Array
    """(.., k, k)."""
    Y: Array
    """(.., k, 2 n)."""
    C: Array
    """(.., p, k)."""
    E: Array
    """(.., p, 2 n)."""


def linear_twin(walker: Walker) -> Walker:
    """The walker without its parts that have no derivative: limits, counts, noise, pushes.

    Raises InputError for a walker in continuous time, or one that detects touchdowns.
    """
    if not isinstance(walker.timing, SampledTime):
        raise InputError(
            f"the sampled loop of a walker was asked for, found {walker.timing}; give "
            "timing=SampledTime(period)"
        )
    if walker.touchdown is not None:
        raise InputError(
            "the walker has to notice touchdowns, which is no linear part; expected touchdown=None"
        )
    return replace(
        walker,
        sensors=None if walker.sensors is None else walker.sensors.smooth(),
        torque_limit=None,
        motors=None,
        disturbance=None,
    )


def tick_matrices(twin: Walker, points: Sequence[FrozenPoint]) -> TickMatrices:
    """Linearise the tick of a `linear_twin` at points of the gait; the matrices have a leading axis of points.

    Raises NotFiniteError as `tick_derivative`.
    """
    assert isinstance(twin.timing, SampledTime)
    assert twin.held is not None
    n, T, sizes, mode = twin.plant.n, twin.timing.period, twin.held.sizes, Mode()
    result, ticked = [], None
    for point in points:
        x, J = (
            twin.initial_state(point.q - TICKS_BEFORE * T * point.v, point.v, mode),
            np.zeros((0, 0)),
        )
        ticked = ticked or tick_derivative(twin, len(x))
        for before in range(TICKS_BEFORE, -1, -1):
            x[:n], x[n : 2 * n] = point.q - before * T * point.v, point.v
            x, J = ticked(point.t - before * T, x, mode)
        u, z = J[_newest(sizes, len(x))], _released(sizes, J)[2 * n :]
        result.append((z[:, 2 * n :], z[:, : 2 * n], u[:, 2 * n :], u[:, : 2 * n]))
    return _acting(TickMatrices(*(np.array(x) for x in zip(*result, strict=True))))


def _acting(tick: TickMatrices) -> TickMatrices:
    """Drop the numbers of z on which, at all phases, neither the torque nor the rest of z depends.

    Two numbers that act on everything in the same ratio become one, their weighted sum: as the old angle of an
    encoder and the rate of its filter do.
    """
    Z, Y, C, E = tick
    columns = np.concatenate((*Z, *C)).T
    k = len(columns)
    largest = columns[range(k), np.argmax(np.abs(columns), axis=1)] if k else np.zeros(0)
    shape = columns / np.where(largest == 0.0, 1.0, largest)[:, np.newaxis]
    alike = np.max(np.abs(shape[:, np.newaxis] - shape), axis=-1, initial=0.0) < SAME
    first = np.argmax(alike, axis=1) if k else np.zeros(0, dtype=int)
    some = np.flatnonzero((first == np.arange(k)) & (largest != 0.0))
    if len(some) == k:
        return tick
    share = (first == some[:, np.newaxis]) * largest / largest[some, np.newaxis]
    return _acting(TickMatrices(share @ Z[:, :, some], share @ Y, C[:, :, some], E))


def _newest(sizes: HeldSizes, end: int) -> slice:
    """Slice of x, of `end` numbers, with the torque that this tick has sent.

    It is at the end of the queue, else where it waits, else where it acts on the motors.
    """
    if sizes.queue:
        end -= sizes.p * (1 + sizes.waiting)
    elif sizes.waiting:
        end -= sizes.p
    return slice(end - sizes.p, end)


def _released(sizes: HeldSizes, J: Array) -> Array:
    """J (nx, nx) after the torque that waits for a part of the period has begun to
    act, as `semantics.release`.
    """
    if not sizes.waiting:
        return J
    p, J = sizes.p, J.copy()
    J[-p:] = J[-2 * p : -p]
    return J
