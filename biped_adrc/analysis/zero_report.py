"""Properties of a gait by its zero dynamics, before any simulation: whether it walks, from where, how fast.

The zero dynamics are the motion of the robot with its joints on the gait's curves q_b = h(Theta), the virtual
constraint. One number determines a step:

    sigma          angular momentum about the stance foot [kg m^2/s], sigma- before and sigma+ after an impact
    zeta           sigma-^2 / 2 before the impact that begins a step [kg^2 m^4/s^2]; zeta* of the periodic orbit
    domain         range of zeta in which a step keeps the limits of ground and motors
    Theta          phase [rad], Theta- its value at the end of a step
    I(Theta)       sigma / Theta' [kg m^2]
    V_zero(Theta)  potential [kg^2 m^4/s^2]: sigma^2 / 2 + V_zero is constant in a step; V_max its largest value
    delta^2        (sigma+ / sigma-)^2, the multiplier of the cycle: stable below 1

The report lists the numbers of `gait.zero_dynamics` and `gait.zero_orbits` with their units. They hold for the
closed loop as far as it keeps to the constraint: exactly for a constraint that the impact does not leave
(hybrid invariant), tracked without error. Where that is in doubt the report says so.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from biped_adrc.analysis.stability import INVARIANCE, invariance_gap
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown, columns
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.gait import CLOSES
from biped_adrc.gait.zero_domain import UNLIMITED, Bound, Domain, DomainLimits, domain
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.gait.zero_orbits import ZeroOrbits, grid
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes

CLOSENESS = 1e-3
"""Distance of zeta from zeta*, as a share of zeta* [1], within which a walk counts as settled."""
UNIT = "kg^2 m^4/s^2"
"""Unit of zeta and of V_zero, the potential of the zero dynamics."""
_Rows = Iterator[tuple[str, ...]]
"""Rows of the report, as texts in columns."""


@dataclass(frozen=True)
class ZeroDynamicsReport(Shown):
    """The periodic orbit of a gait, the range of speeds around it and the margins;
    `text()` has all with units.
    """

    orbits: ZeroOrbits
    """Quadratures of the zero dynamics, and their orbits."""
    limits: DomainLimits
    """Friction, torque and slope that the domain respects."""
    domain: Domain
    """The range of zeta in which a step keeps the limits."""
    zeta_star: float
    """sigma-^2 / 2 of the periodic orbit [kg^2 m^4/s^2]."""
    impulse_ratio: float
    """|F_T| / F_N of the impulses at impact, the same at every speed."""
    invariance: float
    """How far the impact leaves the constraint [rad, rad/s at |Theta'-| = 1 rad/s]."""

    @property
    def walkable(self) -> bool:
        """Whether the periodic orbit itself keeps the limits."""
        return self.domain.holds(self.zeta_star)

    @property
    def speeds(self) -> tuple[float, float]:
        """Mean speed [m/s] of a step at the lower and upper end of the domain; inf without an upper end."""
        return self._at_ends(self.orbits.speed)

    @property
    def energies(self) -> tuple[float, float]:
        """Kinetic energy [J] before impact at both ends of the domain; inf without an upper end."""
        return self._at_ends(self.orbits.kinetic_energy)

    def _at_ends(self, f: Callable[[float], float]) -> tuple[float, float]:
        """f(zeta) at the lower and upper end of the domain; inf where zeta there is infinite."""
        low, high = (f(b.zeta) if math.isfinite(b.zeta) else math.inf for b in self.domain)
        return low, high

    def text(self) -> str:
        """The report as lines of text."""
        b, slope = self.orbits.zero.biped, self.limits.slope
        robot = f"robot {b.description.name}, parameters {b.preset}; slope {slope:g} rad"
        return "\n".join(columns([(robot,), *self._numbers(), *self._range(), *self._doubts()]))

    def _numbers(self) -> _Rows:
        """Rows about the periodic orbit."""
        # grid: values of Theta over the step
        # `existence` < 0 is the condition for a periodic orbit; delta^2 < 1 was checked by `zero_report`
        o, z, c = self.orbits, self.zeta_star, self.orbits.zero.constraint
        inertia = o.inertia(grid(o.zero))
        yield "Theta", f"{c.theta_plus:.6f} to {c.theta_minus:.6f} rad"
        yield "I(Theta)", f"{np.min(inertia):.4f} to {np.max(inertia):.4f} kg m^2"
        yield "delta^2", f"{o.delta**2:.6f}, the multiplier of the cycle: stable"
        yield "V_zero(Theta-)", f"{o.v_end:.4f} {UNIT}"
        yield "V_max", f"{o.v_max:.4f} {UNIT} at Theta = {o.theta_max:.4f} rad"
        yield "existence", f"{o.existence:.4f} {UNIT} < 0: a periodic orbit exists"
        yield "zeta*", f"{z:.4f} {UNIT}, sigma- = {o.sigma(z):.5f} kg m^2/s"
        yield "orbit", f"period {o.period(z):.6f} s, speed {o.speed(z):.4f} m/s"
        yield "", f"{o.kinetic_energy(z):.3f} J before impact, step {o.step_length:.4f} m"
        yield "impact", f"asks for |F_T| / F_N = {self.impulse_ratio:.3f}, at any speed"

    def _range(self) -> _Rows:
        """Rows about the domain: its ends and their reasons, speeds, energies, number of steps
        until the walk has settled.
        """
        if self.domain.empty:
            yield "domain", f"empty: no speed keeps {_show(self.limits)} all along the step"
            return
        (v_0, v_1), (E_0, E_1), (low, high) = self.speeds, self.energies, self.domain
        lower, upper = (f"{bound.zeta:.4f} ({_because(bound)})" for bound in self.domain)
        yield "domain", f"{lower} < zeta < {upper} {UNIT}"
        yield "speeds in it", f"{v_0:.4f} to {v_1:.4f} m/s, of the first step"
        yield "energies in it", f"{E_0:.3f} to {E_1:.3f} J before impact"
        if self.walkable:
            inside = low.zeta + 1e-9 * self.zeta_star  # at the end itself a step fails
            # steps until |zeta - zeta*| is CLOSENESS zeta*, from each end of the domain
            first, last = (
                self.orbits.steps_to(zeta, CLOSENESS) if math.isfinite(zeta) else "any number of"
                for zeta in (inside, high.zeta)
            )
            steps = f"{first} steps from the lower end, {last} from the upper"
            yield "settled", f"to {CLOSENESS:.1%} of zeta* after {steps}"

    def _doubts(self) -> _Rows:
        """Rows with the reasons why these numbers may not hold for the closed loop."""
        if not self.walkable:
            text = f"the periodic orbit does not keep {_show(self.limits)}"
            yield (f"{text}: zeta* is outside of the domain",)
        # INVARIANCE: up to it a constraint counts as hybrid invariant
        if self.invariance > INVARIANCE:
            yield (
                f"the impact leaves the constraint by {self.invariance:.2g} rad or rad/s at |Theta'-| = "
                "1 rad/s: the closed loop comes back to it in the course of a step only, and these numbers "
                "are those of the zero dynamics",
            )


def zero_report(
    biped: Biped, constraint: VirtualConstraint, limits: DomainLimits | None = None
) -> ZeroDynamicsReport:
    """Make the report of a virtual constraint: its orbits, their stability and speeds.

    biped: the robot. constraint: h over the phase. limits: of the ground; None: the friction of the robot's
    record, on level ground.

    Raises GaitError when Theta is no phase, when no periodic orbit exists or it is not stable, and when the
    curve does not end on the ground.

    >>> report = ba.zero_report(biped, gait.constraint)
    >>> print(f"walks at up to {report.speeds[1]:.2f} m/s")
    walks at up to 1.65 m/s
    """
    check_part(biped, "biped", Biped)
    limits = DomainLimits(biped.description.friction_coefficient) if limits is None else limits
    orbits = ZeroOrbits.of(ZeroDynamics.of(biped, constraint))
    # the swing foot at the end of the curve, of which the rates do not matter
    x, z = biped.swing_foot(orbits.zero.end_state(0.0)[0])
    height = float(z + math.tan(limits.slope) * x)
    # CLOSES: largest distance of the foot from the ground in a gait that closes
    if not abs(height) < CLOSES:
        raise GaitError(
            f"the swing foot is {height:.3g} m above the ground of slope {limits.slope:g} rad where the curve "
            f"ends, expected 0 within {CLOSES:g} m; give the slope the curve was made for"
        )
    zeta = orbits.zeta_star
    impulse = biped.impact(*orbits.zero.end_state(orbits.sigma(zeta))).impulse
    # the impulse at zeta*; its ratio is the same at every speed
    along, across = (impulse @ axis for axis in ground_axes(limits.slope))
    # a robot without motors has no constraint to leave
    gap = invariance_gap(biped, constraint) if biped.p else 0.0
    within = domain(orbits, limits)
    return ZeroDynamicsReport(orbits, limits, within, zeta, float(abs(along) / across), gap)


def _because(bound: Bound) -> str:
    """Text with the limit that bounds the domain at one end."""
    if bound.cause == UNLIMITED:
        return UNLIMITED
    return f"{bound.cause} at Theta = {bound.theta:.4f} rad"


def _show(limits: DomainLimits) -> str:
    """Text with the limits that the domain respects."""
    known = {"friction {:g}": limits.friction, "torque {:g} N m": limits.torque}
    words = (text.format(x) for text, x in known.items() if x is not None)
    return ", ".join(("F_N > 0", *words))
