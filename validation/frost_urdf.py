"""URDFs of RABBIT as others write them: links along +z, clockwise angles, right leg first.

Does the import of a URDF depend on who wrote it? In their coordinates r, with q = A r + b, the imported robot
must be the registered one:

    D_r = A' D A,   Omega_r = A' Omega,   A r'+ = Delta q'-

The first writing is FROST's; the others turn the frames of the hips and the axes of the legs. Called by
`validation.groups`; tests of the import use `rabbit_urdf` too.
"""

from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy as np

from biped_adrc.core.types import Array
from biped_adrc.gait.conventions import AngleMap, convention
from biped_adrc.model.biped import Biped
from biped_adrc.model.robot_import.import_robot import biped_from_urdf
from biped_adrc.model.robots.robot_toml import BodyParameters, load_description
from validation.row import Row, nothing

PRESET = "identified-bare"
"""The preset whose masses the URDF has: without rotors, which a URDF cannot say."""
LIMIT = '<limit effort="150"/>'
"""The motors' limit, in each joint [N m]."""
SOURCE = "Biped.load('rabbit'), a URDF with links along -z and angles counter-clockwise"
"""With what the rows compare."""

FROM_FROST: Array = np.eye(5)[[4, 0, 2, 1, 3]]
"""(pitch, hip, knee, hip, knee) of FROST = FROM_FROST @ q of the derived robot, a permutation (5, 5)."""
_FROST = convention("frost").to_paper
TURNED = AngleMap(_FROST.A @ FROM_FROST, _FROST.b)
"""q of the paper from the coordinates of FROST's URDF."""
HUNG = AngleMap(TURNED.A, TURNED.b + TURNED.A @ np.array([math.pi, math.pi, 0.0, 0.0, 0.0]))
"""The same where the frames of the hips are turned by pi: the thighs' zero is another."""


# -- the text --------------------------------------------------------------------------------------
def bodies() -> dict[str, BodyParameters]:
    """Mass [kg], COM [m] and inertia [kg m^2] of torso, thigh and shin."""
    return dict(load_description("rabbit").preset(PRESET).bodies)


def body(name: str, kind: str, lateral: str = "y") -> str:
    """A link with its COM along +z; its moment of inertia about `lateral` is the planar one."""
    p = bodies()[kind]
    moments = {"x": 0.9, "y": 0.8, "z": 0.7} | {lateral: 1.0}
    inertia = " ".join(f'i{a}{a}="{p.inertia * moments[a]!r}"' for a in "xyz")
    return (
        f'<link name="{name}"><inertial><origin xyz="0 0 {p.com}"/><mass value="{p.mass}"/>'
        f'<inertia {inertia} ixy="0" ixz="0" iyz="0"/></inertial></link>\n'
    )


def joint(
    name: str,
    kind: str,
    parent: str,
    child: str,
    axis: str | None = None,
    xyz: str = "0 0 0",
    rpy: str = "0 0 0",
) -> str:
    """A joint with the motor's limit; xyz [m] and rpy [rad] of its frame in the parent's."""
    axis = "" if axis is None else f'<axis xyz="{axis}"/>'
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/>{axis}{LIMIT}</joint>\n'
    )


def rabbit_urdf(
    axis: str = "0 1 0",
    rpy: str = "0 0 0",
    leg_axis: str | None = None,
    lateral: str = "y",
    base: bool = True,
    thigh: float = 0.4,
    shin: float = 0.4,
) -> str:
    """FROST's RABBIT: positive about `axis`, hips turned by rpy [rad], legs about `leg_axis`; lengths [m].

    base: whether the floating base is written as two prismatic joints and a revolute one.
    """
    text = body("torso", "torso")
    if base:
        text += '<link name="world"/><link name="cart"/><link name="lift"/>\n'
        text += joint("BasePosX", "prismatic", "world", "cart", "1 0 0")
        text += joint("BasePosZ", "prismatic", "cart", "lift", "0 0 1")
        text += joint("BaseRotY", "continuous", "lift", "torso", axis)
    leg_axis = axis if leg_axis is None else leg_axis
    for side in ("right", "left"):
        text += body(f"{side}_thigh", "thigh", lateral=lateral)
        text += body(f"{side}_shin", "shin", lateral=lateral) + f'<link name="{side}_toe"/>\n'
        text += joint(f"q1_{side}", "continuous", "torso", f"{side}_thigh", leg_axis, rpy=rpy)
        text += joint(
            f"q2_{side}", "revolute", f"{side}_thigh", f"{side}_shin", leg_axis, f"0 0 {thigh}"
        )
        text += joint(f"{side}_end", "fixed", f"{side}_shin", f"{side}_toe", xyz=f"0 0 {shin}")
    return f'<?xml version="1.0"?>\n<robot name="frost_rabbit">\n{text}</robot>\n'


# -- rows ------------------------------------------------------------------------------------------
def sense_rows(states: int = 20) -> tuple[Row, ...]:
    """D, Omega and the impact of three writings at random states, as shares of their largest entries.

    Each writing is imported, and its coordinates r are mapped to q by a known A and b.
    """
    writings = {
        "links along +z, clockwise": (rabbit_urdf(), TURNED),
        "hips turned by pi about y": (rabbit_urdf(rpy=f"0 {math.pi!r} 0"), HUNG),
        "legs about x, frames turned by pi/2": (
            rabbit_urdf(rpy=f"0 0 {math.pi / 2!r}", leg_axis="1 0 0", lateral="x"),
            TURNED,
        ),
    }
    rows = []
    for name, (text, to_paper) in writings.items():
        gaps = _gaps(text, to_paper, states)
        for quantity, gap in zip(("D", "Omega", "rates after impact"), gaps, strict=True):
            said = f"{quantity}, {states} random states: largest relative gap"
            rows.append(nothing(f"RABBIT, {name}", said, gap, 1e-10, SOURCE))
    return tuple(rows)


def _gaps(text: str, to_paper: AngleMap, states: int) -> Array:
    """Largest gaps (3,) of D, Omega and v+ to those of RABBIT, each as a share of its largest entry."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "rabbit.urdf"
        path.write_text(text, encoding="utf-8")
        own, paper = biped_from_urdf(path), Biped.load("rabbit", PRESET)
    A, random, worst = to_paper.A, np.random.default_rng(4), np.zeros(3)
    for _ in range(states):
        q, v = random.uniform(-math.pi, math.pi, 5), random.normal(0.0, 3.0, 5)
        Q, V = to_paper.angles(q), to_paper.rates(v)
        pairs = (
            (own.inertia(q), A.T @ paper.inertia(Q) @ A),
            (own.bias(q, v), A.T @ paper.bias(Q, V)),
            (to_paper.rates(own.impact(q, v).v), paper.impact(Q, V).v),
        )
        gaps = [float(np.max(np.abs(x - y)) / np.max(np.abs(y))) for x, y in pairs]
        worst = np.maximum(worst, gaps)
    return worst
