"""Angular momentum of links from their own velocities, for laws that the matrices of (2) have to obey.

    L = sum_k m_k (c_k - p) x c_k' + J_k omega_k        of some links, about a point p

c_k, omega_k are taken from Pinocchio's link placements and velocities, so that neither D_e nor (7) enters.
Positive counter-clockwise with x to the right and z up.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pinocchio as pin

from biped_adrc.model.contact import FloatingDynamics
from biped_adrc.types import Array


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
