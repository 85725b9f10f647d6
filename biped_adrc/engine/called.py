"""Laws that cannot be run on symbols, because they branch on numbers: their own compiled functions are called.

They appear in an expression as new symbols, for which a call is written where they are first used.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from biped_adrc.control.base import ControllerLaws, Measurement
from biped_adrc.engine.fingerprint import hash_of, law_text, skeleton
from biped_adrc.engine.native import NativeLaw, native_law
from biped_adrc.engine.symbols import Scalar, column
from biped_adrc.model.reduction import BodyTerms, Reduction


class Call(NamedTuple):
    """One call: the function's name, K and inp as CasADi's columns, and the symbols of its results."""

    name: str
    K: Any
    inp: Any
    out: Any


_LINKED: dict[str, NativeLaw] = {}


def link(laws: ControllerLaws, field: str, n: int, p: int, size: int) -> str:
    """Compile a controller's law by itself, and make it known by its name to code that is loaded later.

    Raises InputError when it cannot be compiled.
    """
    from llvmlite import binding

    law = getattr(laws, field)
    example = examples(laws.parameters, field, n, p, size)
    name = "law_" + hash_of(law_text(law), skeleton(example))
    if name not in _LINKED:
        native = native_law(law, example, result_size(field, p, size))
        binding.add_symbol(name, native.address)
        _LINKED[name] = native
    return name


def examples(k: Any, field: str, n: int, p: int, size: int) -> tuple[Any, ...]:
    """Arguments of a controller's law."""
    one = np.eye(n)
    terms = Reduction(
        one,
        np.zeros(n),
        one[:p, :p].copy(),
        np.zeros(p),
        one[:p, :p].copy(),
        np.zeros((n - p, p)),
        np.zeros(n - p),
    )
    body = BodyTerms(np.zeros(n), np.zeros(n), np.zeros((2, n)), np.zeros(2))
    m = Measurement(0.0, 1, 0.0, np.full(n, 0.1), np.full(n, 0.1), terms, body)
    rest: dict[str, tuple[Any, ...]] = {
        "flow": (np.zeros(p),),
        "predict": (np.zeros(p),),
        "jump": (np.arange(p),),
    }
    return (k, np.zeros(size), m, *rest.get(field, ()))


def result_size(field: str, p: int, size: int) -> int:
    """Numbers in the result of a controller's law."""
    return {"output": p, "estimate": 3 * p}.get(field, size)


def call(name: str, arguments: tuple[Any, ...], size: int) -> tuple[Call, Any]:
    """The call, and its results (size,) as symbols."""
    out = ca.SX.sym(name, size)
    made = Call(name, column(*leaves(arguments[0])), column(*leaves(arguments[1:])), out)
    return made, np.array([Scalar(out[i]) for i in range(size)], dtype=object)


def leaves(tree: Any) -> list[Any]:
    """Arrays and numbers of nested tuples, depth first."""
    return [leaf for x in tree for leaf in leaves(x)] if isinstance(tree, tuple) else [tree]
