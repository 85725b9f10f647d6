"""A scenario whose controller is a process of its own: `ba.in_the_loop`, and `biped-adrc loop`.

    found = ba.in_the_loop(ba.Scenario("LESO", hardware="rabbit"), real_time=True)

The exported controller walks the scenario, on the plant that the scenario says, up to three times: called in
this process, in lock step over loopback, and in real time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.loaded import ExportedController, Loaded
from biped_adrc.deploy.process import controller_process
from biped_adrc.deploy.remote import LockStep, RealTime
from biped_adrc.deploy.source import source_of
from biped_adrc.deploy.tick_times import TickTimes
from biped_adrc.errors import InputError
from biped_adrc.parts import check_part
from biped_adrc.scenario.build import build
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.shown import Shown

DEADLINE = 0.5
"""Of the period: the usual deadline of an answer; the rest is for the plant."""


@dataclass(frozen=True)
class InTheLoop(Shown):
    """The walks of one scenario by its exported controller."""

    offline: Walk
    """Each sample instant is a call in this process."""
    lock_step: Walk
    """Each is a datagram to another process, which is waited for."""
    real_time: Walk | None
    """The same by the clock on the wall; None where it was not asked for."""
    times: TickTimes | None
    """Of the walk in real time."""

    @property
    def walks(self) -> tuple[Walk, ...]:
        """All that there are."""
        walks = self.offline, self.lock_step, self.real_time
        return tuple(walk for walk in walks if walk is not None)

    @property
    def same_in_lock_step(self) -> bool:
        """Whether the walk in lock step is the one offline, bit for bit."""
        return same_motion(self.offline, self.lock_step)

    def said(self, walk: Walk) -> str:
        """How a walk compares with the one offline, in a sentence."""
        if same_motion(self.offline, walk):
            return "the same walk as in this process, bit for bit"
        return "another walk than in this process"


def in_the_loop(
    scenario: Scenario,
    real_time: bool = False,
    deadline: float | None = None,
    real: str = "float64",
    port: int = 0,
) -> InTheLoop:
    """Walk a scenario by its exported controller as a process of its own, in lock step and in real time.

    deadline: from a measurement to the torque, at most the period [s]; half a period if None. real: type of
    numbers in C. port: of the process on 127.0.0.1, 0 for one that is free. Raises InputError for a scenario
    that cannot be exported and where there is no compiler, SimulationError where the process ends or does not
    answer.
    """
    check_part(scenario, "what is to walk", Scenario)
    computer = Computer(build(scenario))
    period = computer.timing.period
    deadline = DEADLINE * period if deadline is None else deadline
    if not 0.0 < deadline <= period:
        raise InputError(
            f"the deadline is {deadline} s, expected above 0 and at most the period of {period} s"
        )
    source = source_of(computer, real=real)
    offline = walk_scenario(scenario, controller=ExportedController(Loaded(source, real)))
    with controller_process(source, port) as process:
        lock_step = walk_scenario(scenario, controller=LockStep(process))
        if not real_time:
            return InTheLoop(offline, lock_step, None, None)
        paced = RealTime(process, deadline)
        walk = walk_scenario(scenario, controller=paced)
    return InTheLoop(offline, lock_step, walk, paced.times)


def same_motion(one: Walk, other: Walk) -> bool:
    """Whether times, angles, rates and torques of two walks are the same numbers, and their ends."""
    if one.trajectory.status is not other.trajectory.status:
        return False
    arcs = one.trajectory.arcs, other.trajectory.arcs
    if len(arcs[0]) != len(arcs[1]):
        return False
    n, p = 2 * one.walker.plant.n, one.walker.plant.p
    return all(
        np.array_equal(a.t, b.t)
        and np.array_equal(a.x[:, :n], b.x[:, :n])
        and np.array_equal(a.x[:, -p:], b.x[:, -p:])
        for a, b in zip(*arcs, strict=True)
    )
