"""A closed loop on NumPy arrays, as a hybrid system that a simulator can run.

`ClosedLoop` has what `Walker` and `SteppingLoop` share: a plant, a controller in its time base (continuous or
sampled), the model that the controller knows, and the methods of `hybrid.system.HybridSystem`, each of which
calls the function of `closed_loop.semantics` with the same name. It adds what pure functions cannot do: checks
of what a user's controller returns, with sentences that name the culprit. A tick is a sample instant. In all
methods

    x (nx,)         state: (q, q', s), and in sampled time behind it the tail, what is held between ticks
    q, v = q'       coordinates (n,) [rad] and rates (n,) [rad/s]; the first p coordinates have motors
    s, m            the controller's state, with that of an observer; a measurement, as the controller gets it
    u, zeta         torques of the motors (p,) [N m]; disturbance, a generalised force (n,) [N m]
    mode            the single support: its number from 1 (step), and the time [s] at which it began (start)
    t               time since the start of the run [s]

A layout (`core.tree.Layout`) says which numbers of a vector belong to which part of a state.

Every signal of one instant is in `closed_loop.instant_signals`.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Generic, NamedTuple, Self, TypeVar, cast

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.protocols import ControlLaw, FootForces, Mode, Plant
from biped_adrc.closed_loop.semantics import Instant, State
from biped_adrc.control.base import Controller, Measurement, check_methods, has_own_class, nested
from biped_adrc.control.tracking import Gains
from biped_adrc.core.checks import PositiveFloat, check_fields, handing_out, returned
from biped_adrc.core.errors import BipedError, InputError, RanAwayError
from biped_adrc.core.part import once, shared
from biped_adrc.core.timing import ContinuousTime, SampledTime, check_ends
from biped_adrc.core.tree import Layout, flatten, returned_tree
from biped_adrc.core.types import Array, frozen, read_only
from biped_adrc.disturbances.base import NO_PUSH, Disturbance
from biped_adrc.gait.reference import Reference, check_point
from biped_adrc.hardware.motors import IDEAL, Motors
from biped_adrc.hardware.sample_hold import HeldParts, Tail
from biped_adrc.hardware.sensing import Sensing, Sensor
from biped_adrc.hardware.touchdown import Touchdown
from biped_adrc.hybrid.system import Clock, HybridSystem, Relaxing
from biped_adrc.model.biped import Biped

RUNAWAY_RATE = 50.0
"""Rate of a joint or of the pitch of which runaway_speed is a multiple [rad/s]."""


class _Bounds(NamedTuple):
    """The largest angles, rates and torques that a run may have."""

    farthest: float
    """Angle of a joint or of the pitch [rad]; infinite for none."""
    fastest: Array
    """Rates (n,) [rad/s]; infinite for none."""
    strongest: float
    """Torque [N m]; infinite for none."""

    def check(self, t: float, q: Array, v: Array) -> None:
        """Raise RanAwayError for an angle in q (n,) [rad] or a rate in v (n,) [rad/s] beyond its bound; t [s]
        is for the text."""
        if np.all((np.abs(q) <= self.farthest) & (np.abs(v) <= self.fastest)):
            return
        # the largest angle, and the rate that is the largest share of its bound
        i, j = int(np.argmax(np.abs(q))), int(np.argmax(np.abs(v) / self.fastest))
        if abs(q[i]) > self.farthest:
            raise RanAwayError(f"t = {t:.6g} s: q{i + 1} is {q[i]:.3g} rad, beyond a whole turn")
        beyond = f"|q{j + 1}'| is {abs(v[j]):.3g} rad/s, above {self.fastest[j]:.3g} rad/s"
        raise RanAwayError(f"t = {t:.6g} s: {beyond}")


_P = TypeVar("_P", bound=Plant)


MADE_AGAIN = ("held", "calls", "layout", "undisturbed", "_once")
"""Attributes in which a loop remembers what it has computed; a copy in another process computes them again."""


@dataclass(frozen=True)
class ClosedLoop(HybridSystem, Generic[_P]):
    """`semantics` on NumPy arrays: a plant, a controller with its timing, and its model of the plant.

    - plant: the robot that moves. model: the robot as the controller knows it; None: the plant itself.
    - controller, timing: in continuous time, or sampled with a period, a delay and restart at impacts.
    - disturbance: zeta (n,) [N m] and forces from outside; None for none.
    - torque_limit [N m]: saturates every motor; the observer is fed the torque applied, not the one asked for.
    - sensors, motors: between controller and plant; in sampled time only.
    - touchdown: the detector by which the controller notices one, in sampled time with restart=False; None: it
      knows each one at once.
    - runaway_speed, runaway_torque [1]: the run ends as run away beyond so many times 50 rad/s, or the peak
      torque of the robot's record; infinite for no end. A joint that turns by more than a whole turn ends it,
      too.

    Raises InputError for values that do not fit together, such as sensors in continuous time.
    """

    plant: _P
    controller: Controller
    disturbance: Disturbance | None = None
    timing: ContinuousTime | SampledTime = ContinuousTime()  # noqa: RUF009
    model: _P | None = None
    torque_limit: PositiveFloat | None = None
    sensors: Sensor | None = None
    motors: Motors | None = None
    touchdown: Touchdown | None = None
    runaway_speed: float = 20.0
    runaway_torque: float = 1000.0

    def __post_init__(self) -> None:
        """Raise InputError for values that do not fit together; see the class."""
        check_fields(self)
        # a longest single support and a height of a fall are a walker's: these two values pass the check
        check_ends(math.inf, 0.0, self.runaway_speed, self.runaway_torque)
        n, model = self.plant.n, self.nominal.n
        if model != n:
            raise InputError(f"the model has {model} coordinates, the plant {n}; they must agree")
        if not self.sampled and (self.sensors or self.motors):
            raise InputError(
                f"sensors and motors work in sampled time, found {type(self.timing).__name__}; give "
                "timing=SampledTime(period)"
            )
        if self.touchdown is not None:
            check_noticing(self.timing, self.nominal)
        _ = self.law  # which refuses a controller without a form for this time base

    # -- parts -------------------------------------------------------------------------------------
    @cached_property
    def nominal(self) -> _P:
        """The model the controller knows; the plant itself when none was given."""
        return self.plant if self.model is None else self.model

    @cached_property
    def undisturbed(self) -> Self:
        """The loop without disturbance; loops that differ in that alone share it, and what it remembers."""
        return shared(self, disturbance=None)

    @property
    def exact(self) -> bool:
        """Whether the controller knows the plant: no other model is given and the plant has no friction."""
        return self.model is None and not getattr(self.plant, "friction", False)

    @cached_property
    def law(self) -> Controller:
        """The controller in the form for this time base, continuous or sampled with this period."""
        if isinstance(self.timing, SampledTime):
            return self.controller.at_ticks(self.timing.period)
        return self.controller.continuous()

    @cached_property
    def calls(self) -> ControlLaw:
        """The methods of `law`, wrapped so that the states which they return are checked for class, shape and
        finite numbers. `output` is not wrapped, since `saturate` checks the torque, and the s' that `flow`
        returns may be infinite, since the integrator checks the state."""
        law = self.law

        def kept(name: str, finite: bool = True) -> Callable[..., Any]:
            method = getattr(law, name)
            # a method of the base class, which no subclass has written, needs no check
            if getattr(type(law), name) is getattr(Controller, name):
                return method

            # more: for `flow` and `predict` the torque, for `jump` the relabelling, handed on read-only
            def after(s: Any, m: Measurement, *more: Array) -> Any:
                result = method(s, m, *map(frozen, more))
                if result is s:  # nothing to check
                    return s
                return frozen(returned_tree(result, Layout.of(s), law, name, finite))

            return after

        jump, correct, predict = map(kept, ("jump", "correct", "predict"))
        flow = kept("flow", finite=False)
        return ControlLaw(law.output, flow, jump, correct, predict, law.estimate)

    @property
    def sampled(self) -> bool:
        """Whether the controller acts at ticks and its torque is held between them."""
        return isinstance(self.timing, SampledTime)

    @property
    def clock(self) -> SampledTime:
        """Sampling period and delay [s] of a loop in sampled time."""
        return cast(SampledTime, self.timing)

    @cached_property
    def held(self) -> HeldParts | None:
        """Sensors, motors and detector at sample instants, which hold numbers between these
        (`hardware.sample_hold`); None in continuous time."""
        time, n, p = self.timing, self.plant.n, self.plant.p
        if not isinstance(time, SampledTime):
            return None
        return _held(time, self.motors or IDEAL, self.sensors, self.touchdown, n, p, self.own)

    def __getstate__(self) -> dict[str, object]:
        """What pickle copies: the fields without cached values, which another process computes again."""
        return {name: value for name, value in vars(self).items() if name not in MADE_AGAIN}

    @property
    def own(self) -> int:
        """How many numbers of x a plant that moves by itself keeps for its own use; 0 for all others."""
        return 0

    @cached_property
    def bounds(self) -> _Bounds:
        """Angles, rates and torque beyond which the run ends as run away. They are infinite where neither plant
        nor model is a Biped; that of the torque also without motors."""
        robot: Any = self.plant if isinstance(self.plant, Biped) else self.nominal
        if not isinstance(robot, Biped):
            return _Bounds(math.inf, read_only(np.full(self.plant.n, math.inf)), math.inf)
        fastest = read_only(np.full(robot.n, self.runaway_speed * RUNAWAY_RATE))
        peak = robot.description.peak_torque if robot.p else math.inf
        # an angle may come to a whole turn, which is more than cables and legs allow
        return _Bounds(2.0 * math.pi, fastest, self.runaway_torque * peak)

    def external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        """zeta (n,) [N m] of the disturbance at t [s], q (n,) [rad], v (n,) [rad/s]; zeros without one. Raises
        InputError where a user's disturbance returns no row of n numbers, NotFiniteError for NaN."""
        return (self.disturbance or NO_PUSH).zeta(t, mode.step, mode.start, q, v)

    def resultant(self, t: float, mode: Mode) -> Array:
        """Force (x, z) from outside on the robot as a whole (2,) [N] at t [s]; with it the ground's force
        balances m (p_com'' - g)."""
        return (self.disturbance or NO_PUSH).net_force(t, mode.step, mode.start)

    def switching_times(self, mode: Mode) -> tuple[float, ...]:
        """Times of the run [s] at which the disturbance is not smooth in the single support `mode`; no
        integration step goes across one."""
        return (self.disturbance or NO_PUSH).switching_times(mode.step, mode.start)

    # -- the state ---------------------------------------------------------------------------------
    def layout_of(self, x: Array) -> Layout:
        """The layout of a state x (nx,) as a `semantics.State`, the same for all states of the loop. Found
        once, by starting the controller at the (q, v) in x, then remembered as an attribute."""
        # by vars(), as fields of a frozen dataclass cannot be set
        if "layout" not in vars(self):
            n, mode = self.plant.n, Mode()
            m = self.measure(mode.start, x[:n], x[n : 2 * n], mode)
            vars(self)["layout"] = Layout.of(self._begun(m, self.law.initial_state(m), mode))
        return vars(self)["layout"]

    def _begun(self, m: Measurement, s: Any, mode: Mode) -> State:
        """The state at the start of a run with measurement m and controller's state s; no torque acts yet."""
        # *mode: number and start of the single support; () is the tail in continuous time
        return State(m.q, m.v, s, () if self.held is None else self.held.start(m.q, m.v, *mode))

    def split_state(self, x: Array) -> tuple[Array, Array, Any]:
        """q (n,) [rad], v (n,) [rad/s] and the controller's state s in x (nx,)."""
        return semantics.parts(self, x)[:3]

    def initial_state(self, q: Array, v: Array, mode: Mode | None = None) -> Array:
        """x (nx,) at the start of the single support `mode` (by default the first one, at 0 s) in q (n,) [rad],
        v (n,) [rad/s]. Here, once, the controller's first output, its state's methods and its reference are
        tried: raises InputError for shapes that do not fit, NotFiniteError for a first torque that is NaN."""
        mode = Mode() if mode is None else mode
        q, v = (np.asarray(x, dtype=float) for x in (q, v))
        # without the disturbance, which does not matter here, so that loops with different ones share the
        # result; shapes and bytes of q and v, since arrays cannot be the key of a result that is remembered
        x, layout = _start(self.undisturbed, mode, q.shape, q.tobytes(), v.shape, v.tobytes())
        vars(self).setdefault("layout", layout)
        return x.copy()

    # -- what it does --------------------------------------------------------------------------------
    def measure(self, t: float, q: Array, v: Array, mode: Mode) -> Measurement:
        """The measurement that the controller gets at t [s]; q (n,) [rad], v (n,) [rad/s] are what its sensors
        show. Raises InputError where they are not (n,) numbers each, NotFiniteError for NaN or infinity."""
        if self.sensors is not None:
            q, v = (returned(x, (self.plant.n,), self.sensors, "reading") for x in (q, v))
        return semantics.measurement(self, t, q, v, mode, self.law.needs_body)

    def saturate(self, u: Array) -> Array:
        """u (p,) [N m] with each entry bounded by the torque limit, if there is one. Raises InputError for what
        is not one real number per motor, NotFiniteError for NaN or infinity."""
        shape, limit = (self.plant.p,), self.torque_limit
        u = returned(u, shape, self.controller, "output", finite=False)
        if limit is not None:
            u = np.minimum(np.maximum(u, -limit), limit)
        # one product tests all of them, at every stage of every step; where it is not finite, `returned` raises
        if not math.isfinite(u.dot(u)):
            returned(u, shape, self.controller, "output")
        return u

    def jumped(self, fires: float, s: Any, m: Measurement) -> Any:
        """s after the controller's jump to m where `fires` is 1 (it notices a touchdown), else s as it is."""
        return self.calls.jump(s, m, self.plant.swap) if fires > 0.5 else s  # type: ignore[attr-defined]

    @cached_property
    def _own_hardware(self) -> bool:
        """Whether a class of the user's is among the sensors or is the detector."""
        parts = (*getattr(self.sensors, "parts", (self.sensors,)), self.touchdown)
        return any(has_own_class(part) for part in parts if part is not None)

    def checked(self, part: Any, method: str, before: Any, after: Any) -> Any:
        """The state `after` that a method of a sensor or detector returned, with arrays of floats. Raises
        InputError, with the user's line, for another class or shape than the state `before`."""
        if part is None or not self._own_hardware:
            return after
        if isinstance(part, Sensing) and method != "reading":  # a state of each sensor
            each = zip(part.parts, before, after, strict=True)
            return tuple([self.checked(x, method, *states) for x, *states in each])
        return frozen(returned_tree(after, Layout.of(before), part, method, finite=False))

    def foot_forces(self, t: float, q: Array, v: Array, tail: Tail, mode: Mode) -> FootForces:
        """Vertical forces of the ground on stance and swing foot [N], the latter 0: a plant whose stance foot
        is pinned, at t [s], q (n,) [rad], v (n,) [rad/s], under the torque in `tail`."""
        return semantics.on_stance_foot(self, self.resultant(t, mode), t, q, v, tail, mode)

    def bounded(self, u: Array) -> Array:
        """Return u (p,) [N m] unchanged. Raises RanAwayError where one of them is beyond the bound."""
        strongest = self.bounds.strongest
        # the product first, since it is fast: where it is within the bound, so is each entry
        if u.dot(u) > strongest**2 and np.max(np.abs(u)) > strongest:
            raise RanAwayError(f"torque {u} N m, above {strongest:.3g} N m")
        return u

    def instant(self, t: float, x: Array, mode: Mode) -> Instant:
        """The `Instant` at t [s] in the state x (nx,): measurement, torque, force and acceleration."""
        return semantics.instant(self, t, x, mode)

    def flow(self, t: float, x: Array, mode: Mode) -> Array:
        """x' (nx,) between events, at t [s]."""
        return semantics.flow(self, t, x, mode)

    def tick(self, t: float, x: Array, mode: Mode) -> Array:
        """x (nx,) after the sample instant at t [s]: sensors, controller and torques on their way have
        changed."""
        return semantics.tick(self, t, x, mode)

    def _release(self, t: float, x: Array, mode: Mode) -> Array:
        """x (nx,) just after the torque that waited for a fraction of the period has begun to act; t and mode
        are not used."""
        return semantics.release(self, x)

    def relaxing(self) -> Relaxing | None:
        """Places in x of the p torques of lagging motors, and of the commanded torques to which they go
        exponentially, the last p numbers of x; with 1 / lag [1/s]. None without lag."""
        k, p = self.held, self.plant.p
        if k is None or k.motors.speed == 0.0:
            return None
        # at: a negative index, counted from the end of x, where the line, the torques on their way, stands
        at = k.line.place("u_m").start - k.line.size
        return Relaxing(slice(at, at + p), slice(-p, None), k.motors.speed)

    def clocks(self) -> tuple[Clock, ...]:
        """The control clock, and for a delay of a fraction of the period a second one that releases the waiting
        torque; empty in continuous time."""
        time, k = self.timing, self.held
        if not isinstance(time, SampledTime) or k is None:
            return ()
        control = Clock("control", time.period, self.tick, time.restart)
        if k.motors.fraction == 0.0:
            return (control,)
        after = k.motors.fraction * time.period
        return (control, Clock("motors", time.period, self._release, time.restart, after))


