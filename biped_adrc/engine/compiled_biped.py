"""A robot whose dynamics are compiled, for controllers in plain Python.

Kinematics, contact and everything that is not asked for at every instant stay Pinocchio's.

The equations of a robot by itself on symbols, for controllers in plain Python.

terms (q, v) -> D, Omega, kappa, xi, ... of (11)-(15),   body (q, v) -> G, C' q', F_a, F_0
accelerate (q, v, force) -> q'',   ground (q, v, a) -> F
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from functools import cached_property, partial
from typing import Any

import numpy as np

from biped_adrc.engine.equations import Function, count
from biped_adrc.engine.fingerprint import hash_of, skeleton, versions_text
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.machine import Machine, Text, machine
from biped_adrc.engine.mechanics import REMEMBERED, PlanarRobot, Robot, Structure, robot_of
from biped_adrc.engine.symbols import Vector, column, floats
from biped_adrc.errors import ModelError
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import EXACT, PlantArrays
from biped_adrc.model.reduction import BodyTerms, Reduction
from biped_adrc.types import Array

SAMPLES = 50
"""Random states at which the code is held against Pinocchio."""
_C = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)


def pointer_call(machine: Machine, name: str, K: Array, inp: Array, out: Array) -> None:
    """A function for every row of inp (N, inputs) and out (N, outputs), both contiguous float64."""
    function = _C(machine.addresses[name])
    at, given, result = K.ctypes.data, inp.ctypes.data, out.ctypes.data
    for _ in range(len(inp)):
        function(at, given, result)
        given, result = given + inp.strides[0], result + out.strides[0]


def parts_of(rows: Array, shapes: Any) -> Iterator[Array]:
    """Arrays of these shapes that lie one after the other in `rows` (size,) or (N, size)."""
    at = 0
    for shape in shapes:
        part = rows[..., at : at + math.prod(shape)]
        yield part.reshape(*rows.shape[:-1], *shape)
        at += math.prod(shape)


class Call:
    """One function with its own input and output arrays."""

    def __init__(self, machine: Machine, name: str, K: Array, inputs: int, outputs: int):
        self.owner, self.K = machine, K
        self.inp, self.out = np.zeros(inputs), np.zeros(max(1, outputs))
        self._function = _C(machine.addresses[name])
        self._at = (K.ctypes.data, self.inp.ctypes.data, self.out.ctypes.data)

    def __call__(self) -> Array:
        self._function(*self._at)
        return self.out.copy()


_MADE: dict[int, tuple[Biped, CompiledBiped]] = {}


@dataclass(frozen=True)
class CompiledBiped(Biped):
    """A Biped with `reduction`, `acceleration` and `ground_reaction` in machine code; make it with `of`."""

    robot: Robot | None = None

    @classmethod
    def of(cls, biped: Biped) -> CompiledBiped:
        """Compile, or take from memory or disk, and check.

        Raises ModelError for a robot that is no planar tree of rigid links, or where the code differs from
        Pinocchio by more than 1e-11 relative.
        """
        found = _MADE.get(id(biped))
        if found is None or found[0] is not biped:
            while len(_MADE) >= REMEMBERED:
                _MADE.pop(next(iter(_MADE)))
            given = {f.name: getattr(biped, f.name) for f in fields(Biped)}
            found = biped, cls(**given, robot=robot_of(biped)).checked(biped)
            _MADE[id(biped)] = found
        return found[1]

    def checked(self, biped: Biped, samples: int = SAMPLES) -> CompiledBiped:
        """Itself, when its terms are Pinocchio's at random states and q'' obeys (1). Raises ModelError."""
        random = np.random.default_rng(3)
        for _ in range(samples):
            q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(0.0, 3.0, biped.n)
            force = random.normal(0.0, 30.0, biped.n)
            terms, D, Omega = self.reduction(q, v), biped.inertia(q), biped.bias(q, v)
            free = force + self.friction_torque(v) - Omega
            a = self.acceleration(q, v, force)
            gaps = {
                "D_s": (terms.D - D, D),
                "Omega": (terms.Omega - Omega, Omega),
                "D_s q''": (D @ a - free, np.abs(D) @ np.abs(a)),
            }
            for name, (gap, scale) in gaps.items():
                relative = float(np.max(np.abs(gap)) / np.max(np.abs(scale)))
                if not relative <= EXACT:
                    raise ModelError(
                        f"robot '{self.description.name}': {name} of the compiled code differs from "
                        f"Pinocchio's by {relative:.1e} relative, expected {EXACT:g}; use engine='pinocchio'"
                    )
        return self

    @cached_property
    def _calls(self) -> dict[str, Call]:
        robot = self.robot
        assert robot is not None
        key = hash_of("plant", skeleton(robot.structure), skeleton(robot.arrays), versions_text())
        functions = PlantEquations.of(robot.structure, robot.arrays).functions()
        code = machine(
            key, list(functions), lambda: Text(module_text({k: f() for k, f in functions.items()}))
        )
        K, n = np.array([*floats(robot.arrays), 0.0]), self.n
        sizes = {
            "terms": (2 * n, self.size),
            "body": (2 * n, 4 * n + 2),
            "accelerate": (3 * n, n),
            "ground": (3 * n, 2),
        }
        return {name: Call(code, name, K, *size) for name, size in sizes.items()}

    @cached_property
    def shapes(self) -> Reduction:
        """Of the parts of a `Reduction`, which `terms` gives one after the other."""
        n, p = self.n, self.p
        return Reduction(*((n, n), (n,), (p, p), (p,), (p, p), (n - p, p), (n - p,)))  # type: ignore[arg-type]

    @property
    def size(self) -> int:
        """Numbers in a `Reduction`."""
        return sum(map(math.prod, self.shapes))

    def reduction(self, q: Array, v: Array) -> Reduction:
        call, n = self._calls["terms"], self.n
        call.inp[:n], call.inp[n:] = self._angles(q), self._angles(v)
        return Reduction(*parts_of(call(), self.shapes))

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        call, n = self._calls["body"], self.n
        call.inp[:n], call.inp[n:] = self._angles(q), self._angles(v)
        out = call()
        return BodyTerms(out[:n], out[n : 2 * n], out[2 * n : 4 * n].reshape(2, n), out[4 * n :])

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        call, n = self._calls["accelerate"], self.n
        if self.friction:
            force = force + self.friction_torque(v)
        call.inp[:n], call.inp[n : 2 * n], call.inp[2 * n :] = (
            self._angles(q),
            self._angles(v),
            force,
        )
        return call()

    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        call, n = self._calls["ground"], self.n
        call.inp[:n], call.inp[n : 2 * n], call.inp[2 * n :] = self._angles(q), self._angles(v), a
        return call()


@dataclass(frozen=True)
class PlantEquations:
    """The functions of a robot by itself; K is CasADi's column of the symbols in it."""

    robot: PlanarRobot
    K: Any

    @classmethod
    def of(cls, structure: Structure, example: PlantArrays) -> PlantEquations:
        """With symbols for the floats of an example."""
        K = Vector("K", count(example))
        return cls(PlanarRobot.of(structure, K.like(example)), K.symbol)

    def functions(self) -> dict[str, Callable[[], Function]]:
        """By name; `terms` and `body` give the parts of their tuples one after the other."""
        robot = self.robot
        found: dict[str, tuple[Callable[..., Any], int]] = {
            "terms": (robot.reduction, 2),
            "body": (robot.body_terms, 2),
            "accelerate": (robot.acceleration, 3),
            "ground": (robot.ground_reaction, 3),
        }
        return {name: partial(self._made, *how) for name, how in found.items()}

    def _made(self, law: Callable[..., Any], count: int) -> Function:
        """The function of `count` vectors (n,)."""
        inp = Vector("inp", count * self.robot.n)
        given = (inp.take(self.robot.n) for _ in range(count))
        parts = law(*given)
        return Function(self.K, inp.symbol, column(*parts))
