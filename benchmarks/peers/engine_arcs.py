"""The compiled engine on one single support: arcs by its methods, and its right-hand side for other solvers."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from solvers import Flow

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.kernels.run import ArcRun, arc
from biped_adrc.engine.program import Program
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod
from biped_adrc.types import Array

METHODS: Mapping[str, OneStepMethod] = {
    "RK4 0.1 ms": RK4(1e-4),
    "DOP853, rtol 1e-6": Adaptive(1e-6, 1e-6),
    "ETD-RK4 0.5 ms": Exponential(5e-4),
    "ETD-RK4 1 ms": Exponential(1e-3),
    "ETD-RK4 2 ms": Exponential(2e-3),
    "ETD-RK4 with feedback 1 ms": Exponential(1e-3, feedback=True),
    "ETD-RK4 with feedback 2 ms": Exponential(2e-3, feedback=True),
    "ETD-RK4 with feedback 5 ms": Exponential(5e-3, feedback=True),
}


def program_of(walker: Walker) -> Program:
    """The machine code of a walker in continuous time."""
    return Program.of(walker, walker.controller.laws.parameters.observer.order * walker.plant.p)


def right_hand_side(walker: Walker, program: Program) -> Flow:
    """f(t, x) -> x' by machine code, called from Python in the first single support."""
    nx, n = program.nx, walker.plant.n
    function = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3)(program.address("flow"))
    inp, out = np.zeros(3 + nx + n), np.zeros(nx + 1)
    inp[1] = 1.0
    at = (program.K.ctypes.data, inp.ctypes.data, out.ctypes.data)
    state = inp[3 : 3 + nx]

    def f(t: float, x: Array, code: Program = program) -> Array:
        inp[0], state[:] = t, x
        function(*at)
        return out[:nx].copy()

    return f


class Arcs(NamedTuple):
    """One method on one single support."""

    run: Callable[[], ArcRun]
    """As it is timed."""
    times: Array

    def states(self) -> Array:
        """X (len(times), n); a step that ends at a time is not interpolated."""
        found = self.run()
        keep = np.append(np.diff(found.t) > 0.0, True)
        nodes = CubicHermiteSpline(found.t[keep], found.x[keep], found.dx[keep])
        states: Array = nodes(self.times)
        return states


def arcs(walker: Walker, x: Array, times: Array) -> dict[str, Arcs]:
    """What walks from x through the times, by method; times at equal distances that steps divide."""
    apart, size = float(times[1] - times[0]), len(x) - 2 * walker.plant.n
    found = {}
    for name, method in METHODS.items():
        compiled = CompiledWalker.of(walker, method, size)
        every = round(apart / method.h) if isinstance(method, RK4 | Exponential) else 1
        s = compiled.plan.start(x, 0.0, 1, 0.0, float(times[-1]))
        found[name] = Arcs(partial(arc, compiled.plan, compiled.K, s, every), times)
    return found
