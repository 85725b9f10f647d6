"""Forced return map: what ground, a force and errors of masses do to a periodic walk, to first order.

    x_(k+1) = A x_k + B w_k,   y_k = C x_k + D w_k,   w = (h, F, mu),   y of (zeta-, zeta_m, T)

    x (nx,)    deviation from the periodic orbit of the state just before impact: q, q', controller's states
    h [m]      height of the ground where single support k ends, over that of its stance foot; < 0 for a drop
    F [N]      horizontal force on the hip, constant in that single support, forwards
    mu [1]     relative error of masses, of all bodies or of some, in it and in the impact before it
    sigma      angular momentum about the stance foot [kg m^2/s], of the robot without mu
    zeta-      sigma^2 / 2 just before landing, as a share of its value on the orbit [1]
    zeta_m     the same in the middle of the gait's range of Theta, the phase [1]
    T [s]      duration of the single support

x has q_N too, which `ReturnMap` drops: behind a step of the ground the feet are not level. So A has one
eigenvalue 0 more than dP/ds has, and the others in common. G(z) = D + C (z - A)^-1 B has three gains, of each
input to each output by itself,

    static         |G(1)|, for an input that stays
    H-infinity     max |G(e^(i omega))|, omega from 0 to pi: of the rms, for the worst input
    peak           |D| + sum |C A^k B|: the largest |y| for all inputs with |w| <= 1, an l1 norm

Strides in machine code are differenced with three widths 4 d, 2 d and d. Two of them give an extrapolation
without the error of order d^2: the last two the result, the first two `wider`. Their distance says how far the
result has converged, and a shorter step how good the method of integration is. In sampled time a touchdown that
moves across a sample instant makes a kink: d has to be small, as 1e-5. An exponential method has kinks of its
own, since its last steps are halved: there d is better large, as 1e-3, and the step short.
"""

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from biped_adrc.analysis.return_map import PeriodicOrbit, ReturnMap, after_impact
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError, SimulationError
from biped_adrc.core.linear import sorted_eigenvalues
from biped_adrc.core.shown import Shown, columns
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.disturbances.base import NO_PUSH
from biped_adrc.disturbances.force import HipForce
from biped_adrc.engine.batch import strides
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.model.ground import stepped
from biped_adrc.model.model_errors import ModelErrors

INPUTS, OUTPUTS = ("h", "F", "mu"), ("zeta-", "zeta_m", "T")
"""Names of inputs and outputs."""
WIDTHS = np.array([1.0, 1e3, 10.0])
"""Widths of the differences in h, F, mu [m, N, 1] for a width of 1 in the states."""
_ABOUT = 1e-4
"""Time before and after the middle [s], for the slope of zeta by Theta there."""
_SETTLED = 1e-6
"""The largest difference of the orbit's state to its image [rad, rad/s]."""


