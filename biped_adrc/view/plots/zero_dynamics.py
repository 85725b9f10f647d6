"""The zero dynamics of a gait: I(Theta), V_zero(Theta), the phase portrait with its domain, and rho(zeta).

The zero dynamics are the motion with all joints exactly on the gait's curves: a scalar system.

    Theta            phase of the gait [rad]; - and + are just before and just after an impact
    sigma            angular momentum about the stance foot [kg m^2/s], sigma = I(Theta) Theta'
    V_zero(Theta)    potential [kg^2 m^4/s^2]: sigma^2 / 2 + V_zero is constant in a single support, so that the
                     portrait has level curves of this sum; V_max is the largest V_zero of a step
    zeta             sigma-^2 / 2 at the end of a walking step; zeta* of the periodic orbit, the gait
    delta            sigma+ / sigma- across an impact
    rho(zeta)        delta^2 zeta - V_zero(Theta-): zeta at the end of the next step. Its graph is a straight
                     line; every walking step is a pair of corners between this line and the diagonal

`biped-adrc gait zero --plot` draws all four from a `ZeroDynamicsReport` (`analysis.zero_report`).
The domain is the range of zeta from which walks come back to the orbit and keep the limits.
"""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from biped_adrc.analysis.zero_report import ZeroDynamicsReport
from biped_adrc.core.types import Array
from biped_adrc.gait.zero_domain import PASSING
from biped_adrc.gait.zero_orbits import ZeroOrbits, grid
from biped_adrc.view.style import DASHES, GREY, PALETTE, label, new_figure

WIDE = 2.0  # where the domain has no upper end it is drawn to this many zeta*
STAIRS = 8
"""Number of walking steps drawn from either end of the domain."""
DOMAIN = "#DDEBF4"
"""Light blue, the colour of the domain."""


def zero_inertia(axes: Axes, orbits: ZeroOrbits) -> Axes:
    """Draw I(Theta) [kg m^2], the inertia sigma / Theta', whose sign must not change in a step; returns the
    axes.
    """
    theta = grid(orbits.zero)
    axes.plot(theta, orbits.inertia(theta), color=PALETTE[0])
    axes.axhline(0.0, color="black", lw=0.8)
    label(axes, r"$\Theta$ [rad]", r"$I$ [kg m$^2$]", "inertia")
    return _walking_order(axes, theta)


def zero_potential(axes: Axes, report: ZeroDynamicsReport) -> Axes:
    """Draw V_zero(Theta) [kg^2 m^4/s^2], its largest value V_max, and sigma+^2 / 2 of the periodic orbit, which
    has to be above V_max: else the robot does not come over the top of its step and falls back. Returns the
    axes.
    """
    o = report.orbits
    theta = grid(o.zero)
    axes.plot(theta, o.potential(theta), color=PALETTE[0], label=r"$V_{zero}$")
    # sigma+^2 / 2 = delta^2 sigma-^2 / 2
    begin, name = o.delta**2 * report.zeta_star, r"$\sigma_+^2/2$ of the orbit"
    axes.axhline(begin, color=PALETTE[1], ls=DASHES[1], label=name)
    axes.plot(o.theta_max, o.v_max, "o", color="black", ms=4, label=r"$V_{max}$")
    label(axes, r"$\Theta$ [rad]", r"$V_{zero}$ [kg$^2$m$^4$/s$^2$]", "potential")
    axes.legend(loc="best")
    return _walking_order(axes, theta)


def zero_portrait(axes: Axes, report: ZeroDynamicsReport) -> Axes:
    """Draw the phase plane (Theta [rad], sigma [kg m^2/s]): the domain shaded, the periodic orbit, its impact
    dotted, and level curves of sigma^2 / 2 + V_zero(Theta), which are other steps.

    The sigma axis reaches a little past the fastest step of the domain. Returns the axes.
    """
    o, theta = report.orbits, grid(report.orbits.zero)
    low, high = _shown(report)  # range of zeta that is drawn
    orbit, fastest = _sigma(o, theta, report.zeta_star), _sigma(o, theta, max(low, high))
    if not report.domain.empty:
        axes.fill_between(theta, _sigma(o, theta, low), fastest, color=DOMAIN, lw=0, label="domain")
    axes.plot(theta, orbit, color=PALETTE[1], lw=2.0, label="orbit")
    ends = [theta[-1], theta[0]], [orbit[-1], orbit[0]]
    axes.plot(*ends, color=PALETTE[1], ls=":", label="impact")
    # sigma is negative in a walk towards +x; some of the other sign shows steps that turn round
    far = max((fastest[-1], orbit[-1]), key=abs)
    axes.set_ylim(min(1.1 * far, -0.4 * far), max(1.1 * far, -0.4 * far))
    _level_curves(axes, report)
    label(axes, r"$\Theta$ [rad]", r"$\sigma$ [kg m$^2$/s]", "phase portrait")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.16), ncols=2)
    return _walking_order(axes, theta)


