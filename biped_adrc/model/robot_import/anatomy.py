"""The parts of a planar biped, as they are found in its tree: feet, hip, order of joints, and phase variable.

The phase is the absolute angle of the virtual stance leg from the hip to the stance foot, counter-clockwise
with x to the right and z up, so that it falls while the robot walks to +x. With a_k the absolute angles of the
links of the stance leg and l_k the lengths of the leg in them,

    Theta = sum_k l_k a_k / sum_k l_k = c q + const

with the coordinates q (n,) [rad] and a constant row c (n,), which a virtual constraint needs: q5 + q1 + q3/2
for RABBIT, whose legs have two links. For two links of equal length this is the angle itself (an isosceles
triangle), for others its first-order part about the straight leg.

The trunk is the link that the planar base carries, the torso. Feet are a pair (stance foot, swing foot); which
leg stands is a convention, as the legs are alike. All positions are those at zero angles, where all frames are
parallel. Re-rooting is to turn the tree round, so that it hangs from its stance foot (`pinned.reroot`).

`import_robot.derive` calls `anatomy` after base and feet are known. What the file does not say is guessed only
when there is one answer, and every guess is a sentence in `Derived.notes`.
"""

import math
import re
from dataclasses import dataclass, replace
from itertools import combinations, pairwise, zip_longest

import numpy as np

from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array
from biped_adrc.model.pinned import reroot
from biped_adrc.model.robot_import.base import PlanarBase, added
from biped_adrc.model.robots import urdf
from biped_adrc.model.robots.urdf import Joint, Note, Notes, Tree

FOOT_NAMES = re.compile(r"foot|feet|toe|sole", re.IGNORECASE)
"""Words in the name of a link that make it a foot."""
_AWAY = 1e-6  # [m], a foot nearer to its last joint than this is no foot


@dataclass(frozen=True)
class Anatomy:
    """Parts of a biped: names of feet and hip, joints in order, and its phase variable."""

    feet: tuple[str, str]
    """Links of the stance and the swing foot."""
    hip: str
    """Link whose origin is the hip."""
    moving: tuple[Joint, ...]
    """Revolute joints without the pitch, in the order q1, q2, ..."""
    phase: tuple[float, ...]
    """Row c (n,) of Theta = c q, dimensionless; the last entry belongs to the pitch."""
    notes: Notes
    """Sentences on what was guessed, and on the phase."""


def anatomy(body: PlanarBase, pair: tuple[str, str], hip: str | None) -> Anatomy:
    """Find the parts of a biped with the feet `pair` (stance, swing); `hip` is the link at whose origin the
    legs meet, guessed when it is None.

    Raises ModelError with the candidates and the option to give when a guess is not certain.
    """
    tree, foot, notes = body.tree, pair[0], tuple[Note, ...]()  # foot: the stance foot
    if hip is None:
        hip, sentence = _guessed_hip(tree, pair)
        notes = (Note("assumed", sentence),)
    # links on the trunk, or the trunk, whose origins stay when the tree is turned round at the stance foot
    fits = [link for link in tree.links_from(body.trunk) if _keeps_its_origin(tree, link, foot)]
    if hip not in fits:
        raise ModelError(
            f"'{tree.source}': hip '{hip}', expected a link whose origin stays when the tree is turned "
            f"round at the stance foot '{foot}': one of {fits}"
        )
    moving = _in_order(body, pair)
    pitch = next(joint for joint in tree.joints if joint.name == body.pitch)
    c = _phase(tree, foot, hip, (*moving, pitch))
    terms = zip(c, (*moving, pitch), strict=True)
    text = " ".join(f"{w:+.6g} {joint.name}" for w, joint in terms if w != 0.0)
    phase = f"phase: Theta = {text}, the virtual leg from the hip to '{foot}'"
    notes = (*notes, Note("assumed", phase))
    return Anatomy(pair, hip, moving, tuple(float(w) for w in c), notes)


def position(tree: Tree, link: str) -> Array:
    """Position (x, z) (2,) [m] of the frame of a link at zero angles, in the frame of the root: the sum of the
    joints' origins, as frames are parallel.
    """
    origins = [joint.origin for joint in tree.path_to_root(link)]
    return np.array([math.fsum(o[0] for o in origins), math.fsum(o[2] for o in origins)])


