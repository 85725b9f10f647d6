"""Single support: Pinocchio's terms of the model pinned at the stance foot, in the paper's q_s.

q_s (n,) [rad] are the angles of the joints and, last, the absolute pitch of the torso; D_s (n, n) [kg m^2] is
the inertia matrix in q_s, Omega (n,) [N m] the sum of Coriolis and gravity terms.

The pinned tree hangs from the stance foot, by the revolute joint PIN_JOINT (the pin): its first coordinate is
the absolute angle of the stance shin. The paper's coordinates count from the torso. Both are angles of the same
links, so `q_tree = T q_s` with a constant T, and `D_s = T' M T`, `Omega = T' nle(T q, T v)`, with M the inertia
matrix and nle the nonlinear effects (Coriolis and gravity terms) of Pinocchio.

`reroot` makes this tree: it turns the tree of floating.urdf round at its stance foot. All frames
are parallel at zero angles, so turning the tree round only moves origins. A joint that is walked
backwards keeps its coordinate when its axis is negated: if the child turns by `q` about `n`, the
parent turns by `q` about `-n` seen from the child.

T' is the transpose of T; on a vector a prime is a time derivative. `Biped` holds one `PinnedDynamics` and
checks the angles; nothing is checked here. Pinocchio's geometry is in three dimensions, the rows XZ of it are
the plane of motion.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pinocchio as pin

from biped_adrc.core.errors import InputError, ModelError, NotFiniteError
from biped_adrc.core.types import Array
from biped_adrc.model.robots.robot_toml import RobotDescription, Rotors
from biped_adrc.model.robots.urdf import Joint, Link, Tree, Triple, to_xml

XZ = [0, 2]
"""The plane of motion among Pinocchio's axes x, y, z."""
WORLD_AXES = pin.LOCAL_WORLD_ALIGNED
"""Pinocchio's option for velocities of the origin of a frame along the axes of the world."""


def pinned_model(tree: Tree, d: RobotDescription, armature: Rotors) -> pin.Model:
    """Make the Pinocchio model of a tree, pinned or with its floating base, with the rotor inertia `armature`
    [kg m^2] at every motor of the record `d`, or one number for each, and with the record's gravity.
    """
    model = pin.buildModelFromXML(to_xml(tree))
    rotor = np.zeros(model.nv)
    rotor[[velocity_index(model, joint) for joint in d.actuated]] = armature
    model.armature = rotor
    model.gravity.linear = np.array([0.0, 0.0, -d.gravity])
    return model


def velocity_index(model: pin.Model, joint: str) -> int:
    """Index of a joint in Pinocchio's velocity vector."""
    return int(model.joints[model.getJointId(joint)].idx_v)


def frame_index(model: pin.Model, frame: str) -> int:
    """Pinocchio's index of a link's frame, also where a joint has the same name. Raises
    ModelError if it is unknown.
    """
    if not model.existBodyName(frame):
        names = [f.name for f in model.frames if f.type == pin.FrameType.BODY]
        raise ModelError(f"model '{model.name}' has no frame '{frame}'; it has {names}")
    return int(model.getBodyId(frame))


BEYOND = 1e150
"""Sum of absolute angles or rates [rad, rad/s] from which on the dynamics, with their squares, may overflow."""


def finite_angles(q: Array, shape: tuple[int]) -> Array:
    """Return q itself after a check that it has this shape, (n,), and finite numbers [rad] or [rad/s].

    Raises InputError for the shape, NotFiniteError for NaN, infinity and numbers from BEYOND on. The test is on
    the sum of the absolute values as Python's floats: that is the fastest, and overflows without a warning.
    """
    if q.shape != shape:
        raise InputError(f"expected an array of shape {shape}, found {q.shape}")
    # `not <` instead of `>=`: a comparison with NaN is false
    if not sum(map(abs, q.tolist())) < BEYOND:
        raise NotFiniteError(f"expected finite angles or rates, below {BEYOND:g}, found {q}")
    return q


