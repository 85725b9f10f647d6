"""What a controller is: a torque from a measurement and a state of its own.

    u = output(s, m),   s' = flow(s, m, u)         in continuous time
    s <- correct(s, m), u = output(s, m), s <- predict(s, m, u)    at a tick

The state s is passed in and handed back. A controller without a state needs `output` alone and works in
both time bases. `u` handed to `flow` and `predict` is the torque applied, after saturation.

At a sample instant `output` comes between `correct` and `predict`: the torque uses the measurement of this
instant, and the observer inside is told that torque and no other, so it does not wind up at a limit.

A controller is a frozen dataclass that writes these methods. Python calls them, and the engine turns them into
machine code (`biped_adrc.core.part`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import ClassVar, NamedTuple, NoReturn

import numpy as np

from biped_adrc.core.checks import line_of, returned, spoken
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import Part
from biped_adrc.core.shown import one_line
from biped_adrc.core.types import Array, Indices
from biped_adrc.model.reduction import BodyTerms, Reduction
from biped_adrc.observers.base import ErrorSystem, Estimate


class Measurement(NamedTuple):
    """What the controller is given, as its sensors see it; `terms` are the nominal model's, computed once.

    >>> q, v = gait.q_minus, gait.v_minus
    >>> m = ba.Measurement(t=0.0, step=1, t_step=0.0, q=q, v=v, terms=biped.reduction(q, v))
    >>> m.q_b.shape
    (4,)
    """

    t: float
    """[s] from the start of the run."""
    step: int
    """Single support, counted from 1."""
    t_step: float
    """[s] since this single support began."""
    q: Array
    """(n,) [rad]."""
    v: Array
    """(n,) [rad/s]."""
    terms: Reduction
    """D, Omega, kappa, xi of the nominal model at (q, v)."""
    body: BodyTerms | None = None
    """G, C' q' and the ground's force of the nominal model, for a controller with `needs_body`."""
    elsewhere: Callable[[Array, Array], Measurement] | None = None
    """elsewhere(q, v) -> what would be given in that state, at the same time; None outside of a closed loop."""

    @property
    def q_b(self) -> Array:
        """Actuated joints (p,) [rad]."""
        return self.q[: len(self.terms.kappa)]

    @property
    def v_b(self) -> Array:
        """Their rates (p,) [rad/s]."""
        return self.v[: len(self.terms.kappa)]

    def __repr__(self) -> str:
        return one_line(self)


def measured(m: Measurement) -> Estimate:
    """What measurement and nominal model say of the p joints: q_b, q_b' and xi, each (p,).

    In place of an observer's estimates where there is none, and where one starts.
    """
    p = m.terms.kappa.shape[0]
    return Estimate(m.q[:p], m.v[:p], m.terms.xi)


