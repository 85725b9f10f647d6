"""Wrappers: controllers around any controller, which call the one inside (`inner`).

A *tick* is a sample instant. A subclass of `Around` writes the methods in which it differs from `inner`. No
wrapper asks of which class `inner` is, so a controller that compiles to machine code does so inside a wrapper
too. `friction_feedforward` and `delayed.Predicted` act all the time, as does an additional torque a, such as a
learner's, beside the torque u_i of the controller inside:

    u = u_i + a

The controller inside gets the sum that acts: its observer does not take a for a disturbance, and so does not
work against it. Around `Passive`, where u_i = 0, the torque is a itself. a (p,) [N m] is a parameter: machine
code reads it from its vector of parameters, Python from the array that the wrapper was made with, which its
owner may overwrite. So a `Stepper`, which runs a walk tick by tick, sets a new a before each tick, and compiles
nothing.

Across a touchdown a *policy*, a wrapper, acts for the time in which contact settles. Policy `Hold`:

    s <- initial_state(m)  at each tick with t_step < T,   s <- correct(s, m)  at the other ticks

s is the state of the controller inside, m the measurement, T [s] the length of the window after a touchdown.
t_step is the time since the last touchdown that the controller knows of; the start of a run counts as one. A
contact that takes time moves the joints by forces that no observer knows, and an observer takes them for a
disturbance. While the observer is held in its initial state, the torque is that of the model on measured rates:
ADRC then is NPD, which takes xi from the model. As every tick, the last of these ends with `predict` under its
torque, so after the window the observer runs as after the start of a run.

Policies act at ticks, so they work in sampled time alone. With T = 0 the walk is that of the controller inside,
bit for bit. Around an outer loop (a controller that corrects the reference of the one inside) policies would
restart that loop; put the outer loop around the policy.

`AcrossContact` is the base of all policies; `ContactWindow` of those with a T. `impact_invariant` is another
policy; more, as files that run, are in `examples/policies`. What an observer does at the instant of the
touchdown itself is its `ResetPolicy`.
"""

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.checks import NonNegativeFloat
from biped_adrc.core.part import derived
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.tree import chosen
from biped_adrc.core.types import Array, Indices, freeze
from biped_adrc.observers.base import Estimate


@dataclass(frozen=True)
class Around(Controller):
    """Base of the wrappers around `inner`: every method that a subclass does not write is
    that of the controller inside.
    """

    IS_BASE: ClassVar[bool] = True
    inner: Controller

    @property
    def needs_body(self) -> bool:  # type: ignore[override]
        """Whether the controller inside needs `Measurement.body`, the model's gravity and ground force."""
        return self.inner.needs_body

    @property
    def reads_impulse(self) -> tuple[str, ...]:  # type: ignore[override]
        """Names of the methods of the controller inside that read `Measurement.impulse`, the changes of the
        rates by an impulse on the striking foot.
        """
        return self.inner.reads_impulse

    def output(self, s: Any, m: Measurement) -> Array:
        return self.inner.output(s, m)

    def initial_state(self, m: Measurement) -> Any:
        return self.inner.initial_state(m)

    def flow(self, s: Any, m: Measurement, u: Array) -> Any:
        return self.inner.flow(s, m, u)

    def correct(self, s: Any, m: Measurement) -> Any:
        return self.inner.correct(s, m)

    def predict(self, s: Any, m: Measurement, u: Array) -> Any:
        return self.inner.predict(s, m, u)

    def jump(self, s: Any, after: Measurement, swap: Indices) -> Any:
        return self.inner.jump(s, after, swap)

    def estimate(self, s: Any, m: Measurement) -> Estimate | None:
        return self.inner.estimate(s, m)

    def sampled(self, period: float) -> Self:
        return replace(self, inner=self.inner.sampled(period))

    def continuous(self) -> Self:
        super().continuous()  # raises InputError for a wrapper that works in sampled time only
        return replace(self, inner=self.inner.continuous())


@dataclass(frozen=True)
class AddedTorque(Around):
    """A wrapper that adds a = `torque` (p,) [N m] to the torque of `inner`."""

    torque: Array

    def __post_init__(self) -> None:
        freeze(self, "torque")  # a read-only view: the owner may still overwrite the array

    def output(self, s: Any, m: Measurement) -> Array:
        return self.inner.output(s, m) + self.torque


@dataclass(frozen=True)
class AcrossContact(Around):
    """Base of the policies across a touchdown, which act in sampled time only."""

    def continuous(self) -> Self:
        self._only_sampled()  # raises InputError


@dataclass(frozen=True)
class ContactWindow(AcrossContact):
    """Base of the policies that act for T = `window` [s] after a touchdown. Raises InputError unless T >= 0."""

    window: NonNegativeFloat = 0.015

    @derived
    def until(self) -> float:
        """T [s] less the round-off of times, so that a tick at the very end of the window is outside."""
        return float(self.window - SAME_INSTANT)


@dataclass(frozen=True)
class Hold(ContactWindow):
    """A policy that restarts the observer of `inner` at each tick for `window` [s] after a touchdown."""

    def correct(self, s: Any, m: Measurement) -> Any:
        # both are computed: machine code has no branch here; t_step [s] is the time since the touchdown, until
        # is T less the round-off of times
        fresh, run = self.inner.initial_state(m), self.inner.correct(s, m)
        return chosen(m.t_step < self.until, fresh, run)
