"""One step of the zero dynamics as CasADi expressions: the unknowns, the model at the nodes, and the impact.

On the constraint q_b = h(Theta), with c = [c_b c_N] the phase row, the configuration and its derivatives are

    q = (h, (Theta - c_b h) / c_N),   q' = dq/dTheta Theta',   q'' = dq/dTheta Theta'' + d2q/dTheta2 Theta'^2

and the unactuated row of D q'' + Omega = (u, 0), with inertia matrix D, Coriolis and gravity terms Omega and
torques u, gives Theta''. A *node* is a phase of the step at which the model is evaluated. So torque and
ground reaction at a node are explicit functions of the Bezier coefficients, the phases Theta+ and Theta-, and
the rate |Theta'| there: nothing is integrated in time, and CasADi's derivatives are exact.

The planar model (`model.planar_robot`) is written for NumPy arrays; with arrays of CasADi scalars the same code
gives expressions. `nlp` builds cost and constraints from a `SymbolicStep`; `optimise` reads the solution by the
names of `Unknowns`. Each constraint of the programme is a `Bounded`.
"""

from __future__ import annotations

from typing import Any, Generic, NamedTuple, TypeVar

import casadi as ca
import numpy as np

from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import basis_at
from biped_adrc.gait.design.request import GaitRequest, RobotLimits
from biped_adrc.gait.zero_dynamics import gauss_nodes
from biped_adrc.model.biped import Biped
from biped_adrc.model.derivatives import entries, impact_rows, pose_function, together
from biped_adrc.model.ground import ground_axes
from biped_adrc.model.planar import point, turned
from biped_adrc.model.planar_robot import PlanarRobot, robot_of

_T = TypeVar("_T", bound=Any)


class Unknowns(NamedTuple, Generic[_T]):
    """The unknowns of the nonlinear programme as symbols or as numbers, in the order of the decision vector,
    for n coordinates, p motors, K Gauss nodes.
    """

    q: _T
    """q- (n,): configuration just before impact [rad]."""
    slope: _T
    """dq_b/dTheta just before impact (p,) [rad/rad]."""
    alpha: _T
    """Bezier coefficients (p, M + 1) [rad]."""
    theta: _T
    """Theta+ after impact and Theta- before the next one (2,) [rad]."""
    after: _T
    """q_e' (n + 2,) after an impact at Theta'- = 1 rad/s, not relabelled [rad/s, m/s]: q' and the velocity of
    the old stance foot; it is linear in Theta'-."""
    impulse: _T
    """(F_T, F_N) of that impact (2,) [N s]."""
    rate: _T
    """|Theta'| just before impact (1,) [rad/s]."""
    rates: _T
    """|Theta'| at the nodes (K,) [rad/s]."""
    peak: _T
    """Largest |u_i| of the step as a share of the torque limit (1,)."""
    rough: _T
    """H [m], and the phases s of the landings on H and -H (3,); (0,) where no rough ground is asked for."""

    def split(self, x: Array) -> Unknowns[Array]:
        """Split a decision vector x (nx,) into the unknowns, in the shapes of the symbols in `self`, such as
        (n, 1) and (p, M + 1); matrices stand in x column by column.
        """
        cuts = np.split(np.ravel(x), np.cumsum([np.prod(part.shape) for part in self])[:-1])
        both = zip(cuts, self, strict=True)
        return Unknowns(*(cut.reshape(part.shape, order="F") for cut, part in both))


def stacked(numbers: Unknowns[Array]) -> Array:
    """Join the unknowns to the decision vector (nx,), matrices column by column."""
    return np.concatenate([np.ravel(part, order="F") for part in numbers])


def at_gait(
    biped: Biped, h: VirtualConstraint, q: Array, dq: Array, rate: float, rates: Array, peak: float
) -> Unknowns[Array]:
    """The unknowns of a step on the constraint h that ends in q (n,) [rad] with slope dq/dTheta = dq (n,).

    rate, rates (K,): |Theta'| before impact and at the nodes [rad/s]. peak [1]: largest torque over its limit.
    """
    # dq is q' at Theta' = 1 rad/s; `about`: dq_b/dTheta, alpha, phases, rates and impulse of that impact
    impact, ends = biped.impact(q, dq), np.array([h.theta_plus, h.theta_minus])
    about = dq[: biped.p], h.curve.coefficients, ends, impact.v_e, impact.impulse
    return Unknowns(q, *about, np.array(rate), rates, np.array(peak), np.zeros(0))


class Bounded(NamedTuple):
    """One constraint (row, or several rows) low <= value <= high, dimensionless, or [rad] for angles; an
    equality if low = high.
    """

    name: str
    """Name of the constraint in error messages; several rows may share one."""
    value: ca.MX
    """Expressions: often the same limit at all nodes."""
    low: float
    high: float
    unit: str = ""
    """What the value is a share of, such as "of the weight", or its unit; for messages."""


