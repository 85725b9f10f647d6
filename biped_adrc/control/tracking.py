"""What (20) and (28) share: the acceleration asked for, with or without the loop through Theta''.

    a = q_d'' + f,   f = -K_d (x2 - q_d') - K_p (x1 - q_d)

q_d'' = drift + H q'' contains q'' and so, through the model, the torque. With the unactuated rows
q_N'' = A_N q_b'' + a_N of (12) and q_b'' = a,

    (I - H_b - H_N A_N) a = drift + f + H_N a_N

is solved for a. As printed, (20) and (28) drop H q''.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.linear import solve
from biped_adrc.model.reduction import Reduction
from biped_adrc.types import Array


@dataclass(frozen=True)
class Gains:
    """K_p [1/s^2] and K_d [1/s] of Table II, one number for all joints or one per joint."""

    K_p: Array | float = 5000.0
    K_d: Array | float = 50.0

    def __post_init__(self) -> None:
        for name in ("K_p", "K_d"):
            value = np.asarray(getattr(self, name), dtype=float)
            if value.ndim > 1 or not np.all(np.isfinite(value)) or np.any(value <= 0):
                raise InputError(
                    f"gain {name} is {value}, expected positive numbers, one per joint"
                )
            object.__setattr__(self, name, float(value) if value.ndim == 0 else value)


TABLE_II = Gains(5000.0, 50.0)
"""Table II of the paper."""


def feedback(gains: Gains, r: ReferencePoint, x1: Array, x2: Array) -> Array:
    """-K_d (x2 - q_d') - K_p (x1 - q_d) (p,) [rad/s^2]."""
    f: Array = -gains.K_d * (x2 - r.dq_d) - gains.K_p * (x1 - r.q_d)
    return f


def solved_acceleration(r: ReferencePoint, terms: Reduction, f: Array) -> Array:
    """a (p,) of the module's equation. Raises SingularError when its matrix is singular."""
    p = len(f)
    H_b, H_N = r.H[:, :p], r.H[:, p:]
    return solve(
        np.eye(p) - H_b - H_N @ terms.A_N,
        r.drift + f + H_N @ terms.a_N,
        "I - H_b - H_N A_N, by which the reference is tracked from this state,",
    )


def printed_acceleration(r: ReferencePoint, f: Array) -> Array:
    """a (p,) as (20) and (28) print it, with h' Theta'' dropped."""
    return r.drift + f
