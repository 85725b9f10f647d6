"""A walk from Python: the kernels with arrays made for them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.engine.kernels.plan import Plan, plan
from biped_adrc.engine.kernels.tables import Clock, Code, Method, Push, Scene, Sizes
from biped_adrc.errors import InputError
from biped_adrc.types import Array


class Walked(NamedTuple):
    """How a walk ended."""

    code: int
    """Of `tables.STATUS`."""
    impacts: int
    t: float
    """[s]"""
    x: Array
    """x+ after the last impact asked for, the last good state otherwise (nx,)."""
    step: int
    t_start: float
    """[s]"""


class ArcRun(NamedTuple):
    """Nodes of one arc and how it ended."""

    code: int
    """Of `tables.STATUS`, or `layout.STRUCK`; x is then x-."""
    s: Array
    """The run's vector at the end."""
    t: Array
    """(m,) [s]"""
    x: Array
    """(m, nx)"""
    dx: Array
    """(m, nx)"""


def walk(
    code: Code,
    K: Array,
    sizes: Sizes,
    scene: Scene,
    push: Push,
    clock: Clock,
    method: Method,
    x: Array,
    t: float,
    step: int,
    t_start: float,
    t_end: float,
    impacts: int,
    x_minus: Array,
    x_plus: Array,
    times: Array,
) -> Walked:
    """From x at t [s], in the single support `step` that began at t_start [s], over `impacts` foot strikes.

    For impacts = 0 until t_end [s]. Row i of x_minus, x_plus (m, nx) and times (m,) is strike i; more than m
    strikes are EVENT_LIMIT. Raises InputError for a start or buffers that do not fit.
    """
    made = plan(code, sizes, scene, push, clock, method)
    return walk_plan(made, K, x, t, step, t_start, t_end, impacts, x_minus, x_plus, times)


def walk_plan(
    made: Plan,
    K: Array,
    x: Array,
    t: float,
    step: int,
    t_start: float,
    t_end: float,
    impacts: int,
    x_minus: Array,
    x_plus: Array,
    times: Array,
) -> Walked:
    """`walk` with a plan made before."""
    m, nx = len(times), made.nx
    if x_minus.shape != (m, nx) or x_plus.shape != (m, nx):
        raise InputError(
            f"x- and x+ have shapes {x_minus.shape} and {x_plus.shape}, expected ({m}, {nx}) for {m} times"
        )
    if not (math.isfinite(t) and math.isfinite(t_end) and t_end > t):
        raise InputError(f"the run would go from {t} s to {t_end} s; expected a positive duration")
    s, strikes = made.start(x, t, step, t_start, t_end), np.zeros((m, 1 + 2 * nx))
    status, count = kernels().stride(made.P, made.F, K, made.work(), s, impacts, strikes)
    times[:count] = strikes[:count, 0]
    x_minus[:count], x_plus[:count] = strikes[:count, 1 : 1 + nx], strikes[:count, 1 + nx :]
    head = s[[layout.TIME, layout.STEP, layout.START]].tolist()
    return Walked(status, count, head[0], s[layout.HEAD :].copy(), int(head[1]), head[2])


def arc(made: Plan, K: Array, s: Array, every: int = 1, room: int = 1024) -> ArcRun:
    """One arc from the run's vector s to its first event or END, every k-th step kept; s stays as it was."""
    nx, W = made.nx, made.work()
    while True:
        end, R = s.copy(), np.empty((room, 1 + 2 * nx))
        end[layout.EVERY], end[layout.COUNT] = every, 0.0
        code = kernels().arc(made.P, made.F, K, W, end, R)
        if code != layout.FULL:
            R = R[: int(end[layout.COUNT])]
            return ArcRun(code, end, R[:, 0], R[:, 1 : 1 + nx], R[:, 1 + nx :])
        room *= 2
