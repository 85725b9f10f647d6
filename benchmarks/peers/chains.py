"""The robot pinned at its stance foot, in the package's engine and in a Python loop around Pinocchio.

`Chain` is what each peer gives: its q'' for the check that it has the same robot, and its methods. A peer's
joint angles are q_peer = T q_s with T square and constant, so f_peer = T^-T f and q'' = T^-1 a_peer.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pinocchio as pin

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.base import Passive
from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array
from biped_adrc.engine.calls import compiled_biped
from biped_adrc.engine.program import CompiledWalker
from biped_adrc.hybrid.integrators import RK4, OneStepMethod
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import StepDown

SAME = 1e-8
"""Largest relative difference of a peer's q'' to the package's, dimensionless."""
H = 1e-3  # [s], of fixed steps
FAR = 1e3  # [m], [s] or hip heights: no guard of the engine fires

Simulate = Callable[[Array, Array, float], Array]
"""(q_s, q_s', T) -> q_s after T [s] of free motion."""


class Chain(ABC):
    """One peer's model of the pinned robot."""

    def __init__(self, biped: Biped) -> None:
        self.biped = biped

    @abstractmethod
    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under the generalised force (n,) [N m], in the package's coordinates."""

    @abstractmethod
    def methods(self) -> Mapping[str, Simulate]:
        """What is timed, by name."""

    def check(self, samples: int = 100) -> float:
        """Largest |q'' - q''_package| / |q''_package| over random states and forces.

        Raises ModelError when the peer simulates another robot.
        """
        random, n = np.random.default_rng(5), self.biped.n
        worst = 0.0
        for _ in range(samples):
            q, v = random.uniform(-np.pi, np.pi, n), random.normal(size=n)
            force = random.normal(scale=50.0, size=n)
            ours = self.biped.acceleration(q, v, force)
            gap = np.linalg.norm(self.acceleration(q, v, force) - ours)
            worst = max(worst, float(gap / np.linalg.norm(ours)))
        if not worst <= SAME:
            raise ModelError(
                f"{type(self).__name__}: q'' differs from the package's by {worst:.1e} relative, expected "
                f"{SAME:g}; look at axes, armature and gravity"
            )
        return worst


@dataclass(frozen=True)
class Coordinates:
    """The package's coordinates q_s and those of a peer whose joints come in another order."""

    biped: Biped
    joints: Sequence[str]

    @cached_property
    def T(self) -> Array:
        """(n, n), q_peer = T q_s."""
        names = list(self.biped.pinned.model.names)[1:]
        T: Array = self.biped.pinned.T[[names.index(joint) for joint in self.joints]]
        return T

    @cached_property
    def inverse(self) -> Array:
        """T^-1."""
        inverse: Array = np.linalg.inv(self.T)
        return inverse

    def force(self, force: Array) -> Array:
        """T^-T f."""
        return self.inverse.T @ force


class CompiledChain(Chain):
    """The package's compiled engine: a walker without torque over a ground far below, its guards watched."""

    def __init__(self, biped: Biped) -> None:
        super().__init__(biped)
        self.code = compiled_biped(biped)
        self.walker = Walker(
            biped, Passive(), fall_height=-FAR, max_step_time=FAR, ground_steps=(StepDown(1, FAR),)
        )

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        return self.code.acceleration(q, v, force)

    def methods(self) -> Mapping[str, Simulate]:
        return {"RK4 1 ms": self._simulate(RK4(H))}

    def _simulate(self, method: OneStepMethod) -> Simulate:
        n = self.biped.n
        layout = self.walker.layout_of(np.zeros(2 * n))
        plan = CompiledWalker.of(self.walker, method, layout).plan

        def simulate(q: Array, v: Array, duration: float) -> Array:
            run = plan.start(np.concatenate((q, v)), 0.0, 1, 0.0, duration)
            run["farthest"] = FAR  # it turns over
            run.strikes(1)
            run.stride()
            return run.x[:n].copy()

        return simulate


class PinocchioChain(Chain):
    """The package's own model, called as a user of Pinocchio would, without its checks."""

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        return self.biped.acceleration(q, v, force)

    def methods(self) -> Mapping[str, Simulate]:
        return {"aba in a Python loop, RK4 1 ms": self.rk4}

    def rk4(self, q: Array, v: Array, duration: float) -> Array:
        """q after `duration` [s]."""
        pinned = self.biped.pinned
        model, data, zero = pinned.model, pinned.data, np.zeros(pinned.model.nv)
        x, w = pinned.T @ q, pinned.T @ v
        for _ in range(round(duration / H)):
            a1 = pin.aba(model, data, x, w, zero)
            w2 = w + 0.5 * H * a1
            a2 = pin.aba(model, data, x + 0.5 * H * w, w2, zero)
            w3 = w + 0.5 * H * a2
            a3 = pin.aba(model, data, x + 0.5 * H * w2, w3, zero)
            w4 = w + H * a3
            a4 = pin.aba(model, data, x + H * w3, w4, zero)
            x = x + (H / 6.0) * (w + 2.0 * (w2 + w3) + w4)
            w = w + (H / 6.0) * (a1 + 2.0 * (a2 + a3) + a4)
        end: Array = np.linalg.solve(pinned.T, x)
        return end
