"""The dynamics of a planar robot as formulas, with numbers read off its Pinocchio model.

    D_s(q) q'' + Omega(q, q') = B_s u + zeta,   Omega = C q' + G_s

Pinocchio computes numbers only. Gait design (CasADi) and the compiled engine (code generated from
expressions) need the dynamics as formulas, which this module gives for any planar robot.

a = A q (n,) are the absolute angles of the links, counter-clockwise with x to the right and z up, zero for a
link that points up. The place x + i z of every point fixed to the robot, as a complex number [m] from the
stance foot, is a sum of turned vectors with constant complex numbers d (n,) [m], one number per link:

    x + i z = sum_i d_i exp(i a_i)

Let d_k (n,) be those of the COM of link k, m_k its mass, J_k its inertia about the COM, and o the product entry
by entry. Then in absolute angles, with c = cos a and s = sin a,

    W_ij = sum_k m_k conj(d_ki) d_kj,   w_i = sum_k m_k d_ki
    C_ij = cos(a_j - a_i) = c_i c_j + s_i s_j,   S_ij = sin(a_j - a_i) = c_i s_j - s_i c_j

    D_a = Re W o C - Im W o S + diag J,   Omega_a = -(Re W o S + Im W o C) (da/dt)^2 + g Re(w o exp(i a))

and in the coordinates D_s = A^T D_a A + diag rotor, Omega = A^T Omega_a. (C_ij here are cosines, not the
Coriolis matrix C above.) The vectors d are fitted to Pinocchio's own positions, where the fit is exact, and D_s
and Omega are compared to Pinocchio's before anything uses them. The functions take numbers and object arrays of
symbols alike: NumPy asks each symbol for its `cos` and `sin`.

`wrench_torque` is the generalised force of a force and a moment at a point fixed to a link, for
disturbances: with J(q) (2, n) the Jacobian of the point, and b (n,) that of the link's own absolute angle,

    zeta = J^T (F_x, F_z) + b^T M
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, NamedTuple, Protocol, TypeVar

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.model.biped import Biped
from biped_adrc.model.pinned import frame_index

Numbers = TypeVar("Numbers", Array, NDArray[np.object_])
"""Arrays of numbers, or of symbols; a function that is given one kind returns the same kind."""
EXACT = 1e-11
"""Largest difference to Pinocchio's D_s, Omega, swing foot and hip, relative to their largest entry."""


class PlantArrays(NamedTuple):
    """Masses, lengths and inertias of n links, as the formulas for D_s and Omega take them, float64.

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


class Joined(Protocol):
    """Anything with the matrix A of the absolute angles: a `PlanarTree`, a `LinkPoint`, the engine's robot."""

    @property
    def A(self) -> NDArray[np.int_] | Array:
        """Matrix (n, n) of the absolute angles [rad], a = A q."""


@dataclass(frozen=True)
class PlanarTree:
    """A planar robot of n links: which coordinates turn which link (A), and the numbers of the formulas (K)."""

    A: NDArray[np.int_]
    """Matrix (n, n) of integers, a = A q: row i has the coordinates whose sum is the angle of link i."""
    K: PlantArrays
    """Masses, lengths and inertias."""

    @classmethod
    def of(cls, biped: Biped) -> PlanarTree:
        """Make the tree of a robot: A and K from its Pinocchio model, checked against it.

        Raises ModelError when the robot is not a planar tree of rigid links.
        """
        n, (mass, inertia, A) = biped.n, biped.pinned.bodies()
        d = fitted(A, biped.pinned.points, EXACT)
        com, rotor = d[:n], np.zeros(n)
        rotor[: biped.p] = biped.armature
        W = com.conj().T @ (mass[:, np.newaxis] * com)
        w, foot, hip = (_parts(z) for z in (mass @ com, d[n], d[n + 1]))
        total, gravity = float(np.sum(mass)), biped.description.gravity
        inertia = np.diag(W.real) + inertia
        K = PlantArrays(*_parts(W), inertia, rotor, *w, *foot, *hip, total, gravity)
        return cls(A.astype(int), K).check(biped)

    def check(self, biped: Biped, samples: int = 20) -> PlanarTree:
        """Compare D_s, Omega and the swing foot with Pinocchio's at random states, and return this tree.

        Raises ModelError where one differs by more than EXACT, relatively.
        """
        random, K = np.random.default_rng(2), self.K
        names = ("D_s", "Omega", "the swing foot")
        for _ in range(samples):
            q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(size=biped.n)
            foot = point(turned(self, q), K.foot_re, K.foot_im)
            ours = (*inertia_and_bias(self, K, q, v), np.array(foot))
            theirs = (biped.inertia(q), biped.bias(q, v), biped.swing_foot(q))
            for name, one, other in zip(names, ours, theirs, strict=True):
                gap = np.max(np.abs(one - other)) / max(1e-3, float(np.max(np.abs(other))))
                if not gap <= EXACT:
                    raise ModelError(
                        f"robot '{biped.description.name}' is no planar tree of rigid links: {name} in "
                        f"absolute angles differs from Pinocchio's by {gap:.1e} relative, expected {EXACT:g}; "
                        "look for an axis that is not y"
                    )
        return self

    @property
    def foot(self) -> ComplexArray:
        """Vectors d of the swing foot (n,) [m], whose place is x + i z = sum_i d_i exp(i a_i)."""
        return self.K.foot_re + 1j * self.K.foot_im

    @property
    def hip(self) -> ComplexArray:
        """Vectors d of the hip (n,) [m], as those of the foot."""
        return self.K.hip_re + 1j * self.K.hip_im

    @property
    def leg(self) -> float:
        """Length of the stretched stance leg [m]: the sum of the lengths |d_i| of the hip's vectors."""
        return float(np.sum(np.abs(self.hip)))


