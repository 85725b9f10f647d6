"""References in machine code, for controllers in plain Python: the same class, evaluated faster.

point (t, q, v) -> the parts of a `ReferencePoint`, one after the other
"""

from __future__ import annotations

from copy import copy
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.control.base import Controller
from biped_adrc.engine.compiled_biped import Call
from biped_adrc.engine.equations import Function, count
from biped_adrc.engine.fingerprint import hash_of, law_text, skeleton, versions_text
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.machine import Machine, Text, machine
from biped_adrc.engine.symbols import Tracer, Untraceable, Vector, column, floats, run
from biped_adrc.gait.reference import Reference, ReferenceLaws, ReferencePoint
from biped_adrc.types import Array

_CODES: dict[str, Machine] = {}


def with_compiled_references(part: Any, n: int) -> Any:
    """A controller, or a part of one, with all references in its fields compiled for n coordinates."""
    if isinstance(part, Reference):
        return compiled_reference(part, n)
    if not (is_dataclass(part) and isinstance(part, Controller)):
        return part
    given = {f.name: getattr(part, f.name) for f in fields(part) if f.init}
    made = {name: with_compiled_references(value, n) for name, value in given.items()}
    changed = {name: value for name, value in made.items() if value is not given[name]}
    return replace(part, **changed) if changed else part


def compiled_reference(reference: Reference, n: int) -> Reference:
    """The reference with its law in machine code; itself where it has none, or none to be compiled."""
    laws: ReferenceLaws | None = reference._laws
    if laws is None or reference._obstacle or laws.obstacle:
        return reference
    try:
        point = Point(laws, n)
    except Untraceable:
        return reference
    made = copy(reference)
    vars(made)["_laws"] = laws._replace(point=point)
    return made


class Point:
    """A law of references for n coordinates, called as it is."""

    def __init__(self, laws: ReferenceLaws, n: int):
        example = laws.point(laws.parameters, 0.0, np.zeros(n), np.zeros(n))
        self.n, self.p = n, len(example.q_d)
        K = np.array([*floats(laws.parameters), 0.0])
        self.call = Call(_code(laws, n), "point", K, 1 + 2 * n, sum(map(np.size, example)))

    def __call__(self, k: Any, t: float, q: Array, v: Array) -> ReferencePoint:
        inp, n, p = self.call.inp, self.n, self.p
        inp[0], inp[1 : 1 + n], inp[1 + n :] = t, q, v
        out = self.call()
        return ReferencePoint(
            out[:p], out[p : 2 * p], out[2 * p : 3 * p], out[3 * p :].reshape(p, n)
        )


def _code(laws: ReferenceLaws, n: int) -> Machine:
    texts = law_text(laws.point), skeleton(laws.parameters), versions_text()
    key = hash_of("point", n, *texts)
    if key not in _CODES:
        _CODES[key] = machine(key, ["point"], lambda: Text(module_text({"point": _point(laws, n)})))
    return _CODES[key]


def _point(laws: ReferenceLaws, n: int) -> Function:
    K, inp = Vector("K", count(laws.parameters)), Vector("inp", 1 + 2 * n)
    k, at = K.like(laws.parameters), (inp.take(), inp.take(n), inp.take(n))
    return Function(K.symbol, inp.symbol, column(*run(Tracer(), laws.point, k, *at)))
