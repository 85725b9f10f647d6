"""The next footstep, decided in each walking step: on which member of a family of gaits the step ends.

    h = f + R + b(s) (g - f)

A *family* of gaits (`gait.family`) has a constraint, its *member*, for each speed v [m/s] and step length L
[m]; the *cycle* of a member is the periodic walk on it. Theta = c q is the phase, Theta+ at the start of a
step.

    h        angles q_d (p,) [rad] of the joints with motors in this step, a function of Theta
    f, g     members (v-, L) and (v+, L), functions of Theta
    v-, v+   speeds [m/s] of the members on which the step begins and ends; v- is v+ of the step before
    L        length of the step [m], to the next *stone* where there are stones, on which the foot has to land
    R        polynomial that brings f to the joints' angles after impact, and fades out
    s        share of the step in Theta, 0 to 1
    b        rises from 0 at the decision, s = DECISION = 0.35, to 1 at s = SETTLED = 0.9

Until the decision v+ is computed anew at each sample instant, as the speed for which y at the decision of the
next step is

    y_next(v+) = y_free + (1 - pole / delta^2) (y_0 - y_free)

    y        sigma^2, with sigma [kg m^2/s] the angular momentum about the stance foot
    r        estimate [N m] of the torque from outside on the unactuated row, of the coordinate without motor
    y_0      y at the decision in the cycle at the speed to keep in the next step
    y_free   y at the next decision without the correction. Its v+ is the speed of the member whose cycle has
             y_0 while r acts
    delta    sigma just after the impact over sigma just before it, in that cycle

Without the correction the error y - y_0 is delta^2 times as large at the next decision, with it `pole` times.
y_next is kept between the y of the cycles of the family's slowest and fastest member, and v+ between the least
and the largest speed at which a step from v- may end (`StepMap.ends`): beyond it the foot slips, or a motor is
too weak. The map from step to step is used as in H-LIP (Xiong, Ames, arXiv 2101.09588), with the angular
momentum about the contact as its state (Gong, Grizzle, arXiv 2008.10763).

The estimates of sigma and r come from a momentum observer with its poles at -omega: sigma' = -G_N + r, with G_N
gravity's part of the unactuated row.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np

from biped_adrc.control.base import Controller, Measurement, body_of
from biped_adrc.control.outer_loop import Constraint, OuterLoop, tracked_constraint
from biped_adrc.control.reference_reset import ResetPolynomial, reset_coefficients
from biped_adrc.core.checks import PositiveFloat, PositiveFloats
from biped_adrc.core.errors import GaitError, ReachError
from biped_adrc.core.part import derived, with_fields
from biped_adrc.core.tree import chosen
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import Correction, VirtualConstraint
from biped_adrc.gait.family import DECISION, GaitFamily, load_family
from biped_adrc.gait.gait import Gait
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import of_step

SETTLED = 0.9
"""Share of a walking step, in Theta, from which h is the member g alone."""
EARLY = 0.2
"""A run that starts at a smaller share of a walking step bends this first step to its own posture by R."""


def blend(s: float) -> tuple[float, float, float]:
    """b, db/ds, d2b/ds2 [1] at the share s of a step: b is 0 up to DECISION, 1 from SETTLED on; three
    derivatives of b are continuous.
    """
    k = 1.0 / (SETTLED - DECISION)
    x = np.minimum(np.maximum(k * (s - DECISION), 0.0), 1.0)
    z = x * (1.0 - x)
    b = x**4 * (35.0 - 84.0 * x + 70.0 * x**2 - 20.0 * x**3)
    return b, 140.0 * k * z**3, 420.0 * k * k * z**2 * (1.0 - 2.0 * x)


@dataclass(frozen=True)
class StepCurve:
    """h of one walking step, the module's first equation; with `base`, the correction c = h - base to that."""

    family: GaitFamily
    begin: float
    """v- [m/s]."""
    end: float
    """v+ [m/s]."""
    L: float
    """Length of the step [m]."""
    plus: float
    """Theta+, where the step began [rad]."""
    reset: Array
    """Coefficients (2, p) [rad] of R, a `ResetPolynomial`."""
    base: VirtualConstraint | None = None
    """The constraint to which c is added; None for h itself."""

    def __call__(self, theta: float) -> tuple[Array, Array, Array]:
        """h or c, and two derivatives by Theta, each (p,), at theta [rad]."""
        mu = np.array((self.begin, self.L))  # (speed, step length) of the member f
        minus = self.family.curve(mu)[2]  # Theta-, at the end of the step
        rate = 1.0 / (minus - self.plus)
        f, df, ddf = self.family.h(mu, self.plus, theta)
        g, dg, ddg = self.family.h(np.array((self.end, self.L)), self.plus, theta)
        b, db, ddb = blend(rate * (theta - self.plus))
        # R is a polynomial in x, which falls from 1 at Theta+ to 0 at the end of the step; d is g - f
        R, dR, ddR = ResetPolynomial(self.reset, minus, -rate)(theta)
        d, dd, ddd, db, ddb = g - f, dg - df, ddg - ddf, rate * db, rate * rate * ddb
        h = f + R + b * d
        dh, ddh = df + dR + b * dd + db * d, ddf + ddR + b * ddd + 2.0 * db * dd + ddb * d
        if self.base is None:
            return h, dh, ddh
        h_0, dh_0, ddh_0 = self.base.h(theta)
        return h - h_0, dh - dh_0, ddh - ddh_0


