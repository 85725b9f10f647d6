"""Multipliers of a walking cycle by the variational equation and the saltation matrix of the impact.

    x' = f(x),            Phi' = A(x) Phi,   A = df/dx         in single support
    x+ = Delta(x-),       Phi+ = Xi Phi-                       at impact, h(x-) = 0
    Xi = D Delta + (f+ - D Delta f-) dh / (dh f-)

x = (q, q'), h the height of the swing foot over the ground, dh its row of derivatives, f- and f+
the flow before and after impact (Aizerman, Gantmacher, 1958; Leine, Nijmeijer, 2004). The return
map (24) is not differenced: A comes from the derivatives of RNEA, D Delta from those of the impact
map (`model.derivatives`). The result is exact up to the error of the integration method.

On the section, with E the matrix that drops q_N and L = ds -> dx the tangent that keeps h = 0,

    dP/ds = E Pi Phi D Delta L,   Pi = 1 - f- dh / (dh f-),

since Xi L = D Delta L. Xi Phi has the same multipliers and the 1 of a flow that does not depend on
time.

The derivative of the torque is found by differentiating the law of NPD on a virtual constraint; for
any other controller without states it is a difference quotient of fourth order of the torque alone
(`DIFFERENCE`). Controllers with states, sampled time and disturbances are refused.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.analysis.return_map import (
    MOST_ITERATIONS,
    PeriodicOrbit,
    ReturnMap,
    after_impact,
    newton_step,
    not_converged,
    sorted_eigenvalues,
)
from biped_adrc.closed_loop.walker import Instant, Mode, Walker
from biped_adrc.control.npd import NPDController
from biped_adrc.control.passive import Passive
from biped_adrc.control.tracking import Gains
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.hybrid.system import Guard, HybridSystem
from biped_adrc.hybrid.trajectory import Event
from biped_adrc.linear import solve
from biped_adrc.model.derivatives import (
    acceleration_derivatives,
    impact_derivatives,
    torque_derivatives,
)
from biped_adrc.shown import Shown
from biped_adrc.types import Array, ComplexArray

DIFFERENCE = 2e-4
"""Width of the quotient of the torque [rad, rad/s]; NPD's is within 1e-10 of its derivative, relatively."""


# -- the torque ------------------------------------------------------------------------------------
def torque_derivative(walker: Walker, i: Instant) -> Array:
    """du/dx (p, 2 n) [N m/rad, N m s/rad] of the applied torque at an instant of the walk.

    Zero for passive walkers and in the rows of saturated motors, exact for NPD, by differences for
    other controllers.
    """
    law = walker.law
    if type(law) is Passive:
        return np.zeros((walker.plant.p, 2 * walker.plant.n))
    # a subclass may have an output of its own, which is not (28)
    if type(law) is NPDController and type(law.reference) is VirtualConstraint:
        du = npd_derivative(walker, law, law.reference, i)
    else:
        du = differenced_torque(walker, i)
    if walker.torque_limit is not None:
        du[np.abs(i.u) >= walker.torque_limit] = 0.0
    return du


def npd_derivative(walker: Walker, law: NPDController, h: VirtualConstraint, i: Instant) -> Array:
    """du/dx (p, 2 n) [N m/rad, N m s/rad] of (28), from two equations.

    They hold for the torque u and the acceleration a that it demands of the nominal model:

        D a + Omega - B u = 0,   a_b - H a - drift - f = 0

    (H a is absent where h' Theta'' is dropped, as printed). Both are differentiated at fixed (a,
    u).
    """
    m, n, p = i.measurement, walker.plant.n, walker.plant.p
    B, H = walker.nominal.B, law.reference(m.t, m.q, m.v).H
    u = i.u if walker.torque_limit is None else law.output(i.s, m)
    a = solve(m.terms.D, B @ u - m.terms.Omega, "D_s")
    by_q, by_v = torque_derivatives(walker.nominal, m.q, m.v, a)
    loop = 1.0 if law.solve_theta else 0.0
    wanted = _wanted_derivative(h, law.gains, m.q, m.v, loop * float(h.phase @ a))
    K = np.block([[m.terms.D, -B], [B.T - loop * H, np.zeros((p, p))]])
    rhs = np.vstack((-np.hstack((by_q, by_v)), wanted))
    return solve(K, rhs, "the matrix of (28)")[n:]


