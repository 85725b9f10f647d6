"""The three-link walker of the literature, its outputs, and its cycle under a feedback of them.

Grizzle, Abba, Plestan, IEEE TAC 46(1), 2001; Westervelt et al., Feedback Control of Dynamic Bipedal Robot
Locomotion, 2007. Absolute angles th = (stance leg, swing leg, torso), clockwise from the vertical:

    y1 = th3 - p3(th1),   y2 = th2 + th1 - p2(th1) (th1^2 - th1d^2),   th1d = pi / 8

A step ends at th1 = th1d, as in the source, and not at foot contact: with this constraint the swing foot passes
below the ground. The outputs are those of a `LinearOutputs` in our coordinates q. Called by
`validation.groups`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import Polynomial
from scipy.optimize import newton

from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.base import Controller
from biped_adrc.control.finite_time import FiniteTimeController
from biped_adrc.control.output_npd import OutputNPDController
from biped_adrc.control.tracking import Gains
from biped_adrc.core.errors import SimulationError
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Polynomial as PolynomialCurve
from biped_adrc.gait.outputs import LinearOutputs
from biped_adrc.hybrid.integrators import Adaptive, OneStepMethod
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.system import Guard, HybridSystem
from biped_adrc.model.biped import Biped
from validation.row import Row

END = math.pi / 8
"""th1d [rad]."""
A = (0.512, 0.073, 0.035, -0.819, -2.27, 3.26, 3.11, 1.89)
"""Coefficients of p3 and p2 as printed."""
P3 = Polynomial(A[:4])
"""p3(th1) [rad]."""
P2 = Polynomial(A[4:]) * Polynomial([-(END**2), 0.0, 1.0])
"""p2(th1) (th1^2 - th1d^2), the whole of it [rad]."""

TO_Q: Array = np.array([[-1.0, 0.0, 1.0], [0.0, -1.0, 1.0], [0.0, 0.0, -1.0]])
"""(3, 3) of q = TO_Q th + ZERO: absolute angles counter-clockwise, a hanging leg at pi; hips from the torso."""
ZERO: Array = np.array([math.pi, math.pi, 0.0])
"""(3,) [rad]."""

SOURCE = (
    "model and outputs: Grizzle et al. 2001, Westervelt et al. 2007; digits recomputed from them"
)
"""Of the expected values."""


@lru_cache(maxsize=1)
def robot() -> Biped:
    """The registered three-link walker."""
    return Biped.load("three_link")


def outputs() -> LinearOutputs:
    """y = H0 q - h_d(Theta), with Theta = pi - th1 and s = (th1 + th1d) / (2 th1d).

    The published polynomials in th1 are expanded in s, of which a `VirtualConstraint` takes the coefficients.
    """
    th1 = Polynomial([-END, 2.0 * END])
    torso, swing = P3(th1), P2(th1) - 2.0 * math.pi
    a = np.zeros((2, 6))
    a[0, : len(torso.coef)], a[1, : len(swing.coef)] = torso.coef, swing.coef
    desired = VirtualConstraint(PolynomialCurve(a), robot().phase, math.pi + END, math.pi - END)
    return LinearOutputs(np.array([[0.0, 0.0, -1.0], [-1.0, -1.0, -2.0]]), desired)


def before_impact(omega: float) -> tuple[Array, Array]:
    """(q-, q'-), (3,) each, with y = y' = 0 at th1 = th1d and th1' = omega [rad/s]."""
    th = np.array([END, P2(END) - END, P3(END)])
    slope = np.array([1.0, P2.deriv()(END) - 1.0, P3.deriv()(END)])
    return TO_Q @ th + ZERO, TO_Q @ slope * omega


@dataclass(frozen=True)
class EndsAtPhase(HybridSystem):
    """The walker, with the impact where the stance leg has come to th1d instead of at foot contact."""

    walker: Walker

    def flow(self, t: float, x: Array, mode: Mode) -> Array:
        return self.walker.flow(t, x, mode)

    def guards(self, mode: Mode) -> tuple[Guard, ...]:
        return (
            Guard(
                "impact",
                lambda t, x: float(robot().phase @ x[:3]) - (math.pi - END),
                lambda t, x: self.walker.strike(t, x, mode),
            ),
        )


def step(controller: Controller, omega: float, method: OneStepMethod) -> tuple[float, float]:
    """One step from th1' = omega [rad/s]: P(omega) [rad/s] and its period [s].

    Raises SimulationError where the step does not end.
    """
    walker = Walker(robot(), controller)
    impact = robot().impact(*before_impact(omega))
    x = walker.initial_state(impact.q, impact.v)
    run = simulate(EndsAtPhase(walker), x, Mode(), method, t_end=3.0, stop_after=("impact", 1))
    if not run.status.ok:
        raise SimulationError(
            f"the step from {omega:g} rad/s does not end: {run.status.name}, {run.status.value}"
        )
    (end,) = run.events("impact")
    return -float(robot().phase @ end.x_minus[3:6]), end.t


def rate(controller: Controller, method: OneStepMethod) -> float:
    """omega* [rad/s] by Newton's method. Raises RuntimeError where the search does not end."""
    return float(newton(lambda w: step(controller, w, method)[0] - w, 1.55, tol=1e-8))


def cycle(controller: Controller, method: OneStepMethod) -> tuple[float, float, float]:
    """omega* [rad/s], the period [s] and dP/domega, by Newton's method and a central difference.

    Raises RuntimeError where the search does not end.
    """
    omega = rate(controller, method)
    high, low = (step(controller, omega + h, method)[0] for h in (1e-3, -1e-3))
    return omega, step(controller, omega, method)[1], (high - low) / 2e-3


def three_link_rows(source: bool = True) -> tuple[Row, ...]:
    """The cycle under proportional-derivative feedback of the outputs: stance rate, period, slope of the return
    map.

    source: whether the note has the rate of the cycle under the finite-time feedback of the source, too.
    """
    y, gains = outputs(), Gains(400.0, 40.0)
    omega, period, slope = cycle(OutputNPDController(y, gains), Adaptive())
    other = math.nan
    if source:
        other = rate(FiniteTimeController(y, alpha=0.9, eps=0.1), Adaptive(1e-6, 1e-8))
    name = "three-link walker"
    note = (
        "gains 400 1/s^2 and 40 1/s on the outputs, impact at th1 = th1d: those under which the recomputed "
        f"digits come out; the finite-time feedback of the source (alpha 0.9, eps 0.1) has {other:.6f} rad/s"
    )
    return (
        Row(name, "stance rate before impact [rad/s]", 1.545015, omega, 1e-6, SOURCE, note=note),
        Row(name, "period [s]", 1.145869, period, 1e-6, SOURCE, note="as above"),
        Row(name, "dP/domega", 0.5748, slope, 1e-3, SOURCE, note="as above"),
    )
