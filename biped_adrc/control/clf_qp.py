"""A control Lyapunov function in a quadratic program, with limits on torque and ground force.

    y = q_b - q_d,   y'' = M q_b'' - drift - H_N a_N = mu
    eta = (y / eps, y'),   V = eta' P eta,   P = [[sqrt 3, 1], [1, sqrt 3]] (x) I

    min  |mu|^2 + w delta^2   over mu, delta
    s.t. V' <= -c V / eps + delta                 c = 1 / (1 + sqrt 3)
         |u| <= u_max,   F_N >= F_min,   |F_T| <= friction F_N

    q_b, q_N    joints with motors (p,), and the other coordinates [rad]; ' is d/dt or a transpose
    a           q_b'' = a = kappa u + xi (p,) [rad/s^2] by the nominal model, with the torque u (p,) [N m]
    A_N, a_N    q_N'' = A_N a + a_N by the nominal model
    drift, H    q_d'' = drift + H q'' of the reference q_d, H = (H_b, H_N); M = I - H_b - H_N A_N (p, p)
    mu          input of the program, the acceleration y'' (p,) [rad/s^2]
    eps, w      time scale in which V falls [s], and the weight of the relaxation delta; (x): Kronecker product
    F_T, F_N    tangential and normal force of the ground on the stance foot [N], F = F_a q'' + F_0

P solves the Riccati equation of the double integrator for Q = I; c = 1 / lambda_max(P). V' + c V / eps = psi_0
+ psi_1 mu is affine in mu, and so are u = kappa^-1 (a - xi), where a = M^-1 (mu + drift + H_N a_N), and F.
Where no limit is active the program has the solution of least norm, which is tried first: mu = -psi_0 psi_1 /
(|psi_1|^2 + 1 / w) for psi_0 > 0, else 0. Where psi_0 > 0 then

    V' + c V / eps = psi_0 / (1 + w |psi_1|^2),   psi_1 = 2 (y / eps + sqrt 3 y')

V falls as exp(-c t / eps) only where w |psi_1|^2 >> 1. States at which w |psi_1|^2 is below 1 are a dead zone:
mu fades, and V may grow, by sqrt(3/2) V / eps at most, until the state leaves it. At rest the dead zone is |y|
< eps / (2 sqrt w), 5e-5 rad with the defaults; w = 1e9 makes it 1.6e-7 rad.

Ames, Galloway, Sreenath, Grizzle, IEEE TAC 59(4), 2014; Galloway, Sreenath, Ames, Grizzle, IEEE Access 3, 2015.

When no mu fulfils all limits, those on the force of the ground are dropped. The limits on the torque alone can
always be met, since delta is free; should the solver not find the solution, the torque of least norm is cut off
at u_max.
"""

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from biped_adrc.control.base import Controller, Measurement, body_of
from biped_adrc.control.tracking import output_matrix
from biped_adrc.core.checks import PositiveFloat
from biped_adrc.core.errors import NotFiniteError
from biped_adrc.core.linear import solve
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.model.reduction import identity

ROOT = math.sqrt(3.0)


class Decrease(NamedTuple):
    """The Lyapunov function V, and V' + c V / eps = psi_0 + psi_1 mu as a function of mu."""

    V: float
    """V [rad^2/s^2]."""
    psi_0: float
    """V' + c V / eps for mu = 0 [rad^2/s^3]; above 0, V does not fall fast enough without an input."""
    psi_1: Array
    """Gradient by mu (p,) [rad/s]."""


class Affine(NamedTuple):
    """u = U mu + u_0 (p,) [N m], and the force of the ground (F_T, F_N) = F_mu mu + F_1 (2,) [N]."""

    U: Array
    """(p, p) [kg m^2]."""
    u_0: Array
    """(p,) [N m]."""
    F_mu: Array
    """(2, p) [kg m]."""
    F_1: Array
    """(2,) [N]."""


class _Rows(NamedTuple):
    """Constraints G z <= h of the program, for z = (mu, sqrt w delta) (p + 1,); the rows of the ground come
    last.

    Scaling delta by the root of its weight w makes the cost |z|^2, which needs no matrix.
    """

    G: Array
    """(number of rows, p + 1)."""
    h: Array
    """(number of rows,)."""
    ground: int
    """Number of rows for the force of the ground."""


def decrease(y: Array, dy: Array, eps: float) -> Decrease:
    """V and the terms psi_0, psi_1 of V' for outputs y [rad], y' = dy [rad/s], each (p,), and eps [s]."""
    a = y / eps  # eta = (a, dy); below, products of the two halves of eta
    aa, ab, bb = float(a @ a), float(a @ dy), float(dy @ dy)
    V = ROOT * aa + 2.0 * ab + ROOT * bb
    # V' for mu = 0, and c V / eps; ROOT is sqrt 3
    psi_0 = 2.0 * (ROOT * ab + bb) / eps + V / (eps * (1.0 + ROOT))
    return Decrease(V, psi_0, 2.0 * (a + ROOT * dy))


def least_norm(d: Decrease, relaxation: float) -> Array:
    """mu (p,) [rad/s^2] of least |mu|^2 + w delta^2 without limits; zero where V falls fast enough by itself.

    relaxation [1]: the weight w of delta^2.
    """
    return d.psi_1 * (-max(d.psi_0, 0.0) / (float(d.psi_1 @ d.psi_1) + 1.0 / relaxation))