def _wanted_derivative(
    h: VirtualConstraint, gains: Gains, q: Array, v: Array, rate2: float
) -> Array:
    """d/dx (p, 2 n) of h' Theta'' + drift + f at fixed Theta'' = rate2 [rad/s^2], q, v (n,) [rad, rad/s]."""
    c, p = h.phase, h.curve.coefficients.shape[0]
    theta, rate = float(c @ q), float(c @ v)
    _, h1, h2 = h.h(theta)
    h3 = third_derivative(h, theta)
    K_p, K_d = (np.broadcast_to(k, p)[:, np.newaxis] for k in (gains.K_p, gains.K_d))
    S = np.eye(p, len(c))
    tangent = S - np.outer(h1, c)
    by_q = np.outer(h3 * rate**2 + h2 * rate2, c) + K_d * np.outer(h2 * rate, c) - K_p * tangent
    by_v = 2.0 * np.outer(h2 * rate, c) - K_d * tangent
    return np.hstack((by_q, by_v))


def third_derivative(h: VirtualConstraint, theta: float) -> Array:
    """d3h/dTheta3 (p,) [1/rad^2] at theta [rad], from the power coefficients of the curve."""
    s, power = h.rate * (theta - h.theta_plus), h.curve.powers[1:]
    second = np.split(h.curve.piece(s), 3)[2][:, 1:]
    return h.rate**3 * (second * power) @ s ** (power - 1.0)


def differenced_torque(walker: Walker, i: Instant, difference: float = DIFFERENCE) -> Array:
    """du/dx (p, 2 n) of any law without states, by differences of fourth order, before saturation.

    difference: their width [rad, rad/s].
    """
    m, n, d = i.measurement, walker.plant.n, difference
    mode = Mode(m.step, m.t - m.t_step)

    def u(dx: Array) -> Array:
        return walker.law.output(i.s, walker.measure(m.t, m.q + dx[:n], m.v + dx[n:], mode))

    columns = [
        (8.0 * (u(d * e) - u(-d * e)) - (u(2 * d * e) - u(-2 * d * e))) / (12.0 * d)
        for e in np.eye(2 * n)
    ]
    return np.array(columns).reshape(2 * n, -1).T


# -- the flow and the impact -----------------------------------------------------------------------
def flow_derivative(walker: Walker, i: Instant) -> Array:
    """A = df/dx (2 n, 2 n) of single support at an instant, from its torque and force; x in [rad, rad/s]."""
    n, m = walker.plant.n, i.measurement
    plant = acceleration_derivatives(walker.plant, m.q, m.v, i.force)
    A = np.zeros((2 * n, 2 * n))
    A[:n, n:] = np.eye(n)
    A[n:, :n], A[n:, n:] = plant.dq, plant.dv
    A[n:] += plant.dforce @ (walker.plant.B @ torque_derivative(walker, i))
    return A


def height_derivative(walker: Walker, x: Array) -> Array:
    """dh/dx (2 n,) [m/rad] of the height of the swing foot over the ground; zero for rates."""
    n = walker.plant.n
    d_x, d_z = walker.plant.swing_foot_jacobian(x[:n])
    return np.concatenate((d_z + math.tan(walker.slope) * d_x, np.zeros(n)))


def saltation(walker: Walker, t: float, x: Array, mode: Mode) -> Array:
    """Xi (2 n, 2 n) of the impact at x- (2 n,) [rad, rad/s]. Raises SimulationError unless it is
    transversal.
    """
    struck = after_impact(walker, t, x, mode)
    n = walker.plant.n
    D = impact_derivatives(walker.plant, x[:n], x[n:])
    before, after = walker.flow(t, x, mode), walker.flow(t, *struck)
    dh = height_derivative(walker, x)
    return D + np.outer(after - D @ before, dh) / _descent(dh, before)


