"""Double support: the unpinned model (2) and the plastic impact (3)-(9) of the paper.

The coordinates are q_e = (q_s, p_e): q_s (n,) [rad] of single support and the end p_e (2,) [m] of the support
leg. The floating URDF is rooted at the torso, whose two slides (the base) replace p_e, so its own velocity
v_float (n + 2,) differs from q_e'; the Jacobian of the stance foot gives `v_float = J_e(q) q_e'`, hence

    D_e = J_e' M J_e,   E_2 = J_2 J_e                                (2), (4)
    D_e (q_e+' - q_e-') = E_2' F_2,   E_2 q_e+' = 0                  (7)

A prime is a transpose on a matrix, a time derivative on a vector; - and + stand for just before and just after
the impact.

    D_e, E_2        inertia matrix in q_e; Jacobian dp_2/dq_e of the swing foot p_2 (2,) [m]
    M, J_2          inertia matrix of the floating model; Jacobian of the swing foot, both in v_float
    D_s, Omega      inertia matrix [kg m^2], Coriolis and gravity terms [N m] of single support, in q_s
    F_2             (F_T, F_N), tangential and normal impulse of the ground on the swing foot [N s]

Line (7) says that only this impulse acts, and that the new stance foot neither slips nor rebounds. (5) in the
paper has the sign of E_2' F_2 against (3), (4) and (7); (7) is right.

`LinkMotion` computes the angular momentum of single links from their own velocities, to test laws
that these matrices must obey:

    L = sum_k m_k (c_k - p) x c_k' + J_k omega_k        of some links, about a point p

m_k is the mass of link k, J_k its inertia about its COM c_k, and omega_k its spin [rad/s]. c_k and omega_k come
from Pinocchio's link placements and velocities, so neither D_e nor (7) enters. L is positive counter-clockwise
with x to the right and z up. `Biped` makes the FloatingDynamics.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from biped_adrc.core.errors import SingularError
from biped_adrc.core.shown import shown
from biped_adrc.core.types import Array
from biped_adrc.model.pinned import WORLD_AXES, XZ, frame_index, pinned_model, velocity_index
from biped_adrc.model.robots.robot_toml import RobotDescription, Rotors
from biped_adrc.model.robots.urdf import Tree


@shown
class Impact(NamedTuple):
    """Result of the plastic impact of a state (q-, v-): the state (q, v) after it with the legs relabelled, the
    impulse (9), and the velocities (8) before relabelling.
    """

    q: Array
    """q_s after relabelling (n,) [rad]."""
    v: Array
    """q_s' after impact and relabelling (n,) [rad/s]."""
    impulse: Array
    """Impulse F_2 (2,) = (tangential, normal) of the ground on the new stance foot [N s]."""
    v_e: Array
    """q_e+' of (8) (n + 2,) [rad/s, m/s] just after impact, in the coordinates from before the relabelling; the
    last two are the velocity of the old support foot."""

    @property
    def old_foot_velocity(self) -> Array:
        """Velocity (x, z) (2,) [m/s] of the old support foot just after impact; z > 0 where it lifts off."""
        return self.v_e[-2:]

    @property
    def impulse_ratio(self) -> float:
        """|F_T| / F_N, dimensionless: the coefficient of dry friction that the impact requires."""
        return float(abs(self.impulse[0]) / self.impulse[1])