def _parts(z: ComplexArray) -> tuple[Array, Array]:
    """Real and imaginary part of z, contiguous as compiled code expects them."""
    return np.ascontiguousarray(z.real), np.ascontiguousarray(z.imag)


def fitted(A: Array, places: Callable[[Array], Array], exact: float) -> ComplexArray:
    """Fit the vectors d (points, n) [m] of points fixed to links, by least squares over random angles.

    A is the matrix of the absolute angles (n, n); `places` maps q (n,) [rad] to the places (points, 2) [m].
    Parts of d below `exact` times the largest distance of a place from the origin, or times 1 m where it is
    smaller, are round-off and set to 0.
    """
    n = len(A)
    q = np.random.default_rng(1).uniform(-np.pi, np.pi, (3 * n + 3, n))
    turns = np.exp(1j * q @ A.T)
    there = np.array([np.atleast_2d(places(x)) for x in q]) @ np.array([1.0, 1.0j])
    d = np.linalg.lstsq(turns, there, rcond=None)[0]
    least = exact * max(1.0, float(np.max(np.abs(there))))
    re, im = (np.where(np.abs(x) < least, 0.0, x) for x in (d.real, d.imag))
    return np.asarray((re + 1j * im).T)


# -- laws, for numbers and symbols -----------------------------------------------------------------
class Turned(NamedTuple, Generic[Numbers]):
    """Cosines and sines of the absolute angles, each (n,), dimensionless."""

    c: Numbers
    """cos a."""
    s: Numbers
    """sin a."""


def turned(robot: Joined, q: Numbers) -> Turned[Numbers]:
    """cos and sin of a = A q at the angles q (n,) [rad]."""
    a = robot.A @ q
    return Turned(np.cos(a), np.sin(a))


def inertia_and_bias(
    robot: Joined, K: PlantArrays, q: Numbers, v: Numbers
) -> tuple[Numbers, Numbers]:
    """D_s (n, n) [kg m^2] and Omega (n,) [N m] at q (n,) [rad], q' = v (n,) [rad/s], by the formulas above."""
    t, A = turned(robot, q), robot.A
    C, S = _differences(t)
    D = K.W_re * C - K.W_im * S
    np.fill_diagonal(D, K.inertia)
    D_s = A.T @ D @ A
    for i in range(len(A)):
        D_s[i, i] = D_s[i, i] + K.rotor[i]
        D_s[i, :i] = D_s[:i, i]
    return D_s, A.T @ (_weight(K, t) - (K.W_re * S + K.W_im * C) @ (A @ v) ** 2)


def gravity_and_turning(
    robot: Joined, K: PlantArrays, t: Turned[Numbers], v: Numbers
) -> tuple[Numbers, Numbers]:
    """Gravity G_s = dV/dq (n,) [N m], and dT/dq = C^T q' (n,) [N m], of potential and kinetic energy V, T.

    t: cosines and sines of the absolute angles. v = q' (n,) [rad/s]. C is the Coriolis matrix.
    """
    A, rate = robot.A, robot.A @ v
    C, S = _differences(t)
    turning = rate * ((K.W_re * S + K.W_im * C) @ rate)
    return A.T @ _weight(K, t), A.T @ turning


def _differences(t: Turned[Numbers]) -> tuple[Numbers, Numbers]:
    """cos and sin of a_j - a_i (n, n), with 0 on both diagonals.

    On the diagonal the cosine is 1: this adds a constant to D_a, which `PlantArrays.inertia` has, and nothing
    to Omega_a, since Im W_ii = 0.
    """
    off = 1.0 - np.eye(len(t.c))
    C = (np.outer(t.c, t.c) + np.outer(t.s, t.s)) * off
    return C, (np.outer(t.c, t.s) - np.outer(t.s, t.c)) * off