def _descent(dh: Array, f: Array) -> float:
    """dh f [m/s], the vertical velocity of the foot at the ground.

    Raises SimulationError unless the foot comes down: a grazing foot leaves no derivative.
    """
    rate = float(dh @ f)
    if not rate < 0.0:
        raise SimulationError(
            f"the swing foot meets the ground at {rate:.3g} m/s, expected downwards: where it only grazes, "
            "the return map has no derivative"
        )
    return rate


def split_matrix(y: Array) -> tuple[Array, Array]:
    """x (k,) and Phi (k, k) of y = (x, Phi) (k + k^2,), x in [rad, rad/s]."""
    k = math.isqrt(len(y))
    return y[:k], y[k:].reshape(k, k)


@dataclass(frozen=True)
class VariationalSystem(HybridSystem):
    """Walker and fundamental matrix together: state y = (x, Phi), Phi (2 n, 2 n) row by row.

    A hybrid system of its own, so the ordinary simulator integrates it. Raises InputError for a
    walker with states besides (q, q'), held torques or disturbances.
    """

    walker: Walker

    def __post_init__(self) -> None:
        w = self.walker
        if w.sampled:
            raise InputError(
                "the walker holds its torque between ticks, the variational equation needs continuous time: "
                "use ContinuousTime(), or ReturnMap.jacobian"
            )
        if w.disturbance is not None:
            raise InputError(
                "the walker is disturbed, so that its walk is no cycle: leave the disturbance out"
            )

    def start(self, x: Array) -> Array:
        """y (2 n + 4 n^2,) of x (2 n,) [rad, rad/s] with Phi = 1.

        Raises InputError for a controller with states.
        """
        size = 2 * self.walker.plant.n
        if len(x) != size:
            raise InputError(
                f"{type(self.walker.controller).__name__} has {len(x) - size} states of its own, the "
                "variational equation is written for controllers without: use ReturnMap.jacobian"
            )
        return np.concatenate((x, np.eye(size).ravel()))

    def flow(self, t: float, y: Array, mode: Mode) -> Array:
        """Time derivative (2 n + 4 n^2,) of y = (x, Phi): the walker's flow [rad/s, rad/s^2], and A
        Phi.
        """
        x, Phi = split_matrix(y)
        i = self.walker.instant(t, x, mode)
        A = flow_derivative(self.walker, i)
        return np.concatenate((i.measurement.v, i.a, (A @ Phi).ravel()))

    def guards(self, mode: Mode) -> tuple[Guard, ...]:
        """The walker's event functions on x, with Phi reset by the saltation matrix."""
        return tuple(self._lifted(guard, mode) for guard in self.walker.guards(mode))

    def _lifted(self, guard: Guard, mode: Mode) -> Guard:
        """One event of the walker as an event of y."""

        def reset(t: float, y: Array) -> tuple[Array, Mode] | None:
            x, Phi = split_matrix(y)
            struck = self.walker.strike(t, x, mode)
            if struck is None:
                return None
            Xi = saltation(self.walker, t, x, mode)
            return np.concatenate((struck[0], (Xi @ Phi).ravel())), struck[1]

        return replace(
            guard,
            witness=lambda t, y: guard.witness(t, split_matrix(y)[0]),
            reset=None if guard.reset is None else reset,
        )


