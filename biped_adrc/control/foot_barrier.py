"""A filter of the torque that brings the swing foot onto the next stone: exponential control barrier functions.

x(q) [m] is how far the swing foot is ahead of the stance foot, and x_r(Theta) [m] how far the reference has it
at the same phase Theta = c q. The reference makes steps of length L_r, the next *stone*, on which the foot has
to come down, is at L. The barriers keep x within tol of a path x_c that leaves the reference smoothly and ends
on the stone:

    x_c = x_r + (L - L_r) beta(x_r / L_r),   e = x - x_c,   b_1 = tol - e >= 0,   b_2 = tol + e >= 0

beta is a polynomial that rises from 0, where the foot passes the stance foot, to 1 at the end of the step. The
angles q_N without a motor follow the actuated ones q_b, q_N'' = A_N q_b'' + a_N of (12) of the paper, so that

    e'' = G q_b'' + g,   q_b'' = kappa u + xi^

G (p,) [m] and g [m/s^2] are the terms of e'', kappa (p, p) is the nominal model's input gain. xi^ (p,)
[rad/s^2] is the estimate of the observer inside, which contains what the model does not know; without an
observer it is the model's xi. Each barrier has to fulfil b'' + 2 lambda b' + lambda^2 b >= 0, with both poles
at -lambda. The two conditions together bound one number:

    |e'' + 2 lambda e' + lambda^2 e| <= lambda^2 tol

The controller inside asks for accelerations a of the joints. The filter changes them as little as the bound
allows: it minimises |q_b'' - a|^2, a quadratic program with the solution q_b'' = a + G' d / |G|^2. The number d
is by how much the bound is exceeded, with the sign that leads back, and 0 within it. Accelerations are compared
and not torques, so that light and heavy joints count alike.

One torque can always keep both bounds, but it may be beyond the torque limit, which the program does not know.
An instant at which the torque that acts does not keep them is *infeasible*; in sampled time the state counts
such instants.

Nguyen, Hereid, Grizzle, Ames, Sreenath, 3D dynamic walking on stepping stones with control barrier functions,
CDC 2016; Nguyen, Sreenath, Exponential control barrier functions, ACC 2016.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.control.around import Around
from biped_adrc.control.base import Measurement
from biped_adrc.control.outer_loop import own_reference, tracked_constraint
from biped_adrc.core.checks import PositiveFloat
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array, Indices
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import of_step
from biped_adrc.model.planar import LinkPoint, Turned, jacobian, point, turned
from biped_adrc.model.planar_robot import robot_of
from biped_adrc.observers.base import Estimate

_ROUND_OFF = 1e-6
"""A bound on e'' that is exceeded by less than this [m/s^2] counts as kept."""


class FootError(NamedTuple):
    """Error of the swing foot from its path: e [m], e' = de [m/s] and e'' = G q_b'' + g [m/s^2]."""

    e: float
    de: float
    G: Array
    """(p,) [m]."""
    g: float
    """[m/s^2]."""


class BarrierState(NamedTuple):
    """State of a `FootBarrier`."""

    inner: Any
    """State of the controller inside."""
    infeasible: float
    """Number of sample instants so far at which the torque that acted broke a bound."""


