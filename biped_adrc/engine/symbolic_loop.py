"""The closed loop on symbols: what `closed_loop.semantics` is given so that its lines become generated code."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import NamedTuple, TypeVar

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.protocols import ControlLaw, Mode
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.engine.mechanics import PlanarRobot
from biped_adrc.engine.symbols import Scalar, Vector, maximum, minimum, where
from biped_adrc.engine.tracer import Located, Tracer, run
from biped_adrc.hardware.sample_hold import HeldParts
from biped_adrc.observers.base import Estimate
from biped_adrc.types import Array, Indices

T = TypeVar("T")


def on_symbols(trace: Tracer, controller: Controller, p: int, size: int) -> ControlLaw:
    """The methods of a controller on symbols.

    Raises Located for a method that gives another number than p torques or `size` numbers of the
    state, since generated code could not notice.
    """
    twin = trace.on_symbols(controller)

    def checked(name: str, expected: int) -> Callable[..., Array]:
        def called(*arguments: object) -> Array:
            found = run(trace, getattr(twin, name), *arguments)
            if np.shape(found) != (expected,):
                raise Located(
                    f"{type(controller).__name__}.{name} gives an array of shape {np.shape(found)}, "
                    f"expected ({expected},)"
                )
            return found

        return called

    def estimate(s: Array, m: Measurement) -> Estimate | None:
        return run(trace, twin.estimate, s, m)

    flow, jump, correct, predict = (
        checked(name, size) for name in ("flow", "jump", "correct", "predict")
    )
    return ControlLaw(checked("output", p), flow, jump, correct, predict, estimate)


class SymbolicLoop(NamedTuple):
    """A `protocols.Loop` of symbols; zeta (n,) [N m] and `force` (2,) [N] are inputs."""

    plant: PlanarRobot
    """The robot that moves, on symbols."""
    nominal: PlanarRobot
    """The controller's model, on symbols; the same ones where it is the plant."""
    exact: bool
    """Whether the controller's model is the plant."""
    calls: ControlLaw
    """The controller's methods in its time base."""
    held: HeldParts | None
    """Parameters of what is held between sample instants, None in continuous time."""
    swap: Indices
    """Relabelling of the actuated joints (p,), numbers of the structure."""
    gain: Array
    """Relative errors of v+ (n,) [1], or empty."""
    limit: float
    """Torque limit [N m]."""
    strongest: float
    """Torque beyond which the run ends [N m]."""
    torques: list[Scalar]
    """All torques so far that must not be beyond it."""
    zeta: Array
    force: Array
    """From outside on the robot as a whole."""
    moves: bool = False
    """Whether the plant moves by itself: then `force` are the forces on its feet [N]."""

    def measure(self, t: float, q: Array, v: Array, mode: Mode) -> Measurement:
        """With the body's terms always, at q (n,) [rad], v (n,) [rad/s]: what no method asks
        for leaves no code.
        """
        return semantics.measurement(self, t, q, v, mode, body=True)

    def saturate(self, u: Array) -> Array:
        """u (p,) [N m] within the limit, which may be infinite."""
        return np.array([minimum(maximum(x, -self.limit), self.limit) for x in u], dtype=object)

    def jumped(self, fires: float, s: Array, m: Measurement) -> Array:
        """s after the controller's jump to the measurement m where `fires` is 1, else s as it is."""
        after = self.calls.jump(s, m, self.swap)
        return np.array(
            [where(fires > 0.5, a, b) for a, b in zip(after, s, strict=True)], dtype=object
        )

    def foot_forces(
        self, t: float, q: Array, v: Array, tail: Array, mode: Mode
    ) -> tuple[float, float]:
        """Vertical forces of the ground on stance and swing foot [N]."""
        if self.moves:
            return self.force[0], self.force[1]
        return semantics.on_stance_foot(self, self.force, t, q, v, tail, mode)

    def bounded(self, u: Array) -> Array:
        """u (p,) [N m] itself, kept for `lost`."""
        self.torques.extend(u)
        return u

    def lost(self, least: Scalar) -> Scalar:
        """What a function adds to its result: the least pivot; -1 where a finite torque is beyond the bound."""
        if not self.torques:
            return least
        u = functools.reduce(maximum, map(abs, self.torques))
        return where((u > self.strongest) * (u < math.inf) * (least > 0.0), -1.0, least)

    def external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        """The symbols of zeta (n,) [N m]."""
        return self.zeta


class SymbolicInstant(NamedTuple):
    """The symbols of one instant, and the loop that they are given to."""

    inp: Vector
    """All inputs, as one vector."""
    trace: Tracer
    """Makes copies of functions for symbols, and keeps the pivots."""
    loop: SymbolicLoop
    t: float
    x: Array
    """State (nx,)."""
    mode: Mode
    """Single support and its start, symbols too."""

    @property
    def lost(self) -> Scalar:
        """What a function adds to its result, see `SymbolicLoop.lost`."""
        return self.loop.lost(self.trace.solver.least)

    def does(self, function: Callable[..., T], *more: object) -> T:
        """What a function of `semantics`, or one with the same first arguments, gives here."""
        return self.trace(function)(self.loop, self.t, self.x, self.mode, *more)
