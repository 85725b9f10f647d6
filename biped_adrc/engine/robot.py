"""A robot's make and its numbers, as generated code takes them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from biped_adrc.engine.mechanics import Structure
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import PlanarTree, PlantArrays

REMEMBERED = 64
"""Robots kept in memory."""


@dataclass(frozen=True)
class Robot:
    """`structure` decides the code, `arrays` are given to it at run time."""

    structure: Structure
    arrays: PlantArrays


_ROBOTS: dict[int, tuple[Biped, Robot]] = {}


def robot_of(biped: Biped) -> Robot:
    """Read off a robot, or remembered. Raises ModelError when it is no planar tree of rigid links."""
    found = _ROBOTS.get(id(biped))
    if found is None or found[0] is not biped:
        while len(_ROBOTS) >= REMEMBERED:
            _ROBOTS.pop(next(iter(_ROBOTS)))
        found = biped, _read(biped)
        _ROBOTS[id(biped)] = found
    return found[1]


def _read(biped: Biped) -> Robot:
    tree = PlanarTree.of(biped)
    arrays = tree.K
    swap: Any = biped.relabelling[: biped.p] if biped.p else np.zeros(0, dtype=int)
    structure = Structure(
        biped.n,
        biped.p,
        tree.A,
        biped.R.astype(int),
        biped.relabel(np.zeros(biped.n)),
        swap,
        tuple(np.asarray(x) != 0.0 for x in arrays),
    )
    return Robot(structure, arrays)
