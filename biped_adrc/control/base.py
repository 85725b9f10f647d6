"""A controller: a torque from a measurement and the controller's own state.

    u = output(s, m),   s' = flow(s, m, u)         in continuous time
    s <- correct(s, m), u = output(s, m), s <- predict(s, m, u)    at a tick

A *tick* is a sample instant; s' is ds/dt. The state s is passed in and handed back. A controller without a
state needs `output` alone and works in both time bases. The `u` that `flow` and `predict` get is the torque
applied, after saturation. Of the n coordinates q the first p, q_b, are the joints with motors; the others are
q_N. The nominal model is the one that controllers know: D q'' + Omega = B u, hence q_b'' = kappa u + xi.
Symbols: D (n, n) the inertia matrix, Omega (n,) [N m] Coriolis and gravity terms, B the rows with motors, kappa
(p, p) [1/(kg m^2)] the input gain, xi (p,) [rad/s^2] the acceleration of q_b without torques.

At a sample instant `output` comes between `correct` and `predict`: the torque uses the measurement of this
instant, and the observer inside gets that torque and no other, so it does not wind up at a limit.

A controller is a frozen dataclass that writes these methods. Python calls them, or the engine, the package's
compiler (`biped_adrc.core.part`), turns them into machine code.

`Passive` sends no torque: u = 0, for passive walkers and for the robot's own motion.
A compass robot walks down a slope with no more than that (McGeer, Int. J. Robotics Research 9(2), 1990). Tests
use it where no controller may interfere, such as for the conservation of energy between impacts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from inspect import signature
from typing import Any, ClassVar, NamedTuple, NoReturn, Self

import numpy as np

from biped_adrc.core.checks import check_part, line_of, returned, spoken
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import Part, once
from biped_adrc.core.shown import shown
from biped_adrc.core.tree import Layout, flatten, returned_tree, zeros_like
from biped_adrc.core.types import Array, Indices
from biped_adrc.model.reduction import BodyTerms, Reduction
from biped_adrc.observers.base import ErrorSystem, Estimate


@shown
class Measurement(NamedTuple):
    """The measurement that a controller gets, from its sensors, with `terms` of the nominal model there.

    >>> q, v = gait.q_minus, gait.v_minus
    >>> m = ba.Measurement(t=0.0, step=1, t_step=0.0, q=q, v=v, terms=biped.reduction(q, v))
    >>> m.q_b.shape
    (4,)
    """

    t: float
    """Time since the start of the run [s]."""
    step: int
    """Number of the single support (walking step), from 1."""
    t_step: float
    """Time since this single support began [s]."""
    q: Array
    """Angles (n,) [rad]."""
    v: Array
    """Rates (n,) [rad/s]."""
    terms: Reduction
    """D, Omega, kappa, xi and more of the nominal model at (q, v)."""
    body: BodyTerms | None = None
    """G, C' q' (C' a transpose) and the ground's force of the nominal model; None without `needs_body`."""
    elsewhere: Callable[[Array, Array], Measurement] | None = None
    """elsewhere(q, v), each (n,) [rad, rad/s] -> the measurement there, at this time; None outside a loop."""
    impulse: Array | None = None
    """Changes of the rates (n, 2) [1/(kg m)] by an impulse of 1 N s on the striking foot in x and in z: a law
    that reads it leaves such changes out of its errors. None but for a controller inside `ImpactInvariant`,
    near a touchdown."""

    @property
    def q_b(self) -> Array:
        """Actuated joints (p,) [rad]."""
        return self.q[: len(self.terms.kappa)]

    @property
    def v_b(self) -> Array:
        """Rates of the actuated joints (p,) [rad/s]."""
        return self.v[: len(self.terms.kappa)]


def measured(m: Measurement) -> Estimate:
    """The measured q_b, q_b' and the nominal model's xi, each (p,), as the three fields of an `Estimate`.

    A law without an observer uses it in place of estimates, and an observer starts from it.
    """
    return Estimate(m.q_b, m.v_b, m.terms.xi)


def body_of(m: Measurement) -> BodyTerms:
    """`m.body`, the body terms of the nominal model: gravity, the ground's force, the swing foot's Jacobian.

    Raises InputError for a measurement made for a controller without `needs_body`.
    """
    if m.body is None:
        raise InputError(
            "the measurement has no body terms; expected those of the nominal model. Give the controller "
            "needs_body = True, or the Measurement body=biped.body_terms(q, v)"
        )
    return m.body


def impulse_of(m: Measurement) -> Array:
    """`m.impulse` (n, 2) [1/(kg m)], the changes of the rates by an impulse on the striking foot.

    Raises InputError for a measurement without it.
    """
    if m.impulse is None:
        raise InputError("the measurement has no impulse; expected one made by ImpactInvariant")
    return m.impulse


class Controller(Part):
    """Base of all controllers: write `output`, and the other methods that the controller needs.

    A frozen dataclass with gains and parts as fields. A controller with `flow` works in continuous time, one
    with `predict` in sampled time; `sampled` turns the first into the second, where it is not both.

    >>> @dataclass(frozen=True)
    ... class PD(ba.Controller):
    ...     reference: ba.Reference
    ...
    ...     def output(self, s, m):
    ...         r = self.reference(m.t, m.q, m.v)
    ...         return 2500.0 * (r.q_d - m.q_b) + 120.0 * (r.dq_d - m.v_b)
    >>> ba.walk(ba.Walker(biped, PD(gait.constraint)), gait, impacts=1).impacts
    1
    """

    SUCH_AS = "NPDController(gait.constraint)"
    IS_BASE: ClassVar[bool] = True
    """Whether the methods of this very class do nothing of their own, or only pass calls on to `inner`; a class
    that inherits from it is no base unless it says so."""

    needs_body: ClassVar[bool] = False
    """Whether the controller reads `Measurement.body`, which is computed only then."""
    reads_impulse: ClassVar[tuple[str, ...]] = ()
    """Which of the methods "output" and "correct" leave the directions of `Measurement.impulse` out of their
    errors; none by default."""
    in_python: ClassVar[str] = ""
    """Why a law of this package cannot be compiled, for the user who walks with it; empty for all others."""

    def output(self, s: Any, m: Measurement) -> Array:
        """Torque u (p,) [N m] commanded to the motors, before any limit. Raises InputError
        if no subclass writes it.
        """
        how = "write it: u (p,) [N m] from its state s and the Measurement m"
        self._has_no("method output(s, m)", how)

    def initial_state(self, m: Measurement) -> Any:
        """State s at the start of a run: an array, or a NamedTuple of arrays, numbers and states.

        Empty (0,) for a controller without state.
        """
        return np.zeros(0)

    def flow(self, s: Any, m: Measurement, u: Array) -> Any:
        """s' in continuous time, under the applied torque u (p,) [N m]; by default zero: s stays as it is."""
        return zeros_like(s)

    def correct(self, s: Any, m: Measurement) -> Any:
        """s corrected by the measurement of this sample instant; sampled time only."""
        return s

    def predict(self, s: Any, m: Measurement, u: Array) -> Any:
        """s at the next sample instant, under the applied torque u (p,) [N m]; sampled time only."""
        return s

    def jump(self, s: Any, after: Measurement, swap: Indices) -> Any:
        """State s of the controller after an impact, from s before it; by default the same.

        after: the measurement after the impact. swap (p,), whole numbers: as the legs swap, entry i of a row x
        of the joints becomes entry swap[i] of (x, -x), by `types.relabelled`.
        """
        return s

    def estimate(self, s: Any, m: Measurement) -> Estimate | None:
        """Estimates of the p joints by an observer inside, for plots and wrappers; None without one."""
        return None

    def sampled(self, period: float) -> Controller:
        """The controller in its form for ticks every `period` [s]; the same object where `predict` does not
        depend on the period.
        """
        return self

    @once  # computed once for each controller and period
    def at_ticks(self, period: float) -> Controller:
        """Call `sampled`, and check its result. Raises InputError for a controller, also one inside, whose
        state flows in continuous time, but that has no `predict` for ticks.
        """
        law = self.sampled(period)
        check_part(law, f"what {type(self).__name__}.sampled returned", Controller)
        how = "write predict(s, m, u), s at the next sample instant, or use ContinuousTime()"
        # _writes: whether the class overrides the method; _has_no: raises InputError
        for part in nested(law):
            if part._writes("flow") and not part._writes("predict"):
                part._has_no("discrete form", how)
        return law

    def continuous(self) -> Controller:
        """The controller itself, for continuous time. Raises InputError for one that
        was made for sampled time.
        """
        if self._writes("predict") and not self._writes("flow"):
            self._only_sampled()
        return self

    def error_system(self) -> ErrorSystem | None:
        """Linear error dynamics of the observer, if the observer is the whole state s; None otherwise.

        The exponential integration method (`hybrid.exponential`) needs them.
        """
        return None

    def _writes(self, name: str) -> bool:
        """Whether the controller's class overrides the method `name` of a base (`IS_BASE`)."""
        return not next(vars(c) for c in type(self).__mro__ if name in vars(c)).get("IS_BASE")

    def _only_sampled(self) -> NoReturn:
        """Raise InputError: this controller works in sampled time only."""
        how = "give timing=SampledTime(period), or hardware.period of a scenario (--period)"
        self._has_no("form but one in sampled time only", how)

    def _has_no(self, what: str, how: str) -> NoReturn:
        """Raise InputError: this controller lacks `what`; how: what the user can do."""
        raise InputError(f"{type(self).__name__} has no {what}; {how}")


class WithPeriod(Controller):
    """Base of controllers whose sampled form is of the same class, with its field `period` set."""

    period: float | None

    def sampled(self, period: float) -> Self:
        return replace(self, period=period)  # type: ignore[type-var]

    def continuous(self) -> Self:
        if self.period is not None:
            self._only_sampled()
        return self


def nested(controller: Controller | None) -> Iterator[Controller]:
    """Iterate over a controller and the controllers inside it (field `inner`), from outside in."""
    while controller is not None:
        yield controller
        controller = getattr(controller, "inner", None)


def check_methods(controller: Controller, s: Any, m: Measurement, sampled: bool) -> None:
    """Check a controller's methods at the start of a run, in state s at m; sampled: whether at ticks.

    Raises InputError. Of a controller of this package the shape of `output` alone is checked. Arrays must have
    the right shape, as machine code would write past the end of the state; a user's method must give the same
    result twice, as machine code keeps nothing in an object.
    """
    own, output = has_own_class(controller), getattr(controller, "measured_output", None)
    kept = dict(vars(controller))
    for name in ("output", "flow", "correct", "predict", "jump") if own else ():
        takes = [*signature(getattr(Controller, name)).parameters]  # self first
        try:
            # as in a call with the arguments of the base class
            signature(getattr(controller, name)).bind(*takes[1:])
        except TypeError as error:
            where = f"{spoken(controller)}.{name}{line_of(controller, name)}"
            raise InputError(f"{where}: {error}, expected {name}({', '.join(takes)})") from error
    if own and output:  # an observer's estimates have the shapes of what it measures
        part: Any = vars(controller)["observer"]
        returned_tree(part.estimate(s), Layout.of(output(m)), part, "estimate", finite=False)
    u = returned(controller.output(s, m), (m.terms.kappa.shape[0],), controller, "output")
    if not own:
        return
    # method -> its arguments behind the state s
    calls = {"correct": (m,), "predict": (m, u)} if sampled else {"flow": (m, u)}
    first: dict[str, Any] = {"output": u}
    for name, arguments in calls.items():
        result = getattr(controller, name)(s, *arguments)
        # shapes alone: a state that is not finite is reported where the walk meets it
        first[name] = returned_tree(result, Layout.of(s), controller, name, finite=False)
    # other: any measurement that differs from m
    calls, other = {"output": (m,), **calls}, m._replace(q=m.q + 1e-3, v=m.v + 1e-3)
    for name, arguments in calls.items():
        # a call at other angles and rates, which a memory in the object would keep; [1:] leaves out m
        getattr(controller, name)(s, other, *arguments[1:])
        again = getattr(controller, name)(s, *arguments)
        # a leaf may be a list
        again = returned_tree(again, None, controller, name, finite=False)
        same = all(vars(controller)[k] is x for k, x in kept.items())
        if not (same and np.array_equal(flatten(first[name]), flatten(again), equal_nan=True)):
            raise InputError(
                f"{spoken(controller)}.{name}{line_of(controller, name)} gave another result when asked again "
                "at the same instant, or changed the object; expected no memory in the object: write "
                "@dataclass(frozen=True), and return a state from initial_state, and flow or predict"
            )


def has_own_class(part: Part) -> bool:
    """Whether the class of a part, or of a part in its fields, is a user's and not of this package."""
    inside = (x for x in vars(part).values() if isinstance(x, Part))
    return not type(part).__module__.startswith("biped_adrc.") or any(map(has_own_class, inside))


@dataclass(frozen=True)
class Passive(Controller):
    """A controller with u = 0 (p,) [N m].

    >>> walk = ba.walk_scenario(ba.Scenario("passive", robot="compass", run={"impacts": 2}))
    >>> walk.impacts
    2
    """

    def output(self, s: Any, m: Measurement) -> Array:
        return np.zeros(m.terms.kappa.shape[0])
