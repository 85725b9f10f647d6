"""Generated code that Python calls: methods of parts, and terms of a disturbance.

A generated function is `void f(double* K, double* inp, double* out)`: K has the numbers of the part that it was
made from, and one unused number at its end so that it is never empty; inp its inputs, out its outputs, arrays
joined one after the other. zeta (n,) [N m] is a disturbance, the generalised torque from outside. For
controllers that run in Python `CompiledBiped` is a `model.biped.Biped` with those of its methods in machine
code that are asked for at every instant, traced from `model.planar_robot`; kinematics, contact and all else
stay Pinocchio's. `compiled_references` does the same for the references of a controller.
"""

import ctypes
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property, partial
from types import new_class
from typing import Any, cast

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.core.part import content, once, with_content
from biped_adrc.core.tree import Layout, flatten
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import NO_PUSH, Disturbance
from biped_adrc.engine.generated import generated, with_casadi
from biped_adrc.engine.machine import Code
from biped_adrc.engine.not_compiled import NotCompiled, located
from biped_adrc.engine.program import push_code
from biped_adrc.engine.structure import floats, structure
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar_robot import PlanarRobot, robot_of
from biped_adrc.model.reduction import BodyTerms, Reduction

FUNCTION = ctypes.PYFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)
"""ctypes' type of f(K, inp, out), three addresses; it keeps Python's lock, whose release costs as much."""


class Call:
    """One generated function with arrays of its own for inputs and outputs; not to be shared between threads.

    A caller writes to `inp` and then calls it; a change of the numbers in `K` counts from the next call on.
    """

    def __init__(self, machine: Code, name: str, K: Array, inputs: int, outputs: int):
        """name: of the function in `machine`; K (size,): its parameters; inputs, outputs: how many numbers."""
        self.K, self.inp, self.out = K, np.zeros(inputs), np.zeros(max(1, outputs))
        self._function = FUNCTION(machine.addresses[name])
        self._at = (K.ctypes.data, self.inp.ctypes.data, self.out.ctypes.data)

    def __call__(self) -> Array:
        """The outputs (outputs,) for the inputs in `inp`, as a read-only copy."""
        self._function(*self._at)
        out = self.out.copy()
        out.setflags(write=False)  # parts of it that are handed out are read-only then, too
        return out

    def rows(self, inp: Array) -> Array:
        """The outputs (N, outputs) for N rows of inputs, inp (N, inputs); the array `inp` of the object
        stays."""
        inp, out = np.ascontiguousarray(inp), np.empty((len(inp), len(self.out)))
        starts = inp.ctypes.data, out.ctypes.data
        K, inputs, outputs = self.K.ctypes.data, inp.strides[0], out.strides[0]
        # row i begins i times the length of a row [bytes] after the first one
        for i in range(len(inp)):
            self._function(K, starts[0] + i * inputs, starts[1] + i * outputs)
        return out


def pushes(disturbance: Disturbance | None, n: int) -> list[Call]:
    """The functions of a disturbance's terms, each (t, step, t_start, q, v) -> (zeta (n,) [N m], force (2,)
    [N]), for n coordinates; an empty list without a disturbance.

    Raises NotCompiled for a term without machine code.
    """
    terms, sizes = (disturbance or NO_PUSH).terms, (3 + 2 * n, n + 2)
    return [Call(push_code(x, n), "push", np.array([*floats(x), 0.0]), *sizes) for x in terms]


def zeta_rows(terms: Sequence[Call], t: Array, rows: Array, mode: Mode, n: int) -> Array:
    """The sum zeta (K, n) [N m] of the `terms`, functions of `pushes`, at K times t (K,) [s] of one single
    support; rows (K, ..) begin with q and q', n numbers each.
    """
    when = np.broadcast_to((mode.step, mode.start), (len(t), 2))
    inp = np.column_stack((t, when, rows[:, : 2 * n]))
    # [:, :n]: zeta, without the force behind it
    return sum((term.rows(inp)[:, :n] for term in terms), np.zeros((len(t), n)))


def in_code(part: Any, method: str, *examples: Array | float) -> Callable[..., Any]:
    """A function that computes in machine code what a method of a part returns, an array or a tuple of arrays.

    examples: arguments with the right shapes, at which the method is called once in Python for the shapes of
    its result. Any thread may call the function. Raises NotCompiled, also where the method raises at them.
    """
    with located(getattr(part, method)):
        result = Layout.of(getattr(part, method)(*examples))
    inputs = Layout.of(examples)

    traced = partial(with_casadi, "equations", "method_function", part, method, inputs)
    code = generated((method, inputs, structure(part)), {"method": traced})
    called = Call(code, "method", np.array([*floats(part), 0.0]), inputs.size, result.size)
    one_thread = threading.Lock()

    def evaluated(*arguments: Array | float) -> Any:
        with one_thread:
            called.inp[:] = flatten(arguments)
            return result.tree(called())

    return evaluated