@dataclass(frozen=True)
class ForcedMap(Shown):
    """The linear map x_(k+1) = A x_k + B w_k, y_k = C x_k + D w_k, with w as INPUTS and y as OUTPUTS."""

    A: Array
    """dx_(k+1)/dx_k (nx, nx)."""
    B: Array
    """dx_(k+1)/dw_k (nx, 3)."""
    C: Array
    """dy_k/dx_k (3, nx)."""
    D: Array
    """dy_k/dw_k (3, 3)."""
    wider: "ForcedMap | None" = None
    """The same by wider differences; None for a map that is one itself."""

    @property
    def multipliers(self) -> ComplexArray:
        """Eigenvalues of A (nx,), the largest magnitude first."""
        return sorted_eigenvalues(self.A)

    def response(self, omega: Array) -> ComplexArray:
        """G(e^(i omega)) (K, 3, 3) [output per input] at angles omega (K,) [rad per step]."""
        z = np.exp(1j * omega)[:, np.newaxis, np.newaxis]
        G: ComplexArray = np.linalg.solve(z * np.eye(len(self.A)) - self.A, self.B)
        return self.D + self.C @ G

    @property
    def static(self) -> Array:
        """G(1) (3, 3) with its sign, a row for each output, a column for each input."""
        return self.response(np.zeros(1))[0].real

    def gains(self) -> Array:
        """Gains (3, 3, 3) [output per input]: static, H-infinity, peak; rows by output, columns by input.

        The last two are infinite for a cycle that is not stable.
        """
        poles, gains = self.multipliers, np.full((3, *self.D.shape), math.inf)
        gains[0] = np.abs(self.static)
        if (radius := abs(poles[0])) >= 1.0:
            return gains
        # narrow peaks are at the angles of the poles; around the largest values the grid becomes finer
        omega = np.union1d(np.linspace(0.0, math.pi, 129), np.abs(np.angle(poles)))
        for _ in range(8):
            top = np.unique(np.argmax(np.abs(self.response(omega)), axis=0))
            ends = omega[np.maximum(top - 1, 0)], omega[np.minimum(top + 1, len(omega) - 1)]
            omega = np.union1d(omega[top], np.linspace(*ends, 17))
        gains[1], gains[2] = np.max(np.abs(self.response(omega)), axis=0), np.abs(self.D)
        # to round-off; small eigenvalues of A may come late, in nx steps
        X, steps = self.B, len(self.A) + math.ceil(-37.0 / math.log(max(radius, 0.1)))
        for _ in range(steps):
            gains[2], X = gains[2] + np.abs(self.C @ X), self.A @ X
        return gains

    def text(self) -> str:
        """The gains as lines of text, each with its relative distance to the one by wider differences."""
        found, wider = self.gains(), (self.wider or self).gains()
        rows: list[tuple[str, ...]] = [("output", "input", "static", "H-infinity", "peak")]
        for i, j in np.ndindex(self.D.shape):
            pairs = zip(found[:, i, j], wider[:, i, j], strict=True)
            cells = (f"{g:.5g} ({abs(g - w) / g:.0e})" if g < math.inf else "inf" for g, w in pairs)
            rows.append((OUTPUTS[i], INPUTS[j], *cells))
        return "\n".join(columns(rows))


def forced(walker: Walker, w: Array, bodies: tuple[str, ...] = ()) -> Walker:
    """The walker with w = (h, F, mu) (3,) [m, N, 1] in single support 2, of which its controller knows nothing.

    bodies: those whose masses have the error mu, all where empty.
    """
    h, F, mu = w.tolist()
    wrong = ModelErrors(mass=dict.fromkeys(bodies or walker.plant.description.links, mu))
    # where mu is zero the model stays the plant, for which machine code computes less
    plant = wrong.apply(walker.plant) if mu else walker.plant
    walker = replace(walker, plant=plant, model=walker.nominal if mu else walker.model)
    push = (walker.disturbance or NO_PUSH) + HipForce(plant, (F, 0.0))
    # a stride begins with the impact of single support 1 and ends with that of 2
    ground = walker.ground_steps + stepped(np.array([-h]), 2)
    return replace(walker, disturbance=push if F else walker.disturbance, ground_steps=ground)


def _strides(
    P: ReturnMap, bodies: tuple[str, ...], phase: Array, w: Array, x: Array, end: float = math.inf
) -> Array:
    """Walk strides of P's walker, from states x (K, nx) before impact, under w (3,).

    bodies: those with the error mu. phase (n,): c in Theta = c q. Returns rows (K, nx + 3): state before the
    next impact or at `end` [s], sigma^2 / 2, Theta, time.
    """
    walker, plant = forced(P.walker, w, bodies), P.walker.plant
    if (compiled := replace(P, walker=walker).compiled(x[0])) is None:
        raise InputError(
            "walker or method have no machine code; expected RK4 or Exponential and parts that compile"
        )
    starts = [after_impact(walker, 0.0, each, Mode()) for each in x]
    rows = list[Array]()
    for walk in strides(compiled, starts, min(end, 2.0 * walker.max_step_time)):
        if end == math.inf and not walk.status.ok:
            raise SimulationError(f"no return to an impact: {walk.status.name} {walk.detail}")
        at = walk.x_minus[0] if end == math.inf else walk.final_state
        sigma = plant.angular_momentum(*np.split(at[: 2 * plant.n], 2))
        rows.append(np.array([*at, 0.5 * sigma**2, phase @ at[: plant.n], walk.t_end]))
    return np.array(rows)


