"""A robot from one URDF: everything the record of a robot says, derived and checked.

    derived = derive("walker.urdf")
    derived.biped    the Biped, with the masses of the URDF as its preset "urdf"
    derived.said     what was guessed, in sentences
    derived.checks   the laws it was checked against, with their numbers

The URDF describes a planar biped with point feet: revolute joints about y, equal legs, each with a link at its
tip. Frames may be turned, angles may run either way; q keeps the file's zeros and senses. The section of
the return map is foot strike, the height of the swing foot, which follows from the feet.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from biped_adrc.checks import Check
from biped_adrc.errors import ModelError, OutputError
from biped_adrc.files import write_text
from biped_adrc.model.anatomy import anatomy
from biped_adrc.model.biped import Biped
from biped_adrc.model.legs import check_alike
from biped_adrc.model.own_checks import checks
from biped_adrc.model.planar_base import on_planar_base
from biped_adrc.model.reading import Reading, read, tip_of
from biped_adrc.model.record import FRICTION, PRESET, Hints, record_of, to_toml
from biped_adrc.model.robots import description_of
from biped_adrc.model.sticks import drawable
from biped_adrc.model.urdf import Joint, to_xml


@dataclass(frozen=True)
class Derived:
    """A biped derived from a URDF, and how."""

    biped: Biped
    said: tuple[str, ...]
    checks: tuple[Check, ...]
    record: Mapping[str, Any]
    """As in a robot.toml."""

    @property
    def broken(self) -> tuple[Check, ...]:
        """Checks that do not hold."""
        return tuple(check for check in self.checks if not check.holds)

    def write(self, folder: Path | str) -> Path:
        """Write floating.urdf and robot.toml for `Biped.load`; the path of robot.toml.

        Raises OutputError where one of them exists already or cannot be written.
        """
        folder = Path(folder)
        urdf, record = folder / "floating.urdf", folder / "robot.toml"
        for path in (urdf, record):
            if path.exists():
                raise OutputError(f"'{path}' exists already; give a new folder, or remove it first")
        write_text(urdf, to_xml(self.biped.tree))
        write_text(record, to_toml({**self.record, "urdf": urdf.name}))
        return record


def biped_from_urdf(
    path: Path | str,
    feet: tuple[str, str] | None = None,
    actuated: tuple[str, ...] | None = None,
    hip: str | None = None,
    torque: float | None = None,
    armature: float = 0.0,
    tip: tuple[float, float, float] | None = None,
) -> Biped:
    """The Biped of a URDF, once every check holds; see `Hints` for the options and `derive` for the rest.

    Raises ModelError.
    """
    derived = derive(path, Hints(feet, actuated, hip, torque, armature=armature, tip=tip))
    if derived.broken:
        broken = "; ".join(str(check) for check in derived.broken)
        raise ModelError(f"URDF '{path}': {broken}")
    return derived.biped


def derive(path: Path | str, hints: Hints | None = None) -> Derived:
    """Derive and check a biped from a URDF.

    Raises ModelError that names the link, joint or file, and what to give or to change.
    """
    hints = Hints() if hints is None else hints
    reading, feet = _with_tips(path, hints)
    body = on_planar_base(reading.tree)
    parts = anatomy(body, feet, hints.hip)
    tree, said_shapes = drawable(body.tree, parts.feet)
    actuated, said_motors = _motors(reading, parts.moving, hints)
    check_alike(body.tree, parts.feet, body.pitch, actuated)
    torque, said_torque = _torque(reading, actuated, hints)
    record = record_of(reading, body, parts, actuated, torque, hints)
    description = description_of(record, Path(path))
    biped = Biped(description, tree, PRESET, hints.armature)
    biped.check()
    said = (
        *body.said,
        *parts.said,
        *said_motors,
        *said_torque,
        *said_shapes,
        *_remarks(reading, hints),
    )
    return Derived(biped, said, checks(biped), record)


def _with_tips(path: Path | str, hints: Hints) -> tuple[Reading, tuple[str, ...] | None]:
    """The URDF, and the feet: those of the hints, or links put at their tips."""
    if hints.tip is None:
        return read(path), hints.feet
    if hints.feet is None or not all(map(math.isfinite, hints.tip)):
        raise ModelError(
            f"URDF '{path}': feet at {hints.tip} m of links {hints.feet}; expected three finite numbers, and "
            "the links by feet=(...) or --feet"
        )
    return read(path, dict.fromkeys(hints.feet, hints.tip)), tuple(map(tip_of, hints.feet))


# -- motors ----------------------------------------------------------------------------------------
def _motors(
    reading: Reading, moving: tuple[Joint, ...], hints: Hints
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    names = tuple(joint.name for joint in moving)
    if hints.actuated is None:
        found = tuple(name for name in names if reading.effort.get(name) != 0.0)
        free = ", ".join(f"'{name}'" for name in names if name not in found)
        motors = ", ".join(f"q{i + 1} = '{name}'" for i, name in enumerate(found)) or "none"
        return found, (f"motors: {motors}" + (f"; {free} free (effort 0)" if free else ""),)
    for name in hints.actuated:
        if name not in names or hints.actuated.count(name) > 1:
            raise ModelError(
                f"URDF '{reading.tree.source}': motors {list(hints.actuated)}, expected each at most once and "
                f"from {list(names)}"
            )
    return hints.actuated, ()


def _torque(
    reading: Reading, actuated: tuple[str, ...], hints: Hints
) -> tuple[float, tuple[str, ...]]:
    """The torque limit of all motors [N m]; 1 where there is none, as a record asks for a number."""
    if hints.torque is not None or not actuated:
        return (1.0 if hints.torque is None else hints.torque), ()
    without = [name for name in actuated if not reading.effort.get(name, 0.0) > 0.0]
    if without:
        raise ModelError(
            f"URDF '{reading.tree.source}': motors {without} have no torque limit; write "
            '<limit effort="..."/> into the joints, or give torque=... [N m] or --torque'
        )
    efforts = {name: reading.effort[name] for name in actuated}
    least = min(efforts.values())
    which = "every motor" if least == max(efforts.values()) else f"the weakest of {efforts}"
    return least, (f"torque limit: {least:g} N m, of {which}",)


def _remarks(reading: Reading, hints: Hints) -> tuple[str, ...]:
    found = []
    if hints.friction_coefficient is None:
        found.append(f"dry friction of the feet: {FRICTION}, as of RABBIT; a URDF does not say")
    if hints.armature == 0.0:
        found.append("rotor inertia: none; a URDF does not say")
    if any(reading.viscous.values()) or any(reading.static.values()):
        found.append("joint friction: read from <dynamics>, off unless asked for")
    if reading.flat:
        found.append(
            f"moments about x and z of {list(reading.flat)}: those of slender links; the URDF has none, and "
            "planar motion needs none"
        )
    if reading.undrawn:
        found.append(
            f"shapes of {list(reading.undrawn)} are meshes or stand oblique, and are not drawn"
        )
    return tuple(found)
