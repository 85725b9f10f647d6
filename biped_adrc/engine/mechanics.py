"""The planar robot on symbols: a `closed_loop.semantics.WalkingPlant` with the numbers of `PlantArrays`.

With a = A q, c = cos a, s = sin a, C_ij = cos(a_j - a_i) = c_i c_j + s_i s_j and S_ij = sin(a_j - a_i):

    D = Re W o C - Im W o S + diag J,   Omega = -(Re W o S + Im W o C) a'^2 + g Re(w exp(i a))

taken to the coordinates by A. In double support q_e = (q_s, p_e), and with J_m the row of m p_com

    D_e = (D_s, J_m'; J_m, m 1),   E_2 = (J_2, 1)                    (2), (4)

and after the plastic impact (7) the swing foot stands, q_e+' = N q+' with N = (1; -J_2), E_2 N = 0. N' takes
the impulse F_2 out of (7):

    N' D_e N q+' = N' D_e (q-'; 0) = (D_s - J_2' J_m) q-'

N' D_e N is the inertia about the swing foot; D_e itself is singular for a robot whose mass is in one point.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from biped_adrc.engine.plant import PlantArrays
from biped_adrc.engine.symbols import Tracer, cos, sin, solve_positive, tanh
from biped_adrc.model.biped import STICTION_SPEED
from biped_adrc.model.reduction import BodyTerms, Reduction, reduce
from biped_adrc.types import Array


class Structure(NamedTuple):
    """What is no number of a robot but its make: links, signs, and which terms there are."""

    n: int
    p: int
    A: NDArray[np.int_]
    """a = A q (n, n)."""
    R: NDArray[np.int_]
    """Relabelling at impact (n, n)."""
    offset: Array
    """Relabelling at impact (n,) [rad]."""
    swap: NDArray[np.int_]
    """Relabelling of the actuated joints (p,)."""
    present: tuple[Any, ...]
    """Which of the numbers of `PlantArrays` are not zero by make, arrays of bool."""


def without_zeros(robot: Structure, K: PlantArrays) -> PlantArrays:
    """The numbers with a plain 0 for those that are zero by make, whose terms then vanish."""
    pairs: Any = zip(K, robot.present, strict=True)
    kept: Any = [np.where(mask, x, 0.0) if mask.ndim else x for x, mask in pairs]
    return PlantArrays(*kept)


class Turned(NamedTuple):
    """Cosines and sines of the absolute angles, (n,)."""

    c: Any
    s: Any

    def products(self) -> tuple[Any, Any]:
        """C and S of the module, (n, n), with zeros on the diagonal."""
        off = 1.0 - np.eye(len(self.c))
        C = np.outer(self.c, self.c) + np.outer(self.s, self.s)
        return C * off, (np.outer(self.c, self.s) - np.outer(self.s, self.c)) * off

    def point(self, re: Any, im: Any) -> Any:
        """(x, z) [m] of a point, from its vectors."""
        return np.array([re @ self.c - im @ self.s, im @ self.c + re @ self.s], dtype=object)


class Impact(NamedTuple):
    """After the impact (7) and relabelling (8): q and v (n,), and the impulse F_2 (2,) [N s]."""

    q: Any
    v: Any
    impulse: Any


@dataclass(frozen=True)
class PlanarRobot:
    """Methods as those of `model.biped.Biped`; friction: viscous [N m s] and static [N m], or empty."""

    structure: Structure
    K: PlantArrays
    friction: tuple[Any, ...] = ()

    @classmethod
    def of(
        cls, structure: Structure, K: PlantArrays, friction: tuple[Any, ...] = ()
    ) -> PlanarRobot:
        """Without the terms that are zero by make."""
        return cls(structure, without_zeros(structure, K), friction)

    @property
    def n(self) -> int:
        """Coordinates."""
        return self.structure.n

    @property
    def p(self) -> int:
        """Motors."""
        return self.structure.p

    def turned(self, q: Any) -> Turned:
        """At the angles q (n,)."""
        a = self.structure.A @ q
        return Turned(cos(a), sin(a))

    def inertia_and_bias(self, q: Any, v: Any) -> tuple[Any, Any]:
        """D_s (n, n) and Omega (n,)."""
        K, A, t, n = self.K, self.structure.A, self.turned(q), self.n
        C, S = t.products()
        D = K.W_re * C - K.W_im * S
        for i in range(n):
            D[i, i] = K.inertia[i]
        spin = K.W_re * S + K.W_im * C
        Omega = K.gravity * (K.w_re * t.c - K.w_im * t.s) - spin @ (A @ v) ** 2
        D_s = A.T @ D @ A
        for i in range(n):
            D_s[i, i] = D_s[i, i] + K.rotor[i]
        for i in range(n):
            for j in range(i):
                D_s[i, j] = D_s[j, i]
        return D_s, A.T @ Omega

    def reduction(self, q: Any, v: Any) -> Reduction:
        terms: Reduction = Tracer()(reduce)(*self.inertia_and_bias(q, v), self.p)
        return terms

    def body_terms(self, q: Any, v: Any) -> BodyTerms:
        K, A, t, rate = self.K, self.structure.A, self.turned(q), self.structure.A @ v
        C, S = t.products()
        turning = A.T @ (rate * ((K.W_re * S + K.W_im * C) @ rate))
        G = A.T @ (K.gravity * (K.w_re * t.c - K.w_im * t.s))
        F_0 = self.ground_reaction(q, v, np.full(self.n, 0.0, dtype=object))
        return BodyTerms(G, turning, self.jacobian(t, K.w_re, K.w_im), F_0)

    def acceleration(self, q: Any, v: Any, force: Any) -> Any:
        D, Omega = self.inertia_and_bias(q, v)
        if self.friction:
            viscous, static = self.friction
            force = force - viscous * v - static * tanh(v / STICTION_SPEED)
        return solve_positive(D, force - Omega, "D_s")

    def jacobian(self, t: Turned, re: Any, im: Any) -> Any:
        """d(x, z)/dq (2, n) of a point."""
        rows = [-(re * t.s) - im * t.c, re * t.c - im * t.s]
        return np.array([self.structure.A.T @ row for row in rows], dtype=object)

    def ground_reaction(self, q: Any, v: Any, a: Any) -> Any:
        K, t, rate2 = self.K, self.turned(q), (self.structure.A @ v) ** 2
        F = self.jacobian(t, K.w_re, K.w_im) @ a
        x, z = Turned(t.c * rate2, t.s * rate2).point(K.w_re, K.w_im)
        return np.array([F[0] - x, F[1] - z + K.mass * K.gravity], dtype=object)

    def momentum(self, q: Any, v: Any) -> Any:
        return self.jacobian(self.turned(q), self.K.w_re, self.K.w_im) @ v

    def swing_foot(self, q: Any) -> Any:
        return self.turned(q).point(self.K.foot_re, self.K.foot_im)

    def hip(self, q: Any) -> Any:
        return self.turned(q).point(self.K.hip_re, self.K.hip_im)

    def kinetic_energy(self, q: Any, v: Any) -> Any:
        D, _ = self.inertia_and_bias(q, v)
        return 0.5 * (v @ (D @ v))

    def potential_energy(self, q: Any) -> Any:
        return self.K.gravity * self.turned(q).point(self.K.w_re, self.K.w_im)[1]

    def impact(self, q: Any, v: Any) -> Impact:
        """By the rows of p_e of (7)."""
        K, t, R = self.K, self.turned(q), self.structure.R
        D, _ = self.inertia_and_bias(q, v)
        J_m, J_2 = self.jacobian(t, K.w_re, K.w_im), self.jacobian(t, K.foot_re, K.foot_im)
        before = D - J_2.T @ J_m
        after = before - J_m.T @ J_2 + K.mass * (J_2.T @ J_2)
        v_plus = solve_positive(after, before @ v, "N' D_e N")
        F_2 = J_m @ (v_plus - v) - K.mass * (J_2 @ v_plus)
        return Impact(R @ q + self.structure.offset, R @ v_plus, F_2)