def forced_map(
    P: ReturnMap, orbit: PeriodicOrbit, constraint: VirtualConstraint, bodies: tuple[str, ...] = ()
) -> ForcedMap:
    """Linearise the strides of P's walker under w = (h, F, mu) around its orbit.

    P: its `difference` is the least width d in the states; WIDTHS times that are those in h, F, mu. orbit: P's
    fixed point with the controller's states. constraint: of the gait, for the middle of Theta's range. bodies:
    those whose masses have the error mu, all where empty. Raises InputError for a stride without a derivative
    or without machine code, SimulationError where the walker does not come back to the orbit.
    """
    from scipy.optimize import brentq  # SciPy's optimisers take half a second to load

    check_part(P, "the map", ReturnMap)
    check_part(orbit, "the orbit", PeriodicOrbit)
    check_part(constraint, "the constraint of the gait", VirtualConstraint)
    x0, none = orbit.x_minus[np.newaxis], np.zeros(3)
    if P.walker.sensors or not getattr(P.walker.timing, "restart", True):
        raise InputError(
            "a stride with sensors, which round, or with a clock that does not restart at impact has no "
            "derivative; expected a walker without sensors, in continuous time or with restart=True"
        )
    walked, k = partial(_strides, P, bodies, constraint.phase), x0.size
    cycle, middle = walked(none, x0)[0], 0.5 * (constraint.theta_plus + constraint.theta_minus)
    if (gap := np.max(np.abs(cycle[:k] - x0))) > _SETTLED:
        raise SimulationError(f"the orbit misses itself by {gap:.2g}, expected below {_SETTLED:g}")

    def ahead(t: float) -> float:
        return walked(none, x0, t)[0, -2] - middle

    ends = 0.01 * cycle[-1], 0.99 * cycle[-1]
    if ahead(ends[0]) * ahead(ends[1]) > 0.0:
        raise InputError("the orbit does not reach the middle of the constraint: give its gait's")
    t = brentq(ahead, *ends)
    before, at, after = (walked(none, x0, t + s)[0, -3:-1] for s in (-_ABOUT, 0.0, _ABOUT))
    slope = (after[0] - before[0]) / (after[1] - before[1])

    def images(w: Array, x: Array) -> Array:
        # (x-, y) (K, nx + 3); zeta at the time t is carried to the middle of Theta by its slope there
        end, mid = walked(w, x), walked(w, x, t)
        zeta_m = (mid[:, -3] - slope * (mid[:, -2] - middle)) / at[0]
        return np.column_stack((end[:, :k], end[:, k] / cycle[k], zeta_m, end[:, -1]))

    def derivative(d: float) -> Array:
        of_x = images(none, x0 + d * np.eye(k)) - images(none, x0 - d * np.eye(k))
        of_w = [images(w, x0) - images(-w, x0) for w in d * np.diag(WIDTHS)]
        return np.vstack((of_x, *of_w)).T / (2.0 * d * np.append(np.ones(k), WIDTHS))

    def split(M: Array, wider: ForcedMap | None = None) -> ForcedMap:
        return ForcedMap(M[:k, :k], M[:k, k:], M[k:, :k], M[k:, k:], wider)

    wide, half, narrow = (derivative(scale * P.difference) for scale in (4.0, 2.0, 1.0))
    return split((4.0 * narrow - half) / 3.0, split((4.0 * half - wide) / 3.0))
