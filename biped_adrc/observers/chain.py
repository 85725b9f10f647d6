"""A chain of integrators per joint in scaled states: what continuous and discrete GPI observers share.

x_k = z_k scale^(k-1), k = 1..m+2, with x1 position, x2 velocity, x3 disturbance and its derivatives. In x
itself the observer matrix of Table I has condition number 3e29; scaled it has 5e6.

Here are start, estimates and reset, which do not depend on how the gains were chosen; a leaf (`gpi`,
`high_gain`, `kalman`) adds its flow, or correct and predict. The checks of poles are shared with the momentum
observer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from biped_adrc.errors import InputError, check_positive
from biped_adrc.observers.base import Estimate, Observer, ObserverLaws, ResetPolicy
from biped_adrc.types import Array

NONE, RELABEL, MEASURED, MODEL = (policy.code for policy in ResetPolicy)


MOST_POLES = 20
"""States per joint: with more, round-off places the poles, and machine code of a step takes minutes to make."""
SLOWEST, FASTEST = 1e-6, 1e9
"""[rad/s]: beyond these bandwidths products of the gains have no place among the floats."""


class Chain(Protocol):
    """What the laws of the chain need; the parameters of every observer of this kind have it."""

    @property
    def order(self) -> int:
        """m + 2."""

    @property
    def scale(self) -> float:
        """[rad/s]."""


def chain_state(k: Chain, x: Estimate) -> Array:
    """Z (m + 2, p) that agrees with x, higher derivatives zero."""
    Z = np.zeros((k.order, len(x.position)))
    Z[0], Z[1] = x.position, x.velocity / k.scale
    if k.order > 2:
        Z[2] = x.disturbance / k.scale**2
    return Z


def chain_estimate(k: Chain, Z: Array) -> Estimate:
    """x1^, x2^ and xi^ in Z (m + 2, p); xi^ = 0 for m = 0."""
    xi = Z[2] * k.scale**2 if k.order > 2 else np.zeros(Z.shape[1])
    return Estimate(Z[0], Z[1] * k.scale, xi)


def chain_reset(k: Chain, policy: int, Z: Array, swap: Array, x: Estimate) -> Array:
    """Z (m + 2, p) after impact under the policy of this code.

    swap (p,) relabels the joints, x is taken after it. MEASURED keeps xi^ and its derivatives, relabelled.
    """
    if policy == NONE:
        return Z
    if policy == MODEL:
        return chain_state(k, x)
    swapped = Z[:, swap]
    if policy == MEASURED:
        swapped[0], swapped[1] = x.position, x.velocity / k.scale
    return swapped


def chain_laws(
    k: Chain,
    flow: Callable[..., Array] | None = None,
    correct: Callable[..., Array] | None = None,
    predict: Callable[..., Array] | None = None,
) -> ObserverLaws:
    """The laws of an observer whose state is a chain; its flow, or correct and predict, are its own.

    They take and give Z (m + 2, p), as `ObserverLaws` says.
    """
    return ObserverLaws(k, chain_state, chain_estimate, chain_reset, flow, correct, predict)


# -- what is asked of poles ----------------------------------------------------------------------
def stable_poles(poles: Sequence[complex], what: str, because: str) -> tuple[complex, ...]:
    """Two poles [rad/s] or more with negative real parts, complex ones in conjugate pairs.

    Without pairs the gains would not be real. `what` has them, `because` says why two. Raises InputError, with
    the pole that is wrong.
    """
    try:
        numbers = tuple(complex(pole) for pole in poles)
    except (TypeError, ValueError):
        raise InputError(
            f"the poles of {what} are {poles!r}, expected a sequence of numbers [rad/s] as (-300, -400)"
        ) from None
    check_chain(len(numbers), 1.0, what)
    if len(numbers) < 2:
        raise InputError(f"{what} needs at least 2 poles{because}, found {len(numbers)}")
    for pole in numbers:
        if not np.isfinite(pole) or pole.real >= 0:
            raise InputError(
                f"observer pole {_show(pole)} rad/s is not stable; every real part must be < 0"
            )
        if numbers.count(pole) != numbers.count(pole.conjugate()):
            raise InputError(f"observer pole {_show(pole)} rad/s has no conjugate beside it")
        check_chain(2, abs(pole), what)
    return numbers


def equal_poles(bandwidth: float, number: int) -> tuple[complex, ...]:
    """That many poles at -bandwidth [rad/s]. Raises InputError unless it is positive."""
    check_positive(bandwidth, f"observer bandwidth is {bandwidth} rad/s")
    return (complex(-bandwidth),) * number


def whole(number: int, least: int, name: str, what: str, most: int = MOST_POLES - 2) -> int:
    """The number as an int, as m of m + 2 poles. Raises InputError unless it is whole, `least` to `most`."""
    is_whole = isinstance(number, (int, np.integer)) and not isinstance(number, bool)
    if not (is_whole and least <= number <= most):
        above = f", at most {most}" if is_whole and number > least else ""
        raise InputError(
            f"{what} is {name} = {number!r}, expected a whole number {name} >= {least}{above}"
        )
    return int(number)


def _show(pole: complex) -> str:
    return f"{pole.real:g}" if pole.imag == 0 else f"{pole:g}"


def check_chain(order: int, scale: float, what: str) -> None:
    """Raise InputError for more than MOST_POLES states per joint, or a bandwidth out of reach [rad/s]."""
    if order > MOST_POLES:
        raise InputError(f"{what} has {order} poles, expected at most {MOST_POLES}")
    if not SLOWEST <= scale <= FASTEST:
        raise InputError(
            f"{what} has a bandwidth of {scale:g} rad/s, expected {SLOWEST:g} to {FASTEST:g} rad/s"
        )


class ChainParameters(NamedTuple):
    """order: m + 2, states per joint. scale: w [rad/s], by which states are scaled."""

    order: int
    scale: float


@dataclass(frozen=True)
class ChainObserver(Observer):
    """m extended states; z is (m + 2, p) flattened. Leaves add their own flow, as a law or a method.

    scale [rad/s] is near the bandwidth, so that the scaled states have numbers of one size.
    """

    m: int
    scale: float

    def __post_init__(self) -> None:
        check_chain(self.order, self.scale, type(self).__name__)

    @property
    def laws(self) -> ObserverLaws:
        return chain_laws(ChainParameters(self.order, self.scale))

    @property
    def order(self) -> int:
        return self.m + 2
