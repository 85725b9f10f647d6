"""What a C function of the engine costs by itself: called in a compiled loop."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from report import microseconds

from biped_adrc.types import Array

CALLS = 20_000  # in one loop
ROOM = 1024  # numbers, more than any function hands back


@lru_cache(maxsize=1)
def _loop() -> Any:
    import numba

    from biped_adrc.engine.kernels.call import call

    @numba.njit(nogil=True)  # type: ignore[misc]
    def loop(address: int, K: Array, inp: Array, out: Array, count: int) -> None:
        for _ in range(count):
            call(address, K, inp, out)

    return loop


def machine_microseconds(address: int, K: Array, inp: Array, repeats: int = 7) -> float:
    """Median CPU time of one call of `void f(double* K, double* inp, double* out)` [us]."""
    loop, out = _loop(), np.zeros(ROOM)
    return microseconds(lambda: loop(address, K, inp, out, CALLS), 1, repeats) / CALLS