class PinnedDynamics:
    """Pinocchio's model pinned at the stance foot, and its kinematics at q = q_s, v = q_s' (n,) [rad, rad/s].

    Positions are (x, z) from the stance foot. `model` and `data` are Pinocchio's, `T` (n, n) maps q_s to the
    tree's coordinates and `inverse` back, `swing` and `hip` are Pinocchio's frame indices. Rows XZ of a vector
    of Pinocchio's are the plane. `Biped` has the dynamics.
    """

    def __init__(self, tree: Tree, d: RobotDescription, stance_chain: Array, armature: Rotors):
        """Build the model of `tree`, which hangs from the stance foot; d: record of the robot, with its joints
        and gravity; armature [kg m^2]: rotor inertia at every motor, or one number for each.

        stance_chain (n,): the pin's angle is stance_chain q_s, the absolute angle of the stance foot's link.
        Raises ModelError when the tree and the record have different numbers of coordinates.
        """
        self.model, joints = pinned_model(tree, d, armature), d.joints
        self.data = self.model.createData()
        n = len(joints)
        if self.model.nv != n:
            raise ModelError(
                f"'{tree.source}': pinned model has {self.model.nv} coordinates, "
                f"the robot record names {n} ({list(joints)})"
            )
        # q_tree = T q_s: joints keep their coordinates; the last one, the pitch, is no joint of this tree, but
        # the pin takes its place
        self.T = np.zeros((n, n))
        for j, name in enumerate(joints[:-1]):
            self.T[velocity_index(self.model, name), j] = 1.0
        self.T[velocity_index(self.model, PIN_JOINT)] = stance_chain
        self.inverse = np.linalg.inv(self.T)
        self.swing = frame_index(self.model, d.swing_foot)
        self.hip = frame_index(self.model, d.hip)

    def position(self, q: Array, frame: int) -> Array:
        """Position (x, z) of a frame, by its index, from the stance foot (2,) [m]."""
        pin.forwardKinematics(self.model, self.data, self.T @ q)
        return pin.updateFramePlacement(self.model, self.data, frame).translation[XZ]

    def jacobian(self, q: Array, frame: int) -> Array:
        """Jacobian d(x, z)/dq_s (2, n) [m] of a frame's position, by the frame's index."""
        J = pin.computeFrameJacobian(self.model, self.data, self.T @ q, frame, WORLD_AXES)
        return J.reshape(6, -1)[XZ] @ self.T  # for n = 1 Pinocchio returns (6,)

    def centre_of_mass(self, q: Array, v: Array, a: Array) -> tuple[Array, Array, Array]:
        """Position [m], velocity [m/s], acceleration [m/s^2] of the COM, each (x, z) (2,); a = q_s'' (n,)."""
        pin.centerOfMass(self.model, self.data, self.T @ q, self.T @ v, self.T @ a)
        d = self.data  # [0]: of the whole robot
        return d.com[0][XZ].copy(), d.vcom[0][XZ].copy(), d.acom[0][XZ].copy()

    def mass_jacobian(self, q: Array) -> Array:
        """Jacobian m dp_com/dq_s (2, n) [kg m], m the whole mass: times q_s' it is the linear momentum."""
        J = pin.jacobianCenterOfMass(self.model, self.data, self.T @ q).reshape(3, -1)
        return float(pin.computeTotalMass(self.model)) * J[XZ] @ self.T

    def bodies(self) -> tuple[Array, Array, Array]:
        """Masses (n,) [kg], inertias about the COM (n,) [kg m^2] and the matrix A (n, n) of the absolute angles
        a = A q_s of the n bodies, counter-clockwise with x to the right and z up.

        The bodies are in Pinocchio's order; fixed links are merged with the body they hang on.
        """
        # [1:], and joints from 1 on below: index 0 is the world
        inertias = self.model.inertias[1:]
        mass = np.array([body.mass for body in inertias])
        about_y = np.array([body.inertia[1, 1] for body in inertias])
        q = np.zeros(self.model.nq)  # any: planar rotations do not depend on the angles
        # row 4 is the turn about y, which points into the plane: a positive one is clockwise
        rows = [
            -pin.computeJointJacobian(self.model, self.data, q, joint).reshape(6, -1)[4] @ self.T
            for joint in range(1, self.model.njoints)
        ]
        return mass, about_y, np.array(rows)

    def points(self, q: Array) -> Array:
        """Positions (x, z) (n + 2, 2) [m] from the stance foot: the COMs of the n bodies in the order of
        `bodies`, then the swing foot, then the hip.

        The closed form of `planar_robot` is fitted to these.
        """
        pin.forwardKinematics(self.model, self.data, self.T @ q)
        # [1:]: without the world, which has index 0
        places, inertias = list(self.data.oMi)[1:], list(self.model.inertias)[1:]
        coms = [oMi.act(body.lever) for oMi, body in zip(places, inertias, strict=True)]
        ends = (pin.updateFramePlacement(self.model, self.data, k) for k in (self.swing, self.hip))
        return np.array([*coms, *(frame.translation for frame in ends)])[:, XZ]


