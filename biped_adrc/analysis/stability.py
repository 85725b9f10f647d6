"""Whether a walking cycle is stable: its multipliers by two methods side by side, and which to trust.

P is the return map from just before one impact to just before the next. Its point is s (k,) [rad, rad/s]: q and
q' without q_N, the unactuated pitch, which the swing foot on the ground gives; then the controller's states.
The multipliers of a cycle, P(s) = s, are the eigenvalues lambda of dP/ds; it is stable if all |lambda| < 1.

    variational             eigenvalues of dP/ds by the variational equation, no differences
    central differences     eigenvalues of dP/ds by differences of the return map at two widths d and d / 2,
                            extrapolated: (4 J(d/2) - J(d)) / 3 is dP/ds up to d^4 and round-off / d

Both find dP/ds in independent ways, so their agreement is evidence. Where the variational equation doubts its
own result it says why. Two sets of multipliers are compared in pairs, one from each set. Of all ways to
make pairs the one with the least sum of distances is taken; distances are divided by the tolerance.

    cycle_stability(cycle)   fixed point, and the multipliers of each method in one table

`scenario.cycle` has the return map of a scenario. A controller with states (an observer) has these behind the
mechanical ones in the state of the map; then only central differences apply.

    x-, x+         state (q, q', controller's states) just before and just after an impact
    q_b = h(Theta) the constraint that the joints q_b follow; the phase Theta = c q [rad] times the gait
    hybrid invariant   a constraint that the impact does not leave
    Phi            fundamental matrix of the variational equation along the step, Phi = dx(t)/dx(0)
    flow           f = x'; f- is that just before the next impact; Phi f(0) = f- for an exact Phi
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.analysis.certificate import Certificate, certificates
from biped_adrc.analysis.return_map import PeriodicOrbit, ReturnMap, after_impact
from biped_adrc.analysis.signals import signals
from biped_adrc.analysis.variational import StepDerivative, periodic_orbit
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Passive
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import SimulationError
from biped_adrc.core.linear import sorted_eigenvalues
from biped_adrc.core.shown import Shown, columns
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.published import passive_cycle
from biped_adrc.gait.reference import ZeroReference
from biped_adrc.gait.zero_dynamics import ZeroDynamics, impact_jump
from biped_adrc.hybrid.constants import XRTOL, XTOL
from biped_adrc.hybrid.integrators import Adaptive
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import Limits

VARIATIONAL, CENTRAL = "variational equation", "central differences"
"""Names of the methods."""
RELATIVE, ABSOLUTE = 1e-6, 1e-7
"""Tolerances with which two multipliers agree: relative to the larger one, or absolute."""
FLOW = 1e-5
"""The largest `StepDerivative.flow_residual` with which the variational equation is trusted."""
INVARIANCE = 1e-6
"""The largest `invariance_gap` with which a constraint counts as hybrid invariant [rad, rad/s]."""
SETTLES = 1e-9
"""Largest residual of Newton's method [rad, rad/s]; with feet of 1e-7 of the hip's mass round-off is 1e-10."""

APART = 1e-3
"""Longest step of a method with step control in `nominal_step` [s]."""


@dataclass(frozen=True)
class StabilityTable(Shown):
    """Multipliers (k,) by both methods, the largest magnitude first; `verdict` says whether they agree."""

    central: ComplexArray
    """By central differences."""
    variational: ComplexArray | None = None
    """By the variational equation; None for a controller with states."""
    noise: Array | float = 0.0
    """Bound (k,) of the error of differences, see `noise_of_differences`."""
    doubt: str = ""
    """Why the variational equation is not to be trusted; empty when it is."""

    @property
    def trusted(self) -> ComplexArray:
        """The multipliers of the variational equation, or of the differences where it is
        in doubt or does not apply.
        """
        return self.central if self.variational is None or self.doubt else self.variational

    @property
    def stable(self) -> bool:
        """Whether all trusted multipliers are inside the unit circle."""
        return bool(np.max(np.abs(self.trusted)) < 1.0)

    @property
    def agree(self) -> bool:
        """Whether the multipliers of both methods differ by at most the tolerance; True where only one is
        trusted."""
        return self.gap() <= 1.0

    def gap(self, noise: Array | float | None = None) -> float:
        """Largest distance of the two sets, in units of the tolerance: at most 1 when they agree, 0 where only
        one set is trusted. They are paired by size; where that does not agree, of all pairings that of least
        total distance counts.

        noise (k,): bound of the numerical error of each multiplier, which the tolerance is at least; the
        table's own if None, 0 for none.
        """
        if self.trusted is self.central:
            return 0.0
        a, b = self.central[:, np.newaxis], self.trusted[np.newaxis]
        allowed = np.maximum(ABSOLUTE, RELATIVE * np.maximum(np.abs(a), np.abs(b)))
        cost = np.abs(a - b) / np.maximum(allowed, self.noise if noise is None else noise)
        by_size = float(np.max(np.diagonal(cost)))
        if by_size <= 1.0:
            return by_size
        # SciPy's optimisers take half a second to load
        from scipy.optimize import linear_sum_assignment

        # it finds the pairs (rows, columns) of least total cost
        return float(np.max(cost[linear_sum_assignment(cost)]))

    @property
    def verdict(self) -> str:
        """Text of one or two sentences: why one of the two methods is not to be trusted, if so; whether the
        cycle is stable by the other, with its largest |lambda|.
        """
        name = CENTRAL if self.trusted is self.central else VARIATIONAL
        largest, end = np.max(np.abs(self.trusted)), "stable" if self.stable else "not stable"
        last = f"Trust the {name}: the cycle is {end}, the largest |lambda| is {largest:.6f}."
        if self.doubt:
            return f"{VARIATIONAL.capitalize()}: not to be trusted, {self.doubt}. {last}"
        if self.variational is None:
            return last
        gap, within = self.gap(), f"{RELATIVE:g} relative or {ABSOLUTE:g} absolute"
        # gap(0.0): whether they agree by the tolerances alone, or only within the noise
        if max(self.gap(0.0), gap) > 1.0:
            within += f" or what root finder and step leave open, at most {np.max(self.noise):.1e}"
        far = f"disagrees, {gap:.3g} times the tolerance of" if gap > 1.0 else "agrees within"
        return f"{CENTRAL.capitalize()}: {far} {within}. {last}"

    def text(self, count: int = 9) -> str:
        """The table as lines of text, the `count` largest |lambda| of each method, and the verdict."""
        methods = {VARIATIONAL: self.variational, CENTRAL: self.central}
        sizes = {name: np.abs(z)[:count] for name, z in methods.items() if z is not None}
        rows = [(name, " ".join(f"{x:.6e}" for x in size)) for name, size in sizes.items()]
        return "\n".join([*columns(rows, 28, gap=1), self.verdict])


# -- both methods ----------------------------------------------------------------------------------
def noise_of_differences(P: ReturnMap, step: StepDerivative) -> Array:
    """Bound (k,) of |delta lambda_i|, by which differences and variational equation may differ numerically.

        f-         d(q, q')/dt just before impact, in the coordinates of s (`end_flow`)
        t          time of the impact [s]; -dt/ds is `earlier`
        tau        error of the root finder in t [s]
        d          half width of the differences (`P.difference`), J(d) their Jacobian
        r          relative error of f- by the integration method (`flow_residual`)
        y_i, x_i   left and right eigenvectors of dP/ds (rows of y, columns of `right`)

    First error: an image P(s) is wrong by f- tau, so column j of (4 J(d/2) - J(d)) / 3 by f- eta_j, |eta_j| <=
    3 tau / d. Second error: dP/ds has the part f- dt/ds, in which differences see f- with the error r. To first
    order, with |.| entry by entry for vectors, and |.|_1 the sum of absolute values,

        |y_i x_i| |delta lambda_i| <= |y_i f-| (3 tau / d |x_i|_1 + r |dt/ds| |x_i|)
    """
    values, right = np.linalg.eig(step.jacobian)
    try:
        y, size = np.linalg.inv(right), np.abs(right)  # so y_i x_i = 1
    except np.linalg.LinAlgError:  # no basis of eigenvectors: to first order there is no bound
        return np.full(len(values), np.inf)
    # tau is XTOL + XRTOL t, the tolerances of the root finder; the result is in the order of the multipliers
    late = 3.0 * (XTOL + XRTOL * step.duration) / P.difference * np.sum(size, axis=0)
    late += step.flow_residual * np.abs(step.earlier) @ size
    noise: Array = np.abs(y @ step.end_flow) * late
    return noise[np.argsort(-np.abs(values))]


def central_multipliers(P: ReturnMap, s: Array) -> ComplexArray:
    """Multipliers (k,) by central differences at s (k,) [rad, rad/s], extrapolated from
    d = P.difference and d / 2.
    """
    wide, narrow = P.jacobian(s), replace(P, difference=0.5 * P.difference).jacobian(s)
    return sorted_eigenvalues((4.0 * narrow - wide) / 3.0)


def invariance_gap(biped: Biped, constraint: VirtualConstraint) -> float:
    """Distance of the state after impact from the constraint q_b = h(Theta); zero for a hybrid invariant one.

    + and - mark the state after and before the impact. The larger of max |q_b+ - h(Theta+)| [rad] and max
    |q_b'+ - h' Theta'+| [rad/s], after an impact at the end of the constraint with |Theta'-| = 1 rad/s.
    """
    q, v = ZeroDynamics.of(biped, constraint).end_state(1.0)
    # end_state has sigma = 1; the rates are scaled to |Theta'-| = 1 rad/s
    jump = impact_jump(biped, constraint, q, v / abs(float(constraint.phase @ v)))
    return float(np.max(np.abs(jump)))


def stability_table(P: ReturnMap, step: StepDerivative) -> StabilityTable:
    """Compute multipliers by both methods at the fixed point, as `variational.periodic_orbit` finds it.

    P: the return map. step: dP/ds by the variational equation along one walking step from the fixed point. The
    variational equation is doubted when Phi f(0) is not f-, the flow before the next impact, by more than FLOW
    (`StepDerivative.flow_residual`). Central differences of P cost 4 steps of walking per coordinate.
    """
    doubt = ""
    if not step.flow_residual <= FLOW:
        doubt = (
            f"its Phi misses (q', q'') before the impact by {step.flow_residual:.1e}, allowed {FLOW:g}: "
            "shorten the integration step, or see whether the law depends on time or has corners"
        )
    central, noise = central_multipliers(P, step.s), noise_of_differences(P, step)
    return StabilityTable(central, step.multipliers, noise, doubt)


# -- of a cycle -------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Cycle(Shown):
    """A return map and a state from which Newton's method finds its fixed point."""

    P: ReturnMap
    guess: Array
    """State x- just before impact, (2 n,) or with the controller's states behind [rad, rad/s]."""


LIGHT_FEET = 5e-4
"""Half width of central differences of the return map P for robots without motors [rad, rad/s]: wider than
usual, since light feet leave a round-off of 1e-10 in P."""


def known_cycle(biped: Biped, slope: float | None = None) -> Cycle:
    """The stored cycle of a robot without motors, with a guess of its fixed point.

    slope [rad]: of the ground, near the one for which the cycle is stored; None for that one. Raises GaitError
    when none is stored, SimulationError when the robot does not come to a first impact.
    """
    # pitch: q_N of these robots is the angle of a leg, pi where vertical; the search for q_N begins there.
    # LIGHT_FEET: a wider difference of P for these robots, whose light feet make more round-off. 1e-12: rtol
    # and atol of the integration method, for the same reason
    known = passive_cycle(biped)
    angle = known.slope if slope is None else slope
    walker = Walker(biped, Passive(), slope=angle, max_step_time=known.max_step_time)
    P = ReturnMap(walker, Adaptive(1e-12, 1e-12), difference=LIGHT_FEET, pitch=math.pi)
    # From the stored state after impact, in the first single support (Mode()), to the first impact; P simulates
    # any system that contains its walker, here the walker itself
    start = walker.initial_state(known.q_plus, known.v_plus)
    return Cycle(P, P.next_impact(walker, start, Mode()).x_minus)


def cycle_start(biped: Biped, slope: float) -> tuple[Array, Array]:
    """(q, v), each (n,) [rad, rad/s], just after impact in the cycle of a robot without motors; slope [rad].

    Raises SimulationError where Newton's method finds no cycle.
    """
    # SETTLES: residual [rad, rad/s] at which Newton's method stops; the second result, the derivative of the
    # step, is not needed
    cycle, n = known_cycle(biped, slope), biped.n
    orbit, _ = periodic_orbit(cycle.P, cycle.guess, SETTLES)
    after = biped.impact(orbit.x_minus[:n], orbit.x_minus[n:])
    return after.q, after.v


@dataclass(frozen=True)
class CycleStability(Shown):
    """The fixed point of a return map and its multipliers by every method that applies."""

    orbit: PeriodicOrbit
    """The fixed point, its residual, and its multipliers."""
    table: StabilityTable
    """Multipliers by method, and whether they agree."""


def cycle_stability(cycle: Cycle) -> CycleStability:
    """Find the fixed point of a cycle and its multipliers by every method.

    cycle: the walker, with a start near its cycle, as `cycle_of` makes it from a scenario.

    The methods are independent of each other, the variational equation along the step and central differences
    of the return map. That they agree is the test of each.

    For a controller with states only central differences apply, since the variational equation is written for
    the mechanics alone. Raises SimulationError when no fixed point is found.

    >>> from biped_adrc.scenario.cycle import cycle_of
    >>> stability = ba.cycle_stability(cycle_of(ba.Scenario("passive", robot="rimless_wheel")))
    >>> stability.table.stable
    True
    """
    check_part(cycle, "cycle", Cycle)
    P = cycle.P
    # a controller with states; where P starts it anew at each impact, P leaves them out of the guess
    if len(cycle.guess) > 2 * P.walker.plant.n:
        orbit = P.fixed_point(cycle.guess)
        return CycleStability(orbit, StabilityTable(orbit.multipliers))
    # the fixed point to the residual SETTLES, and dP/ds by the variational equation there
    orbit, step = periodic_orbit(P, cycle.guess, SETTLES)
    return CycleStability(orbit, stability_table(P, step))


def nominal_step(cycle: Cycle, orbit: PeriodicOrbit, limits: Limits | None = None) -> Certificate:
    """Certificate of the step at the fixed point: the forces and torques it needs, with these limits.

    limits: None for those of the robot's record. Certificates depend on states, torques and forces alone, so
    the signals are computed with a reference of zeros.

    Raises SimulationError where the step does not end with an impact.
    """
    P, walker = cycle.P, cycle.P.walker
    # start: (x+, mode) after the impact at the fixed point; the run stops after one more impact
    start = after_impact(walker, 0.0, orbit.x_minus, Mode())
    # the certificate's mean forces take the momentum as linear between nodes, which therefore have to be close
    method = P.method
    if isinstance(method, Adaptive):
        # APART: longest step of a method with step control
        method = replace(method, max_step=APART)
    run = simulate_by(P.engine, walker, *start, method, impacts=1, t_end=walker.max_step_time)
    if not run.status.ok:
        raise SimulationError(f"the step of the cycle ended before: {run.status.name}")
    along = signals(walker, run, ZeroReference(walker.plant.p))
    # of the one step there is one certificate
    return certificates(walker, run, along, limits)[0]
