"""The robot as a model of MuJoCo, from the same tree, with rotors, joint friction and motors.

    qpos = (x, z of the base, q)      in the order of the model's joints

`floating_model` stands on a `SoftGround` with spheres for feet; `pinned_model` turns about its stance foot
and has no contact. Of MuJoCo's bodies those that move have to have a mass, so the joints of the base belong
to the trunk. RK4, since MuJoCo's Euler methods move the angles over a sampling period by (1 + h/T)
a T^2 / 2, which a fast observer takes for a disturbance: that of Table I does not walk on them.
Static friction is MuJoCo's `frictionloss`, a bound on a constraint's force, where the rigid plant has tanh.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from types import ModuleType

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.extras.mujoco.soft_ground import SoftGround
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.robots.urdf import Joint, Tree
from biped_adrc.types import MuJoCoModel, MuJoCoSpec

KINDS = {"revolute": "mjJNT_HINGE", "prismatic": "mjJNT_SLIDE"}
"""MuJoCo's types of joints, by the type in the tree."""
PLANES = ("ground", "ground ahead")
"""Under both feet; on steps, under the stance foot and under the other one."""


@cache
def mujoco() -> ModuleType:
    """The module. Raises InputError where it is not installed."""
    try:
        import mujoco as found
    except ImportError as error:
        raise InputError(
            f"MuJoCo is not installed ({error}); pip install 'biped-adrc[mujoco]'"
        ) from error
    found.set_mju_user_warning(lambda _: None)  # counted in its data; it would write a file
    return found


def pinned_model(biped: Biped, h: float) -> MuJoCoModel:
    """The robot pinned at its stance foot, without contact; h [s]: step of the engine."""
    tree = biped.pinned_tree
    spec = _spec(biped, h)
    _add(spec.worldbody, tree, tree.joints_below("ground"), biped)
    spec.option.disableflags |= mujoco().mjtDisableBit.mjDSBL_CONTACT
    return spec.compile()


def floating_model(
    biped: Biped, ground: SoftGround, slope: float, h: float, planes: tuple[str, ...] = PLANES[:1]
) -> MuJoCoModel:
    """The robot on soft ground of a slope [rad]; h [s]: step of the engine. planes: one, or one a foot."""
    return floating_spec(biped, ground, slope, h, planes).compile()


def floating_spec(
    biped: Biped, ground: SoftGround, slope: float, h: float, planes: tuple[str, ...] = PLANES[:1]
) -> MuJoCoSpec:
    """From what `floating_model` is compiled.

    The plane lies a foot's radius below the plane of the foot points, so that a foot touches where a point
    would.
    """
    mj, d = mujoco(), biped.description
    spec = _spec(biped, h)
    spec.option.cone, spec.option.impratio = mj.mjtCone.mjCONE_ELLIPTIC, ground.impratio
    joints = {joint.name: joint for joint in biped.tree.joints}
    _add(spec.worldbody, biped.tree, [joints[name] for name in (*d.base, d.unactuated)], biped)
    out = np.insert(ground_axes(slope)[1], 1, 0.0)
    for name in planes:
        spec.worldbody.add_geom(
            name=name, type=mj.mjtGeom.mjGEOM_PLANE, size=[0.0, 0.0, 1.0],
            pos=-ground.foot_radius * out, quat=[np.cos(slope / 2), 0.0, np.sin(slope / 2), 0.0],
            contype=0, conaffinity=0,
        )  # fmt: skip
    for foot, plane in zip(d.feet, (planes[0], planes[-1]), strict=True):
        spec.body(foot).add_geom(
            name=foot, type=mj.mjtGeom.mjGEOM_SPHERE, size=[ground.foot_radius, 0.0, 0.0],
            mass=0.0, contype=0, conaffinity=0,
        )  # fmt: skip
        spec.add_pair(
            geomname1=plane, geomname2=foot, condim=3,
            friction=[ground.friction, ground.friction, 0.0, 0.0, 0.0],
            solref=[ground.time_constant, ground.damping_ratio],
            solimp=[*ground.impedance, 1e-3, 0.5, 2.0],
        )  # fmt: skip
    return spec


def _spec(biped: Biped, h: float) -> MuJoCoSpec:
    """An empty world with gravity, in which a state alone decides what comes next (no warm starts)."""
    mj = mujoco()
    spec = mj.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep, spec.option.gravity = h, [0.0, 0.0, -biped.description.gravity]
    spec.option.integrator = mj.mjtIntegrator.mjINT_RK4
    spec.option.jacobian = mj.mjtJacobian.mjJAC_DENSE
    spec.option.disableflags |= mj.mjtDisableBit.mjDSBL_WARMSTART
    # one robot is one island, and looking costs 7 %
    spec.option.disableflags |= mj.mjtDisableBit.mjDSBL_ISLAND
    for joint in biped.description.actuated:
        spec.add_actuator(name=joint, target=joint, trntype=mj.mjtTrn.mjTRN_JOINT)
    return spec


def _add(parent: MuJoCoSpec, tree: Tree, joints: Sequence[Joint], biped: Biped) -> None:
    """One body that moves by `joints`, the last of which carries its link, and all that hangs on it."""
    mj, last = mujoco(), joints[-1]
    body = parent.add_body(name=last.child, pos=np.sum([j.origin for j in joints], axis=0))
    if (inertial := tree.links[last.child].inertial) is not None:  # None: a frame without mass
        xx, xy, xz, yy, yz, zz = inertial.inertia
        body.mass, body.ipos = inertial.mass, inertial.com
        body.fullinertia, body.explicitinertial = [xx, yy, zz, xy, xz, yz], True
    names = biped.description.joints
    for joint in joints:
        if joint.type == "fixed":
            continue
        viscous, static = 0.0, 0.0
        if biped.friction and joint.name in names:
            viscous, static = np.array(biped.friction_coefficients)[:, names.index(joint.name)]
        rotor = biped.armature if joint.name in biped.description.actuated else 0.0
        body.add_joint(
            name=joint.name, type=getattr(mj.mjtJoint, KINDS[joint.type]), axis=joint.axis,
            armature=rotor, damping=viscous, frictionloss=static,
        )  # fmt: skip
    for joint in tree.joints_below(last.child):
        _add(body, tree, [joint], biped)
