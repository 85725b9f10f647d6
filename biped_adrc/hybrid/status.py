"""How a run ended. Each text says what happened and what to change; the command line prints it as it is.

A run never raises for what happens on the way: `hybrid.simulator` and the compiled loops note a
status, and the trajectory up to there is kept.
"""

from __future__ import annotations

from enum import Enum


class Status(Enum):
    """The value is the message."""

    COMPLETED = "the run reached the number of events or the time asked for"
    """The only status that is `ok`."""
    TIME_OUT = "the time ended before the number of events asked for; give a larger t_end"
    """t_end came before the number of events."""
    FELL = (
        "the robot fell; start nearer to the gait, push less, raise the torque limit or change the "
        "controller"
    )
    """The hip came too low."""
    STALLED = (
        "the swing foot did not strike within the longest step allowed; the robot stands or falls "
        "back: start faster or push less"
    )
    """A single support took too long."""
    NOT_FINITE = (
        "a state or torque is not finite; the last good state is kept: check the controller's output, "
        "shorten the step or use a stiff or exponential method"
    )
    """NaN or infinity."""
    SINGULAR = "a matrix that the controller inverts became singular; the constraint does not suit this state"
    """A pivot of exactly zero."""
    STEP_FAILED = "the one-step method could not go on; try another method or a looser tolerance"
    """Step control or the solver gave up."""
    RAISED = "a part in plain Python raised an exception of its own; the detail says which"
    """An exception in a user's part, in a batch."""
    ILLEGAL = (
        "the ground or the motors could not have carried this step; push less, walk slower, or change the gait "
        "or the controller"
    )
    """What ground or motors could not have carried (`analysis.legality`)."""
    EVENT_LIMIT = "more events than max_events; the events accumulate (Zeno), or raise max_events"
    """As many events as `RunOptions.max_events`."""

    @property
    def ok(self) -> bool:
        """True when the run did what was asked."""
        return self is Status.COMPLETED