def _weight(K: PlantArrays, t: Turned[Numbers]) -> Numbers:
    """dV/da = g Re(w o exp(i a)) (n,) [N m], gravity in absolute angles."""
    return K.gravity * (K.w_re * t.c - K.w_im * t.s)


def point(t: Turned[Numbers], re: Array, im: Array) -> tuple[Numbers, Numbers]:
    """Position (x, z) [m] of a point from the stance foot, from its vectors d = re + i im (n,) [m]."""
    return re @ t.c - im @ t.s, im @ t.c + re @ t.s


def jacobian(robot: Joined, t: Turned[Numbers], re: Array, im: Array) -> Numbers:
    """Jacobian d(x, z)/dq (2, n) [m] of a point with vectors d = re + i im (n,) [m]."""
    return np.array([robot.A.T @ (-(re * t.s) - im * t.c), robot.A.T @ (re * t.c - im * t.s)])


def ground_reaction(robot: Joined, K: PlantArrays, q: Numbers, v: Numbers, a: Numbers) -> Numbers:
    """Force (F_T, F_N) (2,) [N] of the ground on the stance foot, along x and z: m (p_com'' - gravity).

    q (n,) [rad], v = q' (n,) [rad/s]; a = q'' (n,) [rad/s^2], not the absolute angles.
    """
    t, rate2 = turned(robot, q), (robot.A @ v) ** 2
    F_x, F_z = jacobian(robot, t, K.w_re, K.w_im) @ a
    x, z = point(Turned(t.c * rate2, t.s * rate2), K.w_re, K.w_im)
    return np.array([F_x - x, F_z - z + K.mass * K.gravity])


POINT_EXACT = 1e-10
"""Parts of a `LinkPoint` below this, relative to its largest distance from the stance foot, are round-off."""


class LinkPoint(NamedTuple):
    """A point fixed to a link, in closed form for n coordinates; all arrays float64, for compiled code."""

    A: Array
    """Matrix of the absolute angles a = A q (n, n)."""
    re: Array
    """Re d (n,) [m]."""
    im: Array
    """Im d (n,) [m]."""
    turn: Array
    """b (n,), dimensionless: the derivative of the link's absolute angle with respect to q."""


def wrench_torque(k: LinkPoint, q: Array, f: Array) -> Array:
    """Generalised force zeta (n,) [N m] of f = (F_x, F_z, M) (3,) [N, N, N m] at the point, at q (n,) [rad].

    M is counter-clockwise with x to the right and z up.
    """
    zeta: Array = f[:2] @ jacobian(k, turned(k, q), k.re, k.im) + k.turn * f[2]
    return zeta


def link_point(biped: Biped, link: str, at: tuple[float, float] | None = None) -> LinkPoint:
    """The point `at` (x, z) [m] in the frame of `link`, in closed form; its origin if None.

    Raises ModelError for a link that the robot does not have, or that does not move with its coordinates.
    """
    f, x_z = biped.floating, at or (0.0, 0.0)
    tree, trunk = biped.tree, biped.description.trunk
    known = [name for name in tree.links if tree.path_below(name, trunk) is not None]
    if link not in known:
        raise ModelError(
            f"robot '{biped.description.name}' has no link '{link}' that moves with its coordinates; it has "
            f"{known}"
        )
    frame = frame_index(f.model, link)

    def place(q: Array) -> Array:
        pin.framesForwardKinematics(f.model, f.data, f.configuration(q))
        return np.asarray(f.data.oMf[frame].act(np.array([x_z[0], 0.0, x_z[1]])))[[0, 2]]

    zero = f.configuration(np.zeros(biped.n))
    J = pin.computeFrameJacobian(f.model, f.data, zero, frame, pin.LOCAL_WORLD_ALIGNED)
    return _fitted(biped, place, np.ascontiguousarray(-J[4, f.angles]))


def hip_point(biped: Biped) -> LinkPoint:
    """The hip as a point in closed form, without rotation: forces act there, moments do not."""
    return _fitted(biped, biped.hip, np.zeros(biped.n))


def _fitted(biped: Biped, place: Callable[[Array], Array], turn: Array) -> LinkPoint:
    """Fit a `LinkPoint` to its place (x, z) [m] as a function of q (n,) [rad]; turn: b (n,) of its link."""
    _, _, A = biped.pinned.bodies()
    (d,) = fitted(A, place, POINT_EXACT)
    return LinkPoint(np.ascontiguousarray(A), *_parts(d), turn)
