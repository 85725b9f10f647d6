"""MuJoCo on the pinned chain, and on the robot with feet on the ground.

The steps run in MuJoCo's own loop (`mj_step` with nstep), constraints and contacts are switched off for
the chain. On the ground the contact is MuJoCo's soft one, so that motion is another system's.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import mujoco
import numpy as np
from chain import Chain, Coordinates, Simulate, rotors, welded

from biped_adrc.model.biped import Biped
from biped_adrc.robots.urdf import to_xml
from biped_adrc.types import Array

H = 1e-3  # [s]
FOOT = 0.02  # radius of a foot on the ground [m]
METHODS = {
    "Euler 1 ms": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast 1 ms": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "RK4 1 ms": mujoco.mjtIntegrator.mjINT_RK4,
}


class MuJoCoChain(Chain):
    """MjModel of the pinned tree's URDF with rotors as armature."""

    def __init__(self, biped: Biped) -> None:
        super().__init__(biped)
        self.model = _model(biped, mujoco.MjSpec.from_string(to_xml(welded(biped.pinned_tree))))
        self.model.opt.disableflags |= (
            mujoco.mjtDisableBit.mjDSBL_CONSTRAINT | mujoco.mjtDisableBit.mjDSBL_CONTACT
        )
        self.data = mujoco.MjData(self.model)
        joints = [self.model.joint(j).name for j in range(self.model.njnt)]
        self.coordinates = Coordinates(biped, joints)

    def place(self, q: Array, v: Array) -> None:
        """The data at rest but for (q, v)."""
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:], self.data.qvel[:] = self.coordinates.T @ q, self.coordinates.T @ v

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        self.place(q, v)
        self.data.qfrc_applied[:] = self.coordinates.force(force)
        mujoco.mj_forward(self.model, self.data)
        return self.coordinates.inverse @ self.data.qacc

    def methods(self) -> Mapping[str, Simulate]:
        return {name: self._simulate(integrator) for name, integrator in METHODS.items()}

    def _simulate(self, integrator: int) -> Simulate:
        def simulate(q: Array, v: Array, duration: float) -> Array:
            self.model.opt.integrator = integrator
            self.place(q, v)
            mujoco.mj_step(self.model, self.data, nstep=round(duration / H))
            return self.coordinates.inverse @ self.data.qpos

        return simulate


def on_the_ground(biped: Biped) -> Mapping[str, Simulate]:
    """The floating robot with spheres for feet over a plane; only its cost is of interest."""
    spec = _floating(biped)
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0.0, 0.0, 1.0], pos=[0.0, 0.0, -FOOT]
    )
    for foot in (biped.description.stance_foot, biped.description.swing_foot):
        spec.body(foot).add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[FOOT, 0.0, 0.0], mass=0.0)
    model = _model(biped, spec)
    model.jnt_limited[:] = 0
    data = mujoco.MjData(model)

    def simulate(q: Array, v: Array, duration: float) -> Array:
        mujoco.mj_resetData(model, data)
        hip, speed = biped.hip(q), biped.hip_velocity(q, v)
        names = [*biped.description.base, *biped.description.joints]
        for name, x, dx in zip(names, (*hip, *q), (*speed, *v), strict=True):
            data.joint(name).qpos, data.joint(name).qvel = x, dx
        mujoco.mj_step(model, data, nstep=round(duration / H))
        return np.array([data.joint(name).qpos[0] for name in biped.description.joints])

    return {"with contact, Euler 1 ms": simulate}


def _floating(biped: Biped) -> mujoco.MjSpec:
    """The trunk with three joints of its own: bodies without mass between them are refused."""
    tree, d = biped.tree, biped.description
    carried = [replace(j, type="fixed") if j.name in d.base else j for j in tree.joints]
    spec = mujoco.MjSpec.from_string(to_xml(replace(tree, joints=tuple(carried))))
    trunk = spec.body(d.trunk)
    spec.delete(spec.joint(d.unactuated))
    slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
    for name, kind in ((d.base[0], slide), (d.base[1], slide), (d.unactuated, hinge)):
        axis = next(j.axis for j in tree.joints if j.name == name)
        trunk.add_joint(name=name, type=kind, axis=axis)
    return spec


def _model(biped: Biped, spec: mujoco.MjSpec) -> mujoco.MjModel:
    model = spec.compile()
    model.opt.timestep = H
    model.opt.gravity[:] = (0.0, 0.0, -biped.description.gravity)
    for joint, inertia in rotors(biped).items():
        model.joint(joint).armature = inertia
    # derived constants, such as the inertia at qpos0, know of the rotors only after this
    mujoco.mj_setConst(model, mujoco.MjData(model))
    return model
