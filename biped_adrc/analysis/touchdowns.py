"""Times at which a controller detected the touchdowns of a finished walk (`hardware.touchdown`).

Labels say which leg is the stance leg: a touchdown swaps those of the plant, a detection those that the
controller assumes. So the events of both kinds are paired in the order of time, the first two, the next two and
so on: after each pair the labels agree again. In a pair of a touchdown and a detection the detection is late if
it comes second, else early. Two touchdowns in a pair were both missed, two detections in a pair are both false.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Frozen
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Trajectory


class TouchdownRates(NamedTuple):
    """Lateness of the detections of a walk, and the shares of early and missed ones; None where there
    is none.
    """

    late_mean: float | None
    """Mean delay of the detections that were not early [s]."""
    late_max: float | None
    """Largest delay of a detection [s]."""
    early_share: float | None
    """Share of the touchdowns that were detected early [1]."""
    missed_share: float | None
    """Share of the touchdowns that were missed [1]."""
    false_notices: int
    """Number of detections without a touchdown."""


@dataclass(frozen=True)
class Detections(Frozen):
    """The N touchdowns of a walk and their detections."""

    t: Array
    """Times of the touchdowns (N,) [s]."""
    late: Array
    """Delay of each detection (N,) [s], negative for an early one; NaN where it was missed or is to come."""
    false: Array
    """Times of the detections without a touchdown [s]."""
    waits: bool = False
    """Whether the walk ended before the last touchdown was detected or missed; no share counts it."""

    @property
    def rates(self) -> TouchdownRates:
        """Mean and largest delay of the detections that were not early [s], shares of the touchdowns that were
        detected early or missed [1], and the number of false detections.

        A last touchdown whose detection was still to come is left out of delays and shares.
        """
        # `waits` is 1 as a number: then the last touchdown is left out
        decided = self.late[: len(self.late) - self.waits]
        late = decided[decided >= 0.0]
        mean, most = (float(f(late)) if len(late) else None for f in (np.mean, np.max))
        kinds = decided < 0.0, np.isnan(decided)
        early, missed = (float(np.mean(kind)) if len(decided) else None for kind in kinds)
        return TouchdownRates(mean, most, early, missed, len(self.false))


def touchdowns(loop: ClosedLoop[Any], run: Trajectory) -> Detections:
    """Match the touchdowns of a run of this loop with the detections of its controller.

    loop: a `Walker` or `SteppingLoop` with a touchdown part; raises InputError without.
    """
    return matched(np.array([event.t for event in run.events(FOOT_STRIKE)]), notices(loop, run))


def matched(impacts: Array, found: Array) -> Detections:
    """Pair touchdowns at `impacts` (N,) [s] with detections at `found` [s], both increasing, as in the module:
    the first two events are a pair, the next two, and so on.

    An event left over at the end is a false detection, or a touchdown whose detection is still to come.
    """
    late, false = np.full(len(impacts), np.nan), []
    struck = [(t, "touchdown", i) for i, t in enumerate(impacts)]
    events = sorted([*struck, *((t, "notice", -1) for t in found)], key=lambda x: x[0])
    # i and j: index of a touchdown, -1 of a detection, so max(i, j) is that of the touchdown in a pair
    for (t, kind, i), (then, other, j) in zip(events[::2], events[1::2], strict=False):
        if kind != other:
            late[max(i, j)] = then - t if kind == "touchdown" else t - then
        elif kind == "notice":
            false += [t, then]
    # an odd number of events leaves the last one alone: (time, kind)
    alone = events[-1][:2] if len(events) % 2 else (0.0, "")
    false += [alone[0]] if alone[1] == "notice" else []
    return Detections(impacts, late, np.array(false), alone[1] == "touchdown")


def notices(loop: ClosedLoop[Any], run: Trajectory) -> Array:
    """Times [s] at which a controller detected a touchdown, right or wrong, from the states of a run.

    Raises InputError for a loop without a touchdown part.
    """
    # its parts at sample instants; None in continuous time
    k = loop.held
    if k is None or k.touchdown is None:
        raise InputError(
            "the controller of this walk knows touchdowns at once; give touchdown=, such as "
            "FaultyTouchdown(0.005)"
        )
    # the controller's belief at all nodes: a detection raises its number `step` and sets its `start`
    x = np.vstack([arc.x for arc in run.arcs])
    began = loop.layout_of(x[0]).tree(x).tail.belief
    step, start = np.asarray(began.step, dtype=float), np.asarray(began.start)
    # the first tick may detect a touchdown at once; its number is then above that of the single support
    at_once = step[0] > run.arcs[0].mode.step and start[0] == run.arcs[0].t[0]
    return start[np.append(at_once, np.diff(step) > 0.0)]
