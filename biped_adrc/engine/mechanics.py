"""The planar robot's equations for symbols, in absolute angles, with the numbers of `PlantArrays`.

With a = A q, c = cos a, s = sin a, C_ij = cos(a_j - a_i) = c_i c_j + s_i s_j and S_ij = sin(a_j - a_i):

    D = Re W o C - Im W o S + diag J,   Omega = -(Re W o S + Im W o C) a'^2 + g Re(w exp(i a))

taken to the coordinates by A. In double support q_e = (q_s, p_e), and with J_m the row of m p_com

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

from biped_adrc.engine.plant import PlantArrays
from biped_adrc.engine.symbols import cos, sin, solve_positive
from biped_adrc.hardware.meter import Loads
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


class Turned(NamedTuple):
    """Cosines and sines of the absolute angles, (n,)."""

    c: Any
    s: Any


def turned(robot: Structure, q: Any) -> Turned:
    """At the angles q (n,)."""
    a = robot.A @ q
    return Turned(cos(a), sin(a))


def inertia_and_bias(robot: Structure, K: PlantArrays, q: Any, v: Any) -> tuple[Any, Any]:
    """D_s (n, n) and Omega (n,)."""
    t, A, rate2 = turned(robot, q), robot.A, (robot.A @ v) ** 2
    off = 1.0 - np.eye(robot.n)
    C = (np.outer(t.c, t.c) + np.outer(t.s, t.s)) * off
    S = (np.outer(t.c, t.s) - np.outer(t.s, t.c)) * off
    D = K.W_re * C - K.W_im * S
    for i in range(robot.n):
        D[i, i] = K.inertia[i]
    spin = K.W_re * S + K.W_im * C
    Omega = K.gravity * (K.w_re * t.c - K.w_im * t.s) - spin @ rate2
    D_s = A.T @ D @ A
    for i in range(robot.n):
        D_s[i, i] = D_s[i, i] + K.rotor[i]
    for i in range(robot.n):
        for j in range(i):
            D_s[i, j] = D_s[j, i]
    return D_s, A.T @ Omega


def body_terms(robot: Structure, K: PlantArrays, q: Any, v: Any) -> BodyTerms:
    """G, C' q' = dT/dq, and the force of the ground as F_a q'' + F_0."""
    t, A, rate = turned(robot, q), robot.A, robot.A @ v
    off = 1.0 - np.eye(robot.n)
    C = (np.outer(t.c, t.c) + np.outer(t.s, t.s)) * off
    S = (np.outer(t.c, t.s) - np.outer(t.s, t.c)) * off
    turning = A.T @ (rate * ((K.W_re * S + K.W_im * C) @ rate))
    G = A.T @ (K.gravity * (K.w_re * t.c - K.w_im * t.s))
    F_0 = ground_reaction(robot, K, q, v, np.full(robot.n, 0.0, dtype=object))
    return BodyTerms(G, turning, jacobian(robot, t, K.w_re, K.w_im), F_0)


def point(t: Turned, re: Any, im: Any) -> tuple[Any, Any]:
    """(x, z) [m] of a point, from its vectors."""
    return re @ t.c - im @ t.s, im @ t.c + re @ t.s


def jacobian(robot: Structure, t: Turned, re: Any, im: Any) -> Any:
    """d(x, z)/dq (2, n)."""
    rows = [-(re * t.s) - im * t.c, re * t.c - im * t.s]
    return np.array([robot.A.T @ row for row in rows], dtype=object)


def ground_reaction(robot: Structure, K: PlantArrays, q: Any, v: Any, a: Any) -> Any:
    """(F_T, F_N) [N] of the ground on the stance foot: m (p_com'' - g)."""
    t, rate2 = turned(robot, q), (robot.A @ v) ** 2
    J = jacobian(robot, t, K.w_re, K.w_im)
    x, z = point(Turned(t.c * rate2, t.s * rate2), K.w_re, K.w_im)
    F_x, F_z = J @ a
    return np.array([F_x - x, F_z - z + K.mass * K.gravity], dtype=object)


def momentum(robot: Structure, K: PlantArrays, q: Any, v: Any) -> Any:
    """m p_com' (2,) [N s]."""
    return jacobian(robot, turned(robot, q), K.w_re, K.w_im) @ v


def loads(robot: Structure, K: PlantArrays, q: Any, v: Any, a: Any, outside: Any) -> Loads:
    """What the meter looks at, for q'' = a; outside (5,): force [N], impulse [N s], drop of the ground [m]."""
    t = turned(robot, q)
    force = ground_reaction(robot, K, q, v, a) - outside[:2]
    foot = np.array(point(t, K.foot_re, K.foot_im), dtype=object)
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
