"""How a run ended. Each text says what happened and what to change; the command line prints it as it is.

A failure during a run raises no error: `hybrid.simulator` and the compiled loops return a status, and the
trajectory up to the failure is kept.
"""

from enum import Enum


class Status(Enum):
    """Why a run ended; the value of each is its message to the user. Only COMPLETED is success.

    >>> walk = ba.walk_scenario(ba.Scenario("NPD", run={"impacts": 2}))
    >>> walk.trajectory.status is ba.Status.COMPLETED
    True
    """

    COMPLETED = "the run reached the number of events or the time asked for"
    """All events or all the time asked for; the only status that is `ok`."""
    TIME_OUT = "the time ended before the number of events asked for; give a larger t_end"
    """t_end came before the number of events asked for."""
    FELL = "the robot fell; start nearer the gait, push less, raise the torque limit or change the controller"
    """The hip came lower than the walker's limit."""
    STALLED = (
        "the swing foot did not strike within the longest step allowed; the robot stands or falls "
        "back: start faster or push less"
    )
    """A single support lasted longer than the walker's limit."""
    NOT_FINITE = (
        "a state or torque is not finite; the last good state is kept: check the controller's output, "
        "shorten the step or use an exponential method"
    )
    """NaN or infinity in a state or torque."""
    SINGULAR = "a matrix that the controller inverts became singular; the constraint does not suit this state"
    """A matrix of the controller was singular: in compiled code, a pivot of exactly zero."""
    STEP_FAILED = "the one-step method could not go on; try another method or a looser tolerance"
    """The integration method could not go on: no acceptable step, or too many steps."""
    EVENT_LIMIT = "events accumulate (Zeno), or exceed max_events: end the run before, or raise it"
    """The next event would come within 1 us, or `RunOptions.max_events` came before the run was complete."""
    RAN_AWAY = (
        "the motion or a torque grew beyond anything that the robot has, or a joint turned all the way round; "
        "shorten the step, use an adaptive or exponential method, or weaken the controller's gains or "
        "its observer; runaway_speed and runaway_torque set the bounds on rates and torques"
    )
    """An angle, a rate or a torque passed the walker's bounds; the last state within them is kept."""
    RAISED = "a class of your own raised an exception"
    """An exception in a class of the user's, or an array of another shape from it, in the middle of a run."""
    INFEASIBLE = "ground or motors could not carry this step; push less, walk slower, change gait or controller"
    """A walking step broke a limit of ground or motors (`analysis.feasibility`), or the stance foot of a plant
    with soft contact left the ground."""

    __repr__ = Enum.__str__  # without its message, in lists and arrays

    @property
    def ok(self) -> bool:
        """True when the run did what was asked."""
        return self is Status.COMPLETED