@dataclass(frozen=True)
class CompiledBiped(Biped):
    """A Biped with `reduction`, `body_terms`, `acceleration` and `ground_reaction` in machine code.

    Make it with `compiled_biped`. Numbers such as (11) are equations of the paper.
    """

    robot: PlanarRobot | None = None
    """The same robot in closed form, whose methods are traced; never None after `compiled_biped`."""

    @cached_property
    def _methods(self) -> dict[str, Callable[..., Any]]:
        """Methods of `robot` in machine code, by name; `_called` adds each one when it is called first."""
        return {}

    def _called(self, method: str, *arguments: Array) -> Any:
        """Call a method in machine code at q [rad] and v [rad/s], each (n,) and checked, and further
        arguments."""
        # `_angles` checks a vector; zeros: an example of the arguments, by which `in_code` learns their
        # shapes
        arguments = (*map(self._angles, arguments[:2]), *arguments[2:])
        if method not in self._methods:
            self._methods[method] = in_code(self.robot, method, *map(np.zeros_like, arguments))
        return self._methods[method](*arguments)

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms of (11)-(15), such as kappa and xi of q_b'' = kappa u + xi for the joints q_b with motors,
        at q (n,) [rad], v (n,) [rad/s].
        """
        return cast(Reduction, self._called("reduction", q, v))

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """Terms of momentum and ground force of the whole robot, at q (n,) [rad], v (n,) [rad/s]."""
        return cast(BodyTerms, self._called("body_terms", q, v))

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under `force` (n,) [N m], joint friction included."""
        return cast(Array, self._called("acceleration", q, v, force))

    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """Force of the ground on the stance foot (2,) [N] for q'' = a (n,) [rad/s^2]."""
        return cast(Array, self._called("ground_reaction", q, v, a))


@once
def compiled_biped(biped: Biped) -> CompiledBiped:
    """A copy of a robot with its dynamics in machine code, made once for each robot. Raises ModelError for one
    that is no planar tree.
    """
    values = {f.name: getattr(biped, f.name) for f in fields(Biped)}
    return CompiledBiped(**values, robot=robot_of(biped))


class CompiledReference:
    """A reference for n coordinates in machine code. Raises NotCompiled for one that cannot be compiled.

    `twin` takes the reference's place in a controller: it is of a subclass of the reference's class, and a call
    of it runs the code. A copy of the twin with other numbers, such as `replace` makes, runs in Python.
    """

    def __init__(self, reference: Reference, n: int):
        # kind: a class for the twin alone, since Python looks __call__ up in the class of an object
        base = type(reference)
        kind = new_class(base.__name__, (base,))
        self.reference, self.twin = reference, with_content(reference, content(reference), kind)
        self._point = in_code(reference, "__call__", 0.0, np.zeros(n), np.zeros(n))
        self.known: tuple[float, Array, Array, ReferencePoint] | None = None
        """t [s], q, v and the point there, or None. A call with these very arrays, which are read-only, and
        this t returns the point without computing it; `engine.ticks` sets it."""

        def called(this: Reference, t: float, q: Array, v: Array) -> ReferencePoint:
            return self(t, q, v) if this is self.twin else base.__call__(this, t, q, v)

        setattr(kind, "__call__", called)  # noqa: B010

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        """The point at t [s], q (n,) [rad], v (n,) [rad/s]."""
        # known: (t, q, v, point) of a sample instant for which it was computed already, or None
        known = self.known
        if known is not None and q is known[1] and v is known[2] and t == known[0]:
            return known[3]
        return cast(ReferencePoint, self._point(t, q, v))


def compiled_references(part: object, n: int, references: list[CompiledReference]) -> Any:
    """A controller, or a part of one, with `CompiledReference.twin` in place of the references in its fields,
    for n coordinates.

    Controllers nest (`inner`), so fields of dataclasses are searched to any depth. Each `CompiledReference` is
    appended to the list `references`. A reference that cannot be compiled stays as it is.
    """
    if isinstance(part, Reference):
        with suppress(NotCompiled):
            references.append(CompiledReference(part, n))
            return references[-1].twin
        return part
    # classes, which count as dataclasses too, and robots have no references in them
    if not is_dataclass(part) or isinstance(part, type | Biped):
        return part
    values = {f.name: getattr(part, f.name) for f in fields(part) if f.init}
    parts = {name: compiled_references(value, n, references) for name, value in values.items()}
    changed = {name: value for name, value in parts.items() if value is not values[name]}
    return replace(part, **changed) if changed else part
