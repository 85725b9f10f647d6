"""A filter of the torque that keeps the swing foot on its way to the stone: exponential control barriers.

The foot is x(q) ahead of the stance foot, a sum of turned vectors (`model.planar`), and x_r(Theta) where the
reference in force has it, with c q_r = Theta. The corridor is about x_c, and ends on the stone L, also where
the reference steps to L_r:

    b_1 = tol - e,   b_2 = tol + e,   e = x - x_c,   x_c = x_r + (L - L_r) beta(x_r / L_r)

beta rises from 0 where the foot passes the stance foot to 1 at the end. With q_N'' = A_N q_b'' + a_N of (12),

    e'' = G q_b'' + g,   q_b'' = kappa u + xi^

xi^ is the estimate of the observer inside, with all in it that the model does not know; without one it is the
model's xi. The conditions b'' + 2 lambda b' + lambda^2 b >= 0 (both poles at -lambda) bound one number:

    |e'' + 2 lambda e' + lambda^2 e| <= lambda^2 tol

Of all torques that keep it that one acts whose q_b'' is nearest to that of the controller inside, a, by
|q_b'' - a|^2: its error dynamics are double integrators of the joints, which count alike whatever their
inertia. It is a quadratic program in closed form, q_b'' = a + G' d / |G|^2, where d is what is missing to the
nearer bound, 0 inside.

The bounds never exclude each other, but the limit of the torque, which is not in the program, may. An instant
at which the torque that acts does not keep them is *infeasible*; in sampled time the last number of the state
counts them.

Nguyen, Hereid, Grizzle, Ames, Sreenath, 3D dynamic walking on stepping stones with control barrier functions,
CDC 2016; Nguyen, Sreenath, Exponential control barrier functions, ACC 2016.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.control.around import Around
from biped_adrc.control.base import Controller, Measurement, nested
from biped_adrc.control.outer_loop import OuterLoop, own_reference, tracked_constraint
from biped_adrc.core.checks import PositiveFloat
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array, Indices
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import length_of
from biped_adrc.model.planar import LinkPoint, Turned, jacobian, point, turned
from biped_adrc.model.planar_robot import robot_of
from biped_adrc.observers.base import Estimate

ROUND_OFF = 1e-6
"""Of e'' [m/s^2]: what is missing by less counts as kept."""


class FootError(NamedTuple):
    """e [m], e' [m/s] and e'' = G q_b'' + g [m/s^2] of the module."""

    e: float
    de: float
    G: Array
    """(p,) [m]."""
    g: float


