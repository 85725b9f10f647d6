"""The same robot with parallel frames at zero angles, from a URDF whose frames stand as they like.

With R_p the turn of the parent's frame at zero angles and (x, R) the origin of a joint in it,

    R_c = R_p R,   x' = R_p x,   n' = R_c n                          (joints)
    c' = R_c c,    I' = (R_c R_i) I (R_c R_i)'                       (bodies)

so a leg that hangs down by an origin of rpy = (0, pi, 0) becomes a leg that points along -z. Angles keep
their names, senses and zeros. A `continuous` joint becomes `revolute`, for which nq = nv. Shapes that are
meshes or stand oblique after the turn are not kept: the strict tree has upright primitives only.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from biped_adrc.errors import ModelError
from biped_adrc.model.urdf import (
    GEOMETRY_SIZES,
    JOINT_TYPES,
    MOMENTS,
    SYMMETRIC,
    moments_of,
    numbers,
)
from biped_adrc.types import Array

_ROUND_OFF = 1e-15  # entries of a turn below this are the round-off of pi, dimensionless
_UPRIGHT = 1e-6  # how far a shape's axes may be from the frame's, dimensionless


class Straightened(NamedTuple):
    """<robot> with parallel frames, and the names of links of which something was not kept."""

    robot: ET.Element
    undrawn: tuple[str, ...]
    """Links with a shape that cannot be drawn."""
    flat: tuple[str, ...]
    """Links without moments about x and z, which got some; they do not enter planar motion."""


def straightened(robot: ET.Element, source: str) -> Straightened:
    """<robot> with parallel frames at zero angles. Raises ModelError."""
    robot = copy.deepcopy(robot)
    turns = _turns(robot, source)
    links = robot.findall("link")
    undrawn = tuple(link.get("name", "") for link in links if _turn_link(link, turns, source))
    flat = tuple(link.get("name", "") for link in links if _fill_moments(link, source))
    for joint in robot.findall("joint"):
        _turn_joint(joint, turns, source)
    return Straightened(robot, undrawn, flat)


def _rotation(element: ET.Element | None, where: str) -> Array:
    """R (3, 3) of the rpy of an <origin>: about the fixed axes x, y, z in this order."""
    R: Array = pin.rpy.rpyToMatrix(*numbers(element, "rpy", "0 0 0", 3, f"{where} <origin>"))
    return np.where(np.abs(R) < _ROUND_OFF, 0.0, R)


def _link_of(joint: ET.Element, role: str) -> str:
    found = joint.find(role)
    return "" if found is None else found.get("link", "")


def _turns(robot: ET.Element, source: str) -> dict[str, Array]:
    """R (3, 3) of every link at zero angles, from the roots down; each link is met once."""
    joints = robot.findall("joint")
    children = {_link_of(joint, "child") for joint in joints}
    names = [link.get("name", "") for link in robot.findall("link")]
    turns = {name: np.eye(3) for name in names if name not in children}
    edge = list(turns)
    while edge:
        below = [j for j in joints if _link_of(j, "parent") in edge]
        edge = []
        for joint in below:
            child = _link_of(joint, "child")
            if child not in turns:
                R = _rotation(joint.find("origin"), place_of(joint, source))
                turns[child] = turns[_link_of(joint, "parent")] @ R
                edge.append(child)
    return turns


def place_of(element: ET.Element, source: str) -> str:
    return f"URDF '{source}', {element.tag} '{element.get('name')}'"


def _write(element: ET.Element, key: str, values: Array) -> None:
    element.set(key, " ".join(repr(float(value)) for value in values))


def _turn_origin(element: ET.Element, R: Array, where: str) -> Array:
    """Write the origin of `element` in axes turned by R; its own turn afterwards, (3, 3)."""
    origin = element.find("origin")
    if origin is None:
        return R
    own = R @ _rotation(origin, where)
    _write(origin, "xyz", R @ numbers(origin, "xyz", "0 0 0", 3, f"{where} <origin>"))
    origin.attrib.pop("rpy", None)
    return own


def _turn_joint(joint: ET.Element, turns: Mapping[str, Array], source: str) -> None:
    where = place_of(joint, source)
    kind = "revolute" if joint.get("type") == "continuous" else joint.get("type", "")
    if kind not in JOINT_TYPES:
        raise ModelError(
            f"{where}: type '{kind}', expected one of {['continuous', *JOINT_TYPES]}; a robot that floats "
            "needs no joint for that, its planar base is added"
        )
    if joint.find("mimic") is not None:
        raise ModelError(
            f"{where}: it mimics another joint; coupled joints are not supported, give it a motor of its own "
            "or make it 'fixed'"
        )
    joint.set("type", kind)
    _turn_origin(joint, turns.get(_link_of(joint, "parent"), np.eye(3)), where)
    axis = joint.find("axis")
    if kind == "fixed" and axis is not None:
        joint.remove(axis)
    elif kind != "fixed":
        axis = ET.SubElement(joint, "axis", xyz="1 0 0") if axis is None else axis
        R = turns.get(_link_of(joint, "child"), np.eye(3))
        _write(axis, "xyz", R @ numbers(axis, "xyz", "1 0 0", 3, f"{where} <axis>"))


def _turn_link(link: ET.Element, turns: Mapping[str, Array], source: str) -> bool:
    """Turn body and shapes; whether a shape was not kept."""
    where, R = place_of(link, source), turns.get(link.get("name", ""), np.eye(3))
    inertial = link.find("inertial")
    if inertial is not None:
        own = _turn_origin(inertial, R, f"{where} <inertial>")
        moments = inertial.find("inertia")
        if moments is not None and not np.array_equal(own, np.eye(3)):
            _turn_moments(moments, own, f"{where} <inertia>")
    kept = [_turn_visual(visual, R, f"{where} <visual>") for visual in link.findall("visual")]
    for visual, keep in zip(link.findall("visual"), kept, strict=True):
        if not keep:
            link.remove(visual)
    return not all(kept)


def _turn_moments(moments: ET.Element, R: Array, where: str) -> None:
    turned = R @ moments_of(moments, where)[SYMMETRIC] @ R.T
    for key, value in zip(MOMENTS, (0.5 * (turned + turned.T))[np.triu_indices(3)], strict=True):
        moments.set(key, repr(float(value)))


def _fill_moments(link: ET.Element, source: str) -> bool:
    """Give a body with iyy alone the moments of a slender link along z; whether it was one."""
    moments = link.find("inertial/inertia")
    if moments is None:
        return False
    where = f"{place_of(link, source)} <inertia>"
    found = moments_of(moments, where, "0")
    iyy, others = float(found[3]), np.delete(found, 3)
    if not iyy > 0.0 or np.any(np.abs(others) > _ROUND_OFF * iyy):
        return False
    moments.attrib.update(ixx=repr(iyy), izz=repr(0.05 * iyy), ixy="0", ixz="0", iyz="0")
    return True


def _turn_visual(visual: ET.Element, R: Array, where: str) -> bool:
    """Turn a shape; False when it is no upright primitive afterwards."""
    geometry = visual.find("geometry")
    shapes = () if geometry is None else tuple(geometry)
    shape = next((g for g in shapes if g.tag in GEOMETRY_SIZES), None)
    own = np.abs(_turn_origin(visual, R, where))
    if shape is None:
        return False
    if shape.tag == "box":
        axes = np.asarray(np.round(own), dtype=np.float64)
        size: Array = axes @ numbers(shape, "size", "", 3, f"{where} <box>")
        _write(shape, "size", size)
        return bool(np.max(np.abs(own - axes)) < _UPRIGHT)
    return shape.tag == "sphere" or bool(abs(own[2, 2] - 1.0) < _UPRIGHT)
