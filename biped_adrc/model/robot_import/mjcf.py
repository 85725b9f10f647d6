"""Reading an MJCF through MuJoCo's own compiler, which knows its defaults, classes and meshes.

The compiled model is placed at its reference posture qpos0. There every body gets a frame parallel to the
world's, at the anchor of its last joint, so that it is a link of `urdf.Tree`; joints of one body are a chain of
links without mass. Where the name of a shape or site says foot, and that of its body does not, the place of
this shape becomes the point of a foot. Angles count from the reference posture.

Read are masses and inertias, joints and their ranges, armature, damping, friction loss, and the torque that the
motors reach. Shapes with their contacts, springs and the gains of servos are left out; constraints between
bodies are refused. It needs the optional package `mujoco`. In the functions m is MuJoCo's compiled model, d its
data, j the index of a joint and b that of a body; body 0 is the world.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.core.errors import ModelError, optional
from biped_adrc.core.files import one_line
from biped_adrc.core.types import Array
from biped_adrc.model.robot_import.anatomy import FOOT_NAMES
from biped_adrc.model.robots import urdf
from biped_adrc.model.robots.robot_toml import GRAVITY
from biped_adrc.model.robots.urdf import FREELY, Joint, Link, Note, Notes, Tree, vector
from biped_adrc.model.robots.urdf_reader import Contents

_KINDS = ("floating", "ball", "prismatic", "revolute")
"""Types of joints, in the order of MuJoCo's numbers for them."""


def read_mjcf(path: Path) -> Contents:
    """Compile an MJCF and read the robot in it, as `urdf_reader.read` does for a URDF.

    Raises ModelError for a file that does not compile or has constraints between bodies, InputError without
    MuJoCo.
    """
    missing = f"'{path}' is MJCF, which MuJoCo compiles, and MuJoCo is not installed"
    with optional("mujoco", missing):
        import mujoco
    mujoco.set_mju_user_warning(lambda _: None)  # MuJoCo's own handler writes a file MUJOCO_LOG.TXT
    try:
        m = mujoco.MjModel.from_xml_path(str(path))
    except ValueError as error:
        reason = " ".join(str(error).split())
        raise ModelError(f"MJCF '{path}' does not compile: {reason}") from None
    if m.neq:
        raise ModelError(
            f"'{path}': it has {m.neq} constraints in <equality>, expected none; closed chains and coupled "
            "joints are not supported"
        )
    d = mujoco.MjData(m)  # at the reference posture qpos0
    mujoco.mj_kinematics(m, d)  # places of all bodies at the reference posture
    names = [one_line(m.body(b).name) or f"body{b}" for b in range(m.nbody)]
    # _KINDS: types of joints by MuJoCo's numbers; a hinge is "revolute"
    hinges = {_name(m, j): j for j in range(m.njnt) if _KINDS[m.jnt_type[j]] == "revolute"}

    def by_joint(values: Array) -> dict[str, float]:
        """The entries for hinges of an array over MuJoCo's velocities, by name of the joint."""
        return {name: float(values[m.jnt_dofadr[j]]) for name, j in hinges.items()}

    # a joint whose motors have no limit is left out
    torques = {name: e for name, j in hinges.items() if (e := _torque(m, j)) < math.inf}
    viscous, static, rotor = map(by_joint, (m.dof_damping, m.dof_frictionloss, m.dof_armature))
    # orientation of each body in the world, by its name
    turns = dict(zip(names, d.xmat.reshape(-1, 3, 3).copy(), strict=True))
    tree, notes = _tree(m, d, names, path), _notes(m, hinges)
    return Contents(tree, torques, viscous, static, rotor, turns, notes)


def _name(m: Any, j: int) -> str:
    """Name of joint j, or joint with its index if the file has none."""
    return one_line(m.joint(j).name) or f"joint{j}"