# -- feet ------------------------------------------------------------------------------------------
def on_feet(
    body: PlanarBase, feet: tuple[str, ...] | None, actuated: tuple[str, ...]
) -> tuple[PlanarBase, tuple[str, str]]:
    """Make the robot stand on two points; returns it and these points, its feet (stance, swing), which are
    guessed where `feet` is None.

    A joint between shin and foot is welded at its zero unless it is one of `actuated`. A tree that hangs from
    one of its legs is turned round, so that the trunk carries both. Raises ModelError.
    """
    if feet is None:
        feet, sentence = _guessed_feet(body)
        body = body.noting(Note("assumed", sentence))
    known = len(feet) == 2 and set(feet) <= set(body.tree.links)
    if not known or len(urdf.bodies_between(body.tree, (feet[0], feet[1]))) == 1:
        raise ModelError(
            f"'{body.tree.source}': feet {list(feet)}, expected two links that a joint moves against each "
            f"other, the stance foot first, by feet=(...) or --feet; the ends of the tree are {_ends(body)}"
        )
    pair = feet[0], feet[1]
    for ends in (pair, pair[::-1]):
        # the way to the other foot begins with the leg of ends[0]
        body = _on_point(body, ends[0], urdf.way(body.tree, ends), actuated)
    return _upright(body, pair)


def _ends(body: PlanarBase) -> list[str]:
    """Names of the links at the ends of the tree: no joint hangs on them, or on the trunk at most one."""
    tree, trunk = body.tree, body.trunk
    below = tree.links_from(trunk)
    # at most 1 joint on the trunk, 0 on other links
    return [link for link in below if len(tree.joints_below(link)) <= (link == trunk)]


def _guessed_feet(body: PlanarBase) -> tuple[tuple[str, ...], str]:
    """Guess the two feet: the two ends of the tree with the most joints between them, or if several pairs have
    as many the two whose names say foot; also returns the sentence that says why.

    Raises ModelError where neither rule gives exactly two.
    """
    ends = _ends(body)
    # number of joints between two ends that are not fixed
    apart = {pair: len(urdf.bodies_between(body.tree, pair)) - 1 for pair in combinations(ends, 2)}
    most = max(apart.values(), default=0)
    farthest = [pair for pair, count in apart.items() if count == most]
    # FOOT_NAMES: foot, feet, toe, sole
    named = tuple(end for end in ends if FOOT_NAMES.search(end))
    for guesses, why in (
        (farthest, f"the two ends with the most joints between them, {most}"),
        ([named] if len(named) == 2 else [], "the two ends that are called feet"),
    ):
        if len(guesses) == 1:
            one, other = guesses[0]
            return guesses[0], f"feet: '{one}' (drawn as the stance foot) and '{other}', {why}"
    raise ModelError(
        f"'{body.tree.source}': which two of the links {ends} are the feet is not certain; say it by "
        "feet=('stance', 'swing') or --feet stance,swing"
    )


def _on_point(
    body: PlanarBase, foot: str, leg: list[tuple[Joint, str]], actuated: tuple[str, ...]
) -> PlanarBase:
    """The robot itself if its foot lies away from the last joint of the leg. Otherwise that joint is an ankle,
    and the result has it fixed: so a link that is called a foot becomes a part of the shin.

    leg: joints and links on the way from this foot to the other one. Raises ModelError, with a hint how to add
    a tip, for an ankle that is one of `actuated`, and for a link that is not called a foot.
    """
    tree, last = body.tree, next(joint for joint, _ in leg if joint.type != "fixed")
    if math.dist(position(tree, foot), position(tree, last.child)) >= _AWAY:
        return body
    # len > 1: a single joint between both feet is no ankle
    if last.name not in actuated and FOOT_NAMES.search(foot) and len(leg) > 1:
        welded = (replace(j, type="fixed") if j == last else j for j in tree.joints)
        text = f"joint '{last.name}': welded at its zero, as '{foot}' is a point here, at the axis; its sole"
        return replace(body, tree=replace(tree, joints=tuple(welded))).noting(
            Note("left out", f"{text} is no contact. --actuated {last.name},... keeps the joint")
        )
    raise ModelError(
        f"'{tree.source}': foot '{foot}' lies on the axis of its own joint '{last.name}', so the "
        "leg has no end; put a link without mass at its tip and name it by feet=(...) or --feet, or give "
        "the place of the tip in the link's frame by tip=(x, y, z) or --set tip=x,y,z"
    )


