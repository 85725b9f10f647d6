"""The planar robot as a plant in closed form: what a closed loop asks of `Biped`, as formulas.

Pinocchio computes numbers only. Gait design (CasADi) and the compiled engine (code generated from expressions)
need the dynamics as formulas, which `PlanarRobot` has for any planar robot, with numbers read off its Pinocchio
model. q (n,) are the coordinates q_s of `Biped`, v = q'. A prime is a transpose on a matrix, a time derivative
on a vector.

    D_s(q) q'' + Omega(q, q') = B_s u + delta + zeta,   Omega = C q' + G_s

    D_s, Omega   inertia matrix (n, n) [kg m^2], Coriolis and gravity terms (n,) [N m]
    C, G_s       Coriolis matrix (n, n) [N m s], torques of gravity (n,) [N m]
    B_s, u       torques of the motors (p,) [N m], and the constant matrix (n, p) by which they act
    zeta, delta  external generalised force, and error of the model, each (n,) [N m]
    p_com, m     place (x, z) of the COM [m], whole mass [kg]
    g, rotor     gravity [m/s^2]; inertia of the motors' rotors, reflected to the coordinates (n,) [kg m^2]

Let a = A q be the absolute angles of the n links, d_k (n,) the constant complex vectors of `planar` to the COM
of link k, x + i z = sum_i d_ki exp(i a_i) from the stance foot, m_k its mass, J_k its inertia about the COM,
and o the product entry by entry. Then in absolute angles, with c = cos a and s = sin a,

    W_ij = sum_k m_k conj(d_ki) d_kj,   w_i = sum_k m_k d_ki
    C_ij = cos(a_j - a_i) = c_i c_j + s_i s_j,   S_ij = sin(a_j - a_i) = c_i s_j - s_i c_j

    D_a = Re W o C - Im W o S + diag J,   Omega_a = -(Re W o S + Im W o C) (da/dt)^2 + g Re(w o exp(i a))

and in the coordinates D_s = A^T D_a A + diag rotor, Omega = A^T Omega_a. (C_ij here are cosines, not the
Coriolis matrix C above.) D_s and Omega are compared to Pinocchio's before anything uses them.

In double support q_e = (q_s, p_e), with the stance foot at p_e (2,) [m]. With J_m (2, n) the Jacobian of m
p_com and J_2 (2, n) that of the swing foot, the inertia matrix D_e in q_e and the Jacobian E_2 of the swing
foot are

    D_e = (D_s, J_m'; J_m, m 1),   E_2 = (J_2, 1)                    (2), (4) of the paper

and after the plastic impact (7) the swing foot stands, q_e+' = N q+' with N = (1; -J_2), E_2 N = 0.
N' takes the impulse F_2 out of (7):

    N' D_e N q+' = N' D_e (q-'; 0) = (D_s - J_2' J_m) q-'

N' D_e N (n, n) is the inertia about the swing foot: symmetric, positive definite, and n rows in
place of the n + 4 of (7). D_e itself is singular for a robot whose mass is in one point.

`PlanarRobot` is a part like controllers and observers (`core.part`): the engine, which makes machine code, runs
its methods on symbols, so none of them branches on a number.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple, Self

import numpy as np

from biped_adrc.core.errors import ModelError
from biped_adrc.core.linear import solve_positive
from biped_adrc.core.part import derived, once, with_fields
from biped_adrc.core.types import Array, Flags, Indices
from biped_adrc.model.biped import STICTION_SPEED, Biped
from biped_adrc.model.contact import Impact
from biped_adrc.model.planar import Numbers, Turned, fitted, jacobian, per_link, point, turned
from biped_adrc.model.reduction import BodyTerms, Reduction, reduce

_EXACT = 1e-11
"""Largest difference to Pinocchio's D_s, Omega and swing foot, relative to their largest entry [1]; also the
share of the largest length below which fitted vectors are round-off."""


class PlantArrays(NamedTuple):
    """Masses, lengths and inertias of n links, as the formulas of the module take them, float64; d are the
    vectors of `planar`.

    The engine passes them at run time, so that one compilation serves all robots of the same structure.
    Complex vectors are stored as real and imaginary part.
    """

    W_re: Array
    """Re W (n, n) [kg m^2]."""
    W_im: Array
    """Im W (n, n) [kg m^2]."""
    inertia: Array
    """Re W_ii + J_i (n,) [kg m^2], the diagonal of D_a."""
    rotor: Array
    """Inertia of the motors' rotors, reflected to the coordinates (n,) [kg m^2]; 0 without a motor."""
    w_re: Array
    """Re w (n,) [kg m]."""
    w_im: Array
    """Im w (n,) [kg m]."""
    foot_re: Array
    """Re d of the swing foot (n,) [m]."""
    foot_im: Array
    """Im d of the swing foot (n,) [m]."""
    hip_re: Array
    """Re d of the hip (n,) [m]."""
    hip_im: Array
    """Im d of the hip (n,) [m]."""
    mass: float
    """Total mass of the robot [kg]."""
    gravity: float
    """Gravity g [m/s^2]."""


