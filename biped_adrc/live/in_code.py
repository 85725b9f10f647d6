"""Walks moved on in machine code: as a whole, or the plant alone around a controller in plain Python.

The hand is two more parts of the disturbance, a torque on the coordinates and a force on a link. Their numbers
are in the vector F of the plan (`engine.kernels.run_plan`), which each walk has for itself and writes before a
sample. So another hand compiles nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, cast

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.disturbances.base import Sum
from biped_adrc.disturbances.link import LinkParameters, OnLink
from biped_adrc.disturbances.step import TorqueStep
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.kernels import layout
from biped_adrc.engine.simulate import flown, starting
from biped_adrc.engine.symbols import floats
from biped_adrc.engine.ticks import TicksWithHardware
from biped_adrc.hybrid.simulator import FlownArc
from biped_adrc.live.hand import Hand, LinkPoints
from biped_adrc.live.moving import Moving, Now, in_python
from biped_adrc.types import Array

ROOM = 16
"""Nodes of a sample to make room for at first."""


def on_the_plan(walker: Walker) -> Walker:
    """The walker with a torque and a force as two more parts of its disturbance, both zero."""
    d, n = walker.plant.description, walker.plant.n
    force = OnLink(walker.plant, d.trunk, TorqueStep(np.zeros(3)))
    given = walker.disturbance or Sum()
    return replace(walker, disturbance=given + TorqueStep(np.zeros(n)) + force)


class HandNumbers:
    """Puts the numbers of a hand into the vector F of a plan that is a walk's own."""

    def __init__(self, made: CompiledWalker, points: LinkPoints):
        """For a walker `on_the_plan`: the last two parts of its disturbance are the hand."""
        disturbance, P = made.walker.disturbance, made.plan.P
        assert isinstance(disturbance, Sum)
        laws = [law for part in disturbance.parts[-2:] for law in part.laws or ()]
        self.torque, self.force = (cast(Any, law.parameters) for law in laws)
        last = P[layout.PARTS_AT] + layout.PART_SIZE * P[layout.PARTS] + 1
        self.at = [int(P[last - k * layout.PART_SIZE]) for k in (2, 1)]
        self.F, self.points = made.plan.F, points
        plant = made.walker.plant
        self.held = self.rest = Hand((0.0,) * plant.n, plant.description.trunk)

    def hold(self, hand: Hand | None) -> None:
        """Put a hand into F; None for one that does nothing."""
        hand = self.rest if hand is None else hand
        if hand == self.held:
            return
        self.held = hand
        torque = self.torque._replace(amplitude=np.array(hand.torque))
        wave = self.force.wave._replace(amplitude=np.array((*hand.force, 0.0)))
        force = LinkParameters(self.points.of(hand.link, hand.at), wave)
        for at, k in zip(self.at, (torque, force), strict=True):
            numbers = floats(k)
            self.F[at : at + len(numbers)] = numbers


def own_plan(made: CompiledWalker) -> CompiledWalker:
    """The same with a plan whose numbers may be written."""
    return replace(made, plan=replace(made.plan, F=made.plan.F.copy()))


@dataclass(frozen=True)
class MovingCode(Moving):
    """A walk that is machine code as a whole."""

    made: CompiledWalker
    numbers: HandNumbers = field(init=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "numbers", HandNumbers(self.made, self.points))

    def at(self, t: float, x: Array, mode: Mode, began: float, fired: str | None) -> Now:
        return Now(t, x, mode, began, fired, starting(self.made, x, t, mode, t, fired))

    def fly(self, now: Now, hand: Hand | None) -> tuple[FlownArc, Array]:
        self.numbers.hold(hand)
        s = now.s.copy()
        s[layout.END] = self.until(now)
        return flown(self.made, s, now.mode, 1, ROOM)


@dataclass(frozen=True)
class MovingPython(Moving):
    """A walk whose controller is plain Python, on the compiled plant."""

    system: TicksWithHardware
    numbers: HandNumbers = field(init=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "numbers", HandNumbers(self.system.plant, self.points))

    def fly(self, now: Now, hand: Hand | None) -> tuple[FlownArc, Array]:
        self.numbers.hold(hand)
        return in_python(self.system, self, now), np.zeros(0)
