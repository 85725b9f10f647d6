"""What a controller is: a torque from a measurement and a state of its own.

    u = output(s, m),   s' = flow(s, m, u)         in continuous time
    s <- correct(s, m), u = output(s, m), s <- predict(s, m, u)    at a tick

The state s is passed in and handed back. A controller without a state needs `output` alone and works in
both time bases. `u` handed to `flow` and `predict` is the torque applied, after saturation.

At a sample instant `output` comes between `correct` and `predict`: the torque uses the measurement of this
instant, and the observer inside is told that torque and no other, so it does not wind up at a limit.

A leaf gives `laws`, pure functions of numbers and arrays that the engine turns into machine code, or writes the
methods, and runs in Python. `closed_loop.semantics` calls either through `controller_laws`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple

import numpy as np

from biped_adrc.composed import Composed
from biped_adrc.errors import InputError
from biped_adrc.model.reduction import BodyTerms, Reduction
from biped_adrc.observers.base import ErrorSystem, Estimate
from biped_adrc.parts import returned
from biped_adrc.shown import one_line
from biped_adrc.types import Array


class Measurement(NamedTuple):
    """What the controller is given, as its sensors see it; `terms` are the nominal model's, computed once."""

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


class ControllerLaws(NamedTuple):
    """The pure functions behind a controller; None for what it has not, as a state or a discrete form.

    s (size,) is the state, of a size that `initial_state` decides; u (p,) [N m]; swap (p,) relabels the joints.
    """

    parameters: object
    """k, a NamedTuple of numbers and float64 arrays."""
    output: Callable[..., Array]
    """output(k, s, m) -> u."""
    initial_state: Callable[..., Array] | None = None
    """initial_state(k, m) -> s."""
    flow: Callable[..., Array] | None = None
    """flow(k, s, m, u) -> s'."""
    jump: Callable[..., Array] | None = None
    """jump(k, s, after, swap) -> s after impact."""
    correct: Callable[..., Array] | None = None
    """correct(k, s, m) -> s at the tick."""
    predict: Callable[..., Array] | None = None
    """predict(k, s, m, u) -> s at the next tick."""
    estimate: Callable[..., Estimate | None] | None = None
    """estimate(k, s, m) -> what an observer inside says."""
    obstacle: str = ""
    """The part that has no laws, so that these run in Python only; empty where all of them compile."""
    blind: Callable[..., Any] | None = None
    """blind(k, m, a) -> k with which no rates a (n, 2) change the rate error that `output` sees at m."""
    correct_blind: Callable[..., Array] | None = None
    """correct_blind(k, s, m, a) -> s as `correct` gives it, from the part of the innovation orthogonal to a."""

    @property
    def functions(self) -> ControllerLaws:
        """The laws alone, without their parameters."""
        return self._replace(parameters=None, obstacle="")

    def __repr__(self) -> str:
        return one_line(self)


class Controller(Composed):
    """Base of all controllers: write `output` and what else it needs, or give `laws`, which they all call.

    Frozen, with gains and parts as fields. A controller with `flow` works in continuous time, one with
    `correct` and `predict` in sampled time, and `sampled` turns the one into the other.
    """

    _kind: ClassVar[str] = "controller"
    _methods: ClassVar[frozenset[str]] = frozenset(
        (
            "output",
            "initial_state",
            "flow",
            "jump",
            "correct",
            "predict",
            "estimate",
        )
    )
    needs_body: ClassVar[bool] = False
    """Whether `Measurement.body` has to be there."""

    @property
    def laws(self) -> ControllerLaws | None:
        """The pure functions that the methods amount to; None for a controller written as methods alone."""
        return None

    def output(self, s: Array, m: Measurement) -> Array:
        """u (p,) [N m] asked of the motors, before any limit. Raises InputError where none is written."""
        law = self._law("output")
        if law is None:
            raise InputError(
                f"{type(self).__name__} has neither a method output(s, m) nor laws; write one of them: u (p,) "
                "[N m] from its state s and the Measurement m"
            )
        u: Array = law(s, m)
        return u

    def initial_state(self, m: Measurement) -> Array:
        """s (size,) at the start of a run; empty (0,) for a controller without state."""
        law = self._law("initial_state")
        return np.zeros(0) if law is None else law(m)

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        """s' (size,) in continuous time, under the applied torque u (p,) [N m].

        Raises InputError for a controller that was made for sampled time.
        """
        law = self._law("flow")
        if law is None:
            self.continuous()
        return np.zeros(0) if law is None else law(s, m, u)

    def correct(self, s: Array, m: Measurement) -> Array:
        """Sampled: s (size,) with the measurement of this sample instant taken in.

        Raises InputError, as `predict` does, for a controller in continuous time that has a state.
        """
        if self._laws is None:
            return s
        law = self._law("correct")
        if law is None and self._law("flow") is not None:
            raise InputError(
                f"{type(self).__name__} works in continuous time; call sampled(period)"
            )
        return s if law is None else law(s, m)

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        """Sampled: s (size,) at the next sample instant, under the applied torque u (p,) [N m]."""
        if self._laws is None:
            return s
        law = self._law("predict")
        if law is None and self._law("flow") is not None:
            raise InputError(
                f"{type(self).__name__} works in continuous time; call sampled(period)"
            )
        return s if law is None else law(s, m, u)

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        """s (size,) after impact; `swap` (p,) relabels the joints, `after` is measured after it."""
        law = self._law("jump")
        return s if law is None else law(s, after, swap)

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        """What an observer inside says of the joints, each (p,); None without one. It is for plots."""
        law = self._law("estimate")
        return None if law is None else law(s, m)

    def sampled(self, period: float) -> Controller:
        """The same law for ticks every `period` [s].

        Raises InputError for a controller that has a state in continuous time and no discrete form.
        """
        if type(self).flow is not Controller.flow or self._law("flow") is not None:
            raise InputError(
                f"{type(self).__name__} has no discrete form: give it a method sampled(period), "
                "or use ContinuousTime()"
            )
        return self

    def continuous(self) -> Controller:
        """Itself, for continuous time. Raises InputError for a controller that was made for sampled time."""
        written = type(self).flow is not Controller.flow
        if not written and self._law("flow") is None and self._law("predict") is not None:
            raise InputError(
                f"{type(self).__name__} works in sampled time only; give timing=SampledTime(period)"
            )
        return self

    def error_system(self) -> ErrorSystem | None:
        """Linear error dynamics of an observer that is the whole state s; None otherwise."""
        return None


def controller_laws(controller: Controller) -> ControllerLaws:
    """The laws of a controller: its methods, of which the controller itself is the first argument.

    A class that still gives `laws` has those.
    """
    if not controller._obstacle:
        laws: ControllerLaws = controller._laws
        return laws
    kind = type(controller)
    methods = {name: getattr(kind, name) for name in Controller._methods}
    written = {n: f for n, f in methods.items() if f is not getattr(Controller, n)}
    return ControllerLaws(controller, kind.output)._replace(**written)


def check_state(controller: Controller, s: Array, m: Measurement, u: Array) -> None:
    """Raise InputError for a law of the state s (size,) that gives another number of numbers than s has.

    It is asked once, at the start: machine code would write past the end of the state.
    """
    calls = {"flow": (s, m, u), "correct": (s, m), "predict": (s, m, u)}
    for name, given in calls.items():
        law = controller._law(name)
        if law is not None:
            returned(law(*given), s.shape, controller, name, finite=False)
