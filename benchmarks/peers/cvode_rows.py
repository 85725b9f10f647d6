"""CVODE on the compiled flow without Python: its library by itself, and an estimate from scikit-sundae."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from cvode_in_c import CVODEInC
from engine_arcs import program_of, right_hand_side
from machine_time import machine_microseconds
from report import microseconds
from solvers import cvode

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.types import Array

IN_C, IN_PYTHON = "CVODE in C, compiled", "CVODE (scikit-sundae)"


def in_c(walker: Walker, x: Array, times: Array) -> Callable[[], Array]:
    """One restart. Raises ModuleNotFoundError where the library is not found."""
    return partial(CVODEInC(program_of(walker)), x, times)


def estimate(walker: Walker, x: Array, times: Array, wall: float) -> float:
    """`wall` [s] of scikit-sundae on the compiled flow, with machine code in place of its calls from Python."""
    program, calls = program_of(walker), 0
    f = right_hand_side(walker, program)

    def counted(t: float, y: Array) -> Array:
        nonlocal calls
        calls += 1
        return f(t, y)

    cvode()(counted, x, times)
    inp = np.concatenate(([0.0, 1.0, 0.0], x, np.zeros(walker.plant.n)))
    code = machine_microseconds(program.address("flow"), program.K, inp)
    return wall - 1e-6 * calls * (microseconds(partial(f, 0.0, x)) - code)
