"""The planar robot's equations for symbols, with the numbers of `PlantArrays`: impact and what the meter sees.

In double support q_e = (q_s, p_e), and with J_m the row of m p_com

    D_e = (D_s, J_m'; J_m, m 1),   E_2 = (J_2, 1)                    (2), (4)

and after the plastic impact (7) the swing foot stands, q_e+' = N q+' with N = (1; -J_2), E_2 N = 0. N' takes
the impulse F_2 out of (7):

    N' D_e N q+' = N' D_e (q-'; 0) = (D_s - J_2' J_m) q-'

N' D_e N is the inertia about the swing foot; D_e itself is singular for a robot whose mass is in one point.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from biped_adrc.engine.symbols import solve_positive
from biped_adrc.hardware.meter import Loads
from biped_adrc.model.planar import (
    PlantArrays,
    gravity_and_turning,
    ground_reaction,
    inertia_and_bias,
    jacobian,
    point,
    turned,
)
from biped_adrc.model.reduction import BodyTerms
from biped_adrc.types import Array


class Structure(NamedTuple):
    """What is no number of a robot but its make: links, signs, and which terms there are."""

    n: int
    p: int
    A: NDArray[np.int_]
    """a = A q (n, n)."""
    R: NDArray[np.int_]
    """Relabelling at impact (n, n)."""
    offset: Array
    """Relabelling at impact (n,) [rad]."""
    swap: NDArray[np.int_]
    """Relabelling of the actuated joints (p,)."""
    present: tuple[Any, ...]
    """Which of the numbers of `PlantArrays` are not zero by make, arrays of bool."""


def without_zeros(robot: Structure, K: PlantArrays) -> PlantArrays:
    """The numbers with a plain 0 for those that are zero by make, whose terms then vanish."""
    pairs: Any = zip(K, robot.present, strict=True)
    kept: Any = [np.where(mask, x, 0.0) if mask.ndim else x for x, mask in pairs]
    return PlantArrays(*kept)


def body_terms(robot: Structure, K: PlantArrays, q: Any, v: Any) -> BodyTerms:
    """G, C' q' = dT/dq, and the force of the ground as F_a q'' + F_0."""
    F_0 = ground_reaction(robot, K, q, v, np.full(robot.n, 0.0, dtype=object))
    t = turned(robot, q)
    F_a = jacobian(robot, t, K.w_re, K.w_im)
    return BodyTerms(*gravity_and_turning(robot, K, t, v), F_a, F_0)


def momentum(robot: Structure, K: PlantArrays, q: Any, v: Any) -> Any:
    """m p_com' (2,) [N s]."""
    return jacobian(robot, turned(robot, q), K.w_re, K.w_im) @ v


def loads(robot: Structure, K: PlantArrays, q: Any, v: Any, a: Any, outside: Any) -> Loads:
    """What the meter looks at, for q'' = a; outside (5,): force [N], impulse [N s], drop of the ground [m]."""
    t = turned(robot, q)
    force = ground_reaction(robot, K, q, v, a) - outside[:2]
    foot = np.array(point(t, K.foot_re, K.foot_im))
    return Loads(momentum(robot, K, q, v), force, outside[2:4], outside[:2], foot, outside[4])


def impact(robot: Structure, K: PlantArrays, q: Any, v: Any) -> tuple[Any, Any, Any]:
    """(q, q')+ of (8), relabelled, and the impulse F_2 (2,) [N s], by the rows of p_e of (7)."""
    t = turned(robot, q)
    D, _ = inertia_and_bias(robot, K, q, v)
    J_m = jacobian(robot, t, K.w_re, K.w_im)
    J_2 = jacobian(robot, t, K.foot_re, K.foot_im)
    before = D - J_2.T @ J_m
    after = before - J_m.T @ J_2 + K.mass * (J_2.T @ J_2)
    v_plus = solve_positive(after, before @ v, "N' D_e N")
    F_2 = J_m @ (v_plus - v) - K.mass * (J_2 @ v_plus)
    return robot.R @ q + robot.offset, robot.R @ v_plus, F_2
