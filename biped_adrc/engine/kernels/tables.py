"""What a compiled walk is given, and what its codes mean."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from biped_adrc.hybrid.status import Status
from biped_adrc.types import Array

Ints = NDArray[np.int64]

STATUS = (
    Status.COMPLETED,
    Status.TIME_OUT,
    Status.FELL,
    Status.STALLED,
    Status.NOT_FINITE,
    Status.SINGULAR,
    Status.STEP_FAILED,
    Status.EVENT_LIMIT,
)
"""By the code of a kernel; `layout.STRUCK` and `layout.FULL` are no statuses."""


class Code(NamedTuple):
    """Addresses of `void f(double* K, double* inp, double* out)`, 0 for none.

    zeta is (n,) [N m]; pivot, the least of the matrices inverted, makes a state that is not finite SINGULAR
    where it is exactly 0, and is infinite without one.
    """

    flow: int
    """(t, step, t_start, x, zeta) -> (dx, pivot); in sampled time only q and v flow."""
    tick: int
    """(t, step, t_start, x, zeta, outside) -> (x after the tick, pivot, q''), in sampled time. outside (5,):
    force from outside (2) [N], its impulse since the last tick (2) [N s], drop of the ground [m]."""
    strike: int
    """(t, step, x) -> (x+, pivot); step is that of the new single support."""
    watch: int
    """(t, t_start, drop, q) -> witnesses of the guards, in `layout`'s order, and x of the swing foot [m]."""
    to: int = 0
    """x -> y = (w, E), E (k, p) row by row; the coordinates of the exponential method."""
    back: int = 0
    """y -> x."""
    remainder: int = 0
    """(t, step, t_start, y, zeta) -> (N_w, N_E, pivot), N_E (r, p) in the forced rows only."""
    turn: int = 0
    """For a matrix M (k, k) in place of K: E -> M E."""


class Sizes(NamedTuple):
    """n coordinates, nx states, p joints, nw and (k, p) numbers of y = (w, E).

    moving: how many of the first states flow, all for 0; the others are held between ticks.
    """

    n: int
    nx: int
    p: int
    nw: int = 0
    k: int = 0
    moving: int = 0


class Scene(NamedTuple):
    """least_step [m]; drops (m, 2): rows (single support, height [m])."""

    least_step: float
    drops: Array


class PushCode(NamedTuple):
    """zeta as a sum of parts, each a function (t, step, t_start, q, v) -> zeta (n,).

    Part i has the parameters K[offsets[i]:offsets[i + 1]]. switches (m, 2): rows (step, s); the torque is not
    smooth s [s] after that single support began, or for step 0 at the time s.
    """

    addresses: Ints
    K: Array
    offsets: Ints
    switches: Array
    resultants: tuple[int, ...] = ()
    """Addresses of (t, step, t_start, q, v) -> force (2,) [N] on the robot as a whole, 0 for none."""


class Clock(NamedTuple):
    """Ticks every `period` [s], 0 for continuous time, from the arc's start or, without restart, t_first."""

    period: float
    restart: int
    t_first: float
    part: float = 0.0
    """[s] after each tick at which the waiting torque acts, 0 for none."""


class Method(NamedTuple):
    """Step or tolerances, the tableau of DOP853, and for ETD-RK4 phi (levels, 6, k, k) and the forced rows."""

    kind: int
    h: float
    rtol: float
    atol: float
    max_step: float
    A: Array
    B: Array
    C: Array
    E3: Array
    E5: Array
    phi: Array
    rows: Ints


def no_push() -> PushCode:
    """zeta = 0."""
    return PushCode(
        np.zeros(0, dtype=np.int64), np.zeros(0), np.zeros(1, dtype=np.int64), np.zeros((0, 2))
    )


def continuous_time() -> Clock:
    """No ticks."""
    return Clock(0.0, 1, 0.0)
