"""A fixed-base arm under a controller, with the controllers and observers that walkers use.

    D q'' + Omega = sat(u)

`closed_loop.semantics` defines the loop; here are its torque limits and a run in one call. The
controller's terms come from the nominal `model`, which may know less than the `plant`, for instance
not the load in the hand. There are no events and one mode, so a run is a single arc.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.errors import InputError
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.arm import Arm
from biped_adrc.timing import ContinuousTime, SampledTime
from biped_adrc.types import Array


@dataclass(frozen=True)
class ArmSystem(ClosedLoop[Arm]):
    """An arm and its controller as a hybrid system with every joint actuated (p = n).

    - plant: the arm that moves. model: what the controller knows, the plant itself when None.
    - controller, timing: as of a walker, without a computation delay.
    - limited: whether motors saturate at the efforts of the plant's URDF [N m]; observers are fed
      what is applied.

    Raises InputError for a model with another number of joints, a computation delay, which is for
    walkers, or a controller that needs the ground.
    """

    plant: Arm
    controller: Controller
    timing: ContinuousTime | SampledTime = field(default_factory=ContinuousTime)
    model: Arm | None = None
    limited: bool = True

    def __post_init__(self) -> None:
        """Raise InputError for what is no arm's: a delay, or a controller that needs the ground."""
        self.check()
        if isinstance(self.timing, SampledTime) and self.timing.delay > 0.0:
            raise InputError(
                f"the computation delay is {self.timing.delay} s, expected 0: delays are for walkers"
            )
        if self.controller.needs_body:
            raise InputError(
                f"{type(self.controller).__name__} needs the terms of a body on the ground; use it on a Walker"
            )

    @property
    def limit(self) -> Array | None:
        """The efforts of the URDF (n,) [N m]; None with `limited=False`."""
        return self.plant.effort if self.limited else None

    def run(
        self, q: Array, v: Array, duration: float, method: OneStepMethod, store_every: int = 1
    ) -> Trajectory:
        """The motion from q (n,) [rad], v (n,) [rad/s] for `duration` [s]; every `store_every`-th
        step is kept.

        Raises InputError for a start that does not fit; what happens on the way is in the status.
        """
        x = self.initial_state(q, v)
        return simulate(self, x, Mode(), method, t_end=duration, store_every=store_every)

    def measure(self, t: float, q: Array, v: Array, mode: Mode | None = None) -> Measurement:
        """What the controller is given at t [s], q (n,) [rad], v (n,) [rad/s]; an arm has one mode."""
        return super().measure(t, q, v, Mode())

    def applied(self, t: float, x: Array) -> Array:
        """Torque u (n,) [N m] that acts at (t, x), t in [s]."""
        return self.instant(t, x, Mode()).u

    def error(self, trajectory: Trajectory, reference: Reference) -> Array:
        """Tracking error q - q_d (K, n) [rad] at the K nodes of a run."""
        n = self.plant.n
        rows = trajectory.sample(lambda t, x, _: x[:n] - reference(t, x[:n], x[n : 2 * n]).q_d)
        return np.array(rows)
