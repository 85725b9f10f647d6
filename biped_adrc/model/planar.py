"""The planar tree in absolute angles: closed forms for any planar robot, read off its Pinocchio model.

With a = A q the absolute angles of the links, every point c fixed to the robot is a sum of turned vectors,
written as complex numbers x + i z from the stance foot:

    c = sum_i d_i exp(i a_i)

so that, with d_k the COM of link k, m_k its mass, J_k its inertia about the COM, W = sum_k m_k d_k* d_k',
and w = sum_k m_k d_k,

    D = Re W o cos(a_j - a_i) - Im W o sin(a_j - a_i) + diag J       row i, column j
    C a' = -(Re W o sin(a_j - a_i) + Im W o cos(a_j - a_i)) a'^2
    G = g Re(w exp(i a))

and D_s = A' D A + rotors, Omega = A' (C a' + G). The vectors d are fitted to Pinocchio's own positions, where
the fit is exact, and the terms are compared to Pinocchio's before anything uses them. The
formulas are written once, for NumPy and for CasADi's symbols alike.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from biped_adrc.errors import ModelError
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array, ComplexArray

EXACT = 1e-11
"""Largest relative difference to Pinocchio's D_s, Omega, swing foot and hip."""


@dataclass(frozen=True)
class PlanarTree:
    """n links; the arrays are all a generated model needs."""

    A: Array
    """(n, n), a = A q."""
    mass: Array
    """(n,) [kg]."""
    inertia: Array
    """(n,) about the COM [kg m^2]."""
    rotor: Array
    """(n,) reflected inertia of the coordinates [kg m^2]."""
    com: ComplexArray
    """(n, n) rows d_k [m]."""
    foot: ComplexArray
    """(n,) of the swing foot [m]."""
    hip: ComplexArray
    """(n,) of the hip [m]."""
    gravity: float
    """[m/s^2]."""

    @classmethod
    def of(cls, biped: Biped) -> PlanarTree:
        """Read off the model of a robot. Raises ModelError when it is not a planar tree of rigid links."""
        pinned, n = biped.pinned, biped.n
        mass, inertia, A = pinned.bodies()
        q = np.random.default_rng(1).uniform(-np.pi, np.pi, (3 * n + 3, n))
        turns = np.exp(1j * q @ A.T)
        where = np.array([pinned.points(x) for x in q])
        fitted = np.linalg.lstsq(turns, where[..., 0] + 1j * where[..., 1], rcond=None)[0]
        rotor = np.zeros(n)
        rotor[: biped.p] = biped.armature
        d = np.asarray((_clean(fitted.real) + 1j * _clean(fitted.imag)).T, dtype=np.complex128)
        gravity = biped.description.gravity
        tree = cls(A, mass, inertia, rotor, d[:n], d[n], d[n + 1], gravity)
        return tree.check(biped)

    def check(self, biped: Biped, samples: int = 20) -> PlanarTree:
        """The tree itself, when D_s, Omega and the swing foot are Pinocchio's. Raises ModelError."""
        random = np.random.default_rng(2)
        for _ in range(samples):
            q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(size=biped.n)
            ours = [self.D(np, q), self.Omega(np, q, v), np.array(self.point(np, self.foot, q))]
            theirs = [biped.inertia(q), biped.bias(q, v), biped.swing_foot(q)]
            for name, one, other in zip(
                ("D_s", "Omega", "the swing foot"), ours, theirs, strict=True
            ):
                gap = np.max(np.abs(one - other)) / max(1e-3, float(np.max(np.abs(other))))
                if not gap <= EXACT:
                    raise ModelError(
                        f"robot '{biped.description.name}' is no planar tree of rigid links: {name} in "
                        f"absolute angles differs from Pinocchio's by {gap:.1e} relative, expected {EXACT:g}; "
                        "look for an axis that is not y"
                    )
        return self

    @property
    def W(self) -> ComplexArray:
        """(n, n) [kg m^2]."""
        w: ComplexArray = self.com.conj().T @ (self.mass[:, np.newaxis] * self.com)
        return w

    @property
    def w(self) -> ComplexArray:
        """(n,) [kg m], m times the COM of all."""
        return np.asarray(self.mass @ self.com)

    @property
    def leg(self) -> float:
        """Length of the stretched stance leg [m]."""
        return float(np.sum(np.abs(self.hip)))

    @property
    def total_mass(self) -> float:
        """[kg]."""
        return float(np.sum(self.mass))

    # -- laws, for xp = numpy or casadi ------------------------------------------------------------
    def D(self, xp: Any, q: Any) -> Any:
        """D_s(q) (n, n)."""
        a, one, W = self.A @ q, np.ones((1, len(self.mass))), self.W
        turn = (xp.reshape(a, (-1, 1)) @ one).T - xp.reshape(a, (-1, 1)) @ one
        D = W.real * xp.cos(turn) - W.imag * xp.sin(turn) + np.diag(self.inertia)
        return self.A.T @ D @ self.A + np.diag(self.rotor)

    def Omega(self, xp: Any, q: Any, v: Any) -> Any:
        """Omega(q, q') (n,)."""
        a, da, one, W = self.A @ q, self.A @ v, np.ones((1, len(self.mass))), self.W
        turn = (xp.reshape(a, (-1, 1)) @ one).T - xp.reshape(a, (-1, 1)) @ one
        C = -(W.real * xp.sin(turn) + W.imag * xp.cos(turn))
        return self.A.T @ (C @ da**2) + self.G(xp, q)

    def G(self, xp: Any, q: Any) -> Any:
        """G_s(q) (n,)."""
        a, w = self.A @ q, self.w
        return self.A.T @ (self.gravity * (w.real * xp.cos(a) - w.imag * xp.sin(a)))

    def point(self, xp: Any, d: ComplexArray, q: Any) -> tuple[Any, Any]:
        """(x, z) of a point d from the stance foot [m]."""
        a = self.A @ q
        cos, sin = xp.cos(a), xp.sin(a)
        return xp.dot(d.real, cos) - xp.dot(d.imag, sin), xp.dot(d.imag, cos) + xp.dot(d.real, sin)

    def jacobian(self, xp: Any, d: ComplexArray, q: Any) -> tuple[Any, Any]:
        """Rows d(x, z)/dq, each (n,) [m]."""
        a = self.A @ q
        cos, sin = xp.cos(a), xp.sin(a)
        return (
            self.A.T @ (-d.real * sin - d.imag * cos),
            self.A.T @ (d.real * cos - d.imag * sin),
        )

    def acceleration(self, xp: Any, d: ComplexArray, q: Any, v: Any, acc: Any) -> tuple[Any, Any]:
        """(x'', z'') of a point d [m/s^2]."""
        a, rate = self.A @ q, self.A @ v
        cos, sin, r2 = xp.cos(a), xp.sin(a), rate**2
        j_x, j_z = self.jacobian(xp, d, q)
        centre_x = xp.dot(d.real, cos * r2) - xp.dot(d.imag, sin * r2)
        centre_z = xp.dot(d.imag, cos * r2) + xp.dot(d.real, sin * r2)
        return xp.dot(j_x, acc) - centre_x, xp.dot(j_z, acc) - centre_z


def _clean(x: Any) -> Any:
    """Round-off of the fit taken off."""
    return np.where(np.abs(x) < EXACT, 0.0, x)
