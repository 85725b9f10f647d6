"""Multipliers of a walking cycle by the variational equation, without differences of the return map.

    x' = f(x),            Phi' = A(x) Phi,   A = df/dx         in single support
    dP/ds = E Pi Phi D Delta L,   Pi = 1 - f- dh / (dh f-)     from just before an impact to the next one

    x = (q, q')    state (2 n,) [rad, rad/s]; q_N, the last of q, is the unactuated pitch
    s              section coordinates (2 n - 1,): x without q_N, which the swing foot on the ground gives back
    P              return map, from s just before one impact to s just before the next
    h, dh          height of the swing foot over the ground [m], and the row dh/dx
    L              ds -> dx, with q_N changed so that h stays 0
    Delta, D Delta impact map and its derivative, from `model.derivatives`
    Phi            fundamental matrix dx(t)/dx(0), A by the derivatives of RNEA
    f-             flow x' just before the next impact
    E              matrix that drops q_N

The result is exact up to the error of the integration method. Pi is what the impact's time, which depends on s,
leaves of a change (Aizerman, Gantmacher, 1958; Leine, Nijmeijer, 2004).

The walker has to be in continuous time, without disturbances, and its controller without states; others are
refused. A needs du/dx of the controller. This derivative alone is taken from a copy of the walker in sampled
time, as `analysis.tick_derivative` differentiates sample instants: the torque of a controller without states is
the same function of x there.
"""

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from biped_adrc.analysis.return_map import (
    MOST_ITERATIONS,
    PeriodicOrbit,
    ReturnMap,
    after_impact,
    newton_step,
    not_converged,
)
from biped_adrc.analysis.tick_derivative import tick_derivative
from biped_adrc.closed_loop.walker import Instant, Mode, Walker
from biped_adrc.core.errors import InputError, ModelError, SimulationError, SingularError
from biped_adrc.core.linear import sorted_eigenvalues
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import SampledTime
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.engine.run import compiled_plant
from biped_adrc.hybrid.system import Guard, HybridSystem
from biped_adrc.model.derivatives import acceleration_derivatives, impact_derivatives

TorqueDerivative = Callable[[Instant], Array]
"""A function of an instant of a walk: du/dx (p, 2 n) [N m/rad, N m s/rad] of the applied torque."""


def torque_derivative(walker: Walker) -> TorqueDerivative:
    """Make the function du/dx (p, 2 n) of an instant of a walk, for a law without states, x = (q, q').

    du/dx [N m/rad, N m s/rad] is exact for a law that compiles, by central differences for another one; rows of
    saturated motors are zero.
    """
    n, p = walker.plant.n, walker.plant.p
    if p == 0:
        return lambda i: np.zeros((0, 2 * n))
    limit = math.inf if walker.torque_limit is None else walker.torque_limit
    # a copy with the same law in sampled time: its u at a sample instant (tick) depends on x alone, so any
    # period will do
    twin = replace(walker, timing=SampledTime(1e-3), torque_limit=None)
    ticked = tick_derivative(twin, twin.layout_of(np.zeros(2 * n)))

    def at(i: Instant) -> Array:
        m = i.measurement
        # the twin's state is (q, q', u held); u before the tick does not matter, after it u is the law's torque
        x = np.concatenate((m.q, m.v, np.zeros(p)))
        # [1] is the derivative of the state after a tick: its rows of u, its columns of (q, q'); m.t - m.t_step
        # is the time at which the single support began
        du = ticked(m.t, x, Mode(m.step, m.t - m.t_step))[1][2 * n :, : 2 * n]
        return np.where(np.abs(i.u)[:, np.newaxis] >= limit, 0.0, du)

    return at


