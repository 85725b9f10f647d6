"""The sample instants of a plant that moves by itself, in machine code: one call from Python for each.

    sample (t, step, t_start, x) -> x, xi^, least pivot

Measurement, the model's terms, controller, limits and queue of torques are those of `closed_loop.semantics`,
traced as for a walker (`engine.equations`). Where the code gives what is not finite or met a matrix that cannot
be inverted, the same instant is asked of Python, which says what is wrong by raising it.
"""

from __future__ import annotations

import ctypes
import math

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.engine.equations import WalkerStructure
from biped_adrc.engine.kernels.record import OUTSIDE
from biped_adrc.engine.mechanics import robot_of
from biped_adrc.engine.program import NotCompiled, controller_numbers, machine_of
from biped_adrc.engine.symbols import floats
from biped_adrc.errors import ModelError
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array

_SAMPLE = ctypes.PYFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)
"""Called with the lock of Python held: to let go of it would cost as much as the call."""


class CompiledTick:
    """The function `sample` of a loop whose controller has `size` states, with room for what it is given.

    Not to be shared between threads. Raises NotCompiled where a part cannot be traced, with the reason.
    """

    def __init__(self, loop: SteppingLoop, size: int):
        if not isinstance(loop.model, Biped):
            raise NotCompiled(f"the model is a {type(loop.model).__name__}, expected a Biped")
        assert loop.held is not None
        try:
            robot = robot_of(loop.model)
        except ModelError as reason:
            raise NotCompiled(str(reason)) from reason
        self.make = WalkerStructure(robot.structure, size, loop.held.sizes)
        self.numbers = controller_numbers(robot, loop)
        self.K = np.array([*floats(self.numbers), 0.0])
        if np.any(np.isnan(self.K)):
            raise NotCompiled(f"a parameter of {type(loop.controller).__name__} or its loop is NaN")
        self.owner, _ = machine_of(self.make, self.numbers, ["sample"])
        n, p, nx = loop.plant.n, loop.plant.p, self.make.nx
        self.inp, self.out = np.zeros(3 + nx + n + OUTSIDE), np.zeros(nx + p + 1)
        self.x, self.xi = np.zeros(0), np.zeros(0)
        still = np.zeros(n)
        m = loop.measure(0.0, still, still, Mode())
        self.blind = loop.calls.estimate(np.zeros(size), m) is None  # no observer
        noticing = loop.held.touchdown
        self.felt = loop if noticing and noticing.needs_force else None
        self._function = _SAMPLE(self.owner.addresses["sample"])
        self._at = self.K.ctypes.data, self.inp.ctypes.data, self.out.ctypes.data

    def __call__(self, t: float, x: Array, mode: Mode) -> Array | None:
        """x (nx,) after the sample instant at t [s]; None where Python has to say what is wrong.

        It is kept as `x`, and the estimate of xi (p,) there as `xi`.
        """
        inp = self.inp
        inp[0], inp[1], inp[2] = t, mode.step, mode.start
        inp[3 : 3 + len(x)] = x
        if self.felt is not None:
            q, v, _, tail = parts(self.felt, x)
            inp[-OUTSIDE:] = self.felt.foot_forces(t, q, v, tail, mode)
        self._function(*self._at)
        out = self.out.copy()
        if not (out[-1] > 0.0 and math.isfinite(out.dot(out))):
            return None
        if self.blind:
            out[len(x) : -1] = math.nan
        self.x, self.xi = out[: len(x)], out[len(x) : -1]
        return self.x
