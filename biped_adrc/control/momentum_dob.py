"""Feedback linearisation with a momentum-based disturbance observer.

    D q'' + Omega = B u + zeta,   r -> zeta              observers/momentum.py
    u = kappa^-1 (a_d - xi) - r_b - A_N' r_N             NPD (28), less both parts of r through (12)
    q_N'' = A_N q_b'' + a_N + D22^-1 r_N                 in the loop through Theta''

r_b is matched, a motor each; r_N acts on the unactuated coordinate: its effect on the q_b is cancelled, that on
q_N itself cannot be. For r = zeta the error obeys q_b'' - q_d'' = -K_d (q_b' - q_d') - K_p (q_b - q_d)
exactly, under any force that stays. Unlike in ADRC the model compensates its own Omega, and the observer sees
what is left.

De Luca, Albu-Schaeffer, Haddadin, Hirzinger, IROS 2006; Chen, Ballance, Gawthrop, O'Reilly, IEEE Trans.
Industrial Electronics 47(4), 2000; Sariyildiz, Oboe, Ohnishi, IEEE Trans. Industrial Electronics 67(3), 2020.

At impact the momentum jumps, about another foot; r is relabelled and kept, see `momentum_reset`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar

import numpy as np

from biped_adrc.control.base import Controller, ControllerLaws, Measurement, measured
from biped_adrc.control.body import body_of
from biped_adrc.control.tracking import (
    TABLE_II,
    Gains,
    TrackingParameters,
    constraint_parameters,
    tracking_torque,
)
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import ConstraintParameters, VirtualConstraint, virtual_constraint
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.linear import solve_positive
from biped_adrc.model.reduction import Reduction
from biped_adrc.observers.base import Estimate, ResetPolicy
from biped_adrc.observers.chain import Chain, rows
from biped_adrc.observers.gpi_sampled import SampledGPIParameters, gpi_correct, gpi_predict
from biped_adrc.observers.momentum import (
    MomentumChain,
    MomentumObserver,
    MomentumParameters,
    SampledMomentumObserver,
    momentum_estimate,
    momentum_flow,
    momentum_reset,
    momentum_state,
)
from biped_adrc.types import Array

_K = TypeVar("_K", bound=Chain)


class MomentumDOBParameters(NamedTuple, Generic[_K]):
    """h, the gains with the choice of loop, the observer's parameters, and `ResetPolicy.code`."""

    h: ConstraintParameters
    tracking: TrackingParameters
    observer: _K
    policy: int


def momentum_of(m: Measurement) -> Estimate:
    """pi = D q' (n,) [kg m^2/s] of the nominal model, and no force from outside."""
    none = np.zeros(len(m.q))
    return Estimate(m.terms.D @ m.v, none, none)


def known_force(m: Measurement, u: Array) -> Array:
    """beta = C' q' - G + B u (n,) [N m] for the applied torque u (p,)."""
    body, p = body_of(m), m.terms.kappa.shape[0]
    beta = body.turning - body.G
    beta[:p] += u
    return beta


def pushed(terms: Reduction, r: Array) -> Reduction:
    """The split of D q'' + Omega = B u + r: with the force r (n,) [N m] in xi and a_N."""
    p = terms.kappa.shape[0]
    xi = terms.xi + terms.kappa @ (r[:p] + terms.A_N.T @ r[p:])
    a_N = terms.a_N + solve_positive(terms.D[p:, p:], r[p:], "D22")
    return Reduction(terms.D, terms.Omega - r, terms.kappa, xi, terms.kappa_inverse, terms.A_N, a_N)


def dob_torque(k: TrackingParameters, r: ReferencePoint, m: Measurement, force: Array) -> Array:
    """u (p,) [N m] for an estimated force (n,). Raises SingularError as `tracking_torque`."""
    terms, x = pushed(m.terms, force), measured(m)
    return tracking_torque(k, r, Estimate(x.position, x.velocity, terms.xi), terms)


def joint_estimate(m: Measurement, force: Array) -> Estimate:
    """The measurement, and the total disturbance (14) that the model and a force (n,) make."""
    x = measured(m)
    return Estimate(x.position, x.velocity, pushed(m.terms, force).xi)


def coordinates(swap: Array, n: int) -> Array:
    """The relabelling of the actuated joints (p,) as one of all n coordinates, q_N staying."""
    return np.concatenate((swap, np.arange(len(swap), n)))


# -- on a virtual constraint ---------------------------------------------------------------------
def dob_initial_state(k: MomentumDOBParameters[Chain], m: Measurement) -> Array:
    """s = z (k n,) of an observer that agrees with the measurement, r = 0."""
    return momentum_state(k.observer, momentum_of(m)).ravel()


