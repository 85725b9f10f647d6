"""What an observer is: a state z, its flow or its discrete step, and the estimates read from it.

    z' = flow(z, y, input)                               in continuous time
    z <- correct(z, y),  z <- predict(z, input)          at a sample instant, and over the period after it

    input = kappa u (p,) [rad/s^2],  y = q_b (p,) [rad]

for the observers under ADRC; those under DOB see the momentum and the known force of all n coordinates.
States are flat vectors passed in and handed back; an observer holds only numbers. So one observer object may
serve many walks at once, and an integrator may evaluate a step twice. The engine turns the methods into machine
code. `control.observing` puts an observer under a controller, `analysis.observer` chooses its poles and
judges it alone.
"""

from __future__ import annotations

from abc import abstractmethod
from enum import Enum
from typing import NamedTuple

from biped_adrc.core.errors import InputError
from biped_adrc.core.part import Part
from biped_adrc.core.shown import one_line
from biped_adrc.core.types import Array, Indices


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

    >>> ba.ADRCController(gait.constraint, reset=ba.ResetPolicy.MEASURED).reset.value
    'measured'
    """

    NONE = "none"
    """Nothing."""
    RELABEL = "relabel"
    """The states of the legs swap."""
    MEASURED = "measured"
    """As relabel, with x1^ and x2^ from the measurement after impact."""
    MODEL = "model"
    """As at the start: x1^, x2^ measured, xi^ from the nominal model, higher derivatives zero."""

    @classmethod
    def named(cls, name: str | ResetPolicy) -> ResetPolicy:
        """The policy by name. Raises InputError with the names there are."""
        try:
            return cls(name)
        except ValueError:
            names = [policy.value for policy in cls]
            raise InputError(f"reset policy '{name}' is unknown; choose one of {names}") from None


class ErrorSystem(NamedTuple):
    """Coordinates in which a linear observer's error obeys e' = A e + b (q_b'' - kappa u).

    With Z = z as (k, p): E = S (q_b, q_b') - Z, where S puts q_b in row 0 and q_b' * velocity_scale in
    row 1. The forcing enters row 1 times velocity_scale.
    """

    A: Array
    """(k, k) [1/s]."""
    velocity_scale: float
    """[s]."""


class Observer(Part):
    """Base of all observers: a frozen dataclass with `flow`, or with `correct` and `predict`.

    Which of them it has says in which time base it works.

    >>> observer = ba.GPIObserver.from_poles()
    >>> z = observer.initial_state(np.zeros(4), np.ones(4), np.zeros(4))
    >>> observer.estimate(z).velocity
    array([1., 1., 1., 1.])
    """

    @abstractmethod
    def initial_state(self, y: Array, dy: Array, xi: Array) -> Array:
        """z (size,) that agrees with position y, velocity dy and disturbance xi, each (p,)."""

    @abstractmethod
    def estimate(self, z: Array) -> Estimate:
        """The estimates in z (size,), each (p,) [rad], [rad/s], [rad/s^2]."""

    @abstractmethod
    def reset(
        self, z: Array, policy: ResetPolicy, swap: Indices, y: Array, dy: Array, xi: Array
    ) -> Array:
        """z (size,) after impact, from z before it.

        `swap` (p,) is the relabelling of joints; y, dy, xi, each (p,), are taken after it.
        """

    def flow(self, z: Array, y: Array, input: Array) -> Array:
        """z' (size,) in continuous time, for the measurement y (p,) and the input (p,).

        Raises InputError for an observer that was made for sampled time.
        """
        raise InputError(f"{type(self).__name__} works in sampled time only; give a SampledTime")

    def correct(self, z: Array, y: Array) -> Array:
        """Sampled: z (size,) at a sample instant with the measurement y (p,) taken in.

        Raises InputError for an observer in continuous time, as `predict` does.
        """
        raise self._continuous()

    def predict(self, z: Array, input: Array) -> Array:
        """Sampled: z (size,) one period later under a constant input (p,)."""
        raise self._continuous()

    def sampled(self, period: float) -> Observer:
        """The discrete form for ticks every `period` [s]. Raises InputError where there is none."""
        raise InputError(f"{type(self).__name__} has no discrete form; use ContinuousTime()")

    def error_system(self) -> ErrorSystem | None:
        """The linear error dynamics, for the exponential method; None when there are none."""
        return None

    def _continuous(self) -> InputError:
        """The error for what is asked of an observer in sampled time alone."""
        return InputError(f"{type(self).__name__} works in continuous time; call sampled(period)")