class Controller(Part):
    """Base of all controllers: write `output`, and what else the controller needs.

    Frozen, with gains and parts as fields. A controller with `flow` works in continuous time, one with
    `correct` and `predict` in sampled time, and `sampled` turns the one into the other.

    >>> @dataclass(frozen=True)
    ... class PD(ba.Controller):
    ...     reference: ba.Reference
    ...
    ...     def output(self, s, m):
    ...         r = self.reference(m.t, m.q, m.v)
    ...         return 2500.0 * (r.q_d - m.q_b) + 120.0 * (r.dq_d - m.v_b)
    >>> ba.walk(ba.Walker(biped, PD(gait.constraint)), gait, impacts=1).impacts
    1
    """

    needs_body: ClassVar[bool] = False
    """Whether `Measurement.body` has to be there."""

    def output(self, s: Array, m: Measurement) -> Array:
        """u (p,) [N m] asked of the motors, before any limit. Raises InputError where no class writes it."""
        raise InputError(
            f"{type(self).__name__} has no method output(s, m); write it: u (p,) [N m] from its state s and "
            "the Measurement m"
        )

    def initial_state(self, m: Measurement) -> Array:
        """s (size,) at the start of a run; empty (0,) for a controller without state."""
        return np.zeros(0)

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        """s' (size,) in continuous time, under the applied torque u (p,) [N m]; of no state, none."""
        return s

    def correct(self, s: Array, m: Measurement) -> Array:
        """Sampled: s (size,) with the measurement of this sample instant taken in."""
        return s

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        """Sampled: s (size,) at the next sample instant, under the applied torque u (p,) [N m]."""
        return s

    def jump(self, s: Array, after: Measurement, swap: Indices) -> Array:
        """s (size,) after impact; `swap` (p,) is for `types.relabelled`, `after` is measured after it."""
        return s

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        """What an observer inside says of the joints, each (p,); None without one. It is for plots."""
        return None

    def projected_output(self, s: Array, m: Measurement, a: Array) -> Array:
        """u (p,) [N m] as `output`, blind to changes of the rates along a (n, 2) in the rate error.

        For `impact_invariant`. Raises InputError for a controller that has no such form.
        """
        self._has_no("rate error that could be projected")

    def projected_correct(self, s: Array, m: Measurement, a: Array) -> Array:
        """s (size,) as `correct`, blind to changes of the rates along a (n, 2) in the innovation."""
        self._has_no("innovation that could be projected")

    def sampled(self, period: float) -> Controller:
        """The same law for ticks every `period` [s].

        Raises InputError for a controller that has a state in continuous time and no discrete form.
        """
        if self._writes("flow") and not self._writes("predict"):
            raise InputError(
                f"{type(self).__name__} has no discrete form: give it a method sampled(period), "
                "or use ContinuousTime()"
            )
        return self

    def continuous(self) -> Controller:
        """Itself, for continuous time. Raises InputError for a controller that was made for sampled time."""
        if self._writes("predict") and not self._writes("flow"):
            self._only_sampled()
        return self

    def error_system(self) -> ErrorSystem | None:
        """Linear error dynamics of an observer that is the whole state s; None otherwise."""
        return None

    def _writes(self, name: str) -> bool:
        """Whether its class writes this method."""
        return getattr(type(self), name) is not getattr(Controller, name)

    def _only_sampled(self) -> NoReturn:
        raise InputError(
            f"{type(self).__name__} works in sampled time only; give timing=SampledTime(period), or "
            "hardware.period of a scenario"
        )

    def _has_no(self, what: str) -> NoReturn:
        raise InputError(
            f"{type(self).__name__} has no {what}; expected one such as NPDController or ADRCController"
        )


def nested(controller: Controller | None) -> Iterator[Controller]:
    """A controller and the controllers inside it (field `inner`)."""
    while controller is not None:
        yield controller
        controller = getattr(controller, "inner", None)


def check_methods(controller: Controller, s: Array, m: Measurement, sampled: bool) -> None:
    """Raise InputError for arrays of another shape, and for a user's method with a memory or noise of its own.

    It is asked at the start: machine code would write past the end of the state, and keep nothing in an object.
    """
    u = returned(controller.output(s, m), (m.terms.kappa.shape[0],), controller, "output")
    if not _is_own(controller):
        return
    calls = {"correct": (m,), "predict": (m, u)} if sampled else {"flow": (m, u)}
    first = {"output": u}
    for name, method in calls.items():
        result = getattr(controller, name)(s, *method)
        first[name] = returned(result, s.shape, controller, name, finite=False)
    calls, other = {"output": (m,), **calls}, m._replace(v=m.v + 1e-3)
    for name, method in calls.items():
        getattr(controller, name)(s, other, *method[1:])  # which a memory takes in
        if not np.array_equal(first[name], getattr(controller, name)(s, *method), equal_nan=True):
            raise InputError(
                f"{spoken(controller)}.{name}{line_of(controller, name)} gave another result when asked again "
                "at the same instant; expected no memory in the object: return a state from initial_state, and "
                "flow or predict"
            )


def _is_own(part: Part) -> bool:
    """Whether the class of a part, or of one in it, is a user's."""
    inside = (x for x in vars(part).values() if isinstance(x, Part))
    return not type(part).__module__.startswith("biped_adrc.") or any(map(_is_own, inside))