# -- one step --------------------------------------------------------------------------------------
@dataclass(frozen=True)
class StepDerivative(Shown):
    """The return map and its derivative at one point; 2 n states, 2 n - 1 section coordinates."""

    s: Array
    """The point (2 n - 1,) [rad, rad/s]."""
    image: Array
    """P(s) (2 n - 1,) [rad, rad/s]."""
    jacobian: Array
    """dP/ds (2 n - 1, 2 n - 1)."""
    monodromy: Array
    """Xi Phi (2 n, 2 n), from the state after one impact to the state after the next."""
    duration: float
    """Of the single support [s]."""
    flow_residual: float
    """max |Phi f(0) - f-| / max |f-|: zero for the exact Phi of a flow that does not depend on time, so it
    shows a wrong A, a reference in time, and the error of the method."""
    end_flow: Array
    """f- in section coordinates (2 n - 1,): how the image moves per second that the event is found late."""
    earlier: Array
    """-dt/ds (2 n - 1,) [s/rad, s^2/rad] of the time t of impact: dP/ds has the part minus f- times this."""

    @property
    def multipliers(self) -> ComplexArray:
        """Eigenvalues of dP/ds (2 n - 1,), the largest magnitude first; those of the cycle when P(s) = s."""
        return sorted_eigenvalues(self.jacobian)


def differentiate_step(P: ReturnMap, s: Array) -> StepDerivative:
    """P(s) and dP/ds at s (2 n - 1,) [rad, rad/s] along one single support, with P's walker and method.

    Raises SimulationError, with the status, when the walker does not come back; InputError as
    VariationalSystem does.
    """
    walker, k, x = P.walker, P.walker.plant.n - 1, P.lift(s)
    (x0, mode), end = _single_support(P, x)
    assert end.x_plus is not None
    x_end, Phi = split_matrix(end.x_minus)
    f0, f_end = walker.flow(0.0, x0, mode), walker.flow(end.t, x_end, mode)
    dh = height_derivative(walker, x_end)
    D = impact_derivatives(walker.plant, *np.split(x, 2))
    through = Phi @ D @ section_tangent(walker, x)
    earlier = dh @ through
    through -= np.outer(f_end, earlier) / _descent(dh, f_end)
    residual = float(np.max(np.abs(Phi @ f0 - f_end)) / np.max(np.abs(f_end)))
    monodromy = split_matrix(end.x_plus)[1]
    return StepDerivative(
        s,
        P.project(x_end),
        np.delete(through, k, axis=0),
        monodromy,
        end.t,
        residual,
        np.delete(f_end, k),
        earlier / _descent(dh, f_end),
    )


def _single_support(P: ReturnMap, x: Array) -> tuple[tuple[Array, Mode], Event]:
    """Impact at x (2 n,), and the single support after it with its fundamental matrix: x+ with its
    mode, and the event of the next impact.
    """
    system = VariationalSystem(P.walker)
    y0 = system.start(x)
    struck = after_impact(P.walker, 0.0, x, Mode())
    y0[: len(x)] = struck[0]
    return struck, P.next_impact(system, y0, struck[1])


def section_tangent(walker: Walker, x: Array) -> Array:
    """L (2 n, 2 n - 1): dx of a change of the section coordinates, which drop q_N and keep h = 0."""
    k, dh = walker.plant.n - 1, height_derivative(walker, x)
    L = np.delete(np.eye(len(x)), k, axis=1)
    L[k] = np.delete(dh, k) / -dh[k]
    return L


def periodic_orbit(
    P: ReturnMap, guess: Array, tolerance: float = 1e-11
) -> tuple[PeriodicOrbit, StepDerivative]:
    """Newton's method on P(s) - s from a state before impact (2 n,) [rad, rad/s], with the exact dP/ds.

    Converges quadratically. Raises SimulationError when it does not converge or the walker does not
    come back, SingularError when a multiplier is 1.
    """
    s = P.project(np.asarray(guess, dtype=float))
    for iteration in range(1, MOST_ITERATIONS + 1):
        step = differentiate_step(P, s)
        gap = step.image - s
        residual = float(np.max(np.abs(gap)))
        if residual < tolerance:
            return PeriodicOrbit(P.lift(s), step.multipliers, residual, iteration), step
        s = s + newton_step(step.jacobian, gap)
    raise not_converged(residual, tolerance)
