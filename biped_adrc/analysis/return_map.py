"""The Poincare return map on the impact section, (24) of the paper, its fixed point (25) and its multipliers.

    P: x-(k) -> x-(k + 1),   P(x*) = x*            x- = state before impact k, x* = fixed point

P takes a state just before impact through the impact and one single support to the next impact. On the section
the swing foot is on the ground, so the ten numbers of (q, q') of the robot RABBIT have nine degrees of freedom.
Section coordinates s drop q_N, the unactuated pitch, which the height of the swing foot gives back. The
controller's states are coordinates too: without them the map of a closed loop with an observer is that of
another system, except when the reset at impact forgets them. c is their number, n that of the coordinates q.

P runs in compiled code, several points in parallel, or step by step with Pinocchio where a part of
the walker cannot be compiled. dP/ds is by differences here; `variational` has it without.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import tan

import numpy as np

from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.core.checks import Checked
from biped_adrc.core.errors import InputError, ModelError, SimulationError
from biped_adrc.core.linear import solve, sorted_eigenvalues
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.program import COMPILED, CompiledWalker
from biped_adrc.engine.run import check_engine
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import HybridSystem
from biped_adrc.hybrid.trajectory import Event

MOST_ITERATIONS = 12
"""Largest number of iterations of Newton's method on P(s) - s."""
_CHORD = 0.1
"""An iteration that leaves more than this share of the residual has dP/ds computed anew for the next one."""


@dataclass(frozen=True)
class PeriodicOrbit(Shown):
    """A fixed point of the return map with its multipliers."""

    x_minus: Array
    """State before impact (2 n + c,): q [rad], q' [rad/s], then the c states of the controller."""
    multipliers: ComplexArray
    """Eigenvalues of dP/ds, the largest magnitude first; dimensionless."""
    residual: float
    """max |P(s) - s| [rad, rad/s]."""

    @property
    def stable(self) -> bool:
        """Whether all multipliers are inside the unit circle."""
        return bool(np.max(np.abs(self.multipliers)) < 1.0)


