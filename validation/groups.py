"""The groups of the verification, and the functions that make their rows.

Each maker takes seconds to minutes and is independent of the others, so that tests can distribute them. What
each group asks is on the page docs/verification.md.

Groups: passive walkers, the three-link walker, the example of 2003, the paper, laws of work and of multipliers
on stored gaits, all robots, gait design, the force on the hip, RABBIT in other coordinates ("senses"), and the
law of one joint by other tools.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from biped_adrc.core.errors import InputError
from biped_adrc.paper.scenarios import CONTROLLERS
from validation import frost_urdf, gaits, other_tools, passive, rabbit, three_link
from validation.row import PRESETS, Row

DESIGNED = ("identified", "tac2003")
"""Presets for which gaits are designed."""
Maker = Callable[[], tuple[Row, ...]]
"""A function that computes rows."""


@dataclass(frozen=True)
class Group:
    """One group of rows."""

    name: str
    """By which it is asked for."""
    makers: tuple[Maker, ...]
    """They give the rows, part by part."""


def groups() -> tuple[Group, ...]:
    """All of them, in the order of the table."""
    speeds = [(preset, speed) for preset in DESIGNED for speed in rabbit.SPEEDS]
    stored = [(preset, gait) for preset in PRESETS for gait in gaits.invariant_gaits(preset)]
    walkers = ("ball", "wheel", "simplest", "short_step", "heavy_feet", "compass")
    makers: dict[str, tuple[Maker, ...]] = {
        "passive": tuple(getattr(passive, f"{name}_rows") for name in walkers),
        "three-link": (three_link.three_link_rows,),
        "tac2003": (rabbit.printed_rows, *(partial(rabbit.designed_rows, L) for L in (None, 0.4))),
        "paper": (
            rabbit.poles_row,
            *(partial(rabbit.fixed_point_rows, preset) for preset in PRESETS),
        ),
        "work": tuple(partial(gaits.work_rows, preset) for preset in PRESETS),
        "multipliers": tuple(partial(gaits.multiplier_rows, *pair) for pair in stored),
        "robots": tuple(partial(gaits.robot_rows, robot) for robot in gaits.ROBOTS),
        "design": (
            *(partial(rabbit.design_rows, *pair) for pair in speeds),
            *(partial(rabbit.through_rows, preset) for preset in DESIGNED),
        ),
        "hip": (
            rabbit.published_force_rows,
            *(partial(rabbit.hip_rows, c) for c in CONTROLLERS),
        ),
        "senses": (frost_urdf.sense_rows,),
        "other tools": (other_tools.pyadrc_rows, other_tools.control_rows),
    }
    return tuple(Group(name, parts) for name, parts in makers.items())


def group_named(name: str) -> Group:
    """The group of this name. Raises InputError with the names there are."""
    found = {group.name: group for group in groups()}
    if name not in found:
        raise InputError(f"there is no group '{name}'; choose one of {list(found)}")
    return found[name]
