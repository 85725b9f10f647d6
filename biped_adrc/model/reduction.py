"""The split (11)-(15) of the paper: the nominal model of the actuated joints.

    D_s q'' + Omega = B_s u + xi~                                    (11)
    q_b'' = kappa u + xi                                             (13)
    kappa = [D11 - D12 D22^-1 D21]^-1 B1                             (15)
    xi = [D11 - D12 D22^-1 D21]^-1
         {xi~1 - Omega1 - D12 D22^-1 (xi~2 - Omega2)}                (14)

The unactuated rows of (11) are solved for q_N'' and inserted into the actuated ones, so that every
actuated joint is a double integrator with an input gain kappa and a total disturbance xi. Controllers
and observers work on (13) alone.

    D_s, Omega    inertia matrix (n, n) [kg m^2], Coriolis and gravity terms C q' + G (n,) [N m]
    u, B_s        torques of the motors (p,) [N m], and the constant matrix (n, p) by which they act
    xi~           zeta + delta (n,) [N m]: external generalised force, and error of the model
    F_T, F_N      force [N] of the ground on the stance foot, along x (to the right) and z (up)
    kappa, xi     gain (p, p) [1/(kg m^2)] and total disturbance (p,) [rad/s^2] of the actuated joints

q_b (p,) are the joints with motors, q_N the other coordinates, usually the pitch alone; D11 (p, p), D12, D21,
D22 are the blocks of D_s for them, and index 1 stands for the rows of q_b, 2 for those of q_N.

xi~ is a generalised force [N m] in (11) and xi an acceleration [rad/s^2] in (13); the paper prints one letter
for both. Here B1 is the identity: the motors act on the joints q_b.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from biped_adrc.core.linear import solve_positive
from biped_adrc.core.shown import shown
from biped_adrc.core.types import Array, read_only


@shown
class Reduction(NamedTuple):
    """Terms of the reduced model at one state; n coordinates, the first p of them actuated."""

    D: Array
    """Inertia matrix D_s (n, n) [kg m^2]."""
    Omega: Array
    """Coriolis and gravity terms C q' + G (n,) [N m]."""
    kappa: Array
    """Input gain (15), (p, p) [1/(kg m^2)]."""
    xi: Array
    """(14) with xi~ = 0: the model's own part of the total disturbance (p,) [rad/s^2]."""
    kappa_inverse: Array
    """B1^-1 [D11 - D12 D22^-1 D21] (p, p) [kg m^2]."""
    A_N: Array
    """-D22^-1 D21 (n - p, p): without xi~ the unactuated rows are q_N'' = A_N q_b'' + a_N."""
    a_N: Array
    """-D22^-1 Omega2 (n - p,) [rad/s^2]."""


@shown
class BodyTerms(NamedTuple):
    """Terms of the whole robot at one state that few controllers need, besides its `Reduction`.

    With the momentum D_s q' = pi, the equation of motion is pi' = C' q' - G + B_s u + zeta; the force of the
    ground is F = F_a q'' + F_0, by Newton's law for the COM.
    """

    G: Array
    """Gravity's part of Omega (n,) [N m]."""
    turning: Array
    """C' q' = dT/dq (n,) [N m], C' the transpose, T the kinetic energy: what the motion itself adds to pi'."""
    F_a: Array
    """m dp_com/dq (2, n) [kg m], the part of (F_T, F_N) that is proportional to q''."""
    F_0: Array
    """(F_T, F_N) (2,) [N] of the ground on the stance foot at q'' = 0, along x and z."""
    J_2: Array
    """dp_2/dq (2, n) [m] of the position (x, z) of the swing foot."""
    mass: float
    """Mass of the whole robot [kg]."""


@lru_cache(maxsize=16)
def identity(p: int) -> Array:
    """The unit matrix (p, p), read-only; the same array at every call."""
    return read_only(np.eye(p))


def reduce(D: Array, Omega: Array, p: int) -> Reduction:
    """Compute kappa (15), xi (14) with xi~ = 0, and the other terms of a `Reduction`, from D_s = D (n, n) [kg
    m^2] and Omega (n,) [N m].

    The first p coordinates are actuated; p = 0 is a passive robot with empty kappa and xi. With one unactuated
    coordinate D22 is a number, and no system is solved for it. Raises SingularError for a singular D22, or a
    singular D11 - D12 D22^-1 D21.
    """
    if p == 0:  # all rows are unactuated: a_N is the whole acceleration
        a_N = -solve_positive(D, Omega, "D_s")
        none = np.zeros((0, 0))
        return Reduction(D, Omega, none, np.zeros(0), none, np.zeros((D.shape[0], 0)), a_N)
    D12 = D[:p, p:]
    if D.shape[0] == p + 1:
        A_N = D[p:, :p] / -D[p, p]
        a_N = Omega[p:] / -D[p, p]
    else:
        A_N = -solve_positive(D[p:, p:], D[p:, :p], "D22")
        a_N = -solve_positive(D[p:, p:], Omega[p:], "D22")
    kappa_inverse = D[:p, :p] + D12 @ A_N
    kappa = solve_positive(kappa_inverse, identity(p), "D11 - D12 D22^-1 D21")
    xi = kappa @ -(Omega[:p] + D12 @ a_N)
    return Reduction(D, Omega, kappa, xi, kappa_inverse, A_N, a_N)


def unknown_force(terms: Reduction, a: Array, u: Array) -> Array:
    """The generalised force xi~ = D_s a + Omega - B_s u (n,) [N m] of (11), which the nominal model, with its
    D_s and Omega in `terms`, does not explain.

    With a = q'' (n,) [rad/s^2] of the plant and its torque u (p,) [N m] it is the disturbance zeta plus the
    model error delta, friction included.
    """
    # B_s u has u in its first p rows, and 0 below
    force = terms.D @ a + terms.Omega
    force[: len(u)] = force[: len(u)] - u
    return force


def disturbance_parts(terms: Reduction, force: Array) -> tuple[Array, Array]:
    """Matched part (from xi~1) and unmatched part (from xi~2) of (14), each (p,) [rad/s^2].

    A motor could cancel the matched part at once; the unmatched one enters through -D12 D22^-1 xi~2, where
    -D12 D22^-1 = A_N^T. force is xi~ = delta + zeta (n,) [N m], on all coordinates.
    """
    p = terms.kappa.shape[0]
    return terms.kappa @ force[:p], terms.kappa @ (terms.A_N.T @ force[p:])
