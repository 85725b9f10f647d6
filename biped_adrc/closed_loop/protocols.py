"""What a closed loop, its plant and its controller must offer to the functions of `closed_loop.semantics`.

A Protocol is a list of methods and properties: any class that has them will do.

Plants are `model.biped.Biped`, `model.planar_robot.PlanarRobot` and any of the user's own; loops
are `closed_loop.system.ClosedLoop` on arrays of NumPy and `engine.equations.SymbolicLoop` on symbols.

    q, v = q'     coordinates (n,) [rad] and rates (n,) [rad/s]; the first p coordinates have motors
    u, zeta       torques of the motors (p,) [N m]; disturbance, a generalised force (n,) [N m]
    B_s           (n, p), the identity over zeros: u acts on the first p coordinates
    D_s, Omega    mass matrix (n, n) [kg m^2]; Coriolis and gravity terms (n,) [N m]
    x (nx,)       state of a loop: q, q', the controller's state s, and what is held between sample instants

A plant that moves by itself, for instance MuJoCo or Drake behind a class of the user's, is a `SteppingPlant`:

    row = (q, q', own)                          the whole state (2 n + k,) [rad, rad/s, its own units]
    advance(t, row, u, load, until) -> Moved

own are k numbers that the plant needs besides (q, q') to continue from this state, such as the torques of
motors with a lag. `advance` moves the plant from the row at t [s] to the time `until` [s], or to the next
contact if that is earlier. The torque u (p,) [N m] and what acts from outside, a `Load` [N m, N] or None, are
constant over this time. `Moved` has the time [s] that was reached, the row there, and the contacts, if any.

`closed_loop.stepping.SteppingLoop` drives it. What breaks this contract is an InputError that names the plant's
class, what was found and what was expected. Values that are not finite pass: the loop ends the run with
NOT_FINITE, as for any plant.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from biped_adrc.control.base import Measurement
from biped_adrc.core.tree import Layout
from biped_adrc.core.types import Array, Indices
from biped_adrc.hardware.sample_hold import HeldParts, Tail
from biped_adrc.hybrid.status import Status
from biped_adrc.model.ground import StepDown, StepUp
from biped_adrc.model.reduction import Reduction
from biped_adrc.observers.base import Estimate


class Mode(NamedTuple):
    """The discrete state of a walk: in which single support it is.

    step: number of the single support, from 1. start [s]: time of the run at which it began.

    >>> ba.Mode(step=2, start=0.4)
    Mode(step=2, start=0.4)
    """

    step: int = 1
    start: float = 0.0


FootForces = tuple[float, float]
"""Vertical forces of the ground on stance and swing foot [N]."""


class Motored(Protocol):
    """A robot of n coordinates, of which the first p have motors."""

    @property
    def n(self) -> int:
        """Number of coordinates."""

    @property
    def p(self) -> int:
        """Number of motors; they act on the first p coordinates."""


class Plant(Motored, Protocol):
    """A robot: n coordinates, of which the first p have motors. q [rad], v [rad/s] and forces [N m] are (n,).

    This is enough for the controller's model of a plant that moves by itself. A walker on the rigid plant
    stands on one pinned foot and strikes the ground with the other: its plant also needs the methods that
    `model.biped.Biped` and `model.planar_robot.PlanarRobot` have in common.
    """

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms D_s, Omega, kappa, xi and more, of (11)-(15) of the paper, at q (n,) [rad], v (n,) [rad/s].
        The motors' rows are q_b'' = kappa u + xi."""

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under the generalised force B_s u + zeta (n,) [N m]; joint friction included."""


class ControlLaw(NamedTuple):
    """The functions of a controller in its time base (continuous or sampled) that a closed loop calls.

    s is the controller's state, m the measurement. On arrays they are the methods of `control.base.Controller`,
    whose results are checked; on symbols copies of these methods.
    """

    output: Callable[[Any, Measurement], Array]
    """output(s, m) -> torque asked for (p,) [N m], before saturation."""
    flow: Callable[[Any, Measurement, Array], Any]
    """flow(s, m, u) -> s' in continuous time, u (p,) [N m] the torque applied."""
    jump: Callable[..., Any]
    """jump(s, m, swap) -> s after an impact, with the measurement m after it and the relabelling swap (p,)."""
    correct: Callable[[Any, Measurement], Any]
    """correct(s, m) -> s at a sample instant, with the new measurement."""
    predict: Callable[[Any, Measurement, Array], Any]
    """predict(s, m, u) -> s at the next sample instant, u (p,) [N m] the torque that will act."""
    estimate: Callable[[Any, Measurement], Estimate | None]
    """estimate(s, m) -> the `Estimate` of the controller's observer, None without one."""


