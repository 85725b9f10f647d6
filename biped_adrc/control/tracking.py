"""What (20) and (28) share: the acceleration asked for, with or without the loop through Theta''.

    u = kappa^-1 (a - xi),   a = q_d'' + f,   f = -K_d (x2 - q_d') - K_p (x1 - q_d)

They differ in where x1, x2 and xi come from: an observer in (20), the measurement and the model in (28).

q_d'' = drift + H q'' contains q'' and so, through the model, the torque. With the unactuated rows
q_N'' = A_N q_b'' + a_N of (12) and q_b'' = a,

    (I - H_b - H_N A_N) a = drift + f + H_N a_N

is solved for a. As printed, (20) and (28) drop H q''.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.control.base import Measurement
from biped_adrc.core.checks import numbers
from biped_adrc.core.errors import InputError
from biped_adrc.core.linear import solve, solve_positive
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, frozen
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.model.reduction import BodyTerms, Reduction
from biped_adrc.observers.base import Estimate

HIGHEST = 1e15
"""Of a gain [1/s^2], [1/s]: beyond it products of gains and poles have no place among the floats."""


@dataclass(frozen=True)
class Gains(Shown):
    """K_p [1/s^2] and K_d [1/s] of Table II, one number for all joints or one per joint (p,).

    Raises InputError for numbers that are not positive.

    >>> gains = ba.Gains(K_p=2500.0, K_d=np.array([100.0, 100.0, 80.0, 80.0]))
    >>> ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint, gains)), gait, impacts=2).impacts
    2
    """

    K_p: Array | float = 5000.0
    K_d: Array | float = 50.0

    def __post_init__(self) -> None:
        for name in ("K_p", "K_d"):
            value = numbers(getattr(self, name), f"gain {name}")
            if value.ndim > 1 or not np.all((value > 0.0) & (value <= HIGHEST)):
                raise InputError(
                    f"gain {name} is {value}, expected positive numbers, one per joint, at most {HIGHEST:g}"
                )
            object.__setattr__(self, name, float(value) if value.ndim == 0 else frozen(value))

    def check(self, p: int) -> None:
        """Raise InputError for gains per joint of another number of joints than p."""
        for name in ("K_p", "K_d"):
            count = np.size(getattr(self, name))
            if count not in (1, p):
                raise InputError(
                    f"gain {name} has {count} numbers, expected 1 or {p}: one for each joint with a motor"
                )


TABLE_II = Gains(5000.0, 50.0)
"""Table II of the paper.

>>> ba.TABLE_II.K_p, ba.TABLE_II.K_d
(5000.0, 50.0)
"""


def tracking_torque(
    gains: Gains,
    r: ReferencePoint,
    x: Estimate,
    terms: Reduction,
    solve_theta: bool,
    a: Array | None = None,
) -> Array:
    """u (p,) [N m] of (20) or (28), whichever x is. Raises SingularError as `solved_acceleration`.

    solve_theta: whether the loop through Theta'' is solved. a (n, 2): the rate error is taken blind to changes
    of the rates along a; None: as it is.
    """
    x2 = x.velocity
    if a is not None:
        x2 = r.dq_d + orthogonal_to(rate_error_change(r, a)) @ (x2 - r.dq_d)
    f = feedback(gains, r, x.position, x2)
    ddq_b = solved_acceleration(r, terms, f) if solve_theta else printed_acceleration(r, f)
    return terms.kappa_inverse @ (ddq_b - x.disturbance)


def rate_error_change(r: ReferencePoint, a: Array) -> Array:
    """Change of q_b' - q_d' (p, 2) when the rates change by a (n, 2): a_b - H a, as q_d' moves with Theta'."""
    return a[: len(r.q_d)] - r.H @ a


def feedback(gains: Gains, r: ReferencePoint, x1: Array, x2: Array) -> Array:
    """-K_d (x2 - q_d') - K_p (x1 - q_d) (p,) [rad/s^2].

    >>> r = gait.constraint(0.0, gait.q_minus, gait.v_minus)
    >>> ba.feedback(ba.Gains(100.0, 10.0), r, r.q_d + 0.01, r.dq_d)
    array([-1., -1., -1., -1.])
    """
    return -gains.K_d * (x2 - r.dq_d) - gains.K_p * (x1 - r.q_d)


def solved_acceleration(r: ReferencePoint, terms: Reduction, f: Array) -> Array:
    """a (p,) [rad/s^2] of the module's equation. Raises SingularError when its matrix is exactly singular.

    That is where a pivot of it is 0.0; near that a grows without bound and without an error.

    >>> r = gait.constraint(0.0, gait.q_minus, gait.v_minus)
    >>> terms = biped.reduction(gait.q_minus, gait.v_minus)
    >>> ba.solved_acceleration(r, terms, np.zeros(4)).shape
    (4,)
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


def body_of(m: Measurement) -> BodyTerms:
    """m.body. Raises InputError for a measurement made for a controller without `needs_body`."""
    if m.body is None:
        raise InputError(
            "the measurement has no body terms; expected those of the nominal model. Give the controller "
            "needs_body = True, or the Measurement body=biped.body_terms(q, v)"
        )
    return m.body
