"""A walker, a one-step method and a disturbance, made ready for the compiled loops.

Three things come together here: the program of the walker (`engine.program`: flow, tick, impact, ..), the
matrices of the method (`hybrid.exponential`), and the terms of the disturbance, which are compiled by
themselves so that another disturbance does not recompile the walker. The result is the plan of a run, which the
loops take. What cannot be compiled raises `NotCompiled` with the reason; in sampled time the march then calls
its sample instants and impacts in Python (`PythonTicks`), and the plant moves in machine code between them.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from biped_adrc.closed_loop.walker import LEAST_STEP, Mode, Walker
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Sum
from biped_adrc.engine.kernels.compiled_run import CompiledRun, plan
from biped_adrc.engine.kernels.record import FUNCTIONS, PART
from biped_adrc.engine.program import Program, push_code
from biped_adrc.engine.symbols import NotCompiled, floats
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid import constants
from biped_adrc.hybrid.exponential import Exponential, no_coordinates, phi_levels
from biped_adrc.hybrid.integrators import RK4, OneStepMethod

NO_PUSH = Sum()


@dataclass(frozen=True)
class CompiledWalker:
    """A walker that the compiled loops can run."""

    walker: Walker
    """Plant, controller and all the rest."""
    program: Program
    """Keeps the code in memory and holds the parameters."""
    plan: CompiledRun
    """A run that has not begun: sizes, addresses and settings."""

    ticks: PythonTicks | None = None
    """What carries out sample instants and impacts in Python; None where machine code does."""

    @classmethod
    def of(
        cls,
        walker: Walker,
        method: OneStepMethod,
        size: int,
        t_first: float = 0.0,
        reference: Reference | None = None,
        in_python: bool = False,
    ) -> CompiledWalker:
        """For a controller with `size` states and a run that begins at t_first [s].

        reference: what readings of the program refer to.
        in_python: sample instants and impacts by the walker's own methods, in sampled time.
        Compiles the walker's functions where they are not in memory or on disk, and makes the plan.
        Raises NotCompiled where a part or the method cannot be compiled, InputError for a
        method without the coordinates that it needs.
        """
        if not isinstance(method, RK4 | Exponential):
            raise NotCompiled(
                f"method {type(method).__name__} has no compiled form, as RK4 and Exponential have"
            )
        etd = isinstance(method, Exponential)
        split = walker.split_form() if etd else None
        if etd and split is None:
            raise no_coordinates()
        program = Program.of(walker, size, split, reference, in_python)
        n, p, nx, bounds = walker.plant.n, walker.plant.p, program.nx, walker.bounds
        push = walker.disturbance or NO_PUSH
        parts = [(push_code(x, n).addresses["push"], len(floats(x))) for x in push.terms]
        relaxing = walker.relaxing()
        k = 0 if split is None else len(split.A)
        flows = walker.held is None or relaxing  # the torque of the motors, then all does
        tables = {
            "K": program.K,
            "fastest": bounds.fastest,
            "drops": np.array([(d.step, d.drop) for d in walker.ground_steps]).reshape(-1, 2),
            "switches": np.array(push.switches, dtype=float).reshape(-1, 2),
            "push": np.array(floats(push.terms)),
            "parts": np.array(parts, dtype=np.int64).reshape(-1, PART).view(float),
        }
        if split is not None:
            tables["phi"] = phi_levels(method.h, split.A)
        fields = dict[str, float]()
        if isinstance(walker.timing, SampledTime) and walker.held is not None:
            T, motors = walker.timing.period, walker.held.motors
            part = motors.fraction * T if walker.held.sizes.waiting else 0.0
            fields |= {"period": T, "restart": walker.timing.restart, "part": part}
        fields |= {"kind": constants.ETD if etd else constants.RK4, "h": method.h}
        fields |= {"n": n, "nx": nx, "p": p, "k": k, "moving": nx if flows else 2 * n}
        fields |= {"t_first": t_first, "pulled": push.pulls}
        fields |= {"least_step": LEAST_STEP, "farthest": bounds.farthest}
        if relaxing is not None:
            fields |= {"lags": nx + relaxing.at.start, "lag_speed": relaxing.speed}
        fields |= {name: program.address(name) for name in FUNCTIONS}
        ticks = PythonTicks(walker, nx, program.address("flow")) if in_python else None
        if ticks is not None:
            fields |= ticks.addresses
        return cls(walker, program, plan(tables, fields), ticks)


_FUNCTION = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)


@lru_cache(maxsize=64)
def _numbers_at(address: int, size: int) -> Array:
    """The numbers (size,) at an address, as a view."""
    numbers: Array = np.ctypeslib.as_array((ctypes.c_double * size).from_address(address))
    return numbers


class PythonTicks:
    """`tick` and `impact` as `kernels.record.Run` describes them, by a walker with nx states.

    flow: address of the walker's flow. What a method raises is kept as `error`; the march ends as NOT_FINITE.
    """

    def __init__(self, walker: Walker, nx: int, flow: int):
        self.walker, self.n, self.nx = walker, walker.plant.n, nx
        self.flow = ctypes.PYFUNCTYPE(None, *[ctypes.c_void_p] * 3)(flow)
        self.error: BaseException | None = None
        sizes = {"tick": (3 + nx + self.n, nx + 1 + self.n), "impact": (2 + nx, nx + 1)}
        self.functions = {
            name: _FUNCTION(partial(self._called, getattr(self, name), *size))
            for name, size in sizes.items()
        }

    @property
    def addresses(self) -> dict[str, int]:
        """Of both functions, by name."""
        return {k: ctypes.cast(f, ctypes.c_void_p).value or 0 for k, f in self.functions.items()}

    def _called(
        self, method: Callable[..., Array], read: int, written: int, K: int, inp: int, out: int
    ) -> None:
        """Evaluate a method with the addresses K, inp, out: `read` numbers (double) at inp, `written` at out.

        NaN where it raises.
        """
        result = _numbers_at(out, written)
        try:
            result[:] = method(_numbers_at(inp, read), result, lambda: self.flow(K, inp, out))
        except BaseException as error:  # goes on where the march was called
            self.error, result[:] = error, math.nan

    def tick(self, inp: Array, out: Array, flow: Callable[[], None]) -> Array:
        """A sample instant: (x, 1, q'') of (t, step, t_start, x, ..).

        t [s], the number of the single support, its start [s], x (nx,); then x (nx,) after the sample instant,
        1 for the least pivot, so that no matrix is singular, and q'' (n,) [rad/s^2] under the new torque.
        flow: computes the slope into out, at what is in inp.
        """
        t, step, start = inp[:3].tolist()
        here = slice(3, 3 + self.nx)
        x = inp[here] = self.walker.tick(t, inp[here].copy(), Mode(int(step), start))
        flow()
        return np.concatenate((x, (1.0,), out[self.n : 2 * self.n]))

    def impact(self, inp: Array, out: Array, flow: Callable[[], None]) -> Array:
        """An impact: (x+, 1) of (t, step, x), x+ (nx,); t [s], step that of the single support that begins."""
        t, step = inp[:2].tolist()
        return np.append(self.walker.impact(t, inp[2:].copy(), Mode(int(step) - 1))[0], 1.0)
