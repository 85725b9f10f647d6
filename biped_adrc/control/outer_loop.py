"""Outer loops: around a controller that tracks a virtual constraint, a state that corrects the constraint.

    h_in_force(Theta) = h(Theta) + c(Theta; w),   s = (s_inner, w)

w is the loop's own state; it changes at impact, and between impacts only by `own_flow`. The inner controller,
whichever it is, tracks the sum. Outer loops can be nested: their corrections add up.

An inner loop drives q_b - h(Theta) to zero, and cannot change how the zero dynamics respond to a push; an
outer loop does so by changing h. The inner controller itself is not changed: at each call a copy of it tracks
the corrected constraint. The core, inside all loops, starts and jumps last, when all corrections are known,
since an observer of outputs starts from the error of the reference in force.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from biped_adrc.control.around import Around
from biped_adrc.control.base import Controller, Measurement, nested
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import with_fields
from biped_adrc.core.types import Array, Indices
from biped_adrc.gait.constraint import CorrectedConstraint, Correction, VirtualConstraint
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.observers.base import ErrorSystem, Estimate

Constraint = VirtualConstraint | CorrectedConstraint


@dataclass(frozen=True)
class OuterLoop(Around):
    """Base of all outer loops. Raises InputError when `inner` has no virtual constraint as `reference`."""

    reads_impulse: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        tracked_constraint(self.inner)

    @property
    @abstractmethod
    def own_size(self) -> int:
        """Number of the loop's own states w."""

    @abstractmethod
    def own_start(self, h: Constraint, m: Measurement) -> Array:
        """w (own_size,) at the start of a run; h is the constraint that the inner controller tracks."""

    @abstractmethod
    def own_jump(self, w: Array, h: Constraint, after: Measurement) -> Array:
        """w (own_size,) after impact, from w before it; h is the constraint that the
        inner controller then tracks.
        """

    @abstractmethod
    def correction(self, w: Array) -> Correction:
        """The correction c(Theta; w) for this w (own_size,), a function of Theta [rad].

        It returns c, dc/dTheta, d2c/dTheta2, each (p,).
        """

    def own_flow(self, w: Array) -> Array:
        """w' (own_size,) in continuous time; zero by default."""
        return np.zeros(self.own_size)

    def own_correct(self, w: Array, m: Measurement) -> Array:
        """w (own_size,) after the measurement of a sample instant; unchanged by default."""
        return w

    def parts(self, s: Array) -> tuple[Array, Array]:
        """s_inner, and w (own_size,), which is the end of s."""
        end = len(s) - self.own_size
        return s[:end], s[end:]

    def _acting(self, w: Array) -> Controller:
        """The inner controller with its constraint corrected by c(Theta; w)."""
        return with_correction(self.inner, self.correction(w))

    # -- what a controller does ------------------------------------------------------------------
    def output(self, s: Array, m: Measurement) -> Array:
        z, w = self.parts(s)
        return self._acting(w).output(z, m)

    def initial_state(self, m: Measurement) -> Array:
        z = self.inner.initial_state(m)
        s = np.concatenate((z, self.own_start(reference_in_force(self.inner, z), m)))
        core, end = innermost(self, s)
        return np.concatenate((core.initial_state(m), s[end:]))

    def flow(self, s: Array, m: Measurement, u: Array) -> Array:
        z, w = self.parts(s)
        dz = self._acting(w).flow(z, m, u) if len(z) else z
        return np.concatenate((dz, self.own_flow(w)))

    def correct(self, s: Array, m: Measurement) -> Array:
        z, w = self.parts(s)
        return np.concatenate((self._acting(w).correct(z, m), self.own_correct(w, m)))

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        z, w = self.parts(s)
        return np.concatenate((self._acting(w).predict(z, m, u), w))

    def jump(self, s: Array, after: Measurement, swap: Indices) -> Array:
        z, w = self.parts(s)
        z = self.inner.jump(z, after, swap)
        state = np.concatenate((z, self.own_jump(w, reference_in_force(self.inner, z), after)))
        core, end = innermost(self, state)
        return np.concatenate((core.jump(s[:end], after, swap), state[end:]))

    def error_system(self) -> ErrorSystem | None:
        return self.inner.error_system()

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        return self.inner.estimate(self.parts(s)[0], m)


OF_A_LOOP = "an outer loop corrects the virtual constraint of its inner controller"


def tracked_constraint(controller: Controller, why: str = OF_A_LOOP) -> VirtualConstraint:
    """The virtual constraint h of the controller inside all outer loops.

    Raises InputError, beginning with `why`, if it tracks none.
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
    """A copy of the controller, or of the one inside it (field `inner`), that tracks another reference."""
    if hasattr(controller, "reference"):
        return with_fields(controller, reference=reference)
    return with_fields(controller, inner=tracking(controller.inner, reference))  # type: ignore[attr-defined]


def reference_in_force(controller: Controller, s: Array) -> Constraint:
    """The reference that a controller tracks in its state s (size,), all corrections included.

    Raises InputError as `tracked_constraint`.
    """
    if isinstance(controller, OuterLoop):
        z, w = controller.parts(s)
        return CorrectedConstraint(
            reference_in_force(controller.inner, z), controller.correction(w)
        )
    return own_reference(controller) or tracked_constraint(controller)


def tracked_by(law: Controller, reference: Reference | OuterLoop) -> Reference | OuterLoop:
    """What errors are measured from: an outer loop, which corrects its reference, or a reference."""
    return law if isinstance(law, OuterLoop) else reference


def tracked_point(h: Reference | OuterLoop, s: Array, m: Measurement) -> ReferencePoint:
    """The point at the measurement m of a reference, or of what an outer loop with state s has in force."""
    r = reference_in_force(h, s) if isinstance(h, OuterLoop) else h
    return r(m.t, m.q, m.v)


def innermost(loop: OuterLoop, s: Array) -> tuple[Controller, int]:
    """The controller inside all outer loops, tracking the reference in force in s
    (size,), and its number of states.

    Its states are the first ones of s. An observer of outputs starts from the error of the
    reference in force, not of h alone.
    """
    core: Controller = loop
    size = len(s)
    while isinstance(core, OuterLoop):
        size, core = size - core.own_size, core.inner
    return tracking(core, reference_in_force(loop, s)), size


def with_correction(controller: Controller, correction: Correction) -> Controller:
    """A copy of the controller, inside whatever outer loops, that tracks its constraint plus a correction."""
    if isinstance(controller, OuterLoop):
        return with_fields(controller, inner=with_correction(controller.inner, correction))
    return tracking(controller, CorrectedConstraint(own_reference(controller), correction))
