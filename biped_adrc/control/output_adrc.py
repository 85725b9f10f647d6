"""ADRC in output form: the disturbance that is estimated is that of the output, not of the joints.

    y   = q_b - q_d
    y'' = L u + xi_y,   L = (I - H_b - H_N A_N) kappa
    u   = L^-1 (-K_p y^ - K_d y'^ - xi_y^)

With q_d'' = drift + H q'' and the split (12), (13) the nominal model says xi_y = M xi - drift - H_N a_N, with
M = I - H_b - H_N A_N. None of it is used between impacts: the reference's own acceleration, and what the
unactuated coordinate does to it through Theta'', are estimated together with model error and forces from
outside. In the joint form (20) q_d'' comes from the model, and what is wrong with the model's Theta'' is an
error of the reference that no observer of q_b'' can see. L is J D^-1 B for the Jacobian J of y.

Han, IEEE Trans. Industrial Electronics 56(3), 2009, for the total disturbance of an output; Westervelt,
Grizzle, Koditschek, IEEE TAC 48(1), 2003, for y.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from biped_adrc.control.adrc import ADRCParameters, gpi_parameters, has_gpi_laws
from biped_adrc.control.base import Controller, ControllerLaws, Measurement, measured
from biped_adrc.control.tracking import (
    TABLE_II,
    Gains,
    TrackingParameters,
    constraint_parameters,
)
from biped_adrc.gait.constraint import VirtualConstraint, virtual_constraint
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.linear import solve
from biped_adrc.model.reduction import Reduction
from biped_adrc.observers.base import Estimate, Observer, ResetPolicy
from biped_adrc.observers.chain import Chain, chain_estimate, chain_reset, chain_state, rows
from biped_adrc.observers.gpi import GPIObserver, GPIParameters, gpi_flow
from biped_adrc.observers.gpi_sampled import (
    SampledGPIObserver,
    SampledGPIParameters,
    gpi_correct,
    gpi_predict,
)
from biped_adrc.types import Array


def output_matrix(r: ReferencePoint, terms: Reduction) -> Array:
    """M (p, p), y'' = M q_b'' - ..."""
    p = len(r.q_d)
    return np.eye(p) - r.H[:, :p] - r.H[:, p:] @ terms.A_N


def output_measured(r: ReferencePoint, m: Measurement) -> Estimate:
    """y, y' and the nominal model's xi_y, each (p,)."""
    x = measured(m)
    p, terms = len(r.q_d), m.terms
    xi_y = output_matrix(r, terms) @ terms.xi - r.drift - r.H[:, p:] @ terms.a_N
    return Estimate(x.position - r.q_d, x.velocity - r.dq_d, xi_y)


def output_input(r: ReferencePoint, terms: Reduction, u: Array) -> Array:
    """L u (p,) [rad/s^2]."""
    product: Array = output_matrix(r, terms) @ (terms.kappa @ u)
    return product


def output_torque(k: TrackingParameters, r: ReferencePoint, x: Estimate, terms: Reduction) -> Array:
    """u (p,) [N m] for estimates x of the output. Raises SingularError where M is exactly singular.

    That is where a pivot of it is 0.0; near that u grows without bound and without an error.
    """
    w = -k.K_p * x.position - k.K_d * x.velocity - x.disturbance
    a = solve(output_matrix(r, terms), w, "L of y'' = L u + xi_y, the output's decoupling matrix,")
    return terms.kappa_inverse @ a


def joint_estimate(r: ReferencePoint, x: Estimate, terms: Reduction) -> Estimate:
    """Estimates x of the output in words of the joints, q_N'' taken from the nominal model."""
    p = len(r.q_d)
    xi = solve(
        output_matrix(r, terms),
        x.disturbance + r.drift + r.H[:, p:] @ terms.a_N,
        "the output's decoupling matrix",
    )
    return Estimate(x.position + r.q_d, x.velocity + r.dq_d, xi)


# -- on a virtual constraint ---------------------------------------------------------------------
def output_adrc_initial_state(k: ADRCParameters[Chain], m: Measurement) -> Array:
    """s = z ((m + 2) p,) of an observer that agrees with measurement and model."""
    r = virtual_constraint(k.h, m.q, m.v)
    return chain_state(k.observer, output_measured(r, m)).ravel()


def output_adrc_output(k: ADRCParameters[Chain], s: Array, m: Measurement) -> Array:
    """u (p,) [N m]."""
    r = virtual_constraint(k.h, m.q, m.v)
    return output_torque(k.tracking, r, chain_estimate(k.observer, rows(k.observer, s)), m.terms)


def output_adrc_flow(k: ADRCParameters[GPIParameters], s: Array, m: Measurement, u: Array) -> Array:
    """s' under the applied torque u (p,)."""
    r = virtual_constraint(k.h, m.q, m.v)
    y, Lu = output_measured(r, m).position, output_input(r, m.terms, u)
    return gpi_flow(k.observer, rows(k.observer, s), y, Lu).ravel()


