"""The walker: plant, controller, disturbance and timing make a hybrid system.

    q'' = f(q, q') + D_s^-1 (B_s u + zeta)        between impacts   (10)
    (q, q')+ = R Delta(q-, q'-)                   at foot strike    (10)

State x = (q, q', s) in continuous time, (q, q', s, u) in sampled time, where the held torque is part of
the state, and with sensors, motors or a meter what `hardware.held` has in front of u. The controller's terms
come from the nominal `model`, the motion from the `plant`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.control.base import Controller, Measurement, check_output, misshapen
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.errors import InputError, NotFiniteError, SimulationError
from biped_adrc.ground import StepDown, StepUp, check_slope
from biped_adrc.hardware import held
from biped_adrc.hardware.held import Held, HeldParameters
from biped_adrc.hardware.meter import Hit, Meter, loads, metered
from biped_adrc.hardware.motors import Line, Motors, acting, limited, mean_torque, sent
from biped_adrc.hardware.sensors import Sensors, sense
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import Clock, Guard, HybridSystem, Split
from biped_adrc.linear import solve
from biped_adrc.model.biped import Biped
from biped_adrc.model.reduction import Reduction, unknown_force
from biped_adrc.split import SplitLaws, error_laws, loop_laws, split_of
from biped_adrc.timing import ContinuousTime, SampledTime, check_ends, check_timing
from biped_adrc.types import Array

FOOT_STRIKE = "foot_strike"
LEAST_STEP = 1e-3
"""[m]: legs without knees cross with the swing foot at the ground; what is nearer than this is no step."""


class Mode(NamedTuple):
    """Single support `step` (from 1) that began at `start` [s]."""

    step: int = 1
    start: float = 0.0


class Instant(NamedTuple):
    """What acts at one state."""

    measurement: Measurement
    s: Array
    u: Array
    """Torque applied (p,) [N m]."""
    zeta: Array
    """External torque (n,) [N m]."""
    force: Array
    """B_s u + zeta (n,) [N m]."""
    a: Array
    """q'' (n,) [rad/s^2]."""


@dataclass(frozen=True)
class Walker(HybridSystem):
    """torque_limit [N m] saturates every motor; the observer is fed the torque applied.

    slope [rad]: of the ground, positive downhill. ground_steps: where it falls or rises by steps.
    sensors, motors, meter: what is between the controller and the plant; in sampled time only.
    impact_gain (n,): v+ = (1 + gain) v+ of (7), an error of the impact model; empty for none.
    fall_height: the run ends as a fall when the hip is below this fraction of |p_hip| at q = 0.
    max_step_time [s]: a longer single support ends as stalled.
    """

    plant: Biped
    controller: Controller
    disturbance: Disturbance | None = None
    timing: ContinuousTime | SampledTime = ContinuousTime()  # noqa: RUF009
    model: Biped | None = None
    torque_limit: float | None = None
    fall_height: float = 0.35
    max_step_time: float = 2.0
    slope: float = 0.0
    ground_steps: tuple[StepDown | StepUp, ...] = ()
    sensors: Sensors | None = None
    motors: Motors | None = None
    meter: Meter | None = None
    impact_gain: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        check_slope(self.slope)
        limit = self.torque_limit
        if limit is not None and not (math.isfinite(limit) and limit > 0):
            raise InputError(f"the torque limit is {limit} N m, expected a positive number or None")
        if self.model is not None and self.model.n != self.plant.n:
            raise InputError(
                f"the model has {self.model.n} coordinates, the plant {self.plant.n}; they must agree"
            )
        check_ends(self.max_step_time, self.fall_height)
        check_timing(self.timing)
        parts = (self.sensors, self.motors, self.meter)
        held.check_parts(self.plant.n, self.timing, *parts, self.impact_gain)

    @cached_property
    def nominal(self) -> Biped:
        """The model the controller knows; the plant itself when none was given."""
        return self.model if self.model is not None else self.plant

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
        time, meter = self.timing, self.meter
        if not isinstance(time, SampledTime):
            return None
        return held.held_parameters(
            self.plant.n,
            self.plant.p,
            time.period,
            time.delay,
            time.delay_known,
            self.sensors,
            self.motors,
            None if meter is None else meter.parameters(self.plant, time.period, self.slope),
        )

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
        n = self.plant.n
        return x[:n], x[n : 2 * n], x[2 * n : len(x) - self.behind]

    def held_at(self, x: Array) -> Held:
        """What x holds between ticks, in sampled time."""
        assert self.held is not None
        return held.read(self.held.sizes, x[len(x) - self.behind :])

    def measure(self, t: float, q: Array, v: Array, mode: Mode) -> Measurement:
        """What the controller is given at (t, q, v)."""
        model = self.nominal
        body = model.body_terms(q, v) if self.law.needs_body else None
        return Measurement(t, mode.step, t - mode.start, q, v, model.reduction(q, v), body)

    def initial_state(self, q: Array, v: Array, mode: Mode | None = None) -> Array:
        """x at the start of single support in (q, v). Raises InputError for a controller that does not fit."""
        mode = Mode() if mode is None else mode
        m = self.measure(mode.start, np.asarray(q, dtype=float), np.asarray(v, dtype=float), mode)
        s = self.law.initial_state(m)
        check_output(self.controller, np.asarray(self.law.output(s, m)), self.plant.p)
        if self.held is None:
            return np.concatenate((m.q, m.v, s))
        return np.concatenate((m.q, m.v, s, held.at_start(self.held, m.q, m.v, self.sensors)))

    def saturate(self, u: Array) -> Array:
        """u within the torque limit. Raises NotFiniteError, SimulationError for another number of torques."""
        u = np.asarray(u, dtype=float)
        if u.shape != (self.plant.p,):
            raise SimulationError(misshapen(self.controller, u, self.plant.p))
        if self.torque_limit is not None:
            u = np.minimum(np.maximum(u, -self.torque_limit), self.torque_limit)
        if not math.isfinite(u.dot(u)):
            raise NotFiniteError(f"{type(self.controller).__name__}.output returned {u} N m")
        return u

    def _external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        if self.disturbance is None:
            return np.zeros(self.plant.n)
        return self.disturbance.torque(t, mode.step, mode.start, q, v)

    def _force(self, u: Array, zeta: Array) -> Array:
        force = zeta.copy()
        force[: self.plant.p] += u
        return force

    def _motor_torque(self, x: Array) -> Array:
        return held.motor_torque(self.held_at(x).line)

    def instant(self, t: float, x: Array, mode: Mode) -> Instant:
        """Measurement, torque, force and acceleration at (t, x)."""
        q, v, s = self.split_state(x)
        m = self.measure(t, q, v, mode)
        u = self._motor_torque(x) if self.sampled else self.saturate(self.law.output(s, m))
        zeta = self._external(t, q, v, mode)
        force = self._force(u, zeta)
        return Instant(m, s, u, zeta, force, self._acceleration(m.terms, q, v, force))

    def unknown(self, terms: Reduction, a: Array, u: Array, zeta: Array) -> Array:
        """xi~ of (11) (n,) [N m]: zeta, and with a plant that is not the model all that is wrong with it."""
        if self.model is None and not self.plant.friction:
            return zeta
        return unknown_force(terms, a, u)

    def ground_reaction(self, i: Instant, mode: Mode) -> Array:
        """Force of the ground on the stance foot (F_T, F_N) [N], forces from outside taken off."""
        m = i.measurement
        F = self.plant.ground_reaction(m.q, m.v, i.a)
        if self.disturbance is None:
            return F
        return F - self.disturbance.resultant(m.t, mode.step, mode.start)

    def _acceleration(self, terms: Reduction, q: Array, v: Array, force: Array) -> Array:
        """q'' of the plant; where it is the nominal model, D_s and Omega are at hand already."""
        if self.model is None and not self.plant.friction:
            return solve(terms.D, force - terms.Omega, "D_s")
        return self.plant.acceleration(q, v, force)

    def _metered(
        self, t: float, g: Array, q: Array, v: Array, line: Line, terms: Reduction, mode: Mode
    ) -> Array:
        """The meter's state after a tick at which `line` is sent."""
        k = self.held
        assert k is not None
        u, mean = held.motor_torque(line), mean_torque(k.motors, line)
        zeta = self._external(t, q, v, mode)
        a = self._acceleration(terms, q, v, self._force(u, zeta))
        since, drop = (t - k.meter.period, t), self.drop(mode.step)
        asked = loads(self.plant, self.disturbance, since, mode, q, v, a, drop)
        unknown = self.unknown(terms, a, u, zeta)
        given = (q, v, u, mean, unknown, terms, t, mode.step, t - mode.start, asked)
        return metered(k.meter, g, *given)

    def flow(self, t: float, x: Array, mode: Mode) -> Array:
        if self.sampled:
            q, v, _ = self.split_state(x)
            dx, line = np.zeros_like(x), self.held_at(x).line
            n = self.plant.n
            force = self._force(held.motor_torque(line), self._external(t, q, v, mode))
            dx[:n], dx[n : 2 * n] = v, self.plant.acceleration(q, v, force)
            if len(line.u_m):
                assert self.held is not None
                at, p = len(x) - self.held.sizes.p * (self.held.sizes.waiting + 2), self.plant.p
                dx[at : at + p] = self.held.motors.speed * (line.u - line.u_m)
            return dx
        i = self.instant(t, x, mode)
        return np.concatenate((i.measurement.v, i.a, self.law.flow(i.s, i.measurement, i.u)))

    def tick(self, t: float, x: Array, mode: Mode) -> Array:
        """x after a tick of the control clock: sensors, controller, line of torques, meter."""
        k = self.held
        assert k is not None
        (q, v, s), h, n = self.split_state(x), self.held_at(x), self.plant.n
        w = sense(k.sensors, h.w, q, v) if k.sizes.sensors else h.w
        m = (
            self.measure(t, w[:n], w[n : 2 * n], mode)
            if k.sizes.sensors
            else self.measure(t, q, v, mode)
        )
        s = self.law.correct(s, m)
        u = self.saturate(self.law.output(s, m))
        if k.sizes.rate:
            u = limited(k.motors, h.line, u)
        line = sent(k.motors, h.line, u)
        s = self.law.predict(s, m, acting(k.motors, line) if k.sizes.known else u)
        g = h.g
        if k.sizes.meter:
            terms = self.nominal.reduction(q, v) if k.sizes.sensors else m.terms
            g = self._metered(t, g, q, v, line, terms, mode)
        return np.concatenate((q, v, s, held.written(Held(w, g, line))))

    def _release(self, t: float, x: Array, mode: Mode) -> Array:
        """The torque that waited for a part of the period acts."""
        p, x = self.plant.p, x.copy()
        x[-p:] = x[-2 * p : -p]
        return x

    def clocks(self) -> tuple[Clock, ...]:
        time = self.timing
        if not isinstance(time, SampledTime):
            return ()
        assert self.held is not None
        control = Clock("control", time.period, self.tick, time.restart)
        if not self.held.sizes.waiting:
            return (control,)
        after = self.held.motors.fraction * time.period
        return (control, Clock("motors", time.period, self._release, time.restart, after))

    def switching_times(self, mode: Mode) -> tuple[float, ...]:
        if self.disturbance is None:
            return ()
        return self.disturbance.switching_times(mode.step, mode.start)

    def strike(self, t: float, x: Array, mode: Mode) -> tuple[Array, Mode] | None:
        """x+ after impact and relabelling; None unless the swing foot is ahead of the stance foot."""
        if self.plant.swing_foot(x[: self.plant.n])[0] <= LEAST_STEP:
            return None
        return self.struck(t, x, mode)

    def struck(self, t: float, x: Array, mode: Mode) -> tuple[Array, Mode]:
        """x+ after impact and relabelling, wherever the swing foot is."""
        q, v, s = self.split_state(x)
        impact = self.plant.impact(q, v)
        v_plus = impact.v if not self.impact_gain else impact.v * (1.0 + np.array(self.impact_gain))
        mode, n, tail = Mode(mode.step + 1, t), self.plant.n, np.zeros(0)
        seen = impact.q, v_plus
        if self.held is not None:
            h, expected = self.held_at(x), v_plus
            if self.held.sizes.sensors:
                expected = self.nominal.impact(h.w[:n], h.w[n : 2 * n]).v
            hit = Hit(t, mode.step - 1, self.plant.momentum(q, v), impact.impulse)
            h = held.after_impact(self.held, h, self._swap, q, impact.q, v_plus, expected, hit)
            tail = held.written(h)
            if self.held.sizes.sensors:
                seen = h.w[:n], h.w[n : 2 * n]
        s = self.law.jump(s, self.measure(t, *seen, mode), self._swap)
        return np.concatenate((impact.q, v_plus, s, tail)), mode

    @cached_property
    def _swap(self) -> Any:
        """Relabelling of the actuated joints (p,), dtype int."""
        if self.plant.p == 0:
            return np.zeros(0, dtype=int)
        return self.plant.relabelling[: self.plant.p]

    def drop(self, step: int) -> float:
        """How far the steps of the ground in single support `step` lower where it ends [m]."""
        return sum((d.drop for d in self.ground_steps if d.step == step), 0.0)

    def clearance(self, q: Array, step: int | None = None) -> float:
        """Height of the swing foot above the ground [m], measured along the vertical.

        With `step`, above the ground on which that single support ends; without, where no step down is.
        """
        x, z = self.plant.swing_foot(q)
        drop = 0.0 if step is None else self.drop(step)
        return float(z + math.tan(self.slope) * x) + drop

    @cached_property
    def lowest_hip(self) -> float:
        """Height of the hip below which the run ends as a fall [m]."""
        straight = np.zeros(self.plant.n)
        return self.fall_height * float(np.linalg.norm(self.plant.hip(straight)))

    def guards(self, mode: Mode) -> tuple[Guard, ...]:
        n = self.plant.n
        return (
            Guard(
                FOOT_STRIKE,
                lambda t, x: self.clearance(x[:n], mode.step),
                lambda t, x: self.strike(t, x, mode),
            ),
            Guard(
                "hip_too_low",
                lambda t, x: float(self.plant.hip(x[:n])[1]) - self.lowest_hip,
                terminal=Status.FELL,
            ),
            Guard(
                "step_too_long",
                lambda t, x: mode.start + self.max_step_time - t,
                terminal=Status.STALLED,
            ),
        )

    def split_laws(self, feedback: bool = False) -> SplitLaws | None:
        """The laws behind `split`, or behind `feedback_split`, which raises InputError and says why not."""
        n, p = self.plant.n, self.plant.p
        if not feedback:
            return None if self.sampled else error_laws(self.law, n, p)
        if self.sampled:
            raise InputError(
                "feedback=True needs a controller that acts at every instant, and this one acts at ticks; "
                "use ContinuousTime(), or RK4, Adaptive or Stiff"
            )
        return loop_laws(self.law, n, p, self.plant.inertia)

    def split(self, mode: Mode) -> Split | None:
        """Error coordinates of the observer: e' = A e + b (q_b'' - kappa u), independent of u itself.

        The observer's states are the first of s; what follows them is taken with (q, q').
        """
        laws = self.split_laws()
        return None if laws is None else replace(split_of(self, laws, mode), node=None)

    def feedback_split(self, mode: Mode) -> Split | None:
        """Those with the tracking error q_b - h(Theta) too, beside Theta and the angular momentum.

        Raises InputError for a walker without such coordinates.
        """
        laws = self.split_laws(feedback=True)
        return None if laws is None else split_of(self, laws, mode)
