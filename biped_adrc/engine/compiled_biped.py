"""A robot whose dynamics are compiled, for controllers that run in Python.

    terms      (q, v) -> D, Omega, kappa, xi, ... of (11)-(15)
    body       (q, v) -> G, C' q', F_a, F_0, J_2, mass
    accelerate (q, v, force) -> q''
    ground     (q, v, a) -> F

A `CompiledBiped` is a `model.biped.Biped` with these four replaced by machine code, traced from
`model.planar_robot`; kinematics, contact and all that is not asked for at every instant stay
Pinocchio's. `engine.simulate` puts it in the place of the plant when a controller has no compiled form.
`compiled_references` does the same for the references of a controller,

    point      (t, q, v) -> the parts of a `ReferencePoint`

`pointer_call`, `parts_of` and `Call` are how the rest of the engine calls generated code from
Python.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property, lru_cache, partial
from itertools import accumulate
from operator import call
from types import new_class
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.core.part import content, with_content
from biped_adrc.core.types import Array
from biped_adrc.engine.equations import SymbolicFunction, count
from biped_adrc.engine.ir import generated
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.structure import structure
from biped_adrc.engine.symbols import NotCompiled, Vector, column, floats
from biped_adrc.engine.tracer import Tracer, run
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar_robot import PlanarRobot, once_each, robot_of
from biped_adrc.model.reduction import BodyTerms, Reduction

Shape = tuple[int, ...]
"""Shape of an array."""

_C = ctypes.PYFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)
"""Called with the lock of Python held: to let go of it would cost as much as a call."""


def pointer_call(machine: LoadedCode, name: str, K: Array, inp: Array, out: Array) -> None:
    """Call a function for every row of inp (N, inputs) and write out (N, outputs), both contiguous float64.

    By addresses: one ctypes call per row, no array is made.
    """
    function = _C(machine.addresses[name])
    at, inputs, result = K.ctypes.data, inp.ctypes.data, out.ctypes.data
    for _ in range(len(inp)):
        function(at, inputs, result)
        inputs, result = inputs + inp.strides[0], result + out.strides[0]


def parts_of(rows: Array, shapes: tuple[Shape, ...]) -> list[Array]:
    """Arrays of these shapes that lie one after the other in `rows` (size,) or (N, size); views, no copies."""
    first = rows.shape[:-1]
    pairs = zip(shapes, places_of(shapes), strict=True)
    return [rows[..., at].reshape(first + shape) for shape, at in pairs]


@lru_cache(maxsize=1024)
def places_of(shapes: tuple[Shape, ...]) -> tuple[slice, ...]:
    """Where numbers of arrays of these shapes lie one after the other."""
    ends = tuple(accumulate(map(math.prod, shapes)))
    return tuple(map(slice, (0, *ends), ends))


class Call:
    """One generated function with its own output array; not to be shared between threads."""

    def __init__(self, machine: LoadedCode, name: str, K: Array, inp: Array, outputs: int):
        """K (size,): its parameters; inp: its inputs, read at each call; outputs: how many numbers."""
        self.owner, self.K, self.inp, self.out = machine, K, inp, np.zeros(max(1, outputs))
        self._function = _C(machine.addresses[name])
        self._at = (K.ctypes.data, inp.ctypes.data, self.out.ctypes.data)

    def evaluate(self) -> Array:
        """The outputs (outputs,) of what is in `inp`, overwritten by the next call."""
        self._function(*self._at)
        return self.out

    def __call__(self, *arguments: Array) -> Array:
        """The outputs (outputs,) of what is in `inp`, or of these inputs joined; a copy, read-only."""
        if arguments:
            np.concatenate(arguments, out=self.inp)
        out = self.evaluate().copy()
        out.setflags(write=False)  # once, for all the views that are handed out
        return out


@dataclass(frozen=True)
class CompiledBiped(Biped):
    """A Biped with `reduction`, `body_terms`, `acceleration` and `ground_reaction` in machine code.

    Make it with `of`; robot: what the code is made from and called with.
    """

    robot: PlanarRobot | None = None

    @classmethod
    def of(cls, biped: Biped) -> CompiledBiped:
        """Compile, or take from memory or disk. Raises ModelError for a robot that is no planar tree."""
        return _compiled(biped)

    @cached_property
    def _calls(self) -> dict[str, Call]:
        """The four functions by name, compiled on first use."""
        robot = self.robot
        assert robot is not None
        code = generated(("plant", structure(robot)), plant_functions(robot))
        K, n = np.array([*floats(robot), 0.0]), self.n
        sizes = {
            "terms": (2 * n, sum(map(math.prod, self.shapes))),
            "body": (2 * n, 6 * n + 3),
            "accelerate": (3 * n, n),
            "ground": (3 * n, 2),
        }
        return {
            name: Call(code, name, K, np.zeros(size), outputs)
            for name, (size, outputs) in sizes.items()
        }

    @cached_property
    def shapes(self) -> tuple[Shape, ...]:
        """Of the parts of a `Reduction`, which `terms` gives one after the other."""
        n, p = self.n, self.p
        return (n, n), (n,), (p, p), (p,), (p, p), (n - p, p), (n - p,)

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms of (11)-(15) at q (n,) [rad], v (n,) [rad/s]."""
        terms = self._calls["terms"](self._angles(q), self._angles(v))
        return Reduction(*parts_of(terms, self.shapes))

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """The parts of `BodyTerms` at q (n,) [rad], v (n,) [rad/s]."""
        out, n = self._calls["body"](self._angles(q), self._angles(v)), self.n
        G, turning, F_a, F_0, J_2 = parts_of(out[:-1], ((n,), (n,), (2, n), (2,), (2, n)))
        return BodyTerms(G, turning, F_a, F_0, J_2, float(out[-1]))

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under `force` (n,) [N m]; friction is added in Python, where the robot has any."""
        if self.friction:
            force = force + self.friction_torque(v)
        return self._calls["accelerate"](self._angles(q), self._angles(v), force)

    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """On the stance foot (2,) [N] for q'' = a (n,) [rad/s^2]."""
        return self._calls["ground"](self._angles(q), self._angles(v), a)


@once_each
def _compiled(biped: Biped) -> CompiledBiped:
    """As `CompiledBiped.of`, remembered for the last robots."""
    given = {f.name: getattr(biped, f.name) for f in fields(Biped)}
    return CompiledBiped(**given, robot=robot_of(biped))


def plant_functions(example: PlanarRobot) -> dict[str, Callable[[], SymbolicFunction]]:
    """The four functions by name, each to be traced when it is needed; q, v, force, a are (n,).

    `terms` and `body` give the parts of their tuples one after the other. K has symbols for the
    floats of the example.
    """
    K = Vector("K", count(example))
    robot = Tracer().on_symbols(K.like(example).sparse)

    def function(law: Callable[..., Iterable[ArrayLike]], number: int) -> SymbolicFunction:
        inp = Vector("inp", number * robot.n)
        parts = law(*(inp.take(robot.n) for _ in range(number)))
        return SymbolicFunction(K.symbol, inp.symbol, column(*parts))

    return {
        "terms": partial(function, robot.reduction, 2),
        "body": partial(function, robot.body_terms, 2),
        "accelerate": partial(function, robot.acceleration, 3),
        "ground": partial(function, robot.ground_reaction, 3),
    }


def compiled_references(part: object, n: int) -> Any:
    """A controller, or a part of one, with the references in its fields compiled, for n coordinates.

    Controllers nest (`inner`), so fields of dataclasses are searched to any depth. What cannot be compiled
    stays as it is.
    """
    if isinstance(part, Reference):
        return _in_code(part, n)
    if not is_dataclass(part) or isinstance(part, type | Biped):
        return part
    values = {f.name: getattr(part, f.name) for f in fields(part) if f.init}
    parts = {name: compiled_references(value, n) for name, value in values.items()}
    changed = {name: value for name, value in parts.items() if value is not values[name]}
    return replace(part, **changed) if changed else part


def _in_code(reference: Reference, n: int) -> Reference:
    """The reference, still of its class, called in machine code; itself where it cannot be compiled."""
    try:
        point = _point(reference, n)
    except NotCompiled:
        return reference
    kind = new_class(type(reference).__name__, (type(reference),))
    setattr(kind, "__call__", staticmethod(point))  # noqa: B010
    return with_content(reference, content(reference), kind)


def _point(reference: Reference, n: int) -> Callable[[float, Array, Array], ReferencePoint]:
    """The reference as a function of t [s], q (n,) [rad], v (n,) [rad/s]. Raises NotCompiled."""
    K, inp = Vector("K", count(reference)), Vector("inp", 1 + 2 * n)
    at = inp.take(), inp.take(n), inp.take(n)
    symbols = run(Tracer(), call, K.like(reference), *at)
    shapes = tuple(np.shape(part) for part in symbols)
    function = SymbolicFunction(K.symbol, inp.symbol, column(*symbols))
    code = generated(("point", n, structure(reference)), {"point": lambda: function})
    numbers = np.array([*floats(reference), 0.0])
    called = Call(code, "point", numbers, np.zeros(1 + 2 * n), sum(map(math.prod, shapes)))

    def point(t: float, q: Array, v: Array) -> ReferencePoint:
        called.inp[0], called.inp[1 : 1 + n], called.inp[1 + n :] = t, q, v
        return ReferencePoint(*parts_of(called(), shapes))

    return point
