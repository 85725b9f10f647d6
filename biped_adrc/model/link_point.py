"""A point fixed to a link, in closed form: the generalised force of a force and a moment there.

With J(q) the Jacobian of the point, a sum of turned vectors as in `biped_adrc.model.planar`, and the link's own
absolute angle b q,

    zeta = J' (F_x, F_z) + b' M
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from biped_adrc.errors import ModelError
from biped_adrc.model.biped import Biped
from biped_adrc.model.pinned import frame_index
from biped_adrc.model.planar import fitted, jacobian, turned
from biped_adrc.types import Array

EXACT = 1e-10
"""Largest gap of the fit, relative to the farthest place of the point."""


class LinkPoint(NamedTuple):
    """n coordinates; all arrays float64."""

    A: Array
    """(n, n), a = A q."""
    re: Array
    """Re d (n,) [m]."""
    im: Array
    """Im d (n,) [m]."""
    turn: Array
    """b (n,): rate of the link's absolute angle per rate of the coordinates."""


def wrench_torque(k: LinkPoint, q: Array, f: Array) -> Array:
    """zeta (n,) [N m] of f = (F_x, F_z, M) [N, N, N m], M counter-clockwise with x to the right and z up."""
    zeta: Array = f[:2] @ jacobian(k, turned(k, q), k.re, k.im) + k.turn * f[2]
    return zeta


def link_point(biped: Biped, link: str, at: tuple[float, float] | None = None) -> LinkPoint:
    """The point `at` (x, z) [m] in the frame of `link`, its origin without.

    Raises ModelError for a link that the robot has not, or that does not move with its coordinates.
    """
    f, x_z = biped.floating, at or (0.0, 0.0)
    try:
        frame = frame_index(f.model, link)
    except ModelError:
        known = [name for name in biped.tree.links if _moves(biped, name)]
        raise ModelError(
            f"robot '{biped.description.name}' has no link '{link}'; it has {known}"
        ) from None
    if not _moves(biped, link):
        raise ModelError(
            f"robot '{biped.description.name}': link '{link}' is above the trunk "
            f"'{biped.description.trunk}' and part of the base, no body; give the trunk instead"
        )

    def place(q: Array) -> Array:
        pin.framesForwardKinematics(f.model, f.data, f.configuration(q))
        return np.asarray(f.data.oMf[frame].act(np.array([x_z[0], 0.0, x_z[1]])))[[0, 2]]

    zero = f.configuration(np.zeros(biped.n))
    J = pin.computeFrameJacobian(f.model, f.data, zero, frame, pin.LOCAL_WORLD_ALIGNED)
    return _fitted(biped, place, np.ascontiguousarray(-J[4, f.angles]), link)


def hip_point(biped: Biped) -> LinkPoint:
    """The hip, with no turn."""
    return _fitted(biped, biped.hip, np.zeros(biped.n), "hip")


def _moves(biped: Biped, link: str) -> bool:
    return biped.tree.path_below(link, biped.description.trunk) is not None


def _fitted(biped: Biped, place: Callable[[Array], Array], turn: Array, name: str) -> LinkPoint:
    """d of a point whose place (x, z) is a function of q. Raises ModelError where the fit is not exact."""
    _, _, A = biped.pinned.bodies()
    (d,), gap, size = fitted(A, place, EXACT)
    if not gap <= EXACT * size:
        raise ModelError(
            f"robot '{biped.description.name}': '{name}' is no point of a planar tree; its place is off by "
            f"{gap:.1e} m at random angles, expected less than {EXACT * size:.1e} m"
        )
    A, re, im = map(np.ascontiguousarray, (A, d.real, d.imag))
    return LinkPoint(A, re, im, turn)
