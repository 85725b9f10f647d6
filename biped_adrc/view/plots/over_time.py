"""Signals of one walk over time, on axes of your own: angles, errors, torques, disturbances, ground, energy.

Also the phase portrait and the friction cone, which are curves of the same signals. Every plot takes the Axes,
`Signals` (rows are the K nodes of a walk, the instants at which its state is stored) and perhaps the window of
a push, which is shaded; it labels the axes with units and returns them. Lines break at impacts, where
velocities and torques jump.

    q, q_b, q_d      the coordinates [rad], the first p of them, which have motors, and references of these
    u, zeta          torques of the motors, and of disturbances from outside [N m]
    xi, xi^          total disturbance of the joints [rad/s^2], and an observer's estimate of it
    kappa            input gain of the controller's model, q_b'' = kappa u + xi: (13) of the paper
    Theta            phase of the gait [rad], Theta' its rate
    F_T, F_N         force of the ground on the robot, along the ground and out of it [N]
"""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from matplotlib.axes import Axes

from biped_adrc.analysis.signals import Signals
from biped_adrc.analysis.statistics import rms
from biped_adrc.core.errors import check_positive
from biped_adrc.core.types import Array
from biped_adrc.model.ground import ground_axes
from biped_adrc.view.style import DASHES, GREY, PALETTE, PUSH, label

Window = tuple[float, float]
"""Start and stop of a push [s]."""


class OverTime(Protocol):
    """The signals that lines over time need: t (K,) [s], and the number of the single support (K,)."""

    @property
    def t(self) -> Array: ...
    @property
    def step(self) -> Array: ...


def with_gaps(s: OverTime, y: Array) -> Array:
    """Insert a row of NaN into y (K,) or (K, k) where a new single support begins.

    matplotlib breaks a line at NaN, so no line crosses an impact. The times are broken in the same way.
    """
    return np.insert(y, np.flatnonzero(np.diff(s.step)) + 1, np.nan, axis=0)


def line(axes: Axes, s: OverTime, y: Array, i: int, name: str, **look: Any) -> None:
    """Draw y (K,) over time [s] in the i-th colour and dash, broken at impacts; name: in the legend.

    look: matplotlib's settings of a line, in place of that colour and dash.
    """
    look = {"color": PALETTE[i], "ls": DASHES[i % 4], **look}
    axes.plot(with_gaps(s, s.t), with_gaps(s, y), label=name, **look)


def curves(axes: Axes, s: OverTime, values: Array, symbol: str) -> None:
    """Draw the columns of values (K, k) over time [s], named symbol_1, symbol_2, ... in the legend."""
    for i, column in enumerate(values.T):
        line(axes, s, column, i, f"${symbol}_{i + 1}$")


def finished(axes: Axes, unit: str, push: Window | None = None) -> Axes:
    """Shade the time of a push (start, stop) [s], label the axes, put the legend above; returns the axes.

    unit: label of the axis of values, a word and the unit.
    """
    if push is not None:
        axes.axvspan(*push, color=PUSH, alpha=0.3, zorder=0, label="push")
    label(axes, "time [s]", unit)
    return legend(axes)


def legend(axes: Axes) -> Axes:
    """Put the legend in a line above the axes, where it covers nothing and takes no width; returns the axes."""
    count = len(axes.get_legend_handles_labels()[1])
    spaces = {"columnspacing": 1.2, "handlelength": 1.6, "borderaxespad": 0.0}
    axes.legend(loc="lower left", bbox_to_anchor=(-0.01, 1.0), ncols=count, frameon=False, **spaces)
    return axes


def angle_unit(values: Array) -> tuple[str, float]:
    """Choose the unit, from rad to nrad, in which the largest |value| [rad] is at least 0.5; returns it and its
    factor, units per rad. NaN does not count.
    """
    largest = np.nanmax(np.abs(values), initial=0.0)
    for unit, factor in (("rad", 1.0), ("mrad", 1e3), ("µrad", 1e6)):
        if largest * factor >= 0.5:
            return unit, factor
    return "nrad", 1e9


