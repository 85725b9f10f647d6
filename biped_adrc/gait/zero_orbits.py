"""All steps of the zero dynamics at once, in closed form up to one quadrature.

With zeta1 = Theta and zeta2 = sigma, the angular momentum about the stance foot (counter-clockwise positive, so
negative in a walk towards +x),

    zeta1' = zeta2 / I(zeta1),   zeta2' = -G_N(zeta1)        I [kg m^2]: inertia, G_N [N m]: gravity's torque
    V_zero(Theta) = int_{Theta+}^{Theta} G_N I dTheta,   zeta2^2 / 2 + V_zero = const in single support

so one number determines a step: zeta = sigma-^2 / 2 [kg^2 m^4/s^2] just before the impact that begins it. Theta
runs from Theta+ just after an impact to Theta- just before the next one; sigma+ and sigma- likewise. With delta
= sigma+ / sigma-, which does not depend on the speed, the step begins with sigma+^2 / 2 = delta^2 zeta
and is completed if that exceeds V_max = max V_zero. The return map rho gives zeta of the next step:

    rho(zeta) = delta^2 zeta - V_zero(Theta-)   for   zeta > V_max / delta^2
    zeta* = -V_zero(Theta-) / (1 - delta^2)     exists if  delta^2 / (1 - delta^2) V_zero(Theta-) + V_max < 0
                                                and is stable if  0 < delta^2 < 1

(Westervelt, Grizzle, Koditschek, IEEE TAC 48(1), 2003). rho is affine, so zeta_k - zeta* = delta^(2k)
(zeta_0 - zeta*) from anywhere in the domain. Nothing depends on the sense of Theta: the integrals run from
Theta+ to Theta-, whichever is larger. A slope changes neither gravity nor these formulas: it decides where
the swing foot meets the ground, and so where the curve ends.

I and V_zero are Legendre series through the values at the Gauss nodes of `ZeroDynamics`, so that they can be
evaluated, differentiated and searched for zeros anywhere in the step. `zero_domain` adds what
ground and motors allow; `analysis.zero_report` prints both.

    orbits = ZeroOrbits.of(ba.ZeroDynamics.of(biped, gait.constraint))
    star = orbits.zeta_star              247.4 kg^2 m^4/s^2 for the published gait of RABBIT
    orbits.speed(star), orbits.delta**2  0.750 m/s, and the multiplier 0.694
    orbits.iterate(0.6 * star, 5)        how a slower walk comes back to it, step by step
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import Legendre, legendre
from scipy.integrate import quad
from scipy.optimize import brentq

from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.gait.zero_dynamics import ZeroDynamics, gauss_nodes

_GRID = 401
"""Number of phases at which signs and extremes are searched; zeros between two of them are then solved for."""
_DURATION = 1e-6
"""Largest relative error [1] of a duration, by the error estimate of its quadrature."""


def series(zero: ZeroDynamics, values: Array) -> Legendre:
    """The Legendre series in Theta [rad] of degree K - 1 with the values (K,) at the Gauss nodes of `zero`."""
    s, w, _ = gauss_nodes(len(values))
    x, c = 2.0 * s - 1.0, zero.constraint
    # coefficient j: (j + 1/2) int P_j f dx over x in [-1, 1], by Gauss's rule, whose weights there are 2 w
    products = legendre.legvander(x, len(x) - 1).T @ (2.0 * w * values)
    coefficients = products * (np.arange(len(x)) + 0.5)
    return Legendre(coefficients, domain=[c.theta_plus, c.theta_minus])


def grid(zero: ZeroDynamics) -> Array:
    """_GRID phases [rad] (401,) from Theta+ to Theta-, both included."""
    return np.linspace(zero.constraint.theta_plus, zero.constraint.theta_minus, _GRID)


@dataclass(frozen=True)
class ZeroOrbits(Shown):
    """The return map rho of one constraint, restricted to the zero dynamics, its fixed point and its domain.
    Make it by `of`.

    zeta is always sigma-^2 / 2 before an impact [kg^2 m^4/s^2].
    """

    zero: ZeroDynamics
    """The constraint, and the model at its Gauss nodes."""
    inertia: Legendre
    """I(Theta) [kg m^2]."""
    potential: Legendre
    """V_zero(Theta) [kg^2 m^4/s^2]."""
    delta: float
    """sigma+ / sigma- across the impact."""
    theta_max: float
    """Phase at which V_zero is largest [rad]."""

    @classmethod
    def of(cls, zero: ZeroDynamics) -> ZeroOrbits:
        """Compute the map of the constraint of `zero`.

        Raises GaitError when I changes its sign (Theta is no phase), or when the impact reverses the motion.
        """
        c = zero.constraint
        inertia = series(zero, zero.inertia)
        # grid: 401 phases from Theta+ to Theta-, at which a change of the sign of I shows
        delta, values = zero.delta, inertia(grid(zero))
        turns = np.flatnonzero(values[1:] * values[:-1] <= 0.0)
        if len(turns) or not delta > 0.0:
            where = f", near Theta = {grid(zero)[turns[0]]:.4g} rad" if len(turns) else ""
            raise GaitError(
                f"I(Theta) runs from {np.min(values):.4g} to {np.max(values):.4g} kg m^2, expected one "
                f"sign{where}, or Theta cannot be the phase; the impact maps sigma- to {delta:.4g} sigma-, "
                "expected a positive factor, or the next step runs backwards: swing the free links less, take "
                "shorter steps"
            )
        # V_zero is 0 at Theta+
        potential = series(zero, zero.gravity * zero.inertia).integ(lbnd=c.theta_plus)
        return cls(zero, inertia, potential, delta, _highest(potential, grid(zero)))

    # -- the numbers of the literature -------------------------------------------------------------
    @property
    def v_end(self) -> float:
        """Potential V_zero(Theta-) at the end of a step [kg^2 m^4/s^2], against 0 at its start; negative when
        gravity speeds the step up.
        """
        return float(self.potential(self.zero.constraint.theta_minus))

    @cached_property
    def v_max(self) -> float:
        """Largest potential V_max = max V_zero >= 0 of a step [kg^2 m^4/s^2]; a step is completed
        if sigma+^2 / 2 exceeds it.
        """
        return max(0.0, float(self.potential(self.theta_max)))

    @property
    def existence(self) -> float:
        """delta^2 / (1 - delta^2) V_zero(Theta-) + V_max [kg^2 m^4/s^2]: negative if a periodic orbit exists,
        then V_max less the start delta^2 zeta* of its step; infinite for delta = 1.
        """
        d2 = self.delta**2
        return d2 / (1.0 - d2) * self.v_end + self.v_max if d2 != 1.0 else math.inf

    @property
    def lowest(self) -> float:
        """Lower end V_max / delta^2 [kg^2 m^4/s^2] of the domain of rho: above this zeta the next step is
        completed.
        """
        return self.v_max / self.delta**2

    @property
    def zeta_star(self) -> float:
        """zeta* [kg^2 m^4/s^2], the fixed point of the return map rho: zeta of the periodic orbit.

        Raises GaitError, with what to change, where there is no stable orbit.
        """
        d2, V, unit = self.delta**2, self.v_end, "kg^2 m^4/s^2"
        why = ""
        if not d2 < 1.0:
            why = f"delta^2 = {d2:.6g}, expected below 1; take longer steps, retract the leg faster"
        elif not V < 0.0:
            why = f"V_zero(Theta-) = {V:.6g} {unit}, expected below 0; move the hip forward over the step"
        elif not self.existence < 0.0:
            why = (
                f"a step would begin {self.existence:.3g} {unit} short of the V_max = {self.v_max:.6g} that it "
                f"has to pass at Theta = {self.theta_max:.4g} rad; lower the hip there or shorten the way"
            )
        if why:
            raise GaitError(f"the zero dynamics have no stable orbit: {why}")
        return -V / (1.0 - d2)

    def sigma(self, zeta: float) -> float:
        """sigma- [kg m^2/s], the angular momentum before impact, for zeta = sigma-^2 / 2 [kg^2 m^4/s^2].

        Its sign is that of the direction of the walk.
        """
        c = self.zero.constraint
        # sigma = I Theta', and Theta' has the sign of Theta- - Theta+
        forward = (c.theta_minus - c.theta_plus) * float(self.inertia(c.theta_minus))
        return math.copysign(math.sqrt(2.0 * zeta), forward)

    # -- the return map ----------------------------------------------------------------------------
    def rho(self, zeta: float) -> float:
        """The return map: zeta of the next impact [kg^2 m^4/s^2], from zeta of this one. Raises GaitError for a
        step that is not completed.
        """
        begin = self.delta**2 * zeta
        if not self.v_max < begin < math.inf:
            raise GaitError(
                f"the step after zeta = {zeta:.6g} begins with {begin:.6g} and stops before V_max = "
                f"{self.v_max:.6g} kg^2 m^4/s^2; expected zeta above {self.lowest:.6g}"
            )
        return begin - self.v_end

    def iterate(self, zeta: float, steps: int) -> Array:
        """zeta, rho(zeta), rho(rho(zeta)), ... (steps + 1,) [kg^2 m^4/s^2]: zeta at the start and after each of
        `steps` walking steps.

        Raises GaitError for a step that is not completed.
        """
        result = [zeta]
        for _ in range(steps):
            result.append(self.rho(result[-1]))
        return np.array(result)

    def steps_to(self, zeta: float, closeness: float) -> int:
        """Number k of walking steps until |zeta_k - zeta*| <= closeness zeta*, as |zeta_k - zeta*| falls with
        delta^(2 k); closeness is a share [1] of zeta*.

        Raises GaitError for a first step that is not completed, or if there is no stable orbit.
        """
        self.rho(zeta)  # raises for a step that is not completed; its value is not needed
        ratio = abs(zeta / self.zeta_star - 1.0) / closeness
        if ratio <= 1.0:
            return 0
        return math.ceil(-math.log(ratio) / math.log(self.delta**2))

    # -- what a step looks like --------------------------------------------------------------------
    def sigma_squared(self, theta: Array, zeta: float) -> Array:
        """sigma^2 [kg^2 m^4/s^2] at the phases theta (K,) [rad] of the step that begins after the impact with
        zeta; where it is negative, the step has stopped before.
        """
        return 2.0 * (self.delta**2 * zeta - self.potential(theta))

    def period(self, zeta: float) -> float:
        """Duration [s] of the step that begins after the impact with zeta: the integral of |I / sigma| over
        Theta.

        It is defined for zeta = V_max / delta^2 too, the lower end of the domain, where sigma is 0 at the phase
        of V_max and rho is not defined. The quadrature is adaptive, since sigma may be near 0 there. Raises
        GaitError for a step that is not completed, and for one that nearly comes to rest: where the
        quadrature's own estimate of its error exceeds the share _DURATION of the duration.
        """
        if zeta != self.lowest:
            self.rho(zeta)  # raises for a step that is not completed; its value is not needed
        c, low = self.zero.constraint, self.lowest

        def slowness(theta: float) -> float:
            """|dt/dTheta| = |I / sigma| [s/rad] at theta [rad]."""
            rise = max(0.0, self.v_max - float(self.potential(theta)))
            # sigma^2 = 2 (delta^2 zeta - V_zero), as the sum of two distances to V_max: this keeps the digits
            # of a sigma near 0, which the difference of two large numbers would lose
            square = 2.0 * (self.delta**2 * (zeta - low) + rise)
            return abs(float(self.inertia(theta))) / math.sqrt(square)

        ends = sorted((c.theta_plus, c.theta_minus))
        # `quad` divides the interval at the phase of V_max, where the integrand is largest
        peak = [self.theta_max] if ends[0] < self.theta_max < ends[1] else None
        time, error, *_ = quad(
            slowness, *ends, points=peak, limit=400, epsabs=1e-12, epsrel=1e-10, full_output=1
        )
        if not error <= _DURATION * time:
            raise GaitError(
                f"the duration of the step after zeta = {zeta:.17g} is {time:.4g} s, known to {error:.1g} s "
                f"only, expected {_DURATION:g} of it: it nearly comes to rest at V_max; start further from "
                f"{low:.17g} kg^2 m^4/s^2"
            )
        return float(time)

    @cached_property
    def step_length(self) -> float:
        """Distance between the feet at impact [m], along the ground where that has a slope."""
        q, _ = self.zero.end_state(0.0)  # the pose does not depend on the speed
        return float(np.linalg.norm(self.zero.biped.swing_foot(q)))

    def speed(self, zeta: float) -> float:
        """Average speed [m/s] of the step that begins after the impact with zeta. At the lower end of the
        domain, zeta = V_max / delta^2, it is 0 where the step comes to rest at V_max for ever.
        """
        if zeta == self.lowest:
            # an equilibrium, where dV_zero/dTheta is 0 (below the share 1e-6 of its largest value), is
            # approached and never passed; a V_max at an end of the step is left or reached in finite time
            slope = self.potential.deriv()
            largest = float(np.max(np.abs(slope(grid(self.zero)))))
            if abs(float(slope(self.theta_max))) < 1e-6 * largest:
                return 0.0
        return self.step_length / self.period(zeta)

    def kinetic_energy(self, zeta: float) -> float:
        """Kinetic energy [J] just before the impact with zeta."""
        return self.zero.biped.kinetic_energy(*self.zero.end_state(self.sigma(zeta)))


def _highest(potential: Legendre, theta: Array) -> float:
    """Phase [rad] at which V_zero is largest: a zero of its slope beside the largest value on the grid theta
    (K,), or that grid point where the slope has no change of sign, as at an end.
    """
    # the two neighbours of k, within the grid, enclose the zero
    k = int(np.argmax(potential(theta)))
    slope = potential.deriv()
    # _GRID: number of phases in theta
    for one, other in ((theta[max(k - 1, 0)], theta[k]), (theta[k], theta[min(k + 1, _GRID - 1)])):
        if slope(one) * slope(other) < 0:
            return float(brentq(slope, one, other, xtol=1e-14))
    return float(theta[k])