@dataclass(frozen=True)
class FootBarrier(Around):
    """The module's filter of the torque of `inner`; its state is a `BarrierState`.

    biped: the robot of the nominal model. stones: L of the steps [m], the first one first; behind the last one
    nothing is filtered. step: L_r [m], None for a reference that steps on the stones, as in `Footstep`.
    tolerance: tol [m], less than that of the stones, since the foot may come down early or late. rate: lambda
    [1/s]. observed: whether xi^ is the estimate of the observer inside, else the model's xi. Raises InputError
    when `inner` tracks no virtual constraint.

    >>> inner = FootBarrier(ba.NPDController(gait.constraint), biped, stones=(0.42, 0.43))
    >>> controller = ba.Footstep.on_gait(inner, gait, biped, stones=(0.42, 0.43))
    >>> walker = ba.Walker(biped, controller, timing=ba.SampledTime(1e-3), torque_limit=150.0)
    >>> ba.walk(walker, gait, impacts=2).impacts
    2
    """

    biped: Biped
    stones: tuple[float, ...] = ()
    step: PositiveFloat | None = None
    tolerance: PositiveFloat = 0.003
    rate: PositiveFloat = 100.0
    observed: bool = True

    def __post_init__(self) -> None:
        tracked_constraint(self.inner, "the corridor of a foot is about a virtual constraint")
        object.__setattr__(self, "stones", tuple(map(float, self.stones)))

    @derived
    def swing(self) -> LinkPoint:
        """The swing foot as a function of q in closed form: x + i z = sum_k d_k exp(i a_k), with vectors d [m]
        along the links and absolute angles a = A q [rad].
        """
        robot = robot_of(self.biped)
        A, K = robot.A.astype(float), robot.K
        # the last field is for moments at the point, which are not needed here
        return LinkPoint(A, K.foot_re, K.foot_im, np.zeros(len(A)))

    def foot(self, q: Array, v: Array) -> tuple[float, float, Array, float]:
        """x [m], x' [m/s], dx/dq (n,) [m] of the swing foot, and [m/s^2] the part of x'' at q'' = 0.

        q (n,) [rad], v (n,) [rad/s].
        """
        # the foot is at x + i z = sum_i d_i exp(i a_i), d = k.re + i k.im; t: cos and sin of the angles a = A q
        k, t = self.swing, turned(self.swing.A, q)
        rate2 = (k.A @ v) ** 2
        # [0] is the row of x, [1] would be that of z
        J: Any = jacobian(k.A, t, k.re, k.im)[0]
        x: Any = point(t, k.re, k.im)[0]
        # x is a sum of cos a and sin a of absolute angles a = A q, and (cos a)'' = -a'^2 cos a for a'' = 0
        turning: Any = point(Turned(t.c * rate2, t.s * rate2), k.re, k.im)[0]
        return x, J @ v, J, -turning

    def corridor(self, x: float, L: float) -> tuple[float, float, float]:
        """x_c [m], the centre of the corridor, for a stone at L [m], and dx_c/dx_r [1], d2x_c/dx_r2 [1/m].

        x [m] is x_r, where the reference has its swing foot.
        """
        # None: the reference steps on the stones itself
        L_r = L if self.step is None else self.step
        # beta = 10 z^3 - 15 z^4 + 6 z^5; 0 before the foot passes the stance foot, 1 behind the end of the step
        z = np.minimum(np.maximum(x / L_r, 0.0), 1.0)
        beta, dbeta = z**3 * (10.0 - 15.0 * z + 6.0 * z**2), 30.0 * (z * (1.0 - z)) ** 2
        ddbeta, far = 60.0 * z * (1.0 - z) * (1.0 - 2.0 * z), L - L_r
        return x + far * beta, 1.0 + far * dbeta / L_r, far * ddbeta / L_r**2

    def error(self, m: Measurement) -> FootError:
        """e, e' and the terms G, g of e'' by the nominal model at a measurement.

        The reference's posture q_r has the joints q_d and, without a motor, the angle that gives it the
        measured phase Theta = c q.
        """
        c, p, terms = tracked_constraint(self.inner).phase, len(m.terms.kappa), m.terms
        r = own_reference(self.inner)(m.t, m.q, m.v)  # q_d, q_d', and q_d'' = drift + H q''

        # the coordinates (n,) of the reference, from its phase and its joints; linear, so for rates too; the
        # last coordinate, without a motor, follows from Theta = c q
        def on_reference(theta: Array | float, q_b: Array) -> Array:
            return np.append(q_b, (theta - c[:p] @ q_b) / c[p])

        q_r, v_r = on_reference(c @ m.q, r.q_d), on_reference(c @ m.v, r.dq_d)
        a_r = on_reference(0.0, r.drift)  # at q'' = 0 Theta'' is 0
        R = np.vstack((r.H, (c - c[:p] @ r.H) / c[p]))  # q_r'' = R q'' + a_r
        # of the swing foot: x, x', J = dx/dq (n,), and ddx, the part of x'' at q'' = 0
        x, dx, J, ddx = self.foot(m.q, m.v)
        x_r, dx_r, J_r, ddx_r = self.foot(q_r, v_r)
        # stones[k - 1] in step k; behind the last stone 1.0, as any length will do: `missing` is 0 there
        x_c, slope, bend = self.corridor(x_r, of_step(self.stones, m.step, 1.0))
        # slope, bend: dx_c/dx_r, d2x_c/dx_r2; e'' = G q'' + g, with G (n,) until q_N'' is inserted
        G = J - slope * (J_r @ R)
        g = ddx - slope * (ddx_r + J_r @ a_r) - bend * dx_r**2
        G_b, g_b = G[:p] + G[p:] @ terms.A_N, g + G[p:] @ terms.a_N
        return FootError(x - x_c, dx - slope * dx_r, G_b, g_b)

    def missing(self, s: Any, m: Measurement, u: Array) -> tuple[float, Array]:
        """d [m/s^2], the change of e'' that is missing under the torque u (p,) [N m] to keep the bound, and G
        (p,) [m] of e''.

        s: state of the controller inside. d is 0 within the bound, and behind the last stone.
        """
        # None too for a controller without an observer
        x = self.inner.estimate(s, m) if self.observed else None
        f, xi, k = self.error(m), m.terms.xi if x is None else x.disturbance, self.rate
        # y = e'' + 2 lambda e' + lambda^2 e, which has to stay within +-bound
        y = f.G @ (m.terms.kappa @ u + xi) + f.g + 2.0 * k * f.de + k * k * f.e
        bound = k * k * self.tolerance
        d: Any = np.maximum(-bound - y, 0.0) - np.maximum(y - bound, 0.0)
        # + 0.5: in machine code m.step is a float
        d = np.where(m.step < len(self.stones) + 0.5, d, 0.0)
        return d, f.G

    def output(self, s: Any, m: Measurement) -> Array:
        u = self.inner.output(s.inner, m)
        # the change G' d / |G|^2 of q_b'' changes e'' by d
        d, G = self.missing(s.inner, m, u)
        return u + m.terms.kappa_inverse @ (G * (d / (G @ G)))

    def initial_state(self, m: Measurement) -> Any:
        return BarrierState(self.inner.initial_state(m), 0.0)

    def flow(self, s: Any, m: Measurement, u: Array) -> Any:
        # the count has the rate 0: it changes at sample instants alone
        return BarrierState(self.inner.flow(s.inner, m, u), 0.0)

    def correct(self, s: Any, m: Measurement) -> Any:
        return s._replace(inner=self.inner.correct(s.inner, m))

    def predict(self, s: Any, m: Measurement, u: Array) -> Any:
        """The inner state at the next sample instant; this one is counted if the torque u breaks a bound."""
        # [0]: d, how far the bound is exceeded; by round-off alone it counts as kept
        # _ROUND_OFF: a bound exceeded by less counts as kept
        infeasible: Any = np.where(abs(self.missing(s.inner, m, u)[0]) > _ROUND_OFF, 1.0, 0.0)
        return BarrierState(self.inner.predict(s.inner, m, u), s.infeasible + infeasible)

    def jump(self, s: Any, after: Measurement, swap: Indices) -> Any:
        return s._replace(inner=self.inner.jump(s.inner, after, swap))

    def estimate(self, s: Any, m: Measurement) -> Estimate | None:
        return self.inner.estimate(s.inner, m)


def infeasible_instants(s: Any) -> int | None:
    """Number of infeasible sample instants that a controller's state s has counted; None without a barrier in
    it, or where the walk left no finite state.
    """
    # wrappers around the barrier have its state inside of theirs
    while not isinstance(s, BarrierState):
        if not hasattr(s, "inner"):
            return None
        s = s.inner
    return round(float(s.infeasible)) if np.isfinite(s.infeasible) else None