def output_adrc_jump(k: ADRCParameters[Chain], s: Array, after: Measurement, swap: Array) -> Array:
    """s after impact."""
    x = output_measured(virtual_constraint(k.h, after.q, after.v), after)
    return chain_reset(k.observer, k.policy, rows(k.observer, s), swap, x).ravel()


def output_adrc_correct(k: ADRCParameters[SampledGPIParameters], s: Array, m: Measurement) -> Array:
    """s at a tick."""
    y = output_measured(virtual_constraint(k.h, m.q, m.v), m).position
    return gpi_correct(k.observer, rows(k.observer, s), y).ravel()


def output_adrc_predict(
    k: ADRCParameters[SampledGPIParameters], s: Array, m: Measurement, u: Array
) -> Array:
    """s one period later under the applied torque u (p,)."""
    Lu = output_input(virtual_constraint(k.h, m.q, m.v), m.terms, u)
    return gpi_predict(k.observer, rows(k.observer, s), Lu).ravel()


def output_adrc_estimate(k: ADRCParameters[Chain], s: Array, m: Measurement) -> Estimate:
    """What the observer says, of the joints."""
    x = chain_estimate(k.observer, rows(k.observer, s))
    return joint_estimate(virtual_constraint(k.h, m.q, m.v), x, m.terms)


@dataclass(frozen=True)
class OutputADRCController(Controller):
    """The module's equations with an observer of y that is the whole state.

    gains: K_p [1/s^2] and K_d [1/s] of y'' = -K_p y - K_d y', Table II by default as in the joint form.
    reset: of the observer at impact, where MODEL takes y, y' from the measurement and xi_y from the model.
    There is no form for the exponential method: in continuous time with Table I take RK4(5e-5).
    """

    reference: Reference
    observer: Observer = field(default_factory=GPIObserver.from_poles)
    gains: Gains = TABLE_II
    reset: ResetPolicy = ResetPolicy.MODEL

    def output(self, s: Array, m: Measurement) -> Array:
        k = self.gains.parameters(solve_theta=True)
        return output_torque(k, self._at(m), self.observer.estimate(s), m.terms)

    def initial_state(self, m: Measurement) -> Array:
        return self.observer.initial_state(*output_measured(self._at(m), m))

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        r = self._at(m)
        y, Lu = output_measured(r, m).position, output_input(r, m.terms, u)
        return self.observer.flow(s, y, Lu)

    def correct(self, s: Array, m: Measurement) -> Array:
        return self.observer.correct(s, output_measured(self._at(m), m).position)

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.predict(s, output_input(self._at(m), m.terms, u))

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        x = output_measured(self._at(after), after)
        return self.observer.reset(s, self.reset, swap, *x)

    def _at(self, m: Measurement) -> ReferencePoint:
        return self.reference(m.t, m.q, m.v)

    @property
    def parameters(self) -> ADRCParameters[Any]:
        """What the laws `output_adrc_...` need. Raises InputError for parts without a law."""
        h, gains = constraint_parameters(self.reference), self.gains.parameters(solve_theta=True)
        return ADRCParameters(h, gains, gpi_parameters(self.observer), self.reset.code)

    @property
    def laws(self) -> ControllerLaws | None:
        if type(self.reference) is not VirtualConstraint or not has_gpi_laws(self.observer):
            return None
        laws = ControllerLaws(
            self.parameters,
            output_adrc_output,
            output_adrc_initial_state,
            jump=output_adrc_jump,
            estimate=output_adrc_estimate,
        )
        if type(self.observer) is SampledGPIObserver:
            return laws._replace(correct=output_adrc_correct, predict=output_adrc_predict)
        return laws._replace(flow=output_adrc_flow)

    def sampled(self, period: float) -> OutputADRCController:
        return replace(self, observer=self.observer.sampled(period))

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        return joint_estimate(self._at(m), self.observer.estimate(s), m.terms)