def dob_output(k: MomentumDOBParameters[Chain], s: Array, m: Measurement) -> Array:
    """u (p,) [N m]."""
    force = momentum_estimate(k.observer, rows(k.observer, s)).disturbance
    return dob_torque(k.tracking, virtual_constraint(k.h, m.q, m.v), m, force)


def dob_flow(
    k: MomentumDOBParameters[MomentumParameters], s: Array, m: Measurement, u: Array
) -> Array:
    """s' under the applied torque u (p,)."""
    y, beta = momentum_of(m).position, known_force(m, u)
    return momentum_flow(k.observer, rows(k.observer, s), y, beta).ravel()


def dob_jump(k: MomentumDOBParameters[Chain], s: Array, after: Measurement, swap: Array) -> Array:
    """s after impact."""
    swap_n = coordinates(swap, len(after.q))
    Z = rows(k.observer, s)
    return momentum_reset(k.observer, k.policy, Z, swap_n, momentum_of(after)).ravel()


def dob_correct(k: MomentumDOBParameters[SampledGPIParameters], s: Array, m: Measurement) -> Array:
    """s at a tick."""
    return gpi_correct(k.observer, rows(k.observer, s), momentum_of(m).position).ravel()


def dob_predict(
    k: MomentumDOBParameters[SampledGPIParameters], s: Array, m: Measurement, u: Array
) -> Array:
    """s one period later under the applied torque u (p,)."""
    return gpi_predict(k.observer, rows(k.observer, s), known_force(m, u)).ravel()


def dob_estimate(k: MomentumDOBParameters[Chain], s: Array, m: Measurement) -> Estimate:
    """What the observer says, of the joints."""
    return joint_estimate(m, momentum_estimate(k.observer, rows(k.observer, s)).disturbance)


_OBSERVERS = (MomentumObserver, SampledMomentumObserver)


@dataclass(frozen=True)
class MomentumDOBController(Controller):
    """The module's equations with a momentum observer that is the whole state.

    solve_theta: solve the loop through Theta'' (default), or drop h' Theta'' as (28) is printed.
    reset: what happens to the observer at impact.
    """

    needs_body: ClassVar[bool] = True

    reference: Reference
    observer: MomentumChain = field(default_factory=lambda: MomentumObserver.from_bandwidth(200.0))
    gains: Gains = TABLE_II
    solve_theta: bool = True
    reset: ResetPolicy = ResetPolicy.MODEL

    def output(self, s: Array, m: Measurement) -> Array:
        k, r = self.gains.parameters(self.solve_theta), self.reference(m.t, m.q, m.v)
        return dob_torque(k, r, m, self.observer.estimate(s).disturbance)

    def initial_state(self, m: Measurement) -> Array:
        return self.observer.initial_state(*momentum_of(m))

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.flow(s, momentum_of(m).position, known_force(m, u))

    def correct(self, s: Array, m: Measurement) -> Array:
        return self.observer.correct(s, momentum_of(m).position)

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.observer.predict(s, known_force(m, u))

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        swap_n = coordinates(swap, len(after.q))
        return self.observer.reset(s, self.reset, swap_n, *momentum_of(after))

    @property
    def parameters(self) -> MomentumDOBParameters[Any]:
        """What the laws `dob_...` need. Raises InputError for a reference or an observer without a law."""
        h, gains = constraint_parameters(self.reference), self.gains.parameters(self.solve_theta)
        if type(self.observer) not in _OBSERVERS:
            raise InputError(
                f"the laws are written for a MomentumObserver, found {type(self.observer).__name__}; call "
                "the controller's methods instead"
            )
        return MomentumDOBParameters(h, gains, self.observer.parameters, self.reset.code)

    @property
    def laws(self) -> ControllerLaws | None:
        kind = type(self.observer)
        if type(self.reference) is not VirtualConstraint or kind not in _OBSERVERS:
            return None
        laws = ControllerLaws(
            self.parameters, dob_output, dob_initial_state, jump=dob_jump, estimate=dob_estimate
        )
        if kind is SampledMomentumObserver:
            return laws._replace(correct=dob_correct, predict=dob_predict)
        return laws._replace(flow=dob_flow)

    def sampled(self, period: float) -> MomentumDOBController:
        sampled = self.observer.sampled(period)
        assert isinstance(sampled, MomentumChain)
        return replace(self, observer=sampled)

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        return joint_estimate(m, self.observer.estimate(s).disturbance)
