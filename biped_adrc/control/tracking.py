"""What (20) and (28) share: the acceleration asked for, with or without the loop through Theta''.

    u = kappa^-1 (a - xi),   a = q_d'' + f,   f = -K_d (x2 - q_d') - K_p (x1 - q_d)

They differ in where x1, x2 and xi come from: an observer in (20), the measurement and the model in (28).

q_d'' = drift + H q'' contains q'' and so, through the model, the torque. With the unactuated rows
q_N'' = A_N q_b'' + a_N of (12) and q_b'' = a,

    (I - H_b - H_N A_N) a = drift + f + H_N a_N

is solved for a. As printed, (20) and (28) drop H q''.

`tracked_laws` puts any reference under the laws of a controller that needs its point alone; `control.observing`
does so for those with an observer.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple, TypeVar

import numpy as np

from biped_adrc.control.base import ControllerLaws, Measurement
from biped_adrc.errors import InputError
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.linear import solve, solve_positive
from biped_adrc.model.reduction import BodyTerms, Reduction
from biped_adrc.observers.base import Estimate
from biped_adrc.parts import numbers
from biped_adrc.shown import Shown
from biped_adrc.types import Array, frozen

_T = TypeVar("_T")


HIGHEST = 1e15
"""Of a gain [1/s^2], [1/s]: beyond it products of gains and poles have no place among the floats."""


class TrackingParameters(NamedTuple):
    """K_p [1/s^2] and K_d [1/s], (p,), or (1,) for one number; loop: 1 solves for Theta'', 0 drops it.

    P (p, p): what of the rate error K_d sees; (0, 0) for all of it.
    """

    K_p: Array
    K_d: Array
    loop: int
    P: Array = np.zeros((0, 0))


@dataclass(frozen=True)
class Gains(Shown):
    """K_p [1/s^2] and K_d [1/s] of Table II, one number for all joints or one per joint (p,).

    Raises InputError for numbers that are not positive.
    """

    K_p: Array | float = 5000.0
    K_d: Array | float = 50.0

    def __post_init__(self) -> None:
        for name in ("K_p", "K_d"):
            value = numbers(getattr(self, name), f"gain {name}")
            if value.ndim > 1 or not np.all(np.isfinite(value)) or np.any(value <= 0):
                raise InputError(
                    f"gain {name} is {value}, expected positive numbers, one per joint"
                )
            if np.any(value > HIGHEST):
                raise InputError(f"gain {name} is {value}, expected at most {HIGHEST:g}")
            object.__setattr__(self, name, float(value) if value.ndim == 0 else frozen(value))

    def check(self, p: int) -> None:
        """Raise InputError for gains per joint of another number of joints than p."""
        for name, row in zip(("K_p", "K_d"), self._rows, strict=True):
            if len(row) not in (1, p):
                raise InputError(
                    f"gain {name} has {len(row)} numbers, expected 1 or {p}: one for each joint with a motor"
                )

    @cached_property
    def _rows(self) -> tuple[Array, Array]:
        return np.atleast_1d(self.K_p).copy(), np.atleast_1d(self.K_d).copy()

    def parameters(self, solve_theta: bool) -> TrackingParameters:
        """What the law `tracking_torque` takes; solve_theta: whether the loop through Theta'' is solved."""
        return TrackingParameters(*self._rows, int(solve_theta))


TABLE_II = Gains(5000.0, 50.0)
"""Table II of the paper."""


def tracking_torque(
    k: TrackingParameters, r: ReferencePoint, x: Estimate, terms: Reduction
) -> Array:
    """u (p,) [N m] of (20) or (28), whichever x is. Raises SingularError as `solved_acceleration`."""
    x2 = x.velocity if len(k.P) == 0 else r.dq_d + k.P @ (x.velocity - r.dq_d)
    f = feedback(k, r, x.position, x2)
    a = solved_acceleration(r, terms, f) if k.loop > 0 else printed_acceleration(r, f)
    return terms.kappa_inverse @ (a - x.disturbance)


def feedback(k: TrackingParameters | Gains, r: ReferencePoint, x1: Array, x2: Array) -> Array:
    """-K_d (x2 - q_d') - K_p (x1 - q_d) (p,) [rad/s^2]."""
    return -k.K_d * (x2 - r.dq_d) - k.K_p * (x1 - r.q_d)


def solved_acceleration(r: ReferencePoint, terms: Reduction, f: Array) -> Array:
    """a (p,) [rad/s^2] of the module's equation. Raises SingularError when its matrix is exactly singular.

    That is where a pivot of it is 0.0; near that a grows without bound and without an error.
    """
    p = len(f)
    H_b, H_N = r.H[:, :p], r.H[:, p:]
    return solve(
        np.eye(p) - H_b - H_N @ terms.A_N,
        r.drift + f + H_N @ terms.a_N,
        "I - H_b - H_N A_N, by which the reference is tracked from this state,",
    )


def printed_acceleration(r: ReferencePoint, f: Array) -> Array:
    """a (p,) [rad/s^2] as (20) and (28) print it, with h' Theta'' dropped.

    It saves the solution of a linear system; the error it leaves is a disturbance for the loop.
    """
    return r.drift + f


def orthogonal_to(N: Array) -> Array:
    """P = 1 - N (N' N)^-1 N' (k, k): the part of a vector that is orthogonal to the columns of N (k, 2)."""
    return np.eye(len(N)) - N @ solve_positive(N.T @ N, N.T, "N' N of two impulses")


def blind_tracking(k: TrackingParameters, r: ReferencePoint, a: Array) -> TrackingParameters:
    """With a rate error that no rates a (n, 2) change: q_b' - q_d' changes by a_b - H a."""
    return k._replace(P=orthogonal_to(a[: len(r.q_d)] - r.H @ a))


class TrackedParameters(NamedTuple):
    """h: the reference. own: parameters of the controller's own laws."""

    h: Reference
    own: object


def tracked_laws(reference: Reference, own: ControllerLaws) -> ControllerLaws:
    """The laws of a controller that tracks any reference.

    own: its laws with the point r of the reference put before the state, such as output(k, r, s, m), and
    initial_state(k, r, m).
    """
    return _tracked(own.functions)._replace(parameters=TrackedParameters(reference, own.parameters))


@lru_cache(maxsize=64)
def _tracked(own: ControllerLaws) -> ControllerLaws:
    """The laws without parameters, cached so that the same functions have the same machine code."""

    def about_the_point(law: Callable[..., _T]) -> Callable[..., _T]:
        def tracked(k: TrackedParameters, s: Array, m: Measurement, *rest: object) -> _T:
            return law(k.own, k.h(m.t, m.q, m.v), s, m, *rest)

        return tracked

    def initial_state(k: TrackedParameters, m: Measurement) -> Array:
        assert own.initial_state is not None
        return own.initial_state(k.own, k.h(m.t, m.q, m.v), m)

    def blind(k: TrackedParameters, m: Measurement, a: Array) -> TrackedParameters:
        assert own.blind is not None
        return k._replace(own=own.blind(k.own, k.h(m.t, m.q, m.v), a))

    given = {name: law for name, law in own._asdict().items() if callable(law)}
    tracked: dict[str, Any] = {name: about_the_point(law) for name, law in given.items()}
    laws = own._replace(**tracked)
    laws = laws if own.blind is None else laws._replace(blind=blind)
    return laws if own.initial_state is None else laws._replace(initial_state=initial_state)


def body_of(m: Measurement) -> BodyTerms:
    """m.body. Raises InputError for a measurement made for a controller without `needs_body`."""
    if m.body is None:
        raise InputError(
            "the measurement has no body terms; expected those of the nominal model. Give the controller "
            "needs_body = True, or the Measurement body=biped.body_terms(q, v)"
        )
    return m.body
