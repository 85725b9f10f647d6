"""What a walk asks of the ground at a tick, with what comes from outside; read by the meter."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from biped_adrc.types import Array


class Outside(NamedTuple):
    """What comes from outside at a tick, forces as (x, z)."""

    force: Array
    """(2,) [N]."""
    impulse: Array
    """Since the last tick (2,) [N s]."""
    drop: float
    """How far this single support ends below its stance foot [m]."""


class LoadedPlant(Protocol):
    """What is asked of a plant for its loads, with forces and points as (x, z).

    `closed_loop.protocols.WalkingPlant` has it.
    """

    def momentum(self, q: Array, v: Array) -> Array:
        """m v_com (2,) [N s]."""

    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """Force of the ground on the stance foot (2,) [N], without forces from outside."""

    def swing_foot(self, q: Array) -> Array:
        """From the stance foot (2,) [m]."""


class Loads(NamedTuple):
    """Of the plant at a tick, forces as (x, z)."""

    momentum: Array
    """m v_com (2,) [N s]."""
    force: Array
    """Of the ground on the stance foot (2,) [N]."""
    foot: Array
    """Swing foot from the stance foot (2,) [m]."""
    outside: Outside


def loads(plant: LoadedPlant, given: Outside, q: Array, v: Array, a: Array) -> Loads:
    """What the plant asks of the ground at q (n,) [rad], v (n,) [rad/s] and q'' = a (n,) [rad/s^2].

    A force from outside is carried in part by what accelerates: the ground carries the rest.
    """
    force = plant.ground_reaction(q, v, a) - given.force
    return Loads(plant.momentum(q, v), force, plant.swing_foot(q), given)
