"""Shapes for a robot whose URDF has none that can be drawn: sticks from joint to joint, and balls.

A stick runs from the origin of a link to every joint below it, or to its COM where nothing lies below. It is a
cylinder along z, a box along x, and a row of balls where it stands obliquely. At every COM lies a ball of
steel that weighs as much as the body, r = (3 m / (4 pi rho))^(1/3).
"""

from __future__ import annotations

import math
from dataclasses import replace

from biped_adrc.model.urdf import Link, Tree, Vector, Visual

_STEEL = 7800.0  # [kg/m^3]
_RADIUS = 0.03  # of a stick, as a fraction of its length
_BEADS = 9
_STANCE, _SWING, _TRUNK = (0.0, 0.45, 0.7, 1.0), (0.84, 0.37, 0.0, 1.0), (0.35, 0.35, 0.4, 1.0)


def drawable(tree: Tree, feet: tuple[str, str]) -> tuple[Tree, tuple[str, ...]]:
    """The tree itself where a link has a shape, else the tree with sticks and a sentence that says so."""
    if any(link.visuals for link in tree.links.values()):
        return tree, ()
    legs = [{joint.child for joint in tree.path_to_root(foot)} for foot in feet]
    links = {}
    for name, link in tree.links.items():
        stance, swing = (name in leg for leg in legs)
        colour = _TRUNK if stance == swing else _STANCE if stance else _SWING
        links[name] = replace(link, visuals=_shapes(tree, link, colour))
    said = "shapes: the URDF has none that can be drawn, so sticks and balls are drawn instead"
    return replace(tree, links=links), (said,)


def _shapes(tree: Tree, link: Link, colour: tuple[float, ...]) -> tuple[Visual, ...]:
    rgba = (colour[0], colour[1], colour[2], colour[3])
    ends = [joint.origin for joint in tree.joints_below(link.name) if any(joint.origin)]
    if link.inertial is None:
        return tuple(shape for end in ends for shape in _stick(end, rgba))
    com = link.inertial.com
    radius = (3.0 * link.inertial.mass / (4.0 * math.pi * _STEEL)) ** (1.0 / 3.0)
    sticks = [shape for end in ends or [com] if any(end) for shape in _stick(end, rgba)]
    return (*sticks, Visual("sphere", (radius,), com, rgba))


def _stick(end: Vector, rgba: tuple[float, float, float, float]) -> tuple[Visual, ...]:
    """From the origin to `end` [m]."""
    x, _, z = end
    length = math.hypot(x, z)
    radius = _RADIUS * length
    middle = (0.5 * x, 0.0, 0.5 * z)
    if abs(x) < radius:
        return (Visual("cylinder", (radius, abs(z)), middle, rgba),)
    if abs(z) < radius:
        return (Visual("box", (abs(x), 2.0 * radius, 2.0 * radius), middle, rgba),)
    shares = [k / (_BEADS - 1) for k in range(_BEADS)]
    return tuple(Visual("sphere", (radius,), (s * x, 0.0, s * z), rgba) for s in shares)