def _upright(body: PlanarBase, feet: tuple[str, str]) -> tuple[PlanarBase, tuple[str, str]]:
    """The robot, whose trunk is in the middle of the way between the feet: where the tree hangs from a link of
    a leg, it is turned round to hang from the heaviest link in the middle. Also its feet.

    A foot at the old root keeps its place by a link without mass, since `reroot` moves the frames of links.
    """
    bodies, tree = urdf.bodies_between(body.tree, feet), body.tree
    # one body in the middle where their number is odd, twice here; two where it is even
    middle = [*bodies[(len(bodies) - 1) // 2], *bodies[len(bodies) // 2]]
    # nothing to do for a trunk in the middle, or beside the way, such as a torso that the hip link carries
    if body.trunk in middle or not any(body.trunk in links for links in bodies):
        return body, feet
    if body.trunk in feet:
        tree, tip = urdf.with_tip(tree, body.trunk, (0.0, 0.0, 0.0))
        feet = (tip, feet[1]) if feet[0] == body.trunk else (feet[0], tip)
    heaviest = max(middle, key=lambda link: getattr(tree.links[link].inertial, "mass", 0.0))
    turned = reroot(tree, heaviest, body.trunk)
    # `reroot` puts the link "ground" and a joint to it first: both go, and a planar base takes their place
    links = {name: link for name, link in turned.links.items() if name != "ground"}
    again = added(Tree(tree.name, links, turned.joints[1:], tree.source), heaviest)
    text = f"trunk: '{heaviest}', in the middle between the feet; the file hangs from '{body.trunk}', in a leg"
    # notes[0] is on the old base
    return again.noting(*body.notes[1:], Note("assumed", text)), feet


# -- joints ----------------------------------------------------------------------------------------
def _in_order(body: PlanarBase, feet: tuple[str, str]) -> tuple[Joint, ...]:
    """The revolute joints but the pitch, in the order stance hip, swing hip, stance knee, swing knee, ..., then
    those that carry both feet or none.

    From the trunk outwards, a joint of the stance leg before its twin of the swing leg: the paper's order.
    """
    # revolute joints from the root outwards; both legs have those above the trunk, which are left out below
    paths = (reversed(body.tree.path_to_root(foot)) for foot in feet)
    one, other = ([joint for joint in path if joint.type == "revolute"] for path in paths)
    pairs = zip_longest((j for j in one if j not in other), (j for j in other if j not in one))
    legs = [joint for pair in pairs for joint in pair if joint is not None]
    turning = [j for j in body.tree.joints if j.type == "revolute" and j.name != body.pitch]
    return (*legs, *(joint for joint in turning if joint not in legs))


# -- hip and phase ---------------------------------------------------------------------------------
def _guessed_hip(tree: Tree, feet: tuple[str, str]) -> tuple[str, str]:
    """Guess the link whose origin is the hip, the place of the first joint of the swing leg; also returns the
    sentence that says why.

    It is the link where the paths from both feet to the root meet, if its origin lies at that joint and stays
    there when the tree is turned round, else the first link of the swing leg. Raises ModelError where the swing
    foot is fixed to the stance leg.
    """
    one, other = ([foot, *(j.parent for j in tree.path_to_root(foot))] for foot in feet)
    meet = next(link for link in one if link in other)
    swing = [j for j in tree.path_to_root(feet[1]) if j.child not in one and j.type == "revolute"]
    # none where one leg alone carries the base, and its foot is named as the swing foot
    if not swing:
        raise ModelError(
            f"'{tree.source}': the swing foot '{feet[1]}' is fixed to the stance leg; give the feet the "
            f"other way round, feet=('{feet[1]}', '{feet[0]}')"
        )
    # swing[-1]: of the joints of the swing leg alone the one nearest to the trunk
    here = math.dist(position(tree, meet), position(tree, swing[-1].child)) < _AWAY
    link = meet if here and _keeps_its_origin(tree, meet, feet[0]) else swing[-1].child
    return link, f"hip: the origin of '{link}', where '{swing[-1].name}' joins the legs"


def _keeps_its_origin(tree: Tree, link: str, foot: str) -> bool:
    """Whether turning the tree round at `foot` leaves the origin of `link` where it is.

    `pinned.reroot` moves the frame of a link between root and foot to the joint below it, so this joint must
    lie at the link's origin. Other links keep their frames.
    """
    outwards = [joint for joint in tree.path_to_root(foot) if joint.parent == link]
    # [::2]: x and z of (x, y, z); _AWAY: 1e-6 m
    return all(math.hypot(*joint.origin[::2]) < _AWAY for joint in outwards)


def _phase(tree: Tree, foot: str, hip: str, joints: tuple[Joint, ...]) -> Array:
    """Row c (n,) of Theta = c q, from the lengths [m] of the stance leg's links between foot and hip.

    joints: those of q in order, the pitch last. c weights the absolute angles of the links by their lengths.
    """
    # from the foot upwards, until a link that the hip is on or hangs on; points: places (x, z) of the foot, the
    # joints and the hip; links: those between two points in a row
    carriers = {hip, *(joint.parent for joint in tree.path_to_root(hip))}
    points, links = [position(tree, foot)], []
    for joint in tree.path_to_root(foot):
        links.append(joint.child)
        if joint.child in carriers:
            break
        points.append(position(tree, joint.child))
    points.append(position(tree, hip))
    lengths = np.array([math.dist(a, b) for a, b in pairwise(points)])
    # `absolute_angles` count in the sense of the pitch, which is counter-clockwise about -y, clockwise about y
    counter_clockwise = -joints[-1].axis[1]
    rows = urdf.absolute_angles(tree, tuple(joint.name for joint in joints), links)
    return counter_clockwise * lengths @ rows / np.sum(lengths) + 0.0  # + 0.0: no -0.0 in the file
