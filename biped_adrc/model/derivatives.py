"""Derivatives of the dynamics and of the impact with respect to the state, without difference quotients.

The variational equation (`analysis.variational`) needs the derivatives by x = (q, q') of the motion x' = f(x)
and of the impact x+ = Delta(x-) to more digits than differences of the dynamics would give.

Single support, from Pinocchio's derivatives of the recursive Newton-Euler algorithm (RNEA) on the pinned model
in `q_tree = T q_s` with a constant T (Carpentier, Mansard, RSS 2018). With v = q' and the generalised force
tau(q, v, a) = D_s a + Omega at a = q'',

    dq''/dq = -D_s^-1 dtau/dq,   dq''/dv = D_s^-1 (dfriction/dv - dtau/dv),   dq''/dforce = D_s^-1

The transpose of T maps the derivatives back to q_s. D_s (n, n) [kg m^2] is the inertia matrix and Omega (n,)
[N m] the sum of Coriolis and gravity terms. force (n,) [N m] is B_s u + delta + zeta: motor torques on all n
coordinates, model error and external generalised force; friction (n,) [N m] is that of the joints.

Impact: (7) is r(q, v-, z) = 0 with z = (q_e+', F_2) (n + 4,), where q_e = (q_s, p_e) contains the position p_e
(2,) of the stance foot, F_2 (2,) is the impulse on the swing foot, and - and + stand for before and after.
CasADi differentiates r, written with the formulas of `planar_robot`, and the implicit function theorem gives

    dz = -(dr/dz)^-1 (dr/dq dq + dr/dv- dv-)
"""

from typing import NamedTuple

import casadi as ca
import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from biped_adrc.core.linear import solve
from biped_adrc.core.types import Array
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import jacobian, point, turned
from biped_adrc.model.planar_robot import PlanarRobot, robot_of


class AccelerationDerivatives(NamedTuple):
    """Partial derivatives of q'' = D_s^-1 (force + friction - Omega), each (n, n)."""

    dq: Array
    """dq''/dq [1/s^2]."""
    dv: Array
    """dq''/dq' [1/s]."""
    dforce: Array
    """dq''/dforce = D_s^-1 [1/(kg m^2)]."""


def acceleration_derivatives(biped: Biped, q: Array, v: Array, a: Array) -> AccelerationDerivatives:
    """Derivatives of `Biped.acceleration` at q (n,) [rad], v (n,) [rad/s], under the generalised force that
    gives q'' = a (n,) [rad/s^2] there.

    The force is B_s u + delta + zeta, a constant here; friction is included where the biped has it.
    """
    # T q: the coordinates of the tree that Pinocchio has
    pinned, T = biped.pinned, biped.pinned.T
    pin.computeRNEADerivatives(pinned.model, pinned.data, T @ q, T @ v, T @ a)
    # reshape: (n, n) for n = 1 too
    parts = pinned.data.dtau_dq, pinned.data.dtau_dv
    dq, dv = (T.T @ np.reshape(part, T.shape) @ T for part in parts)
    inverse = solve(biped.inertia(q), np.eye(biped.n), "the inertia matrix D_s")
    by_v = inverse @ (biped.friction_derivative(v) - dv)
    return AccelerationDerivatives(-inverse @ dq, by_v, inverse)


def impact_derivatives(biped: Biped, q: Array, v: Array) -> Array:
    """Derivative (2 n, 2 n) d(q+, v+) / d(q-, v-) of `Biped.impact`, relabelling included, at q = q-, v = q'-
    (n,) [rad, rad/s].

    Raises SingularError where the matrix of (7) is singular.
    """
    n, impact, robot = biped.n, biped.impact(q, v), robot_of(biped)
    x, before, z = (ca.MX.sym(*name) for name in (("q", n), ("v", n), ("z", n + 4)))
    D, J_m, J_2, _ = pose_function(robot)(x)  # the place of the swing foot is not in (7)
    r = ca.vertcat(*impact_rows(D, J_m, J_2, robot.K.mass, before, z[: n + 2], z[n + 2 :]))
    rows = ca.Function("impact", [x, before, z], [ca.jacobian(r, y) for y in (x, before, z)])
    by_q, by_v, by_z = map(np.array, rows(q, v, np.concatenate((impact.v_e, impact.impulse))))
    dz = solve(by_z, -np.hstack((by_q, by_v)), "the matrix of the impact (7)")
    # q+ = R q- + r and v+ = R (q_s+'), whose derivatives are the first n rows of dz
    return np.vstack((np.hstack((biped.R, np.zeros((n, n)))), biped.R @ dz[:n]))


# -- the planar model as CasADi expressions --------------------------------------------------------
def entries(x: ca.SX) -> NDArray[np.object_]:
    """Convert a CasADi column of m symbols to a NumPy array (m,) of CasADi scalars; the inverse of
    `together`.
    """
    return np.fromiter(ca.vertsplit(x), dtype=object)


def together(values: NDArray[np.object_]) -> ca.SX:
    """Convert a NumPy array (m,) or (m, k) of CasADi scalars to one CasADi column or matrix."""
    rows = np.reshape(values, (len(values), -1))
    return ca.vertcat(*(ca.horzcat(*map(ca.SX, row)) for row in rows))


def pose_function(robot: PlanarRobot) -> ca.Function:
    """Make the CasADi function q (n,) [rad] -> (D_s, J_m, J_2, p_2) for the impact equations (7).

    D_s (n, n) [kg m^2] is the inertia matrix, J_m = d(m p_com)/dq (2, n) [kg m], p_2 (2,) [m] the position of
    the swing foot from the stance foot, J_2 = dp_2/dq (2, n) [m].
    """
    n, K = robot.n, robot.K
    q = ca.SX.sym("q", n)
    x = entries(q)
    rest: NDArray[np.object_] = np.zeros(n, dtype=object)
    t, A = turned(robot.A, x), robot.A
    D, _ = robot.inertia_and_bias(x, rest)  # D_s does not depend on the rates
    # w: the vectors d of all COMs, weighted by the masses and summed; foot: those of the swing foot
    J_m, J_2 = jacobian(A, t, K.w_re, K.w_im), jacobian(A, t, K.foot_re, K.foot_im)
    foot = ca.vertcat(*point(t, K.foot_re, K.foot_im))
    return ca.Function("pose", [q], [*map(together, (D, J_m, J_2)), foot])


def impact_rows(
    D: ca.MX, J_m: ca.MX, J_2: ca.MX, mass: float, before: ca.MX, after: ca.MX, impulse: ca.MX
) -> tuple[ca.MX, ca.MX, ca.MX]:
    """Residuals of (7): of momenta (n,) [N m s] and (2,) [N s], and of the foot's velocity (2,)
    [m/s]; zero at the solution.

    D_e (q_e'+ - q_e'-) = E_2' F balances the momenta, E_2 q_e'+ = 0 lets the swing foot neither slip nor
    rebound. D, J_m, J_2: of `pose_function`. mass [kg]: of the robot. before: q'- (n,) [rad/s], with the stance
    foot at rest; after: q_e'+ = (q'+, p_e'+) (n + 2,) [rad/s, m/s]; impulse: F (2,) [N s] on the swing foot.
    """
    n = before.numel()
    # jumps of the joint rates and of the old stance foot's velocity; D_e = (D, J_m'; J_m, mass), E_2 = (J_2, 1)
    turn, move = after[:n] - before, after[n:]
    return (
        D @ turn + J_m.T @ move - J_2.T @ impulse,
        J_m @ turn + mass * move - impulse,
        J_2 @ after[:n] + move,
    )