class Loop(Protocol):
    """The parts of a closed loop, and what acts on it from outside: all that `semantics` asks for."""

    @property
    def plant(self) -> Any:
        """The robot that moves: a `Plant` or `SteppingPlant`; with impacts, a `Biped` or `PlanarRobot`."""

    @property
    def nominal(self) -> Any:
        """The controller's model: a plant of the same kind, or the plant itself."""

    @property
    def exact(self) -> bool:
        """Whether the nominal model is the whole plant: no other model and no friction that it ignores. Then
        D_s and Omega are computed once for controller and motion."""

    @property
    def calls(self) -> ControlLaw:
        """The functions of the controller in its time base, continuous or sampled."""

    @property
    def held(self) -> HeldParts | None:
        """Parameters of what is held between sample instants; None in continuous time."""

    def layout_of(self, x: Array) -> Layout:
        """The layout of a state x (nx,): which numbers of it are which part of a `semantics.State`."""

    def measure(self, t: float, q: Array, v: Array, mode: Mode) -> Measurement:
        """The measurement that the controller gets at t [s] of q (n,) [rad], v (n,) [rad/s], as they are: the
        caller has applied the sensors."""

    def saturate(self, u: Array) -> Array:
        """u (p,) [N m] within the torque limit."""

    def jumped(self, fires: float, s: Any, m: Measurement) -> Any:
        """s after the controller's jump to the measurement m where `fires` is 1 (its detector has noticed a
        touchdown), else s as it is."""

    def checked(self, part: Any, method: str, before: Any, after: Any) -> Any:
        """The state `after` that a method of a sensor or detector returned; it has to have the layout of the
        state `before`."""

    def foot_forces(self, t: float, q: Array, v: Array, tail: Tail, mode: Mode) -> FootForces:
        """The forces of the ground at t [s], q (n,) [rad], v (n,) [rad/s], under the torque in `tail`, the held
        part of the state."""

    def bounded(self, u: Array) -> Array:
        """Return u (p,) [N m] unchanged; the run ends as run away where it is beyond what motors can give."""

    def external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        """The disturbance zeta (n,) [N m] at t [s]."""


# -- plants that move by themselves ----------------------------------------------------------------
class Load(NamedTuple):
    """The forces that act on a plant from outside at one instant."""

    zeta: Array
    """Generalised force (n,) [N m] of the coordinates q, with the stance foot held."""
    force: Array
    """Resultant (x, z) (2,) [N], which a base that floats feels too."""


class Contact(NamedTuple):
    """A touchdown, which ends a single support; or, with a status, what ends the run, such as a fall."""

    name: str
    """Name of the event in the trajectory."""
    impulse: Array = np.zeros(2)
    """Impulse (x, z) of the ground on the robot (2,) [N s]."""
    ends: Status | None = None
    """Status with which the run ends; None for a touchdown."""


class Moved(NamedTuple):
    """The result of `advance`: the time that a plant has reached, and its state there."""

    t: float
    """`until`, or the time of the contacts [s]."""
    row: Array
    """State (2 n + k,) at t, just before the contacts."""
    contacts: tuple[Contact, ...] = ()
    """All contacts at t. They are one event: names joined by +, impulses added. Where some of them end the run,
    only those count: a fall with a touchdown is a fall."""
    after: Array | None = None
    """State (2 n + k,) just after a touchdown; None where there is none."""


class Feet(NamedTuple):
    """Both feet at one time, the stance foot first; (x, z) of each."""

    force: Array
    """Forces of the ground on the feet (2, 2) [N]."""
    place: Array
    """Places of the foot points (2, 2) [m]."""
    speed: Array
    """Velocities of the points that touch the ground, or would touch it (2, 2) [m/s]."""
    level: Array
    """Heights of the ground under the feet (2,) [m]; 0 on ground without steps."""


@runtime_checkable
class SteppingPlant(Motored, Protocol):
    """A plant that moves by itself: n coordinates, the first p of them with motors. A row (2 n + k,) is its
    whole state (q, q', own); see the module. Arrays that it gets are read-only."""

    @property
    def swap(self) -> Indices:
        """Relabelling of the motors at a touchdown (p,): motor i gets entry swap[i] of (u, -u); `arange(p)` for
        none."""

    def start(self, t: float, q: Array, v: Array) -> Array:
        """The row at t [s] that begins with q (n,) [rad] and v (n,) [rad/s]; its own numbers, such as motor
        torques, are those of a plant that has not been moved yet."""

    def advance(self, t: float, row: Array, u: Array, load: Load | None, until: float) -> Moved:
        """Move from a row at t [s] to `until` [s] or to the next contact, under constant u (p,) [N m] and load;
        None for no load. Raises `hybrid.integrators.StepFailed` where it cannot go on, which ends the run with
        the status STEP_FAILED."""


@runtime_checkable
class OnFeet(Protocol):
    """A plant that can say what its feet do."""

    def footing(self, row: Array, u: Array, load: Load) -> Feet:
        """Force, place and velocity of both feet in the state `row` (2 n + k,), under the torques u (p,) [N m]
        asked of the motors and the load from outside."""


@runtime_checkable
class LaggingPlant(SteppingPlant, Protocol):
    """A plant whose motors may have a lag, so that the torque on its joints is not the commanded one."""

    @property
    def lag(self) -> float:
        """Time constant [s]; 0 for none."""

    def lagging(self, lag: float) -> SteppingPlant:
        """A copy of the plant whose motors have this lag [s]."""

    def motor_torque(self, own: Array, u: Array) -> Array:
        """Torque on the joints (.., p) [N m] that the motors produce, in states in which the plant's own
        numbers are `own` (.., k) and u (.., p) [N m] is asked of the motors."""


@runtime_checkable
class UnevenPlant(SteppingPlant, Protocol):
    """A plant whose ground may have steps up and down, each placed by the number of a single support."""

    @property
    def ground_steps(self) -> tuple[StepDown | StepUp, ...]:
        """The steps up and down of the ground."""

    def on_steps(self, steps: tuple[StepDown | StepUp, ...], first_step: int) -> SteppingPlant:
        """A copy of the plant on these steps of the ground; its first single support is number `first_step`."""
