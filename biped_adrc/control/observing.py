"""Tracking with an observer that is the controller's whole state: what ADRC, its output form and DOB share.

    u = torque(r, x^, m),   z' = flow(z, y, input)          in continuous time
    z <- correct(z, y),     z <- predict(z, input)          at a tick

r is the point of the reference, x^ what the observer says. A controller of this kind says what its observer
looks at, y and what it starts from, what its input is, and the torque; observer and reference may be any.

Four functions, a `Sight`, tell the three controllers apart: `adrc` looks at the joints, `output_adrc` at the
output y = q_b - q_d, `momentum_dob` at the momentum. All else, resets and time bases included, is here once.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple, Self

import numpy as np

from biped_adrc.control.base import Controller, ControllerLaws, Measurement
from biped_adrc.control.tracking import (
    Gains,
    TrackingParameters,
    blind_tracking,
    orthogonal_to,
)
from biped_adrc.gait.reference import Reference, ReferencePoint, reference_laws
from biped_adrc.observers.base import (
    Estimate,
    Observer,
    ObserverLaws,
    ResetPolicy,
    observer_laws,
)
from biped_adrc.types import Array


class ObservingParameters(NamedTuple):
    """The numbers of the parts: reference, gains with the choice of loop, observer, and its reset."""

    h: object
    tracking: TrackingParameters
    observer: Observer
    policy: ResetPolicy


class Sight(NamedTuple):
    """How a controller uses its observer: what the observer is given, and what is made of its estimates.

    r is the reference's point; for all but `torque` it is None where `of_reference` is False.
    """

    seen: Callable[[ReferencePoint, Measurement], Estimate]
    """seen(r, m) -> y and y', and the disturbance that the nominal model expects."""
    fed: Callable[[ReferencePoint, Measurement, Array], Array]
    """fed(r, m, u) -> the observer's input under the torque u (p,)."""
    torque: Callable[[TrackingParameters, ReferencePoint, Estimate, Measurement], Array]
    """torque(k, r, x, m) -> u (p,) [N m] for the estimates x."""
    told: Callable[[ReferencePoint, Estimate, Measurement], Estimate]
    """told(r, x, m) -> the estimates in words of the joints."""
    struck: Callable[[ReferencePoint, Measurement, Array], Array]
    """struck(r, m, a) -> what rates a (n, 2) change in the rate of y."""
    of_reference: bool
    """Whether the observer looks at the error of the reference."""


@lru_cache(maxsize=128)
def observing_laws(
    sight: Sight, point: Callable[..., ReferencePoint], o: ObserverLaws
) -> ControllerLaws:
    """The laws around the laws o of any observer and the law of any reference, all without parameters.

    Cached, so that controllers which differ in numbers alone share their machine code. The reference's point is
    asked for where it is used only, since each call of it evaluates the curve. Coordinates behind the p joints,
    such as the pitch of a momentum observer, keep their place at impact.
    """
    seen, fed, torque, told, _, of_reference = sight

    def at(k: ObservingParameters, m: Measurement) -> Any:
        return point(k.h, m.t, m.q, m.v) if of_reference else None

    def output(k: ObservingParameters, s: Array, m: Measurement) -> Array:
        x = o.estimate(k.observer, s)
        return torque(k.tracking, point(k.h, m.t, m.q, m.v), x, m)

    def initial_state(k: ObservingParameters, m: Measurement) -> Array:
        return np.ravel(o.state(k.observer, seen(at(k, m), m)))

    def jump(k: ObservingParameters, s: Array, after: Measurement, swap: Array) -> Array:
        x = seen(at(k, after), after)
        every = np.concatenate((swap, np.arange(len(swap), len(x.position))))
        return np.ravel(o.reset(k.observer, k.policy, s, every, x))

    def estimate(k: ObservingParameters, s: Array, m: Measurement) -> Estimate:
        return told(at(k, m), o.estimate(k.observer, s), m)

    def flow(k: ObservingParameters, s: Array, m: Measurement, u: Array) -> Array:
        r = at(k, m)
        assert o.flow is not None
        return np.ravel(o.flow(k.observer, s, seen(r, m).position, fed(r, m, u)))

    def correct(k: ObservingParameters, s: Array, m: Measurement) -> Array:
        assert o.correct is not None
        return np.ravel(o.correct(k.observer, s, seen(at(k, m), m).position))

    def predict(k: ObservingParameters, s: Array, m: Measurement, u: Array) -> Array:
        assert o.predict is not None
        return np.ravel(o.predict(k.observer, s, fed(at(k, m), m, u)))

    laws = ControllerLaws(None, output, initial_state, jump=jump, estimate=estimate)
    if o.flow is not None:
        laws = laws._replace(flow=flow)
    if o.correct is not None and o.predict is not None:
        laws = laws._replace(correct=correct, predict=predict)
    return with_projections(laws, sight, point, o)


def with_projections(
    laws: ControllerLaws, sight: Sight, point: Callable[..., ReferencePoint], o: ObserverLaws
) -> ControllerLaws:
    """The laws of `observing_laws` with those that `impact_invariant` asks for."""
    seen, struck, of_reference = sight.seen, sight.struck, sight.of_reference

    def at(k: ObservingParameters, m: Measurement) -> Any:
        return point(k.h, m.t, m.q, m.v) if of_reference else None

    def blind(k: ObservingParameters, m: Measurement, a: Array) -> ObservingParameters:
        r = point(k.h, m.t, m.q, m.v)
        return k._replace(tracking=blind_tracking(k.tracking, r, a))

    def correct_blind(k: ObservingParameters, s: Array, m: Measurement, a: Array) -> Array:
        assert o.correct is not None
        r = at(k, m)
        told, y = o.estimate(k.observer, s).position, seen(r, m).position
        P = orthogonal_to(struck(r, m, a))
        return np.ravel(o.correct(k.observer, s, told + P @ (y - told)))

    laws = laws._replace(blind=blind)
    if o.correct is not None and o.predict is not None:
        laws = laws._replace(correct_blind=correct_blind)
    return laws


class ObservingController(Controller):
    """Base of the controllers whose state is an observer's; `sight` says what they make of it.

    reference: what is tracked. gains: K_p [1/s^2], K_d [1/s] on the estimates. reset: the observer's,
    at impact.
    """

    reference: Reference
    observer: Observer
    gains: Gains
    reset: ResetPolicy

    solve_theta: bool = True
    """Whether the loop through Theta'' is solved."""

    @property
    @abstractmethod
    def sight(self) -> Sight:
        """What is seen, fed, and made of the estimates."""

    @property
    def laws(self) -> ControllerLaws:
        r, o = reference_laws(self.reference), observer_laws(self.observer)
        k = ObservingParameters(
            r.parameters, self.gains.parameters(self.solve_theta), self.observer, self.reset
        )
        laws = observing_laws(self.sight, r.point, o)
        return laws._replace(parameters=k, obstacle=r.obstacle)

    def sampled(self, period: float) -> Self:
        sampled: Self = replace(self, observer=self.observer.sampled(period))  # type: ignore[type-var]
        return sampled
