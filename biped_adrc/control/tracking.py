"""Shared parts of the controllers that track a reference: the commanded acceleration,
and an observer as the state.

    u = kappa^-1 (a - xi),   a = q_d'' + f,   f = -K_d (x2 - q_d') - K_p (x1 - q_d)

is shared by the laws (20) and (28) of the paper. They differ in where x1, x2 and xi come from: an observer in
(20), the measurement and the model in (28). The p joints q_b have motors, the coordinates q_N have none; (13)
is q_b'' = kappa u + xi, with the input gain kappa (p, p) and the disturbance xi (p,) [rad/s^2].

q_d'' = drift + H q'', H = (H_b, H_N) (p, n), contains q'' and so, through the model, the torque: for a virtual
constraint q_d = h(Theta), with the phase Theta = c q, it is the *loop through Theta''*. With the unactuated
rows q_N'' = A_N q_b'' + a_N of (12) and q_b'' = a,

    (I - H_b - H_N A_N) a = drift + f + H_N a_N

is solved for a. As printed, (20) and (28) drop H q''.

ADRC, its output form and DOB (disturbance observer) have an observer that is their whole state z:

    u = torque(r, x^, m),   z' = flow(z, y, input)          in continuous time
    z <- correct(z, y),     z <- predict(z, input)          at a tick

A *tick* is a sample instant. r is the point of the reference (q_d, q_d', drift, H), m the measurement with the
model's terms (kappa, xi, A_N, a_N), x^ the observer's estimate. An `ObservingController` defines the observer's
measurement y, its input, and the torque, for every observer and every reference. In `adrc` y is q_b, in
`output_adrc` the error q_b - q_d, in `momentum_dob` the momentum. All else, resets and time bases included, is
here once.
"""

from abc import abstractmethod
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np

from biped_adrc.control.base import Controller, Measurement, impulse_of
from biped_adrc.core.checks import check_part, numbers
from biped_adrc.core.errors import InputError, check_positive, check_whole
from biped_adrc.core.linear import solve, solve_positive
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, Indices, read_only
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.model.reduction import Reduction
from biped_adrc.observers.base import Estimate, Observer, ResetPolicy, equal_poles

_HIGHEST = 1e15
"""Largest gain, K_p in 1/s^2 or K_d in 1/s; above it products of gains and poles overflow."""


def per_joint(values: object, what: str) -> Array | float:
    """A positive number as a float, or one for each joint as an array (p,).

    what: how the message begins. Raises InputError for numbers that are not positive, or too large.
    """
    found = numbers(values, what)
    if found.ndim > 1 or not np.all((found > 0.0) & (found <= _HIGHEST)):
        raise InputError(
            f"{what} is {found}, expected positive numbers, one per joint, at most {_HIGHEST:g}"
        )
    return float(found) if found.ndim == 0 else read_only(found)


def check_joints(values: Array | float, what: str, p: int) -> None:
    """Raise InputError, which calls the values `what`, where they are neither one number nor p."""
    count = np.size(values)
    if count not in (1, p):
        raise InputError(
            f"{what} has {count} numbers, expected 1 or {p}: one for each joint with a motor"
        )


@dataclass(frozen=True)
class Gains(Shown):
    """Gains of the feedback on the errors of angles and rates; those of Table II by default.

    K_p [1/s^2], K_d [1/s]: on angles and on rates, one number for all joints or one per joint (p,).

    Raises InputError for numbers that are not positive.

    >>> gains = ba.Gains(K_p=2500.0, K_d=np.array([100.0, 100.0, 80.0, 80.0]))
    >>> ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint, gains)), gait, impacts=2).impacts
    2
    """

    SUCH_AS = "Gains(5000.0, 50.0), K_p [1/s^2] and K_d [1/s]"

    K_p: Array | float = 5000.0
    K_d: Array | float = 50.0

    def __post_init__(self) -> None:
        for name in ("K_p", "K_d"):
            object.__setattr__(self, name, per_joint(getattr(self, name), f"gain {name}"))

    @property
    def first(self) -> tuple[float, float]:
        """K_p [1/s^2] and K_d [1/s] of the first joint."""
        return float(np.ravel(self.K_p)[0]), float(np.ravel(self.K_d)[0])

    def check(self, p: int) -> None:
        """Raise InputError for gains per joint whose number is not p."""
        for name in ("K_p", "K_d"):
            check_joints(getattr(self, name), f"gain {name}", p)


TABLE_II = Gains(5000.0, 50.0)
"""Table II of the paper.

>>> ba.TABLE_II.K_p, ba.TABLE_II.K_d
(5000.0, 50.0)
"""


