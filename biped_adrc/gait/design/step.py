"""One step of the zero dynamics in CasADi's symbols: the unknowns, what each node gives, and the impact.

q, Theta' and Theta'' on the constraint, torque and ground reaction are explicit functions of the Bezier
coefficients, the phases and the rates |Theta'|, so that nothing is integrated in time and all derivatives are
exact.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from biped_adrc.gait.curves import ControlledCurve
from biped_adrc.gait.design.request import GaitRequest, RobotLimits
from biped_adrc.gait.zero_dynamics import gauss_nodes
from biped_adrc.ground import ground_axes
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import (
    PlanarTree,
    gravity_and_turning,
    ground_reaction,
    inertia_and_bias,
    jacobian,
    point,
    turned,
)
from biped_adrc.types import Array


class Unknowns(NamedTuple):
    """Symbols of the unknowns in their order."""

    q: Any
    """q- (n,)."""
    slope: Any
    """dq_b/dTheta before impact (p,)."""
    alpha: Any
    """(p, M + 1)."""
    theta: Any
    """Theta+, Theta- (2,)."""
    after: Any
    """q_e' (n + 2,) after an impact at Theta'- = 1, old labels."""
    impulse: Any
    """(F_T, F_N) of that impact (2,)."""
    rate: Any
    """|Theta'| before impact (1,)."""
    rates: Any
    """|Theta'| at the nodes (1, K)."""
    peak: Any
    """Largest torque over the robot's (1,)."""

    def vector(self) -> Any:
        """All as one column."""
        return ca.vertcat(*(ca.vec(part) for part in self))

    def parts(self, x: Array) -> Unknowns:
        """Numbers in place of the symbols."""
        sizes = [part.numel() for part in self]
        cuts = np.split(np.asarray(x).ravel(), np.cumsum(sizes)[:-1])
        shaped = (cut.reshape(part.shape, order="F") for cut, part in zip(cuts, self, strict=True))
        return Unknowns(*shaped)


class Node(NamedTuple):
    """What one node gives, in the order of the function's rows."""

    inertia: Any
    gravity: Any
    u: Any
    v_b: Any
    force: Any
    foot: Any
    q: Any


def functions(kind: type[ControlledCurve], degree: int, s: Array) -> tuple[Array, Array, Array]:
    """Values, first and second derivatives of the curve's basis at s (K,), each (M + 1, K)."""
    basis = kind(np.eye(degree + 1))
    values, first, second = (np.array(rows).T for rows in zip(*map(basis, s), strict=True))
    return values, first, second


def each(x: Any) -> Any:
    """The numbers of a column of symbols, as NumPy takes them."""
    out = np.empty(x.numel(), dtype=object)
    for i in range(len(out)):
        out[i] = x[i]
    return out


def together(values: Any) -> Any:
    """A column or matrix of symbols, from NumPy."""
    rows = [ca.horzcat(*row) for row in np.reshape(values, (len(values), -1))]
    return ca.vertcat(*rows)


def node_function(tree: PlanarTree, phase: Array, degree: int, direction: float) -> Any:
    """CasADi function (alpha, Theta+-, s, b, b', b'', |Theta'|) -> the rows of Node, stacked."""
    n, K = len(tree.A), tree.K
    p, M = n - 1, degree
    alpha, theta, s, r = (ca.SX.sym(*a) for a in (("a", p * (M + 1)), ("t", 2), ("s"), ("r")))
    basis = [ca.SX.sym(f"b{k}", M + 1) for k in range(3)]
    span, c_b, c_N = theta[1] - theta[0], phase[:p], phase[p]
    h, dh, ddh = (ca.reshape(alpha, p, M + 1) @ b for b in basis)
    dh, ddh = dh / span, ddh / span**2
    q = ca.vertcat(h, (theta[0] + s * span - ca.dot(c_b, h)) / c_N)
    dq = ca.vertcat(dh, (1.0 - ca.dot(c_b, dh)) / c_N)
    ddq = ca.vertcat(ddh, -ca.dot(c_b, ddh) / c_N)
    rate = direction * r
    x, v = each(q), each(dq * rate)
    D, Omega = map(together, inertia_and_bias(tree, K, x, v))
    inertia = D[p, :] @ dq
    rate2 = -(Omega[p] + D[p, :] @ ddq * rate**2) / inertia
    a = dq * rate2 + ddq * rate**2
    u = (D @ a + Omega)[:p]
    t, force = turned(tree, x), ground_reaction(tree, K, x, v, each(a))
    foot, (G, _) = point(t, K.foot_re, K.foot_im), gravity_and_turning(tree, K, t, v)
    rows = Node(inertia, G[p], u, together(v[:p]), together(force), ca.vertcat(*foot), q)
    return ca.Function("node", [alpha, theta, s, *basis, r], [ca.vertcat(*rows)])