@dataclass(frozen=True)
class FootBarrier(Around):
    """The module's filter around `inner`; its state is that of `inner` and the number of infeasible instants.

    biped: the robot of the nominal model. stones: L of the steps [m], the first one first; behind the last one
    nothing is filtered. step: L_r [m], None for a reference that steps on the stones, as in `Footstep`.
    tolerance: tol [m], less than that of the stones, since the foot may come down early or late. rate: lambda
    [1/s]. observed: whether xi^ is the observer's. Raises InputError when `inner` tracks no virtual constraint.

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
        """The swing foot as a point in closed form."""
        robot = robot_of(self.biped)
        A, K = robot.A.astype(float), robot.K
        return LinkPoint(A, K.foot_re, K.foot_im, np.zeros(len(A)))

    @derived
    def phase(self) -> Array:
        """c (n,) of Theta = c q."""
        return tracked_constraint(self.inner).phase

    def foot(self, q: Array, v: Array) -> tuple[float, float, Array, float]:
        """x [m], x' [m/s], dx/dq (n,) [m], and x'' [m/s^2] without q'' of the swing foot."""
        k, t = self.swing, turned(self.swing, q)
        rate2 = (k.A @ v) ** 2
        J: Any = jacobian(k, t, k.re, k.im)[0]
        x: Any = point(t, k.re, k.im)[0]
        turning: Any = point(Turned(t.c * rate2, t.s * rate2), k.re, k.im)[0]
        return x, J @ v, J, -turning

    def corridor(self, x: float, L: float) -> tuple[float, float, float]:
        """x_c [m] of a stone L [m], and two derivatives by x_r = x [m]."""
        L_r = L if self.step is None else self.step
        z = np.minimum(np.maximum(x / L_r, 0.0), 1.0)
        beta, dbeta = z**3 * (10.0 - 15.0 * z + 6.0 * z**2), 30.0 * (z * (1.0 - z)) ** 2
        ddbeta, far = 60.0 * z * (1.0 - z) * (1.0 - 2.0 * z), L - L_r
        return x + far * beta, 1.0 + far * dbeta / L_r, far * ddbeta / L_r**2

    def error(self, m: Measurement) -> FootError:
        """e at a measurement, of the nominal model."""
        c, p, terms = self.phase, len(m.terms.kappa), m.terms
        r = own_reference(self.inner)(m.t, m.q, m.v)

        def on_reference(theta: float, q_b: Array) -> Array:
            return np.append(q_b, (theta - c[:p] @ q_b) / c[p])

        q_r, v_r = on_reference(c @ m.q, r.q_d), on_reference(c @ m.v, r.dq_d)
        a_r = on_reference(0.0, r.drift)
        R = np.vstack((r.H, (c - c[:p] @ r.H) / c[p]))  # q_r'' = R q'' + a_r
        x, dx, J, ddx = self.foot(m.q, m.v)
        x_r, dx_r, J_r, ddx_r = self.foot(q_r, v_r)
        x_c, slope, bend = self.corridor(x_r, length_of(self.stones, m.step, 1.0))
        G = J - slope * (J_r @ R)
        g = ddx - slope * (ddx_r + J_r @ a_r) - bend * dx_r**2
        return FootError(
            x - x_c, dx - slope * dx_r, G[:p] + G[p:] @ terms.A_N, g + G[p:] @ terms.a_N
        )

    def missing(self, s: Array, m: Measurement, u: Array) -> tuple[float, Array]:
        """d [m/s^2] under the torque u (p,) [N m], and G (p,) [m]."""
        x = self.inner.estimate(s[:-1], m) if self.observed else None
        f, xi, k = self.error(m), m.terms.xi if x is None else x.disturbance, self.rate
        y = f.G @ (m.terms.kappa @ u + xi) + f.g + 2.0 * k * f.de + k * k * f.e
        bound = k * k * self.tolerance
        d: Any = np.maximum(-bound - y, 0.0) - np.maximum(y - bound, 0.0)
        d = np.where(m.step < len(self.stones) + 0.5, d, 0.0)
        return d, f.G

    def filtered(self, s: Array, m: Measurement, u: Array) -> Array:
        """The torque (p,) [N m] of the program, from that of the controller inside."""
        d, G = self.missing(s, m, u)
        return u + m.terms.kappa_inverse @ (G * (d / (G @ G)))

    def output(self, s: Array, m: Measurement) -> Array:
        return self.filtered(s, m, self.inner.output(s[:-1], m))

    def initial_state(self, m: Measurement) -> Array:
        return np.append(self.inner.initial_state(m), 0.0)

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        return np.append(self.inner.flow(s[:-1], m, u), 0.0)

    def correct(self, s: Array, m: Measurement) -> Array:
        return np.append(self.inner.correct(s[:-1], m), s[-1])

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        infeasible = np.where(abs(self.missing(s, m, u)[0]) > ROUND_OFF, 1.0, 0.0)
        return np.append(self.inner.predict(s[:-1], m, u), s[-1] + infeasible)

    def jump(self, s: Array, after: Measurement, swap: Indices) -> Array:
        return np.append(self.inner.jump(s[:-1], after, swap), s[-1])

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        return self.inner.estimate(s[:-1], m)


def infeasible_instants(controller: Controller, s: Array) -> int | None:
    """How many instants were infeasible until the state s (size,) of a controller; None without a barrier."""
    for c in nested(controller):
        if isinstance(c, FootBarrier):
            return round(float(s[-1])) if np.isfinite(s[-1]) else None
        s = c.parts(s)[0] if isinstance(c, OuterLoop) else s
    return None