def tracking_torque(
    gains: Gains, r: ReferencePoint, x: Estimate, m: Measurement, solve_theta: bool
) -> Array:
    """Torque u (p,) [N m] of (20) or (28), by the reference r now and the joints' x1, x2, xi in x.

    x: from an observer, or measured. m: only its model terms and its impulse are used. solve_theta: whether the
    loop through Theta'' is solved for the acceleration a; else a = drift + f, as the paper prints it, whose
    error acts as a disturbance. Raises SingularError where that loop is singular.
    """
    x2 = x.velocity
    if m.impulse is not None:  # near a touchdown, inside `ImpactInvariant`
        x2 = r.dq_d + unchanged(r, x2 - r.dq_d, m.impulse)
    f = feedback(gains, r, x.position, x2)
    ddq_b = solved_acceleration(r, m.terms, f) if solve_theta else r.drift + f
    return m.terms.kappa_inverse @ (ddq_b - x.disturbance)


def unchanged(r: ReferencePoint, de: Array, a: Array) -> Array:
    """The part of the rate error de = q_b' - q_d' (p,) [rad/s] that no change of the rates q' along the two
    columns of a (n, 2) alters, such as by an impulse in x and in z; r: the reference now.
    """
    return orthogonal_to(rate_error_change(r, a)) @ de


def rate_error_change(r: ReferencePoint, a: Array) -> Array:
    """Change of q_b' - q_d' (p, 2) when the rates q' change by each column of a (n, 2): a_b - H a, with a_b
    its first p rows, since q_d' = H q' for a virtual constraint.
    """
    return a[: len(r.q_d)] - r.H @ a


def feedback(gains: Gains, r: ReferencePoint, x1: Array, x2: Array) -> Array:
    """The feedback f = -K_d (x2 - q_d') - K_p (x1 - q_d) (p,) [rad/s^2].

    gains: K_p [1/s^2], K_d [1/s]. r: the reference now. x1 (p,) [rad], x2 (p,) [rad/s]: angles and rates,
    measured or estimated.

    >>> r = gait.constraint(0.0, gait.q_minus, gait.v_minus)
    >>> ba.feedback(ba.Gains(100.0, 10.0), r, r.q_d + 0.01, r.dq_d)
    array([-1., -1., -1., -1.])
    """
    return -gains.K_d * (x2 - r.dq_d) - gains.K_p * (x1 - r.q_d)


def solved_acceleration(r: ReferencePoint, terms: Reduction, f: Array) -> Array:
    """Solve (I - H_b - H_N A_N) a = drift + f + H_N a_N for the acceleration a (p,) [rad/s^2] of the joints.

    r: the reference now, with drift and H of q_d''. terms: of the model, with A_N and a_N of q_N''. f (p,)
    [rad/s^2]: the feedback.
    Raises SingularError when the matrix is exactly singular, with a pivot of 0.0; near that a grows
    without bound and without an error.

    >>> r = gait.constraint(0.0, gait.q_minus, gait.v_minus)
    >>> terms = biped.reduction(gait.q_minus, gait.v_minus)
    >>> ba.solved_acceleration(r, terms, np.zeros(4)).shape
    (4,)
    """
    rest = r.drift + f + r.H[:, len(f) :] @ terms.a_N
    what = "I - H_b - H_N A_N, by which the reference is tracked from this state,"
    return solve(output_matrix(r, terms), rest, what)


def output_matrix(r: ReferencePoint, terms: Reduction) -> Array:
    """M = I - H_b - H_N A_N (p, p) of the output y = q_b - q_d, for which y'' = M q_b'' - drift - H_N a_N.

    r: the reference now, with drift and H. terms: of the model, with A_N and a_N.
    """
    p = len(r.q_d)
    return np.eye(p) - r.H[:, :p] - r.H[:, p:] @ terms.A_N


def orthogonal_to(N: Array) -> Array:
    """Projection P = 1 - N (N' N)^-1 N' (k, k) onto the directions orthogonal to the columns of N (k, 2).

    N' is the transpose of N.
    """
    return np.eye(len(N)) - N @ solve_positive(N.T @ N, N.T, "N' N of two impulses")


