"""How a walk ended, in a few words for a picture of it."""

from __future__ import annotations

from biped_adrc.hybrid.trajectory import Trajectory


def ending(trajectory: Trajectory) -> str:
    """Such as "fell at 3.42 s: hip too low"; empty for a walk that did what it was asked for.

    The reason is the event that ended the run, its detail, or what its status says, in this order.
    """
    status = trajectory.status
    if status.ok:
        return ""
    event = trajectory.arcs[-1].event
    reason = status.value.split(";")[0]
    if event is not None and event.x_plus is None:
        reason = event.guard.replace("_", " ")
    elif trajectory.detail:
        reason = trajectory.detail
    return f"{status.name.lower().replace('_', ' ')} at {trajectory.t_end:.2f} s: {reason}"