def _tree(m: Any, d: Any, names: list[str], path: Path) -> Tree:
    """Links and joints of a compiled model, placed by its data at qpos0; names: of the bodies.

    A body with several joints becomes a chain of links without mass, and its own link at the end. Raises
    ModelError for a ball joint, and a body with impossible moments. path: of the file, for messages.
    """
    # places: origin [m] of each body's link in the world; above, parent: origin and name of the link that
    # carries the next joint
    places, links, joints = [np.zeros(3)], {names[0]: Link(names[0], None, ())}, list[Joint]()
    for b in range(1, m.nbody):
        above, parent = places[m.body_parentid[b]], names[m.body_parentid[b]]
        own = range(m.body_jntadr[b], m.body_jntadr[b] + m.body_jntnum[b])
        for j in own or (-1,):  # -1: none, the body is fixed to its parent
            last = j == own[-1] if own else True
            name = _name(m, j) if own else f"{names[b]}_mount"
            child = names[b] if last else f"{names[b]}_{name}"
            kind = _KINDS[m.jnt_type[j]] if own else "fixed"
            # the child's origin in the world [m]
            place = d.xanchor[j] if kind == "revolute" else d.xpos[b] if last else above
            axis = vector(d.xaxis[j]) if own else (1.0, 0.0, 0.0)
            if kind == "ball":
                raise ModelError(f"'{path}': joint '{name}' is a ball, expected hinges about y")
            # FREELY: no limits of the range
            ends = _range(m, j) if kind == "revolute" else FREELY
            origin = vector(place - above)
            joints.append(Joint(name, kind, parent, child, origin, axis, range=ends))
            links[child] = Link(child, None, ())  # a mass follows below, for the body's own link
            above, parent = place, child
        places.append(above)
        if m.body_mass[b] > 0.0:
            R = d.ximat[b].reshape(3, 3)
            moments = (R * m.body_inertia[b]) @ R.T  # R diag(principal moments) R'
            upper = tuple(moments[np.triu_indices(3)].tolist())
            body = urdf.Inertial(float(m.body_mass[b]), vector(d.xipos[b] - above), upper)
            urdf.check_inertial(body, f"'{path}', body '{names[b]}'")
            links[names[b]] = Link(names[b], body, ())
    model = one_line(m.names[: m.names.index(b"\0")].decode(errors="replace"))
    tree = Tree(model or path.stem, links, tuple(joints), f"{path} (MJCF)")
    # a shape or site that is called a foot, on a body that is not, becomes a link without mass at its place
    owners, at = (*m.geom_bodyid, *m.site_bodyid), (*d.geom_xpos, *d.site_xpos)
    shapes = [*map(m.geom, range(m.ngeom)), *map(m.site, range(m.nsite))]
    for b, place, shape in zip(owners, at, shapes, strict=True):
        foot = one_line(shape.name)
        sole = FOOT_NAMES.search(foot) and not FOOT_NAMES.search(names[b])
        if b and sole and foot not in tree.links:
            tree, _ = urdf.with_tip(tree, names[b], vector(place - places[b]), foot)
    return tree


def _range(m: Any, j: int) -> tuple[float, float]:
    """Range (lower, upper) [rad] of hinge j, counted from the reference posture; infinite where it has none, or
    one of a whole turn or more.
    """
    low, high = (float(x) for x in m.jnt_range[j] - m.qpos0[m.jnt_qposadr[j]])
    return (low, high) if m.jnt_limited[j] and high - low < 2.0 * math.pi else FREELY


def _torque(m: Any, j: int) -> float:
    """Torque [N m] that the actuators of joint j reach in both directions: the sum of their limits, at most
    that of the joint itself.

    The limit of an actuator is its force range, or if it is a motor without one, its control range times its
    gain; both times its gear. 0 without an actuator, infinite without a limit.
    """
    total = 0.0
    # transmission types 0 and 1 of an actuator a act on a joint; bias type 0 is a motor, others are servos
    for a in np.flatnonzero((m.actuator_trnid[:, 0] == j) & (m.actuator_trntype < 2)):
        gear, gain = abs(m.actuator_gear[a, 0]), abs(m.actuator_gainprm[a, 0])
        if m.actuator_forcelimited[a]:
            total += gear * np.min(np.abs(m.actuator_forcerange[a]))
        elif m.actuator_ctrllimited[a] and not m.actuator_biastype[a]:
            total += gear * gain * np.min(np.abs(m.actuator_ctrlrange[a]))
        else:
            total = math.inf
    return min(total, *np.abs(m.jnt_actfrcrange[j])) if m.jnt_actfrclimited[j] else total


def _notes(m: Any, hinges: dict[str, int]) -> Notes:
    """Notes on the parts of a compiled model that the robot leaves out; hinges: index j by name.

    springs: stiffness [N m/rad] by joint. zeros: angle [rad] of the reference posture in the file, by joint.
    """
    springs = {n: float(m.jnt_stiffness[j]) for n, j in hinges.items() if m.jnt_stiffness[j]}
    zeros = {n: z for n, j in hinges.items() if (z := float(m.qpos0[m.jnt_qposadr[j]]))}
    g, usual = m.opt.gravity.tolist(), [0.0, 0.0, -GRAVITY]
    # (what was found, text): no note where it is 0, empty or False
    notes = (
        (m.ngeom, f"{m.ngeom} shapes with their contacts, such as soles: the feet are points"),
        (springs, f"springs at joints [N m/rad]: {springs}"),
        (zeros, f"zeros of joints: angles count from the reference posture, at {zeros} rad"),
        (np.any(m.actuator_biastype), "gains of servos: the motors are torques"),
        (m.ntendon, f"{m.ntendon} tendons"),
        (g != usual, f"gravity {g} m/s^2; --set gravity= gives another than {GRAVITY}"),
    )
    return tuple(Note("left out", text) for found, text in notes if found)
