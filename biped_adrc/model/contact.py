"""Double support: the unpinned model (2), the plastic impact (3)-(9).

q_e = (q_s, p_e) with p_e the end of the support leg. The floating URDF is rooted at the torso;
p_e' and q_s' give its velocity through the stance-foot Jacobian, `v_float = J_e(q) q_e'`, hence

    D_e = J_e' M J_e,   E_2 = J_2 J_e                                (2), (4)
    D_e (q_e+' - q_e-') = E_2' F_2,   E_2 q_e+' = 0                  (7)

F_2 = (F_T, F_N) is the impulse of the ground on the swing foot [N s]. (5) in the paper has the
sign of E_2' F_2 against (3), (4) and (7); (7) is right.

`LinkMotion` has the angular momentum of links from their own velocities, for laws that these matrices obey:

    L = sum_k m_k (c_k - p) x c_k' + J_k omega_k        of some links, about a point p

c_k, omega_k are taken from Pinocchio's link placements and velocities, so that neither D_e nor (7) enters.
Positive counter-clockwise with x to the right and z up.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import pinocchio as pin

from biped_adrc.errors import SingularError
from biped_adrc.model.pinned import XZ, build, frame_index, velocity_index
from biped_adrc.robots.robot_toml import RobotDescription
from biped_adrc.robots.urdf import Tree
from biped_adrc.shown import one_line
from biped_adrc.types import Array


class Impact(NamedTuple):
    """The plastic impact at x- = (q, v): Delta (8), Sigma (9), and the state after relabelling."""

    q: Array
    """q_s after relabelling (n,) [rad]."""
    v: Array
    """q_s' after impact and relabelling (n,) [rad/s]."""
    impulse: Array
    """F_2 = (tangential, normal) [N s]."""
    v_e: Array
    """q_e+' before relabelling (n + 2,): Delta of (8)."""

    @property
    def old_foot_velocity(self) -> Array:
        """(x, z) velocity of the foot that was the support [m/s]; z > 0 means that it lifts off."""
        return self.v_e[-2:]

    @property
    def impulse_ratio(self) -> float:
        """|F_T| / F_N: the dry friction the impact asks for, dimensionless."""
        return float(abs(self.impulse[0]) / self.impulse[1])

    def __repr__(self) -> str:
        return one_line(self)


class FloatingDynamics:
    """The floating model in q_e = (q_s, p_e), evaluated with p_e at the origin."""

    def __init__(self, tree: Tree, d: RobotDescription, armature: float):
        self.model = build(tree, d, armature)
        self.data = self.model.createData()
        self.n = len(d.joints)
        self.angles = np.array([velocity_index(self.model, name) for name in d.joints])
        self.base = np.array([velocity_index(self.model, name) for name in d.base])
        self.stance, self.swing = (frame_index(self.model, foot) for foot in d.feet)

    def configuration(self, q: Array, p_e: Array | None = None) -> Array:
        """Pinocchio configuration for q_s (n,) and the stance foot at p_e (2,) [m]."""
        x = np.zeros(self.model.nq)
        x[self.angles] = q
        pin.forwardKinematics(self.model, self.data, x)
        foot = pin.updateFramePlacement(self.model, self.data, self.stance).translation[XZ]
        x[self.base] = (0.0 if p_e is None else p_e) - foot
        return x

    def velocity_map(self, q: Array) -> Array:
        """J_e(q) (n + 2, n + 2): v_float = J_e q_e'."""
        return self._velocity_map(self.configuration(q))

    def _velocity_map(self, x: Array) -> Array:
        J = self._foot_jacobian(x, self.stance)
        J_e = np.zeros((self.n + 2, self.n + 2))
        J_e[self.angles, np.arange(self.n)] = 1.0
        J_e[self.base, : self.n] = -J[:, self.angles]
        J_e[self.base[0], self.n] = J_e[self.base[1], self.n + 1] = 1.0
        return J_e

    def inertia_on_fixed_base(self, q: Array) -> Array:
        """Inertia matrix of the joints (n, n) with the base held [kg m^2]."""
        M = pin.crba(self.model, self.data, self.configuration(q))
        return M[np.ix_(self.angles, self.angles)]

    def _foot_jacobian(self, x: Array, frame: int) -> Array:
        J: Array = pin.computeFrameJacobian(
            self.model, self.data, x, frame, pin.LOCAL_WORLD_ALIGNED
        )
        return J[XZ]

    def extended_inertia(self, q: Array) -> Array:
        """D_e(q) (n + 2, n + 2) of (2)."""
        J_e = self.velocity_map(q)
        M = pin.crba(self.model, self.data, self.configuration(q))
        return J_e.T @ M @ J_e

    def swing_jacobian(self, q: Array) -> Array:
        """E_2 = dp_2/dq_e (2, n + 2) of (4)."""
        return self._foot_jacobian(self.configuration(q), self.swing) @ self.velocity_map(q)

    def projected(self, q: Array, v: Array) -> tuple[Array, Array]:
        """D_s and Omega from the floating model, constrained by the stance contact (n, n), (n,).

        With Z = J_e[:, :n] the null space of the contact Jacobian, D_s = Z' M Z and
        Omega = Z' (nle + M Z' v), where Z' v is minus the drift of the stance foot on the base rows.
        """
        x = self.configuration(q)
        Z = self.velocity_map(q)[:, : self.n]
        w = Z @ v
        zero = np.zeros(self.model.nv)
        pin.forwardKinematics(self.model, self.data, x, w, zero)
        drift = pin.getFrameClassicalAcceleration(
            self.model, self.data, self.stance, pin.LOCAL_WORLD_ALIGNED
        ).linear[XZ]
        Zdot_v = np.zeros(self.model.nv)
        Zdot_v[self.base] = -drift
        M = np.array(pin.crba(self.model, self.data, x))
        nle = pin.nonLinearEffects(self.model, self.data, x, w)
        return Z.T @ M @ Z, Z.T @ (nle + M @ Zdot_v)

    def impact(self, q: Array, v: Array, R: Array, offset: Array) -> Impact:
        """Solve (7) at (q-, v-) and relabel: q+ = R q- + offset, v+ = R v (n,). Raises SingularError."""
        n, x = self.n, self.configuration(q)
        J_e = self._velocity_map(x)
        D_e = J_e.T @ pin.crba(self.model, self.data, x) @ J_e
        E_2 = self._foot_jacobian(x, self.swing) @ J_e
        K = np.block([[D_e, -E_2.T], [E_2, np.zeros((2, 2))]])
        rhs = np.concatenate((D_e[:, :n] @ v, np.zeros(2)))
        try:
            solution = np.asarray(np.linalg.solve(K, rhs), dtype=np.float64)
        except np.linalg.LinAlgError as error:
            raise SingularError("the impact (7) is singular") from error
        v_e = solution[: n + 2]
        return Impact(R @ q + offset, R @ v_e[:n], solution[n + 2 :], v_e)


