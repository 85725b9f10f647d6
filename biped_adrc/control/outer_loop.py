"""Outer loops: around a controller that tracks a virtual constraint, a state that corrects the constraint.

    h_in_force(Theta) = h(Theta) + c(Theta; w),   s = (inner, own),   own = w

h gives the angles q_d of the p joints as functions of the phase Theta = c q. The *core* is the controller
inside all loops; the reference *in force* is h with the corrections of all loops. s is the state of a loop, the
state `inner` of the controller inside and the loop's own state w; w changes at impact, and between impacts only
by `own_flow` in continuous time and `own_correct` in sampled time. The inner controller, whichever it is,
tracks the sum. Outer loops can be nested: their corrections add up.

An inner controller drives q_b - h(Theta) to zero, with q_b the joints with motors, and cannot change how the
zero dynamics respond to a push; an outer loop does that by changing h. The inner controller itself stays as it
is: at each call a copy of it tracks the corrected constraint. The core starts and jumps (changes its state at
impact) last, when all corrections are known, since an observer of outputs starts from the error of the
reference in force.
"""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Self

from biped_adrc.control.around import Around
from biped_adrc.control.base import Controller, Measurement, nested
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import with_fields
from biped_adrc.core.tree import zeros_like
from biped_adrc.core.types import Array, Indices
from biped_adrc.gait.constraint import CorrectedConstraint, Correction, VirtualConstraint
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.observers.base import ErrorSystem, Estimate

Constraint = VirtualConstraint | CorrectedConstraint


class LoopState(NamedTuple):
    """State of an outer loop."""

    inner: Any
    """State of the controller inside."""
    own: Any
    """The loop's own state w."""


@dataclass(frozen=True)
class OuterLoop(Around):
    """Base of all outer loops. Raises InputError when `inner` has no virtual constraint as `reference`."""

    IS_BASE: ClassVar[bool] = True
    # none: `ImpactInvariant`, which uses this, goes inside an outer loop and not around one
    reads_impulse: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        tracked_constraint(self.inner)

    @abstractmethod
    def own_start(self, h: Constraint, m: Measurement) -> Any:
        """w at the start of a run, at m; h is the constraint that the inner controller tracks, with the
        corrections of loops further inside.
        """

    def own_jump(self, w: Any, h: Constraint, after: Measurement) -> Any:
        """w after impact, from w before it; by default that of a start. h is the constraint that the inner
        controller tracks after it.

        after: the measurement after the impact.
        """
        return self.own_start(h, after)

    @abstractmethod
    def correction(self, w: Any) -> Correction:
        """The correction c(Theta; w) for this w, a function of Theta [rad].

        It returns c, dc/dTheta, d2c/dTheta2, each (p,).
        """

    def own_flow(self, w: Any) -> Any:
        """w' in continuous time; zero by default."""
        return zeros_like(w)

    def own_correct(self, w: Any, m: Measurement) -> Any:
        """w after the measurement of a sample instant; unchanged by default."""
        return w

    def sampled(self, period: float) -> Self:
        if self._writes("own_flow") and not self._writes("own_correct"):
            self._has_no("method own_correct", "write it: w after a sample instant")
        return super().sampled(period)

    def continuous(self) -> Self:
        if self._writes("own_correct") and not self._writes("own_flow"):
            self._only_sampled()
        return super().continuous()

    def _acting(self, w: Any) -> Controller:
        """The inner controller with its constraint corrected by c(Theta; w)."""
        # the reference of the core has the corrections of loops further out already; c is added to them
        h = CorrectedConstraint(own_reference(self.inner), self.correction(w))
        return tracking(self.inner, h)

    # -- what a controller does ------------------------------------------------------------------
    def output(self, s: Any, m: Measurement) -> Array:
        return self._acting(s.own).output(s.inner, m)

    def initial_state(self, m: Measurement) -> Any:
        """(inner, w) at the start; the core starts a second time, with this correction in its reference."""
        # state of the controller inside; its core has started without c
        z = self.inner.initial_state(m)
        s = LoopState(z, self.own_start(reference_in_force(self.inner, z), m))
        return with_core(self, s, innermost(self, s).initial_state(m))

    def flow(self, s: Any, m: Measurement, u: Array) -> Any:
        return LoopState(self._acting(s.own).flow(s.inner, m, u), self.own_flow(s.own))

    def correct(self, s: Any, m: Measurement) -> Any:
        return LoopState(self._acting(s.own).correct(s.inner, m), self.own_correct(s.own, m))

    def predict(self, s: Any, m: Measurement, u: Array) -> Any:
        return LoopState(self._acting(s.own).predict(s.inner, m, u), s.own)

    def jump(self, s: Any, after: Measurement, swap: Indices) -> Any:
        """(inner, w) after impact, the joints relabelled by swap (p,), as the legs exchange names; the core
        jumps a second time, from its state before the impact, with this correction in its reference.
        """
        z = self.inner.jump(s.inner, after, swap)
        # as z has the core's state after a jump without this correction, the core jumps again
        state = LoopState(z, self.own_jump(s.own, reference_in_force(self.inner, z), after))
        before = core_state(self, s)
        return with_core(self, state, innermost(self, state).jump(before, after, swap))

    def error_system(self) -> ErrorSystem | None:
        # the core's observer is the same with a corrected reference
        return self.inner.error_system()

    def estimate(self, s: Any, m: Measurement) -> Estimate | None:
        return self.inner.estimate(s.inner, m)