class StepState(NamedTuple):
    """State w of a `Footstep`."""

    begin: float
    """v- [m/s]: the speed of the member f of the family, on which the step begins."""
    end: float
    """v+ [m/s]: the speed of the member g, on which it ends."""
    L: float
    """Length of the step [m]."""
    before: float
    """Length of the step before [m]."""
    sigma: float
    """Estimate of the angular momentum about the stance foot, half a period ago [kg m^2/s]."""
    r: float
    """Estimate of the torque from outside on the unactuated row of the dynamics [N m]."""
    plus: float
    """Theta+, where the step began [rad]."""
    reset: Array
    """Coefficients (2, p) [rad] of R."""


def step_reset(family: GaitFamily, mu: Array, plus: float, q_b: Array, slope: Array) -> Array:
    """Coefficients (2, p) [rad] of R: with it the step along a member begins at the joints' angles q_b (p,)
    [rad] with dq_b/dTheta = slope.

    mu: the member's (speed [m/s], step length [m]). plus: Theta [rad] where the step begins. slope: (p,).
    """
    h, dh, _ = family.h(mu, plus, plus)
    # R is a polynomial in x, which falls from 1 at the start of the step to 0 at its end, Theta- = curve(mu)[2]
    return reset_coefficients(1.0, -1.0 / (family.curve(mu)[2] - plus), q_b - h, slope - dh)


