"""Disturbances in machine code: each term by itself, so that another one does not recompile the walker.

The methods `torque` and `resultant` of a term become functions `void f(double* K, double* inp, double* out)`: K
its numbers, inp (t, step, t_start, q, v), out zeta (n,) [N m] or the force (2,) [N]. Its method `acts` is
evaluated first: where it is not above 0, out is zero and the rest is not computed, since most pushes act for a
small part of a walk.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import methodcaller

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.engine.compiled_biped import pointer_call
from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.ir import in_memory, module_text
from biped_adrc.engine.kernels.record import PART, Ints
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.structure import structure
from biped_adrc.engine.symbols import NotCompiled, Vector, column, floats, symbols_of
from biped_adrc.engine.tracer import Tracer, run

Terms = Sequence[tuple[LoadedCode, Array]]
"""Machine code and numbers of each term."""


def terms_of(disturbance: Disturbance | None, n: int) -> Terms:
    """The terms of a disturbance of n coordinates. Raises NotCompiled for one without machine code."""
    terms = () if disturbance is None else disturbance.terms
    return [(term_code(term, n), np.array([*floats(term), 0.0])) for term in terms]


def push_of(disturbance: Disturbance | None, n: int) -> tuple[Ints, dict[str, Array]]:
    """The parts and tables that `compiled_run.plan` takes of a disturbance. Raises NotCompiled as
    `terms_of`."""
    terms = terms_of(disturbance, n)
    starts = np.cumsum([0, *(len(K) for _, K in terms)])
    parts = [
        (code.addresses["torque"], at, code.addresses.get("resultant", 0))
        for (code, _), at in zip(terms, starts.tolist(), strict=False)
    ]
    push = np.array([x for _, K in terms for x in K])
    switches = np.array(() if disturbance is None else disturbance.switches).reshape(-1, 2)
    table = np.array(parts, dtype=np.int64).reshape(-1, PART)
    return table, {"push": push, "switches": switches}


def summed(terms: Terms, t: Array, rows: Array, mode: Mode, n: int) -> Array:
    """zeta (K, n) [N m] at K times [s], in rows (q, q', ..) of n coordinates."""
    inp, total = np.empty((len(t), 3 + 2 * n)), np.zeros((len(t), n))
    inp[:, 0], inp[:, 1], inp[:, 2], inp[:, 3:] = t, mode.step, mode.start, rows[:, : 2 * n]
    out = np.empty_like(total)
    for code, K in terms:
        pointer_call(code, "torque", K, inp, out)
        total += out
    return total


GUARDED = """
define void @{name}(ptr %K, ptr %inp, ptr %out) nounwind {{
  %flag = alloca double
  call void @acts(ptr %K, ptr %inp, ptr %flag)
  %a = load double, ptr %flag
  %acts = fcmp ogt double %a, 0.0
  br i1 %acts, label %act, label %rest
act:
  call void @{name}_acting(ptr %K, ptr %inp, ptr %out)
  ret void
rest:
  call void @llvm.memset.p0.i64(ptr %out, i8 0, i64 {bytes}, i1 false)
  ret void
}}
"""
"""A function that looks at `acts` first."""


def term_code(term: Disturbance, n: int) -> LoadedCode:
    """Machine code with the functions `torque` and, where the class writes it, `resultant`, for n coordinates.

    Raises NotCompiled for a term that cannot be traced, with the reason.
    """
    if _writes(term, "switching_times"):
        raise NotCompiled(f"{type(term).__name__} writes switching_times in place of switches")
    key = "disturbance", n, structure(term)
    return in_memory(key, list(_sizes(term, n)), lambda: term_text(term, n))


def term_text(term: Disturbance, n: int) -> str:
    """What `term_code` is made from, in LLVM's language.

    A class that writes `acts` gets three functions: `acts`, the function proper, and one that calls it only
    where the first is above 0. Raises NotCompiled.
    """
    sizes = _sizes(term, n)
    if not _writes(term, "acts"):
        return module_text({name: _function(term, n, name, size) for name, size in sizes.items()})
    functions = {"acts": _function(term, n, "acts", 1)}
    functions |= {f"{name}_acting": _function(term, n, name, sizes[name]) for name in sizes}
    guarded = [GUARDED.format(name=name, bytes=8 * size) for name, size in sizes.items()]
    clear = "declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)"
    return "\n".join([module_text(functions), clear, *guarded])


def _writes(term: Disturbance, name: str) -> bool:
    return getattr(type(term), name) is not getattr(Disturbance, name)


def _sizes(term: Disturbance, n: int) -> dict[str, int]:
    """The functions of a term, and how many numbers each gives."""
    return {"torque": n, "resultant": 2} if term.pulls else {"torque": n}


def _function(term: Disturbance, n: int, name: str, size: int) -> SymbolicFunction:
    """A method of a term on symbols. Raises NotCompiled, also where it gives other than `size` numbers."""
    (K, k), inp = symbols_of(term), Vector("inp", 3 + 2 * n)
    at = (inp.take(), inp.take(), inp.take(), inp.take(n), inp.take(n))
    method = methodcaller(name, *(at if name == "torque" else at[:3]))
    try:
        out = column(run(Tracer(), method, k))
    except TypeError:  # no numbers
        out = column()
    if out.numel() != size:
        raise NotCompiled(f"{type(term).__name__}.{name} gives no {size} numbers")
    return SymbolicFunction(K, inp.symbol, out)
