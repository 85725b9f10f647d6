"""Events along an arc: where a step crosses zero of a witness, located by Brent's method on the step itself.

The step is taken again with a shorter length, so that x- has the accuracy of the method and not of an
interpolant.
"""

from __future__ import annotations

import math

from scipy.optimize import brentq

from biped_adrc.errors import NotFiniteError
from biped_adrc.hybrid.integrators import Step
from biped_adrc.hybrid.system import FoundEvent, Guard
from biped_adrc.hybrid.trajectory import Event
from biped_adrc.types import Array

RESOLUTION = 2e-3
"""Longest stretch [s] of a step over which a double crossing of a witness could pass unseen."""


T_XTOL, T_RTOL = 1e-15, 9e-16  # of the event time: [s], and relative to it


ITERATIONS = 10_000  # a witness that touches zero flatly takes more than SciPy's 100


def interior(t0: float, t1: float) -> list[float]:
    """Times in (t0, t1] [s] no further apart than RESOLUTION, the last one t1."""
    count = max(1, math.ceil((t1 - t0) / RESOLUTION - 1e-9))
    return [t0 + (t1 - t0) * k / count for k in range(1, count)] + [t1]


def event_time_error(t: float) -> float:
    """How far the root finder may leave the time of an event at t [s] from the root [s], in both engines."""
    return T_XTOL + T_RTOL * abs(t)


class Watch:
    """The witnesses (event functions) along one arc; a guard is armed once its witness has left zero.

    values: those at the last time looked at.
    """

    def __init__(self, guards: tuple[Guard, ...], t: float, x: Array, fired: str | None):
        """`fired` has just ended the last arc: what is left of its witness is round-off, taken as zero."""
        self.guards = guards
        self.values = [0.0 if g.name == fired else g.witness(t, x) for g in guards]

    def first(self, step: Step) -> FoundEvent | None:
        """The earliest crossing in `step` that is an event; None without one.

        Long steps are looked through every RESOLUTION, and a reset that returns None lets a
        crossing pass.
        """
        before_t = step.t0
        for t in interior(step.t0, step.t1):
            x = step.x1 if t == step.t1 else step.at(t)
            after = [guard.witness(t, x) for guard in self.guards]
            crossed = [
                (*self._locate(guard, step, (before_t, w0), (t, w1)), guard)
                for guard, w0, w1 in zip(self.guards, self.values, after, strict=True)
                if guard.direction.crossed(w0, w1)
            ]
            self.values, before_t = after, t
            for te, xe, guard in sorted(crossed, key=lambda c: c[0]):
                if guard.terminal is not None:
                    return FoundEvent(Event(guard.name, te, xe, None), None, guard.terminal)
                outcome = guard.reset(te, xe) if guard.reset is not None else None
                if outcome is not None:
                    return FoundEvent(Event(guard.name, te, xe, outcome[0]), outcome)
        return None

    @staticmethod
    def _locate(
        guard: Guard, step: Step, start: tuple[float, float], end: tuple[float, float]
    ) -> tuple[float, Array]:
        """Time [s] and state (nx,) of the crossing between two (time, witness), by Brent's method to round-off.

        The witnesses at both ends are those that differ in sign: taken again, dense output may give
        others in their last bit. Raises NotFiniteError for a state in between that is not finite.
        """
        known = dict((start, end))

        def witness(t: float) -> float:
            return known[t] if t in known else guard.witness(t, state(t))

        def state(t: float) -> Array:
            x = step.at(t)
            if not math.isfinite(x.dot(x)):
                raise NotFiniteError(f"the state is not finite at t = {t:.6g} s, within a step")
            return x

        if end[1] == 0.0:
            return end[0], state(end[0])
        limits = {"xtol": T_XTOL, "rtol": T_RTOL, "maxiter": ITERATIONS}
        te = float(brentq(witness, start[0], end[0], **limits))
        return te, state(te)
