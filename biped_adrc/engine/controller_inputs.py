"""The inputs of a controller that runs in Python, in machine code: the model's terms, and its reference
beside them.

    inputs (t, q, v) -> the parts of a `Reduction`, then those of a `ReferencePoint`
    point  (t, q, v) -> the parts of a `ReferencePoint`

A controller written as a Python method cannot be compiled, but nearly all that it needs can: the
nominal model's terms and the reference. The call that moves the plant to a sample instant computes
them and leaves them there (`engine.ticks`). The controller does not notice: its reference is
replaced by one that returns what is known already.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from math import prod
from operator import call
from types import new_class
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.engine.compiled_biped import Call, CompiledBiped, parts_of
from biped_adrc.engine.equations import SymbolicFunction, count
from biped_adrc.engine.ir import generated
from biped_adrc.engine.mechanics import PlanarRobot
from biped_adrc.engine.structure import structure
from biped_adrc.engine.symbols import Untraceable, Vector, column, floats
from biped_adrc.engine.tracer import Tracer, run
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import PlantArrays
from biped_adrc.part import content, with_content
from biped_adrc.types import Array


class CompiledReference:
    """A reference for n coordinates in machine code, called as the reference itself is.

    `now` is (q, v, point): arguments and the reference at them, where `ControllerInputs` has
    computed it already. They are recognised by identity, which is safe since those arrays are
    read-only and made anew each time.
    """

    def __init__(self, reference: Reference, n: int):
        """Compiles the reference. Raises Untraceable."""
        self.reference, self.n = reference, n
        self.now: tuple[Array | None, Array | None, ReferencePoint | None] = (None, None, None)
        K, inp = Vector("K", count(reference)), Vector("inp", 1 + 2 * n)
        point = traced(K.like(reference), inp.take(), inp.take(n), inp.take(n))
        self.shapes = [np.shape(part) for part in point]
        function = SymbolicFunction(K.symbol, inp.symbol, column(*point))
        key = "point", n, structure(reference)
        numbers = np.array([*floats(reference), 0.0])
        code = generated(key, {"point": lambda: function})
        self.call = Call(code, "point", numbers, 1 + 2 * n, sum(map(prod, self.shapes)))

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        """The reference at t [s], q (n,) [rad], v (n,) [rad/s]."""
        seen_q, seen_v, known = self.now
        if q is seen_q and v is seen_v and known is not None:  # both arrays are read only
            return known
        inp = self.call.inp
        inp[0], inp[1 : 1 + self.n], inp[1 + self.n :] = t, q, v
        return ReferencePoint(*parts_of(self.call(), self.shapes))


def traced(reference: Reference, t: float, q: Array, v: Array) -> ReferencePoint:
    """The reference at symbols of t, q (n,), v (n,). Raises Untraceable."""
    return run(Tracer(), call, reference, t, q, v)


def compiled_references(part: object, n: int, points: list[CompiledReference]) -> Any:
    """A controller, or a part of one, with the references in its fields compiled.

    Controllers nest (`inner`), so fields of dataclasses are searched to any depth. `points` is
    extended by those. What cannot be compiled stays as it is.
    """
    if isinstance(part, Reference):
        return _compiled(part, n, points)
    if not is_dataclass(part) or isinstance(part, type | Biped):
        return part
    given = {f.name: getattr(part, f.name) for f in fields(part) if f.init}
    made = {name: compiled_references(value, n, points) for name, value in given.items()}
    changed = {name: value for name, value in made.items() if value is not given[name]}
    return replace(part, **changed) if changed else part


def _compiled(reference: Reference, n: int, points: list[CompiledReference]) -> Reference:
    """The reference, still of its class, called in machine code; itself where it cannot be compiled."""
    try:
        points.append(CompiledReference(reference, n))
    except Untraceable:
        return reference
    kind = new_class(type(reference).__name__, (type(reference),))
    setattr(kind, "__call__", points[-1])  # noqa: B010
    return with_content(reference, content(reference), kind)


class InputNumbers(NamedTuple):
    """What the function is given as K: numbers of the model and of the reference."""

    robot: PlantArrays
    """Of the model."""
    k: Any
    """The reference, () without one."""


class ControllerInputs:
    """The function `inputs` for a nominal model and at most one reference.

    model: a CompiledBiped. K: numbers of both, as the function takes them; shapes: of the parts
    that it gives.
    """

    def __init__(self, model: Biped, point: CompiledReference | None):
        """Compiles the function for the model's structure and the reference; `point` None for no reference."""
        assert isinstance(model, CompiledBiped)
        assert model.robot is not None
        robot = self.robot = model.robot
        self.point, self.shapes = point, [*model.shapes, *(point.shapes if point else ())]
        self.numbers = InputNumbers(robot.arrays, () if point is None else point.reference)
        self.K = np.array([*floats(self.numbers), 0.0])
        key = "inputs", structure(robot.structure, exact=True), structure(self.numbers)
        self.machine = generated(key, {"inputs": self.function})

    @property
    def address(self) -> int:
        """Address of the function."""
        return self.machine.addresses["inputs"]

    def function(self) -> SymbolicFunction:
        """Model and reference on symbols."""
        n = self.robot.structure.n
        K, inp = Vector("K", count(self.numbers)), Vector("inp", 1 + 2 * n)
        numbers, t, q, v = K.like(self.numbers), inp.take(), inp.take(n), inp.take(n)
        terms = PlanarRobot.of(self.robot.structure, numbers.robot).reduction(q, v)
        r = () if self.point is None else traced(numbers.k, t, q, v)
        return SymbolicFunction(K.symbol, inp.symbol, column(*terms, *r))
