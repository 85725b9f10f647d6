"""An observer: a state z, its flow or its discrete step, and the estimates read from it.

    z' = flow(z, y, input)                               in continuous time
    z <- correct(z, y),  z <- predict(z, input)          at a sample instant, and over the period after it

    input = kappa u (p,) [rad/s^2],  y = q_b (p,) [rad]

for the observers under ADRC: q_b are the angles of the p joints with motors, kappa u is the acceleration that
the torques u give them by the nominal model, xi = q_b'' - kappa u is the total disturbance, and ^ marks an
estimate. The disturbance observer (DOB) of `momentum` has the momentum of all n coordinates as y and the known
force on them as input. States are passed in and handed back; an observer holds only constants. So one observer
object may serve many walks at once, and an integrator may evaluate a step twice. The engine, a compiler, turns
the methods into machine code. `control.tracking` puts an observer under a controller, `analysis.observer`
chooses its poles and judges it alone.

All observers of the package share a chain of integrators per coordinate in scaled states,

    x_k = z_k scale^(k-1), k = 1..m+2,

with x1 position, x2 velocity, x3 disturbance and its derivatives, m extended states in all from x3 on. In x
itself the observer matrix with the poles of the paper's Table I has condition number 3e29; scaled it has 5e6.
`lead` integrators lie between disturbance and measurement: lead = 2 from an acceleration to an angle, lead = 1
from a force to a momentum, where there is no x2 and the disturbance follows x1. `ChainObserver` has start,
estimates and reset, which do not depend on how the gains were chosen; `gpi`, `high_gain`, `kalman` and
`momentum` add their flow.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, ClassVar, NamedTuple, NoReturn

import numpy as np

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError, check_count, check_positive, check_whole
from biped_adrc.core.part import Part, once, rewrites
from biped_adrc.core.shown import shown
from biped_adrc.core.types import Array, Indices, relabelled


@shown
class Estimate(NamedTuple):
    """Estimates of position, velocity and disturbance of the p joints, each (p,)."""

    position: Array
    """x1^ [rad]."""
    velocity: Array
    """x2^ [rad/s]."""
    disturbance: Array
    """xi^ = x3^ [rad/s^2]."""


class ResetPolicy(Enum):
    """What happens to the observer's state at impact, where the legs swap and velocities jump.

    An observer that is left alone there takes the jump for a disturbance, and its estimate peaks.

    >>> ba.ADRCController(gait.constraint, reset=ba.ResetPolicy.MEASURED).reset.value
    'measured'
    """

    NONE = "none"
    """The state stays as it is."""
    RELABEL = "relabel"
    """The states of the legs swap."""
    MEASURED = "measured"
    """As relabel, with x1^ and x2^ from the measurement after impact."""
    MODEL = "model"
    """As at the start: x1^, x2^ measured, xi^ from the nominal model, higher derivatives zero."""


class ErrorSystem(NamedTuple):
    """Linear error dynamics of an observer: E' = A E + b (q_b'' - kappa u), with one column of E per joint.

    For a state z (k, p) the error is E = S (q_b, q_b') - z (k, p): S puts q_b in row 0, q_b' * velocity_scale
    in row 1 and zeros below. b is velocity_scale in row 1 and 0 elsewhere.
    """

    A: Array
    """Matrix (k, k) [1/s]."""
    velocity_scale: float
    """Factor by which row 1 has the velocity multiplied [s]."""


class Observer(Part):
    """Base of all observers: a frozen dataclass with `flow` for continuous time, or
    with `correct` and `predict`.

    >>> observer = ba.GPIObserver.from_poles()
    >>> z = observer.initial_state(np.zeros(4), np.ones(4), np.zeros(4))
    >>> observer.estimate(z).velocity
    array([1., 1., 1., 1.])
    """

    # an example for messages of errors
    SUCH_AS = "GPIObserver.from_bandwidth(500.0)"

    MAKERS: ClassVar[tuple[str, ...]] = ()
    """Class methods by which a scenario may make it, beside the constructor."""

    @abstractmethod
    def initial_state(self, y: Array, dy: Array, xi: Array) -> Any:
        """State z whose estimates are y [rad], dy [rad/s] and the disturbance xi [rad/s^2], each (p,)."""

    @abstractmethod
    def estimate(self, z: Any) -> Estimate:
        """Estimates in the state z, each (p,) [rad], [rad/s], [rad/s^2]."""

    @abstractmethod
    def reset(
        self, z: Any, policy: ResetPolicy, swap: Indices, y: Array, dy: Array, xi: Array
    ) -> Any:
        """State z after impact, from z before it.

        swap (p,): the relabelling; joint i after impact takes entry swap[i] of (x, -x), x (p,) before it. y,
        dy, each (p,): measured position and velocity after it; xi (p,): the nominal model's disturbance there.
        """

    def flow(self, z: Any, y: Array, input: Array) -> Any:
        """z' in continuous time, for the measurement y (p,) and the input (p,).

        This base raises InputError: an observer in sampled time does not write the method.
        """
        self._only("works in sampled time only; give a SampledTime")

    def correct(self, z: Any, y: Array) -> Any:
        """In sampled time: z corrected by the measurement y (p,) of the sample instant.

        This base raises InputError: an observer in continuous time does not write the method.
        """
        self._only("works in continuous time; call sampled(period)")

    def predict(self, z: Any, input: Array) -> Any:
        """In sampled time: z one period later under a constant input (p,).

        This base raises InputError: an observer in continuous time does not write the method.
        """
        self._only("works in continuous time; call sampled(period)")

    def sampled(self, period: float) -> Observer:
        """The discrete form for ticks every `period` [s]. This base raises InputError: it has none."""
        self._only("has no discrete form; write sampled(period) for it, or use ContinuousTime()")

    # `once` keeps the result for each observer and period
    @once
    def at_ticks(self, period: float) -> Observer:
        """The result of `sampled`, checked. Raises InputError for one without `correct` and `predict`, and for
        an observer whose class writes another `flow` than that of which `sampled` is the discrete form.
        """
        if rewrites(self, "sampled", "flow"):
            self._only("writes another flow; write sampled(period) for it, or use ContinuousTime()")
        # `sampled` may be a user's; a method that is still the one of this base was not written, and `_only`
        # raises InputError
        found = self.sampled(period)
        check_part(found, f"what {type(self).__name__}.sampled returned", Observer)
        for name in ("correct", "predict"):
            if getattr(type(found), name) is getattr(Observer, name):
                found._only(f"has no method {name}; write it, or use ContinuousTime()")
        return found

    def error_system(self) -> ErrorSystem | None:
        """Linear error dynamics, which the exponential integration method solves exactly; None without any."""
        return None

    def _only(self, sentence: str) -> NoReturn:
        """Raise InputError, the name of the class and then `sentence`, for a method that it does not have."""
        raise InputError(f"{type(self).__name__} {sentence}")


MOST_POLES = 20
"""Most states per joint: with more, round-off places the poles, and compiling a step takes minutes."""
SLOWEST, FASTEST = 1e-6, 1e9
"""Range of bandwidths [rad/s], beyond which products of the gains overflow or vanish."""


# -- what is asked of poles ----------------------------------------------------------------------
def stable_poles(poles: Sequence[complex], what: str) -> tuple[complex, ...]:
    """Check poles [rad/s]: two or more with negative real parts, complex ones in
    conjugate pairs. Returns them.

    Without pairs the gains would not be real. what: the observer, for the message. Raises InputError with the
    wrong pole, also for more poles, or larger or smaller magnitudes, than `check_chain` allows.
    """
    try:
        numbers = tuple(complex(pole) for pole in poles)
    except (TypeError, ValueError):
        raise InputError(
            f"the poles of {what} are {poles!r}, expected a sequence of numbers [rad/s] as (-300, -400)"
        ) from None
    if len(numbers) < 2:
        raise InputError(f"{what} needs at least 2 poles, found {len(numbers)}")
    for pole in numbers:
        paired = numbers.count(pole) == numbers.count(pole.conjugate())
        if not (np.isfinite(pole) and pole.real < 0.0 and paired):
            shown = pole.real if pole.imag == 0 else pole
            raise InputError(
                f"observer pole {shown:g} rad/s is not stable, or has no conjugate beside it; every real "
                "part must be < 0"
            )
        check_chain(len(numbers), abs(pole), what)
    return numbers


def equal_poles(bandwidth: float, number: int) -> tuple[complex, ...]:
    """`number` poles at -bandwidth [rad/s]. Raises InputError for values not positive or too large."""
    check_positive(bandwidth, f"observer bandwidth is {bandwidth} rad/s")
    check_count(number, f"an observer has {number!r} poles")
    check_chain(number, bandwidth, "an observer")
    return (complex(-bandwidth),) * number


def check_chain(order: int, scale: float, what: str) -> None:
    """Raise InputError for an `order`, states per joint, above MOST_POLES, or a `scale` [rad/s] outside of
    SLOWEST to FASTEST.

    scale: bandwidth, or magnitude of one pole. what: the observer, for the message.
    """
    if order > MOST_POLES or not SLOWEST <= scale <= FASTEST:
        raise InputError(
            f"{what} has {order} poles and a bandwidth of {scale:g} rad/s, expected at most {MOST_POLES}, and "
            f"{SLOWEST:g} to {FASTEST:g} rad/s"
        )


@dataclass(frozen=True)
class ChainObserver(Observer):
    """Base of observers with m extended states; z is (lead + m, p). Subclasses add the dynamics.

    m: number of the extended states, the disturbance and its first m - 1 derivatives. scale [rad/s]: near the
    bandwidth, so that the scaled states of the module have numbers of one size; 1/T in sampled time.

    >>> observer = ba.GPIObserver.from_bandwidth(300.0, m=2)
    >>> isinstance(observer, ba.ChainObserver), observer.order
    (True, 4)
    """

    m: int
    scale: float
    lead: int = field(default=2, kw_only=True)
    """Number of integrators between disturbance and measurement."""

    def __post_init__(self) -> None:
        check_whole(self.m, f"the order m of {type(self).__name__} is {self.m!r}")
        check_positive(self.scale, f"the scale of {type(self).__name__} is {self.scale!r} rad/s")
        check_chain(self.order, self.scale, type(self).__name__)

    @property
    def order(self) -> int:
        """Number of states per coordinate, lead + m."""
        return self.lead + self.m

    def initial_state(self, y: Array, dy: Array, xi: Array) -> Array:
        """State z whose estimates are y, dy and xi, each (p,) in physical units; derivatives of xi are zero.

        With lead = 1 y is a momentum, xi a force, and dy is not used.
        """
        z = np.zeros((self.order, len(y)))
        z[0] = y
        if self.lead > 1:
            z[1] = dy / self.scale
        if self.m > 0:
            z[self.lead] = xi / self.scale**self.lead
        return z

    def estimate(self, z: Array) -> Estimate:
        """Estimates x1^, x2^ and xi^ in z, each (p,), in physical units.

        xi^ = 0 for m = 0. With lead = 1 x1^ is a momentum, xi^ a force, and x2^ = 0, as no state stands for it.
        """
        none = np.zeros(z.shape[1])
        velocity = z[1] * self.scale if self.lead > 1 else none
        xi = z[self.lead] * self.scale**self.lead if self.m > 0 else none
        return Estimate(z[0], velocity, xi)

    def reset(
        self, z: Array, policy: ResetPolicy, swap: Indices, y: Array, dy: Array, xi: Array
    ) -> Array:
        """State z after impact, by a policy: NONE leaves z as it is, RELABEL swaps the legs in it, MEASURED
        also takes y and dy from the measurement, and MODEL starts anew from y, dy and xi.

        swap (p,): the relabelling, entries of (x, -x). y, dy, xi: measured position and velocity, and the
        model's disturbance, after impact; with lead = 1 y is a momentum, and dy has no use. Then xi^ is a
        force, which the impact does not end, so MODEL keeps it, and only its derivatives become zero. Columns
        of z behind the first p = len(swap), of unactuated coordinates, keep their place.
        """
        if policy is ResetPolicy.NONE:
            return z
        if policy is ResetPolicy.MODEL and self.lead > 1:
            return self.initial_state(y, dy, xi)
        p = len(swap)
        z = np.concatenate((relabelled(z[:, :p], swap), z[:, p:]), axis=1)
        if policy is not ResetPolicy.RELABEL:
            z[0] = y
            if self.lead > 1:
                z[1] = dy / self.scale
        # only with lead = 1, whose z[0] is the momentum, z[1] the force, and the rest its derivatives
        if policy is ResetPolicy.MODEL:
            z[2:] = 0.0
        return z
