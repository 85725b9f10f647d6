"""What an observer is: a state z, its flow or its discrete step, and the estimates read from it.

    z' = flow(z, y, input)                               in continuous time
    z <- correct(z, y),  z <- predict(z, input)          at a sample instant, and over the period after it

    input = kappa u (p,) [rad/s^2],  y = q_b (p,) [rad]

for the observers under ADRC; those under DOB see the momentum and the known force of all n coordinates.
States are vectors passed in and handed back; an observer holds only parameters. So one observer object may
serve many walks at once, and an integrator may evaluate a step twice.

`Observer` has the methods that controllers call, `ObserverLaws` the pure functions behind them, which the
engine turns into machine code. `control.observing` puts an observer under a controller, `observer_design`
chooses its poles and judges it alone.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np

from biped_adrc.composed import Composed
from biped_adrc.errors import InputError
from biped_adrc.parts import check_part, returned
from biped_adrc.shown import one_line
from biped_adrc.types import Array


class Estimate(NamedTuple):
    """What the observer says of the p joints, each (p,)."""

    position: Array
    """x1^ [rad]."""
    velocity: Array
    """x2^ [rad/s]."""
    disturbance: Array
    """xi^ = x3^ [rad/s^2]."""

    def __repr__(self) -> str:
        return one_line(self)


class ResetPolicy(Enum):
    """What happens to the observer at impact, where the legs swap and velocities jump.

    An observer that is left alone there takes the jump for a disturbance, and its estimate peaks.
    """

    NONE = "none"
    """Nothing."""
    RELABEL = "relabel"
    """The states of the legs swap."""
    MEASURED = "measured"
    """As relabel, with x1^ and x2^ from the measurement after impact."""
    MODEL = "model"
    """As at the start: x1^, x2^ measured, xi^ from the nominal model, higher derivatives zero."""

    @property
    def code(self) -> int:
        """The policy as a number, for laws: its place in this list, from 0."""
        return list(ResetPolicy).index(self)

    @classmethod
    def named(cls, name: str | ResetPolicy) -> ResetPolicy:
        """The policy by name. Raises InputError with the names there are."""
        try:
            return cls(name)
        except ValueError:
            names = [policy.value for policy in cls]
            raise InputError(f"reset policy '{name}' is unknown; choose one of {names}") from None


class Feedback(NamedTuple):
    """What a controller makes of the estimates: kappa u = q_d'' - K_d (x2^ - q_d') - K_p (x1^ - q_d) - xi^.

    The exponential method has to know it, since it integrates observer and controller as one linear system.
    """

    K_p: Array | float
    """[1/s^2], one number or (p,)."""
    K_d: Array | float
    """[1/s]."""
    reference: object
    """Where q_d comes from; an outer loop puts itself here."""


class ErrorSystem(NamedTuple):
    """Coordinates in which a linear observer's error obeys e' = A e + b (q_b'' - kappa u).

    With Z = z as (k, p): E = S (q_b, q_b') - Z, where S puts q_b in row 0 and q_b' * velocity_scale in
    row 1. The forcing enters row 1 times velocity_scale.
    """

    A: Array
    """(k, k) [1/s]."""
    velocity_scale: float
    """[s]."""
    feedback: Feedback | None = None
    """Of the controller around the observer; None for an observer alone."""


class HasOrder(Protocol):
    """Parameters of an observer's laws: by `order` the flat state is cut into rows."""

    @property
    def order(self) -> int:
        """States per joint."""


class ObserverLaws(NamedTuple):
    """The pure functions behind an observer, its state as rows Z (order, p); None for what it has not.

    x is an Estimate taken from the measurement and the model. An observer has `flow`, or `correct` and
    `predict`: that says in which time base it works.
    """

    parameters: Any
    """k, a NamedTuple of numbers and float64 arrays, one of them `order`."""
    state: Callable[..., Array]
    """state(k, x) -> Z that agrees with x."""
    estimate: Callable[..., Estimate]
    """estimate(k, Z) -> x."""
    reset: Callable[..., Array]
    """reset(k, policy, Z, swap, x) -> Z after impact; policy is `ResetPolicy.code`."""
    flow: Callable[..., Array] | None = None
    """flow(k, Z, y, input) -> Z'."""
    correct: Callable[..., Array] | None = None
    """correct(k, Z, y) -> Z at the tick."""
    predict: Callable[..., Array] | None = None
    """predict(k, Z, input) -> Z one period later."""
    obstacle: str = ""
    """Why these run in Python only; empty where they compile."""

    @property
    def functions(self) -> ObserverLaws:
        """The laws alone, without their parameters."""
        return self._replace(parameters=None, obstacle="")

    def __repr__(self) -> str:
        return one_line(self)


def rows(k: HasOrder, z: Array) -> Array:
    """Z (order, p), the flat state z by rows, for parameters k with `order`; no copy."""
    return z.reshape(k.order, -1)


class Observer(Composed):
    """Base of all observers, in continuous time unless made by `sampled`.

    Give `laws`, whose parameters have `order`, the states per joint; or write the methods.
    """

    _kind: ClassVar[str] = "observer"
    _methods: ClassVar[frozenset[str]] = frozenset(
        ("initial_state", "estimate", "reset", "flow", "correct", "predict")
    )

    @property
    def laws(self) -> ObserverLaws | None:
        """The pure functions that the methods call; None for an observer written as methods alone."""
        return None

    @property
    def order(self) -> int:
        """States per joint."""
        return int(self._given.parameters.order)

    def initial_state(self, y: Array, dy: Array, xi: Array) -> Array:
        """z that agrees with position y, velocity dy and disturbance xi, each (p,); z (order p,) is flat."""
        k = self._given
        return k.state(k.parameters, Estimate(y, dy, xi)).ravel()

    def estimate(self, z: Array) -> Estimate:
        """The estimates in z (order p,), each (p,) [rad], [rad/s], [rad/s^2]."""
        k = self._given
        return k.estimate(k.parameters, rows(k.parameters, z))

    def reset(
        self, z: Array, policy: ResetPolicy, swap: Array, y: Array, dy: Array, xi: Array
    ) -> Array:
        """z (order p,) after impact, from z before it.

        `swap` (p,) is the relabelling of joints; y, dy, xi, each (p,), are taken after it.
        """
        k, x = self._given, Estimate(y, dy, xi)
        return k.reset(k.parameters, policy.code, rows(k.parameters, z), swap, x).ravel()

    def flow(self, z: Array, y: Array, input: Array) -> Array:
        """z' (order p,) in continuous time, for the measurement y (p,) and the input (p,).

        Raises InputError for an observer that was made for sampled time.
        """
        return self._next("flow", "sampled time only; give a SampledTime", z, y, input)

    def correct(self, z: Array, y: Array) -> Array:
        """Sampled: z (order p,) at a sample instant with the measurement y (p,) taken in.

        Raises InputError for an observer in continuous time, as `predict` does.
        """
        return self._next("correct", "continuous time; call sampled(period)", z, y)

    def predict(self, z: Array, input: Array) -> Array:
        """Sampled: z (order p,) one period later under a constant input (p,)."""
        return self._next("predict", "continuous time; call sampled(period)", z, input)

    def sampled(self, period: float) -> Observer:
        """The discrete form for ticks every `period` [s]. Raises InputError where there is none."""
        raise InputError(f"{type(self).__name__} has no discrete form; use ContinuousTime()")

    def error_system(self) -> ErrorSystem | None:
        """The linear error dynamics, for the exponential method; None when there are none."""
        return None

    @property
    def _given(self) -> ObserverLaws:
        """The laws. Raises InputError where neither they nor all methods are written."""
        laws: ObserverLaws | None = self._laws
        if laws is None:
            raise InputError(
                f"{type(self).__name__} has no laws, and does not write all of the methods order, "
                "initial_state, estimate and reset; write what is missing"
            )
        return laws

    def _next(self, name: str, works_in: str, z: Array, *given: Array) -> Array:
        """z by the law of this name; without that law, the error that says where the observer works."""
        law = self._law(name)
        if law is None:
            raise InputError(f"{type(self).__name__} works in {works_in}")
        return law(rows(self._laws.parameters, z), *given).ravel()


class MethodParameters(NamedTuple):
    """Of an observer that is written as methods: its state is one row."""

    observer: Observer
    order: int = 1


POLICIES = list(ResetPolicy)


def observer_laws(observer: Observer) -> ObserverLaws:
    """The laws of an observer: its methods, with the flat state as one row."""
    if not observer._obstacle:
        laws: ObserverLaws = observer._laws
        return laws
    made = ObserverLaws(MethodParameters(observer), _start, _estimate, _reset)
    discrete = (
        type(observer).predict is not Observer.predict or observer._law("predict") is not None
    )
    if not discrete:
        return made._replace(flow=_flow)
    return made._replace(correct=_correct, predict=_predict)


def _start(k: MethodParameters, x: Estimate) -> Array:
    return k.observer.initial_state(*x)[np.newaxis]


def _estimate(k: MethodParameters, Z: Array) -> Estimate:
    found = k.observer.estimate(Z[0])
    check_part(found, f"what {type(k.observer).__name__}.estimate returned", Estimate)
    return found


def _reset(k: MethodParameters, policy: int, Z: Array, swap: Array, x: Estimate) -> Array:
    return _row(k.observer.reset(Z[0], POLICIES[policy], swap, *x), Z, k, "reset")


def _flow(k: MethodParameters, Z: Array, y: Array, input: Array) -> Array:
    return _row(k.observer.flow(Z[0], y, input), Z, k, "flow")


def _correct(k: MethodParameters, Z: Array, y: Array) -> Array:
    return _row(k.observer.correct(Z[0], y), Z, k, "correct")


def _predict(k: MethodParameters, Z: Array, input: Array) -> Array:
    return _row(k.observer.predict(Z[0], input), Z, k, "predict")


def _row(found: Array, Z: Array, k: MethodParameters, name: str) -> Array:
    """Z (1, size) that the method of this name gives."""
    return returned(found, Z[0].shape, k.observer, name, finite=False)[np.newaxis]
