"""Re-rooting a floating biped at its stance foot: from floating.urdf to the pinned variant.

All frames are parallel at zero angles, so turning the tree round only moves origins. A joint that
is walked backwards keeps its coordinate when its axis is negated: if the child turns by `q` about
`n`, the parent turns by `q` about `-n` seen from the child.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from biped_adrc.errors import ModelError
from biped_adrc.model.urdf import Joint, Link, Tree, Vector

PIN_JOINT = "stance_pin"
ZERO: Vector = (0.0, 0.0, 0.0)


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0] + 0.0, a[1] - b[1] + 0.0, a[2] - b[2] + 0.0)


def _moved(link: Link, origin: Vector) -> Link:
    """`link` written in a frame whose origin lies at `origin` of the old one."""
    body = link.inertial and replace(link.inertial, com=_minus(link.inertial.com, origin))
    visuals = tuple(replace(v, origin=_minus(v.origin, origin)) for v in link.visuals)
    return Link(link.name, body, visuals)


def reroot(tree: Tree, foot: str, torso: str) -> Tree:
    """The tree pinned at link `foot` by a revolute joint `stance_pin` with the torso's pitch axis.

    `torso` is the link that the floating base carries; what is above it is dropped. Raises
    ModelError when `foot` does not hang below `torso` by revolute and fixed joints.
    """
    chain = _chain(tree, foot, torso)
    pitch = tree.joint_above(torso)
    assert pitch is not None
    origin = {joint.parent: joint.origin for joint in chain}  # of the new frames in the old ones
    joints = [Joint(PIN_JOINT, "revolute", "ground", foot, ZERO, pitch.axis)]
    for joint in chain:
        axis = joint.axis if joint.type == "fixed" else _minus(ZERO, joint.axis)
        back = _minus(ZERO, origin.get(joint.child, ZERO))
        turned = replace(joint, parent=joint.child, child=joint.parent, origin=back, axis=axis)
        beside = _beside(tree, joint.parent, chain)
        moved = (replace(j, origin=_minus(j.origin, origin.get(j.parent, ZERO))) for j in beside)
        joints += [turned, *moved]
    links = {
        name: _moved(tree.links[name], origin.get(name, ZERO))
        for name in (joint.child for joint in joints)
    }
    ground = {"ground": Link("ground", None, ())}
    return Tree(f"{tree.name}_pinned", {**ground, **links}, tuple(joints), tree.source)


def _chain(tree: Tree, foot: str, torso: str) -> tuple[Joint, ...]:
    """Joints from `foot` up to `torso`."""
    chain = tree.path_below(foot, torso)
    if chain is None:
        raise ModelError(f"URDF '{tree.source}': foot '{foot}' does not hang below '{torso}'")
    for joint in chain:
        if joint.type == "prismatic":
            raise ModelError(
                f"URDF '{tree.source}', joint '{joint.name}': prismatic joint in the stance leg"
            )
    return chain


def _beside(tree: Tree, link: str, chain: tuple[Joint, ...]) -> Iterator[Joint]:
    """All joints below `link` that are not reached by the chain."""
    for joint in tree.joints_below(link):
        if joint not in chain:
            yield joint
            yield from _beside(tree, joint.child, chain)