class FloatingDynamics:
    """The floating model in q_e = (q_s, p_e), evaluated with p_e at the origin.

    Nothing depends on where the foot is, so the results hold for any p_e. q (n,) [rad] and v (n,) [rad/s] are
    the paper's coordinates q_s, q_s'; m = n + 2 is the number of Pinocchio's velocities. `model` and `data` are
    Pinocchio's, `angles` (n,) the places of q_s and `base` (2,) those of the slides along x, z in its vectors,
    `stance` and `swing` the frame indices of the feet.
    """

    def __init__(self, tree: Tree, d: RobotDescription, armature: Rotors):
        """Build the model of the tree on its planar base, with the rotor inertia `armature` [kg m^2] at every
        motor of the record `d`, or one number for each.
        """
        self.model = pinned_model(tree, d, armature)
        self.data = self.model.createData()
        self.n = len(d.joints)
        self.angles = np.array([velocity_index(self.model, name) for name in d.joints])
        self.base = np.array([velocity_index(self.model, name) for name in d.base])
        self.stance, self.swing = (frame_index(self.model, foot) for foot in d.feet)

    def configuration(self, q: Array) -> Array:
        """Pinocchio's configuration (m,) [rad, m] at q_s (n,) [rad] with the stance foot at the origin."""
        x = np.zeros(self.model.nq)
        x[self.angles] = q
        pin.forwardKinematics(self.model, self.data, x)
        foot = pin.updateFramePlacement(self.model, self.data, self.stance).translation[XZ]
        x[self.base] = -foot  # `foot` was its place with the base at the origin
        return x

    def velocity_map(self, q: Array) -> Array:
        """Matrix J_e(q) (m, m) of v_float = J_e q_e', with entries [1] and [m].

        The slides of the base move with p_e' - J q_s', J (2, n) the Jacobian of the foot for a base at rest, so
        that the stance foot moves with p_e'.
        """
        J = self._foot_jacobian(self.configuration(q), self.stance)
        J_e = np.zeros((self.n + 2, self.n + 2))
        J_e[self.angles, np.arange(self.n)] = 1.0
        J_e[self.base, : self.n] = -J[:, self.angles]
        J_e[self.base[0], self.n] = J_e[self.base[1], self.n + 1] = 1.0
        return J_e

    def _foot_jacobian(self, x: Array, frame: int) -> Array:
        """Jacobian (2, m) [m, 1] of the position (x, z) of a frame by Pinocchio's configuration x (m,)."""
        J: Array = pin.computeFrameJacobian(self.model, self.data, x, frame, WORLD_AXES)
        return J[XZ]

    def extended(self, q: Array) -> tuple[Array, Array]:
        """D_e (n + 2, n + 2) [kg m^2, kg m, kg] of (2) and E_2 = dp_2/dq_e (2, n + 2) [m, 1] of (4)."""
        x, J_e = self.configuration(q), self.velocity_map(q)
        D_e = J_e.T @ pin.crba(self.model, self.data, x) @ J_e
        return D_e, self._foot_jacobian(x, self.swing) @ J_e

    def projected(self, q: Array, v: Array) -> tuple[Array, Array]:
        """D_s (n, n) [kg m^2] and Omega (n,) [N m] from the floating model, constrained by the stance contact.

        The pinned model is not used, so the result serves as a check of it. With Z = J_e[:, :n] a basis of the
        null space of the contact Jacobian, D_s = Z^T M Z and Omega = Z^T (nle + M dZ/dt v); nle are Pinocchio's
        Coriolis and gravity terms. dZ/dt v is zero but in the rows of the base, where it is minus the
        acceleration that the stance foot has at the velocities Z v with all accelerations zero.
        """
        x = self.configuration(q)
        Z = self.velocity_map(q)[:, : self.n]
        w = Z @ v
        pin.forwardKinematics(self.model, self.data, x, w, np.zeros(self.model.nv))
        a = pin.getFrameClassicalAcceleration(self.model, self.data, self.stance, WORLD_AXES)
        Zdot_v = np.zeros(self.model.nv)
        Zdot_v[self.base] = -a.linear[XZ]
        M = np.array(pin.crba(self.model, self.data, x))
        nle = pin.nonLinearEffects(self.model, self.data, x, w)
        return Z.T @ M @ Z, Z.T @ (nle + M @ Zdot_v)

    def impact(self, q: Array, v: Array, R: Array, offset: Array) -> Impact:
        """Solve (7) at (q-, v-) (n,) [rad, rad/s] and relabel: q+ = R q- + offset, v+ = R v.

        R (n, n) and offset (n,) [rad] are those of `Biped`. Raises SingularError where (7) is singular.
        """
        n, (D_e, E_2) = self.n, self.extended(q)
        K = np.block([[D_e, -E_2.T], [E_2, np.zeros((2, 2))]])
        # q_e'- = (v-, 0): the stance foot is at rest before the impact
        rhs = np.concatenate((D_e[:, :n] @ v, np.zeros(2)))
        try:
            solution = np.asarray(np.linalg.solve(K, rhs), dtype=np.float64)
        except np.linalg.LinAlgError as error:
            raise SingularError("the impact (7) is singular") from error
        v_e = solution[: n + 2]
        return Impact(R @ q + offset, R @ v_e[:n], solution[n + 2 :], v_e)