def pose_function(tree: PlanarTree) -> Any:
    """CasADi function q -> D_s (n, n), d(m p_com)/dq (2, n), J_2 (2, n) and the swing foot (2,)."""
    n, K = len(tree.A), tree.K
    q = ca.SX.sym("q", n)
    x, rest = each(q), np.zeros(n)
    t, (D, _) = turned(tree, x), inertia_and_bias(tree, K, x, rest)
    J_m, J_2 = jacobian(tree, t, K.w_re, K.w_im), jacobian(tree, t, K.foot_re, K.foot_im)
    foot = ca.vertcat(*point(t, K.foot_re, K.foot_im))
    return ca.Function("pose", [q], [*map(together, (D, J_m, J_2)), foot])


def unknowns(n: int, degree: int, nodes: int) -> Unknowns:
    """The symbols."""
    p, scalar = n - 1, (1, 1)
    sizes = (n, 1), (p, 1), (p, degree + 1), (2, 1), (n + 2, 1), (2, 1), scalar, (1, nodes), scalar
    named = zip(Unknowns._fields, sizes, strict=True)
    return Unknowns(*(ca.MX.sym(name, *size) for name, size in named))


class Step:
    """What the rows are made of; scales are the weight, the leg, and the peak torque."""

    def __init__(
        self, biped: Biped, request: GaitRequest, limits: RobotLimits, direction: float
    ) -> None:
        self.biped, self.request, self.limits = biped, request, limits
        self.tree, self.direction = PlanarTree.of(biped), direction
        self.n, self.p = biped.n, biped.p
        self.leg = self.tree.leg
        self.mass, self.gravity = self.tree.K.mass, self.tree.K.gravity
        self.sigma_scale = biped.weight * self.leg * np.sqrt(self.leg / self.gravity)
        x = self.x = unknowns(self.n, request.degree, request.nodes)
        s, w, C = gauss_nodes(request.nodes)
        self.function = node_function(self.tree, biped.phase, request.degree, direction)
        self.q_plus = biped.R @ x.q + biped.relabel(np.zeros(self.n))
        self.v_plus = biped.R @ x.after[: self.n]
        self.node = self.at(s, x.rates)
        first = (biped.phase[np.newaxis] @ self.v_plus) * x.rate
        ends = self.at(np.array([0.0, 1.0]), ca.horzcat(first, x.rate))
        self.everywhere = Node(*(ca.horzcat(*pair) for pair in zip(self.node, ends, strict=True)))
        self.places = np.concatenate((s, [0.0, 1.0]))
        self.span = x.theta[1] - x.theta[0]
        self.dt = direction * self.span * w[np.newaxis] / x.rates
        self.duration = ca.sum2(self.dt)
        drive = -self.node.gravity * self.node.inertia * self.span
        self.work, self.until = drive @ w, drive @ C.T
        c_b, c_N = biped.phase[: self.p], biped.phase[self.p]
        self.dq = ca.vertcat(x.slope, (1.0 - ca.dot(c_b, x.slope)) / c_N)
        along, out = ground_axes(request.slope)
        self.along, self.out = along[np.newaxis], out[np.newaxis]
        self.pose = pose_function(self.tree)
        self.D, self.J_m, self.J_2, self.foot = self.pose(x.q)
        self.length = self.along @ self.foot

    def at(self, s: Array, rates: Any) -> Node:
        """Node at the shares s (K,) of the step, with |Theta'| (1, K)."""
        count, p, x = len(s), self.p, self.x
        columns = ca.repmat(ca.vec(x.alpha), 1, count), ca.repmat(x.theta, 1, count)
        basis = functions(self.request.kind, self.request.degree, s)
        stacked = self.function.map(count)(*columns, s[np.newaxis], *basis, rates)
        sizes = (1, 1, p, p, 2, 2, self.n)
        return Node(*ca.vertsplit(stacked, [0, *np.cumsum(sizes).tolist()]))

    def sigma(self, q: Any, v: Any) -> Any:
        """sigma over its scale."""
        return self.pose(q)[0][self.n - 1, :] @ v / self.sigma_scale

    def impact(self) -> Any:
        """D_e (q_e'+ - q_e'-) - E_2' F and E_2 q_e'+ at Theta'- = 1, (7), scaled (n + 4,)."""
        x, m, J_m, J_2 = self.x, self.mass, self.J_m, self.J_2
        change = x.after - ca.vertcat(self.dq, 0.0, 0.0)
        turn, move = change[: self.n], change[self.n :]
        upper = self.D @ turn + J_m.T @ move - J_2.T @ x.impulse
        lower = J_m @ turn + m * move - x.impulse
        foot = J_2 @ x.after[: self.n] + x.after[self.n :]
        return ca.vertcat(upper / (m * self.leg**2), lower / (m * self.leg), foot / self.leg)
