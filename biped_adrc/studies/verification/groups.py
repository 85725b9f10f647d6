"""The groups of the verification, each with what it says and the functions that make its rows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from biped_adrc.errors import InputError
from biped_adrc.resources import packaged
from biped_adrc.studies.verification.frost_urdf import sense_rows
from biped_adrc.studies.verification.gaits import (
    PRESETS,
    ROBOTS,
    invariant_gaits,
    multiplier_rows,
    robot_rows,
    work_rows,
)
from biped_adrc.studies.verification.passive import (
    ball_rows,
    compass_rows,
    heavy_feet_rows,
    short_step_rows,
    simplest_rows,
    wheel_rows,
)
from biped_adrc.studies.verification.rabbit import (
    SPEEDS,
    design_rows,
    designed_rows,
    fixed_point_rows,
    hip_rows,
    poles_row,
    printed_rows,
    published_force_rows,
    through_rows,
)
from biped_adrc.studies.verification.row import Row
from biped_adrc.studies.verification.three_link import three_link_rows

Maker = Callable[[], tuple[Row, ...]]


@dataclass(frozen=True)
class Group:
    """`text` is Markdown; `makers` give the rows, part by part."""

    name: str
    title: str
    text: str
    makers: tuple[Maker, ...]


def groups() -> tuple[Group, ...]:
    """All of them, in the order of the page."""
    passive = (
        ball_rows,
        wheel_rows,
        simplest_rows,
        short_step_rows,
        heavy_feet_rows,
        compass_rows,
    )
    fixed_points = tuple(partial(fixed_point_rows, preset) for preset in PRESETS)
    works = tuple(partial(work_rows, preset) for preset in PRESETS)
    multipliers = tuple(
        partial(multiplier_rows, preset, gait)
        for preset in PRESETS
        for gait in invariant_gaits(preset)
    )
    robots = tuple(partial(robot_rows, robot) for robot in ROBOTS)
    designed = tuple(
        partial(design_rows, preset, speed)
        for preset in ("identified", "tac2003")
        for speed in SPEEDS
    )
    example = (printed_rows, designed_rows, partial(designed_rows, 0.4))
    pushed = tuple(partial(hip_rows, tracking) for tracking in ("NPD", "ADRC"))
    through = tuple(partial(through_rows, preset) for preset in ("identified", "tac2003"))
    makers: dict[str, tuple[Maker, ...]] = {
        "passive": passive,
        "three-link": (three_link_rows,),
        "tac2003": example,
        "paper": (poles_row, *fixed_points),
        "work": works,
        "multipliers": multipliers,
        "robots": robots,
        "design": (*designed, *through),
        "hip": (published_force_rows, *pushed),
        "senses": (sense_rows,),
    }
    texts = packaged("biped_adrc.studies.verification", "groups.toml")
    return tuple(Group(n, **said, makers=makers[n]) for n, said in texts.items())


def group_named(name: str) -> Group:
    """Raises InputError with the names there are."""
    found = {group.name: group for group in groups()}
    if name not in found:
        raise InputError(f"there is no group '{name}'; choose one of {list(found)}")
    return found[name]
