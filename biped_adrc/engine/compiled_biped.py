"""A robot and references in machine code, for controllers that run in Python.

A `CompiledBiped` is a `model.biped.Biped` with those of its methods that are asked for at every instant in
machine code, traced from `model.planar_robot`; kinematics, contact and all else stay Pinocchio's. `engine.run`
puts it in the place of the plant when a controller has no compiled form. `compiled_references` does the same
for the references of a controller.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property
from types import new_class
from typing import Any, cast

import numpy as np

from biped_adrc.core.part import content, with_content
from biped_adrc.core.types import Array
from biped_adrc.engine.calls import in_code
from biped_adrc.engine.symbols import NotCompiled
from biped_adrc.gait.reference import Reference
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar_robot import PlanarRobot, once_each, robot_of
from biped_adrc.model.reduction import BodyTerms, Reduction


@dataclass(frozen=True)
class CompiledBiped(Biped):
    """A Biped with `reduction`, `body_terms`, `acceleration` and `ground_reaction` in machine code.

    Make it with `of`; robot: what the code is made from and called with.
    """

    robot: PlanarRobot | None = None

    @classmethod
    def of(cls, biped: Biped) -> CompiledBiped:
        """With the formulas of a robot. Raises ModelError for one that is no planar tree."""
        return _compiled(biped)

    @cached_property
    def _made(self) -> dict[str, Callable[..., Any]]:
        """Methods of `robot` in machine code, each made when it is called first."""
        return {}

    def _called(self, method: str, *arguments: Array) -> Any:
        """What a method gives at q and v, each (n,), and more."""
        arguments = (*map(self._angles, arguments[:2]), *arguments[2:])
        if method not in self._made:
            zeros = map(np.zeros_like, arguments)
            self._made[method] = in_code(self.robot, method, *zeros)
        return self._made[method](*arguments)

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms of (11)-(15) at q (n,) [rad], v (n,) [rad/s]."""
        return cast(Reduction, self._called("reduction", q, v))

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """The parts of `BodyTerms` at q (n,) [rad], v (n,) [rad/s]."""
        return cast(BodyTerms, self._called("body_terms", q, v))

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under `force` (n,) [N m], joint friction included."""
        return cast(Array, self._called("acceleration", q, v, force))

    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """On the stance foot (2,) [N] for q'' = a (n,) [rad/s^2]."""
        return cast(Array, self._called("ground_reaction", q, v, a))


@once_each
def _compiled(biped: Biped) -> CompiledBiped:
    """As `CompiledBiped.of`, remembered for the last robots."""
    given = {f.name: getattr(biped, f.name) for f in fields(Biped)}
    return CompiledBiped(**given, robot=robot_of(biped))


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
        point = in_code(reference, "__call__", 0.0, np.zeros(n), np.zeros(n))
    except NotCompiled:
        return reference
    kind = new_class(type(reference).__name__, (type(reference),))
    setattr(kind, "__call__", staticmethod(point))  # noqa: B010
    return with_content(reference, content(reference), kind)