def restricted_map(axes: Axes, report: ZeroDynamicsReport) -> Axes:
    """Draw the return map rho(zeta), the diagonal, zeta*, the domain, and STAIRS walking steps from either end
    of the domain.

    zeta [kg^2 m^4/s^2] is sigma^2 / 2 before an impact. The stairs begin just inside the domain, as its ends
    do not belong to it, and run towards zeta* where the gait is stable. Returns the axes.
    """
    o, zeta_star = report.orbits, report.zeta_star
    low, high = _shown(report)  # range of zeta that is drawn
    right = 1.05 * max(high, zeta_star)
    zeta = np.array([o.lowest, right])
    if not report.domain.empty:
        axes.axvspan(low, high, color=DOMAIN, lw=0, zorder=0, label="domain")
    axes.plot([0.0, right], [0.0, right], color=GREY, ls="--", label="the same speed")
    # v_end is V_zero(Theta-); the line begins at the lowest zeta whose next step is completed
    axes.plot(zeta, o.delta**2 * zeta - o.v_end, color=PALETTE[0], label=r"$\rho(\zeta)$")
    for k, end in enumerate(() if report.domain.empty else (low, high)):
        inside = end + 1e-6 * (high - low) * (1.0 if k == 0 else -1.0)
        name = "step by step" if k == 0 else "_"  # "_" leaves it out of the legend
        stairs(axes, o.iterate(inside, STAIRS), name)
    axes.plot(zeta_star, zeta_star, "s", color="black", mfc="none", label=r"$\zeta^*$")
    unit = "[kg$^2$m$^4$/s$^2$]"
    label(axes, rf"$\zeta_k$ {unit}", rf"$\zeta_{{k+1}}$ {unit}", "return map")
    axes.set_xlim(0.0, right)
    axes.set_ylim(0.0, None)
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.16), ncols=3)
    return axes


def stairs(axes: Axes, way: Array, name: str) -> None:
    """Draw successive values `way` (k,) of a scalar return map as stairs over (value, next value), from the
    diagonal at way[0]: up or down to the map, then across to the diagonal, and so on.

    way: in the unit of the map. name: in the legend.
    """
    # x: w0 w0 w1 w1 ..., y: w0 w1 w1 w2 ...
    corners = np.repeat(way, 2)
    axes.plot(corners[:-1], np.append(way[0], corners[2:]), color=PALETTE[1], lw=0.9, label=name)


def zero_dynamics_figure(report: ZeroDynamicsReport) -> Figure:
    """Draw inertia, potential, phase portrait and return map of a gait's zero dynamics; the title has the ends
    of the domain and what bounds it.
    """
    with new_figure(9.0, 6.6) as figure:
        (inertia, potential), (portrait, returns) = figure.subplots(2, 2)
        zero_inertia(inertia, report.orbits)
        zero_potential(potential, report)
        zero_portrait(portrait, report)
        restricted_map(returns, report)
        figure.suptitle(_title(report), fontsize=10.0)
        return figure


def _level_curves(axes: Axes, report: ZeroDynamicsReport) -> None:
    """Draw level curves of sigma^2 / 2 + V_zero within the limits of the axes: a step below V_max turns round.

    The levels are V_max and others above and below it, by multiples of how far the periodic orbit is above.
    """
    o = report.orbits
    theta, sigma = np.meshgrid(grid(o.zero)[::2], np.linspace(*axes.get_ylim(), 201))
    above = o.delta**2 * report.zeta_star - o.v_max
    levels = o.v_max + above * np.array([-1.0, -0.5, 0.0, 0.5, 2.0, 4.0])
    constant = 0.5 * sigma**2 + o.potential(theta)
    axes.contour(theta, sigma, constant, levels, colors=GREY, linewidths=0.6, linestyles="-")
    # an empty line with the legend's entry for the contours, which have none
    axes.plot([], [], color=GREY, lw=0.6, label="other steps")


def _shown(report: ZeroDynamicsReport) -> tuple[float, float]:
    """The range of zeta [kg^2 m^4/s^2] to draw: the domain, to WIDE zeta* where it has no upper end; if it is
    empty, from the lowest zeta whose step is completed to zeta* of the orbit.
    """
    low, high = report.domain
    if report.domain.empty:
        return report.orbits.lowest, report.zeta_star
    return low.zeta, high.zeta if math.isfinite(high.zeta) else WIDE * report.zeta_star


def _sigma(orbits: ZeroOrbits, theta: Array, zeta: float) -> Array:
    """sigma (K,) [kg m^2/s] at the phases theta (K,) [rad] of the step that begins after zeta [kg^2 m^4/s^2];
    NaN where sigma^2 would be negative, as the step does not get there.
    """
    square = orbits.sigma_squared(theta, zeta)
    size = np.sqrt(np.where(square >= 0.0, square, np.nan))
    return math.copysign(1.0, orbits.sigma(1.0)) * size  # the sign of a walk, the same for any zeta


def _title(report: ZeroDynamicsReport) -> str:
    """Sentence with the ends of the domain and the limit that bounds each."""
    low, high = report.domain
    if report.domain.empty:
        return "no speed keeps the limits"
    below = "to pass $V_{max}$" if low.cause == PASSING else low.cause
    top = f"{high.zeta:.4g}" if math.isfinite(high.zeta) else r"\infty"
    return rf"domain ${low.zeta:.4g} < \zeta < {top}$; bounds: {below}, {high.cause}"


def _walking_order(axes: Axes, theta: Array) -> Axes:
    """Limit the Theta axis to the phases of a step, from theta[0] at its start, left, to theta[-1] at its end,
    also where Theta falls in a step; returns the axes.
    """
    axes.set_xlim(theta[0], theta[-1])
    return axes