JOINTS = ("stance hip", "swing hip", "stance knee", "swing knee")
"""Names of the actuated joints of a five-link biped."""


def joint_name(s: Signals, i: int) -> str:
    """Name of actuated joint i (from 0) in a legend: such as "$q_1$ stance hip" with four actuated joints,
    which are taken for those of a five-link biped; else the symbol alone.
    """
    return f"$q_{i + 1}$ {JOINTS[i]}" if s.q_d.shape[1] == len(JOINTS) else f"$q_{i + 1}$"


def angles(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """Draw all coordinates q1..qn [rad] over time [s]; push: (start, stop) [s], shaded. Returns the axes."""
    curves(axes, s, s.q, "q")
    return finished(axes, "angle [rad]", push)


def joint_tracking(
    axes: Axes, s: Signals, joints: Sequence[int] | None = None, push: Window | None = None
) -> Axes:
    """Draw the angles of actuated joints [rad] over time [s] as broad lines, their
    references dashed in black on top.

    joints: indices from 0, all if None. push: (start, stop) [s], shaded. Returns the axes.
    """
    joints = range(s.q_d.shape[1]) if joints is None else joints
    for i in joints:
        line(axes, s, s.q[:, i], i, joint_name(s, i), ls=DASHES[i % 2], lw=2.2)
    for i in joints:
        # after a fall the error is NaN, and the reference is not drawn
        on_curve = np.where(np.isnan(s.error[:, i]), np.nan, s.q_d[:, i])
        name = "references" if i == joints[0] else "_"  # matplotlib leaves "_" out of the legend
        line(axes, s, on_curve, i, name, color="black", ls=(0, (4, 3)), lw=0.8)
    return finished(axes, "angle [rad]", push)


def tracking_errors(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """Draw q_b - q_d of each actuated joint over time [s], in the unit from rad to nrad that suits the largest.

    push: (start, stop) [s], shaded. Returns the axes.
    """
    unit, factor = angle_unit(s.error)
    curves(axes, s, factor * s.error, "q")
    return finished(axes, f"tracking error [{unit}]", push)


def torques(axes: Axes, s: Signals, limit: float | None = None, push: Window | None = None) -> Axes:
    """Draw the motors' torques u [N m] over time [s]; limit [N m]: dotted, with both signs. Returns the axes.

    push: (start, stop) [s], shaded.
    """
    curves(axes, s, s.u, "u")
    if limit is not None:
        axes.axhline(limit, color=GREY, ls=":", label=f"limit {limit:g} N m")
        axes.axhline(-limit, color=GREY, ls=":", label="_")  # "_" keeps it out of the legend
    return finished(axes, "torque [N m]", push)


def total_disturbance(axes: Axes, s: Signals, joint: int = 0, push: Window | None = None) -> Axes:
    """Draw xi of (13), q_b'' - kappa u, and its estimate xi^ [rad/s^2] for one actuated joint over time [s].

    The model is the controller's nominal one. joint: index from 0. Without an observer the panel says so. push:
    (start, stop) [s], shaded. Returns the axes.
    """
    names = f"\\xi_{joint + 1}", f"\\hat{{\\xi}}_{joint + 1}"
    _pair(axes, s, s.xi[:, joint], s.xi_estimate[:, joint], names, 0)
    return finished(axes, f"$\\xi_{joint + 1}$ [rad/s²]", push)


def matched_disturbance(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """Draw the external torque zeta [N m] on each actuated joint, and the torque to which its xi^ is
    equivalent.

    Broad: zeta_b, the torque on the motors' joints, which a motor could cancel. Dashed: kappa^-1 (xi^ -
    xi_nominal), with xi_nominal the xi of the model without zeta; it also holds the effect of zeta on the joint
    without a motor and errors of the model, so the lines differ by those. Joints with the same torque share the
    first one's lines. push: (start, stop) [s], shaded. Returns the axes.
    """
    # joints by the bytes of their torque over time
    alike: dict[bytes, list[int]] = {}
    for i in range(s.q_d.shape[1]):
        alike.setdefault(s.zeta[:, i].tobytes(), []).append(i)
    for joints in alike.values():
        i, names = joints[0], ", ".join(f"\\zeta_{j + 1}" for j in joints)
        estimate = f"\\hat{{\\zeta}}_{i + 1}"
        _pair(axes, s, s.zeta[:, i], s.zeta_estimate[:, i], (names, estimate), i)
    return finished(axes, r"torque $\zeta$ [N m]", push)


def _pair(
    axes: Axes, s: Signals, true: Array, estimate: Array, names: tuple[str, str], i: int
) -> None:
    """Draw a signal and its estimate, both (K,), over time. An estimate that is all NaN is that of a controller
    without an observer: the axes then say so.

    names: symbols of both in TeX. i: number of the signal's colour; the estimate is dashed in black.
    """
    line(axes, s, true, i, f"${names[0]}$", ls="-", lw=2.4, alpha=0.6)
    if np.isnan(estimate).all():
        say_no_observer(axes)
    else:
        line(axes, s, estimate, i, f"${names[1]}$", color="black", ls=(0, (4, 2)), lw=1.0)


def say_no_observer(axes: Axes) -> None:
    """Write on the axes, in place of a curve, that the controller has no observer."""
    axes.text(0.5, 0.9, "no observer: nothing is estimated", ha="center", transform=axes.transAxes)


def energy(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """Draw kinetic, potential and total energy [J] over time [s], the potential energy counted from its least
    value in the walk.

    At an impact only the kinetic energy falls. push: (start, stop) [s], shaded. Returns the axes. 0, 1, 2 are
    the numbers of colour and dash.
    """
    potential = s.potential - s.potential.min()
    line(axes, s, s.kinetic, 0, "kinetic")
    line(axes, s, potential, 1, "potential")
    line(axes, s, s.kinetic + potential, 2, "total")
    return finished(axes, "energy [J]", push)


def friction_cone(axes: Axes, s: Signals, mu: float = 0.6, slope: float = 0.0) -> Axes:
    """Draw F_T against F_N [N] in single support and the cone |F_T| = mu F_N, outside
    of which a foot would slip.

    mu: coefficient of dry friction, 0.6 for RABBIT (its record names the source). slope [rad]: of the ground,
    positive downhill; F_T is along it. Impulses at impact are not forces and are not drawn. Returns the axes.

    Raises InputError for a coefficient that is not positive.
    """
    check_positive(mu, f"the coefficient of friction is {mu}")
    tangent, normal = (s.ground_reaction @ axis for axis in ground_axes(slope))
    top = 1.1 * max(float(np.max(normal)), 1.0)  # [N]; a cone also where the ground never pushes
    axes.fill([0.0, mu * top, -mu * top], [0.0, top, top], color="#dddddd", zorder=0)
    for sign in (-1.0, 1.0):
        name = f"cone, $\\mu$ = {mu:g}" if sign > 0 else "_"
        axes.plot([0.0, sign * mu * top], [0.0, top], color=GREY, ls="--", label=name)
    x, y = with_gaps(s, tangent), with_gaps(s, normal)
    axes.plot(x, y, color=PALETTE[0], lw=0.9, label="ground reaction")
    axes.axhline(0.0, color="black", lw=0.8, label="_")
    label(axes, "$F_T$ [N]", "$F_N$ [N]")
    return legend(axes)


def ground_reaction(axes: Axes, s: Signals, push: Window | None = None, slope: float = 0.0) -> Axes:
    """Draw F_T and F_N [N] over time [s], the force of the ground on the robot along and perpendicular to
    ground of this slope [rad], positive downhill.

    push: (start, stop) [s], shaded. Returns the axes.
    """
    for i, (name, axis) in enumerate(zip(("$F_T$", "$F_N$"), ground_axes(slope), strict=True)):
        line(axes, s, s.ground_reaction @ axis, i, name)
    axes.axhline(0.0, color="black", lw=0.8, label="_")
    return finished(axes, "ground reaction [N]", push)


def phase_portrait(axes: Axes, s: Signals, name: str = "walk", colour: int = 0) -> Axes:
    """Draw Theta' [rad/s] over Theta [rad]: solid in single support, dotted from before an impact to after it,
    with a dot at the start of the walk.

    name: in the legend. colour: index in the palette. Returns the axes.
    """
    x, y = with_gaps(s, s.theta), with_gaps(s, s.dtheta)
    axes.plot(x, y, color=PALETTE[colour], lw=0.8, label=name)
    # j: last node before an impact, j + 1: first node after it; the legend has the first only ("_" hides)
    for k, j in enumerate(np.flatnonzero(np.diff(s.step))):
        ends, text = slice(j, j + 2), "impact" if k == 0 else "_"
        axes.plot(s.theta[ends], s.dtheta[ends], color=GREY, ls=":", lw=0.6, label=text)
    axes.plot(s.theta[0], s.dtheta[0], "o", color="black", ms=4, label="start")
    label(axes, r"$\Theta$ [rad]", r"$\dot\Theta$ [rad/s]")
    axes.legend(loc="best", frameon=False)
    return axes


_MARKERS = "osD^"
"""Marks by controller, repeated from the fifth on."""
FLOOR = 1e-13
"""Least error that is drawn [rad]: on a logarithmic scale anything below it is round-off."""


def error_over_time(axes: Axes, walks: Mapping[str, Signals], push: Window | None = None) -> Axes:
    """Draw max_i |q_i - q_di| [rad] of the actuated joints over time [s], a line for each walk, on a
    logarithmic scale.

    walks: name of the controller -> signals. push: (start, stop) [s], shaded. Lines break at impacts. Errors
    below FLOOR are drawn there, as a logarithmic scale has no 0. Returns the axes.
    """
    for i, (name, s) in enumerate(walks.items()):
        line(axes, s, np.maximum(np.max(np.abs(s.error), axis=1), FLOOR), i, name, lw=1.0)
    axes.set_yscale("log")
    return finished(axes, "largest tracking error [rad]", push)


def error_sizes(axes: Axes, walks: Mapping[str, Signals]) -> Axes:
    """Draw peak and root mean square of the tracking error [rad] of all joints up to a fall, a mark for each
    controller, with the numbers beside them; returns the axes.

    walks: name of the controller -> signals. The scale is logarithmic, so that less than FLOOR is drawn there.
    """
    for i, (name, s) in enumerate(walks.items()):
        past = s.before_fall  # without the nodes of a fall, where the error is NaN
        sizes = [max(float(np.nanmax(np.abs(s.error))), FLOOR), max(rms(past.t, past.error), FLOOR)]
        axes.plot([0, 1], sizes, color=PALETTE[i], marker=_MARKERS[i % 4], ls="", ms=8, label=name)
        for k, size in enumerate(sizes):
            axes.annotate(
                f"{size:.1e}", (k, size), xytext=(9, 0), textcoords="offset points", va="center"
            )
    axes.set_xticks([0, 1], ["largest", "root mean square"])
    axes.set_xlim(-0.5, 1.8)
    axes.set_yscale("log")
    axes.margins(y=0.15)
    label(axes, "", "tracking error [rad]")
    return axes


def torque_sizes(axes: Axes, walks: Mapping[str, Signals]) -> Axes:
    """Draw the peak torque max |u_i| [N m] of every motor as bars, side by side for each controller in a colour
    and hatch of its own; returns the axes.

    walks: name of the controller -> signals, all with the same motors.
    """
    width = 0.8 / len(walks)
    for i, (name, s) in enumerate(walks.items()):
        peaks = np.max(np.abs(s.u), axis=0)
        # the bars of all walks together are centred at the number of the motor
        at = np.arange(len(peaks)) + (i - 0.5 * (len(walks) - 1)) * width
        hatch = ("", "///", "...", "xxx")[i % 4]
        axes.bar(at, peaks, width, color=PALETTE[i], ec="white", hatch=hatch, label=name)
    axes.set_xticks(np.arange(len(peaks)), [f"$u_{k + 1}$" for k in range(len(peaks))])
    label(axes, "", "peak torque [N m]")
    return legend(axes)
