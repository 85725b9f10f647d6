"""An arm under a controller, as a system to be simulated; the same controllers and observers as for walkers.

    D q'' + Omega = sat(u)

State x = (q, q', s) in continuous time, (q, q', s, u) in sampled time. The controller's terms come from the
nominal `model`, which may know less than the `plant`: what the hand carries, say. There are no events.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.errors import InputError, NotFiniteError
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.system import Clock, HybridSystem, Mode
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.arm import Arm
from biped_adrc.timing import ContinuousTime, SampledTime, check_timing
from biped_adrc.types import Array


@dataclass(frozen=True)
class ArmSystem(HybridSystem):
    """plant and controller; model: what the controller knows, the plant itself when None.

    Motors saturate at the efforts of the plant's URDF unless `limited` is False; observers are fed what is
    applied. Raises InputError for a model with another number of joints, a computation delay, which is for
    walkers, or a controller that needs the ground.
    """

    plant: Arm
    controller: Controller
    timing: ContinuousTime | SampledTime = field(default_factory=ContinuousTime)
    model: Arm | None = None
    limited: bool = True

    def __post_init__(self) -> None:
        check_timing(self.timing)
        if self.nominal.n != self.plant.n:
            raise InputError(
                f"the model has {self.nominal.n} joints, the plant {self.plant.n}; they must agree"
            )
        if isinstance(self.timing, SampledTime) and self.timing.delay > 0.0:
            raise InputError(
                f"the computation delay is {self.timing.delay} s, expected 0: delays are for walkers"
            )
        if self.controller.needs_body:
            raise InputError(
                f"{type(self.controller).__name__} needs the terms of a body on the ground; use it on a Walker"
            )

    @cached_property
    def nominal(self) -> Arm:
        """What the controller knows."""
        return self.plant if self.model is None else self.model

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

    def run(
        self, q: Array, v: Array, duration: float, method: OneStepMethod, store_every: int = 1
    ) -> Trajectory:
        """From (q, v) for `duration` [s]. Raises InputError; what happens on the way is in the status."""
        x = self.initial_state(np.asarray(q, dtype=float), np.asarray(v, dtype=float))
        return simulate(self, x, None, method, t_end=duration, store_every=store_every)

    def initial_state(self, q: Array, v: Array) -> Array:
        """x at (q, v), each (n,). Raises InputError for a controller that does not fit."""
        n, m = self.plant.n, self.measure(0.0, q, v)
        s = self.law.initial_state(m)
        u = np.asarray(self.law.output(s, m))
        if u.shape != (n,):
            raise InputError(
                f"{type(self.controller).__name__}.output returned an array of shape {u.shape}, expected "
                f"({n},): one torque per joint"
            )
        return np.concatenate((q, v, s, *([np.zeros(n)] if self.sampled else [])))

    def measure(self, t: float, q: Array, v: Array) -> Measurement:
        """What the controller is given."""
        return Measurement(t, 1, t, q, v, self.nominal.reduction(q, v))

    def applied(self, t: float, x: Array) -> Array:
        """u (n,) that acts at (t, x)."""
        q, v, s = self._parts(x)
        if self.sampled:
            return x[-self.plant.n :]
        return self._saturated(self.law.output(s, self.measure(t, q, v)))

    def error(self, trajectory: Trajectory, reference: Reference) -> Array:
        """q - q_d (K, n) at the nodes of a run."""
        n, rows = self.plant.n, []
        for arc in trajectory.arcs:
            for t, x in zip(arc.t, arc.x, strict=True):
                rows.append(x[:n] - reference(float(t), x[:n], x[n : 2 * n]).q_d)
        return np.array(rows)

    def flow(self, t: float, x: Array, mode: Mode) -> Array:
        q, v, s = self._parts(x)
        if self.sampled:
            a = self.plant.acceleration(q, v, x[-self.plant.n :])
            return np.concatenate((v, a, np.zeros(len(s) + self.plant.n)))
        m = self.measure(t, q, v)
        u = self._saturated(self.law.output(s, m))
        return np.concatenate((v, self.plant.acceleration(q, v, u), self.law.flow(s, m, u)))

    def clocks(self) -> tuple[Clock, ...]:
        if isinstance(self.timing, SampledTime):
            return (Clock("control", self.timing.period, self._tick, self.timing.restart),)
        return ()

    def _tick(self, t: float, x: Array, mode: Mode) -> Array:
        q, v, s = self._parts(x)
        m = self.measure(t, q, v)
        s = self.law.correct(s, m)
        u = self._saturated(self.law.output(s, m))
        return np.concatenate((q, v, self.law.predict(s, m, u), u))

    def _parts(self, x: Array) -> tuple[Array, Array, Array]:
        n = self.plant.n
        return x[:n], x[n : 2 * n], x[2 * n : len(x) - n if self.sampled else len(x)]

    def _saturated(self, u: Array) -> Array:
        if self.limited:
            u = np.clip(u, -self.plant.effort, self.plant.effort)
        if not np.all(np.isfinite(u)):
            raise NotFiniteError(f"{type(self.controller).__name__}.output returned {u} N m")
        return u