def check_noticing(timing: ContinuousTime | SampledTime, model: object) -> None:
    """Raise InputError where the timing, or the controller's model, does not allow a detector of touchdowns."""
    if not isinstance(timing, SampledTime) or timing.restart:
        raise InputError(
            f"touchdowns are noticed at ticks of a clock that knows none of them, found {timing}; give "
            "timing=SampledTime(period, restart=False)"
        )
    if not all(hasattr(model, name) for name in ("R", "relabel", "swing_foot")):
        raise InputError(
            f"the model is a {type(model).__name__}, which has no feet; a controller that notices touchdowns "
            "needs one with R, relabel and swing_foot, such as Biped.load('rabbit')"
        )


@once
def _held(
    time: SampledTime,
    motors: Motors,
    sensor: Sensor | None,
    touchdown: Touchdown | None,
    n: int,
    p: int,
    own: int,
) -> HeldParts:
    """Compute `ClosedLoop.held` for n coordinates, p motors and `own` numbers of a plant that moves by itself.
    It is remembered in `time`, so that loops with equal parts share the result."""
    # drive: rate limit, lag and delay of the motors; line: torques on their way, here for their layout
    sensors = None if sensor is None else sensor.sampled(n, p, time.period)
    drive, line = motors.sampled(p, time.delay, time.period)
    known = time.delay_known and time.delay > 0.0
    return frozen(HeldParts(sensors, drive, touchdown, known, own, Layout.of(line)))


