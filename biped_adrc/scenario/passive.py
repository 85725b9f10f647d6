"""Robots without motors on their known cycle: the fixed point of the return map, found by Newton.

It is found from the stored state; a walk starts just after its impact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.control.passive import Passive
from biped_adrc.gait.published import passive_cycle
from biped_adrc.hybrid.integrators import Adaptive
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array
from biped_adrc.walker import Mode, Walker

LIGHT_FEET = 5e-4
"""[rad, rad/s], of central differences, where round-off of 1e-10 in P asks for wider ones."""
SETTLES = 1e-9
"""[rad, rad/s], residual of Newton: feet of 1e-7 of the hip's mass leave a round-off of 1e-10."""


@dataclass(frozen=True)
class Cycle:
    """A return map and a pre-impact state from which Newton finds its fixed point."""

    P: ReturnMap
    guess: Array


def known_cycle(biped: Biped, slope: float | None = None) -> Cycle:
    """The stored cycle of a robot without motors, on its own slope or another one [rad] nearby.

    Raises GaitError when none is stored, SimulationError when the robot does not come to a first impact.
    """
    known = passive_cycle(biped)
    angle = known.slope if slope is None else slope
    walker = Walker(biped, Passive(), slope=angle, max_step_time=known.max_step_time)
    P = ReturnMap(walker, Adaptive(1e-12, 1e-12), difference=LIGHT_FEET, pitch=math.pi)
    start = walker.initial_state(known.q_plus, known.v_plus)
    return Cycle(P, P.next_strike(walker, start, Mode()).x_minus)


def cycle_start(biped: Biped, slope: float) -> tuple[Array, Array]:
    """(q, v) just after the impact of the cycle on a slope [rad]. Raises SimulationError without one."""
    cycle, n = known_cycle(biped, slope), biped.n
    orbit, _ = periodic_orbit(cycle.P, cycle.guess, SETTLES)
    after = biped.impact(orbit.x_minus[:n], orbit.x_minus[n:])
    return after.q, after.v
