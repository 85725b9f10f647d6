"""Points of a planar robot in closed form, and forces that act there.

a = A q (n,) are the absolute angles of the n links, counter-clockwise with x to the right and z up, zero for a
link that points up; q (n,) are the coordinates q_s of `Biped`. The place x + i z of every point fixed to the
robot, as a complex number [m] from the stance foot, is a sum of turned vectors with constant complex numbers d
(n,) [m], one number per link:

    x + i z = sum_i d_i exp(i a_i)

The vectors d are fitted to Pinocchio's own positions; the fit is exact but for round-off. Re d and Im d are
passed as two arrays, re and im. The functions take numbers and object arrays of symbols alike: NumPy asks each
symbol for its `cos` and `sin`. `planar_robot` has the dynamics.

`wrench_torque` is the generalised force zeta (n,) [N m] of a force and a moment at a point fixed to a link, for
disturbances: with J(q) (2, n) the Jacobian of the point, and b (n,) that of the link's own absolute angle,

    zeta = J^T (F_x, F_z) + b^T M
"""

from collections.abc import Callable
from typing import Generic, NamedTuple, TypeVar

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array, ComplexArray, Indices
from biped_adrc.model.biped import Biped
from biped_adrc.model.pinned import frame_index

Numbers = TypeVar("Numbers", Array, NDArray[np.object_])
"""Arrays of numbers, or of symbols; a function returns the kind that it takes."""


def per_link(z: ComplexArray) -> tuple[Array, Array]:
    """Real and imaginary part of z, the vectors d of a point with one number per link; contiguous copies, as
    compiled code expects them.
    """
    return np.ascontiguousarray(z.real), np.ascontiguousarray(z.imag)


def fitted(A: Array, places: Callable[[Array], Array], exact: float) -> ComplexArray:
    """Fit the vectors d (points, n) [m] of points fixed to links, by least squares over 3 n + 3 random q.

    A is the matrix of the absolute angles (n, n); `places` maps q (n,) [rad] to the positions (points, 2) [m],
    or (2,) for one point. Parts of d below `exact` times the largest distance of a place from the origin, or
    times 1 m where it is smaller, are round-off and set to 0.
    """
    n = len(A)
    q = np.random.default_rng(1).uniform(-np.pi, np.pi, (3 * n + 3, n))
    turns = np.exp(1j * q @ A.T)  # exp(i a), a row for each q
    # x + i z [m], (3 n + 3, points)
    there = np.array([np.atleast_2d(places(x)) for x in q]) @ np.array([1.0, 1.0j])
    d = np.linalg.lstsq(turns, there, rcond=None)[0]
    least = exact * max(1.0, float(np.max(np.abs(there))))
    re, im = (np.where(np.abs(x) < least, 0.0, x) for x in (d.real, d.imag))
    return np.asarray((re + 1j * im).T)


# -- laws, for numbers and symbols -----------------------------------------------------------------
class Turned(NamedTuple, Generic[Numbers]):
    """Cosines c and sines s of the absolute angles a, each (n,), dimensionless."""

    c: Numbers
    s: Numbers


def turned(A: Indices | Array, q: Numbers) -> Turned[Numbers]:
    """cos and sin of a = A q, with A (n, n), at the angles q (n,) [rad]."""
    a = A @ q
    return Turned(np.cos(a), np.sin(a))


def point(t: Turned[Numbers], re: Array, im: Array) -> tuple[Numbers, Numbers]:
    """Position (x, z) [m] of a point from the stance foot, from its vectors d = re + i im (n,) [m]: the real
    and the imaginary part of sum_i d_i exp(i a_i).
    """
    return re @ t.c - im @ t.s, im @ t.c + re @ t.s


def jacobian(A: Indices | Array, t: Turned[Numbers], re: Array, im: Array) -> Numbers:
    """Jacobian d(x, z)/dq (2, n) [m] of a point with vectors d = re + i im (n,) [m]; A (n, n): of `turned`."""
    return np.array([A.T @ (-(re * t.s) - im * t.c), A.T @ (re * t.c - im * t.s)])


class LinkPoint(NamedTuple):
    """Constants of the closed form, in q (n,), of a point fixed to a link; all float64, for compiled code."""

    A: Array
    """Matrix of the absolute angles a = A q (n, n)."""
    re: Array
    """Re d (n,) [m]."""
    im: Array
    """Im d (n,) [m]."""
    turn: Array
    """b (n,), dimensionless: the derivative of the link's absolute angle with respect to q."""


def wrench_torque(k: LinkPoint, q: Array, f: Array) -> Array:
    """Generalised force zeta (n,) [N m] of the force and moment f = (F_x, F_z, M) (3,) [N, N, N m] that act at
    the point k, at q (n,) [rad].

    F is in the axes of the world. M is counter-clockwise with x to the right and z up.
    """
    return f[:2] @ jacobian(k.A, turned(k.A, q), k.re, k.im) + k.turn * f[2]


def link_point(biped: Biped, link: str, at: tuple[float, float] | None = None) -> LinkPoint:
    """The point at = (x, z) [m] in the frame of `link`, in closed form; None is the link's origin.

    Raises ModelError for a link that the robot does not have, or that does not move with its coordinates.
    """
    f, x_z = biped.floating, at or (0.0, 0.0)
    known = biped.tree.links_from(biped.description.trunk)
    if link not in known:
        raise ModelError(
            f"robot '{biped.description.name}' has no link '{link}' that moves with its coordinates; it has "
            f"{known}"
        )
    frame = frame_index(f.model, link)

    def place(q: Array) -> Array:
        """Position (x, z) (2,) [m] of the point x_z of the frame from the stance foot, at q (n,) [rad], by
        Pinocchio on the floating model f.
        """
        pin.framesForwardKinematics(f.model, f.data, f.configuration(q))
        return np.asarray(f.data.oMf[frame].act(np.array([x_z[0], 0.0, x_z[1]])))[[0, 2]]

    # any angles: the turn of a link in the plane does not depend on them. Row 4 is the turn about y, which
    # points into the plane: minus makes it counter-clockwise
    zero = f.configuration(np.zeros(biped.n))
    J = pin.computeFrameJacobian(f.model, f.data, zero, frame, pin.LOCAL_WORLD_ALIGNED)
    return _fitted(biped, place, np.ascontiguousarray(-J[4, f.angles]))


def hip_point(biped: Biped) -> LinkPoint:
    """The hip as a point in closed form; of no link, so its b is 0 and `wrench_torque` ignores a moment."""
    return _fitted(biped, biped.hip, np.zeros(biped.n))


def _fitted(biped: Biped, place: Callable[[Array], Array], turn: Array) -> LinkPoint:
    """Fit a `LinkPoint` to its place (x, z) [m] as a function of q (n,) [rad]; turn: b (n,) of its link."""
    _, _, A = biped.pinned.bodies()
    # parts of d below 1e-10 of the point's largest distance from the stance foot are round-off
    (d,) = fitted(A, place, 1e-10)
    return LinkPoint(np.ascontiguousarray(A), *per_link(d), turn)
