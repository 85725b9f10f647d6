"""Signals of one walk over time, on axes of your own: angles, errors, torques, disturbances, ground, energy.

Also the phase portrait and the friction cone, which are curves of the same signals. Every plot
takes the Axes, `Signals` (rows are the nodes of a walk) and perhaps the window of a push, which is
shaded; it labels the axes with units and returns them. Lines break at impacts, where velocities and
torques jump.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from biped_adrc.analysis.signals import Signals
from biped_adrc.core.errors import InputError, check_positive
from biped_adrc.core.types import Array
from biped_adrc.model.ground import ground_axes
from biped_adrc.view.style import DASHES, GREY, PALETTE, PUSH, label

Window = tuple[float, float]
"""Start and stop of a push [s]."""


def broken(s: Signals, y: Array) -> Array:
    """y (K,) or (K, k), in any unit, with a row of NaN where a single support begins.

    matplotlib breaks a line at NaN, so none crosses an impact. Time is broken in the same way.
    """
    return np.insert(y, np.flatnonzero(np.diff(s.step)) + 1, np.nan, axis=0)


def line(axes: Axes, s: Signals, y: Array, i: int, name: str) -> None:
    """Draw y (K,) over time [s] in the i-th colour and dash."""
    axes.plot(broken(s, s.t), broken(s, y), color=PALETTE[i], ls=DASHES[i % 4], label=name)


def curves(axes: Axes, s: Signals, values: Array, symbol: str, unit: str) -> None:
    """Draw the columns of values (K, k) over time [s]: symbol_1, symbol_2, ...; unit: label of the axis."""
    for i, column in enumerate(values.T):
        line(axes, s, column, i, f"${symbol}_{i + 1}$")
    label(axes, "time [s]", unit)


def shade(axes: Axes, push: Window | None) -> None:
    """Shade the time of a push (start, stop) [s]; nothing without one."""
    if push is not None:
        axes.axvspan(*push, color=PUSH, alpha=0.3, zorder=0, label="push")


def legend(axes: Axes) -> Axes:
    """Put a legend to the right of the axes, where it covers nothing; returns the axes."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2, frameon=False)
    return axes


def angle_unit(values: Array) -> tuple[str, float]:
    """The unit in which the largest of `values` [rad] reads well, from rad to nrad, and the factor to it."""
    largest = np.nanmax(np.abs(values), initial=0.0)
    for unit, factor in (("rad", 1.0), ("mrad", 1e3), ("µrad", 1e6)):
        if largest * factor >= 0.5:
            return unit, factor
    return "nrad", 1e9


JOINTS = ("stance hip", "swing hip", "stance knee", "swing knee")
"""Names of the actuated joints of a five-link biped."""


def joint_name(s: Signals, i: int) -> str:
    """ "$q_1$ stance hip" and so on for four actuated joints; the symbol alone on another robot."""
    known = s.q_d.shape[1] == len(JOINTS)
    return f"$q_{i + 1}$ {JOINTS[i]}" if known else f"$q_{i + 1}$"


def chosen(s: Signals, joints: Sequence[int] | None) -> tuple[int, ...]:
    """Indices of actuated joints from 0, all if None. Raises InputError for one that does not exist."""
    p = s.q_d.shape[1]
    result = tuple(range(p)) if joints is None else tuple(joints)
    if not result or not all(0 <= i < p for i in result):
        raise InputError(
            f"joints {list(result)} were asked for, expected indices from 0 to {p - 1}"
        )
    return result


