"""Two legs alike, body by body: what the exchange of the legs at impact, q+ = R q- + r, takes for granted.

Twins are paired upwards from the feet. They must agree in mass, COM, inertia about y, place on their parent,
in the sense of their joints and in having a motor; then r = 0 and, where hips count from a torso, R is a
permutation.
"""

from __future__ import annotations

import math

from biped_adrc.errors import ModelError
from biped_adrc.model.relabelling import twins
from biped_adrc.model.urdf import Inertial, Joint, Tree

_ALIKE = 1e-9  # relative to the numbers compared


def check_alike(tree: Tree, feet: tuple[str, str], pitch: str, actuated: tuple[str, ...]) -> None:
    """Raises ModelError that names the two bodies or joints, and what differs."""
    for one, other in pairs(tree, feet):
        where = f"URDF '{tree.source}': the legs differ:"
        a, b = (_numbers(tree.links[link].inertial) for link in (one, other))
        for what in a:
            if not _close(a[what], b[what]):
                raise ModelError(
                    f"{where} {what} is {_text(a[what])} of '{one}' and {_text(b[what])} of '{other}'; the "
                    "legs change over at impact, so make them equal, with equal zeros of their joints"
                )
        joints = tree.joint_above(one), tree.joint_above(other)
        if joints[0] is not None and joints[1] is not None:
            _check_joints(joints[0], joints[1], pitch, actuated, where)


def pairs(tree: Tree, feet: tuple[str, str]) -> tuple[tuple[str, str], ...]:
    """Links of the stance leg with their twins in the swing leg, from the feet upwards."""
    found = twins(tree, feet)
    stance = [joint.child for joint in tree.path_to_root(feet[0])]
    return tuple((link, found[link]) for link in stance if link in found)


def _numbers(inertial: Inertial | None) -> dict[str, tuple[float, ...]]:
    """What twins have alike, by its name."""
    body = inertial or Inertial(0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    com = body.com[0], body.com[2]
    return {
        "mass [kg]": (body.mass,),
        "COM (x, z) [m]": com,
        "inertia iyy [kg m^2]": body.inertia[3:4],
    }


def _check_joints(
    one: Joint, other: Joint, pitch: str, actuated: tuple[str, ...], where: str
) -> None:
    if pitch in (one.name, other.name):
        return  # one leg is the trunk: its place is the base's
    places = (one.origin[0], one.origin[2]), (other.origin[0], other.origin[2])
    if not _close(*places):
        raise ModelError(
            f"{where} the place (x, z) [m] is {_text(places[0])} of '{one.name}' and {_text(places[1])} of "
            f"'{other.name}'; make it equal"
        )
    if one.type != other.type or (one.type == "revolute" and one.axis != other.axis):
        raise ModelError(
            f"{where} '{one.name}' is {one.type} about {_text(one.axis)} and '{other.name}' {other.type} "
            f"about {_text(other.axis)}; give both the same type and sense"
        )
    if (one.name in actuated) != (other.name in actuated):
        raise ModelError(
            f"{where} of '{one.name}' and '{other.name}' only one has a motor; name both or none by "
            "actuated=(...) or --actuated"
        )


def _close(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return math.dist(a, b) <= _ALIKE * max(math.hypot(*a), math.hypot(*b))


def _text(values: tuple[float, ...]) -> str:
    text = ", ".join(f"{value:.6g}" for value in values)
    return text if len(values) == 1 else f"({text})"
