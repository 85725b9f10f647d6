"""The planar robot as a plant in closed form: what a closed loop asks of `Biped`, by the formulas of `planar`.

In double support q_e = (q_s, p_e), and with J_m the row of m p_com

    D_e = (D_s, J_m'; J_m, m 1),   E_2 = (J_2, 1)                    (2), (4)

and after the plastic impact (7) the swing foot stands, q_e+' = N q+' with N = (1; -J_2), E_2 N = 0.
N' takes the impulse F_2 out of (7):

    N' D_e N q+' = N' D_e (q-'; 0) = (D_s - J_2' J_m) q-'

N' D_e N (n, n) is the inertia about the swing foot: symmetric, positive definite, and n rows in
place of the n + 4 of (7). D_e itself is singular for a robot whose mass is in one point.

It is a part as all others (`core.part`): the engine runs its methods on symbols.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from biped_adrc.core.linear import solve_positive
from biped_adrc.core.part import derived, with_fields
from biped_adrc.core.types import Array, Indices
from biped_adrc.model.biped import STICTION_SPEED, Biped
from biped_adrc.model.contact import Impact
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


@dataclass(frozen=True)
class PlanarRobot:
    """A planar tree with two feet and p motors, with the methods of `Biped` that a closed loop calls."""

    A: Indices
    """Absolute angles of the links a = A q, (n, n) of -1, 0, 1."""
    K: PlantArrays
    """Masses, lengths and inertias."""
    p: int
    """Motors."""
    R: Indices
    """Relabelling of the coordinates at an impact (n, n)."""
    offset: Array
    """Constant part of the relabelling (n,) [rad]."""
    swap: Indices
    """Relabelling of the actuated joints (p,)."""
    friction: tuple[Array, Array] | tuple[()] = ()
    """Viscous [N m s] and static [N m], each (n,), or empty."""

    @classmethod
    def of(cls, biped: Biped) -> PlanarRobot:
        """The formulas of a robot. Raises ModelError when it is no planar tree of rigid links."""
        tree = PlanarTree.of(biped)
        return cls(
            tree.A,
            tree.K,
            biped.p,
            biped.R.astype(int),
            biped.relabel(np.zeros(biped.n)),
            biped.swap,
            biped.friction_coefficients if biped.friction else (),
        )

    @derived
    def present(self) -> tuple[NDArray[np.bool_], ...]:
        """For each of K, which entries are different from zero (arrays of bool)."""
        return tuple(np.asarray(x) != 0.0 for x in self.K)

    @property
    def sparse(self) -> PlanarRobot:
        """The same with a plain 0 for what is not `present`; on symbols the terms of those then vanish."""
        numbers: tuple[Any, ...] = self.K
        pairs = zip(numbers, self.present, strict=True)
        kept: list[Any] = [np.where(mask, x, 0.0) if mask.ndim else x for x, mask in pairs]
        return with_fields(self, K=PlantArrays(*kept))

    @property
    def n(self) -> int:
        """Coordinates."""
        return len(self.A)

    def relabel(self, q: Array) -> Array:
        """R q + r: q (n,) [rad] in the coordinates of the next single support."""
        return self.R @ q + self.offset

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms of (11)-(15) at q (n,) [rad], v (n,) [rad/s]."""
        return reduce(*inertia_and_bias(self, self.K, q, v), self.p)

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """The parts of `BodyTerms` at q (n,) [rad], v (n,) [rad/s]."""
        F_0 = self.ground_reaction(q, v, np.zeros(self.n))
        t = turned(self, q)
        F_a = jacobian(self, t, self.K.w_re, self.K.w_im)
        J_2 = jacobian(self, t, self.K.foot_re, self.K.foot_im)
        return BodyTerms(*gravity_and_turning(self, self.K, t, v), F_a, F_0, J_2, self.K.mass)

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under `force` (n,) [N m], joint friction taken off.

        Static friction is smoothed by tanh(q' / STICTION_SPEED), as in `Biped`.
        """
        D, Omega = inertia_and_bias(self, self.K, q, v)
        if self.friction:
            viscous, static = self.friction
            force = force - viscous * v - static * np.tanh(v / STICTION_SPEED)
        return solve_positive(D, force - Omega, "D_s")

    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """On the stance foot (2,) [N], for q'' = a (n,) [rad/s^2]."""
        return ground_reaction(self, self.K, q, v, a)

    def momentum(self, q: Array, v: Array) -> Array:
        """m v_com (2,) [N s]."""
        momentum: Array = jacobian(self, turned(self, q), self.K.w_re, self.K.w_im) @ v
        return momentum

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

    def impact(self, q: Array, v: Array) -> Impact:
        """State and impulse after (7), (8) from q (n,) [rad], v (n,) [rad/s], by the equation of the module.

        The impulse is that of the rows of p_e of (7): F_2 = J_m (q+' - q-') - m J_2 q+'.
        """
        K, t = self.K, turned(self, q)
        D, _ = inertia_and_bias(self, K, q, v)
        J_m, J_2 = jacobian(self, t, K.w_re, K.w_im), jacobian(self, t, K.foot_re, K.foot_im)
        before = D - J_2.T @ J_m
        after = before - J_m.T @ J_2 + K.mass * (J_2.T @ J_2)
        v_plus = solve_positive(after, before @ v, "N' D_e N")
        F_2 = J_m @ (v_plus - v) - K.mass * (J_2 @ v_plus)
        v_e = np.concatenate((v_plus, -(J_2 @ v_plus)))
        return Impact(self.relabel(q), self.R @ v_plus, F_2, v_e)


T = TypeVar("T")
REMEMBERED = 64
"""Number of robots whose formulas are kept in memory."""


def once_each(make: Callable[[Biped], T]) -> Callable[[Biped], T]:
    """`make`, with what it made of the last REMEMBERED robots; a robot is known by its identity.

    By identity, since comparing two robots would cost more than reading one.
    """
    memory: dict[int, tuple[Biped, T]] = {}

    def found(biped: Biped) -> T:
        if id(biped) not in memory or memory[id(biped)][0] is not biped:
            while len(memory) >= REMEMBERED:
                memory.pop(next(iter(memory)))
            memory[id(biped)] = biped, make(biped)
        return memory[id(biped)][1]

    return found


robot_of = once_each(PlanarRobot.of)
"""As `PlanarRobot.of`, remembered for the last robots."""
