"""The record of a robot derived from its URDF, in the words of a robot.toml, and as TOML.

`tomllib` reads and does not write. Strings, numbers, lists and tables are all a record holds, and JSON's
strings are basic strings of TOML.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from biped_adrc.model.anatomy import Anatomy
from biped_adrc.model.legs import pairs
from biped_adrc.model.planar_base import PlanarBase
from biped_adrc.model.reading import Reading
from biped_adrc.model.robots import GRAVITY
from biped_adrc.model.urdf import Tree

PRESET = "urdf"
FRICTION = 0.6
"""Dry friction of the feet where none is given: RABBIT's, dimensionless."""

_SIDES = re.compile(r"(^|[_-])(left|right|l|r)(?=$|[_-])", re.IGNORECASE)


@dataclass(frozen=True)
class Hints:
    """What a URDF does not say; None is guessed where there is one answer.

    feet: links of the stance and the swing foot. actuated: joints with a motor, q1, q2, ... in order. hip:
    link whose origin is the hip. torque [N m]: limit of a motor. friction_coefficient: of the feet. armature
    [kg m^2]: rotor inertia per motor, reflected to the joint. gravity [m/s^2]. tip [m]: place of the feet
    in the frames of the links `feet`, for a URDF that ends with its shins.
    """

    feet: tuple[str, ...] | None = None
    actuated: tuple[str, ...] | None = None
    hip: str | None = None
    torque: float | None = None
    friction_coefficient: float | None = None
    armature: float = 0.0
    gravity: float = GRAVITY
    tip: tuple[float, float, float] | None = None


def record_of(
    reading: Reading,
    body: PlanarBase,
    parts: Anatomy,
    actuated: tuple[str, ...],
    torque: float,
    hints: Hints,
) -> dict[str, Any]:
    """What a robot.toml says of it."""
    moving = [joint.name for joint in parts.moving]
    friction = FRICTION if hints.friction_coefficient is None else hints.friction_coefficient
    source = f"The <inertial> elements of {Path(reading.tree.source).name}."
    return {
        "name": reading.tree.name,
        "urdf": Path(reading.tree.source).name,
        "default_preset": PRESET,
        "actuated": list(actuated),
        "passive": [name for name in moving if name not in actuated],
        "unactuated": body.pitch,
        "base": list(body.base),
        "stance_foot": parts.feet[0],
        "swing_foot": parts.feet[1],
        "hip": parts.hip,
        "trunk": body.trunk,
        "phase": list(parts.phase),
        "peak_torque": torque,
        "friction_coefficient": friction,
        "gravity": hints.gravity,
        "ranges": {name: list(reading.ranges[name]) for name in moving if name in reading.ranges},
        "friction": {
            kind: {name: values[name] for name in moving if name in values}
            for kind, values in (("viscous", reading.viscous), ("static", reading.static))
        },
        "links": _bodies(body.tree, parts.feet),
        "presets": {PRESET: {"source": source, "armature": hints.armature}},
    }


def _bodies(tree: Tree, feet: tuple[str, str]) -> dict[str, list[str]]:
    """Links with mass by body: twins together, under their name without the side."""
    twins = dict(pairs(tree, feet))
    heavy = [name for name, link in tree.links.items() if link.inertial is not None]
    bodies: dict[str, list[str]] = {}
    for link in heavy:
        if link in twins.values():
            continue
        group = [link, twins[link]] if link in twins else [link]
        name = _SIDES.sub("", link).strip("_-") if link in twins else link
        taken = not name or name in bodies or (name in heavy and name not in group)
        bodies[link if taken else name] = group
    return bodies


def to_toml(record: Mapping[str, Any]) -> str:
    """TOML text of `record`: its values first, then its tables; empty tables are left out."""
    return "\n".join(_lines(record, ())).strip() + "\n"


def _lines(table: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    values = {key: value for key, value in table.items() if not isinstance(value, Mapping)}
    tables = {key: value for key, value in table.items() if isinstance(value, Mapping)}
    if path and values:
        yield f"\n[{'.'.join(_key(part) for part in path)}]"
    yield from (f"{_key(key)} = {_value(value)}" for key, value in values.items())
    for key, value in tables.items():
        yield from _lines(value, (*path, key))


def _key(key: str) -> str:
    bare = key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return key if bare else json.dumps(key, ensure_ascii=False)


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(_value(item) for item in value)}]"
    return json.dumps(value, ensure_ascii=False)