@dataclass(frozen=True)
class PlanarRobot:
    """A planar tree with two feet and p motors, with the methods of `Biped` that a closed loop calls."""

    A: Indices
    """Matrix (n, n) of the links' absolute angles a = A q, with entries -1, 0, 1."""
    K: PlantArrays
    """Masses, lengths and inertias."""
    p: int
    """Number of motors."""
    R: Indices
    """Matrix (n, n) of the relabelling q+ = R q- + r, by which the legs exchange their roles at an impact."""
    offset: Array
    """Constant part r of the relabelling (n,) [rad]."""
    swap: Indices
    """Relabelling of the motors (p,): new motor i is entry swap[i] of (q_b, -q_b)."""
    friction: tuple[Array, Array] | tuple[()] = ()
    """Viscous [N m s] and static [N m] joint friction, each (n,), or empty for none."""
    # says to `core.part.once` that nothing here changes, as nobody else has these arrays
    _constant = True

    @classmethod
    def of(cls, biped: Biped) -> Self:
        """The formulas of a robot, with the numbers of its Pinocchio model, and checked against that.

        Raises ModelError when it is no planar tree of rigid links.
        """
        n, (mass, inertia, A) = biped.n, biped.pinned.bodies()
        # _EXACT: largest relative difference to Pinocchio
        d = fitted(A, biped.pinned.points, _EXACT)
        # d (n + 2, n): the COMs, then the swing foot, then the hip
        com, rotor = d[:n], np.zeros(n)
        rotor[: biped.p] = biped.armature
        W = com.conj().T @ (mass[:, np.newaxis] * com)
        w, foot, hip = (per_link(z) for z in (mass @ com, d[n], d[n + 1]))
        total, gravity = float(np.sum(mass)), biped.description.gravity
        inertia = np.diag(W.real) + inertia
        K = PlantArrays(*per_link(W), inertia, rotor, *w, *foot, *hip, total, gravity)
        # relabelling zero angles leaves the constant r
        legs = biped.R.astype(int), biped.relabel(np.zeros(n)), biped.swap
        friction = biped.friction_coefficients if biped.friction else ()
        return cls(A.astype(int), K, biped.p, *legs, friction).check(biped)

    def check(self, biped: Biped, samples: int = 20) -> Self:
        """Return this robot after D_s, Omega and the swing foot are compared with Pinocchio's at random states.

        Raises ModelError where one differs by more than _EXACT times its largest entry, in SI units, or times
        1e-3 where that is larger.
        """
        random = np.random.default_rng(2)
        names = ("D_s", "Omega", "the swing foot")
        for _ in range(samples):
            q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(size=biped.n)
            ours = (*self.inertia_and_bias(q, v), self.swing_foot(q))
            theirs = (biped.inertia(q), biped.bias(q, v), biped.swing_foot(q))
            for name, one, other in zip(names, ours, theirs, strict=True):
                gap = np.max(np.abs(one - other)) / max(1e-3, float(np.max(np.abs(other))))
                if not gap <= _EXACT:
                    raise ModelError(
                        f"robot '{biped.description.name}' is no planar tree of rigid links: {name} in "
                        f"absolute angles differs from Pinocchio's by {gap:.1e} relative, expected {_EXACT:g}; "
                        "look for an axis that is not y"
                    )
        return self

    @derived
    def present(self) -> tuple[Flags, ...]:
        """For each number or array in K, in order, a bool array of its shape: which entries are not zero.

        The engine takes it as structure: another pattern of zeros is another machine code.
        """
        return tuple(np.asarray(x) != 0.0 for x in self.K)

    @property
    def sparse(self) -> Self:
        """A copy for the engine, where K holds symbols: an entry that is zero in the robot (not `present`)
        becomes a plain 0, so that its terms vanish from the expressions.
        """
        # present: for each entry of K whether the robot's own number is not zero
        numbers: tuple[Any, ...] = self.K
        pairs = zip(numbers, self.present, strict=True)
        # single numbers, such as the mass, stay symbols
        kept: list[Any] = [np.where(mask, x, 0.0) if mask.ndim else x for x, mask in pairs]
        return with_fields(self, K=PlantArrays(*kept))

    @property
    def n(self) -> int:
        """Number of coordinates."""
        return len(self.A)

    @property
    def leg(self) -> float:
        """Length of the stretched stance leg [m]: the sum of |d_i| over the hip's vectors."""
        return float(np.sum(np.abs(self.K.hip_re + 1j * self.K.hip_im)))

    def relabel(self, q: Array) -> Array:
        """q (n,) [rad] in the coordinates of the next single support, R q + r (n,) [rad]."""
        return self.R @ q + self.offset

    def inertia_and_bias(self, q: Numbers, v: Numbers) -> tuple[Numbers, Numbers]:
        """D_s (n, n) [kg m^2] and Omega (n,) [N m] of the module, at q (n,) [rad], v = q' (n,) [rad/s]."""
        t, A, K = turned(self.A, q), self.A, self.K
        C, S = _differences(t)
        D = K.W_re * C - K.W_im * S
        # C and S have zeros there: K.inertia has Re W_ii + J_i
        np.fill_diagonal(D, K.inertia)
        D_s = A.T @ D @ A
        for i in range(len(A)):
            D_s[i, i] = D_s[i, i] + K.rotor[i]
            D_s[i, :i] = D_s[:i, i]  # exactly symmetric, and the same symbols twice
        # _weight: g Re(w o exp(i a)), the torques of gravity in absolute angles
        return D_s, A.T @ (_weight(K, t) - (K.W_re * S + K.W_im * C) @ (A @ v) ** 2)

    def gravity_and_turning(self, t: Turned[Numbers], v: Numbers) -> tuple[Numbers, Numbers]:
        """Gravity G_s = dV/dq (n,) [N m] and dT/dq = C^T q' (n,) [N m], with the potential energy V and the
        kinetic energy T.

        t: cosines and sines of the absolute angles a. v = q' (n,) [rad/s]. C^T: the Coriolis matrix transposed.
        dT/da = a' o ((Re W o S + Im W o C) a') is mapped to q by A^T, with C and S of the module.
        """
        A, K, rate = self.A, self.K, self.A @ v
        # cos and sin of a_j - a_i; turning: dT/da; _weight: dV/da
        C, S = _differences(t)
        turning = rate * ((K.W_re * S + K.W_im * C) @ rate)
        return A.T @ _weight(K, t), A.T @ turning

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms of (11)-(15) at q (n,) [rad], v (n,) [rad/s], such as kappa and xi."""
        return reduce(*self.inertia_and_bias(q, v), self.p)

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """`BodyTerms` at q (n,) [rad], v (n,) [rad/s]: gravity, dT/dq, ground force, swing foot and mass."""
        F_0 = self.ground_reaction(q, v, np.zeros(self.n))
        t = turned(self.A, q)
        F_a = jacobian(self.A, t, self.K.w_re, self.K.w_im)
        J_2 = jacobian(self.A, t, self.K.foot_re, self.K.foot_im)
        return BodyTerms(*self.gravity_and_turning(t, v), F_a, F_0, J_2, self.K.mass)

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under the generalised force B_s u + delta + zeta (n,) [N m] and joint friction.

        Static friction is smoothed by tanh(q' / STICTION_SPEED), as in `Biped`.
        """
        D, Omega = self.inertia_and_bias(q, v)
        if self.friction:
            viscous, static = self.friction
            force = force - viscous * v - static * np.tanh(v / STICTION_SPEED)
        return solve_positive(D, force - Omega, "D_s")

    def ground_reaction(self, q: Numbers, v: Numbers, a: Numbers) -> Numbers:
        """Force (F_T, F_N) (2,) [N] of the ground on the stance foot, along x and z: m p_com'' + (0, m g).

        q (n,) [rad], v = q' (n,) [rad/s]; a = q'' (n,) [rad/s^2], not the absolute angles.
        """
        K, t, rate2 = self.K, turned(self.A, q), (self.A @ v) ** 2
        F_x, F_z = jacobian(self.A, t, K.w_re, K.w_im) @ a
        # m p_com'' = J_m q'' - w exp(i a) (a')^2; the second part is `point` with c, s times the squared rates
        x, z = point(Turned(t.c * rate2, t.s * rate2), K.w_re, K.w_im)
        return np.array([F_x - x, F_z - z + K.mass * K.gravity])

    def momentum(self, q: Array, v: Array) -> Array:
        """Linear momentum m p_com' (x, z) (2,) [N s] at q (n,) [rad], v (n,) [rad/s]."""
        return jacobian(self.A, turned(self.A, q), self.K.w_re, self.K.w_im) @ v

    def swing_foot(self, q: Array) -> Array:
        """Position (x, z) of the swing foot from the stance foot (2,) [m], at q (n,) [rad]."""
        return np.array(point(turned(self.A, q), self.K.foot_re, self.K.foot_im))

    def hip(self, q: Array) -> Array:
        """Position (x, z) of the hip from the stance foot (2,) [m], at q (n,) [rad]."""
        return np.array(point(turned(self.A, q), self.K.hip_re, self.K.hip_im))

    def kinetic_energy(self, q: Array, v: Array) -> Array:
        """Kinetic energy v^T D_s v / 2 [J], a number, at q (n,) [rad], v (n,) [rad/s]."""
        D, _ = self.inertia_and_bias(q, v)
        return 0.5 * (v @ (D @ v))

    def potential_energy(self, q: Array) -> Array:
        """Potential energy [J], a number, at q (n,) [rad]; zero at the height of the stance foot."""
        # [1]: the height times the mass, m z_com
        return self.K.gravity * point(turned(self.A, q), self.K.w_re, self.K.w_im)[1]

    def impact(self, q: Array, v: Array) -> Impact:
        """The plastic impact of the swing foot at q- = q (n,) [rad], q'- = v (n,) [rad/s]: N' D_e N q+' = (D_s
        - J_2' J_m) q-', then the relabelling of the legs.

        The impulse is that of the rows of p_e of (7): F_2 = J_m (q+' - q-') - m J_2 q+'.
        """
        K, t = self.K, turned(self.A, q)
        D, _ = self.inertia_and_bias(q, v)
        J_m, J_2 = jacobian(self.A, t, K.w_re, K.w_im), jacobian(self.A, t, K.foot_re, K.foot_im)
        # the matrices of q-' and of q+' in that equation
        before = D - J_2.T @ J_m
        after = before - J_m.T @ J_2 + K.mass * (J_2.T @ J_2)
        v_plus = solve_positive(after, before @ v, "N' D_e N")
        F_2 = J_m @ (v_plus - v) - K.mass * (J_2 @ v_plus)
        # the swing foot stops, so the old stance foot moves with -J_2 q+'
        v_e = np.concatenate((v_plus, -(J_2 @ v_plus)))
        return Impact(self.relabel(q), self.R @ v_plus, F_2, v_e)


def _differences(t: Turned[Numbers]) -> tuple[Numbers, Numbers]:
    """cos and sin of a_j - a_i (n, n), with 0 on both diagonals, also in place of cos 0 = 1.

    The true 1 adds the constant Re W_ii to D_a, which `PlantArrays.inertia` contains, and nothing to Omega_a,
    since Im W_ii = 0.
    """
    off = 1.0 - np.eye(len(t.c))
    C = (np.outer(t.c, t.c) + np.outer(t.s, t.s)) * off
    return C, (np.outer(t.c, t.s) - np.outer(t.s, t.c)) * off


def _weight(K: PlantArrays, t: Turned[Numbers]) -> Numbers:
    """dV/da = g Re(w o exp(i a)) (n,) [N m], the torques of gravity in absolute angles a."""
    return K.gravity * (K.w_re * t.c - K.w_im * t.s)


robot_of = once(PlanarRobot.of)
"""`PlanarRobot.of(biped)`, whose result is kept in the Biped and returned again."""
