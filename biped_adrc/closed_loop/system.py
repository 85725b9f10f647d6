"""A closed loop in NumPy as a hybrid system; what `Walker` and `ArmSystem` have in common.

`reading` is what can be read off any closed loop at one instant; NumPy and compiled code share its source.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.semantics import Instant, Loop, Mode, Plant, instant, unknown
from biped_adrc.control.base import Controller, Measurement, check_output, check_state, misshapen
from biped_adrc.control.tracking import Gains
from biped_adrc.errors import BipedError, InputError, NotFiniteError, SimulationError
from biped_adrc.gait.reference import Reference, ReferencePoint, check_point
from biped_adrc.hardware import sample_hold as held
from biped_adrc.hardware.meter import MeterParameters, Outside
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sample_hold import Held, HeldParameters
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.hybrid.system import Clock, HybridSystem
from biped_adrc.model.reduction import disturbance_parts
from biped_adrc.parts import check_fields
from biped_adrc.timing import ContinuousTime, SampledTime, check_timing
from biped_adrc.types import Array

P = TypeVar("P", bound=Plant)


class ClosedLoop(HybridSystem, Generic[P]):
    """`semantics` for arrays, with a plant, a controller, its timing, and the model that it knows."""

    plant: P
    controller: Controller
    timing: ContinuousTime | SampledTime
    model: P | None
    sensors: Sensors | None = None
    motors: Motors | None = None

    def check(self) -> None:
        """Raise InputError for a part that is none, or a model with another number of coordinates."""
        check_timing(self.timing)
        check_fields(self)
        if self.nominal.n != self.plant.n:
            raise InputError(
                f"the model has {self.nominal.n} coordinates, the plant {self.plant.n}; they must agree"
            )

    # -- parts -------------------------------------------------------------------------------------
    @cached_property
    def nominal(self) -> P:
        """The model the controller knows; the plant itself when none was given."""
        return self.plant if self.model is None else self.model

    @property
    def exact(self) -> bool:
        """Whether the model the controller knows is all that there is."""
        return self.model is None

    @cached_property
    def law(self) -> Controller:
        """The controller in this time base."""
        if isinstance(self.timing, SampledTime):
            return self.controller.sampled(self.timing.period)
        return self.controller

    @property
    def sampled(self) -> bool:
        """Whether a torque is held between ticks."""
        return isinstance(self.timing, SampledTime)

    @cached_property
    def held(self) -> HeldParameters | None:
        """What is held between ticks; None in continuous time."""
        time, n, p = self.timing, self.plant.n, self.plant.p
        if not isinstance(time, SampledTime):
            return None
        given = (self.sensors, self.motors, self.metering(time), self.own)
        return held.held_parameters(n, p, time, *given)

    @property
    def own(self) -> int:
        """How many numbers a plant that moves by itself keeps."""
        return 0

    def metering(self, timing: SampledTime) -> MeterParameters | None:
        """Of the meter; None without one."""
        return None

    @property
    def limit(self) -> float | Array | None:
        """Largest torque of the motors, one number or (p,) [N m]; None for none."""
        return None

    @cached_property
    def torques(self) -> tuple[int]:
        """Shape of u."""
        return (self.plant.p,)

    @property
    def gain(self) -> Array:
        """As `semantics.Loop`."""
        return np.zeros(0)

    @property
    def swap(self) -> Any:
        """As `semantics.Loop`."""
        return np.arange(self.plant.p)

    def external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        """zeta (n,) [N m]."""
        return np.zeros(self.plant.n)

    def outside(self, t: float, mode: Mode) -> Outside:
        """As `semantics.Loop`."""
        return Outside(np.zeros(2), np.zeros(2), 0.0)

    # -- the state ---------------------------------------------------------------------------------
    @cached_property
    def behind(self) -> int:
        """How many numbers of x come after the controller's state."""
        return 0 if self.held is None else self.held.sizes.total

    def controller_size(self, x: Array | int) -> int:
        """Numbers in s, from x or its length."""
        length = x if isinstance(x, int) else len(x)
        return length - 2 * self.plant.n - self.behind

    def split_state(self, x: Array) -> tuple[Array, Array, Array]:
        """q, v, s of x."""
        return semantics.parts(self, x)[:3]

    def held_at(self, x: Array) -> Held:
        """What x holds between ticks, in sampled time."""
        assert self.held is not None
        return held.read(self.held.sizes, x[len(x) - self.behind :])

    def initial_state(self, q: Array, v: Array, mode: Mode | None = None) -> Array:
        """x at the start of single support in (q, v). Raises InputError for a controller that does not fit."""
        mode = Mode() if mode is None else mode
        m = self.measure(mode.start, np.asarray(q, dtype=float), np.asarray(v, dtype=float), mode)
        for part in _with_inner(self.law):
            _check_tracking(part, m, self.plant.p)
        s, k = self.law.initial_state(m), self.held
        u = np.asarray(self.law.output(s, m))
        check_output(self.controller, u, self.plant.p)
        check_state(self.law, s, m, u)
        tail = np.zeros(0) if k is None else held.at_start(k, m.q, m.v, self.sensors)
        return np.concatenate((m.q, m.v, s, tail))

    # -- what it does --------------------------------------------------------------------------------
    def measure(self, t: float, q: Array, v: Array, mode: Mode) -> Measurement:
        """What the controller is given at (t, q, v)."""
        return semantics.measurement(self, t, q, v, mode, self.law.needs_body)

    def saturate(self, u: Array) -> Array:
        """u within the torque limit. Raises NotFiniteError, SimulationError for another number of torques."""
        u, limit = np.asarray(u, dtype=float), self.limit
        if u.shape != self.torques:
            raise SimulationError(misshapen(self.controller, u, self.plant.p))
        if limit is not None:
            u = np.minimum(np.maximum(u, -limit), limit)
        if not math.isfinite(u.dot(u)):
            raise NotFiniteError(f"{type(self.controller).__name__}.output returned {u} N m")
        return u

    def instant(self, t: float, x: Array, mode: Mode) -> Instant:
        """Measurement, torque, force and acceleration at (t, x)."""
        return semantics.instant(self, t, x, mode)

    def unknown(self, i: Instant) -> Array:
        """xi~ of (11) (n,) [N m]: zeta, and with a plant that is not the model all that is wrong with it."""
        return semantics.unknown(self, i.measurement.terms, i.a, i.u, i.zeta)

    def flow(self, t: float, x: Array, mode: Mode) -> Array:
        return semantics.flow(self, t, x, mode)

    def tick(self, t: float, x: Array, mode: Mode) -> Array:
        """x after a tick of the control clock: sensors, controller, line of torques, meter."""
        return semantics.tick(self, t, x, mode)

    def _release(self, t: float, x: Array, mode: Mode) -> Array:
        return semantics.release(self, x)

    def clocks(self) -> tuple[Clock, ...]:
        time, k = self.timing, self.held
        if not isinstance(time, SampledTime) or k is None:
            return ()
        control = Clock("control", time.period, self.tick, time.restart)
        if not k.sizes.waiting:
            return (control,)
        after = k.motors.fraction * time.period
        return (control, Clock("motors", time.period, self._release, time.restart, after))