PIN_JOINT = "stance_pin"
"""Name of the joint between the ground and the stance foot in the pinned tree."""
ZERO: Triple = (0.0, 0.0, 0.0)


def _minus(a: Triple, b: Triple) -> Triple:
    """a - b of two vectors, such as places [m]; adding 0.0 turns -0.0 into 0.0, as a URDF would show "-0"."""
    return (a[0] - b[0] + 0.0, a[1] - b[1] + 0.0, a[2] - b[2] + 0.0)


def _moved(link: Link, origin: Triple) -> Link:
    """The same link in a parallel frame, whose origin lies at `origin` [m] in the old one."""
    body = link.inertial and replace(link.inertial, com=_minus(link.inertial.com, origin))
    visuals = tuple(replace(v, origin=_minus(v.origin, origin)) for v in link.visuals)
    return Link(link.name, body, visuals)


def reroot(tree: Tree, foot: str, torso: str) -> Tree:
    """The tree turned round: link `foot` hangs from a new link "ground" by a revolute joint PIN_JOINT, with the
    torso's pitch axis, the stance leg from the foot, and the torso from the leg.

    The frame of a link on the leg moves to the joint below it, by which it now hangs; that of the foot stays.
    `torso` is the link that the floating base carries; the base above it is dropped. Raises ModelError when
    `foot` does not hang below `torso`.
    """
    chain, pitch = tree.path_below(foot, torso), tree.joint_above(torso)
    if chain is None:
        raise ModelError(f"'{tree.source}': foot '{foot}' does not hang below '{torso}'")
    assert pitch is not None  # the torso hangs on a joint where a path leads up to it
    # chain: joints from the foot up to the torso
    origin = {joint.parent: joint.origin for joint in chain}  # of the new frames in the old ones
    pin_joint = Joint(PIN_JOINT, "revolute", "ground", foot, ZERO, pitch.axis)
    joints = [pin_joint, *_beside(tree, foot, chain)]
    for joint in chain:
        axis = joint.axis if joint.type == "fixed" else _minus(ZERO, joint.axis)
        # the joint stays where it is; seen from the child's new frame that is minus the frame's move
        back = _minus(ZERO, origin.get(joint.child, ZERO))
        turned = replace(joint, parent=joint.child, child=joint.parent, origin=back, axis=axis)
        beside = _beside(tree, joint.parent, chain)
        moved = (replace(j, origin=_minus(j.origin, origin.get(j.parent, ZERO))) for j in beside)
        joints += [turned, *moved]
    children = [joint.child for joint in joints]
    links = {name: _moved(tree.links[name], origin.get(name, ZERO)) for name in children}
    ground = {"ground": Link("ground", None, ())}  # without mass and shapes
    return Tree(f"{tree.name}_pinned", {**ground, **links}, tuple(joints), tree.source)


def _beside(tree: Tree, link: str, chain: tuple[Joint, ...]) -> Iterator[Joint]:
    """Iterate over all joints below `link` that are not on the chain and not below a joint of it: these
    branches are not turned round.
    """
    for joint in tree.joints_below(link):
        if joint not in chain:
            yield joint
            yield from _beside(tree, joint.child, chain)