# -- the flow and the impact -----------------------------------------------------------------------
def flow_derivative(walker: Walker, i: Instant, du: Array) -> Array:
    """A = df/dx (2 n, 2 n) of single support at an instant i, x in [rad, rad/s]; du (p, 2 n): du/dx."""
    n, m = walker.plant.n, i.measurement
    # q'' computed once more for robots without motors: it is equal but for round-off, on which the digits of
    # their stored walks depend
    a = i.a if walker.plant.p else walker.plant.acceleration(m.q, m.v, i.force)
    plant = acceleration_derivatives(walker.plant, m.q, m.v, a)
    A = np.zeros((2 * n, 2 * n))
    A[:n, n:] = np.eye(n)
    A[n:, :n], A[n:, n:] = plant.dq, plant.dv
    # the part through the torque: B du/dx changes the generalised force, dforce is dq''/dforce
    A[n:] += plant.dforce @ (walker.plant.B @ du)
    return A


def height_derivative(walker: Walker, x: Array) -> Array:
    """dh/dx (2 n,) [m/rad] of the height h of the swing foot over the ground; zero for the rates in x."""
    n = walker.plant.n
    d_x, d_z = walker.plant.swing_foot_jacobian(x[:n])
    return np.concatenate((d_z + math.tan(walker.ground_slope) * d_x, np.zeros(n)))


def split_matrix(y: Array) -> tuple[Array, Array]:
    """x (k,) and Phi (k, k) of y = (x, Phi) (k + k^2,), x in [rad, rad/s]."""
    # the whole root of k + k^2, rounded down, is k
    k = math.isqrt(len(y))
    return y[:k], y[k:].reshape(k, k)


@dataclass(frozen=True)
class VariationalSystem(HybridSystem):
    """A walker with its fundamental matrix in single support: state y = (x, Phi), Phi (2 n, 2 n) row by row.

    A hybrid system of its own, so the ordinary simulator integrates it up to the next impact, which leaves y as
    it is. Raises InputError for a walker in sampled time or under a disturbance.
    """

    walker: Walker

    def __post_init__(self) -> None:
        if self.walker.sampled or self.walker.disturbance is not None:
            raise InputError(
                "the variational equation needs continuous time and no disturbance, the walker has "
                f"{self.walker.timing} and {self.walker.disturbance}: leave them out, or use ReturnMap.jacobian"
            )

    @cached_property
    def fast(self) -> Walker:
        """The walker with robot and reference in machine code where that can be."""
        # a robot without motors keeps Python's round-off, as stored walks start at its cycle; ModelError: of
        # one that is no planar tree; [0]: without the list of the compiled references
        with suppress(ModelError):
            return compiled_plant(self.walker)[0] if self.walker.plant.p else self.walker
        return self.walker

    @cached_property
    def torque_derivative(self) -> TorqueDerivative:
        """The function of an instant of the walk that gives du/dx (p, 2 n) [N m/rad, N m s/rad]."""
        return torque_derivative(self.walker)

    def flow(self, t: float, y: Array, mode: Mode) -> Array:
        """Time derivative (2 n + 4 n^2,) of y: the walker's flow [rad/s, rad/s^2], and A Phi."""
        x, Phi = split_matrix(y)
        i = self.fast.instant(t, x, mode)
        A = flow_derivative(self.fast, i, self.torque_derivative(i))
        return np.concatenate((i.measurement.v, i.a, (A @ Phi).ravel()))

    def guards(self, mode: Mode) -> tuple[Guard, ...]:
        """The walker's event functions, which read q alone, the first numbers of x and of y.

        At an impact only the mode changes: y keeps its value from before, for `differentiate_step`.
        """

        def impact(t: float, y: Array) -> tuple[Array, Mode] | None:
            # (x+, mode), or None: no impact
            after = self.walker.strike(t, split_matrix(y)[0], mode)
            return None if after is None else (y, after[1])

        # the first event function is the foot's strike, the others end the run
        strike, *ends = self.walker.guards(mode)
        return replace(strike, reset=impact), *ends


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
    duration: float
    """Duration of the single support [s]."""
    flow_residual: float
    """max |Phi f(0) - f-| / max |f-|: zero for the exact Phi of a flow that does not depend on time."""
    end_flow: Array
    """f- in section coordinates (2 n - 1,): how the image moves per second that the event is found late."""
    earlier: Array
    """-dt/ds (2 n - 1,) [s/rad, s^2/rad] of the time t of impact: dP/ds has the part minus f- times this."""

    @property
    def multipliers(self) -> ComplexArray:
        """Eigenvalues of dP/ds (2 n - 1,), the largest magnitude first; multipliers of
        the cycle when P(s) = s.
        """
        return sorted_eigenvalues(self.jacobian)


