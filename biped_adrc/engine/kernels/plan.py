"""What a run needs, flattened into the integers P and floats F of the kernels, once for any number of runs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.tables import Clock, Code, Ints, Method, PushCode, Scene, Sizes
from biped_adrc.errors import InputError
from biped_adrc.types import Array

LEAST_PERIOD = 1e-9
"""[s]; what is shorter cannot be counted in floats."""


@dataclass(frozen=True)
class Plan:
    """P and F, read only, and the sizes of what a run needs beside them."""

    P: Ints
    F: Array
    nx: int
    width: int

    def work(self) -> Array:
        """Work rows; one matrix for each run that goes on at the same time."""
        return np.zeros((layout.ROWS, self.width))

    def start(self, x: Array, t: float, step: int, t_start: float, end: float) -> Array:
        """The vector s of a run from x at t [s], in the single support `step` that began at t_start [s].

        Raises InputError for a state that is not finite or has another shape.
        """
        x = np.asarray(x, dtype=float)
        if x.shape != (self.nx,) or not np.all(np.isfinite(x)):
            raise InputError(f"the initial state is {x}, expected {self.nx} finite numbers")
        s = np.zeros(layout.HEAD + self.nx)
        s[layout.TIME], s[layout.STEP], s[layout.START], s[layout.END] = t, step, t_start, end
        s[layout.FIRED], s[layout.ARC] = -1.0, t
        s[layout.HEAD :] = x
        return s


def plan(
    code: Code, sizes: Sizes, scene: Scene, push: PushCode, clock: Clock, method: Method
) -> Plan:
    """Raises InputError for parts that do not fit together."""
    _check(code, sizes, push, clock, method)
    P = np.zeros(layout.P_HEAD, dtype=np.int64)
    P[: len(code)] = code
    P[layout.COORDINATES], P[layout.STATES], P[layout.JOINTS] = sizes.n, sizes.nx, sizes.p
    P[layout.SLOW], P[layout.STIFF] = sizes.nw, sizes.k
    P[layout.MOVING] = sizes.moving or sizes.nx
    P[layout.FORCED], P[layout.LEVELS] = len(method.rows), len(method.phi)
    P[layout.KIND], P[layout.RESTART] = method.kind, clock.restart
    P[layout.DROPS], P[layout.SWITCHES] = len(scene.drops), len(push.switches)
    P[layout.PARTS] = len(push.addresses)
    head = np.zeros(layout.F_HEAD)
    head[layout.PERIOD], head[layout.T_FIRST] = clock.period, clock.t_first
    head[layout.PERIOD_PART] = clock.part
    head[layout.LEAST_STEP], head[layout.H] = scene.least_step, method.h
    head[layout.RTOL], head[layout.ATOL] = method.rtol, method.atol
    head[layout.MAX_STEP] = method.max_step
    weights = method.phi if method.kind == layout.ETD else _tableau(method)
    P[layout.WIDTH] = _width(sizes)
    F, at = _joined([head, scene.drops, push.switches, push.K, weights])
    P[layout.DROPS_AT], P[layout.SWITCHES_AT], P[layout.WEIGHTS_AT] = at[1], at[2], at[4]
    resultants = push.resultants or (0,) * len(push.addresses)
    P[layout.RESULTANTS] = np.count_nonzero(resultants)
    given = zip(push.addresses, push.offsets[:-1], resultants, strict=True)
    parts = [(a, at[3] + o, r) for a, o, r in given]
    P, where = _integers([P, method.rows, np.array(parts, dtype=np.int64)])
    P[layout.ROWS_AT], P[layout.PARTS_AT] = where[1], where[2]
    return Plan(P, F, sizes.nx, _width(sizes))


def _check(code: Code, sizes: Sizes, push: PushCode, clock: Clock, method: Method) -> None:
    if len(push.offsets) != len(push.addresses) + 1 or push.offsets[-1] > len(push.K):
        raise InputError(
            f"{len(push.addresses)} parts of a disturbance with {len(push.K)} parameters have offsets "
            f"{push.offsets}, expected one more than parts, the last one the number of parameters"
        )
    if not (math.isfinite(clock.period) and (clock.period == 0.0 or clock.period >= LEAST_PERIOD)):
        raise InputError(
            f"the sampling period is {clock.period} s, expected at least {LEAST_PERIOD:g} s, or 0 for none"
        )
    k, phi = sizes.k, method.phi
    if method.kind == layout.ETD and (k == 0 or phi.shape[1:] != (layout.MATRICES, k, k)):
        raise InputError(
            f"the matrices have shape {phi.shape}, expected (levels, 6, {k}, {k}), k > 0"
        )
    needed = {"flow": True, "watch": True, "strike": True, "tick": clock.period > 0.0}
    needed |= dict.fromkeys(("to", "back", "remainder", "turn"), method.kind == layout.ETD)
    missing = [name for name, is_needed in needed.items() if is_needed and not getattr(code, name)]
    if missing:
        raise InputError(f"no address of {', '.join(missing)}, which this method and clock call")


def _tableau(method: Method) -> Array:
    return np.concatenate([a.ravel() for a in (method.A, method.B, method.C, method.E3, method.E5)])


def _joined(parts: Sequence[Array]) -> tuple[Array, list[int]]:
    """All in one vector, and where each begins."""
    flat = [np.asarray(part, dtype=np.float64).ravel() for part in parts]
    ends = np.cumsum([len(part) for part in flat])
    return np.concatenate(flat), [0, *ends[:-1].tolist()]


def _integers(parts: Sequence[Ints]) -> tuple[Ints, list[int]]:
    flat = [np.asarray(part, dtype=np.int64).ravel() for part in parts]
    ends = np.cumsum([len(part) for part in flat])
    return np.concatenate(flat), [0, *ends[:-1].tolist()]


def _width(sizes: Sizes) -> int:
    """Numbers of the longest row: a law's input or output, or the head of a run."""
    states = max(sizes.nx, sizes.nw + sizes.k * sizes.p)
    return max(layout.HEAD, 3 + states + max(sizes.n, 2) + layout.OUTSIDE)
