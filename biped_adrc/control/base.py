"""What a controller is: a torque from a measurement and a state of its own.

    u = output(s, m),   s' = flow(s, m, u)         in continuous time
    s <- correct(s, m), u = output(s, m), s <- predict(s, m, u)    at a tick

The state s is passed in and handed back. A controller without a state needs `output` alone and works in
both time bases. `u` handed to `flow` and `predict` is the torque applied, after saturation.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple

import numpy as np

from biped_adrc.errors import InputError, NotFiniteError
from biped_adrc.model.reduction import BodyTerms, Reduction
from biped_adrc.observers.base import ErrorSystem, Estimate
from biped_adrc.types import Array


class Measurement(NamedTuple):
    """What the controller is given; `terms` are the nominal model's, computed once."""

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

    @property
    def q_b(self) -> Array:
        """Actuated joints (p,) [rad]."""
        return self.q[: self.terms.kappa.shape[0]]

    @property
    def v_b(self) -> Array:
        """Their rates (p,) [rad/s]."""
        return self.v[: self.terms.kappa.shape[0]]


def measured(m: Measurement) -> Estimate:
    """What the measurement and the nominal model say of the p joints: q_b, q_b' and xi."""
    p = m.terms.kappa.shape[0]
    return Estimate(m.q[:p], m.v[:p], m.terms.xi)


class ControllerLaws(NamedTuple):
    """The pure functions behind a controller; None for what it has not, as a state or a discrete form."""

    parameters: Any
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
    estimate: Callable[..., Estimate] | None = None
    """estimate(k, s, m) -> what an observer inside says."""


class Controller(ABC):
    """Base of all controllers."""

    needs_body: ClassVar[bool] = False
    """Whether `Measurement.body` has to be there."""

    @abstractmethod
    def output(self, s: Array, m: Measurement) -> Array:
        """u (p,) [N m]."""

    def initial_state(self, m: Measurement) -> Array:
        """s at the start of a run; empty for a controller without state."""
        return np.zeros(0)

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        """s' in continuous time, under the applied torque u."""
        return np.zeros(0)

    def correct(self, s: Array, m: Measurement) -> Array:
        """Sampled: s with the measurement of this tick taken in."""
        return s

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        """Sampled: s at the next tick, under the applied torque u."""
        return s

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        """s after impact; `swap` (p,) relabels the joints, `after` is the state after it."""
        return s

    def sampled(self, period: float) -> Controller:
        """The same law for ticks every `period` [s].

        Raises InputError for a controller that has a state in continuous time and no discrete form.
        """
        if type(self).flow is not Controller.flow:
            raise InputError(
                f"{type(self).__name__} has no discrete form: give it a method sampled(period), "
                "or use ContinuousTime()"
            )
        return self

    @property
    def laws(self) -> ControllerLaws | None:
        """The pure functions that the methods amount to; None for a controller written as methods alone."""
        return None

    def error_system(self) -> ErrorSystem | None:
        """Linear error dynamics of an observer that is the whole state s; None otherwise."""
        return None

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        """What an observer inside says; None without one."""
        return None


def misshapen(controller: Controller, u: Array, p: int) -> str:
    """What is said of an output u that is not one torque for each of p motors."""
    return (
        f"{type(controller).__name__}.output returned an array of shape {u.shape}, expected ({p},): one torque "
        "[N m] per motor"
    )


def check_output(controller: Controller, u: Array, p: int) -> None:
    """Raise InputError for a first output that is not one torque per motor, NotFiniteError for NaN."""
    if u.shape != (p,):
        raise InputError(misshapen(controller, u, p))
    if not np.all(np.isfinite(u)):
        raise NotFiniteError(f"{type(controller).__name__}.output returned {u} at the start")
