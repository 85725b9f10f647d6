"""The planar robot on symbols: a plant of `closed_loop.protocols` with the numbers of `PlantArrays`.

D_s, Omega, positions and forces are those of `model.planar`, whose functions run on numbers and
symbols alike. In double support q_e = (q_s, p_e), and with J_m the row of m p_com

    D_e = (D_s, J_m'; J_m, m 1),   E_2 = (J_2, 1)                    (2), (4)

and after the plastic impact (7) the swing foot stands, q_e+' = N q+' with N = (1; -J_2), E_2 N = 0.
N' takes the impulse F_2 out of (7):

    N' D_e N q+' = N' D_e (q-'; 0) = (D_s - J_2' J_m) q-'

N' D_e N (n, n) is the inertia about the swing foot: symmetric, positive definite, and n rows in
place of the n + 4 of (7). D_e itself is singular for a robot whose mass is in one point.

`robot_of` reads structure and numbers off a `Biped`; `engine.program` puts the numbers into K.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from biped_adrc.core.types import Array, Indices
from biped_adrc.engine.symbols import solve_positive, tanh
from biped_adrc.engine.tracer import Tracer
from biped_adrc.model.biped import STICTION_SPEED, Biped
from biped_adrc.model.planar import (
    PlanarTree,
    PlantArrays,
    gravity_and_turning,
    ground_reaction,
    inertia_and_bias,
    jacobian,
    point,
    turned,
)
from biped_adrc.model.reduction import BodyTerms, Reduction, reduce


class RobotStructure(NamedTuple):
    """Compile-time structure: topology, joint signs, sparsity. Numbers are in PlantArrays."""

    n: int
    """Coordinates."""
    p: int
    """Motors."""
    A: Indices
    """Absolute angles of the links a = A q, (n, n) of -1, 0, 1."""
    R: Indices
    """Relabelling of the coordinates at impact (n, n)."""
    offset: Array
    """Constant part of the relabelling (n,) [rad]."""
    swap: Indices
    """Relabelling of the actuated joints (p,)."""
    present: tuple[NDArray[np.bool_], ...]
    """For each of `PlantArrays`, which entries can be different from zero (arrays of bool)."""


class SymbolicImpact(NamedTuple):
    """The state after the impact (7) and relabelling (8), as `model.contact.Impact` has it for numbers."""

    q: Array
    """After relabelling (n,) [rad]."""
    v: Array
    """After impact and relabelling (n,) [rad/s]."""
    impulse: Array
    """F_2 of the ground (2,) [N s]."""


@dataclass(frozen=True)
class PlanarRobot:
    """The robot on symbols, with the methods of `model.biped.Biped` that a closed loop calls."""

    structure: RobotStructure
    """Decides the code."""
    K: PlantArrays
    """Symbols, or numbers, of the robot."""
    friction: tuple[Array, Array] | tuple[()] = ()
    """Viscous [N m s] and static [N m], each (n,), or empty."""

    @classmethod
    def of(
        cls,
        structure: RobotStructure,
        K: PlantArrays,
        friction: tuple[Array, Array] | tuple[()] = (),
    ) -> PlanarRobot:
        """With a plain 0 for the entries of K (n,), (n, n) that the structure says are zero; their
        terms then vanish.
        """
        values: tuple[Any, ...] = K
        pairs = zip(values, structure.present, strict=True)
        kept: list[Any] = [np.where(mask, x, 0.0) if mask.ndim else x for x, mask in pairs]
        return cls(structure, PlantArrays(*kept), friction)

    @property
    def n(self) -> int:
        """Coordinates."""
        return self.structure.n

    @property
    def p(self) -> int:
        """Motors."""
        return self.structure.p

    @property
    def A(self) -> Indices:
        """a = A q (n, n)."""
        return self.structure.A

    @property
    def R(self) -> Indices:
        """Relabelling of the coordinates at an impact (n, n)."""
        return self.structure.R

    def relabel(self, q: Array) -> Array:
        """R q + r: q (n,) [rad] in the coordinates of the next single support."""
        return self.R @ q + self.structure.offset

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms of (11)-(15) at q (n,) [rad], v (n,) [rad/s]."""
        return Tracer()(reduce)(*inertia_and_bias(self, self.K, q, v), self.p)

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """The parts of `BodyTerms` at q (n,) [rad], v (n,) [rad/s]."""
        F_0 = self.ground_reaction(q, v, np.full(self.n, 0.0, dtype=object))
        t = turned(self, q)
        F_a = jacobian(self, t, self.K.w_re, self.K.w_im)
        J_2 = jacobian(self, t, self.K.foot_re, self.K.foot_im)
        return BodyTerms(*gravity_and_turning(self, self.K, t, v), F_a, F_0, J_2, self.K.mass)

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under `force` (n,) [N m], joint friction taken off.

        Static friction is smoothed by tanh(q' / STICTION_SPEED), as in the model of Python's.
        """
        D, Omega = inertia_and_bias(self, self.K, q, v)
        if self.friction:
            viscous, static = self.friction
            force = force - viscous * v - static * tanh(v / STICTION_SPEED)
        return solve_positive(D, force - Omega, "D_s")

    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """On the stance foot (2,) [N], for q'' = a (n,) [rad/s^2]."""
        return ground_reaction(self, self.K, q, v, a)

    def momentum(self, q: Array, v: Array) -> Array:
        """m v_com (2,) [N s]."""
        return jacobian(self, turned(self, q), self.K.w_re, self.K.w_im) @ v

    def swing_foot(self, q: Array) -> Array:
        """(x, z) from the stance foot (2,) [m]."""
        return np.array(point(turned(self, q), self.K.foot_re, self.K.foot_im))

    def hip(self, q: Array) -> Array:
        """(x, z) from the stance foot (2,) [m]."""
        return np.array(point(turned(self, q), self.K.hip_re, self.K.hip_im))

    def kinetic_energy(self, q: Array, v: Array) -> Array:
        """(1/2) v' D_s v [J], at q (n,) [rad], v (n,) [rad/s]."""
        D, _ = inertia_and_bias(self, self.K, q, v)
        return 0.5 * (v @ (D @ v))

    def potential_energy(self, q: Array) -> Array:
        """[J], zero at the height of the stance foot, at q (n,) [rad]."""
        return self.K.gravity * point(turned(self, q), self.K.w_re, self.K.w_im)[1]

    def impact(self, q: Array, v: Array) -> SymbolicImpact:
        """State and impulse after (7), (8) from q (n,) [rad], v (n,) [rad/s], by the equation of the module.

        The impulse is that of the rows of p_e of (7): F_2 = J_m (q+' - q-') - m J_2 q+'.
        """
        K, t, R = self.K, turned(self, q), self.structure.R
        D, _ = inertia_and_bias(self, K, q, v)
        J_m, J_2 = jacobian(self, t, K.w_re, K.w_im), jacobian(self, t, K.foot_re, K.foot_im)
        before = D - J_2.T @ J_m
        after = before - J_m.T @ J_2 + K.mass * (J_2.T @ J_2)
        v_plus = solve_positive(after, before @ v, "N' D_e N")
        F_2 = J_m @ (v_plus - v) - K.mass * (J_2 @ v_plus)
        return SymbolicImpact(R @ q + self.structure.offset, R @ v_plus, F_2)


_T = TypeVar("_T")
REMEMBERED = 64
"""Number of robots whose data is kept in memory."""


@dataclass(frozen=True)
class RobotData:
    """One robot for generated code: `structure` decides the code, `arrays` are given to it at run time."""

    structure: RobotStructure
    arrays: PlantArrays


def once_each(make: Callable[[Biped], _T]) -> Callable[[Biped], _T]:
    """`make`, with what it made of the last REMEMBERED robots; a robot is known by its identity.

    By identity, since comparing two robots would cost more than reading one.
    """
    memory: dict[int, tuple[Biped, _T]] = {}

    def found(biped: Biped) -> _T:
        if id(biped) not in memory or memory[id(biped)][0] is not biped:
            while len(memory) >= REMEMBERED:
                memory.pop(next(iter(memory)))
            memory[id(biped)] = biped, make(biped)
        return memory[id(biped)][1]

    return found


@once_each
def robot_of(biped: Biped) -> RobotData:
    """Structure and numbers of a robot. Raises ModelError when it is no planar tree of rigid links."""
    tree = PlanarTree.of(biped)
    arrays = tree.K
    structure = RobotStructure(
        biped.n,
        biped.p,
        tree.A,
        biped.R.astype(int),
        biped.relabel(np.zeros(biped.n)),
        biped.swap,
        tuple(np.asarray(x) != 0.0 for x in arrays),
    )
    return RobotData(structure, arrays)