@dataclass(frozen=True)
class Footstep(OuterLoop):
    """The module's outer loop around `inner`, whose constraint becomes h; its own state w is a `StepState`.

    inner: the controller that tracks h. family: of gaits, from which each step is taken. speed [m/s]: the speed
    to keep. speeds [m/s]: those to keep in steps 1, 2, .. instead; behind the last of them comes `speed`. step
    [m]: length of the steps where there are no stones. stones [m]: lengths of the steps, the first one first.
    pole [1]: factor of the error of y from step to step. bandwidth [rad/s]: omega of the momentum observer.
    period [s]: of the ticks, in sampled time. Raises GaitError for a speed, ReachError for a stone that no
    member reaches.

    >>> controller = ba.Footstep.on_gait(ba.NPDController(gait.constraint), gait, biped, step=0.3)
    >>> force, clock = ba.HipForce(biped, (-12.0, 0.0), steps=(3, 99)), ba.SampledTime(1e-3)
    >>> walker = ba.Walker(biped, controller, force, timing=clock, torque_limit=150.0)
    >>> ba.walk(walker, gait, impacts=8).feasibility.status.name
    'COMPLETED'
    """

    family: GaitFamily
    speed: PositiveFloat
    step: PositiveFloat
    stones: tuple[float, ...] = ()
    pole: float = 0.35
    bandwidth: PositiveFloat = 20.0
    period: float = 1e-3
    speeds: PositiveFloats = ()

    needs_body = True

    def __post_init__(self) -> None:
        super().__post_init__()
        for k, v in enumerate(self.speeds, 1):
            try:
                self.family.check(v, self.step)
            except GaitError as error:
                raise GaitError(f"speed {k} of the list is out of reach: {error}") from None
        self.family.check(self.speed, self.step)
        for k, L in enumerate(self.stones, 1):
            try:
                self.family.check(self.speed, L)
            except GaitError as error:
                raise ReachError(f"stone {k} is out of reach: {error}") from None

    @classmethod
    def on_gait(
        cls,
        inner: Controller,
        gait: Gait,
        biped: Biped,
        family: str | Path = "rough",
        speed: float | None = None,
        step: float | None = None,
        stones: Sequence[float] = (),
        pole: float = 0.35,
        bandwidth: float = 20.0,
        speeds: Sequence[float] = (),
    ) -> Self:
        """The controller around `inner`, with a stored family of `biped`, by its name or file.

        speed [m/s], step [m]: those of the gait if None, and speed the last one of `speeds` [m/s], where there
        are some. stones [m], pole [1], bandwidth [rad/s]: as fields of the class.
        """
        length, rates = gait.step_length(biped), tuple(np.ravel(speeds).tolist())
        usual = rates[-1] if rates else length / gait.period
        return cls(
            inner,
            load_family(family, biped),
            usual if speed is None else speed,
            length if step is None else step,
            tuple(map(float, stones)),
            pole,
            bandwidth,
            speeds=rates,
        )

    def sampled(self, period: float) -> Self:
        return with_fields(self, inner=self.inner.sampled(period), period=period)

    @derived
    def base(self) -> VirtualConstraint:
        """The constraint of the controller inside, in whose place h comes: the correction is h - base."""
        return tracked_constraint(self.inner)

    def correction(self, w: StepState) -> Correction:
        return StepCurve(self.family, w.begin, w.end, w.L, w.plus, w.reset, self.base)

    def length(self, step: int) -> float:
        """L [m] of the single support with number `step`: to its stone, or the usual length without stones."""
        return of_step(self.stones, step, self.step)

    def kept(self, step: int) -> float:
        """Speed [m/s] to keep in the single support with number `step`."""
        return of_step(self.speeds, step, self.speed)

    def momentum(self, m: Measurement) -> float:
        """sigma half a period before m [kg m^2/s], at which G_N at m is the mean of G_N over a period."""
        return m.terms.D[-1] @ m.v + 0.5 * self.period * body_of(m).G[-1]

    def begun(self, v: float, earlier: float, before: float, r: float, m: Measurement) -> StepState:
        """w of a walking step that begins at m on the member v [m/s], after two steps of lengths `earlier` and
        then `before` [m]; r [N m]: the estimate of the torque from outside.

        The slope dq_b/dTheta after impact is that of the family, since rates measured there are noisy.
        """
        L, plus = self.length(m.step), float(self.family.phase @ m.q)  # plus: Theta+ as measured
        # the entries behind delta^2, 2 W', J' are dq_b/dTheta just after impact
        slope = self.family.steps.to_decision(np.array((v, earlier, before, L)))[3:]
        reset = step_reset(self.family, np.array((v, L)), plus, m.q_b, slope)
        return StepState(v, v, L, before, self.momentum(m), r, plus, reset)  # v+ = v at first

    def own_start(self, h: Constraint, m: Measurement) -> StepState:
        """w at the start of a run; h is not used. A run that starts within a step, at a share above EARLY =
        0.2, follows the member itself: its R is zero, and its Theta+ that of the member.
        """
        # as if two steps of the usual length came before, and without a torque from outside
        w = self.begun(self.kept(m.step), self.step, self.step, 0.0, m)
        _, plus, minus = self.family.curve(np.array((w.begin, w.L)))
        early = (w.plus - plus) / (minus - plus) < EARLY
        return chosen(early, w, w._replace(plus=plus, reset=0.0 * w.reset))

    def own_jump(self, w: StepState, h: Constraint, after: Measurement) -> StepState:
        # the step that ended has the length w.L, the one before it w.before
        return self.begun(w.end, w.before, w.L, w.r, after)

    def own_correct(self, w: StepState, m: Measurement) -> StepState:
        """Move the estimates of sigma and r on by a period (Euler), and compute v+ anew until the decision."""
        T, omega, x = self.period, self.bandwidth, w
        e = self.momentum(m) - x.sigma  # by the measurement, less the estimate
        r = x.r + T * omega**2 * e
        sigma = x.sigma + T * (x.r - body_of(m).G[-1] + 2.0 * omega * e)
        # minus: Theta- of the member on which the step began; early: the share of the step in Theta is below
        # DECISION, so v+ is computed anew; later it is kept
        minus = self.family.curve(np.array((x.begin, x.L)))[2]
        early = (self.family.phase @ m.q - x.plus) / (minus - x.plus) < DECISION
        end = np.where(early, self.decision(x, sigma**2, r, m.step), x.end)
        return x._replace(end=end, sigma=sigma, r=r)  # type: ignore[arg-type]

    def decision(self, x: StepState, y: float, r: float, step: int) -> float:
        """v+ [m/s] from y = sigma^2 [kg^2 m^4/s^2] and r [N m] now, by the module's equation.

        x: state of the step. step: number of the single support.
        """
        # y is that of the next step, so its length and speed count
        steps, ahead, speed = self.family.steps, self.length(step + 1), self.kept(step + 1)
        begin = np.array((x.begin, x.before))  # v-, and the length of the step before

        # y at the next decision if this step ends on the member of the speed v
        def following(v: float) -> float:
            return steps.next_square(y, begin, np.array((v, x.L)), ahead, r)

        y_0 = steps.of_cycle(np.array((speed, ahead)))[0]
        # y_free: y at the next decision with the v whose cycle has y_0 under r
        free = following(self.zero(lambda v: steps.cycle_square(v, ahead, r) - y_0))
        goal = free + (1.0 - self.pole / steps.delta_squared(speed, ahead)) * (y_0 - free)
        # the y of the cycles of the slowest and the fastest member
        slowest, fastest = self.family.low[0], self.family.high[0]
        low, high = (steps.cycle_square(v, ahead) for v in (slowest, fastest))
        goal = np.minimum(np.maximum(goal, low), high)
        # to stay on the member v- is always allowed
        least, most = steps.ends(np.array((x.begin, x.L)))
        v = self.zero(lambda v: following(v) - goal)
        return np.minimum(np.maximum(v, np.minimum(least, x.begin)), np.maximum(most, x.begin))

    def zero(self, f: Callable[[float], float]) -> float:
        """The speed v [m/s] in the family's range at which f(v) is 0. Where that is 0 nowhere in it, the nearer
        end.

        It is the zero of the parabola through f at both ends and in the middle of the range, and two steps of
        Newton's method with its slope: a loop to a tolerance would not do, since this becomes machine code
        without branches.
        """
        low, high = self.family.low[0], self.family.high[0]
        f_0, f_1, f_2 = f(low), f(0.5 * (low + high)), f(high)
        # f = f_0 + b z + c z^2 in z = (v - low) / (high - low), in [0, 1]
        b, c = 4.0 * f_1 - 3.0 * f_0 - f_2, 2.0 * (f_0 + f_2 - 2.0 * f_1)
        # the zero at which f rises, in the form without cancellation; the floor keeps the root real where the
        # parabola has no zero; y has a size of 100 kg^2 m^4/s^2
        root = np.sqrt(np.maximum(b * b - 4.0 * c * f_0, 1e-6))
        z = np.minimum(np.maximum(-2.0 * f_0 / (b + root), 0.0), 1.0)
        for _ in range(2):
            # root is df/dz at the parabola's zero
            z = np.minimum(np.maximum(z - f(low + (high - low) * z) / root, 0.0), 1.0)
        return low + (high - low) * z
