"""Sample instants and impacts in Python, which the compiled march calls as it calls machine code.

For a controller, sensors or a touchdown detector without a compiled form: between two sample instants the plant
moves in machine code all the same.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.types import Array

_FUNCTION = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)


@lru_cache(maxsize=64)
def _numbers_at(address: int, size: int) -> Array:
    """The numbers (size,) at an address, as a view."""
    numbers: Array = np.ctypeslib.as_array((ctypes.c_double * size).from_address(address))
    return numbers


class PythonTicks:
    """`tick` and `impact` as `kernels.run_plan.Functions` describes them, by a walker with nx states.

    flow: address of the walker's flow. What a method raises is kept in `errors`, by the address of the run's
    inputs, and the march ends as NOT_FINITE.
    """

    def __init__(self, walker: Walker, nx: int, flow: int):
        self.walker, self.n, self.nx = walker, walker.plant.n, nx
        self.flow = ctypes.PYFUNCTYPE(None, *[ctypes.c_void_p] * 3)(flow)
        self.errors = dict[int, BaseException]()
        self.functions = _FUNCTION(self._tick), _FUNCTION(self._impact)

    @property
    def addresses(self) -> dict[str, int]:
        """Of both functions, by name."""
        names = ("tick", "impact")
        values = (ctypes.cast(f, ctypes.c_void_p).value or 0 for f in self.functions)
        return dict(zip(names, values, strict=True))

    def _tick(self, K: int, inputs: int, outputs: int) -> None:
        """(t, step, t_start, x, zeta, force) -> (x after the sample instant, 1, q'')."""
        n, nx = self.n, self.nx
        inp, out = _numbers_at(inputs, 3 + nx + n), _numbers_at(outputs, nx + 1 + n)

        def ticked() -> Array:
            t, step, start = inp[:3].tolist()
            x = inp[3 : 3 + nx] = self.walker.tick(
                t, inp[3 : 3 + nx].copy(), Mode(int(step), start)
            )
            self.flow(K, inputs, outputs)
            return np.concatenate((x, (1.0,), out[n : 2 * n]))

        self._keep(ticked, inputs, out)

    def _impact(self, K: int, inputs: int, outputs: int) -> None:
        """(t, step, x) -> (x+, 1)."""
        inp, out = _numbers_at(inputs, 2 + self.nx), _numbers_at(outputs, self.nx + 1)

        def struck() -> Array:
            after = Mode(int(inp[1]), float(inp[0]))
            return np.append(semantics.strike(self.walker, after.start, inp[2:].copy(), after), 1.0)

        self._keep(struck, inputs, out)

    def _keep(self, result: Callable[[], Array], inputs: int, out: Array) -> None:
        """`out` = result(); what it raises is kept, and `out` is NaN."""
        try:
            out[:] = result()
        except BaseException as error:  # goes on where the march was called
            self.errors[inputs], out[:] = error, math.nan