OF_A_LOOP = "an outer loop corrects the virtual constraint of its inner controller"
"""Beginning of a message on a controller inside an outer loop."""


def tracked_constraint(controller: Controller, why: str = OF_A_LOOP) -> VirtualConstraint:
    """The virtual constraint h, without corrections, of the controller inside all wrappers.

    Raises InputError if it tracks none; why: how the message begins.
    """
    h = own_reference(controller)
    if isinstance(h, CorrectedConstraint):
        return h.constraint
    if not isinstance(h, VirtualConstraint):
        result = "no reference" if h is None else f"a reference of type {type(h).__name__}"
        raise InputError(
            f"{why}, but {type(controller).__name__} has {result}; expected a field `reference` that holds a "
            "VirtualConstraint, as in NPDController(gait.constraint)"
        )
    return h


def own_reference(controller: Controller | None) -> Any:
    """The field `reference` of the controller inside all wrappers (field `inner`); None where it has none."""
    each = (getattr(c, "reference", None) for c in nested(controller))
    return next((h for h in each if h is not None), None)


def tracking(controller: Controller, reference: Constraint) -> Controller:
    """A copy of the controller in which it, or else the one inside (field `inner`), tracks `reference`."""
    if hasattr(controller, "reference"):
        return with_fields(controller, reference=reference)
    return with_fields(controller, inner=tracking(controller.inner, reference))  # type: ignore[attr-defined]


def reference_in_force(controller: Controller, s: Any) -> Constraint:
    """The reference in force of a controller in its state s: h with the corrections of all its outer loops.

    Raises InputError if the controller tracks no virtual constraint.
    """
    if isinstance(controller, OuterLoop):
        h = reference_in_force(controller.inner, s.inner)
        return CorrectedConstraint(h, controller.correction(s.own))
    # where there is no reference (None), `tracked_constraint` raises the error
    return own_reference(controller) or tracked_constraint(controller)


def tracked_by(law: Controller, reference: Reference | OuterLoop) -> Reference | OuterLoop:
    """From what `tracked_point` gets the q_d of a controller `law`: from itself if it is an outer loop, whose
    state has the corrections; else from `reference`.
    """
    return law if isinstance(law, OuterLoop) else reference


def tracked_point(h: Reference | OuterLoop, s: Any, m: Measurement) -> ReferencePoint:
    """The point (q_d, q_d', ..) of a reference h at the measurement m; for an outer loop h the point of the
    reference in force in its state s.
    """
    r = reference_in_force(h, s) if isinstance(h, OuterLoop) else h
    return r(m.t, m.q, m.v)


def innermost(loop: OuterLoop, s: LoopState) -> Controller:
    """A copy of the core that tracks the reference in force in the state s of the outermost loop.

    An observer of outputs starts from the error of the reference in force, not of h alone.
    """
    core: Controller = loop
    while isinstance(core, OuterLoop):
        core = core.inner
    return tracking(core, reference_in_force(loop, s))


def core_state(controller: Controller, s: Any) -> Any:
    """The state of the core, in a state s of the outermost loop `controller`."""
    return core_state(controller.inner, s.inner) if isinstance(controller, OuterLoop) else s


def with_core(controller: Controller, s: Any, core: Any) -> Any:
    """The state s of the outermost loop `controller` with `core` as the state of the core in it."""
    if not isinstance(controller, OuterLoop):
        return core
    return s._replace(inner=with_core(controller.inner, s.inner, core))
