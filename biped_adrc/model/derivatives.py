"""Derivatives of the dynamics and of the impact with respect to the state, without difference
quotients.

The variational equation (`analysis.variational`) needs df/dx and dDelta/dx to more digits than
differences of the dynamics would give.

Single support, from Pinocchio's derivatives of ABA and RNEA on the pinned model in `q_tree = T q_s`
(Carpentier, Mansard, RSS 2018). T is constant, so derivatives are only multiplied by it; rotor
inertia is constant too and enters through the model's armature.

Impact, in the velocity w of the floating base and the joints, where (7) reads

    M(x) (w+ - w-) = J_2' F_2,   J_2 w+ = 0,   w- = Z(q) v-

With the matrix K = [[M, -J_2'], [J_2, 0]] of (7) a change of the state gives

    K (dw+, dF_2) = ( d(M a)|_(a = w- - w+) + d(J_2' F_2)|_(F_2) + M dw-,   -d(J_2 w+)|_(w+) )

d(M a) is the derivative of RNEA at rest under the acceleration a, minus that of gravity alone.
d(J_2' F_2) and d(J_2 w+) are two contractions of one tensor, the second derivative of the position
p of a foot. It is written down from the columns (v_j, omega_j) of the foot's Jacobian,

    d2p / dx_i dx_j = omega_i x v_j    for i nearer the root than j, or i = j,

since moving joint i turns everything beyond it. M and J_2 do not depend on where the base is, so
the columns of the base's position drop out.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pinocchio as pin

from biped_adrc.linear import solve
from biped_adrc.model.biped import STICTION_SPEED, Biped
from biped_adrc.model.contact import FloatingDynamics
from biped_adrc.model.pinned import XZ
from biped_adrc.types import Array


class AccelerationDerivatives(NamedTuple):
    """Partial derivatives of q'' = D_s^-1 (force + friction - Omega), each (n, n)."""

    dq: Array
    """[1/s^2]."""
    dv: Array
    """[1/s]."""
    dforce: Array
    """D_s^-1 [1/(kg m^2)]."""


class TorqueDerivatives(NamedTuple):
    """Partial derivatives of the inverse dynamics D_s(q) a + Omega(q, q') at fixed a, each (n, n)."""

    dq: Array
    """[N m/rad]."""
    dv: Array
    """[N m s/rad]."""


class ImpactDerivatives(NamedTuple):
    """Partial derivatives of the state (q+, v+) after impact and relabelling; n coordinates."""

    dq: Array
    """dq+/dq- = R (n, n)."""
    dv_dq: Array
    """dv+/dq- (n, n) [1/s]."""
    dv: Array
    """dv+/dv- (n, n)."""

    @property
    def matrix(self) -> Array:
        """D Delta (2 n, 2 n) = d(q+, v+) / d(q-, v-); dq+/dv- is zero, since q does not jump with v."""
        return np.block([[self.dq, np.zeros_like(self.dq)], [self.dv_dq, self.dv]])


def acceleration_derivatives(
    biped: Biped, q: Array, v: Array, force: Array
) -> AccelerationDerivatives:
    """Derivatives of `Biped.acceleration` at q (n,) [rad], v (n,) [rad/s] and the generalised force
    B_s u + delta + zeta (n,) [N m], friction included where the biped has it.
    """
    pinned, T = biped.pinned, biped.pinned.T
    if biped.friction:
        force = force + biped.friction_torque(v)
    inverse, data = np.linalg.inv(T), pinned.data
    pin.computeABADerivatives(pinned.model, data, T @ q, T @ v, inverse.T @ force)
    dq, dv, dtau = (inverse @ np.reshape(d, T.shape) for d in (data.ddq_dq, data.ddq_dv, data.Minv))
    dforce = dtau @ inverse.T
    return AccelerationDerivatives(dq @ T, dv @ T + dforce @ friction_derivative(biped, v), dforce)


def friction_derivative(biped: Biped, v: Array) -> Array:
    """d/dv of `Biped.friction_torque` (n, n) [N m s/rad] at rates v (n,) [rad/s]: diagonal."""
    if not biped.friction:
        return np.zeros((biped.n, biped.n))
    viscous, static = biped.friction_coefficients
    smooth = 1.0 - np.tanh(v / STICTION_SPEED) ** 2
    return np.diag(-viscous - static * smooth / STICTION_SPEED)


def torque_derivatives(biped: Biped, q: Array, v: Array, a: Array) -> TorqueDerivatives:
    """Derivatives of D_s(q) a + Omega(q, q') at fixed a (n,) [rad/s^2], without friction."""
    pinned, T = biped.pinned, biped.pinned.T
    pin.computeRNEADerivatives(pinned.model, pinned.data, T @ q, T @ v, T @ a)
    dq, dv = (np.reshape(part, T.shape) for part in (pinned.data.dtau_dq, pinned.data.dtau_dv))
    return TorqueDerivatives(T.T @ dq @ T, T.T @ dv @ T)


def impact_derivatives(biped: Biped, q: Array, v: Array) -> ImpactDerivatives:
    """Derivatives of `Biped.impact` at (q-, q'-) (n,) [rad, rad/s], by the equations of the module.

    Raises SingularError where the matrix of (7) is singular.
    """
    floating = biped.floating
    impact = biped.impact(q, v)
    x = floating.configuration(q)
    Z, dZ_v = stance_velocity(floating, x, v)
    w_plus = floating.velocity_map(q) @ impact.v_e
    J, H = foot_derivatives(floating, x, floating.swing)
    M = np.array(pin.crba(floating.model, floating.data, x))
    m = len(M)
    K = np.block([[M, -J.T], [J, np.zeros((2, 2))]])
    a = Z @ v - w_plus
    by_q = momentum_derivative(floating, x, a) + np.einsum("a,aij->ij", impact.impulse, H)
    by_q = by_q[:, floating.angles] + M @ dZ_v
    rows = -(H @ w_plus)[:, floating.angles]
    rhs = np.block([[by_q, M @ Z], [rows, np.zeros((2, biped.n))]])
    angles = biped.R @ solve(K, rhs, "the matrix of the impact (7)")[:m][floating.angles]
    return ImpactDerivatives(biped.R, angles[:, : biped.n], angles[:, biped.n :])


def momentum_derivative(floating: FloatingDynamics, x: Array, a: Array) -> Array:
    """d(M(x) a)/dx at fixed a (m,), as (m, m) [N m/rad].

    RNEA at rest gives M a + G, so its derivatives with and without a differ by what is wanted.
    """
    model, data, rest, m = floating.model, floating.data, np.zeros(len(x)), len(x)
    pin.computeRNEADerivatives(model, data, x, rest, a)
    with_a = np.array(data.dtau_dq).reshape(m, m)
    pin.computeRNEADerivatives(model, data, x, rest, rest)
    return with_a - np.reshape(data.dtau_dq, (m, m))


def stance_velocity(floating: FloatingDynamics, x: Array, v: Array) -> tuple[Array, Array]:
    """Z (m, n) of w- = Z q'-, the stance foot being at rest, and d(Z q'-)/dq (m, n), at x (m,) [rad, m]."""
    J, H = foot_derivatives(floating, x, floating.stance)
    angles, base = floating.angles, floating.base
    Z, dZ_v = np.zeros((len(x), floating.n)), np.zeros((len(x), floating.n))
    Z[angles, np.arange(floating.n)] = 1.0
    Z[base] = -J[:, angles]
    dZ_v[base] = -(H[:, angles][:, :, angles] @ v)
    return Z, dZ_v


def foot_derivatives(floating: FloatingDynamics, x: Array, foot: int) -> tuple[Array, Array]:
    """dp/dx (2, m) and d2p/dx2 (2, m, m) of a foot's position p = (x, z) [m]; `foot` is its frame's index."""
    columns = pin.computeFrameJacobian(
        floating.model, floating.data, x, foot, pin.LOCAL_WORLD_ALIGNED
    )
    linear, angular = columns[:3].T, columns[3:].T
    i, j = np.indices((len(x), len(x)))
    H = np.cross(angular[np.minimum(i, j)], linear[np.maximum(i, j)])
    return columns[XZ], np.moveaxis(H, -1, 0)[XZ]
