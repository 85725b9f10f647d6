"""Re-rooting a floating biped at its stance foot: from floating.urdf to the pinned variant.

All frames are parallel at zero angles, so turning the tree round only moves origins. A joint that
is walked backwards keeps its coordinate when its axis is negated: if the child turns by `q` about
`n`, the parent turns by `q` about `-n` seen from the child.
"""

from __future__ import annotations

from dataclasses import replace

from biped_adrc.errors import ModelError
from biped_adrc.model.urdf import Inertial, Joint, Link, Tree, Vector, Visual

PIN_JOINT = "stance_pin"


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0] + 0.0, a[1] - b[1] + 0.0, a[2] - b[2] + 0.0)


def _moved(link: Link, origin: Vector) -> Link:
    """`link` written in a frame whose origin lies at `origin` of the old one."""
    inertial: Inertial | None = None
    if link.inertial is not None:
        inertial = replace(link.inertial, com=_minus(link.inertial.com, origin))
    visuals: tuple[Visual, ...] = tuple(
        replace(v, origin=_minus(v.origin, origin)) for v in link.visuals
    )
    return Link(link.name, inertial, visuals)


def reroot(tree: Tree, foot: str, torso: str) -> Tree:
    """The tree pinned at link `foot` by a revolute joint `stance_pin` with the torso's pitch axis.

    `torso` is the link that the floating base carries; what is above it is dropped. Raises
    ModelError when `foot` does not hang below `torso` by revolute and fixed joints.
    """
    chain = _chain(tree, foot, torso)
    pitch = tree.joint_above(torso)
    assert pitch is not None
    ground = "ground"
    links: dict[str, Link] = {ground: Link(ground, None, ())}
    joints = [Joint(PIN_JOINT, "revolute", ground, foot, (0.0, 0.0, 0.0), pitch.axis)]
    here, here_origin = foot, (0.0, 0.0, 0.0)  # origin of the new frame of `here` in its old frame
    links[foot] = _moved(tree.links[foot], here_origin)
    walked: set[str] = set()
    for joint in chain:
        axis = joint.axis if joint.type == "fixed" else _minus((0.0, 0.0, 0.0), joint.axis)
        # the old joint sits at the old origin of `here`, and at joint.origin of its parent
        joints.append(
            Joint(
                joint.name,
                joint.type,
                here,
                joint.parent,
                _minus((0.0, 0.0, 0.0), here_origin),
                axis,
            )
        )
        walked.add(joint.name)
        here, here_origin = joint.parent, joint.origin
        links[here] = _moved(tree.links[here], here_origin)
        joints += _branches(tree, here, here_origin, walked, links)
    return Tree(f"{tree.name}_pinned", links, tuple(joints), tree.source)


def _chain(tree: Tree, foot: str, torso: str) -> tuple[Joint, ...]:
    """Joints from `foot` up to `torso`."""
    chain: list[Joint] = []
    for joint in tree.path_to_root(foot):
        if joint.child == torso:
            break
        chain.append(joint)
    else:
        raise ModelError(f"URDF '{tree.source}': foot '{foot}' does not hang below '{torso}'")
    for joint in chain:
        if joint.type == "prismatic":
            raise ModelError(
                f"URDF '{tree.source}', joint '{joint.name}': prismatic joint in the stance leg"
            )
    return tuple(chain)


def _branches(
    tree: Tree, link: str, origin: Vector, walked: set[str], links: dict[str, Link]
) -> list[Joint]:
    """Everything that hangs on `link` beside the walked chain, with its joints moved to `origin`."""
    out: list[Joint] = []
    for joint in tree.joints_below(link):
        if joint.name in walked:
            continue
        walked.add(joint.name)
        out.append(replace(joint, origin=_minus(joint.origin, origin)))
        links[joint.child] = tree.links[joint.child]
        out += _branches(tree, joint.child, (0.0, 0.0, 0.0), walked, links)
    return out
