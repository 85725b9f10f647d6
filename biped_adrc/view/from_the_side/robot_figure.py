"""The paper's figure 1: the lines of the robot from its URDF, with q1..q5, Theta, p_2 and p_e.

A link of absolute angle a [rad] points along (-sin a, cos a); angles are counter-clockwise
positive. q5 is the absolute angle of the torso, q1 and q2 go from the torso to the thighs, q3 and
q4 from the thighs to the shins. p_e is the stance foot, p_2 the swing foot. Theta is the angle of the
line from the hip to p_e: the phase of the virtual constraints. Absolute angles are those from the vertical.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.model.biped import Biped
from biped_adrc.view.from_the_side.moving_parts import COLOURS
from biped_adrc.view.from_the_side.side_view import bones, placed_lines
from biped_adrc.view.placement import joint_values, link_placements
from biped_adrc.view.style import GREY, PALETTE, label, literal, new_figure

POSE = (3.5, 4.05, -0.5, -0.75, -0.32)
"""q1..q5 [rad] of a posture in which no mark covers another."""

_HIP_ARCS = (0.15, 0.22)  # [m], radii of q1 and q2
_KNEE_ARC, _THETA_ARC, _PITCH_ARC = 0.15, 0.30, 0.50


def robot_figure(biped: Biped, q: Array | None = None) -> Figure:
    """Draw the robot in single support at q (5,) [rad], with all its angles; in the
    posture `POSE` if q is None.

    Raises InputError for a robot that is not a five-link biped (torso, two thighs, two shins).
    """
    if biped.n != 5:
        raise InputError(f"figure 1 shows a biped of 5 coordinates, found {biped.n}")
    q = np.array(POSE) if q is None else np.asarray(q, dtype=float)
    with new_figure(6.0, 6.6) as figure:
        axes = figure.subplots()
        _links(axes, biped, q)
        _hip_angles(axes, biped, q)
        _knee_angles(axes, biped, q)
        _feet(axes, biped, q)
        axes.set_aspect("equal")
        axes.grid(False)
        name = literal(biped.description.name)
        label(axes, "x [m]", "z [m]", f"{name}: coordinates in single support")
        return figure


def direction(a: float) -> Array:
    """Unit vector (2,) along which a link of absolute angle a [rad] points: (-sin a, cos a)."""
    return np.array([-math.sin(a), math.cos(a)])


def _links(axes: Axes, biped: Biped, q: Array) -> None:
    """Draw the ground, and the lines of all links in the colours of their legs."""
    axes.axhline(0.0, color="black", lw=1.0, zorder=1)
    lines = bones(biped)
    ends = placed_lines(lines, link_placements(biped.tree, joint_values(biped, q)))
    shades = [COLOURS[bone.leg] for bone in lines]
    look: dict[str, Any] = {"capstyle": "round", "alpha": 0.35, "zorder": 3}
    axes.add_collection(LineCollection(ends, colors=shades, linewidths=12.0, **look))


def _angle(
    axes: Axes,
    centre: Array,
    radius: float,
    span: tuple[float, float],
    name: str,
    colour: str,
    at: float,
    out: float = 0.0,
) -> None:
    """Draw an arc about `centre` (2,) [m] from absolute angle span[0] to span[1] [rad], an arrow at its end.

    radius [m]: of the arc. name: its text, at the share `at` (0 to 1) of the arc, `out` [m] outside it.
    """
    points = np.array([centre + radius * direction(a) for a in np.linspace(*span, 60)])
    axes.plot(points[:-2, 0], points[:-2, 1], color=colour, lw=1.3, zorder=5)
    arrow = {"arrowstyle": "-|>", "color": colour, "lw": 1.3, "shrinkA": 0, "shrinkB": 0}
    # the head of the arrow, from a point a little before the end
    axes.annotate("", points[-1], points[-4], arrowprops=arrow, zorder=5)
    middle = span[0] + at * (span[1] - span[0])
    _text(axes, centre + (radius + out) * direction(middle), name, colour)


def _text(axes: Axes, at: Array, text: str, colour: str) -> None:
    """Write a text at the point `at` (2,) [m] on white."""
    box = {"fc": "white", "ec": "none", "pad": 0.8, "alpha": 0.9}
    axes.text(
        at[0], at[1], text, color=colour, ha="center", va="center", fontsize=11, bbox=box, zorder=7
    )


def _ray(axes: Axes, start: Array, end: Array, colour: str = GREY, width: float = 0.9) -> None:
    """Draw a dashed line between two points (2,) [m]."""
    axes.plot(*zip(start, end, strict=True), color=colour, ls=(0, (5, 3)), lw=width, zorder=4)


def _hip_angles(axes: Axes, biped: Biped, q: Array) -> None:
    """Draw the angles at the hip: q5 from the vertical to the torso, q1 and q2 from the torso to the thighs,
    Theta from the vertical to the line to p_e.

    The vertical and the line to p_e are dashed; each angle has a radius of its own, so that no two arcs meet.
    """
    hip, theta = biped.hip(q), float(biped.phase @ q)
    _ray(axes, hip, hip + 0.72 * direction(0.0))
    for i, radius in enumerate(_HIP_ARCS):
        # from the prolonged torso to the thigh
        _angle(axes, hip, radius, (q[4], q[4] + q[i]), f"$q_{i + 1}$", PALETTE[i], 0.32)
    _ray(axes, hip, np.zeros(2), "black", 1.3)
    _angle(axes, hip, _THETA_ARC, (0.0, theta), r"$\Theta$", "black", 0.55)
    _angle(axes, hip, _PITCH_ARC, (0.0, q[4]), "$q_5$", PALETTE[2], 0.5, 0.05)


def _knee_angles(axes: Axes, biped: Biped, q: Array) -> None:
    """Draw q3 and q4, each from the prolonged line of its thigh to the shin."""
    placements = link_placements(biped.tree, joint_values(biped, q))
    joints = {joint.name: joint for joint in biped.tree.joints}
    for i in (2, 3):
        knee = placements[joints[biped.description.joints[i]].child][[0, 2], 3]
        thigh = float(q[4] + q[i - 2])
        _ray(axes, knee, knee + 0.24 * direction(thigh))
        span = thigh, thigh + q[i]
        _angle(axes, knee, _KNEE_ARC, span, f"$q_{i + 1}$", PALETTE[i + 1], 0.5, 0.05)


def _feet(axes: Axes, biped: Biped, q: Array) -> None:
    """Draw the points p_e, the end of the stance leg, and p_2, the swing foot, with their names."""
    p_2 = biped.swing_foot(q)
    outwards = 0.1 if p_2[0] >= 0 else -0.1
    for point, name, shift in ((np.zeros(2), "$p_e$", -outwards), (p_2, "$p_2$", outwards)):
        axes.plot(*point, "o", color="black", ms=4, zorder=6)
        _text(axes, point + np.array([shift, 0.05]), name, "black")
