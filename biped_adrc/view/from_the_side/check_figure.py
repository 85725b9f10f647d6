"""A robot as its file was understood: links, masses, joints with the sense of their angles, feet and hip.

The robot stands with its feet a step apart, the swing foot in front. A bent arrow at a joint shows how what it
carries turns as its angle grows; the disc at a COM has an area in proportion to the mass. The title has the
phase Theta of a gait as a sum of angles. The command `robot check` writes this picture, and in a reproduction
of the paper it is figure 1. A record is the robot's file beside its URDF: which joints and feet are which.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from biped_adrc.core.types import Array
from biped_adrc.gait.design.optimise import apart
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar_robot import robot_of
from biped_adrc.view.colours import STANCE, SWING, TORQUE, TRUNK, bent_arrow
from biped_adrc.view.placement import joint_values, legs, link_placements
from biped_adrc.view.style import label, literal, new_figure

_STEP = 0.6
"""Distance of the feet, as a share of the leg."""


def check_figure(biped: Biped) -> Figure:
    """Draw the robot from the side as its URDF and its record were understood, with names, masses and angles.

    Beside each COM stands its link; a line goes from a link's origin to its COM and to the joints below it.
    """
    d, tree, leg = biped.description, biped.tree, robot_of(biped).leg
    # q (n,) with the swing foot this far ahead, on level ground (slope 0), without limits of angles ({})
    # _STEP of the leg
    q = apart(biped, _STEP * leg, 0.0, {})
    places = link_placements(tree, joint_values(biped, q))
    stance, swing = legs(biped)
    with new_figure(8.0, 7.0) as figure:
        axes = figure.subplots()
        axes.axhline(0.0, color="black", lw=1.0, zorder=0)
        for name in tree.links_from(d.trunk):
            # texts at the stance leg are to the left, all others to the right
            link, side = tree.links[name], -1 if name in stance else 1
            colour = STANCE if name in stance else SWING if name in swing else TRUNK
            ends = [_at(places[joint.child]) for joint in tree.joints_below(name)]
            if link.inertial is not None:
                mass, com = link.inertial.mass, _at(places[name], link.inertial.com)
                size = 40.0 * np.sqrt(mass / biped.mass)  # diameter in typographic points
                axes.plot(*com, "o", color=colour, alpha=0.5, ms=size)
                _write(axes, com, f"{name} {mass:.4g} kg", side, colour, 0.5 * size)
                ends.append(com)
            for end in ends:
                axes.plot(*zip(_at(places[name]), end, strict=True), color=colour, lw=2.5)
        # bent arrows in the senses of the joints, of this radius [m]
        _senses(axes, biped, places, 0.07 * leg)
        marks = {"stance foot": np.zeros(2), "swing foot": biped.swing_foot(q), "hip": biped.hip(q)}
        for text, point in marks.items():
            # 1: to the right of the point; 4.0 and -12.0: how far to the right and upwards, in points of type
            axes.plot(*point, "s", color="black", ms=5, zorder=5)
            _write(axes, point, text, 1, "black", 4.0, -12.0)
        axes.set_aspect("equal")
        axes.margins(0.5, 0.1)
        title = f"{d.name}, {biped.mass:.4g} kg, trunk {d.trunk}; it walks to the right"
        label(axes, "x [m]", "z [m]", f"{literal(title)}\n$\\Theta$ = {d.theta}")
        return figure


def _senses(axes: Axes, biped: Biped, places: dict[str, Array], radius: float) -> None:
    """Draw at each joint a bent arrow in the sense in which its angle grows, wider where other joints are at
    the same place. places: world placement (4, 4) of each link by name. radius [m]: of a lone arrow.
    """
    joints, there = {joint.name: joint for joint in biped.tree.joints}, list[Array]()
    for i, name in enumerate(biped.description.joints):
        centre = _at(places[joints[name].child])
        k = sum(np.allclose(centre, other) for other in there)
        there.append(centre)
        # a rotation about +y is clockwise in the picture, which has x to the right and z up
        bend = bent_arrow(-joints[name].axis[1] * radius * (1.0 + 0.5 * k))
        axes.add_patch(Polygon(centre + bend, color=TORQUE, alpha=0.7, zorder=4))
        # to the right for the swing leg, legs()[1], else to the left; at one place the names are stacked
        side = 1 if joints[name].child in legs(biped)[1] else -1
        _write(axes, centre, f"q{i + 1} {name}", side, TORQUE, 30.0, 14.0 * k)


def _at(M: Array, point: tuple[float, ...] = (0.0, 0.0, 0.0)) -> Array:
    """x and z (2,) [m] of a point in a frame of placement M (4, 4)."""
    return np.asarray((M @ [*point, 1.0])[[0, 2]])


def _write(
    axes: Axes, point: Array, text: str, side: int, colour: str, out: float, up: float = 0.0
) -> None:
    """Write a text beside a point (2,) [m]: from `out` to the right of it (side 1) or to the left (side -1),
    and `up` above it, both in typographic points.
    """
    ha = "left" if side > 0 else "right"
    far = (side * (4.0 + out), up - 4.0)
    axes.annotate(literal(text), tuple(point), far, textcoords="offset points", ha=ha, color=colour)
