"""Work and energy over one step of a periodic walk on level ground.

Single support conserves energy but for the joints, and a step ends as high as it began, so that the net work of
the joints is the kinetic energy lost at impact: int u' q_b' dt = KE- - KE+.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.return_map import ReturnMap, after_impact
from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.types import Array
from biped_adrc.hybrid.system import Guard, HybridSystem

TIGHT = ba.Adaptive(1e-12, 1e-12)


@dataclass(frozen=True)
class Worked(HybridSystem):
    """The walker with W' = u' q_b' as its last state."""

    walker: Walker

    def flow(self, t: float, y: Array, mode: Mode) -> Array:
        i = self.walker.instant(t, y[:-1], mode)
        power = i.u @ i.measurement.v_b
        return np.concatenate((i.measurement.v, i.a, [power]))

    def guards(self, mode: Mode) -> tuple[Guard, ...]:
        return tuple(self.with_work(guard) for guard in self.walker.guards(mode))

    def with_work(self, guard: Guard) -> Guard:
        def reset(t: float, y: Array) -> tuple[Array, Mode] | None:
            struck = guard.reset(t, y[:-1])
            return None if struck is None else (np.append(struck[0], y[-1]), struck[1])

        return replace(
            guard,
            witness=lambda t, y: guard.witness(t, y[:-1]),
            reset=None if guard.reset is None else reset,
        )


def work_and_loss(walker: Walker, x: Array) -> tuple[float, float]:
    """Joint work from the impact at x to the next, and the kinetic energy that one takes [J]."""
    P, n, plant = ReturnMap(walker, TIGHT), walker.plant.n, walker.plant
    start, mode = after_impact(walker, 0.0, x, Mode())
    end = P.next_impact(Worked(walker), np.append(start, 0.0), mode).x_minus
    q, v = end[:n], end[n : 2 * n]
    after = plant.impact(q, v)
    return end[-1], plant.kinetic_energy(q, v) - plant.kinetic_energy(after.q, after.v)


@pytest.mark.parametrize("name", ["published", "recipe"])
def test_joint_work_is_the_energy_lost_at_impact(biped: ba.Biped, name: str) -> None:
    gait = ba.load_gait(name, biped)
    walker = Walker(biped, ba.NPDController(gait.constraint))
    x = np.concatenate((gait.q_minus, gait.v_minus))
    x = periodic_orbit(ReturnMap(walker, TIGHT), x, 1e-10)[0].x_minus
    work, lost = work_and_loss(walker, x)
    assert work == pytest.approx(lost, rel=1e-8)
    assert lost > 1.0


def test_a_step_that_is_not_periodic_keeps_some_of_the_work(biped: ba.Biped, gait: ba.Gait) -> None:
    """1 % faster than the cycle the walker slows down, and the work falls short of the loss."""
    walker = Walker(biped, ba.NPDController(gait.constraint))
    work, lost = work_and_loss(walker, np.concatenate((gait.q_minus, 1.01 * gait.v_minus)))
    assert lost - work > 1e-3 * lost
