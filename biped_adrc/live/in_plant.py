"""Walks moved on by a plant that moves by itself, such as MuJoCo, with a hand beside its own disturbance."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import Load
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.engine.compiled_loop import CompiledLoop
from biped_adrc.engine.compiled_push import PlantPush, PythonPush
from biped_adrc.engine.strides import Strides
from biped_adrc.hybrid.simulator import FlownArc, Record
from biped_adrc.hybrid.system import Clock, FoundEvent, HybridSystem, Mover
from biped_adrc.live.hand import Hand, LinkPoints
from biped_adrc.live.moving import Moving, Now, in_python
from biped_adrc.types import Array


@dataclass(frozen=True)
class MovingPlant(Moving):
    """A walk on a plant that moves by itself."""

    on: SteppingLoop

    @property
    def loop(self) -> SteppingLoop:
        return self.on

    def begun(self, q: Array, v: Array, mode: Mode, own: Array | None) -> Array:
        k = self.on.held
        assert k is not None
        if own is None or len(own) != k.sizes.own:
            return self.on.initial_state(q, v, mode)
        x = ClosedLoop.initial_state(self.on, q, v, mode)
        x[len(x) - k.sizes.total :][: len(own)] = own
        return x

    def torque(self, now: Now) -> Array:
        return self.on.motor_torque(now.x)

    def fly(self, now: Now, hand: Hand | None) -> tuple[FlownArc, Array]:
        system = self.system
        if isinstance(system, Strides):
            push = system.push if hand is None else WithHand(system.push, hand, self.points)
            system = replace(system, began=now.began, push=push)
        elif hand is not None:
            system = UnderHand(self.on, WithHand(PythonPush(self.on), hand, self.points))
        return in_python(system, self, now), np.zeros(0)

    @cached_property
    def system(self) -> HybridSystem:
        """The loop as the simulator runs it, without a hand."""
        if not isinstance(self.on, CompiledLoop):
            return self.on
        still = np.zeros(self.on.plant.n)
        size = len(self.on.law.initial_state(self.on.measure(0.0, still, still, Mode())))
        return self.on.system(size, self.t_first)


@dataclass(frozen=True)
class WithHand:
    """What acts on a loop from outside, and a hand."""

    push: PlantPush
    hand: Hand
    points: LinkPoints

    def load(self, t: float, q: Array, v: Array, mode: Mode) -> Load:
        """The sum at t [s], q (n,) [rad], v (n,) [rad/s]."""
        own, mine = self.push.load(t, q, v, mode), self.points.load(self.hand, q)
        return mine if own is None else Load(own.zeta + mine.zeta, own.force + mine.force)

    def zeta(self, t: Array, q: Array, v: Array, mode: Mode) -> Array:
        """zeta (K, n) [N m] at K times [s], q (K, n) [rad], v (K, n) [rad/s]."""
        mine = np.array([self.points.load(self.hand, row).zeta for row in q])
        return self.push.zeta(t, q, v, mode) + mine


@dataclass(frozen=True)
class UnderHand(HybridSystem):
    """A loop whose plant does not stride, with another load than its own."""

    loop: SteppingLoop
    push: WithHand

    def clocks(self) -> tuple[Clock, ...]:
        return self.loop.clocks()

    def switching_times(self, mode: Mode) -> tuple[float, ...]:
        return self.loop.switching_times(mode)

    def mover(self, fired: str | None) -> Mover:
        return self.move

    def move(
        self, t: float, x: Array, mode: Mode, until: float, record: Record
    ) -> tuple[float, Array, FoundEvent | None]:
        """As `SteppingLoop.move`."""
        return self.loop.moved(t, x, mode, until, record, self.push.load)