class Node(NamedTuple):
    """The model at K nodes (phases of the step), one column each; the fields are in the order of the rows of
    `node_function`.
    """

    inertia: ca.MX
    """I(Theta) (1, K): sigma = I Theta' [kg m^2]."""
    gravity: ca.MX
    """G_N (1, K): gravity torque on the unactuated coordinate [N m]."""
    u: ca.MX
    """Joint torques (p, K) [N m]."""
    v_b: ca.MX
    """Joint rates (p, K) [rad/s]."""
    force: ca.MX
    """Ground reaction on the stance foot (2, K), horizontal and vertical also on a slope [N]."""
    foot: ca.MX
    """Position (x, z) of the swing foot from the stance foot (2, K) [m]."""
    q: ca.MX
    """Configuration (n, K) [rad]."""


def node_function(robot: PlanarRobot, phase: Array, degree: int, direction: float) -> ca.Function:
    """Make a CasADi function (alpha, (Theta+, Theta-), s, b, b', b'', |Theta'|) -> the rows of `Node`, stacked,
    at one node.

    phase: c (n,), Theta = c q. degree: M of the curve. direction: sign of Theta'. Arguments of the result are
    alpha (p (M + 1),), column by column; s: normalised phase of the node; b, b', b'' (M + 1,): basis functions
    of the curve and their derivatives by s there, inputs so that one function serves all nodes.
    """
    n, K = robot.n, robot.K  # K: the robot's constants here, not the number of nodes
    p, M = n - 1, degree
    # s, r: one symbol each, the phase and |Theta'|
    alpha, theta, s, r = (ca.SX.sym(*a) for a in (("a", p * (M + 1)), ("t", 2), ("s"), ("r")))
    basis = [ca.SX.sym(f"b{k}", M + 1) for k in range(3)]
    span, c_b, c_N = theta[1] - theta[0], phase[:p], phase[p]
    h, dh, ddh = (ca.reshape(alpha, p, M + 1) @ b for b in basis)
    dh, ddh = dh / span, ddh / span**2  # derivatives by Theta from here on
    q = ca.vertcat(h, (theta[0] + s * span - ca.dot(c_b, h)) / c_N)
    dq = ca.vertcat(dh, (1.0 - ca.dot(c_b, dh)) / c_N)
    ddq = ca.vertcat(ddh, -ca.dot(c_b, ddh) / c_N)
    rate = direction * r
    x, v = entries(q), entries(dq * rate)
    D, Omega = map(together, robot.inertia_and_bias(x, v))
    inertia = D[p, :] @ dq
    # Theta'' from the row without a motor
    rate2 = -(Omega[p] + D[p, :] @ ddq * rate**2) / inertia
    a = dq * rate2 + ddq * rate**2
    u = (D @ a + Omega)[:p]
    # t: cos and sin of the links' absolute angles; G: gravity's torques (n,)
    t, force = turned(robot.A, x), robot.ground_reaction(x, v, entries(a))
    foot, (G, _) = point(t, K.foot_re, K.foot_im), robot.gravity_and_turning(t, v)
    rows = (inertia, G[p], u, together(v[:p]), together(force), ca.vertcat(*foot), q)
    return ca.Function("node", [alpha, theta, s, *basis, r], [ca.vertcat(*rows)])


def split_rows(rows: ca.MX, n: int) -> Node:
    """The `Node` of the rows that `node_function` gives for n coordinates, one column for each phase."""
    sizes = (1, 1, n - 1, n - 1, 2, 2, n)
    return Node(*ca.vertsplit(rows, [0, *np.cumsum(sizes).tolist()]))


def unknowns(n: int, degree: int, nodes: int, rough: int) -> Unknowns[ca.MX]:
    """New CasADi symbols of all unknowns, for n coordinates, curves of this degree, `nodes` Gauss nodes, and
    `rough` unknowns of rough ground.
    """
    p, scalar = n - 1, (1, 1)
    ends = (n, 1), (p, 1), (p, degree + 1), (2, 1), (n + 2, 1), (2, 1)
    sizes = *ends, scalar, (1, nodes), scalar, (rough, 1)
    named = zip(Unknowns._fields, sizes, strict=True)
    return Unknowns(*(ca.MX.sym(name, *size) for name, size in named))