@dataclass(frozen=True)
class ReturnMap(Checked, Shown):
    """The map P in section coordinates s, for a walker and an integration method.

    Raises InputError for a walker with noise, whose state never returns.

    >>> P = ba.ReturnMap(ba.Walker(biped, ba.NPDController(gait.constraint)), ba.RK4(1e-3))
    >>> s = P.project(np.append(gait.q_minus, gait.v_minus))
    >>> bool(np.all(np.abs(P(s) - s) < 1e-4))
    True
    """

    walker: Walker
    """The closed loop."""
    method: OneStepMethod
    """Integration method of the flow."""
    controller_states: bool = True
    """Whether the controller's states are coordinates; False starts the controller anew at each passage."""
    difference: float = 1e-5
    """Half width of the central differences [rad, rad/s]."""
    pitch: float = 0.0
    """Initial value of q_N in the search of `lift` [rad]."""
    engine: str = COMPILED
    """Engine: "compiled" or "pinocchio", which also replaces it where a part has no compiled form."""

    def __post_init__(self) -> None:
        check_engine(self.engine)
        w = self.walker
        if w.touchdown is not None or (w.sensors is not None and w.sensors.noisy):
            raise InputError(
                "the walker has noise in its sensors, or a controller that has to notice touchdowns and counts "
                "them, so its state never returns; expected one without it for a return map"
            )

    @property
    def _dropped(self) -> int:
        """Index of q_N in the state."""
        return self.walker.plant.n - 1

    def project(self, x: Array) -> Array:
        """Section coordinates s (2 n - 1 + c,) of a state x before impact (2 n + c,) [rad, rad/s].

        s is x without q_N, and, if `controller_states` is False, without the controller's states too (c = 0).
        """
        end = len(x) if self.controller_states else 2 * self.walker.plant.n
        return np.delete(x[:end], self._dropped)

    def lift(self, s: Array) -> Array:
        """The state before impact (2 n + c,) of section coordinates s (2 n - 1 + c,) [rad, rad/s].

        q_N is found by Newton's method, such that the swing foot is on the ground. Raises
        SimulationError where no pitch does that.
        """
        # at most 50 iterations, to round-off of the height [m]; 1e-12 m is the error that is accepted
        x = np.insert(s, self._dropped, self.pitch)
        plant, n = self.walker.plant, self.walker.plant.n
        for _ in range(50):
            height = self.walker.clearance(x[:n])
            d_x, d_z = plant.swing_foot_jacobian(x[:n])[:, -1]
            x[self._dropped] -= height / (d_z + tan(self.walker.ground_slope) * d_x)
            if abs(height) < 1e-15:
                break
        if abs(self.walker.clearance(x[:n])) > 1e-12:
            raise SimulationError("no torso angle puts the swing foot of this state on the ground")
        if not self.controller_states:  # a controller that is started anew
            x = self.walker.initial_state(x[:n], x[n : 2 * n])
        return x

    def __call__(self, s: Array) -> Array:
        """The return map P: section coordinates before the next impact from those before this one, s
        (2 n - 1 + c,) [rad, rad/s].

        Raises SimulationError, with the status, when the walker does not come back.
        """
        return self.images([s])[0]

    def images(self, points: Sequence[Array]) -> list[Array]:
        """P of several points s (2 n - 1 + c,) [rad, rad/s], in parallel threads where it is compiled.

        Raises SimulationError, with the status, when the walker does not come back.
        """
        starts = [after_impact(self.walker, 0.0, self.lift(s), Mode()) for s in points]
        compiled = self.compiled(starts[0][0])
        if compiled is None:
            return [self.project(self.next_impact(self.walker, *x).x_minus) for x in starts]
        from biped_adrc.engine.batch import strides

        # strides: the runs from all starts to their next impact. The walker's own limit max_step_time comes
        # first; the time given here only ends every run
        images = strides(compiled, starts, 2.0 * self.walker.max_step_time)
        for walked in images:
            if not walked.status.ok:
                raise _no_return(walked.status, walked.detail)
        return [self.project(walked.x_minus[-1]) for walked in images]

    def compiled(self, x: Array) -> CompiledWalker | None:
        """The compiled walker for states with the layout of x (2 n + c,); None without a compiled form."""
        if self.engine != COMPILED:
            return None
        try:
            return CompiledWalker.of(self.walker, self.method, self.walker.layout_of(x))
        except (NotCompiled, ModelError):
            return None

    def next_impact(self, system: HybridSystem, x: Array, mode: Mode) -> Event:
        """Simulate a walker, or a system that contains one, from x (2 n + c,) after impact to its next impact.

        mode: number and start [s] of the single support.
        Raises SimulationError, with the status, when there is none.
        """
        # the walker's own limit max_step_time comes first; this one only ends every run
        limit = 2.0 * self.walker.max_step_time
        run = simulate(system, x, mode, self.method, t_end=limit, stop_after=(FOOT_STRIKE, 1))
        if not run.status.ok:
            raise _no_return(run.status, run.detail)
        return run.events(FOOT_STRIKE)[-1]

    def jacobian(self, s: Array) -> Array:
        """dP/ds (2 n - 1 + c, 2 n - 1 + c) by central differences of half width `difference` [rad, rad/s]."""
        d = self.difference
        # s + d e and s - d e by turns, along each coordinate
        points = [s + sign * d * e for e in np.eye(len(s)) for sign in (1.0, -1.0)]
        images = self.images(points)
        return np.array([(images[2 * i] - images[2 * i + 1]) / (2.0 * d) for i in range(len(s))]).T

    def fixed_point(self, guess: Array, tolerance: float = 1e-9) -> PeriodicOrbit:
        """Find P(s) = s by Newton's method from a state before impact `guess` (2 n + c,).

        guess: q (n,) [rad], q' (n,) [rad/s], then the c other numbers of the walker's state, those of the
        controller and of what is held between sample instants, in their own units. tolerance: of the largest
        |P(s) - s| of all section coordinates, each in its own unit. dP/ds is kept from iteration to iteration
        while this residual falls fast enough, since it costs 2 returns per coordinate; it is computed anew at
        the fixed point.
        Raises SimulationError when the iteration does not converge or the walker does not come back,
        SingularError when a multiplier is 1.
        """
        s = self.project(np.asarray(guess, dtype=float))
        J, s_J, previous = self.jacobian(s), s, np.inf
        for _ in range(MOST_ITERATIONS):
            gap = self(s) - s
            residual = float(np.max(np.abs(gap)))
            done = residual < tolerance
            # J is dP/ds at s_J, and no longer that at s once s has moved by more than the differences
            stale = float(np.max(np.abs(s - s_J))) > self.difference
            # too slow: more than the share _CHORD of the residual is left
            if stale and (done or residual > _CHORD * previous):
                J, s_J = self.jacobian(s), s
            if done:
                return PeriodicOrbit(self.lift(s), sorted_eigenvalues(J), residual)
            s, previous = s + newton_step(J, gap), residual
        raise not_converged(residual, tolerance)


def _no_return(status: Status, detail: str) -> SimulationError:
    """The error of a walk that ended before the next impact, with its status."""
    return SimulationError(f"no return to the section: {status.name}, {status.value} {detail}")


def after_impact(walker: Walker, t: float, x: Array, mode: Mode) -> tuple[Array, Mode]:
    """State x+ (2 n + c,) and mode after the impact of a walker in x (2 n + c,) [rad, rad/s] at t [s].

    mode: number and start [s] of the single support that ends with it. Raises SimulationError where the swing
    foot is behind the stance foot.
    """
    after = walker.strike(t, x, mode)
    if after is None:
        raise SimulationError("the swing foot is behind the stance foot: not an impact")
    return after


def newton_step(J: Array, gap: Array) -> Array:
    """Newton's step ds (k,) towards P(s) = s: (1 - J) ds = gap, with J = dP/ds (k, k), gap = P(s) - s (k,).

    Raises SingularError when 1 is a multiplier.
    """
    # the text names the matrix in the error
    return solve(np.eye(len(gap)) - J, gap, "1 - dP/ds, by which Newton looks for the cycle,")


def not_converged(residual: float, tolerance: float) -> SimulationError:
    """The error of Newton's method after MOST_ITERATIONS, with its residual and tolerance [rad, rad/s]."""
    return SimulationError(
        f"Newton on the return map did not converge in {MOST_ITERATIONS} iterations: "
        f"residual {residual:.3g}, expected below {tolerance:g}; start nearer to the orbit"
    )
