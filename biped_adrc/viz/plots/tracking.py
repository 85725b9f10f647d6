"""Joint angles with their references, tracking errors, torques."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes

from biped_adrc.analysis.signals import Signals
from biped_adrc.errors import InputError
from biped_adrc.viz.plots.lines import Window, angle_unit, broken, legend, line, shade
from biped_adrc.viz.style import DASHES, GREY, PALETTE, label

JOINTS = ("stance hip", "swing hip", "stance knee", "swing knee")


def joint_name(s: Signals, i: int) -> str:
    """q_1 stance hip, and so on; q_i alone on another robot."""
    known = s.q_d.shape[1] == len(JOINTS)
    return f"$q_{i + 1}$ {JOINTS[i]}" if known else f"$q_{i + 1}$"


def chosen(s: Signals, joints: Sequence[int] | None) -> tuple[int, ...]:
    """Indices of actuated joints, all if None. Raises InputError for one that does not exist."""
    p = s.q_d.shape[1]
    found = tuple(range(p)) if joints is None else tuple(joints)
    if not found or not all(0 <= i < p for i in found):
        raise InputError(f"joints {list(found)} were asked for, expected indices from 0 to {p - 1}")
    return found


def angles(axes: Axes, s: Signals, push: Window | None = None) -> Axes:
    """All coordinates over time [rad], with motors or without."""
    shade(axes, push)
    for i in range(s.q.shape[1]):
        line(axes, s, s.q[:, i], i, f"$q_{i + 1}$")
    label(axes, "time [s]", "angle [rad]")
    return legend(axes)


def joint_tracking(
    axes: Axes, s: Signals, joints: Sequence[int] | None = None, push: Window | None = None
) -> Axes:
    """Angles of the actuated joints as broad lines, their references dashed on top in black; [rad] over [s]."""
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
    """q_b - q_d by joint, in the unit in which the largest reads well."""
    shade(axes, push)
    unit, factor = angle_unit(s.error)
    for i in range(s.error.shape[1]):
        line(axes, s, factor * s.error[:, i], i, f"$q_{i + 1}$")
    label(axes, "time [s]", f"tracking error [{unit}]")
    return legend(axes)


def torques(axes: Axes, s: Signals, limit: float | None = None, push: Window | None = None) -> Axes:
    """Torques of the motors [N m]; limit [N m] is drawn as dotted lines."""
    shade(axes, push)
    for i in range(s.u.shape[1]):
        line(axes, s, s.u[:, i], i, f"$u_{i + 1}$")
    if limit is not None:
        axes.axhline(limit, color=GREY, ls=":", label=f"limit {limit:g} N m")
        axes.axhline(-limit, color=GREY, ls=":", label="_")
    label(axes, "time [s]", "torque [N m]")
    return legend(axes)