def differentiate_step(P: ReturnMap, s: Array) -> StepDerivative:
    """Compute P(s) and dP/ds at s (2 n - 1,) [rad, rad/s] along one single support, with P's walker and method.

    Raises SimulationError, with the status, when the walker does not come back; InputError for a controller
    with states, and as VariationalSystem does.
    """
    # k: index of q_N, which s does not contain; x: the state before impact at s
    walker, k, x = P.walker, P.walker.plant.n - 1, P.lift(s)
    if len(x) != 2 * walker.plant.n:
        raise InputError(
            f"{type(walker.controller).__name__} has states of its own, the variational equation is written "
            "for controllers without: use ReturnMap.jacobian"
        )
    x0, mode = after_impact(walker, 0.0, x, Mode())
    # (x+, Phi = 1) after the impact; end: the next impact, with y = (x, Phi) just before it
    start = np.concatenate((x0, np.eye(len(x)).ravel()))
    end = P.next_impact(VariationalSystem(walker), start, mode)
    x_end, Phi = split_matrix(end.x_minus)
    f0, f_end = walker.flow(0.0, x0, mode), walker.flow(end.t, x_end, mode)
    dh = height_derivative(walker, x_end)
    rate = float(dh @ f_end)  # dh/dt at impact, below 0 [m/s]
    D = impact_derivatives(walker.plant, *np.split(x, 2))
    # through: dx/ds at the time of the next impact, kept fixed
    through = Phi @ D @ section_tangent(walker, x)
    # dh/ds at a fixed time; over `rate` it is -dt/ds of the impact's time t
    earlier = dh @ through
    through -= np.outer(f_end, earlier) / rate
    return StepDerivative(
        s=s,
        image=P.project(x_end),
        jacobian=np.delete(through, k, axis=0),
        duration=end.t,
        flow_residual=float(np.max(np.abs(Phi @ f0 - f_end)) / np.max(np.abs(f_end))),
        end_flow=np.delete(f_end, k),
        earlier=earlier / rate,
    )


def section_tangent(walker: Walker, x: Array) -> Array:
    """L (2 n, 2 n - 1): change dx of the state x (2 n,) per change ds of the section coordinates, with h = 0
    unchanged.

    dh dx = 0 gives the row of q_N, which has the index k in x; all other rows are those of the unit matrix.
    """
    k, dh = walker.plant.n - 1, height_derivative(walker, x)
    L = np.delete(np.eye(len(x)), k, axis=1)
    L[k] = np.delete(dh, k) / -dh[k]
    return L


def periodic_orbit(
    P: ReturnMap, guess: Array, tolerance: float = 1e-11
) -> tuple[PeriodicOrbit, StepDerivative]:
    """Find P(s) = s by Newton's method with the exact dP/ds, from a state before impact (2 n,) [rad, rad/s].

    tolerance: bound on max |P(s) - s| [rad, rad/s]. Newton converges quadratically; it begins at the fixed
    point of the compiled map where there is one. Raises SimulationError when it does not converge or the walker
    does not come back, SingularError when a multiplier is 1.
    """
    s = P.project(np.asarray(guess, dtype=float))
    # a start that costs little: the compiled map's fixed point by differences, if it finds one
    if P.compiled(x := P.lift(s)) is not None:
        # differentiate_step below costs as much as a hundred steps of the compiled map
        with suppress(SimulationError, SingularError):
            s = P.project(P.fixed_point(x, tolerance).x_minus)
    for _ in range(MOST_ITERATIONS):
        step = differentiate_step(P, s)
        gap = step.image - s
        residual = float(np.max(np.abs(gap)))
        if residual < tolerance:
            return PeriodicOrbit(P.lift(s), step.multipliers, residual), step
        s = s + newton_step(step.jacobian, gap)
    raise not_converged(residual, tolerance)