class SymbolicStep:
    """The walking step as CasADi expressions of the unknowns x, from which `nlp` builds cost and constraints.

    direction: sign of Theta' in the walk. span: Theta- - Theta+ [rad]. node: the model at the K Gauss nodes;
    everywhere: there and at both ends of the step, (K + 2) columns, at the normalised phases `places`. work: W
    (1, 1) = int -G_N I dTheta over the step, until (1, K): the same up to each node [kg^2 m^4/s^2]. dt (1, K):
    time of each node's share of the step, duration: their sum [s]. length: distance of the feet along the
    ground at q- [m]. along, out (1, 2): unit vectors of the ground and of its normal. dq (n,): dq/dTheta before
    impact. R, r: relabelling q+ = R q- + r. q_plus, v_plus (n,): state after the impact at Theta'- = 1. D, J_m,
    J_2, foot: inertia matrix, Jacobians of m p_com and of the swing foot, and its place, at q-.

    Constraints are made dimensionless by the leg length, the weight, and sigma_scale = m g l sqrt(l / g).
    """

    def __init__(
        self, biped: Biped, request: GaitRequest, limits: RobotLimits, direction: float
    ) -> None:
        """Make the symbols of the unknowns, and all expressions of them.

        limits: the request's, completed by the robot's own. direction: sign of Theta' in the walk.
        """
        self.biped, self.request, self.limits = biped, request, limits
        robot, self.direction = robot_of(biped), direction
        self.n, self.p = biped.n, biped.p
        self.leg = robot.leg
        self.mass, self.gravity = robot.K.mass, robot.K.gravity
        self.sigma_scale = biped.weight * self.leg * np.sqrt(self.leg / self.gravity)
        x = self.x = unknowns(self.n, request.degree, request.nodes, 3 if limits.rough else 0)
        # phases in [0, 1], weights of an integral over it, and matrix of the integrals from 0 to each node
        s, w, C = gauss_nodes(request.nodes)
        self.function = node_function(robot, biped.phase, request.degree, direction)
        self.R, self.r = ca.DM(biped.R), biped.relabel(np.zeros(self.n))
        self.phase = ca.DM(biped.phase[np.newaxis])
        self.q_plus, self.v_plus = self.R @ x.q + self.r, self.R @ x.after[: self.n]
        self.node = self.at(s, x.rates)
        # |Theta'| just after impact: that at Theta'- = 1, times |Theta'-|
        first = (self.phase @ self.v_plus) * x.rate
        ends = self.at(np.array([0.0, 1.0]), ca.horzcat(first, x.rate))
        self.everywhere = Node(*(ca.horzcat(*pair) for pair in zip(self.node, ends, strict=True)))
        self.places = np.concatenate((s, [0.0, 1.0]))
        self.span = x.theta[1] - x.theta[0]
        self.dt = direction * self.span * w[np.newaxis] / x.rates
        self.duration = ca.sum2(self.dt)
        # -G_N I dTheta/ds at the nodes
        drive = -self.node.gravity * self.node.inertia * self.span
        self.work, self.until = drive @ w, drive @ C.T
        self.dq = self.slope(x.slope)
        self.along, self.out = (ca.DM(axis[np.newaxis]) for axis in ground_axes(request.slope))
        self.pose = pose_function(robot)  # q -> (D, J_m, J_2, foot)
        self.D, self.J_m, self.J_2, self.foot = self.pose(x.q)
        self.length = self.along @ self.foot

    def at(self, s: Array, rates: ca.MX) -> Node:
        """The model at any normalised phases s (K,), where |Theta'| is `rates` (1, K) [rad/s]."""
        count, x = len(s), self.x
        columns = ca.repmat(ca.vec(x.alpha), 1, count), ca.repmat(x.theta, 1, count)
        # basis functions of the curves and two derivatives by s, one column for each phase
        basis = [x.T for x in basis_at(self.request.kind, self.request.degree, s)]
        stacked = self.function.map(count)(*columns, s[np.newaxis], *basis, rates)
        return split_rows(stacked, self.n)

    def slope(self, dq_b: ca.MX) -> ca.MX:
        """dq/dTheta (n,) of all coordinates from that of the joints (p,), by c dq = 1 [rad/rad]."""
        c_b, c_N = self.biped.phase[: self.p], self.biped.phase[self.p]
        return ca.vertcat(dq_b, (1.0 - ca.dot(c_b, dq_b)) / c_N)

    def sigma(self, q: ca.MX, v: ca.MX) -> ca.MX:
        """Angular momentum about the stance foot at (q, v), each (n,) [rad, rad/s], over `sigma_scale` [1]."""
        # the last row of D q', of the coordinate without a motor; pose: q -> (D, J_m, J_2, foot)
        return self.pose(q)[0][self.n - 1, :] @ v / self.sigma_scale

    def impact(self) -> ca.MX:
        """Residual (n + 4,) of the paper's impact equations (7) at Theta'- = 1 rad/s, scaled by mass and leg
        length; zero where `after` and `impulse` of the unknowns are the impact of q-.
        """
        x, m = self.x, self.mass
        # of the momenta of the joints (n,) and of the whole robot (2,), and of the new foot's velocity (2,)
        upper, lower, foot = impact_rows(self.D, self.J_m, self.J_2, m, self.dq, x.after, x.impulse)
        return ca.vertcat(upper / (m * self.leg**2), lower / (m * self.leg), foot / self.leg)