def affine(r: ReferencePoint, m: Measurement) -> Affine:
    """Torque and ground force as affine functions of mu (p,), by which limits on them become rows of the QP.

    r: the reference now. Raises SingularError where M, and so L = M kappa, the factor of u in y'' = L u + ..,
    is exactly singular.
    """
    terms, body, p = m.terms, body_of(m), len(r.q_d)
    rest = r.drift + r.H[:, p:] @ terms.a_N
    # a = M^-1 (mu + rest): one solution for all p columns of mu, and in the last column for mu = 0
    columns = np.column_stack((identity(p), rest))
    solution = solve(output_matrix(r, terms), columns, "L of y'' = L u + xi_y")
    torque = terms.kappa_inverse @ solution
    force = (body.F_a[:, :p] + body.F_a[:, p:] @ terms.A_N) @ solution
    u_0 = torque[:, p] - terms.kappa_inverse @ terms.xi
    F_1 = force[:, p] + body.F_a[:, p:] @ terms.a_N + body.F_0
    return Affine(torque[:, :p], u_0, force[:, :p], F_1)


@dataclass(frozen=True)
class CLFQPController(Controller):
    """A controller that solves the module's quadratic program at every call; it runs in Python, not compiled.

    reference: q_d, which the joints track. epsilon [s]: V falls with c / eps outside the dead zone; 1 / eps^2
    and sqrt 3 / eps are like K_p and K_d of a PD. torque_limit: u_max [N m], friction [1] (of a flat ground)
    and least_force: F_min [N], each None for no such limit. relaxation [1]: w. Raises InputError for numbers
    that are not positive; needs qpsolvers and daqp.
    """

    needs_body: ClassVar[bool] = True
    in_python = "it solves a quadratic program at each call"

    reference: Reference
    epsilon: PositiveFloat = 0.01
    torque_limit: PositiveFloat | None = 150.0
    friction: PositiveFloat | None = 0.6
    least_force: PositiveFloat | None = 30.0
    relaxation: PositiveFloat = 1e4

    def output(self, s: Array, m: Measurement) -> Array:
        """u (p,) [N m]: of the law of least norm if that keeps all limits, else of the program; where this has
        no solution, that of the law of least norm, cut off at u_max.

        Raises NotFiniteError for a state that is not finite.
        """
        if not (np.isfinite(m.q).all() and np.isfinite(m.v).all()):
            raise NotFiniteError(
                f"the CLF-QP was asked for a torque at q = {m.q}, q' = {m.v}, expected finite numbers"
            )
        r = self.reference(m.t, m.q, m.v)
        d = decrease(m.q_b - r.q_d, m.v_b - r.dq_d, self.epsilon)
        # d: V and its decrease as a function of mu; `to`: torque and force as functions of mu
        to, mu = affine(r, m), least_norm(d, self.relaxation)
        u, program = to.U @ mu + to.u_0, self.program(d, to)  # u: torque of the law of least norm
        # row 0, the decrease of V, holds by the choice of mu; delta, the last column, is in no other row
        if np.all(program.G[1:, :-1] @ mu <= program.h[1:]):  # all limits are kept
            return u
        solved = self._solved(program)
        if solved is not None:
            return to.U @ solved + to.u_0
        limit = math.inf if self.torque_limit is None else self.torque_limit
        # the law of least norm, each motor cut off by itself: the last resort, after which V may grow
        return np.clip(u, -limit, limit)

    def program(self, d: Decrease, to: Affine) -> _Rows:
        """Rows of the program: first the decrease d of V, then the limits on torque, then those on the force of
        the ground, which can be dropped from the end where no mu fulfils all. to: from mu to torque and force.
        """
        p = len(to.u_0)
        G: list[Array] = [d.psi_1[np.newaxis]]
        h: list[Array | list[float]] = [[-d.psi_0]]
        if self.torque_limit is not None:
            G += [to.U, -to.U]
            h += [self.torque_limit - to.u_0, self.torque_limit + to.u_0]
        F_mu, F_1, first = to.F_mu, to.F_1, sum(map(len, G))  # first: row of the ground's force
        if self.least_force is not None:
            G.append(-F_mu[1:])  # -F_N <= -F_min
            h.append(F_1[1:] - self.least_force)
        if self.friction is not None:
            # F_T - friction F_N <= 0 and -F_T - friction F_N <= 0
            cone = np.array([[1.0, -self.friction], [-1.0, -self.friction]])
            G.append(cone @ F_mu)
            h.append(-(cone @ F_1))
        rows = np.zeros((sum(map(len, G)), p + 1))
        np.concatenate(G, out=rows[:, :p])
        # -delta, by the last entry of z, which is sqrt w delta
        rows[0, p] = -1.0 / math.sqrt(self.relaxation)
        return _Rows(rows, np.concatenate(h), len(rows) - first)

    def _solved(self, program: _Rows) -> Array | None:
        """Solve the program for mu (p,) [rad/s^2], with the limits on the force of the ground or else without;
        None when the solver fails at both.
        """
        # z = (mu, sqrt w delta); the last `ground` rows of G z <= h are the limits on the force of the ground
        z = _least(program.G, program.h)
        if z is None and program.ground > 0:
            z = _least(program.G[: -program.ground], program.h[: -program.ground])
        return None if z is None else z[:-1]


def _least(G: Array, h: Array) -> Array | None:
    """The vector z of least |z| that fulfils G z <= h, row by row; None when the solver finds none."""
    from qpsolvers import solve_qp

    n = G.shape[1]  # primal_tol: how far a row may be exceeded
    z: Array | None = solve_qp(np.eye(n), np.zeros(n), G, h, solver="daqp", primal_tol=1e-9)
    return z if z is not None and math.isfinite(z.dot(z)) else None
