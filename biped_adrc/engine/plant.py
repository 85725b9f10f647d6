"""The numbers of a planar robot as run-time arrays: one compilation serves every mass, length and inertia.

What they mean is in `biped_adrc.model.planar`: D, C and G in absolute angles.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import PlanarTree
from biped_adrc.types import Array, ComplexArray


class PlantArrays(NamedTuple):
    """n links; all arrays float64 and contiguous."""

    W_re: Array
    """Re W (n, n) [kg m^2]."""
    W_im: Array
    """Im W (n, n) [kg m^2]."""
    inertia: Array
    """Re W_ii + J_i (n,) [kg m^2]."""
    rotor: Array
    """(n,) [kg m^2]."""
    w_re: Array
    """Re w (n,) [kg m]."""
    w_im: Array
    """Im w (n,) [kg m]."""
    foot_re: Array
    """Re d of the swing foot (n,) [m]."""
    foot_im: Array
    hip_re: Array
    """Re d of the hip (n,) [m]."""
    hip_im: Array
    mass: float
    """Of the robot [kg]."""
    gravity: float
    """[m/s^2]."""


def plant_arrays(biped: Biped, tree: PlanarTree | None = None) -> PlantArrays:
    """Read off a robot. Raises ModelError when it is no planar tree of rigid links."""
    tree = PlanarTree.of(biped) if tree is None else tree
    W, w = tree.W, tree.w

    def parts(z: ComplexArray) -> tuple[Array, Array]:
        return np.ascontiguousarray(z.real), np.ascontiguousarray(z.imag)

    W_re, W_im = parts(W)
    w_re, w_im = parts(w)
    foot_re, foot_im = parts(tree.foot)
    hip_re, hip_im = parts(tree.hip)
    inertia = np.ascontiguousarray(np.diag(W_re) + tree.inertia)
    return PlantArrays(
        W_re,
        W_im,
        inertia,
        np.ascontiguousarray(tree.rotor),
        w_re,
        w_im,
        foot_re,
        foot_im,
        hip_re,
        hip_im,
        tree.total_mass,
        tree.gravity,
    )
