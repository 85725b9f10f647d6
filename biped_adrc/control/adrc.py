"""Active disturbance rejection with an extended observer, eq. (20).

    u = kappa^-1 (q_d'' - K_d (x2^ - q_d') - K_p (x1^ - q_d) - xi^)

xi^ lumps model error and external torques into one signal per joint; the nominal model gives kappa alone
(and, through Theta'' in q_d'', the unactuated row).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Generic, NamedTuple, TypeVar

from biped_adrc.control.base import Controller, ControllerLaws, Measurement, measured
from biped_adrc.control.tracking import (
    TABLE_II,
    Gains,
    TrackingParameters,
    constraint_parameters,
    tracking_torque,
)
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import ConstraintParameters, VirtualConstraint, virtual_constraint
from biped_adrc.gait.reference import Reference
from biped_adrc.observers.base import ErrorSystem, Estimate, Feedback, Observer, ResetPolicy
from biped_adrc.observers.chain import Chain, chain_estimate, chain_reset, chain_state, rows
from biped_adrc.observers.gpi import GPIObserver, GPIParameters, gpi_flow
from biped_adrc.observers.gpi_sampled import (
    SampledGPIObserver,
    SampledGPIParameters,
    gpi_correct,
    gpi_predict,
)
from biped_adrc.observers.high_gain import HighGainObserver
from biped_adrc.types import Array

_K = TypeVar("_K", bound=Chain)


class ADRCParameters(NamedTuple, Generic[_K]):
    """h, the gains with the choice of loop, the observer's parameters, and `ResetPolicy.code`."""

    h: ConstraintParameters
    tracking: TrackingParameters
    observer: _K
    policy: int


def adrc_initial_state(k: ADRCParameters[Chain], m: Measurement) -> Array:
    """s = z ((m + 2) p,) of an observer that agrees with measurement and model."""
    return chain_state(k.observer, measured(m)).ravel()


def adrc_output(k: ADRCParameters[Chain], s: Array, m: Measurement) -> Array:
    """u (p,) [N m] on a virtual constraint."""
    r = virtual_constraint(k.h, m.q, m.v)
    return tracking_torque(k.tracking, r, chain_estimate(k.observer, rows(k.observer, s)), m.terms)


def adrc_flow(k: ADRCParameters[GPIParameters], s: Array, m: Measurement, u: Array) -> Array:
    """s' under the applied torque u (p,), with the observer (17)."""
    Z = rows(k.observer, s)
    return gpi_flow(k.observer, Z, measured(m).position, m.terms.kappa @ u).ravel()


def adrc_jump(k: ADRCParameters[Chain], s: Array, after: Measurement, swap: Array) -> Array:
    """s after impact."""
    Z = rows(k.observer, s)
    return chain_reset(k.observer, k.policy, Z, swap, measured(after)).ravel()


def adrc_correct(k: ADRCParameters[SampledGPIParameters], s: Array, m: Measurement) -> Array:
    """s at a tick, with the observer in discrete time."""
    return gpi_correct(k.observer, rows(k.observer, s), measured(m).position).ravel()


def adrc_predict(
    k: ADRCParameters[SampledGPIParameters], s: Array, m: Measurement, u: Array
) -> Array:
    """s one period later under the applied torque u (p,)."""
    return gpi_predict(k.observer, rows(k.observer, s), m.terms.kappa @ u).ravel()


def adrc_estimate(k: ADRCParameters[Chain], s: Array, m: Measurement) -> Estimate:
    """What the observer says."""
    return chain_estimate(k.observer, rows(k.observer, s))


_GPI = (GPIObserver, HighGainObserver, SampledGPIObserver)


def has_gpi_laws(observer: Observer) -> bool:
    """Whether the laws `gpi_...` are the observer's."""
    return type(observer) in _GPI


def gpi_parameters(observer: Observer) -> Any:
    """What the laws `gpi_...` need. Raises InputError for an observer that is no GPI observer."""
    if not has_gpi_laws(observer) or observer.laws is None:
        raise InputError(
            f"the laws of ADRC are written for a GPI observer, found {type(observer).__name__}; "
            "call the controller's methods instead"
        )
    return observer.laws.parameters


@dataclass(frozen=True)
class ADRCController(Controller):
    """(20) with an observer that is its whole state.

    solve_theta: solve the loop through Theta'' (default), or drop h' Theta'' as printed.
    reset: what happens to the observer at impact.
    """

    reference: Reference
    observer: Observer = field(default_factory=GPIObserver.from_poles)
    gains: Gains = TABLE_II
    solve_theta: bool = True
    reset: ResetPolicy = ResetPolicy.MODEL

    def output(self, s: Array, m: Measurement) -> Array:
        k, r = self.gains.parameters(self.solve_theta), self.reference(m.t, m.q, m.v)
        return tracking_torque(k, r, self.observer.estimate(s), m.terms)

    def initial_state(self, m: Measurement) -> Array:
        return self.observer.initial_state(m.q_b, m.v_b, m.terms.xi)

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.flow(s, m.q_b, m.terms.kappa @ u)

    def correct(self, s: Array, m: Measurement) -> Array:
        return self.observer.correct(s, m.q_b)

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.predict(s, m.terms.kappa @ u)

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        return self.observer.reset(s, self.reset, swap, after.q_b, after.v_b, after.terms.xi)

    @property
    def parameters(self) -> ADRCParameters[Any]:
        """What the laws `adrc_...` need. Raises InputError for a reference or an observer without a law."""
        h, gains = constraint_parameters(self.reference), self.gains.parameters(self.solve_theta)
        return ADRCParameters(h, gains, gpi_parameters(self.observer), self.reset.code)

    @property
    def laws(self) -> ControllerLaws | None:
        if type(self.reference) is not VirtualConstraint or not has_gpi_laws(self.observer):
            return None
        laws = ControllerLaws(
            self.parameters,
            adrc_output,
            adrc_initial_state,
            jump=adrc_jump,
            estimate=adrc_estimate,
        )
        if type(self.observer) is SampledGPIObserver:
            return laws._replace(correct=adrc_correct, predict=adrc_predict)
        return laws._replace(flow=adrc_flow)

    def sampled(self, period: float) -> ADRCController:
        return replace(self, observer=self.observer.sampled(period))

    def error_system(self) -> ErrorSystem | None:
        error = self.observer.error_system()
        if error is None:
            return None
        return error._replace(feedback=Feedback(self.gains.K_p, self.gains.K_d, self.reference))

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        return self.observer.estimate(s)