@once
def _start(loop: ClosedLoop[Any], mode: Mode, *start: Any) -> tuple[Array, Layout]:
    """Compute the x (nx,) of `ClosedLoop.initial_state`, and its layout, and check the controller there. start:
    shape and bytes of q, then those of v: arrays cannot be hashed, as keys of remembered results must be."""
    shapes, data = start[::2], start[1::2]  # the arrays of q and v again
    q, v = (np.frombuffer(x).reshape(shape) for shape, x in zip(shapes, data, strict=True))
    # no warning of NumPy: a number that is not finite raises an error here, or ends the walk later.
    # handing_out() raises an exception of the user's code again, as an error that names its line
    with handing_out(), np.errstate(over="ignore", invalid="ignore"):
        m = loop.measure(mode.start, q, v, mode)
        inside = list(nested(loop.law))  # the controller, and those inside it
        for part in inside:
            _check_tracking(part, m, loop.plant.p)
        # the innermost first, as a wrapper chooses between its states before they are checked
        for part in filter(has_own_class, reversed(inside[1:])):
            check_methods(part, part.initial_state(m), m, loop.sampled)
        # None: a state of any layout is right at the start; later ones have to have the same
        s = returned_tree(loop.law.initial_state(m), None, loop.law, "initial_state")
        check_methods(loop.law, s, m, loop.sampled)  # calls each method once
        state = loop._begun(m, s, mode)
        return flatten(state), Layout.of(state)