class ObservingController(Controller):
    """Base of the controllers whose state s is the state z of an observer.

    reference: the reference to track. observer: that observer. gains: K_p [1/s^2], K_d [1/s] on the estimates.
    reset: what happens to the observer at impact. In the methods r is the point of the reference, x the
    observer's estimates; y, its measurement, is `position` of `measured_output`.

    >>> controller = ba.ADRCController(gait.constraint)
    >>> isinstance(controller, ba.ObservingController), controller.observer.m
    (True, 7)
    """

    reads_impulse: ClassVar[tuple[str, ...]] = ("output", "correct")

    reference: Reference
    observer: Observer
    gains: Gains
    reset: ResetPolicy

    @classmethod
    def from_bandwidth(
        cls, reference: Reference, omega_c: float, omega_o: float, m: int = 1, **others: Any
    ) -> Self:
        """The law with K_p = omega_c^2, K_d = 2 omega_c, and an observer of m extended states with all poles at
        -omega_o, m + 2 of them, m + 1 of a momentum observer (Gao, American Control Conference 2003).

        omega_c, omega_o [rad/s]: bandwidths of loop and observer. others: further arguments of the constructor.
        Raises InputError for a bandwidth or an order out of range.

        >>> ba.ADRCController.from_bandwidth(gait.constraint, omega_c=50.0, omega_o=300.0, m=2).gains.K_p
        2500.0
        """
        check_positive(omega_c, f"omega_c is {omega_c} rad/s")
        check_whole(m, f"observer order m is {m!r}")
        make: Any = cls
        # an observer of the kind of the default one, with `lead` integrators before the disturbance
        usual = make(reference, **others).observer
        observer = type(usual).from_poles(equal_poles(omega_o, usual.lead + m))
        gains = Gains(omega_c**2, 2.0 * omega_c)
        law: Self = make(reference, observer=observer, gains=gains, **others)
        return law

    @abstractmethod
    def measured_output(self, m: Measurement) -> Estimate:
        """The observer's measurement y, its rate y', and the nominal model's value of what the observer
        estimates as the disturbance; in the units of the observer. Its start and reset use all three, `flow`
        and `correct` y alone.
        """

    @abstractmethod
    def observer_input(self, m: Measurement, u: Array) -> Array:
        """The observer's input under the torque u (p,) [N m], such as kappa u [rad/s^2]."""

    @abstractmethod
    def torque(self, r: ReferencePoint, x: Estimate, m: Measurement) -> Array:
        """u (p,) [N m] for the point r of the reference and the observer's own estimates x."""

    def impulse_change(self, m: Measurement) -> Array:
        """N: changes of y', or of y where y is a momentum, by an impulse of 1 N s in x and in z on the striking
        foot, one column each, from `m.impulse` a (n, 2); by default a_b (p, 2), where y is q_b.
        """
        return impulse_of(m)[: m.terms.kappa.shape[0]]

    def joint_estimate(self, x: Estimate, m: Measurement) -> Estimate:
        """The observer's estimates x as estimates of the joints, each (p,); x itself by
        default, where y is q_b.
        """
        return x

    def point(self, m: Measurement) -> ReferencePoint:
        """The point of the reference at a measurement."""
        return self.reference(m.t, m.q, m.v)

    def estimated(self, s: Any) -> Estimate:
        """The observer's estimates in s. Raises InputError for an observer that returns something else."""
        x = self.observer.estimate(s)
        check_part(x, f"what {type(self.observer).__name__}.estimate returned", Estimate)
        return x

    def output(self, s: Any, m: Measurement) -> Array:
        return self.torque(self.point(m), self.estimated(s), m)

    def initial_state(self, m: Measurement) -> Any:
        # three arguments: y, y', and the model's value of the disturbance
        return self.observer.initial_state(*self.measured_output(m))

    def jump(self, s: Any, after: Measurement, swap: Indices) -> Any:
        """The observer's state after impact by the policy `reset`; swap (p,): relabelling of the joints."""
        return self.observer.reset(s, self.reset, swap, *self.measured_output(after))

    def flow(self, s: Any, m: Measurement, u: Array) -> Any:
        return self.observer.flow(s, self.measured_output(m).position, self.observer_input(m, u))

    def correct(self, s: Any, m: Measurement) -> Any:
        y = self.measured_output(m).position
        # near a touchdown, inside `ImpactInvariant`: the innovation y - y^ without what an impulse can change
        if m.impulse is not None:
            y_hat = self.observer.estimate(s).position
            y = y_hat + orthogonal_to(self.impulse_change(m)) @ (y - y_hat)
        return self.observer.correct(s, y)

    def predict(self, s: Any, m: Measurement, u: Array) -> Any:
        return self.observer.predict(s, self.observer_input(m, u))

    def estimate(self, s: Any, m: Measurement) -> Estimate:
        return self.joint_estimate(self.estimated(s), m)

    def sampled(self, period: float) -> Self:
        # the observer in its form for sample instants; all else does not depend on the period
        return replace(self, observer=self.observer.at_ticks(period))  # type: ignore[type-var]

    def continuous(self) -> Self:
        # an observer that writes no flow of its own, only inherits one that raises an error, was made for ticks
        if type(self.observer).flow is Observer.flow:
            self._only_sampled()
        return self