def _with_inner(controller: Controller | None) -> Iterator[Controller]:
    """A controller, and those inside it."""
    while controller is not None:
        yield controller
        controller = getattr(controller, "inner", None)


def _check_tracking(controller: Controller, m: Measurement, p: int) -> None:
    """Raise InputError for a reference or gains of a robot with other joints than p motors, len(m.q) in all."""
    gains, reference = (getattr(controller, name, None) for name in ("gains", "reference"))
    if isinstance(gains, Gains):
        gains.check(p)
    if not isinstance(reference, Reference):
        return
    try:
        point = reference(m.t, m.q, m.v)
    except BipedError:
        raise
    except (ValueError, IndexError, TypeError) as error:
        raise InputError(
            f"the {type(reference).__name__} of {type(controller).__name__} cannot be evaluated at the "
            f"{len(m.q)} coordinates of this robot: {error}; expected one of this robot, such as the "
            "constraint of a gait that was designed for it"
        ) from error
    check_point(reference, point, p, len(m.q))


class Reading(NamedTuple):
    """At one instant, or at N of them with N rows; meanings as in `analysis.signals.Signals`."""

    a: Any
    q_d: Any
    dq_d: Any
    u: Any
    zeta: Any
    xi: Any
    xi_estimate: Any
    xi_external: Any
    xi_matched: Any
    xi_nominal: Any
    zeta_estimate: Any
    ground_reaction: Any
    """Forces from outside not yet taken off."""
    kinetic: Any
    potential: Any
    """Zero at the height of this stance foot."""
    swing_foot: Any
    hip: Any


def reading(
    loop: Loop,
    t: float,
    x: Array,
    mode: Mode,
    reference: Callable[[Array, Measurement], ReferencePoint],
) -> Reading:
    """At (t, x); reference(s, m) is what is looked at, usually what the controller tracks."""
    i = instant(loop, t, x, mode)
    m, plant, terms, p = i.measurement, loop.plant, i.measurement.terms, loop.plant.p
    r, estimate = reference(i.s, m), loop.law.estimate(i.s, m)
    xi_estimate = np.full(p, np.nan) if estimate is None else estimate.disturbance
    matched, unmatched = disturbance_parts(terms, unknown(loop, terms, i.a, i.u, i.zeta))
    return Reading(
        a=i.a,
        q_d=r.q_d,
        dq_d=r.dq_d,
        u=i.u,
        zeta=i.zeta,
        xi=i.a[:p] - terms.kappa @ i.u,
        xi_estimate=xi_estimate,
        xi_external=matched + unmatched,
        xi_matched=matched,
        xi_nominal=terms.xi,
        zeta_estimate=terms.kappa_inverse @ (xi_estimate - terms.xi),
        ground_reaction=plant.ground_reaction(m.q, m.v, i.a),
        kinetic=plant.kinetic_energy(m.q, m.v),
        potential=plant.potential_energy(m.q),
        swing_foot=plant.swing_foot(m.q),
        hip=plant.hip(m.q),
    )
