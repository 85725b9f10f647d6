"""The product of the exponential method: `turn`, M E for a matrix M (k, k) in place of K and E (k, p).

Straight-line code in vectors, one function for each size.
"""

from __future__ import annotations

from functools import lru_cache

from biped_adrc.engine.equations import Function
from biped_adrc.engine.fingerprint import hash_of, versions_text
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.machine import Machine, Text, machine
from biped_adrc.engine.symbols import Vector, column


@lru_cache(maxsize=64)
def product(k: int, p: int) -> Machine:
    """With the function `turn`."""
    key = hash_of("turn", k, p, versions_text())
    return machine(key, ["turn"], lambda: Text(module_text({"turn": _turn(k, p)}), vectors=True))


def _turn(k: int, p: int) -> Function:
    M, E = Vector("M", k * k), Vector("E", k * p)
    return Function(M.symbol, E.symbol, column(M.take(k, k) @ E.take(k, p)))