@dataclass(frozen=True)
class LinkMotion:
    """Links of the floating model at (q, q_e'), with the stance foot at the origin."""

    floating: FloatingDynamics
    q: Array
    """(n,) [rad]."""
    v_e: Array
    """(q_s', p_e') (n + 2,) [rad/s, m/s]."""
    data: Any = field(init=False, repr=False)

    def __post_init__(self) -> None:
        f = self.floating
        rates, x = f.velocity_map(self.q) @ self.v_e, f.configuration(self.q)
        data = f.model.createData()
        pin.forwardKinematics(f.model, data, x, rates)
        pin.updateFramePlacements(f.model, data)
        object.__setattr__(self, "data", data)

    def momentum(self, joints: Iterable[int] | None = None) -> Any:
        """Spatial momentum of the links of `joints` (by Pinocchio, all without), in the axes of the world."""
        model, data, total = self.floating.model, self.data, pin.Force.Zero()
        for j in range(1, model.njoints) if joints is None else joints:
            total += data.oMi[j].act(model.inertias[j] * data.v[j])
        return total

    def about(self, point: Array, joints: Iterable[int] | None = None) -> float:
        """L of the links of `joints` (all without) about a point (x, z) [kg m^2/s]."""
        h = self.momentum(joints)
        return -float((h.angular - np.cross([point[0], 0.0, point[1]], h.linear))[1])

    @property
    def new_foot(self) -> Array:
        """(x, z) of the swing foot [m]."""
        place: Array = self.data.oMf[self.floating.swing].translation
        return place[[0, 2]]

    def old_leg(self) -> list[int]:
        """Joints of the leg that was the support, from its knee up to its hip."""
        model, found = self.floating.model, []
        j = int(model.frames[self.floating.stance].parentJoint)
        top = int(model.frames[self.floating.swing].parentJoint)
        shared = set(model.supports[top])
        while j not in shared:
            found.append(j)
            j = int(model.parents[j])
        return found

    def outboard(self, joint: int) -> float:
        """L about a joint of all that it carries, with the momentum of its rotor [kg m^2/s].

        An ideal joint passes no impulse of torque on, so an impact elsewhere leaves it as it is.
        """
        model, data = self.floating.model, self.data
        below = data.oMi[joint].rotation @ data.v[joint].angular
        parent = int(model.parents[joint])
        above = data.oMi[parent].rotation @ data.v[parent].angular
        rotor = -float((below - above)[1]) * float(model.armature[model.joints[joint].idx_v])
        centre = data.oMi[joint].translation[[0, 2]]
        return self.about(centre, model.subtrees[joint]) + rotor

    @property
    def com_velocity(self) -> Array:
        """(x, z) [m/s]."""
        velocity: Array = self.momentum().linear / pin.computeTotalMass(self.floating.model)
        return velocity[[0, 2]]
