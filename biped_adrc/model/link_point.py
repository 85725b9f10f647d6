"""A point fixed to a link, in closed form: the generalised force of a force and a moment there.

With a = A q the absolute angles and the point c = sum_i d_i exp(i a_i), written as x + i z from the stance
foot, as in `biped_adrc.model.planar`, and the link's own absolute angle b q,

    zeta = A' [(-Re d o sin a - Im d o cos a) F_x + (Re d o cos a - Im d o sin a) F_z] + b' M

The vectors d are fitted to the positions that Pinocchio's floating model gives, where the fit is exact.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from biped_adrc.errors import ModelError
from biped_adrc.model.biped import Biped
from biped_adrc.model.pinned import frame_index
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
    a = k.A @ q
    c, s = np.cos(a), np.sin(a)
    zeta: Array = ((k.re * c - k.im * s) * f[1] - (k.re * s + k.im * c) * f[0]) @ k.A + k.turn * f[
        2
    ]
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
    n, (_, _, A) = biped.n, biped.pinned.bodies()
    q = np.random.default_rng(1).uniform(-np.pi, np.pi, (2 * n + 3, n))
    turns = np.exp(1j * q @ A.T)
    there = np.array([place(x) for x in q]) @ np.array([1.0, 1.0j])
    d = np.linalg.lstsq(turns, there, rcond=None)[0]
    gap, size = np.max(np.abs(turns @ d - there)), np.max(np.abs(there))
    if not gap <= EXACT * size:
        raise ModelError(
            f"robot '{biped.description.name}': '{name}' is no point of a planar tree; its place is off by "
            f"{gap:.1e} m at random angles, expected less than {EXACT * size:.1e} m"
        )
    re, im = (np.where(np.abs(x) > EXACT * size, x, 0.0) for x in (d.real, d.imag))
    return LinkPoint(np.ascontiguousarray(A), re, im, turn)
