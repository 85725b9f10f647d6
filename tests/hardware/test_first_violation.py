"""The first violation of a walk: of hand-made single supports in which it is known, and of a walk cut there."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

import biped_adrc as ba
from biped_adrc.analysis.feasibility import first_violation
from biped_adrc.analysis.ground_force import Nodes
from biped_adrc.model.robots.limits import KnownLimits

KNOWN = KnownLimits(0.6, 150.0, 5e-3)
LATER = {"torque": 0.0, "scuffs": 0.0, "F_N": 3.75e-3, "friction": 3.6e-3}
"""[s] until the mean over 5 ms is outside the cone; torque and depth count at once."""


def step(walker, **begins):
    """A single support of 0.4 s at 300 N in which each violation begins at its time [s]."""
    t = np.linspace(0.0, 0.4, 4001)

    def since(name, before, after):
        return np.where(t >= begins.get(name, np.inf), after, before)

    zero, torque = np.zeros((len(t), 4)), np.zeros((len(t), 4))
    torque[:, 2] = since("torque", 149.0, -151.0)
    F = np.column_stack((since("friction", 0.0, -250.0), since("F_N", 300.0, -100.0)))
    newton = F - walker.plant.weight * np.array([0.0, 1.0])
    momentum = cumulative_trapezoid(newton, t, axis=0, initial=0.0)
    foot = np.column_stack((np.full(len(t), 0.3), since("scuffs", 0.05, -0.002)))
    ones = np.ones(len(t), dtype=int)
    return Nodes(t, ones, zero, torque, zero, momentum, foot, np.zeros((len(t), 2)))


def first_in(walker, n, finished=True):
    """The first violation of a single support, with an impulse along the normal at its end."""
    return first_violation(walker, n, KNOWN, int(finished), n.momentum[-1] + np.array([0.0, 1.0]))


@pytest.fixture(scope="module")
def walker(biped, gait):
    return ba.Walker(biped, ba.NPDController(gait.constraint))


@pytest.mark.parametrize("first", LATER)
@pytest.mark.parametrize("second", [None, *LATER])
def test_the_earliest_of_all_is_told(walker, first, second):
    begins = {first: 0.1} if second is None else {second: 0.2, first: 0.1}
    found = first_in(walker, step(walker, **begins))
    assert found.t == pytest.approx(0.1 + LATER[first], abs=2e-4)
    assert first in found.what


def test_none_is_none_and_a_number_that_is_none_is_one(walker):
    feasible = step(walker)
    assert first_in(walker, feasible) is None
    u = feasible.u.copy()
    u[7, 1] = np.nan
    assert first_in(walker, replace(feasible, u=u)).t == feasible.t[7]


def test_the_end_of_a_step_counts_unless_the_foot_comes_down_there(walker):
    late = step(walker, scuffs=0.395)
    assert first_in(walker, late) is None
    assert first_in(walker, late, finished=False).t == pytest.approx(0.395)


def test_a_walk_is_cut_at_the_node_of_its_first_violation(walker, gait):
    """A push in the second step asks for more than any torque of the first."""
    push = ba.TorquePulse([120.0, 0.0, 0.0, 0.0, 0.0], step=2, start=0.1, stop=0.2)
    walk = ba.walk(replace(walker, disturbance=push), gait, 2)
    s, most = walk.signals, np.max(np.abs(walk.signals.u), axis=1)
    limit = 0.5 * (np.max(most[s.step == 1]) + np.max(most[s.step == 2]))
    assert limit > 1.02 * np.max(most[s.step == 1])
    whole, cut = walk.trajectory, walk.until_infeasible(ba.Limits(torque=limit)).trajectory
    assert cut.status is ba.Status.INFEASIBLE
    assert cut.t_end == s.t[np.argmax(most > limit)]
    assert len(cut.arcs) == 2
    assert cut.arcs[1].event is None
    for one, other in zip(cut.arcs, whole.arcs, strict=True):
        np.testing.assert_array_equal(one.x, other.x[: len(one.t)])
    assert len(cut.arcs[0].t) == len(whole.arcs[0].t)
    assert "torque" in cut.detail