def _check_tracking(controller: Controller, m: Measurement, p: int) -> None:
    """Raise InputError where the gains or the reference of a controller, if it has any, do not fit p motors and
    the coordinates. The reference is evaluated at the measurement m for that; an exception in a user's
    reference names its line (`handing_out`)."""
    gains, reference = (getattr(controller, name, None) for name in ("gains", "reference"))
    if isinstance(gains, Gains):
        gains.check(p)
    if isinstance(reference, Reference):
        _check_reference(reference, type(controller).__name__, p, m.t, m.q.tobytes(), m.v.tobytes())


@once
def _check_reference(reference: Reference, law: str, p: int, t: float, q: bytes, v: bytes) -> None:
    """Evaluate the reference of a controller of the class `law` at t [s] and the bytes of q and v, and raise
    InputError where it does not fit p motors and the coordinates. What fits is remembered."""
    at = np.frombuffer(q), np.frombuffer(v)
    try:
        with handing_out():
            point = reference(t, *at)
    except BipedError:  # its text names the culprit already
        raise
    except (ValueError, IndexError, TypeError) as error:
        raise InputError(
            f"the {type(reference).__name__} of {law} cannot be evaluated at the "
            f"{len(at[0])} coordinates of this robot: {error}; expected one of this robot, such as the "
            "constraint of a gait that was designed for it"
        ) from error
    check_point(reference, point, p, len(at[0]))
