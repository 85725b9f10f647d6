"""What a closed loop, its plant and its controller must offer to the functions of `closed_loop.semantics`.

Plants are `model.biped.Biped`, `engine.mechanics.PlanarRobot` and any of the user's own; loops
are `closed_loop.system.ClosedLoop` on arrays of NumPy and `engine.equations.SymbolicLoop` on symbols.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

from biped_adrc.control.base import Measurement
from biped_adrc.core.types import Array, Indices
from biped_adrc.hardware.sample_hold import HeldParts
from biped_adrc.model.reduction import Reduction
from biped_adrc.observers.base import Estimate


class Mode(NamedTuple):
    """The discrete state of a walk: single support `step` (from 1), which began at `start` [s].

    >>> ba.Mode(step=2, start=0.4)
    Mode(step=2, start=0.4)
    """

    step: int = 1
    start: float = 0.0


class Plant(Protocol):
    """What moves: n coordinates, of which the first p have motors. q [rad], v [rad/s] and forces
    [N m] are (n,).

    Enough for the model of a plant that moves by itself. A walker stands on the ground with one foot (pinned)
    and strikes it with the other: it needs the methods of `model.biped.Biped` that
    `engine.mechanics.PlanarRobot` has, too.
    """

    @property
    def n(self) -> int:
        """Number of coordinates."""

    @property
    def p(self) -> int:
        """Number of motors; they act on the first p coordinates."""

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms of (11)-(15) at q (n,) [rad] and v (n,) [rad/s]."""

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under the generalised force B_s u + zeta (n,) [N m]; joint friction included."""


class ControlLaw(NamedTuple):
    """The functions of a controller in its time base that a closed loop calls, parameters filled in.

    On arrays the methods of `control.base.Controller`, and what they give is checked; on symbols its twin's.
    """

    output: Callable[[Array, Measurement], Array]
    """output(s, m) -> torque asked for (p,) [N m], before saturation."""
    flow: Callable[[Array, Measurement, Array], Array]
    """flow(s, m, u) -> s' in continuous time, u (p,) [N m] the torque applied."""
    jump: Callable[..., Array]
    """jump(s, m, swap) -> s after an impact; m is the measurement after it."""
    correct: Callable[[Array, Measurement], Array]
    """correct(s, m) -> s at a sample instant, with the new measurement."""
    predict: Callable[[Array, Measurement, Array], Array]
    """predict(s, m, u) -> s at the next sample instant, u (p,) [N m] the torque that will act."""
    estimate: Callable[[Array, Measurement], Estimate | None]
    """estimate(s, m) -> what an observer inside says, None without one."""


class Loop(Protocol):
    """The parts of a closed loop, and what acts on it from outside: all that `semantics` asks for."""

    @property
    def plant(self) -> Any:
        """What moves: a `Plant`; a `Biped` or `PlanarRobot` where there are impacts."""

    @property
    def nominal(self) -> Any:
        """The controller's model: a plant of the same kind, or the plant itself."""

    @property
    def exact(self) -> bool:
        """Whether the nominal model is the whole plant: no other model and no friction that it ignores.

        Then D_s and Omega are computed once for controller and motion.
        """

    @property
    def calls(self) -> ControlLaw:
        """The functions of the controller in its time base."""

    @property
    def held(self) -> HeldParts | None:
        """Parameters of what is held between sample instants; None in continuous time."""

    @property
    def swap(self) -> Indices:
        """Relabelling of the actuated joints at an impact (p,), dtype int, as `types.relabelled` takes it."""

    @property
    def gain(self) -> Array:
        """Relative errors of the impact map: v+ = (1 + gain) v+, (n,) [1], or empty for none."""

    def measure(self, t: float, q: Array, v: Array, mode: Mode) -> Measurement:
        """What the controller is given at t [s], q (n,) [rad], v (n,) [rad/s]: `measurement`."""

    def saturate(self, u: Array) -> Array:
        """u (p,) [N m] within the torque limit."""

    def jumped(self, fires: float, s: Array, m: Measurement) -> Array:
        """s after the controller's jump to the measurement m where `fires` is 1, else s as it is."""

    def foot_forces(
        self, t: float, q: Array, v: Array, tail: Array, mode: Mode
    ) -> tuple[float, float]:
        """Vertical forces of the ground on stance and swing foot [N], under the torque held in `tail`."""

    def bounded(self, u: Array) -> Array:
        """u (p,) [N m] itself; ends the run where it is beyond anything that the motors have."""

    def external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        """The disturbance zeta (n,) [N m] at t [s]."""