def angles(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """All coordinates q (K, n) [rad] over time [s], with motors or without."""
    shade(axes, push)
    curves(axes, s, s.q, "q", "angle [rad]")
    return legend(axes)


def joint_tracking(
    axes: Axes, s: Signals, joints: Sequence[int] | None = None, push: Window | None = None
) -> Axes:
    """Angles of the actuated joints [rad] as broad lines over time [s], their references dashed on top
    in black.

    joints: indices from 0, all if None. Raises InputError for an index that does not exist.
    """
    shade(axes, push)
    joints, t = chosen(s, joints), broken(s, s.t)
    for i in joints:
        dash = DASHES[i % 2]
        axes.plot(
            t, broken(s, s.q[:, i]), color=PALETTE[i], ls=dash, lw=2.2, label=joint_name(s, i)
        )
    for i in joints:
        name = "references" if i == joints[0] else "_"
        axes.plot(t, broken(s, s.q_d[:, i]), color="black", ls=(0, (4, 3)), lw=0.8, label=name)
    label(axes, "time [s]", "angle [rad]")
    return legend(axes)


def tracking_errors(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """q_b - q_d (K, p) by joint over time [s], in the unit from rad to nrad in which the largest reads well."""
    shade(axes, push)
    unit, factor = angle_unit(s.error)
    curves(axes, s, factor * s.error, "q", f"tracking error [{unit}]")
    return legend(axes)


def torques(axes: Axes, s: Signals, limit: float | None = None, push: Window | None = None) -> Axes:
    """Torques of the motors u (K, p) [N m] over time [s]; limit [N m] is drawn as dotted lines."""
    shade(axes, push)
    curves(axes, s, s.u, "u", "torque [N m]")
    if limit is not None:
        axes.axhline(limit, color=GREY, ls=":", label=f"limit {limit:g} N m")
        axes.axhline(-limit, color=GREY, ls=":", label="_")
    return legend(axes)


NO_OBSERVER = "no observer: nothing is estimated"
"""Written on a panel in place of an estimate."""


def total_disturbance(axes: Axes, s: Signals, joint: int = 0, push: Window | None = None) -> Axes:
    """xi of (13), q_b'' - kappa u, and its estimate xi^ [rad/s^2] for one actuated joint over time [s].

    joint: index from 0; InputError for one that does not exist. Without an observer the panel says
    so.
    """
    chosen(s, (joint,))
    shade(axes, push)
    names = f"\\xi_{joint + 1}", f"\\hat{{\\xi}}_{joint + 1}"
    _pair(axes, s, s.xi[:, joint], s.xi_estimate[:, joint], names, PALETTE[0])
    label(axes, "time [s]", f"$\\xi_{joint + 1}$ [rad/s²]")
    return legend(axes)


def matched_disturbance(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """The torque from outside on the actuated joints, and what the estimates amount to there [N m].

    Broad: zeta_b, which enters (14) as kappa zeta_b, the matched part. Dashed: kappa^-1 (xi^ - xi_nominal); it
    also holds the unmatched part and errors of the model, so the lines differ by those. Joints with the same
    torque share the first one's lines.
    """
    shade(axes, push)
    alike: dict[bytes, list[int]] = {}
    for i in range(s.q_d.shape[1]):
        alike.setdefault(s.zeta[:, i].tobytes(), []).append(i)
    for joints in alike.values():
        names = ", ".join(f"\\zeta_{i + 1}" for i in joints)
        estimate = f"\\hat{{\\zeta}}_{joints[0] + 1}"
        i = joints[0]
        _pair(axes, s, s.zeta[:, i], s.zeta_estimate[:, i], (names, estimate), PALETTE[i])
    label(axes, "time [s]", r"torque $\zeta$ [N m]")
    return legend(axes)


def _pair(
    axes: Axes, s: Signals, true: Array, estimate: Array, names: tuple[str, str], colour: str
) -> None:
    """Draw a signal and its estimate, both (K,), with these symbols, or say that there is no observer."""
    t = broken(s, s.t)
    axes.plot(t, broken(s, true), color=colour, lw=2.4, alpha=0.6, label=f"${names[0]}$")
    if np.isnan(estimate).all():
        middle = {"ha": "center", "va": "center", "transform": axes.transAxes}
        axes.text(0.5, 0.9, NO_OBSERVER, **middle)  # type: ignore[arg-type]
        return
    dashed = {"color": "black", "ls": (0, (4, 2)), "lw": 1.0}
    axes.plot(t, broken(s, estimate), label=f"${names[1]}$", **dashed)  # type: ignore[arg-type]


def energy(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """Energies [J] over time [s], the potential energy from its least value; impacts take kinetic
    energy only.
    """
    shade(axes, push)
    potential = s.potential - s.potential.min()
    for i, (values, name) in enumerate(
        ((s.kinetic, "kinetic"), (potential, "potential"), (s.kinetic + potential, "total"))
    ):
        line(axes, s, values, i, name)
    label(axes, "time [s]", "energy [J]")
    return legend(axes)


def friction_cone(axes: Axes, s: Signals, mu: float = 0.6, slope: float = 0.0) -> Axes:
    """F_T against F_N [N] in single support and the cone |F_T| = mu F_N; outside it a foot would slip.

    mu: coefficient of dry friction, 0.6 for RABBIT (its record names the source). slope [rad]: of
    the ground, positive downhill; F_T is along it. Impulses at impact are not forces and are not
    drawn.

    Raises InputError for a coefficient that is not positive.
    """
    check_positive(mu, f"the coefficient of friction is {mu}")
    tangent, normal = (s.ground_reaction @ axis for axis in ground_axes(slope))
    top = 1.1 * max(float(np.max(normal)), 1.0)
    axes.fill([0.0, mu * top, -mu * top], [0.0, top, top], color="#dddddd", zorder=0)
    for sign in (-1.0, 1.0):
        name = f"cone, $\\mu$ = {mu:g}" if sign > 0 else "_"
        axes.plot([0.0, sign * mu * top], [0.0, top], color=GREY, ls="--", label=name)
    axes.plot(
        broken(s, tangent), broken(s, normal), color=PALETTE[0], lw=0.9, label="ground reaction"
    )
    axes.axhline(0.0, color="black", lw=0.8, label="_")
    label(axes, "$F_T$ [N]", "$F_N$ [N]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.14), ncols=2, frameon=False)
    return axes


def ground_reaction(axes: Axes, s: Signals, push: Window | None = None, slope: float = 0.0) -> Axes:
    """F_T and F_N [N] over time [s], along and out of ground of this slope [rad], positive downhill."""
    shade(axes, push)
    for i, (name, axis) in enumerate(zip(("$F_T$", "$F_N$"), ground_axes(slope), strict=True)):
        line(axes, s, s.ground_reaction @ axis, i, name)
    axes.axhline(0.0, color="black", lw=0.8, label="_")
    label(axes, "time [s]", "ground reaction [N]")
    return legend(axes)


def phase_portrait(axes: Axes, s: Signals, name: str = "walk", colour: int = 0) -> Axes:
    """Theta [rad] against Theta' [rad/s]: solid in single support, dotted across impacts.

    colour: index in the palette. The start is marked.
    """
    axes.plot(broken(s, s.theta), broken(s, s.dtheta), color=PALETTE[colour], lw=0.8, label=name)
    for k, j in enumerate(np.flatnonzero(np.diff(s.step))):
        ends, text = slice(j, j + 2), "impact" if k == 0 else "_"
        axes.plot(s.theta[ends], s.dtheta[ends], color=GREY, ls=":", lw=0.6, label=text)
    axes.plot(s.theta[0], s.dtheta[0], "o", color="black", ms=4, label="start")
    label(axes, r"$\Theta$ [rad]", r"$\dot\Theta$ [rad/s]")
    axes.legend(loc="best", frameon=False)
    return axes