class LinkMotion:
    """Placements and velocities of all links of the floating model at (q, q_e'), stance foot at the origin.

    It has its own work data, so it stays valid when the model is used again.
    """

    def __init__(self, floating: FloatingDynamics, q: Array, v_e: Array):
        """Compute them from the configuration q (n,) [rad] and the rates v_e = (q_s', p_e') (n + 2,) [rad/s,
        m/s].
        """
        self.floating, self.data = floating, floating.model.createData()
        rates, x = floating.velocity_map(q) @ v_e, floating.configuration(q)
        pin.forwardKinematics(floating.model, self.data, x, rates)
        pin.updateFramePlacements(floating.model, self.data)

    def momentum(self, joints: Iterable[int] | None = None) -> pin.Force:
        """Linear [N s] and angular [N m s] momentum, about the world's origin and in its axes, of some links:
        each joint of `joints` contributes the body that hangs directly on it.

        joints: Pinocchio's indices of joints; None for all. Index 0 is the world, which does not move.
        """
        model, data, total = self.floating.model, self.data, pin.Force.Zero()
        for j in range(1, model.njoints) if joints is None else joints:
            # the spatial momentum of the body, from its own frame to the world's
            total += data.oMi[j].act(model.inertias[j] * data.v[j])
        return total

    def about(self, point: Array, joints: Iterable[int] | None = None) -> float:
        """Angular momentum [kg m^2/s], counter-clockwise, about a point (x, z) [m] of the bodies that hang
        directly on `joints`.

        joints: Pinocchio's indices of joints; None for all.
        """
        h = self.momentum(joints)
        # minus: with x to the right and z up, the axis y points into the plane
        return -float((h.angular - np.cross([point[0], 0.0, point[1]], h.linear))[1])

    def old_leg(self) -> list[int]:
        """Pinocchio's indices of the joints of the leg that stood before the impact, from its knee up to its
        hip: those above its foot that do not carry the swing foot as well.
        """
        model, feet = self.floating.model, (self.floating.stance, self.floating.swing)
        # all joints between the world and either foot
        old, other = (list(model.supports[model.frames[foot].parentJoint]) for foot in feet)
        return [j for j in reversed(old) if j not in other]

    def outboard(self, joint: int) -> float:
        """Angular momentum [kg m^2/s], counter-clockwise, about a joint of all links that it carries, with that
        of its rotor: armature times the rate of the joint.

        joint: Pinocchio's index. An ideal joint transmits no impulse of torque, so an impact elsewhere leaves
        this number unchanged.
        """
        model, data = self.floating.model, self.data
        # angular velocities [rad/s] of the links on both sides; the rotor turns with their difference
        below = data.oMi[joint].rotation @ data.v[joint].angular
        parent = int(model.parents[joint])
        above = data.oMi[parent].rotation @ data.v[parent].angular
        # minus: the axis y points into the plane, and counter-clockwise is positive
        rotor = -float((below - above)[1]) * float(model.armature[model.joints[joint].idx_v])
        centre = data.oMi[joint].translation[[0, 2]]
        return self.about(centre, model.subtrees[joint]) + rotor
